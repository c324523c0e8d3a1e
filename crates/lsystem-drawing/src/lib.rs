//! L-systems derived and drawn.
//!
//! What comes in is a [`Definition`](lsystem_syntax::Definition); what goes out is a [`Drawing`], a small graph of
//! memoised blocks, or the derived word itself.
//!
//! The way between: [`System`] understands a definition; [`Rules`] rewrite its axiom; a [`Turtle`] reads
//! what was derived, in the [`Plane`] or in space ([`Solid`]); a [`Drawer`] remembers what it has drawn. [`Word`] reads
//! any place of any generation without deriving it.

// The order of the data.
mod key;
mod rewriting;
pub mod rotation;
mod turtle;

mod plane;
mod solid;
mod space;
mod system;

mod access;
mod counts;
mod derivation;
mod tally;
mod walk;

mod drawing;
mod mesh;
pub mod triangulate;

mod describe;

#[cfg(test)]
mod testing;

pub use access::{Ancestor, Part, Word, symbol_of_polygon};
pub use counts::{Counter, count, count_segments, count_symbols};
pub use derivation::{expand, expand_counted, expand_into, expand_once, expand_symbol, limit};
pub use describe::{LegendEntry, describe, kind, legend, short_count, why_empty};
pub use drawing::{
    Block, BlockId, Body, ColourChange, Drawer, Drawing, Effect, Frame, Item, Line, Mark, MarkReader, Outlook, Piece,
    Placed, Polygon, SceneSize, Segment, SegmentArrays, SegmentChunk, Segments, Shape, Stroke, StyleChange, StyleId,
    WidthChange, draw, draw_solid, hull, shapes,
};
pub use key::{Key, Purpose};
pub use mesh::{Mesh, MeshMaker};
pub use plane::{Directions, Plane};
pub use rewriting::{
    Choice, ContextPattern, Fault, History, Image, Letter, LetterId, Modules, Rewrite, Rewriter, Rule, Rules, Template,
};
pub use rotation::Rotation;
pub use solid::Solid;
pub use space::{Axis, Space, times};
pub use system::System;
pub use tally::Tally;
pub use turtle::{Colouring, Tropism, Turtle, exponent_of, finite};
