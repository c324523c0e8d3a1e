//! The table of export formats. The program and the page take names, words and writers from it.
//!
//! A new format needs a writer in its own file and a row here.

use super::csv::csv_file;
use super::paper::{write_pdf, write_tikz, write_tikz_library};
use super::svg::{svg_file, warning};
use super::{
    FileOptions, Notes, Sink, SvgForm, SvgOptions, WriteResult, bibtex, latex, markdown, mesh_file, write_plot,
};
use lsystem_drawing::{Drawing, Solid, System};
use lsystem_syntax::{Definition, Halt, Style};
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
    /// The purposes of the format's files.
    pub purposes: &'static [Purpose],
    /// Whether the format's files are no text.
    pub is_binary: bool,
    /// Whether all parts of a file are in memory before the first one is written.
    pub is_made_in_memory: bool,
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
    /// Notes for instruments.
    Sound,
    /// Systems, strings and tables, to open again or to compute with.
    Data,
}

impl Purpose {
    /// All purposes, in the order of the page's dialog.
    pub const ALL: [Self; 8] =
        [Self::Screen, Self::Film, Self::Plotter, Self::Paper, Self::Print, Self::Mesh, Self::Sound, Self::Data];

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
            Self::Sound => "sound",
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
            Self::Paper => "Article",
            Self::Print => "Poster",
            Self::Mesh => "3D",
            Self::Sound => "Sound",
            Self::Data => "Data",
        }
    }
}

