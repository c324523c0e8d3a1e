//! An opaque picture in the making: its plan, and the strategy that makes it.

use super::RenderStats;
use super::bottom_up::{BottomUp, PartSource};
use super::canvas::Canvas;
use super::descent::{Descent, Node};
use super::painter::Painter;
use super::shape::Shape;
use super::strategy::{MAX_STEPS, Strategy};
use super::top_down::{Context, TopDown};
use super::view::{Measure, View, ViewTransform};
use crate::pane::Pane;
use crate::pane::Pass;
use crate::viewport::{Detail, Viewport};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;
use lsystem_syntax::Style;

/// The most pixels of a survey: about those of an ordinary screen. A larger picture is surveyed at a smaller scale.
const SURVEY_PIXELS: f64 = (1 << 20) as f64;

/// Everything that a picture is asked to show.
#[derive(Clone)]
pub(super) struct Plan {
    pub style: Style,
    pub viewport: Viewport,
    pub view: View,
    pub detail: Detail,
    /// If given, only the segments with smaller numbers (0-based) are shown.
    pub upto: Option<u128>,
    pub pane: Pane,
    pub pass: Pass,
    /// Whether the background is left out.
    pub is_transparent: bool,
}

impl Plan {
    /// The plan of a survey of the whole picture, and the survey's pixels along the side of a pixel.
    fn survey(&self) -> (Self, f64) {
        let Viewport { width, height, ratio } = self.viewport;
        let scale = (SURVEY_PIXELS / (f64::from(width) * f64::from(height)).max(1.0)).sqrt().min(1.0);
        let side = |side: u32| (f64::from(side) * scale).ceil() as u32;
        let viewport = Viewport { width: side(width), height: side(height), ratio: ratio * scale };
        (Self { viewport, pane: Pane::whole(viewport), ..self.clone() }, scale)
    }

    /// Subsamples along the side of a pixel.
    fn samples(&self) -> f64 {
        self.detail.samples() as f64
    }
}

/// An opaque picture in the making.
#[derive(Default)]
pub(super) struct Picture {
    /// The plan until the drawing is prepared, and the scale of the survey (1 without one).
    plan: Option<(Plan, f64)>,
    painter: Painter,
    descent: Descent,
    pub top_down: TopDown,
    bottom_up: Option<Box<BottomUp>>,
    /// The start of a bottom-up picture, if there may be one.
    whole: Option<Whole>,
    /// The steps after which a top-down picture is judged.
    probe: Option<u64>,
    /// During a survey: its subsamples along the side of a pixel of the whole picture.
    survey: Option<f64>,
    /// The strategy of the panes, as the last survey has found.
    strategy: Strategy,
    /// The strategy at the start of a picture without a survey.
    pub opening: Strategy,
    /// Whether pictures are never made bottom-up, to save memory.
    pub is_light: bool,
}

/// The root's node, and the upper left and the lower right corner of the whole picture in subsamples.
type Whole = (Node, [[f64; 2]; 2]);

impl Picture {
    /// Forgets the drawing.
    pub(super) fn clear(&mut self) {
        self.stop();
        self.top_down.tiling.clear();
        self.painter.inks.clear();
        self.descent.path.clear();
    }

    /// Gives up the unfinished picture.
    fn stop(&mut self) {
        self.plan = None;
        self.painter.stop();
        self.top_down.stop();
        (self.bottom_up, self.whole, self.probe, self.survey) = (None, None, None, None);
    }

    /// Starts a picture.
    pub(super) fn begin(&mut self, drawing: &Drawing, plan: Plan) {
        self.stop();
        self.painter.begin(drawing.memoised);
        if plan.pass == Pass::Survey && !drawing.memoised {
            // A drawing without shared blocks is always made top-down in full detail.
            self.strategy = Strategy::default();
            return;
        }
        let (plan, scale) = if plan.pass == Pass::Survey { plan.survey() } else { (plan, 1.0) };
        let transform = ViewTransform::new(drawing, plan.viewport, plan.view, plan.samples());
        let hairline = plan.viewport.least_width(&plan.style) * plan.samples();
        let measure = Measure { hairline, step: transform.step, scale: transform.scale };
        if self.painter.inks.choose(drawing, &plan.style) || measure != self.painter.measure {
            self.painter.measure = measure;
            self.top_down.tiling.clear();
        }
        self.top_down.tiling.begin(plan.detail);
        self.plan = Some((plan, scale));
    }

    /// Collects the facts that the picture needs, and empties the canvas.
    pub(super) fn prepare(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        let Some((plan, scale)) = self.plan.take() else { return Progress::Done };
        let size = [plan.pane.width, plan.pane.height].map(|side| side as usize * plan.detail.samples());
        if self.painter.inks.prepare(drawing, meter) == Progress::More
            || self.descent.path.prepare(drawing, &plan.style, meter) == Progress::More
            || self.painter.canvases[0].make_room(size, self.painter.inks.picture_planes(), meter) == Progress::More
        {
            self.plan = Some((plan, scale));
            return Progress::More;
        }
        self.start(drawing, shapes, &plan, size);
        self.survey = (plan.pass == Pass::Survey).then_some(scale * plan.samples());
        // `make_room` has charged this work already.
        self.painter.canvases[0].take_work();
        Progress::Done
    }

