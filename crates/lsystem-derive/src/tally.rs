//! Exact counts of any size.
//!
//! Counts are only added and printed, so they are kept in decimal. A general library for big integers would be a tenth
//! of the page's wasm.

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

    proptest! {
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
