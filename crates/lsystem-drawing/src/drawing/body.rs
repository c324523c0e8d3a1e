//! Boxes and balls around blocks in space.
//!
//! A body made only from the bodies of inner blocks would be loose, and the slack would add up from block to block. A
//! best-first search through the inner blocks makes the body tight to a tolerance.

use crate::Solid;
use crate::drawing::block::{Block, BlockId, Contents, Enclosed, Item, Placed};
use crate::rotation::{Vector, dot, norm};
use crate::space::unit_of;
use core::cmp::Ordering;
use lsystem_base::Meter;
use std::collections::BinaryHeap;

/// A box along the axes of a block's frame, and a ball about the box's centre. Each contains all that the block draws,
/// up to a rounding error of 1e-11. The ball is tighter for rotated blocks, the box for long ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The least coordinates.
    pub low: [f64; 3],
    /// The greatest coordinates.
    pub high: [f64; 3],
    /// The radius of the ball.
    pub radius: f64,
}

/// The wanted error of a body, relative to its size. A search that reaches its limits is less exact.
const TOLERANCE: f64 = 0.01;
/// A block with a scale below this counts as a point.
const SPECK: f64 = 1e-30;
/// The most blocks opened by a search for one side of a box or for a ball.
const EFFORT: usize = 48;
/// The most units of work of such a search.
const WORK: u64 = 1 << 13;

impl Body {
    /// The centre of the box and the ball.
    #[must_use]
    pub fn centre(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| 0.5 * (self.low[i] + self.high[i]))
    }

    /// Half the lengths of the box's sides.
    #[must_use]
    pub fn half(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| 0.5 * (self.high[i] - self.low[i]))
    }

    /// The body around `items`.
    pub(crate) fn enclose(contents: Contents<'_, Solid>, items: &[Item<Solid>]) -> Enclosed<Solid> {
        let vertices = contents.vertices;
        let mut work = 0;
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let mut hold = |point: &Vector| {
            for i in 0..3 {
                low[i] = low[i].min(point[i]);
                high[i] = high[i].max(point[i]);
            }
        };
        for item in items {
            match item {
                Item::Stroke(stroke) => [stroke.from, stroke.to].iter().for_each(&mut hold),
                Item::Polygon(polygon) => vertices[polygon.range()].iter().for_each(&mut hold),
                Item::Block(_) => {}
            }
        }
        let mut slack = 0.0_f64;
        // Without blocks, the box is complete.
        if items.iter().any(|item| matches!(item, Item::Block(_))) {
            let quantity = DistanceFrom { from: [0.0; 3], scale: 1.0 };
            let (size, _) =
                MaximumSearch::new(contents, items, quantity, f64::INFINITY, (0, 0)).finish(contents, &mut work);
            for i in 0..3 {
                for (side, sign) in [(&mut low[i], -1.0), (&mut high[i], 1.0)] {
                    let mut direction = [0.0; 3];
                    direction[i] = sign;
                    let quantity = CoordinateAlong { base: 0.0, direction, scale: 1.0 };
                    let search = MaximumSearch::new(contents, items, quantity, TOLERANCE * size, (EFFORT, WORK));
                    let (most, gap) = search.finish(contents, &mut work);
                    *side = sign * most;
                    slack = slack.max(gap);
                }
            }
        }
        let reach = low.iter().chain(&high).fold(0.0_f64, |reach, c| reach.max(c.abs()));
        let centre = [0, 1, 2].map(|i| 0.5 * (low[i] + high[i]));
        let quantity = DistanceFrom { from: centre, scale: 1.0 };
        let search = MaximumSearch::new(contents, items, quantity, TOLERANCE * reach, (EFFORT, WORK));
        let (radius, gap) = search.finish(contents, &mut work);
        // The ball around the box is large enough.
        let radius = radius.min(norm(Self { low, high, radius }.half()));
        let shift = unit_of(reach);
        let unit = libm::scalbn(1.0, -shift);
        let hull = Self { low: low.map(|c| c * unit), high: high.map(|c| c * unit), radius: radius * unit };
        Enclosed { hull, slack: slack.max(gap) * unit, shift, work }
    }
}

/// A quantity of points, with bounds on its maximum over the contents of a body.
pub(super) trait Quantity: Copy {
    /// The quantity at a point.
    fn of(&self, point: Vector) -> f64;
    /// An upper bound on the maximum over a body's contents.
    fn most(&self, body: &Body) -> f64;
    /// A lower bound on the maximum over a body's contents, if every side of the box is within `slack` of the contents.
    fn least(&self, body: &Body, slack: f64) -> f64;
    /// The quantity for points in the frame of a placed block.
    fn within(&self, placed: &Placed<Solid>) -> Self;
}

/// The coordinate of a point in a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoordinateAlong {
    pub(super) base: f64,
    pub(super) direction: Vector,
    pub(super) scale: f64,
}

impl Quantity for CoordinateAlong {
    fn of(&self, point: Vector) -> f64 {
        self.base + self.scale * dot(self.direction, point)
    }

    fn most(&self, body: &Body) -> f64 {
        let half = body.half();
        let across: f64 = (0..3).map(|i| self.direction[i].abs() * half[i]).sum();
        self.of(body.centre()) + self.scale * across.min(body.radius)
    }

    fn least(&self, body: &Body, slack: f64) -> f64 {
        // The contents touch each side of the box, at worst at the corner with the least value.
        let half = body.half();
        let parts = [0, 1, 2].map(|i| self.direction[i].abs() * half[i]);
        let across: f64 = parts.iter().sum();
        let best = (0..3).map(|i| 2.0 * parts[i] - across - self.direction[i].abs() * slack);
        self.of(body.centre()) + self.scale * best.fold(-across, f64::max)
    }

