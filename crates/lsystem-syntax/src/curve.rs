//! Functions of one variable that are given by points, such as the taper of a stem along its length.
//!
//! A curve is the cubic B-spline of its points with uniform knots that begin and end at the first and the last point: the
//! function files of cpfg and the Virtual Laboratory mean the same. Two points give a line, three a parabola. x must not
//! decrease from point to point, so x grows along the spline and each x has one y. A point that stands three times is a
//! corner; after four points with the same x the value jumps.

use core::fmt;
use lsystem_base::number::number;

/// A function of one variable; outside its points it keeps the values of its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve(Vec<[f64; 2]>);

/// The most points of a curve.
pub(crate) const MAX_POINTS: usize = 64;
/// Halving the parameter this often leaves no number between its bounds.
const HALVINGS: u32 = 60;

impl Curve {
    /// The curve of points `[x, y]`; `None` if there are fewer than 2 or more than 64, if x decreases or never grows, or
    /// if a number is not finite.
    #[must_use]
    pub fn new(points: Vec<[f64; 2]>) -> Option<Self> {
        let [first, .., last] = points[..] else { return None };
        let finite = points.as_flattened().iter().all(|value| value.abs() <= 1e100);
        let ordered = points.is_sorted_by(|a, b| a[0] <= b[0]) && first[0] < last[0];
        (finite && ordered && points.len() <= MAX_POINTS).then_some(Self(points))
    }

    /// The points.
    #[must_use]
    pub fn points(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// The value at `x`; NaN for NaN.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        let (first, last) = (self.0[0], self.0[self.0.len() - 1]);
        if x >= last[0] {
            return last[1];
        }
        if x <= first[0] {
            return first[1];
        }
        let (mut low, mut high) = (0.0, self.spans() as f64);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            if self.at(middle, 0) > x {
                high = middle;
            } else {
                low = middle;
            }
        }
        self.at(low, 1) + 0.0 * x
    }

    /// The units of work of a value.
    #[must_use]
    pub fn work(&self) -> u64 {
        16 * u64::from(HALVINGS)
    }

    fn degree(&self) -> usize {
        (self.0.len() - 1).min(3)
    }

    fn spans(&self) -> usize {
        self.0.len() - self.degree()
    }

    /// A coordinate of the spline by de Boor's algorithm; `u` is from 0 to the number of spans.
    fn at(&self, u: f64, axis: usize) -> f64 {
        let (degree, spans) = (self.degree(), self.spans());
        let span = (u as usize).min(spans - 1);
        let knot = |at: usize| at.saturating_sub(degree).min(spans) as f64;
        let mut near = [0.0; 4];
        for (value, point) in near.iter_mut().zip(&self.0[span..=span + degree]) {
            *value = point[axis];
        }
        for round in 1..=degree {
            for at in (round..=degree).rev() {
                let (from, to) = (knot(span + at), knot(span + at + 1 + degree - round));
                let part = (u - from) / (to - from);
                near[at] = (1.0 - part) * near[at - 1] + part * near[at];
            }
        }
        near[degree]
    }
}

