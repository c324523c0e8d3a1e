//! Errors of scripts and of films.

use crate::script::{MAX_FRAME_PIXELS, MAX_KEYS, MAX_RATE, MAX_SCRIPT, MAX_SECONDS, MAX_SIDE, MAX_TRACKS, MIN_SIDE};
use crate::{Easing, Ending};
use core::fmt;
use core::ops::Range;
use lsystem_base::say;

/// A mistake in a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ScriptProblem {
    /// The number of a segment cannot be read.
    Segment,
    /// The text is longer than [`MAX_SCRIPT`] bytes.
    Long,
    /// The text does not begin with a version that is known.
    Version,
    /// A part is neither a time, a rate, a size, an ending, an easing nor a track.
    Part,
    /// A part of this kind stands twice.
    Twice(String),
    /// The seconds are out of range.
    Seconds,
    /// The frames a second are out of range.
    Rate,
    /// The size is out of range.
    Size,
    /// There is no such easing.
    Easing,
    /// A track's name is unknown.
    Subject,
    /// There are too many tracks.
    Tracks,
    /// There are too many keys.
    Keys,
    /// A key is not a time, a colon and a value.
    Key,
    /// A key's time is out of range.
    Time,
    /// A key's time is not after the one before.
    Order,
    /// A key has the wrong number of numbers; the right number in words.
    Count(String),
    /// A number is wrong or out of range; the range in words.
    Value(String),
}

impl fmt::Display for ScriptProblem {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Long => out.write_str(&say!("a film's text has at most {} bytes", MAX_SCRIPT)),
            Self::Version => out.write_str(&say!("a film's text begins with its version, 1, such as `1;10s;n=0:0,8:6`")),
            Self::Part => out.write_str(&say!(
                "expected seconds (`10s`), a rate (`25fps`), a size (`1280x720`), one of {}, `ease=` or a track such as \
                 `angle=0:20,5:30`",
                Ending::NAMES.map(|name| format!("`{name}`")).join(", ")
            )),
            Self::Twice(name) => out.write_str(&say!("{} stands twice", name)),
            Self::Seconds => out.write_str(&say!("a film has 0.04 to {} seconds", MAX_SECONDS)),
            Self::Rate => out.write_str(&say!("a film has 1 to {} frames a second, a whole number", MAX_RATE)),
            Self::Size => out.write_str(&say!(
                "a frame has {} to {} pixels each way and at most {} in all",
                MIN_SIDE,
                MAX_SIDE,
                MAX_FRAME_PIXELS
            )),
            Self::Segment => out.write_str(&say!("expected `@` and the number of a segment, from 1")),
            Self::Easing => {
                out.write_str(&say!("an easing is one of {}", Easing::NAMES.map(|name| format!("`{name}`")).join(", ")))
            }
            Self::Subject => out.write_str(&say!(
                "a track is `n`, `drawn`, `view`, `camera`, a number of the system by its key in links such as `angle`, \
                 or a constant such as `rules.r`"
            )),
            Self::Tracks => out.write_str(&say!("a film has at most {} tracks", MAX_TRACKS)),
            Self::Keys => out.write_str(&say!("a film has at most {} keys", MAX_KEYS)),
            Self::Key => out.write_str(&say!("a key is a time and a value, such as `5:30` or `5:30~smooth`")),
            Self::Time => out.write_str(&say!("the time of a key is from 0 to {} seconds", MAX_SECONDS)),
            Self::Order => out.write_str(&say!("each key is later than the one before")),
            Self::Count(words) => out.write_str(&say!("expected {}", words)),
            Self::Value(words) => out.write_str(&say!("expected {}", words)),
        }
    }
}

/// A problem in a script, and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError {
    /// The mistake.
    pub problem: ScriptProblem,
    /// The part that is wrong, in bytes of the text.
    pub span: Range<usize>,
    /// An excerpt of this part.
    pub text: String,
}

impl fmt::Display for ScriptError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.text.as_str() {
            "" => out.write_str(&say!("film: {}", self.problem)),
            text => out.write_str(&say!("film, `{}`: {}", text, self.problem)),
        }
    }
}

impl core::error::Error for ScriptError {}

/// A track that does not fit its system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FilmError {
    /// The rules have no constant of this name.
    NoConstant(String),
    /// The constant is computed, so that no number can replace it.
    Computed(String),
}

impl fmt::Display for FilmError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoConstant(name) => out.write_str(&say!("the rules have no constant `{}`", name)),
            Self::Computed(name) => {
                out.write_str(&say!("the constant `{}` is computed; only a constant that is a number can change", name))
            }
        }
    }
}

impl core::error::Error for FilmError {}
