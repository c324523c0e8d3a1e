//! A system between edits, and the order of its work.

use crate::budget::{LIMITS, SMALL};
use crate::counts::Counts;
use crate::pace::{REFINING, STEP, WORK};
use crate::report::Report;
use crate::surface::{Clock, Screen};
use crate::viewer::{CanvasPicture, PictureSettings};
use crate::views::Views;
use lsystem::derive::History;
use lsystem::drawing::FigureDrawer;
use lsystem::drawing::Origin;
use lsystem::render::{Framing, Pane, fitted_scale, opening_camera};
use lsystem::syntax::{Kind, problems};
use lsystem::{Camera, Definition, Diagnostic, Figure, Limits, Progress, System, Vantage, View, Viewport};
use serde::Serialize;
use std::borrow::Cow;
use ts_rs::TS;

/// The answer of [`Session::step`].
#[derive(Debug, Serialize, TS)]
pub struct StepAnswer<'a> {
    /// Null if nothing more is known than before.
    pub report: Option<&'a Report>,
    /// Null if the canvas shows the same as before.
    pub drawn: Option<CanvasPicture>,
    /// Whether nothing is left to do.
    pub idle: bool,
}

/// A system between edits: its drawing, and the picture on the canvas.
pub struct Session<S> {
    surface: S,
    pub(crate) clock: Clock,
    pub(crate) definition: Definition,
    pub(crate) system: Option<System>,
    /// The remembered derivation, after [`Session::remember`].
    pub(crate) history: Option<History>,
    pub(crate) views: Views,
    /// The limits of drawings.
    limits: Limits,
    /// The drawing that is being built.
    drawer: Option<FigureDrawer>,
    /// The shown drawing.
    pub(crate) shown: Option<Figure>,
    report: Report,
    counts: Counts,
    /// Whether the report has changed since the page got it.
    is_report_new: bool,
    pub(crate) viewport: Viewport,
    pub(crate) vantage: Vantage,
    /// The place on a segment that is the origin of views in the plane; `None` for the fitted centre.
    pub(crate) origin: Option<Origin>,
    /// The camera where the page names none: that of the shown drawing.
    opening: Camera,
    is_camera_named: bool,
    /// The framing of all drawings, if they are not fitted.
    pub(crate) framing: Option<Framing>,
    /// The number of segments shown; `None` for all.
    pub(crate) upto: Option<u128>,
    /// Whether the viewer has not yet begun with the present settings.
    pub(crate) stale: bool,
    /// Whether the newest drawing exceeded a limit, so that an older drawing is shown.
    pub(crate) refused: bool,
    /// The number of mates that help with slow pictures in space.
    pub(crate) mates: u32,
    /// On a mate: the pane to begin, and its budget.
    pub(crate) pane: Option<(Pane, f32)>,
}

impl<S: Screen> Session<S> {
    /// A session that paints `surface`.
    pub fn new(surface: S, clock: Clock) -> Self {
        Self {
            surface,
            clock,
            definition: Definition::default(),
            system: None,
            history: None,
            views: Views::default(),
            limits: LIMITS,
            drawer: None,
            shown: None,
            report: Report::default(),
            counts: Counts::default(),
            is_report_new: false,
            viewport: Viewport { width: 0, height: 0, ratio: 1.0 },
            vantage: Vantage::default(),
            origin: None,
            opening: Camera::default(),
            is_camera_named: false,
            framing: None,
            upto: None,
            stale: false,
            refused: false,
            mates: 0,
            pane: None,
        }
    }

    /// A session for small pictures, with little memory and without counts.
    pub fn small(surface: S, clock: Clock) -> Self {
        Self { views: Views::small(), limits: SMALL, ..Self::new(surface, clock) }
    }

