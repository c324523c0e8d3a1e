//! Numbers with many binary places: places in drawings whose segments are 10^-301 of their size.
//!
//! A number is a whole number of units of `2^-32p`. The number p of 32-bit places after the point is the caller's, and
//! the same for all numbers that are added.

use core::cmp::Ordering;

/// A sign and a size in units of the last place.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Fixed {
    negative: bool,
    /// Base 2^32, the lowest digit first, without zeros at the end.
    digits: Vec<u32>,
}

impl Fixed {
    fn new(negative: bool, mut digits: Vec<u32>) -> Self {
        while digits.last() == Some(&0) {
            digits.pop();
        }
        Self { negative: negative && !digits.is_empty(), digits }
    }

    /// A whole number of units.
    #[must_use]
    pub fn units(number: u128) -> Self {
        Self::new(false, [0, 32, 64, 96].map(|bits| (number >> bits) as u32).to_vec())
    }

    /// A finite number, with `places` places after the point; further bits are dropped.
    #[must_use]
    pub fn of(number: f64, places: usize) -> Self {
        let (mantissa, exponent) = parts(number);
        Self { negative: number < 0.0, ..Self::units(mantissa.into()) }.shifted(exponent + 32 * places as i32)
    }

    /// The nearest `f64`, almost: the bits after the first 64 are dropped. `places` are the places after the point.
    #[must_use]
    pub fn number(&self, places: usize) -> f64 {
        self.number_at(places, 0)
    }

    /// As [`Fixed::number`], times `2^exponent`.
    #[must_use]
    pub fn number_at(&self, places: usize, exponent: i32) -> f64 {
        let top = self.digits.iter().rev().take(3).fold(0.0, |sum, &digit| sum * 4_294_967_296.0 + f64::from(digit));
        let below = self.digits.len().saturating_sub(3) as i32 - places as i32;
        libm::scalbn(if self.negative { -top } else { top }, 32 * below + exponent)
    }

    /// Whether the number is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.digits.is_empty()
    }

    /// The number with the other sign.
    #[must_use]
    pub fn opposite(mut self) -> Self {
        self.negative = !self.negative && !self.digits.is_empty();
        self
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        if self.negative == other.negative {
            return Self::new(self.negative, sum(&self.digits, &other.digits));
        }
        match sizes(&self.digits, &other.digits) {
            Ordering::Less => Self::new(other.negative, difference(&other.digits, &self.digits)),
            _ => Self::new(self.negative, difference(&self.digits, &other.digits)),
        }
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.clone().opposite())
    }

    /// The product with a number that has `places` places after the point, rounded towards zero.
    #[must_use]
    pub fn times(&self, other: &Self, places: usize) -> Self {
        let mut product = vec![0_u32; self.digits.len() + other.digits.len()];
        for (at, &a) in self.digits.iter().enumerate().filter(|(_, digit)| **digit != 0) {
            let mut carry = 0_u64;
            for (to, &b) in product[at..].iter_mut().zip(&other.digits) {
                carry += u64::from(*to) + u64::from(a) * u64::from(b);
                *to = carry as u32;
                carry >>= 32;
            }
            product[at + other.digits.len()] = carry as u32;
        }
        product.drain(..places.min(product.len()));
        Self::new(self.negative != other.negative, product)
    }

    /// The number times a finite factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let (mantissa, exponent) = parts(factor);
        let product = self.times(&Self::units(mantissa.into()), 0).shifted(exponent);
        if factor < 0.0 { product.opposite() } else { product }
    }

    /// The number divided by a positive normal number, rounded towards zero.
    #[must_use]
    pub fn over(&self, divisor: f64) -> Self {
        let (mantissa, exponent) = parts(divisor);
        let mut quotient = self.shifted(-exponent);
        let mut rest = 0_u128;
        for digit in quotient.digits.iter_mut().rev() {
            rest = rest << 32 | u128::from(*digit);
            *digit = (rest / u128::from(mantissa)) as u32;
            rest %= u128::from(mantissa);
        }
        Self::new(quotient.negative, quotient.digits)
    }

    /// The number times `2^bits`, rounded towards zero.
    #[must_use]
    pub fn shifted(&self, bits: i32) -> Self {
        let (whole, rest) = (bits.div_euclid(32), bits.rem_euclid(32));
        let mut digits = vec![0; whole.max(0) as usize];
        let mut carry = 0_u64;
        for (at, &digit) in self.digits.iter().chain(&[0]).enumerate() {
            carry |= u64::from(digit) << rest;
            if at as i64 + i64::from(whole) >= 0 {
                digits.push(carry as u32);
            }
            carry >>= 32;
        }
        Self::new(self.negative, digits)
    }

    /// Compares two numbers that are not negative.
    #[must_use]
    pub fn compared(&self, other: &Self) -> Ordering {
        sizes(&self.digits, &other.digits)
    }

    /// A whole number without sign from decimal digits; `None` for other texts and for more than `most` digits.
    #[must_use]
    pub fn read(text: &str, most: usize) -> Option<Self> {
        let fits = !text.is_empty() && text.len() <= most && text.bytes().all(|byte| byte.is_ascii_digit());
        fits.then(|| {
            text.bytes().fold(Self::default(), |number, byte| {
                number.times(&Self::units(10), 0).plus(&Self::units((byte - b'0').into()))
            })
        })
    }

    /// A whole number, not negative, in decimal digits.
    #[must_use]
    pub fn decimal(&self) -> String {
        let mut left = self.clone();
        let mut text = vec![];
        while !left.is_zero() || text.is_empty() {
            let tenth = left.over(10.0);
            let digit = left.minus(&tenth.times(&Self::units(10), 0));
            text.push(b'0' + digit.digits.first().map_or(0, |digit| *digit as u8));
            left = tenth;
        }
        text.iter().rev().map(|&byte| char::from(byte)).collect()
    }
}

