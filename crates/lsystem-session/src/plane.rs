//! The viewer of drawings in the plane. A sketch, with half the width and height while its cost is
//! unknown, comes first if the fine one takes longer than a part of a frame.

use crate::budget::{affordable, halved};
use crate::pace::{STEP, WHOLE, WORK};
use crate::surface::{Clock, Screen};
use crate::viewer::{CanvasPicture, Only, PictureSettings, Viewer};
use lsystem::render::{Closeup, Detail};
use lsystem::{Drawing, Progress, Renderer, View, Viewport};
use std::sync::Arc;

/// The milliseconds that a fine picture may take before a coarse one is shown instead: a step, since the page gets the next
/// picture no earlier.
const PATIENCE: f64 = STEP;
/// The same for the first picture of a drawing whose cost is unknown: the coarse picture is to be there within the frame.
const FIRST_PATIENCE: f64 = 5.0;

/// The number of pictures that start coarse after a slow fine picture. Then a fine one is tried again, because the
/// slowness may have been accidental. If it was not, one picture in five comes later than the others, by one step.
const SKETCHES: u8 = 4;

/// A drawing in the plane and its picture.
pub(crate) struct PlaneView {
    drawing: Option<Arc<Drawing>>,
    /// The drawing that the renderers have: the whole, or the surroundings of a segment.
    shown: Option<Arc<Drawing>>,
    closeup: Option<Closeup>,
    fine: Renderer,
    /// The renderer of coarse pictures. `None` for small pictures, which use `fine` for both and always start coarse.
    coarse: Option<Renderer>,
    settings: Option<PictureSettings>,
    stage: Stage,
    /// Milliseconds spent on the fine picture so far.
    spent: f64,
    /// Milliseconds spent on the coarse picture so far.
    sketching: f64,
    /// The number of pictures that will start coarse, after a slow fine one.
    sketches: u8,
    /// Whether no picture of the drawing is finished yet.
    is_unknown: bool,
    /// Whether coarse pictures have half the width and height: until one takes so little that a whole one is in time too.
    is_half: bool,
}

/// The stage of a picture.
#[derive(Clone, Copy, PartialEq)]
enum Stage {
    /// The coarse picture is in the making. `begun`: the fine picture has already begun.
    Coarse { begun: bool },
    /// The fine picture is in the making. `sketched`: the coarse picture is shown.
    Fine { sketched: bool },
    /// The fine picture is shown.
    Done,
}

impl Default for PlaneView {
    fn default() -> Self {
        Self {
            drawing: None,
            shown: None,
            closeup: None,
            fine: Renderer::new(),
            coarse: Some(Renderer::new()),
            settings: None,
            stage: Stage::Done,
            spent: 0.0,
            sketching: 0.0,
            sketches: 0,
            is_unknown: true,
            is_half: true,
        }
    }
}

impl<S: Screen> Viewer<S> for PlaneView {
    fn begin(&mut self, settings: PictureSettings) {
        let settings = self.aimed(settings);
        self.settings = Some(self.within_room(settings));
        if self.sketches > 0 || self.coarse.is_none() {
            self.sketches = self.sketches.saturating_sub(1);
            self.begin_coarse(false);
        } else {
            self.begin_fine();
        }
    }

    fn paint(&mut self, clock: &Clock, surface: &mut S) -> Result<Option<CanvasPicture>, S::Error> {
        let Some(settings) = &self.settings else { return Ok(None) };
        let &PictureSettings { viewport, scale, .. } = settings;
        match self.stage {
            Stage::Done => Ok(None),
            Stage::Coarse { begun } => {
                let start = clock();
                let viewport = self.coarse_viewport(viewport);
                let coarse = self.coarse.as_mut().unwrap_or(&mut self.fine);
                let progress = coarse.step(WORK);
                self.sketching += clock() - start;
                if progress == Progress::More {
                    return Ok(None);
                }
                surface.show(coarse.pixels(), viewport)?;
                self.is_half = self.sketching > if self.is_half { WHOLE } else { STEP };
                if !begun {
                    self.begin_fine();
                }
                self.stage = Stage::Fine { sketched: true };
                Ok(Some(CanvasPicture { scale, ..CanvasPicture::default() }))
            }
            Stage::Fine { sketched } => {
                let start = clock();
                let progress = self.fine.step(WORK);
                self.spent += clock() - start;
                if progress == Progress::Done {
                    self.sketches = if self.spent > PATIENCE { SKETCHES } else { 0 };
                    self.stage = Stage::Done;
                    self.is_unknown = false;
                    surface.show(self.fine.pixels(), viewport)?;
                    let rough = self.fine.stats().is_rough();
                    let only = Only::of(self.fine.pixels(), &settings.style);
                    return Ok(Some(CanvasPicture { complete: true, scale, rough, only, ..CanvasPicture::default() }));
                }
                if self.spent > if self.is_unknown { FIRST_PATIENCE } else { PATIENCE } {
                    self.sketches = SKETCHES;
                    if !sketched {
                        self.begin_coarse(true);
                    }
                }
                Ok(None)
            }
        }
    }

