//! The walk of the turtle through a marked drawing, and its notes.

use crate::marked::drawing_letters;
use crate::pitch::Range;
use crate::reader::{Line, lines};
use crate::{Heard, Note, Pitch, SoundOptions, Time, Tune};
use lsystem_drawing::{Figure, System};
use lsystem_syntax::{Halt, Work};

/// The units of work to read a line.
const LINE_WORK: u64 = 16;
/// The units of work to find a line by its number: a descent through nested blocks.
const FIND_WORK: u64 = 128;
/// The velocity of the stem, how much less each branch level has, and the least.
const VELOCITY: [u32; 3] = [100, 9, 48];
/// The longest rest, in steps: a drawing may jump as far as numbers go.
const LONGEST_REST: f64 = 64.0;
/// Gaps below this part of the drawing's size are rounding.
const ROUNDING: f64 = 1e-9;

/// A drawing of a [`marked`](crate::marked) system, ready to be heard.
#[derive(Clone, Debug)]
pub struct Walk {
    figure: Figure,
    /// By letter: its number among the letters that draw.
    letters: Vec<usize>,
    /// The least and the greatest x and y.
    extent: [[f64; 2]; 2],
}

impl Walk {
    /// The walk through `figure`, a drawing of the marked `system`.
    #[must_use]
    pub fn new(figure: Figure, system: &System) -> Self {
        let corner = |corner: &Vec<f64>| [corner[0], corner[1]];
        let extent = figure.bounds().map_or([[0.0; 2]; 2], |[low, high]| [corner(&low), corner(&high)]);
        Self { figure, letters: drawing_letters(system), extent }
    }

    /// The drawing.
    #[must_use]
    pub const fn figure(&self) -> &Figure {
        &self.figure
    }

    /// The number of lines; saturating.
    #[must_use]
    pub fn segments(&self) -> u128 {
        self.figure.segment_count()
    }

    /// The notes of all lines, or of lines at even distances if there are more than [`SoundOptions::notes`]. The latter
    /// have the time [`Time::Step`], and their voices are branch levels.
    ///
    /// # Errors
    /// If the work is stopped.
    pub fn tune(&self, options: &SoundOptions, work: &mut dyn Work) -> Result<Tune, Halt> {
        let (all, most) = (self.segments(), u128::from(options.bounded().notes));
        if all > most {
            // Without overflow: the product may be beyond 128 bits.
            let at = |number: u128| all / most * number + all % most * number / most;
            let tune = self.samples((0..most).map(at), options, work)?;
            return Ok(Tune { heard: Heard::Some(all), ..tune });
        }
        let mut lines = Vec::with_capacity(all as usize);
        self.read(0, &mut |line| {
            work.charge(LINE_WORK)?;
            lines.push(line);
            Ok(true)
        })?;
        Ok(self.all(&lines, options))
    }

    /// The notes of at most `count` lines: of line `from` (0-based), and of each `stride`-th one after it. They have the
    /// time [`Time::Step`], and their voices are branch levels.
    ///
    /// # Errors
    /// If the work is stopped.
    pub fn part(
        &self,
        from: u128,
        stride: u128,
        count: u32,
        options: &SoundOptions,
        work: &mut dyn Work,
    ) -> Result<Tune, Halt> {
        let (all, stride) = (self.segments(), stride.max(1));
        let at = |number: u32| stride.checked_mul(number.into()).and_then(|far| from.checked_add(far));
        let numbers = (0..count).map_while(at).take_while(|&number| number < all);
        self.samples(numbers, options, work)
    }

    /// Hands the lines from number `from` on to `take` until it returns `false`.
    fn read(&self, from: u128, take: &mut dyn FnMut(Line) -> Result<bool, Halt>) -> Result<(), Halt> {
        let mut pass = |lines: &mut dyn Iterator<Item = Line>| {
            for line in lines {
                if !take(line)? {
                    break;
                }
            }
            Ok(())
        };
        match &self.figure {
            Figure::Plane(drawing) => pass(&mut lines(drawing.marks_from(from))),
            Figure::Space(drawing) => pass(&mut lines(drawing.marks_from(from))),
        }
    }

    /// The notes of some lines by their numbers, one in each step.
    fn samples(
        &self,
        numbers: impl Iterator<Item = u128>,
        options: &SoundOptions,
        work: &mut dyn Work,
    ) -> Result<Tune, Halt> {
        let mut tune = Tune::default();
        let mut levels: Vec<u32> = vec![];
        for (step, number) in (0_u32..).zip(numbers) {
            work.charge(FIND_WORK)?;
            let mut found = None;
            self.read(number, &mut |line| {
                found = line.letter.is_some().then_some(line);
                Ok(found.is_none())
            })?;
            let Some(line) = found else { break };
            let voice = levels.iter().position(|&level| level == line.level).unwrap_or_else(|| {
                levels.push(line.level);
                levels.len() - 1
            });
            let time = [f64::from(step), 1.0];
            tune.push(self.note(&line, number, voice as u32, time, options));
        }
        Ok(tune)
    }

