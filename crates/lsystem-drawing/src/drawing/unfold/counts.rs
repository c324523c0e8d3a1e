//! The count of segments and open branches, for the limits of unfolded drawings.

use crate::drawing::block::Space;
use crate::turtle::TurtleOp;

/// The units of work of an open branch: the saved turtle state takes the memory of this many letters.
const BRANCH: u64 = 32;

/// The counts so far.
#[derive(Clone, Debug, Default)]
pub(super) struct DrawingCounts {
    /// The number of segments, polygons and vertices of polygons; each counts the same towards the memory limit.
    pub segments: u64,
    /// The number of open branches.
    open: u64,
    /// The largest number of open branches so far.
    deepest: u64,
    /// The number of open polygons.
    outlines: u64,
}

impl DrawingCounts {
    pub(super) fn add<S: Space>(&mut self, op: &TurtleOp<S>) {
        match op {
            TurtleOp::Draw(_) | TurtleOp::Circle(_) | TurtleOp::Tube => self.segments += op.segments(),
            // The polygon and its vertices.
            TurtleOp::Fill(..) | TurtleOp::Triangle { .. } => self.segments += 1 + op.work(),
            TurtleOp::Push(_) => {
                self.open += 1;
                self.deepest = self.deepest.max(self.open);
            }
            TurtleOp::Pop => self.open = self.open.saturating_sub(1),
            TurtleOp::Vertex => self.segments += u64::from(self.outlines > 0),
            TurtleOp::OpenPolygon => {
                self.outlines += 1;
                // The polygon and its first vertex.
                self.segments += 2;
            }
            TurtleOp::ClosePolygon => self.outlines = self.outlines.saturating_sub(1),
            TurtleOp::Move(_)
            | TurtleOp::Turn(_)
            | TurtleOp::Wind(_)
            | TurtleOp::Upright
            | TurtleOp::Bend(_)
            | TurtleOp::Style(_)
            | TurtleOp::TurnColour(_)
            | TurtleOp::SwapTurns
            | TurtleOp::ScaleLength(_)
            | TurtleOp::OpenTube
            | TurtleOp::FirstVertex => {}
        }
    }

    /// The units of work for saving the open branches.
    pub(super) fn work(&self) -> u64 {
        self.deepest.saturating_mul(BRANCH)
    }
}
