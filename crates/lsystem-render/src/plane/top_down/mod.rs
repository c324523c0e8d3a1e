//! The top-down strategy: visits the blocks of the graph, the last drawn first. An explicit stack lets the descent stop
//! anywhere.
//!
//! A block that is covered or outside the picture costs one step. A small block that recurs is stamped from its tile.
//! Broad strokes in one colour are painted in [passes].

pub(in crate::plane) mod passes;
pub(in crate::plane) mod tile;
pub(in crate::plane) mod tiling;

use super::canvas::stroke::Capsule;
use super::descent::{Cut, Descent, Node};
use super::painter::{BROAD, Painter};
use super::shape::Shape;
use super::strategy::MAX_STEPS;
use crate::ink::{Inks, Shade};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Drawing, Item, Polygon, Stroke};
use passes::{Passes, sketch};
use tiling::{Bounds, Tiling};

/// The largest extent of an outline at first, in subsamples: four pixels.
const FIRST_OUTLINED: f64 = 16.0;
/// The steps after which the extent of outlines doubles: a tenth of [`MAX_STEPS`].
const STEPS_TO_DOUBLE: u64 = 100_000;
/// The part of a length that may be rounding.
const ROUNDING: f64 = 1e-9;

/// The drawing, and the tools that paint it.
pub(super) struct Context<'a> {
    pub drawing: &'a Drawing,
    pub shapes: &'a [Shape],
    pub painter: &'a mut Painter,
    pub descent: &'a mut Descent,
}

/// A top-down picture in the making, and the tiles of the pictures before.
pub(super) struct TopDown {
    stack: Vec<Node>,
    /// The state of leaving out the last segments, until that is done.
    cut: Option<Cut>,
    pub tiling: Tiling,
    passes: Passes,
    /// The largest extent of a block that is painted as its outline, in subsamples.
    pub outlined: f64,
    /// The number of steps at which that extent grows next.
    next_growth: u64,
    /// The number of covered blocks met so far.
    pub covered: u64,
}

impl Default for TopDown {
    fn default() -> Self {
        Self {
            stack: vec![],
            cut: None,
            tiling: Tiling::default(),
            passes: Passes::default(),
            outlined: 0.0,
            next_growth: MAX_STEPS,
            covered: 0,
        }
    }
}

impl TopDown {
    /// Gives up the unfinished picture.
    pub(super) fn stop(&mut self) {
        self.stack.clear();
        self.cut = None;
        self.passes = Passes::default();
        self.tiling.stop();
    }

    /// Starts a picture of a drawing, or of its segments before `upto`. Blocks up to the extent `outlined`, in
    /// subsamples, are outlines from the beginning.
    pub(super) fn begin(&mut self, context: &Context<'_>, root: Node, upto: Option<u128>, outlined: f64) {
        let Context { drawing, painter, descent, .. } = context;
        self.covered = 0;
        self.next_growth = MAX_STEPS;
        // Tiles that hold outlines of another extent would spoil this picture.
        if self.outlined != outlined {
            self.tiling.clear();
        }
        self.outlined = outlined;
        let is_free = upto.is_none() && !descent.path.counts();
        let is_plain = matches!(painter.inks.of(root.block.0 as usize), Inks::One(_));
        let widest = painter.widest(drawing, &root);
        if is_free && is_plain && widest > BROAD && widest.is_finite() {
            self.passes.begin(root);
        } else {
            self.stack.push(root);
            self.cut = upto.map(Cut::new);
        }
    }

    /// The part of the picture that is done, from 0 to 1; `None` if that takes too long to count.
    pub(super) fn done(&self, context: &mut Context<'_>) -> Option<f64> {
        let Context { drawing, shapes, painter, descent } = context;
        let (measure, size) = (painter.measure, painter.canvases[0].size());
        let is_seen = |node: &Node| {
            let (block, shape) = (&drawing.blocks[node.block.0 as usize], &shapes[node.block.0 as usize]);
            let centre = node.place.point(shape.centre);
            !node.place.misses(size, centre, shape.half, measure.widest(block, node.pen))
        };
        descent.done(drawing, painter.inks.choice, &self.stack, is_seen)
    }

    /// Goes on until the picture is done, the meter is spent, or the picture has taken more than `most` steps.
    pub(super) fn step(&mut self, context: &mut Context<'_>, most: u64, meter: &mut Meter) -> Progress {
        if let Some(cut) = &mut self.cut {
            let choice = context.painter.inks.choice;
            if context.descent.leave_out(context.drawing, choice, &mut self.stack, cut, meter) == Progress::More {
                return Progress::More;
            }
            self.cut = None;
        }
        while !meter.is_spent() && context.painter.steps() <= most {
            if context.painter.fill(meter) || self.tiling.finish(context.painter, self.stack.len(), meter) {
                continue;
            }
            let Some(node) = self.stack.last_mut() else {
                let Some(work) = self.next_pass(context) else { return Progress::Done };
                meter.charge(work);
                continue;
            };
            if node.cursor <= context.drawing.blocks[node.block.0 as usize].items.start {
                self.stack.pop();
                continue;
            }
            node.cursor -= 1;
            meter.charge(1);
            let canvas = node.canvas;
            meter.charge(match &context.drawing.items[node.cursor as usize] {
                Item::Stroke(stroke) => stroke_of(context, node, stroke),
                Item::Polygon(polygon) => polygon_of(context, node, polygon),
                Item::Block(placed) => {
                    let child = context.descent.child(context.drawing, context.painter.inks.choice, node, placed);
                    node.span.end -= child.span.size;
                    self.block(context, &child)
                }
            });
            // The check whether a broad stroke is covered takes as long as painting the stroke.
            let work = context.painter.canvases[canvas].take_work();
            context.painter.add_work(work);
            meter.charge(work);
        }
        Progress::More
    }

