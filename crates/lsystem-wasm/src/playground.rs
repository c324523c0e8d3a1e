//! The page's handle: keeps a system between edits and works in steps that end on time.

use crate::budget::{LIMITS, SMALL};
use crate::clock::Clock;
use crate::report::{Report, compile, legend_of, problems};
use crate::surface::CanvasSurface;
use crate::viewer::{Drawn, PictureSettings, Views, WORK};
use crate::{from_js, to_js};
use lsystem::derive::Counter;
use lsystem::drawing::{FigureDrawer, kind, why_empty};
use lsystem::render::fitted_scale;
use lsystem::syntax::Kind;
use lsystem::{Camera, Definition, Diagnostic, Figure, Limits, Progress, System, Vantage, View, Viewport};
use serde::Serialize;
use wasm_bindgen::prelude::*;
use web_sys::OffscreenCanvas;

/// An L-system between edits: its drawing, and the picture on the canvas.
#[wasm_bindgen]
pub struct Playground {
    surface: CanvasSurface,
    pub(crate) clock: Clock,
    pub(crate) definition: Definition,
    pub(crate) system: Option<System>,
    /// The remembered derivation, after [`Playground::remember`].
    pub(crate) history: Option<lsystem::derive::History>,
    pub(crate) views: Views,
    /// The limits of drawings.
    limits: Limits,
    /// The drawing that is being built.
    drawer: Option<FigureDrawer>,
    /// The shown drawing.
    pub(crate) shown: Option<Figure>,
    pub(crate) report: Report,
    /// The counters of symbols and segments. Long counts continue when there is nothing else to do.
    counters: Option<[Counter; 2]>,
    /// Whether the report has changed since the page got it.
    is_report_new: bool,
    pub(crate) viewport: Viewport,
    pub(crate) vantage: Vantage,
    /// The number of segments shown; `None` for all.
    pub(crate) upto: Option<u128>,
    /// Whether the viewer has not yet begun with the present settings.
    pub(crate) stale: bool,
    /// Whether the newest drawing exceeded a limit, so that an older drawing is shown.
    pub(crate) refused: bool,
    /// The number of mates that help with slow pictures in space.
    pub(crate) mates: u32,
    /// On a mate: the pane to begin, and its budget.
    pub(crate) pane: Option<(lsystem::render::Pane, f32)>,
}

/// The most milliseconds of a step while a picture is refined, so that new input is handled soon.
const REFINING: f64 = 3.0;

/// The units of work for each count before the first report: some milliseconds.
const COUNTING: u64 = 1 << 17;

/// The answer of [`Playground::step`].
#[derive(Serialize)]
struct StepAnswer<'a> {
    report: Option<&'a Report>,
    drawn: Option<Drawn>,
    idle: bool,
}