/// The input of a file, with the function that writes it. A limit is an error before the first byte.
#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// The system, written by [`write_json`](crate::write_json).
    System,
    /// The derived string.
    String,
    /// A definition and its system, in another notation.
    Words(fn(&Definition, &System, &FileOptions, &mut Sink<'_>) -> WriteResult),
    /// Pixels, made by a renderer.
    Pixels,
    /// Strokes in the plane. A drawing in space is projected first.
    Paper(fn(Arc<Drawing>, &Style, &FileOptions, &mut Sink<'_>) -> WriteResult),
    /// Segments in the plane or in space. The number is the most segments and vertices of polygons.
    Segments {
        /// Writes a drawing in the plane.
        plane: fn(&Drawing, u64, &mut Sink<'_>) -> Result<(), Halt>,
        /// Writes a drawing in space.
        space: fn(&Drawing<Solid>, u64, &mut Sink<'_>) -> Result<(), Halt>,
    },
    /// The notes of the turtle's walk.
    Sound,
    /// A mesh of tubes. A drawing in the plane becomes one in space.
    Mesh(fn(Arc<Drawing<Solid>>, &Style, &FileOptions, &mut Sink<'_>) -> WriteResult),
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
            Self::Sound => "sound",
            Self::Mesh(_) => "mesh",
        }
    }
}

const GLB: &str =
    "Tubes and leaves with materials, as binary glTF: each reusable part is written once, for viewers and game engines";

/// The format of pictures of pixels.
pub const PNG: Format = format("png", "png", "image/png", "PNG")
    .help("Picture of pixels")
    .of(&[Purpose::Screen, Purpose::Print], Content::Pixels)
    .binary()
    .reads(&["size", "dpi", "transparent", "bare"]);

/// All formats, in the order of the page's list.
pub static FORMATS: [Format; 18] = [
    format("svg", "svg", "image/svg+xml", "SVG")
        .help("Picture of strokes")
        .of(
            &[Purpose::Screen],
            Content::Paper(|drawing, style, options, sink| picture(&drawing, style, options, SvgForm::Flat, sink)),
        )
        .reads(&["transparent", "bare"]),
    format("svg-compact", "svg", "image/svg+xml", "Compact SVG")
        .help("Picture of strokes with each reusable part written once: a small file at any number of iterations")
        .of(
            &[Purpose::Screen],
            Content::Paper(|drawing, style, options, sink| picture(&drawing, style, options, SvgForm::Compact, sink)),
        )
        .made_in_memory()
        .reads(&["transparent", "bare"]),
    format("plotter", "svg", "image/svg+xml", "Plotter SVG")
        .help("Lines for a pen plotter, in millimetres: a layer for each colour, drawn once, with little travel")
        .of(
            &[Purpose::Plotter],
            Content::Paper(|drawing, style, options, sink| {
                let summary = write_plot(drawing, style, options, sink)?.words(&options.plot);
                Ok(Notes { summary: Some(summary), ..Notes::default() })
            }),
        )
        .reads(&[
            "sheet",
            "portrait",
            "landscape",
            "margin",
            "pen",
            "hatch",
            "hide",
            "start",
            "min-length",
            "speed",
            "travel-speed",
            "lift",
        ]),
    PNG,
    format("pdf", "pdf", "application/pdf", "PDF")
        .help("Page of strokes")
        .of(
            &[Purpose::Paper],
            Content::Paper(|drawing, style, options, sink| write_pdf(&drawing, style, options, sink)),
        )
        .binary()
        .reads(&["sheet", "landscape", "margin", "whole-sheet", "bare"]),
    format("tikz", "tikz", "text/x-tex", "TikZ").help("Picture of strokes for LaTeX").of(
        &[Purpose::Paper],
        Content::Paper(|drawing, style, options, sink| write_tikz(&drawing, style, options, sink)),
    ),
    format("tikz-library", "tikz", "text/x-tex", "TikZ L-system")
        .help("System for TikZ's library lindenmayersystems, which draws simple systems while LaTeX runs")
        .of(&[Purpose::Paper], Content::Words(write_tikz_library)),
    format("latex", "tex", "text/x-tex", "LaTeX")
        .help("System typeset as in books: axiom, productions, constants and angles")
        .of(&[Purpose::Paper], Content::Words(|definition, system, _, sink| words(&latex(definition, system), sink))),
    format("markdown", "md", "text/markdown", "Markdown")
        .help("System as a list: axiom, productions, constants and angles")
        .of(
            &[Purpose::Paper],
            Content::Words(|definition, system, _, sink| words(&markdown(definition, system), sink)),
        ),
    format("bibtex", "bib", "text/x-bibtex", "BibTeX")
        .help("Entries of the system's source and of its picture")
        .of(&[Purpose::Paper], Content::Words(|definition, system, _, sink| words(&bibtex(definition, system), sink))),
    format("midi", "mid", "audio/midi", "MIDI")
        .help("Walk of the turtle as notes: lines are notes, branches are voices")
        .of(&[Purpose::Sound], Content::Sound)
        .binary()
        .reads(&["pitch", "time", "scale", "octaves", "tempo", "notes"]),
    format("json", "json", "application/json", "JSON")
        .help("System, to open again")
        .of(&[Purpose::Data], Content::System),
    format("txt", "txt", "text/plain", "Text").help("Derived string").of(&[Purpose::Data], Content::String),
    format("csv", "csv", "text/csv", "CSV")
        .help("Segments as a table: x0,y0,x1,y1,level,colour; in space x0,y0,z0,x1,y1,z1,level,colour")
        .of(&[Purpose::Data], Content::Segments { plane: csv_file, space: csv_file }),
    format("obj", "obj", "model/obj", "OBJ")
        .help("Mesh of coloured tubes, as text")
        .of(&[Purpose::Mesh], Content::Mesh(mesh_file::obj))
        .made_in_memory()
        .reads(&["finest", "height"]),
    format("glb", "glb", "model/gltf-binary", "glTF")
        .help(GLB)
        .of(&[Purpose::Mesh], Content::Mesh(mesh_file::glb))
        .binary()
        .made_in_memory()
        .reads(&["finest", "height"]),
    format("stl", "stl", "model/stl", "STL")
        .help("Closed tubes and slabs for printers, in millimetres, on a foot")
        .of(&[Purpose::Mesh], Content::Mesh(mesh_file::print::<false>))
        .binary()
        .made_in_memory()
        .reads(&["finest", "height", "thinnest", "foot"]),
    format("scad", "scad", "application/x-openscad", "OpenSCAD")
        .help("Union of convex bodies for OpenSCAD, in millimetres, to cut and to join with other solids")
        .of(&[Purpose::Mesh], Content::Mesh(mesh_file::print::<true>))
        .made_in_memory()
        .reads(&["finest", "height", "thinnest", "foot"]),
];

/// A row with its name, the ending of file names, the media type and the label.
const fn format(name: &'static str, ending: &'static str, mime: &'static str, label: &'static str) -> Format {
    let (purposes, options, content) = (&[], &[], Content::System);
    Format {
        name,
        ending,
        mime,
        label,
        help: "",
        purposes,
        is_binary: false,
        is_made_in_memory: false,
        content,
        options,
    }
}

impl Format {
    const fn help(self, help: &'static str) -> Self {
        Self { help, ..self }
    }

    const fn of(self, purposes: &'static [Purpose], content: Content) -> Self {
        Self { purposes, content, ..self }
    }

    const fn binary(self) -> Self {
        Self { is_binary: true, ..self }
    }

    const fn made_in_memory(self) -> Self {
        Self { is_made_in_memory: true, ..self }
    }

    const fn reads(self, options: &'static [&'static str]) -> Self {
        Self { options, ..self }
    }

    /// The format with this name, if any.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        FORMATS.iter().find(|format| format.name == name)
    }

    /// Whether the format's files show the drawing.
    #[must_use]
    pub fn shows_drawing(&self) -> bool {
        !matches!(self.content, Content::System | Content::String | Content::Words(_))
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

/// Writes a short text: a system has texts of at most 1 MiB.
fn words(text: &str, sink: &mut Sink<'_>) -> Result<Notes, Halt> {
    sink.text.push_str(text);
    Ok(Notes::default())
}

fn picture(
    drawing: &Drawing,
    style: &Style,
    options: &FileOptions,
    form: SvgForm,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    let FileOptions { title, description, system, most, transparent, .. } = options.clone();
    let options = SvgOptions { title, description, system, most, form, transparent, ..SvgOptions::default() };
    let painted = svg_file(drawing, style, &options, sink)?;
    Ok(Notes { remark: warning(painted, style.ink), ..Notes::default() })
}
