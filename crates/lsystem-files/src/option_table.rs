//! The table of the choices for files: the page's dialog and the program's flags are made from it.
//!
//! A new choice needs a member of [`FileOptions`], a row here, and its name in the rows of the formats that read it.

use crate::FileOptions;
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_base::{MAX_PICTURE_SIDE, decimal};
use lsystem_plot::{Corner, SHEETS, Sheet};
use lsystem_sound::{MAX_NOTES, Pitch, Scale, Time};
use lsystem_syntax::message::grouped;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A choice for files: a row of [`FILE_OPTIONS`].
pub struct FileOption {
    /// The name in scripts; the program's flag is `--NAME`.
    pub name: &'static str,
    /// The label on the page.
    pub label: &'static str,
    /// A description, as a noun phrase or a command.
    pub help: &'static str,
    /// The unit of numbers, in the singular form of its symbol or in the plural; empty for none.
    pub unit: &'static str,
    /// The possible values and the default.
    pub kind: OptionKind,
    /// Writes a valid value.
    set: fn(&mut FileOptions, &OptionValue),
}

/// The possible values of a choice, and its default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OptionKind {
    /// Yes or no; no by default.
    Flag,
    /// A number.
    Number {
        /// The least value.
        low: f64,
        /// The largest value.
        high: f64,
        /// The distance of values that a control offers.
        step: f64,
        /// The default.
        default: f64,
    },
    /// One of these words, each with its label; the first one by default unless named otherwise.
    Word {
        /// Words and labels.
        words: &'static [(&'static str, &'static str)],
        /// The default.
        default: &'static str,
    },
    /// A width and a height in pixels, such as `1600x1200`; the format chooses by default.
    Size,
    /// A sheet of paper: one of [`SHEETS`], or a width and a height in millimetres such as `300x400`.
    Sheet {
        /// Names and labels.
        words: &'static [(&'static str, &'static str)],
        /// The default.
        default: &'static str,
        /// The least side of other sizes.
        low: f64,
        /// The largest side of other sizes.
        high: f64,
    },
}

/// A value as the page sends it or as it is typed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum OptionValue {
    /// Yes or no.
    Flag(bool),
    /// A number.
    Number(f64),
    /// A word or a size.
    Text(String),
}

