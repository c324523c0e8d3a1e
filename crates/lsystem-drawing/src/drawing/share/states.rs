//! Sharing blocks among modules with parameters.
//!
//! A module with the same parameters draws the same piece in the same number of steps, so each state (letter,
//! parameters, steps) has one piece. If lengths scale together, states are equal up to a scale, and a figure has a few
//! states for each step. Otherwise only equal numbers make equal states. If a piece uses the vertical (`$`), the
//! direction of the vertical in the turtle's frame is part of the state: ABOP figure 2.6 has 4,096 apices in step 12,
//! but few such directions.

mod write;

use super::letters::{is_balanced, is_filled_at_once};
use super::scales::{Keys, Scales, applying};
use super::vertical::{self, Orientation, Tilt, vertical_of};
use super::word::Origin;
use crate::drawing::block::Space;
use crate::drawing::builder::Builder;
use crate::drawing::piece::{Piece, variants};
use crate::drawing::pieces::{Pieces, StateWord, StateWords};
use crate::drawing::task::{Made, Outcome, Task};
use crate::room::{bytes_of, reserve};
use crate::style::ColourChange;
use crate::turtle::{Score, TurtleOp, continuation};
use core::ops::Range;
use lsystem_base::Meter;
use lsystem_derive::{Fault, LetterId, Rules, Template, between, fault};
use lsystem_syntax::Diagnostic;
use std::collections::HashMap;
use std::sync::Arc;
use write::{Entry, StatePieceWriting};

/// The most states; each takes about 100 bytes. Systems with more states hardly ever repeat them.
const STATES: usize = 1 << 16;

/// Whether pieces depend only on letters, parameters, the vertical and steps. The system must have:
/// - no contexts, no chance, no cutting and no tropism;
/// - balanced branches in every rewritten module, successor and image;
/// - every polygon within one successor or image.
pub(super) fn memoises<S: Space>(rules: &Rules, score: &Score<S>) -> bool {
    let bends = |op: &TurtleOp<S>| matches!(op, TurtleOp::Bend(_));
    let (letters, ops) = (rules.by_letter.len(), |letter: usize| score.ops[letter].as_slice());
    // Rewritten modules and modules with images do not act in a word; their pieces and images are checked separately.
    let is_rewritten = |letter: usize| !rules.by_letter[letter].is_empty();
    let apart = |letter: usize| is_rewritten(letter) || !rules.images[letter].is_empty();
    let own = |letter: usize| if apart(letter) { &[] } else { ops(letter) };
    let filled = |word: &Template| {
        let members = word.letters.iter().map(|&letter| usize::from(letter));
        is_filled_at_once(members.map(|letter| (!is_rewritten(letter)).then(|| own(letter))))
    };
    let inside =
        |word: &Template| is_balanced(word.letters.iter().flat_map(|&letter| own(usize::from(letter)))) && filled(word);
    let alone = |ops: &[TurtleOp<S>]| is_balanced(ops) && is_filled_at_once([Some(ops)]);
    let shown = |word: &Template| {
        alone(&word.letters.iter().flat_map(|&letter| ops(usize::from(letter))).copied().collect::<Vec<_>>())
    };
    let commands =
        |word: &Template| word.letters.iter().map(|&letter| 1 + ops(usize::from(letter)).len()).sum::<usize>();
    let special = score.varies() || score.has_tubes() || score.ops.iter().flatten().any(bends);
    let decided_elsewhere = special || rules.is_random() || rules.is_cutting() || rules.interpreter.is_some();
    !decided_elsewhere
        && filled(&rules.axiom)
        && rules.by_letter.iter().flatten().all(|rule| !rule.is_context_sensitive() && inside(&rule.successor))
        && rules.images.iter().flatten().all(|image| commands(&image.successor) <= IMAGE && shown(&image.successor))
        && (0..letters).all(|letter| !apart(letter) || alone(ops(letter)))
        && vertical::is_known(rules, score)
}

