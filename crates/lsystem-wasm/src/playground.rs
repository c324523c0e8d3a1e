//! The page's handle: keeps a system between edits and works in steps that end on time.

use crate::clock::Clock;
use crate::painter::{Painter, Scene};
use crate::reading::Written;
use crate::report::{Report, legend_of, problems};
use crate::surface::Surface;
use crate::{LIMITS, from_js, to_js};
use lsystem::{
    Definition, Diagnostic, Drawer, Drawing, Kind, Progress, Space, System, View, Viewport, count_segments,
    count_symbols, describe, fitted_scale, kind, why_empty,
};
use serde::Serialize;
use std::sync::Arc;
use wasm_bindgen::prelude::*;
use web_sys::OffscreenCanvas;

/// Work units between two looks at the clock: well under a millisecond each.
pub(crate) const WORK: usize = 16_384;

/// An L-system between edits: its drawing, and the picture on the canvas.
#[wasm_bindgen]
pub struct Playground {
    painter: Painter,
    clock: Clock,
    /// What the shown drawing is of.
    pub(crate) definition: Definition,
    pub(crate) system: Option<System>,
    pub(crate) drawing: Option<Arc<Drawing>>,
    pub(crate) written: Option<Written>,
    /// The drawing that is being built.
    drawer: Option<Drawer>,
    /// The same for what leaves the plane; where it has a drawing, `drawing` is none.
    #[cfg(feature = "full")]
    pub(crate) solid: crate::solid::SolidView,
    pub(crate) report: Report,
    /// Whether the page has not seen the report yet.
    news: bool,
    pub(crate) viewport: Viewport,
    pub(crate) view: View,
    /// How many segments the picture shows; all of them without it.
    pub(crate) upto: Option<u128>,
    picture: Picture,
}

/// How far the picture is.
#[derive(Clone, Copy, PartialEq)]
enum Picture {
    /// What is on the canvas is out of date.
    Stale,
    /// The painter has been told.
    Begun,
}

/// The answer of [`Playground::step`].
#[derive(Serialize)]
struct Step<'a> {
    report: Option<&'a Report>,
    drawn: Option<Drawn>,
    idle: bool,
}

#[derive(Serialize)]
pub(crate) struct Drawn {
    /// Whether nothing finer follows.
    pub(crate) complete: bool,
    /// Device pixels per fitted extent at zoom 1.
    pub(crate) scale: f64,
}

