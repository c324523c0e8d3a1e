//! The parts of a tube: cubic curves between two points of the turtle's path (generalized cylinders, ABOP, chapter 5).

use crate::space::{Geometry, minus, times};
use crate::style::WidthChange;
use lsystem_syntax::TUBE_STROKES;

/// The number of strokes of a part.
const STROKES: usize = TUBE_STROKES as usize;

/// A point of a tube.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TubeEnd<S: Geometry> {
    pub at: S::Point,
    pub heading: S::Turn,
    pub width: WidthChange,
}

impl<S: Geometry> TubeEnd<S> {
    /// The points of the curve to `end`, with the widths there: [`STROKES`] + 1 points, the first and the last exactly
    /// those of the ends. The curve is the Hermite curve with the headings as directions at its ends; both tangents are
    /// as long as the chord, so that the points of a straight part have equal distances.
    pub(crate) fn curve(&self, end: &Self, directions: &mut S::Directions) -> [(S::Point, WidthChange); STROKES + 1] {
        let chord = minus(end.at, &self.at);
        let length = chord.as_ref().iter().map(|c| c * c).sum::<f64>().sqrt();
        let mut tangent = |turn: S::Turn| S::ahead(&S::axes(directions, turn), S::Point::default(), length);
        let (first, last) = (tangent(self.heading), tangent(end.heading));
        core::array::from_fn(|at| match at {
            0 => (self.at, self.width),
            STROKES => (end.at, end.width),
            _ => {
                let t = at as f64 / STROKES as f64;
                let rest = 1.0 - t;
                let mut point = self.at;
                for (vector, weight) in
                    [(chord, t * t * (3.0 - 2.0 * t)), (first, t * rest * rest), (last, -t * t * rest)]
                {
                    let part = times(vector, weight);
                    point.as_mut().iter_mut().zip(part.as_ref()).for_each(|(c, part)| *c += part);
                }
                (point, self.width.between(end.width, t))
            }
        })
    }
}
