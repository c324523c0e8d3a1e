//! The descent that adds ink up.

use super::Pass;
use super::bands::bands;
use super::facts::Facts;
use super::haze::Haze;
use super::ink::Ink;
use super::look::Look;
use super::pigment::{Pigments, Source};
use super::sheet::{LEAST, Pigment, Sheet};
use super::tile::{self, InkKey, Tiles};
use crate::plane::descent::{Cut, Descent, Met, Node};
use crate::plane::inks::{InkTable, Inks, Shade};
use crate::plane::tile::Key;
use crate::plane::view::Camera;
use crate::plane::{Amount, Pane, RenderStats, View, Viewport};
use lsystem_drawing::{Drawing, Item};
use lsystem_syntax::{Meter, Progress, Style};

/// The largest extent, in pixels, at which all ink of a block is added at its centre of gravity, unless that takes too long.
const TINY: f64 = 1.0;
/// A straight block longer than this, in pixels, is taken apart, so that rounding stays far below a pixel.
const LONG: f64 = 1e6;
/// Strokes wider than twice this, in pixels, are not drawn into tiles, and a block of them is no dot.
const BROAD: f64 = 16.0;
/// Sums are kept below this power of two.
const LARGEST: i32 = 100;

/// Blocks of this extent, in pixels, and smaller ones are put together from tiles.
const TILED: f64 = 64.0;
/// So many larger blocks are looked into at most; where that is not enough, larger ones are drawn as haze.
const PATIENCE: u64 = 40_000;
/// A picture is true as long as it takes no more steps than this, and so many for each of its sums: blocks looked into,
/// strokes and stamps. Then ever larger blocks are taken for dots.
const TIRED: u64 = 200_000;
const EACH: u64 = 16;
/// Units of work that strokes and areas take, beside, in the time of a step.
const UNITS: u64 = 16;
/// What is being done for a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stage {
    /// Leaving out the segments that are not to be shown.
    Cut,
    /// Looking how many blocks there are whose extent is larger than `grain` pixels.
    Survey { visits: u64, grain: f64, all: Amount, rising: bool },
    /// Drawing them, and as haze what is not larger than `grain`: 0 where all is drawn.
    Draw { grain: f64 },
    /// Adding the haze.
    Settle { grain: f64 },
    #[default]
    Done,
}

/// A block on a sheet, in pixels.
struct Seen {
    /// The middle of its bounds.
    centre: [f64; 2],
    /// How far it reaches from there, across and down.
    reach: [f64; 2],
    /// Of its widest stroke.
    width: f64,
    /// The longer side of its bounds.
    extent: f64,
}

/// A tile being made.
struct Making {
    key: InkKey,
    /// The stack's height before.
    height: usize,
    size: usize,
    /// From the pixel of the origin to the tile's upper left corner.
    corner: [i64; 2],
    /// Where it is to be added: a sheet, the pixel of the origin, and its pigment.
    sheet: usize,
    pixel: [i64; 2],
    pigment: Pigment,
}

/// A picture that has been asked for.
struct Plan {
    style: Style,
    pane: Pane,
    pass: Pass,
    camera: Camera,
    samples: f64,
    upto: Option<u128>,
}

/// A picture in the making.
#[derive(Default)]
pub(super) struct Walk {
    /// What is to be made, until the drawing is ready for it.
    plan: Option<Plan>,
    /// How far segments have been left out, if some are.
    cut: Option<Cut>,
    /// A block whose pigment has been asked for.
    waiting: Option<Node>,
    /// The sheet on which a polygon is being filled.
    filled: usize,
    /// The largest extent, in pixels, at which all ink of a block is added at its centre of gravity.
    tiny: f64,
    /// The steps after which it becomes larger.
    patience: u64,
    /// Units of work that strokes and areas took.
    laid: u64,
    descent: Descent,
    table: InkTable,
    pigments: Pigments,
    /// The picture, then a sheet for each size of tile.
    sheets: [Sheet; 1 + tile::SIZES],
    tiles: Tiles,
    stack: Vec<Node>,
    making: Vec<Making>,
    look: Look,
    /// The exponent of the unit of tiles.
    unit: i32,
    /// Whether blocks may recur.
    repeats: bool,
    /// Where the descent starts.
    start: Vec<Node>,
    stage: Stage,
    /// The grain of the last survey that found few blocks enough, and their ink.
    found: Option<(f64, Amount)>,
    pass: Pass,
    /// Pixels around a pane whose haze is spread into it.
    apron: usize,
    /// What a survey of the whole picture found for its panes: the grain, and all ink.
    surveyed: (f64, Amount),
    haze: Haze,
    pub stats: RenderStats,
}

