//! Numbers of twice the precision of `f64`, for places on a drawing whose segments are 10^-19 of its size.

/// The unevaluated sum of two `f64`: 106 bits (Dekker 1971, Knuth's two-sum).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Wide {
    high: f64,
    low: f64,
}

impl Wide {
    pub(super) const ZERO: Self = Self { high: 0.0, low: 0.0 };

    /// The exact sum of two numbers.
    pub(super) fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let rest = high - a;
        Self { high, low: (a - (high - rest)) + (b - rest) }
    }

    /// The exact product of two numbers (Veltkamp's split), unless the product is out of range.
    pub(super) fn product(a: f64, b: f64) -> Self {
        let split = |v: f64| {
            let big = v * 134_217_729.0;
            let high = big - (big - v);
            (high, v - high)
        };
        let high = a * b;
        let ((a1, a0), (b1, b0)) = (split(a), split(b));
        let low = ((a1 * b1 - high) + a1 * b0 + a0 * b1) + a0 * b0;
        Self { high, low: if low.is_finite() { low } else { 0.0 } }
    }

    pub(super) fn plus(self, v: f64) -> Self {
        let sum = Self::sum(self.high, v);
        Self::sum(sum.high, sum.low + self.low)
    }

    pub(super) fn plus_wide(self, other: Self) -> Self {
        self.plus(other.high).plus(other.low)
    }

    /// The quotient, to about 106 bits.
    pub(super) fn over(self, divisor: f64) -> Self {
        let quotient = self.high / divisor;
        Self::sum(quotient, self.minus(Self::product(quotient, divisor)) / divisor)
    }

    /// The number rounded to `f64`, and the rest.
    pub(super) fn parts(self) -> [f64; 2] {
        [self.high, self.low]
    }

    /// The difference, rounded once.
    pub(super) fn minus(self, other: Self) -> f64 {
        let whole = Self::sum(self.high, -other.high);
        whole.high + (whole.low + (self.low - other.low))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_parts_of_large_numbers_are_kept() {
        let tiny = 1e-25;
        let a = Wide::sum(1.0, 0.0).plus(tiny);
        assert_eq!(a.minus(Wide::sum(1.0, 0.0)), tiny);
        let third = Wide::product(1.0 / 3.0, 3.0);
        assert_eq!(third.minus(Wide::sum(1.0, 0.0)), 3.0 * (1.0 / 3.0) - 1.0 + third.low);
        assert!(third.low != 0.0);
        let back = Wide::sum(1.0, tiny).over(3.0);
        assert!(
            Wide::product(back.parts()[0], 3.0).plus(3.0 * back.parts()[1]).minus(Wide::sum(1.0, tiny)).abs() < 1e-30
        );
        assert_eq!(Wide::product(1e300, 1e300).low, 0.0);
    }
}
