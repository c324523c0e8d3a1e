//! Predefined surfaces: bicubic Bezier patches that a symbol draws (ABOP, section 5.1).
//!
//! ```text
//! l: 0 0 0  0 .3 0  0 .6 0  0 1 0 ...
//! ```
//!
//! Each line has a surface: a letter as its name, a colon, and the coordinates of 16 control points for each patch, row
//! by row. A point has three numbers: ahead of the turtle, to its left, and up, for a surface of size 1. White space or
//! commas separate the numbers. The turtle is at the origin.

use crate::Diagnostic;
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_base::{MAX_SURFACE_PATCHES, MAX_SURFACES, decimal, say};

/// A point or a direction: ahead, left and up.
pub type SurfacePoint = [f64; 3];

/// The control points of a patch, row by row.
pub type Patch = [SurfacePoint; 16];

/// The number of strips of a patch in both directions: a patch has up to 72 triangles. Between the corners of a strip, a
/// row of control points that turns by 90 degrees stays within 1/150 of its length of the true surface.
pub(crate) const SURFACE_STRIPS: usize = 6;

/// The largest coordinate.
const MAX: f64 = 1e6;

/// A surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The surface's name: a letter.
    pub name: char,
    /// The patches; at least one and at most [`MAX_SURFACE_PATCHES`].
    pub patches: Vec<Patch>,
}

/// Reads surfaces.
///
/// # Errors
/// The first wrong line.
pub fn parse_surfaces(text: &str) -> Result<Vec<Surface>, Diagnostic> {
    let mut found: Vec<Surface> = Vec::new();
    for (line, written) in text.lines().enumerate() {
        if written.trim().is_empty() {
            continue;
        }
        let surface = surface(written).and_then(|surface| match &found {
            _ if found.iter().any(|other| other.name == surface.name) => {
                Err(say!("the surface `{}` stands twice", surface.name))
            }
            _ if found.len() >= MAX_SURFACES => Err(say!("a system has at most {} surfaces", MAX_SURFACES)),
            _ => Ok(surface),
        });
        found.push(surface.map_err(|problem| {
            Diagnostic::error(say!("Line {} of the surfaces: {}", line + 1, problem))
                .hint(say!("A surface is a letter, a colon, and 48 numbers for each patch."))
        })?);
    }
    Ok(found)
}

/// Reads a line; the error is what is wrong with it.
fn surface(line: &str) -> Result<Surface, String> {
    let no_name = || say!("it does not begin with a letter and a colon");
    let (name, numbers) = line.split_once(':').ok_or_else(no_name)?;
    let mut letters = name.trim().chars();
    let name = match (letters.next(), letters.next()) {
        (Some(name), None) if name.is_alphabetic() => name,
        _ => return Err(no_name()),
    };
    let words = || numbers.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    let count = words().count();
    if count == 0 || count % 48 != 0 {
        return Err(say!("{} numbers are no multiple of 48", count));
    }
    if count / 48 > MAX_SURFACE_PATCHES {
        return Err(say!("a surface has at most {} patches", MAX_SURFACE_PATCHES));
    }
    let number = |word: &str| decimal::read(word).filter(|value| value.abs() <= MAX);
    let numbers = words().map(number).collect::<Option<Vec<f64>>>();
    let numbers = numbers.ok_or_else(|| say!("a word is no number between -1,000,000 and 1,000,000"))?;
    let patch = |numbers: &[f64]| core::array::from_fn(|at| core::array::from_fn(|axis| numbers[3 * at + axis]));
    Ok(Surface { name, patches: numbers.chunks_exact(48).map(patch).collect() })
}

/// Surfaces as text that [`parse_surfaces`] reads as the same surfaces.
#[must_use]
pub fn print_surfaces(surfaces: &[Surface]) -> String {
    let mut text = String::new();
    for surface in surfaces {
        if !text.is_empty() {
            text.push('\n');
        }
        let _ = write!(text, "{}:", surface.name);
        for coordinate in surface.patches.iter().flatten().flatten() {
            text.push(' ');
            text.push_str(&number(*coordinate));
        }
    }
    text
}

impl Surface {
    /// The triangles of a surface of size 1: each patch as [`SURFACE_STRIPS`] times [`SURFACE_STRIPS`] cells of two
    /// triangles. Triangles with two corners that are equal but for rounding are left out.
    #[must_use]
    pub fn triangles(&self) -> Vec<[SurfacePoint; 3]> {
        let mut triangles = Vec::new();
        let reach = self.patches.iter().flatten().flatten().fold(0.0_f64, |reach, c| reach.max(c.abs()));
        let differ = |a: &SurfacePoint, b: &SurfacePoint| a.iter().zip(b).any(|(a, b)| (a - b).abs() > 1e-9 * reach);
        for patch in &self.patches {
            let corner = |row: usize, column: usize| {
                let [u, v] = [row, column].map(|at| weights(at as f64 / SURFACE_STRIPS as f64));
                core::array::from_fn(|axis| {
                    let row = |row: usize| (0..4).map(|at| v[at] * patch[4 * row + at][axis]).sum::<f64>();
                    (0..4).map(|at| u[at] * row(at)).sum::<f64>()
                })
            };
            for row in 0..SURFACE_STRIPS {
                for column in 0..SURFACE_STRIPS {
                    let [a, b] = [corner(row, column), corner(row, column + 1)];
                    let [c, d] = [corner(row + 1, column + 1), corner(row + 1, column)];
                    let is_full = |[a, b, c]: &[SurfacePoint; 3]| differ(a, b) && differ(b, c) && differ(c, a);
                    triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(is_full));
                }
            }
        }
        triangles
    }
}

