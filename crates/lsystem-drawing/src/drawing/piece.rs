//! Pieces of a drawing: their blocks, their effect on the turtle, and their placement.

use super::block::{BlockId, Placed, Space};
use super::builder::Builder;
use crate::Plane;
use crate::space::{reach, times, unit_of};
use crate::style::StyleChange;
use crate::turtle::{LARGEST_SCALE, Pen, Score};
use lsystem_derive::LetterId;

/// The change of the turtle's state by a piece. The frame is the turtle's at entry: position at the origin, heading +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect<S: Space = Plane> {
    /// The position at the end, in units of `2^exponent` steps.
    pub at: S::Point,
    /// The exponent of the unit of `at`.
    pub exponent: i32,
    /// The rotation at the end.
    pub heading: S::Turn,
    /// The change of the style.
    pub style: StyleChange,
}

/// The drawing of a letter that is derived for some more steps.
#[derive(Clone, Copy, Debug)]
pub struct Piece<S: Space = Plane> {
    /// The block that the letter draws, if any.
    pub block: Option<BlockId>,
    /// The change of the turtle's state.
    pub effect: Effect<S>,
}

/// The pieces of one depth, sorted by letter.
pub(super) type Level<S = Plane> = Vec<(LetterId, Piece<S>)>;

/// The exponent of the factor of lengths on a branch at `level`.
pub(super) fn branch_exponent<S: Space>(score: &Score<S>, level: i32) -> i32 {
    if score.branch_length_factor == 1.0 || level == 0 {
        return 0;
    }
    unit_of(libm::pow(score.branch_length_factor, f64::from(level)).min(LARGEST_SCALE))
}

/// The exponent of the farthest coordinate of a piece; `None` if the piece neither draws nor moves the turtle.
pub(super) fn exponent<S: Space>(builder: &Builder<S>, Piece { block, effect }: &Piece<S>) -> Option<i32> {
    let block = block.map(|block| builder.blocks[block.0 as usize].exponent);
    block.max((effect.at != S::Point::default()).then_some(effect.exponent))
}

/// Places `block`, times `factor`, at the pen's state, in units of `2^exponent` steps.
pub(super) fn place<S: Space>(
    builder: &mut Builder<S>,
    block: BlockId,
    pen: &Pen<S>,
    exponent: i32,
    factor: f64,
) -> Placed<S> {
    let own = builder.blocks[block.0 as usize].exponent;
    Placed {
        block,
        style: builder.styles.id(&pen.style),
        at: pen.at,
        heading: pen.heading,
        scale: pen.scale * libm::scalbn(factor, own - exponent),
    }
}

/// Applies the effect of a piece, times `factor`, to the pen.
pub(super) fn follow<S: Space>(
    builder: &mut Builder<S>,
    pen: &mut Pen<S>,
    effect: &Effect<S>,
    exponent: i32,
    factor: f64,
) {
    let axes = S::axes(&mut builder.directions, pen.heading);
    let by = times(shifted(times(effect.at, factor), effect.exponent.saturating_sub(exponent)), pen.scale);
    pen.at = S::transform(&axes, pen.at, by);
    pen.heading = S::then(pen.heading, effect.heading);
    pen.style = pen.style.then(&effect.style);
}

/// The effect that the pen's state stands for. The pen started at the origin, in units of `2^exponent` steps.
pub(super) fn effect<S: Space>(pen: &Pen<S>, exponent: i32) -> Effect<S> {
    let shift = unit_of(reach(&pen.at));
    let at = shifted(pen.at, -shift);
    Effect { at, exponent: exponent.saturating_add(shift), heading: pen.heading, style: pen.style }
}

/// The point with every coordinate times `2^exponent`.
fn shifted<P: AsMut<[f64]>>(mut point: P, exponent: i32) -> P {
    point.as_mut().iter_mut().for_each(|c| *c = libm::scalbn(*c, exponent));
    point
}