    fn is_done(&self) -> bool {
        self.stage == Stage::Done
    }

    fn is_refining(&self) -> bool {
        self.stage == Stage::Fine { sketched: true }
    }
}

impl PlaneView {
    pub(crate) fn small() -> Self {
        Self { fine: Renderer::light(), coarse: None, ..Self::default() }
    }

    /// Takes the drawing of the next pictures.
    pub(crate) fn load(&mut self, drawing: Arc<Drawing>) {
        self.stage = Stage::Done;
        self.closeup = None;
        // A drawing with other angles takes about as long as the previous one.
        if self.drawing.as_ref().is_none_or(|former| former.block_count() != drawing.block_count()) {
            (self.is_unknown, self.is_half) = (true, true);
        }
        self.show(drawing.clone());
        self.drawing = Some(drawing);
    }

    /// Gives the renderers a drawing.
    fn show(&mut self, drawing: Arc<Drawing>) {
        if self.shown.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, &drawing)) {
            return;
        }
        self.fine.load(drawing.clone());
        if let Some(coarse) = &mut self.coarse {
            coarse.load(drawing.clone());
        }
        self.shown = Some(drawing);
    }

    pub(crate) fn closeup(&self) -> Option<&Closeup> {
        self.closeup.as_ref()
    }

    /// The settings for what the renderers get: a close-up, if the view has a place on a segment as its origin and the drawing has
    /// that segment.
    fn aimed(&mut self, mut settings: PictureSettings) -> PictureSettings {
        let Some(whole) = &self.drawing else { return settings };
        let mut shown = whole.clone();
        if let Some(origin) = &settings.origin {
            let known = self.closeup.take().filter(|known| known.origin == *origin);
            let closeup = self.closeup.insert(known.unwrap_or_else(|| Closeup::new(whole.clone(), origin.clone())));
            let near = closeup.show(settings.viewport, settings.vantage.view);
            settings.upto = settings.upto.zip(near.as_ref()).map(|(upto, (near, _))| near.among_first(upto));
            settings.vantage.view = match near {
                Some((near, view)) => {
                    shown = near.drawing.clone();
                    view
                }
                None => View::default(),
            };
        }
        self.show(shown);
        settings
    }

    pub(crate) fn forget(&mut self) {
        *self = if self.coarse.is_some() { Self::default() } else { Self::small() };
    }

    /// The settings with as many pixels as fit the memory budget.
    fn within_room(&self, settings: PictureSettings) -> PictureSettings {
        let Some(drawing) = &self.shown else { return settings };
        let most = |viewport| {
            let most = |detail| Renderer::most_bytes(drawing, &settings.style, viewport, detail);
            most(Detail::Fine) + most(Detail::Sketch)
        };
        PictureSettings { viewport: affordable(settings.viewport, drawing.bytes(), most), ..settings }
    }

    fn begin_fine(&mut self) {
        if let Some(settings) = &self.settings {
            begin(&mut self.fine, settings, settings.viewport, Detail::Fine);
        }
        self.spent = 0.0;
        self.stage = Stage::Fine { sketched: false };
    }

    /// The size of coarse pictures. A small picture is shown in its own size.
    fn coarse_viewport(&self, viewport: Viewport) -> Viewport {
        if self.is_half && self.coarse.is_some() { halved(viewport) } else { viewport }
    }

    fn begin_coarse(&mut self, begun: bool) {
        if let Some(settings) = &self.settings {
            let viewport = self.coarse_viewport(settings.viewport);
            begin(self.coarse.as_mut().unwrap_or(&mut self.fine), settings, viewport, Detail::Sketch);
        }
        self.sketching = 0.0;
        self.stage = Stage::Coarse { begun };
    }
}

/// Starts a picture.
fn begin(renderer: &mut Renderer, settings: &PictureSettings, viewport: Viewport, detail: Detail) {
    let PictureSettings { style, vantage, upto, .. } = settings;
    renderer.begin_with(style, viewport, vantage.view, detail, *upto);
}
