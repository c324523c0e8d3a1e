//! The settings of a picture in space.

use super::camera::{Camera, Lens};
use super::effort::Effort;
use super::light::{Light, LightKind};
use super::quality::Quality;
use crate::{Pane, Viewport};
use lsystem_drawing::{Drawing, Solid, Widths};
use lsystem_syntax::{Ink, Style};

/// The settings of a picture, which only change when its budget does.
#[derive(Clone, Copy)]
pub(super) struct Setup {
    pub lens: Lens,
    pub light: Light,
    /// RGBA of samples that show nothing.
    pub background: [u8; 4],
    /// Samples along the side of a pixel.
    pub samples: usize,
    /// The width and the height of the whole picture, in samples.
    pub size: [f64; 2],
    /// The width and the height of a tile, in samples.
    pub side: [usize; 2],
    /// Whether there is only one tile.
    pub single: bool,
    /// The extent in samples below which blocks are dots.
    pub detail: f32,
    pub effort: Effort,
    /// Whether only a pane is made, whose budget is set by the caller.
    pub pane: bool,
    /// The upper left corner of the pane in the picture, in samples.
    pub corner: [f64; 2],
    /// Half the smallest stroke width, in samples.
    pub hairline: f64,
    pub widths: Widths,
    /// How far a primitive reaches beyond its outline, in samples.
    pub slack: f32,
}

impl Setup {
    /// The settings of a pane; `budget` is given if the pane is one of several of a picture.
    pub(super) fn new(
        drawing: &Drawing<Solid>,
        style: &Style,
        viewport: Viewport,
        camera: &Camera,
        quality: Quality,
        (pane, budget): (Pane, Option<f32>),
        background: [u8; 4],
    ) -> Self {
        let is_additive = style.ink == Ink::Density;
        let samples = if is_additive { 1 } else { quality.samples() };
        let lens = Lens::new(drawing, viewport, camera, samples as f64);
        let size = [viewport.width, viewport.height].map(|pixels| f64::from(pixels) * samples as f64);
        let side = quality.tile(viewport);
        let effort = Effort::new(quality, viewport);
        let kind = if is_additive {
            LightKind::None
        } else if quality.has_shadows(style) {
            LightKind::Full
        } else {
            LightKind::Simple
        };
        Self {
            lens,
            light: Light::new(style, &lens, camera.fade, kind),
            background,
            samples,
            size,
            side,
            single: (0..2).all(|i| side[i] as f64 >= size[i]),
            detail: quality.detail() as f32,
            effort: budget.map_or(effort, |budget| effort.with_budget(budget)),
            pane: budget.is_some(),
            corner: [pane.x, pane.y].map(|pixels| f64::from(pixels) * samples as f64),
            hairline: viewport.least_width(style) * samples as f64 / 2.0,
            widths: Widths::new(drawing.width),
            slack: 0.0,
        }
    }

    /// The settings of a depth picture of `size` samples, through a lens; `scale` is the number of these samples along
    /// the side of a pixel, and `more` a factor of the budget. There is `room` for other depth pictures.
    pub(super) fn depths(
        drawing: &Drawing<Solid>,
        style: &Style,
        viewport: Viewport,
        (lens, size, scale, more): (Lens, [usize; 2], f64, f32),
        room: [usize; 2],
    ) -> Self {
        let quality = Quality::MOVING;
        Self {
            lens,
            light: Light::new(style, &lens, 0.0, LightKind::None),
            background: [0; 4],
            samples: 1,
            size: size.map(|count| count as f64),
            side: room,
            single: true,
            detail: quality.detail() as f32,
            effort: Effort::new(quality, viewport).with_budget(more * quality.budget()),
            pane: true,
            corner: [0.0; 2],
            hairline: (viewport.least_width(style) * scale / 2.0).max(0.5),
            widths: Widths::new(drawing.width),
            slack: 0.0,
        }
    }
}
