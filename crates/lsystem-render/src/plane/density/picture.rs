//! A picture of sums in the making: a survey of the drawing, then the descent that adds ink up.

use super::bands::bands;
use super::deposit::Deposit;
use super::facts::Facts;
use super::haze::Haze;
use super::pigment::{MeanSource, Pigments};
use super::survey::{Finding, Next, Survey};
use super::tiling::{Footprint, Outcome, Sheets, Tiling, WantedTile};
use crate::ink::Amount;
use crate::ink::Grid;
use crate::ink::sheet::{BROAD as FILLED, LEAST_INK};
use crate::ink::{InkTable, Inks, Shade};
use crate::ink::{Pigment, Sheet};
use crate::pane::Pass;
use crate::plane::RenderStats;
use crate::plane::descent::{Cut, Descent, Node, Visit};
use crate::plane::opaque_picture::Plan;
use crate::plane::pen::Pen;
use crate::plane::view::{Measure, ViewTransform};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Drawing, Item, Line};

/// A straight block longer than this, in pixels, is taken apart, so that rounding stays far below a pixel.
const LONGEST_LINE: f64 = 1e6;
/// Strokes with a larger radius than this, in pixels, are not drawn into tiles, and their blocks are bands, not dots.
const BROAD: f64 = 16.0;
/// Sums stay below about 2 to this power, so that an `f32` (below 2^128) holds them and their pigments.
const LARGEST_EXPONENT: i32 = 100;
/// The steps of a picture before larger blocks are added as dots: this many, and more for each sum. A step is a block
/// looked into, a stroke or a stamp.
const STEPS: u64 = 200_000;
/// The further steps for each sum of the picture.
const STEPS_PER_SUM: u64 = 16;
/// The units of work on strokes and areas that take the time of a step.
const UNITS_PER_STEP: u64 = 16;

/// The stage of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stage {
    /// Leaves out the segments that are not to be shown.
    Cut,
    /// Finds the grain of the haze.
    Survey(Survey),
    /// Draws blocks, and adds blocks up to the extent `grain`, in pixels, to the haze; 0 means no haze.
    Draw { grain: f64 },
    /// Adds the haze to the sheet.
    Settle { grain: f64 },
    #[default]
    Done,
}

/// The size of dots.
#[derive(Clone, Copy, Debug, Default)]
struct Dots {
    /// The largest extent of a dot, in pixels. A dot is a block whose ink is all added at its centre of gravity.
    extent: f64,
    /// The number of steps at which that extent doubles next.
    next_growth: u64,
    /// The units of work that strokes and areas took.
    work: u64,
}

/// A picture of sums in the making.
#[derive(Default)]
pub(super) struct Picture {
    /// The plan until the drawing is prepared, and the places of the sums.
    plan: Option<(Plan, Grid)>,
    /// The state of leaving out the last segments, until that is done.
    cut: Option<Cut>,
    descent: Descent,
    table: InkTable,
    pigments: Pigments,
    measure: Measure,
    grid: Grid,
    sheets: Sheets,
    /// The sheet on which a polygon is being filled.
    filled: usize,
    tiling: Tiling,
    dots: Dots,
    haze: Haze,
    /// Pixels around a pane whose haze is spread into it.
    apron: usize,
    /// The stack at the start of each descent.
    start: Vec<Node>,
    stack: Vec<Node>,
    /// A block that waits for its pigment.
    waiting: Option<Node>,
    stage: Stage,
    pass: Pass,
    /// The result of the survey of the whole picture, for its panes.
    finding: Finding,
    /// Whether blocks may recur.
    repeats: bool,
    pub stats: RenderStats,
}

impl Picture {
    /// Forgets the drawing.
    pub(super) fn clear(&mut self) {
        self.descent.path.clear();
        self.table.clear();
        self.pigments.clear();
        self.tiling.clear();
        self.stop();
    }

    /// Forgets the tiles of the pictures before.
    pub(super) fn forget(&mut self) {
        self.tiling.clear();
    }

