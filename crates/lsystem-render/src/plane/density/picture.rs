//! A picture of sums in the making: a survey of the drawing, then the descent that adds ink up.

use super::bands::bands;
use super::deposit::Deposit;
use super::facts::Facts;
use super::haze::Haze;
use super::pigment::{Pigments, Source};
use super::sheet::{LEAST, Pigment, Sheet};
use super::survey::{Finding, Next, Survey};
use super::tiling::{Outcome, Seen, Sheets, Tiling};
use crate::plane::descent::{Cut, Descent, Node, Visit};
use crate::plane::inks::{InkTable, Inks, Shade};
use crate::plane::picture::Plan;
use crate::plane::view::{Measure, ViewTransform};
use crate::plane::{Amount, Pane, Pass, RenderStats};
use lsystem_drawing::{Drawing, Item};
use lsystem_syntax::{Meter, Progress};

/// The largest extent, in pixels, at which all ink of a block is added at its centre of gravity, unless that takes too long.
const TINY: f64 = 1.0;
/// A straight block longer than this, in pixels, is taken apart, so that rounding stays far below a pixel.
const LONG: f64 = 1e6;
/// Strokes wider than twice this, in pixels, are not drawn into tiles, and a block of them is no dot.
const BROAD: f64 = 16.0;
/// Sums are kept below this power of two.
const LARGEST: i32 = 100;
/// The steps of a picture before larger blocks are added as dots, and how many more for each of its sums. A step is a
/// block looked into, a stroke or a stamp.
const PATIENCE: [u64; 2] = [200_000, 16];
/// The units of work on strokes and areas that take the time of a step.
const UNITS: u64 = 16;

/// What is being done for a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stage {
    /// Leaving out the segments that are not to be shown.
    Cut,
    /// Finding out how closely the drawing can be looked at.
    Survey(Survey),
    /// Drawing it, and as haze what is not larger than `grain`: 0 where all is drawn.
    Draw { grain: f64 },
    /// Adding the haze.
    Settle { grain: f64 },
    #[default]
    Done,
}

/// How large dots are.
#[derive(Clone, Copy, Debug, Default)]
struct Dots {
    /// The largest extent, in pixels, at which all ink of a block is added at its centre of gravity.
    extent: f64,
    /// The steps after which that extent doubles.
    patience: u64,
    /// The units of work that strokes and areas took.
    laid: u64,
}

/// A picture of sums in the making.
#[derive(Default)]
pub(super) struct Picture {
    /// What is to be made, until the drawing is ready for it, and the sums along the side of a pixel.
    plan: Option<(Plan, f64)>,
    /// How far segments have been left out, if some are.
    cut: Option<Cut>,
    descent: Descent,
    table: InkTable,
    pigments: Pigments,
    measure: Measure,
    sheets: Sheets,
    /// The sheet on which a polygon is being filled.
    filled: usize,
    tiling: Tiling,
    dots: Dots,
    haze: Haze,
    /// Pixels around a pane whose haze is spread into it.
    apron: usize,
    /// Where the descent starts.
    start: Vec<Node>,
    stack: Vec<Node>,
    /// A block whose pigment has been asked for.
    waiting: Option<Node>,
    stage: Stage,
    pass: Pass,
    /// What a survey of the whole picture found for its panes.
    finding: Finding,
    /// Whether blocks may recur.
    repeats: bool,
    pub stats: RenderStats,
}

impl Picture {
    /// Forgets everything about the drawing there was.
    pub(super) fn clear(&mut self) {
        self.descent.path.clear();
        self.table.clear();
        self.pigments.clear();
        self.tiling.clear();
        self.stop();
    }

    /// Gives up the picture that is being made.
    fn stop(&mut self) {
        (self.plan, self.cut, self.waiting) = (None, None, None);
        self.pigments.stop();
        self.stack.clear();
        self.start.clear();
        self.tiling.stop();
        self.stage = Stage::Done;
    }

    /// Starts the sums of a pane with so many sums along the side of a pixel.
    pub(super) fn begin(&mut self, drawing: &Drawing, plan: Plan, samples: f64) {
        self.stop();
        self.apron = 0;
        self.stats = RenderStats::default();
        self.repeats = drawing.memoised;
        let transform = ViewTransform::new(drawing, plan.viewport, plan.view, samples);
        let hairline = plan.viewport.least_width(&plan.style) * samples;
        let measure = Measure { hairline, step: transform.step, scale: transform.scale };
        let changed = self.table.choose(drawing, &plan.style);
        // Tiles with large dots in them would spoil this picture.
        let rough = core::mem::replace(&mut self.dots.extent, TINY) > TINY;
        if self.pigments.prepare(&plan.style, self.table.choice.colours) | changed | rough || measure != self.measure {
            self.measure = measure;
            self.tiling.clear();
        }
        self.plan = Some((plan, samples));
    }

