//! L-systems: grammar, derivation, turtle and drawing.
//!
//! A [`Definition`] is a system as a person wrote it, or as [`read_file`] found it; [`System::new`] takes it and tells
//! what is wrong with it as [`Diagnostic`]s, which [`render_diagnostic`] shows in the text. From a [`System`] one gets
//!
//! - its string: [`expand`], any stretch of one that is too long for that by a [`Word`], and its length, however large,
//!   by [`count_symbols`];
//! - its [`Drawing`] in the plane or in [space](Solid): [`draw`] and [`draw_solid`], or in steps a [`Drawer`];
//! - from a drawing pixels ([`Renderer`], [`DensityRenderer`], [`SolidRenderer`]), files ([`write_svg`], [`write_csv`], and
//!   [`write_obj`] and [`write_glb`] of its [`Mesh`]), its segments, and what lies at a point ([`pick`]).
//!
//! A drawing is a graph of shared [`Block`]s, one for all parts that look the same up to a turn: without chance and
//! context the hundredth generation is as small as the tenth. Whatever has to be unfolded, or could take too much memory,
//! ends at one of the [`Limits`] with a diagnostic. The same system and seed give the same bits everywhere.
//!
//! ```
//! use lsystem::{Definition, Limits, PlaneRenderer, Progress, Renderer, Style, SvgOptions, System, View, Viewport};
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

mod access;
mod counts;
mod derivation;
mod describe;
mod drawing;
mod format;
mod key;
mod mesh;
mod plane;
mod program;
mod render;
mod render3d;
mod rewriting;
mod rotation;
mod solid;
mod space;
mod system;
mod tally;
#[cfg(test)]
mod testing;
mod triangulate;
mod turtle;
mod walk;

pub use access::{Ancestor, Part, Word, symbol_of_polygon};
pub use counts::{Counter, count, count_segments, count_symbols};
pub use derivation::{expand, expand_counted, expand_into, expand_once, expand_symbol};
pub use describe::{LegendEntry, describe, kind, legend, short_count, why_empty};
pub use drawing::{
    Block, BlockId, Body, ColourChange, Drawer, Drawing, Effect, Item, Mark, Outlook, Piece, Placed, Polygon, Segment,
    SegmentArrays, SegmentChunk, Segments, Stroke, StyleChange, StyleId, WidthChange, draw, draw_solid,
};
pub use format::{
    CsvWriter, FileContent, GlbWriter, ObjWriter, Svg, SvgForm, SvgOptions, SvgWriter, read_file, read_json, tag_png,
    write_csv, write_glb, write_json, write_obj, write_svg,
};
pub use key::{Key, Purpose};
pub use lsystem_syntax::{
    Action, Class, Classes, Code, Colour, ColourBy, Constant, ConstantPlace, Definition, Diagnostic, Dialect, Expected,
    Expr, Field, Function, GRADIENT, Grammar, Heading, Ink, JsonError, Kind, LimitName, Limits, MAX_ACTIONS,
    MAX_CONTEXT, MAX_COUNTING, MAX_ITERATIONS, MAX_LETTERS, MAX_PALETTE, MAX_PARAMETERS, MAX_PICTURE_PIXELS,
    MAX_PICTURE_SIDE, MAX_TEXT, Meaning, Meter, Module, Op, Operator, Override, Pattern, Production, Progress,
    Quantity, Role, SIGN, STACK, Seen, Severity, Style, Tint, Unusable, classify, parse, parse_overrides, plain_word,
    print_actions, print_axiom, print_module, print_overrides, print_rules, render_diagnostic, utf16_letters,
    utf16_span, visible,
};
pub use mesh::{Mesh, MeshMaker};
pub use plane::Plane;
pub use program::{Choice, Program, Rewrite, SymbolId};
pub use render::{
    DensityRenderer, Detail, Fitted, Pane, Pass, Pick, PlaneRenderer, Pointer, Rect, RenderStats, Renderer, Target,
    View, Viewport, fit, fitted_ends, fitted_outline, fitted_polygon, fitted_scale, pick,
};
pub use render3d::{
    Camera, Effort, Quality, SolidRenderer, Spent, camera_axes, fitted_solid_ends, fitted_solid_polygon, pick_solid,
    solid_scale,
};
pub use rewriting::{
    ContextPattern, Fault, History, Image, Letter, LetterId, Modules, Rewriter, Rule, Rules, Template,
};
pub use rotation::Rotation;
pub use solid::Solid;
pub use space::{Axis, Space};
pub use system::System;
pub use tally::Tally;
pub use turtle::{Colouring, Tropism, Turtle};

/// The README's Rust code is tested with the rest.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
