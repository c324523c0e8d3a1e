//! The strokes of a plot: every stroke of the drawing. If the drawing is cut, a block smaller than the pen becomes one
//! stroke.
//!
//! A shared drawing may place the same block very often. So the work and the strokes are bounded by the sheet, not by
//! the drawing: a block that is placed a second time where it is already is passed over, and where parts are smaller
//! than the pen a spot is drawn once ([`Spots`]).

use super::hatch;
use crate::facts::BlockFacts;
use crate::options::PlotOptions;
use crate::page::{Page, Point, distance};
use crate::pens::Pens;
use crate::spots::Spots;
use lsystem_base::LimitName;
use lsystem_drawing::{BlockFrame, BlockId, Directions, Drawing, Item, Line, Placed, Polygon, StyleChange, Widths};
use lsystem_syntax::style::gradient_step;
use lsystem_syntax::{ColourSource, Diagnostic, Halt, Style, Tint, Work};
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

/// Reads the strokes of a drawing.
pub(crate) struct Gather<'a> {
    drawing: &'a Drawing,
    style: &'a Style,
    facts: &'a BlockFacts,
    page: &'a Page,
    options: PlotOptions,
    /// Whether parts smaller than the pen become one stroke.
    pub(crate) is_cut: bool,
    /// The strokes so far.
    pub(crate) pens: Pens,
    /// The most open blocks.
    pub(crate) most_blocks: u64,
    /// The blocks opened so far.
    blocks: u64,
    /// The segments and polygons before the next item.
    passed: [u128; 2],
    all: f64,
    directions: Directions,
    /// The open blocks, outermost first: the items that remain, and the frame.
    open: Vec<(core::slice::Iter<'a, Item>, BlockFrame)>,
    /// The distinct ways to place a block, without the position.
    variants: HashMap<Variant, u32>,
    /// The placed blocks so far: the variant, and the position in steps of [`SAME`] or of [`BESIDE`].
    placed: HashSet<(u32, [i64; 2])>,
    pub(crate) spots: Spots,
}

/// A block in a direction, at a scale and in a style: whether positions are in steps of [`BESIDE`], the bits of the scale and the width,
/// and the visible colour and level.
type Variant = (BlockId, u64, bool, u64, [u64; 2], i32, u32);

impl<'a> Gather<'a> {
    /// No strokes so far, and no limits.
    pub(crate) fn new(
        drawing: &'a Drawing,
        style: &'a Style,
        facts: &'a BlockFacts,
        page: &'a Page,
        options: PlotOptions,
    ) -> Self {
        Self {
            drawing,
            style,
            facts,
            page,
            options,
            is_cut: false,
            pens: Pens::new(page, &options),
            most_blocks: u64::MAX,
            blocks: 0,
            passed: [0; 2],
            all: drawing.segment_count() as f64,
            directions: Directions::default(),
            open: Vec::new(),
            variants: HashMap::new(),
            placed: HashSet::new(),
            spots: Spots::new(options.pen),
        }
    }

    /// Reads the whole drawing.
    ///
    /// # Errors
    /// If there are too many strokes or blocks.
    pub(crate) fn read(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        self.open.extend(self.drawing.root.map(|root| (self.drawing.items_of(root).iter(), self.page.frame)));
        while let Some((items, frame)) = self.open.last_mut() {
            work.charge(4)?;
            let Some(item) = items.next() else {
                self.open.pop();
                continue;
            };
            let frame = *frame;
            match item {
                Item::Stroke(own) => {
                    self.line(&Line::new(own, self.drawing), &frame, work)?;
                    self.passed[0] = self.passed[0].saturating_add(1);
                }
                Item::Polygon(polygon) => self.polygon(polygon, &frame, work)?,
                Item::Block(placed) => self.enter(placed, &frame, work)?,
            }
            // A spot may get a stroke of its own.
            if self.pens.count.max(self.spots.count()) > self.pens.most {
                return Err(self.pens.too_many());
            }
        }
        for number in 0..self.spots.count() as usize {
            work.charge(4)?;
            if let Some((layer, ends)) = self.spots.lone(number) {
                self.pens.stroke(layer, ends);
            }
        }
        Ok(())
    }

