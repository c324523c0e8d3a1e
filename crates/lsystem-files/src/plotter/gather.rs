//! The strokes of a plot: every stroke of the drawing. If the drawing is cut, a block smaller than the pen becomes one
//! stroke.
//!
//! A shared drawing may place the same block very often. So the work and the strokes are bounded by the sheet, not by
//! the drawing: a block that is placed a second time where it is already is passed over, and where parts are smaller
//! than the pen a spot is drawn once ([`Spots`]).

use super::facts::BlockFacts;
use super::hatch::{self, Fill};
use super::merge::LEAST;
use super::options::PlotOptions;
use super::page::{Page, Point, distance};
use super::spots::Spots;
use crate::compact::visible;
use core::ops::Range;
use lsystem_drawing::{BlockId, Directions, Drawing, Frame, Item, Line, Placed, StyleChange};
use lsystem_syntax::style::gradient_step;
use lsystem_syntax::{ColourBy, Diagnostic, LimitName, Meter, Progress, Style, Tint};
use std::collections::{HashMap, HashSet};

/// The distance up to which two placements of a block are the same, in millimetres: far above rounding errors and far
/// below the steps of a plotter.
const SAME: f64 = 1e-6;
/// The distance up to which two placements of a block with parts smaller than the pen are the same, in pens.
const BESIDE: f64 = 0.5;
/// Blocks smaller than this are passed over if all their spots are full, in pens.
const LOCAL: f64 = 8.0;
/// Blocks of fewer segments are read at each place: that takes no longer than to look them up.
const FEW: u128 = 4;

/// Receives the strokes: the layer and the ends.
pub(super) trait Strokes {
    fn add(&mut self, layer: u32, ends: [Point; 2]);
}

/// Reads the strokes of a drawing in steps.
#[derive(Clone, Debug)]
pub(super) struct Gather {
    page: Page,
    options: PlotOptions,
    /// The most strokes, and the most open blocks.
    most: u64,
    most_blocks: u64,
    /// The strokes so far.
    count: u64,
    /// The blocks opened so far.
    blocks: u64,
    /// The segments and polygons before the next item.
    passed: [u128; 2],
    all: f64,
    directions: Directions,
    /// The open blocks, outermost first: the items that remain, and the frame.
    open: Vec<(Range<u32>, Frame)>,
    /// The layers' colours, in the order of their first strokes.
    pub(super) colours: Vec<[u8; 3]>,
    layers: HashMap<[u8; 3], u32>,
    /// The distinct ways to place a block, without the position.
    variants: HashMap<Variant, u32>,
    /// The placed blocks so far: the variant, and the position in steps of [`SAME`] or of [`BESIDE`].
    placed: HashSet<(u32, [i64; 2])>,
    /// Whether parts smaller than the pen become one stroke.
    is_cut: bool,
    pub(super) spots: Spots,
    /// The spots of which the lone strokes are drawn.
    lone: usize,
    /// The polygon being hatched, and its layer.
    fill: Option<(u32, Fill)>,
    /// The end of the last stroke of each layer, and the travel so far in drawing order.
    last: Vec<Point>,
    travel: f64,
}

/// A block in a direction, at a scale and in a style: whether positions are in steps of [`BESIDE`], the bits of the scale and the width,
/// and the visible colour and level.
type Variant = (BlockId, u64, bool, u64, u64, i32, u32);

impl Gather {
    /// Prepares the reading of at most this many strokes and blocks, with or without a cut at the pen's width.
    pub(super) fn new(
        drawing: &Drawing,
        page: Page,
        options: PlotOptions,
        [most, most_blocks]: [u64; 2],
        is_cut: bool,
    ) -> Self {
        let mut open = Vec::new();
        if let Some(root) = drawing.root {
            open.push((drawing.blocks[root.0 as usize].items.clone(), page.frame));
        }
        Self {
            page,
            options,
            most,
            most_blocks,
            count: 0,
            blocks: 0,
            passed: [0; 2],
            all: drawing.segment_count() as f64,
            directions: Directions::default(),
            open,
            colours: Vec::new(),
            layers: HashMap::new(),
            variants: HashMap::new(),
            placed: HashSet::new(),
            is_cut,
            spots: Spots::new(options.pen),
            lone: 0,
            fill: None,
            last: Vec::new(),
            travel: 0.0,
        }
    }

