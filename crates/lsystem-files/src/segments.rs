//! Segments in the output of any program: an SVG of lines, or a table of coordinates.

mod table;

use lsystem_base::decimal;
use lsystem_base::say;
use lsystem_syntax::line_of;

/// The segments of a file, in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentFile {
    /// The form of the file.
    pub form: SegmentForm,
    /// The two ends of each segment; z is 0 in the plane.
    pub segments: Vec<[[f64; 3]; 2]>,
    /// Whether the file gives z coordinates.
    pub is_solid: bool,
    /// The step to which the file's coordinates are rounded, in their own units, as in 0.01 for two decimals. Digits
    /// beyond the sixth decimal do not count.
    pub rounding: f64,
}

/// The forms of files of segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SegmentForm {
    /// Lines, polylines, polygons and paths of an SVG picture, y down.
    Svg,
    /// One segment on each line of a table.
    Table,
}

/// Reads segments. Returns `None` if the text is neither XML nor a table of numbers.
///
/// # Errors
/// The first part that cannot be read, and its line of the text (from 1): a file with a part that is not understood is
/// not read at all, so that no segment is left out unnoticed. Files with more than `most` segments are not read.
#[must_use]
pub fn read_segments(text: &str, most: usize) -> Option<Result<SegmentFile, SegmentError>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let found = if text.trim_start().starts_with('<') {
        let lines = lsystem_svg::lines(text, most)
            .map_err(|error| SegmentError { line: line_of(text, error.at.unwrap_or(0)), message: error.message });
        lines.map(|lines| {
            let flat = |line: [[f64; 2]; 2]| line.map(|[x, y]| [x, y, 0.0]);
            (SegmentForm::Svg, lines.into_iter().map(flat).collect(), false)
        })
    } else {
        let (segments, is_solid) = match table::read(text, most)? {
            Ok(table) => table,
            Err(error) => return Some(Err(error)),
        };
        Ok((SegmentForm::Table, segments, is_solid))
    };
    Some(found.map(|(form, segments, is_solid)| {
        let rounding = rounding(&segments);
        SegmentFile { form, segments, is_solid, rounding }
    }))
}

/// Why segments are not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SegmentError {
    /// The line in the text, from 1.
    pub line: usize,
    /// The problem, in words.
    pub message: String,
}

impl core::fmt::Display for SegmentError {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.write_str(&say!("line {}: {}", self.line, self.message))
    }
}

/// The largest power of ten, from 1 down to a millionth, of which all coordinates are multiples.
fn rounding(segments: &[[[f64; 3]; 2]]) -> f64 {
    let mut digits = 0;
    for value in segments.iter().flatten().flatten() {
        let is_multiple = |digits: i32| {
            let scaled = value * SCALES[digits as usize];
            (scaled - libm::round(scaled)).abs() <= 1e-6_f64.max(scaled.abs() * 1e-15)
        };
        while digits < 6 && !is_multiple(digits) {
            digits += 1;
        }
    }
    1.0 / SCALES[digits as usize]
}

