//! How far a drawing reaches, more exactly than hulls of few corners tell.

use super::{BlockId, Drawing, Item};
use crate::Heading;
use crate::plane::Directions;
use lsystem_syntax::sorted::sort;
use std::collections::HashMap;

/// How exact the answer is, in units of the root block.
const TOLERANCE: f64 = 1e-11;
/// Blocks looked into before the hulls' answer is good enough; they never say too little.
const EFFORT: u32 = 50_000;

/// The extent of the root block in its own units: min x, min y, max x, max y.
pub(super) fn extent(drawing: &Drawing) -> Option<[f64; 4]> {
    let root = drawing.root?;
    let mut search = Search { drawing, directions: Directions::default(), known: HashMap::new(), effort: EFFORT };
    let mut reach = |degrees| search.reach(root, Heading::from_degrees(degrees), TOLERANCE);
    Some([-reach(180.0), -reach(270.0), reach(0.0), reach(90.0)])
}

/// A number that falls as `value` grows, in the order of [`f64::total_cmp`].
fn falling(value: f64) -> i64 {
    let bits = value.to_bits().cast_signed();
    // Negative values are in the opposite order of their bits.
    if bits < 0 { bits ^ i64::MIN } else { !bits }
}

struct Search<'a> {
    drawing: &'a Drawing,
    directions: Directions,
    /// By block and direction: how far it reaches, and how exactly that is known.
    known: HashMap<(BlockId, Heading), (f64, f64)>,
    effort: u32,
}

impl Search<'_> {
    /// How far `block` reaches in a direction, at most `tolerance` too far.
    fn reach(&mut self, block: BlockId, direction: Heading, tolerance: f64) -> f64 {
        let drawing = self.drawing;
        if drawing.blocks[block.0 as usize].slack <= tolerance {
            return self.reach_of_hull(block, direction);
        }
        match self.known.get(&(block, direction)) {
            Some(&(reach, exact)) if exact <= tolerance => return reach,
            _ => {}
        }
        if self.effort == 0 {
            return self.reach_of_hull(block, direction);
        }
        self.effort -= 1;
        let (c, s) = self.directions.cos_sin(direction);
        let along = |[x, y]: [f64; 2]| c * x + s * y;
        let mut best = f64::NEG_INFINITY;
        // What may reach farthest is looked into first; most of the rest then need not be.
        let mut inner = Vec::new();
        for item in drawing.items_of(block) {
            match item {
                Item::Stroke(stroke) => best = best.max(along(stroke.from)).max(along(stroke.to)),
                Item::Polygon(polygon) => {
                    best = drawing.vertices_of(polygon).iter().map(|&vertex| along(vertex)).fold(best, f64::max);
                }
                Item::Block(placed) => {
                    let at = along(placed.at);
                    let most = at + placed.scale * self.reach_of_hull(placed.block, direction - placed.heading);
                    inner.push((most, at, placed));
                }
            }
        }
        let mut order: Vec<_> = inner.iter().enumerate().map(|(index, (most, ..))| (falling(*most), index)).collect();
        sort(&mut order);
        for (_, index) in order {
            let (most, at, placed) = inner[index];
            if most <= best {
                break;
            }
            // Zero where a block is too small to see.
            let finer = if placed.scale > 0.0 { tolerance / placed.scale } else { f64::INFINITY };
            best = best.max(at + placed.scale * self.reach(placed.block, direction - placed.heading, finer));
        }
        self.known.insert((block, direction), (best, tolerance));
        best
    }

    fn reach_of_hull(&mut self, block: BlockId, direction: Heading) -> f64 {
        let (c, s) = self.directions.cos_sin(direction);
        let corners = self.drawing.corners_of(&self.drawing.blocks[block.0 as usize]);
        corners.iter().map(|&[x, y]| c * x + s * y).fold(f64::NEG_INFINITY, f64::max)
    }
}
