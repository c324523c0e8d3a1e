//! Every block once, and then placed.
//!
//! All symbols are in CSS pixels, so that `<use>` only turns and moves them and stroke widths stay what they are. A
//! symbol is a block in the style in which it is entered, as far as that shows.

use super::paths::{Paths, attribute};
use super::plan::{Part, Plan, Scene};
use super::{Decimals, MANY, Sheet, Svg, SvgOptions};
use core::fmt::Write;
use lsystem_drawing::finite;
use lsystem_drawing::{BlockId, Drawing, StyleChange};
use lsystem_syntax::{Diagnostic, Heading, LimitName, Style};
use std::collections::HashMap;

/// Blocks of at most so many strokes are written out wherever they stand: at least, and at most. Copies of blocks at
/// the bottom are most of all copies, so the more strokes, the fewer copies, and the longer the file.
const SMALL: [u32; 2] = [4, 64];

pub(super) fn write(drawing: &Drawing, root: BlockId, style: &Style, options: &SvgOptions) -> Result<Svg, Diagnostic> {
    // In units of the root block, which has a range that pixels and steps may not have.
    let [x0, y0, x1, y1] = drawing.extent().unwrap_or_default();
    let step = libm::scalbn(1.0, drawing.blocks[root.0 as usize].exponent.saturating_neg()).min(1e300);
    let (width, height) = (x1 - x0 + 2.0 * step, y1 - y0 + 2.0 * step);
    let pixels = options.size / width.max(height);
    // A negative step turns the picture round.
    let (scale, left, top) = if drawing.step < 0.0 { (-pixels, -x1, -y0) } else { (pixels, x0, y1) };
    let begin = Placement::new([(step - left) * pixels, -(step + top) * pixels], Heading::EAST);
    let sheet = Sheet { x: 0.0, y: 0.0, width: width * pixels, height: height * pixels, pixel: 1.0 };

    let scene = Scene::new(drawing, root, style, scale, finite(step * pixels));
    let start = StyleChange::start(drawing.width);
    let [mut small, largest] = SMALL;
    let (plan, instances) = loop {
        let plan = Plan::new(&scene, root, scale, &start, small, options.most);
        let plan = plan.ok_or_else(|| Diagnostic::limit(LimitName::Segments, options.most, None))?;
        let instances = plan.instances();
        if instances <= MANY || small >= largest {
            break (plan, instances);
        }
        small *= 2;
    };

    let around = scene.ink(&start);
    // At least three places: every placement in a placement adds its rounding.
    let decimals = Decimals::for_size(options.size.min(1000.0));
    let mut text = sheet.open(style, options, &around.attributes());
    let paths = Paths::new(&mut text, decimals, Some(around));
    let mut writer = Writer { plan: &plan, decimals, names: HashMap::new(), paths };
    writer.define();
    if let Some(&root) = plan.order.first() {
        writer.write(root, begin);
    }
    text.push_str("</g>\n</svg>\n");
    Ok(Svg { text, instances, ink: style.ink })
}

/// Writes the plan.
struct Writer<'a> {
    plan: &'a Plan<'a>,
    decimals: Decimals,
    /// What shared symbols are called.
    names: HashMap<usize, String>,
    paths: Paths<'a>,
}

impl Writer<'_> {
    /// Writes all shared symbols, children first.
    fn define(&mut self) {
        let plan = self.plan;
        let shared: Vec<usize> = plan.order.iter().rev().copied().filter(|&symbol| plan.is_shared(symbol)).collect();
        if shared.is_empty() {
            return;
        }
        self.paths.text.push_str("<defs>\n");
        for symbol in shared {
            let name = name(self.names.len());
            let alone = plan.is_one_path(symbol);
            if alone {
                self.paths.id = Some(name.clone());
            } else {
                let _ = writeln!(self.paths.text, "<g id=\"{name}\">");
            }
            self.write(symbol, Placement::new([0.0; 2], Heading::EAST));
            if !alone {
                self.paths.text.push_str("</g>\n");
            }
            self.names.insert(symbol, name);
        }
        self.paths.text.push_str("</defs>\n");
    }

    /// Writes the parts of a symbol.
    fn write(&mut self, symbol: usize, placement: Placement) {
        let plan = self.plan;
        let mut open = vec![(plan.symbols[symbol].parts.iter(), placement)];
        while let Some((parts, placement)) = open.last_mut() {
            let placement = *placement;
            match parts.next() {
                None => {
                    open.pop();
                }
                Some(&Part::Stroke(from, to, ink)) => {
                    self.paths.stroke(down(placement.lie(from)), down(placement.lie(to)), ink);
                }
                Some(Part::Polygon(vertices, rgb)) => {
                    self.paths.fill(vertices.iter().map(|&vertex| down(placement.lie(vertex))), *rgb);
                }
                Some(&Part::Use(target, at, heading)) => {
                    let inner = Placement::new(placement.lie(at), placement.heading + heading);
                    match self.names.get(&target) {
                        Some(name) => {
                            self.paths.close();
                            use_symbol(self.paths.text, name, &inner, self.decimals);
                        }
                        None => open.push((plan.symbols[target].parts.iter(), inner)),
                    }
                }
            }
        }
        self.paths.close();
    }
}

/// Where a symbol is placed, in pixels, y up.
#[derive(Clone, Copy)]
struct Placement {
    at: [f64; 2],
    heading: Heading,
    /// Cosine and sine of the heading.
    axis: (f64, f64),
}

impl Placement {
    fn new(at: [f64; 2], heading: Heading) -> Self {
        Self { at, heading, axis: heading.cos_sin() }
    }

    fn lie(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (c, s) = self.axis;
        [self.at[0] + (c * u - s * v), self.at[1] + (s * u + c * v)]
    }
}

/// A point of the file.
fn down([x, y]: [f64; 2]) -> [f64; 2] {
    [x, -y]
}

fn use_symbol(text: &mut String, name: &str, placement: &Placement, decimals: Decimals) {
    // Editors and converters that know SVG 1.1 only need the old name of `href`. Writing to a `String` cannot fail.
    let _ = write!(text, "<use xlink:href=\"#{name}\"");
    let [x, y] = down(placement.at);
    if placement.heading == Heading::EAST {
        attribute(text, "x", decimals, x);
        attribute(text, "y", decimals, y);
    } else {
        text.push_str(" transform=\"translate(");
        decimals.write(text, x);
        text.push(' ');
        decimals.write(text, y);
        // Positive angles are clockwise in SVG.
        let degrees = (-placement.heading).degrees();
        let _ = write!(text, ")rotate({})\"", if degrees > 180.0 { -placement.heading.degrees() } else { degrees });
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
