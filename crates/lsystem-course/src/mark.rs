//! Marks of answers to exercises.

use crate::branches::Branches;
use crate::compiled::compiled;
use crate::correspondence::draw_alike;
use crate::exercise::{Asks, Exercise};
use crate::repair::{drawn, ink, is_of};
use lsystem_base::say;
use lsystem_base::words::{grouped, shown};

use crate::same::Outline;
use crate::sample::{Sample, Sampling};
use crate::sketch::{Sketch, Sketching};
use lsystem_base::{Limits, Meter, Progress};
use lsystem_derive::Tally;
use lsystem_drawing::expand;
use lsystem_render::mask::Mask;
use lsystem_render::{Renderer, View, Viewport, fit};
use lsystem_syntax::{Definition, Diagnostic, Style, parse};

/// Pictures whose ink agrees less than this are different: equal ones differ by the rounding of pixels only.
const SURELY_DIFFERENT: f64 = 0.98;
/// The most symbols of strings that are compared.
const LIMITS: Limits =
    Limits { symbols: 4 << 20, modules: 1 << 20, segments: u32::MAX as u64, work: 16 << 20, memory: 48 << 20 };
/// The first seeds of both samples.
const SEEDS: [u32; 2] = [0, 1_000];

/// The most generations, and the most segments of each, that are compared besides the one that is asked for.
const MAX_GENERATIONS: u32 = 12;
const MAX_COMPARED: u64 = 20_000;

/// The usual size of a shown picture, in CSS pixels.
const SHOWN: f64 = 320.0;
/// The thinnest and the thickest strokes of shown pictures, in CSS pixels.
const THINNEST: f64 = 1.25;
const THICKEST: f64 = 3.0;

/// The mark of an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Grade {
    /// Whether the exercise is solved.
    pub is_solved: bool,
    /// How near the answer is, from 0 to 1. For pictures, the part of the ink that agrees.
    pub agreement: f64,
    /// Whether the answer is the same as the target; `None` if that is unknown, because both are too large.
    pub is_same: Option<bool>,
    /// The symbols of the student's own rules.
    pub symbols: u32,
    /// The segments of the target and of the answer; `None` if they are too many to be counted.
    pub segments: [Option<Tally>; 2],
    /// A sentence about the measure: what agrees, or the first difference.
    pub words: String,
    /// The errors of the answer.
    pub errors: Vec<Diagnostic>,
}

/// Marks answers to one exercise.
pub struct Marker {
    exercise: Exercise,
    target: Sketch,
    /// The segments of the target; `None` if they are too many to be counted.
    segments: Option<Tally>,
    /// The target's ink; empty before it is needed, and if there is too much.
    outline: Option<Outline>,
    text: Option<String>,
    /// The string of the last marked answer, if the string is asked for.
    own_text: Option<String>,
    sample: Option<Sample>,
    /// The mask of the last marked answer.
    own: Mask,
}

/// A mark in the making.
pub struct Marking {
    whole: Definition,
    symbols: u32,
    stage: Stage,
}

enum Stage {
    Sketch(Sketching),
    Sample(Box<Sketch>, Box<Sampling>),
    Failed(Vec<Diagnostic>),
}

impl Marking {
    fn new(whole: Definition, symbols: u32) -> Self {
        let stage = match Sketching::new(&whole) {
            Ok(sketching) => Stage::Sketch(sketching),
            Err(errors) => Stage::Failed(errors),
        };
        Self { whole, symbols, stage }
    }
}

impl Grade {
    /// The agreement in percent, rounded down: what is not the same is never called 100 %.
    #[must_use]
    pub fn percent(&self) -> String {
        percent(self.agreement)
    }
}

impl Marker {
    /// Draws the target.
    ///
    /// # Errors
    /// The errors of the target, or the limit that it exceeds.
    pub fn new(mut exercise: Exercise) -> Result<Self, Vec<Diagnostic>> {
        // Wind moves equal pictures of different derivations apart.
        exercise.target.wind = [0.0; 2];
        let one = |limit| vec![limit];
        let target = Sketching::new(&exercise.target)?.finish().map_err(one)?;
        let (mut text, mut sample) = (None, None);
        match exercise.asks {
            Asks::Picture | Asks::Segments | Asks::Program => {}
            Asks::Text => text = Some(string(&exercise.target)?),
            Asks::Statistics => {
                let mut sampling = Sampling::new(&exercise.target, SEEDS[0])?;
                while sample.is_none() {
                    sample = sampling.step().map_err(one)?;
                }
            }
        }
        let segments = target.segments(&exercise.target);
        Ok(Self { exercise, target, segments, outline: None, text, own_text: None, sample, own: Mask::default() })
    }

