//! A tune: the notes of a walk.

use lsystem_base::words::grouped;
use lsystem_base::{counted, say};
/// The notes of a walk, in drawing order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tune {
    /// The notes.
    pub notes: Vec<Note>,
    /// The time from the start to the end of the last note, in steps.
    pub length: f64,
    /// The number of voices.
    pub voices: u32,
    /// The part of the walk that is heard.
    pub heard: Heard,
}

/// A note: a line of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Note {
    /// The time at which the note begins, in steps.
    pub start: f64,
    /// The time that it lasts, in steps.
    pub length: f64,
    /// The pitch as a key of the MIDI standard: 60 is middle C.
    pub key: u8,
    /// The loudness, from 1 to 127: the stem is loudest.
    pub velocity: u8,
    /// The voice, counted from 0 in the order of their first notes: the branch; of lines at even distances, the branch
    /// level.
    pub voice: u32,
    /// The place of the line's end from left (-1) to right (1).
    pub side: f64,
    /// The number of the line (0-based) in drawing order.
    pub segment: u128,
    /// The end of the line, in model units; z is 0 in the plane.
    pub at: [f64; 3],
}

/// The part of a walk that is heard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heard {
    /// Every line.
    #[default]
    All,
    /// Lines at even distances, out of so many.
    Some(u128),
    /// Every line of an earlier generation: the last one that has few enough.
    Earlier(u32),
}

impl Tune {
    /// Facts about the tune, as a line of text. `step` is the time of a step in seconds.
    #[must_use]
    pub fn words(&self, step: f64) -> String {
        let seconds = libm::round(self.length * step) as u64;
        let time = format!("{}:{:02} min", seconds / 60, seconds % 60);
        let voices = counted!(self.voices, "{} voice", "{} voices");
        let notes = counted!(self.notes.len(), "{} note", "{} notes");
        let all = say!("{} in {}, {}", notes, voices, time);
        match self.heard {
            Heard::All => all,
            Heard::Some(lines) => {
                say!("{}: lines at even distances, of {}", all, grouped(&lines.to_string()))
            }
            Heard::Earlier(n) => say!("{}: all lines of generation {}, as later ones have too many", all, n),
        }
    }
}
