//! Fuzzing of the core: inputs that nobody would write, and what must hold for every one of them.
//!
//! A [`Target`] reads one input from a row of bytes ([`Source`]), gives it to a part of the core, and checks
//!
//! - that nothing panics, with overflow checks and debug assertions compiled in;
//! - that the allocator ([`ALLOCATOR`]) never held more than the page's share of memory ([`Gauge`]);
//! - that no step or synchronous call takes longer than it should;
//! - that the fast way gives what the naive reference of the core's tests gives, where the system is small; that a picture
//!   is the same in other steps and pane by pane; that what is printed or written reads back as the same.
//!
//! The same targets run in two programs. `lsystem-fuzz` feeds them random bytes from a seed, which is fast, needs nothing
//! but Rust, and repeats: the same seed gives the same inputs. `guided` (feature `guided`) is led by the code that inputs
//! reach: libFuzzer, by way of the crate `libfuzzer-sys`, with LLVM's coverage counters, which stable Rust has as a code
//! generation option. The README beside this tells why those, and `cargo xtask fuzz` runs both.
//!
//! Nothing here is shipped, and the core knows nothing of it.

mod clock;
mod gauge;
mod input;
mod make;
mod once;
mod options;
mod shrink;
mod source;
mod supervisor;
mod target;
mod worker;

pub use gauge::Gauge;
pub use once::{guided, once, replay};
pub use options::Options;
pub use shrink::shrink;
pub use source::Source;
pub use supervisor::supervise;
pub use target::Target;
pub use worker::work;

/// The naive reference that the core's tests have.
#[path = "../../lsystem/tests/naive/mod.rs"]
mod naive;

/// Counts what is allocated.
#[global_allocator]
pub static ALLOCATOR: peak_alloc::PeakAlloc = peak_alloc::PeakAlloc;
