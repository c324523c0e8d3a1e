//! The main features of blocks, for pictures in which a block is only a few pixels large.

use super::{BlockFrame, Drawing};
use crate::drawing::block::{Block, Item, Stroke};
use crate::plane::Directions;
use crate::style::{StyleChange, Widths};

/// The largest rounding error of ends that meet, in block units, and of directions on a line, in radians.
const EXACT: f64 = 1e-9;

/// One stroke that stands for a block, in block units.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// The first end.
    pub from: [f64; 2],
    /// The second end.
    pub to: [f64; 2],
    /// The style of the last stroke, relative to the block's entry. The other strokes have the same, but do not taper.
    pub style: StyleChange,
    /// Where the last stroke begins; `None` if it is the only one.
    pub bend: Option<[f64; 2]>,
}

/// A block's main features.
#[derive(Clone, Debug)]
pub struct BlockFeatures {
    /// The stroke equal to all strokes of the block, if these have one style and follow each other straight ahead.
    pub straight: Option<Line>,
    /// Whether the block contains polygons.
    pub filled: bool,
    /// The longest diagonal of the hull, in the style of the last stroke or polygon, which covers the others.
    pub longest: Line,
}

impl BlockFeatures {
    /// The shape of a block. `inner` are the shapes of all earlier blocks, in order.
    #[must_use]
    pub fn new(block: &Block, inner: &[Self], drawing: &Drawing, directions: &mut Directions) -> Self {
        let home = BlockFrame::new(1.0, StyleChange::NONE);
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
                (Some(before), Some(line)) => before.join(&line),
                (Some(_), None) => None,
            };
            bent |= straight.is_none();
        }
        let straight = straight.filter(|_| !bent && !filled);
        let corners = drawing.corners_of(block);
        let style = StyleChange { next: Some(last.width), ..last };
        Self { straight, filled, longest: Line { style, ..longest(corners) } }
    }

    /// The units of work for the shape. All pairs of corners are compared, but a hull has few corners.
    #[must_use]
    pub fn work(block: &Block, drawing: &Drawing) -> u64 {
        let corners = drawing.corners_of(block).len() as u64;
        2 * drawing.contents(block).len() as u64 + corners * corners / 8
    }
}

impl Line {
    /// The line of a stroke.
    #[must_use]
    pub fn new(stroke: &Stroke, drawing: &Drawing) -> Self {
        Self { from: stroke.from, to: stroke.to, style: drawing.styles[stroke.style.0 as usize], bend: None }
    }

    /// The length, in block units.
    #[must_use]
    pub fn length(&self) -> f64 {
        let [x, y] = self.way();
        (x * x + y * y).sqrt()
    }

    fn way(&self) -> [f64; 2] {
        [self.to[0] - self.from[0], self.to[1] - self.from[1]]
    }

    /// The one or two strokes that the line is, and their widths: only the last stroke may taper. `widths`: those of the
    /// line's style.
    pub fn parts(&self, widths: Widths) -> impl DoubleEndedIterator<Item = ([[f64; 2]; 2], Widths)> + use<> {
        let [first, last] = widths.ends();
        let bend = self.bend.filter(|_| first != last);
        let trunk = bend.map(|bend| ([self.from, bend], widths.even()));
        trunk.into_iter().chain([([bend.unwrap_or(self.from), self.to], widths)])
    }

    /// The line in the outer frame of `frame`.
    fn within(&self, frame: &BlockFrame) -> Self {
        Self {
            from: frame.transform(self.from),
            to: frame.transform(self.to),
            style: frame.style.then(&self.style),
            bend: self.bend.map(|bend| frame.transform(bend)),
        }
    }

    /// Both as one line, if `next` continues straight ahead in the same style.
    fn join(&self, next: &Self) -> Option<Self> {
        let gap = Self { from: self.to, to: next.from, ..*self }.length();
        let ([a, b], [c, d]) = (self.way(), next.way());
        let exact = EXACT * self.length() * next.length();
        let ahead = a * c + b * d > 0.0 && (a * d - b * c).abs() <= exact;
        let is_one = self.style.goes_on(&next.style) && gap <= EXACT && ahead;
        is_one.then_some(Self { from: self.from, bend: next.bend.or(Some(next.from)), ..*next })
    }
}

/// The line between the two corners that are farthest apart.
fn longest(corners: &[[f64; 2]]) -> Line {
    let first = corners.first().copied().unwrap_or_default();
    let mut best = Line { from: first, to: first, style: StyleChange::NONE, bend: None };
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
