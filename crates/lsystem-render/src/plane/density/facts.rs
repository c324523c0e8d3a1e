//! The shape and the ink of every block of a drawing.

use super::deposit::{Deposit, Deposits};
use crate::plane::descent::Node;
use crate::plane::shape::{Shape, Shapes};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;

/// The shapes and deposits of a drawing's blocks.
#[derive(Default)]
pub(super) struct Facts {
    pub shapes: Shapes,
    pub deposits: Deposits,
}

impl Facts {
    /// Goes on until the facts of all blocks are known.
    pub(super) fn step(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        if self.shapes.step(drawing, meter) == Progress::More {
            return Progress::More;
        }
        self.deposits.step(drawing, &self.shapes.list, meter)
    }

    #[inline]
    pub(super) fn shape(&self, node: &Node) -> &Shape {
        &self.shapes.list[node.block.0 as usize]
    }

    #[inline]
    pub(super) fn deposit(&self, node: &Node) -> &Deposit {
        &self.deposits.list[node.block.0 as usize]
    }
}