    /// Gives up the unfinished picture.
    fn stop(&mut self) {
        (self.plan, self.cut, self.waiting) = (None, None, None);
        self.pigments.stop();
        self.stack.clear();
        self.start.clear();
        self.tiling.stop();
        self.stage = Stage::Done;
    }

    /// Starts the sums of a pane.
    pub(super) fn begin(&mut self, drawing: &Drawing, plan: Plan, grid: Grid) {
        self.stop();
        let samples = grid.samples();
        self.apron = 0;
        self.stats = RenderStats::default();
        self.repeats = drawing.memoised;
        let transform = ViewTransform::new(drawing, plan.viewport, plan.view, samples);
        let hairline = plan.viewport.least_width(&plan.style) * samples;
        let measure = Measure { hairline, step: transform.step, scale: transform.scale };
        let changed = self.table.choose(drawing, &plan.style);
        // Tiles that hold dots of another size would spoil this picture.
        let other_dots = core::mem::replace(&mut self.dots.extent, grid.dot) != grid.dot;
        self.grid = grid;
        self.tiling.begin(grid);
        if self.pigments.prepare(&plan.style, self.table.choice) | changed | other_dots || measure != self.measure {
            self.measure = measure;
            self.tiling.clear();
        }
        self.plan = Some((plan, grid));
    }

