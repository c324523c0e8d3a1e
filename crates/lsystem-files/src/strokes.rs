//! Strokes and polygons in files, and their looks.

use lsystem_drawing::{Drawing, Mark, StyleChange};
use lsystem_syntax::{Halt, Style, Tint, Work};

/// The most segments of one path. Longer paths take browsers disproportionately long.
pub(super) const PATH: usize = 10_000;
/// The units of work to write a vertex of a polygon.
pub(super) const VERTEX_WORK: u64 = 4;

/// A file of strokes and polygons, in the units of the file, y up.
pub(super) trait StrokeFile: Work {
    /// Writes a stroke.
    fn stroke(&mut self, from: [f64; 2], to: [f64; 2], look: StrokeLook);
    /// Writes a filled polygon.
    fn fill(&mut self, vertices: impl Iterator<Item = [f64; 2]>, rgb: [u8; 3]) -> Result<(), Halt>;
    /// Ends the open path, if any, so that other elements can follow.
    fn close(&mut self);
}

/// Writes all strokes and polygons of a drawing in drawing order. `place` turns points and `look` turns stroke widths
/// from model units to the units of the file.
pub(super) fn write_marks(
    drawing: &Drawing,
    style: &Style,
    place: impl Fn([f64; 2]) -> [f64; 2],
    look: impl Fn(Tint, f64) -> StrokeLook,
    file: &mut impl StrokeFile,
) -> Result<(), Halt> {
    for mark in drawing.marks() {
        match mark {
            Mark::Segment(segment, tint) => {
                file.charge(8)?;
                let ends = [place(segment.from), place(segment.to)];
                let [first, last] = [segment.width, segment.end_width].map(|width| look(tint, width));
                if first.width == last.width {
                    file.stroke(ends[0], ends[1], first);
                } else {
                    file.fill(cone(ends, [first.width, last.width]), first.rgb)?;
                }
            }
            Mark::Polygon(vertices, tint) => {
                file.charge(8 + vertices.len() as u64 / 8)?;
                file.fill(vertices.into_iter().map(&place), style.colour_of(tint).rgb)?;
            }
        }
    }
    file.close();
    Ok(())
}

/// The corners of half a round end.
const ROUND: usize = 8;

/// The outline of a stroke that tapers, with round ends. `widths` are those at the ends.
pub(super) fn cone(ends: [[f64; 2]; 2], widths: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let [dx, dy] = [0, 1].map(|axis| ends[1][axis] - ends[0][axis]);
    let length = libm::hypot(dx, dy);
    let radii = widths.map(|width| width / 2.0);
    let ahead = libm::atan2(dy, dx);
    // The angle from the direction ahead to the place where the straight sides begin. An end may contain the other.
    let side = libm::acos(((radii[0] - radii[1]) / length).clamp(-1.0, 1.0));
    let side = if side.is_nan() { core::f64::consts::FRAC_PI_2 } else { side };
    let arc = move |end: usize, from: f64, to: f64| {
        (0..=ROUND).map(move |step| {
            let (sin, cos) = libm::sincos(ahead + from + (to - from) * step as f64 / ROUND as f64);
            [ends[end][0] + radii[end] * cos, ends[end][1] + radii[end] * sin]
        })
    };
    arc(1, -side, side).chain(arc(0, side, core::f64::consts::TAU - side))
}

/// The look of a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StrokeLook {
    pub(super) rgb: [u8; 3],
    /// In the units of the file.
    pub(super) width: f64,
}

impl StrokeLook {
    /// The look of a stroke of this width. `pixel` is the length of one CSS pixel in the same units.
    pub(super) fn new(style: &Style, tint: Tint, width: f64, pixel: f64) -> Self {
        let width = within(width.max(style.min_width * pixel));
        // A stroke of width 0 is drawn one pixel wide, as on the screen.
        Self { rgb: style.colour_of(tint).rgb, width: if width > 0.0 { width } else { pixel } }
    }

    /// The look of a style that began with [`StyleChange::start`]. `step` is the step length.
    pub(super) fn of(style: &Style, change: &StyleChange, step: f64, pixel: f64) -> Self {
        let tint = Tint { index: change.colour.of(0), level: change.level, place: 0.0 };
        Self::new(style, tint, change.width.of(0.0) * step, pixel)
    }
}

/// Clamps a length so that sums of two lengths stay finite.
pub(super) fn within(length: f64) -> f64 {
    length.clamp(-1e300, 1e300)
}
