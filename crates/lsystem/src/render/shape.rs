//! What the renderer needs to know of a block before it looks inside.

use crate::{Block, Drawing, Item, StyleChange};

/// Facts about one block, in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// The middle of its bounds.
    pub centre: [f64; 2],
    /// Half the sides of its bounds, along the frame's axes.
    pub half: [f64; 2],
    /// What it covers, where that is one straight line without gaps, in one style.
    pub line: Option<Line>,
    /// The style of the last of its strokes, relative to its entry.
    pub last: StyleChange,
    /// How many strokes and lines it takes to draw it, at most.
    pub strokes: u32,
}

impl Shape {
    /// The longer side of its bounds, at this scale.
    pub(super) fn extent(&self, scale: f64) -> f64 {
        2.0 * scale * self.half[0].max(self.half[1])
    }

    /// From one end of its bounds to the other, halfway between the longer sides.
    pub(super) fn axis(&self) -> [[f64; 2]; 2] {
        let along = if self.half[0] >= self.half[1] { [self.half[0], 0.0] } else { [0.0, self.half[1]] };
        [-1.0, 1.0].map(|sign| [self.centre[0] + sign * along[0], self.centre[1] + sign * along[1]])
    }
}

/// A straight line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub from: [f64; 2],
    pub to: [f64; 2],
    /// Relative to the block's entry.
    pub style: StyleChange,
}

/// Gaps and deviations below this part of a line are rounding.
const ROUNDING: f64 = 1e-9;

/// The shape of each block. Trunks (`F -> FF`) become single lines, so a plant's straight parts are drawn exactly.
pub(super) fn shapes(drawing: &Drawing) -> Vec<Shape> {
    let mut shapes: Vec<Shape> = Vec::with_capacity(drawing.blocks.len());
    for block in &drawing.blocks {
        let [centre, half] = bounds(drawing, block);
        let (line, strokes) = contents(drawing, block, &shapes);
        let last = last_style(drawing, block, &shapes);
        shapes.push(Shape { centre, half, line, last, strokes });
    }
    shapes
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

fn contents(drawing: &Drawing, block: &Block, shapes: &[Shape]) -> (Option<Line>, u32) {
    let mut joined: Option<Line> = None;
    let mut straight = true;
    let mut strokes = 0_u32;
    for item in drawing.contents(block) {
        let line = match item {
            Item::Stroke(stroke) => {
                strokes = strokes.saturating_add(1);
                Some(Line { from: stroke.from, to: stroke.to, style: drawing.styles[stroke.style.0 as usize] })
            }
            Item::Polygon(_) => {
                strokes = strokes.saturating_add(1);
                straight = false;
                None
            }
            Item::Block(placed) => {
                let child = &shapes[placed.block.0 as usize];
                if child.strokes == 0 {
                    continue;
                }
                strokes = strokes.saturating_add(child.strokes);
                child.line.map(|line| {
                    let (c, s) = placed.heading.cos_sin();
                    let place = |[x, y]: [f64; 2]| {
                        [placed.at[0] + placed.scale * (c * x - s * y), placed.at[1] + placed.scale * (s * x + c * y)]
                    };
                    let style = drawing.styles[placed.style.0 as usize].then(&line.style);
                    Line { from: place(line.from), to: place(line.to), style }
                })
            }
        };
        if straight {
            joined = match (joined, line) {
                (None, line) => line,
                (Some(a), Some(b)) => join(a, b),
                (Some(_), None) => None,
            };
            straight = joined.is_some();
        }
    }
    let joined = joined.filter(|_| straight);
    (joined, if joined.is_some() { 1 } else { strokes })
}

fn last_style(drawing: &Drawing, block: &Block, shapes: &[Shape]) -> StyleChange {
    let items = drawing.contents(block);
    let last = items.iter().rev().find_map(|item| match item {
        Item::Stroke(stroke) => Some(drawing.styles[stroke.style.0 as usize]),
        Item::Polygon(polygon) => Some(drawing.styles[polygon.style.0 as usize]),
        Item::Block(placed) => {
            let child = &shapes[placed.block.0 as usize];
            (child.strokes > 0).then(|| drawing.styles[placed.style.0 as usize].then(&child.last))
        }
    });
    last.unwrap_or(StyleChange::NONE)
}

/// Two lines as one, where together they are one.
fn join(a: Line, b: Line) -> Option<Line> {
    if a.style != b.style {
        return None;
    }
    let length = |l: &Line| (l.to[0] - l.from[0]).abs() + (l.to[1] - l.from[1]).abs();
    let base = if length(&a) >= length(&b) { a } else { b };
    let (dx, dy) = (base.to[0] - base.from[0], base.to[1] - base.from[1]);
    let norm = (dx * dx + dy * dy).sqrt();
    if norm == 0.0 {
        return (a.from == b.from).then_some(a);
    }
    let (ux, uy) = (dx / norm, dy / norm);
    let along = |p: [f64; 2]| (p[0] - base.from[0]) * ux + (p[1] - base.from[1]) * uy;
    let aside = |p: [f64; 2]| (p[1] - base.from[1]) * ux - (p[0] - base.from[0]) * uy;
    let tolerance = ROUNDING * norm;
    if [a.from, a.to, b.from, b.to].iter().any(|&p| aside(p).abs() > tolerance) {
        return None;
    }
    let range = |l: &Line| (along(l.from).min(along(l.to)), along(l.from).max(along(l.to)));
    let ((a0, a1), (b0, b1)) = (range(&a), range(&b));
    if b0 > a1 + tolerance || a0 > b1 + tolerance {
        return None;
    }
    let at = |t: f64| [base.from[0] + t * ux, base.from[1] + t * uy];
    Some(Line { from: at(a0.min(b0)), to: at(a1.max(b1)), style: a.style })
}