impl fmt::Display for Curve {
    /// Prints the points in the notation.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, [x, y]) in self.0.iter().enumerate() {
            let space = if at == 0 { "" } else { " " };
            write!(f, "{space}({}, {})", number(*x), number(*y))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The blending function of a point by its recursive definition, as cpfg computes it (`splinefun.cpp` of the Virtual
    /// Laboratory): order `t`, and knots by whole numbers.
    fn blend(k: usize, t: usize, u: f64, knot: &dyn Fn(usize) -> f64) -> f64 {
        if t == 1 {
            return f64::from(u8::from(knot(k) <= u && u < knot(k + 1)));
        }
        let part = |above: f64, below: f64| if below == 0.0 { 0.0 } else { above / below };
        part(u - knot(k), knot(k + t - 1) - knot(k)) * blend(k, t - 1, u, knot)
            + part(knot(k + t) - u, knot(k + t) - knot(k + 1)) * blend(k + 1, t - 1, u, knot)
    }

    /// A value of cpfg: the parameter is halved until x is nearer than `error`; cpfg has 0.001.
    fn of_cpfg(points: &[[f64; 2]], x: f64, error: f64) -> f64 {
        let n = points.len() - 1;
        let knot = |j: usize| {
            if j < 4 {
                0.0
            } else if j > n {
                (n - 2) as f64
            } else {
                (j - 3) as f64
            }
        };
        let (mut low, mut high) = (0.0, 1.0);
        loop {
            let middle: f64 = (low + high) / 2.0;
            let u = middle * (n - 2) as f64;
            let sum =
                |axis: usize| points.iter().enumerate().map(|(k, p)| p[axis] * blend(k, 4, u, &knot)).sum::<f64>();
            if (sum(0) - x).abs() <= error {
                return sum(1);
            }
            if sum(0) > x { high = middle } else { low = middle }
        }
    }

    #[test]
    fn values_are_those_of_cpfg() {
        // The first two are files of the Virtual Laboratory's models of a lilac and of a fern leaf.
        let files: [&[[f64; 2]]; 4] = [
            &[[0.0, 0.531316], [0.323810, 0.502745], [0.647619, 0.450364], [1.0, 0.417031]],
            &[[0.0, 1.100946], [0.218100, 0.872272], [0.328571, 0.817075], [1.0, 0.485892]],
            &[[0.0, 0.0], [0.25, 0.1], [0.5, 0.5], [0.5, 0.5], [0.5, 0.5], [0.75, 0.9], [1.0, 1.0]],
            &[[0.0, 0.0], [0.2, 1.0], [0.3, -1.0], [0.4, 2.0], [0.8, 0.0], [0.9, 0.5], [0.95, 3.0], [1.0, 1.0]],
        ];
        for points in files {
            let curve = Curve::new(points.to_vec()).unwrap();
            for at in 1..200 {
                let x = f64::from(at) / 200.0;
                let exact = of_cpfg(points, x, 1e-13);
                assert!((curve.value(x) - exact).abs() < 1e-9, "{x}: {} {exact}", curve.value(x));
                // cpfg itself is as near as its error of x allows.
                let (below, above) = (curve.value(x - 0.001), curve.value(x + 0.001));
                let own = of_cpfg(points, x, 0.001);
                let (low, high) = (below.min(above).min(exact), below.max(above).max(exact));
                assert!(own >= low - 1e-3 && own <= high + 1e-3, "{x}: {own} is not in {low}..{high}");
            }
        }
    }

    #[test]
    fn few_points_are_a_line_and_a_parabola() {
        let line = Curve::new(vec![[-1.0, 2.0], [3.0, 4.0]]).unwrap();
        let parabola = Curve::new(vec![[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]]).unwrap();
        for at in 0..=40 {
            let x = -1.0 + f64::from(at) / 10.0;
            assert!((line.value(x) - (2.5 + x / 2.0)).abs() < 1e-14);
            let x = f64::from(at) / 20.0;
            assert!((parabola.value(x) - x * (2.0 - x)).abs() < 1e-14);
        }
        assert_eq!([-5.0, 9.0, f64::INFINITY, f64::NEG_INFINITY].map(|x| line.value(x)), [2.0, 4.0, 4.0, 2.0]);
        assert!(line.value(f64::NAN).is_nan());
    }

    #[test]
    fn corners_jumps_and_wrong_points() {
        let corner = Curve::new([vec![[0.0, 0.0]], vec![[1.0, 1.0]; 3], vec![[2.0, 0.0]]].concat()).unwrap();
        assert!((corner.value(1.0) - 1.0).abs() < 1e-9);
        let jump =
            Curve::new([vec![[0.0, 0.0]; 4], vec![[1.0, 0.0]; 4], vec![[1.0, 5.0]; 4], vec![[2.0, 5.0]; 4]].concat());
        let jump = jump.unwrap();
        assert!((jump.value(0.999_999) - 0.0).abs() < 1e-9 && (jump.value(1.000_001) - 5.0).abs() < 1e-9);
        for wrong in [
            vec![],
            vec![[0.0, 1.0]],
            vec![[0.0, 1.0], [0.0, 2.0]],
            vec![[0.0, 1.0], [2.0, 1.0], [1.0, 0.0]],
            vec![[0.0, 1.0], [1.0, f64::NAN]],
            vec![[0.0, 1.0], [f64::INFINITY, 1.0]],
            (0..65).map(|at| [f64::from(at), 0.0]).collect(),
        ] {
            assert_eq!(Curve::new(wrong.clone()), None, "{wrong:?}");
        }
    }
}
