//! L-systems as people write them.
//!
//! The input is a [`Definition`]: the texts and numbers of a system, as a file, a link or a page holds them. The output
//! is a [`Grammar`] with its productions, the turtle's actions for each symbol ([`Dialect`], [`parse_overrides`]), and
//! [`Diagnostic`]s that name each problem, its place and a remedy.
//!
//! The reader turns characters into tokens ([`notation`]), lines into productions, overrides into [`Action`]s, and
//! arithmetic into an [`Expr`] that is compiled to [`Code`]. [`print_rules`] writes a grammar as text that reads back
//! as the same grammar.
//!
//! ```
//! let (grammar, diagnostics) = lsystem_syntax::parse("F", "F -> F[+F]F");
//! assert!(diagnostics.is_empty());
//! assert_eq!(lsystem_syntax::print_rules(&grammar), "F -> F[+F]F");
//! ```
//!
//! Limits: a text has at most [`MAX_TEXT`](lsystem_base::MAX_TEXT) bytes, and at most 100 diagnostics of a text are listed. This crate neither
//! derives nor draws. Long work that may end early ([`Work`]) ends with a diagnostic of this crate, or because its owner
//! wants no more.

// In the order of the data: definitions, meanings of symbols, readers and printers, diagnostics.
mod action;
mod characters;
mod class;
mod definition;
mod dialect;
pub mod fields;
mod outline;
pub mod style;
mod surface;
mod value;

mod code;
mod curve;
mod expr;
pub mod grammar;
mod heading;

mod classify;
pub mod lint;
pub mod notation;
pub mod overrides;
pub mod print;

mod diagnostic;
mod expected;
pub mod notes;
mod place;
mod problem;
mod query;
mod shape;
mod work;

pub use action::{ACTIONS, Action, ActionRow, Motion, NumberForm, TUBE_STROKES, Vocabulary};
pub use characters::look_alike;
pub use class::Class;
pub use classify::classify;
pub use code::{Code, Meaning, Op, Unusable};
pub use curve::Curve;
pub use definition::Definition;
pub use diagnostic::{Diagnostic, Diagnostics, Field, Kind, Severity};
pub use dialect::Dialect;
pub use expected::Expected;
pub use expr::{Expr, Function, Operator};
pub use fields::{FIELDS, FieldSpec};
pub use grammar::{Constant, Grammar, Module, Pattern, Production, Seen};
pub use heading::Heading;
pub use notation::constants::ConstantPlace;
pub use notation::parse;
pub use notation::site::{Site, site};
pub use outline::{CIRCLE_SIDES, Outline};
pub use overrides::{parse_overrides, print_overrides};
pub use place::{byte_offset, line_of, render_diagnostic, utf16_letters, utf16_span, visible};
pub use print::{print_axiom, print_module, print_rules};
pub use problem::{Problem, problems};
pub use query::Query;
pub use shape::{MAX_SIDES, Shape};
pub use style::{Colour, ColourBy, ColourSource, GRADIENT, Ink, Style, Tint};
pub use surface::{Patch, Surface, SurfacePoint, parse_surfaces, print_surfaces};
pub use value::Value;
pub use work::{Halt, Work, run_steps};

pub(crate) use notation::expression::Role;
