//! The table of the choices for files: the page's dialog and the program's flags are made from it.
//!
//! A new choice needs a member of [`FileOptions`], a row here, and its name in the rows of the formats that read it.

use crate::FileOptions;
use crate::print::{FOOT, THINNEST};
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_base::words::grouped;
use lsystem_base::{MAX_PICTURE_SIDE, decimal};
use lsystem_plot::{Corner, SHEETS, Sheet};
use lsystem_sound::{MAX_NOTES, Pitch, Scale, Time};
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
    set: Setter,
}

/// Words and their labels.
type Words = &'static [(&'static str, &'static str)];

/// Writes a value of a kind.
#[derive(Clone, Copy)]
enum Setter {
    Flag(fn(&mut FileOptions, bool)),
    Number(fn(&mut FileOptions, f64)),
    Text(fn(&mut FileOptions, &OptionValue)),
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
        words: Words,
        /// The default.
        default: &'static str,
    },
    /// A width and a height in pixels, such as `1600x1200`; the format chooses by default.
    Size,
    /// A sheet of paper: one of [`SHEETS`], or a width and a height in millimetres such as `300x400`.
    Sheet {
        /// Names and labels.
        words: Words,
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
pub static FILE_OPTIONS: [FileOption; 27] = [
    choice("size", "Size", "Width and height of a picture")
        .unit("pixels")
        .text(OptionKind::Size, |options, value| options.size = value.size()),
    choice("dpi", "Resolution", "Pixels of an inch on paper, told in the file; 0 for none")
        .unit("pixels per inch")
        .number([0.0, 100_000.0, 1.0, 0.0], |options, value| options.dpi = Some(value).filter(|&dpi| dpi >= 1.0)),
    choice("transparent", "Transparent background", "Leave the background out")
        .flag(|options, value| options.transparent = value),
    choice("sheet", "Sheet", "Size of the paper").text(
        OptionKind::Sheet {
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
        |options, value| {
            let named = SHEETS.into_iter().find(|(name, ..)| *name == value.text());
            if let Some([width, height]) = named.map(|(_, width, height)| [width, height]).or_else(|| value.sides()) {
                options.sheet = Sheet { width, height, ..options.sheet };
            }
        },
    ),
    choice("portrait", "Portrait", "Keep a plot's sheet upright, even if the drawing is larger on its side")
        .flag(|options, value| turn(options, value, |sheet| sheet.width > sheet.height)),
    choice("landscape", "Landscape", "Turn the sheet, so that it is wider than tall")
        .flag(|options, value| turn(options, value, |sheet| sheet.width < sheet.height)),
    choice("margin", "Margin", "Margin on every side of the sheet")
        .unit("mm")
        .number([0.0, 100.0, 1.0, 10.0], |options, value| options.sheet.margin = value),
    choice("pen", "Pen width", "Width of the pen's line; smaller parts of the drawing become one stroke")
        .unit("mm")
        .number([0.05, 20.0, 0.05, 0.3], |options, value| options.plot.pen = value),
    choice("hatch", "Hatch", "Fill polygons and broad strokes with lines")
        .flag(|options, value| options.plot.hatch = value),
    choice(
        "hide",
        "Hide what is behind",
        "Leave out lines behind polygons and broad strokes, and draw broad strokes as outlines",
    )
    .flag(|options, value| options.plot.hide = value),
    choice("start", "Start corner", "Corner where each pen starts and ends").words(
        &[
            ("top-left", "Top left"),
            ("top-right", "Top right"),
            ("bottom-left", "Bottom left"),
            ("bottom-right", "Bottom right"),
        ],
        |options, value| {
            if let Some(corner) = Corner::ALL.into_iter().find(|corner| corner.name() == value.text()) {
                options.plot.start = corner;
            }
        },
    ),
    choice("min-length", "Shortest line", "Length under which lines are left out")
        .unit("mm")
        .number([0.0, 1000.0, 0.1, 0.0], |options, value| options.plot.least = value),
    choice("speed", "Drawing speed", "Speed of the lowered pen, for the estimate of time")
        .unit("mm/s")
        .number([0.1, 10_000.0, 1.0, 50.0], |options, value| options.plot.speed = value),
    choice("travel-speed", "Travel speed", "Speed of the raised pen, for the estimate of time")
        .unit("mm/s")
        .number([0.1, 10_000.0, 1.0, 150.0], |options, value| options.plot.travel_speed = value),
    choice("lift", "Lift time", "Seconds to raise and lower the pen, for the estimate of time")
        .unit("s")
        .number([0.0, 60.0, 0.1, 0.2], |options, value| options.plot.lift = value),
    choice("whole-sheet", "Whole sheet", "Fill the sheet, instead of ending the page at the edge of the drawing")
        .flag(|options, value| options.is_cropped = !value),
    choice(
        "finest",
        "Finest part",
        "Size under which parts become one tube, in percent of the longest side (in STL, 1 % is 1 mm); 0 keeps all",
    )
    .unit("%")
    .number([0.0, 20.0, 0.1, 0.0], |options, value| options.finest = value / 100.0),
    choice(
        "height",
        "Height",
        "Height of a mesh: mm in STL and OpenSCAD, metres in glTF, units in OBJ; 0 for a longest side of 100 mm, and for \
         steps of 1 m",
    )
    .number([0.0, 10_000.0, 0.1, 0.0], |options, value| options.height = value),
    choice("thinnest", "Thinnest wall", "Least thickness of tubes and leaves of a print")
        .unit("mm")
        .number([0.0, 20.0, 0.1, THINNEST], |options, value| options.thinnest = value),
    choice("foot", "Foot", "Distance by which a foot under a print reaches beyond what stands on it; 0 for none")
        .unit("mm")
        .number([0.0, 100.0, 1.0, FOOT], |options, value| options.foot = value),
    choice("pitch", "Pitch", "Pitch of a note, by the height of the line's end or by the letter that draws the line")
        .words(&[("height", "By height"), ("letter", "By letter")], |options, value| {
            options.sound.pitch = if value.text() == "letter" { Pitch::Letter } else { Pitch::Height }
        }),
    choice("time", "Time", "Time of a note: line after line in drawing order, or by length with branches together")
        .words(&[("step", "Line after line"), ("length", "By length, branches together")], |options, value| {
            options.sound.time = if value.text() == "length" { Time::Length } else { Time::Step }
        }),
    choice("scale", "Scale", "Tones of an octave, on C").words(
        &[("pentatonic", "Pentatonic"), ("major", "Major"), ("minor", "Minor"), ("chromatic", "Chromatic")],
        |options, value| {
            options.sound.scale = match value.text() {
                "major" => Scale::Major,
                "minor" => Scale::Minor,
                "chromatic" => Scale::Chromatic,
                _ => Scale::Pentatonic,
            }
        },
    ),
    choice("octaves", "Range", "Range of the pitches, about middle C")
        .unit("octaves")
        .number([1.0, 6.0, 1.0, 3.0], |options, value| options.sound.octaves = value as u8),
    choice("tempo", "Tempo", "Quarter notes in a minute; a line lasts a sixteenth")
        .unit("per minute")
        .number([20.0, 400.0, 1.0, 120.0], |options, value| options.sound.tempo = value),
    choice(
        "notes",
        "Most notes",
        "Number of notes; of longer walks, lines at even distances are heard, or by length an earlier generation",
    )
    .number([1.0, MAX_NOTES as f64, 1.0, 2_000.0], |options, value| options.sound.notes = value as u32),
    choice(
        "bare",
        "Without the rules inside",
        "Leave the system out of the file; the file cannot be opened again as a system",
    )
    .flag(|options, value| options.bare = value),
];

/// Keeps the sheet as it is, or turns it if it lies the other way.
fn turn(options: &mut FileOptions, is_wanted: bool, is_other: fn(&Sheet) -> bool) {
    if is_wanted {
        options.plot.turns = false;
        if is_other(&options.sheet) {
            options.sheet = options.sheet.turned();
        }
    }
}

const fn choice(name: &'static str, label: &'static str, help: &'static str) -> FileOption {
    FileOption { name, label, help, unit: "", kind: OptionKind::Flag, set: Setter::Flag(|_, _| {}) }
}

impl FileOption {
    const fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    const fn flag(self, set: fn(&mut FileOptions, bool)) -> Self {
        Self { set: Setter::Flag(set), ..self }
    }

    /// A choice of numbers: the least, the largest, the distance of a control's values, and the default.
    const fn number(self, [low, high, step, default]: [f64; 4], set: fn(&mut FileOptions, f64)) -> Self {
        Self { kind: OptionKind::Number { low, high, step, default }, set: Setter::Number(set), ..self }
    }

    const fn text(self, kind: OptionKind, set: fn(&mut FileOptions, &OptionValue)) -> Self {
        Self { kind, set: Setter::Text(set), ..self }
    }

    /// A choice of words with their labels; the first one is the default.
    const fn words(self, words: Words, set: fn(&mut FileOptions, &OptionValue)) -> Self {
        self.text(OptionKind::Word { words, default: words[0].0 }, set)
    }

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
            match (option.set, value) {
                (Setter::Flag(set), OptionValue::Flag(value)) => set(&mut options, *value),
                (Setter::Number(set), OptionValue::Number(value)) => set(&mut options, *value),
                (Setter::Text(set), value) => set(&mut options, value),
                // Not admitted.
                _ => {}
            }
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