    /// The exercise.
    #[must_use]
    pub fn exercise(&self) -> &Exercise {
        &self.exercise
    }

    /// The beginning of the string to derive, at most `most` bytes; `None` if something else is asked for.
    #[must_use]
    pub fn text(&self, most: usize) -> Option<&str> {
        let text = self.text.as_deref()?;
        Some(&text[..text.floor_char_boundary(most)])
    }

    /// The beginning of the string of the last marked answer, at most `most` bytes; `None` if something else is asked for,
    /// or if the answer has errors.
    #[must_use]
    pub fn own_text(&self, most: usize) -> Option<&str> {
        let text = self.own_text.as_deref()?;
        Some(&text[..text.floor_char_boundary(most)])
    }

    /// Starts to mark an answer: the student's own rules, and values of what is free.
    #[must_use]
    pub fn begin(&self, student: &Definition) -> Marking {
        Marking::new(self.exercise.complete(student), Exercise::symbols(student))
    }

    /// Marks an answer at once.
    pub fn mark(&mut self, student: &Definition) -> Grade {
        self.finish(self.begin(student))
    }

    /// Whether a whole system would solve the exercise.
    pub(crate) fn is_solved_by(&mut self, whole: &Definition) -> bool {
        self.finish(Marking::new(whole.clone(), 0)).is_solved
    }

    fn finish(&mut self, mut marking: Marking) -> Grade {
        loop {
            if let Some(mark) = self.step(&mut marking, u64::MAX) {
                return mark;
            }
        }
    }

    /// Works on a mark for about `work` units, or until a longer step is done. Returns the mark after the last step.
    pub fn step(&mut self, marking: &mut Marking, work: u64) -> Option<Grade> {
        let stage = core::mem::replace(&mut marking.stage, Stage::Failed(Vec::new()));
        match stage {
            Stage::Failed(errors) => Some(self.failed(marking, errors)),
            Stage::Sketch(sketching) => match sketching.step(work) {
                Err(limit) => Some(self.failed(marking, vec![limit])),
                Ok(Err(more)) => {
                    marking.stage = Stage::Sketch(more);
                    None
                }
                Ok(Ok(sketch)) if self.sample.is_some() => {
                    marking.stage = match Sampling::new(&marking.whole, SEEDS[1]) {
                        Ok(sampling) => Stage::Sample(Box::new(sketch), Box::new(sampling)),
                        Err(errors) => Stage::Failed(errors),
                    };
                    None
                }
                Ok(Ok(sketch)) => Some(self.compared(marking, &sketch)),
            },
            Stage::Sample(sketch, mut sampling) => match sampling.step() {
                Err(limit) => Some(self.failed(marking, vec![limit])),
                Ok(None) => {
                    marking.stage = Stage::Sample(sketch, sampling);
                    None
                }
                Ok(Some(sample)) => Some(self.sampled(marking, &sketch, &sample)),
            },
        }
    }

    /// The pixels of the target and of the last marked answer, 512 by 512, row by row from above: 1 for ink of both, 2
    /// for ink that is missing, 4 for ink that is too much, 0 for none.
    #[must_use]
    pub fn overlay(&self) -> Vec<u8> {
        self.own.compared(&self.target.mask)
    }

    /// The style in which the target and answers are shown: the target's, with strokes of one width in pixels. Widths in
    /// steps would make a log of an answer that is begun.
    #[must_use]
    pub fn shown_style(&self) -> Style {
        let style = &self.exercise.target.style;
        let rect = fit(&self.target.seen);
        let step = SHOWN / rect.width.max(rect.height) * self.exercise.target.step.abs();
        let width = (style.width * step).clamp(style.min_width.max(THINNEST), THICKEST.max(style.min_width));
        let min_width = if width.is_finite() { libm::round(4.0 * width) / 4.0 } else { THINNEST };
        Style { width: 0.0, min_width, ..style.clone() }
    }

