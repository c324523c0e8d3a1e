//! Where segments lie in the fitted view, as exactly as the deepest view can show.

use super::view::root_bounds;
use super::wide::Wide;
use core::ops::Range;
use lsystem_drawing::Directions;
use lsystem_drawing::exponent_of;
use lsystem_drawing::hull;
use lsystem_drawing::times;
use lsystem_drawing::{Block, BlockId, Drawing, Geometry, Item, Placed, Plane};
use lsystem_syntax::Heading;

/// A place relative to the fitted view: right of and above its centre, in fitted extents (the longer side of
/// [`fit`](crate::fit)), then what is to be added to the two, the part below their precision, as in
/// [`View::fine`](crate::View::fine).
pub type Fitted = [f64; 4];

/// Where the segment `number` (0-based) starts and ends; `None` beyond the last. Takes as long as blocks are nested deep.
#[must_use]
pub fn fitted_ends(drawing: &Drawing, number: u128) -> Option<[Fitted; 2]> {
    let frame = FittedFrame::new(drawing);
    let ends = Search::new(drawing, number..number).ends(number)?;
    Some(ends.map(|end| frame.see(end)))
}

/// The corners, counter-clockwise, of a convex polygon around the axes of the segments with these numbers (0-based, in
/// drawing order); one or two where they lie on a point or a line, none where there are no such segments. It is the
/// smallest one, unless that has very many corners. Blocks are taken whole, so it takes as long as they are nested deep,
/// however many segments there are.
#[must_use]
pub fn fitted_outline(drawing: &Drawing, segments: Range<u128>) -> Vec<Fitted> {
    let mut search = Search::new(drawing, segments.clone());
    let (Some(root), Some([base, _])) = (drawing.root, search.ends(segments.start)) else { return vec![] };
    search.base = base;
    search.block(root, &Spot::ROOT, 0);
    let mut corners = search.corners;
    wrap(&mut corners);
    let frame = FittedFrame::new(drawing);
    corners.into_iter().map(|[x, y]| frame.see([base[0].plus(x), base[1].plus(y)])).collect()
}

/// The vertices of the polygon `number` (0-based, in the order in which they are opened), each joined to the next and the
/// last to the first; none beyond the last polygon.
#[must_use]
pub fn fitted_polygon(drawing: &Drawing, number: u128) -> Vec<Fitted> {
    let mut search = Search::new(drawing, 0..0);
    let Some((Item::Polygon(polygon), spot)) = search.find(number, Drawing::polygons_in) else { return vec![] };
    let frame = FittedFrame::new(drawing);
    drawing.vertices_of(polygon).iter().map(|&vertex| frame.see(spot.lie(&mut search.directions, vertex))).collect()
}

/// Corners that are collected before they are joined to a hull.
const MANY: usize = 4096;

/// Leaves the corners of the hull of some points, however near to each other they are.
fn wrap(points: &mut Vec<[f64; 2]>) {
    let reach = points.iter().flatten().fold(0.0_f64, |reach, c| reach.max(c.abs()));
    let unit = libm::scalbn(1.0, -exponent_of(reach));
    points.iter_mut().for_each(|point| *point = times(*point, unit));
    hull(points);
    points.iter_mut().for_each(|point| *point = times(*point, 1.0 / unit));
}

/// The root block's frame beside the fitted view.
struct FittedFrame {
    centre: [f64; 2],
    side: f64,
}

impl FittedFrame {
    fn new(drawing: &Drawing) -> Self {
        let (_, rect) = root_bounds(drawing);
        Self { centre: rect.centre(), side: rect.longer_side() }
    }

    fn see(&self, at: [Wide; 2]) -> Fitted {
        let [x, y] = [0, 1].map(|axis| at[axis].plus(-self.centre[axis]).over(self.side).parts());
        [x[0], y[0], x[1], y[1]]
    }
}

/// Where a block lies in the root block's frame.
#[derive(Clone, Copy)]
struct Spot {
    at: [Wide; 2],
    heading: Heading,
    scale: f64,
}

impl Spot {
    const ROOT: Self = Self { at: [Wide::ZERO; 2], heading: Heading::EAST, scale: 1.0 };

    fn lie(&self, directions: &mut Directions, [x, y]: [f64; 2]) -> [Wide; 2] {
        let (c, s) = Plane::scaled(directions.cos_sin(self.heading), self.scale);
        [self.at[0].plus(c * x - s * y), self.at[1].plus(s * x + c * y)]
    }

    fn inside(&self, directions: &mut Directions, placed: &Placed) -> Self {
        let at = self.lie(directions, placed.at);
        Self { at, heading: self.heading + placed.heading, scale: self.scale * placed.scale }
    }
}

struct Search<'a> {
    drawing: &'a Drawing,
    segments: Range<u128>,
    directions: Directions,
    /// What corners are relative to.
    base: [Wide; 2],
    corners: Vec<[f64; 2]>,
}

impl<'a> Search<'a> {
    fn new(drawing: &'a Drawing, segments: Range<u128>) -> Self {
        Self { drawing, segments, directions: Directions::default(), base: [Wide::ZERO; 2], corners: vec![] }
    }

    /// The ends of a segment.
    fn ends(&mut self, number: u128) -> Option<[[Wide; 2]; 2]> {
        let (Item::Stroke(stroke), spot) = self.find(number, Drawing::segments_in)? else { return None };
        Some([stroke.from, stroke.to].map(|p| spot.lie(&mut self.directions, p)))
    }

    /// What is counted as `number`, and the place of the block that it is in.
    fn find(&mut self, number: u128, count: fn(&Drawing, &Item) -> u128) -> Option<(&'a Item, Spot)> {
        let (mut block, mut spot, mut number) = (self.drawing.root?, Spot::ROOT, number);
        loop {
            let items = self.drawing.items_of(block);
            let (before, within) = self.drawing.before_by(items, number, count);
            match items.get(before)? {
                Item::Block(placed) => {
                    spot = spot.inside(&mut self.directions, placed);
                    (block, number) = (placed.block, within);
                }
                item => return Some((item, spot)),
            }
        }
    }

    fn hold(&mut self, spot: &Spot, point: [f64; 2]) {
        let at = spot.lie(&mut self.directions, point);
        self.corners.push([0, 1].map(|axis| at[axis].minus(self.base[axis])));
    }

    /// Takes what is wanted of a block, whose first segment has the number `first`. Recursion is as deep as blocks are
    /// nested, at most some thousand.
    fn block(&mut self, id: BlockId, spot: &Spot, first: u128) {
        let drawing = self.drawing;
        let Block { hull: corners, segments, .. } = &drawing.blocks[id.0 as usize];
        if self.segments.start <= first && first.saturating_add(*segments) <= self.segments.end {
            for &corner in &drawing.corners[corners.start as usize..corners.end as usize] {
                self.hold(spot, corner);
            }
            if self.corners.len() > MANY {
                wrap(&mut self.corners);
            }
            return;
        }
        let mut next = first;
        for item in drawing.items_of(id) {
            if next >= self.segments.end {
                return;
            }
            let after = next.saturating_add(drawing.segments_in(item));
            if after > self.segments.start {
                match item {
                    Item::Stroke(stroke) => {
                        self.hold(spot, stroke.from);
                        self.hold(spot, stroke.to);
                    }
                    Item::Polygon(_) => {}
                    Item::Block(placed) => {
                        let inside = spot.inside(&mut self.directions, placed);
                        self.block(placed.block, &inside, next);
                    }
                }
            }
            next = after;
        }
    }
}
