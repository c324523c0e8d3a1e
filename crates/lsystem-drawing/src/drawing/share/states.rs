//! Sharing blocks among modules with parameters.
//!
//! A module with the same parameters draws the same piece in the same number of steps, so pieces are made once for each
//! state: letter, parameters, steps. Where lengths only ever scale together, states are equal up to the scale, and a
//! figure has a few of them for each step; otherwise equal numbers are what brings states together. Where a piece looks to
//! the vertical (`$`), that is part of its state as the turtle has it (ABOP figure 2.6 has 4,096 apices in step 12, and few
//! ways in which the vertical lies).

mod write;

use super::letters::{is_balanced, is_filled_at_once};
use super::scales::{Keys, Scales, applying};
use super::vertical::{self, Course, Tilt, vertical_of};
use super::word::Origin;
use crate::Turtle;
use crate::drawing::block::Space;
use crate::drawing::builder::Builder;
use crate::drawing::piece::Piece;
use crate::drawing::pieces::{Pieces, StateWord, StateWords};
use crate::drawing::task::{Made, Outcome, Task};
use crate::room::{bytes_of, reserve};
use crate::style::ColourChange;
use crate::turtle::{Op, Score, heir};
use core::ops::Range;
use lsystem_derive::{Fault, LetterId, Rules, Template, fault};
use lsystem_syntax::{Diagnostic, Limits, Meter};
use std::collections::HashMap;
use std::sync::Arc;
use write::Writing;

/// The most states: some hundred bytes each. More of them than this hardly ever come together.
const STATES: usize = 1 << 16;

/// Whether pieces depend on nothing but letters, parameters, the vertical and steps: no contexts, no chance, no cutting,
/// nothing that bends towards directions of the model, no rewritten module or image that ends on another branch than it
/// began on, and no polygon that is made by more than one production.
pub(super) fn memoises<S: Space>(rules: &Rules, score: &Score<S>) -> bool {
    let bends = |op: &Op<S>| matches!(op, Op::Bend(_));
    let (letters, ops) = (rules.by_letter.len(), |letter: usize| score.ops[letter].as_slice());
    // Images stand for themselves, and rewritten modules for what they become.
    let is_rewritten = |letter: usize| !rules.by_letter[letter].is_empty();
    let apart = |letter: usize| is_rewritten(letter) || !rules.images[letter].is_empty();
    let own = |letter: usize| if apart(letter) { &[] } else { ops(letter) };
    let filled = |word: &Template| {
        let members = word.letters.iter().map(|&letter| usize::from(letter));
        is_filled_at_once(members.map(|letter| (!is_rewritten(letter)).then(|| own(letter))))
    };
    let inside =
        |word: &Template| is_balanced(word.letters.iter().flat_map(|&letter| own(usize::from(letter)))) && filled(word);
    let alone = |ops: &[Op<S>]| is_balanced(ops) && is_filled_at_once([Some(ops)]);
    let shown = |word: &Template| {
        alone(&word.letters.iter().flat_map(|&letter| ops(usize::from(letter))).copied().collect::<Vec<_>>())
    };
    let deeds = |word: &Template| word.letters.iter().map(|&letter| 1 + ops(usize::from(letter)).len()).sum::<usize>();
    let special = score.varies() || score.ops.iter().flatten().any(bends);
    let decided_elsewhere = special || rules.is_random() || rules.is_cutting();
    !decided_elsewhere
        && filled(&rules.axiom)
        && rules.by_letter.iter().flatten().all(|rule| !rule.is_context_sensitive() && inside(&rule.successor))
        && rules.images.iter().flatten().all(|image| deeds(&image.successor) <= IMAGE && shown(&image.successor))
        && (0..letters).all(|letter| !apart(letter) || alone(ops(letter)))
        && vertical::is_known(rules, score)
}

/// A drawing in the making: plans the states from the axiom on, then makes their pieces from the last step back.
#[derive(Clone, Debug)]
pub(crate) struct States<S: Space> {
    rules: Arc<Rules>,
    keys: Keys,
    scales: Scales,
    /// By letter, whether its pieces look to the vertical; none where nothing does.
    lookers: Vec<bool>,
    n: u32,
    /// How many parts there may be.
    most: u64,
    /// The axiom.
    top: Range<u32>,
    /// By derivation step: the states that are rewritten in it.
    levels: Vec<Vec<State>>,
    parts: Vec<Part>,
    arguments: Vec<f64>,
    states: usize,
    /// Of the level in the making: the states of the next, and where those with some keys are.
    next: Vec<State>,
    met: HashMap<Keyed, u32>,
    /// Whether there are too many states; no more of them are kept then.
    is_crowded: bool,
    /// What is done of the level in the making.
    done: usize,
    /// The word whose parts are being found.
    planning: Option<Planning<S>>,
    /// While pieces are made: those of the level below, and of this one.
    pieces: Option<[Vec<Counted<S>>; 2]>,
    /// The piece that is being made.
    writing: Option<Box<Writing<S>>>,
    deeds: Vec<Deed<S>>,
    /// By letter, whether it shows anything, where that tells what goes on in another's place and does not grow.
    shows: Vec<bool>,
    /// The words of the states; only where there are polygons, to find the symbol that opens one.
    words: Option<StateWords>,
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
    /// It is rewritten, and this state of the next step, so many times as long.
    State(LetterId, u32, f64),
}

