//! The amount of ink of each block, and its distribution: sums over strokes and over the blocks inside.

use crate::ink::Amount;
use crate::ink::{BlockVisitor, Sweep};
use crate::plane::descent::Node;
use crate::plane::shape::Shape;
use crate::plane::view::Measure;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Block, Drawing, Item, StyleChange, WidthChange};

/// The ink of one block, in its own frame.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Deposit {
    /// The length of all strokes together, in block units.
    pub length: Amount,
    /// The area of all polygons together, in square block units.
    pub area: Amount,
    /// The centre of gravity of the strokes, or of the polygons if there are no strokes.
    pub centre: [f64; 2],
    /// The mean of x x, x y and y y about the centre, in square block units.
    pub spread: [f64; 3],
    /// The mean of x x, x y and y y over the unit vectors across the strokes.
    pub across: [f64; 3],
    /// The mean width of the strokes in step lengths, weighted by length, for the width at entry: a factor and an offset.
    pub width: [f64; 2],
    /// Whether the block is a straight line with the same ink everywhere.
    pub even: bool,
}

impl Deposit {
    /// The mean width of a block's strokes, in pixels. Exact if all of them are wider than a hairline, or none.
    #[inline]
    pub(super) fn width(&self, measure: &Measure, node: &Node) -> f64 {
        measure.width(self.width[0] * node.pen.widths.own + self.width[1])
    }

    /// All ink of a block in layers times square pixels.
    #[inline]
    pub(super) fn amount(&self, measure: &Measure, node: &Node) -> Amount {
        let scale = node.place.scale.abs();
        self.length.times(scale).times(self.width(measure, node)).plus(self.area.times(scale).times(scale))
    }

    /// The mean of x x, x y and y y of a block's ink about its centre, in square pixels, x to the right and y up.
    /// Includes the width of the strokes, each with the mean width.
    #[inline]
    pub(super) fn squares(&self, measure: &Measure, node: &Node) -> [f64; 3] {
        let (cos, sin) = node.place.heading.cos_sin();
        let width = self.width(measure, node);
        let along = turned(self.spread, [node.place.cos, node.place.sin]);
        let across = turned(self.across, [cos, sin]);
        // The mean square of an even distribution is a twelfth of the square of its length.
        [0, 1, 2].map(|i| along[i] + width * width / 12.0 * across[i])
    }

    /// Four points about the centre, in pixels, y down, with the same spread as a block's ink.
    #[inline]
    pub(super) fn spots(&self, node: &Node) -> [[f64; 2]; 4] {
        let [xx, xy, yy] = turned(self.spread, [node.place.cos, node.place.sin]).map(|square| 2.0 * square);
        // The columns of the spread's Cholesky factor, as matrices of second moments have.
        let x = xx.max(0.0).sqrt();
        let y = if x > 0.0 { xy / x } else { 0.0 };
        let rest = (yy - y * y).max(0.0).sqrt();
        [[x, -y], [-x, y], [0.0, rest], [0.0, -rest]]
    }

    /// The share of the deposit in the ink of `whole`: by length, or by area if `whole` has no strokes.
    pub(super) fn share_of(&self, whole: &Self) -> f64 {
        if whole.length.is_zero() { self.area.of(whole.area) } else { self.length.of(whole.length) }
    }
}

/// A line is even if its length differs from that of all its strokes together by at most this part.
const ROUNDING: f64 = 1e-9;

/// The ink of blocks, found in steps.
#[derive(Debug, Default)]
pub(super) struct Deposits {
    /// By block, as far as the sweep is.
    pub list: Vec<Deposit>,
    sweep: Sweep,
    /// The deposit so far of the block being visited.
    sum: Deposit,
}

impl Deposits {
    /// Goes on until the deposits of all blocks are known; `shapes` are those of the blocks.
    pub(super) fn step(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        let mut sweep = self.sweep;
        let progress = sweep.step(&mut Summing { deposits: self, shapes }, drawing, meter);
        self.sweep = sweep;
        progress
    }
}

struct Summing<'a> {
    deposits: &'a mut Deposits,
    shapes: &'a [Shape],
}