    /// Continues until the meter is spent.
    ///
    /// # Errors
    /// If there are too many strokes or blocks.
    pub(super) fn step(
        &mut self,
        (drawing, style, facts): (&Drawing, &Style, &BlockFacts),
        strokes: &mut impl Strokes,
        meter: &mut Meter,
    ) -> Result<Progress, Diagnostic> {
        while !meter.is_spent() {
            if let Some((layer, mut fill)) = self.fill.take() {
                let left = self.most - self.count;
                let progress = fill.step(left, meter, |ends| self.stroke(layer, ends, strokes));
                match progress {
                    None => return Err(self.too_many()),
                    Some(Progress::More) => self.fill = Some((layer, fill)),
                    Some(Progress::Done) => {}
                }
                continue;
            }
            meter.charge(4);
            let Some((items, frame)) = self.open.last_mut() else {
                if self.lone as u64 == self.spots.count() {
                    return Ok(Progress::Done);
                }
                let lone = self.spots.lone(self.lone);
                lone.into_iter().for_each(|(layer, ends)| self.stroke(layer, ends, strokes));
                self.lone += 1;
                continue;
            };
            let Some(item) = items.next() else {
                self.open.pop();
                continue;
            };
            let frame = *frame;
            match &drawing.items[item as usize] {
                Item::Stroke(own) => {
                    self.line((style, drawing), &Line::new(own, drawing), &frame, strokes, meter);
                    self.passed[0] = self.passed[0].saturating_add(1);
                }
                Item::Polygon(polygon) => {
                    meter.charge(u64::from(polygon.count));
                    let vertices: Vec<Point> =
                        drawing.vertices_of(polygon).iter().map(|&vertex| self.down(frame.transform(vertex))).collect();
                    let layer =
                        self.layer(style, drawing, &frame.style.then(&drawing.styles[polygon.style.0 as usize]));
                    let ends = vertices.iter().copied().zip(vertices.iter().copied().cycle().skip(1));
                    ends.for_each(|(from, to)| self.stroke(layer, [from, to], strokes));
                    self.passed[1] = self.passed[1].saturating_add(1);
                    if self.options.hatch {
                        self.fill = Some((layer, Fill::new(vertices, self.options.pen)));
                    }
                }
                Item::Block(placed) => self.enter((drawing, style, facts), placed, &frame, strokes, meter)?,
            }
            // A spot may get a stroke of its own.
            if self.count.max(self.spots.count()) > self.most {
                return Err(self.too_many());
            }
        }
        Ok(Progress::More)
    }

    /// The travel of all strokes in drawing order, from the pens' start and back to it.
    pub(super) fn travel_home(&self) -> f64 {
        let home = self.options.start.of(self.page.size);
        self.travel + self.last.iter().map(|&end| distance(end, home)).sum::<f64>()
    }

    fn too_many(&self) -> Diagnostic {
        Diagnostic::limit(LimitName::PlotStrokes, self.most, None)
    }

    /// Opens a placed block, or draws it as one stroke, or passes it over.
    fn enter(
        &mut self,
        (drawing, style, facts): (&Drawing, &Style, &BlockFacts),
        placed: &Placed,
        outer: &Frame,
        strokes: &mut impl Strokes,
        meter: &mut Meter,
    ) -> Result<(), Diagnostic> {
        let frame = outer.place(placed, drawing, &mut self.directions);
        let block = &drawing.blocks[placed.block.0 as usize];
        let scale = frame.scale.abs();
        let (pen, diameter) = (self.options.pen, facts.diameter(placed.block) * scale);
        let passed = self.passed;
        let pass = [block.segments, block.polygons];
        let is_plain = style.colour_by != ColourBy::Path || self.has_one_step(drawing, pass);
        let one_stroke = facts.straight(placed.block).copied().filter(|_| is_plain);
        if let Some(line) = one_stroke {
            self.line((style, drawing), &line, &frame, strokes, meter);
        } else if self.is_cut && diameter < pen {
            self.line((style, drawing), &facts.chord(placed.block, drawing), &frame, strokes, meter);
        } else if block.segments >= FEW && is_plain && self.is_known((drawing, style, facts), placed.block, &frame) {
            meter.charge(4);
        } else if self.is_cut && diameter < LOCAL * pen && self.is_full((style, drawing, facts), placed.block, &frame) {
            meter.charge(64);
        } else {
            self.blocks += 1;
            if self.blocks > self.most_blocks {
                return Err(Diagnostic::limit(LimitName::PlotBlocks, self.most_blocks, None));
            }
            self.open.push((block.items.clone(), frame));
            return Ok(());
        }
        self.passed = [0, 1].map(|kind| passed[kind].saturating_add(pass[kind]));
        Ok(())
    }

    /// The place along the path after `passed` segments and polygons.
    fn place(&self, drawing: &Drawing, passed: [u128; 2]) -> f64 {
        let mark = usize::try_from(passed[0].saturating_add(passed[1])).unwrap_or(usize::MAX);
        let own = if self.all > 0.0 { (passed[0] as f64 + 0.5) / self.all } else { 0.0 };
        drawing.places.get(mark).copied().unwrap_or(own)
    }