/// The mantissa, as a whole number, and the exponent of a finite number's size.
fn parts(number: f64) -> (u64, i32) {
    let (fraction, exponent) = libm::frexp(number.abs());
    (libm::scalbn(fraction, 53) as u64, exponent - 53)
}

fn sizes(a: &[u32], b: &[u32]) -> Ordering {
    a.len().cmp(&b.len()).then_with(|| a.iter().rev().cmp(b.iter().rev()))
}

fn sum(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut carry = 0_u64;
    let digit = |of: &[u32], at: usize| u64::from(of.get(at).copied().unwrap_or(0));
    (0..=a.len().max(b.len()))
        .map(|at| {
            carry += digit(a, at) + digit(b, at);
            let low = carry as u32;
            carry >>= 32;
            low
        })
        .collect()
}

/// `a - b`, where `b` is not larger.
fn difference(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut borrow = 0_i64;
    let mut digits = a.to_vec();
    for (at, digit) in digits.iter_mut().enumerate() {
        borrow += i64::from(*digit) - i64::from(b.get(at).copied().unwrap_or(0));
        *digit = borrow as u32;
        borrow >>= 32;
    }
    digits
}

/// A point or a vector in the plane.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct FixedPoint(pub [Fixed; 2]);

impl FixedPoint {
    /// The sum.
    #[must_use]
    pub fn plus(&self, Self([x, y]): &Self) -> Self {
        Self([self.0[0].plus(x), self.0[1].plus(y)])
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, Self([x, y]): &Self) -> Self {
        Self([self.0[0].minus(x), self.0[1].minus(y)])
    }

    /// The vector times a finite factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        if factor == 1.0 { self.clone() } else { Self(self.0.each_ref().map(|c| c.scaled(factor))) }
    }

    /// The vector divided by a positive normal number.
    #[must_use]
    pub fn over(&self, divisor: f64) -> Self {
        if divisor == 1.0 { self.clone() } else { Self(self.0.each_ref().map(|c| c.over(divisor))) }
    }

    /// The vector times `2^bits`.
    #[must_use]
    pub fn shifted(&self, bits: i32) -> Self {
        Self(self.0.each_ref().map(|c| c.shifted(bits)))
    }

    /// The vector turned by the direction with this cosine and sine, which have `places` places after the point.
    #[must_use]
    pub fn turned(&self, Self([c, s]): &Self, places: usize) -> Self {
        let Self([x, y]) = self;
        Self([x.times(c, places).minus(&y.times(s, places)), x.times(s, places).plus(&y.times(c, places))])
    }

    /// The nearest numbers, as [`Fixed::number_at`].
    #[must_use]
    pub fn numbers(&self, places: usize, exponent: i32) -> [f64; 2] {
        self.0.each_ref().map(|c| c.number_at(places, exponent))
    }
}

/// Cosines and sines with many places.
#[derive(Clone, Debug)]
pub struct Circle {
    /// The places after the point.
    places: usize,
    /// Half a turn, in radians.
    half: Fixed,
}

impl Circle {
    /// Cosines and sines with `places` places after the point.
    #[must_use]
    pub fn new(places: usize) -> Self {
        let one = Fixed::units(1).shifted(32 * places as i32);
        // Machin, 1706: a quarter of pi is 4 arctan(1/5) - arctan(1/239).
        let arctan = |inverse: f64| {
            let (mut power, mut total) = (one.over(inverse), Fixed::default());
            let mut odd = 1.0;
            while !power.is_zero() {
                total = total.plus(&power.over(odd));
                power = power.over(inverse * inverse).opposite();
                odd += 2.0;
            }
            total
        };
        let half = arctan(5.0).scaled(16.0).minus(&arctan(239.0).scaled(4.0));
        Self { places, half }
    }

