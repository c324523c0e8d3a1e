//! What lies around one segment, as a drawing of its own: the way to any depth of a drawing 10^301 times as large.
//!
//! Coordinates in `f64` tell a segment from its neighbours only up to 10^16, and sums of two `f64` up to 10^32. But a
//! view shows little at a time: a few blocks of about its size, and how they lie to each other. These places are exact
//! sums of the turtle's [way](crate::course), computed with as many digits as the drawing needs. A drawing of the blocks
//! near a segment, with the segment at the origin, is then an ordinary drawing for all that reads drawings.

use super::block::{Block, BlockId, Item, Placed, Polygon, Stroke};
use super::builder::Builder;
use super::origin::Origin;
use super::pieces::Pieces;
use super::{Drawing, SceneSize};
use crate::course::{By, Course, Spot};
use crate::plane::Directions;
use crate::style::{StyleChange, StyleId, Styles};
use lsystem_base::fixed::{Circle, Fixed, FixedPoint};
use lsystem_base::sorted::sort;
use lsystem_syntax::Heading;
use std::collections::HashSet;
use std::sync::{Arc, OnceLock};

/// The neighbourhood of a place near a segment.
#[derive(Clone, Debug)]
pub struct Around {
    /// What lies near the place, in the directions of the whole drawing. The place is the origin of the model.
    pub drawing: Arc<Drawing>,
    /// The origin, in units of the whole drawing's root block: x, y, and their rounding remainders.
    pub start: [f64; 4],
    /// The place itself, in units of the whole drawing's root block.
    pub origin: [f64; 2],
    /// By item of the root block: the number of its first segment in the whole drawing.
    pub firsts: Vec<Fixed>,
    /// Indices of items of the root block: strokes that are cut off far away, descending.
    cut: Vec<usize>,
}

impl Around {
    /// The number in the whole drawing of a segment of the neighbourhood (both 0-based); `None` after the last.
    #[must_use]
    pub fn number_of(&self, segment: u128) -> Option<Fixed> {
        let items = self.drawing.items_of(self.drawing.root?);
        let (at, within) = self.drawing.before(items, segment);
        Some(self.firsts.get(at)?.plus(&Fixed::units(within)))
    }

    /// How many segments of the neighbourhood are among the first `upto` of the whole drawing: they come first here, too.
    #[must_use]
    pub fn among_first(&self, upto: u128) -> u128 {
        let (mut all, end) = (0_u128, Fixed::units(upto));
        let items = self.drawing.root.map_or(&[][..], |root| self.drawing.items_of(root));
        for (item, first) in items.iter().zip(&self.firsts) {
            let count = self.drawing.segments_in(item);
            if first.plus(&Fixed::units(count)).compared(&end).is_gt() {
                let within = end.minus(first).decimal().parse().unwrap_or(0);
                return all.saturating_add(if first.compared(&end).is_lt() { within } else { 0 });
            }
            all = all.saturating_add(count);
        }
        all
    }

    /// The number here of a segment of the whole drawing (both 0-based); `None` if it is not here.
    #[must_use]
    pub fn local(&self, number: u128) -> Option<u128> {
        let before = self.among_first(number);
        Some(before).filter(|_| self.among_first(number.saturating_add(1)) > before)
    }

    /// A place in the whole drawing, from a segment of the neighbourhood (0-based) and the part of it before the place;
    /// `None` after the last segment, and on a segment that is cut off.
    #[must_use]
    pub fn origin_on(&self, segment: &Fixed, along: f64) -> Option<Origin> {
        let counts = self.drawing.counts();
        let mut left = segment.clone();
        for (at, item) in self.drawing.items_of(self.drawing.root?).iter().enumerate() {
            let count = count_of(&counts, item);
            if left.compared(&count).is_lt() {
                let origin = Origin { segment: self.firsts[at].plus(&left), along };
                return Some(origin).filter(|_| !self.cut.contains(&at));
            }
            left = left.minus(&count);
        }
        None
    }
}