/// A drawing in the making: plans the states from the axiom on, then makes their pieces from the last step back.
#[derive(Clone, Debug)]
pub(crate) struct States<S: Space> {
    rules: Arc<Rules>,
    keys: Keys,
    scales: Scales,
    /// By letter: whether its pieces use the vertical. Empty if no piece does.
    uses_vertical: Vec<bool>,
    n: u32,
    /// The most parts.
    most: u64,
    /// The axiom's range in `parts`.
    top: Range<u32>,
    /// By derivation step: the states that the step rewrites.
    levels: Vec<Vec<State>>,
    /// The modules of the axiom and of all successors.
    parts: Vec<StateModule>,
    /// The arguments of all modules.
    arguments: Vec<f64>,
    /// The number of states in all levels.
    states: usize,
    /// The states of the next level.
    next: Vec<State>,
    /// The indices in `next`, by key.
    state_indices: HashMap<StateKey, u32>,
    /// Whether there are more than [`STATES`] states. Further states are not kept.
    has_too_many_states: bool,
    /// The number of states planned, and later of pieces made, in the present level.
    done: usize,
    /// As [`variants`].
    variants: usize,
    /// The word whose parts are being found.
    planning: Option<Planning<S>>,
    /// The pieces of the level below and of the present level, with [`States::variants`] of each state; `None` during
    /// planning.
    pieces: Option<[Vec<CountedPiece<S>>; 2]>,
    /// The next piece, in the making.
    writing: Option<Box<StatePieceWriting<S>>>,
    /// A reusable buffer.
    commands: Vec<TurtleCommand<S>>,
    /// By letter: whether it or an image draws, to find the module that continues another under growth. Empty without
    /// growth.
    shows: Vec<bool>,
    /// The words of the states, to find the symbol that opens a polygon; only in systems with polygons.
    words: Option<StateWords>,
}

/// A module to be rewritten.
#[derive(Clone, Debug)]
struct State {
    letter: LetterId,
    /// The vertical in the module's frame; 0 if its piece does not use the vertical.
    tilt: Tilt,
    /// The index of the first argument.
    argument: u32,
    /// The successor's range in [`States::parts`].
    parts: Range<u32>,
}

/// A module of a successor or of the axiom.
#[derive(Clone, Copy, Debug)]
enum StateModule {
    /// A module that is not rewritten: letter, and index of the first argument.
    Module(LetterId, u32),
    /// A module that is rewritten: letter, index of the state in the next level, and scale of its lengths.
    State(LetterId, u32, f64),
}

