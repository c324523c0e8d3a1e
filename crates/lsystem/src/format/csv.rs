//! Segments as comma-separated values.

use super::number::write_exact;
use crate::{Diagnostic, Drawing, Space};
use core::fmt::Write;

/// Writes all segments in drawing order, a line each, below the header `x0,y0,x1,y1,level,colour` in the plane and
/// `x0,y0,z0,x1,y1,z1,level,colour` in space: model units with the fewest digits that read back as the same number,
/// branch level, colour index not wrapped to a palette.
///
/// # Errors
/// [`Kind::Limit`](crate::Kind::Limit) where there are more than `most` segments.
pub fn write_csv<S: Space>(drawing: &Drawing<S>, most: u64) -> Result<String, Diagnostic> {
    drawing.check_segments(most)?;
    let flat = S::Point::default().as_ref().len() == 2;
    let head = if flat { "x0,y0,x1,y1,level,colour\n" } else { "x0,y0,z0,x1,y1,z1,level,colour\n" };
    let mut text = String::from(head);
    for segment in drawing.segments() {
        for value in segment.from.as_ref().iter().chain(segment.to.as_ref()) {
            write_exact(&mut text, *value);
            text.push(',');
        }
        // Writing to a `String` cannot fail.
        let _ = writeln!(text, "{},{}", segment.level, segment.colour);
    }
    Ok(text)
}
