//! The compact form: `<defs>` with symbols, and `<use>` elements that place them.

use super::paths::{Paths, attribute, look_attributes};
use super::{Decimals, SvgOptions, ViewBox};
use crate::Sink;
use crate::compact::{Compact, SymbolFile, SymbolForm};
use core::fmt::Write;
use lsystem_drawing::{BlockId, Drawing};
use lsystem_syntax::{Halt, Heading, Style};

/// Writes a compact file. Returns the number of strokes and polygons that viewers paint.
pub(super) fn write_compact(
    drawing: &Drawing,
    root: BlockId,
    style: &Style,
    options: &SvgOptions,
    sink: &mut Sink<'_>,
) -> Result<u128, Halt> {
    let picture = Compact::new(drawing, root, style, options.size, options.most, sink)?;
    let [width, height] = picture.size;
    let view_box = ViewBox { x: 0.0, y: 0.0, width, height, pixel: 1.0 };
    view_box.open(style, options, &look_attributes(&picture.around), &mut sink.text);
    // At least three places, because rounding errors add up in nested placements.
    let decimals = Decimals::for_size(options.size.min(1000.0));
    picture.write(&mut Paths::new(sink, decimals, Some(picture.around)))?;
    sink.text.push_str("</g>\n</svg>\n");
    Ok(picture.painted())
}

impl SymbolFile for Paths<'_, '_> {
    fn define(&mut self, number: usize, form: SymbolForm) {
        let text = &mut self.sink.text;
        text.push_str(if number == 0 { "<defs>\n" } else { "" });
        let name = name(number);
        match form {
            // Writing to a `String` cannot fail.
            SymbolForm::Group => drop(writeln!(text, "<g id=\"{name}\">")),
            SymbolForm::Path => self.id = Some(name),
        }
    }

    fn end_symbol(&mut self, form: SymbolForm) {
        self.sink.text.push_str(if form == SymbolForm::Group { "</g>\n" } else { "" });
    }

    fn begin_picture(&mut self, symbols: usize) {
        self.sink.text.push_str(if symbols == 0 { "" } else { "</defs>\n" });
    }

    fn place(&mut self, number: usize, [x, y]: [f64; 2], heading: Heading) {
        let (text, decimals) = (&mut self.sink.text, self.decimals);
        // Programs that know only SVG 1.1 need the old name `xlink:href`. Writing to a `String` cannot fail.
        let _ = write!(text, "<use xlink:href=\"#{}\"", name(number));
        if heading == Heading::EAST {
            attribute(text, "x", decimals, x);
            attribute(text, "y", decimals, -y);
        } else {
            text.push_str(" transform=\"translate(");
            decimals.write(text, x);
            text.push(' ');
            decimals.write(text, -y);
            // Positive angles are clockwise in SVG.
            let degrees = (-heading).degrees();
            let _ = write!(text, ")rotate({})\"", if degrees > 180.0 { -heading.degrees() } else { degrees });
        }
        text.push_str("/>\n");
    }
}

/// The `number`th name: a, b, ..., z, aa, ab, ...
fn name(number: usize) -> String {
    let mut rest = number + 1;
    let mut letters = Vec::new();
    while rest > 0 {
        rest -= 1;
        letters.push(char::from(b'a' + (rest % 26) as u8));
        rest /= 26;
    }
    letters.iter().rev().collect()
}
