//! The memory budget of one wasm instance, which makes one file at a time.
//!
//! | MiB | for |
//! |---|---|
//! | 70 | the drawing, as on the page |
//! | 70 | what is made of the drawing: a mesh ([`MESH`]) or a projection ([`FEW_SEGMENTS`]); a band of a picture ([`BAND`]); or a remembered derivation ([`HISTORY`]) with its counts |
//! | 16 | counts of any size ([`lsystem_base::MAX_COUNTING`]) |
//! | 16 | texts, compiled systems, and the piece of the file that waits for the page |

use crate::FileLimits;
use lsystem_base::Limits;
use lsystem_render::BAND_PIXEL;

/// The most bytes of a remembered derivation. A string that is read by counts takes at most 16 MiB.
const HISTORY: u64 = 24 << 20;
/// The most segments of a mesh or of a projected drawing, and the most strokes and placed blocks of a compact picture.
/// All are in memory at once, with some hundred bytes each.
const FEW_SEGMENTS: u64 = 200_000;
/// The most bytes of a mesh.
const MESH: u64 = 42 << 20;
/// The most pixels of a picture that are painted at a time. A band takes up to 48 MiB.
const BAND: u32 = 1 << 21;

impl FileLimits {
    /// The limits of a file that JavaScript asks for: what the page shows can be saved. A text file has at most
    /// 2,000,000 segments, more than any program opens.
    pub const PAGE: Self = Self {
        drawing: Limits::PAGE,
        drawing_bytes: Limits::PAGE.memory,
        string: Limits { memory: HISTORY, ..Limits::PAGE },
        remembers: true,
        segments: 2_000_000,
        held: FEW_SEGMENTS,
        mesh: [FEW_SEGMENTS, MESH],
        band: BAND,
    };
}

// The drawing and what is made of it fit into their shares.
const _: () = assert!(BAND as u64 * BAND_PIXEL <= Limits::PAGE.memory);
const _: () = assert!(MESH <= Limits::PAGE.memory && HISTORY + (16 << 20) <= Limits::PAGE.memory);
