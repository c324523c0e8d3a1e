//! What every part counts and sorts with: limits, counted work, small sorts and numbers as texts.
//!
//! Each limit is checked before the allocation that it guards, and every loop whose length depends on input charges a
//! [`Meter`].
//!
//! ```
//! use lsystem_base::Meter;
//!
//! let mut meter = Meter::new(10);
//! meter.charge(8);
//! assert_eq!((meter.is_spent(), meter.left()), (false, 2));
//! ```

pub mod decimal;
mod limits;
mod meter;
pub mod number;
mod progress;
pub mod sorted;

pub use limits::{
    LimitName, Limits, MAX_ACTIONS, MAX_CONTEXT, MAX_COUNTING, MAX_ITERATIONS, MAX_LETTERS, MAX_MESH_COPIES,
    MAX_PALETTE, MAX_PARAMETERS, MAX_PICTURE_PIXELS, MAX_PICTURE_SIDE, MAX_PLOT_BLOCKS, MAX_TEXT,
};
pub use meter::Meter;
pub use progress::Progress;
