//! The size of the scene from which pictures in space are made. A scene takes about as much memory as the drawing, so
//! both count towards the memory limit.

/// The numbers of a scene's parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SceneSize {
    /// Blocks, or runs of a block's contents.
    pub nodes: usize,
    /// References from nodes to inner nodes.
    pub links: usize,
    /// Strokes and triangles.
    pub lines: usize,
}

impl SceneSize {
    /// The most links, strokes and triangles of a node.
    pub const WIDTH: usize = 16;
    /// The most bytes of a node.
    pub const NODE: usize = 512;
    /// The bytes of a sample of a node's strokes.
    pub const SAMPLE: usize = 56;
    /// The bytes of a mean colour.
    const MEAN: usize = size_of::<[f32; 3]>();
    /// The bytes of a link.
    pub const LINK: usize = 176;
    /// The bytes of a line.
    pub const LINE: usize = 48;

    /// The number of samples of a node; shared drawings need more.
    #[must_use]
    pub const fn samples(memoised: bool) -> usize {
        if memoised { 16 } else { 8 }
    }

    /// The least bytes of a line.
    pub const LEAST: u64 = Self::LINE as u64;

    /// Adds the nodes of a block with `lines` strokes and triangles and `links` inner blocks.
    pub fn add(&mut self, lines: usize, links: usize) {
        self.lines += lines;
        self.links += links;
        let mut row = (lines + links).div_ceil(Self::WIDTH);
        self.nodes += row;
        while row > 1 {
            // A node of the row above links each node of this row.
            self.links += row;
            row = row.div_ceil(Self::WIDTH);
            self.nodes += row;
        }
    }

    /// The bytes of the scene, with a mean colour for each node.
    pub fn bytes(&self, memoised: bool) -> u64 {
        let node = Self::NODE + Self::samples(memoised) * Self::SAMPLE + Self::MEAN;
        let rest = self.links * Self::LINK + self.lines * Self::LINE;
        (self.nodes * node + rest) as u64
    }
}
