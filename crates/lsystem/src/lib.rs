//! L-systems: grammar, derivation, turtle and drawing. This is the front door: here stands what nearly everybody needs,
//! and everything in the modules, one for each phase of the way from text to picture.
//!
//! A [`Definition`] is a system as a person wrote it, or as [`read_file`] found it; [`System::new`] takes it and tells
//! what is wrong with it as [`Diagnostic`]s, which [`render_diagnostic`] shows in the text. From a [`System`] one gets
//!
//! - its string: [`expand`], any stretch of one that is too long for that by a [`Word`](derive::Word), and its length, however large,
//!   by [`count_symbols`];
//! - its [`Drawing`] in the plane or in [space](Solid): [`draw`] and [`draw_solid`], or in steps a [`Drawer`];
//! - from a drawing pixels ([`Renderer`], [`SolidRenderer`]), files ([`write_svg`], [`write_csv`], and
//!   [`write_obj`] and [`write_glb`] of its [`Mesh`]), its segments, and what lies at a point ([`pick`]).
//!
//! A drawing is a graph of shared [`Block`](drawing::Block)s, one for all parts that look the same up to a turn: without chance and
//! context the hundredth generation is as small as the tenth. Whatever has to be unfolded, or could take too much memory,
//! ends at one of the [`Limits`] with a diagnostic. The same system and seed give the same bits everywhere.
//!
//! ```
//! use lsystem::{Definition, Limits, Progress, Renderer, Style, SvgOptions, System, View, Viewport};
//! use lsystem::{draw, write_svg};
//! use std::sync::Arc;
//!
//! let curve = Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), angle: 60.0, ..Definition::default() };
//! let system = System::new(&curve).0.expect("no diagnostic is an error");
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

// Everything, by phase.
pub use lsystem_derive as derive;
pub use lsystem_drawing as drawing;
pub use lsystem_files as files;
pub use lsystem_render as render;
pub use lsystem_syntax as syntax;

// What nearly everybody needs.
pub use lsystem_drawing::{
    Drawer, Drawing, Mesh, SegmentArrays, Solid, System, count_segments, count_symbols, draw, draw_solid, expand,
};
pub use lsystem_files::{SvgOptions, read_file, read_json, write_csv, write_glb, write_json, write_obj, write_svg};
pub use lsystem_render::{Camera, Renderer, SolidRenderer, View, Viewport, fit, pick};
pub use lsystem_syntax::{Definition, Diagnostic, Dialect, Limits, Progress, Style, render_diagnostic};

/// The README's Rust code is tested with the rest.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
