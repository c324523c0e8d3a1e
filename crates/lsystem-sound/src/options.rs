//! The choices for what is heard.

/// The most notes of a tune.
pub const MAX_NOTES: u32 = 100_000;

/// The choices for what is heard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoundOptions {
    /// The quantity that is the pitch.
    pub pitch: Pitch,
    /// The time of a note.
    pub time: Time,
    /// The pitches in use.
    pub scale: Scale,
    /// The range of pitches in octaves, from 1 to 6.
    pub octaves: u8,
    /// Quarter notes in a minute, from 20 to 400. A step of the tune is a sixteenth note.
    pub tempo: f64,
    /// The most notes, at most [`MAX_NOTES`].
    pub notes: u32,
}

/// The quantity that is the pitch of a note.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pitch {
    /// The height of the line's end, from the lowest to the highest place of the drawing.
    Height,
    /// The letter that draws the line: the letters are the first pitches of the scale, an octave higher in each branch
    /// level.
    Letter,
}

/// The time of a note.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Time {
    /// Lines follow each other in drawing order, one in each step. A jump is a rest of one step.
    Step,
    /// A line begins at its distance from the start along the branches, and lasts as long as it is long: branches that
    /// leave the stem at the same place sound together. A line of mean length lasts one step.
    Length,
}

/// A scale on C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Five tones, of which all sound well together.
    Pentatonic,
    /// The major scale.
    Major,
    /// The natural minor scale.
    Minor,
    /// All twelve tones.
    Chromatic,
}

impl Default for SoundOptions {
    fn default() -> Self {
        Self {
            pitch: Pitch::Height,
            time: Time::Step,
            scale: Scale::Pentatonic,
            octaves: 3,
            tempo: 120.0,
            notes: 2_000,
        }
    }
}

impl SoundOptions {
    /// The choices within their limits.
    #[must_use]
    pub fn bounded(self) -> Self {
        // NaN becomes the default.
        let tempo = if self.tempo.is_nan() { Self::default().tempo } else { self.tempo.clamp(20.0, 400.0) };
        Self { octaves: self.octaves.clamp(1, 6), tempo, notes: self.notes.clamp(1, MAX_NOTES), ..self }
    }

    /// The seconds of a step.
    #[must_use]
    pub fn step_seconds(&self) -> f64 {
        15.0 / self.bounded().tempo
    }
}