    fn start(&mut self, drawing: &Drawing, shapes: &[Shape], plan: &Plan, [width, height]: [usize; 2]) {
        let samples = plan.samples();
        let frame = &mut self.painter.canvases[0];
        frame.reset(width, height, self.painter.inks.picture_planes());
        frame.holes = self.painter.repeats;
        let transform = ViewTransform::new(drawing, plan.viewport, plan.view, samples).of_pane(plan.pane, samples);
        let Some(root) = self.descent.root(drawing, transform) else { return };
        if self.painter.repeats && plan.upto.is_none() && !self.descent.path.counts() && !self.is_light {
            let corner = [plan.pane.x, plan.pane.y].map(|v| -f64::from(v) * samples);
            let [width, height] = [plan.viewport.width, plan.viewport.height].map(|v| f64::from(v) * samples);
            self.whole = Some((root, [corner, [corner[0] + width, corner[1] + height]]));
        }
        let strategy = if plan.pass == Pass::Show { self.strategy } else { self.opening };
        let mut outlined = 0.0;
        match strategy {
            Strategy::BottomUp => self.start_bottom_up(drawing, shapes),
            Strategy::TopDown { outlined: pixels } if plan.pass == Pass::Show => outlined = pixels * samples,
            Strategy::TopDown { .. } => self.probe = self.whole.map(|_| Strategy::next_judgement(0)),
        }
        let Self { painter, descent, .. } = self;
        self.top_down.begin(&Context { drawing, shapes, painter, descent }, root, plan.upto, outlined);
    }

    /// Switches to the bottom-up strategy, unless the drawing is too large for it.
    fn start_bottom_up(&mut self, drawing: &Drawing, shapes: &[Shape]) {
        let source = PartSource { drawing, shapes, inks: &self.painter.inks };
        let measure = self.painter.measure;
        let bottom_up = self.whole.and_then(|(root, seen)| BottomUp::new(source, measure, root, seen));
        self.bottom_up = bottom_up.map(Box::new);
    }

    pub(super) fn frame(&self) -> &Canvas {
        &self.painter.canvases[0]
    }

    /// The inks of the picture's colours, for `Style::ink`.
    pub(super) fn inks(&self) -> Vec<u32> {
        let table = &self.painter.inks;
        table.used().iter().map(|&number| table.choice.ink(number)).collect()
    }

    pub(super) fn stats(&self) -> RenderStats {
        self.painter.stats
    }

    /// Goes on with the picture or its survey.
    pub(super) fn step(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        let progress = self.make(drawing, shapes, meter);
        let is_bottom_up = self.bottom_up.as_ref().is_some_and(|bottom_up| bottom_up.is_planned());
        if let Some(samples) = self.survey.filter(|_| is_bottom_up || progress == Progress::Done) {
            let outlined = self.top_down.outlined / samples;
            self.strategy = if is_bottom_up { Strategy::BottomUp } else { Strategy::TopDown { outlined } };
            self.stop();
            return Progress::Done;
        }
        if progress == Progress::Done {
            // The finished picture is on the canvas, so its parts are not needed any more.
            self.bottom_up = None;
        }
        progress
    }

    fn make(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        loop {
            if let Some(progress) = self.make_bottom_up(drawing, shapes, meter) {
                return progress;
            }
            let Self { painter, descent, .. } = self;
            let mut context = Context { drawing, shapes, painter, descent };
            let most = self.probe.unwrap_or(u64::MAX);
            let progress = self.top_down.step(&mut context, most, meter);
            let steps = context.painter.steps();
            if progress == Progress::Done || steps <= most {
                return progress;
            }
            self.probe = (steps <= MAX_STEPS).then_some(Strategy::next_judgement(steps));
            if Strategy::judge(&self.top_down, &mut context, steps) == Strategy::BottomUp {
                self.start_bottom_up(drawing, shapes);
                self.probe = None;
            }
        }
    }

    /// Goes on with the bottom-up picture; `None` if there is none, or if its parts are too many.
    fn make_bottom_up(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Option<Progress> {
        let bottom_up = self.bottom_up.as_mut()?;
        let Painter { inks, canvases: [frame, ..], stats, .. } = &mut self.painter;
        let source = PartSource { drawing, shapes, inks };
        if !bottom_up.is_planned() {
            match bottom_up.plan(source, &mut self.descent, meter) {
                None => {
                    self.bottom_up = None;
                    return None;
                }
                Some(Progress::More) => return Some(Progress::More),
                Some(Progress::Done) => {
                    // The parts take the memory of the tiles, so that both together stay within the budget.
                    self.top_down.stop();
                    self.top_down.tiling.free();
                    frame.reset(frame.strips * u64::BITS as usize, frame.height, frame.planes);
                }
            }
        }
        Some(bottom_up.step(source, &mut self.descent, frame, stats, meter))
    }
}