#[wasm_bindgen]
impl Playground {
    /// A playground that paints `canvas`.
    ///
    /// # Errors
    /// Throws where the canvas has no 2D context.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        Ok(Self {
            painter: Painter::new(Surface::new(canvas)?),
            clock: Clock::new(),
            definition: Definition::default(),
            system: None,
            drawing: None,
            written: None,
            drawer: None,
            #[cfg(feature = "full")]
            solid: crate::solid::SolidView::default(),
            report: Report::default(),
            news: false,
            viewport: Viewport { width: 0, height: 0, ratio: 1.0 },
            view: View::default(),
            upto: None,
            picture: Picture::Begun,
        })
    }

    /// Takes a new state of the system and says what it means; the drawing follows in [`Playground::step`]. Where
    /// the definition is wrong the former system stays.
    ///
    /// # Errors
    /// Throws where the argument is not a definition at all.
    pub fn define(&mut self, definition: JsValue) -> Result<JsValue, JsValue> {
        let definition = from_js(definition)?;
        let (system, diagnostics) = System::new(&definition);
        let diagnostics = problems(&diagnostics, &definition, "");
        let Some(system) = system else {
            return to_js(&Report { diagnostics, ..Report::default() });
        };
        let n = definition.iterations;
        let same_drawing = self.definition.iterations == n
            && (self.system.as_ref()).is_some_and(|former| {
                former.seed == system.seed
                    && former.program == system.program
                    && former.rules == system.rules
                    && former.turtle == system.turtle
            });
        let known = Report {
            ok: true,
            diagnostics,
            kind: kind(&system),
            stochastic: system.is_stochastic(),
            solid: system.is_solid(),
            symbols: count_symbols(&system, n).map(|count| count.to_string()),
            segments: count_segments(&system, n).map(|count| count.to_string()),
            legend: legend_of(&system),
            empty: why_empty(&system, n),
            ..Report::default()
        };
        if same_drawing && (!self.built() || self.is_drawn()) {
            let former = core::mem::replace(&mut self.report, known);
            self.report.memoised = former.memoised;
            self.report.blocks = former.blocks;
            self.report.segments = former.segments;
            self.report.symbols = former.symbols;
            self.report.largest = former.largest;
            self.report.description = former.description;
        } else {
            self.upto = None;
            self.report = known;
            self.start(&system, n);
        }
        self.picture = Picture::Stale;
        self.written = None;
        self.definition = definition;
        self.system = Some(system);
        to_js(&self.report)
    }

    /// Says where to look: the canvas size in device pixels, device pixels per CSS pixel, and the view, relative to
    /// the fitted one, whose `x` and `y` are sums of two numbers each.
    #[expect(clippy::too_many_arguments, reason = "an object would have to be read field by field")]
    pub fn view(&mut self, width: u32, height: u32, ratio: f64, x: f64, y: f64, zoom: f64, fine_x: f64, fine_y: f64) {
        let view = View { x, y, zoom, fine: [fine_x, fine_y] };
        let viewport = Viewport { width, height, ratio }.within_limits();
        if (view, viewport) != (self.view, self.viewport) {
            (self.view, self.viewport) = (view, viewport);
            self.picture = Picture::Stale;
        }
    }

    /// Shows only the first `upto` segments, the turtle on its way; all of them without a number. A new drawing starts
    /// with all.
    pub fn play(&mut self, upto: Option<u128>) {
        if upto != self.upto {
            self.upto = upto;
            self.picture = Picture::Stale;
        }
    }

    /// Whether no drawing is being built.
    #[wasm_bindgen(getter)]
    pub fn built(&self) -> bool {
        #[cfg(feature = "full")]
        if self.solid.drawer.is_some() {
            return false;
        }
        self.drawer.is_none()
    }

    /// Works for about `budget` milliseconds: `{report, drawn: {complete, scale}, idle}`, parts null without news.
    ///
    /// # Errors
    /// Throws where the canvas refuses the picture.
    pub fn step(&mut self, budget: f64) -> Result<JsValue, JsValue> {
        let end = self.clock.now() + budget;
        let mut drawn = None;
        while drawn.is_none() && !self.is_idle() {
            if !self.built() {
                self.build();
            } else {
                drawn = self.paint()?;
            }
            if self.clock.now() >= end {
                break;
            }
        }
        let report = core::mem::take(&mut self.news).then_some(&self.report);
        to_js(&Step { report, drawn, idle: self.is_idle() })
    }
}

impl Playground {
    pub(crate) fn shown_iterations(&self) -> u32 {
        self.definition.iterations
    }

    /// Starts building a drawing.
    fn start(&mut self, system: &System, n: u32) {
        self.drawer = None;
        #[cfg(feature = "full")]
        self.solid.stop();
        if !system.is_solid() {
            self.drawer = Some(Drawer::new(system, n, LIMITS));
            return;
        }
        #[cfg(feature = "full")]
        self.solid.start(system, n);
        self.report.beyond = cfg!(not(feature = "full"));
    }

    fn is_drawn(&self) -> bool {
        #[cfg(feature = "full")]
        if self.solid.drawing.is_some() {
            return true;
        }
        self.drawing.is_some()
    }

    fn is_idle(&self) -> bool {
        self.built() && (self.picture == Picture::Begun && self.is_painted() || !self.is_visible())
    }

    /// Whether nothing finer than what is on the canvas follows.
    fn is_painted(&self) -> bool {
        #[cfg(feature = "full")]
        if self.solid.drawing.is_some() {
            return self.solid.is_done();
        }
        self.painter.is_done()
    }

    /// Whether there is something to paint and somewhere to paint it.
    fn is_visible(&self) -> bool {
        self.is_drawn() && self.viewport.width > 0 && self.viewport.height > 0
    }

