//! Least squares for a few unknowns.

/// Regularisation: this part of the mean of the diagonal is added to the diagonal, so that unknowns without observations
/// stay near zero.
const HELD: f64 = 1e-4;

/// Sums of the products of observed coefficients, and of these with what is observed: the normal equations.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Squares<const N: usize> {
    products: [[f64; N]; N],
    observed: [f64; N],
}

impl<const N: usize> Squares<N> {
    pub(crate) const NONE: Self = Self { products: [[0.0; N]; N], observed: [0.0; N] };

    /// Adds an observation: the sum of the unknowns, each times its part of the row, is `value`.
    pub(crate) fn add(&mut self, row: [f64; N], value: f64, weight: f64) {
        for (at, own) in row.into_iter().enumerate() {
            self.observed[at] += weight * own * value;
            self.products[at].iter_mut().zip(row).for_each(|(sum, other)| *sum += weight * own * other);
        }
    }

    /// The unknowns, by elimination without a choice of pivots: the equations are positive definite. `None` if nothing was
    /// observed.
    pub(crate) fn solved(mut self) -> Option<[f64; N]> {
        let trace: f64 = (0..N).map(|at| self.products[at][at]).sum();
        (0..N).for_each(|at| self.products[at][at] += trace * HELD / N as f64);
        for at in 0..N {
            let (own, value) = (self.products[at], self.observed[at]);
            for row in (0..N).filter(|&row| row != at) {
                let part = self.products[row][at] / own[at];
                self.products[row].iter_mut().zip(own).for_each(|(sum, own)| *sum -= part * own);
                self.observed[row] -= part * value;
            }
        }
        let unknowns: [f64; N] = std::array::from_fn(|at| self.observed[at] / self.products[at][at]);
        unknowns.iter().all(|at| at.is_finite()).then_some(unknowns)
    }
}

/// How much an observation counts that is off, if those that are off by `most` do not count (Beaton and Tukey, "The
/// fitting of power series", 1974).
pub(crate) fn bisquare(off: f64, most: f64) -> f64 {
    let rest = 1.0 - (off / most) * (off / most);
    if rest > 0.0 { rest * rest } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unknowns_leave_the_least_squares() {
        let rows = [[1.0, 0.0], [1.0, 1.0], [1.0, 2.0], [1.0, 3.0], [1.0, 4.0]];
        let values = [1.1, 2.9, 5.2, 6.8, 40.0];
        let mut squares = Squares::NONE;
        let weights = values.map(|value| bisquare(value, 30.0));
        rows.iter().zip(values).zip(weights).for_each(|((&row, value), weight)| squares.add(row, value, weight));
        let own = squares.solved().expect("a line");
        let left = |[a, b]: [f64; 2]| {
            let off = |(row, value): (&[f64; 2], f64)| a * row[0] + b * row[1] - value;
            rows.iter().zip(values).zip(weights).map(|(at, weight)| weight * off(at) * off(at)).sum::<f64>()
        };
        // What holds the unknowns moves them by less than a step of this grid.
        for (a, b) in (-20..=20).flat_map(|a| (-20..=20).map(move |b| (f64::from(a) * 0.02, f64::from(b) * 0.02))) {
            assert!((a, b) == (0.0, 0.0) || left([own[0] + a, own[1] + b]) > left(own), "{a} {b}");
        }
        assert!(weights[4] == 0.0 && Squares::<3>::NONE.solved().is_none());
    }
}