impl Part {
    fn letter(&self) -> LetterId {
        match *self {
            Self::Module(letter, _) | Self::State(letter, ..) => letter,
        }
    }

    /// The state of a module that is rewritten.
    fn state(&self) -> Option<u32> {
        match *self {
            Self::Module(..) => None,
            Self::State(_, state, _) => Some(state),
        }
    }
}

/// What tells states apart: letter, the keys of the arguments, the vertical.
type Keyed = (LetterId, [u64; lsystem_syntax::MAX_PARAMETERS], Tilt);

/// A word whose parts are being found.
#[derive(Clone, Debug)]
struct Planning<S: Space> {
    letters: Vec<LetterId>,
    /// The letters done.
    done: usize,
    /// Where the arguments of the next letter start.
    argument: usize,
    /// Where they must be computed yet: the letter that is rewritten and which of its rules does that, where the
    /// arguments of that letter are, and which of the successor's comes next.
    made: Option<(LetterId, usize, Range<usize>, usize)>,
    /// The first of the parts.
    first: u32,
    /// The steps to go.
    depth: u32,
    course: Course<S>,
}

/// Images of more letters and deeds are not shared: there are more than can be held.
const IMAGE: usize = 2 * 4096;

/// A state's piece, and how many symbols it is made of.
type Counted<S> = (Piece<S>, u128);

/// What the turtle does one after the other.
#[derive(Clone, Copy, Debug)]
enum Deed<S: Space> {
    Op(Op<S>),
    /// The index in the word of the module that the next deeds belong to; only where there are polygons.
    Place(u32),
    /// The colour that tells when what follows was made.
    Date(ColourChange),
    Piece(Piece<S>, f64),
}

impl<S: Space> States<S> {
    /// Ready to draw generation `n` from the axiom on.
    pub(super) fn new(task: &Task<S>) -> Result<Self, Diagnostic> {
        let Task { rules, turtle, score, seed, n, limits } = task;
        let n = *n;
        let lookers = vertical::lookers(rules, score);
        let mut new = Self {
            keys: Keys::new(rules),
            scales: Scales::new(rules, turtle),
            lookers: if lookers.contains(&true) { lookers } else { vec![] },
            rules: rules.clone(),
            n,
            most: task.most_letters().0,
            top: 0..0,
            levels: vec![],
            parts: vec![],
            arguments: vec![],
            states: 0,
            next: vec![],
            met: HashMap::new(),
            is_crowded: false,
            done: 0,
            planning: None,
            pieces: None,
            writing: None,
            deeds: vec![],
            shows: if score.growth < 1.0 { score.shows(rules) } else { vec![] },
            words: score.fills().then(StateWords::default),
        };
        // The axiom's arguments are computed as everywhere.
        let started = lsystem_derive::Rewriter::new(rules.clone(), *seed, *limits);
        let started = started.map_err(|error| fault(rules, error, 0, limits, None))?;
        let word = started.word();
        new.arguments.extend_from_slice(&word.arguments);
        let (letters, course) = (word.letters.clone(), Course::new(turtle.start_turn::<S>(), S::UPWARDS));
        let planning = Planning { letters, done: 0, argument: 0, made: None, first: 0, depth: n, course };
        new.planning = Some(planning);
        Ok(new)
    }

    /// The bytes that it takes.
    pub(super) fn bytes(&self) -> u64 {
        let planning = self.planning.as_ref().map_or(0, |planning| bytes_of(&planning.letters));
        let writing = self.writing.as_ref().map_or(0, |writing| writing.bytes());
        // A hash map leaves an eighth of its places free.
        let met = self.met.capacity() / 7 * 8 * size_of::<(Keyed, u32)>();
        let states = self.states * size_of::<State>();
        let pieces = self.pieces.iter().flatten().map(bytes_of).sum::<u64>();
        planning
            + writing
            + pieces
            + (met + states) as u64
            + bytes_of(&self.parts)
            + bytes_of(&self.arguments)
            + bytes_of(&self.deeds)
            + self.words.as_ref().map_or(0, StateWords::bytes)
    }