#[wasm_bindgen]
impl Playground {
    /// A playground that paints `canvas`.
    ///
    /// # Errors
    /// Throws if the canvas has no 2D context.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        Self::of(canvas, Views::default(), LIMITS)
    }

    /// A playground for small pictures, with little memory and without counts.
    ///
    /// # Errors
    /// Throws if the canvas has no 2D context.
    pub fn small(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        Self::of(canvas, Views::small(), SMALL)
    }

    /// Sets the definition and returns its [`Report`]; [`Playground::step`] makes the drawing. If the definition has
    /// errors, the previous system stays.
    ///
    /// # Errors
    /// Throws if the argument is not a definition.
    pub fn define(&mut self, definition: JsValue) -> Result<JsValue, JsValue> {
        let definition = from_js(definition)?;
        let (system, diagnostics) = compile(&definition);
        let Some(system) = system else {
            return to_js(&Report { diagnostics, ..Report::default() });
        };
        let n = definition.iterations;
        let same_drawing = self.definition.iterations == n
            && (self.system.as_ref()).is_some_and(|former| {
                former.seed == system.seed && former.rules == system.rules && former.turtle == system.turtle
            });
        let known = Report {
            ok: true,
            diagnostics,
            kind: kind(&system),
            stochastic: system.is_stochastic(),
            space: system.is_solid(),
            legend: legend_of(&system),
            empty: why_empty(&system, n),
            ..Report::default()
        };
        if same_drawing && (!self.built() || self.shown.is_some()) {
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
            // Small pictures show no counts, so counters would waste memory.
            self.counters = (self.limits == LIMITS).then(|| [system.symbols(n), system.segments(n)]);
            self.counters.iter_mut().flatten().for_each(|counter| {
                counter.step(COUNTING);
            });
            self.report_counts();
            self.drawer = Some(Figure::drawer(&system, n, self.limits));
        }
        self.stale = true;
        self.history = None;
        self.definition = definition;
        self.system = Some(system);
        to_js(&self.report)
    }

    /// Sets the view: the canvas size in device pixels, device pixels per CSS pixel, and the view relative to the
    /// fitted one. The centre is the sum of `x`, `y` and the small corrections `fine_x`, `fine_y`.
    #[expect(clippy::too_many_arguments, reason = "an object would have to be read field by field")]
    pub fn view(&mut self, width: u32, height: u32, ratio: f64, x: f64, y: f64, zoom: f64, fine_x: f64, fine_y: f64) {
        self.vantage.view = View { x, y, zoom, fine: [fine_x, fine_y] };
        self.viewport = Viewport { width, height, ratio }.within_limits();
        // Even an equal view gets a new picture.
        self.stale = true;
    }

    /// Sets the camera of drawings in space, as [`lsystem::Camera`]: angles in degrees, the target relative to the
    /// fitted centre, in fitted extents.
    #[expect(clippy::too_many_arguments, reason = "an object would have to be read field by field")]
    pub fn camera(
        &mut self,
        azimuth: f64,
        elevation: f64,
        zoom: f64,
        x: f64,
        y: f64,
        z: f64,
        perspective: bool,
        fade: f64,
    ) {
        let camera = Camera { azimuth, elevation, zoom, target: [x, y, z], perspective, fade };
        if camera != self.vantage.camera {
            self.vantage.camera = camera;
            self.stale = true;
        }
    }

    /// Shows only the first `upto` segments, or all without a number. A new drawing shows all segments.
    pub fn play(&mut self, upto: Option<u128>) {
        if upto != self.upto {
            self.upto = upto;
            self.stale = true;
        }
    }

    /// Whether no drawing is being built.
    #[wasm_bindgen(getter)]
    pub fn built(&self) -> bool {
        self.drawer.is_none()
    }

    /// Works for about `budget` milliseconds. Returns `{report, drawn: {complete, scale, moving, rough, slow, only}, idle}`;
    /// `report` and `drawn` are null if they have not changed.
    ///
    /// # Errors
    /// Throws if the canvas refuses the picture.
    pub fn step(&mut self, budget: f64) -> Result<JsValue, JsValue> {
        let refining = !self.stale && self.shown.is_some() && self.views.get().is_refining();
        let end = self.clock.now() + if refining { budget.min(REFINING) } else { budget };
        let mut drawn = None;
        while drawn.is_none() && !self.is_idle() {
            if !self.built() {
                self.build();
            } else if !self.is_painting() {
                self.count();
            } else {
                drawn = self.paint()?;
                if self.waits() {
                    break;
                }
            }
            if self.clock.now() >= end {
                break;
            }
        }
        let report = core::mem::take(&mut self.is_report_new).then_some(&self.report);
        to_js(&StepAnswer { report, drawn, idle: self.is_idle() })
    }
}

impl Playground {
    fn of(canvas: OffscreenCanvas, views: Views, limits: Limits) -> Result<Self, JsValue> {
        Ok(Self {
            surface: CanvasSurface::new(canvas)?,
            clock: Clock::new(),
            definition: Definition::default(),
            system: None,
            history: None,
            views,
            limits,
            drawer: None,
            shown: None,
            report: Report::default(),
            counters: None,
            is_report_new: false,
            viewport: Viewport { width: 0, height: 0, ratio: 1.0 },
            vantage: Vantage::default(),
            upto: None,
            stale: false,
            refused: false,
            mates: 0,
            pane: None,
        })
    }

