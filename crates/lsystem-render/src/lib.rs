//! Pixels of L-systems: from a [`Figure`](lsystem_drawing::Figure), a [`Style`](lsystem_syntax::Style) and a
//! [`Vantage`] to RGBA pixels, or to the segment or polygon at a place ([`pick`]).
//!
//! A [`Renderer`] descends the graph of a drawing in the plane, a [`SolidRenderer`] that of a drawing in space; both
//! work in steps of counted work. Blocks that are covered, too small to see or outside the picture are not looked into,
//! so the cost depends on the picture and not on the number of segments. Opaque ink is painted top-down or, in crowds,
//! composed bottom-up; additive ink is summed. A [`FigureRenderer`] makes pictures of both kinds, as a whole or in
//! bands, and a [`Pyramid`] divides a picture into [`Tiles`].
//!
//! ```
//! use lsystem_base::Limits;
//! use lsystem_drawing::{Figure, System};
//! use lsystem_render::{FigureRenderer, Painted, PictureOptions, Quality, Vantage, Viewport};
//! use lsystem_syntax::{Definition, Style};
//!
//! let line = Definition { axiom: "F".into(), rules: "F -> FF".into(), ..Definition::default() };
//! let system = System::new(&line).expect("the system has no errors");
//! let mut renderer = FigureRenderer::new();
//! renderer.load(&Figure::draw(&system, 100, &Limits::default()).unwrap());
//! renderer.begin(PictureOptions {
//!     style: Style::default(),
//!     viewport: Viewport { width: 64, height: 32, ratio: 1.0 },
//!     vantage: Vantage::default(),
//!     upto: None,
//!     quality: Quality::BEST,
//!     band: 64 * 32,
//! });
//! while renderer.step(100_000) != Painted::Rows {}
//! assert_eq!(renderer.pixels().len(), 64 * 32 * 4);
//! ```

mod figure;
mod figure_renderer;
mod framing;
mod ink;
pub mod mask;
mod page_view;
mod pane;
mod plane;
mod search;
mod space;
mod vantage;
mod viewport;

pub use figure::{fitted_ends, fitted_outline, fitted_polygon, fitted_scale, opening_camera, pick};
pub use figure_renderer::{BAND_PIXEL, FigureRenderer, Painted, PictureOptions};
pub use framing::Framing;
pub use page_view::{PageCamera, PageView};
pub use pane::{Pane, Pass};
pub use plane::{
    Closeup, MAX_ZOOM, Near, Pyramid, RenderStats, Renderer, TilePlace, TileRenderer, TileShare, Tiles, View, fit,
    seen_from, segment_near,
};
pub use search::{Pick, Pointer, Target};
pub use space::{Camera, Effort, Quality, SolidRenderer, Spent, camera_axes};
pub use vantage::Vantage;
pub use viewport::{Detail, Viewport};
