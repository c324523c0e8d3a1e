//! The detail of a picture.

use crate::Viewport;
use lsystem_syntax::{Ink, Style};

/// The detail of a picture: 0 is the coarsest, for large drawings while the camera moves. [`Quality::FINEST`] is for
/// the screen at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Quality(pub u8);

impl Quality {
    /// For files: as [`Quality::FINEST`], with 8 times the work for crowded drawings.
    pub const BEST: Self = Self(17);
    /// Dots up to half a pixel, 4x4 samples in a pixel.
    pub const FINEST: Self = Self(16);
    /// The finest quality with one sample in a pixel, for a moving camera. Up to here two steps double the budget.
    pub const MOVING: Self = Self(14);

    /// The quality `steps` finer, or coarser for a negative number, between 0 and [`Quality::MOVING`].
    #[must_use]
    pub fn paced(self, steps: i32) -> Self {
        let number = (i32::from(self.0) + steps).clamp(0, i32::from(Self::MOVING.0));
        Self(number as u8)
    }

    /// Samples along the side of a pixel.
    pub(super) const fn samples(self) -> usize {
        if self.0 >= Self::FINEST.0 {
            4
        } else if self.0 > Self::MOVING.0 {
            2
        } else {
            1
        }
    }

    /// Whether a picture has shadows. Moving pictures have none, because shadows take another picture of the drawing.
    pub(super) fn has_shadows(self, style: &Style) -> bool {
        self >= Self::FINEST && style.shadows && style.ink != Ink::Density
    }

    /// The extent in samples below which blocks are dots.
    pub(super) fn detail(self) -> f64 {
        match self.0 {
            0..6 => 3.0,
            6..15 => 1.5,
            15 => 1.6,
            _ => 2.0,
        }
    }

    /// Samples across and down a tile. A coarse picture has a single tile (up to 2048 samples each way), so that the
    /// graph is descended once. Fine pictures have small tiles, which stay in the processor's cache.
    pub(super) fn tile(self, viewport: Viewport) -> [usize; 2] {
        /// A multiple of 1, 2 and 4 samples, and of the tile's cells.
        const SIDE: usize = 1024;
        if self > Self::MOVING {
            return [SIDE; 2];
        }
        [viewport.width, viewport.height].map(|pixels| (pixels as usize).next_multiple_of(8).clamp(8, 2 * SIDE))
    }

    /// The first budget: the most strokes and nodes that are looked into.
    pub(super) fn budget(self) -> f32 {
        if self > Self::MOVING {
            return FIRST_BUDGET;
        }
        let whole = (COARSEST_BUDGET << (self.0 / 2)) as f32;
        if self.0.is_multiple_of(2) { whole } else { whole * core::f32::consts::SQRT_2 }
    }

    /// The units of work that a picture should take; 0 for coarse pictures, whose budget is fixed.
    pub(super) fn work(self, viewport: Viewport) -> i64 {
        let worth = LEAST_WORK.max(i64::from(viewport.width) * i64::from(viewport.height) * WORK_PER_PIXEL);
        match self {
            Self(..=14) => 0,
            Self(15 | 16) => worth,
            _ => worth * BEST_FACTOR,
        }
    }
}

/// The units of work for each pixel of a fine picture.
const WORK_PER_PIXEL: i64 = 2;
/// The least units of work for a fine picture of any size.
const LEAST_WORK: i64 = 3_000_000;
/// The work of [`Quality::BEST`], relative to [`Quality::FINEST`].
const BEST_FACTOR: i64 = 8;
/// The first budget of fine pictures, in strokes and nodes.
const FIRST_BUDGET: f32 = 40_000.0;
/// The budget of the coarsest picture, in strokes and nodes.
const COARSEST_BUDGET: u32 = 1500;
