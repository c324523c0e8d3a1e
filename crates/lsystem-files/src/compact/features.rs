//! The features of a drawing's blocks at the size of a picture.

use lsystem_drawing::{BlockId, Directions, Drawing, Item, Line, Shape};
use lsystem_syntax::{Meter, Progress};

/// Blocks less than this size across become one stroke, in pixels.
const DOT: f64 = 1.0;

/// The features of blocks, by block, as far as computed.
#[derive(Clone, Debug, Default)]
pub(super) struct Features {
    shapes: Vec<Shape>,
    /// The number of strokes that draw the block at this size, saturating. Blocks placed with scaled lengths may have
    /// other numbers there.
    strokes: Vec<u32>,
    directions: Directions,
}

impl Features {
    /// Computes the features of further blocks until the meter is spent. One unit of the root is `scale` pixels.
    pub(super) fn step(&mut self, drawing: &Drawing, root: BlockId, scale: f64, meter: &mut Meter) -> Progress {
        let exponent = drawing.blocks[root.0 as usize].exponent;
        while let Some(block) = drawing.blocks.get(self.shapes.len()) {
            if meter.is_spent() {
                return Progress::More;
            }
            meter.charge(1 + Shape::work(block, drawing));
            let shape = Shape::new(block, &self.shapes, drawing, &mut self.directions);
            let own = scale * libm::scalbn(1.0, block.exponent.saturating_sub(exponent));
            self.strokes.push(match one_stroke(&shape, own) {
                Some(_) => 1,
                None => (drawing.contents(block).iter())
                    .map(|item| match item {
                        Item::Stroke(_) | Item::Polygon(_) => 1,
                        Item::Block(placed) => self.strokes(placed.block),
                    })
                    .fold(0, u32::saturating_add),
            });
            self.shapes.push(shape);
        }
        Progress::Done
    }

    pub(super) fn strokes(&self, block: BlockId) -> u32 {
        self.strokes[block.0 as usize]
    }

    /// The single stroke that draws a block, if there is one. One unit of the block is `scale` pixels.
    pub(super) fn one_stroke(&self, block: BlockId, scale: f64) -> Option<&Line> {
        one_stroke(&self.shapes[block.0 as usize], scale)
    }
}

fn one_stroke(shape: &Shape, scale: f64) -> Option<&Line> {
    let dot = (shape.longest.length() * scale.abs() < DOT).then_some(&shape.longest);
    shape.straight.as_ref().or(dot)
}