/// All choices. Values are applied in this order.
pub static FILE_OPTIONS: [FileOption; 24] = [
    FileOption {
        name: "size",
        label: "Size",
        help: "Width and height of a picture",
        unit: "pixels",
        kind: OptionKind::Size,
        set: |options, value| options.size = value.size(),
    },
    FileOption {
        name: "dpi",
        label: "Resolution",
        help: "Pixels of an inch on paper, told in the file; 0 for none",
        unit: "pixels per inch",
        kind: OptionKind::Number { low: 0.0, high: 100_000.0, step: 1.0, default: 0.0 },
        set: |options, value| options.dpi = Some(value.number()).filter(|&dpi| dpi >= 1.0),
    },
    FileOption {
        name: "transparent",
        label: "Transparent background",
        help: "Leave the background out",
        unit: "",
        kind: OptionKind::Flag,
        set: |options, value| options.transparent = value.flag(),
    },
    FileOption {
        name: "sheet",
        label: "Sheet",
        help: "Size of the paper",
        unit: "",
        kind: OptionKind::Sheet {
            words: &[
                ("a5", "A5"),
                ("a4", "A4"),
                ("a3", "A3"),
                ("a2", "A2"),
                ("a1", "A1"),
                ("letter", "Letter"),
                ("legal", "Legal"),
                ("tabloid", "Tabloid"),
            ],
            default: "a4",
            low: 10.0,
            high: 10_000.0,
        },
        set: |options, value| {
            let named = SHEETS.into_iter().find(|(name, ..)| *name == value.text());
            if let Some([width, height]) = named.map(|(_, width, height)| [width, height]).or_else(|| value.sides()) {
                options.sheet = Sheet { width, height, ..options.sheet };
            }
        },
    },
    FileOption {
        name: "portrait",
        label: "Portrait",
        help: "Keep a plot's sheet upright, even if the drawing is larger on its side",
        unit: "",
        kind: OptionKind::Flag,
        set: |options, value| {
            if value.flag() {
                options.plot.turns = false;
                if options.sheet.width > options.sheet.height {
                    options.sheet = options.sheet.turned();
                }
            }
        },
    },
    FileOption {
        name: "landscape",
        label: "Landscape",
        help: "Turn the sheet, so that it is wider than tall",
        unit: "",
        kind: OptionKind::Flag,
        set: |options, value| {
            if value.flag() {
                options.plot.turns = false;
                if options.sheet.width < options.sheet.height {
                    options.sheet = options.sheet.turned();
                }
            }
        },
    },
    FileOption {
        name: "margin",
        label: "Margin",
        help: "Margin on every side of the sheet",
        unit: "mm",
        kind: OptionKind::Number { low: 0.0, high: 100.0, step: 1.0, default: 10.0 },
        set: |options, value| options.sheet.margin = value.number(),
    },
    FileOption {
        name: "pen",
        label: "Pen width",
        help: "Width of the pen's line; smaller parts of the drawing become one stroke",
        unit: "mm",
        kind: OptionKind::Number { low: 0.05, high: 20.0, step: 0.05, default: 0.3 },
        set: |options, value| options.plot.pen = value.number(),
    },
    FileOption {
        name: "hatch",
        label: "Hatch",
        help: "Fill polygons and broad strokes with lines",
        unit: "",
        kind: OptionKind::Flag,
        set: |options, value| options.plot.hatch = value.flag(),
    },
    FileOption {
        name: "hide",
        label: "Hide what is behind",
        help: "Leave out lines behind polygons and broad strokes, and draw broad strokes as outlines",
        unit: "",
        kind: OptionKind::Flag,
        set: |options, value| options.plot.hide = value.flag(),
    },
    FileOption {
        name: "start",
        label: "Start corner",
        help: "Corner where each pen starts and ends",
        unit: "",
        kind: OptionKind::Word {
            words: &[
                ("top-left", "Top left"),
                ("top-right", "Top right"),
                ("bottom-left", "Bottom left"),
                ("bottom-right", "Bottom right"),
            ],
            default: "top-left",
        },
        set: |options, value| {
            if let Some(corner) = Corner::ALL.into_iter().find(|corner| corner.name() == value.text()) {
                options.plot.start = corner;
            }
        },
    },
    FileOption {
        name: "min-length",
        label: "Shortest line",
        help: "Length under which lines are left out",
        unit: "mm",
        kind: OptionKind::Number { low: 0.0, high: 1000.0, step: 0.1, default: 0.0 },
        set: |options, value| options.plot.least = value.number(),
    },
    FileOption {
        name: "speed",
        label: "Drawing speed",
        help: "Speed of the lowered pen, for the estimate of time",
        unit: "mm/s",
        kind: OptionKind::Number { low: 0.1, high: 10_000.0, step: 1.0, default: 50.0 },
        set: |options, value| options.plot.speed = value.number(),
    },
    FileOption {
        name: "travel-speed",
        label: "Travel speed",
        help: "Speed of the raised pen, for the estimate of time",
        unit: "mm/s",
        kind: OptionKind::Number { low: 0.1, high: 10_000.0, step: 1.0, default: 150.0 },
        set: |options, value| options.plot.travel_speed = value.number(),
    },
    FileOption {
        name: "lift",
        label: "Lift time",
        help: "Seconds to raise and lower the pen, for the estimate of time",
        unit: "s",
        kind: OptionKind::Number { low: 0.0, high: 60.0, step: 0.1, default: 0.2 },
        set: |options, value| options.plot.lift = value.number(),
    },
    FileOption {
        name: "whole-sheet",
        label: "Whole sheet",
        help: "Fill the sheet, instead of ending the page at the edge of the drawing",
        unit: "",
        kind: OptionKind::Flag,
        set: |options, value| options.is_cropped = !value.flag(),
    },
    FileOption {
        name: "finest",
        label: "Finest part",
        help: "Size under which parts become one tube, in percent of the longest side (in STL, 1 % is 1 mm); 0 keeps all",
        unit: "%",
        kind: OptionKind::Number { low: 0.0, high: 20.0, step: 0.1, default: 0.0 },
        set: |options, value| options.finest = value.number() / 100.0,
    },
    FileOption {
        name: "pitch",
        label: "Pitch",
        help: "Pitch of a note, by the height of the line's end or by the letter that draws the line",
        unit: "",
        kind: OptionKind::Word { words: &[("height", "By height"), ("letter", "By letter")], default: "height" },
        set: |options, value| {
            options.sound.pitch = if value.text() == "letter" { Pitch::Letter } else { Pitch::Height }
        },
    },
    FileOption {
        name: "time",
        label: "Time",
        help: "Time of a note: line after line in drawing order, or by length with branches together",
        unit: "",
        kind: OptionKind::Word {
            words: &[("step", "Line after line"), ("length", "By length, branches together")],
            default: "step",
        },
        set: |options, value| options.sound.time = if value.text() == "length" { Time::Length } else { Time::Step },
    },
    FileOption {
        name: "scale",
        label: "Scale",
        help: "Tones of an octave, on C",
        unit: "",
        kind: OptionKind::Word {
            words: &[("pentatonic", "Pentatonic"), ("major", "Major"), ("minor", "Minor"), ("chromatic", "Chromatic")],
            default: "pentatonic",
        },
        set: |options, value| {
            options.sound.scale = match value.text() {
                "major" => Scale::Major,
                "minor" => Scale::Minor,
                "chromatic" => Scale::Chromatic,
                _ => Scale::Pentatonic,
            }
        },
    },
    FileOption {
        name: "octaves",
        label: "Range",
        help: "Range of the pitches, about middle C",
        unit: "octaves",
        kind: OptionKind::Number { low: 1.0, high: 6.0, step: 1.0, default: 3.0 },
        set: |options, value| options.sound.octaves = value.number() as u8,
    },
    FileOption {
        name: "tempo",
        label: "Tempo",
        help: "Quarter notes in a minute; a line lasts a sixteenth",
        unit: "per minute",
        kind: OptionKind::Number { low: 20.0, high: 400.0, step: 1.0, default: 120.0 },
        set: |options, value| options.sound.tempo = value.number(),
    },
    FileOption {
        name: "notes",
        label: "Most notes",
        help: "Number of notes; of longer walks, lines at even distances are heard, or by length an earlier generation",
        unit: "",
        kind: OptionKind::Number { low: 1.0, high: MAX_NOTES as f64, step: 1.0, default: 2_000.0 },
        set: |options, value| options.sound.notes = value.number() as u32,
    },
    FileOption {
        name: "bare",
        label: "Without the rules inside",
        help: "Leave the system out of the file; the file cannot be opened again as a system",
        unit: "",
        kind: OptionKind::Flag,
        set: |options, value| options.bare = value.flag(),
    },
];

