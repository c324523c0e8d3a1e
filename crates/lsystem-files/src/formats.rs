//! The table of export formats. The program and the page take names, words and writers from it.
//!
//! A new format needs a writer in its own file and a row here.

use super::{CsvWriter, FileOptions, GlbWriter, ObjWriter, PlotWriter, SvgForm, SvgOptions, SvgWriter};
use lsystem_drawing::{Drawing, Mesh, Solid, Space};
use lsystem_syntax::{Diagnostic, Progress, Style};
use std::sync::Arc;

/// An export format: a row of [`FORMATS`].
pub struct Format {
    /// The format's name for the program and for scripts.
    pub name: &'static str,
    /// The ending of file names, without a dot.
    pub ending: &'static str,
    /// The media type.
    pub mime: &'static str,
    /// The label on the page.
    pub label: &'static str,
    /// A description, as a noun phrase.
    pub help: &'static str,
    /// The purpose of the format's files.
    pub purpose: Purpose,
    /// The input of the format's writer.
    pub content: Content,
}

/// The purpose of a file: the groups of the page's save dialog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Pictures for screens.
    Screen,
    /// Films of growth and of moving views.
    Film,
    /// Strokes for pen plotters.
    Plotter,
    /// Figures and formulas for papers.
    Paper,
    /// Large pictures for printers.
    Print,
    /// Meshes for viewers and for printers in space.
    Mesh,
    /// Systems, strings and tables, to open again or to compute with.
    Data,
}

impl Purpose {
    /// All purposes, in the order of the page's dialog.
    pub const ALL: [Self; 7] =
        [Self::Screen, Self::Film, Self::Plotter, Self::Paper, Self::Print, Self::Mesh, Self::Data];

    /// The purpose's name in scripts.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Screen => "screen",
            Self::Film => "film",
            Self::Plotter => "plotter",
            Self::Paper => "paper",
            Self::Print => "print",
            Self::Mesh => "mesh",
            Self::Data => "data",
        }
    }
}

/// The writer of a file, or the diagnostic for an exceeded limit.
type WriterResult = Result<Box<dyn Writer>, Diagnostic>;

/// The input of a file, with the function that makes its writer.
#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// The system, written by [`write_json`](crate::write_json).
    System,
    /// The derived string.
    String,
    /// Pixels, made by a renderer.
    Pixels,
    /// Strokes in the plane. A drawing in space is projected first.
    Paper(fn(Arc<Drawing>, Style, &FileOptions) -> WriterResult),
    /// Segments in the plane or in space. The number is the most segments and vertices of polygons.
    Segments {
        /// The writer for a drawing in the plane.
        plane: fn(Arc<Drawing>, u64) -> WriterResult,
        /// The writer for a drawing in space.
        space: fn(Arc<Drawing<Solid>>, u64) -> WriterResult,
    },
    /// A mesh of coloured tubes, with its name.
    Mesh(fn(Mesh, &str) -> Box<dyn Writer>),
}

/// A writer that makes a file in steps.
pub trait Writer {
    /// Appends to the file for about `work` units of work.
    ///
    /// # Errors
    /// If a limit is exceeded.
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic>;

    /// A warning about the file, after all steps are done; `None` if there is none.
    fn remark(&self) -> Option<Diagnostic> {
        None
    }

    /// Facts about the file as a line of text, after all steps are done; `None` if there are none to tell.
    fn summary(&self) -> Option<String> {
        None
    }
}

