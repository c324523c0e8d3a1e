//! Numbers side by side without branches, so that the compiler makes vector instructions of them.

use core::array::from_fn;
use core::ops::{Add, Mul, Sub};

/// The number of samples that are looked at together.
pub(super) const LANES: usize = 4;

/// From this number on an `f32` is whole, and its lowest bits are the number above this one.
const WHOLE: f32 = 8_388_608.0;

/// A number for each sample.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lanes(pub [f32; LANES]);

/// A decision for each sample: all bits set, or none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mask(pub [u32; LANES]);

impl Lanes {
    /// The same number in all lanes.
    #[inline(always)]
    pub(super) fn all(value: f32) -> Self {
        Self([value; LANES])
    }

    /// Numbers that count up by 1.
    #[inline(always)]
    pub(super) fn from(first: f32) -> Self {
        Self([first, first + 1.0, first + 2.0, first + 3.0])
    }

    #[inline(always)]
    pub(super) fn at_least(self, least: f32) -> Self {
        Self(from_fn(|i| if self.0[i] > least { self.0[i] } else { least }))
    }

    #[inline(always)]
    pub(super) fn at_most(self, most: f32) -> Self {
        Self(from_fn(|i| if self.0[i] < most { self.0[i] } else { most }))
    }

    /// The greater of both numbers in each lane.
    #[inline(always)]
    pub(super) fn at_least_of(self, other: Self) -> Self {
        Self(from_fn(|i| if self.0[i] > other.0[i] { self.0[i] } else { other.0[i] }))
    }

    /// The smaller of both numbers in each lane.
    #[inline(always)]
    pub(super) fn at_most_of(self, other: Self) -> Self {
        Self(from_fn(|i| if self.0[i] < other.0[i] { self.0[i] } else { other.0[i] }))
    }

    /// The smallest number.
    #[inline(always)]
    pub(super) fn least(self) -> f32 {
        let [a, b, c, d] = self.0;
        let least = |a: f32, b: f32| if a < b { a } else { b };
        least(least(a, b), least(c, d))
    }

    /// The greatest number.
    #[inline(always)]
    pub(super) fn greatest(self) -> f32 {
        let [a, b, c, d] = self.0;
        let greatest = |a: f32, b: f32| if a > b { a } else { b };
        greatest(greatest(a, b), greatest(c, d))
    }

    #[inline(always)]
    pub(super) fn sum(self) -> f32 {
        let [a, b, c, d] = self.0;
        (a + b) + (c + d)
    }

    /// Numbers from 0 to 2^22, rounded to whole numbers.
    #[inline(always)]
    pub(super) fn round(self) -> Self {
        self + WHOLE + -WHOLE
    }

    /// Whole numbers from 0 to 2^22.
    #[inline(always)]
    pub(super) fn indices(self) -> [usize; LANES] {
        from_fn(|i| ((self.0[i] + WHOLE).to_bits() & 0x7f_ffff) as usize)
    }

    /// The square roots; 0 for negative numbers.
    #[inline(always)]
    pub(super) fn root(self) -> Self {
        Self(self.at_least(0.0).0.map(f32::sqrt))
    }

    /// The reciprocals.
    #[inline(always)]
    pub(super) fn inverse(self) -> Self {
        Self(from_fn(|i| 1.0 / self.0[i]))
    }

    /// The lanes in which the number is less than the other.
    #[inline(always)]
    pub(super) fn below(self, other: Self) -> Mask {
        Mask(from_fn(|i| if self.0[i] < other.0[i] { u32::MAX } else { 0 }))
    }

    /// The numbers of the lanes in the mask, and the other's numbers elsewhere.
    #[inline(always)]
    pub(super) fn or(self, mask: Mask, other: Self) -> Self {
        Self(from_fn(|i| f32::from_bits((self.0[i].to_bits() & mask.0[i]) | (other.0[i].to_bits() & !mask.0[i]))))
    }

    /// Numbers from 0 to 255, rounded to whole numbers.
    #[inline(always)]
    pub(super) fn bytes(self) -> [u32; LANES] {
        from_fn(|i| (self.0[i] + WHOLE).to_bits() & 0xff)
    }
}

impl Mask {
    #[inline(always)]
    pub(super) fn and(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] & other.0[i]))
    }

    #[inline(always)]
    pub(super) fn with(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] | other.0[i]))
    }

    #[inline(always)]
    pub(super) fn any(self) -> bool {
        self.0.iter().fold(0, |all, one| all | one) != 0
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] * other.0[i]))
    }
}

impl Add<f32> for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f32) -> Self {
        Self(from_fn(|i| self.0[i] + other))
    }
}

impl Mul<f32> for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f32) -> Self {
        Self(from_fn(|i| self.0[i] * other))
    }
}
