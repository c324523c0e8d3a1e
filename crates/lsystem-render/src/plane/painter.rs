//! Paints strokes, polygons and blocks on the canvases of a picture, and counts the steps.

use super::RenderStats;
use super::canvas::Canvas;
use super::canvas::cone::Cone;
use super::canvas::polygon::Filling;
use super::descent::{Node, Place};
use super::pen::Pen;
use super::seen::Seen;
use super::shape::Shape;
use super::top_down::tile;
use super::view::{Measure, TINY};
use crate::ink::InkTable;
use lsystem_base::Meter;
use lsystem_drawing::Drawing;

/// Strokes with a larger radius than this, in subsamples, are broad: they are not painted into tiles.
pub(super) const BROAD: f64 = 64.0;
/// A straight block longer than this, in subsamples, is taken apart, so that rounding stays far below a subsample.
const LONGEST_LINE: f64 = 1e6;
/// The units of work, beside the step itself, that count as one step more.
const UNITS_PER_STEP: u64 = 32;

/// Paints on the canvases of one picture at a time.
#[derive(Default)]
pub(super) struct Painter {
    pub measure: Measure,
    pub inks: InkTable,
    /// The picture, then a canvas for each size of tile.
    pub canvases: [Canvas; 1 + tile::SIZES],
    /// By canvas: how often the picture has emptied the canvas for a tile.
    serials: [u64; 1 + tile::SIZES],
    seen: Seen,
    /// Whether blocks may recur.
    pub repeats: bool,
    /// The polygon that is being filled.
    filling: Filling,
    /// The canvas of that polygon.
    filled: usize,
    /// The strokes and polygons painted on the picture itself so far.
    pub painted: u64,
    /// The steps that large items took beyond one step each.
    extra: u64,
    pub stats: RenderStats,
}

impl Painter {
    /// Starts a picture; `repeats`: blocks may recur.
    pub(super) fn begin(&mut self, repeats: bool) {
        self.stats = RenderStats::default();
        self.repeats = repeats;
        (self.painted, self.extra, self.serials) = (0, 0, Default::default());
        self.seen.clear();
    }

    /// Gives up the polygon that is being filled.
    pub(super) fn stop(&mut self) {
        self.filling = Filling::default();
    }

    /// Empties the canvas for tiles of a size, and makes it at least `width` by `height` subsamples.
    pub(super) fn empty_tile(&mut self, size: usize, [width, height]: [usize; 2], planes: usize) {
        self.canvases[1 + size].reset(width, height, planes);
        self.serials[1 + size] += 1;
    }

    /// The most that half the width of a block's strokes is, in subsamples.
    #[inline]
    pub(super) fn widest(&self, drawing: &Drawing, node: &Node) -> f64 {
        self.measure.widest(&drawing.blocks[node.block.0 as usize], node.pen)
    }

    /// The steps so far: blocks looked into, strokes and stamps, and more for large ones.
    #[inline]
    pub(super) fn steps(&self) -> u64 {
        self.stats.blocks + self.stats.strokes + self.stats.stamps + self.extra
    }

    /// Counts units of work beyond the step itself.
    #[inline]
    pub(super) fn add_work(&mut self, work: u64) {
        self.extra += work / UNITS_PER_STEP;
    }

    /// Goes on with the polygon that is being filled. Returns whether there was one.
    #[inline]
    pub(super) fn fill(&mut self, meter: &mut Meter) -> bool {
        if self.filling.is_done() {
            return false;
        }
        self.filling.step(&mut self.canvases[self.filled], meter);
        true
    }

    /// Notes a block with these properties at this place on this canvas. Returns whether it is new there.
    #[inline]
    pub(super) fn is_new(&mut self, canvas: usize, properties: [u64; 5], place: [f64; 2]) -> bool {
        let [block, scale, width, next, grain] = properties;
        self.seen.paint([self.tag(canvas), block, scale, width, next, grain], [place])
    }

