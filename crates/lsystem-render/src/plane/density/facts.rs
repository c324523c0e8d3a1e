//! The shape and the ink of every block of a drawing.

use super::deposit::Deposit;
use crate::plane::descent::Node;
use crate::plane::shape::Shape;

/// The shapes and deposits of a drawing's blocks.
#[derive(Clone, Copy)]
pub(super) struct Facts<'a> {
    pub shapes: &'a [Shape],
    pub deposits: &'a [Deposit],
}

impl<'a> Facts<'a> {
    #[inline]
    pub(super) fn shape(self, node: &Node) -> &'a Shape {
        &self.shapes[node.block.0 as usize]
    }

    #[inline]
    pub(super) fn deposit(self, node: &Node) -> &'a Deposit {
        &self.deposits[node.block.0 as usize]
    }
}
