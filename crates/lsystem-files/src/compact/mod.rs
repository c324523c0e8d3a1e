//! Compact pictures: every block is defined once and then placed. SVG and PDF share this form.
//!
//! All symbols are in CSS pixels, so that a placed symbol is only turned and moved and stroke widths stay the same. A
//! symbol is a block together with the visible part of the style at its start.

mod features;
mod plan;
mod styled_drawing;

use crate::strokes::{PATH, StrokeFile, StrokeLook};
use features::Features;
use lsystem_drawing::finite;
use lsystem_drawing::{BlockId, Drawing, StyleChange};
use lsystem_syntax::{Halt, Heading, Style, Work};
use plan::{CompactPlan, SymbolPart};
use std::collections::HashMap;
use styled_drawing::StyledDrawing;

/// The least and the greatest size, in strokes, up to which a block is written out at each place instead of shared.
/// Small blocks make most of the copies, so a greater size means fewer copies but a longer file.
const SMALL: [u32; 2] = [4, 64];

/// The least and the greatest size in pixels under which a block becomes one stroke. Larger ones make fewer strokes.
const DOT: [f64; 2] = [1.0, 8.0];

/// The most copies before larger blocks are written out.
const MANY_COPIES: u128 = 100_000;

/// The most strokes and polygons without a warning. More take viewers of PDF and browsers many seconds.
pub(super) const MANY: u128 = 400_000;

/// A file format that can define symbols and place them. Points are in CSS pixels, y up; those of the whole picture
/// have the picture's upper left corner as their origin.
pub(super) trait SymbolFile: StrokeFile {
    /// Begins the definition of symbol `number`. Symbols are numbered in the order of their definitions.
    fn define(&mut self, number: usize, form: SymbolForm);
    /// Ends the definition of a symbol.
    fn end_symbol(&mut self, form: SymbolForm);
    /// Begins the picture, after `symbols` definitions.
    fn begin_picture(&mut self, symbols: usize);
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
    drawing.is_memoised() && style.colour_by.source().is_shared()
}

/// A planned compact picture.
pub(super) struct Compact {
    /// The width and the height of the picture.
    pub(super) size: [f64; 2],
    /// The look of strokes at the drawing's start.
    pub(super) around: StrokeLook,
    /// The placement of the whole picture.
    whole: Placement,
    plan: CompactPlan,
}

impl Compact {
    /// Plans the picture of a drawing with this root. Its longer side has `longer` pixels, and it has at most `most`
    /// strokes, vertices of polygons and placed symbols.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the picture has too many parts.
    pub(super) fn new(
        drawing: &Drawing,
        root: BlockId,
        style: &Style,
        longer: f64,
        most: u64,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
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
        let ([mut dot, coarsest], [mut small, largest]) = (DOT, SMALL);
        loop {
            let features = Features::new(drawing, root, scale, dot, work)?;
            let styled = StyledDrawing { drawing, style, features: &features, step };
            let plan = CompactPlan::new(&styled, root, scale, small, most, work)?;
            if plan.painted > MANY && dot < coarsest {
                dot = (1.25 * dot).min(coarsest);
            } else if plan.copies > MANY_COPIES && small < largest {
                small *= 2;
            } else {
                return Ok(Self { size, around, whole, plan });
            }
        }
    }

    /// The number of strokes and polygons that viewers paint.
    pub(super) fn painted(&self) -> u128 {
        self.plan.painted
    }

    /// Writes the symbols and the picture.
    pub(super) fn write(&self, file: &mut impl SymbolFile) -> Result<(), Halt> {
        // The numbers of the shared symbols written so far.
        let mut numbers = HashMap::new();
        for &symbol in self.plan.shared.iter().rev() {
            file.charge(8 + self.plan.parts_of(symbol).len().min(PATH) as u64 / 8)?;
            let form = if self.plan.is_one_path(symbol) { SymbolForm::Path } else { SymbolForm::Group };
            file.define(numbers.len(), form);
            numbers.insert(symbol, numbers.len());
            self.write_symbol(symbol, Placement::new([0.0; 2], Heading::EAST), &numbers, file)?;
            file.end_symbol(form);
        }
        file.begin_picture(numbers.len());
        self.write_symbol(CompactPlan::WHOLE, self.whole, &numbers, file)
    }

    /// Writes the parts of a symbol. Symbols without numbers are written in place.
    fn write_symbol(
        &self,
        symbol: usize,
        placement: Placement,
        numbers: &HashMap<usize, usize>,
        file: &mut impl SymbolFile,
    ) -> Result<(), Halt> {
        // The symbols being written, outermost first: the parts that are left, and the placement.
        let mut open = vec![(self.plan.parts_of(symbol).iter(), placement)];
        while let Some((parts, placement)) = open.last_mut() {
            file.charge(8)?;
            let placement = *placement;
            match parts.next() {
                None => {
                    open.pop();
                }
                Some(&SymbolPart::Stroke(from, to, look)) => {
                    file.stroke(placement.lie(from), placement.lie(to), look);
                }
                Some(SymbolPart::Polygon(vertices, rgb)) => {
                    let vertices = self.plan.vertices_of(vertices).iter();
                    file.fill(vertices.map(|&vertex| placement.lie(vertex)), *rgb)?;
                }
                Some(&SymbolPart::Use(target, at, heading)) => {
                    let inner = Placement::new(placement.lie(at), placement.heading + heading);
                    match numbers.get(&target) {
                        Some(&number) => {
                            file.close();
                            file.place(number, inner.at, inner.heading);
                        }
                        None => open.push((self.plan.parts_of(target).iter(), inner)),
                    }
                }
            }
        }
        file.close();
        Ok(())
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
