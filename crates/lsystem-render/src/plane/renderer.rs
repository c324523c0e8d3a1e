//! The renderer of drawings in the plane.

use super::RenderStats;
use super::blend::Blend;
use super::opaque_picture::Plan;
use super::view::View;
use crate::pane::{Pane, Pass};
use crate::viewport::{Detail, Viewport};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;
use lsystem_syntax::Style;
use std::sync::Arc;

/// Makes pictures of a drawing in the plane, one after the other, in the same memory.
#[derive(Default)]
pub struct Renderer {
    drawing: Option<Arc<Drawing>>,
    pub(super) blend: Blend,
    /// Whether the background is left out.
    is_transparent: bool,
    spent: u64,
}

impl Renderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A renderer for small pictures, without the memory that bottom-up pictures take.
    #[must_use]
    pub fn light() -> Self {
        let mut renderer = Self::default();
        renderer.blend.opaque.picture.is_light = true;
        renderer
    }

    /// The renderer of pictures without the background. Opaque ink has the mean colour of a pixel's covered subsamples,
    /// and their share as its opacity. Ink that adds up has the least opacity with which it looks the same over the
    /// style's background: over another background it looks different. So does the default ink where it shades.
    #[must_use]
    pub fn transparent(self) -> Self {
        Self { is_transparent: true, ..self }
    }

    /// Forgets what pictures have left for later pictures of the same drawing, which are then the same whatever was
    /// drawn before.
    pub fn forget(&mut self) {
        self.blend.forget();
    }

    /// Takes the drawing of the next pictures. The steps of the first picture prepare the drawing.
    pub fn load(&mut self, drawing: Arc<Drawing>) {
        self.blend.clear();
        self.drawing = Some(drawing);
    }

    /// Starts a picture of the loaded drawing. An unfinished picture is given up. A viewport that is too large is cut
    /// to [`Viewport::within_limits`].
    pub fn begin(&mut self, style: &Style, viewport: Viewport, view: View) {
        self.begin_with(style, viewport, view, Detail::Fine, None);
    }

    /// As [`Renderer::begin`], in coarse or in fine `detail`. If `upto` is given, only the first `upto` segments are
    /// shown, for playback.
    pub fn begin_with(&mut self, style: &Style, viewport: Viewport, view: View, detail: Detail, upto: Option<u128>) {
        let (viewport, is_transparent) = (viewport.within_limits(), self.is_transparent);
        let pane = Pane::whole(viewport);
        let pass = Pass::Only;
        self.start(Plan { style: style.clone(), viewport, view, detail, upto, pane, pass, is_transparent });
    }

    /// As [`Renderer::begin_with`] in fine detail, for one of the [panes](Pass::all) of the picture. The pixels are
    /// those of the pane. Panes that begin at multiples of 16 pixels have the same subsamples as the whole picture. The
    /// picture may have [`MAX_PICTURE_SIDE`](lsystem_base::MAX_PICTURE_SIDE) pixels each way, and a pane
    /// [`MAX_PICTURE_PIXELS`](lsystem_base::MAX_PICTURE_PIXELS) in all.
    pub fn begin_pane(
        &mut self,
        style: &Style,
        viewport: Viewport,
        view: View,
        upto: Option<u128>,
        (pane, pass): (Pane, Pass),
    ) {
        let (detail, is_transparent) = (Detail::Fine, self.is_transparent);
        self.start(Plan { style: style.clone(), viewport, view, detail, upto, pane, pass, is_transparent });
    }

    fn start(&mut self, plan: Plan) {
        let viewport = plan.viewport.within_sides();
        let pane = if plan.pass == Pass::Survey { plan.pane } else { plan.pane.within(viewport).within_limits() };
        self.blend.begin(Plan { viewport, pane, ..plan });
    }

    /// Goes on with the picture for about `work` units, as [`Meter`] counts them, and for at most [`Meter::PIECE`]
    /// more.
    pub fn step(&mut self, work: usize) -> Progress {
        let mut meter = Meter::new(work as u64);
        let progress = self.blend.step(self.drawing.as_deref(), &mut meter);
        self.spent += meter.spent();
        progress
    }

    /// The picture so far: RGBA, 8 bits each, opaque unless [`transparent`](Self::transparent), from the upper left
    /// corner row by row. The size is that of the picture once a step has prepared the drawing.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        self.blend.pixels()
    }

    /// The work and the memory of the picture so far.
    #[must_use]
    pub fn stats(&self) -> RenderStats {
        self.blend.stats()
    }

    /// The units of work of all steps so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }
}