    /// Goes on with the drawing that is being built.
    fn build(&mut self) {
        #[cfg(feature = "full")]
        if self.solid.drawer.is_some() {
            return self.build_solid();
        }
        let (Some(system), Some(mut drawer)) = (&self.system, self.drawer.take()) else { return };
        if drawer.step(WORK as u64) == Progress::More {
            self.drawer = Some(drawer);
            return;
        }
        match drawer.finish() {
            Ok(drawing) => {
                describe_drawing(&mut self.report, system, self.definition.iterations, &drawing, drawing.bounds());
                let drawing = Arc::new(drawing);
                self.painter.load(drawing.clone());
                self.drawing = Some(drawing);
                #[cfg(feature = "full")]
                self.solid.forget();
            }
            Err(limit) => self.refuse(limit),
        }
        self.news = true;
        self.picture = Picture::Stale;
    }

    /// Goes on with the drawing in space that is being built.
    #[cfg(feature = "full")]
    fn build_solid(&mut self) {
        let (Some(system), Some(outcome)) = (&self.system, self.solid.build()) else { return };
        match outcome {
            Ok(drawing) => {
                let bounds = drawing.bounds().map(|[low, high]| [low[0], low[1], high[0], high[1]]);
                describe_drawing(&mut self.report, system, self.definition.iterations, &drawing, bounds);
                self.drawing = None;
            }
            Err(limit) => self.refuse(limit),
        }
        self.news = true;
        self.picture = Picture::Stale;
    }

    /// What is shown has to be painted anew.
    #[cfg(feature = "full")]
    pub(crate) fn outdate(&mut self) {
        self.picture = Picture::Stale;
    }

    /// Goes on with the picture of a drawing in space; what is on the canvas after that, if anything new is.
    #[cfg(feature = "full")]
    fn paint_solid(&mut self) -> Result<Option<Drawn>, JsValue> {
        let Some(system) = &self.system else { return Ok(None) };
        if self.picture == Picture::Stale {
            self.solid.begin(&system.style, self.viewport);
            self.picture = Picture::Begun;
        }
        self.solid.paint(&system.style, self.viewport, &self.clock, &self.painter.surface)
    }

    fn refuse(&mut self, limit: Diagnostic) {
        if let Kind::Limit { largest, .. } = limit.kind {
            self.report.largest = largest;
        }
        self.report.diagnostics.extend(problems(&[limit], &self.definition, ""));
    }

    /// Goes on with the picture; what is on the canvas after that, if anything new is.
    fn paint(&mut self) -> Result<Option<Drawn>, JsValue> {
        #[cfg(feature = "full")]
        if self.solid.drawing.is_some() {
            return self.paint_solid();
        }
        let (Some(system), Some(drawing)) = (&self.system, &self.drawing) else { return Ok(None) };
        if self.picture == Picture::Stale {
            let (style, viewport, view, upto) = (system.style.clone(), self.viewport, self.view, self.upto);
            self.painter.begin(Scene { style, viewport, view, upto });
            self.picture = Picture::Begun;
        }
        let shown = self.painter.step(&self.clock)?;
        Ok(shown.map(|complete| Drawn { complete, scale: fitted_scale(drawing, self.viewport) }))
    }
}

/// Completes a report with what its drawing tells.
fn describe_drawing<S: Space>(
    report: &mut Report,
    system: &System,
    n: u32,
    drawing: &Drawing<S>,
    bounds: Option<[f64; 4]>,
) {
    // Where counts depend on chance the drawing has been materialised, and its count is exact.
    let segments = count_segments(system, n).unwrap_or_else(|| drawing.segment_count().into());
    if let Some(symbols) = drawing.symbol_count() {
        report.symbols = Some(symbols.to_string());
    }
    report.memoised = Some(drawing.is_memoised());
    report.blocks = Some(drawing.block_count());
    report.description = describe(system, n, &segments, bounds);
    report.segments = Some(segments.to_string());
}

impl core::fmt::Debug for Playground {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Playground").field("definition", &self.definition).finish_non_exhaustive()
    }
}
