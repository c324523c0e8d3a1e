//! Compact pictures: every block is defined once and then placed. SVG and PDF share this form.
//!
//! All symbols are in CSS pixels, so that a placed symbol is only turned and moved and stroke widths stay the same. A
//! symbol is a block together with the visible part of the style at its start.

mod features;
mod plan;
mod styled_drawing;

use crate::strokes::{PATH, StrokeLook};
use features::Features;
use lsystem_drawing::finite;
use lsystem_drawing::{BlockId, Drawing, StyleChange};
use lsystem_syntax::{ColourBy, Diagnostic, Heading, LimitName, Meter, Progress, Style};
use plan::{CompactPlan, SymbolPart};
use std::collections::HashMap;
use styled_drawing::StyledDrawing;
pub(super) use styled_drawing::visible;

/// The least and the greatest size, in strokes, up to which a block is written out at each place instead of shared.
/// Small blocks make most of the copies, so a greater size means fewer copies but a longer file.
const SMALL: [u32; 2] = [4, 64];

/// The most copies without a warning. More take browsers several seconds.
pub(super) const MANY: u128 = 100_000;
/// The units of work to write a vertex of a polygon.
const VERTEX_WORK: u64 = 4;

/// A file format that can define symbols and place them. Points are in CSS pixels, y up; those of the whole picture
/// have the picture's upper left corner as their origin.
pub(super) trait SymbolFile {
    /// Begins the file.
    fn begin(&mut self);
    /// Begins the definition of symbol `number`. Symbols are numbered in the order of their definitions.
    fn define(&mut self, number: usize, form: SymbolForm);
    /// Ends the definition of a symbol.
    fn end_symbol(&mut self, form: SymbolForm);
    /// Begins the picture, after `symbols` definitions.
    fn begin_picture(&mut self, symbols: usize);
    /// Ends the picture and the file.
    fn end(&mut self);
    /// Writes a stroke.
    fn stroke(&mut self, from: [f64; 2], to: [f64; 2], look: StrokeLook);
    /// Begins a polygon.
    fn fill(&mut self, vertices: Vec<[f64; 2]>, rgb: [u8; 3]);
    /// Writes the next vertex of the open polygon, or its end. Returns whether a polygon was open.
    fn vertex(&mut self) -> bool;
    /// Ends the open path, if any.
    fn close(&mut self);
    /// Places symbol `number`.
    fn place(&mut self, number: usize, at: [f64; 2], heading: Heading);
}

/// The form of a symbol's definition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SymbolForm {
    /// Strokes of one look, few enough for one path.
    Path,
    /// Anything else.
    Group,
}

/// Whether a drawing has blocks that a compact picture can share.
pub(super) fn is_shareable(drawing: &Drawing, style: &Style) -> bool {
    drawing.is_memoised() && style.colour_by != ColourBy::Path
}

/// The state of writing a compact file.
#[derive(Clone, Debug)]
pub(super) struct Compact {
    /// The width and the height of the picture.
    pub(super) size: [f64; 2],
    /// The look of strokes at the drawing's start.
    pub(super) around: StrokeLook,
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
    features: Features,
    plan: CompactPlan,
    stage: Stage,
    /// The numbers of the shared symbols written so far.
    numbers: HashMap<usize, usize>,
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
    /// Writing a shared symbol.
    Define(SymbolForm),
    /// Writing the whole picture.
    Draw,
    Done,
}

