//! The size of a picture, and its subsamples.

use lsystem_base::{MAX_PICTURE_PIXELS, MAX_PICTURE_SIDE};
use lsystem_syntax::Style;

/// Empty space around a fitted drawing, as a part of the viewport's shorter side.
const MARGIN: f64 = 0.06;

/// The size of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// The width in device pixels.
    pub width: u32,
    /// The height in device pixels.
    pub height: u32,
    /// Device pixels in one CSS pixel.
    pub ratio: f64,
}

impl Viewport {
    /// The viewport, cut at the right and at the bottom to at most [`MAX_PICTURE_SIDE`] pixels each way and
    /// [`MAX_PICTURE_PIXELS`] in all.
    #[must_use]
    pub fn within_limits(self) -> Self {
        let Self { width, height, .. } = self.within_sides();
        Self { height: height.min(MAX_PICTURE_PIXELS / width.max(1)), width, ..self }
    }

    /// The viewport, cut to at most [`MAX_PICTURE_SIDE`] pixels each way: the size of a picture that is made in panes.
    #[must_use]
    pub fn within_sides(self) -> Self {
        let [width, height] = [self.width, self.height].map(|side| side.min(MAX_PICTURE_SIDE));
        Self { width, height, ..self }
    }

    /// The width and the height without the margins, in device pixels.
    pub(crate) fn usable(self) -> [f64; 2] {
        let [width, height] = [self.width, self.height].map(f64::from);
        let margin = 2.0 * MARGIN * width.min(height);
        [width - margin, height - margin]
    }

    /// The least width of strokes, in device pixels.
    pub(crate) fn least_width(self, style: &Style) -> f64 {
        let width = (style.min_width * self.ratio).max(1.0);
        if width.is_finite() { width } else { 1.0 }
    }
}

/// The subsamples of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// 4x4 subsamples in a pixel: smooth edges.
    #[default]
    Fine,
    /// One subsample in a pixel: rough edges, in a fraction of the time.
    Coarse,
    /// As coarse, with strokes and shades up to a pixel off: a picture that is shown only until a fine one is there.
    Sketch,
}

impl Detail {
    /// Subsamples along one side of a pixel.
    pub(crate) const fn samples(self) -> usize {
        match self {
            Self::Fine => 4,
            Self::Coarse | Self::Sketch => 1,
        }
    }
}
