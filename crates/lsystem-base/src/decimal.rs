//! Decimal numbers, read exactly: the nearest double, ties to even.
//!
//! The standard library gives the same results, but its tables make the page's wasm 13 KB larger, and 11 KB compressed,
//! since they do not compress. So all numbers that the wasms read are read here.

use core::cmp::Ordering;

/// The most digits that are kept. Any double or midpoint of two doubles has fewer significant digits.
const MAX_DIGITS: usize = 800;

/// The powers of ten that are exact doubles.
const EXACT: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// Reads a number such as `-12`, `0.5`, `.5`, `5.` or `1e-7`. Numbers too large for a double are infinite; `None` if
/// the text is not a number.
#[must_use]
pub fn read(text: &str) -> Option<f64> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, whole(exponent)?),
        None => (unsigned, 0),
    };
    let (before, after) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if before.len() + after.len() == 0 || !are_digits(before) || !are_digits(after) {
        return None;
    }
    let written = before.bytes().chain(after.bytes());
    let leading = written.clone().take_while(|&digit| digit == b'0').count();
    let mut digits: Vec<u8> = written.clone().skip(leading).take(MAX_DIGITS).map(|digit| digit - b'0').collect();
    // If a digit left out is not zero, the last digit kept must not be zero, so that rounding sees a remainder.
    let rest = written.skip(leading + digits.len());
    let left_out = rest.clone().count();
    if rest.clone().any(|digit| digit != b'0')
        && let Some(last) = digits.last_mut()
    {
        *last |= 1;
    }
    let size = nearest(&digits, exponent - after.len() as i64 + left_out as i64);
    Some(if text.starts_with('-') { -size } else { size })
}

/// Reads an exponent, clamped to 2^40.
fn whole(text: &str) -> Option<i64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let size = digits.bytes().fold(0, |size, digit| (size * 10 + i64::from(digit - b'0')).min(1 << 40));
    Some(if text.starts_with('-') { -size } else { size })
}

/// The double nearest to `digits` times 10^`exponent`.
fn nearest(digits: &[u8], exponent: i64) -> f64 {
    let significant = digits.iter().rposition(|&digit| digit != 0).map_or(0, |last| last + 1);
    let (digits, exponent) = (&digits[..significant], exponent + (digits.len() - significant) as i64);
    if digits.is_empty() {
        return 0.0;
    }
    if digits.len() <= 15
        && let Some(&power) = EXACT.get(exponent.unsigned_abs() as usize)
    {
        // Both numbers are exact, so the only rounding is that of the result.
        let whole = digits.iter().fold(0.0, |whole, &digit| whole * 10.0 + f64::from(digit));
        return if exponent < 0 { whole / power } else { whole * power };
    }
    // The largest double has 309 digits before the point; the smallest begins at the 324th digit after it.
    match exponent + digits.len() as i64 {
        311.. => f64::INFINITY,
        ..-325 => 0.0,
        _ => rounded(Big::of(digits), exponent),
    }
}

/// The double nearest to `numerator` times 10^`exponent`, computed in integers of any length.
fn rounded(mut numerator: Big, exponent: i64) -> f64 {
    let mut denominator = Big(vec![1]);
    if exponent < 0 { &mut denominator } else { &mut numerator }.scale(exponent.unsigned_abs());
    // Exponent of the quotient's last bit. The quotient then has 54 or 55 bits, one or two more than a double's
    // mantissa; subnormal doubles have fewer.
    let unit = (numerator.bits() - denominator.bits() - 54).max(-1075);
    if unit < 0 { &mut numerator } else { &mut denominator }.double(unit.unsigned_abs());
    denominator.double(55);
    let mut quotient = 0_u64;
    for _ in 0..=55 {
        quotient = quotient << 1 | u64::from(numerator.subtract(&denominator));
        numerator.double(1);
    }
    let more = if quotient < 1 << 54 { 1 } else { 2 };
    let (mantissa, remainder) = (quotient >> more, quotient & ((1 << more) - 1));
    let is_up = match remainder.cmp(&(1 << (more - 1))) {
        Ordering::Less => false,
        Ordering::Equal => numerator.bits() > 0 || mantissa % 2 == 1,
        Ordering::Greater => true,
    };
    libm::scalbn((mantissa + u64::from(is_up)) as f64, (unit + more) as i32)
}

/// An integer of any length: limbs of 32 bits, least significant first. The last limb is not zero.
struct Big(Vec<u32>);

impl Big {
    fn of(digits: &[u8]) -> Self {
        let mut big = Self(Vec::new());
        for nine in digits.chunks(9) {
            let value = nine.iter().fold(0, |value, &digit| value * 10 + u32::from(digit));
            big.times(10_u32.pow(nine.len() as u32), value);
        }
        big
    }

