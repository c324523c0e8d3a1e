//! The expected types and ranges of values, and their words.

use crate::Colour;
use crate::value::Value;
use lsystem_base::number::number;
use lsystem_base::words::grouped;
use lsystem_base::{MAX_PALETTE, say};

/// The expected type and range of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// No value at all.
    Nothing,
    /// A finite number.
    Number,
    /// A finite number from the first to the second.
    Between(f64, f64),
    /// A finite number above 0, at most this.
    PositiveUpTo(f64),
    /// A whole number from the first to the second.
    Whole(i64, i64),
    /// `true` or `false`.
    Boolean,
    /// A string.
    String,
    /// A string of at most this many UTF-16 units.
    Text(usize),
    /// One of these words.
    Word(&'static [&'static str]),
    /// An object.
    Object,
    /// A list of this many values, each as expected.
    Each(usize, &'static Expected),
    /// An object with these members.
    Record(&'static [(&'static str, Expected)]),
    /// An object, or a list of lines.
    Rules,
    /// An object, or a list of lines.
    Overrides,
    /// A string, or a list of outcomes.
    Successor,
    /// An outcome `{"p": 0.5, "e": "F"}`.
    Outcome,
    /// A colour.
    Colour,
    /// From 1 to [`MAX_PALETTE`] colours.
    Palette,
}

impl Expected {
    /// Whether a number is within the range; `false` if no number is expected.
    #[must_use]
    pub fn admits(self, value: f64) -> bool {
        match self {
            Self::Number => value.is_finite(),
            Self::Between(least, most) => (least..=most).contains(&value),
            Self::PositiveUpTo(most) => value > 0.0 && value <= most,
            Self::Whole(least, most) => value == libm::trunc(value) && (least as f64..=most as f64).contains(&value),
            _ => false,
        }
    }

    /// Whether a field's value has the expected type. The range is not checked.
    #[must_use]
    pub fn takes(self, value: &Value) -> bool {
        match self {
            Self::Number | Self::Between(..) | Self::PositiveUpTo(_) | Self::Whole(..) => {
                matches!(value, Value::Number(_))
            }
            Self::Boolean => matches!(value, Value::Flag(_)),
            Self::String | Self::Text(_) | Self::Word(_) | Self::Colour => matches!(value, Value::Text(_)),
            Self::Each(..) | Self::Palette => matches!(value, Value::List(_)),
            _ => false,
        }
    }

    /// Whether a field's value has the expected type and is within the range.
    #[must_use]
    pub fn admits_value(self, value: &Value) -> bool {
        match (self, value) {
            (_, Value::Number(number)) => self.admits(*number),
            (Self::Boolean, Value::Flag(_)) | (Self::String, Value::Text(_)) => true,
            // Each UTF-16 unit takes at least one byte of UTF-8, so a short text need not be counted.
            (Self::Text(most), Value::Text(text)) => text.len() <= most || text.encode_utf16().count() <= most,
            (Self::Word(words), Value::Text(text)) => words.contains(&text.as_str()),
            (Self::Colour, Value::Text(text)) => text.parse::<Colour>().is_ok(),
            (Self::Each(count, each), Value::List(list)) => {
                list.len() == count && list.iter().all(|value| each.admits_value(value))
            }
            (Self::Palette, Value::List(list)) => {
                (1..=MAX_PALETTE).contains(&list.len()) && list.iter().all(|value| Self::Colour.admits_value(value))
            }
            _ => false,
        }
    }
}

impl Expected {
    /// The expected type and range, as a noun phrase.
    #[must_use]
    pub fn words(self) -> String {
        match self {
            Expected::Nothing => say!("nothing"),
            Expected::Number => say!("a number"),
            Expected::Between(least, most) => say!("a number from {} to {}", bound(least), bound(most)),
            Expected::PositiveUpTo(most) => say!("a number above 0, at most {}", bound(most)),
            Expected::Whole(least, most) => {
                say!("a whole number from {} to {}", bound(least as f64), bound(most as f64))
            }
            Expected::Boolean => say!("true or false"),
            Expected::String => say!("a string"),
            Expected::Text(most) => say!("a text of at most {} characters", bound(most as f64)),
            Expected::Word(words) => {
                let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
                say!("one of {}", words.join(", "))
            }
            Expected::Object => say!("an object"),
            Expected::Each(count, each) => say!("a list of {} values, each {}", count, each.words()),
            Expected::Record(members) => {
                let members: Vec<&str> = members.iter().map(|(name, _)| *name).collect();
                say!("an object of {}", members.join(", "))
            }
            Expected::Rules | Expected::Overrides => say!("an object or a list of lines"),
            Expected::Successor => say!("a string or a list of outcomes"),
            Expected::Outcome => say!("an outcome {{\"p\": 0.5, \"e\": \"F+F\"}}"),
            Expected::Colour => say!("a colour such as \"#1f5c3a\""),
            Expected::Palette => say!("a list of 1 to {} colours such as \"#1f5c3a\"", MAX_PALETTE),
        }
    }
}

/// A bound of a range; whole numbers with their digits in groups of three.
fn bound(value: f64) -> String {
    let digits = number(value.abs());
    let digits = if digits.bytes().all(|byte| byte.is_ascii_digit()) { grouped(&digits) } else { digits };
    if value < 0.0 { format!("-{digits}") } else { digits }
}
