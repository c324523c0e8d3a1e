//! The page's handle: keeps a system between edits and works in steps that end on time.

use crate::budget::{LIMITS, SMALL};
use crate::clock::Clock;
use crate::report::{Report, legend_of, problems, understood};
use crate::surface::Surface;
use crate::viewer::{Drawn, Realm, Scene, Views, WORK};
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
    surface: Surface,
    pub(crate) clock: Clock,
    pub(crate) definition: Definition,
    pub(crate) system: Option<System>,
    /// Of its derivation, once somebody asks.
    pub(crate) history: Option<lsystem::derive::History>,
    pub(crate) views: Views,
    /// Of drawings.
    limits: Limits,
    /// Where a drawing is being built.
    building: Option<Realm>,
    /// Where what is shown has been drawn.
    pub(crate) shown: Option<Realm>,
    pub(crate) report: Report,
    /// The symbols and segments of the system, counted when there is nothing else to do where that takes long.
    counters: Option<[Counter; 2]>,
    /// Whether the page has not seen the report yet.
    news: bool,
    pub(crate) viewport: Viewport,
    pub(crate) view: View,
    /// How many segments the picture shows; all of them without it.
    pub(crate) upto: Option<u128>,
    /// Whether the viewer has to be told what to show.
    pub(crate) stale: bool,
    /// Whether the newest definition passed a limit, so that an older drawing is shown.
    pub(crate) refused: bool,
    /// How many others help with pictures in space that take long.
    pub(crate) mates: u32,
    /// Held by every file in the making as well.
    pub(crate) files: std::rc::Rc<()>,
    /// As one of those: what to make.
    pub(crate) pane: Option<(lsystem::render::Pane, f32)>,
}

/// While a picture is refined newer input is listened for after so many milliseconds.
const REFINING: f64 = 3.0;

/// Work units of a count that are spent before the first report: some milliseconds.
const COUNTING: u64 = 1 << 17;

/// The answer of [`Playground::step`].
#[derive(Serialize)]
struct Step<'a> {
    report: Option<&'a Report>,
    drawn: Option<Drawn>,
    idle: bool,
}

#[wasm_bindgen]
impl Playground {
    /// A playground that paints `canvas`.
    ///
    /// # Errors
    /// Throws where the canvas has no 2D context.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        Self::of(canvas, Views::default(), LIMITS)
    }

    /// A playground for small pictures: it takes little memory and counts nothing.
    ///
    /// # Errors
    /// Throws where the canvas has no 2D context.
    pub fn small(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        Self::of(canvas, Views::small(), SMALL)
    }

    /// Takes a new state of the system and says what it means; the drawing follows in [`Playground::step`]. Where
    /// the definition is wrong the former system stays.
    ///
    /// # Errors
    /// Throws where the argument is not a definition at all.
    pub fn define(&mut self, definition: JsValue) -> Result<JsValue, JsValue> {
        let definition = from_js(definition)?;
        let (system, diagnostics) = understood(&definition);
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
            solid: system.is_solid(),
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
            // Nobody reads the counts of a small picture, and they take memory.
            self.counters = (self.limits == LIMITS).then(|| [system.symbols(n), system.segments(n)]);
            self.counters.iter_mut().flatten().for_each(|counter| {
                counter.step(COUNTING);
            });
            self.tell_counts();
            self.start(&system, n);
        }
        self.stale = true;
        self.history = None;
        self.definition = definition;
        self.system = Some(system);
        to_js(&self.report)
    }

    /// Says where to look: the canvas size in device pixels, device pixels per CSS pixel, and the view, relative to
    /// the fitted one, whose `x` and `y` are sums of two numbers each.
    #[expect(clippy::too_many_arguments, reason = "an object would have to be read field by field")]
    pub fn view(&mut self, width: u32, height: u32, ratio: f64, x: f64, y: f64, zoom: f64, fine_x: f64, fine_y: f64) {
        self.view = View { x, y, zoom, fine: [fine_x, fine_y] };
        self.viewport = Viewport { width, height, ratio }.within_limits();
        // Who asks again waits for a picture again.
        self.stale = true;
    }

    /// Shows only the first `upto` segments, the turtle on its way; all of them without a number. A new drawing starts
    /// with all.
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

    /// Works for about `budget` milliseconds: `{report, drawn: {complete, scale, moving, rough, slow}, idle}`, parts null
    /// without news.
    ///
    /// # Errors
    /// Throws where the canvas refuses the picture.
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
        let report = core::mem::take(&mut self.news).then_some(&self.report);
        to_js(&Step { report, drawn, idle: self.is_idle() })
    }
}

