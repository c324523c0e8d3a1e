//! The table of export formats. The program and the page take names, words and writers from it.
//!
//! A new format needs a writer in its own file and a row here.

use super::{
    CsvWriter, FileOptions, PdfWriter, PlotWriter, SvgForm, SvgOptions, SvgWriter, TikzLibraryWriter, TikzWriter,
    bibtex, latex, markdown, mesh_file,
};
use lsystem_drawing::{Drawing, Solid, Space, System};
use lsystem_syntax::{Definition, Diagnostic, Progress, Style};
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
    /// The names of the choices that the format reads, in the order of [`FILE_OPTIONS`](crate::FILE_OPTIONS).
    pub options: &'static [&'static str],
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

    /// The purpose's label on the page.
    #[must_use]
    pub const fn label(self) -> &'static str {
        match self {
            Self::Screen => "Screen",
            Self::Film => "Film",
            Self::Plotter => "Plotter",
            Self::Paper => "Paper",
            Self::Print => "Print",
            Self::Mesh => "3D",
            Self::Data => "Data",
        }
    }
}

/// The writer of a file, or the diagnostic for an exceeded limit.
pub(super) type WriterResult = Result<Box<dyn Writer>, Diagnostic>;

/// The input of a file, with the function that makes its writer.
#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// The system, written by [`write_json`](crate::write_json).
    System,
    /// The derived string.
    String,
    /// A definition and its system, in another notation.
    Words(fn(&Definition, &System, &FileOptions) -> WriterResult),
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
    /// A mesh of tubes. A drawing in the plane becomes one in space.
    Mesh(fn(Arc<Drawing<Solid>>, Style, &FileOptions) -> WriterResult),
}

