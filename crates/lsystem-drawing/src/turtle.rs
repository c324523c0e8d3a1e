//! The turtle: its settings, the operations of its actions, the score of all letters, and the pen.

mod op;
mod pen;
mod score;
mod settings;

pub use op::AxisTurn;
pub(crate) use op::{TurtleOp, work_of};
pub(crate) use pen::{Paper, Pen, ScaleTrace, scaled};
pub(crate) use score::{Score, continuation};
pub use settings::{Colouring, Triangle, Turtle};
