//! Facts about a block that the renderer uses before it looks inside.

use crate::ink::{BlockVisitor, Sweep};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Block, Drawing, Item, Line, StyleChange};

/// Facts about one block, in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// The middle of the block's bounds.
    pub centre: [f64; 2],
    /// Half the sides of the bounds, along the frame's axes.
    pub half: [f64; 2],
    /// The line that the block covers, if it covers one straight line without gaps in one style.
    pub line: Option<Line>,
    /// The style of the last stroke, relative to the block's entry.
    pub last: StyleChange,
    /// The most strokes, lines and polygons that drawing the block takes.
    pub strokes: u32,
}

impl Shape {
    /// The longer side of the bounds, at this scale.
    pub(super) fn extent(&self, scale: f64) -> f64 {
        2.0 * scale * self.half[0].max(self.half[1])
    }

    /// The segment through the centre from one end of the bounds to the other, parallel to the longer sides.
    pub(super) fn axis(&self) -> [[f64; 2]; 2] {
        let along = if self.half[0] >= self.half[1] { [self.half[0], 0.0] } else { [0.0, self.half[1]] };
        [-1.0, 1.0].map(|sign| [self.centre[0] + sign * along[0], self.centre[1] + sign * along[1]])
    }
}

/// Gaps and deviations below this part of a line are rounding.
const ROUNDING: f64 = 1e-9;

/// The shapes of blocks, found in steps. Trunks (`F -> FF`) become single lines, so a plant's straight parts are drawn
/// exactly.
#[derive(Debug, Default)]
pub(super) struct Shapes {
    /// By block, as far as the sweep is.
    pub list: Vec<Shape>,
    sweep: Sweep,
    block: PartialShape,
}

/// The shape of the items visited so far in a block.
#[derive(Debug)]
struct PartialShape {
    line: Option<Line>,
    /// Whether all items so far make one line.
    straight: bool,
    strokes: u32,
    /// The number of the last item that draws something.
    last: Option<usize>,
}

impl Default for PartialShape {
    fn default() -> Self {
        Self { line: None, straight: true, strokes: 0, last: None }
    }
}

impl Shapes {
    /// Forgets the drawing.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Goes on until the shapes of all blocks are known.
    pub(super) fn step(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        let mut sweep = self.sweep;
        let progress = sweep.step(self, drawing, meter);
        self.sweep = sweep;
        progress
    }
}

impl BlockVisitor for Shapes {
    fn item(&mut self, drawing: &Drawing, _: usize, number: usize, item: &Item) -> u64 {
        let block = &mut self.block;
        let line = match item {
            Item::Stroke(stroke) => {
                block.strokes = block.strokes.saturating_add(1);
                let style = drawing.styles[stroke.style.0 as usize];
                Some(Line { from: stroke.from, to: stroke.to, style, bend: None })
            }
            Item::Polygon(_) => {
                block.strokes = block.strokes.saturating_add(1);
                block.straight = false;
                None
            }
            Item::Block(placed) => {
                let child = &self.list[placed.block.0 as usize];
                if child.strokes == 0 {
                    return 1;
                }
                block.strokes = block.strokes.saturating_add(child.strokes);
                child.line.map(|line| {
                    let (c, s) = placed.heading.cos_sin();
                    let place = |[x, y]: [f64; 2]| {
                        [placed.at[0] + placed.scale * (c * x - s * y), placed.at[1] + placed.scale * (s * x + c * y)]
                    };
                    let style = drawing.styles[placed.style.0 as usize].then(&line.style);
                    Line { from: place(line.from), to: place(line.to), style, bend: line.bend.map(place) }
                })
            }
        };
        block.last = Some(number);
        if block.straight {
            block.line = match (block.line, line) {
                (None, line) => line,
                (Some(a), Some(b)) => join(a, b),
                (Some(_), None) => None,
            };
            block.straight = block.line.is_some();
        }
        1
    }

    fn close(&mut self, drawing: &Drawing, block: &Block) -> u64 {
        let own = core::mem::take(&mut self.block);
        let [centre, half] = bounds(drawing, block);
        let line = own.line.filter(|_| own.straight);
        let last = own.last.map_or(StyleChange::NONE, |last| match &drawing.contents(block)[last] {
            Item::Stroke(stroke) => drawing.styles[stroke.style.0 as usize],
            Item::Polygon(polygon) => drawing.styles[polygon.style.0 as usize],
            Item::Block(placed) => {
                drawing.styles[placed.style.0 as usize].then(&self.list[placed.block.0 as usize].last)
            }
        });
        let strokes = if line.is_some() { 1 } else { own.strokes };
        self.list.push(Shape { centre, half, line, last, strokes });
        drawing.corners_of(block).len() as u64 / 8
    }
}

/// The shapes of all blocks, by block.
#[cfg(test)]
pub(super) fn shapes(drawing: &Drawing) -> Vec<Shape> {
    let mut shapes = Shapes::default();
    while shapes.step(drawing, &mut Meter::new(u64::MAX)) == Progress::More {}
    shapes.list
}

fn bounds(drawing: &Drawing, block: &Block) -> [[f64; 2]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for corner in drawing.corners_of(block) {
        for axis in 0..2 {
            low[axis] = low[axis].min(corner[axis]);
            high[axis] = high[axis].max(corner[axis]);
        }
    }
    if low[0] > high[0] {
        return [[0.0; 2]; 2];
    }
    [[0, 1].map(|a| (low[a] + high[a]) / 2.0), [0, 1].map(|a| (high[a] - low[a]) / 2.0)]
}

/// The union of two lines, if it is one line in one style. Only its last stroke may taper.
fn join(a: Line, b: Line) -> Option<Line> {
    if !a.style.goes_on(&b.style) {
        return None;
    }
    let tapers = a.style.next != b.style.next;
    let length = |l: &Line| (l.to[0] - l.from[0]).abs() + (l.to[1] - l.from[1]).abs();
    let base = if length(&a) >= length(&b) { a } else { b };
    let (dx, dy) = (base.to[0] - base.from[0], base.to[1] - base.from[1]);
    let norm = (dx * dx + dy * dy).sqrt();
    if norm == 0.0 {
        return (a.from == b.from).then_some(Line { style: b.style, ..a });
    }
    let (ux, uy) = (dx / norm, dy / norm);
    let along = |p: [f64; 2]| (p[0] - base.from[0]) * ux + (p[1] - base.from[1]) * uy;
    let aside = |p: [f64; 2]| (p[1] - base.from[1]) * ux - (p[0] - base.from[0]) * uy;
    let tolerance = ROUNDING * norm;
    if [a.from, a.to, b.from, b.to].iter().any(|&p| aside(p).abs() > tolerance) {
        return None;
    }
    if tapers {
        let [a0, a1, b0, b1] = [a.from, a.to, b.from, b.to].map(along);
        let follows = a0 <= a1 && b0 <= b1 && (b0 - a1).abs() <= tolerance;
        return follows.then_some(Line { from: a.from, to: b.to, style: b.style, bend: b.bend.or(Some(b.from)) });
    }
    let range = |l: &Line| (along(l.from).min(along(l.to)), along(l.from).max(along(l.to)));
    let ((a0, a1), (b0, b1)) = (range(&a), range(&b));
    if b0 > a1 + tolerance || a0 > b1 + tolerance {
        return None;
    }
    let at = |t: f64| [base.from[0] + t * ux, base.from[1] + t * uy];
    Some(Line { from: at(a0.min(b0)), to: at(a1.max(b1)), style: a.style, bend: None })
}
