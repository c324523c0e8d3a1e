//! Drawings as Scalable Vector Graphics.

use super::number::Decimals;
use crate::derivation::limit;
use crate::{Diagnostic, Drawing, LimitName, Segment, Style};
use core::fmt::Write;

/// How a drawing becomes an SVG picture.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgOptions {
    /// The picture's title; none where empty.
    pub title: String,
    /// Its description, for people who do not see it; none where empty.
    pub description: String,
    /// The longer side of the picture, in CSS pixels.
    pub size: f64,
    /// The most segments to write.
    pub most: u64,
}

impl Default for SvgOptions {
    fn default() -> Self {
        Self { title: String::new(), description: String::new(), size: 1024.0, most: 2_000_000 }
    }
}

/// Segments of one path: longer ones take browsers disproportionately long.
const PATH: usize = 10_000;

/// Writes a drawing with a margin of one step length: strokes in drawing order, those of one style that follow each
/// other in one path, in model units with y turned down as SVG has it. Coordinates are exact to a millionth of the
/// picture.
///
/// # Errors
/// [`Kind::Limit`](crate::Kind::Limit) where there are more than [`SvgOptions::most`] segments.
pub fn write_svg(drawing: &Drawing, style: &Style, options: &SvgOptions) -> Result<String, Diagnostic> {
    if drawing.segment_count() > u128::from(options.most) {
        return Err(limit(LimitName::Segments, options.most, None));
    }
    let [x, y] = drawing.start;
    let [x0, y0, x1, y1] = drawing.bounds().unwrap_or([x, y, x, y]).map(within);
    let margin = drawing.step.abs();
    let (width, height) = (x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin);
    let longer = width.max(height);
    let pixel = longer / options.size;
    let decimals = Decimals::for_size(longer);

    let mut text = String::from("<svg xmlns=\"http://www.w3.org/2000/svg\"");
    let pixels = Decimals::for_size(options.size * 1e3);
    attribute(&mut text, "width", pixels, width / pixel);
    attribute(&mut text, "height", pixels, height / pixel);
    text.push_str(" viewBox=\"");
    for (value, end) in [(x0 - margin, ' '), (-y1 - margin, ' '), (width, ' '), (height, '"')] {
        decimals.write(&mut text, value);
        text.push(end);
    }
    text.push_str(" role=\"img\">\n");
    for (tag, words) in [("title", &options.title), ("desc", &options.description)] {
        if !words.is_empty() {
            let _ = writeln!(text, "<{tag}>{}</{tag}>", escape(words));
        }
    }
    text.push_str("<rect");
    attribute(&mut text, "x", decimals, x0 - margin);
    attribute(&mut text, "y", decimals, -y1 - margin);
    attribute(&mut text, "width", decimals, width);
    attribute(&mut text, "height", decimals, height);
    let _ = writeln!(text, " fill=\"{}\"/>", String::from(style.background));
    text.push_str("<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
    Paths { text: &mut text, style, decimals, pixel, pen: None }.write(drawing);
    text.push_str("</g>\n</svg>\n");
    Ok(text)
}

/// What is written of the paths.
struct Paths<'a> {
    text: &'a mut String,
    style: &'a Style,
    decimals: Decimals,
    /// One CSS pixel in model units.
    pixel: f64,
    /// The open path.
    pen: Option<Pen>,
}

#[derive(Clone, Copy)]
struct Pen {
    rgb: [u8; 3],
    width: f64,
    /// Where it ended, in units of the last decimal place.
    at: [f64; 2],
    segments: usize,
}

impl Paths<'_> {
    fn write(mut self, drawing: &Drawing) {
        for segment in drawing.segments() {
            self.segment(&segment);
        }
        self.close();
    }

    fn segment(&mut self, segment: &Segment) {
        let rgb = self.style.colour_of(segment.colour, segment.level).rgb;
        let thinnest = self.style.min_width * self.pixel;
        // Nothing has no width on paper: a stroke without one is a hairline, as on the screen.
        let width = if segment.width.max(thinnest) > 0.0 { segment.width.max(thinnest) } else { self.pixel };
        let places = |[x, y]: [f64; 2]| [self.decimals.round(within(x)), self.decimals.round(within(-y))];
        let (from, to) = (places(segment.from), places(segment.to));
        match self.pen {
            Some(pen) if pen.rgb == rgb && pen.width == width && pen.segments < PATH => {
                self.text.push(if pen.at == from { ' ' } else { 'M' });
                if pen.at != from {
                    self.point(segment.from);
                    self.text.push('L');
                }
            }
            _ => {
                self.close();
                let _ = write!(self.text, "<path stroke=\"#{:02x}{:02x}{:02x}\"", rgb[0], rgb[1], rgb[2]);
                attribute(self.text, "stroke-width", Decimals::for_size(width), width);
                self.text.push_str(" d=\"M");
                self.point(segment.from);
                self.text.push('L');
            }
        }
        self.point(segment.to);
        let segments = self.pen.map_or(0, |pen| pen.segments) + 1;
        self.pen = Some(Pen { rgb, width, at: to, segments });
    }

    fn point(&mut self, [x, y]: [f64; 2]) {
        self.decimals.write(self.text, within(x));
        self.text.push(' ');
        self.decimals.write(self.text, within(-y));
    }

    fn close(&mut self) {
        if self.pen.take().is_some() {
            self.text.push_str("\"/>\n");
        }
    }
}

fn attribute(text: &mut String, name: &str, decimals: Decimals, value: f64) {
    let _ = write!(text, " {name}=\"");
    decimals.write(text, value);
    text.push('"');
}

/// Keeps what is beyond any picture within the numbers, sums of two included.
fn within(coordinate: f64) -> f64 {
    coordinate.clamp(-1e300, 1e300)
}

/// The text as XML content. Characters that XML cannot hold become U+FFFD.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\t' | '\n' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'.. => escaped.push(c),
            _ => escaped.push('\u{fffd}'),
        }
    }
    escaped
}
