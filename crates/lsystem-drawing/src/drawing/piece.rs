//! Pieces of a drawing: their blocks, their effect on the turtle, and their placement.

use super::block::{BlockId, Placed, Space};
use super::builder::Builder;
use super::taper::Flow;
use crate::Plane;
use crate::exact_path::{By, Leg, Spot};
use crate::space::{reach, times, unit_of};
use crate::style::StyleChange;
use crate::turtle::{Pen, Score};
use lsystem_derive::LetterId;

/// The change of the turtle's state by a piece. The frame is the turtle's at entry: position at the origin, heading +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect<S: Space = Plane> {
    /// The position at the end, in units of `2^exponent` steps.
    pub at: S::Point,
    /// That position, exactly.
    pub spot: Spot,
    /// The exponent of the unit of `at`.
    pub exponent: i32,
    /// The rotation at the end.
    pub heading: S::Turn,
    /// The change of the style.
    pub style: StyleChange,
    /// The factor of lengths at the end.
    pub scale: f64,
    /// Whether left and right turns are exchanged at the end, unlike at entry.
    pub swaps: bool,
}

/// The drawing of a letter that is derived for some more steps.
#[derive(Clone, Copy, Debug)]
pub struct Piece<S: Space = Plane> {
    /// The block that the letter draws, if any.
    pub block: Option<BlockId>,
    /// The change of the turtle's state.
    pub effect: Effect<S>,
    /// The ends of the piece on its branch, if strokes taper.
    pub(crate) flow: Flow,
}

/// The pieces of one depth, sorted by letter and by whether the turtle enters with exchanged turns.
pub(super) type Level<S = Plane> = Vec<((LetterId, bool), Piece<S>)>;

/// The numbers of pieces of a letter or state: a turtle that exchanges left and right turns draws another piece.
pub(super) fn variants<S: Space>(score: &Score<S>) -> usize {
    if score.swaps() { 2 } else { 1 }
}

/// The exponent of the farthest coordinate of a piece; `None` if the piece neither draws nor moves the turtle.
pub(super) fn exponent<S: Space>(builder: &Builder<S>, Piece { block, effect, .. }: &Piece<S>) -> Option<i32> {
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
        spot: Some(pen.spot),
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
    let (by, factor) = (By::Piece(effect.spot), factor * pen.scale);
    pen.spot = builder.exact_path.go(Leg { from: pen.spot, by, heading: pen.heading, factor });
    pen.heading = S::then(pen.heading, effect.heading);
    pen.style = pen.style.then(&effect.style);
    pen.scale_by(effect.scale);
    pen.swapped ^= effect.swaps;
}

/// The effect that the pen's state stands for. The pen started at the origin, in units of `2^exponent` steps, and with
/// exchanged turns if `swapped`.
pub(super) fn effect<S: Space>(pen: &Pen<S>, exponent: i32, swapped: bool) -> Effect<S> {
    let shift = unit_of(reach(&pen.at));
    let at = shifted(pen.at, -shift);
    Effect {
        at,
        spot: pen.spot,
        exponent: exponent.saturating_add(shift),
        heading: pen.heading,
        style: pen.style,
        scale: pen.scale,
        swaps: pen.swapped != swapped,
    }
}

/// The point with every coordinate times `2^exponent`.
fn shifted<P: AsMut<[f64]>>(mut point: P, exponent: i32) -> P {
    point.as_mut().iter_mut().for_each(|c| *c = libm::scalbn(*c, exponent));
    point
}