/// The Bernstein polynomials of degree 3.
fn weights(t: f64) -> [f64; 4] {
    let rest = 1.0 - t;
    [rest * rest * rest, 3.0 * t * rest * rest, 3.0 * t * t * rest, t * t * t]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(name: char) -> String {
        let points = (0..16).map(|at| format!(" {} {} 0", at % 4, at / 4)).collect::<String>();
        format!("{name}:{points}")
    }

    #[test]
    fn text_and_surfaces_are_the_same() {
        let text = format!("{}\n\n{}", flat('l'), flat('M').replace(" 3 3 0", ", 3,3.5 -0.25"));
        let found = parse_surfaces(&text).unwrap();
        assert_eq!((found[0].name, found[1].patches[0][15]), ('l', [3.0, 3.5, -0.25]));
        assert_eq!(parse_surfaces(&print_surfaces(&found)), Ok(found));
    }

    #[test]
    fn problems_name_their_line() {
        let many = (0..=MAX_SURFACES).map(|at| flat(char::from_u32(0x3b1 + at as u32).unwrap())).collect::<Vec<_>>();
        let long = format!("l:{}", " 1".repeat(48 * (MAX_SURFACE_PATCHES + 1)));
        for (text, line, problem) in [
            ("l 1 2 3", 1, "it does not begin with a letter and a colon"),
            ("2: 1", 1, "it does not begin with a letter and a colon"),
            ("l: 1 2", 1, "2 numbers are no multiple of 48"),
            ("l:", 1, "0 numbers are no multiple of 48"),
            (&flat('l').replacen('0', "x", 1), 1, "a word is no number between -1,000,000 and 1,000,000"),
            (&flat('l').replacen('0', "1e7", 1), 1, "a word is no number between -1,000,000 and 1,000,000"),
            (&format!("{}\n{}", flat('l'), flat('l')), 2, "the surface `l` stands twice"),
            (&many.join("\n"), MAX_SURFACES + 1, "a system has at most 32 surfaces"),
            (&long, 1, "a surface has at most 16 patches"),
        ] {
            let error = parse_surfaces(text).unwrap_err();
            assert_eq!(error.message, format!("Line {line} of the surfaces: {problem}"), "{text}");
        }
    }

    /// A point of a curve by repeated division of its control polygon.
    fn divided(points: &[SurfacePoint], t: f64) -> SurfacePoint {
        match points {
            [point] => *point,
            _ => {
                let between =
                    |pair: &[SurfacePoint]| core::array::from_fn(|axis| (1.0 - t) * pair[0][axis] + t * pair[1][axis]);
                divided(&points.windows(2).map(between).collect::<Vec<_>>(), t)
            }
        }
    }

    #[test]
    fn corners_are_those_of_de_casteljau() {
        let patch: Patch = core::array::from_fn(|at| {
            let (x, y) = ((at % 4) as f64, (at / 4) as f64);
            [x + 0.3 * y, y - 0.2 * x * x, libm::sin(x * y)]
        });
        let triangles = Surface { name: 'l', patches: vec![patch] }.triangles();
        assert_eq!(triangles.len(), 2 * SURFACE_STRIPS * SURFACE_STRIPS);
        for (cell, pair) in triangles.chunks_exact(2).enumerate() {
            let place = |row: usize, column: usize| {
                let [u, v] = [row, column].map(|at| at as f64 / SURFACE_STRIPS as f64);
                let rows: Vec<SurfacePoint> = patch.chunks(4).map(|row| divided(row, v)).collect();
                divided(&rows, u)
            };
            let (row, column) = (cell / SURFACE_STRIPS, cell % SURFACE_STRIPS);
            let [a, b] = [place(row, column), place(row, column + 1)];
            let [c, d] = [place(row + 1, column + 1), place(row + 1, column)];
            for (found, expected) in pair.iter().flatten().zip([a, b, c, a, c, d]) {
                assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
            }
        }
    }

    #[test]
    fn a_row_that_turns_by_90_degrees_stays_near_its_surface() {
        // A quarter of a circle, lifted along the other direction.
        let bend = 0.552_284_749_8;
        let row = [[1.0, 0.0], [1.0, bend], [bend, 1.0], [0.0, 1.0]];
        let point = |t: f64| divided(&row.map(|[x, y]| [x, y, 0.0]), t);
        let length = 2.0_f64.sqrt();
        for at in 0..600 {
            let strip = (at / 100) as f64;
            let [a, b, p] = [strip / 6.0, (strip + 1.0) / 6.0, f64::from(at) / 600.0].map(point);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let across = (dx * (p[1] - a[1]) - dy * (p[0] - a[0])).abs() / (dx * dx + dy * dy).sqrt();
            assert!(across < length / 150.0, "{across}");
        }
    }

    #[test]
    fn a_patch_that_ends_in_a_point_has_no_flat_triangles() {
        let mut found = parse_surfaces(&flat('l')).unwrap();
        found[0].patches[0][..4].fill([0.1, 0.3, 0.7]);
        assert_eq!(found[0].triangles().len(), 2 * SURFACE_STRIPS * SURFACE_STRIPS - SURFACE_STRIPS);
    }
}
