//! A place on a segment as the origin of views: exact at any depth, where coordinates are not.

use lsystem_base::MAX_SEGMENT_DIGITS;
use lsystem_base::decimal;
use lsystem_base::fixed::Fixed;

/// The most digits of a fraction that are written: all that an `f64` below 1 needs, with a few zeros in front.
const MAX_DIGITS: usize = 24;

/// A place on a segment.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// The segment's number (0-based).
    pub segment: Fixed,
    /// The part of the segment before the place, from 0 at the start to less than 1.
    pub along: f64,
}

impl From<Fixed> for Origin {
    /// The start of a segment.
    fn from(segment: Fixed) -> Self {
        Self { segment, along: 0.0 }
    }
}

impl Origin {
    /// Reads what [`Origin::text`] writes: the segment's number from 1, and decimals for the part before the place; `None`
    /// for other texts.
    #[must_use]
    pub fn read(text: &str) -> Option<Self> {
        let whole = text.find('.').unwrap_or(text.len());
        let (number, fraction) = text.split_at(whole);
        let number = Fixed::read(number, MAX_SEGMENT_DIGITS).filter(|number| !number.is_zero())?;
        // Signs and exponents are no part of such a fraction.
        let is_plain = fraction.bytes().all(|byte| byte == b'.' || byte.is_ascii_digit());
        let along = match fraction {
            "" => 0.0,
            _ => decimal::read(fraction).filter(|_| is_plain && fraction.len() <= MAX_DIGITS + 1)?,
        };
        Some(Self { segment: number.minus(&Fixed::units(1)), along })
    }

    /// The segment's number from 1, and decimals for the part before the place, if there is one.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = self.segment.plus(&Fixed::units(1)).decimal();
        // A place on the segment is never told as one on the next.
        let part = self.along.to_string();
        if let Some(decimals) = part.strip_prefix("0.")
            && text.len() + part.len() <= MAX_SEGMENT_DIGITS
        {
            text.push('.');
            text.push_str(&decimals[..decimals.len().min(MAX_DIGITS)]);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_read_as_it_is_written() {
        for (text, segment, along) in [("1", 0, 0.0), ("17.25", 16, 0.25), ("200.0000000000000007", 199, 7e-16)] {
            let origin = Origin { segment: Fixed::units(segment), along };
            assert_eq!(Origin::read(text), Some(origin.clone()), "{text}");
            assert_eq!(origin.text(), text);
        }
        let last = Origin { segment: Fixed::units(4), along: 1.0 - f64::EPSILON / 2.0 };
        assert_eq!(Origin::read(&last.text()), Some(last));
        for wrong in ["", "0", "0.5", ".5", "3.", "3.x", "3.5e9", "3.-5", "-3", "3.1.2"] {
            assert_eq!(Origin::read(wrong), None, "{wrong}");
        }
    }
}
