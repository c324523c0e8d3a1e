//! The viewer of drawings in the plane. A coarse picture comes first if the fine one takes longer than a frame.

use crate::budget::affordable;
use crate::pace::{STEP, WORK};
use crate::surface::{Clock, Surface};
use crate::viewer::{Drawn, Only, PictureSettings, Viewer};
use lsystem::render::{Closeup, Detail};
use lsystem::{Drawing, Progress, Renderer, View};
use std::sync::Arc;

/// The milliseconds that a fine picture may take before a coarse one is shown instead: a step, since the page gets the next
/// picture no earlier.
const PATIENCE: f64 = STEP;

/// The number of pictures that start coarse after a slow fine picture. Then a fine one is tried again, because the
/// slowness may have been accidental. If it was not, one picture in five comes later than the others, by one step.
const SKETCHES: u8 = 4;

/// A drawing in the plane and its picture.
pub(crate) struct PlaneView {
    drawing: Option<Arc<Drawing>>,
    /// What the renderers have: the drawing, or what lies around a segment.
    shown: Option<Arc<Drawing>>,
    closeup: Option<Closeup>,
    fine: Renderer,
    /// The renderer of coarse pictures. `None` for small pictures, which use `fine` for both and always start coarse.
    coarse: Option<Renderer>,
    settings: Option<PictureSettings>,
    stage: Stage,
    /// Milliseconds spent on the fine picture so far.
    spent: f64,
    /// The number of pictures that will start coarse, after a slow fine one.
    sketches: u8,
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
            sketches: 0,
        }
    }
}

impl<S: Surface> Viewer<S> for PlaneView {
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

    fn paint(&mut self, clock: &Clock, surface: &mut S) -> Result<Option<Drawn>, S::Error> {
        let Some(settings) = &self.settings else { return Ok(None) };
        let &PictureSettings { viewport, scale, .. } = settings;
        match self.stage {
            Stage::Done => Ok(None),
            Stage::Coarse { begun } => {
                let coarse = self.coarse.as_mut().unwrap_or(&mut self.fine);
                if coarse.step(WORK) == Progress::More {
                    return Ok(None);
                }
                surface.show(coarse.pixels(), viewport)?;
                if !begun {
                    self.begin_fine();
                }
                self.stage = Stage::Fine { sketched: true };
                Ok(Some(Drawn { scale, ..Drawn::default() }))
            }
            Stage::Fine { sketched } => {
                let start = clock();
                let progress = self.fine.step(WORK);
                self.spent += clock() - start;
                if progress == Progress::Done {
                    self.sketches = if self.spent > PATIENCE { SKETCHES } else { 0 };
                    self.stage = Stage::Done;
                    surface.show(self.fine.pixels(), viewport)?;
                    let rough = self.fine.stats().is_rough();
                    let only = Only::of(self.fine.pixels(), &settings.style);
                    return Ok(Some(Drawn { complete: true, scale, rough, only, ..Drawn::default() }));
                }
                if self.spent > PATIENCE {
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
            most(Detail::Fine) + most(Detail::Coarse)
        };
        PictureSettings { viewport: affordable(settings.viewport, drawing.bytes(), most), ..settings }
    }

    fn begin_fine(&mut self) {
        if let Some(settings) = &self.settings {
            begin(&mut self.fine, settings, Detail::Fine);
        }
        self.spent = 0.0;
        self.stage = Stage::Fine { sketched: false };
    }

    fn begin_coarse(&mut self, begun: bool) {
        if let Some(settings) = &self.settings {
            begin(self.coarse.as_mut().unwrap_or(&mut self.fine), settings, Detail::Coarse);
        }
        self.stage = Stage::Coarse { begun };
    }
}

/// Starts a picture.
fn begin(renderer: &mut Renderer, settings: &PictureSettings, detail: Detail) {
    let PictureSettings { style, viewport, vantage, upto, .. } = settings;
    renderer.begin_with(style, *viewport, vantage.view, detail, *upto);
}
