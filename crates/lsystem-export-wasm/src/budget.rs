//! The memory budget of one instance, which makes one file at a time.
//!
//! | MiB | for |
//! |---|---|
//! | 70 | the drawing, as on the page |
//! | 70 | what is made of the drawing: a mesh ([`MESH`]) or a projection ([`FEW_SEGMENTS`]); a band of a picture ([`BAND`]); or a remembered derivation ([`HISTORY`]) with its counts |
//! | 16 | counts of any size ([`lsystem_syntax::MAX_COUNTING`]) |
//! | 16 | texts, compiled systems, and the piece of the file that waits for the page |

use lsystem_render::BAND_PIXEL;
use lsystem_syntax::Limits;

/// The limits of drawings and strings: what the page shows can be saved.
pub(crate) const LIMITS: Limits = Limits::PAGE;
/// The limits of a remembered derivation. A string that is read by counts takes at most 16 MiB more.
pub(crate) const HISTORY: Limits = Limits { memory: 24 << 20, ..LIMITS };
/// The most segments of a text file: more than any program opens.
pub(crate) const TEXT_SEGMENTS: u64 = 2_000_000;
/// The most segments of a mesh or of a projected drawing, and the most strokes and placed blocks of a compact picture.
/// All are in memory at once, with some hundred bytes each.
pub(crate) const FEW_SEGMENTS: u64 = 200_000;
/// The most bytes of a mesh.
pub(crate) const MESH: u64 = 42 << 20;
/// The most pixels of a picture that are painted at a time. A band takes up to 48 MiB.
pub(crate) const BAND: u32 = 1 << 21;
/// The units of work of a step: well under a millisecond.
pub(crate) const WORK: u64 = 16_384;

// The drawing and what is made of it fit into their shares.
const _: () = assert!(BAND as u64 * BAND_PIXEL <= LIMITS.memory);
const _: () = assert!(MESH <= LIMITS.memory && HISTORY.memory + (16 << 20) <= LIMITS.memory);
