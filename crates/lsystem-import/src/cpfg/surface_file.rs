//! The files of surfaces of cpfg, and text for them.
//!
//! A file has the bounds of the surface, a contact point, the directions that become the turtle's heading and up, a size,
//! and for each patch some lines about its colours and neighbours, and four lines with four points each.

use core::fmt::Write;
use lsystem_base::{MAX_SURFACE_PATCHES, number::number};
use lsystem_syntax::{Patch, Surface, SurfacePoint};

/// The patches of a file, in the frame of the turtle, times `scale`, with five digits. `None` if the file is no surface.
pub(super) fn read_surface(text: &str, scale: f64) -> Option<Vec<Patch>> {
    let [mut contact, mut heading, mut up] = [[0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut size = 1.0;
    let mut rows: Vec<[f64; 12]> = Vec::new();
    for line in text.lines().map(str::trim) {
        let point = || numbers(line).try_into().ok();
        match line {
            _ if line.starts_with("CONTACT POINT") => contact = point()?,
            _ if line.starts_with("HEADING") => heading = point()?,
            _ if line.starts_with("UP") => up = point()?,
            _ if line.starts_with("SIZE") => size = *numbers(line).first()?,
            _ if line.starts_with(|c: char| c.is_ascii_digit() || "-+.".contains(c)) => {
                rows.extend(<[f64; 12]>::try_from(numbers(line)));
            }
            _ => {}
        }
        if rows.len() > 4 * MAX_SURFACE_PATCHES {
            return None;
        }
    }
    if rows.is_empty() || !rows.len().is_multiple_of(4) || size == 0.0 {
        return None;
    }
    let heading = unit(heading)?;
    let along = dot(up, heading);
    let up = unit(core::array::from_fn(|axis| up[axis] - along * heading[axis]))?;
    let left = [
        up[1] * heading[2] - up[2] * heading[1],
        up[2] * heading[0] - up[0] * heading[2],
        up[0] * heading[1] - up[1] * heading[0],
    ];
    let point = |written: &[f64]| -> SurfacePoint {
        let from = core::array::from_fn(|axis| (written[axis] - contact[axis]) * (scale / size));
        [heading, left, up].map(|axis| rounded(dot(from, axis)))
    };
    let patch = |rows: &[[f64; 12]]| -> Patch {
        core::array::from_fn(|at| point(&rows[at / 4][3 * (at % 4)..3 * (at % 4) + 3]))
    };
    let patches: Vec<Patch> = rows.chunks_exact(4).map(patch).collect();
    patches.iter().flatten().flatten().all(|c| c.abs() <= 1e6).then_some(patches)
}

/// A surface as a file.
pub(crate) fn surface_file(surface: &Surface) -> String {
    let all = || surface.patches.iter().flatten();
    let mut text = String::new();
    for axis in 0..3 {
        let bound =
            |start: f64, of: fn(f64, f64) -> f64| number(all().fold(start, |bound, point| of(bound, point[axis])));
        let _ = write!(text, "{} {} ", bound(f64::INFINITY, f64::min), bound(f64::NEG_INFINITY, f64::max));
    }
    text.push_str("\nCONTACT POINT X: 0 Y: 0 Z: 0\nEND POINT X: 0 Y: 0 Z: 0\nHEADING X: 1 Y: 0 Z: 0\nUP X: 0 Y: 0 Z: 1\nSIZE: 1\n");
    for (at, patch) in surface.patches.iter().enumerate() {
        let _ = write!(
            text,
            "patch{at}\nTOP COLOR: 0 DIFFUSE: 0 BOTTOM COLOR: 0 DIFFUSE: 0\nAL: ~ A: ~ AR: ~\nL: ~ R: ~\nBL: ~ B: ~ BR: ~\n"
        );
        for row in patch.chunks(4) {
            let words: Vec<String> = row.iter().flatten().map(|c| number(*c)).collect();
            let _ = writeln!(text, "{}", words.join(" "));
        }
    }
    text
}

/// The numbers of a line, without its words.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split(|c: char| c.is_whitespace() || c == ':');
    words.filter_map(|word| word.parse::<f64>().ok().filter(|value| value.is_finite())).take(13).collect()
}

fn dot(a: SurfacePoint, b: SurfacePoint) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The direction with length 1; `None` for no direction.
fn unit(vector: SurfacePoint) -> Option<SurfacePoint> {
    let length = dot(vector, vector).sqrt();
    (length > 1e-9 && length.is_finite()).then(|| vector.map(|c| c / length))
}

/// The number with five digits: more than the files have.
fn rounded(value: f64) -> f64 {
    if value.abs() < 1e-9 || !value.is_finite() {
        return if value.is_finite() { 0.0 } else { value };
    }
    format!("{value:.4e}").parse().unwrap_or(value)
}