impl StateModule {
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

/// The identity of a state in a level: letter, keys of the arguments, vertical.
type StateKey = (LetterId, [u64; lsystem_base::MAX_PARAMETERS], Tilt);

/// A word whose parts are being found.
#[derive(Clone, Debug)]
struct Planning<S: Space> {
    letters: Vec<LetterId>,
    /// The number of letters done.
    done: usize,
    /// The index of the next letter's first argument.
    argument: usize,
    /// If the arguments are still to be computed: the predecessor, the index of its production, the range of its
    /// arguments, and the index of the successor's next argument.
    made: Option<(LetterId, usize, Range<usize>, usize)>,
    /// Whether a module may still come whose numbers grow from those of the predecessor.
    blends: bool,
    /// The index of the word's first part.
    first: u32,
    /// The number of derivation steps left.
    depth: u32,
    /// The turtle's orientation after the letters done.
    orientation: Orientation<S>,
}

/// The most letters and operations of an image in a shared drawing: one buffer holds all commands of an image.
const IMAGE: usize = 2 * 4096;

/// A state's piece, and the number of symbols in its derivation.
type CountedPiece<S> = (Piece<S>, u128);

/// A command to the turtle.
#[derive(Clone, Copy, Debug)]
enum TurtleCommand<S: Space> {
    Op(TurtleOp<S>),
    /// The index in the word of the module of the next commands; only in systems with polygons.
    Place(u32),
    /// The colour of the next commands, by generation.
    Colour(ColourChange),
    /// Place the piece of a state of the level below, times a scale.
    State(u32, f64),
}

impl<S: Space> States<S> {
    /// Prepares to draw from the axiom on.
    pub(super) fn new(task: &Task<S>) -> Result<Self, Diagnostic> {
        let Task { rules, turtle, score, seed, n, limits } = task;
        let n = *n;
        let uses_vertical = vertical::uses_vertical(rules, score);
        let mut new = Self {
            keys: Keys::new(rules),
            scales: Scales::new(rules, turtle),
            uses_vertical: if uses_vertical.contains(&true) { uses_vertical } else { vec![] },
            rules: rules.clone(),
            n,
            most: task.most_letters().0,
            top: 0..0,
            levels: vec![],
            parts: vec![],
            arguments: vec![],
            states: 0,
            next: vec![],
            state_indices: HashMap::new(),
            has_too_many_states: false,
            done: 0,
            variants: variants(score),
            planning: None,
            pieces: None,
            writing: None,
            commands: vec![],
            shows: if score.growth < 1.0 { score.shows(rules) } else { vec![] },
            words: score.fills().then(StateWords::default),
        };
        // A rewriter computes the axiom's arguments.
        let started = lsystem_derive::Rewriter::new(rules.clone(), *seed, *limits);
        let started = started.map_err(|error| fault(rules, error, 0, limits, None))?;
        let word = started.word();
        new.arguments.extend_from_slice(&word.arguments);
        let (heading, vertical) = turtle.start::<S>();
        let (letters, orientation) = (word.letters.clone(), Orientation::new(heading, vertical));
        let planning =
            Planning { letters, done: 0, argument: 0, made: None, blends: false, first: 0, depth: n, orientation };
        new.planning = Some(planning);
        Ok(new)
    }

    /// The bytes that the work occupies, without the builder.
    pub(super) fn bytes(&self) -> u64 {
        let planning = self.planning.as_ref().map_or(0, |planning| bytes_of(&planning.letters));
        let writing = self.writing.as_ref().map_or(0, |writing| writing.bytes());
        // A hash map leaves an eighth of its places free.
        let state_indices = self.state_indices.capacity() / 7 * 8 * size_of::<(StateKey, u32)>();
        let states = self.states * size_of::<State>();
        let pieces = self.pieces.iter().flatten().map(bytes_of).sum::<u64>();
        planning
            + writing
            + pieces
            + (state_indices + states) as u64
            + bytes_of(&self.parts)
            + bytes_of(&self.arguments)
            + bytes_of(&self.commands)
            + self.words.as_ref().map_or(0, StateWords::bytes)
    }

