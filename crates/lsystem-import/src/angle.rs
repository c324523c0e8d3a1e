//! Angles as people write them: `25,7°`, `360/7`, `2π/5`, `pi/3`, `1.047 rad`, `1/6 turn`.

use core::f64::consts::PI;
use lsystem_base::decimal;

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
    let mut reader = Reader { text, at: 0, has_pi: false };
    let value = reader.quotient().filter(|value| value.is_finite()).ok_or(NoAngle::NoNumber)?;
    let end = reader.at;
    reader.blank();
    // A longer word is no unit.
    let letters = reader.rest().chars().take(16).take_while(|&c| c.is_alphabetic() || c == '°' || c == 'º');
    let unit: String = letters.collect();
    let taken = reader.at + unit.len();
    let unit = unit.to_lowercase();
    let named = |names: &[&str]| names.contains(&&*unit);
    if named(&["°", "º", "deg", "degree", "degrees", "grad", "grade", "degrés", "degré", "grados", "degs"]) {
        return Ok((value, false, taken));
    }
    if named(&["rad", "radians", "radian", "rads", "bogenmaß", "radians."]) {
        return Ok((tidy(value.to_degrees()), true, taken));
    }
    if named(&["turn", "turns", "revolution", "revolutions", "umdrehung", "tour"]) {
        return Ok((tidy(value * 360.0), false, taken));
    }
    if reader.has_pi {
        return Ok((tidy(value.to_degrees()), true, end));
    }
    by_value(value).map(|(degrees, radians)| (degrees, radians, end))
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

struct Reader<'a> {
    text: &'a str,
    at: usize,
    has_pi: bool,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn blank(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start_matches([' ', '\t', '\u{a0}']).len();
    }

    fn eat(&mut self, marks: &[&str]) -> bool {
        let before = self.at;
        self.blank();
        match marks.iter().find(|mark| self.rest().starts_with(**mark)) {
            Some(mark) => {
                self.at += mark.len();
                true
            }
            None => {
                self.at = before;
                false
            }
        }
    }

    fn quotient(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        loop {
            if self.eat(&["/", "÷", "⁄", "∕"]) {
                value /= self.factor()?;
            } else if self.eat(&["*", "·", "×"]) {
                value *= self.factor()?;
            } else {
                return Some(value);
            }
        }
    }

    /// A number, which may stand directly before π: `2π`.
    fn factor(&mut self) -> Option<f64> {
        let sign = if self.eat(&["-", "−"]) { -1.0 } else { 1.0 };
        let number = self.number();
        let pi = self.pi();
        match (number, pi) {
            (None, false) => None,
            (number, true) => Some(sign * number.unwrap_or(1.0) * PI),
            (Some(number), false) => Some(sign * number),
        }
    }

    fn pi(&mut self) -> bool {
        let before = self.at;
        if !self.eat(&["π", "\\pi", "Math.PI", "pi", "PI", "Pi"]) {
            return false;
        }
        if self.rest().starts_with(|c: char| c.is_alphanumeric()) {
            self.at = before;
            return false;
        }
        self.has_pi = true;
        true
    }

    /// A number; a comma between digits is a point.
    fn number(&mut self) -> Option<f64> {
        let before = self.at;
        self.blank();
        let bytes = self.rest().as_bytes();
        let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
        let mut end = 0;
        let mut points = 0;
        while digit(end) || matches!(bytes.get(end), Some(b'.' | b',')) && digit(end + 1) && points == 0 {
            points += usize::from(!digit(end));
            end += 1;
        }
        let number = decimal::read(&self.rest()[..end].replace(',', "."));
        self.at = if number.is_some() { self.at + end } else { before };
        number
    }
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
