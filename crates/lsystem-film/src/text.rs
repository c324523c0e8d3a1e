//! The text form of scripts: `1;10s;25fps;1280x720;repeat;n=0:0,9:7~smooth;angle=0:20,5:30`.
//!
//! Parts are separated by `;` or line ends. The first part is the version. All other parts may be left out and stand in
//! any order. A track is a name, `=`, and keys that are separated by `,`: a time in seconds, `:`, and a value, whose
//! numbers are separated by `/`; then `~` and an easing. Of all these signs, none is escaped in links.

use crate::error::{ScriptError, ScriptProblem};
use crate::script::{MAX_FRAME_PIXELS, MAX_KEYS, MAX_RATE, MAX_SCRIPT, MAX_SECONDS, MAX_SIDE, MAX_TRACKS};
use crate::script::{MIN_SECONDS, MIN_SIDE};
use crate::{Easing, Ending, Keyframe, Script, Subject, Track};
use core::fmt;
use core::ops::Range;
use core::str::FromStr;
use lsystem_base::decimal;
use lsystem_base::number::number as written;
use lsystem_base::word;
use lsystem_base::words::said;
use lsystem_drawing::Origin;
use lsystem_syntax::notes::excerpt;

/// The version of the text form.
const VERSION: &str = "1";
/// The part of a film with a fixed camera.
const FIXED: &str = "fixed";
/// The sign before the number of the segment that is the origin of views, from 1.
const SEGMENT: char = '@';
/// Longer numbers are not read, in bytes, as in links.
const LONGEST_NUMBER: usize = 40;

/// A part of a text that is being read.
#[derive(Clone, Copy)]
struct Piece<'a> {
    text: &'a str,
    /// The offset of the piece in the whole text, in bytes.
    start: usize,
}

impl<'a> Piece<'a> {
    fn trimmed(self) -> Self {
        let cut = self.text.len() - self.text.trim_start().len();
        Self { text: self.text.trim(), start: self.start + cut }
    }

    /// The pieces between separators.
    fn split(self, separators: &'static [char]) -> impl Iterator<Item = Self> {
        let mut start = self.start;
        self.text.split(separators).map(move |text| {
            let piece = Self { text, start };
            // All separators are one byte long.
            start += text.len() + 1;
            piece.trimmed()
        })
    }

    /// The pieces before and after the first separator, if there is one.
    fn split_once(self, separator: char) -> Option<(Self, Self)> {
        let (before, after) = self.text.split_once(separator)?;
        let second = Self { text: after, start: self.start + before.len() + 1 };
        Some((Self { text: before, ..self }.trimmed(), second.trimmed()))
    }

    fn error(self, problem: ScriptProblem) -> ScriptError {
        let span: Range<usize> = self.start..self.start + self.text.len();
        ScriptError { problem, span, text: excerpt(self.text) }
    }

    /// A finite number.
    fn number(self) -> Option<f64> {
        let short = Some(self.text).filter(|text| text.len() <= LONGEST_NUMBER);
        // Adding 0 turns -0 into 0.
        short.and_then(decimal::read).filter(|number| number.is_finite()).map(|number| number + 0.0)
    }

    fn whole(self) -> Option<u32> {
        self.text.bytes().all(|byte| byte.is_ascii_digit()).then(|| self.text.parse().ok()).flatten()
    }

    fn without(self, suffix: &str) -> Option<Self> {
        Some(Self { text: self.text.strip_suffix(suffix)?, ..self }.trimmed())
    }
}

impl FromStr for Script {
    type Err = ScriptError;