    /// Continues until the meter is spent.
    pub(super) fn step(&mut self, task: &Task<S>, builder: &mut Builder<S>, meter: &mut Meter) -> Outcome<Made<S>> {
        if self.pieces.is_none() {
            return self.plan(task, meter);
        }
        let is_top = self.levels.is_empty();
        let step = self.levels.len() as u32;
        let begun = match self.levels.last().map(|level| level.get(self.done / self.variants)) {
            None => {
                let origin = Origin { former: None, step };
                let (heading, vertical) = task.turtle.start::<S>();
                let entry = Entry { heading, vertical, swapped: false };
                (self.top.clone(), origin, entry)
            }
            Some(Some(state)) => {
                let origin = Origin { former: Some(state.letter), step };
                let swapped = self.done % self.variants == 1;
                let entry = Entry { heading: S::AHEAD, vertical: vertical_of(&state.tilt), swapped };
                (state.parts.clone(), origin, entry)
            }
            Some(None) => {
                self.close_pieces(meter);
                return Outcome::Paused;
            }
        };
        let mut writing = self.writing.take().unwrap_or_else(|| {
            let (parts, origin, entry) = begun;
            Box::new(StatePieceWriting::new(parts.clone(), origin, self.fully_grown(parts, &origin, meter), entry))
        });
        match self.write(&mut writing, task, builder, meter) {
            Err(diagnostic) => return Outcome::Failed(diagnostic),
            Ok(None) => self.writing = Some(writing),
            Ok(Some((piece, symbols))) if is_top => {
                let symbols = u64::try_from(symbols).ok();
                return Outcome::Ended(Made { root: piece.block, pieces: self.take_words(), symbols });
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

    /// Completes a level of pieces and continues with the level above.
    fn close_pieces(&mut self, meter: &mut Meter) {
        self.done = 0;
        let (Some(level), Some([below, here])) = (self.levels.pop(), &mut self.pieces) else { return };
        meter.charge(1 + level.len() as u64 / 4);
        if let Some(words) = &mut self.words {
            let word = |(state, made): (&State, &[CountedPiece<S>])| StateWord {
                modules: state.parts.clone(),
                blocks: [made.first(), made.get(1)].map(|made| made.and_then(|made| made.0.block)),
                symbols: made.first().map_or(0, |made| made.1),
            };
            words.levels.push(level.iter().zip(here.chunks(self.variants)).map(word).collect());
        }
        *below = core::mem::take(here);
    }

    /// Takes the words of all states, after all pieces are made.
    fn take_words(&mut self) -> Pieces<S> {
        let axiom = self.top.clone();
        self.words.take().map_or(Pieces::None, |words| Pieces::States(StateWords { axiom, ..words }))
    }

    /// For a piece of the last step, under growth: the one part that is fully grown, if any; all other parts still
    /// grow. `None` for every other piece.
    fn fully_grown(&self, parts: Range<u32>, origin: &Origin, meter: &mut Meter) -> Option<Option<u32>> {
        let former = origin.former.filter(|_| !self.shows.is_empty() && origin.step == self.n)?;
        meter.charge(parts.len() as u64 / 4);
        let first = parts.start;
        let letters = self.parts[parts.start as usize..parts.end as usize].iter().map(StateModule::letter);
        Some(continuation(former, letters, |letter| self.shows[usize::from(letter)]).map(|at| first + at as u32))
    }

    /// Continues with the plan.
    fn plan(&mut self, task: &Task<S>, meter: &mut Meter) -> Outcome<Made<S>> {
        let steps = self.levels.len() as u32;
        if self.planning.is_none() {
            meter.charge(1);
            let Some(state) = self.levels.last().and_then(|level| level.get(self.done)) else {
                // The present level is complete.
                if steps >= self.n || self.next.is_empty() {
                    self.done = 0;
                    self.pieces = Some([vec![], vec![]]);
                } else {
                    self.close();
                }
                return Outcome::Paused;
            };
            if self.has_too_many_states {
                return Outcome::NotShareable(steps.checked_sub(1));
            }
            let (letter, from) = (state.letter, state.argument as usize);
            let orientation = Orientation::new(S::AHEAD, vertical_of(&state.tilt));
            self.planning = Some(self.planned(letter, from, self.n - steps, orientation));
        }
        match self.find(task, meter) {
            Err(()) => return Outcome::NotShareable(steps.checked_sub(1)),
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

    /// The successor of a letter, ready for planning. The letter's arguments start at `from`; `depth` steps are left.
    fn planned(&self, letter: LetterId, from: usize, depth: u32, orientation: Orientation<S>) -> Planning<S> {
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
        let blends = depth == 0 && !self.shows.is_empty();
        Planning { letters, done: 0, argument, made, blends, first, depth, orientation }
    }

    /// Appends parts of the word that is being planned, until the meter is spent. An error means too many parts. A
    /// diagnostic means that a number is not finite.
    fn find(&mut self, task: &Task<S>, meter: &mut Meter) -> Result<Option<Diagnostic>, ()> {
        let Some(mut planning) = self.planning.take() else { return Ok(None) };
        let mut commands = core::mem::take(&mut self.commands);
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
                let blends = planning.blends && letter == *former;
                planning.blends &= !blends;
                let grown = if blends { task.score.growth } else { 1.0 };
                for (at, made) in rule.successor.arguments[*code..*code + arity].iter().enumerate() {
                    let value = made.value(&self.arguments[own.clone()], &|_| 0.0);
                    if !value.is_finite() {
                        let error = Fault::NotFinite(Some(rule.production));
                        let steps = self.levels.len() as u32;
                        return Ok(Some(fault(&self.rules, error, steps.saturating_sub(1), &task.limits, None)));
                    }
                    reserve(&mut self.arguments, 1);
                    let value = if grown < 1.0 { between(self.arguments[own.start + at], value, grown) } else { value };
                    self.arguments.push(value);
                }
                *code += arity;
            }
            reserve(&mut self.parts, 1);
            let part = self.part(task, letter, &mut planning, &mut commands);
            if let Some(words) = &mut self.words {
                reserve(&mut words.modules, 1);
                words.modules.push(part.state());
            }
            self.parts.push(part);
            planning.argument += arity;
            planning.done += 1;
        }
        self.commands = commands;
        self.planning = Some(planning);
        Ok(None)
    }

    /// The next part of a word that is being planned.
    fn part(
        &mut self,
        task: &Task<S>,
        letter: LetterId,
        Planning { argument, depth, orientation, .. }: &mut Planning<S>,
        commands: &mut Vec<TurtleCommand<S>>,
    ) -> StateModule {
        if *depth == 0 || self.rules.by_letter[usize::from(letter)].is_empty() {
            if !self.uses_vertical.is_empty() {
                commands.clear();
                // A number that is not finite is reported when the piece is made.
                let _ = self.act(task, letter, *argument, commands);
                for command in commands {
                    if let TurtleCommand::Op(op) = command {
                        orientation.follow(op);
                    }
                }
            }
            return StateModule::Module(letter, *argument as u32);
        }
        let Self {
            rules,
            keys,
            scales,
            uses_vertical,
            arguments,
            next,
            state_indices,
            states,
            has_too_many_states,
            ..
        } = self;
        let arity = usize::from(rules.letters[usize::from(letter)].arity);
        let own = &mut arguments[*argument..*argument + arity];
        let scale = scales.take(letter, own);
        let uses = uses_vertical.get(usize::from(letter)).is_some_and(|&uses| uses);
        let tilt = if uses { orientation.tilt() } else { Tilt::default() };
        let key = (letter, keys.of(letter, own, scales), tilt);
        // The first module with a key stands for all with the same key.
        let state = match state_indices.get(&key) {
            Some(&state) => state,
            None if *states >= STATES => {
                *has_too_many_states = true;
                0
            }
            None => {
                let state = next.len() as u32;
                state_indices.insert(key, state);
                next.push(State { letter, tilt, argument: *argument as u32, parts: 0..0 });
                *states += 1;
                state
            }
        };
        StateModule::State(letter, state, scale)
    }

    /// Completes a level of the plan: the states found become the next level.
    fn close(&mut self) {
        self.state_indices.clear();
        self.levels.push(core::mem::take(&mut self.next));
        self.done = 0;
    }

    /// Appends the operations of a module or its image.
    fn act(
        &self,
        Task { turtle, score, .. }: &Task<S>,
        letter: LetterId,
        argument: usize,
        commands: &mut Vec<TurtleCommand<S>>,
    ) -> Result<(), Fault> {
        let arity = |letter: LetterId| usize::from(self.rules.letters[usize::from(letter)].arity);
        let own = argument..argument + arity(letter);
        let mut one = |letter: LetterId, arguments: &[f64]| {
            commands
                .extend(score.ops_of(turtle, usize::from(letter), arguments.first().copied()).map(TurtleCommand::Op));
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
