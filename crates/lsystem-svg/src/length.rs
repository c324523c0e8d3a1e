//! Lengths with their units.

use std::str::FromStr;
use svgtypes::{Length, LengthUnit};

/// The size in pixels of the letter m, to which some lengths refer.
const EM: f64 = 16.0;

/// A length in the user's coordinates; a percentage is a part of `whole`.
pub(crate) fn length(text: &str, whole: f64) -> Option<f64> {
    Length::from_str(text).ok().map(|length| pixels(length, whole)).filter(|length| length.is_finite())
}

pub(crate) fn pixels(Length { number, unit }: Length, whole: f64) -> f64 {
    let unit = match unit {
        LengthUnit::None | LengthUnit::Px => 1.0,
        LengthUnit::Em => EM,
        LengthUnit::Ex => EM / 2.0,
        LengthUnit::In => 96.0,
        LengthUnit::Cm => 96.0 / 2.54,
        LengthUnit::Mm => 96.0 / 25.4,
        LengthUnit::Pt => 96.0 / 72.0,
        LengthUnit::Pc => 16.0,
        LengthUnit::Percent => whole / 100.0,
    };
    number * unit
}