impl Walk {
    /// Forgets everything about the drawing there was.
    pub(super) fn clear(&mut self) {
        self.descent.path.clear();
        self.table.clear();
        self.pigments.clear();
        self.tiles.clear();
        self.stop();
    }

    /// Gives up the picture that is being made.
    fn stop(&mut self) {
        (self.plan, self.cut, self.waiting) = (None, None, None);
        self.pigments.stop();
        self.stack.clear();
        self.start.clear();
        self.making.clear();
        self.stage = Stage::Done;
    }

    /// Starts the sums of a pane with so many sums along the side of a pixel.
    pub(super) fn begin(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        (viewport, view): (Viewport, View),
        samples: f64,
        upto: Option<u128>,
        (pane, pass): (Pane, Pass),
    ) {
        self.stop();
        self.apron = 0;
        self.stats = RenderStats::default();
        self.repeats = drawing.memoised;
        let camera = Camera::new(drawing, viewport, view, samples).of_pane(pane, samples);
        let hairline = viewport.least_width(style) * samples;
        let look = Look { hairline, step: camera.step, scale: camera.scale };
        let changed = self.table.choose(drawing, style);
        // Rough tiles would spoil this picture.
        let rough = core::mem::replace(&mut self.tiny, TINY) > TINY;
        if self.pigments.prepare(style, self.table.choice.colours) | changed | rough || look != self.look {
            self.look = look;
            self.tiles.clear();
        }
        self.plan = Some(Plan { style: style.clone(), pane, pass, camera, samples, upto });
    }

