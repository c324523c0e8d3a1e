//! Drawings as Scalable Vector Graphics, in two forms.

mod compact;
mod flat;
mod paths;

use super::compact::{MANY, is_shareable};
use super::number::Decimals;
use super::sink::{Sink, collect};
use compact::write_compact;
use core::fmt::Write;
use flat::write_flat;
use lsystem_base::say;
use lsystem_base::words::grouped;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Diagnostic, Halt, Ink, Style};
use paths::attribute;

/// Options of an SVG picture.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgOptions {
    /// The picture's title; empty for none.
    pub title: String,
    /// The picture's description for screen readers; empty for none.
    pub description: String,
    /// The system as a text of [`write_json`](crate::write_json), stored in the file for
    /// [`read_file`](crate::read_file); empty for none.
    pub system: String,
    /// The form of the file.
    pub form: SvgForm,
    /// The longer side of the picture, in CSS pixels.
    pub size: f64,
    /// Whether the background is left out.
    pub transparent: bool,
    /// The most segments and vertices of polygons to write. In the compact form, placed blocks count too.
    pub most: u64,
}

/// The forms of an SVG file. Both show the same picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SvgForm {
    /// Every segment, in drawing order.
    #[default]
    Flat,
    /// Every block is defined once and then placed, so that the file has some kilobytes at any n. Blocks less than 1
    /// pixel across at the picture's size become one stroke; up to 8 pixels, if the picture has too many strokes. A drawing
    /// without shared blocks, or with colours along the path, is written flat.
    Compact,
}

/// An SVG file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Svg {
    /// The file's text.
    pub text: String,
    /// The number of strokes and polygons that a viewer paints, those of blocks as often as they are placed. `u128::MAX`
    /// means that many or more. Polygons of a flat file are not counted.
    pub painted: u128,
    /// The ink of the drawing's style. In the file, ink is always opaque.
    pub ink: Ink,
}

impl Svg {
    /// A warning if the file opens slowly or differs from the drawing.
    #[must_use]
    pub fn warning(&self) -> Option<Diagnostic> {
        warning(self.painted, self.ink)
    }
}

/// A warning about a picture of strokes: viewers paint very many of them, or it lacks the drawing's additive ink.
pub(super) fn warning(painted: u128, ink: Ink) -> Option<Diagnostic> {
    let (message, hint) = match ink {
        _ if painted > MANY => (
            say!("This file may open slowly ({} shapes)", grouped(&painted.to_string())),
            say!("Fewer iterations or a smaller size make fewer."),
        ),
        Ink::Density => (
            say!("This format has no additive blending: strokes cover each other in the file"),
            say!("PNG keeps the blending."),
        ),
        Ink::Solid | Ink::Auto => return None,
    };
    Some(Diagnostic::warning(message).hint(hint))
}

impl Default for SvgOptions {
    fn default() -> Self {
        Self {
            title: String::new(),
            description: String::new(),
            system: String::new(),
            form: SvgForm::Flat,
            size: 1024.0,
            transparent: false,
            most: 2_000_000,
        }
    }
}

/// Writes a drawing with a margin of one step length and strokes in drawing order; y points down, as in SVG. The flat
/// form is in model units, with coordinates exact to a millionth of the picture; consecutive strokes of the same style
/// share a path. The compact form is in CSS pixels, exact to a hundredth of a pixel.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if there is more to write than [`SvgOptions::most`].
pub fn write_svg(drawing: &Drawing, style: &Style, options: &SvgOptions) -> Result<Svg, Diagnostic> {
    let (text, painted) = collect(|sink| svg_file(drawing, style, options, sink))?;
    Ok(Svg { text, painted, ink: style.ink })
}

/// As [`write_svg`], piece by piece. Returns [`Svg::painted`].
pub(crate) fn svg_file(
    drawing: &Drawing,
    style: &Style,
    options: &SvgOptions,
    sink: &mut Sink<'_>,
) -> Result<u128, Halt> {
    match (options.form, drawing.root) {
        (SvgForm::Compact, Some(root)) if is_shareable(drawing, style) => {
            write_compact(drawing, root, style, options, sink)
        }
        _ => write_flat(drawing, style, options, sink).map(|()| drawing.segment_count()),
    }
}

/// The rectangle of the picture, in the units of the file, y down.
struct ViewBox {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
    /// The length of one CSS pixel.
    pixel: f64,
}

impl ViewBox {
    /// Writes the file's start and opens the drawing's group. `more` are further attributes of the group.
    fn open(&self, style: &Style, options: &SvgOptions, more: &str, text: &mut String) {
        let decimals = Decimals::for_size(self.width.max(self.height));
        text.push_str("<svg xmlns=\"http://www.w3.org/2000/svg\"");
        if !more.is_empty() {
            text.push_str(" xmlns:xlink=\"http://www.w3.org/1999/xlink\"");
        }
        let pixels = Decimals::for_size(options.size * 1e3);
        attribute(text, "width", pixels, self.width / self.pixel);
        attribute(text, "height", pixels, self.height / self.pixel);
        text.push_str(" viewBox=\"");
        for (value, end) in [(self.x, ' '), (self.y, ' '), (self.width, ' '), (self.height, '"')] {
            decimals.write(text, value);
            text.push(end);
        }
        text.push_str(" role=\"img\">\n");
        for (tag, words) in [("title", &options.title), ("desc", &options.description)] {
            if !words.is_empty() {
                // Writing to a `String` cannot fail.
                let _ = writeln!(text, "<{tag}>{}</{tag}>", super::xml::escape(words));
            }
        }
        super::embed::write_metadata(text, &options.system);
        if !options.transparent {
            text.push_str("<rect");
            attribute(text, "x", decimals, self.x);
            attribute(text, "y", decimals, self.y);
            attribute(text, "width", decimals, self.width);
            attribute(text, "height", decimals, self.height);
            let _ = writeln!(text, " fill=\"{}\"/>", String::from(style.background));
        }
        let _ = writeln!(text, "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"{more}>");
    }
}
