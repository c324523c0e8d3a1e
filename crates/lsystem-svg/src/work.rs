//! The counted work of a picture.

use crate::SvgError;
use lsystem_base::word;
use lsystem_base::words::said;

/// The most units of a picture.
pub(crate) const MAX_WORK: u64 = 500_000_000;

/// What is counted.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    Entities,
    Elements,
    Styles,
    Segments,
    Dashes,
    Pixels,
}

/// The units of each kind so far.
#[derive(Default)]
pub(crate) struct Work([u64; 6]);

impl Work {
    /// Counts `count` pieces of `each` units.
    ///
    /// # Errors
    /// A sentence that names what takes the most work, if all together is too much.
    pub(crate) fn charge(&mut self, kind: Kind, count: usize, each: u64) -> Result<(), SvgError> {
        let spent = &mut self.0[kind as usize];
        *spent = spent.saturating_add((count as u64).saturating_mul(each));
        if self.done() <= MAX_WORK {
            return Ok(());
        }
        let most = (0..self.0.len()).max_by_key(|&at| self.0[at]).unwrap_or(0);
        let what = [
            word!("this SVG takes too long to draw: it has too many entities. Save it as a PNG first"),
            word!("this SVG takes too long to draw: it has too many elements. Save it as a PNG first"),
            word!("this SVG takes too long to draw: it has too many styles. Save it as a PNG first"),
            word!("this SVG takes too long to draw: it has too many path segments. Save it as a PNG first"),
            word!("this SVG takes too long to draw: it has too many dashes. Save it as a PNG first"),
            word!("this SVG takes too long to draw: it has too many pixels. Save it as a PNG first"),
        ][most];
        Err(SvgError::new(said(what)))
    }

    pub(crate) fn done(&self) -> u64 {
        self.0.iter().fold(0, |sum: u64, units| sum.saturating_add(*units))
    }
}