/// A block is taken whole if its size is at most this times the reach.
const LARGEST: f64 = 64.0;
/// The items that are looked at. Where more overlap, the blocks drawn first are taken whole, however large: their places
/// are rounded, but lie below the others.
const MOST_VISITS: usize = 1 << 15;
/// The most places that are kept while they are computed.
const MOST_SPOTS: usize = 1 << 16;
/// The most places of a drawing that is seen from near: they have a list.
const MOST_LEGS: usize = 1 << 18;
/// Ends of strokes farther away than this times the reach are cut off.
const FAR: f64 = (1_u64 << 20) as f64;
/// The rounding of hulls and places, in units of a block.
const ROUNDING: f64 = 1e-9;

impl Drawing {
    /// The number of segments, exactly.
    #[must_use]
    pub fn exact_count(&self) -> Fixed {
        self.root.map_or_else(Fixed::default, |root| self.counts().swap_remove(root.0 as usize))
    }

    /// What lies within `2^reach` steps of a place, and parts that lie farther away. The place is `offset` from the origin,
    /// in units of the root block. `None` if there is no such segment, if the drawing is not a shared one, or if it has too many parts.
    #[must_use]
    pub fn around(&self, origin: &Origin, offset: [f64; 2], reach: i32) -> Option<Around> {
        if !self.course.kept || self.course.legs.len() > MOST_LEGS {
            return None;
        }
        let counts = self.counts();
        let way = self.way(&counts, &origin.segment)?;
        let mut exact = Exact::new(self, &way, reach);
        let centre = exact.centre(&way, origin.along)?;
        let unit = self.course.exponent - self.blocks[self.root?.0 as usize].exponent;
        let places = exact.places[0];
        let [x, y] = centre.numbers(places, unit);
        let rest = centre.minus(&FixedPoint([x, y].map(|c| fixed(c, places, -unit))));
        let [fine_x, fine_y] = rest.numbers(places, unit);
        let mut finder = Finder::new(self, exact, &counts, reach);
        let middle = centre.plus(&FixedPoint(offset.map(|c| fixed(c, places, -unit))));
        let place = middle.numbers(places, unit);
        finder.find(middle)?;
        finder.finish([x, y, fine_x, fine_y], place)
    }

    /// The numbers of segments of all blocks, exactly.
    #[must_use]
    pub fn counts(&self) -> Vec<Fixed> {
        let mut counts: Vec<Fixed> = Vec::with_capacity(self.blocks.len());
        for block in &self.blocks {
            let all =
                self.contents(block).iter().fold(Fixed::default(), |sum, item| sum.plus(&count_of(&counts, item)));
            counts.push(all);
        }
        counts
    }

    /// The blocks around a segment, from the root on, with the index of the item that leads to the segment.
    fn way(&self, counts: &[Fixed], segment: &Fixed) -> Option<Vec<(BlockId, usize)>> {
        let (mut block, mut left) = (self.root?, segment.clone());
        let mut way = vec![];
        loop {
            let items = self.items_of(block);
            let at = items.iter().position(|item| {
                let count = count_of(counts, item);
                let inside = left.compared(&count).is_lt();
                if !inside {
                    left = left.minus(&count);
                }
                inside
            })?;
            way.push((block, at));
            match &items[at] {
                Item::Block(placed) => block = placed.block,
                _ => return Some(way),
            }
        }
    }
}

/// A number times `2^exponent`.
fn fixed(number: f64, places: usize, exponent: i32) -> Fixed {
    let (fraction, own) = libm::frexp(number);
    Fixed::of(fraction, places).shifted(own + exponent)
}

/// The number of segments in an item, from those of all blocks.
#[must_use]
pub fn count_of(counts: &[Fixed], item: &Item) -> Fixed {
    match item {
        Item::Stroke(_) => Fixed::units(1),
        Item::Polygon(_) => Fixed::default(),
        Item::Block(placed) => counts[placed.block.0 as usize].clone(),
    }
}

/// Computes exact places. Their unit is that of the drawing's course.
struct Exact<'a> {
    drawing: &'a Drawing,
    /// The binary places of points and of directions, in 32 bits.
    places: [usize; 2],
    circle: Circle,
    /// The directions so far.
    directions: Vec<(Heading, FixedPoint)>,
    /// By place, the places so far, and their number.
    spots: Vec<Option<FixedPoint>>,
    known: usize,
}

