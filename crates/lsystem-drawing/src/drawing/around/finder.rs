//! The search for the items of a neighbourhood.

use super::exact::Exact;
use super::{Around, count_of};
use crate::drawing::block::{Block, BlockId, Item, Placed, Polygon, Stroke};
use crate::drawing::builder::Builder;
use crate::drawing::pieces::Pieces;
use crate::drawing::{Drawing, SceneSize};
use crate::exact_path::{By, ExactPath, Spot};
use crate::plane::Directions;
use crate::style::{StyleChange, StyleId, Styles};
use lsystem_base::fixed::{Fixed, FixedPoint};
use lsystem_syntax::Heading;
use std::collections::HashSet;
use std::sync::{Arc, OnceLock};

/// A block is taken whole if its size is at most this times the reach.
const LARGEST: f64 = 64.0;
/// The items that are looked at. Where more overlap, the blocks drawn first are taken whole, however large: their places
/// are rounded, but lie below the others.
const MAX_VISITS: usize = 1 << 15;
/// Ends of strokes farther away than this times the reach are cut off.
const FAR: f64 = (1_u64 << 20) as f64;
/// The rounding of hulls and places, in units of a block.
const ROUNDING: f64 = 1e-9;

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
pub(super) struct Finder<'a> {
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
    pub(super) fn new(drawing: &'a Drawing, exact: Exact<'a>, counts: &'a [Fixed], reach: i32) -> Self {
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
    pub(super) fn find(&mut self, centre: FixedPoint) -> Option<()> {
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
        let unit = self.drawing.exact_path.exponent - self.reach + 24;
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
        self.visits > MAX_VISITS || self.reach_in(block, *scale) * LARGEST >= 1.0
    }

    /// Whether an item may come into reach.
    #[inline(never)]
    fn is_near(&mut self, node: &Open, item: &Item) -> bool {
        let drawing = self.drawing;
        let block = &drawing.blocks[node.block.0 as usize];
        let exponent = block.exponent - drawing.exact_path.exponent;
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

    /// The exponent from units of the exact path to those of the reach.
    fn unit(&self) -> i32 {
        self.drawing.exact_path.exponent - self.reach
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
        let ends = [drawing.exact_path.start(stroke.spot), stroke.spot]
            .map(|spot| Some(self.exact.within(node.block, spot)?.minus(&node.centre)));
        let [Some(start), Some(end)] = ends else { return None };
        let ends = [start, end];
        let far = |end: &[f64; 2]| end[0].abs().max(end[1].abs()) > FAR;
        let mut turn = node.turn;
        let mut near = ends.each_ref().map(|end| end.numbers(places, unit));
        let leg = drawing.exact_path.legs[stroke.spot.0 as usize - 1];
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
            let spot = self.drawing.exact_path.vertices.get(number).copied()?;
            let at =
                self.exact.within(node.block, spot)?.minus(&node.centre).numbers(self.exact.places[0], self.unit());
            let vertex = self.shown(at, node.turn, node.scale);
            self.vertices.push(vertex);
        }
        Some(Item::Polygon(Polygon { first, style: self.styles.id(style), ..*polygon }))
    }

    /// The drawing of the items found.
    pub(super) fn finish(self, start: [f64; 4], origin: [f64; 2]) -> Option<Around> {
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
                exact_path: ExactPath::new(),
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