impl Playground {
    fn of(canvas: OffscreenCanvas, views: Views, limits: Limits) -> Result<Self, JsValue> {
        Ok(Self {
            surface: Surface::new(canvas)?,
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
            news: false,
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

    /// Goes on with the first count that is not known yet.
    fn count(&mut self) {
        let counter = self.counters.iter_mut().flatten().find(|counter| !counter.is_done());
        if counter.is_some_and(|counter| counter.step(WORK as u64) == Progress::Done) {
            self.tell_counts();
            self.describe();
            self.news = true;
        }
    }

    /// Puts what has been counted into the report.
    fn tell_counts(&mut self) {
        let Some([symbols, segments]) = &self.counters else { return };
        for (counter, told) in [(symbols, &mut self.report.symbols), (segments, &mut self.report.segments)] {
            if let Some(count) = counter.count() {
                *told = Some(count.to_string());
            }
        }
    }

    /// Completes the report with what the drawing that is shown tells.
    fn describe(&mut self) {
        let (Some(realm), Some(system)) = (self.shown, &self.system) else { return };
        if self.building.is_none() && !self.is_refused() {
            let counted = self.counters.as_ref().map(|[_, segments]| segments);
            self.views.at(realm).describe(&mut self.report, system, self.definition.iterations, counted);
        }
    }

    /// Whether an older drawing is shown than that of the definition.
    fn is_refused(&self) -> bool {
        self.report.memoised.is_none()
    }

    /// Whether a file is being made. No drawing is in the meantime, nor is a derivation remembered: they share their
    /// memory.
    pub(crate) fn is_saving(&self) -> bool {
        std::rc::Rc::strong_count(&self.files) > 1
    }

    /// Whether a picture is being made, or has to be.
    fn is_painting(&self) -> bool {
        let visible = self.viewport.width > 0 && self.viewport.height > 0;
        let Some(realm) = self.shown.filter(|_| visible) else { return false };
        self.stale || !self.views.get(realm).is_done()
    }

    /// Goes on with the drawing that is being built, if any is.
    pub(crate) fn go_on_building(&mut self) -> bool {
        self.building.is_some_and(|realm| {
            self.build(realm);
            true
        })
    }

    /// What is shown has to be painted anew.
    pub(crate) fn outdate(&mut self) {
        self.stale = true;
    }

    /// Goes on with the drawing that is being built.
    fn build(&mut self, realm: Realm) {
        let Some(outcome) = self.views.at(realm).build() else { return };
        self.building = None;
        match outcome {
            Ok(()) => self.accept(realm),
            Err(limit) => self.refuse(limit),
        }
        self.news = true;
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

    /// Goes on with the picture; what is on the canvas after that, if anything new is.
    fn paint(&mut self) -> Result<Option<Drawn>, JsValue> {
        let Some(realm) = self.shown else { return Ok(None) };
        if let Some(scene) = self.scene().filter(|_| self.stale) {
            self.views.at(realm).begin(scene);
            self.stale = false;
        }
        self.views.at(realm).paint(&self.clock, &self.surface)
    }

    /// What the picture is to show.
    pub(crate) fn scene(&self) -> Option<Scene> {
        let style = self.system.as_ref()?.style.clone();
        let mates = if self.refused { 0 } else { self.mates };
        Some(Scene { style, viewport: self.viewport, screen: self.viewport, view: self.view, upto: self.upto, mates })
    }
}

impl core::fmt::Debug for Playground {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Playground").field("definition", &self.definition).finish_non_exhaustive()
    }
}
