//! What pictures in space are made from, counted while the drawing is made: as much again as the drawing itself, so that
//! the limit of memory holds for both.

/// The parts of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SceneSize {
    /// Blocks, or runs of a block's contents.
    pub nodes: usize,
    /// Nodes inside others.
    pub links: usize,
    /// Strokes and triangles.
    pub lines: usize,
}

impl SceneSize {
    /// The nodes, strokes and triangles of a node at most.
    pub const WIDTH: usize = 16;
    /// The bytes of a node at most.
    pub const NODE: usize = 472;
    /// Those of a sample of a node's strokes.
    pub const SAMPLE: usize = 64;
    /// Those of a mean colour.
    const MEAN: usize = size_of::<[f32; 3]>();
    /// Those of a link.
    pub const LINK: usize = 176;
    /// Those of a line.
    pub const LINE: usize = 48;

    /// The samples of a node of a drawing that shares its blocks, or does not.
    #[must_use]
    pub const fn samples(memoised: bool) -> usize {
        if memoised { 16 } else { 8 }
    }

    /// The bytes of a line at least.
    pub const LEAST: u64 = Self::LINE as u64;

    /// Adds what a block with so many strokes and triangles, and so many blocks inside, becomes.
    pub fn add(&mut self, lines: usize, links: usize) {
        self.lines += lines;
        self.links += links;
        let mut row = (lines + links).div_ceil(Self::WIDTH);
        self.nodes += row;
        while row > 1 {
            // Each node of a row is linked from the one above.
            self.links += row;
            row = row.div_ceil(Self::WIDTH);
            self.nodes += row;
        }
    }

    /// The bytes of all of it, with a mean colour for each node.
    pub fn bytes(&self, memoised: bool) -> u64 {
        let node = Self::NODE + Self::samples(memoised) * Self::SAMPLE + Self::MEAN;
        let rest = self.links * Self::LINK + self.lines * Self::LINE;
        (self.nodes * node + rest) as u64
    }
}
