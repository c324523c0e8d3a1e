//! How a drawing looks: colours, widths, background.

use crate::Dialect;
use crate::notes::excerpt;
use serde::{Deserialize, Serialize};

/// An sRGB colour without transparency, 8 bits a channel. Text form: `#rrggbb` (also read: `#rgb` and the sixteen
/// basic CSS colour names).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Colour {
    /// Red, green, blue.
    pub rgb: [u8; 3],
}

/// What a stroke's colour follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColourBy {
    /// The colour symbols: the palette's entry that the turtle's colour index selects.
    #[default]
    Symbol,
    /// One colour for all: the first of the palette.
    Single,
    /// The branch level: the palette's entry at the level.
    Level,
}

impl ColourBy {
    /// All of them, in the order to offer them.
    pub const ALL: [Self; 3] = [Self::Symbol, Self::Single, Self::Level];

    /// Their names in files, in the same order.
    pub(crate) const NAMES: [&str; 3] = ["symbol", "single", "level"];

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// The look of a drawing. A stroke is `max(width, min_width)` wide, after the width symbols acted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct Style {
    /// The stroke colour (index 0) and those that follow it. Never empty; indices wrap around at look-up.
    pub palette: Vec<Colour>,
    /// What the colour follows.
    pub colour_by: ColourBy,
    /// Behind the drawing.
    pub background: Colour,
    /// The turtle's stroke width at the start, in multiples of the step length.
    pub width: f64,
    /// No stroke is drawn thinner than this, in CSS pixels of the picture.
    pub min_width: f64,
}

impl Default for Style {
    fn default() -> Self {
        let colour = |r, g, b| Colour { rgb: [r, g, b] };
        Self {
            palette: vec![
                colour(0x1f, 0x5c, 0x3a),
                colour(0x5f, 0x8f, 0x2f),
                colour(0xb5, 0x8b, 0x1e),
                colour(0xb4, 0x53, 0x2a),
                colour(0x8c, 0x2f, 0x4b),
            ],
            colour_by: ColourBy::Symbol,
            background: colour(0xfb, 0xfa, 0xf5),
            width: 0.0,
            min_width: 1.0,
        }
    }
}

impl Style {
    /// The style of the course's files: green strokes 0.04 wide on white.
    #[must_use]
    pub fn course() -> Self {
        Self {
            palette: vec![Colour { rgb: [0, 0x80, 0] }],
            background: Colour { rgb: [0xff; 3] },
            width: 0.04,
            min_width: 0.0,
            ..Self::default()
        }
    }

    /// The colour of a stroke: of the turtle's colour index, or of its branch level.
    #[must_use]
    pub fn colour_of(&self, index: i32, level: u32) -> Colour {
        let entry = match self.colour_by {
            ColourBy::Single => 0,
            ColourBy::Symbol => i64::from(index),
            ColourBy::Level => i64::from(level),
        };
        let wrapped = entry.rem_euclid(self.palette.len().max(1) as i64);
        self.palette.get(wrapped as usize).copied().unwrap_or(Colour { rgb: [0; 3] })
    }

    /// The style that a file in this dialect has where it names none: in [`Dialect::Lowercase`] the pen starts blue,
    /// and its turns choose red and green.
    #[must_use]
    pub fn for_dialect(dialect: Dialect) -> Self {
        let mut style = Self::default();
        if dialect == Dialect::Lowercase {
            style.palette = [[0, 0, 0xff], [0xff, 0, 0], [0, 0x80, 0]].map(|rgb| Colour { rgb }).to_vec();
        }
        style
    }
}

impl From<Colour> for String {
    fn from(colour: Colour) -> Self {
        let [r, g, b] = colour.rgb;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

impl TryFrom<String> for Colour {
    type Error = String;
    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl core::str::FromStr for Colour {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let name = text.trim();
        if let Some((_, rgb)) = NAMED.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) {
            return Ok(Self { rgb: *rgb });
        }
        let digits = name.strip_prefix('#').filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()));
        let value = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        match (digits.map(str::len), value) {
            (Some(6), Some(value)) => Ok(Self { rgb: [(value >> 16) as u8, (value >> 8) as u8, value as u8] }),
            (Some(3), Some(value)) => Ok(Self { rgb: [8, 4, 0].map(|shift| ((value >> shift & 15) * 17) as u8) }),
            _ => Err(format!("`{}` is not a colour: write it as #rrggbb", excerpt(text))),
        }
    }
}

/// The basic colour names of CSS 1.
const NAMED: [(&str, [u8; 3]); 16] = [
    ("black", [0, 0, 0]),
    ("silver", [0xc0, 0xc0, 0xc0]),
    ("gray", [0x80, 0x80, 0x80]),
    ("white", [0xff, 0xff, 0xff]),
    ("maroon", [0x80, 0, 0]),
    ("red", [0xff, 0, 0]),
    ("purple", [0x80, 0, 0x80]),
    ("fuchsia", [0xff, 0, 0xff]),
    ("green", [0, 0x80, 0]),
    ("lime", [0, 0xff, 0]),
    ("olive", [0x80, 0x80, 0]),
    ("yellow", [0xff, 0xff, 0]),
    ("navy", [0, 0, 0x80]),
    ("blue", [0, 0, 0xff]),
    ("teal", [0, 0x80, 0x80]),
    ("aqua", [0, 0xff, 0xff]),
];
