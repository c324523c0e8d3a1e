//! Fuzzing of the core: random inputs, and properties that must hold for all of them.
//!
//! A [`Target`] reads one input from a row of bytes (`Source`), gives it to a part of the core, and checks
//!
//! - that nothing panics, with overflow checks and debug assertions compiled in;
//! - that the allocator ([`ALLOCATOR`]) never held more than the page's share of memory (`Gauge`);
//! - that no step exceeds its share of work, and no step or call is slow;
//! - that results equal those of the naive reference of the core's tests, for small systems; that a picture does not
//!   depend on the size of its steps or on panes; that printed and written texts read back as the same.
//!
//! Two programs run the same targets. `lsystem-fuzz` feeds them random bytes from a seed. It is fast, needs only Rust,
//! and equal seeds give equal inputs. `guided` (feature `guided`) chooses inputs by the code that they reach: by
//! libFuzzer from the crate `libfuzzer-sys`, with LLVM's coverage counters, which stable Rust offers as code generation
//! options. The README of this crate gives the reasons for this choice, and `cargo xtask fuzz` runs both.
//!
//! Nothing here is shipped, and the core does not depend on it.

mod clock;
mod gauge;
mod input;
mod make;
mod once;
mod options;
mod pieces;
mod results;
mod shrink;
mod source;
mod supervisor;
mod target;
mod told;
mod worker;

pub(crate) use gauge::Gauge;
pub(crate) use once::once;
pub use once::{guided, replay};
pub use options::Options;
pub use shrink::shrink;
pub(crate) use source::Source;
pub use supervisor::supervise;
pub use target::Target;
pub use worker::{watch, work};

/// The naive reference of the core's tests.
#[path = "../../lsystem/tests/naive/mod.rs"]
mod naive;

/// The allocator, which counts the bytes in use.
#[global_allocator]
pub static ALLOCATOR: peak_alloc::PeakAlloc = peak_alloc::PeakAlloc;
