//! The memory that a picture in space takes, computed before the picture is made.

use super::lighting::Lighting;
use super::renderer::SolidRenderer;
use super::scene::{Link, SampleStroke, SceneLine, SceneNode};
use crate::Viewport;
use crate::ink::TONE_BYTES;
use lsystem_drawing::{Drawing, SceneSize, Solid};

// The sizes with which a drawing counts the memory of its scene are large enough.
const _: () = assert!(size_of::<SceneNode>() <= SceneSize::NODE && size_of::<SampleStroke>() <= SceneSize::SAMPLE);
const _: () = assert!(size_of::<Link>() <= SceneSize::LINK && size_of::<SceneLine>() <= SceneSize::LINE);

/// The bytes of a sample: a depth and a colour.
pub(super) const SAMPLE_BYTES: u64 = 8;

impl SolidRenderer {
    /// The bytes of the scene made from the drawing, which are [counted with it](lsystem_drawing::Drawing::bytes). A
    /// scene that shows only the first segments takes at most as many again.
    #[must_use]
    pub fn scene_bytes(drawing: &Drawing<Solid>) -> u64 {
        drawing.scene.bytes(drawing.memoised)
    }

    /// The most bytes that a renderer takes for pictures of this size, whole, of half the sides, and in panes, without
    /// the drawing and the scene that is [counted with it](lsystem_drawing::Drawing::bytes).
    #[must_use]
    pub fn most_bytes(viewport: Viewport) -> u64 {
        /// The bytes of a pixel.
        const PIXEL: u64 = 4;
        /// The bytes of a pixel's sums of ink.
        const SUMS: u64 = 16;
        let tile = |samples: u64| SAMPLE_BYTES * samples + samples / 8;
        let pixels = u64::from(viewport.width) * u64::from(viewport.height);
        // A tile has at most 1024 samples each way at rest, and 2048 while the camera moves.
        let (rest, moving) = (tile(1 << 20), |pixels: u64| tile(pixels.clamp(1 << 20, 1 << 22)));
        let walk = |pixels: u64| PIXEL * pixels + moving(pixels);
        let opaque = walk(pixels) + walk(pixels / 4) + PIXEL * pixels + rest + Lighting::most_bytes(viewport);
        let additive = |pixels: u64| (PIXEL + SUMS) * pixels + TONE_BYTES;
        opaque.max(2 * additive(pixels) + additive(pixels / 4))
    }
}