    /// Draws the outline of a polygon, and its hatch lines if they are asked for.
    fn polygon(&mut self, polygon: &Polygon, frame: &BlockFrame, work: &mut dyn Work) -> Result<(), Halt> {
        work.charge(u64::from(polygon.count))?;
        let drawing = self.drawing;
        let vertices: Vec<Point> =
            drawing.vertices_of(polygon).iter().map(|&vertex| self.down(frame.transform(vertex))).collect();
        let layer = self.layer(&frame.style.then(&drawing.styles[polygon.style.0 as usize]));
        let ends = vertices.iter().copied().zip(vertices.iter().copied().cycle().skip(1));
        ends.for_each(|(from, to)| self.pens.stroke(layer, [from, to]));
        self.passed[1] = self.passed[1].saturating_add(1);
        if !self.options.hatch {
            return Ok(());
        }
        let pen = self.options.pen;
        let left = self.pens.most.checked_sub(self.pens.count).ok_or_else(|| self.pens.too_many())?;
        let crossings = hatch::crossings(&vertices, pen, left, work)?.ok_or_else(|| self.pens.too_many())?;
        for line in hatch::lines(crossings, pen) {
            work.charge(1)?;
            line.into_iter().for_each(|ends| self.pens.stroke(layer, ends));
        }
        Ok(())
    }

    /// Opens a placed block, or draws it as one stroke, or passes it over.
    fn enter(&mut self, placed: &Placed, outer: &BlockFrame, work: &mut dyn Work) -> Result<(), Halt> {
        let (drawing, facts) = (self.drawing, self.facts);
        let frame = outer.place(placed, drawing, &mut self.directions);
        let block = &drawing.blocks[placed.block.0 as usize];
        let scale = frame.scale.abs();
        let (pen, diameter) = (self.options.pen, facts.diameter(placed.block) * scale);
        let passed = self.passed;
        let pass = [block.segments, block.polygons];
        let is_plain = self.style.colour_by.source().is_shared() || self.has_one_step(pass);
        let one_stroke = facts.straight(placed.block).copied().filter(|_| is_plain);
        if let Some(line) = one_stroke {
            self.line(&line, &frame, work)?;
        } else if self.is_cut && diameter < pen {
            self.line(&facts.chord(placed.block, drawing), &frame, work)?;
        } else if block.segments >= FEW && is_plain && self.is_known(placed.block, &frame) {
            work.charge(4)?;
        } else if self.is_cut && diameter < LOCAL * pen && self.is_full(placed.block, &frame) {
            work.charge(64)?;
        } else {
            self.blocks += 1;
            if self.blocks > self.most_blocks {
                return Err(Diagnostic::limit(LimitName::PlotBlocks, self.most_blocks, None).into());
            }
            self.open.push((drawing.contents(block).iter(), frame));
            return Ok(());
        }
        self.passed = [0, 1].map(|kind| passed[kind].saturating_add(pass[kind]));
        Ok(())
    }

    /// The place along the path after `passed` segments and polygons.
    fn place(&self, passed: [u128; 2]) -> f64 {
        let mark = usize::try_from(passed[0].saturating_add(passed[1])).unwrap_or(usize::MAX);
        let own = if self.all > 0.0 { (passed[0] as f64 + 0.5) / self.all } else { 0.0 };
        self.drawing.places.get(mark).copied().unwrap_or(own)
    }

    /// Whether the next marks have the same step of the gradient along the path.
    fn has_one_step(&self, next: [u128; 2]) -> bool {
        let last = [0, 1].map(|kind| self.passed[kind].saturating_add(next[kind].saturating_sub(1)));
        let [a, b] = [self.passed, last].map(|passed| gradient_step(self.place(passed)));
        // With places of their own, the marks between the first and the last may have any.
        a == b && self.drawing.places.is_empty()
    }

