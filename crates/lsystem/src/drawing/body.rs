//! Boxes and balls around what blocks draw in space.
//!
//! A body is made tight by looking into the blocks that it contains, best first, until it is as exact as wanted; so
//! slack does not add up from block to block, as it would where bodies were made from bodies alone.

use super::girth::{Girth, girth};
use super::{Block, BlockId, Drawing, Enclosed, Item, Placed};
use crate::Solid;
use crate::rotation::{Vector, dot, norm};
use crate::turtle::exponent_of;
use core::cmp::Ordering;
use std::collections::BinaryHeap;

/// A box along the axes of a block's frame, and a ball about the box's centre. What the block draws lies in both
/// (rounding may leave an end out by 1e-11); the ball says more where blocks turn, the box where they are long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The least coordinates.
    pub low: [f64; 3],
    /// The greatest coordinates.
    pub high: [f64; 3],
    /// Of the ball.
    pub radius: f64,
}

/// How exact a block's body is, compared with its size, where that takes few steps.
const TOLERANCE: f64 = 0.01;
/// A block smaller than this beside the one that holds it is a point.
const SPECK: f64 = 1e-30;
/// Blocks looked into at most for one side of a box or for a ball.
const EFFORT: usize = 48;

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

    /// What contains `items`, in their units, and how far it may be too large.
    pub(crate) fn enclose(
        (blocks, all, vertices): (&[Block<Solid>], &[Item<Solid>], &[Vector]),
        items: &[Item<Solid>],
    ) -> Enclosed<Solid> {
        let contents = Contents { blocks, items: all, vertices };
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
        // Where there are no blocks, that was the box.
        if items.iter().any(|item| matches!(item, Item::Block(_))) {
            let (size, _) = contents.farthest(items, Away { from: [0.0; 3], scale: 1.0 }, f64::INFINITY, 0);
            for i in 0..3 {
                for (side, sign) in [(&mut low[i], -1.0), (&mut high[i], 1.0)] {
                    let mut direction = [0.0; 3];
                    direction[i] = sign;
                    let probe = Along { base: 0.0, direction, scale: 1.0 };
                    let (most, gap) = contents.farthest(items, probe, TOLERANCE * size, EFFORT);
                    *side = sign * most;
                    slack = slack.max(gap);
                }
            }
        }
        let reach = low.iter().chain(&high).fold(0.0_f64, |reach, c| reach.max(c.abs()));
        let centre = [0, 1, 2].map(|i| 0.5 * (low[i] + high[i]));
        let probe = Away { from: centre, scale: 1.0 };
        let (radius, gap) = contents.farthest(items, probe, TOLERANCE * reach, EFFORT);
        // The ball need not be larger than the box.
        let radius = radius.min(norm(Self { low, high, radius }.half()));
        let shift = exponent_of(reach);
        let unit = libm::scalbn(1.0, -shift);
        let hull = Self { low: low.map(|c| c * unit), high: high.map(|c| c * unit), radius: radius * unit };
        Enclosed { hull, slack: slack.max(gap) * unit, shift }
    }
}

/// What is known of a whole drawing, in units of the root block.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// The least and the greatest coordinates.
    pub(super) sides: [Vector; 2],
    pub(crate) girth: Option<Girth>,
}

/// The smallest box around what a block draws as exactly as some effort can tell, and the drawing's girth.
pub(super) fn extent(drawing: &Drawing<Solid>, root: BlockId) -> Extent {
    const EXACT: f64 = 1e-11;
    const PATIENCE: usize = 3_000;
    let Drawing { blocks, items, vertices, .. } = drawing;
    let contents = Contents { blocks, items, vertices };
    let items = drawing.items_of(root);
    let sides = [-1.0, 1.0].map(|sign| {
        [0, 1, 2].map(|i| {
            let mut direction = [0.0; 3];
            direction[i] = sign;
            sign * contents.farthest(items, Along { base: 0.0, direction, scale: 1.0 }, EXACT, PATIENCE).0
        })
    });
    Extent { sides, girth: girth(drawing) }
}

/// A quantity that points have, and what is known of it where only a body is known.
pub(super) trait Probe: Copy {
    /// Of a point.
    fn of(&self, point: Vector) -> f64;
    /// At most, of the contents of a body.
    fn most(&self, body: &Body) -> f64;
    /// That some of the contents of a body have at least, if none of its sides is farther than `slack` from them.
    fn least(&self, body: &Body, slack: f64) -> f64;
    /// The same quantity for points of a block's frame.
    fn within(&self, placed: &Placed<Solid>) -> Self;
}

/// How far a point lies in a direction.
#[derive(Clone, Copy)]
struct Along {
    base: f64,
    direction: Vector,
    scale: f64,
}

impl Probe for Along {
    fn of(&self, point: Vector) -> f64 {
        self.base + self.scale * dot(self.direction, point)
    }

    fn most(&self, body: &Body) -> f64 {
        let half = body.half();
        let across: f64 = (0..3).map(|i| self.direction[i].abs() * half[i]).sum();
        self.of(body.centre()) + self.scale * across.min(body.radius)
    }

