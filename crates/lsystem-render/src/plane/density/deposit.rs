//! How much ink blocks lay down, and where: sums over all their strokes, which are sums over the blocks inside.

use crate::plane::Amount;
use crate::plane::descent::Node;
use crate::plane::shape::Shape;
use crate::plane::sweep::{BlockVisitor, Sweep};
use crate::plane::view::Measure;
use lsystem_drawing::{Block, Drawing, Item};
use lsystem_syntax::{Meter, Progress};

/// The ink of one block, in its own frame.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Deposit {
    /// Of all strokes together, in block units.
    pub length: Amount,
    /// Of all polygons together, in square block units.
    pub area: Amount,
    /// The centre of gravity of the strokes; of the polygons where there are no strokes.
    pub centre: [f64; 2],
    /// About the centre: the mean of x x, x y and y y.
    pub spread: [f64; 3],
    /// The same of the directions across the strokes, each of length 1.
    pub across: [f64; 3],
    /// Whether the line that the block's shape is has the same ink everywhere.
    pub even: bool,
}

impl Deposit {
    /// All ink of a block whose strokes are as wide as it is entered with: in layers, times pixels.
    #[inline]
    pub(super) fn amount(&self, measure: &Measure, node: &Node) -> Amount {
        let scale = node.place.scale.abs();
        self.length.times(scale).times(measure.width(node.pen.width)).plus(self.area.times(scale).times(scale))
    }

    /// How the ink of a block lies about its centre, in pixels, up and to the right: the mean of x x, x y and y y. What its
    /// strokes reach across, as wide as it is entered with, counts as what they reach along.
    #[inline]
    pub(super) fn squares(&self, measure: &Measure, node: &Node) -> [f64; 3] {
        let (cos, sin) = node.place.heading.cos_sin();
        let width = measure.width(node.pen.width);
        let along = turned(self.spread, [node.place.cos, node.place.sin]);
        let across = turned(self.across, [cos, sin]);
        // An even distribution over a length has a twelfth of its square.
        [0, 1, 2].map(|i| along[i] + width * width / 12.0 * across[i])
    }

    /// Which part of a block's ink it is: by length, or by area where there are no strokes.
    pub(super) fn share_of(&self, whole: &Self) -> f64 {
        if whole.length.is_zero() { self.area.of(whole.area) } else { self.length.of(whole.length) }
    }
}

/// A line is even where its length is that of all its strokes together, but for rounding.
const ROUNDING: f64 = 1e-9;

/// The ink of blocks, found in steps.
#[derive(Debug, Default)]
pub(super) struct Deposits {
    /// By block, as far as they are known.
    pub list: Vec<Deposit>,
    place: Sweep,
    /// Of the block in hand, so far.
    sum: Deposit,
}

impl Deposits {
    /// Goes on until the ink of all blocks is known, which have these shapes.
    pub(super) fn step(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        let mut place = self.place;
        let progress = place.step(&mut Summing { deposits: self, shapes }, drawing, meter);
        self.place = place;
        progress
    }
}

struct Summing<'a> {
    deposits: &'a mut Deposits,
    shapes: &'a [Shape],
}

impl BlockVisitor for Summing<'_> {
    /// For all ink, for its centre of gravity, and for how it is spread about that.
    const PASSES: usize = 3;

    fn item(&mut self, drawing: &Drawing, pass: usize, _: usize, item: &Item) -> u64 {
        // Found anew in each pass: to keep the parts of a long block would take more memory than the drawing.
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
            Deposit {
                length: Amount::new(length),
                centre: [0, 1].map(|i| (stroke.from[i] + stroke.to[i]) / 2.0),
                spread: [dx * dx, dx * dy, dy * dy].map(|v| v / 12.0),
                across: [uy * uy, -ux * uy, ux * ux],
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
            let [x, y] = inner.centre;
            Deposit {
                length: inner.length.times(placed.scale),
                area: inner.area.times(placed.scale * placed.scale),
                centre: [placed.at[0] + c * x - s * y, placed.at[1] + s * x + c * y],
                spread: turned(inner.spread, [c, s]),
                across: turned(inner.across, [cos, sin]),
                even: false,
            }
        }
    }
}

/// The means of x x, x y and y y after a turn, by so many times its cosine and sine.
pub(super) fn turned([xx, xy, yy]: [f64; 3], [c, s]: [f64; 2]) -> [f64; 3] {
    [
        c * c * xx - 2.0 * c * s * xy + s * s * yy,
        c * s * (xx - yy) + (c * c - s * s) * xy,
        s * s * xx + 2.0 * c * s * xy + c * c * yy,
    ]
}

/// A polygon's area, as far as its outline does not cross itself, and the mean of its vertices.
fn area(vertices: &[[f64; 2]]) -> (f64, [f64; 2]) {
    let next = vertices.iter().cycle().skip(1);
    let twice: f64 = vertices.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
    let count = vertices.len().max(1) as f64;
    let centre = [0, 1].map(|i| vertices.iter().map(|vertex| vertex[i]).sum::<f64>() / count);
    (twice.abs() / 2.0, centre)
}