/// The powers of ten.
const SCALES: [f64; 7] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// A finite number.
fn number(text: &str) -> Option<f64> {
    decimal::read(text).filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write;

    fn read(text: &str) -> String {
        match read_segments(text, 12) {
            None => "none".to_owned(),
            Some(Err(error)) => error.to_string(),
            Some(Ok(SegmentFile { segments, is_solid, rounding, .. })) => {
                let mut out = format!("{} to {rounding}:", if is_solid { "solid" } else { "plane" });
                for [[a, b, c], [d, e, f]] in segments {
                    let _ = match is_solid {
                        true => write!(out, " {a},{b},{c}-{d},{e},{f}"),
                        false => write!(out, " {a},{b}-{d},{e}"),
                    };
                }
                out
            }
        }
    }

    #[test]
    fn tables() {
        for (text, expected) in [
            ("x0,y0,x1,y1,level,colour\n0,0,1,0.5,0,0\n", "plane to 0.1: 0,0-1,0.5"),
            ("0 0 1 0\n1 0 1 1\n", "plane to 1: 0,0-1,0 1,0-1,1"),
            ("# my lines\n\n0;0;1,25;0\r\n", "plane to 0.01: 0,0-1.25,0"),
            ("colour\tx1\ty1\tx2\ty2\nred\t1\t2\t3\t4", "plane to 1: 1,2-3,4"),
            ("x0,y0,z0,x1,y1,z1\n0,0,0,1,2,3", "solid to 1: 0,0,0-1,2,3"),
            ("0,0,0,1,2,3", "solid to 1: 0,0,0-1,2,3"),
            ("1,2,3,4\n5,6,x,8", "line 2: expected 4 numbers and found `5,6,x,8`"),
            ("x0,y0,x1,y1\n1,2,inf,4", "line 2: expected 4 numbers and found `1,2,inf,4`"),
            ("x0,y0,x1,y1\n", "plane to 1:"),
            ("F+F--F+F", "none"),
            ("", "none"),
            ("1,2", "none"),
            ("F 1 2 3 4", "none"),
        ] {
            assert_eq!(read(text), expected, "{text}");
        }
        assert!(read(&"0,0,1,1\n".repeat(13)).contains("more than 12 segments"));
    }

    #[test]
    fn pictures() {
        for (inside, expected) in [
            ("<line x1='0' y1=\"1\" x2='2.5' y2='3px'/>", "plane to 0.1: 0,1-2.5,3"),
            ("<line x2='2'></line>", "plane to 1: 0,0-2,0"),
            ("<polyline points='0,0 1,0 1 1'/>", "plane to 1: 0,0-1,0 1,0-1,1"),
            ("<polygon points='0,0 1,0 1 1'/>", "plane to 1: 0,0-1,0 1,0-1,1 1,1-0,0"),
            ("<path d='M0 0L1-1H3V4l1,1 1,1z'/>", "plane to 1: 0,0-1,-1 1,-1-3,-1 3,-1-3,4 3,4-4,5 4,5-5,6 5,6-0,0"),
            ("<path d='m1e1.5.5.5M1 1'/>", "plane to 0.1: 10,0.5-10.5,1"),
            ("<g transform='scale(1,-1)'><path d='M1,1h2'/></g><path d='M1,1h2'/>", "plane to 1: 1,-1-3,-1 1,1-3,1"),
            (
                "<g transform='translate(10 20) rotate(90)'><line x2='1' transform='matrix(2 0 0 2 1 0)'/></g>",
                "plane to 1: 10,21-10,23",
            ),
            ("<!-- <line x2='1'/> --><style>a > b</style><rect width='9'/><text>F</text>", "plane to 1:"),
            ("<path d='M0 0 C1 1 2 2 3 3'/>", "line 2: curves (`C` in a path) are not read"),
            ("<use href='#a'/>", "line 2: copies (`use`) are not read; write every line"),
            ("<line x1='a'/>", "line 2: `x1` of a line must be a number and is `a`"),
            ("<path d='L1'/>", "line 2: the path is damaged: `L1`"),
            ("<polyline points='0,0 1'/>", "line 2: the points are damaged: `0,0 1`"),
            ("<line x1='1", "line 2: this SVG is damaged"),
            ("<g transform='tilt(3)'></g>", "line 2: this transform is not read: `tilt(3)`"),
        ] {
            assert_eq!(read(&format!("<svg>\n{inside}</svg>")), expected, "{inside}");
        }
        for (text, expected) in [
            ("<!DOCTYPE html><meta><p>a<br>\n<svg><line x2='2'/></svg></body>", "plane to 1: 0,0-2,0"),
            ("<!DOCTYPE html>\n<svg>\n<line x2='2mm'/></svg>", "line 3: `x2` of a line must be a number and is `2mm`"),
            ("<s:svg xmlns:s='a'><s:line x2='&#50;'/></s:svg>", "plane to 1: 0,0-2,0"),
            ("<svg>\n<g>\n<line x2='2'/></svg>", "line 3: this SVG is damaged"),
            ("<svg><line x2='1e300' transform='scale(1e300)'/></svg>", "line 1: a coordinate is too large"),
        ] {
            assert_eq!(read(text), expected, "{text}");
        }
        let many = format!("<svg>{}</svg>", "<line x2='1'/>".repeat(13));
        assert!(read(&many).contains("more than 12 segments"));
    }
}