    /// Starts the next pass. Returns the units of work, or `None` after the last pass.
    fn next_pass(&mut self, context: &mut Context<'_>) -> Option<u64> {
        let (root, first) = self.passes.next(context.painter, context.drawing)?;
        self.stack.push(root);
        Some(if first { sketch(context, &root) } else { 1 })
    }

    /// Lets the extent of outlines grow with the steps that the picture takes, so that every picture ends.
    fn grow_outlined(&mut self, painter: &Painter) {
        let steps = painter.steps();
        if painter.repeats && steps > self.next_growth {
            self.outlined = if self.outlined == 0.0 { FIRST_OUTLINED } else { 2.0 * self.outlined };
            self.next_growth = steps + STEPS_TO_DOUBLE;
        }
    }

    /// Paints a block, or puts its node on the stack. Returns the units of work.
    fn block(&mut self, context: &mut Context<'_>, node: &Node) -> u64 {
        let shape = &context.shapes[node.block.0 as usize];
        if shape.strokes == 0 {
            return 0;
        }
        let place = node.place;
        let radius = context.painter.widest(context.drawing, node);
        let (centre, reach) = place.bounds(shape, radius);
        let extent = shape.extent(place.scale);
        let grain = self.passes.grain;
        // A block of strokes narrower than the grain is left to a later pass.
        if self.is_hidden(context.painter, node, shape, (centre, reach, radius))
            || radius < grain
            || !is_new(context.painter, node, grain)
        {
            return 1;
        }
        // Colours along the path allow a stroke or a tile only if the block's part of the path has one colour.
        let is_plain = !context.descent.path.counts() || node.canvas != 0 || node.span.is_short();
        if let Some(work) = context.painter.straight(context.drawing, shape, node, is_plain) {
            return work;
        }
        if extent <= grain {
            return sketch(context, node);
        }
        self.grow_outlined(context.painter);
        if extent <= self.outlined {
            return context.painter.outline(context.drawing, shape, node, 2.0 * radius > extent);
        }
        let mut node = *node;
        if grain == 0.0
            && is_plain
            && let Some(size) = self.tiling.tile_size(context.painter, &node, shape.strokes, extent, radius)
        {
            let bounds = Bounds { centre, reach, radius };
            let height = self.stack.len();
            if let Some(work) = self.tiling.stamp_or_make(context.painter, (shape, &mut node), bounds, size, height) {
                return work;
            }
        }
        context.painter.stats.blocks += 1;
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
        // A broad stroke does not fill the corners of its bounds, so its own outline is checked as well.
        radius > BROAD.max(shape.extent(place.scale)) && {
            let [from, to] = shape.axis().map(|p| place.point(p));
            let around = radius + place.scale * shape.half[0].min(shape.half[1]);
            Capsule { from, to, radius: around * (1.0 + ROUNDING) }.is_covered(canvas)
        }
    }
}

/// Notes a block at its place, in a pass of this grain. Returns whether the block is new there.
fn is_new(painter: &mut Painter, node: &Node, grain: f64) -> bool {
    let block = u64::from(node.block.0) << 32 ^ node.place.heading.units();
    let [width, next] = node.pen.widths.key();
    let properties = [block, tile::scale(node.place.scale), width, next, grain.to_bits()];
    !painter.repeats || painter.is_new(node.canvas, properties, node.place.origin)
}

/// Paints a stroke of a block. Returns the units of work.
fn stroke_of(context: &mut Context<'_>, node: &mut Node, stroke: &Stroke) -> u64 {
    let mut pen = node.pen.after(context.painter.inks.choice, &context.drawing.styles[stroke.style.0 as usize]);
    if context.descent.path.counts() && node.canvas == 0 {
        let span = context.descent.path.stroke(node.block, node.span);
        pen.shade = Shade { number: span.ink(), fixed: true };
        node.span.end -= span.size;
    }
    let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
    context.painter.stroke(node.canvas, ends, pen)
}

/// Starts to fill a polygon of a block. Returns the units of work.
fn polygon_of(context: &mut Context<'_>, node: &Node, polygon: &Polygon) -> u64 {
    let mut pen = node.pen.after(context.painter.inks.choice, &context.drawing.styles[polygon.style.0 as usize]);
    if context.descent.path.counts() && node.canvas == 0 {
        pen.shade = Shade { number: context.descent.path.stroke(node.block, node.span).ink(), fixed: true };
    }
    context.painter.polygon(node.canvas, &node.place, context.drawing.vertices_of(polygon), pen)
}