impl<'a> Exact<'a> {
    fn new(drawing: &'a Drawing, way: &[(BlockId, usize)], reach: i32) -> Self {
        // A block's own unit may be larger than the root's.
        let (mut scale, mut largest) = (1.0, 1.0_f64);
        for &(block, at) in way {
            if let Item::Block(placed) = &drawing.items_of(block)[at] {
                scale *= drawing.own_scale(block, placed);
                largest = largest.max(scale);
            }
        }
        let unit = drawing.course.exponent;
        let size = drawing.blocks.iter().map(|block| block.exponent - unit).max().unwrap_or(0).max(0);
        // A guard of 96 bits below the reach, for the rounding of all sums.
        let bits = (96 + unit - reach + libm::frexp(largest).1).max(96);
        let places = [bits, bits + size + 64].map(|bits| bits.unsigned_abs().div_ceil(32) as usize);
        Self {
            drawing,
            places,
            circle: Circle::new(places[1]),
            directions: vec![],
            spots: vec![None; drawing.course.legs.len() + 1],
            known: 0,
        }
    }

    /// The cosine and the sine of a heading.
    fn direction(&mut self, heading: Heading) -> FixedPoint {
        if let Some((_, direction)) = self.directions.iter().find(|(known, _)| *known == heading) {
            return direction.clone();
        }
        let direction = self.circle.at(heading.units(), Heading::TURN);
        self.directions.push((heading, direction.clone()));
        direction
    }

    /// The vector turned by a heading.
    #[inline(never)]
    fn turned(&mut self, vector: &FixedPoint, heading: Heading) -> FixedPoint {
        if heading == Heading::EAST {
            return vector.clone();
        }
        vector.turned(&self.direction(heading), self.places[1])
    }

    /// A place in the frame of its piece; `None` if it takes too many others.
    fn spot(&mut self, spot: Spot) -> Option<FixedPoint> {
        let (mut asked, mut needed) = (vec![spot.0], vec![]);
        while let Some(number) = asked.pop() {
            // A place that is asked for twice is computed once: the first time makes it known as the origin.
            if number == 0 || self.spots[number as usize].is_some() {
                continue;
            }
            self.spots[number as usize] = Some(FixedPoint::default());
            needed.push(number);
            self.known += 1;
            if self.known > MOST_SPOTS {
                return None;
            }
            let leg = &self.drawing.course.legs[number as usize - 1];
            asked.push(leg.from.0);
            if let By::Piece(Spot(end)) = leg.by {
                asked.push(end);
            }
        }
        // A leg comes after those that it builds on.
        sort(&mut needed);
        let [places, fine] = self.places;
        for number in needed {
            let leg = self.drawing.course.legs[number as usize - 1];
            let by = match leg.by {
                By::Piece(end) => {
                    let end = self.known(end);
                    self.turned(&end, leg.heading)
                }
                By::Ahead => self.direction(leg.heading).shifted(32 * (places as i32 - fine as i32)),
                By::Corner(corner) => {
                    let corner = FixedPoint(corner.map(|c| Fixed::of(c, places)));
                    self.turned(&corner, leg.heading)
                }
            };
            self.spots[number as usize] = Some(self.known(leg.from).plus(&by.scaled(leg.factor)));
        }
        Some(self.known(spot))
    }

    /// A place that is computed already.
    fn known(&self, spot: Spot) -> FixedPoint {
        self.spots[spot.0 as usize].clone().unwrap_or_default()
    }

    /// A place in the frame of a block.
    #[inline(never)]
    fn within(&mut self, block: BlockId, spot: Spot) -> Option<FixedPoint> {
        let origin = self.spot(self.drawing.blocks[block.0 as usize].origin)?;
        Some(self.spot(spot)?.minus(&origin))
    }

    /// The place on the segment to which a way leads, in the root's frame.
    fn centre(&mut self, way: &[(BlockId, usize)], along: f64) -> Option<FixedPoint> {
        let mut centre = FixedPoint::default();
        for &(block, at) in way.iter().rev() {
            centre = match &self.drawing.items_of(block)[at] {
                Item::Stroke(stroke) => {
                    let start = self.within(block, self.drawing.course.start(stroke.spot))?;
                    let whole = self.within(block, stroke.spot)?.minus(&start);
                    start.plus(&whole.scaled(along))
                }
                Item::Polygon(_) => return None,
                Item::Block(placed) => {
                    let at = self.within(block, placed.spot?)?;
                    at.plus(&self.turned(&centre, placed.heading).scaled(self.drawing.own_scale(block, placed)))
                }
            };
        }
        Some(centre)
    }
}

