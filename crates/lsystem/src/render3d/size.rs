//! What the nodes of a drawing in space take, counted while the drawing is made.

use super::SolidRenderer;
use super::scene::{Line, Link, Node, Sample, WIDTH, kept_samples};
use crate::{Item, Solid, Viewport};

/// The parts of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SceneSize {
    pub nodes: usize,
    pub links: usize,
    pub lines: usize,
}

/// A mean colour.
const MEAN: usize = size_of::<[f32; 3]>();

impl SceneSize {
    /// The bytes of a line at least.
    pub(crate) const LEAST: u64 = size_of::<Line>() as u64;

    /// Adds what a block with these items becomes, or less: a polygon of so many vertices has two triangles fewer.
    pub(crate) fn add(&mut self, items: &[Item<Solid>]) {
        let mut lines = 0;
        let mut links = 0;
        for item in items {
            match item {
                Item::Stroke(_) => lines += 1,
                Item::Polygon(polygon) => lines += (polygon.count as usize).saturating_sub(2),
                Item::Block(_) => links += 1,
            }
        }
        self.lines += lines;
        self.links += links;
        let mut row = (lines + links).div_ceil(WIDTH);
        self.nodes += row;
        while row > 1 {
            // Each node of a row is linked from the one above.
            self.links += row;
            row = row.div_ceil(WIDTH);
            self.nodes += row;
        }
    }

    /// The bytes of all of it, with a mean colour for each node.
    pub(crate) fn bytes(&self, memoised: bool) -> u64 {
        let node = size_of::<Node>() + kept_samples(memoised) * size_of::<Sample>() + MEAN;
        let rest = self.links * size_of::<Link>() + self.lines * size_of::<Line>();
        (self.nodes * node + rest) as u64
    }
}

impl SolidRenderer {
    /// The most bytes that a renderer takes which makes pictures of this size, whole and halved and in panes, beside the
    /// drawing and what is [counted with it](crate::Drawing::bytes).
    #[must_use]
    pub fn most_bytes(viewport: Viewport) -> u64 {
        /// Pixels, or samples of a tile that has as many, and a depth and a colour for each of these.
        const PIXEL: u64 = 4;
        const SAMPLE: u64 = 8;
        let tile = |samples: u64| SAMPLE * samples + samples / 8;
        let pixels = u64::from(viewport.width) * u64::from(viewport.height);
        // A tile has at most 1024 samples each way at rest, and 2048 while things move.
        let (rest, moving) = (tile(1 << 20), |pixels: u64| tile(pixels.clamp(1 << 20, 1 << 22)));
        let walk = |pixels: u64| PIXEL * pixels + moving(pixels);
        walk(pixels) + walk(pixels / 4) + PIXEL * pixels + rest
    }
}
