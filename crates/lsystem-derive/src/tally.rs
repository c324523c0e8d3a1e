//! Exact counts of any size.
//!
//! Counts are only added and printed, so they are kept in decimal. A general library for big integers would be a tenth
//! of the page's wasm.

use core::cmp::Ordering;
use core::fmt;

/// A count without upper bound.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Limbs of nine decimal digits, least significant first, without leading zeros. Zero has no limbs.
    limbs: Vec<u32>,
}

const LIMB: u64 = 1_000_000_000;

impl Tally {
    /// The count 0.
    pub const ZERO: Self = Self { limbs: Vec::new() };

    /// The number of limbs of nine digits.
    pub fn limbs(&self) -> usize {
        self.limbs.len()
    }

    /// Adds `times` times `other`.
    pub fn add_times(&mut self, times: u32, other: &Self) {
        if times == 0 {
            return;
        }
        if self.limbs.len() < other.limbs.len() {
            self.limbs.resize(other.limbs.len(), 0);
        }
        let mut carry = 0;
        let addends = other.limbs.iter().copied().chain(core::iter::repeat(0));
        for (limb, addend) in self.limbs.iter_mut().zip(addends) {
            // No overflow: the sum is below 2^30 + 2^62 + 2^34.
            let sum = u64::from(*limb) + u64::from(addend) * u64::from(times) + carry;
            *limb = (sum % LIMB) as u32;
            carry = sum / LIMB;
        }
        while carry > 0 {
            self.limbs.push((carry % LIMB) as u32);
            carry /= LIMB;
        }
    }
}

impl Tally {
    /// `self / other`; `None` for a division by zero.
    #[must_use]
    pub fn ratio(&self, other: &Self) -> Option<f64> {
        /// The leading digits that are divided: they fit a `u128`, and an `f64` needs fewer.
        const DIGITS: usize = 38;
        let [a, b] = [self, other].map(Self::to_string);
        let dropped = a.len().max(b.len()).saturating_sub(DIGITS);
        let leading = |digits: &str| digits[..digits.len().saturating_sub(dropped)].parse().unwrap_or(0_u128);
        let (a, b) = (leading(&a), leading(&b));
        let whole = a.checked_div(b)?;
        Some(whole as f64 + (a % b) as f64 / b as f64)
    }
}

impl Ord for Tally {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_length = self.limbs.len().cmp(&other.limbs.len());
        by_length.then_with(|| self.limbs.iter().rev().cmp(other.limbs.iter().rev()))
    }
}

impl PartialOrd for Tally {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl From<u128> for Tally {
    fn from(mut value: u128) -> Self {
        let mut limbs = Vec::new();
        while value > 0 {
            limbs.push((value % u128::from(LIMB)) as u32);
            value /= u128::from(LIMB);
        }
        Self { limbs }
    }
}

impl From<u64> for Tally {
    fn from(value: u64) -> Self {
        Self::from(u128::from(value))
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some((first, rest)) = self.limbs.split_last() else { return f.write_str("0") };
        write!(f, "{first}")?;
        rest.iter().rev().try_for_each(|limb| write!(f, "{limb:09}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn doubles_past_any_machine_number() {
        let mut two = Tally::from(1_u64);
        for _ in 0..1000 {
            let same = two.clone();
            two.add_times(1, &same);
        }
        let digits = two.to_string();
        assert_eq!(digits.len(), 302);
        assert!(digits.starts_with("10715086071862673209") && digits.ends_with("37205668069376"), "{digits}");
        assert_eq!(Tally::ZERO.to_string(), "0");
        assert_eq!(Tally::from(0_u64), Tally::ZERO);
    }

    fn power(base: u32, exponent: u32) -> Tally {
        (0..exponent).fold(Tally::from(1_u64), |power, _| {
            let mut next = Tally::ZERO;
            next.add_times(base, &power);
            next
        })
    }

    #[test]
    fn ratios_of_numbers_beyond_floating_point() {
        let close = |a: &Tally, b: &Tally, expected: f64| {
            let ratio = a.ratio(b).unwrap_or(f64::NAN);
            assert!((ratio / expected - 1.0).abs() < 1e-15, "{ratio} is not {expected}");
        };
        close(&power(3, 1001), &power(3, 1000), 3.0);
        close(&power(30, 1000), &power(30, 999), 30.0);
        close(&power(7, 20), &power(7, 22), 1.0 / 49.0);
        assert_eq!(Tally::from(5_u64).ratio(&Tally::from(2_u64)), Some(2.5));
        assert_eq!(Tally::ZERO.ratio(&power(3, 1000)), Some(0.0));
        assert_eq!(power(3, 1000).ratio(&Tally::ZERO), None);
    }

    proptest! {
        #[test]
        fn orders_as_machine_numbers_do(a in 0..u128::MAX, b in 0..u128::MAX, shift in 0..120) {
            let b = b >> shift;
            prop_assert_eq!(Tally::from(a).cmp(&Tally::from(b)), a.cmp(&b));
        }

        #[test]
        fn adds_as_machine_numbers_do(a in 0..u128::MAX >> 33, b in 0..u128::MAX >> 33, times in 0..u32::MAX) {
            let mut sum = Tally::from(a);
            sum.add_times(times, &Tally::from(b));
            let expected = a + b * u128::from(times);
            prop_assert_eq!(sum.to_string(), expected.to_string());
            prop_assert_eq!(&sum, &Tally::from(expected));
        }
    }
}
