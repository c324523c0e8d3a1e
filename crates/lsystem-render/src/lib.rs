//! Pixels of L-systems.
//!
//! What comes in is a [`Drawing`](lsystem_drawing::Drawing), a [`Style`](lsystem_syntax::Style) and where to look; what
//! goes out are RGBA pixels, or what is drawn at a place ([`pick`], [`pick_solid`]).
//!
//! The way between: `plane` and `space` each go down the graph of the drawing, in steps of counted work.

mod plane;
mod space;

pub use plane::{
    Detail, Fitted, Pane, Pass, Pick, Pointer, RenderStats, Renderer, Target, View, Viewport, fit, fitted_ends,
    fitted_outline, fitted_polygon, fitted_scale, pick,
};
pub use space::{
    Camera, Effort, Quality, SolidRenderer, Spent, camera_axes, fitted_solid_ends, fitted_solid_polygon, pick_solid,
    solid_scale,
};