/// All formats, in the order of the page's list.
pub static FORMATS: [Format; 9] = [
    Format {
        name: "svg",
        ending: "svg",
        mime: "image/svg+xml",
        label: "SVG",
        help: "Picture of strokes",
        purpose: Purpose::Screen,
        content: Content::Paper(|drawing, style, options| svg(drawing, style, options, SvgForm::Flat)),
    },
    Format {
        name: "svg-compact",
        ending: "svg",
        mime: "image/svg+xml",
        label: "Compact SVG",
        help: "Picture of strokes with each reusable part written once: a small file at any number of iterations",
        purpose: Purpose::Screen,
        content: Content::Paper(|drawing, style, options| svg(drawing, style, options, SvgForm::Compact)),
    },
    Format {
        name: "plotter",
        ending: "svg",
        mime: "image/svg+xml",
        label: "Plotter SVG",
        help: "Lines for a pen plotter, in millimetres: a layer for each colour, drawn once, with little travel",
        purpose: Purpose::Plotter,
        content: Content::Paper(|drawing, style, options| Ok(Box::new(PlotWriter::new(drawing, style, options)))),
    },
    Format {
        name: "png",
        ending: "png",
        mime: "image/png",
        label: "PNG",
        help: "Picture of pixels",
        purpose: Purpose::Screen,
        content: Content::Pixels,
    },
    Format {
        name: "json",
        ending: "json",
        mime: "application/json",
        label: "JSON",
        help: "System, to open again",
        purpose: Purpose::Data,
        content: Content::System,
    },
    Format {
        name: "txt",
        ending: "txt",
        mime: "text/plain",
        label: "Text",
        help: "Derived string",
        purpose: Purpose::Data,
        content: Content::String,
    },
    Format {
        name: "csv",
        ending: "csv",
        mime: "text/csv",
        label: "CSV",
        help: "Segments as a table: x0,y0,x1,y1,level,colour; in space x0,y0,z0,x1,y1,z1,level,colour",
        purpose: Purpose::Data,
        content: Content::Segments { plane: csv, space: csv },
    },
    Format {
        name: "obj",
        ending: "obj",
        mime: "model/obj",
        label: "OBJ",
        help: "Mesh of coloured tubes, as text",
        purpose: Purpose::Mesh,
        content: Content::Mesh(|mesh, name| Box::new(Obj { writer: ObjWriter::new(&mesh, name), mesh })),
    },
    Format {
        name: "glb",
        ending: "glb",
        mime: "model/gltf-binary",
        label: "glTF",
        help: "Mesh of coloured tubes, as binary glTF: for viewers, printers and game engines",
        purpose: Purpose::Mesh,
        content: Content::Mesh(|mesh, name| Box::new(Glb { writer: GlbWriter::new(&mesh, name), mesh })),
    },
];

impl Format {
    /// The format with this name, if any.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        FORMATS.iter().find(|format| format.name == name)
    }

    /// Whether the format's files are pictures.
    #[must_use]
    pub fn is_picture(&self) -> bool {
        matches!(self.content, Content::Paper(_) | Content::Pixels)
    }
}

impl core::fmt::Debug for Format {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.write_str(self.name)
    }
}

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// Runs a writer to its end, and returns the whole file.
///
/// # Errors
/// As [`Writer::step`].
pub fn write_all(writer: &mut dyn Writer) -> Result<Vec<u8>, Diagnostic> {
    let mut file = Vec::new();
    while writer.step(&mut file, u64::MAX)? == Progress::More {}
    Ok(file)
}

/// Appends text to a file of bytes.
pub(super) fn append(
    file: &mut Vec<u8>,
    write: impl FnOnce(&mut String) -> Result<Progress, Diagnostic>,
) -> Result<Progress, Diagnostic> {
    let mut text = String::new();
    let progress = write(&mut text)?;
    // Avoids a second copy of a file that is written in one step.
    if file.is_empty() {
        *file = text.into_bytes();
    } else {
        file.append(&mut text.into_bytes());
    }
    Ok(progress)
}

struct SvgFile {
    writer: SvgWriter,
    drawing: Arc<Drawing>,
    style: Style,
}

fn svg(drawing: Arc<Drawing>, style: Style, options: &FileOptions, form: SvgForm) -> WriterResult {
    let FileOptions { title, description, system, most, .. } = options.clone();
    let options = SvgOptions { title, description, system, most, form, ..SvgOptions::default() };
    Ok(Box::new(SvgFile { writer: SvgWriter::new(&drawing, &style, &options)?, drawing, style }))
}

impl Writer for SvgFile {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        append(file, |text| self.writer.step(&self.drawing, &self.style, text, work))
    }

    fn remark(&self) -> Option<Diagnostic> {
        self.writer.warning()
    }
}

struct Csv<S: Space> {
    writer: CsvWriter<S>,
    drawing: Arc<Drawing<S>>,
}

fn csv<S: Space + 'static>(drawing: Arc<Drawing<S>>, most: u64) -> WriterResult {
    Ok(Box::new(Csv { writer: CsvWriter::new(&drawing, most)?, drawing }))
}

impl<S: Space> Writer for Csv<S> {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        append(file, |text| Ok(self.writer.step(&self.drawing, text, work)))
    }
}

struct Obj {
    writer: ObjWriter,
    mesh: Mesh,
}

impl Writer for Obj {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        append(file, |text| Ok(self.writer.step(&self.mesh, text, work)))
    }
}

struct Glb {
    writer: GlbWriter,
    mesh: Mesh,
}

impl Writer for Glb {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        Ok(self.writer.step(&self.mesh, file, work))
    }
}
