//! The function files of cpfg and of the Virtual Laboratory, and text for them.
//!
//! ```text
//! range: 0.0 1.0             fver 1 1
//! points: 4                  name: taper
//! 0 1                        samples: 100
//! 0.3 0.9                    flip: off
//! 0.7 0.5                    points: 4
//! 1 0                        0 1 1             x, y and how often the point counts
//!                            ...
//! ```
//!
//! A set of functions, a file `.fset`, has several of the second form. The points are those of a [`Curve`]. cpfg
//! computes a function at some places and joins these values by lines; a curve is exact.

use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_syntax::Curve;

/// The most points of a file that are looked at.
const MAX_POINTS: usize = 1000;

/// The functions of a file with their names, which are empty if the file has none; `None` for a function that cannot be
/// read.
pub(super) fn read_functions(text: &str) -> Vec<(&str, Option<Curve>)> {
    let begins = |line: &str| ["fver", "range:"].iter().any(|word| line.trim_start().starts_with(word));
    let mut starts: Vec<usize> = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        if begins(line) {
            starts.push(at);
        }
        at += line.len();
    }
    let ends = starts.iter().skip(1).copied().chain([text.len()]);
    starts.iter().zip(ends).map(|(&start, end)| read_function(&text[start..end])).collect()
}

fn read_function(text: &str) -> (&str, Option<Curve>) {
    let value = |keyword: &str| {
        text.lines().find_map(|line| line.trim().strip_prefix(keyword)?.trim_start().strip_prefix(':')).map(str::trim)
    };
    let name = value("name").unwrap_or_default();
    let count = value("points").and_then(|count| count.parse::<usize>().ok()).unwrap_or(0);
    let behind = text.lines().map(str::trim).skip_while(|line| !line.starts_with("points")).skip(1);
    let mut points = Vec::new();
    for line in behind.filter(|line| !line.is_empty()).take(count.min(MAX_POINTS)) {
        let numbers: Option<Vec<f64>> = line.split_whitespace().take(4).map(|word| word.parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x, y]) => points.push([x, y]),
            Some(&[x, y, times]) if times <= 16.0 => points.extend(core::iter::repeat_n([x, y], times as usize)),
            _ => return (name, None),
        }
    }
    // cpfg wants four points and more.
    let curve = if points.len() >= 4 { Curve::new(points) } else { None };
    (name, curve)
}

/// A curve as a file: along x from 0 to 1, with four points or more.
pub(crate) fn function_file(curve: &Curve) -> String {
    let points = curve.points();
    let (first, last) = (points[0][0], points[points.len() - 1][0]);
    let mixed = |a: [f64; 2], b: [f64; 2], part: f64| [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis]));
    // Lines and parabolas as cubics.
    let points = match *points {
        [a, b] => vec![a, mixed(a, b, 1.0 / 3.0), mixed(a, b, 2.0 / 3.0), b],
        [a, b, c] => vec![a, mixed(a, b, 2.0 / 3.0), mixed(b, c, 1.0 / 3.0), c],
        _ => points.to_vec(),
    };
    let mut text = format!("range: 0.0 1.0\npoints: {}\n", points.len());
    for [x, y] in points {
        let _ = writeln!(text, "{} {}", number((x - first) / (last - first)), number(y));
    }
    text
}