impl FileOption {
    /// The choice with this name, if any.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        FILE_OPTIONS.iter().find(|option| option.name == name)
    }

    /// The expected values, in words.
    #[must_use]
    pub fn expected_words(&self) -> String {
        match self.kind {
            OptionKind::Flag => say!("true or false"),
            OptionKind::Number { low, high, .. } => say!("a number from {} to {}", number(low), number(high)),
            OptionKind::Word { words, .. } => {
                say!("one of {}", words.iter().map(|(word, _)| format!("`{word}`")).collect::<Vec<_>>().join(", "))
            }
            OptionKind::Sheet { words, low, high, .. } => say!(
                "{}, or a width and a height such as 300x400, with {} to {} mm each way",
                words.iter().map(|(word, _)| format!("`{word}`")).collect::<Vec<_>>().join(", "),
                number(low),
                grouped(&number(high))
            ),
            OptionKind::Size => say!(
                "a width and a height such as 1600x1200, with 1 to {} pixels each way",
                grouped(&MAX_PICTURE_SIDE.to_string())
            ),
        }
    }

    /// A value from text, as on a command line.
    ///
    /// # Errors
    /// The expected values, in words.
    pub fn parse(&self, text: &str) -> Result<OptionValue, String> {
        let value = match self.kind {
            OptionKind::Flag => text.parse().ok().map(OptionValue::Flag),
            OptionKind::Number { .. } => decimal::read(text).map(OptionValue::Number),
            OptionKind::Word { .. } | OptionKind::Size | OptionKind::Sheet { .. } => {
                Some(OptionValue::Text(text.to_owned()))
            }
        };
        let valid = value.filter(|value| self.admits(value));
        valid.ok_or_else(|| say!("expected {}", self.expected_words()))
    }

    /// Whether a value is possible.
    #[must_use]
    pub fn admits(&self, value: &OptionValue) -> bool {
        match (self.kind, value) {
            (OptionKind::Flag, OptionValue::Flag(_)) => true,
            (OptionKind::Number { low, high, .. }, OptionValue::Number(number)) => (low..=high).contains(number),
            (OptionKind::Word { words, .. }, OptionValue::Text(text)) => words.iter().any(|(word, _)| word == text),
            (OptionKind::Size, OptionValue::Text(_)) => value.size().is_some(),
            (OptionKind::Sheet { words, low, high, .. }, OptionValue::Text(text)) => {
                let within = |sides: [f64; 2]| sides.iter().all(|side| (low..=high).contains(side));
                words.iter().any(|(word, _)| word == text) || value.sides().is_some_and(within)
            }
            _ => false,
        }
    }
}

impl OptionValue {
    fn flag(&self) -> bool {
        *self == Self::Flag(true)
    }

    fn number(&self) -> f64 {
        if let Self::Number(number) = self { *number } else { 0.0 }
    }

    fn text(&self) -> &str {
        if let Self::Text(text) = self { text } else { "" }
    }