impl Drawing {
    /// The factor from the own unit of a placed block to that of its container.
    fn own_scale(&self, block: BlockId, placed: &Placed) -> f64 {
        let exponent = |id: BlockId| self.blocks[id.0 as usize].exponent;
        libm::scalbn(placed.scale, exponent(block) - exponent(placed.block))
    }
}

/// A block that is looked into.
struct Open {
    block: BlockId,
    /// The items from this one on are done.
    next: usize,
    /// The centre in the block's frame.
    centre: FixedPoint,
    /// The block's rotation in the whole drawing.
    turn: Heading,
    /// The block's own unit in that of the root.
    scale: f64,
    style: StyleChange,
    /// The number of segments in the whole drawing before the items that are done.
    first: Fixed,
}

/// The search for the items of the neighbourhood.
struct Finder<'a> {
    drawing: &'a Drawing,
    exact: Exact<'a>,
    counts: &'a [Fixed],
    /// The exponent of the reach, in steps.
    reach: i32,
    directions: Directions,
    styles: Styles,
    vertices: Vec<[f64; 2]>,
    items: Vec<Item>,
    firsts: Vec<Fixed>,
    /// The strokes among the items that are cut off.
    cut: Vec<usize>,
    visits: usize,
    seen: HashSet<(BlockId, Heading, StyleId, u64, FixedPoint)>,
}

impl<'a> Finder<'a> {
    fn new(drawing: &'a Drawing, exact: Exact<'a>, counts: &'a [Fixed], reach: i32) -> Self {
        let mut styles = Styles::new();
        for style in &drawing.styles {
            styles.id(style);
        }
        Self {
            drawing,
            exact,
            counts,
            reach,
            directions: Directions::default(),
            styles,
            vertices: drawing.vertices.clone(),
            items: vec![],
            firsts: vec![],
            cut: vec![],
            visits: 0,
            seen: HashSet::new(),
        }
    }

    /// Finds all items around the centre, which is given in the root's frame.
    fn find(&mut self, centre: FixedPoint) -> Option<()> {
        let drawing = self.drawing;
        let mut open = vec![Open {
            block: drawing.root?,
            next: drawing.items_of(drawing.root?).len(),
            centre,
            turn: Heading::EAST,
            scale: 1.0,
            style: StyleChange::start(drawing.width),
            first: self.counts[drawing.root?.0 as usize].clone(),
        }];
        // The last drawn first: what is drawn again at its place is covered, so that all of it can be left out.
        while let Some(node) = open.last_mut() {
            let Some(next) = node.next.checked_sub(1) else {
                open.pop();
                continue;
            };
            node.next = next;
            self.visits += 1;
            let item = &drawing.items_of(node.block)[next];
            let first = node.first.minus(&count_of(self.counts, item));
            node.first = first.clone();
            if !self.is_near(node, item) {
                continue;
            }
            let style = match item {
                Item::Stroke(stroke) => stroke.style,
                Item::Polygon(polygon) => polygon.style,
                Item::Block(placed) => placed.style,
            };
            let style = node.style.then(&drawing.styles[style.0 as usize]);
            let found = match item {
                Item::Stroke(stroke) => self.stroke(node, stroke, &style)?,
                Item::Polygon(polygon) => Some(self.polygon(node, polygon, &style)?),
                Item::Block(placed) => {
                    let inner = self.inner(node, placed, style, &first)?;
                    if !self.is_new(&inner) {
                        continue;
                    }
                    if !self.is_whole(&inner) {
                        open.push(inner);
                        continue;
                    }
                    Some(self.placed(&inner))
                }
            };
            if let Some(found) = found {
                self.items.push(found);
                self.firsts.push(first);
            }
        }
        self.items.reverse();
        self.firsts.reverse();
        let last = self.items.len().saturating_sub(1);
        self.cut.iter_mut().for_each(|at| *at = last - *at);
        Some(())
    }

