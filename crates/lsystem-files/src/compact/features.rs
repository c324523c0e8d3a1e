//! The features of a drawing's blocks at the size of a picture.

use lsystem_drawing::{BlockFeatures, BlockId, Directions, Drawing, Item, Line};
use lsystem_syntax::{Halt, Work};

/// The features of blocks, by block.
#[derive(Default)]
pub(super) struct Features {
    shapes: Vec<BlockFeatures>,
    /// The number of strokes that draw the block at this size, saturating. Blocks placed with scaled lengths may have
    /// other numbers there.
    strokes: Vec<u32>,
    /// Blocks less than this size across become one stroke, in pixels.
    dot: f64,
}

impl Features {
    /// Finds the features of all blocks. One unit of the root is `scale` pixels, and blocks less than `dot` pixels across
    /// become one stroke.
    pub(super) fn new(
        drawing: &Drawing,
        root: BlockId,
        scale: f64,
        dot: f64,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
        let exponent = drawing.blocks[root.0 as usize].exponent;
        let (mut features, mut directions) = (Self { dot, ..Self::default() }, Directions::default());
        for block in &drawing.blocks {
            work.charge(1 + BlockFeatures::work(block, drawing))?;
            let shape = BlockFeatures::new(block, &features.shapes, drawing, &mut directions);
            let own = scale * libm::scalbn(1.0, block.exponent.saturating_sub(exponent));
            let strokes = match one_stroke(&shape, own, dot) {
                Some(_) => 1,
                None => (drawing.contents(block).iter())
                    .map(|item| match item {
                        Item::Stroke(_) | Item::Polygon(_) => 1,
                        Item::Block(placed) => features.strokes(placed.block),
                    })
                    .fold(0, u32::saturating_add),
            };
            features.strokes.push(strokes);
            features.shapes.push(shape);
        }
        Ok(features)
    }

    pub(super) fn strokes(&self, block: BlockId) -> u32 {
        self.strokes[block.0 as usize]
    }

    /// The single stroke that draws a block, if there is one. One unit of the block is `scale` pixels.
    pub(super) fn one_stroke(&self, block: BlockId, scale: f64) -> Option<&Line> {
        one_stroke(&self.shapes[block.0 as usize], scale, self.dot)
    }
}

fn one_stroke(shape: &BlockFeatures, scale: f64, dot: f64) -> Option<&Line> {
    let is_dot = shape.longest.length() * scale.abs() < dot;
    shape.straight.as_ref().or(is_dot.then_some(&shape.longest))
}
