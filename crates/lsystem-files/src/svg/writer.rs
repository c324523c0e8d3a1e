//! Writing an SVG file of either form in steps.

use super::compact::Compact;
use super::flat::Flat;
use super::{SvgForm, SvgOptions, warning};
use crate::compact::is_shareable;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Diagnostic, Ink, Meter, Progress, Style};

/// A writer of SVG in steps. It holds no drawing, and the caller may remove the written text between two steps.
#[derive(Clone, Debug)]
pub struct SvgWriter {
    form: FormWriter,
    ink: Ink,
    spent: u64,
}

#[derive(Clone, Debug)]
enum FormWriter {
    Flat(Box<Flat>),
    Compact(Box<Compact>),
}

impl SvgWriter {
    /// A writer for a drawing.
    ///
    /// # Errors
    /// As [`write_svg`](crate::write_svg) with the flat form.
    pub fn new(drawing: &Drawing, style: &Style, options: &SvgOptions) -> Result<Self, Diagnostic> {
        let form = match (options.form, drawing.root) {
            (SvgForm::Compact, Some(root)) if is_shareable(drawing, style) => {
                FormWriter::Compact(Box::new(Compact::new(drawing, root, style, options)))
            }
            _ => FormWriter::Flat(Box::new(Flat::new(drawing, style, options)?)),
        };
        Ok(Self { form, ink: style.ink, spent: 0 })
    }

    /// As [`Svg::instances`](crate::Svg::instances), after all steps are done.
    #[must_use]
    pub fn instances(&self) -> u128 {
        match &self.form {
            FormWriter::Flat(_) => 0,
            FormWriter::Compact(compact) => compact.instances(),
        }
    }

    /// A warning if the file opens slowly or differs from the drawing, after all steps are done.
    #[must_use]
    pub fn warning(&self) -> Option<Diagnostic> {
        warning(self.instances(), self.ink)
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Appends to the file for about `work` units of work. The drawing and the style must be the same each time.
    ///
    /// # Errors
    /// As [`write_svg`](crate::write_svg) with the compact form, before anything is written.
    pub fn step(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        text: &mut String,
        work: u64,
    ) -> Result<Progress, Diagnostic> {
        let mut meter = Meter::new(work);
        let progress = match &mut self.form {
            FormWriter::Flat(flat) => Ok(flat.step(drawing, style, text, &mut meter)),
            FormWriter::Compact(compact) => compact.step(drawing, style, text, &mut meter),
        };
        self.spent = self.spent.saturating_add(meter.spent());
        progress
    }
}