impl Compact {
    /// A picture of a drawing with this root. Its longer side has `longer` pixels, and it has at most `most` strokes,
    /// vertices of polygons and placed symbols.
    pub(super) fn new(drawing: &Drawing, root: BlockId, style: &Style, longer: f64, most: u64) -> Self {
        // In units of the root block, because extents in steps or pixels may exceed the range of `f64`.
        let [x0, y0, x1, y1] = drawing.extent().unwrap_or_default();
        let step = libm::scalbn(1.0, drawing.blocks[root.0 as usize].exponent.saturating_neg()).min(1e300);
        let (width, height) = (x1 - x0 + 2.0 * step, y1 - y0 + 2.0 * step);
        let pixels = longer / width.max(height);
        // A negative step turns the picture by 180 degrees.
        let (scale, left, top) = if drawing.step < 0.0 { (-pixels, -x1, -y0) } else { (pixels, x0, y1) };
        let whole = Placement::new([(step - left) * pixels, -(step + top) * pixels], Heading::EAST);
        let size = [width * pixels, height * pixels];
        let step = finite(step * pixels);
        let around = StrokeLook::of(style, &StyleChange::start(drawing.width), step, 1.0);
        let features = Features::default();
        let plan =
            CompactPlan::new(&StyledDrawing { drawing, style, features: &features, step }, root, scale, SMALL[0], most);
        Self {
            size,
            around,
            root,
            scale,
            step,
            whole,
            small: SMALL[0],
            most,
            features,
            plan,
            stage: Stage::Look,
            numbers: HashMap::new(),
            open: vec![],
        }
    }

    /// The number of copies that expanding the whole picture makes, once planned.
    pub(super) fn instances(&self) -> u128 {
        self.plan.instances
    }

    /// Writes until the meter is spent.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) before anything is written, if the picture has too many parts.
    pub(super) fn step(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        file: &mut impl SymbolFile,
        meter: &mut Meter,
    ) -> Result<Progress, Diagnostic> {
        while !meter.is_spent() {
            match self.stage {
                Stage::Look => {
                    if self.features.step(drawing, self.root, self.scale, meter) == Progress::Done {
                        self.stage = Stage::Plan;
                    }
                }
                Stage::Plan => self.plan(drawing, style, file, meter)?,
                Stage::Begin => self.begin(file, meter),
                Stage::Define(form) => {
                    if !self.write(file, meter) {
                        file.end_symbol(form);
                        self.stage = Stage::Begin;
                    }
                }
                Stage::Draw => {
                    if !self.write(file, meter) {
                        file.end();
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
        file: &mut impl SymbolFile,
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
                file.begin();
                self.stage = Stage::Begin;
            }
        }
        Ok(())
    }

    fn begin(&mut self, file: &mut impl SymbolFile, meter: &mut Meter) {
        meter.charge(8);
        let Some(symbol) = self.plan.shared.pop() else {
            file.begin_picture(self.numbers.len());
            self.open.push((CompactPlan::WHOLE, 0, self.whole));
            self.stage = Stage::Draw;
            return;
        };
        meter.charge(self.plan.parts_of(symbol).len().min(PATH) as u64 / 8);
        let form = if self.plan.is_one_path(symbol) { SymbolForm::Path } else { SymbolForm::Group };
        let number = self.numbers.len();
        file.define(number, form);
        self.numbers.insert(symbol, number);
        self.open.push((symbol, 0, Placement::new([0.0; 2], Heading::EAST)));
        self.stage = Stage::Define(form);
    }

    /// Writes the next part of the open symbol, or the next vertex of a polygon. Returns whether there was one.
    fn write(&mut self, file: &mut impl SymbolFile, meter: &mut Meter) -> bool {
        if file.vertex() {
            meter.charge(VERTEX_WORK);
            return true;
        }
        meter.charge(8);
        let Some((symbol, written, placement)) = self.open.last_mut() else {
            file.close();
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
                file.stroke(placement.lie(from), placement.lie(to), look);
            }
            Some(SymbolPart::Polygon(vertices, rgb)) => {
                let vertices = self.plan.vertices_of(vertices);
                meter.charge(vertices.len() as u64 / 8);
                file.fill(vertices.iter().map(|&vertex| placement.lie(vertex)).collect(), *rgb);
            }
            Some(&SymbolPart::Use(target, at, heading)) => {
                let inner = Placement::new(placement.lie(at), placement.heading + heading);
                match self.numbers.get(&target) {
                    Some(&number) => {
                        file.close();
                        file.place(number, inner.at, inner.heading);
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