    /// Notes a block. Returns whether no equal block is at the same place, up to `2^-24` of the reach.
    fn is_new(&mut self, node: &Open) -> bool {
        let unit = self.drawing.course.exponent - self.reach + 24;
        let bits = unit + libm::frexp(node.scale).1 - 32 * self.exact.places[0] as i32;
        let place = node.centre.shifted(bits);
        self.seen.insert((node.block, node.turn, self.styles.id(&node.style), node.scale.to_bits(), place))
    }

    /// The reach in the units of a block, by its exponent and by the scale of its own unit.
    fn reach_in(&self, block: &Block, scale: f64) -> f64 {
        libm::scalbn(1.0 / scale, self.reach - block.exponent)
    }

    /// Whether a block is small enough to be taken as it is.
    fn is_whole(&self, Open { block, scale, .. }: &Open) -> bool {
        let block = &self.drawing.blocks[block.0 as usize];
        self.visits > MOST_VISITS || self.reach_in(block, *scale) * LARGEST >= 1.0
    }

    /// Whether an item may come into reach.
    #[inline(never)]
    fn is_near(&mut self, node: &Open, item: &Item) -> bool {
        let drawing = self.drawing;
        let block = &drawing.blocks[node.block.0 as usize];
        let exponent = block.exponent - drawing.course.exponent;
        let centre = node.centre.numbers(self.exact.places[0], -exponent);
        let reach = self.reach_in(block, node.scale);
        let style = |id: StyleId| node.style.then(&drawing.styles[id.0 as usize]);
        // Half a width, from steps to units of the block.
        let half = |width: f64| libm::scalbn(width / node.scale, -block.exponent) / 2.0;
        let (points, wide): (&[[f64; 2]], f64) = match item {
            Item::Stroke(stroke) => {
                let widths = style(stroke.style).widths().ends();
                (&[stroke.from, stroke.to], half(widths[0].max(widths[1])))
            }
            Item::Polygon(polygon) => (drawing.vertices_of(polygon), 0.0),
            Item::Block(placed) => {
                let inner = &drawing.blocks[placed.block.0 as usize];
                let widest = style(placed.style).width.then(inner.widest).of(0.0);
                // Beside very broad strokes, nearly everything would be near.
                (drawing.corners_of(inner), half(widest).min(LARGEST * reach))
            }
        };
        let (centre, scale) = match item {
            Item::Block(placed) => {
                let (c, s) = self.directions.cos_sin(placed.heading);
                let [x, y] = [0, 1].map(|axis| (centre[axis] - placed.at[axis]) / placed.scale);
                ([c * x + s * y, c * y - s * x], placed.scale)
            }
            _ => (centre, 1.0),
        };
        let within = (reach + wide + ROUNDING) / scale + ROUNDING;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        (0..2).all(|axis| centre[axis] >= low[axis] - within && centre[axis] <= high[axis] + within)
    }

    /// The node of a block inside another.
    #[inline(never)]
    fn inner(&mut self, node: &Open, placed: &Placed, style: StyleChange, first: &Fixed) -> Option<Open> {
        let at = self.exact.within(node.block, placed.spot?)?;
        let own = self.drawing.own_scale(node.block, placed);
        let turned = self.exact.turned(&node.centre.minus(&at), -placed.heading);
        Some(Open {
            block: placed.block,
            next: self.drawing.items_of(placed.block).len(),
            centre: turned.over(own),
            turn: node.turn + placed.heading,
            scale: node.scale * own,
            style,
            first: first.plus(&self.counts[placed.block.0 as usize]),
        })
    }

    /// A vector in the frame of a node, in the directions of the whole drawing and in units of the reach, before the scale.
    #[inline(never)]
    fn shown(&mut self, [x, y]: [f64; 2], turn: Heading, scale: f64) -> [f64; 2] {
        let (c, s) = self.directions.cos_sin(turn);
        [scale * (c * x - s * y), scale * (s * x + c * y)]
    }

    /// The exponent from units of the course to those of the reach.
    fn unit(&self) -> i32 {
        self.drawing.course.exponent - self.reach
    }

