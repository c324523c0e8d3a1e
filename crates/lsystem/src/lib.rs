//! L-systems: grammar, derivation, turtle and drawing. The most used items are at the top level; each module has all
//! items of one phase on the way from text to picture.
//!
//! A [`Definition`] is a system as text, typed or read by [`read_file`]. [`System::new`] checks and compiles it; errors
//! and warnings are [`Diagnostic`]s, which [`render_diagnostic`] shows in the text. A [`System`] has
//!
//! - a string for each generation: [`expand`]; for a string that is too long for memory, a [`Word`](derive::Word) reads
//!   parts and [`count_symbols`] gives the length;
//! - a [`Drawing`] in the [`Plane`] or in [space](Solid): [`draw`], or a [`Drawer`] in steps. A [`Figure`] is the drawing in the
//!   space of its system.
//!
//! A drawing has pixels ([`Renderer`], [`SolidRenderer`]), files ([`write_svg`], [`write_csv`],
//! [`write_glb`], and [`write_obj`] of its [`Mesh`]), segments, and a mark at each point ([`pick`]).
//!
//! A drawing is a graph of shared [`Block`](drawing::Block)s, one for all parts that are equal up to a rotation:
//! without chance and contexts, the hundredth generation takes about as much memory as the tenth. Other drawings are
//! unfolded symbol by symbol; a diagnostic names the exceeded limit of [`Limits`]. Equal systems and seeds give equal
//! bits on all machines.
//!
//! ```
//! use lsystem::{Definition, Limits, Progress, Renderer, Style, SvgOptions, System, View, Viewport};
//! use lsystem::{draw, write_svg};
//! use std::sync::Arc;
//!
//! let curve = Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), angle: 60.0, ..Definition::default() };
//! let system = System::new(&curve).expect("the system has no errors");
//! let few = draw(&system, 4, &Limits::default()).unwrap();
//! let svg = write_svg(&few, &Style::default(), &SvgOptions::default()).unwrap();
//! assert!(svg.text.starts_with("<svg"));
//!
//! // 4^200 segments: no file holds them, but a picture shows them.
//! let many = draw(&system, 200, &Limits::default()).unwrap();
//! let mut renderer = Renderer::new();
//! renderer.load(Arc::new(many));
//! renderer.begin(&Style::default(), Viewport { width: 320, height: 100, ratio: 1.0 }, View::default());
//! while renderer.step(100_000) == Progress::More {}
//! assert_eq!(renderer.pixels().len(), 320 * 100 * 4);
//! ```

// All items, by phase.
pub use lsystem_base as base;
#[cfg(feature = "course")]
pub use lsystem_course as course;
pub use lsystem_derive as derive;
pub use lsystem_drawing as drawing;
pub use lsystem_files as files;
#[cfg(feature = "film")]
pub use lsystem_film as film;
#[cfg(feature = "find")]
pub use lsystem_find as find;
#[cfg(feature = "import")]
pub use lsystem_import as import;
#[cfg(feature = "invent")]
pub use lsystem_invent as invent;
pub use lsystem_plot as plot;
pub use lsystem_render as render;
pub use lsystem_sound as sound;
pub use lsystem_svg as svg;
pub use lsystem_syntax as syntax;

// The most used items.
pub use lsystem_base::{Limits, Progress};
pub use lsystem_drawing::{
    Drawer, Drawing, Figure, Mesh, Plane, SegmentArrays, Solid, System, count_segments, count_symbols, draw, expand,
};
pub use lsystem_files::{SvgOptions, read_file, read_json, write_csv, write_glb, write_json, write_obj, write_svg};
pub use lsystem_render::{Camera, Renderer, SolidRenderer, Vantage, View, Viewport, fit, pick};
pub use lsystem_syntax::{Definition, Diagnostic, Dialect, Style, render_diagnostic};

/// Tests the Rust code in the README.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
