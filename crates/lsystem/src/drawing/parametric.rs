//! Sharing blocks among modules with parameters.
//!
//! A module with the same parameters draws the same piece in the same number of steps, so pieces are made once for each
//! state: letter, parameters, steps. Where lengths only ever scale together, states are equal up to the scale, and a
//! figure has a few of them for each step; otherwise equal numbers are what brings states together. Where a piece looks to
//! the vertical (`$`), that is part of its state as the turtle has it (ABOP figure 2.6 has 4,096 apices in step 12, and few
//! ways in which the vertical lies).

use super::builder::Builder;
use super::drawer::start;
use super::graph::{effect, exponent, follow, is_balanced, place};
use super::sheet::{Desk, Sheet};
use super::vertical::{self, Course, Tilt, vertical_of};
use super::{BlockId, Item, Piece, StyleChange};
use crate::derivation::fault;
use crate::rewriting::{Keys, Scales, applying};
use crate::space::Space;
use crate::turtle::{Op, Pen, Score, exponent_of};
use crate::{Diagnostic, Fault, LetterId, Limits, Meter, Rule, Rules, Template, Turtle};
use core::ops::Range;
use lsystem_syntax::sorted::sort;

/// The most states: some hundred bytes each. More of them than this hardly ever come together.
const STATES: usize = 1 << 16;

/// Whether pieces depend on nothing but letters, parameters, the vertical and steps: no contexts, no chance, no cutting,
/// nothing that bends towards directions of the model, and no rewritten module or image that ends on another branch than it began on.
pub(crate) fn memoises<S: Space>(rules: &Rules, score: &Score<S>) -> bool {
    let bends = |op: &Op<S>| matches!(op, Op::Bend(_));
    let (letters, ops) = (rules.by_letter.len(), |letter: usize| score.ops[letter].iter());
    // Images stand for themselves, and rewritten modules for what they become.
    let apart = |letter: usize| !rules.by_letter[letter].is_empty() || !rules.images[letter].is_empty();
    let inside = |word: &Template| {
        let kept = word.letters.iter().map(|&letter| usize::from(letter)).filter(|&letter| !apart(letter));
        is_balanced(kept.flat_map(ops))
    };
    let shown = |word: &Template| is_balanced(word.letters.iter().flat_map(|&letter| ops(usize::from(letter))));
    // What a module of its own does depends on more than its numbers; polygons are made letter by letter.
    let fills = |op: &Op<S>| matches!(op, Op::OpenPolygon | Op::ClosePolygon);
    let special = score.is_personal() || score.shrinking != 1.0 || score.ops.iter().flatten().any(fills);
    let decided_elsewhere = special || rules.is_random() || rules.is_cutting() || score.ops.iter().flatten().any(bends);
    !decided_elsewhere
        && rules.by_letter.iter().flatten().all(|rule| !rule.is_context_sensitive() && inside(&rule.successor))
        && rules.images.iter().flatten().all(|image| shown(&image.successor))
        && (0..letters).all(|letter| !apart(letter) || is_balanced(ops(letter)))
        && vertical::is_known(rules, score)
}

/// A drawing in the making: plans the states from the axiom on, then makes their pieces from the last step back.
#[derive(Clone, Debug)]
pub(crate) struct Parametric<S: Space> {
    rules: Rules,
    keys: Keys,
    scales: Scales,
    /// By letter, whether its pieces look to the vertical; none where nothing does.
    lookers: Vec<bool>,
    n: u32,
    /// The axiom.
    top: Range<u32>,
    /// By derivation step: the states that are rewritten in it.
    levels: Vec<Vec<State>>,
    parts: Vec<Part>,
    arguments: Vec<f64>,
    states: usize,
    /// Of the level in the making: its parts that will be states of the next.
    open: Vec<Open>,
    /// What is done of the level in the making.
    done: usize,
    /// While pieces are made: those of the level below, and of this one.
    pieces: Option<[Vec<Made<S>>; 2]>,
    deeds: Vec<Deed<S>>,
}

/// A module to be rewritten.
#[derive(Clone, Debug)]
struct State {
    letter: LetterId,
    /// The vertical in its frame, where it looks to that.
    tilt: Tilt,
    /// Where its arguments start.
    argument: u32,
    /// What it becomes.
    parts: Range<u32>,
}