    fn least(&self, body: &Body, slack: f64) -> f64 {
        // Each side of the box is touched somewhere; it may be at the worst of its corners.
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

/// How far a point is from another.
#[derive(Clone, Copy)]
struct Away {
    from: Vector,
    scale: f64,
}

impl Probe for Away {
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

/// What a search looks into.
pub(super) struct Contents<'a> {
    pub(super) blocks: &'a [Block<Solid>],
    pub(super) items: &'a [Item<Solid>],
    pub(super) vertices: &'a [Vector],
}

/// A block that may have the most; the one that may have more comes first.
struct Open<P> {
    most: f64,
    block: BlockId,
    probe: P,
}

impl<P> Ord for Open<P> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.most.total_cmp(&other.most)
    }
}

impl<P> PartialOrd for Open<P> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<P> PartialEq for Open<P> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<P> Eq for Open<P> {}

impl Contents<'_> {
    /// The most that `items` have of a quantity, and how much less it may be: at most `tolerance`, unless `effort`
    /// blocks are too few to tell.
    pub(super) fn farthest<P: Probe>(
        &self,
        items: &[Item<Solid>],
        probe: P,
        tolerance: f64,
        effort: usize,
    ) -> (f64, f64) {
        let (mut open, mut least) = (BinaryHeap::new(), f64::NEG_INFINITY);
        self.look(items, probe, &mut open, &mut least);
        for _ in 0..effort {
            if open.peek().is_none_or(|top| top.most <= least + tolerance) {
                break;
            }
            let Some(Open { block, probe, .. }) = open.pop() else { break };
            let range = &self.blocks[block.0 as usize].items;
            self.look(&self.items[range.start as usize..range.end as usize], probe, &mut open, &mut least);
        }
        let most = open.peek().map_or(least, |top| top.most.max(least));
        (most, most - least)
    }

    fn look<P: Probe>(&self, items: &[Item<Solid>], probe: P, open: &mut BinaryHeap<Open<P>>, least: &mut f64) {
        for item in items {
            match item {
                Item::Stroke(stroke) => *least = least.max(probe.of(stroke.from)).max(probe.of(stroke.to)),
                Item::Polygon(polygon) => {
                    let all = self.vertices[polygon.range()].iter().map(|&vertex| probe.of(vertex));
                    *least = all.fold(*least, f64::max);
                }
                Item::Block(placed) if placed.scale < SPECK => *least = least.max(probe.of(placed.at)),
                Item::Block(placed) => {
                    let Block { hull, slack, .. } = &self.blocks[placed.block.0 as usize];
                    let probe = probe.within(placed);
                    *least = least.max(probe.least(hull, *slack));
                    let most = probe.most(hull);
                    if most > *least {
                        open.push(Open { most, block: placed.block, probe });
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::segments::{Frame, Strokes};
    use super::*;
    use crate::{Definition, Limits, StyleChange, System, draw_solid};

    /// Every block's body contains all that the block draws, and fits it as exactly as it says.
    fn check(rules: &str, angle: f64, n: u32, loose: f64) {
        let definition = Definition { axiom: "A".into(), rules: rules.into(), angle, ..Definition::default() };
        let drawing = draw_solid(&System::new(&definition).0.unwrap(), n, &Limits::default()).unwrap();
        for (id, block) in drawing.blocks.iter().enumerate() {
            let mut strokes = Strokes::new(&drawing);
            strokes.enter(BlockId(id as u32), &Frame::new(1.0, StyleChange::NONE));
            let (body, mut low, mut high, mut radius) = (block.hull, [f64::MAX; 3], [f64::MIN; 3], 0.0_f64);
            for end in strokes.flat_map(|(from, to, _)| [from, to]) {
                low = [0, 1, 2].map(|i| low[i].min(end[i]));
                high = [0, 1, 2].map(|i| high[i].max(end[i]));
                radius = radius.max(norm([0, 1, 2].map(|i| end[i] - body.centre()[i])));
            }
            for i in 0..3 {
                assert!(body.low[i] <= low[i] + 1e-11 && body.high[i] >= high[i] - 1e-11, "{id}: {body:?}");
                let slack = (low[i] - body.low[i]).max(body.high[i] - high[i]);
                assert!(slack <= block.slack + 1e-11 && slack <= loose, "{id}: {slack} {block:?}");
            }
            assert!(
                radius <= body.radius + 1e-11 && body.radius <= radius + loose.max(1e-11),
                "{id}: {radius} {body:?}"
            );
            let reach = body.low.iter().chain(&body.high).fold(0.0_f64, |reach, c| reach.max(c.abs()));
            assert!((0.5..1.0).contains(&reach), "{id}: {body:?}");
        }
    }

    #[test]
    fn bodies_contain_and_fit() {
        check("A -> [&F!A]/////'[&F!A]///////'[&F!A]\nF -> S/////F\nS -> F", 22.5, 9, 0.03);
        check("A -> F[&A][/+A]^F\\A\nF -> FF", 25.7, 8, 0.03);
        // A long chain of blocks, each nearly as large as the one that holds it.
        check("A -> F&/A", 137.5, 300, 0.6);
        // Made stroke by stroke.
        check("A -> F[&A][/+A]^F\\$A\nF -> FF", 25.7, 8, 0.01);
    }
}
