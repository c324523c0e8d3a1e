//! Films of L-systems.
//!
//! A [`Script`] gives a film's length and size, and the numbers that change with time: the generation, angles, the
//! seed, constants, numbers of the style, the view, the camera, and the part of the segments that is drawn. A script is
//! a short text, which links and files hold:
//!
//! ```
//! use lsystem_film::{Film, Script};
//! use lsystem_render::Vantage;
//! use lsystem_syntax::Definition;
//!
//! let script: Script = "1;5s;25fps;640x360;n=0:0,4:6;angle=0:20,5:30~smooth".parse().unwrap();
//! let fern = Definition { axiom: "F".into(), rules: "F -> F[+F]F[-F]F".into(), ..Definition::default() };
//! let film = Film::new(script, fern, Vantage::default()).unwrap();
//! assert_eq!(film.frames(), 125);
//! // At 1.8 seconds the third generation has grown to 70 %.
//! let frame = film.frame(45);
//! assert_eq!(frame.definition.iterations, 3);
//! assert!((frame.definition.growth - 0.7).abs() < 1e-9);
//! ```
//!
//! A [`Film`] is a script with the system and the view that it begins with. [`Film::frame`] makes a frame's definition
//! and view from the number of the frame alone, so that frames can be made in any order, by any number of workers. A
//! [`Painter`] makes pixels of a frame, and [`GifWriter`] a file of pixels. All frames are streamed: the memory does
//! not depend on the length of a film.
//!
//! Equal films have equal frames on all machines, because a frame's numbers and pixels depend on counted work and on
//! functions of `libm` only.

mod easing;
mod subject;
mod track;

mod error;
mod script;
mod text;

mod film;
mod preset;
mod view;

mod gif;
mod painter;
mod palette;

pub use easing::Easing;

pub use film::{Film, Frame};
pub use gif::GifWriter;
pub use painter::{LIMITS, Painter};
pub use palette::{IndexedFrame, Palette, PaletteMaker, palette_samples};
pub use preset::{
    Preset, dive, dive_in_space, dive_to, grow, turntable, turtle, vantage_of_segment, wind, wind_strength,
};
pub use script::{Ending, MAX_GIF_RATE, Script};
pub use subject::Subject;
pub use track::{Keyframe, Track};
