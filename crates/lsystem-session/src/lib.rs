//! The page's worker without a browser. A [`Session`] keeps a system between edits, draws it and paints it on a
//! [`Screen`], in steps of at most [`STEP`] milliseconds on a [`Clock`], so that newer input soon supersedes older.
//!
//! Each change of the definition, the view or the number of shown segments makes the picture in the making obsolete. The
//! next steps then build the drawing, show a coarse picture if a fine one takes longer than a step, and refine the picture
//! while nothing changes. In between, the session reads strings and segments ([`Session::string`], [`Session::symbol`],
//! [`Session::pick`]), and several sessions may make one picture in space together ([`Session::hand_out`]). All of them
//! stay within a budget of memory (`budget.rs`).
//!
//! Functions without a session translate texts: [`notation`], [`site_of`], [`read_file`], [`expand`], [`segments`],
//! [`qr_code`]. Types that implement `Serialize` are messages to the page: their names become those of JavaScript.
//!
//! ```
//! use lsystem::render::Pane;
//! use lsystem::{Definition, View, Viewport};
//! use lsystem_session::{Screen, Session};
//! use std::convert::Infallible;
//!
//! /// Keeps the last picture.
//! #[derive(Default)]
//! struct Pixels(Vec<u8>);
//!
//! impl Screen for Pixels {
//!     type Error = Infallible;
//!     fn put(&mut self, pixels: &[u8], _: Viewport, _: Pane) -> Result<(), Infallible> {
//!         self.0 = pixels.to_vec();
//!         Ok(())
//!     }
//! }
//!
//! let started = std::time::Instant::now();
//! let clock = Box::new(move || started.elapsed().as_secs_f64() * 1000.0);
//! let mut session = Session::new(Pixels::default(), clock);
//! let plant = Definition { axiom: "F".into(), rules: "F -> F[+F]F".into(), angle: 25.0, ..Definition::default() };
//! assert!(session.define(Definition { iterations: 5, ..plant }).ok);
//! session.look(Viewport { width: 64, height: 48, ratio: 1.0 }, View::default(), None);
//! while !session.step().unwrap().idle {}
//! assert_eq!(session.surface().0.len(), 64 * 48 * 4);
//! ```

mod budget;
mod counts;
mod facts;
mod files;
mod mates;
mod notation;
mod pace;
mod plain;
mod plane;
mod qr;
mod reading;
mod report;
mod session;
mod sharing;
mod solid;
mod surface;
#[cfg(test)]
mod tests;
mod viewer;
mod views;

pub use facts::{Anchor, Picked, Place, StringPage, SymbolFacts};
pub use files::{FileRead, read_file};
pub use mates::{Outcome, PaneStep, SharedPane};
pub use notation::{ModulePlace, TextClasses, notation, site_of};
pub use pace::STEP;
pub use plain::{ThrownProblems, expand, segments};
pub use qr::qr_code;
pub use report::{Problem, Report};
pub use session::{Session, StepAnswer};
pub use surface::{Clock, Screen};
pub use viewer::Only;
