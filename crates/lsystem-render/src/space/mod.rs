//! From a drawing's graph in space to pixels.
//!
//! The picture is the same as if every segment were drawn as a lit round stick. No stick is thinner than a pixel. A
//! pixel has 4x4 samples, and each sample shows the nearest stick. The picture is made tile by tile, and the graph is
//! descended from front to back. Blocks outside the tile or behind painted ones are not looked into. A block under half
//! a pixel is a dot with the mean colour and the mean shading of its strokes. So the cost depends on the visible
//! blocks, not on the number of segments.
//!
//! Where very many blocks lie in the same place, as in a bush that thickens without growing, even the visible blocks
//! are too many. So a picture has a budget, which a block shares out to the blocks inside. A block whose share is too
//! small to look into shows some of its strokes: those that stand out and those that face the viewer. So every picture
//! ends, and each stroke shown is part of the drawing. The budget depends on the work that the picture took with a
//! smaller budget or, while the camera moves, on the time of the picture before.
//!
//! A picture at rest has more light: ambient occlusion, soft shadows, a shade on the ground. All of it follows from two
//! depth pictures of the whole drawing, from the eye and from the sun, which come before the picture.

mod additive;
mod camera;
mod effort;
mod face;
mod ground;
mod lanes;
mod light;
mod lighting;
mod occlusion;
mod open_node;
mod opening;
mod painter;
mod path;
mod pick;
mod picture;
mod pixels;
mod place;
mod plan;
mod quality;
mod renderer;
mod samples;
mod scene;
mod setup;
mod shares;
mod size;
mod stand_in;
mod stroke;
mod sun;
mod surface;
mod tile;

#[cfg(test)]
mod tests;

pub use camera::{Camera, camera_axes};
pub(crate) use camera::{SpaceFraming, fitted_ends, fitted_polygon, fitted_scale};
pub use effort::{Effort, Spent};
pub(crate) use opening::opening_camera;
pub(crate) use pick::pick;
pub use quality::Quality;
pub use renderer::SolidRenderer;
