//! The places of segments in the fitted view, as exact as the deepest view can show.

use super::view::root_bounds;
use super::wide::Wide;
use core::ops::Range;
use lsystem_drawing::Directions;
use lsystem_drawing::exponent_of;
use lsystem_drawing::hull;
use lsystem_drawing::times;
use lsystem_drawing::{Block, BlockId, Drawing, Geometry, Item, Placed, Plane};
use lsystem_syntax::Heading;

/// A place in the fitted view: `[x, y, fine_x, fine_y]`. The place is `x + fine_x` right of the centre and `y + fine_y`
/// above it, in fitted extents (the longer side of [`fit`](crate::fit)). The fine part is below the precision of `x`
/// and `y`, as in [`View::fine`](crate::View::fine).
pub(crate) type Fitted = [f64; 4];

/// The start and the end of the segment `number` (0-based); `None` after the last segment. The time grows with the
/// depth to which blocks are nested.
#[must_use]
pub(crate) fn fitted_ends(drawing: &Drawing, number: u128) -> Option<[Fitted; 2]> {
    let frame = FittedFrame::new(drawing);
    let ends = Locator::new(drawing, number..number).ends(number)?;
    Some(ends.map(|end| frame.fit(end)))
}

/// The corners, counter-clockwise, of a convex polygon around the axes of the segments with these numbers (0-based, in
/// drawing order): one or two corners if the segments point on a point or a line, none without segments. The polygon is
/// the convex hull, unless that has very many corners. Blocks are taken whole, so the time grows with the depth to
/// which blocks are nested, not with the number of segments.
#[must_use]
pub(crate) fn fitted_outline(drawing: &Drawing, segments: Range<u128>) -> Vec<Fitted> {
    let mut locator = Locator::new(drawing, segments.clone());
    let (Some(root), Some([base, _])) = (drawing.root, locator.ends(segments.start)) else { return vec![] };
    locator.base = base;
    locator.block(root, &WidePlace::ROOT, 0);
    let mut corners = locator.corners;
    reduce_to_hull(&mut corners);
    let frame = FittedFrame::new(drawing);
    corners.into_iter().map(|[x, y]| frame.fit([base[0].plus(x), base[1].plus(y)])).collect()
}

/// The vertices of the polygon `number` (0-based, in the order in which polygons are opened). Each vertex is joined to
/// the next and the last to the first. Empty after the last polygon.
#[must_use]
pub(crate) fn fitted_polygon(drawing: &Drawing, number: u128) -> Vec<Fitted> {
    let mut locator = Locator::new(drawing, 0..0);
    let Some((Item::Polygon(polygon), place)) = locator.find(number, Drawing::polygons_in) else { return vec![] };
    let frame = FittedFrame::new(drawing);
    drawing.vertices_of(polygon).iter().map(|&vertex| frame.fit(place.point(&mut locator.directions, vertex))).collect()
}

/// The corners that are collected before they are reduced to their hull, to bound the memory.
const MAX_CORNERS: usize = 4096;

/// Reduces points to the corners of their hull. The points are scaled first, so that points near to each other keep
/// their hull.
fn reduce_to_hull(points: &mut Vec<[f64; 2]>) {
    let reach = points.iter().flatten().fold(0.0_f64, |reach, c| reach.max(c.abs()));
    let unit = libm::scalbn(1.0, -exponent_of(reach));
    points.iter_mut().for_each(|point| *point = times(*point, unit));
    hull(points);
    points.iter_mut().for_each(|point| *point = times(*point, 1.0 / unit));
}

/// The fitted view in units of the root block.
pub(super) struct FittedFrame {
    centre: [f64; 2],
    side: f64,
}

impl FittedFrame {
    pub(super) fn new(drawing: &Drawing) -> Self {
        let (_, rect) = root_bounds(drawing);
        Self { centre: rect.centre(), side: rect.longer_side() }
    }