/// A module of a successor or of the axiom.
#[derive(Clone, Copy, Debug)]
enum Part {
    /// It acts as it is; where its arguments start.
    Module(LetterId, u32),
    /// It is this state of the next step, so many times as long.
    State(u32, f64),
}

/// A module that waits for its state: letter, the keys of its arguments, the vertical, its part.
type Open = (LetterId, [u64; crate::MAX_PARAMETERS], Tilt, u32);

/// A state's piece, and how many symbols it is made of.
type Made<S> = (Piece<S>, u128);

/// What the turtle does one after the other.
#[derive(Clone, Copy, Debug)]
enum Deed<S: Space> {
    Op(Op<S>),
    Piece(Piece<S>, f64),
}

/// What came of working on.
pub(crate) enum Outcome {
    /// The work allowed is done; there is more.
    Paused,
    /// The root of the drawing, and the symbols of its generation.
    Ended(Option<BlockId>, u128),
    /// There are too many states; this is the largest n with few enough.
    TooMany(Option<u32>),
    Failed(Diagnostic),
}

impl<S: Space> Parametric<S> {
    /// Ready to draw generation `n` from the axiom on.
    pub(crate) fn new(
        rules: &Rules,
        (turtle, score): (&Turtle, &Score<S>),
        seed: u32,
        limits: &Limits,
        n: u32,
    ) -> Result<Self, Diagnostic> {
        let lookers = vertical::lookers(rules, score);
        let mut new = Self {
            keys: Keys::new(rules),
            scales: Scales::new(rules, turtle),
            lookers: if lookers.contains(&true) { lookers } else { vec![] },
            rules: rules.clone(),
            n,
            top: 0..0,
            levels: vec![],
            parts: vec![],
            arguments: vec![],
            states: 0,
            open: vec![],
            done: 0,
            pieces: None,
            deeds: vec![],
        };
        // The axiom's arguments are computed as everywhere.
        let started = crate::Rewriter::new(rules.clone(), seed, *limits);
        let started = started.map_err(|error| fault(rules, error, 0, limits, None))?;
        let word = started.word();
        new.arguments.extend_from_slice(&word.arguments);
        let course = Course::new(start::<S>(turtle), S::UPWARDS);
        new.top = new.place((turtle, score), &word.letters, 0, n, course);
        new.close();
        Ok(new)
    }

    /// The rules it derives by.
    pub(crate) fn rules(&self) -> &Rules {
        &self.rules
    }

    /// Works on for as many letters as the meter allows.
    pub(crate) fn step(
        &mut self,
        (turtle, score): (&Turtle, &Score<S>),
        builder: &mut Builder<S>,
        limits: &Limits,
        meter: &mut Meter,
    ) -> Outcome {
        if self.pieces.is_none() {
            return self.plan((turtle, score), limits, meter);
        }
        let Some(level) = self.levels.last() else {
            return match self.piece((turtle, score), builder, self.top.clone(), (start::<S>(turtle), S::UPWARDS)) {
                Ok((piece, symbols)) => Outcome::Ended(piece.block, symbols),
                Err(diagnostic) => Outcome::Failed(diagnostic),
            };
        };
        match level.get(self.done) {
            Some(state) => {
                let (parts, vertical) = (state.parts.clone(), vertical_of(&state.tilt));
                meter.charge(S::ITEM * (1 + parts.len() as u64));
                match (self.piece((turtle, score), builder, parts, (S::AHEAD, vertical)), &mut self.pieces) {
                    (Ok(made), Some([_, here])) => here.push(made),
                    (Err(diagnostic), _) => return Outcome::Failed(diagnostic),
                    (Ok(_), None) => {}
                }
                self.done += 1;
            }
            None => {
                meter.charge(1);
                self.levels.pop();
                self.done = 0;
                if let Some([below, here]) = &mut self.pieces {
                    *below = core::mem::take(here);
                }
            }
        }
        Outcome::Paused
    }

