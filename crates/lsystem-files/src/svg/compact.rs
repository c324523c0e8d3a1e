//! The compact form: `<defs>` with symbols, and `<use>` elements that place them.

use super::paths::{Paths, attribute, look_attributes};
use super::{Decimals, SvgOptions, ViewBox};
use crate::compact::{SymbolFile, SymbolForm};
use crate::strokes::StrokeLook;
use core::fmt::Write;
use lsystem_drawing::{BlockId, Drawing};
use lsystem_syntax::{Diagnostic, Heading, Meter, Progress, Style};

/// The state of writing a compact file.
#[derive(Clone, Debug)]
pub(super) struct Compact {
    picture: crate::compact::Compact,
    /// The file's start; empty once written.
    head: String,
    paths: Paths,
    decimals: Decimals,
}

impl Compact {
    pub(super) fn new(drawing: &Drawing, root: BlockId, style: &Style, options: &SvgOptions) -> Self {
        let picture = crate::compact::Compact::new(drawing, root, style, options.size, options.most);
        let [width, height] = picture.size;
        // At least three places, because rounding errors add up in nested placements.
        let decimals = Decimals::for_size(options.size.min(1000.0));
        let view_box = ViewBox { x: 0.0, y: 0.0, width, height, pixel: 1.0 };
        let head = view_box.open(style, options, &look_attributes(&picture.around));
        let paths = Paths::new(decimals, Some(picture.around));
        Self { picture, head, paths, decimals }
    }

    /// The number of copies that expanding the whole picture makes, once planned.
    pub(super) fn instances(&self) -> u128 {
        self.picture.instances()
    }

    pub(super) fn step(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        text: &mut String,
        meter: &mut Meter,
    ) -> Result<Progress, Diagnostic> {
        let mut file = SvgSymbols { text, head: &mut self.head, paths: &mut self.paths, decimals: self.decimals };
        self.picture.step(drawing, style, &mut file, meter)
    }
}

/// The file during one step.
struct SvgSymbols<'a> {
    text: &'a mut String,
    head: &'a mut String,
    paths: &'a mut Paths,
    decimals: Decimals,
}

impl SymbolFile for SvgSymbols<'_> {
    fn begin(&mut self) {
        self.text.push_str(&core::mem::take(self.head));
    }

    fn define(&mut self, number: usize, form: SymbolForm) {
        self.text.push_str(if number == 0 { "<defs>\n" } else { "" });
        let name = name(number);
        match form {
            // Writing to a `String` cannot fail.
            SymbolForm::Group => drop(writeln!(self.text, "<g id=\"{name}\">")),
            SymbolForm::Path => self.paths.id = Some(name),
        }
    }

    fn end_symbol(&mut self, form: SymbolForm) {
        self.text.push_str(if form == SymbolForm::Group { "</g>\n" } else { "" });
    }

    fn begin_picture(&mut self, symbols: usize) {
        self.text.push_str(if symbols == 0 { "" } else { "</defs>\n" });
    }

    fn end(&mut self) {
        self.text.push_str("</g>\n</svg>\n");
    }

    fn stroke(&mut self, from: [f64; 2], to: [f64; 2], look: StrokeLook) {
        self.paths.stroke(self.text, down(from), down(to), look);
    }

    fn fill(&mut self, vertices: Vec<[f64; 2]>, rgb: [u8; 3]) {
        self.paths.fill(self.text, vertices.into_iter().map(down).collect(), rgb);
    }

    fn vertex(&mut self) -> bool {
        self.paths.vertex(self.text)
    }

    fn close(&mut self) {
        self.paths.close(self.text);
    }

    fn place(&mut self, number: usize, at: [f64; 2], heading: Heading) {
        use_symbol(self.text, &name(number), at, heading, self.decimals);
    }
}

/// Converts a point from y up to y down.
fn down([x, y]: [f64; 2]) -> [f64; 2] {
    [x, -y]
}

fn use_symbol(text: &mut String, name: &str, at: [f64; 2], heading: Heading, decimals: Decimals) {
    // Programs that know only SVG 1.1 need the old name `xlink:href`. Writing to a `String` cannot fail.
    let _ = write!(text, "<use xlink:href=\"#{name}\"");
    let [x, y] = down(at);
    if heading == Heading::EAST {
        attribute(text, "x", decimals, x);
        attribute(text, "y", decimals, y);
    } else {
        text.push_str(" transform=\"translate(");
        decimals.write(text, x);
        text.push(' ');
        decimals.write(text, y);
        // Positive angles are clockwise in SVG.
        let degrees = (-heading).degrees();
        let _ = write!(text, ")rotate({})\"", if degrees > 180.0 { -heading.degrees() } else { degrees });
    }
    text.push_str("/>\n");
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