    /// Whether a block is drawn at this place already; from now on it is.
    fn is_known(&mut self, block: BlockId, frame: &BlockFrame) -> bool {
        let is_cut = self.is_cut && self.facts.finest(block) * frame.scale.abs() < self.options.pen;
        let widths = frame.style.widths();
        let widest = widths.widest(self.drawing.blocks[block.0 as usize].widest) * self.page.step;
        let is_broad = self.options.hatch && widest > self.options.pen;
        let (colour, level) = match self.style.colour_by.source() {
            ColourSource::Along => (gradient_step(self.place(self.passed)) as i32, 0),
            ColourSource::Constant | ColourSource::Index | ColourSource::Level | ColourSource::Ink => {
                frame.style.seen(self.style)
            }
        };
        let widths = if is_broad { widths } else { Widths::new(0.0) };
        let variant = (block, frame.heading.units(), is_cut, frame.scale.to_bits(), widths.key(), colour, level);
        let next = self.variants.len() as u32;
        let variant = *self.variants.entry(variant).or_insert(next);
        let cell = if is_cut { BESIDE * self.options.pen } else { SAME };
        let place = frame.at.map(|value| libm::round(value / cell) as i64);
        // Beyond the limit, blocks are only read more than once.
        if self.placed.len() as u64 >= self.pens.most {
            return self.placed.contains(&(variant, place));
        }
        !self.placed.insert((variant, place))
    }

    /// Whether all spots of a box around a block have ink of its colour.
    fn is_full(&mut self, block: BlockId, frame: &BlockFrame) -> bool {
        let drawing = self.drawing;
        let layer = self.layer(&frame.style.then(&self.facts.chord(block, drawing).style));
        let corners = drawing.corners_of(&drawing.blocks[block.0 as usize]);
        self.spots.is_full(layer, corners.iter().map(|&corner| self.down(frame.transform(corner))))
    }

    /// Draws a line of a block, or what is new of it if the drawing has parts smaller than the pen.
    fn line(&mut self, line: &Line, frame: &BlockFrame, work: &mut dyn Work) -> Result<(), Halt> {
        let change = frame.style.then(&line.style);
        let layer = self.layer(&change);
        let ends = [line.from, line.to].map(|end| self.down(frame.transform(end)));
        let [first, last] = change.widths().ends();
        if self.options.hatch && first.max(last) * self.page.step > self.options.pen && ends[0] != ends[1] {
            for (ends, widths) in line.parts(change.widths()) {
                let ends = ends.map(|end| self.down(frame.transform(end)));
                let widths = widths.ends().map(|width| width * self.page.step);
                let left = self.pens.most.saturating_sub(self.pens.count) + 1;
                hatch::broad(ends, widths, self.options.pen, left).for_each(|ends| self.pens.stroke(layer, ends));
            }
        } else if !self.is_cut {
            self.pens.stroke(layer, ends);
        } else if distance(ends[0], ends[1]) < self.options.pen {
            self.spots.dot(layer, ends).into_iter().for_each(|ends| self.pens.stroke(layer, ends));
        } else {
            work.charge(self.spots.steps(ends))?;
            self.spots.stretches(layer, ends).into_iter().for_each(|ends| self.pens.stroke(layer, ends));
        }
        Ok(())
    }

    /// The layer of a stroke in this style, after the marks passed so far.
    fn layer(&mut self, change: &StyleChange) -> u32 {
        let place = if self.style.colour_by.source().is_shared() { 0.0 } else { self.place(self.passed) };
        let rgb = self.style.colour_of(Tint { index: change.colour.of(0), level: change.level, place }).rgb;
        self.pens.layer(rgb)
    }

    /// A point of the sheet with y down.
    fn down(&self, [x, y]: Point) -> Point {
        [x, self.page.size[1] - y]
    }
}
