//! File formats: systems as JSON, in links and typeset; drawings as SVG, PDF, TikZ, CSV and plots; meshes as OBJ, glTF,
//! STL and OpenSCAD; PNG pictures; the turtle's walk as MIDI.
//!
//! [`FORMATS`] is the table of all formats that are written, [`FILE_OPTIONS`] that of the choices for them. [`make`]
//! writes a file of any format from a definition and its system. It is straight code over a [`Sink`], which hands
//! pieces of the file to an [`Owner`], counts work and may stop it. [`read_file`] reads the system back from JSON and
//! from pictures that hold it, [`read_link`] from a link of the page (which [`write_link`] writes), and [`read_segments`] reads the drawings of other
//! programs.
//!
//! ```
//! use lsystem_files::{read_json, write_json};
//! use lsystem_syntax::Definition;
//!
//! let koch = Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), angle: 60.0, ..Definition::default() };
//! let (read, diagnostics) = read_json(&write_json(&koch));
//! assert_eq!((read, diagnostics), (Some(koch), vec![]));
//! ```

mod compact;
mod csv;
mod edit;
mod embed;
mod formats;
mod gltf;
mod json;
mod json_write;
pub mod link;
mod link_write;
mod make;
mod mesh_file;
mod mesh_shape;
mod midi;
mod number;
mod obj;
mod option_table;
mod options;
pub mod packed;
mod page_limits;
mod paper;
mod pen;
mod plot_svg;
mod png;
mod png_writer;
mod print;
mod scad;
mod segments;
mod sink;
mod stl;
mod strokes;
mod svg;
mod xml;

pub use csv::write_csv;
pub use edit::edit_file;
pub use embed::{FileContent, read_file, text_of};
pub use formats::{Content, FORMATS, Format, PNG, Purpose};
pub use gltf::write_glb;
pub use json::{read_fields, read_json};
pub use json_write::write_json;
pub use link::{Link, LinkProblem, read_link, read_link_within};
pub use link_write::write_link;
pub use make::{FileLimits, FileTask, FileView, make, make_with, write_pixels};
pub use mesh_shape::mesh_shape;
pub use obj::write_obj;
pub use option_table::{FILE_OPTIONS, FileOption, OptionKind, OptionValue};
pub use options::FileOptions;
pub use paper::{LATEX_START, bibtex, latex, markdown, write_tikz_library};
pub use plot_svg::write_plot;
pub use png_writer::{PngOptions, write_png};
pub use print::{Print, thin_strokes};
pub use segments::{SegmentError, SegmentFile, SegmentForm, read_segments};
pub use sink::{Notes, Owner, Sink, WriteResult, collect};
pub use stl::write_stl;
pub use svg::{Svg, SvgForm, SvgOptions, write_svg};