    fn from_str(text: &str) -> Result<Self, ScriptError> {
        let whole = Piece { text, start: 0 };
        if text.len() > MAX_SCRIPT {
            return Err(ScriptError { problem: ScriptProblem::Long, span: 0..text.len(), text: String::new() });
        }
        let mut pieces = whole.split(&[';', '\n']).filter(|piece| !piece.text.is_empty());
        match pieces.next() {
            Some(Piece { text: VERSION, .. }) => {}
            Some(first) => return Err(first.error(ScriptProblem::Version)),
            None => return Err(whole.error(ScriptProblem::Version)),
        }
        let pieces: Vec<Piece<'_>> = pieces.collect();
        let mut script = Self::default();
        let mut seen: Vec<&'static str> = Vec::new();
        // Tracks are read last, because the easing of the whole film may stand behind them.
        for &piece in &pieces {
            let Some(kind) = read_part(piece, &mut script)? else { continue };
            if seen.contains(&kind) {
                return Err(piece.error(ScriptProblem::Twice(said(kind))));
            }
            seen.push(kind);
        }
        let mut keys = 0;
        for &piece in pieces.iter().filter(|piece| is_track(piece)) {
            if script.tracks.len() == MAX_TRACKS {
                return Err(piece.error(ScriptProblem::Tracks));
            }
            let track = read_track(piece, script.easing, &mut keys)?;
            if script.tracks.iter().any(|other| other.subject == track.subject) {
                return Err(piece.error(ScriptProblem::Twice(track.subject.name())));
            }
            script.tracks.push(track);
        }
        Ok(script)
    }
}

/// Whether a part is a track. The easing of the whole film is no track.
fn is_track(piece: &Piece<'_>) -> bool {
    piece.text.contains('=') && !piece.text.starts_with("ease=")
}