    /// Finds out what the picture needs to know of the drawing, and empties the sheet.
    pub(super) fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        let Some((plan, samples)) = self.plan.take() else { return Progress::Done };
        if self.table.prepare(drawing, meter) == Progress::More
            || self.descent.path.prepare(drawing, &plan.style, meter) == Progress::More
        {
            self.plan = Some((plan, samples));
            return Progress::More;
        }
        let size = [plan.pane.width, plan.pane.height].map(|side| (f64::from(side) * samples).ceil() as usize);
        let planes = if self.table.used().len() > 1 { 4 } else { 1 };
        if plan.pass == Pass::Survey {
            self.sheets[0].outline(size, planes);
        } else if self.sheets[0].empty(size, planes, meter) == Progress::More {
            self.plan = Some((plan, samples));
            return Progress::More;
        }
        let [patience, each] = PATIENCE;
        (self.dots.patience, self.dots.laid) = (patience + each * (size[0] * size[1]) as u64, 0);
        let transform = ViewTransform::new(drawing, plan.viewport, plan.view, samples).of_pane(plan.pane, samples);
        self.start.extend(self.descent.root(drawing, transform));
        self.cut = plan.upto.map(Cut::new);
        (self.stage, self.pass) = (Stage::Cut, plan.pass);
        Progress::Done
    }

    /// Starts the survey, unless that has been made for the whole picture.
    fn survey(&mut self) -> u64 {
        if matches!(self.pass, Pass::Count | Pass::Show) {
            return self.draw(self.finding);
        }
        self.count(Survey::new([self.sheets[0].width, self.sheets[0].height]));
        0
    }

    fn count(&mut self, survey: Survey) {
        self.stage = Stage::Survey(survey);
        self.stack.clone_from(&self.start);
    }

    /// Starts drawing what a survey has found; the units of work that this took.
    fn draw(&mut self, finding: Finding) -> u64 {
        if self.pass == Pass::Survey {
            (self.finding, self.stage) = (finding, Stage::Done);
            return 0;
        }
        let Finding { grain, all } = finding;
        self.stage = Stage::Draw { grain };
        self.stack.clone_from(&self.start);
        // The exponent of a unit in which so much ink can be held.
        let exponent = all.exponent().map_or(0, |exponent| (exponent - LARGEST).max(0));
        self.tiling.set_unit(exponent);
        self.sheets[0].exponent = exponent;
        self.apron = if grain > 0.0 { Haze::apron(grain) } else { 0 };
        if grain > 0.0 { self.haze.reset(&self.sheets[0], self.apron) } else { 0 }
    }

    /// An empty picture.
    pub(super) fn blank(&mut self, pane: Pane) {
        self.stop();
        self.sheets[0].reset([pane.width, pane.height].map(|side| side as usize), 1, 0);
    }

    pub(super) fn sums(&self) -> &Sheet {
        &self.sheets[0]
    }

    /// What a picture in one ink is drawn with.
    pub(super) fn only_pigment(&self) -> Pigment {
        let number = self.table.used().first().copied().unwrap_or(0);
        self.pigments.of(Shade { number, fixed: true })
    }

    /// Goes on with the picture.
    pub(super) fn step(&mut self, drawing: &Drawing, facts: &Facts, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            match self.stage {
                Stage::Cut => {
                    if let Some(cut) = &mut self.cut
                        && self.descent.leave_out(drawing, self.table.choice, &mut self.start, cut, meter)
                            == Progress::More
                    {
                        return Progress::More;
                    }
                    self.cut = None;
                    meter.charge(self.survey());
                }
                Stage::Survey(survey) => meter.charge(self.visit(drawing, facts, survey)),
                Stage::Draw { .. } if !self.sheets[self.filled].is_filled() => {
                    let before = meter.spent();
                    self.sheets[self.filled].go_on(meter);
                    self.dots.laid += meter.spent() - before;
                }
                Stage::Draw { .. } if self.pigments.is_asked() => {
                    let source = Source { drawing, table: &self.table, deposits: &facts.deposits.list };
                    self.pigments.step(source, meter);
                }
                Stage::Draw { grain } => meter.charge(match self.waiting.take() {
                    Some(node) => self.block(drawing, facts, node, grain),
                    None => self.item(drawing, facts, grain),
                }),
                Stage::Settle { grain } => {
                    if self.haze.settle(&mut self.sheets[0], grain, meter) == Progress::Done {
                        self.stage = Stage::Done;
                    }
                }
                Stage::Done => return Progress::Done,
            }
            // Not before: then a step of one unit would do nothing.
            meter.charge(1);
        }
        Progress::More
    }

    /// Visits one item more of a survey; the units of work that this took.
    fn visit(&mut self, drawing: &Drawing, facts: &Facts, mut survey: Survey) -> u64 {
        let met = self.descent.next(drawing, self.table.choice, &mut self.stack, 0).filter(|_| !survey.is_over());
        match met {
            None => match survey.next() {
                Next::Count(survey) => self.count(survey),
                Next::End(finding) => return self.draw(finding),
            },
            Some(Visit { item: Item::Block(_), node }) => {
                let Some(seen) = self.seen(drawing, facts, &node) else { return 0 };
                if seen.extent > survey.grain {
                    self.stack.push(node);
                    survey.count(Amount::default());
                } else {
                    survey.count(facts.deposit(&node).amount(&self.measure, &node));
                }
                self.stage = Stage::Survey(survey);
            }
            Some(Visit { node, .. }) => {
                // More than any stroke has that is in the picture.
                survey.count(Amount::new(self.measure.width(node.pen.width)).times(self.sheets[0].numbers() as f64));
                self.stage = Stage::Survey(survey);
            }
        }
        0
    }

    /// Draws one item more; the units of work that this took.
    fn item(&mut self, drawing: &Drawing, facts: &Facts, grain: f64) -> u64 {
        match self.descent.next(drawing, self.table.choice, &mut self.stack, self.tiling.floor()) {
            None => {
                let Some(work) = self.tiling.finish(&mut self.sheets) else {
                    self.stage = if grain > 0.0 { Stage::Settle { grain } } else { Stage::Done };
                    return 0;
                };
                self.stats.tiles += 1;
                self.stats.stamps += 1;
                work
            }
            Some(Visit { item: Item::Stroke(stroke), node }) => {
                let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
                self.stroke(&node, ends, node.pen.width, node.pen.shade)
            }
            Some(Visit { item: Item::Polygon(polygon), node }) => {
                self.stats.strokes += 1;
                let vertices = drawing.vertices_of(polygon).iter().map(|&vertex| node.place.point(vertex));
                let pigment = self.pigments.of(node.pen.shade);
                self.filled = node.canvas;
                let sheet = &mut self.sheets[node.canvas];
                sheet.fill(vertices, sheet.layer(), pigment)
            }
            Some(Visit { item: Item::Block(_), node }) => self.block(drawing, facts, node, grain),
        }
    }

    /// Where a block is on its sheet; `None` where nothing of it shows.
    fn seen(&self, drawing: &Drawing, facts: &Facts, node: &Node) -> Option<Seen> {
        let shape = facts.shape(node);
        let place = &node.place;
        let width = self.measure.width(drawing.blocks[node.block.0 as usize].widest.of(node.pen.width));
        let (centre, reach) = place.bounds(shape, width / 2.0);
        let [low, high] = [-1.0, 1.0].map(|sign| [0, 1].map(|axis| centre[axis] + sign * reach[axis]));
        let extent = shape.extent(place.scale.abs());
        let apron = if node.canvas == 0 { self.apron as f64 } else { 0.0 };
        let (near, far) = (low.map(|at| at - apron), high.map(|at| at + apron));
        let shows = shape.strokes > 0 && !self.sheets[node.canvas].misses(near, far);
        shows.then_some(Seen { centre, reach, width, extent })
    }

    fn stroke(&mut self, node: &Node, ends: [[f64; 2]; 2], width: f64, shade: Shade) -> u64 {
        self.stats.strokes += 1;
        let (width, pigment) = (self.measure.width(width), self.pigments.of(shade));
        self.filled = node.canvas;
        let sheet = &mut self.sheets[node.canvas];
        let work = sheet.stroke(ends, width, sheet.layer(), pigment);
        self.dots.laid += work;
        work
    }

    /// What a block is drawn with, as a whole; `None` where that has to be found first, and the block is put off.
    fn pigment(&mut self, node: &Node) -> Option<Pigment> {
        if self.sheets[node.canvas].planes == 1 {
            return Some(Pigment::default());
        }
        match self.table.of(node.block.0 as usize) {
            Inks::One(shade) if !self.descent.path.counts() => {
                Some(self.pigments.of(self.table.choice.then(node.pen.shade, shade)))
            }
            Inks::Many => {
                let mean = self.pigments.mean(node.block.0, node.pen.shade);
                if mean.is_none() {
                    self.pigments.ask(node.block.0, node.pen.shade);
                    self.waiting = Some(*node);
                }
                mean
            }
            _ => Some(self.pigments.of(node.pen.shade)),
        }
    }

    /// Lets dots grow with the steps that the picture takes.
    fn grow_dots(&mut self) {
        // Without repeats there are no more steps than the drawing has segments, but each may be wide.
        let steps = self.stats.blocks + self.stats.strokes + self.stats.stamps;
        let steps = self.dots.laid / UNITS + if self.repeats { steps } else { 0 };
        if steps > self.dots.patience {
            self.dots.extent *= 2.0;
            self.dots.patience += self.dots.patience / 4;
        }
    }

    /// Draws a block, or puts it on the stack; the units of work that this took.
    fn block(&mut self, drawing: &Drawing, facts: &Facts, mut node: Node, grain: f64) -> u64 {
        let Some(seen) = self.seen(drawing, facts, &node) else { return 0 };
        let (shape, deposit) = (facts.shape(&node), facts.deposit(&node));
        // A part of the path that has one colour is like any other block.
        let is_plain = !self.descent.path.counts() || node.canvas != 0 || node.span.is_short();
        if let Some(line) = shape.line.as_ref().filter(|_| deposit.even && is_plain && seen.extent < LONG) {
            let ends = [line.from, line.to].map(|p| node.place.point(p));
            let pen = node.pen.after(self.table.choice, &line.style);
            return self.stroke(&node, ends, pen.width, pen.shade);
        }
        self.grow_dots();
        if seen.extent <= self.dots.extent {
            return self.dot(&node, deposit, seen.width);
        }
        if seen.extent <= grain {
            return self.spread(&node, deposit);
        }
        let mut work = 1;
        if is_plain
            && self.repeats
            && seen.width <= 2.0 * BROAD
            && let Some(size) = self.tiling.tile_size(&node, seen.extent, shape.strokes)
        {
            let is_mixed = self.table.of(node.block.0 as usize) == Inks::Many;
            let Some(pigment) = (if is_mixed { Some(Pigment::default()) } else { self.pigment(&node) }) else {
                return 1;
            };
            let shade = is_mixed.then_some(node.pen.shade);
            let width = self.measure.is_wide(seen.width / 2.0).then_some(node.pen.width.to_bits());
            let tile = (&mut node, self.stack.len(), size);
            match self.tiling.add_or_make(&mut self.sheets, tile, &seen, (shape.strokes, width), (shade, pigment)) {
                Outcome::Added(work) => {
                    self.stats.stamps += 1;
                    return work;
                }
                Outcome::Begun(emptied) => work += emptied,
                Outcome::TooLarge => {}
            }
        }
        self.stats.blocks += 1;
        self.stack.push(node);
        work
    }

    /// Adds all ink of a block at its centre of gravity. Where its strokes are broad, the ink is laid down as two bands
    /// that cross there.
    fn dot(&mut self, node: &Node, deposit: &Deposit, width: f64) -> u64 {
        let Some(pigment) = self.pigment(node) else { return 1 };
        self.stats.strokes += 1;
        self.stats.outlines += u64::from(self.dots.extent > TINY);
        let amount = deposit.amount(&self.measure, node);
        let sheet = &mut self.sheets[node.canvas];
        if width <= 2.0 * BROAD || deposit.length.is_zero() {
            let amount = amount.units(sheet.exponent).max(LEAST) as f32;
            sheet.dot(node.place.point(deposit.centre), amount, pigment);
            return 1;
        }
        let (corners, area) = bands(&self.measure, deposit, node);
        self.filled = node.canvas;
        let work = sheet.fill(corners, (amount.units(sheet.exponent) / area).max(LEAST), pigment);
        self.dots.laid += work;
        work
    }

    /// Adds all ink of a block to the haze.
    fn spread(&mut self, node: &Node, deposit: &Deposit) -> u64 {
        let Some(pigment) = self.pigment(node) else { return 1 };
        self.stats.strokes += 1;
        let [across, _, down] = deposit.squares(&self.measure, node);
        let amount = deposit.amount(&self.measure, node).units(self.sheets[0].exponent);
        self.haze.add(node.place.point(deposit.centre), [across, down], amount, pigment);
        1
    }
}