    /// Works on until the meter is spent.
    pub(super) fn step(&mut self, task: &Task<S>, builder: &mut Builder<S>, meter: &mut Meter) -> Outcome<Made<S>> {
        let Task { turtle, score, limits, .. } = task;
        if self.pieces.is_none() {
            return self.plan((turtle, score), limits, meter);
        }
        let is_top = self.levels.is_empty();
        let step = self.levels.len() as u32;
        let begun = match self.levels.last().map(|level| level.get(self.done)) {
            None => {
                let origin = Origin { former: None, step };
                (self.top.clone(), origin, (turtle.start_turn::<S>(), S::UPWARDS))
            }
            Some(Some(state)) => {
                let origin = Origin { former: Some(state.letter), step };
                (state.parts.clone(), origin, (S::AHEAD, vertical_of(&state.tilt)))
            }
            Some(None) => {
                self.close_pieces(meter);
                return Outcome::Paused;
            }
        };
        let mut writing = self.writing.take().unwrap_or_else(|| {
            let (parts, origin, way) = begun;
            Box::new(Writing::new(parts.clone(), origin, self.young(parts, &origin, meter), way))
        });
        match self.write(&mut writing, (turtle, score), builder, meter) {
            Err(diagnostic) => return Outcome::Failed(diagnostic),
            Ok(None) => self.writing = Some(writing),
            Ok(Some((piece, symbols))) if is_top => {
                let symbols = u64::try_from(symbols).ok();
                return Outcome::Ended(Made { root: piece.block, pieces: self.made_of(), symbols });
            }
            Ok(Some(made)) => {
                if let Some([_, here]) = &mut self.pieces {
                    here.push(made);
                }
                self.done += 1;
            }
        }
        Outcome::Paused
    }

    /// Goes on to the level above.
    fn close_pieces(&mut self, meter: &mut Meter) {
        self.done = 0;
        let (Some(level), Some([below, here])) = (self.levels.pop(), &mut self.pieces) else { return };
        meter.charge(1 + level.len() as u64 / 4);
        if let Some(words) = &mut self.words {
            let word = |(state, made): (&State, &Counted<S>)| StateWord {
                modules: state.parts.clone(),
                block: made.0.block,
                symbols: made.1,
            };
            words.levels.push(level.iter().zip(here.iter()).map(word).collect());
        }
        *below = core::mem::take(here);
    }

    /// The words of all states, when all pieces are made.
    fn made_of(&mut self) -> Pieces<S> {
        let axiom = self.top.clone();
        self.words.take().map_or(Pieces::None, |words| Pieces::States(StateWords { axiom, ..words }))
    }

    /// For a piece of the last step, under growth: its one part that is not new, if any; all others are still growing. `None`
    /// for every other piece.
    fn young(&self, parts: Range<u32>, origin: &Origin, meter: &mut Meter) -> Option<Option<u32>> {
        let former = origin.former.filter(|_| !self.shows.is_empty() && origin.step == self.n)?;
        meter.charge(parts.len() as u64 / 4);
        let first = parts.start;
        let letters = self.parts[parts.start as usize..parts.end as usize].iter().map(Part::letter);
        Some(heir(former, letters, |letter| self.shows[usize::from(letter)]).map(|at| first + at as u32))
    }

    /// Goes on with the plan.
    fn plan(&mut self, with: (&Turtle, &Score<S>), limits: &Limits, meter: &mut Meter) -> Outcome<Made<S>> {
        let steps = self.levels.len() as u32;
        if self.planning.is_none() {
            meter.charge(1);
            let Some(state) = self.levels.last().and_then(|level| level.get(self.done)) else {
                // All states of the axiom are in the first level.
                if steps >= self.n || self.next.is_empty() {
                    self.done = 0;
                    self.pieces = Some([vec![], vec![]]);
                } else {
                    self.close();
                }
                return Outcome::Paused;
            };
            if self.is_crowded {
                return Outcome::Apart(steps.checked_sub(1));
            }
            let (letter, from) = (state.letter, state.argument as usize);
            let course = Course::new(S::AHEAD, vertical_of(&state.tilt));
            self.planning = Some(self.planned(letter, from, self.n - steps, course));
        }
        match self.find((with, limits), meter) {
            Err(()) => return Outcome::Apart(steps.checked_sub(1)),
            Ok(Some(diagnostic)) => return Outcome::Failed(diagnostic),
            Ok(None) => {}
        }
        let Some(planning) = self.planning.take_if(|planning| planning.done == planning.letters.len()) else {
            return Outcome::Paused;
        };
        let parts = planning.first..self.parts.len() as u32;
        match self.levels.last_mut() {
            None => {
                self.top = parts;
                self.close();
            }
            Some(level) => {
                if let Some(state) = level.get_mut(self.done) {
                    state.parts = parts;
                }
                self.done += 1;
            }
        }
        Outcome::Paused
    }