    /// A block as an item of the neighbourhood.
    fn placed(&mut self, node: &Open) -> Item {
        let away = node.centre.numbers(self.exact.places[0], self.unit()).map(|c| -c);
        let exponent = self.drawing.blocks[node.block.0 as usize].exponent;
        Item::Block(Placed {
            block: node.block,
            style: self.styles.id(&node.style),
            spot: None,
            at: self.shown(away, node.turn, node.scale),
            heading: node.turn,
            scale: libm::scalbn(node.scale, exponent - self.reach),
        })
    }

    /// A stroke as an item of the neighbourhood; `None` inside if it stays out of reach.
    fn stroke(&mut self, node: &Open, stroke: &Stroke, style: &StyleChange) -> Option<Option<Item>> {
        // The outlines of shapes are no part of the turtle's way.
        if stroke.spot == Spot::ENTRY {
            return Some(None);
        }
        let drawing = self.drawing;
        let (places, unit) = (self.exact.places[0], self.unit());
        let ends = [drawing.course.start(stroke.spot), stroke.spot]
            .map(|spot| Some(self.exact.within(node.block, spot)?.minus(&node.centre)));
        let [Some(start), Some(end)] = ends else { return None };
        let ends = [start, end];
        let far = |end: &[f64; 2]| end[0].abs().max(end[1].abs()) > FAR;
        let mut turn = node.turn;
        let mut near = ends.each_ref().map(|end| end.numbers(places, unit));
        let leg = drawing.course.legs[stroke.spot.0 as usize - 1];
        let [mut from, mut to] = near.map(|end| self.shown(end, turn, node.scale));
        if matches!(leg.by, By::Ahead) && (far(&from) || far(&to)) {
            // Along the stroke itself, the distance from its line is exact.
            near = ends.map(|end| self.exact.turned(&end, -leg.heading).numbers(places, unit));
            turn = node.turn + leg.heading;
            let most = FAR / node.scale;
            near.iter_mut().for_each(|end| end[0] = end[0].clamp(-most, most));
            // A stroke that only rounding has brought near would make the neighbourhood as large as it is far.
            let widths = style.widths().ends();
            let wide = libm::scalbn(widths[0].max(widths[1]) / node.scale, -self.reach);
            if near[0][0] == near[1][0] && wide < most || near[0][1].abs() > most + wide {
                return Some(None);
            }
            self.cut.push(self.items.len());
            [from, to] = near.map(|end| self.shown(end, turn, node.scale));
        }
        let style = self.styles.id(style);
        Some(Some(Item::Stroke(Stroke { from, to, style, spot: Spot::ENTRY })))
    }

    /// A polygon as an item of the neighbourhood.
    fn polygon(&mut self, node: &Open, polygon: &Polygon, style: &StyleChange) -> Option<Item> {
        let first = self.vertices.len() as u32;
        for number in polygon.range() {
            let spot = self.drawing.course.vertices.get(number).copied()?;
            let at =
                self.exact.within(node.block, spot)?.minus(&node.centre).numbers(self.exact.places[0], self.unit());
            let vertex = self.shown(at, node.turn, node.scale);
            self.vertices.push(vertex);
        }
        Some(Item::Polygon(Polygon { first, style: self.styles.id(style), ..*polygon }))
    }

    /// The drawing of the items found.
    fn finish(self, start: [f64; 4], origin: [f64; 2]) -> Option<Around> {
        let Self { drawing, styles, vertices, items, firsts, cut, reach, .. } = self;
        let mut builder = Builder::new();
        builder.blocks.clone_from(&drawing.blocks);
        builder.items = drawing.items.clone();
        builder.corners.clone_from(&drawing.corners);
        (builder.styles, builder.vertices) = (styles, vertices);
        let root = builder.new_block(&items, reach, Spot::ENTRY)?;
        Some(Around {
            drawing: Arc::new(Drawing {
                blocks: builder.blocks,
                items: builder.items,
                corners: builder.corners,
                vertices: builder.vertices,
                styles: builder.styles.list,
                root: Some(root),
                start: [0.0; 2],
                step: drawing.step,
                width: drawing.width,
                pieces: Pieces::None,
                course: Course::new(),
                memoised: true,
                places: vec![],
                depths: vec![],
                wires: 0,
                symbols: None,
                scene: SceneSize::default(),
                extent: OnceLock::new(),
            }),
            start,
            origin,
            firsts,
            cut,
        })
    }
}
