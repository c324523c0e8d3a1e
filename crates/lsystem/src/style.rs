//! How a drawing looks: colours, widths, background.

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
        let wrong = || format!("`{text}` is not a colour: write it as #rrggbb");
        let digits = text.trim().strip_prefix('#').ok_or_else(wrong)?;
        let value = u32::from_str_radix(digits, 16).map_err(|_| wrong())?;
        match digits.len() {
            6 => Ok(Self { rgb: [(value >> 16) as u8, (value >> 8) as u8, value as u8] }),
            3 => Ok(Self { rgb: [8, 4, 0].map(|shift| ((value >> shift & 15) * 17) as u8) }),
            _ => Err(wrong()),
        }
    }
}
