//! The memory that pictures in space take, known before they are made.

use super::SolidRenderer;
use super::scene::{Line, Link, Node, Sample};
use crate::Viewport;
use lsystem_drawing::{Drawing, SceneSize, Solid};

// What the drawing is counted to need for its pictures is enough.
const _: () = assert!(size_of::<Node>() <= SceneSize::NODE && size_of::<Sample>() <= SceneSize::SAMPLE);
const _: () = assert!(size_of::<Link>() <= SceneSize::LINK && size_of::<Line>() <= SceneSize::LINE);

impl SolidRenderer {
    /// The bytes that the drawing is made ready in for its pictures, [counted with it](lsystem_drawing::Drawing::bytes);
    /// what shows only its first segments takes as many again at most.
    #[must_use]
    pub fn scene_bytes(drawing: &Drawing<Solid>) -> u64 {
        drawing.scene.bytes(drawing.memoised)
    }

    /// The most bytes that a renderer takes which makes pictures of this size, whole and halved and in panes, beside the
    /// drawing and what is [counted with it](lsystem_drawing::Drawing::bytes).
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
