//! The making of a piece of modules with parameters: the turtle's commands become a block.

use super::{CountedPiece, StateModule, States, TurtleCommand};
use crate::drawing::block::Space;
use crate::drawing::builder::Builder;
use crate::drawing::piece::{Piece, effect, exponent, follow, place};
use crate::drawing::share::word::Origin;
use crate::drawing::taper::Flow;
use crate::drawing::task::Task;
use crate::drawing::tree::{Tree, WORD};
use crate::room::bytes_of;
use crate::space::unit_of;
use crate::style::StyleChange;
use crate::turtle::{Pen, ScaleTrace, Score, scaled};
use core::ops::Range;
use lsystem_base::{Limits, Meter};
use lsystem_derive::fault;
use lsystem_syntax::Diagnostic;

/// A piece in the making.
#[derive(Clone, Debug)]
pub(super) struct StatePieceWriting<S: Space> {
    parts: Range<u32>,
    origin: Origin,
    /// As [`States::fully_grown`].
    fully_grown: Option<Option<u32>>,
    /// The factor of lengths after the parts measured.
    trace: ScaleTrace,
    /// Whether left and right turns are exchanged at entry.
    swapped: bool,
    /// The first part not yet done: parts are measured while `tree` is `None`, then drawn.
    done: u32,
    /// The exponent of the piece's longest length so far.
    unit: Option<i32>,
    /// The number of symbols in the parts measured.
    symbols: u128,
    /// The end of the parts whose commands are in the buffer; `None` if the buffer is not valid.
    held: Option<u32>,
    /// The number of these commands that are drawn.
    drawn: usize,
    /// An upper bound on the number of items.
    weight: usize,
    /// The index in the word of the module that is drawn; only in systems with polygons.
    place: u32,
    pen: Pen<S>,
    saved: Vec<Pen<S>>,
    tree: Option<Tree<S>>,
}

/// The turtle at the start of a piece.
pub(super) struct Entry<S: Space> {
    pub(super) heading: S::Turn,
    /// The vertical in the turtle's frame.
    pub(super) vertical: S::Point,
    /// Whether left and right turns are exchanged.
    pub(super) swapped: bool,
}

/// The number of commands after which the buffer takes no more parts.
const HELD: usize = 4096;

impl<S: Space> States<S> {
    /// Continues with a piece until the meter is spent. Returns the finished piece.
    pub(super) fn write(
        &mut self,
        writing: &mut StatePieceWriting<S>,
        task: &Task<S>,
        builder: &mut Builder<S>,
        meter: &mut Meter,
    ) -> Result<Option<CountedPiece<S>>, Diagnostic> {
        let end = writing.parts.end;
        let mut commands = core::mem::take(&mut self.commands);
        while writing.tree.is_none() && (writing.done < end || writing.weight == 0) {
            let next = self.collect(task, writing, &mut commands)?;
            let charged = writing.measure(builder, &task.score, &commands, |state| self.below(state, false));
            let symbols = (writing.done..next).map(|part| self.symbols_of(part)).fold(0, u128::saturating_add);
            writing.symbols = writing.symbols.saturating_add(symbols);
            writing.held = (writing.done == writing.parts.start && next == end).then_some(end);
            meter.charge(4 + 2 * u64::from(next - writing.done) + charged);
            writing.done = next;
            if meter.is_spent() && writing.held.is_none() {
                self.commands = commands;
                return Ok(None);
            }
        }
        let unit = writing.unit.unwrap_or(0);
        let scale = libm::scalbn(1.0, task.score.exponent.saturating_sub(unit));
        let mut tree = writing.tree.take().unwrap_or_else(|| {
            writing.done = writing.parts.start;
            Tree::of_word(unit, writing.weight > WORD, task.score.tapers)
        });
        while writing.done < end {
            let next = match writing.held {
                Some(next) => next,
                None => self.collect(task, writing, &mut commands)?,
            };
            writing.held = Some(next);
            while let Some(command) = commands.get(writing.drawn).filter(|_| !meter.is_spent() && !builder.is_full) {
                let piece = match *command {
                    TurtleCommand::State(state, scale) => {
                        self.below(state, writing.pen.swapped).map(|(piece, _)| (*piece, scale))
                    }
                    _ => None,
                };
                let work = writing.draw(builder, command, piece, &mut tree, unit, scale);
                writing.drawn += 1;
                // Most of the work is for hulls of blocks that the command completes.
                meter.charge(1 + work + builder.take_work());
            }
            if writing.drawn < commands.len() {
                break;
            }
            (writing.done, writing.held, writing.drawn) = (next, None, 0);
        }
        self.commands = commands;
        let whole = writing.origin.former.is_none();
        let flow = if writing.done == end { tree.end(builder, whole) } else { Flow::default() };
        while writing.done == end && !meter.is_spent() && !builder.is_full {
            let finished = tree.finish_one(builder);
            meter.charge(1 + builder.take_work());
            if let Some(block) = finished {
                let piece = Piece { block, effect: effect(&writing.pen, unit, writing.swapped), flow };
                return Ok(Some((piece, writing.symbols)));
            }
        }
        writing.tree = Some(tree);
        Ok(None)
    }

