//! From a drawing's graph to pixels.
//!
//! # The picture
//!
//! The picture is the same as if every segment were stroked in drawing order. Strokes have round caps and are at least
//! a pixel wide. A pixel has 4x4 subsamples, or one in a coarse picture. Each subsample keeps the colour that is drawn
//! last. Polygons are filled by the non-zero winding rule.
//!
//! # The way of a picture
//!
//! ```text
//!                graph of blocks
//!                       |
//!            opaque ink | ink that adds up
//!          +------------+------------+
//!       `opaque`                 `density`
//!          |                         |
//!      `strategy`                 survey
//!       /       \                    |
//!   top-down  bottom-up          sums of ink
//!       \       /                    |
//!      subsamples                  tone curve
//!          +------------+------------+
//!                       |
//!                    pixels
//! ```
//!
//! An opaque picture is made by one of two strategies:
//!
//! - **Top-down** (`top_down`, `descent`): the block drawn last comes first, so that a covered block costs one step. A
//!   block that is straight or at most 2 subsamples large is one stroke. A small block that recurs is stamped from its
//!   tile, which is put together from smaller tiles. Any other block is looked into. Broad strokes in one colour, where
//!   the order of painting is free, are painted in passes from coarse to fine.
//! - **Bottom-up** (`bottom_up`), for crowds, where many blocks overlap and each subsample is covered late: the picture
//!   of each part is composed from the pictures of the parts inside it, on a lattice.
//!
//! `strategy` chooses: every picture is begun top-down, and judged after a probe of fixed work. The panes of a large
//! picture follow the strategy of a survey of the whole picture, so that the panes fit together.
//!
//! The default ink (`blend`) is opaque, and its colours become paler or deeper with the sums of ink where many strokes are
//! finer than a hairline (`fineness`).
//!
//! # Cost
//!
//! A step visits one item: a block, a stroke or a tile. A top-down picture takes at most 1,000,000 steps in full
//! detail. Then the picture is made bottom-up, unless the drawing has more than 20,000 parts or 200,000 items in them,
//! or the pictures of its parts take more than 24 MiB at a time or 400 Mi words in all. Otherwise the picture goes on
//! top-down with outlines of ever larger blocks: their extent doubles every 100,000 steps, so that every picture ends.
//! Tiles take at most 21 MiB.
//!
//! # Exactness
//!
//! - A stroke is exact to the rounding of `f64`, at any magnification.
//! - A tile is off by at most a quarter of a subsample in each direction. The smaller tiles that it is put together
//!   from are, too.
//! - A part of a bottom-up picture is off by at most half a cell of the lattice for each level of parts inside each
//!   other, by a quarter of a cell on average: about 3 % of the drawing in all. A cell is 1, 2 or 4 subsamples wide.
//! - An outline hides the detail of its block.
//!
//! [`RenderStats`] counts parts and outlines, so that the page can inform the reader.

mod blend;
mod bottom_up;
mod canvas;
mod closeup;
mod density;
mod descent;
mod exact;
mod fineness;
mod opaque;
mod opaque_picture;
mod painter;
mod path;
mod pen;
mod pick;
mod pyramid;
mod renderer;
mod room;
mod seen;
mod shape;
mod stats;
mod strategy;
mod top_down;
mod view;
mod wide;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;

pub use closeup::{Closeup, MAX_ZOOM, seen_from};
pub(crate) use exact::{fitted_ends, fitted_outline, fitted_polygon};
pub(crate) use pick::pick;
pub use pick::{Near, segment_near};
pub use pyramid::{Pyramid, TilePlace, TileRenderer, TileShare, Tiles};
pub use renderer::Renderer;
pub use stats::RenderStats;
pub(crate) use view::{PlaneFraming, fitted_scale};
pub use view::{View, fit};