    /// The target in its own colours, as pixels: RGBA, from the upper left corner row by row.
    ///
    /// # Errors
    /// As [`Marker::new`].
    pub fn picture(&self, width: u32, height: u32, ratio: f64) -> Result<Vec<u8>, Vec<Diagnostic>> {
        let target = Definition { style: self.shown_style(), ..self.exercise.target.clone() };
        let sketch = Sketching::with_widths(&target)?.finish().map_err(|limit| vec![limit])?;
        let mut renderer = Renderer::light();
        renderer.load(sketch.seen);
        renderer.begin(&target.style, Viewport { width, height, ratio }, View::default());
        while renderer.step(usize::MAX) == Progress::More {}
        Ok(renderer.pixels().to_vec())
    }

    pub(crate) fn target(&self) -> &Sketch {
        &self.target
    }

    /// The segments of the target; `None` if they are too many to be counted.
    pub(crate) fn segments(&self) -> Option<&Tally> {
        self.segments.as_ref()
    }

    fn failed(&mut self, marking: &Marking, errors: Vec<Diagnostic>) -> Grade {
        self.own = Mask::default();
        self.own_text = None;
        Grade {
            is_solved: false,
            agreement: 0.0,
            is_same: Some(false),
            symbols: marking.symbols,
            segments: [self.segments.clone(), Some(Tally::ZERO)],
            words: String::new(),
            errors,
        }
    }

    fn compared(&mut self, marking: &Marking, own: &Sketch) -> Grade {
        match self.exercise.asks {
            Asks::Text => self.compared_texts(marking, own),
            Asks::Program => {
                self.marked(marking, own, 0.0, None, say!("Programs run in the page: mark these answers there."))
            }
            Asks::Segments => {
                let found = own.segments(&marking.whole);
                let (Some(expected), Some(found)) = (&self.segments, &found) else {
                    let words = say!("There are too many segments to count.");
                    return self.marked(marking, own, 0.0, None, words);
                };
                let agreement = expected.min(found).ratio(expected.max(found)).unwrap_or(1.0);
                let words = say!("{} of {} segments.", counted(found), counted(expected));
                self.marked(marking, own, agreement, Some(expected == found), words)
            }
            Asks::Picture | Asks::Statistics => {
                let agreement = own.mask.agreement(&self.target.mask);
                let is_same = self.is_same(own, agreement);
                // Drawings beyond the range of numbers show no ink, either.
                let has_ink = is_same == Some(true) || !own.mask.is_empty();
                let agreement = if has_ink { agreement } else { 0.0 };
                let ink = shown(&percent(agreement));
                let (agreement, words) = match (is_same, self.branches(own)) {
                    (Some(true), _) => (agreement, self.same(&marking.whole)),
                    (_, Some(branches)) => {
                        let shape = shown(&percent(branches));
                        let words = say!("{} of the ink agrees, and {} of the lengths and turns.", ink, shape);
                        (f64::midpoint(agreement, branches), words)
                    }
                    _ => (agreement, say!("{} of the ink agrees.", ink)),
                };
                self.marked(marking, own, agreement, is_same, words)
            }
        }
    }

    /// Whether the numbers of modules shape the target.
    pub(crate) fn has_numbers(&self) -> bool {
        let grammar = parse(&self.exercise.target.axiom, &self.exercise.target.rules).0;
        grammar.productions.iter().any(|rule| !rule.predecessor.parameters.is_empty())
    }

    /// How much the branches agree where numbers shape them: ink alone does not tell which number is nearer. `None` if
    /// ink decides, or if the branches do not correspond.
    fn branches(&self, own: &Sketch) -> Option<f64> {
        let is_small = |sketch: &Sketch| sketch.figure.check_size(MAX_COMPARED).is_ok();
        if self.exercise.tolerance.is_some() || !self.has_numbers() || !is_small(own) || !is_small(&self.target) {
            return None;
        }
        Some(Branches::of(&own.lists()?.0, &self.target.lists()?.0)?.agreement())
    }

    /// That an answer is right, and for which numbers of iterations it is right, too, if that is known.
    fn same(&self, whole: &Definition) -> String {
        let target = &self.exercise.target;
        let n = target.iterations;
        let alone = || say!("The picture is the same.");
        if whole.iterations != n || n == 0 {
            return alone();
        }
        if draw_alike(whole, target) {
            return say!("The picture is the same, at every number of iterations.");
        }
        let at = |definition: &Definition, n: u32| Definition { iterations: n, ..definition.clone() };
        let mut meter = Meter::new(LIMITS.work);
        let is_same_at = |n: u32| {
            let ink = ink(&at(target, n), MAX_COMPARED, &mut meter);
            let own = drawn(&at(whole, n), MAX_COMPARED, &mut meter);
            ink.zip(own).is_some_and(|(mut ink, own)| is_of(&mut ink, &own))
        };
        if n <= MAX_GENERATIONS && (0..n).all(is_same_at) {
            say!("The picture is the same, for n up to {}.", n)
        } else {
            alone()
        }
    }

