//! Angles as people write them: `25,7°`, `360/7`, `2π/5`, `pi/3`, `1.047 rad`, `1/6 turn`.

use crate::mapped::Mapped;
use crate::tokens::tree;
use crate::value::{Unit, leading};
use core::f64::consts::PI;

/// An angle is read in so many bytes.
const LONGEST: usize = 60;

/// Why a text gives no angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoAngle {
    /// The text is no number.
    NoNumber,
    /// The number may be of radians or of degrees.
    Unclear,
}

/// The angle in degrees at the start of a text, whether it is said in radians, and the length of what is read.
pub(super) fn angle(text: &str) -> Result<(f64, bool, usize), NoAngle> {
    // With the signs of programs; a comma between digits is a point.
    let mut near = Mapped::default();
    let mut at = 0;
    while let Some(ch) = text[at..].chars().next().filter(|_| at < LONGEST) {
        let rest = &text[at..];
        let is_digit = |c: char| c.is_ascii_digit();
        let (sign, length) = match ch {
            '÷' | '⁄' | '∕' => ("/", ch.len_utf8()),
            '·' | '×' => ("*", ch.len_utf8()),
            '−' => ("-", ch.len_utf8()),
            ',' if near.text.ends_with(is_digit) && rest[1..].starts_with(is_digit) => (".", 1),
            '\\' if rest.starts_with("\\pi") => ("π", 3),
            _ => (&rest[..ch.len_utf8()], ch.len_utf8()),
        };
        near.push(at, sign);
        at += length;
    }
    let near = near.end(at);
    let (value, unit, end) = leading(&tree(&near.text).nodes).ok_or(NoAngle::NoNumber)?;
    let (degrees, radians) = match unit {
        Unit::Degrees => (value, false),
        Unit::Radians => (tidy(value.to_degrees()), true),
        Unit::Unknown => by_value(value)?,
    };
    Ok((degrees, radians, near.place(end)))
}

/// The degrees of a number without a unit, and whether it is taken for radians: radians are small fractions of π.
pub(super) fn by_value(value: f64) -> Result<(f64, bool), NoAngle> {
    if value.abs() > 2.0 * PI + 0.001 || value.fract() == 0.0 {
        return Ok((value, false));
    }
    let near = (1..=60).any(|part| {
        let whole = value * f64::from(part) / PI;
        (whole - whole.round()).abs() < 0.002
            && whole.round().abs() <= f64::from(2 * part)
            && whole.round() != 0.0
            && part < 40
    });
    if near || value.abs() < 1.0 { Ok((tidy(value.to_degrees()), true)) } else { Err(NoAngle::Unclear) }
}

/// Removes the error of a conversion from radians.
pub(super) fn tidy(degrees: f64) -> f64 {
    let near = (degrees * 1e9).round() / 1e9;
    if (near - degrees).abs() < 1e-9 { near } else { degrees }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_as_people_write_them() {
        for (text, expected) in [
            ("60", 60.0),
            ("25,7°", 25.7),
            ("360/7", 360.0 / 7.0),
            ("2π/5", 72.0),
            ("π/3", 60.0),
            ("pi / 3 and more", 60.0),
            ("1.047 rad", 59.988681),
            ("1.0472", 60.000140),
            ("1/6 turn", 60.0),
            ("22.5 degrees", 22.5),
            ("2*pi/5", 72.0),
            ("-90", -90.0),
            ("20.", 20.0),
            ("0.5", 28.6478898),
        ] {
            let (degrees, ..) = angle(text).unwrap();
            assert!((degrees - expected).abs() < 1e-4, "{text}: {degrees}");
        }
        assert_eq!(angle("sharp"), Err(NoAngle::NoNumber));
        assert_eq!(angle("pizza"), Err(NoAngle::NoNumber));
        assert_eq!(angle("2.3"), Err(NoAngle::Unclear));
        assert_eq!(angle("45, n = 4").map(|found| found.2), Ok(2));
    }
}
