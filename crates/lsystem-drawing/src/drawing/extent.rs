//! The extent of a drawing in the plane, more exact than its hulls, whose corners are limited in number.

use super::hull::hull;
use crate::Plane;
use crate::drawing::block::{BlockId, Contents, Enclosed, HullInput, Item, Placed, Space};
use crate::plane::Directions;
use crate::space::{Geometry, times, unit_of};
use core::ops::Range;
use lsystem_base::Meter;
use lsystem_base::sorted::sort;
use lsystem_syntax::Heading;
use std::collections::HashMap;

impl Space for Plane {
    /// The corners of a convex polygon, counter-clockwise, as a range of [`Drawing::corners`](crate::Drawing::corners);
    /// one corner for a point, two for a line. Rounding may leave the end of a segment's axis out by 1e-11.
    type Hull = Range<u32>;
    /// Min x, min y, max x, max y.
    type Extent = [f64; 4];
    type Survey = PlaneSurvey;

    fn longest([x0, y0, x1, y1]: &[f64; 4]) -> f64 {
        (x1 - x0).max(y1 - y0)
    }

    fn enclose(input: HullInput<'_, Self>, items: &[Item]) -> Enclosed<Self> {
        let HullInput { blocks, corners, vertices, directions, points, .. } = input;
        points.clear();
        let (mut slack, mut work, mut boxed) = (0.0_f64, 0, 0.0_f64);
        for item in items {
            match item {
                Item::Stroke(stroke) => {
                    // Most strokes begin at the end of the previous one.
                    if points.last() != Some(&stroke.from) {
                        points.push(stroke.from);
                    }
                    points.push(stroke.to);
                }
                Item::Polygon(polygon) if polygon.count > LONG => {
                    let [low, high] = around(&vertices[polygon.range()]);
                    points.extend([low, [high[0], low[1]], high, [low[0], high[1]]]);
                    boxed = boxed.max(high[0] - low[0]).max(high[1] - low[1]);
                    work += u64::from(polygon.count) / 8;
                }
                Item::Polygon(polygon) => points.extend(&vertices[polygon.range()]),
                Item::Block(placed) => {
                    let block = &blocks[placed.block.0 as usize];
                    let axes = Self::scaled(directions.cos_sin(placed.heading), placed.scale);
                    let corners = &corners[block.hull.start as usize..block.hull.end as usize];
                    points.extend(corners.iter().map(|&corner| Self::transform(&axes, placed.at, corner)));
                    slack = slack.max(placed.scale * block.slack);
                }
            }
        }
        let reach = points.iter().flatten().fold(0.0_f64, |reach, c| reach.max(c.abs()));
        let shift = unit_of(reach);
        let unit = libm::scalbn(1.0, -shift);
        points.iter_mut().for_each(|point| *point = times(*point, unit));
        let (outside, hulled) = hull(points);
        // The contents touch all sides of the box, so the box exceeds them by at most its longer side.
        let slack = slack.max(boxed) * unit + outside;
        let first = corners.len() as u32;
        corners.extend(&*points);
        Enclosed { hull: first..corners.len() as u32, slack, shift, work: work + hulled }
    }

    fn survey(root: BlockId) -> PlaneSurvey {
        PlaneSurvey::new(root)
    }

    fn advance(survey: &mut PlaneSurvey, contents: Contents<'_, Self>, meter: &mut Meter) -> Option<[f64; 4]> {
        survey.step(contents, meter)
    }
}

/// For a polygon of more vertices than this, a hull includes the polygon's box: its own hull would take too long.
const LONG: u32 = 1 << 14;

/// The least and the greatest coordinates.
fn around(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    points.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
        [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
    })
}

/// The error of the extent, in units of the root block, if the search stays within the limits below.
const TOLERANCE: f64 = 1e-11;
/// The most blocks opened by the search. After that hulls give the reach, which may be too large but never too small.
const BLOCKS: u32 = 50_000;
/// The most units of work for opening blocks.
const EFFORT: u64 = 1 << 22;
/// The directions in which the extent is measured, in degrees.
const SIDES: [f64; 4] = [180.0, 270.0, 0.0, 90.0];

/// A search for the extent of a block in its own units: min x, min y, max x, max y.
#[derive(Clone, Debug)]
pub struct PlaneSurvey {
    root: BlockId,
    directions: Directions,
    /// By block and direction: the reach, and its largest error.
    known: HashMap<(BlockId, Heading), (f64, f64)>,
    /// The blocks that may still be opened.
    blocks: u32,
    /// The units of work that may still be spent.
    effort: u64,
    /// The open blocks, the root first.
    open: Vec<OpenBlock>,
    /// The reach of the root, by direction in the order of [`SIDES`].
    found: Vec<f64>,
}

/// An open block, whose contents are searched for the reach in a direction.
#[derive(Clone, Debug)]
struct OpenBlock {
    block: BlockId,
    direction: Heading,
    tolerance: f64,
    /// The largest reach found so far.
    best: f64,
    /// The placed blocks that may reach farther, the farthest first: the largest possible reach, the reach of the
    /// origin, and the block.
    inner: Vec<(f64, f64, Placed)>,
    /// The index of the next block in `inner`.
    next: usize,
}

/// An integer that decreases as `value` increases, in the order of [`f64::total_cmp`].
pub(super) fn falling(value: f64) -> i64 {
    let bits = value.to_bits().cast_signed();
    // The bits of negative values decrease as the values increase.
    if bits < 0 { bits ^ i64::MIN } else { !bits }
}

