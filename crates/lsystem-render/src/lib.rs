//! Pixels of L-systems.
//!
//! Input: a [`Figure`](lsystem_drawing::Figure), a [`Style`](lsystem_syntax::Style) and a [`Vantage`]. Output: RGBA
//! pixels ([`FigureRenderer`]), or the segment or polygon at a place ([`pick`]).
//!
//! `plane` and `space` each descend the graph of the drawing, in steps of counted work.

mod figure;
mod figure_renderer;
pub mod mask;
mod page;
mod plane;
mod space;
mod vantage;

pub use figure::{fitted_ends, fitted_outline, fitted_polygon, fitted_scale, pick};
pub use figure_renderer::{BAND_PIXEL, FigureRenderer, Painted, PictureOptions};
pub use page::{PageCamera, PageView};
pub use plane::{
    Detail, Pane, Pass, Pick, Pointer, Pyramid, RenderStats, Renderer, Share, Target, TilePlace, TileRenderer, Tiles,
    View, Viewport, fit,
};
pub use space::{Camera, Effort, Quality, SolidRenderer, Spent, camera_axes};
pub use vantage::Vantage;
