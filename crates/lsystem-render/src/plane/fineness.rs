//! How long and how wide the strokes of a drawing are in a picture: strokes that are finer than a hairline pile up, and
//! the picture shows their amount.

use super::opaque_picture::Plan;
use super::shape::Shape;
use super::view::ViewTransform;
use crate::ink::{Amount, BlockVisitor, Shading, Sweep, smooth};

use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Block, Drawing, Item};

/// The sizes of typical strokes, as powers of two of a hairline's width, between which the shading fades out.
const FINE: [f64; 2] = [0.0, 3.0];
/// The lengths of the longest stroke, as powers of two of a hairline's width, between which single strokes show.
const LONG: [f64; 2] = [-1.0, 1.0];

/// The strokes of a block, in its own units. Strokes that make one straight line count as that line.
#[derive(Clone, Copy, Debug, Default)]
struct Strokes {
    /// All their lengths together.
    length: Amount,
    /// The mean of the binary logarithm of a stroke's length, weighted by length.
    log: f64,
    /// The length of the longest.
    longest: f64,
    /// The mean width in step lengths, weighted by length, for the width at entry: a factor and an offset.
    width: [f64; 2],
}

impl Strokes {
    /// One stroke.
    fn one(length: f64, width: [f64; 2]) -> Self {
        if length > 0.0 && length.is_finite() {
            Self { length: Amount::new(length), log: libm::log2(length), longest: length, width }
        } else {
            Self::default()
        }
    }

    fn with(self, other: Self) -> Self {
        let length = self.length.plus(other.length);
        let [own, others] = [self.length.of(length), other.length.of(length)];
        Self {
            length,
            log: own * self.log + others * other.log,
            longest: self.longest.max(other.longest),
            width: [0, 1].map(|i| own * self.width[i] + others * other.width[i]),
        }
    }
}

/// The strokes of all blocks, found in steps.
#[derive(Default)]
pub(super) struct Fineness {
    list: Vec<Strokes>,
    sweep: Sweep,
    block: Strokes,
    /// The length that was met last, and its strokes: many neighbours have the same length.
    last: (f64, Strokes),
}

impl Fineness {
    /// Forgets the drawing.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Goes on until the strokes of all blocks are known; `shapes` are those of the blocks.
    pub(super) fn step(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        let mut sweep = self.sweep;
        let progress = sweep.step(&mut Visitor { fineness: self, shapes }, drawing, meter);
        self.sweep = sweep;
        progress
    }

    /// The shading of a picture. It depends on the magnification alone, so that all panes agree, and changes
    /// continuously.
    pub(super) fn shading(&self, drawing: &Drawing, plan: &Plan) -> Shading {
        let root = drawing.root.and_then(|root| self.list.get(root.0 as usize));
        let Some(strokes) = root.filter(|strokes| !strokes.length.is_zero()) else { return Shading::default() };
        let transform = ViewTransform::new(drawing, plan.viewport, plan.view, 1.0);
        let hairline = plan.viewport.least_width(&plan.style);
        let width = (strokes.width[0] * drawing.width + strokes.width[1]).abs() * transform.step;
        let length = libm::log2(transform.scale / hairline) + strokes.log;
        let piled = 1.0 - smooth(FINE, length.max(libm::log2(width / hairline)));
        let longest = libm::log2(transform.scale * strokes.longest / hairline);
        Shading { piled, single: piled * (1.0 - smooth(LONG, longest)) }
    }
}

struct Visitor<'a> {
    fineness: &'a mut Fineness,
    shapes: &'a [Shape],
}

impl BlockVisitor for Visitor<'_> {
    fn item(&mut self, drawing: &Drawing, _: usize, _: usize, item: &Item) -> u64 {
        let Fineness { list, block, last, .. } = &mut *self.fineness;
        let width = |style: lsystem_drawing::StyleId| {
            let width = drawing.styles[style.0 as usize].width;
            [width.factor, width.offset]
        };
        let (length, style, work) = match item {
            Item::Stroke(stroke) => {
                let [dx, dy] = [0, 1].map(|i| stroke.to[i] - stroke.from[i]);
                ((dx * dx + dy * dy).sqrt(), stroke.style, 1)
            }
            Item::Polygon(polygon) => {
                let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
                for vertex in drawing.vertices_of(polygon) {
                    for (ends, at) in ends.iter_mut().zip(vertex) {
                        *ends = [ends[0].min(*at), ends[1].max(*at)];
                    }
                }
                let size = ends.map(|[low, high]| high - low);
                (size[0].max(size[1]), polygon.style, 1 + u64::from(polygon.count) / 16)
            }
            Item::Block(placed) => {
                let (inner, scale) = (list[placed.block.0 as usize], placed.scale.abs());
                let [factor, offset] = width(placed.style);
                if !inner.length.is_zero() && scale > 0.0 {
                    *block = block.with(Strokes {
                        length: inner.length.times(scale),
                        log: inner.log + if scale == 1.0 { 0.0 } else { libm::log2(scale) },
                        longest: inner.longest * scale,
                        width: [inner.width[0] * factor, inner.width[0] * offset + inner.width[1]],
                    });
                }
                return 1;
            }
        };
        if last.0 != length {
            *last = (length, Strokes::one(length, [0.0; 2]));
        }
        *block = block.with(Strokes { width: width(style), ..last.1 });
        work
    }

    fn close(&mut self, _: &Drawing, _: &Block) -> u64 {
        let Fineness { list, block, .. } = &mut *self.fineness;
        let mut strokes = core::mem::take(block);
        if let Some(line) = self.shapes.get(list.len()).and_then(|shape| shape.line) {
            let [dx, dy] = [0, 1].map(|i| line.to[i] - line.from[i]);
            strokes = Strokes { length: strokes.length, ..Strokes::one((dx * dx + dy * dy).sqrt(), strokes.width) };
        }
        list.push(strokes);
        0
    }
}