impl Content {
    /// The content's name in scripts.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::System => "system",
            Self::String => "string",
            Self::Pixels => "pixels",
            Self::Paper(_) => "strokes",
            Self::Segments { .. } => "segments",
            Self::Words(_) => "words",
            Self::Mesh(_) => "mesh",
        }
    }
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
pub static FORMATS: [Format; 16] = [
    Format {
        name: "svg",
        ending: "svg",
        mime: "image/svg+xml",
        label: "SVG",
        help: "Picture of strokes",
        purpose: Purpose::Screen,
        content: Content::Paper(|drawing, style, options| svg(drawing, style, options, SvgForm::Flat)),
        options: &["transparent", "bare"],
    },
    Format {
        name: "svg-compact",
        ending: "svg",
        mime: "image/svg+xml",
        label: "Compact SVG",
        help: "Picture of strokes with each reusable part written once: a small file at any number of iterations",
        purpose: Purpose::Screen,
        content: Content::Paper(|drawing, style, options| svg(drawing, style, options, SvgForm::Compact)),
        options: &["transparent", "bare"],
    },
    Format {
        name: "plotter",
        ending: "svg",
        mime: "image/svg+xml",
        label: "Plotter SVG",
        help: "Lines for a pen plotter, in millimetres: a layer for each colour, drawn once, with little travel",
        purpose: Purpose::Plotter,
        content: Content::Paper(|drawing, style, options| Ok(Box::new(PlotWriter::new(drawing, style, options)))),
        options: &[
            "sheet",
            "portrait",
            "landscape",
            "margin",
            "pen",
            "hatch",
            "start",
            "min-length",
            "speed",
            "travel-speed",
            "lift",
        ],
    },
    Format {
        name: "png",
        ending: "png",
        mime: "image/png",
        label: "PNG",
        help: "Picture of pixels",
        purpose: Purpose::Screen,
        content: Content::Pixels,
        options: &["size", "dpi", "transparent", "bare"],
    },
    Format {
        name: "pdf",
        ending: "pdf",
        mime: "application/pdf",
        label: "PDF",
        help: "Page of strokes",
        purpose: Purpose::Paper,
        content: Content::Paper(|drawing, style, options| {
            PdfWriter::new(drawing, style, options).map(|writer| Box::new(writer) as Box<dyn Writer>)
        }),
        options: &["sheet", "landscape", "margin", "whole-sheet", "bare"],
    },
    Format {
        name: "tikz",
        ending: "tikz",
        mime: "text/x-tex",
        label: "TikZ",
        help: "Picture of strokes for LaTeX",
        purpose: Purpose::Paper,
        content: Content::Paper(|drawing, style, options| {
            TikzWriter::new(drawing, style, options).map(|writer| Box::new(writer) as Box<dyn Writer>)
        }),
        options: &[],
    },
    Format {
        name: "tikz-library",
        ending: "tikz",
        mime: "text/x-tex",
        label: "TikZ L-system",
        help: "System for TikZ's library lindenmayersystems, which draws simple systems while LaTeX runs",
        purpose: Purpose::Paper,
        content: Content::Words(|definition, system, options| {
            TikzLibraryWriter::new(definition, system, options).map(|writer| Box::new(writer) as Box<dyn Writer>)
        }),
        options: &[],
    },
    Format {
        name: "latex",
        ending: "tex",
        mime: "text/x-tex",
        label: "LaTeX",
        help: "System typeset as in books: axiom, productions, constants and angles",
        purpose: Purpose::Paper,
        content: Content::Words(|definition, system, _| text(latex(definition, system))),
        options: &[],
    },
    Format {
        name: "markdown",
        ending: "md",
        mime: "text/markdown",
        label: "Markdown",
        help: "System as a list: axiom, productions, constants and angles",
        purpose: Purpose::Paper,
        content: Content::Words(|definition, system, _| text(markdown(definition, system))),
        options: &[],
    },
    Format {
        name: "bibtex",
        ending: "bib",
        mime: "text/x-bibtex",
        label: "BibTeX",
        help: "Entries of the system's source and of its picture",
        purpose: Purpose::Paper,
        content: Content::Words(|definition, system, _| text(bibtex(definition, system))),
        options: &[],
    },
    Format {
        name: "json",
        ending: "json",
        mime: "application/json",
        label: "JSON",
        help: "System, to open again",
        purpose: Purpose::Data,
        content: Content::System,
        options: &[],
    },
    Format {
        name: "txt",
        ending: "txt",
        mime: "text/plain",
        label: "Text",
        help: "Derived string",
        purpose: Purpose::Data,
        content: Content::String,
        options: &[],
    },
    Format {
        name: "csv",
        ending: "csv",
        mime: "text/csv",
        label: "CSV",
        help: "Segments as a table: x0,y0,x1,y1,level,colour; in space x0,y0,z0,x1,y1,z1,level,colour",
        purpose: Purpose::Data,
        content: Content::Segments { plane: csv, space: csv },
        options: &[],
    },
    Format {
        name: "obj",
        ending: "obj",
        mime: "model/obj",
        label: "OBJ",
        help: "Mesh of coloured tubes, as text",
        purpose: Purpose::Mesh,
        content: Content::Mesh(mesh_file::obj),
        options: &["finest"],
    },
    Format {
        name: "glb",
        ending: "glb",
        mime: "model/gltf-binary",
        label: "glTF",
        help: "Tubes and leaves with materials, as binary glTF: each reusable part is written once, for viewers and game engines",
        purpose: Purpose::Mesh,
        content: Content::Mesh(mesh_file::glb),
        options: &["finest"],
    },
    Format {
        name: "stl",
        ending: "stl",
        mime: "model/stl",
        label: "STL",
        help: "Mesh of closed tubes and slabs for printers, 100 mm long",
        purpose: Purpose::Mesh,
        content: Content::Mesh(mesh_file::stl),
        options: &["finest"],
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

/// A short text, written in one step: a system has texts of at most 1 MiB.
struct TextWriter(Vec<u8>);

fn text(text: String) -> WriterResult {
    Ok(Box::new(TextWriter(text.into_bytes())))
}

impl Writer for TextWriter {
    fn step(&mut self, file: &mut Vec<u8>, _: u64) -> Result<Progress, Diagnostic> {
        file.append(&mut self.0);
        Ok(Progress::Done)
    }
}

struct SvgFile {
    writer: SvgWriter,
    drawing: Arc<Drawing>,
    style: Style,
}

fn svg(drawing: Arc<Drawing>, style: Style, options: &FileOptions, form: SvgForm) -> WriterResult {
    let FileOptions { title, description, system, most, transparent, .. } = options.clone();
    let options = SvgOptions { title, description, system, most, form, transparent, ..SvgOptions::default() };
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