    /// Collects the facts that the picture needs, and empties the sheet.
    pub(super) fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        let Some((plan, grid)) = self.plan.take() else { return Progress::Done };
        if self.table.prepare(drawing, meter) == Progress::More
            || self.descent.path.prepare(drawing, &plan.style, meter) == Progress::More
        {
            self.plan = Some((plan, grid));
            return Progress::More;
        }
        let size = grid.size([plan.pane.width, plan.pane.height]);
        let planes = if self.table.used().len() > 1 { 4 } else { 1 };
        if plan.pass == Pass::Survey {
            self.sheets[0].outline(size, planes);
        } else if self.sheets[0].empty(size, planes, meter) == Progress::More {
            self.plan = Some((plan, grid));
            return Progress::More;
        }
        self.dots.next_growth = STEPS + STEPS_PER_SUM * (size[0] * size[1]) as u64;
        self.dots.work = 0;
        let transform = ViewTransform::new(drawing, plan.viewport, plan.view, grid.samples()).of_grid(grid, plan.pane);
        self.start.extend(self.descent.root(drawing, transform));
        self.cut = plan.upto.map(Cut::new);
        (self.stage, self.pass) = (Stage::Cut, plan.pass);
        Progress::Done
    }

    /// Starts the survey, or the drawing if the whole picture has been surveyed. Returns the units of work.
    fn survey(&mut self) -> u64 {
        if matches!(self.pass, Pass::Count | Pass::Show) {
            return self.draw(self.finding);
        }
        self.count(Survey::new([self.sheets[0].width, self.sheets[0].height], self.grid.is_sketch));
        0
    }

    fn count(&mut self, survey: Survey) {
        self.stage = Stage::Survey(survey);
        self.stack.clone_from(&self.start);
    }

    /// Starts drawing with the result of a survey. Returns the units of work.
    fn draw(&mut self, finding: Finding) -> u64 {
        if self.pass == Pass::Survey {
            (self.finding, self.stage) = (finding, Stage::Done);
            return 0;
        }
        let Finding { grain, all } = finding;
        self.stage = Stage::Draw { grain };
        self.stack.clone_from(&self.start);
        // The exponent of a unit in which all ink stays below the largest sum.
        let exponent = all.exponent().map_or(0, |exponent| (exponent - LARGEST_EXPONENT).max(0));
        self.tiling.set_unit(exponent);
        self.sheets[0].exponent = exponent;
        self.apron = if grain > 0.0 { Haze::apron(grain, self.grid.is_sketch) } else { 0 };
        if grain > 0.0 { self.haze.reset(&self.sheets[0], self.apron) } else { 0 }
    }

    pub(super) fn sums(&self) -> &Sheet {
        &self.sheets[0]
    }

    /// The pigment of a picture in one ink.
    pub(super) fn only_pigment(&self) -> Pigment {
        let number = self.table.used().first().copied().unwrap_or(0);
        self.pigments.of(Shade { number, fixed: true })
    }

    /// Goes on with the picture.
    pub(super) fn step(&mut self, drawing: &Drawing, facts: Facts<'_>, meter: &mut Meter) -> Progress {
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
                    self.dots.work += meter.spent() - before;
                }
                Stage::Draw { .. } if self.pigments.is_asked() => {
                    let source = MeanSource { drawing, table: &self.table, deposits: facts.deposits };
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
            // Charged after the work, so that a step of one unit does something.
            meter.charge(1);
        }
        Progress::More
    }

    /// Visits the next item of a survey. Returns the units of work.
    fn visit(&mut self, drawing: &Drawing, facts: Facts<'_>, mut survey: Survey) -> u64 {
        let met = self.descent.next(drawing, self.table.choice, &mut self.stack, 0).filter(|_| !survey.is_over());
        match met {
            None => match survey.next() {
                Next::Count(survey) => self.count(survey),
                Next::End(finding) => return self.draw(finding),
            },
            Some(Visit { item: Item::Block(_), node }) => {
                let Some(footprint) = self.footprint(drawing, facts, &node) else { return 0 };
                if footprint.extent > survey.grain {
                    self.stack.push(node);
                    survey.count(Amount::default());
                } else {
                    survey.count(facts.deposit(&node).amount(&self.measure, &node));
                }
                self.stage = Stage::Survey(survey);
            }
            Some(Visit { node, .. }) => {
                // An upper bound of the ink of a stroke in the picture.
                survey
                    .count(Amount::new(self.measure.width(node.pen.widths.own)).times(self.sheets[0].numbers() as f64));
                self.stage = Stage::Survey(survey);
            }
        }
        0
    }

    /// Draws the next item. Returns the units of work.
    fn item(&mut self, drawing: &Drawing, facts: Facts<'_>, grain: f64) -> u64 {
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
                self.stroke(&node, ends, node.pen)
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

    /// The footprint of a block on its sheet; `None` if the block is outside or empty.
    fn footprint(&self, drawing: &Drawing, facts: Facts<'_>, node: &Node) -> Option<Footprint> {
        let shape = facts.shape(node);
        let place = &node.place;
        let width = self.measure.width(node.pen.widths.widest(drawing.blocks[node.block.0 as usize].widest));
        let (centre, reach) = place.bounds(shape, width / 2.0);
        let [low, high] = [-1.0, 1.0].map(|sign| [0, 1].map(|axis| centre[axis] + sign * reach[axis]));
        let extent = shape.extent(place.scale.abs());
        let apron = if node.canvas == 0 { self.apron as f64 } else { 0.0 };
        let (near, far) = (low.map(|at| at - apron), high.map(|at| at + apron));
        let shows = shape.strokes > 0 && !self.sheets[node.canvas].misses(near, far);
        shows.then_some(Footprint { centre, reach, width, extent })
    }

    fn stroke(&mut self, node: &Node, ends: [[f64; 2]; 2], pen: Pen) -> u64 {
        self.stats.strokes += 1;
        let (widths, pigment) = (pen.widths.ends().map(|width| self.measure.width(width)), self.pigments.of(pen.shade));
        self.filled = node.canvas;
        let sheet = &mut self.sheets[node.canvas];
        let work = sheet.stroke(ends, widths, (sheet.layer(), self.grid.points), pigment);
        self.dots.work += work;
        work
    }

    /// The mean pigment of a block; `None` if the mean is not known yet. Then the block waits for it.
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
        // Without repeats the number of steps is bounded by the number of segments, but not the work on wide strokes.
        let steps = self.stats.blocks + self.stats.strokes + self.stats.stamps;
        let steps = self.dots.work / UNITS_PER_STEP + if self.repeats { steps } else { 0 };
        if steps > self.dots.next_growth {
            self.dots.extent *= 2.0;
            self.dots.next_growth += self.dots.next_growth / 4;
        }
    }

    /// Draws a block, or puts its node on the stack. Returns the units of work.
    fn block(&mut self, drawing: &Drawing, facts: Facts<'_>, mut node: Node, grain: f64) -> u64 {
        let Some(footprint) = self.footprint(drawing, facts, &node) else { return 0 };
        let (shape, deposit) = (facts.shape(&node), facts.deposit(&node));
        // Colours along the path allow a stroke or a tile only if the block's part of the path has one colour.
        let is_plain = !self.descent.path.counts() || node.canvas != 0 || node.span.is_short();
        // A broad line is filled as one polygon, so it must not have two parts.
        let is_simple = |line: &&Line| line.bend.is_none() || footprint.width <= FILLED;
        let is_line = deposit.even && is_plain && footprint.extent < LONGEST_LINE;
        if let Some(line) = shape.line.as_ref().filter(is_simple).filter(|_| is_line) {
            let pen = node.pen.after(self.table.choice, &line.style);
            return line
                .parts(pen.widths)
                .rev()
                .map(|(ends, widths)| self.stroke(&node, ends.map(|p| node.place.point(p)), Pen { widths, ..pen }))
                .sum();
        }
        self.grow_dots();
        if footprint.extent <= self.dots.extent {
            return self.dot(&node, deposit, footprint.width);
        }
        if footprint.extent <= grain {
            return self.spread(&node, deposit);
        }
        let mut work = 1;
        if is_plain
            && self.repeats
            && footprint.width <= 2.0 * BROAD
            && let Some(size) = self.tiling.tile_size(&node, footprint.extent, shape.strokes)
        {
            let is_mixed = self.table.of(node.block.0 as usize) == Inks::Many;
            let Some(pigment) = (if is_mixed { Some(Pigment::default()) } else { self.pigment(&node) }) else {
                return 1;
            };
            let shade = is_mixed.then_some(node.pen.shade);
            let width = self.measure.is_wide(footprint.width / 2.0).then_some(node.pen.widths.key());
            let (height, strokes) = (self.stack.len(), shape.strokes);
            let wanted = WantedTile { height, size, strokes, width, shade, pigment };
            match self.tiling.add_or_make(&mut self.sheets, &mut node, &footprint, wanted) {
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

    /// Adds all ink of a block at its centre of gravity, or as two bands that cross there if its strokes are broad.
    /// Returns the units of work.
    fn dot(&mut self, node: &Node, deposit: &Deposit, width: f64) -> u64 {
        let Some(pigment) = self.pigment(node) else { return 1 };
        self.stats.strokes += 1;
        self.stats.outlines += u64::from(self.dots.extent > self.grid.dot);
        let amount = deposit.amount(&self.measure, node);
        let sheet = &mut self.sheets[node.canvas];
        if width <= 2.0 * BROAD || deposit.length.is_zero() {
            let amount = amount.units(sheet.exponent).max(LEAST_INK) as f32;
            let centre = node.place.point(deposit.centre);
            if self.grid.dot > 1.0 {
                // A dot larger than a place blinks while the view changes, unless its ink is spread.
                for off in deposit.spots(node) {
                    sheet.dot([0, 1].map(|axis| centre[axis] + off[axis]), amount / 4.0, pigment);
                }
            } else {
                sheet.dot(centre, amount, pigment);
            }
            return 1;
        }
        let (corners, area) = bands(&self.measure, deposit, node);
        self.filled = node.canvas;
        let work = sheet.fill(corners, (amount.units(sheet.exponent) / area).max(LEAST_INK), pigment);
        self.dots.work += work;
        work
    }

    /// Adds all ink of a block to the haze. Returns the units of work.
    fn spread(&mut self, node: &Node, deposit: &Deposit) -> u64 {
        let Some(pigment) = self.pigment(node) else { return 1 };
        self.stats.strokes += 1;
        let [across, _, down] = deposit.squares(&self.measure, node);
        let amount = deposit.amount(&self.measure, node).units(self.sheets[0].exponent);
        self.haze.add(node.place.point(deposit.centre), [across, down], amount, pigment);
        1
    }
}
