//! The compact form: every block is defined once and then placed.
//!
//! All symbols are in CSS pixels, so that `<use>` only turns and moves them and stroke widths stay the same. A symbol
//! is a block together with the visible part of the style at its start.

use super::features::Features;
use super::paths::{PATH, Paths, StrokeLook, attribute};
use super::plan::{CompactPlan, SymbolPart};
use super::styled_drawing::StyledDrawing;
use super::{Decimals, MANY, SvgOptions, VERTEX_WORK, ViewBox};
use core::fmt::Write;
use lsystem_drawing::finite;
use lsystem_drawing::{BlockId, Drawing, StyleChange};
use lsystem_syntax::{Diagnostic, Heading, LimitName, Meter, Progress, Style};
use std::collections::HashMap;

/// The least and the greatest size, in strokes, up to which a block is written out at each place instead of shared.
/// Small blocks make most of the copies, so a greater size means fewer copies but a longer file.
const SMALL: [u32; 2] = [4, 64];

/// The state of writing a compact file.
#[derive(Clone, Debug)]
pub(super) struct Compact {
    root: BlockId,
    /// The pixels of one unit of the root block.
    scale: f64,
    /// The step length, in pixels.
    step: f64,
    /// The placement of the whole picture.
    whole: Placement,
    /// Blocks of at most this many strokes are written out at each place.
    small: u32,
    most: u64,
    /// The file's start; empty once written.
    head: String,
    features: Features,
    plan: CompactPlan,
    stage: Stage,
    paths: Paths,
    decimals: Decimals,
    /// The names of the shared symbols written so far.
    names: HashMap<usize, String>,
    /// The symbols being written, outermost first: the symbol, the number of its parts written, and its placement.
    open: Vec<(usize, usize, Placement)>,
}

/// The progress of a compact file.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Finding the features of blocks.
    Look,
    Plan,
    /// Beginning the next shared symbol, or the whole picture if no symbol is left.
    Begin,
    /// Writing a shared symbol. The symbol is a group unless it is one path.
    Define {
        is_group: bool,
    },
    /// Writing the whole picture.
    Draw,
    Done,
}

impl Compact {
    pub(super) fn new(drawing: &Drawing, root: BlockId, style: &Style, options: &SvgOptions) -> Self {
        // In units of the root block, because extents in steps or pixels may exceed the range of `f64`.
        let [x0, y0, x1, y1] = drawing.extent().unwrap_or_default();
        let step = libm::scalbn(1.0, drawing.blocks[root.0 as usize].exponent.saturating_neg()).min(1e300);
        let (width, height) = (x1 - x0 + 2.0 * step, y1 - y0 + 2.0 * step);
        let pixels = options.size / width.max(height);
        // A negative step turns the picture by 180 degrees.
        let (scale, left, top) = if drawing.step < 0.0 { (-pixels, -x1, -y0) } else { (pixels, x0, y1) };
        let whole = Placement::new([(step - left) * pixels, -(step + top) * pixels], Heading::EAST);
        let view_box = ViewBox { x: 0.0, y: 0.0, width: width * pixels, height: height * pixels, pixel: 1.0 };
        let step = finite(step * pixels);
        let around = StrokeLook::of(style, &StyleChange::start(drawing.width), step, 1.0);
        // At least three places, because rounding errors add up in nested placements.
        let decimals = Decimals::for_size(options.size.min(1000.0));
        let features = Features::default();
        let plan = CompactPlan::new(
            &StyledDrawing { drawing, style, features: &features, step },
            root,
            scale,
            SMALL[0],
            options.most,
        );
        Self {
            root,
            scale,
            step,
            whole,
            small: SMALL[0],
            most: options.most,
            head: view_box.open(style, options, &around.attributes()),
            features,
            plan,
            stage: Stage::Look,
            paths: Paths::new(decimals, Some(around)),
            decimals,
            names: HashMap::new(),
            open: vec![],
        }
    }

    /// The number of copies that expanding the whole picture makes, once planned.
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

    /// Continues the plan. If the plan has too many copies, begins another with a greater size of written-out blocks.
    fn plan(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        text: &mut String,
        meter: &mut Meter,
    ) -> Result<(), Diagnostic> {
        let styled = StyledDrawing { drawing, style, features: &self.features, step: self.step };
        let [_, largest] = SMALL;
        match self.plan.step(&styled, meter) {
            None => return Err(Diagnostic::limit(LimitName::Segments, self.most, None)),
            Some(Progress::More) => {}
            Some(Progress::Done) if self.plan.instances > MANY && self.small < largest => {
                self.small *= 2;
                self.plan = CompactPlan::new(&styled, self.root, self.scale, self.small, self.most);
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
            self.open.push((CompactPlan::WHOLE, 0, self.whole));
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

    /// Writes the next part of the open symbol, or the next vertex of a polygon. Returns whether there was one.
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
            Some(&SymbolPart::Stroke(from, to, look)) => {
                self.paths.stroke(text, down(placement.lie(from)), down(placement.lie(to)), look);
            }
            Some(SymbolPart::Polygon(vertices, rgb)) => {
                let vertices = self.plan.vertices_of(vertices);
                meter.charge(vertices.len() as u64 / 8);
                let vertices = vertices.iter().map(|&vertex| down(placement.lie(vertex))).collect();
                self.paths.fill(text, vertices, *rgb);
            }
            Some(&SymbolPart::Use(target, at, heading)) => {
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

/// The placement of a symbol, in pixels, y up.
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

/// Converts a point from y up to y down.
fn down([x, y]: [f64; 2]) -> [f64; 2] {
    [x, -y]
}

fn use_symbol(text: &mut String, name: &str, placement: &Placement, decimals: Decimals) {
    // Programs that know only SVG 1.1 need the old name `xlink:href`. Writing to a `String` cannot fail.
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