    /// Paints a stroke, unless it was painted before. Returns the units of work.
    pub(super) fn stroke(&mut self, canvas: usize, ends: [[f64; 2]; 2], pen: Pen) -> u64 {
        let radii = pen.widths.ends().map(|width| self.measure.radius(width));
        if self.repeats && !self.seen.paint([self.tag(canvas), radii[0].to_bits(), radii[1].to_bits()], ends) {
            return 0;
        }
        self.stats.strokes += 1;
        self.painted += u64::from(canvas == 0);
        let colour = self.inks.code(pen.shade);
        let rows = Cone { ends, radii }.paint(&mut self.canvases[canvas], colour);
        let work = rows as u64 / 4 + self.canvases[canvas].take_work();
        self.add_work(work);
        work
    }

    /// A number that identifies a canvas and its tile.
    #[inline]
    fn tag(&self, canvas: usize) -> u64 {
        self.serials[canvas] << 8 | canvas as u64
    }

    /// Starts to fill a polygon. Returns the units of work.
    pub(super) fn polygon(&mut self, canvas: usize, place: &Place, vertices: &[[f64; 2]], pen: Pen) -> u64 {
        self.stats.strokes += 1;
        self.painted += u64::from(canvas == 0);
        let colour = self.inks.code(pen.shade);
        self.filled = canvas;
        self.filling.begin(&self.canvases[canvas], vertices.iter().map(|&vertex| place.point(vertex)), colour)
    }

    /// Paints a block's hull in the colour of the block's last stroke. If strokes are `broad` beside the block, paints
    /// a stroke along the block instead. Returns the units of work.
    pub(super) fn outline(&mut self, drawing: &Drawing, shape: &Shape, node: &Node, broad: bool) -> u64 {
        self.stats.outlines += 1;
        if broad {
            return self.axis(drawing, shape, node);
        }
        let hull = &drawing.blocks[node.block.0 as usize].hull;
        let pen = node.pen.after(self.inks.choice, &shape.last);
        match &drawing.corners[hull.start as usize..hull.end as usize] {
            [from, to] => self.stroke(node.canvas, [*from, *to].map(|p| node.place.point(p)), pen),
            corners => {
                let work = self.polygon(node.canvas, &node.place, corners, pen);
                let work = work + self.filling.finish(&mut self.canvases[node.canvas]);
                self.extra += self.filling.work as u64 / 4;
                work
            }
        }
    }

    /// Paints a stroke along a block in the colour of the block's last stroke, and below it a stroke as wide as the
    /// block's widest if that is much wider. Returns the units of work.
    fn axis(&mut self, drawing: &Drawing, shape: &Shape, node: &Node) -> u64 {
        let ends = shape.axis().map(|end| node.place.point(end));
        let pen = node.pen.after(self.inks.choice, &shape.last);
        let pens = self.measure.pens(&drawing.blocks[node.block.0 as usize], node.pen, pen);
        pens.map(|pen| self.stroke(node.canvas, ends, pen)).sum()
    }

    /// Paints a block as one stroke if it is a `plain` straight line (in one colour), or too small to differ from one.
    /// Returns the units of work, or `None` if the block is neither.
    pub(super) fn straight(&mut self, drawing: &Drawing, shape: &Shape, node: &Node, plain: bool) -> Option<u64> {
        let extent = shape.extent(node.place.scale);
        if let Some(line) = &shape.line
            && extent < LONGEST_LINE
            && plain
        {
            let pen = node.pen.after(self.inks.choice, &line.style);
            return Some(
                line.parts(pen.widths)
                    .rev()
                    .map(|(ends, widths)| {
                        self.stroke(node.canvas, ends.map(|p| node.place.point(p)), Pen { widths, ..pen })
                    })
                    .sum(),
            );
        }
        (extent <= TINY).then(|| self.axis(drawing, shape, node))
    }
}
