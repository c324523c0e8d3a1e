//! Numbers beyond the range of `f64`: a drawing of a thousand generations has 2^3000 segments.

/// The number `part * 2^exponent`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Amount {
    /// The absolute value is at least 0.5 and below 1, or 0.
    part: f64,
    exponent: i32,
}

impl Amount {
    pub(crate) const ONE: Self = Self { part: 0.5, exponent: 1 };

    pub(crate) fn new(value: f64) -> Self {
        if !value.is_finite() {
            return Self::default();
        }
        let (part, exponent) = libm::frexp(value);
        Self { part, exponent }
    }

    pub(crate) fn is_zero(self) -> bool {
        self.part == 0.0
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other } else { self };
        }
        let (a, b) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        Self { exponent: a.exponent, part: 1.0 }.times(a.part + libm::scalbn(b.part, b.exponent - a.exponent))
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        let Self { part, exponent } = Self::new(self.part * factor);
        Self { part, exponent: exponent.saturating_add(self.exponent) }
    }

    /// The exponent of the greatest power of two that is not greater than the number; `None` for 0.
    pub(crate) fn exponent(self) -> Option<i32> {
        (!self.is_zero()).then(|| self.exponent - 1)
    }

    /// The number in units of `2^exponent`.
    pub(crate) fn units(self, exponent: i32) -> f64 {
        libm::scalbn(self.part, self.exponent.saturating_sub(exponent))
    }

    /// The ratio of the number to `whole`; 0 if `whole` is 0.
    pub(crate) fn of(self, whole: Self) -> f64 {
        if whole.is_zero() { 0.0 } else { self.units(whole.exponent) / whole.part }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_go_beyond_floating_point() {
        let mut huge = Amount::new(3.0);
        for _ in 0..1000 {
            huge = huge.times(8.0);
        }
        assert_eq!(huge.exponent(), Some(3001));
        assert_eq!(huge.plus(huge).units(3001), 3.0);
        assert_eq!(Amount::default().plus(huge), huge);
        let tiny = Amount::new(1.0).times(libm::scalbn(1.0, -900)).times(libm::scalbn(1.0, -900));
        assert_eq!(tiny.plus(Amount::default()).exponent(), Some(-1800));
        assert_eq!(tiny.plus(tiny).of(tiny), 2.0);
        assert_eq!(tiny.of(huge), 0.0);
    }
}
