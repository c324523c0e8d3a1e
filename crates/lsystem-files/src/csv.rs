//! Segments as comma-separated values.

use super::number::write_exact;
use core::fmt::Write;
use lsystem_drawing::MarkReader;
use lsystem_drawing::{Drawing, Mark, Space};
use lsystem_syntax::{Diagnostic, Meter, Progress};

/// Writes all segments in drawing order, one on each line. The header is `x0,y0,x1,y1,level,colour` in the plane and
/// `x0,y0,z0,x1,y1,z1,level,colour` in space. Coordinates are in model units, with the fewest digits that read back as
/// the same number. `level` is the branch level; `colour` is the colour index, not wrapped to a palette.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if there are more than `most` segments and vertices of polygons.
pub fn write_csv<S: Space>(drawing: &Drawing<S>, most: u64) -> Result<String, Diagnostic> {
    let mut writer = CsvWriter::new(drawing, most)?;
    let mut text = String::new();
    while writer.step(drawing, &mut text, u64::MAX) == Progress::More {}
    Ok(text)
}

/// A writer of CSV in steps. It holds no drawing, and the caller may remove the written text between two steps.
#[derive(Clone, Debug)]
pub struct CsvWriter<S: Space> {
    reader: MarkReader<S>,
    has_head: bool,
    spent: u64,
}

impl<S: Space> CsvWriter<S> {
    /// A writer for a drawing.
    ///
    /// # Errors
    /// As [`write_csv`].
    pub fn new(drawing: &Drawing<S>, most: u64) -> Result<Self, Diagnostic> {
        drawing.check_size(most)?;
        Ok(Self { reader: MarkReader::new(drawing), has_head: false, spent: 0 })
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Appends lines for about `work` units of work. `drawing` must be the same each time.
    pub fn step(&mut self, drawing: &Drawing<S>, text: &mut String, work: u64) -> Progress {
        if !self.has_head {
            let flat = S::Point::default().as_ref().len() == 2;
            text.push_str(if flat { "x0,y0,x1,y1,level,colour\n" } else { "x0,y0,z0,x1,y1,z1,level,colour\n" });
            self.has_head = true;
        }
        let mut meter = Meter::new(work);
        let mut progress = Progress::More;
        while progress == Progress::More && !meter.is_spent() {
            let Some(mark) = self.reader.next(drawing) else {
                progress = Progress::Done;
                break;
            };
            meter.charge(mark.work());
            let Mark::Segment(segment, _) = mark else { continue };
            for value in segment.from.as_ref().iter().chain(segment.to.as_ref()) {
                write_exact(text, *value);
                text.push(',');
            }
            // Writing to a `String` cannot fail.
            let _ = writeln!(text, "{},{}", segment.level, segment.colour);
        }
        self.spent = self.spent.saturating_add(meter.spent());
        progress
    }
}