impl BlockVisitor for Summing<'_> {
    /// One pass each for the amount of ink, for its centre of gravity, and for its spread about the centre.
    const PASSES: usize = 3;

    fn item(&mut self, drawing: &Drawing, pass: usize, _: usize, item: &Item) -> u64 {
        // Computed anew in each pass: keeping the parts of a long block would take more memory than the drawing.
        let part = part(drawing, item, &self.deposits.list);
        let sum = &mut self.deposits.sum;
        if pass == 0 {
            sum.length = sum.length.plus(part.length);
            sum.area = sum.area.plus(part.area);
        } else {
            let share = part.share_of(sum);
            if pass == 1 {
                sum.centre = [0, 1].map(|i| sum.centre[i] + share * part.centre[i]);
            } else {
                let [dx, dy] = [0, 1].map(|i| part.centre[i] - sum.centre[i]);
                let about = [dx * dx, dx * dy, dy * dy];
                sum.spread = [0, 1, 2].map(|i| sum.spread[i] + share * (part.spread[i] + about[i]));
                sum.across = [0, 1, 2].map(|i| sum.across[i] + share * part.across[i]);
                sum.width = [0, 1].map(|i| sum.width[i] + share * part.width[i]);
            }
        }
        if let Item::Polygon(polygon) = item { 1 + u64::from(polygon.count) / 16 } else { 1 }
    }

    fn close(&mut self, _: &Drawing, _: &Block) -> u64 {
        let mut ink = core::mem::take(&mut self.deposits.sum);
        ink.even = self.shapes[self.deposits.list.len()].line.is_some_and(|line| {
            let (dx, dy) = (line.to[0] - line.from[0], line.to[1] - line.from[1]);
            let length = (dx * dx + dy * dy).sqrt();
            (ink.length.units(0) - length).abs() <= ROUNDING * length
        });
        self.deposits.list.push(ink);
        0
    }
}

/// The ink of an item, in the frame of the block that holds it, given the ink of the blocks inside.
pub(super) fn part(drawing: &Drawing, item: &Item, deposits: &[Deposit]) -> Deposit {
    match item {
        Item::Stroke(stroke) => {
            let [dx, dy] = [0, 1].map(|i| stroke.to[i] - stroke.from[i]);
            let length = (dx * dx + dy * dy).sqrt();
            let [ux, uy] = if length > 0.0 { [dx / length, dy / length] } else { [0.0; 2] };
            let StyleChange { width, next, .. } = drawing.styles[stroke.style.0 as usize];
            let next = next.unwrap_or(width);
            Deposit {
                length: Amount::new(length),
                centre: [0, 1].map(|i| (stroke.from[i] + stroke.to[i]) / 2.0),
                spread: [dx * dx, dx * dy, dy * dy].map(|v| v / 12.0),
                across: [uy * uy, -ux * uy, ux * ux],
                width: [(width.factor + next.factor) / 2.0, (width.offset + next.offset) / 2.0],
                ..Deposit::default()
            }
        }
        Item::Polygon(polygon) => {
            let vertices = drawing.vertices_of(polygon);
            let (area, centre) = area(vertices);
            Deposit { area: Amount::new(area), centre, ..Deposit::default() }
        }
        Item::Block(placed) => {
            let inner = &deposits[placed.block.0 as usize];
            let (cos, sin) = placed.heading.cos_sin();
            let (c, s) = (cos * placed.scale, sin * placed.scale);
            let ([x, y], [factor, offset]) = (inner.centre, inner.width);
            let width = drawing.styles[placed.style.0 as usize].width.then(WidthChange { factor, offset });
            Deposit {
                length: inner.length.times(placed.scale),
                area: inner.area.times(placed.scale * placed.scale),
                centre: [placed.at[0] + c * x - s * y, placed.at[1] + s * x + c * y],
                spread: turned(inner.spread, [c, s]),
                across: turned(inner.across, [cos, sin]),
                width: [width.factor, width.offset],
                even: false,
            }
        }
    }
}

/// The means of x x, x y and y y after a turn and a scaling; `[c, s]` are the cosine and the sine times the scale.
pub(super) fn turned([xx, xy, yy]: [f64; 3], [c, s]: [f64; 2]) -> [f64; 3] {
    [
        c * c * xx - 2.0 * c * s * xy + s * s * yy,
        c * s * (xx - yy) + (c * c - s * s) * xy,
        s * s * xx + 2.0 * c * s * xy + c * c * yy,
    ]
}

/// The area of a polygon whose outline does not cross itself, and the mean of its vertices.
fn area(vertices: &[[f64; 2]]) -> (f64, [f64; 2]) {
    let next = vertices.iter().cycle().skip(1);
    let twice: f64 = vertices.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
    let count = vertices.len().max(1) as f64;
    let centre = [0, 1].map(|i| vertices.iter().map(|vertex| vertex[i]).sum::<f64>() / count);
    (twice.abs() / 2.0, centre)
}