    /// Goes on with the plan.
    fn plan(&mut self, with: (&Turtle, &Score<S>), limits: &Limits, meter: &mut Meter) -> Outcome {
        let steps = self.levels.len() as u32;
        let Some(state) = self.levels.last().and_then(|level| level.get(self.done)) else {
            meter.charge(1 + self.open.len() as u64);
            // All states of the axiom are in the first level.
            if steps == 0 || steps >= self.n || self.open.is_empty() {
                self.done = 0;
                self.pieces = Some([vec![], vec![]]);
            } else {
                self.close();
            }
            return Outcome::Paused;
        };
        if self.states > STATES || self.parts.len() as u64 > limits.segments {
            return Outcome::TooMany(steps.checked_sub(1));
        }
        let Self { rules, arguments, .. } = self;
        let (letter, from) = (state.letter, state.argument as usize);
        let course = Course::new(S::AHEAD, vertical_of(&state.tilt));
        let own = from..from + usize::from(rules.letters[usize::from(letter)].arity);
        let parts = match applying(&rules.by_letter[usize::from(letter)], &arguments[own.clone()]) {
            None => self.place(with, &[letter], from, self.n - steps, course),
            Some(rule) => {
                let (made, production) = (make(rule, own, arguments), rule.production);
                let letters = rule.successor.letters.clone();
                if arguments[made..].iter().any(|number| !number.is_finite()) {
                    let error = Fault::NotFinite(Some(production));
                    return Outcome::Failed(fault(rules, error, steps - 1, limits, None));
                }
                self.place(with, &letters, made, self.n - steps, course)
            }
        };
        meter.charge(1 + parts.len() as u64);
        if let Some(state) = self.levels.last_mut().and_then(|level| level.get_mut(self.done)) {
            state.parts = parts;
        }
        self.done += 1;
        Outcome::Paused
    }

    /// Appends parts: modules whose arguments start at `argument`, with `depth` steps to go.
    fn place(
        &mut self,
        with: (&Turtle, &Score<S>),
        letters: &[LetterId],
        mut argument: usize,
        depth: u32,
        mut course: Course<S>,
    ) -> Range<u32> {
        let mut deeds = core::mem::take(&mut self.deeds);
        let first = self.parts.len() as u32;
        for &letter in letters {
            let arity = usize::from(self.rules.letters[usize::from(letter)].arity);
            if depth > 0 && !self.rules.by_letter[usize::from(letter)].is_empty() {
                let Self { keys, scales, lookers, parts, arguments, open, .. } = self;
                let own = &mut arguments[argument..argument + arity];
                let scale = scales.take(letter, own);
                let looks = lookers.get(usize::from(letter)).is_some_and(|&looks| looks);
                let tilt = if looks { course.tilt() } else { Tilt::default() };
                open.push((letter, keys.of(letter, own, scales), tilt, parts.len() as u32));
                parts.push(Part::State(argument as u32, scale));
            } else {
                if !self.lookers.is_empty() {
                    deeds.clear();
                    // What cannot be computed is told of when pieces are made.
                    let _ = self.act(with, letter, argument, &mut deeds);
                    for deed in &deeds {
                        if let Deed::Op(op) = deed {
                            course.follow(op);
                        }
                    }
                }
                self.parts.push(Part::Module(letter, argument as u32));
            }
            argument += arity;
        }
        self.deeds = deeds;
        first..self.parts.len() as u32
    }

    /// Makes a level of what is open: of those with equal keys the first in the order of the word stands for all.
    fn close(&mut self) {
        sort(&mut self.open);
        let mut level: Vec<State> = Vec::new();
        let mut last = None;
        for &(letter, key, tilt, part) in &self.open {
            let Part::State(argument, scale) = self.parts[part as usize] else { continue };
            if last.replace((letter, key, tilt)) != Some((letter, key, tilt)) {
                level.push(State { letter, tilt, argument, parts: 0..0 });
            }
            self.parts[part as usize] = Part::State(level.len() as u32 - 1, scale);
        }
        self.open.clear();
        self.states += level.len();
        self.levels.push(level);
        self.done = 0;
    }