    pub(crate) fn shown_iterations(&self) -> u32 {
        self.definition.iterations
    }

    fn is_idle(&self) -> bool {
        self.built() && !self.is_painting() && !self.is_counting()
    }

    fn is_counting(&self) -> bool {
        self.counters.as_ref().is_some_and(|counters| counters.iter().any(|counter| !counter.is_done()))
    }

    /// Continues the first unfinished count.
    fn count(&mut self) {
        let counter = self.counters.iter_mut().flatten().find(|counter| !counter.is_done());
        if counter.is_some_and(|counter| counter.step(WORK as u64) == Progress::Done) {
            self.report_counts();
            if !self.is_refused() {
                self.describe();
            }
            self.is_report_new = true;
        }
    }

    /// Copies finished counts into the report.
    fn report_counts(&mut self) {
        let Some([symbols, segments]) = &self.counters else { return };
        for (counter, reported) in [(symbols, &mut self.report.symbols), (segments, &mut self.report.segments)] {
            if let Some(count) = counter.count() {
                *reported = Some(count.to_string());
            }
        }
    }

    /// Adds the properties of the shown drawing to the report.
    fn describe(&mut self) {
        let (Some(figure), Some(system)) = (&self.shown, &self.system) else { return };
        let report = &mut self.report;
        if let Some(symbols) = figure.symbol_count() {
            report.symbols = Some(symbols.to_string());
        }
        report.memoised = Some(figure.is_memoised());
        report.blocks = Some(figure.block_count());
        // If the count depends on chance, the drawing is unfolded and has an exact count.
        let counted = self.counters.as_ref().and_then(|[_, segments]| segments.count()).cloned();
        if let Some(segments) = counted.or_else(|| figure.exact_segments()) {
            report.description = figure.describe(system, self.definition.iterations, &segments);
            report.segments = Some(segments.to_string());
        }
    }

    /// Whether the shown drawing is older than the definition.
    fn is_refused(&self) -> bool {
        self.report.memoised.is_none()
    }

    /// Whether a picture is in the making or must be made.
    fn is_painting(&self) -> bool {
        let visible = self.viewport.width > 0 && self.viewport.height > 0;
        visible && self.shown.is_some() && (self.stale || !self.views.get().is_done())
    }

    /// Continues the drawing that is being built.
    pub(crate) fn build(&mut self) {
        if self.drawer.as_mut().is_none_or(|drawer| drawer.step(WORK as u64) == Progress::More) {
            return;
        }
        let Some(drawer) = self.drawer.take() else { return };
        match drawer.finish() {
            Ok(figure) => {
                self.refused = false;
                self.views.load(&figure);
                self.shown = Some(figure);
                self.describe();
            }
            Err(limit) => self.refuse(limit),
        }
        self.is_report_new = true;
        self.stale = true;
    }

    fn refuse(&mut self, limit: Diagnostic) {
        self.refused = true;
        if let Kind::Limit { largest, .. } = limit.kind {
            self.report.largest = largest;
        }
        self.report.diagnostics.extend(problems(&[limit], &self.definition, ""));
    }

    /// Continues the picture. Returns the picture on the canvas if it is new.
    fn paint(&mut self) -> Result<Option<Drawn>, JsValue> {
        if self.stale
            && let Some(settings) = self.settings()
        {
            self.views.get_mut().begin(settings);
            self.stale = false;
        }
        self.views.get_mut().paint(&self.clock, &self.surface)
    }

    /// The settings of the picture, if there is a drawing.
    pub(crate) fn settings(&self) -> Option<PictureSettings> {
        Some(PictureSettings {
            style: self.system.as_ref()?.style.clone(),
            viewport: self.viewport,
            scale: fitted_scale(self.shown.as_ref()?, self.viewport, &self.vantage),
            vantage: self.vantage,
            upto: self.upto,
            mates: if self.refused { 0 } else { self.mates },
        })
    }
}

impl core::fmt::Debug for Playground {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Playground").field("definition", &self.definition).finish_non_exhaustive()
    }
}
