//! File formats: systems as JSON and in links, drawings as SVG and CSV, meshes as OBJ and glTF, and pictures that hold
//! their system.

mod csv;
mod embed;
mod formats;
mod gltf;
mod import;
mod json;
mod json_write;
mod lines;
mod link;
mod number;
mod obj;
mod options;
pub mod packed;
mod plotter;
mod png;
mod segments;
mod sheet;
mod svg;
mod xml;

pub use csv::{CsvWriter, write_csv};
pub use embed::{FileContent, import_file, read_file};
pub use formats::{Content, FORMATS, Format, Purpose, Writer, write_all};
pub use gltf::{GlbWriter, write_glb};
pub use import::{Entry, Imported, MAX_ENTRIES, Remark, import};
pub use json::read_json;
pub use json_write::write_json;
pub use link::{Link, LinkProblem, read_link};
pub use obj::{ObjWriter, write_obj};
pub use options::FileOptions;
pub use plotter::{Corner, PlotOptions, PlotSummary, PlotWriter};
pub use png::tag_png;
pub use segments::{SegmentError, SegmentFile, SegmentForm, read_segments};
pub use sheet::{INCH, SHEETS, Sheet};
pub use svg::{Svg, SvgForm, SvgOptions, SvgWriter, write_svg};
