//! Every block once, and then placed.
//!
//! All symbols are in CSS pixels, so that `<use>` only turns and moves them and stroke widths stay what they are. A
//! symbol is a block in the style in which it is entered, as far as that shows.

use super::features::Features;
use super::paths::{Ink, PATH, Paths, attribute};
use super::plan::{Part, Plan};
use super::scene::Scene;
use super::{Decimals, MANY, Sheet, SvgOptions, VERTEX_WORK};
use core::fmt::Write;
use lsystem_drawing::finite;
use lsystem_drawing::{BlockId, Drawing, StyleChange};
use lsystem_syntax::{Diagnostic, Heading, LimitName, Meter, Progress, Style};
use std::collections::HashMap;

/// Blocks of at most so many strokes are written out wherever they stand: at least, and at most. Copies of blocks at
/// the bottom are most of all copies, so the more strokes, the fewer copies, and the longer the file.
const SMALL: [u32; 2] = [4, 64];

/// A compact file that is being written.
#[derive(Clone, Debug)]
pub(super) struct Compact {
    root: BlockId,
    /// Pixels for one unit of the root, and for a step.
    scale: f64,
    step: f64,
    /// Where the whole picture lies on the paper.
    whole: Placement,
    /// Strokes of a block that is written out wherever it stands, at most.
    small: u32,
    most: u64,
    /// All that comes before the drawing.
    head: String,
    features: Features,
    plan: Plan,
    stage: Stage,
    paths: Paths,
    decimals: Decimals,
    /// What the shared symbols written so far are called.
    names: HashMap<usize, String>,
    /// The symbols that are being written, outermost first: how many of their parts are written, and where they lie.
    open: Vec<(usize, usize, Placement)>,
}

/// How far a compact file is.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Looking at the blocks.
    Look,
    Plan,
    /// Beginning the next shared symbol, or the whole picture where there is none left.
    Begin,
    /// Writing a shared symbol, which is a group unless it is one path.
    Define {
        is_group: bool,
    },
    /// Writing the whole picture.
    Draw,
    Done,
}

impl Compact {
    pub(super) fn new(drawing: &Drawing, root: BlockId, style: &Style, options: &SvgOptions) -> Self {
        // In units of the root block, which has a range that pixels and steps may not have.
        let [x0, y0, x1, y1] = drawing.extent().unwrap_or_default();
        let step = libm::scalbn(1.0, drawing.blocks[root.0 as usize].exponent.saturating_neg()).min(1e300);
        let (width, height) = (x1 - x0 + 2.0 * step, y1 - y0 + 2.0 * step);
        let pixels = options.size / width.max(height);
        // A negative step turns the picture round.
        let (scale, left, top) = if drawing.step < 0.0 { (-pixels, -x1, -y0) } else { (pixels, x0, y1) };
        let whole = Placement::new([(step - left) * pixels, -(step + top) * pixels], Heading::EAST);
        let sheet = Sheet { x: 0.0, y: 0.0, width: width * pixels, height: height * pixels, pixel: 1.0 };
        let step = finite(step * pixels);
        let around = Ink::of(style, &StyleChange::start(drawing.width), step, 1.0);
        // At least three places: every placement in a placement adds its rounding.
        let decimals = Decimals::for_size(options.size.min(1000.0));
        let features = Features::default();
        let plan = Plan::new(&Scene { drawing, style, features: &features, step }, root, scale, SMALL[0], options.most);
        Self {
            root,
            scale,
            step,
            whole,
            small: SMALL[0],
            most: options.most,
            head: sheet.open(style, options, &around.attributes()),
            features,
            plan,
            stage: Stage::Look,
            paths: Paths::new(decimals, Some(around)),
            decimals,
            names: HashMap::new(),
            open: vec![],
        }
    }

    /// How many copies expanding the whole picture makes, when that is planned.
    pub(super) fn instances(&self) -> u128 {
        self.plan.instances
    }