/// Reads a part that is no track. Returns its kind.
fn read_part(piece: Piece<'_>, script: &mut Script) -> Result<Option<&'static str>, ScriptError> {
    if is_track(&piece) {
        return Ok(None);
    }
    if let Some((_, name)) = piece.split_once('=') {
        script.easing = Easing::named(name.text).ok_or_else(|| name.error(ScriptProblem::Easing))?;
        return Ok(Some(word!("the easing")));
    }
    if let Some(ending) = Ending::named(piece.text) {
        script.ending = ending;
        return Ok(Some(word!("the ending")));
    }
    if piece.text == FIXED {
        script.fixed = true;
        return Ok(Some(word!("the camera")));
    }
    if let Some(number) = piece.text.strip_prefix(SEGMENT) {
        script.segment = Some(Origin::read(number).ok_or_else(|| piece.error(ScriptProblem::Segment))?);
        return Ok(Some(word!("the segment")));
    }
    if let Some(rate) = piece.without("fps") {
        let rate = rate.whole().filter(|rate| (1..=MAX_RATE).contains(rate));
        script.rate = rate.ok_or_else(|| piece.error(ScriptProblem::Rate))?;
        return Ok(Some(word!("the rate")));
    }
    if let Some(seconds) = piece.without("s") {
        let seconds = seconds.number().filter(|seconds| (MIN_SECONDS..=MAX_SECONDS).contains(seconds));
        script.seconds = seconds.ok_or_else(|| piece.error(ScriptProblem::Seconds))?;
        return Ok(Some(word!("the time")));
    }
    if let Some((width, height)) = piece.split_once('x') {
        let sides = (width.whole(), height.whole());
        let (Some(width), Some(height)) = sides else { return Err(piece.error(ScriptProblem::Part)) };
        script.size = checked_size([width, height]).ok_or_else(|| piece.error(ScriptProblem::Size))?;
        return Ok(Some(word!("the size")));
    }
    Err(piece.error(ScriptProblem::Part))
}

/// The size of a frame, if it is within the limits.
fn checked_size(size: [u32; 2]) -> Option<[u32; 2]> {
    let is_within =
        size.iter().all(|side| (MIN_SIDE..=MAX_SIDE).contains(side)) && size[0] * size[1] <= MAX_FRAME_PIXELS;
    is_within.then_some(size)
}

/// Reads a track. `keys` counts the keys of all tracks.
fn read_track(piece: Piece<'_>, easing: Easing, keys: &mut usize) -> Result<Track, ScriptError> {
    let Some((name, values)) = piece.split_once('=') else { return Err(piece.error(ScriptProblem::Part)) };
    let subject = Subject::named(name.text).ok_or_else(|| name.error(ScriptProblem::Subject))?;
    let mut track = Track { subject, keys: Vec::new() };
    for piece in values.split(&[',']) {
        if *keys == MAX_KEYS {
            return Err(piece.error(ScriptProblem::Keys));
        }
        *keys += 1;
        let key = read_key(piece, &track.subject, easing)?;
        if track.keys.last().is_some_and(|before| before.time >= key.time) {
            return Err(piece.error(ScriptProblem::Order));
        }
        track.keys.push(key);
    }
    Ok(track)
}

fn read_key(piece: Piece<'_>, subject: &Subject, easing: Easing) -> Result<Keyframe, ScriptError> {
    let (time, rest) = piece.split_once(':').ok_or_else(|| piece.error(ScriptProblem::Key))?;
    let (value, easing) = match rest.split_once('~') {
        Some((value, name)) => (value, Easing::named(name.text).ok_or_else(|| name.error(ScriptProblem::Easing))?),
        None => (rest, easing),
    };
    let seconds = time.number().filter(|seconds| (0.0..=MAX_SECONDS).contains(seconds));
    let seconds = seconds.ok_or_else(|| time.error(ScriptProblem::Time))?;
    let numbers: Vec<Piece<'_>> = value.split(&['/']).collect();
    if !subject.takes(numbers.len()) {
        return Err(value.error(ScriptProblem::Count(subject.count_words())));
    }
    let number = |(at, piece): (usize, &Piece<'_>)| {
        let number = piece.number().filter(|&number| subject.range(at).admits(number));
        number.ok_or_else(|| piece.error(ScriptProblem::Value(subject.range_words(at))))
    };
    let value = numbers.iter().enumerate().map(number).collect::<Result<_, _>>()?;
    Ok(Keyframe { time: seconds, value, easing })
}

impl Script {
    /// Adds a track as text, such as `angle=0:20,5:30`. A track of the same subject is replaced.
    ///
    /// # Errors
    /// As for the text of a script.
    pub fn add(&mut self, text: &str) -> Result<(), ScriptError> {
        let mut keys = self.tracks.iter().map(|track| track.keys.len()).sum();
        let piece = Piece { text, start: 0 }.trimmed();
        let track = read_track(piece, self.easing, &mut keys)?;
        self.tracks.retain(|other| other.subject != track.subject);
        if self.tracks.len() == MAX_TRACKS {
            return Err(piece.error(ScriptProblem::Tracks));
        }
        self.tracks.push(track);
        Ok(())
    }

    /// Sets the seconds, the rate and the size.
    ///
    /// # Errors
    /// The number that is out of its range.
    pub fn set(&mut self, seconds: f64, rate: u32, size: [u32; 2]) -> Result<(), ScriptProblem> {
        if !(MIN_SECONDS..=MAX_SECONDS).contains(&seconds) {
            return Err(ScriptProblem::Seconds);
        }
        if !(1..=MAX_RATE).contains(&rate) {
            return Err(ScriptProblem::Rate);
        }
        let size = checked_size(size).ok_or(ScriptProblem::Size)?;
        (self.seconds, self.rate, self.size) = (seconds, rate, size);
        Ok(())
    }
}

impl fmt::Display for Script {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { seconds, rate, size: [width, height], ending, easing, fixed, segment, tracks } = self;
        write!(out, "{VERSION};{}s;{rate}fps;{width}x{height};{}", written(*seconds), ending.name())?;
        if *easing != Easing::default() {
            write!(out, ";ease={}", easing.name())?;
        }
        if *fixed {
            write!(out, ";{FIXED}")?;
        }
        if let Some(segment) = segment {
            write!(out, ";{SEGMENT}{}", segment.text())?;
        }
        for Track { subject, keys } in tracks {
            for (at, key) in keys.iter().enumerate() {
                match at {
                    0 => write!(out, ";{subject}=")?,
                    _ => out.write_str(",")?,
                }
                let numbers: Vec<String> = key.value.iter().map(|&number| written(number)).collect();
                write!(out, "{}:{}", written(key.time), numbers.join("/"))?;
                if key.easing != *easing {
                    write!(out, "~{}", key.easing.name())?;
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Script, ScriptError> {
        text.parse()
    }

    #[test]
    fn texts_are_read_and_written() {
        for text in [
            "1;10s;25fps;1280x720;repeat",
            "1;10s;25fps;640x360;once;@18446744073709551617;view=0:0.1/-0.2/1,9:0/0/1e300",
            "1;2.5s;60fps;16x4096;once;ease=smooth;fixed;n=0:0,2:7~hold",
            "1;10s;25fps;640x360;bounce;view=0:0/0/1,9:0.1/-0.2/1e19/1e-18/-2e-18;seed=0:1,1:2;rules.r=0:0.5,10:-1",
            "1;10s;25fps;640x360;repeat;camera=0:25/12,10:385/12;tropism=0:0/-1/0,5:1/0/0;drawn=0:0,9:1",
        ] {
            let script = read(text).unwrap();
            assert_eq!(script.to_string(), text);
        }
        let loose = read(" 1 ;\n n = 0 : 0 , 2 : 7 ;;\r\n angle=1:2~ in\n30 fps; ease=out ").unwrap();
        assert_eq!(loose.to_string(), "1;10s;30fps;1280x720;repeat;ease=out;n=0:0,2:7;angle=1:2~in");
    }

    #[test]
    fn mistakes_are_told_with_their_place() {
        let check = |text: &str, place: &str, words: &str| {
            let error = read(text).unwrap_err();
            assert_eq!(&text[error.span.clone()], place, "{text}");
            assert!(error.to_string().contains(words), "{error}");
        };
        check("", "", "begins with its version");
        check("2;n=0:1", "2", "begins with its version");
        check("1;10", "10", "expected seconds");
        check("1;1s;2s", "2s", "the time stands twice");
        check("1;fixed;fixed", "fixed", "the camera stands twice");
        check("1;0s", "0s", "0.04 to 3600 seconds");
        check("1;99999s", "99999s", "seconds");
        check("1;@0", "@0", "from 1");
        check("1;@x", "@x", "from 1");
        check("1;61fps", "61fps", "1 to 60 frames");
        check("1;15x100", "15x100", "16 to 4096");
        check("1;4096x4096", "4096x4096", "8388608 in all");
        check("1;1280xhigh", "1280xhigh", "a size");
        check("1;moon=0:1", "moon", "a track is");
        check("1;n=0:1;n=0:2", "n=0:2", "n stands twice");
        check("1;angle=0:1,x:2", "x", "the time of a key");
        check("1;angle=0:1,5", "5", "a key is a time and a value");
        check("1;angle=5:1,5:2", "5:2", "later than the one before");
        check("1;angle=0:1~fast", "fast", "an easing is one of");
        check("1;angle=0:1/2", "1/2", "expected one number");
        check("1;view=0:1/2", "1/2", "3 or 5 numbers");
        check("1;n=0:1001", "1001", "a number from 0 to 1,000");
        check("1;seed=0:1.5", "1.5", "a whole number");
        check("1;ease=fast", "fast", "an easing is one of");
        check("1;angle=0:nan", "nan", "a number");
    }

    #[test]
    fn hostile_texts_are_bounded() {
        let many = |count: usize, part: &dyn Fn(usize) -> String| (0..count).map(part).collect::<Vec<_>>();
        let keys = many(MAX_KEYS + 1, &|at| format!("{at}:1")).join(",");
        assert_eq!(read(&format!("1;angle={keys}")).unwrap_err().problem, ScriptProblem::Keys);
        let tracks = many(MAX_TRACKS + 1, &|at| format!("rules.a{at}=0:1")).join(";");
        assert_eq!(read(&format!("1;{tracks}")).unwrap_err().problem, ScriptProblem::Tracks);
        assert_eq!(read(&"1;".repeat(MAX_SCRIPT)).unwrap_err().problem, ScriptProblem::Long);
        for text in ["1;=", "1;=0:1", "1;angle=", "1;x", "1;s", "1;fps", "1;view=0://", "1;ä=ö:ü", "1;angle=0:1~"] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
