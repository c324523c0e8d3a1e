//! What a drawing made letter by letter will take: segments, and branches open at the same time.

use crate::drawing::block::Space;
use crate::turtle::Op;

/// What an open branch costs in units of work: its turtle's state takes the memory of as many letters.
const BRANCH: u64 = 32;

/// The counts so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    /// Of a polygon's vertices, too: they take as much memory.
    pub segments: u64,
    /// Branches open now, and at most so far.
    open: u64,
    deepest: u64,
    /// Polygons open now.
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

    /// The work that remembering the open branches takes.
    pub(super) fn work(&self) -> u64 {
        self.deepest.saturating_mul(BRANCH)
    }
}
