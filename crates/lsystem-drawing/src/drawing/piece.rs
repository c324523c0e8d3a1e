//! What a piece of a drawing draws, how it leaves the turtle, and how it is placed.

use super::block::{BlockId, Placed, Space};
use super::builder::Builder;
use crate::Plane;
use crate::space::{reach, times, unit_of};
use crate::style::StyleChange;
use crate::turtle::{LARGEST, Pen, Score};
use lsystem_derive::LetterId;

/// How a piece of a drawing leaves the turtle, in the frame in which it entered: at the origin heading along +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect<S: Space = Plane> {
    /// Where it ends, in units of `2^exponent` steps.
    pub at: S::Point,
    /// Of the unit that `at` is in.
    pub exponent: i32,
    /// How it has turned.
    pub heading: S::Turn,
    /// What has happened to the style.
    pub style: StyleChange,
}

/// What a letter derived for some more steps does.
#[derive(Clone, Copy, Debug)]
pub struct Piece<S: Space = Plane> {
    /// What it draws; `None` if nothing.
    pub block: Option<BlockId>,
    /// How it leaves the turtle.
    pub effect: Effect<S>,
}

/// The pieces of one depth, sorted by letter.
pub(super) type Level<S = Plane> = Vec<(LetterId, Piece<S>)>;

/// The exponent of what lengths are multiplied by on a branch so many levels deep.
pub(super) fn smaller<S: Space>(score: &Score<S>, level: i32) -> i32 {
    if score.shrinking == 1.0 || level == 0 {
        return 0;
    }
    unit_of(libm::pow(score.shrinking, f64::from(level)).min(LARGEST))
}

/// The exponent of the longest way in a piece; `None` if it goes nowhere.
pub(super) fn exponent<S: Space>(builder: &Builder<S>, Piece { block, effect }: &Piece<S>) -> Option<i32> {
    let block = block.map(|block| builder.blocks[block.0 as usize].exponent);
    block.max((effect.at != S::Point::default()).then_some(effect.exponent))
}

/// Places `block`, `factor` times as large, where the pen is, in units of `2^exponent` steps.
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

/// Moves the pen as a piece does that is `factor` times as large.
pub(super) fn follow<S: Space>(
    builder: &mut Builder<S>,
    pen: &mut Pen<S>,
    effect: &Effect<S>,
    exponent: i32,
    factor: f64,
) {
    let axes = S::axes(&mut builder.directions, pen.heading);
    let by = times(shifted(times(effect.at, factor), effect.exponent.saturating_sub(exponent)), pen.scale);
    pen.at = S::lie(&axes, pen.at, by);
    pen.heading = S::then(pen.heading, effect.heading);
    pen.style = pen.style.then(&effect.style);
}

/// What has happened to the pen, in units of `2^exponent` steps.
pub(super) fn effect<S: Space>(pen: &Pen<S>, exponent: i32) -> Effect<S> {
    let shift = unit_of(reach(&pen.at));
    let at = shifted(pen.at, -shift);
    Effect { at, exponent: exponent.saturating_add(shift), heading: pen.heading, style: pen.style }
}

/// Every coordinate times `2^exponent`.
fn shifted<P: AsMut<[f64]>>(mut point: P, exponent: i32) -> P {
    point.as_mut().iter_mut().for_each(|c| *c = libm::scalbn(*c, exponent));
    point
}
