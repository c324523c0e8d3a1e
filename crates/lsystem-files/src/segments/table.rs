//! Tables of segments: four or six coordinates on each line, separated by commas, semicolons, tabs or spaces.

use super::{SegmentError, number};
use lsystem_base::say;
use lsystem_syntax::notes::excerpt;

/// Headers of columns: the ends of a segment in the plane and in space.
const PLANE: [[&str; 4]; 3] = [["x0", "y0", "x1", "y1"], ["x1", "y1", "x2", "y2"], ["ax", "ay", "bx", "by"]];
const SPACE: [[&str; 6]; 2] = [["x0", "y0", "z0", "x1", "y1", "z1"], ["x1", "y1", "z1", "x2", "y2", "z2"]];

type Table = (Vec<[[f64; 3]; 2]>, bool);

/// Reads a table. Returns `None` if the first line with content is neither a header nor four numbers.
pub(super) fn read(text: &str, most: usize) -> Option<Result<Table, SegmentError>> {
    let mut lines = text.lines().enumerate().map(|(at, line)| (at + 1, line.trim()));
    let mut lines = lines.by_ref().filter(|(_, line)| !line.is_empty() && !line.starts_with('#')).peekable();
    let &(_, first) = lines.peek()?;
    let separator = [';', '\t', ','].into_iter().find(|&separator| first.contains(separator));
    let columns = match header(&cells(first, separator)) {
        Some(columns) => {
            lines.next();
            columns
        }
        None => {
            let numbers = cells(first, separator).iter().map(|cell| value(cell, separator)).collect::<Option<Vec<_>>>();
            let count = numbers?.len();
            // Six numbers are the two ends in space. With any other number of columns, the first four count.
            match count {
                0..4 => return None,
                6 => (0..6).collect(),
                _ => (0..4).collect(),
            }
        }
    };
    Some(rows(lines, separator, &columns, most))
}

fn rows<'a>(
    lines: impl Iterator<Item = (usize, &'a str)>,
    separator: Option<char>,
    columns: &[usize],
    most: usize,
) -> Result<Table, SegmentError> {
    let is_solid = columns.len() == 6;
    let mut segments = Vec::new();
    for (line, text) in lines {
        if segments.len() == most {
            return Err(SegmentError { line, message: say!("there are more than {} segments", most) });
        }
        let cells = cells(text, separator);
        let values = columns.iter().map(|&column| value(cells.get(column)?, separator)).collect::<Option<Vec<f64>>>();
        segments.push(match values.as_deref() {
            Some(&[a, b, c, d]) => [[a, b, 0.0], [c, d, 0.0]],
            Some(&[a, b, c, d, e, f]) => [[a, b, c], [d, e, f]],
            _ => {
                let message = say!("expected {} numbers and found `{}`", columns.len(), excerpt(text));
                return Err(SegmentError { line, message });
            }
        });
    }
    Ok((segments, is_solid))
}

/// The cells of a line. Without a separator, white space separates.
fn cells(line: &str, separator: Option<char>) -> Vec<&str> {
    match separator {
        Some(separator) => line.split(separator).map(|cell| cell.trim().trim_matches('"')).collect(),
        None => line.split_whitespace().collect(),
    }
}

/// The number in a cell. Between semicolons and tabs, a comma may stand for the decimal point.
fn value(cell: &str, separator: Option<char>) -> Option<f64> {
    match separator {
        Some(';' | '\t') => number(&cell.replace(',', ".")),
        _ => number(cell),
    }
}

/// The columns of the coordinates, if the line is a header.
fn header(cells: &[&str]) -> Option<Vec<usize>> {
    let names: Vec<String> = cells.iter().map(|cell| cell.to_ascii_lowercase()).collect();
    let columns = |wanted: &[&str]| {
        wanted.iter().map(|name| names.iter().position(|found| found == name)).collect::<Option<Vec<usize>>>()
    };
    (SPACE.iter().find_map(|wanted| columns(wanted))).or_else(|| PLANE.iter().find_map(|wanted| columns(wanted)))
}
