//! The walk of the turtle as notes: lines become notes, branches become voices.
//!
//! [`marked`] adds marks to a system, so that its drawing tells where branches begin and which letter drew a line.
//! [`Walk`] is such a drawing, ready to be heard: [`Walk::tune`] gives all lines or lines at even distances, and
//! [`Walk::part`] the lines from any place on. [`listen`] chooses what is heard of a system of any size. A [`Tune`] is a
//! list of [`Note`]s; playing and writing them is up to others.
//!
//! ```
//! use lsystem_base::{Limits, Meter};
//! use lsystem_drawing::{Figure, System};
//! use lsystem_sound::{SoundOptions, listen};
//! use lsystem_syntax::{Definition, Halt, Work};
//!
//! let rules = "F -> F[+F]F".into();
//! let twig = Definition { axiom: "F".into(), rules, angle: 30.0, ..Definition::default() };
//! let system = System::new(&twig).expect("the system has no errors");
//! let draw = &mut |system: &System, n, _: &mut dyn Work| Figure::draw(system, n, &Limits::default()).map_err(Halt::from);
//! let tune = listen(&system, 1, &SoundOptions::default(), draw, &mut Meter::new(u64::MAX)).unwrap();
//! assert_eq!((tune.notes.len(), tune.voices, tune.length), (3, 2, 3.0));
//! ```

mod listen;
mod marked;
mod options;
mod pitch;
mod reader;
mod tune;
mod walk;

pub use listen::listen;
pub use marked::marked;
pub use options::{MAX_NOTES, Pitch, Scale, SoundOptions, Time};
pub use tune::{Heard, Note, Tune};
pub use walk::Walk;