impl PlaneSurvey {
    pub fn new(root: BlockId) -> Self {
        Self {
            root,
            directions: Directions::default(),
            known: HashMap::new(),
            blocks: BLOCKS,
            effort: EFFORT,
            open: vec![],
            found: vec![],
        }
    }

    /// Continues until the meter is spent. Returns the extent when all sides are known.
    pub fn step(&mut self, contents: Contents<'_, Plane>, meter: &mut Meter) -> Option<[f64; 4]> {
        while let Some(&side) = SIDES.get(self.found.len()) {
            if meter.is_spent() {
                return None;
            }
            if self.open.is_empty() {
                let direction = Heading::from_degrees(side);
                if let Some(reach) = self.reach(contents, self.root, direction, TOLERANCE, meter) {
                    self.found.push(reach);
                }
            } else if let Some(reach) = self.search_open_block(contents, meter) {
                self.found.push(reach);
            }
        }
        let [x0, y0, x1, y1] = self.found[..] else { return None };
        Some([-x0, -y0, x1, y1])
    }

    /// Searches the block that was opened last. Returns the reach of the root when it is known.
    fn search_open_block(&mut self, contents: Contents<'_, Plane>, meter: &mut Meter) -> Option<f64> {
        meter.charge(1);
        let open = self.open.last_mut()?;
        let farthest = open.inner.get(open.next).filter(|(most, ..)| *most > open.best);
        if let Some(&(_, at, placed)) = farthest {
            open.next += 1;
            // The scale is zero for a block that is too small for `f64`.
            let finer = if placed.scale > 0.0 { open.tolerance / placed.scale } else { f64::INFINITY };
            let direction = open.direction - placed.heading;
            let level = self.open.len() - 1;
            // An unknown reach opens the inner block, which later raises `best` of this one.
            if let Some(reach) = self.reach(contents, placed.block, direction, finer, meter) {
                self.open[level].best = self.open[level].best.max(at + placed.scale * reach);
            }
            return None;
        }
        let OpenBlock { block, direction, tolerance, best, .. } = self.open.pop()?;
        self.known.insert((block, direction), (best, tolerance));
        let Some(outer) = self.open.last_mut() else { return Some(best) };
        if let Some((_, at, placed)) = outer.inner.get(outer.next - 1) {
            outer.best = outer.best.max(at + placed.scale * best);
        }
        None
    }

    /// The reach of a block in a direction, at most `tolerance` too large. If the reach is not known, opens the block
    /// and returns `None`. Beyond the limits of effort, the error may exceed `tolerance`.
    fn reach(
        &mut self,
        contents: Contents<'_, Plane>,
        block: BlockId,
        direction: Heading,
        tolerance: f64,
        meter: &mut Meter,
    ) -> Option<f64> {
        if contents.blocks[block.0 as usize].slack <= tolerance {
            return Some(self.reach_of_hull(contents, block, direction));
        }
        match self.known.get(&(block, direction)) {
            Some(&(reach, exact)) if exact <= tolerance => return Some(reach),
            _ => {}
        }
        if self.blocks == 0 || self.effort == 0 {
            return Some(self.reach_of_hull(contents, block, direction));
        }
        let open = self.enter(contents, block, direction, tolerance, meter);
        self.open.push(open);
        None
    }

    /// Opens a block for the search in a direction.
    fn enter(
        &mut self,
        contents: Contents<'_, Plane>,
        block: BlockId,
        direction: Heading,
        tolerance: f64,
        meter: &mut Meter,
    ) -> OpenBlock {
        let (c, s) = self.directions.cos_sin(direction);
        let along = |[x, y]: [f64; 2]| c * x + s * y;
        let (mut best, mut work) = (f64::NEG_INFINITY, 8);
        // The block with the largest possible reach comes first, so that most other blocks can be skipped.
        let mut inner = Vec::new();
        for item in contents.items_of(block) {
            match item {
                Item::Stroke(stroke) => best = best.max(along(stroke.from)).max(along(stroke.to)),
                Item::Polygon(polygon) => {
                    let vertices = &contents.vertices[polygon.range()];
                    best = vertices.iter().map(|&vertex| along(vertex)).fold(best, f64::max);
                    work += vertices.len() as u64 / 8;
                }
                Item::Block(placed) => {
                    let at = along(placed.at);
                    let reach = self.reach_of_hull(contents, placed.block, direction - placed.heading);
                    inner.push((at + placed.scale * reach, at, *placed));
                    let corners = &contents.blocks[placed.block.0 as usize].hull;
                    work += 4 + u64::from(corners.end - corners.start) / 8;
                }
            }
            work += 1;
        }
        inner.retain(|&(most, ..)| most > best);
        let mut order: Vec<_> = inner.iter().enumerate().map(|(index, (most, ..))| (falling(*most), index)).collect();
        sort(&mut order);
        let inner = order.into_iter().map(|(_, index)| inner[index]).collect();
        self.blocks -= 1;
        self.effort = self.effort.saturating_sub(work);
        meter.charge(work);
        OpenBlock { block, direction, tolerance, best, inner, next: 0 }
    }

    /// The reach of a block's hull in a direction.
    fn reach_of_hull(&mut self, contents: Contents<'_, Plane>, block: BlockId, direction: Heading) -> f64 {
        let (c, s) = self.directions.cos_sin(direction);
        let hull = &contents.blocks[block.0 as usize].hull;
        let corners = &contents.corners[hull.start as usize..hull.end as usize];
        corners.iter().map(|&[x, y]| c * x + s * y).fold(f64::NEG_INFINITY, f64::max)
    }
}
