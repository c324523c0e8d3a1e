//! Measurements: the same work by this library, by other libraries, and by a plain copy of the same bytes.

mod growth;
mod row;
mod work;

#[cfg(target_arch = "wasm32")]
mod pictures;
#[cfg(target_arch = "wasm32")]
mod web;

pub use growth::{GROWTHS, Growth};
pub use row::{Row, tables};
pub use work::{Buffers, WORKS, Work};