    /// Whether a drawing is the same picture as the target; `None` if unknown.
    fn is_same(&mut self, own: &Sketch, agreement: f64) -> Option<bool> {
        let target = &self.target;
        if agreement < SURELY_DIFFERENT {
            return Some(false);
        }
        if own.has_graph_of(target) {
            return Some(true);
        }
        if self.outline.is_none() {
            self.outline = target.outline();
        }
        // An empty picture has no outline that could distinguish it from points.
        if own.mask.is_empty() != self.target.mask.is_empty() {
            return Some(false);
        }
        own.has_outline(self.outline.as_mut()?)
    }

    fn compared_texts(&mut self, marking: &Marking, own: &Sketch) -> Grade {
        let text = match string(&marking.whole) {
            Ok(text) => text,
            Err(errors) => return self.failed(marking, errors),
        };
        let expected = self.text.as_deref().unwrap_or_default();
        let same = text.chars().zip(expected.chars()).take_while(|(a, b)| a == b).count();
        let [found, most] = [text.chars().count(), expected.chars().count()];
        let is_same = text == expected;
        let agreement = if is_same { 1.0 } else { same as f64 / found.max(most) as f64 };
        let words = match is_same {
            true => say!("The string is the same."),
            false => {
                let [found, most] = [found, most].map(|count| counted(&Tally::from(count as u128)));
                let start = match same {
                    0 => say!("The first symbol differs."),
                    1 => say!("The first symbol agrees, the second differs."),
                    same => say!("The first {} symbols agree.", counted(&Tally::from(same as u128))),
                };
                say!("{} Length of your string: {}; of the target: {}.", start, found, most)
            }
        };
        self.own_text = Some(text);
        self.marked(marking, own, agreement, Some(is_same), words)
    }

    fn sampled(&mut self, marking: &Marking, own: &Sketch, sample: &Sample) -> Grade {
        let distance = self.sample.as_ref().map_or(1.0, |target| target.distance(sample));
        let is_near = Sample::is_near(distance);
        let words = match is_near {
            true => say!("Over many seeds the numbers of segments and the sizes agree."),
            false => say!(
                "Over many seeds the numbers of segments or the sizes differ; they agree to {}.",
                shown(&percent(1.0 - distance))
            ),
        };
        self.marked(marking, own, 1.0 - distance, Some(is_near), words)
    }

    fn marked(
        &mut self,
        marking: &Marking,
        own: &Sketch,
        agreement: f64,
        is_same: Option<bool>,
        words: String,
    ) -> Grade {
        self.own = own.mask.clone();
        // Ink agrees within a pixel, and quotients are rounded.
        let agreement = if is_same == Some(true) { agreement } else { agreement.min(1.0 - f64::EPSILON) };
        let is_close = is_same == Some(true) || self.exercise.tolerance.is_some_and(|least| agreement >= least);
        let is_short = self.exercise.most_symbols.is_none_or(|most| marking.symbols <= most);
        let words = match (is_close, is_short, self.exercise.most_symbols) {
            (true, false, Some(most)) => {
                say!("{} But your rules have {} symbols; at most {} are asked for.", words, marking.symbols, most)
            }
            _ => words,
        };
        Grade {
            is_solved: is_close && is_short,
            agreement,
            is_same,
            symbols: marking.symbols,
            segments: [self.segments.clone(), own.segments(&marking.whole)],
            words,
            errors: Vec::new(),
        }
    }
}

fn string(definition: &Definition) -> Result<String, Vec<Diagnostic>> {
    let system = compiled(definition)?;
    expand(&system, definition.iterations, &LIMITS).map_err(|limit| vec![limit])
}

/// A part in percent, rounded down.
fn percent(part: f64) -> String {
    format!("{:.1} %", libm::floor(part * 1000.0) / 10.0)
}

/// A count in words: with separators, or with an exponent if it has many digits.
pub(crate) fn counted(count: &Tally) -> String {
    const MAX_DIGITS: usize = 39;
    match count.to_string() {
        digits if digits.len() <= MAX_DIGITS => grouped(&digits),
        digits => say!("about {} × 10^{}", shown(&format!("{}.{}", &digits[..1], &digits[1..3])), digits.len() - 1),
    }
}