    /// A width and a height.
    fn sides(&self) -> Option<[f64; 2]> {
        let (width, height) = self.text().split_once('x')?;
        Some([decimal::read(width)?, decimal::read(height)?])
    }

    /// The width and the height, if this is a size within the limits.
    fn size(&self) -> Option<[u32; 2]> {
        let (width, height) = self.text().split_once('x')?;
        let [width, height] = [width.parse().ok()?, height.parse().ok()?];
        let within = |side| (1..=MAX_PICTURE_SIDE).contains(&side);
        (within(width) && within(height)).then_some([width, height])
    }
}

impl FileOptions {
    /// The options with these values by name, applied in the order of [`FILE_OPTIONS`].
    ///
    /// # Errors
    /// The first name that does not exist, or the first value that is not possible, in words.
    pub fn from_values(values: &BTreeMap<String, OptionValue>) -> Result<Self, String> {
        if let Some(name) = values.keys().find(|name| FileOption::named(name).is_none()) {
            return Err(say!("there is no option `{}`", name));
        }
        let mut options = Self::default();
        for option in &FILE_OPTIONS {
            let Some(value) = values.get(option.name) else { continue };
            if !option.admits(value) {
                return Err(say!("{}: expected {}", option.name, option.expected_words()));
            }
            (option.set)(&mut options, value);
        }
        Ok(options)
    }
}

impl core::fmt::Debug for FileOption {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.write_str(self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FORMATS;

    fn options(values: &[(&str, OptionValue)]) -> Result<FileOptions, String> {
        FileOptions::from_values(&values.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect())
    }

    #[test]
    fn formats_read_options_of_the_table_in_its_order() {
        for format in &FORMATS {
            let places: Vec<_> = (format.options.iter())
                .map(|name| FILE_OPTIONS.iter().position(|option| option.name == *name).unwrap())
                .collect();
            assert!(places.is_sorted(), "{format:?}: {:?}", format.options);
        }
    }

    #[test]
    fn defaults_are_the_same_in_the_table_and_in_the_options() {
        for option in &FILE_OPTIONS {
            let value = match option.kind {
                OptionKind::Flag => OptionValue::Flag(false),
                OptionKind::Number { default, .. } => OptionValue::Number(default),
                OptionKind::Word { default, .. } | OptionKind::Sheet { default, .. } => {
                    OptionValue::Text(default.to_owned())
                }
                OptionKind::Size => continue,
            };
            assert_eq!(options(&[(option.name, value)]), Ok(FileOptions::default()), "{option:?}");
        }
    }

    #[test]
    fn every_sheet_has_a_label() {
        let Some(OptionKind::Sheet { words, .. }) = FileOption::named("sheet").map(|option| option.kind) else {
            panic!("the kind of sheets");
        };
        assert!(words.iter().map(|(name, _)| *name).eq(SHEETS.iter().map(|(name, ..)| *name)));
    }

    #[test]
    fn sheets_are_turned_whatever_the_order_of_the_values() {
        let text = |text: &str| OptionValue::Text(text.to_owned());
        let turned = options(&[
            ("landscape", OptionValue::Flag(true)),
            ("margin", OptionValue::Number(5.0)),
            ("sheet", text("a3")),
        ]);
        assert_eq!(turned.unwrap().sheet, Sheet { width: 420.0, height: 297.0, margin: 5.0 });
        let own = options(&[("sheet", text("300x420.5")), ("landscape", OptionValue::Flag(true))]).unwrap().sheet;
        assert_eq!(own, Sheet { width: 420.5, height: 300.0, margin: 10.0 });
        assert_eq!(options(&[("size", text("30x20"))]).unwrap().size, Some([30, 20]));
    }

    #[test]
    fn impossible_values_are_told() {
        for (name, value, words) in [
            ("margin", "101", "expected a number from 0 to 100"),
            ("margin", "NaN", "expected a number from 0 to 100"),
            ("sheet", "a99", "expected `a5`, `a4`"),
            ("sheet", "9x100", "10 to 10,000 mm each way"),
            ("sheet", "NaNx100", "such as 300x400"),
            ("size", "0x10", "expected a width and a height such as 1600x1200"),
            ("size", "40000x1", "1 to 32,768 pixels each way"),
            ("bare", "yes", "expected true or false"),
        ] {
            let told = FileOption::named(name).unwrap().parse(value).unwrap_err();
            assert!(told.contains(words), "{name}: {told}");
        }
        assert!(options(&[("flavour", OptionValue::Flag(true))]).unwrap_err().contains("flavour"));
        assert!(options(&[("margin", OptionValue::Flag(true))]).unwrap_err().starts_with("margin: expected"));
    }
}