    /// Sets the definition; [`Session::step`] makes the drawing. If the definition has errors, the previous system stays.
    pub fn define(&mut self, definition: Definition) -> Cow<'_, Report> {
        let system = match System::new(&definition) {
            Ok(system) => system,
            Err(wrong) => return Cow::Owned(Report::wrong(problems(&wrong.0, &definition, ""))),
        };
        let diagnostics = problems(&system.warnings, &definition, "");
        let n = definition.iterations;
        let same_drawing = self.definition.iterations == n
            && (self.system.as_ref()).is_some_and(|former| {
                former.seed == system.seed && former.rules == system.rules && former.turtle == system.turtle
            });
        let known = Report::of(&system, &definition, diagnostics);
        if same_drawing && (!self.built() || self.shown.is_some()) {
            self.report = known.keep_drawing(core::mem::take(&mut self.report));
            if let Some(figure) = self.shown.as_ref().filter(|_| self.built()) {
                self.report.add_width(figure);
            }
        } else {
            self.upto = None;
            self.report = known;
            // Small pictures show no counts, so counters would waste memory.
            self.counts = if self.limits == LIMITS { Counts::new(&system, n) } else { Counts::default() };
            self.counts.report(&mut self.report);
            self.drawer = Some(Figure::drawer(&system, n, self.limits));
        }
        self.stale = true;
        self.history = None;
        self.definition = definition;
        self.system = Some(system);
        Cow::Borrowed(&self.report)
    }

    /// Sets the size of the canvas and the place to look from; without a camera, the [`opening_camera`]. Even an equal
    /// place gets a new picture.
    pub fn look(&mut self, viewport: Viewport, view: View, camera: Option<Camera>) {
        self.viewport = viewport.within_limits();
        self.is_camera_named = camera.is_some();
        self.vantage = Vantage { view, camera: camera.unwrap_or(self.opening) };
        self.stale = true;
    }

    /// Sets the place on a segment that is the origin of views in the plane; `None` for the fitted centre. All places that
    /// the session tells are from there.
    pub fn set_origin(&mut self, origin: Option<Origin>) {
        self.origin = origin;
        self.stale = true;
    }

    /// Keeps the framing of the shown drawing for the next ones, or fits them again. In a kept framing nothing can be
    /// picked, because the page's places are those of fitted drawings.
    pub fn hold(&mut self, is_held: bool) {
        if is_held != self.framing.is_some() {
            self.framing = self.shown.as_ref().filter(|_| is_held).map(Framing::of);
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
    pub fn built(&self) -> bool {
        self.drawer.is_none()
    }

    /// The canvas.
    pub fn surface(&self) -> &S {
        &self.surface
    }

    /// Works for about [`STEP`] milliseconds, until there is a picture, or until nothing is left to do: first on the
    /// drawing, then on the picture, then on counts.
    ///
    /// # Errors
    /// If the canvas refuses the picture.
    pub fn step(&mut self) -> Result<StepAnswer<'_>, S::Error> {
        let refining = !self.stale && self.shown.is_some() && self.views.get::<S>().is_refining();
        let end = (self.clock)() + if refining { REFINING } else { STEP };
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
            if (self.clock)() >= end {
                break;
            }
        }
        let drawn = drawn.map(|drawn| CanvasPicture { pose: self.pose(), ..drawn });
        let report = core::mem::take(&mut self.is_report_new).then_some(&self.report);
        Ok(StepAnswer { report, drawn, idle: self.is_idle() })
    }

    fn is_idle(&self) -> bool {
        self.built() && !self.is_painting() && self.counts.is_done()
    }

    /// Continues counting.
    fn count(&mut self) {
        if self.counts.step() {
            self.counts.report(&mut self.report);
            // A report without a drawing is about a drawing that was refused.
            if self.report.memoised.is_some() {
                self.describe();
            }
            self.is_report_new = true;
        }
    }

    /// Adds the properties of the shown drawing to the report.
    fn describe(&mut self) {
        let (Some(figure), Some(system)) = (&self.shown, &self.system) else { return };
        self.report.add_drawing(figure);
        self.report.azimuth = figure.is_solid().then_some(self.opening.azimuth);
        // If the count depends on chance, the drawing is unfolded and has an exact count.
        let counted = self.counts.segments().and_then(|segments| segments.count()).cloned();
        if let Some(segments) = counted.or_else(|| figure.exact_segments()) {
            self.report.description = figure.describe(system, self.definition.iterations, &segments);
            self.report.segments = Some(segments.to_string());
        }
    }

    /// Whether a picture is in the making or must be made.
    fn is_painting(&self) -> bool {
        let visible = self.viewport.width > 0 && self.viewport.height > 0;
        visible && self.shown.is_some() && (self.stale || !self.views.get::<S>().is_done())
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
                self.opening = opening_camera(&figure);
                if !self.is_camera_named {
                    self.vantage.camera = self.opening;
                }
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
    fn paint(&mut self) -> Result<Option<CanvasPicture>, S::Error> {
        if self.stale
            && let Some(settings) = self.settings()
        {
            self.views.get_mut::<S>().begin(settings);
            self.stale = false;
        }
        self.views.get_mut().paint(&self.clock, &mut self.surface)
    }

    /// The settings of the picture, if there is a drawing.
    pub(crate) fn settings(&self) -> Option<PictureSettings> {
        let (figure, viewport, vantage) = (self.shown.as_ref()?, self.viewport, self.vantage);
        let held = self.framing.as_ref();
        Some(PictureSettings {
            style: self.system.as_ref()?.style.clone(),
            viewport,
            scale: held.map_or_else(
                || fitted_scale(figure, viewport, &vantage),
                |framing| framing.fitted_scale(viewport, &vantage),
            ),
            vantage: held.map_or(vantage, |framing| framing.hold(figure, viewport, &vantage)),
            origin: self.origin.clone().filter(|_| held.is_none()),
            upto: self.upto,
            // Mates know neither a refused drawing nor the framing.
            mates: if self.refused || held.is_some() { 0 } else { self.mates },
        })
    }
}

impl<S> core::fmt::Debug for Session<S> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Session").field("definition", &self.definition).finish_non_exhaustive()
    }
}
