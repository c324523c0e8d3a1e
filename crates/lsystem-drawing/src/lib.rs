//! Drawings of L-systems: from a [`Definition`](lsystem_syntax::Definition) to a [`Drawing`], a small graph of shared
//! blocks.
//!
//! A [`System`] is a checked and compiled definition. Its rules derive strings ([`expand`], [`count_symbols`]). A
//! [`Turtle`] reads the symbols, in the [`Plane`] or in space ([`Solid`]). A [`Drawer`] makes the blocks in steps: one
//! block for each letter and number of derivation steps, or, where chance or contexts forbid sharing, a tree of the
//! whole string. A [`Figure`] is a drawing in the space of its system, for readers to whom the space makes no
//! difference. Bounds, counts, segments, projections and the triangles of a [`Mesh`] are read from the graph.
//!
//! ```
//! use lsystem_base::Limits;
//! use lsystem_drawing::{Figure, System};
//! use lsystem_syntax::Definition;
//!
//! let koch = Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), angle: 60.0, ..Definition::default() };
//! let system = System::new(&koch).expect("the system has no errors");
//! let figure = Figure::draw(&system, 40, &Limits::default()).unwrap();
//! assert_eq!(figure.segment_count(), 1 << 80);
//! assert!(figure.block_count() < 1_000);
//! ```

// In the order of the data.
mod chunks;
mod room;

mod exact_path;
mod plane;
pub mod rotation;
mod solid;
mod space;
mod style;
mod tube;
mod turtle;
mod wind;
mod wireframe;

mod look;
mod neighbours;
mod system;

mod drawn;
mod strings;

mod drawing;
mod mesh;
mod opening;
pub mod triangulate;

mod describe;
mod figure;

pub use describe::{kind, legend, why_empty};
pub use drawing::{
    Around, Block, BlockFeatures, BlockFrame, BlockId, Drawer, Drawing, Item, Line, Mark, Origin, Outlook, Placed,
    Polygon, Projection, SceneSize, Segment, SegmentArrays, Space, Stroke, count_of, draw, hull,
};
pub use drawn::drawn_by_letter;
pub use exact_path::Spot;
pub use figure::{Figure, FigureDrawer};
pub use look::Look;
pub use mesh::{Material, Mesh, MeshForm, MeshOptions, MeshParts};
pub use opening::symbol_of_polygon;
pub use plane::{Directions, Plane};
pub use solid::Solid;
pub use space::{Geometry, exponent_of, finite, times};
pub use strings::{count_segments, count_symbols, expand, expand_counted, expand_into, expand_once, expand_symbol};
pub use style::{ColourChange, StyleChange, StyleId, WidthChange, Widths};
pub use system::System;
pub use turtle::{AxisTurn, Colouring, Triangle, Turtle};
pub use wind::Wind;