    pub(super) fn fit(&self, at: [Wide; 2]) -> Fitted {
        let [x, y] = [0, 1].map(|axis| at[axis].plus(-self.centre[axis]).over(self.side).parts());
        [x[0], y[0], x[1], y[1]]
    }
}

/// The place of a block in the root block's frame.
#[derive(Clone, Copy)]
struct WidePlace {
    at: [Wide; 2],
    heading: Heading,
    scale: f64,
}

impl WidePlace {
    const ROOT: Self = Self { at: [Wide::ZERO; 2], heading: Heading::EAST, scale: 1.0 };

    fn point(&self, directions: &mut Directions, [x, y]: [f64; 2]) -> [Wide; 2] {
        let (c, s) = Plane::scaled(directions.cos_sin(self.heading), self.scale);
        [self.at[0].plus(c * x - s * y), self.at[1].plus(s * x + c * y)]
    }

    fn inside(&self, directions: &mut Directions, placed: &Placed) -> Self {
        let at = self.point(directions, placed.at);
        Self { at, heading: self.heading + placed.heading, scale: self.scale * placed.scale }
    }
}

/// Finds the places of segments and polygons.
struct Locator<'a> {
    drawing: &'a Drawing,
    segments: Range<u128>,
    directions: Directions,
    /// The place that `corners` are relative to.
    base: [Wide; 2],
    corners: Vec<[f64; 2]>,
}

impl<'a> Locator<'a> {
    fn new(drawing: &'a Drawing, segments: Range<u128>) -> Self {
        Self { drawing, segments, directions: Directions::default(), base: [Wide::ZERO; 2], corners: vec![] }
    }

    /// The ends of a segment.
    fn ends(&mut self, number: u128) -> Option<[[Wide; 2]; 2]> {
        let (Item::Stroke(stroke), place) = self.find(number, Drawing::segments_in)? else { return None };
        Some([stroke.from, stroke.to].map(|p| place.point(&mut self.directions, p)))
    }

    /// The item that has the `number` (0-based) among all that `count` counts, and the place of its block.
    fn find(&mut self, number: u128, count: fn(&Drawing, &Item) -> u128) -> Option<(&'a Item, WidePlace)> {
        let (mut block, mut place, mut number) = (self.drawing.root?, WidePlace::ROOT, number);
        loop {
            let items = self.drawing.items_of(block);
            let (before, within) = self.drawing.before_by(items, number, count);
            match items.get(before)? {
                Item::Block(placed) => {
                    place = place.inside(&mut self.directions, placed);
                    (block, number) = (placed.block, within);
                }
                item => return Some((item, place)),
            }
        }
    }

    fn add_corner(&mut self, place: &WidePlace, point: [f64; 2]) {
        let at = place.point(&mut self.directions, point);
        self.corners.push([0, 1].map(|axis| at[axis].minus(self.base[axis])));
    }

    /// Collects the corners of a block, as far as its segments are wanted; `first` is the number of its first segment.
    /// The recursion is as deep as blocks are nested: at most some thousand.
    fn block(&mut self, id: BlockId, place: &WidePlace, first: u128) {
        let drawing = self.drawing;
        let Block { hull: corners, segments, .. } = &drawing.blocks[id.0 as usize];
        if self.segments.start <= first && first.saturating_add(*segments) <= self.segments.end {
            for &corner in &drawing.corners[corners.start as usize..corners.end as usize] {
                self.add_corner(place, corner);
            }
            if self.corners.len() > MAX_CORNERS {
                reduce_to_hull(&mut self.corners);
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
                        self.add_corner(place, stroke.from);
                        self.add_corner(place, stroke.to);
                    }
                    Item::Polygon(_) => {}
                    Item::Block(placed) => {
                        let inside = place.inside(&mut self.directions, placed);
                        self.block(placed.block, &inside, next);
                    }
                }
            }
            next = after;
        }
    }
}
