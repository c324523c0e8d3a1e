//! Teaching with L-systems: exercises and their marks, the output of other programs checked, how the generations
//! [grow](growth), and derivations and turtles [step by step](steps).
//!
//! An [`Exercise`] is a target system with the parts that are given, shown or free. A [`Marker`] compares answers with
//! the target by string, picture or distribution, and its hint names a usual mistake. [`check`] compares the output of
//! a student's program with a generation of a system and names the first difference. [`scorm_package`] puts exercises
//! into a package for learning systems.
//!
//! ```
//! use lsystem_course::{Verdict, check};
//! use lsystem_syntax::Definition;
//!
//! let rules = "A -> AB\nB -> A".into();
//! let algae = Definition { axiom: "A".into(), rules, iterations: 4, ..Definition::default() };
//! assert!(check(&algae, "ABAABABA").is_right());
//! assert_eq!(check(&algae, "ABAAB").verdict, Verdict::Generation(3));
//! ```

mod actions;
mod branches;
mod check;
mod class;
mod compiled;
mod correspondence;
mod difference;
mod exercise;
mod fit;
mod graph;
pub mod growth;
mod hint;
mod mark;
mod nudge;
mod page_words;
mod repair;
mod same;
mod sample;
mod scorm;
mod sketch;
pub mod steps;
mod variants;

pub use check::{Check, MAX_OUTPUT, Output, Verdict, check};
pub use class::{Answer, ClassMarker, Handed, Marked, Mistake, SMALL, answers, exercise_in, mistakes};
pub use exercise::{Asks, Exercise, First, Given};
pub use fit::Ends;
pub use mark::{Grade, Marker, Marking};
pub use page_words::{PageWords, words_in};
pub use same::is_same_picture;
pub use scorm::{Scorm, ScormPages, ScormStandard, scorm_package};
pub use variants::Varied;
