//! Ink, for the plane and for space: the shades of blocks, sums of ink by pixel, and the tones that show them.

mod alpha;
mod amount;
mod grid;
mod inks;
mod outline;
mod pigment;
pub(crate) mod sheet;
mod sweep;
mod tone;

pub(crate) use amount::Amount;
pub(crate) use grid::Grid;
pub(crate) use inks::{Choice, Dye, InkTable, Inks, PLANES, Shade};
pub(crate) use outline::{Crossing, MAX_SORTED, SIDES_PER_UNIT, Side, sides_in};
pub(crate) use pigment::{Pigment, pigment};
pub(crate) use sheet::Sheet;
pub(crate) use sweep::{BlockVisitor, Sweep};
pub(crate) use tone::{Print, Shading, TONE_BYTES, Tone};

/// A smooth step from 0 below the first number to 1 above the second.
pub(crate) fn smooth([from, to]: [f64; 2], at: f64) -> f64 {
    let part = ((at - from) / (to - from)).clamp(0.0, 1.0);
    part * part * (3.0 - 2.0 * part)
}
