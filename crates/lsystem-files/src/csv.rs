//! Segments as comma-separated values.

use super::number::write_exact;
use super::sink::{Sink, collect};
use core::fmt::Write;
use lsystem_drawing::{Drawing, Mark, Space};
use lsystem_syntax::{Diagnostic, Halt, Work};

/// Writes all segments in drawing order, one on each line. The header is `x0,y0,x1,y1,level,colour` in the plane and
/// `x0,y0,z0,x1,y1,z1,level,colour` in space. Coordinates are in model units, with the fewest digits that read back as
/// the same number. `level` is the branch level; `colour` is the colour index, not wrapped to a palette;
/// the lines of shapes have the smallest 32-bit integer.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if there are more than `most` segments and vertices of polygons.
pub fn write_csv<S: Space>(drawing: &Drawing<S>, most: u64) -> Result<String, Diagnostic> {
    collect(|sink| csv_file(drawing, most, sink)).map(|(text, ())| text)
}

/// As [`write_csv`], piece by piece.
pub(crate) fn csv_file<S: Space>(drawing: &Drawing<S>, most: u64, sink: &mut Sink<'_>) -> Result<(), Halt> {
    drawing.check_size(most)?;
    let is_flat = S::Point::default().as_ref().len() == 2;
    sink.text.push_str(if is_flat { "x0,y0,x1,y1,level,colour\n" } else { "x0,y0,z0,x1,y1,z1,level,colour\n" });
    for mark in drawing.marks() {
        sink.charge(mark.work())?;
        let Mark::Segment(segment, _) = mark else { continue };
        for value in segment.from.as_ref().iter().chain(segment.to.as_ref()) {
            write_exact(&mut sink.text, *value);
            sink.text.push(',');
        }
        // Writing to a `String` cannot fail.
        let _ = writeln!(sink.text, "{},{}", segment.level, segment.colour);
    }
    Ok(())
}
