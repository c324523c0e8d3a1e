//! New L-systems that are worth looking at.
//!
//! [`surprise`] makes systems of several [families](Family) by chance and keeps the best one. [`judge`] measures the
//! drawing of a system (growth, dimension, proportions, balance, overlap) and refuses those that nobody would keep.
//!
//! ```
//! let (system, merit) = lsystem_invent::surprise(7);
//! assert!(merit.segments > 100);
//! assert_eq!(lsystem_invent::surprise(7).0, system);
//! ```

mod breed;
mod dice;
mod family;
mod judge;
mod moments;
mod palette;
mod surprise;
mod title;

pub use breed::breed;
pub use family::Family;
pub use judge::{LIMITS, Merit, Rejection, SEGMENTS, judge, lines};
pub use moments::Moments;
pub use surprise::{READY, surprise, trial};