    /// Multiplies by `factor` and adds `more`.
    fn times(&mut self, factor: u32, more: u32) {
        let mut carry = u64::from(more);
        for limb in &mut self.0 {
            carry += u64::from(*limb) * u64::from(factor);
            *limb = carry as u32;
            carry >>= 32;
        }
        if carry > 0 {
            self.0.push(carry as u32);
        }
    }

    /// Multiplies by 10^`exponent`.
    fn scale(&mut self, exponent: u64) {
        for _ in 0..exponent / 9 {
            self.times(1_000_000_000, 0);
        }
        self.times(10_u32.pow((exponent % 9) as u32), 0);
    }

    /// Multiplies by 2^`exponent`.
    fn double(&mut self, exponent: u64) {
        if !self.0.is_empty() {
            self.times(1 << (exponent % 32), 0);
            let limbs = core::iter::repeat_n(0, (exponent / 32) as usize);
            self.0.splice(0..0, limbs);
        }
    }

    /// Subtracts another number, unless it is larger. Returns whether it was subtracted.
    fn subtract(&mut self, other: &Self) -> bool {
        let by_length = self.0.len().cmp(&other.0.len());
        if by_length.then_with(|| self.0.iter().rev().cmp(other.0.iter().rev())) == Ordering::Less {
            return false;
        }
        let mut borrow = 0;
        for (at, limb) in self.0.iter_mut().enumerate() {
            let rest = i64::from(*limb) - i64::from(other.0.get(at).copied().unwrap_or(0)) - borrow;
            *limb = rest as u32;
            borrow = i64::from(rest < 0);
        }
        while self.0.last() == Some(&0) {
            self.0.pop();
        }
        true
    }

    fn bits(&self) -> i64 {
        let highest = self.0.last().map_or(0, |limb| i64::from(limb.leading_zeros()));
        self.0.len() as i64 * 32 - highest
    }
}

#[cfg(test)]
mod tests {
    use super::read;
    use proptest::prelude::*;

    /// Compares with the standard library, except for words such as `inf`.
    fn check(text: &str) {
        let is_word = text.bytes().any(|byte| byte.is_ascii_alphabetic() && !matches!(byte, b'e' | b'E'));
        let expected = text.parse::<f64>().ok().filter(|_| !is_word);
        assert_eq!(read(text).map(f64::to_bits), expected.map(f64::to_bits), "{text}");
    }

    #[test]
    fn numbers_are_read_exactly() {
        for text in [
            "0",
            "-0",
            "-12",
            "0.5",
            ".5",
            "5.",
            "+1e-7",
            "1E5",
            "25.7",
            "1e22",
            "1e23",
            "8.5e22",
            "123456789012345678",
            "9007199254740993",
            "9007199254740992.5",
            "1.7976931348623157e308",
            "1.7976931348623159e308",
            "1e309",
            "4.9e-324",
            "2.4703282292062327e-324",
            "2.4703282292062328e-324",
            "2.2250738585072011e-308",
            "1e-400",
            "1e99999999999999999999",
            "-1e-99999999999999999999",
            "0e99999999999999999999",
            "",
            ".",
            "-",
            "e5",
            "1e",
            "1e+",
            "1.2.3",
            "--1",
            "inf",
            "NaN",
            "0x10",
            "1_000",
            "٣",
            " 1",
        ] {
            check(text);
        }
        let zeros = "0".repeat(2000);
        for text in [format!("0.{zeros}1"), format!("1{zeros}"), format!("1{zeros}e-2000"), format!("0.{zeros}7e2001")]
        {
            check(&text);
        }
        // Halfway between two doubles, exactly and with a further digit 2,000 places on.
        check(&format!("9007199254740993.{zeros}"));
        check(&format!("9007199254740993.{zeros}1"));
    }

    proptest! {
        #[test]
        fn as_the_standard_library_reads(bits in any::<u64>(), digits in "[0-9]{1,25}", point in 0..25_usize, exponent in -345..325_i32) {
            let value = f64::from_bits(bits);
            if value.is_finite() {
                check(&format!("{value:e}"));
                // The middle between this double and the next, where the digits end.
                let next = f64::from_bits(bits.wrapping_add(1));
                if next.is_finite() {
                    check(&format!("{value:.1100e}"));
                    check(&format!("{:.30e}", value / 2.0 + next / 2.0));
                }
            }
            let point = point.min(digits.len());
            check(&format!("{}.{}e{exponent}", &digits[..point], &digits[point..]));
            check(&format!("-{digits}e{exponent}"));
        }

        #[test]
        fn any_text(text in "[-+.0-9eE]{0,12}|\\PC{0,6}") {
            check(&text);
        }
    }
}
