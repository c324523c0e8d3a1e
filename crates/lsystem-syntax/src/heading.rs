//! Headings as exact integers.

use core::ops::{Add, Neg, Sub};

/// Units in one degree. Decimals with up to nine places are exact, and so are turns divided by 7, 11 or 13.
const PER_DEGREE: u64 = 1_001_000_000_000;
/// Units in one full turn.
const TURN: u64 = 360 * PER_DEGREE;

/// A direction or a turn in the plane: counter-clockwise from +x, modulo one full turn.
///
/// A heading is a whole number of units of 1/1,001,000,000,000 degree. A million turns by 25.7 degrees therefore add up
/// exactly, and equal parts of a drawing stay equal. Floating-point sums would differ in the last bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Heading(u64);

impl Heading {
    /// Along +x.
    pub const EAST: Self = Self(0);
    /// Along +y.
    pub const UP: Self = Self(TURN / 4);
    /// The units of a full turn, a multiple of 8.
    pub const TURN: u64 = TURN;
    /// Half a turn.
    pub const HALF: Self = Self(TURN / 2);

    /// The heading nearest to `degrees`; zero when `degrees` is not finite.
    #[must_use]
    pub fn from_degrees(degrees: f64) -> Self {
        if !degrees.is_finite() {
            return Self(0);
        }
        // `%` is exact for floats, so a large angle loses nothing here.
        let within = degrees % 360.0;
        let units = libm::round(within * PER_DEGREE as f64) as i64;
        Self(units.rem_euclid(TURN as i64) as u64)
    }

    /// The heading in degrees, in `0.0..360.0`.
    #[must_use]
    pub fn degrees(self) -> f64 {
        // Adding whole degrees and the fraction separately rounds correctly for every decimal.
        (self.0 / PER_DEGREE) as f64 + (self.0 % PER_DEGREE) as f64 / PER_DEGREE as f64
    }

    /// The heading in units of 1/1,001,000,000,000 degree, less than one full turn.
    pub fn units(self) -> u64 {
        self.0
    }

    /// `factor` times this heading, taken as a turn of more than -180 and up to 180 degrees. `factor` is 0 or more.
    #[must_use]
    pub fn part(self, factor: f64) -> Self {
        let degrees = if self.0 > TURN / 2 { -(-self).degrees() } else { self.degrees() };
        Self::from_degrees(degrees * factor)
    }

    /// Cosine and sine of the heading.
    ///
    /// The angle is reduced to the first octant in integers. Symmetric headings therefore have the same values up to
    /// sign and order, and multiples of 30 and 45 degrees give exact halves and zeros.
    #[must_use]
    pub fn cos_sin(self) -> (f64, f64) {
        const OCTANT: u64 = TURN / 8;
        const QUARTER: u64 = TURN / 4;
        let (quadrant, within) = (self.0 / QUARTER, self.0 % QUARTER);
        let (c, s) = if within <= OCTANT {
            octant(within)
        } else {
            let (c, s) = octant(QUARTER - within);
            (s, c)
        };
        match quadrant {
            0 => (c, s),
            1 => (-s, c),
            2 => (-c, -s),
            _ => (s, -c),
        }
    }
}

/// Cosine and sine of `units` in the first octant.
fn octant(units: u64) -> (f64, f64) {
    match units {
        0 => (1.0, 0.0),
        u if u == 30 * PER_DEGREE => (0.866_025_403_784_438_6, 0.5),
        u if u == 45 * PER_DEGREE => (core::f64::consts::FRAC_1_SQRT_2, core::f64::consts::FRAC_1_SQRT_2),
        _ => {
            let radians = units as f64 * (core::f64::consts::PI / (TURN / 2) as f64);
            (libm::cos(radians), libm::sin(radians))
        }
    }
}

impl Add for Heading {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self((self.0 + other.0) % TURN)
    }
}

impl Neg for Heading {
    type Output = Self;
    fn neg(self) -> Self {
        Self((TURN - self.0) % TURN)
    }
}

impl Sub for Heading {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_and_divided_turns_close() {
        for (degrees, count) in [(25.7, 3600), (22.5, 16), (360.0 / 7.0, 7), (360.0 / 13.0, 13), (0.001, 360_000)] {
            let turn = Heading::from_degrees(degrees);
            let whole = (0..count).fold(Heading::EAST, |sum, _| sum + turn);
            assert_eq!(whole, Heading::EAST, "{degrees}");
            assert_eq!(Heading::from_degrees(-degrees), -turn);
        }
    }

    #[test]
    fn symmetric_directions_have_equal_values() {
        for tenth in 0..3600 {
            let heading = Heading::from_degrees(f64::from(tenth) / 10.0);
            let (c, s) = heading.cos_sin();
            assert_eq!((-heading).cos_sin(), (c, if s == 0.0 { -s + 0.0 } else { -s }));
            assert_eq!((heading + Heading::HALF).cos_sin(), (-c, -s));
            let radians = heading.degrees().to_radians();
            assert!((c - libm::cos(radians)).abs() < 1e-15 && (s - libm::sin(radians)).abs() < 1e-15);
        }
        assert_eq!(Heading::from_degrees(60.0).cos_sin().0, 0.5);
        assert_eq!(Heading::from_degrees(150.0).cos_sin().1, 0.5);
        assert_eq!(Heading::UP.cos_sin(), (-0.0, 1.0));
    }

    #[test]
    fn degrees_survive_the_round_trip() {
        for degrees in [0.0, 25.7, 22.5, 137.507_764_05, 359.999_999_999] {
            assert_eq!(Heading::from_degrees(degrees).degrees(), degrees);
        }
    }
}