    /// The cosine and the sine of `units`, of which `turn`, a multiple of 8, are a full turn.
    #[must_use]
    pub fn at(&self, units: u64, turn: u64) -> FixedPoint {
        let quarter = turn / 4;
        let (quadrant, within) = (units / quarter, units % quarter);
        let [c, s] = if within <= turn / 8 {
            self.octant(within, turn)
        } else {
            let [c, s] = self.octant(quarter - within, turn);
            [s, c]
        };
        FixedPoint(match quadrant {
            0 => [c, s],
            1 => [s.opposite(), c],
            2 => [c.opposite(), s.opposite()],
            _ => [s, c.opposite()],
        })
    }

    /// The series of cosine and sine, for at most an eighth of a turn.
    fn octant(&self, units: u64, turn: u64) -> [Fixed; 2] {
        // Both are below 2^53, so that they are exact as f64.
        let angle = self.half.times(&Fixed::units(units.into()), 0).over(turn as f64 / 2.0);
        let mut sums = [Fixed::default(), Fixed::default()];
        let (mut term, mut number) = (Fixed::units(1).shifted(32 * self.places as i32), 0.0);
        let mut at = 0;
        while !term.is_zero() {
            let sum = &mut sums[at % 2];
            *sum = if at % 4 < 2 { sum.plus(&term) } else { sum.minus(&term) };
            (at, number) = (at + 1, number + 1.0);
            term = term.times(&angle, self.places).over(number);
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_and_written() {
        for text in ["0", "7", "4294967296", "340282366920938463463374607431768211457"] {
            assert_eq!(Fixed::read(text, 300).unwrap().decimal(), text);
        }
        let long = "123456789".repeat(33);
        assert_eq!(Fixed::read(&long, 300).unwrap().decimal(), long);
        assert_eq!(["", "-1", "1e3", "1.5"].map(|text| Fixed::read(text, 300)), [const { None }; 4]);
        assert_eq!(Fixed::read(&long, 200), None);
    }

    #[test]
    fn arithmetic_agrees_with_that_of_f64_and_i128() {
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11).cast_signed() - (1 << 52)
        };
        for _ in 0..2000 {
            let [a, b] = [next() >> (next() & 31), next() >> (next() & 31)];
            let [x, y] = [a, b].map(|v| Fixed::of(v as f64, 2));
            assert_eq!(x.plus(&y), Fixed::of((a + b) as f64, 2));
            assert_eq!(x.minus(&y).number(2), (a - b) as f64);
            let product = (i128::from(a) * i128::from(b)) as f64;
            assert!((x.times(&y, 2).number(2) - product).abs() <= 1e-15 * product.abs());
            assert_eq!(x.scaled(0.375).number(2), a as f64 * 0.375);
            if b != 0 {
                let quotient = x.over(b.unsigned_abs() as f64).number(2);
                assert!((quotient - a as f64 / b.unsigned_abs() as f64).abs() <= 1e-15 * quotient.abs() + 1e-18);
            }
            assert_eq!(x.shifted(70).shifted(-70), x);
        }
        assert_eq!(Fixed::of(-0.75, 1).number(1), -0.75);
        assert_eq!(Fixed::of(1e300, 34).number(34), 1e300);
        assert_eq!(Fixed::of(1e-300, 34).number(34), 1e-300);
    }

    #[test]
    fn a_circle_closes_to_the_last_places() {
        let circle = Circle::new(36);
        assert_eq!(circle.half.number(36), core::f64::consts::PI);
        let turn = 360_360;
        for units in [0, 1, 30_030, 45_045, 60_060, 90_090, 123_456, 200_000, 300_301, 360_359] {
            let FixedPoint([c, s]) = circle.at(units, turn);
            let square = c.times(&c, 36).plus(&s.times(&s, 36));
            let off = square.minus(&Fixed::units(1).shifted(32 * 36));
            assert!(off.number(36).abs() < 1e-305, "{units}");
            let angle = units as f64 * (2.0 * core::f64::consts::PI / f64::from(turn as u32));
            assert!((c.number(36) - libm::cos(angle)).abs() < 1e-15 && (s.number(36) - libm::sin(angle)).abs() < 1e-15);
        }
        let FixedPoint([c, s]) = circle.at(30_030, turn);
        assert!(s.minus(&Fixed::of(0.5, 36)).number(36).abs() < 1e-300 && c.number(36) > 0.0);
    }
}