    /// Makes the piece of some parts. The turtle enters with `heading`, in a frame with that `vertical`.
    fn piece(
        &mut self,
        (turtle, score): (&Turtle, &Score<S>),
        builder: &mut Builder<S>,
        parts: Range<u32>,
        (heading, vertical): (S::Turn, S::Point),
    ) -> Result<Made<S>, Diagnostic> {
        let mut symbols = 0_u128;
        let mut deeds = core::mem::take(&mut self.deeds);
        deeds.clear();
        for part in &self.parts[parts.start as usize..parts.end as usize] {
            match *part {
                Part::Module(letter, argument) => {
                    symbols = symbols.saturating_add(1);
                    let acted = self.act((turtle, score), letter, argument as usize, &mut deeds);
                    // Images count as a step of their own.
                    acted.map_err(|error| fault(&self.rules, error, self.n, &Limits::default(), None))?;
                }
                Part::State(state, scale) => {
                    let below = self.pieces.as_ref().and_then(|[below, _]| below.get(state as usize));
                    if let Some((piece, inside)) = below {
                        symbols = symbols.saturating_add(*inside);
                        deeds.push(Deed::Piece(*piece, scale));
                    }
                }
            }
        }
        let unit = |deed: &Deed<S>| match deed {
            Deed::Op(Op::Draw(length) | Op::Move(length)) if *length != 0.0 => {
                Some(score.exponent.saturating_add(exponent_of(*length)))
            }
            Deed::Op(_) => None,
            Deed::Piece(piece, scale) => exponent(builder, piece).map(|own| own.saturating_add(exponent_of(*scale))),
        };
        let unit = deeds.iter().filter_map(unit).max().unwrap_or(0);
        let scale = libm::scalbn(1.0, score.exponent.saturating_sub(unit));
        let mut pen = Pen { vertical, ..Pen::new(heading, StyleChange::NONE) };
        let (mut saved, mut sheet) = (Vec::new(), Sheet::new());
        for deed in &deeds {
            match deed {
                Deed::Op(op) => {
                    let Builder { styles, directions, vertices, .. } = builder;
                    let mut desk = Desk { sheet: &mut sheet, styles, vertices };
                    pen.act(&[*op], &mut saved, scale, directions, &mut desk);
                }
                Deed::Piece(piece, scale) => {
                    if let Some(block) = piece.block {
                        sheet.items.push(Item::Block(place(builder, block, &pen, unit, *scale)));
                    }
                    follow(builder, &mut pen, &piece.effect, unit, *scale);
                }
            }
        }
        self.deeds = deeds;
        let block = builder.block(&sheet.items, unit);
        Ok((Piece { block, effect: effect(&pen, unit) }, symbols))
    }

    /// Appends what a module, or its image, does.
    fn act(
        &self,
        (turtle, score): (&Turtle, &Score<S>),
        letter: LetterId,
        argument: usize,
        deeds: &mut Vec<Deed<S>>,
    ) -> Result<(), Fault> {
        let arity = |letter: LetterId| usize::from(self.rules.letters[usize::from(letter)].arity);
        let own = argument..argument + arity(letter);
        let mut one = |letter: LetterId, arguments: &[f64]| {
            deeds.extend(score.ops_of(turtle, usize::from(letter), arguments.first().copied()).map(Deed::Op));
        };
        match applying(&self.rules.images[usize::from(letter)], &self.arguments[own.clone()]) {
            None => one(letter, &self.arguments[own]),
            Some(image) => {
                let mut codes = image.successor.arguments.iter();
                for &letter in &image.successor.letters {
                    let slots = &self.arguments[own.clone()];
                    let arguments: Vec<f64> =
                        codes.by_ref().take(arity(letter)).map(|code| code.value(slots, &|_| 0.0)).collect();
                    if arguments.iter().any(|number| !number.is_finite()) {
                        return Err(Fault::NotFinite(Some(image.production)));
                    }
                    one(letter, &arguments);
                }
            }
        }
        Ok(())
    }
}

/// Appends the arguments of what `rule` makes with the parameters at `own`; where they start.
fn make(rule: &Rule, own: Range<usize>, arguments: &mut Vec<f64>) -> usize {
    let made = arguments.len();
    for code in &rule.successor.arguments {
        let value = code.value(&arguments[own.clone()], &|_| 0.0);
        arguments.push(value);
    }
    made
}
