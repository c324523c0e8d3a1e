//! The turtle: what each letter of a program does, and from where it starts.

use crate::{Action, Heading};

/// A turtle ready to read a program's words.
#[derive(Clone, Debug, PartialEq)]
pub struct Turtle {
    /// By letter ([`SymbolId`](crate::SymbolId)): what it does.
    pub actions: Vec<Vec<Action>>,
    /// Of a left turn.
    pub left: Heading,
    /// Of a right turn, clockwise.
    pub right: Heading,
    /// At the start.
    pub heading: Heading,
    /// Where it starts, in model units.
    pub start: [f64; 2],
    /// The step length, in model units.
    pub step: f64,
    /// The stroke width at the start, in multiples of the step length.
    pub width: f64,
}
