//! File formats: systems as JSON, in links and typeset, drawings as SVG, PDF, TikZ and CSV, meshes as OBJ and glTF, and
//! pictures that hold their system.

mod compact;
mod csv;
mod embed;
mod formats;
mod gltf;
mod json;
mod json_write;
pub mod link;
mod mesh_file;
mod number;
mod obj;
mod option_table;
mod options;
pub mod packed;
mod paper;
mod plotter;
mod png;
mod png_writer;
mod segments;
mod sheet;
mod stl;
mod strokes;
mod svg;
mod xml;

pub use csv::{CsvWriter, write_csv};
pub use embed::{FileContent, read_file, text_of};
pub use formats::{Content, FORMATS, Format, Purpose, Writer, write_all};
pub use gltf::{GlbWriter, write_glb};
pub use json::read_json;
pub use json_write::write_json;
pub use link::{Link, LinkProblem, read_link};
pub use obj::{ObjWriter, write_obj};
pub use option_table::{FILE_OPTIONS, FileOption, OptionKind, OptionValue};
pub use options::FileOptions;
pub use paper::{PdfWriter, TikzLibraryWriter, TikzWriter, bibtex, latex, markdown};
pub use plotter::{Corner, PlotOptions, PlotSummary, PlotWriter};
pub use png::tag_png;
pub use png_writer::{PngOptions, PngWriter};
pub use segments::{SegmentError, SegmentFile, SegmentForm, read_segments};
pub use sheet::{INCH, SHEETS, Sheet};
pub use stl::StlWriter;
pub use svg::{Svg, SvgForm, SvgOptions, SvgWriter, write_svg};
