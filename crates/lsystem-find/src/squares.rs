//! Least squares for a few unknowns.

/// What holds the unknowns where the observations do not tell them, as a part of what is told.
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
