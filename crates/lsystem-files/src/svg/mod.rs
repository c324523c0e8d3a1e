//! Drawings as Scalable Vector Graphics, in two forms.

mod compact;
mod features;
mod flat;
mod paths;
mod plan;
mod scene;
mod writer;

use super::number::Decimals;
use core::fmt::Write;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Diagnostic, Field, Ink, Kind, Progress, Style};
use paths::attribute;
pub use writer::SvgWriter;

/// How a drawing becomes an SVG picture.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgOptions {
    /// The picture's title; none where empty.
    pub title: String,
    /// Its description, for people who do not see it; none where empty.
    pub description: String,
    /// The system as [`write_json`](crate::write_json) gives it, kept in the file so that
    /// [`read_file`](crate::read_file) finds it again; none where empty.
    pub system: String,
    /// How much of the drawing's graph the file keeps.
    pub form: SvgForm,
    /// The longer side of the picture, in CSS pixels.
    pub size: f64,
    /// The most segments and vertices of polygons to write; of the compact form, placed blocks too.
    pub most: u64,
}

/// The forms of an SVG file; they look the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SvgForm {
    /// Every segment, in drawing order.
    #[default]
    Flat,
    /// Every block once, and then placed: a file of some kilobytes at any n. Blocks under a pixel across at the
    /// picture's size are one stroke. A drawing that does not memoise, or whose colours follow the path, has nothing to
    /// share and is written flat.
    Compact,
}

/// An SVG file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Svg {
    /// Its text.
    pub text: String,
    /// How many copies of blocks whoever shows it has to make: every `<use>` counts as often as it is met when all
    /// are expanded. `u128::MAX` stands for that many or more; a flat file has none.
    pub instances: u128,
    /// The ink of the drawing's style; that of a file always covers.
    pub ink: Ink,
}

/// More copies than this take browsers seconds.
const MANY: u128 = 100_000;
/// The units of work that writing a vertex of a polygon takes.
const VERTEX_WORK: u64 = 4;

impl Svg {
    /// A warning where showing the file takes long, or it does not look like the drawing.
    #[must_use]
    pub fn warning(&self) -> Option<Diagnostic> {
        warning(self.instances, self.ink)
    }
}

fn warning(instances: u128, ink: Ink) -> Option<Diagnostic> {
    let kind = match ink {
        _ if instances > MANY => Kind::Instances { count: instances },
        Ink::Density => Kind::CoveringInk,
        Ink::Solid => return None,
    };
    Some(Diagnostic { kind, field: Field::Numbers, span: 0..0 })
}

impl Default for SvgOptions {
    fn default() -> Self {
        Self {
            title: String::new(),
            description: String::new(),
            system: String::new(),
            form: SvgForm::Flat,
            size: 1024.0,
            most: 2_000_000,
        }
    }
}

/// Writes a drawing with a margin of one step length, strokes in drawing order, y turned down as SVG has it. The flat
/// form is in model units and joins strokes of one style that follow each other in one path; coordinates are exact to
/// a millionth of the picture. The compact form is in CSS pixels, exact to a hundredth of one.
///
/// # Errors
/// [`Kind::Limit`] where there is more to write than [`SvgOptions::most`].
pub fn write_svg(drawing: &Drawing, style: &Style, options: &SvgOptions) -> Result<Svg, Diagnostic> {
    let mut text = String::new();
    let mut writer = SvgWriter::new(drawing, style, options)?;
    while writer.step(drawing, style, &mut text, u64::MAX)? == Progress::More {}
    Ok(Svg { text, instances: writer.instances(), ink: style.ink })
}

/// The paper, in the units of the file, y down.
struct Sheet {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
    /// One CSS pixel.
    pixel: f64,
}

impl Sheet {
    /// Writes all that comes before the drawing, and opens its group. `more` are attributes of that group.
    fn open(&self, style: &Style, options: &SvgOptions, more: &str) -> String {
        let decimals = Decimals::for_size(self.width.max(self.height));
        let mut text = String::from("<svg xmlns=\"http://www.w3.org/2000/svg\"");
        if !more.is_empty() {
            text.push_str(" xmlns:xlink=\"http://www.w3.org/1999/xlink\"");
        }
        let pixels = Decimals::for_size(options.size * 1e3);
        attribute(&mut text, "width", pixels, self.width / self.pixel);
        attribute(&mut text, "height", pixels, self.height / self.pixel);
        text.push_str(" viewBox=\"");
        for (value, end) in [(self.x, ' '), (self.y, ' '), (self.width, ' '), (self.height, '"')] {
            decimals.write(&mut text, value);
            text.push(end);
        }
        text.push_str(" role=\"img\">\n");
        for (tag, words) in [("title", &options.title), ("desc", &options.description)] {
            if !words.is_empty() {
                // Writing to a `String` cannot fail.
                let _ = writeln!(text, "<{tag}>{}</{tag}>", super::xml::escape(words));
            }
        }
        super::embed::write_metadata(&mut text, &options.system);
        text.push_str("<rect");
        attribute(&mut text, "x", decimals, self.x);
        attribute(&mut text, "y", decimals, self.y);
        attribute(&mut text, "width", decimals, self.width);
        attribute(&mut text, "height", decimals, self.height);
        let _ = writeln!(text, " fill=\"{}\"/>", String::from(style.background));
        let _ = writeln!(text, "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"{more}>");
        text
    }
}
