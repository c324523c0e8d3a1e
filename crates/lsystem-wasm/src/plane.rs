//! The viewer of drawings in the plane. A coarse picture comes first if the fine one takes longer than a frame.

use crate::budget::affordable;
use crate::clock::Clock;
use crate::report::Report;
use crate::surface::CanvasSurface;
use crate::viewer::{Drawn, NOTHING, Only, PictureSettings, Snapshot, Viewer, WORK, describe_drawing, step_drawer};
use lsystem::Viewport;
use lsystem::derive::Counter;
use lsystem::render::{Detail, Pane, Pass, fitted_scale};
use lsystem::{Diagnostic, Drawer, Drawing, Limits, Progress, Renderer, System};
use std::sync::Arc;
use wasm_bindgen::JsValue;

/// The milliseconds that a fine picture may take before a coarse one is shown instead.
const PATIENCE: f64 = 8.0;

/// The number of pictures that start coarse after a slow fine picture. Then a fine one is tried again, because the
/// slowness may have been accidental.
const SKETCHES: u8 = 4;

/// The most pixels of a band of a picture for a file. A pixel with subsamples takes up to 24 bytes, so a band takes 24
/// MiB.
const BAND: u32 = 1 << 20;

/// The side of a cell, in pixels. Panes that begin at multiples of this have the same subsamples as the whole picture.
const CELL: u32 = 16;

/// A drawing in the plane and its picture.
pub(crate) struct PlaneView {
    pub(crate) drawing: Option<Arc<Drawing>>,
    /// The drawing that is being built.
    drawer: Option<Box<Drawer>>,
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
            drawer: None,
            fine: Renderer::new(),
            coarse: Some(Renderer::new()),
            settings: None,
            stage: Stage::Done,
            spent: 0.0,
            sketches: 0,
        }
    }
}

impl Viewer for PlaneView {
    fn start(&mut self, system: &System, n: u32, limits: Limits) {
        self.drawer = Some(Box::new(Drawer::new(system, n, limits)));
    }

    fn stop(&mut self) {
        self.drawer = None;
    }

    fn build(&mut self) -> Option<Result<(), Diagnostic>> {
        Some(step_drawer(&mut self.drawer)?.map(|drawing| {
            self.stage = Stage::Done;
            self.fine.load(drawing.clone());
            if let Some(coarse) = &mut self.coarse {
                coarse.load(drawing.clone());
            }
            self.drawing = Some(drawing);
        }))
    }

    fn forget(&mut self) {
        self.drawing = None;
    }

    fn describe(&self, report: &mut Report, system: &System, n: u32, counted: Option<&Counter>) {
        if let Some(drawing) = &self.drawing {
            describe_drawing(report, system, n, drawing, drawing.bounds(), counted);
        }
    }

    fn begin(&mut self, settings: PictureSettings) {
        self.settings = Some(self.within_room(settings));
        if self.sketches > 0 || self.coarse.is_none() {
            self.sketches = self.sketches.saturating_sub(1);
            self.begin_coarse(false);
        } else {
            self.begin_fine();
        }
    }

    fn paint(&mut self, clock: &Clock, surface: &CanvasSurface) -> Result<Option<Drawn>, JsValue> {
        let (Some(drawing), Some(settings)) = (&self.drawing, &self.settings) else { return Ok(None) };
        let (viewport, scale) = (settings.viewport, fitted_scale(drawing, settings.screen));
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
                Ok(Some(Drawn { complete: false, scale, moving: false, rough: false, slow: false, only: None }))
            }
            Stage::Fine { sketched } => {
                let start = clock.now();
                let progress = self.fine.step(WORK);
                self.spent += clock.now() - start;
                if progress == Progress::Done {
                    self.sketches = if self.spent > PATIENCE { SKETCHES } else { 0 };
                    self.stage = Stage::Done;
                    surface.show(self.fine.pixels(), viewport)?;
                    let rough = self.fine.stats().is_rough();
                    let only = Only::of(self.fine.pixels(), &settings.style);
                    return Ok(Some(Drawn { complete: true, scale, moving: false, rough, slow: false, only }));
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

    fn snapshot(&self, settings: PictureSettings) -> Result<Box<dyn Snapshot>, &'static str> {
        let viewport = settings.viewport.within_limits();
        let settings = PictureSettings { viewport, ..settings };
        let mut renderer = Renderer::new();
        renderer.load(self.drawing.clone().ok_or(NOTHING)?);
        let rows = (BAND / viewport.width.max(1) / CELL).max(1) * CELL;
        let bands = [viewport.width, rows];
        let mut parts = Pass::all(settings.style.ink, viewport, bands);
        parts.reverse();
        let mut snapshot = PlaneSnapshot { renderer, settings, parts, part: (Pane::whole(viewport), Pass::Only) };
        snapshot.next();
        Ok(Box::new(snapshot))
    }
}

/// A picture for a file, made band by band.
struct PlaneSnapshot {
    renderer: Renderer,
    settings: PictureSettings,
    /// The bands left, the next one last.
    parts: Vec<(Pane, Pass)>,
    /// The present band.
    part: (Pane, Pass),
}

impl Snapshot for PlaneSnapshot {
    fn next(&mut self) -> bool {
        let Some(part) = self.parts.pop() else { return false };
        self.part = part;
        let PictureSettings { style, viewport, view, upto, .. } = &self.settings;
        self.renderer.begin_pane(style, *viewport, *view, *upto, part);
        true
    }

    fn step(&mut self) -> Progress {
        self.renderer.step(WORK)
    }

    fn band(&self) -> Option<(&[u8], Viewport, Pane)> {
        let (band, pass) = self.part;
        pass.shows().then(|| (self.renderer.pixels(), self.settings.viewport, band))
    }
}

impl PlaneView {
    pub(crate) fn small() -> Self {
        Self { fine: Renderer::light(), coarse: None, ..Self::default() }
    }

    /// The settings with as many pixels as fit the memory budget.
    fn within_room(&self, settings: PictureSettings) -> PictureSettings {
        let Some(drawing) = &self.drawing else { return settings };
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
    let PictureSettings { style, viewport, view, upto, .. } = settings;
    renderer.begin_with(style, *viewport, *view, detail, *upto);
}
