//! From a drawing's graph in space to pixels.
//!
//! The picture is what drawing every segment as a lit round stick would show: no stick thinner than a pixel, 4x4 samples
//! a pixel, each showing what is nearest. It is made tile by tile: the graph is descended from front to back, what is
//! outside the tile or behind what is painted already is not looked into, and a block under half a pixel is a dot with
//! the mean colour and the mean shading of what it draws. So a picture costs what can be seen of it, however many
//! segments there are.
//!
//! Where very many blocks lie in the same place, as in a bush that thickens without growing, even that is too much. Each
//! tile has a budget, which a block shares out to the blocks in it; one whose share is too small to look into shows the
//! longest of its strokes. So pictures end in time, and all that they show is there.

mod camera;
mod hatch;
mod light;
mod scene;
mod stroke;
mod tile;
mod walk;

#[cfg(test)]
mod tests;

pub use camera::{Camera, camera_axes, solid_scale};

use crate::{Drawing, Progress, RenderStats, Solid, Style, Viewport};
use scene::Scene;
use std::sync::Arc;
use walk::Walk;

/// How much a picture may show for its time: 0 is the coarsest, for large drawings on the move, and
/// [`Quality::FINEST`] the picture as it is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Quality(pub u8);

impl Quality {
    /// Blocks of half a pixel, 4x4 samples a pixel.
    pub const FINEST: Self = Self((LADDER.len() - 1) as u8);

    /// One step finer, up to the finest.
    #[must_use]
    pub fn finer(self) -> Self {
        Self(self.0 + 1).min(Self::FINEST)
    }

    /// One step coarser, down to the coarsest.
    #[must_use]
    pub fn coarser(self) -> Self {
        Self(self.0.saturating_sub(1))
    }

    /// Samples along the side of a pixel.
    fn samples(self) -> usize {
        self.rung().samples
    }

    /// Blocks smaller than this are dots, in samples.
    fn detail(self) -> f64 {
        self.rung().detail
    }

    /// Samples along the side of a tile.
    fn side(self) -> usize {
        self.rung().side
    }

    /// Contents of blocks that are looked into at most, in a tile.
    fn budget(self) -> u32 {
        self.rung().budget
    }

    fn rung(self) -> Rung {
        LADDER[usize::from(self.0).min(LADDER.len() - 1)]
    }
}

/// What a quality means.
#[derive(Clone, Copy)]
struct Rung {
    samples: usize,
    detail: f64,
    side: usize,
    budget: u32,
}

/// Coarse pictures are made in a few large tiles, so that what is on none of them need not be looked for often; fine ones
/// in many small tiles that stay in a near cache.
const LADDER: [Rung; 6] = [
    Rung { samples: 1, detail: 5.0, side: 1024, budget: 8_000 },
    Rung { samples: 1, detail: 3.0, side: 1024, budget: 25_000 },
    Rung { samples: 1, detail: 2.0, side: 1024, budget: 80_000 },
    Rung { samples: 1, detail: 1.2, side: 1024, budget: 250_000 },
    Rung { samples: 2, detail: 1.6, side: 512, budget: 80_000 },
    Rung { samples: 4, detail: 2.0, side: 256, budget: 60_000 },
];

/// Makes pictures of a drawing in space, one after the other, in the same memory.
#[derive(Default)]
pub struct SolidRenderer {
    drawing: Option<Arc<Drawing<Solid>>>,
    scene: Scene,
    walk: Walk,
}

impl SolidRenderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes the drawing that the next pictures are of.
    pub fn load(&mut self, drawing: Arc<Drawing<Solid>>) {
        self.scene = Scene::new(&drawing);
        self.drawing = Some(drawing);
    }

    /// Starts a picture of the loaded drawing; a picture that was being made is given up.
    pub fn begin(&mut self, style: &Style, viewport: Viewport, camera: &Camera, quality: Quality) {
        if let Some(drawing) = &self.drawing {
            self.scene.dye(style);
            self.walk.begin(drawing, style, viewport, camera, quality);
        }
    }

    /// Goes on with the picture for about `work` units (one unit is in the order of 10 to 100 nanoseconds).
    pub fn step(&mut self, work: usize) -> Progress {
        let mut left = i64::try_from(work).unwrap_or(i64::MAX).max(1);
        self.walk.step(&self.scene, &mut left)
    }

    /// The picture so far: RGBA, 8 bits each, opaque, from the upper left corner row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        &self.walk.pixels
    }

    /// What the picture took so far.
    #[must_use]
    pub fn stats(&self) -> RenderStats {
        self.walk.stats
    }
}