    pub(super) fn step(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        text: &mut String,
        meter: &mut Meter,
    ) -> Result<Progress, Diagnostic> {
        while !meter.is_spent() {
            match self.stage {
                Stage::Look => {
                    if self.features.step(drawing, self.root, self.scale, meter) == Progress::Done {
                        self.stage = Stage::Plan;
                    }
                }
                Stage::Plan => self.plan(drawing, style, text, meter)?,
                Stage::Begin => self.begin(text, meter),
                Stage::Define { is_group } => {
                    if !self.write(text, meter) {
                        text.push_str(if is_group { "</g>\n" } else { "" });
                        self.stage = Stage::Begin;
                    }
                }
                Stage::Draw => {
                    if !self.write(text, meter) {
                        text.push_str("</g>\n</svg>\n");
                        self.stage = Stage::Done;
                    }
                }
                Stage::Done => return Ok(Progress::Done),
            }
        }
        Ok(if matches!(self.stage, Stage::Done) { Progress::Done } else { Progress::More })
    }

    /// Goes on with the plan, and begins another where this one has too many copies.
    fn plan(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        text: &mut String,
        meter: &mut Meter,
    ) -> Result<(), Diagnostic> {
        let scene = Scene { drawing, style, features: &self.features, step: self.step };
        let [_, largest] = SMALL;
        match self.plan.step(&scene, meter) {
            None => return Err(Diagnostic::limit(LimitName::Segments, self.most, None)),
            Some(Progress::More) => {}
            Some(Progress::Done) if self.plan.instances > MANY && self.small < largest => {
                self.small *= 2;
                self.plan = Plan::new(&scene, self.root, self.scale, self.small, self.most);
            }
            Some(Progress::Done) => {
                text.push_str(&core::mem::take(&mut self.head));
                self.stage = Stage::Begin;
            }
        }
        Ok(())
    }

    fn begin(&mut self, text: &mut String, meter: &mut Meter) {
        meter.charge(8);
        let Some(symbol) = self.plan.shared.pop() else {
            text.push_str(if self.names.is_empty() { "" } else { "</defs>\n" });
            self.open.push((Plan::WHOLE, 0, self.whole));
            self.stage = Stage::Draw;
            return;
        };
        text.push_str(if self.names.is_empty() { "<defs>\n" } else { "" });
        let name = name(self.names.len());
        meter.charge(self.plan.parts_of(symbol).len().min(PATH) as u64 / 8);
        let is_group = !self.plan.is_one_path(symbol);
        if is_group {
            // Writing to a `String` cannot fail.
            let _ = writeln!(text, "<g id=\"{name}\">");
        } else {
            self.paths.id = Some(name.clone());
        }
        self.names.insert(symbol, name);
        self.open.push((symbol, 0, Placement::new([0.0; 2], Heading::EAST)));
        self.stage = Stage::Define { is_group };
    }

    /// Writes the next part of what is open, or a vertex of one; whether there was any.
    fn write(&mut self, text: &mut String, meter: &mut Meter) -> bool {
        if self.paths.vertex(text) {
            meter.charge(VERTEX_WORK);
            return true;
        }
        meter.charge(8);
        let Some((symbol, written, placement)) = self.open.last_mut() else {
            self.paths.close(text);
            return false;
        };
        let placement = *placement;
        let part = self.plan.parts_of(*symbol).get(*written);
        *written += 1;
        match part {
            None => {
                self.open.pop();
            }
            Some(&Part::Stroke(from, to, ink)) => {
                self.paths.stroke(text, down(placement.lie(from)), down(placement.lie(to)), ink);
            }
            Some(Part::Polygon(vertices, rgb)) => {
                let vertices = self.plan.vertices_of(vertices);
                meter.charge(vertices.len() as u64 / 8);
                let vertices = vertices.iter().map(|&vertex| down(placement.lie(vertex))).collect();
                self.paths.fill(text, vertices, *rgb);
            }
            Some(&Part::Use(target, at, heading)) => {
                let inner = Placement::new(placement.lie(at), placement.heading + heading);
                match self.names.get(&target) {
                    Some(name) => {
                        self.paths.close(text);
                        use_symbol(text, name, &inner, self.decimals);
                    }
                    None => self.open.push((target, 0, inner)),
                }
            }
        }
        true
    }
}

/// Where a symbol is placed, in pixels, y up.
#[derive(Clone, Copy, Debug)]
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
