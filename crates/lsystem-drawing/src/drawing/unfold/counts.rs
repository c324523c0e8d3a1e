//! The count of segments and open branches, for the limits of unfolded drawings.

use crate::drawing::block::Space;
use crate::turtle::Op;

/// The units of work of an open branch: the saved turtle state takes the memory of this many letters.
const BRANCH: u64 = 32;

/// The counts so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    /// The number of segments, polygons and vertices of polygons; each counts the same towards the memory limit.
    pub segments: u64,
    /// The number of open branches.
    open: u64,
    /// The largest number of open branches so far.
    deepest: u64,
    /// The number of open polygons.
    outlines: u64,
}

impl Tally {
    pub(super) fn add<S: Space>(&mut self, op: &Op<S>) {
        match op {
            Op::Draw(_) => self.segments += 1,
            Op::Push(_) => {
                self.open += 1;
                self.deepest = self.deepest.max(self.open);
            }
            Op::Pop => self.open = self.open.saturating_sub(1),
            Op::Vertex => self.segments += u64::from(self.outlines > 0),
            Op::OpenPolygon => {
                self.outlines += 1;
                self.segments += 1;
            }
            Op::ClosePolygon => self.outlines = self.outlines.saturating_sub(1),
            Op::Move(_) | Op::Turn(_) | Op::Upright | Op::Bend(_) | Op::Style(_) => {}
        }
    }

    /// The units of work for saving the open branches.
    pub(super) fn work(&self) -> u64 {
        self.deepest.saturating_mul(BRANCH)
    }
}
