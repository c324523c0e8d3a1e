//! What blocks look like from so far away that only their main features show.

use super::{Drawing, Frame};
use crate::drawing::block::{Block, Item, Stroke};
use crate::plane::Directions;
use crate::style::StyleChange;

/// How far rounding may move the ends of strokes that meet, in block units, and bend strokes on a line, in radians.
const EXACT: f64 = 1e-9;

/// One stroke in the place of a block, in block units.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Its first end.
    pub from: [f64; 2],
    /// Its other end.
    pub to: [f64; 2],
    /// Since the block's entry.
    pub style: StyleChange,
}

/// A block's main features.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The one stroke that covers what all its strokes do, where they are in one style and follow each other straight
    /// ahead.
    pub straight: Option<Line>,
    /// Whether there are polygons in it.
    pub filled: bool,
    /// From end to end where it is longest, in the style of its last stroke, which covers the others.
    pub longest: Line,
}

impl Shape {
    /// The shape of a block; `inner` are those of all blocks before it, in their order.
    #[must_use]
    pub fn new(block: &Block, inner: &[Self], drawing: &Drawing, directions: &mut Directions) -> Self {
        let home = Frame::new(1.0, StyleChange::NONE);
        let mut straight: Option<Line> = None;
        let (mut bent, mut filled) = (false, false);
        let mut last = StyleChange::NONE;
        for item in drawing.contents(block) {
            let line = match item {
                Item::Stroke(stroke) => {
                    let line = Line::new(stroke, drawing);
                    last = line.style;
                    Some(line)
                }
                Item::Polygon(polygon) => {
                    filled = true;
                    last = drawing.styles[polygon.style.0 as usize];
                    continue;
                }
                Item::Block(placed) => {
                    let frame = home.place(placed, drawing, directions);
                    let inner = &inner[placed.block.0 as usize];
                    filled |= inner.filled;
                    last = frame.style.then(&inner.longest.style);
                    inner.straight.map(|line| line.within(&frame))
                }
            };
            straight = match (straight, line) {
                (None, line) => line,
                (Some(before), Some(line)) => before.and(&line),
                (Some(_), None) => None,
            };
            bent |= straight.is_none();
        }
        let straight = straight.filter(|_| !bent && !filled);
        let corners = drawing.corners_of(block);
        Self { straight, filled, longest: Line { style: last, ..longest(corners) } }
    }

    /// The units of work that finding it takes: blocks have some hundred items at most, and few corners, all pairs of
    /// which are looked at.
    #[must_use]
    pub fn work(block: &Block, drawing: &Drawing) -> u64 {
        let corners = drawing.corners_of(block).len() as u64;
        2 * drawing.contents(block).len() as u64 + corners * corners / 8
    }
}

impl Line {
    /// A stroke of a drawing.
    #[must_use]
    pub fn new(stroke: &Stroke, drawing: &Drawing) -> Self {
        Self { from: stroke.from, to: stroke.to, style: drawing.styles[stroke.style.0 as usize] }
    }

    /// In block units.
    #[must_use]
    pub fn length(&self) -> f64 {
        let [x, y] = self.way();
        (x * x + y * y).sqrt()
    }

    fn way(&self) -> [f64; 2] {
        [self.to[0] - self.from[0], self.to[1] - self.from[1]]
    }

    /// Seen from the block that holds this one's block.
    fn within(&self, frame: &Frame) -> Self {
        Self { from: frame.lie(self.from), to: frame.lie(self.to), style: frame.style.then(&self.style) }
    }

    /// Both as one line, where `next` goes on straight ahead in the same style.
    fn and(&self, next: &Self) -> Option<Self> {
        let gap = Self { from: self.to, to: next.from, ..*self }.length();
        let ([a, b], [c, d]) = (self.way(), next.way());
        let exact = EXACT * self.length() * next.length();
        let ahead = a * c + b * d > 0.0 && (a * d - b * c).abs() <= exact;
        (self.style == next.style && gap <= EXACT && ahead).then_some(Self { to: next.to, ..*self })
    }
}

/// Between the corners that are farthest apart.
fn longest(corners: &[[f64; 2]]) -> Line {
    let first = corners.first().copied().unwrap_or_default();
    let mut best = Line { from: first, to: first, style: StyleChange::NONE };
    for (at, &from) in corners.iter().enumerate() {
        for &to in &corners[at + 1..] {
            let line = Line { from, to, ..best };
            if line.length() > best.length() {
                best = line;
            }
        }
    }
    best
}