    /// What becomes of a letter whose arguments start at `from`, with `depth` steps to go.
    fn planned(&self, letter: LetterId, from: usize, depth: u32, course: Course<S>) -> Planning<S> {
        let Self { rules, arguments, parts, .. } = self;
        let own = from..from + usize::from(rules.letters[usize::from(letter)].arity);
        let first = parts.len() as u32;
        let productions = &rules.by_letter[usize::from(letter)];
        let rule = applying(productions, &arguments[own.clone()]);
        let at = rule.and_then(|rule| productions.iter().position(|production| core::ptr::eq(production, rule)));
        let (letters, argument, made) = match (rule, at) {
            (Some(rule), Some(at)) => (rule.successor.letters.clone(), arguments.len(), Some((letter, at, own, 0))),
            _ => (vec![letter], from, None),
        };
        Planning { letters, done: 0, argument, made, first, depth, course }
    }

    /// Appends parts of the word that is being planned, until the meter is spent; an error where there are too many. Where
    /// a number cannot be computed, what there is to say.
    fn find(
        &mut self,
        (with, limits): ((&Turtle, &Score<S>), &Limits),
        meter: &mut Meter,
    ) -> Result<Option<Diagnostic>, ()> {
        let Some(mut planning) = self.planning.take() else { return Ok(None) };
        let mut deeds = core::mem::take(&mut self.deeds);
        while let Some(&letter) = planning.letters.get(planning.done) {
            if meter.is_spent() {
                break;
            }
            if self.parts.len() as u64 > self.most {
                return Err(());
            }
            let arity = usize::from(self.rules.letters[usize::from(letter)].arity);
            meter.charge(2 + arity as u64);
            if let Some((former, rule, own, code)) = &mut planning.made {
                let rule = &self.rules.by_letter[usize::from(*former)][*rule];
                for made in &rule.successor.arguments[*code..*code + arity] {
                    let value = made.value(&self.arguments[own.clone()], &|_| 0.0);
                    if !value.is_finite() {
                        let error = Fault::NotFinite(Some(rule.production));
                        let steps = self.levels.len() as u32;
                        return Ok(Some(fault(&self.rules, error, steps.saturating_sub(1), limits, None)));
                    }
                    reserve(&mut self.arguments, 1);
                    self.arguments.push(value);
                }
                *code += arity;
            }
            reserve(&mut self.parts, 1);
            let part = self.part(with, letter, &mut planning, &mut deeds);
            if let Some(words) = &mut self.words {
                reserve(&mut words.modules, 1);
                words.modules.push(part.state());
            }
            self.parts.push(part);
            planning.argument += arity;
            planning.done += 1;
        }
        self.deeds = deeds;
        self.planning = Some(planning);
        Ok(None)
    }

    /// The next part of a word that is being planned.
    fn part(
        &mut self,
        with: (&Turtle, &Score<S>),
        letter: LetterId,
        Planning { argument, depth, course, .. }: &mut Planning<S>,
        deeds: &mut Vec<Deed<S>>,
    ) -> Part {
        if *depth == 0 || self.rules.by_letter[usize::from(letter)].is_empty() {
            if !self.lookers.is_empty() {
                deeds.clear();
                // What cannot be computed is told of when pieces are made.
                let _ = self.act(with, letter, *argument, deeds);
                for deed in deeds {
                    if let Deed::Op(op) = deed {
                        course.follow(op);
                    }
                }
            }
            return Part::Module(letter, *argument as u32);
        }
        let Self { rules, keys, scales, lookers, arguments, next, met, states, is_crowded, .. } = self;
        let arity = usize::from(rules.letters[usize::from(letter)].arity);
        let own = &mut arguments[*argument..*argument + arity];
        let scale = scales.take(letter, own);
        let looks = lookers.get(usize::from(letter)).is_some_and(|&looks| looks);
        let tilt = if looks { course.tilt() } else { Tilt::default() };
        let key = (letter, keys.of(letter, own, scales), tilt);
        // Of those with equal keys the first in the order of the word stands for all.
        let state = match met.get(&key) {
            Some(&state) => state,
            None if *states >= STATES => {
                *is_crowded = true;
                0
            }
            None => {
                let state = next.len() as u32;
                met.insert(key, state);
                next.push(State { letter, tilt, argument: *argument as u32, parts: 0..0 });
                *states += 1;
                state
            }
        };
        Part::State(letter, state, scale)
    }

    /// Begins a level with the states that were found.
    fn close(&mut self) {
        self.met.clear();
        self.levels.push(core::mem::take(&mut self.next));
        self.done = 0;
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