    /// The notes of all lines.
    fn all(&self, lines: &[Line], options: &SoundOptions) -> Tune {
        let lengths = lines.iter().filter(|line| line.letter.is_some()).map(|line| far(line.ends));
        let (sum, count) = lengths.fold((0.0, 0.0), |(sum, count), length| (sum + length, count + 1.0));
        let mut walker = Walker {
            time: options.time,
            mean: sum / count,
            least: ROUNDING * self.size(),
            now: 0.0,
            voices: 0,
            branches: vec![Branch { voice: None, now: 0.0, at: None }],
        };
        let mut tune = Tune::default();
        for line in lines {
            if let Some((voice, time)) = walker.walk(line) {
                let number = tune.notes.len() as u128;
                tune.push(self.note(line, number, voice, time, options));
            }
        }
        tune
    }

    /// The longer side of the drawing.
    fn size(&self) -> f64 {
        let [low, high] = self.extent;
        (high[0] - low[0]).max(high[1] - low[1])
    }

    fn note(&self, line: &Line, segment: u128, voice: u32, time: [f64; 2], options: &SoundOptions) -> Note {
        let (range, at) = (Range::new(options), line.ends[1]);
        let [across, up] = [0, 1].map(|axis| {
            let [low, high] = self.extent.map(|corner| corner[axis]);
            let part = (at[axis] - low) / (high - low);
            // A drawing without extent is in the middle.
            if part.is_finite() { part } else { 0.5 }
        });
        let key = match options.pitch {
            Pitch::Height => range.at(up),
            Pitch::Letter => {
                let letter = line.letter.and_then(|letter| self.letters.get(letter));
                range.of_letter(letter.copied().unwrap_or(0), line.level)
            }
        };
        let [loud, less, soft] = VELOCITY;
        let velocity = loud.saturating_sub(less.saturating_mul(line.level)).max(soft) as u8;
        let side = (2.0 * across - 1.0).clamp(-1.0, 1.0);
        let [start, length] = time;
        Note { start, length, key, velocity, voice, side, segment, at }
    }
}

impl Tune {
    fn push(&mut self, note: Note) {
        self.length = self.length.max(note.start + note.length);
        self.voices = self.voices.max(note.voice + 1);
        self.notes.push(note);
    }
}

/// The place and the time of the turtle on its way through all lines.
struct Walker {
    time: Time,
    /// The mean length of lines.
    mean: f64,
    /// The least distance that is a jump.
    least: f64,
    /// The end of the last note, if lines follow each other.
    now: f64,
    /// The number of voices.
    voices: u32,
    /// The open branches, the stem first.
    branches: Vec<Branch>,
}

/// An open branch.
#[derive(Clone, Copy)]
struct Branch {
    /// `None` before the first note.
    voice: Option<u32>,
    /// The time at its end, as far as it is drawn.
    now: f64,
    /// The place of its end; `None` before the first line.
    at: Option<[f64; 3]>,
}

impl Walker {
    /// Goes along a line. Returns the voice, the start and the length of its note.
    fn walk(&mut self, line: &Line) -> Option<(u32, [f64; 2])> {
        let is_branch = line.letter.is_none();
        // A line of level 1 belongs to the second open branch; a new branch of level 1 leaves the first one.
        let open = (line.level as usize + usize::from(!is_branch)).max(1);
        self.branches.truncate(open);
        let mut last = *self.branches.last()?;
        if self.branches.len() < open {
            // The mark of a branch is lost.
            last.voice = None;
            self.branches.push(last);
        }
        let [from, to] = line.ends;
        let jump = last.at.map_or(0.0, |at| far([at, from]));
        let rest = match self.time {
            _ if jump <= self.least => 0.0,
            Time::Step => 1.0,
            Time::Length => self.steps(jump).min(LONGEST_REST),
        };
        self.now += rest;
        let now = last.now + rest;
        let branch = self.branches.last_mut()?;
        (branch.now, branch.at) = (now, Some(from));
        if is_branch {
            self.branches.push(Branch { voice: None, now, at: Some(from) });
            return None;
        }
        let voice = *branch.voice.get_or_insert_with(|| {
            self.voices += 1;
            self.voices - 1
        });
        branch.at = Some(to);
        let (start, length) = match self.time {
            Time::Step => (self.now, 1.0),
            Time::Length => (now, if self.mean > 0.0 { far(line.ends) / self.mean } else { 1.0 }),
        };
        // Lengths beyond the range of numbers count as one step.
        let length = if length.is_finite() { length } else { 1.0 };
        let branch = self.branches.last_mut()?;
        branch.now = now + length;
        self.now = start + length;
        Some((voice, [start, length]))
    }

    /// A distance in steps.
    fn steps(&self, distance: f64) -> f64 {
        let steps = distance / self.mean;
        if steps.is_nan() { 1.0 } else { steps }
    }
}

/// The length of a line.
fn far([from, to]: [[f64; 3]; 2]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    libm::hypot(libm::hypot(x, y), z)
}
