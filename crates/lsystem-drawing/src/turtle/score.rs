//! The score: the operations of all letters, as one module after the other performs them.

use crate::Plane;
use crate::space::{Geometry, exponent_of, finite};
use crate::style::ColourChange;
use crate::turtle::op::TurtleOp;
use crate::turtle::settings::{Colouring, Turtle};
use crate::wind::WAVE;
use lsystem_derive::{LetterId, ModuleAge, Quantity, Rule, Rules};
use lsystem_syntax::{Action, Heading};

/// A turtle's actions compiled to operations, in units that keep the lengths of its symbols below 1.
#[derive(Clone, Debug)]
pub(crate) struct Score<S: Geometry = Plane> {
    /// By letter; empty for unreachable letters.
    pub ops: Vec<Vec<TurtleOp<S>>>,
    /// A length of 1 is `2^exponent` steps.
    pub exponent: i32,
    /// One step in model units; 1 if the turtle's own step is zero, and the default length is then 0.
    pub step: f64,
    /// The width at the start, in multiples of `step`.
    pub width: f64,
    /// As [`Turtle::growth`].
    pub growth: f64,
    /// Whether strokes taper: the turtle wants it, and widths may change.
    pub tapers: bool,
    /// The largest deviations of angles and of lengths, as fractions.
    variations: [f64; 2],
    /// Whether the colour index is the derivation step that made the module.
    pub(crate) colours_by_generation: bool,
    /// By derivation step, modulo [`WAVE`]: the turn of a branch that the step made. `None` without wind.
    wind_turns: Option<[S::Turn; WAVE]>,
}

impl Turtle {
    /// The compiled actions of the letters that may be drawn.
    pub(crate) fn score<S: Geometry>(&self, drawn: &[bool]) -> Score<S> {
        let mut ops: Vec<Vec<TurtleOp<S>>> = (self.actions.iter().zip(drawn))
            .map(|(actions, &drawn)| if drawn { self.ops(actions) } else { vec![] })
            .collect();
        let lengths = ops.iter().flatten().filter_map(TurtleOp::length);
        let exponent = exponent_of(lengths.map(f64::abs).fold(0.0, f64::max));
        for op in ops.iter_mut().flatten() {
            *op = op.scaled(-exponent);
        }
        Score {
            tapers: self.tapers && self.changes_width(drawn),
            ops,
            exponent,
            step: self.unit(),
            width: finite(self.width).max(0.0) * self.steps(),
            growth: finite(self.growth).clamp(0.0, 1.0),
            variations: [self.angle_variation, self.length_variation].map(|part| finite(part).clamp(0.0, 1.0)),
            colours_by_generation: self.colouring == Colouring::Generations,
            wind_turns: self.wind.map(|wind| core::array::from_fn(|step| wind.after::<S>(step))),
        }
    }
}

impl<S: Geometry> Score<S> {
    /// The operations of a letter. `number`, a module's first argument, replaces the number of the letter's first
    /// action.
    pub(crate) fn ops_of(
        &self,
        turtle: &Turtle,
        letter: usize,
        number: Option<f64>,
    ) -> impl Iterator<Item = TurtleOp<S>> {
        let (ops, first) = (&self.ops[letter], turtle.actions[letter].first());
        // In systems with polygons, an operation for the first vertex comes before a draw or move.
        let marks = matches!(ops[..], [TurtleOp::FirstVertex, ..]);
        // A surface has an operation for each triangle.
        let surface = if let Some(&Action::Surface(name, _)) = first { Some(turtle.surface(name).len()) } else { None };
        let numbered = number.zip(first).map(|(number, action)| (usize::from(marks), action.with(number)));
        ops.iter().enumerate().map(move |(index, &op)| match numbered {
            Some((_, action)) if surface.is_some_and(|count| index < count) => {
                let size = finite(libm::scalbn(turtle.in_steps(action.number()), -self.exponent));
                op.map_length(|_| size)
            }
            Some((place, action)) if surface.is_none() && place == index => self.op(turtle, action),
            _ => op,
        })
    }

    /// The operation of an action of `turtle`, from which this score was made; its length may be above 1.
    pub(crate) fn op(&self, turtle: &Turtle, action: Action) -> TurtleOp<S> {
        turtle.op(action).scaled(-self.exponent)
    }

    /// Replaces `ops` by the operations of `actions`, the first of them with `number`. `turtle` is the one from which
    /// this score was made. Lengths may be above 1.
    pub(crate) fn numbered(&self, turtle: &Turtle, actions: &[Action], number: f64, ops: &mut Vec<TurtleOp<S>>) {
        ops.clear();
        if let [first, rest @ ..] = actions {
            ops.extend(turtle.ops(&[first.with(number)]));
            ops.extend(turtle.ops::<S>(rest));
        }
        ops.iter_mut().for_each(|op| *op = op.scaled(-self.exponent));
    }

    /// Whether angles or lengths vary from module to module.
    pub(crate) fn varies(&self) -> bool {
        self.variations != [0.0; 2]
    }

