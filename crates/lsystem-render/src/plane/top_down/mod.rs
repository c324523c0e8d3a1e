//! The top-down strategy: the blocks of the graph, the last drawn first, on an explicit stack so that it can stop anywhere.
//!
//! A block that is covered or outside the picture costs one step. A small block that recurs is stamped from its tile.
//! Broad strokes in one colour are painted in [passes](self::passes).

pub(in crate::plane) mod passes;
pub(in crate::plane) mod tile;
pub(in crate::plane) mod tiling;

use super::canvas::stroke::Capsule;
use super::descent::{Cut, Descent, Node};
use super::inks::{Inks, Shade};
use super::painter::{BROAD, Painter};
use super::shape::Shape;
use super::strategy::PATIENCE;
use lsystem_drawing::{Drawing, Item, Polygon, Stroke};
use lsystem_syntax::{Meter, Progress};
use passes::{Passes, sketch};
use tiling::{Bounds, Tiling};

/// The largest extent of an outline at first, in subsamples: four pixels.
const ROUGH: f64 = 16.0;
/// The steps after which that extent doubles.
const DOUBLED: u64 = 100_000;
/// The part of a length that may be rounding.
const ROUNDING: f64 = 1e-9;

/// What the strategies paint, and with what.
pub(super) struct Easel<'a> {
    pub drawing: &'a Drawing,
    pub shapes: &'a [Shape],
    pub painter: &'a mut Painter,
    pub descent: &'a mut Descent,
}

/// A top-down picture in the making, and the tiles of the pictures before.
pub(super) struct TopDown {
    stack: Vec<Node>,
    /// How far segments have been left out, if some are.
    cut: Option<Cut>,
    pub tiling: Tiling,
    passes: Passes,
    /// The largest extent of a block that is painted as its outline, in subsamples.
    pub rough: f64,
    /// The steps after which that extent grows.
    patience: u64,
    /// The blocks so far that were covered.
    pub covered: u64,
}

impl Default for TopDown {
    fn default() -> Self {
        Self {
            stack: vec![],
            cut: None,
            tiling: Tiling::default(),
            passes: Passes::default(),
            rough: 0.0,
            patience: PATIENCE,
            covered: 0,
        }
    }
}

impl TopDown {
    /// Gives up the picture that is being made.
    pub(super) fn stop(&mut self) {
        self.stack.clear();
        self.cut = None;
        self.passes = Passes::default();
        self.tiling.stop();
    }

    /// Starts a picture of a whole drawing, of the segments before `upto` only if that is given. Blocks up to the extent
    /// `rough`, in subsamples, are outlines from the beginning.
    pub(super) fn begin(&mut self, easel: &Easel<'_>, root: Node, upto: Option<u128>, rough: f64) {
        let Easel { drawing, painter, descent, .. } = easel;
        self.covered = 0;
        self.patience = PATIENCE;
        // Tiles with outlines in them would spoil this picture.
        if self.rough != rough {
            self.tiling.clear();
        }
        self.rough = rough;
        let is_free = upto.is_none() && !descent.path.counts();
        let is_plain = matches!(painter.inks.of(root.block.0 as usize), Inks::One(_));
        if is_free && is_plain && (BROAD..f64::INFINITY).contains(&painter.widest(drawing, &root)) {
            self.passes.begin(root);
        } else {
            self.stack.push(root);
            self.cut = upto.map(Cut::new);
        }
    }

    /// Which part of the picture is done; `None` where that takes too long to tell.
    pub(super) fn done(&self, easel: &mut Easel<'_>) -> Option<f64> {
        let Easel { drawing, shapes, painter, descent } = easel;
        let (measure, size) = (painter.measure, painter.canvases[0].size());
        let is_seen = |node: &Node| {
            let (block, shape) = (&drawing.blocks[node.block.0 as usize], &shapes[node.block.0 as usize]);
            let centre = node.place.point(shape.centre);
            !node.place.misses(size, centre, shape.half, measure.widest(block, node.pen.width))
        };
        descent.done(drawing, painter.inks.choice, &self.stack, is_seen)
    }

    /// Goes on with the picture, until it is done, the meter is spent, or the picture has taken more steps than `most`.
    pub(super) fn step(&mut self, easel: &mut Easel<'_>, most: u64, meter: &mut Meter) -> Progress {
        if let Some(cut) = &mut self.cut {
            let choice = easel.painter.inks.choice;
            if easel.descent.leave_out(easel.drawing, choice, &mut self.stack, cut, meter) == Progress::More {
                return Progress::More;
            }
            self.cut = None;
        }
        while !meter.is_spent() && easel.painter.steps() <= most {
            if easel.painter.fill(meter) || self.tiling.finish(easel.painter, self.stack.len(), meter) {
                continue;
            }
            let Some(node) = self.stack.last_mut() else {
                let Some(work) = self.next_pass(easel) else { return Progress::Done };
                meter.charge(work);
                continue;
            };
            if node.cursor <= easel.drawing.blocks[node.block.0 as usize].items.start {
                self.stack.pop();
                continue;
            }
            node.cursor -= 1;
            meter.charge(1);
            let canvas = node.canvas;
            meter.charge(match &easel.drawing.items[node.cursor as usize] {
                Item::Stroke(stroke) => stroke_of(easel, node, stroke),
                Item::Polygon(polygon) => polygon_of(easel, node, polygon),
                Item::Block(placed) => {
                    let child = easel.descent.child(easel.drawing, easel.painter.inks.choice, node, placed);
                    node.span.end -= child.span.size;
                    self.block(easel, &child)
                }
            });
            // To look whether broad strokes are covered takes as long as the strokes do.
            let work = easel.painter.canvases[canvas].take_work();
            easel.painter.add_work(work);
            meter.charge(work);
        }
        Progress::More
    }

