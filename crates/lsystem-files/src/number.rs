//! Short decimal numbers.

use core::fmt::Write;

/// Writes numbers rounded to a number of decimal places, without trailing zeros.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Decimals {
    places: u32,
}

impl Decimals {
    /// Decimals with a resolution of at least a millionth of `size`, at most 17 places.
    pub(super) fn for_size(size: f64) -> Self {
        let places = 6.0 - libm::floor(libm::log10(size.abs()));
        // The cast saturates for sizes without a finite logarithm, and `min` bounds the result.
        Self { places: (places as u32).min(17) }
    }

    /// `value` rounded, in units of the last decimal place; `value` unchanged if the result would be 1e18 or more.
    pub(super) fn round(self, value: f64) -> f64 {
        let scaled = libm::round(value * self.unit());
        if scaled.abs() < 1e18 { scaled + 0.0 } else { value }
    }

    /// Writes `value`.
    pub(super) fn write(self, text: &mut String, value: f64) {
        let scaled = libm::round(value * self.unit());
        // Writing to a `String` cannot fail.
        if scaled.abs() < 1e18 {
            let (units, unit) = (scaled.abs() as u64, self.unit() as u64);
            let sign = if scaled < 0.0 { "-" } else { "" };
            let _ = write!(text, "{sign}{}", units / unit);
            if !units.is_multiple_of(unit) {
                let _ = write!(text, ".{:0width$}", units % unit, width = self.places as usize);
                text.truncate(text.trim_end_matches('0').len());
            }
        } else {
            let _ = write!(text, "{value:e}");
        }
    }

    fn unit(self) -> f64 {
        10_u64.pow(self.places) as f64
    }
}

/// Writes `value` with the fewest digits that read back as the same number.
pub(super) fn write_exact(text: &mut String, value: f64) {
    let _ = match value.abs() {
        0.0 => text.write_char('0'),
        1e-7..1e21 => write!(text, "{value}"),
        _ => write!(text, "{value:e}"),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn short(size: f64, value: f64) -> String {
        let mut text = String::new();
        Decimals::for_size(size).write(&mut text, value);
        text
    }

    #[test]
    fn decimals_fit_the_size() {
        assert_eq!(short(1000.0, 12.345_678), "12.346");
        assert_eq!(short(1000.0, -0.000_1), "0");
        assert_eq!(short(1000.0, -100.0), "-100");
        assert_eq!(short(1.0, 0.050_000_04), "0.05");
        assert_eq!(short(1e-3, 1.5e-7), "0.00000015");
        assert_eq!(short(1e12, 2.5e11 + 0.4), "250000000000");
        assert_eq!(short(1e300, -1.5e300), "-1.5e300");
        assert_eq!(short(0.0, 0.1), "0.1");
        assert_eq!(short(f64::INFINITY, 3.2), "3");
    }

    #[test]
    fn exact_numbers_read_back() {
        for value in [0.0, -0.0, 0.1, -1.0 / 3.0, 1e-300, 1.5e300, 123_456_789.123, 1e21, 1e-7] {
            let mut text = String::new();
            write_exact(&mut text, value);
            assert_eq!(text.parse::<f64>().unwrap(), value);
            assert!(text.len() < 25 && text != "-0");
        }
    }
}