    /// Replaces `commands` by the commands of the next parts, as many as there is room for. Returns the part after them.
    fn collect(
        &self,
        task: &Task<S>,
        writing: &StatePieceWriting<S>,
        commands: &mut Vec<TurtleCommand<S>>,
    ) -> Result<u32, Diagnostic> {
        commands.clear();
        for number in writing.done..writing.parts.end {
            if commands.len() >= HELD {
                return Ok(number);
            }
            let part = self.parts[number as usize];
            commands.extend(self.words.is_some().then(|| TurtleCommand::Place(number - writing.parts.start)));
            commands.extend(
                task.score
                    .colours_by_generation
                    .then(|| TurtleCommand::Colour(writing.origin.colour_of(part.letter()))),
            );
            match part {
                StateModule::Module(letter, argument) => {
                    let before = commands.len();
                    let acted = self.act(task, letter, argument as usize, commands);
                    // An image counts as a step after generation `n`.
                    acted.map_err(|error| fault(&self.rules, error, self.n, &Limits::default(), None))?;
                    let grows = writing.fully_grown.is_some_and(|continuation| continuation != Some(number));
                    if grows || task.score.has_wind() {
                        commands[before..].iter_mut().for_each(|command| {
                            if let TurtleCommand::Op(op) = command {
                                *op = task.score.changed(*op, grows, writing.origin.step);
                            }
                        });
                    }
                }
                StateModule::State(_, state, scale) => {
                    commands.push(TurtleCommand::State(state, scale));
                }
            }
        }
        Ok(writing.parts.end)
    }

    /// The piece of a state of the level below, usually or while left and right turns are exchanged.
    fn below(&self, state: u32, swapped: bool) -> Option<&CountedPiece<S>> {
        let place = state as usize * self.variants + usize::from(swapped);
        self.pieces.as_ref().and_then(|[below, _]| below.get(place))
    }

    /// The number of symbols in a part's derivation.
    fn symbols_of(&self, part: u32) -> u128 {
        match self.parts[part as usize] {
            StateModule::Module(..) => 1,
            StateModule::State(_, state, _) => self.below(state, false).map_or(0, |(_, symbols)| *symbols),
        }
    }
}

impl<S: Space> StatePieceWriting<S> {
    /// A piece of these parts.
    pub(super) fn new(
        parts: Range<u32>,
        origin: Origin,
        fully_grown: Option<Option<u32>>,
        Entry { heading, vertical, swapped }: Entry<S>,
    ) -> Self {
        Self {
            done: parts.start,
            parts,
            origin,
            fully_grown,
            trace: ScaleTrace::new(),
            swapped,
            unit: None,
            symbols: 0,
            held: None,
            drawn: 0,
            weight: 0,
            place: 0,
            pen: Pen { vertical, swapped, ..Pen::new(heading, StyleChange::NONE) },
            saved: vec![],
            tree: None,
        }
    }

    /// The bytes that the piece in the making occupies.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.saved) + self.trace.bytes() + self.tree.as_ref().map_or(0, Tree::bytes)
    }

    /// Measures the lengths and the number of some commands. `below` gives the piece of a state of the level below.
    /// Returns the units of work.
    fn measure<'a>(
        &mut self,
        builder: &Builder<S>,
        score: &Score<S>,
        commands: &[TurtleCommand<S>],
        below: impl Fn(u32) -> Option<&'a CountedPiece<S>>,
    ) -> u64 {
        let Self { unit: most, trace, .. } = self;
        let mut reach = |unit: Option<i32>, trace: &ScaleTrace| {
            *most = (*most).max(unit.map(|unit| unit.saturating_add(trace.exponent())));
        };
        let mut work = 0;
        for command in commands {
            work += 1;
            match command {
                TurtleCommand::Op(op) => {
                    let length = op.length().filter(|length| *length != 0.0);
                    reach(length.map(|length| score.exponent.saturating_add(unit_of(length))), trace);
                    trace.follow(op);
                    work += op.work() - 1;
                }
                TurtleCommand::State(state, scale) => {
                    // With exchanged turns, a piece has the same scale and about the same size.
                    let Some((piece, _)) = below(*state) else { continue };
                    reach(exponent(builder, piece).map(|own| own.saturating_add(unit_of(*scale))), trace);
                    trace.scale = scaled(trace.scale, piece.effect.scale);
                }
                TurtleCommand::Colour(_) | TurtleCommand::Place(_) => {}
            }
        }
        self.weight += 1 + work as usize;
        work
    }

    /// Performs a command. `piece` is the piece of the command's state, with its scale. Returns the units of work.
    fn draw(
        &mut self,
        builder: &mut Builder<S>,
        command: &TurtleCommand<S>,
        piece: Option<(Piece<S>, f64)>,
        tree: &mut Tree<S>,
        unit: i32,
        scale: f64,
    ) -> u64 {
        let Self { pen, saved, place: at, .. } = self;
        match command {
            TurtleCommand::Op(op) => {
                tree.draw(builder, u64::from(*at), |paper, directions| {
                    pen.act(&[*op], saved, scale, directions, paper);
                });
                return op.work();
            }
            TurtleCommand::Place(place) => *at = *place,
            TurtleCommand::Colour(colour) => pen.style.colour = *colour,
            TurtleCommand::State(..) => {
                let Some((piece, scale)) = piece else { return 1 };
                let placed = piece.block.map(|block| place(builder, block, pen, unit, scale));
                tree.place(builder, placed, &piece.flow, pen.style.width);
                follow(builder, pen, &piece.effect, unit, scale);
            }
        }
        1
    }
}
