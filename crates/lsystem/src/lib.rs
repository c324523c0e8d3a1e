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

pub use lsystem_derive::{
    Ancestor, Choice, ContextPattern, Counter, Fault, History, Image, Key, Letter, LetterId, Modules, Part, Purpose,
    Rewrite, Rewriter, Rule, Rules, Tally, Template, Word,
};
pub use lsystem_drawing::{
    Axis, Block, BlockId, Body, ColourChange, Colouring, Drawer, Drawing, Effect, Item, LegendEntry, Mark, Mesh,
    MeshMaker, Outlook, Piece, Placed, Plane, Polygon, Rotation, Segment, SegmentArrays, SegmentChunk, Segments, Solid,
    Space, Stroke, StyleChange, StyleId, System, Tropism, Turtle, WidthChange, count_segments, count_symbols, describe,
    draw, draw_solid, expand, expand_counted, expand_into, expand_once, expand_symbol, kind, legend, short_count,
    symbol_of_polygon, why_empty,
};
pub use lsystem_files::{
    CsvWriter, FileContent, GlbWriter, ObjWriter, Svg, SvgForm, SvgOptions, SvgWriter, read_file, read_json, tag_png,
    write_csv, write_glb, write_json, write_obj, write_svg,
};
pub use lsystem_render::{
    Camera, DensityRenderer, Detail, Effort, Fitted, Pane, Pass, Pick, PlaneRenderer, Pointer, Quality, Rect,
    RenderStats, Renderer, SolidRenderer, Spent, Target, View, Viewport, camera_axes, fit, fitted_ends, fitted_outline,
    fitted_polygon, fitted_scale, fitted_solid_ends, fitted_solid_polygon, pick, pick_solid, solid_scale,
};
pub use lsystem_syntax::{
    Action, Class, Classes, Code, Colour, ColourBy, Constant, ConstantPlace, Definition, Diagnostic, Dialect, Expected,
    Expr, Field, Function, GRADIENT, Grammar, Heading, Ink, JsonError, Kind, LimitName, Limits, MAX_ACTIONS,
    MAX_CONTEXT, MAX_COUNTING, MAX_ITERATIONS, MAX_LETTERS, MAX_PALETTE, MAX_PARAMETERS, MAX_PICTURE_PIXELS,
    MAX_PICTURE_SIDE, MAX_TEXT, Meaning, Meter, Module, Op, Operator, Override, Pattern, Production, Progress,
    Quantity, Role, SIGN, STACK, Seen, Severity, Style, Tint, Unusable, classify, parse, parse_overrides, plain_word,
    print_actions, print_axiom, print_module, print_overrides, print_rules, render_diagnostic, utf16_letters,
    utf16_span, visible,
};

/// The README's Rust code is tested with the rest.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