    /// Finds out what the picture needs to know of the drawing, and empties the sheet.
    pub(super) fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        let Some(plan) = self.plan.take() else { return Progress::Done };
        if self.table.prepare(drawing, meter) == Progress::More
            || self.descent.path.prepare(drawing, &plan.style, meter) == Progress::More
        {
            self.plan = Some(plan);
            return Progress::More;
        }
        let Plan { pane, pass, samples, .. } = plan;
        let size = [pane.width, pane.height].map(|side| (f64::from(side) * samples).ceil() as usize);
        let planes = if self.table.used().len() > 1 { 4 } else { 1 };
        if pass == Pass::Survey {
            self.sheets[0].outline(size, planes);
        } else if self.sheets[0].empty(size, planes, meter) == Progress::More {
            self.plan = Some(plan);
            return Progress::More;
        }
        let Plan { camera, upto, .. } = plan;
        (self.patience, self.laid) = (TIRED + EACH * (size[0] * size[1]) as u64, 0);
        self.start.extend(self.descent.root(drawing, camera));
        self.cut = upto.map(Cut::new);
        (self.stage, self.pass) = (Stage::Cut, pass);
        Progress::Done
    }

    /// Starts to look at the drawing, unless that has been done for the whole picture.
    fn look_around(&mut self) -> u64 {
        if matches!(self.pass, Pass::Count | Pass::Show) {
            let (grain, all) = self.surveyed;
            return self.draw(grain, all);
        }
        self.found = None;
        self.survey(4.0 * self.sheets[0].width.max(self.sheets[0].height) as f64, false);
        0
    }

    /// Starts looking how many blocks are larger than `grain`; `rising` says that there were too many with less.
    fn survey(&mut self, grain: f64, rising: bool) {
        self.stage = Stage::Survey { visits: 0, grain, all: Amount::default(), rising };
        self.stack.clone_from(&self.start);
    }

    /// Starts drawing so much ink in all.
    fn draw(&mut self, grain: f64, all: Amount) -> u64 {
        if self.pass == Pass::Survey {
            (self.surveyed, self.stage) = ((grain, all), Stage::Done);
            return 0;
        }
        self.stage = Stage::Draw { grain };
        self.stack.clone_from(&self.start);
        let exponent = exponent(all);
        // Tiles are in the picture's unit.
        if exponent != self.unit {
            self.unit = exponent;
            self.tiles.clear();
        }
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
                    meter.charge(self.look_around());
                }
                Stage::Survey { .. } => meter.charge(self.look(drawing, facts)),
                Stage::Draw { .. } if !self.sheets[self.filled].is_filled() => {
                    let before = meter.spent();
                    self.sheets[self.filled].go_on(meter);
                    self.laid += meter.spent() - before;
                }
                Stage::Draw { .. } if self.pigments.is_asked() => {
                    let source = Source { drawing, table: &self.table, inks: &facts.inks.list };
                    self.pigments.step(source, meter);
                }
                Stage::Draw { grain } => meter.charge(match self.waiting.take() {
                    Some(node) => self.block(drawing, facts, node, grain),
                    None => self.go_on(drawing, facts, grain),
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

    /// Looks at one block more. Blocks are looked for that are ever smaller, until the rest can be left to tiles or there
    /// are too many of them.
    fn look(&mut self, drawing: &Drawing, facts: &Facts) -> u64 {
        let Stage::Survey { visits, grain, all, rising } = &mut self.stage else { return 0 };
        if *visits > PATIENCE {
            let (grain, rising) = (*grain, *rising);
            match self.found.filter(|_| !rising) {
                Some((grain, all)) => return self.draw(grain, all),
                None => self.survey(16.0 * grain, true),
            }
            return 0;
        }
        match self.descent.next(drawing, self.table.choice, &mut self.stack, 0) {
            None => {
                let (grain, all, rising) = (*grain, *all, *rising);
                if rising || grain <= TILED {
                    return self.draw(if rising { grain } else { 0.0 }, all);
                } else {
                    self.found = Some((grain, all));
                    self.survey((grain / 4.0).max(TILED), false);
                }
            }
            Some(Met { item: Item::Block(_), node }) => {
                let Some(seen) = self.seen(drawing, facts, &node) else { return 0 };
                let ink = facts.ink(&node);
                let Stage::Survey { visits, grain, all, .. } = &mut self.stage else { return 0 };
                *visits += 1;
                if seen.extent > *grain {
                    self.stack.push(node);
                } else {
                    let amount = self.look.amount(ink, &node);
                    *all = all.plus(amount);
                }
            }
            Some(Met { node, .. }) => {
                // More than any stroke has that is in the picture.
                let amount = Amount::new(self.width(node.pen.width)).times(self.sheets[0].numbers() as f64);
                let Stage::Survey { visits, all, .. } = &mut self.stage else { return 0 };
                *visits += 1;
                *all = all.plus(amount);
            }
        }
        0
    }

    /// Draws one item more.
    fn go_on(&mut self, drawing: &Drawing, facts: &Facts, grain: f64) -> u64 {
        let floor = self.making.last().map_or(0, |making| making.height);
        match self.descent.next(drawing, self.table.choice, &mut self.stack, floor) {
            None => {
                let Some(making) = self.making.pop() else {
                    self.stage = if grain > 0.0 { Stage::Settle { grain } } else { Stage::Done };
                    return 0;
                };
                let tile = self.tiles.insert(making.key, &self.sheets[1 + making.size], making.corner);
                self.stats.tiles += 1;
                // To keep it.
                let sheet = &self.sheets[1 + making.size];
                let kept = (sheet.height + sheet.values.len() / 64) as u64;
                kept + self.stamp(&tile, making.sheet, making.pixel, making.pigment)
            }
            Some(Met { item: Item::Stroke(stroke), node }) => {
                let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
                self.stroke(&node, ends, node.pen.width, node.pen.shade)
            }
            Some(Met { item: Item::Polygon(polygon), node }) => {
                self.stats.strokes += 1;
                let vertices = drawing.vertices_of(polygon).iter().map(|&vertex| node.place.point(vertex));
                let pigment = self.pigments.of(node.pen.shade);
                self.filled = node.canvas;
                let sheet = &mut self.sheets[node.canvas];
                sheet.fill(vertices, sheet.layer(), pigment)
            }
            Some(Met { item: Item::Block(_), node }) => self.block(drawing, facts, node, grain),
        }
    }

    /// The width of strokes, in pixels.
    fn width(&self, width: f64) -> f64 {
        self.look.width(width)
    }

    /// Where a block is on its sheet; `None` where nothing of it shows.
    fn seen(&self, drawing: &Drawing, facts: &Facts, node: &Node) -> Option<Seen> {
        let shape = facts.shape(node);
        let place = &node.place;
        let width = self.width(drawing.blocks[node.block.0 as usize].widest.of(node.pen.width));
        let centre = place.point(shape.centre);
        let reach = [
            place.cos.abs() * shape.half[0] + place.sin.abs() * shape.half[1] + width / 2.0,
            place.sin.abs() * shape.half[0] + place.cos.abs() * shape.half[1] + width / 2.0,
        ];
        let [low, high] = [-1.0, 1.0].map(|sign| [0, 1].map(|axis| centre[axis] + sign * reach[axis]));
        let extent = 2.0 * place.scale.abs() * shape.half[0].max(shape.half[1]);
        let apron = if node.canvas == 0 { self.apron as f64 } else { 0.0 };
        let (near, far) = (low.map(|at| at - apron), high.map(|at| at + apron));
        let shows = shape.strokes > 0 && !self.sheets[node.canvas].misses(near, far);
        shows.then_some(Seen { centre, reach, width, extent })
    }

    fn stroke(&mut self, node: &Node, ends: [[f64; 2]; 2], width: f64, shade: Shade) -> u64 {
        self.stats.strokes += 1;
        let (width, pigment) = (self.width(width), self.pigments.of(shade));
        self.filled = node.canvas;
        let sheet = &mut self.sheets[node.canvas];
        let work = sheet.stroke(ends, width, sheet.layer(), pigment);
        self.laid += work;
        work
    }

    /// Lays down all ink of a block that is small beside the width of its strokes, as two bands that cross.
    fn bands(&mut self, ink: &Ink, node: &Node, pigment: Pigment) -> u64 {
        let (corners, area) = bands(&self.look, ink, node);
        let amount = self.look.amount(ink, node);
        self.filled = node.canvas;
        let sheet = &mut self.sheets[node.canvas];
        let layer = (amount.units(sheet.exponent) / area).max(LEAST);
        let work = sheet.fill(corners, layer, pigment);
        self.laid += work;
        work
    }

    fn stamp(&mut self, tile: &tile::Tile, sheet: usize, pixel: [i64; 2], pigment: Pigment) -> u64 {
        self.stats.stamps += 1;
        let at = [0, 1].map(|axis| pixel[axis] + tile.corner[axis]);
        self.sheets[sheet].stamp(&self.tiles.stamp(tile), at, pigment)
    }

    /// What a block is drawn with, as a whole; `None` where that has to be found first, and it is put off.
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

    /// Takes ever larger blocks for dots, the longer the picture takes.
    fn grow_tiny(&mut self) {
        // Without repeats there are no more steps than the drawing has segments, but each may be wide.
        let steps = self.stats.blocks + self.stats.strokes + self.stats.stamps;
        if self.laid / UNITS + if self.repeats { steps } else { 0 } > self.patience {
            self.tiny *= 2.0;
            self.patience += self.patience / 4;
        }
    }

    /// Draws a block, or puts it on the stack.
    fn block(&mut self, drawing: &Drawing, facts: &Facts, mut node: Node, grain: f64) -> u64 {
        let Some(Seen { centre, reach, width, extent }) = self.seen(drawing, facts, &node) else { return 0 };
        let (shape, place) = (facts.shape(&node), node.place);
        let ink = facts.ink(&node);
        // A part of the path that has one colour is like any other block.
        let plain = !self.descent.path.counts() || node.canvas != 0 || node.span.is_short();
        if let Some(line) = shape.line.as_ref().filter(|_| ink.even && plain && extent < LONG) {
            let ends = [line.from, line.to].map(|p| place.point(p));
            let pen = node.pen.after(self.table.choice, &line.style);
            return self.stroke(&node, ends, pen.width, pen.shade);
        }
        self.grow_tiny();
        if extent <= self.tiny {
            let Some(pigment) = self.pigment(&node) else { return 1 };
            self.stats.strokes += 1;
            self.stats.outlines += u64::from(self.tiny > TINY);
            if width > 2.0 * BROAD && !ink.length.is_zero() {
                return self.bands(ink, &node, pigment);
            }
            let amount = self.look.amount(ink, &node);
            let sheet = &mut self.sheets[node.canvas];
            sheet.dot(place.point(ink.centre), amount.units(sheet.exponent).max(LEAST) as f32, pigment);
            return 1;
        }
        if extent <= grain {
            let Some(pigment) = self.pigment(&node) else { return 1 };
            self.stats.strokes += 1;
            let [across, _, down] = self.look.squares(ink, &node);
            let amount = self.look.amount(ink, &node).units(self.sheets[0].exponent);
            self.haze.add(place.point(ink.centre), [across, down], amount, pigment);
            return 1;
        }
        let mut cleared = 0;
        if let Some(size) = tile::size(extent, shape.strokes).filter(|_| !self.tiles.crowded || extent < 20.0)
            && size + 1 > node.canvas
            && width <= 2.0 * BROAD
            && self.repeats
            && plain
        {
            let many = self.table.of(node.block.0 as usize) == Inks::Many;
            let pigment = if many { Some(Pigment::default()) } else { self.pigment(&node) };
            let Some(pigment) = pigment else { return 1 };
            let fine = !self.tiles.crowded && tile::is_sparse(extent, shape.strokes);
            let (pixel, offset, rest) = tile::snap(place.origin, fine);
            let key = InkKey {
                key: Key {
                    block: node.block,
                    heading: place.heading,
                    scale: crate::plane::tile::scale(place.scale),
                    offset,
                    fine,
                    width: (width > self.look.hairline).then_some(node.pen.width.to_bits()),
                },
                shade: many.then_some(node.pen.shade.number),
            };
            if let Some(tile) = self.tiles.get(&key) {
                return self.stamp(&tile, node.canvas, pixel, pigment);
            }
            let from_origin = [0, 1].map(|axis| centre[axis] - place.origin[axis] + rest[axis]);
            // Ink goes to all pixels around it.
            let corner = [0, 1].map(|axis| (from_origin[axis] - reach[axis]).floor() as i64 - 1);
            let far = [0, 1].map(|axis| (from_origin[axis] + reach[axis]).ceil() as i64 + 1 - corner[axis]);
            let far = far.map(|side| side.max(1) as usize);
            let planes = if many { 4 } else { 1 };
            if Tiles::fits(far, planes) {
                let sheet = node.canvas;
                cleared = self.sheets[1 + size].reset(far, planes, self.unit);
                node.place.origin = [0, 1].map(|axis| rest[axis] - corner[axis] as f64);
                node.canvas = 1 + size;
                if !many {
                    node.pen.shade = Shade::default();
                }
                self.making.push(Making { key, height: self.stack.len(), size, corner, sheet, pixel, pigment });
            }
        }
        self.stats.blocks += 1;
        self.stack.push(node);
        1 + cleared
    }
}

/// The exponent of a unit in which so much ink can be held.
fn exponent(all: Amount) -> i32 {
    all.exponent().map_or(0, |exponent| (exponent - LARGEST).max(0))
}