    /// Whether the next marks have the same step of the gradient along the path.
    fn has_one_step(&self, drawing: &Drawing, next: [u128; 2]) -> bool {
        let last = [0, 1].map(|kind| self.passed[kind].saturating_add(next[kind].saturating_sub(1)));
        let [a, b] = [self.passed, last].map(|passed| gradient_step(self.place(drawing, passed)));
        // With places of their own, the marks between the first and the last may have any.
        a == b && drawing.places.is_empty()
    }

    /// Whether a block is drawn at this place already; from now on it is.
    fn is_known(
        &mut self,
        (drawing, style, facts): (&Drawing, &Style, &BlockFacts),
        block: BlockId,
        frame: &Frame,
    ) -> bool {
        let is_cut = self.is_cut && facts.finest(block) * frame.scale.abs() < self.options.pen;
        let width = frame.style.width.of(0.0);
        let is_broad =
            self.options.hatch && drawing.blocks[block.0 as usize].widest.of(width) * self.page.step > self.options.pen;
        let (colour, level) = match style.colour_by {
            ColourBy::Path => (gradient_step(self.place(drawing, self.passed)) as i32, 0),
            _ => visible(style, &frame.style),
        };
        let width = if is_broad { width } else { 0.0 };
        let variant = (block, frame.heading.units(), is_cut, frame.scale.to_bits(), width.to_bits(), colour, level);
        let next = self.variants.len() as u32;
        let variant = *self.variants.entry(variant).or_insert(next);
        let cell = if is_cut { BESIDE * self.options.pen } else { SAME };
        let place = frame.at.map(|value| libm::round(value / cell) as i64);
        // Beyond the limit, blocks are only read more than once.
        if self.placed.len() as u64 >= self.most {
            return self.placed.contains(&(variant, place));
        }
        !self.placed.insert((variant, place))
    }

    /// Whether all spots of a box around a block have ink of its colour.
    fn is_full(
        &mut self,
        (style, drawing, facts): (&Style, &Drawing, &BlockFacts),
        block: BlockId,
        frame: &Frame,
    ) -> bool {
        let layer = self.layer(style, drawing, &frame.style.then(&facts.chord(block, drawing).style));
        let corners = drawing.corners_of(&drawing.blocks[block.0 as usize]);
        self.spots.is_full(layer, corners.iter().map(|&corner| self.down(frame.transform(corner))))
    }

    /// Draws a line of a block, or what is new of it if the drawing has parts smaller than the pen.
    fn line(
        &mut self,
        (style, drawing): (&Style, &Drawing),
        line: &Line,
        frame: &Frame,
        strokes: &mut impl Strokes,
        meter: &mut Meter,
    ) {
        let change = frame.style.then(&line.style);
        let layer = self.layer(style, drawing, &change);
        let ends = [line.from, line.to].map(|end| self.down(frame.transform(end)));
        let width = change.width.of(0.0) * self.page.step;
        if self.options.hatch && width > self.options.pen && ends[0] != ends[1] {
            let left = self.most.saturating_sub(self.count) + 1;
            hatch::broad(ends, width, self.options.pen, left).for_each(|ends| self.stroke(layer, ends, strokes));
        } else if !self.is_cut {
            self.stroke(layer, ends, strokes);
        } else if distance(ends[0], ends[1]) < self.options.pen {
            self.spots.dot(layer, ends).into_iter().for_each(|ends| self.stroke(layer, ends, strokes));
        } else {
            meter.charge(self.spots.steps(ends));
            self.spots.stretches(layer, ends).into_iter().for_each(|ends| self.stroke(layer, ends, strokes));
        }
    }

    fn stroke(&mut self, layer: u32, ends: [Point; 2], strokes: &mut impl Strokes) {
        let last = &mut self.last[layer as usize];
        self.travel += distance(*last, ends[0]);
        *last = ends[1];
        // After many iterations, the strokes between blocks are points.
        if distance(ends[0], ends[1]) > LEAST {
            self.count += 1;
            strokes.add(layer, ends);
        }
    }

    /// The layer of a stroke in this style, after the marks passed so far.
    fn layer(&mut self, style: &Style, drawing: &Drawing, change: &StyleChange) -> u32 {
        let place = match style.colour_by {
            ColourBy::Path => self.place(drawing, self.passed),
            _ => 0.0,
        };
        let rgb = style.colour_of(Tint { index: change.colour.of(0), level: change.level, place }).rgb;
        *self.layers.entry(rgb).or_insert_with(|| {
            self.colours.push(rgb);
            self.last.push(self.options.start.of(self.page.size));
            self.colours.len() as u32 - 1
        })
    }

    /// A point of the sheet with y down.
    fn down(&self, [x, y]: Point) -> Point {
        [x, self.page.size[1] - y]
    }
}
