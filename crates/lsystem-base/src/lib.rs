//! Limits, counted work, and numbers as texts: the ground that all other crates stand on.
//!
//! Each of the [`Limits`] is checked before the allocation that it guards. Every loop whose length depends on input
//! charges a [`Meter`], and work that takes long runs in steps that return a [`Progress`]. [`decimal`], [`number`] and
//! [`sorted`] read numbers, write numbers and sort lists in few bytes of compiled code.
//!
//! ```
//! use lsystem_base::{Meter, decimal};
//!
//! let mut meter = Meter::new(10);
//! meter.charge(8);
//! assert_eq!((meter.is_spent(), meter.left()), (false, 2));
//! assert_eq!(decimal::read("25.7"), Some(25.7));
//! ```

pub mod decimal;
pub mod fixed;
mod limits;
mod meter;
mod mixer;
mod named;
pub mod number;
mod progress;
pub mod sorted;
pub mod words;

pub use limits::{
    LimitName, Limits, MAX_ACTIONS, MAX_COMPARISONS, MAX_CONTEXT, MAX_COUNTING, MAX_FILE, MAX_ITERATIONS, MAX_LETTERS,
    MAX_MESH_COPIES, MAX_PALETTE, MAX_PARAMETERS, MAX_PICTURE_PIXELS, MAX_PICTURE_SIDE, MAX_PLOT_BLOCKS,
    MAX_SEGMENT_DIGITS, MAX_SURFACE_PATCHES, MAX_SURFACES, MAX_SURFACES_TEXT, MAX_TEXT,
};
pub use meter::Meter;
pub use mixer::Mixer;
pub use progress::Progress;