    fn within(&self, placed: &Placed<Solid>) -> Self {
        Self {
            base: self.of(placed.at),
            direction: placed.heading.undo(self.direction),
            scale: self.scale * placed.scale,
        }
    }
}

/// The distance of a point from `from`.
#[derive(Clone, Copy, Debug)]
pub(super) struct DistanceFrom {
    pub(super) from: Vector,
    pub(super) scale: f64,
}

impl Quantity for DistanceFrom {
    fn of(&self, point: Vector) -> f64 {
        self.scale * norm([0, 1, 2].map(|i| point[i] - self.from[i]))
    }

    fn most(&self, body: &Body) -> f64 {
        let corner = [0, 1, 2].map(|i| (self.from[i] - body.low[i]).max(body.high[i] - self.from[i]));
        (self.scale * norm(corner)).min(self.of(body.centre()) + self.scale * body.radius)
    }

    fn least(&self, body: &Body, slack: f64) -> f64 {
        let side = |i: usize| (self.from[i] - body.low[i]).max(body.high[i] - self.from[i]);
        self.scale * ((0..3).map(side).fold(0.0, f64::max) - slack).max(0.0)
    }

    fn within(&self, placed: &Placed<Solid>) -> Self {
        let from = placed.heading.undo([0, 1, 2].map(|i| (self.from[i] - placed.at[i]) / placed.scale));
        Self { from, scale: self.scale * placed.scale }
    }
}

/// A block that may contain the maximum, ordered by its upper bound.
#[derive(Clone, Debug)]
struct OpenBlock<P> {
    most: f64,
    block: BlockId,
    quantity: P,
}

impl<P> Ord for OpenBlock<P> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.most.total_cmp(&other.most)
    }
}

impl<P> PartialOrd for OpenBlock<P> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<P> PartialEq for OpenBlock<P> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<P> Eq for OpenBlock<P> {}

/// A search for the maximum of a quantity over some items.
#[derive(Clone, Debug)]
pub(super) struct MaximumSearch<P> {
    open: BinaryHeap<OpenBlock<P>>,
    /// A lower bound on the maximum.
    least: f64,
    tolerance: f64,
    /// The blocks that may still be opened, and the units of work that may still be spent.
    effort: (usize, u64),
    /// Units of work not yet charged to a meter.
    work: u64,
}

impl<P: Quantity> MaximumSearch<P> {
    pub(super) fn new(
        contents: Contents<'_, Solid>,
        items: &[Item<Solid>],
        quantity: P,
        tolerance: f64,
        effort: (usize, u64),
    ) -> Self {
        let mut search = Self { open: BinaryHeap::new(), least: f64::NEG_INFINITY, tolerance, effort, work: 0 };
        search.look(contents, items, quantity);
        search
    }

    /// Continues until the meter is spent. Returns at the end an upper bound on the maximum, and the bound's largest
    /// error: at most the tolerance, unless the effort is used up.
    pub(super) fn step(&mut self, contents: Contents<'_, Solid>, meter: &mut Meter) -> Option<(f64, f64)> {
        loop {
            meter.charge(core::mem::take(&mut self.work));
            let is_known = self.open.peek().is_none_or(|top| top.most <= self.least + self.tolerance);
            if is_known || self.effort.0 == 0 || self.effort.1 == 0 {
                let most = self.open.peek().map_or(self.least, |top| top.most.max(self.least));
                return Some((most, most - self.least));
            }
            if meter.is_spent() {
                return None;
            }
            let OpenBlock { block, quantity, .. } = self.open.pop()?;
            self.look(contents, contents.items_of(block), quantity);
            self.effort = (self.effort.0 - 1, self.effort.1.saturating_sub(self.work));
        }
    }

    /// Runs [`MaximumSearch::step`] to the end and adds the units of work to `work`.
    fn finish(mut self, contents: Contents<'_, Solid>, work: &mut u64) -> (f64, f64) {
        let mut meter = Meter::new(u64::MAX);
        let found = self.step(contents, &mut meter).unwrap_or((f64::INFINITY, f64::INFINITY));
        *work += meter.spent();
        found
    }

    /// Raises the lower bound by `items`, and opens the blocks among them that may exceed it.
    fn look(&mut self, contents: Contents<'_, Solid>, items: &[Item<Solid>], quantity: P) {
        let Self { open, least, work, .. } = self;
        // A stroke takes an eighth of a unit.
        *work += 4 + items.len() as u64 / 8;
        for item in items {
            match item {
                Item::Stroke(stroke) => *least = least.max(quantity.of(stroke.from)).max(quantity.of(stroke.to)),
                Item::Polygon(polygon) => {
                    let all = contents.vertices[polygon.range()].iter().map(|&vertex| quantity.of(vertex));
                    *work += u64::from(polygon.count) / 16;
                    *least = all.fold(*least, f64::max);
                }
                Item::Block(placed) if placed.scale < SPECK => *least = least.max(quantity.of(placed.at)),
                Item::Block(placed) => {
                    let Block { hull, slack, .. } = &contents.blocks[placed.block.0 as usize];
                    *work += 1;
                    let quantity = quantity.within(placed);
                    *least = least.max(quantity.least(hull, *slack));
                    let most = quantity.most(hull);
                    if most > *least {
                        open.push(OpenBlock { most, block: placed.block, quantity });
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
