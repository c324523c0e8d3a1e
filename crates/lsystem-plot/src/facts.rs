//! The facts about a drawing's blocks that decide how they are plotted.

use crate::page::{Point, distance};
use lsystem_drawing::{BlockFeatures, BlockFrame, BlockId, Directions, Drawing, Item, Line, StyleChange};
use lsystem_syntax::{Halt, Work};

/// The facts about all blocks.
pub(crate) struct BlockFacts {
    shapes: Vec<BlockFeatures>,
    ways: Vec<Way>,
}

/// The pen's way through a block, in block units.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// Where the first stroke starts and the last one ends; `None` without strokes.
    ends: Option<[Point; 2]>,
    /// The length of all strokes.
    ink: f64,
    /// The least diameter of the blocks inside that are not straight, or of this block.
    finest: f64,
}

impl BlockFacts {
    /// Finds the facts about all blocks.
    pub(crate) fn new(drawing: &Drawing, work: &mut dyn Work) -> Result<Self, Halt> {
        let mut directions = Directions::default();
        let (mut shapes, mut ways): (Vec<BlockFeatures>, Vec<Way>) = (vec![], vec![]);
        for block in &drawing.blocks {
            work.charge(1 + BlockFeatures::work(block, drawing))?;
            let shape = BlockFeatures::new(block, &shapes, drawing, &mut directions);
            let diameter = if shape.straight.is_some() { f64::INFINITY } else { shape.longest.length() };
            let mut way = Way { ends: None, ink: 0.0, finest: diameter };
            let home = BlockFrame::new(1.0, StyleChange::NONE);
            for item in drawing.contents(block) {
                let ends = match item {
                    Item::Polygon(_) => None,
                    Item::Stroke(stroke) => {
                        way.ink += distance(stroke.from, stroke.to);
                        Some([stroke.from, stroke.to])
                    }
                    Item::Block(placed) => {
                        let inner = ways[placed.block.0 as usize];
                        let scale = placed.scale.abs();
                        way.ink += inner.ink * scale;
                        way.finest = way.finest.min(inner.finest * scale);
                        let frame = home.place(placed, drawing, &mut directions);
                        inner.ends.map(|ends| ends.map(|end| frame.transform(end)))
                    }
                };
                way.ends = match (way.ends, ends) {
                    (Some([start, _]), Some([_, end])) => Some([start, end]),
                    (before, next) => before.or(next),
                };
            }
            shapes.push(shape);
            ways.push(way);
        }
        Ok(Self { shapes, ways })
    }

    /// The stroke equal to a block, if there is one.
    pub(crate) fn straight(&self, block: BlockId) -> Option<&Line> {
        self.shapes[block.0 as usize].straight.as_ref()
    }

    /// The block's longest diagonal, in block units.
    pub(crate) fn diameter(&self, block: BlockId) -> f64 {
        self.shapes[block.0 as usize].longest.length()
    }

    /// The least diameter of the blocks in `block` that are not straight, in units of `block`.
    pub(crate) fn finest(&self, block: BlockId) -> f64 {
        self.ways[block.0 as usize].finest
    }

    /// One stroke that stands for a block smaller than the pen. It leads from the start of the block's first stroke to
    /// the end of the last one, so that the strokes of consecutive blocks meet as the blocks do. The stroke of a closed
    /// block leads to the farthest corner. No stroke is longer than the ink that it stands for.
    pub(crate) fn chord(&self, block: BlockId, drawing: &Drawing) -> Line {
        let longest = self.shapes[block.0 as usize].longest;
        let Way { ends: Some([from, end]), ink, .. } = self.ways[block.0 as usize] else { return longest };
        let corners = drawing.corners_of(&drawing.blocks[block.0 as usize]);
        let to = if distance(from, end) >= CLOSED * longest.length() {
            end
        } else {
            corners
                .iter()
                .copied()
                .fold(end, |far, corner| if distance(from, corner) > distance(from, far) { corner } else { far })
        };
        let part = (ink / distance(from, to)).min(1.0);
        let to = if part < 1.0 { [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis])) } else { to };
        Line { from, to, ..longest }
    }
}

/// The part of a block's diameter between the ends of its way, below which the block counts as closed.
const CLOSED: f64 = 0.25;
