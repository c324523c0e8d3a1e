//! Pixels of L-systems.
//!
//! Input: a [`Drawing`](lsystem_drawing::Drawing), a [`Style`](lsystem_syntax::Style) and a [`View`] or a [`Camera`].
//! Output: RGBA pixels, or the segment or polygon at a place ([`pick`], [`pick_solid`]).
//!
//! `plane` and `space` each descend the graph of the drawing, in steps of counted work.

pub mod mask;
mod page;
mod plane;
mod space;

pub use page::{PageCamera, PageView};
pub use plane::{
    Detail, Fitted, Pane, Pass, Pick, Pointer, Pyramid, RenderStats, Renderer, Share, Target, TilePlace, TileRenderer,
    Tiles, View, Viewport, fit, fitted_ends, fitted_outline, fitted_polygon, fitted_scale, pick,
};
pub use space::{
    Camera, Effort, Quality, SolidRenderer, Spent, camera_axes, fitted_solid_ends, fitted_solid_polygon, pick_solid,
    solid_scale,
};