    /// Whether a letter opens a polygon or fills a disc.
    pub(crate) fn fills(&self) -> bool {
        self.ops
            .iter()
            .flatten()
            .any(|op| matches!(op, TurtleOp::OpenPolygon | TurtleOp::Fill(..) | TurtleOp::Triangle { .. }))
    }

    /// Whether a letter draws a part of a tube, which begins at an earlier symbol.
    pub(crate) fn has_tubes(&self) -> bool {
        self.ops.iter().flatten().any(|op| matches!(op, TurtleOp::Tube))
    }

    /// Whether a letter exchanges left and right turns.
    pub(crate) fn swaps(&self) -> bool {
        self.ops.iter().flatten().any(|op| matches!(op, TurtleOp::SwapTurns))
    }

    /// Whether modules of the same letter may do different things: by variation, colour, growth
    /// or sway.
    pub(crate) fn differs_by_module(&self) -> bool {
        self.varies() || self.differs_by_age()
    }

    /// Whether modules of the same letter may do different things by their age.
    pub(crate) fn differs_by_age(&self) -> bool {
        self.colours_by_generation || self.growth < 1.0 || self.has_wind()
    }

    /// Whether branches sway.
    pub(crate) fn has_wind(&self) -> bool {
        self.wind_turns.is_some()
    }

    /// Replaces `own` by the operations of one module. `ops` are the operations of its letter.
    pub(crate) fn own(&self, ops: &[TurtleOp<S>], fate: &ModuleAge, seed: u32, own: &mut Vec<TurtleOp<S>>) {
        let grown = if fate.grows { self.growth } else { 1.0 };
        let [angles, lengths] = self.variations;
        // The slot counts lengths and angles only, so that other operations do not change the random numbers.
        let mut slot = 0;
        let mut varied = |most: f64, what: Quantity| {
            slot += 1;
            match most {
                0.0 => grown,
                _ => grown * (1.0 + most * fate.key.variation(seed, what, slot - 1)),
            }
        };
        let mut of_surface = 1.0;
        own.clear();
        if self.colours_by_generation {
            own.push(TurtleOp::Style(ColourChange::Set(fate.since.cast_signed()).into()));
        }
        own.extend(ops.iter().map(|&op| match op {
            TurtleOp::Turn(turning) => {
                // A half turn leads straight back and does not vary.
                let most = if turning.angle.by == Heading::HALF { 0.0 } else { angles };
                TurtleOp::Turn(turning.part(varied(most, Quantity::Angle)))
            }
            TurtleOp::Wind(_) => self.in_wind(op, fate.step),
            // All triangles of a surface change alike.
            TurtleOp::Triangle { follows: true, .. } => op.map_length(|size| size * of_surface),
            other => other.map_length(|length| {
                of_surface = varied(lengths, Quantity::Length);
                length * of_surface
            }),
        }));
    }

    /// The operation `op` of a module that derivation step `step` made and that may still grow.
    pub(crate) fn changed(&self, op: TurtleOp<S>, grows: bool, step: u32) -> TurtleOp<S> {
        if grows { self.growing(self.in_wind(op, step)) } else { self.in_wind(op, step) }
    }

    /// The operation `op` of a module that derivation step `step` made.
    fn in_wind(&self, op: TurtleOp<S>, step: u32) -> TurtleOp<S> {
        match (op, &self.wind_turns) {
            (TurtleOp::Wind(_), Some(turns)) => TurtleOp::Wind(turns[step as usize % WAVE]),
            _ => op,
        }
    }

    /// The operation `op` of a module that still grows.
    fn growing(&self, op: TurtleOp<S>) -> TurtleOp<S> {
        match op {
            TurtleOp::Turn(turning) => TurtleOp::Turn(turning.part(self.growth)),
            other => other.map_length(|length| length * self.growth),
        }
    }

    /// Whether a letter draws.
    pub(crate) fn draws(&self, letter: LetterId) -> bool {
        self.ops[usize::from(letter)].iter().any(|op| matches!(op, TurtleOp::Draw(_)))
    }

    /// By letter: whether the letter, or one of its images, draws.
    pub(crate) fn shows(&self, rules: &Rules) -> Vec<bool> {
        let shows = |(letter, images): (usize, &Vec<Rule>)| {
            let mut letters = images.iter().flat_map(|image| &image.successor.letters);
            if images.is_empty() { self.draws(letter as LetterId) } else { letters.any(|&letter| self.draws(letter)) }
        };
        rules.images.iter().enumerate().map(shows).collect()
    }

    /// The index in `successor` of the letter that continues `former`.
    pub(crate) fn continuation(&self, former: LetterId, successor: &[LetterId]) -> Option<usize> {
        continuation(former, successor.iter().copied(), |letter| self.draws(letter))
    }
}

/// The index in `successor` of the letter that continues `former`: the first of the same letter, or else, if `former`
/// draws, the first that draws.
pub(crate) fn continuation(
    former: LetterId,
    mut successor: impl Iterator<Item = LetterId> + Clone,
    draws: impl Fn(LetterId) -> bool,
) -> Option<usize> {
    let same = successor.clone().position(|letter| letter == former);
    same.or_else(|| successor.position(&draws).filter(|_| draws(former)))
}