    /// Starts the next pass, if there is one; the units of work that this took.
    fn next_pass(&mut self, easel: &mut Easel<'_>) -> Option<u64> {
        let (root, first) = self.passes.next(easel.painter, easel.drawing)?;
        self.stack.push(root);
        Some(if first { sketch(easel, &root) } else { 1 })
    }

    /// Lets the extent of outlines grow with the steps that the picture takes.
    fn grow_rough(&mut self, painter: &Painter) {
        let steps = painter.steps();
        if painter.repeats && steps > self.patience {
            self.rough = if self.rough == 0.0 { ROUGH } else { 2.0 * self.rough };
            self.patience = steps + DOUBLED;
        }
    }

    /// Paints a block, or puts it on the stack; the units of work that this took.
    fn block(&mut self, easel: &mut Easel<'_>, node: &Node) -> u64 {
        let shape = &easel.shapes[node.block.0 as usize];
        if shape.strokes == 0 {
            return 0;
        }
        let place = node.place;
        let radius = easel.painter.widest(easel.drawing, node);
        let (centre, reach) = place.bounds(shape, radius);
        let extent = shape.extent(place.scale);
        let grain = self.passes.grain;
        // A narrow block is for a later pass.
        if self.is_hidden(easel.painter, node, shape, (centre, reach, radius))
            || radius < grain
            || !is_new(easel.painter, node, grain)
        {
            return 1;
        }
        // A part of the path that has one colour is like any other block.
        let is_plain = !easel.descent.path.counts() || node.canvas != 0 || node.span.is_short();
        if let Some(work) = easel.painter.straight(easel.drawing, shape, node, is_plain) {
            return work;
        }
        if extent <= grain {
            return sketch(easel, node);
        }
        self.grow_rough(easel.painter);
        if extent <= self.rough {
            return easel.painter.outline(easel.drawing, shape, node, 2.0 * radius > extent);
        }
        let mut node = *node;
        if grain == 0.0
            && is_plain
            && let Some(size) = self.tiling.tile_size(easel.painter, &node, shape.strokes, extent, radius)
        {
            let bounds = Bounds { centre, reach, radius };
            let height = self.stack.len();
            if let Some(work) = self.tiling.stamp_or_make(easel.painter, (shape, &mut node), bounds, size, height) {
                return work;
            }
        }
        easel.painter.stats.blocks += 1;
        self.stack.push(node);
        1
    }

    /// Whether a block is covered or outside the picture.
    fn is_hidden(
        &mut self,
        painter: &mut Painter,
        node: &Node,
        shape: &Shape,
        (centre, reach, radius): ([f64; 2], [f64; 2], f64),
    ) -> bool {
        let place = node.place;
        let [across, down] = [0, 1]
            .map(|axis| [(centre[axis] - reach[axis]).floor() as i64, (centre[axis] + reach[axis]).ceil() as i64]);
        let canvas = &mut painter.canvases[node.canvas];
        if canvas.is_full(across, down) {
            self.covered += 1;
            return true;
        }
        if node.canvas == 0 && place.misses(canvas.size(), centre, shape.half, radius) {
            return true;
        }
        // Broad strokes leave out the corners of their bounds.
        radius > BROAD.max(shape.extent(place.scale)) && {
            let [from, to] = shape.axis().map(|p| place.point(p));
            let around = radius + place.scale * shape.half[0].min(shape.half[1]);
            Capsule { from, to, radius: around * (1.0 + ROUNDING) }.is_covered(canvas)
        }
    }
}

/// Whether a block has not been painted at this place, in a pass of this grain.
fn is_new(painter: &mut Painter, node: &Node, grain: f64) -> bool {
    let block = u64::from(node.block.0) << 32 ^ node.place.heading.units();
    let properties = [block, tile::scale(node.place.scale), node.pen.width.to_bits(), grain.to_bits()];
    !painter.repeats || painter.is_new(node.canvas, properties, node.place.origin)
}

/// Paints a stroke of a block; the units of work that this took.
fn stroke_of(easel: &mut Easel<'_>, node: &mut Node, stroke: &Stroke) -> u64 {
    let mut pen = node.pen.after(easel.painter.inks.choice, &easel.drawing.styles[stroke.style.0 as usize]);
    if easel.descent.path.counts() && node.canvas == 0 {
        let span = easel.descent.path.stroke(node.block, node.span);
        pen.shade = Shade { number: span.ink(), fixed: true };
        node.span.end -= span.size;
    }
    let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
    easel.painter.stroke(node.canvas, ends, pen)
}

/// Starts to fill a polygon of a block; the units of work that this took.
fn polygon_of(easel: &mut Easel<'_>, node: &Node, polygon: &Polygon) -> u64 {
    let mut pen = node.pen.after(easel.painter.inks.choice, &easel.drawing.styles[polygon.style.0 as usize]);
    if easel.descent.path.counts() && node.canvas == 0 {
        pen.shade = Shade { number: easel.descent.path.stroke(node.block, node.span).ink(), fixed: true };
    }
    easel.painter.polygon(node.canvas, &node.place, easel.drawing.vertices_of(polygon), pen)
}
