//! The page's handle: keeps a system between edits and works in steps that end on time.

use crate::budget::{LIMITS, SMALL};
use crate::clock::Clock;
use crate::report::{Report, compile, legend_of, problems};
use crate::surface::CanvasSurface;
use crate::viewer::{Drawn, PictureSettings, Realm, Views, WORK};
use crate::{from_js, to_js};
use lsystem::derive::Counter;
use lsystem::drawing::{kind, why_empty};
use lsystem::syntax::Kind;
use lsystem::{Definition, Diagnostic, Limits, Progress, System, View, Viewport};
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
    /// The space of the drawing that is being built.
    building: Option<Realm>,
    /// The space of the shown drawing.
    pub(crate) shown: Option<Realm>,
    pub(crate) report: Report,
    /// The counters of symbols and segments. Long counts continue when there is nothing else to do.
    counters: Option<[Counter; 2]>,
    /// Whether the report has changed since the page got it.
    is_report_new: bool,
    pub(crate) viewport: Viewport,
    pub(crate) view: View,
    /// The number of segments shown; `None` for all.
    pub(crate) upto: Option<u128>,
    /// Whether the viewer has not yet begun with the present settings.
    pub(crate) stale: bool,
    /// Whether the newest drawing exceeded a limit, so that an older drawing is shown.
    pub(crate) refused: bool,
    /// The number of mates that help with slow pictures in space.
    pub(crate) mates: u32,
    /// A reference; every file in the making has another one.
    pub(crate) files: std::rc::Rc<()>,
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
            self.start(&system, n);
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
        self.view = View { x, y, zoom, fine: [fine_x, fine_y] };
        self.viewport = Viewport { width, height, ratio }.within_limits();
        // Even an equal view gets a new picture.
        self.stale = true;
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
        self.building.is_none()
    }

    /// Works for about `budget` milliseconds. Returns `{report, drawn: {complete, scale, moving, rough, slow, only}, idle}`;
    /// `report` and `drawn` are null if they have not changed.
    ///
    /// # Errors
    /// Throws if the canvas refuses the picture.
    pub fn step(&mut self, budget: f64) -> Result<JsValue, JsValue> {
        let refining = !self.stale && self.shown.is_some_and(|realm| self.views.get(realm).is_refining());
        let end = self.clock.now() + if refining { budget.min(REFINING) } else { budget };
        let mut drawn = None;
        while drawn.is_none() && !self.is_idle() {
            if let Some(realm) = self.building {
                if self.is_saving() {
                    break;
                }
                self.build(realm);
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
            building: None,
            shown: None,
            report: Report::default(),
            counters: None,
            is_report_new: false,
            viewport: Viewport { width: 0, height: 0, ratio: 1.0 },
            view: View::default(),
            upto: None,
            stale: false,
            refused: false,
            mates: 0,
            files: std::rc::Rc::default(),
            pane: None,
        })
    }

    pub(crate) fn shown_iterations(&self) -> u32 {
        self.definition.iterations
    }

    /// Starts building a drawing.
    fn start(&mut self, system: &System, n: u32) {
        if let Some(realm) = self.building.take() {
            self.views.at(realm).stop();
        }
        let realm = Realm::of(system);
        self.building = Some(realm);
        self.views.at(realm).start(system, n, self.limits);
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
            self.describe();
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
        let (Some(realm), Some(system)) = (self.shown, &self.system) else { return };
        if self.building.is_none() && !self.is_refused() {
            let counted = self.counters.as_ref().map(|[_, segments]| segments);
            self.views.at(realm).describe(&mut self.report, system, self.definition.iterations, counted);
        }
    }

    /// Whether the shown drawing is older than the definition.
    fn is_refused(&self) -> bool {
        self.report.memoised.is_none()
    }

    /// Whether a file is in the making. Meanwhile no drawing is built and no derivation is remembered, because they
    /// share the file's memory.
    pub(crate) fn is_saving(&self) -> bool {
        std::rc::Rc::strong_count(&self.files) > 1
    }

    /// Whether a picture is in the making or must be made.
    fn is_painting(&self) -> bool {
        let visible = self.viewport.width > 0 && self.viewport.height > 0;
        let Some(realm) = self.shown.filter(|_| visible) else { return false };
        self.stale || !self.views.get(realm).is_done()
    }

    /// Continues the drawing that is being built. Returns false if there is none.
    pub(crate) fn continue_drawing(&mut self) -> bool {
        self.building.is_some_and(|realm| {
            self.build(realm);
            true
        })
    }

    /// Records that the picture must be painted again.
    pub(crate) fn outdate(&mut self) {
        self.stale = true;
    }

    /// Continues the drawing that is being built.
    fn build(&mut self, realm: Realm) {
        let Some(outcome) = self.views.at(realm).build() else { return };
        self.building = None;
        match outcome {
            Ok(()) => self.accept(realm),
            Err(limit) => self.refuse(limit),
        }
        self.is_report_new = true;
        self.stale = true;
    }

    fn accept(&mut self, realm: Realm) {
        self.refused = false;
        if let Some(former) = self.shown.replace(realm).filter(|&former| former != realm) {
            self.views.at(former).forget();
        }
        if let Some(system) = &self.system {
            let counted = self.counters.as_ref().map(|[_, segments]| segments);
            self.views.at(realm).describe(&mut self.report, system, self.definition.iterations, counted);
        }
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
        let Some(realm) = self.shown else { return Ok(None) };
        if let Some(settings) = self.settings().filter(|_| self.stale) {
            self.views.at(realm).begin(settings);
            self.stale = false;
        }
        self.views.at(realm).paint(&self.clock, &self.surface)
    }

    /// The settings of the picture.
    pub(crate) fn settings(&self) -> Option<PictureSettings> {
        let style = self.system.as_ref()?.style.clone();
        let mates = if self.refused { 0 } else { self.mates };
        Some(PictureSettings {
            style,
            viewport: self.viewport,
            screen: self.viewport,
            view: self.view,
            upto: self.upto,
            mates,
        })
    }
}

impl core::fmt::Debug for Playground {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Playground").field("definition", &self.definition).finish_non_exhaustive()
    }
}
