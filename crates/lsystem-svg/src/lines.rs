//! The straight lines of a picture that a program wrote: all of them, or an error at the first part that is none.

use crate::SvgError;
use crate::transform::Transform;
use crate::work::Work;
use crate::xml::{Document, Element};
use lsystem_base::say;
use lsystem_syntax::notes::excerpt;
use std::str::FromStr;
use svgtypes::{Length, LengthUnit, NumberListParser, PathParser, PathSegment};

type Point = [f64; 2];

/// Reads all lines, polylines, polygons and straight paths, in the coordinates of the outermost element, y down. Text
/// around the picture, as in a web page, is passed over.
///
/// # Errors
/// The first part that cannot be read, with its place; also if there are more than `most` lines.
pub fn lines(text: &str, most: usize) -> Result<Vec<[Point; 2]>, SvgError> {
    // Entities are declared before the first element.
    let begin = if text.contains("<!ENTITY") { 0 } else { text.find("<svg").unwrap_or(0) };
    let rest = &text[begin..];
    let end = rest.rfind("</svg").and_then(|from| Some(from + rest[from..].find('>')? + 1)).unwrap_or(rest.len());
    let read = read(&rest[..end], most);
    read.map_err(|error| SvgError { at: error.at.map(|at| begin + at), ..error })
}

fn read(text: &str, most: usize) -> Result<Vec<[Point; 2]>, SvgError> {
    let document = Document::read(text, &mut Work::default())?;
    let mut lines = Lines { found: Vec::new(), most, transform: Transform::moved(0.0, 0.0) };
    // The ends of the open elements, and the transforms inside.
    let mut open = vec![(usize::MAX, lines.transform)];
    for (index, element) in document.elements().iter().enumerate() {
        while open.len() > 1 && open.last().is_some_and(|(end, _)| *end <= index) {
            open.pop();
        }
        lines.transform = open.last().map_or(lines.transform, |(_, around)| *around);
        let wrong = |message| SvgError { message, at: Some(element.at) };
        if let Some(text) = element.get("transform") {
            let own = Transform::read(text);
            let own = own.ok_or_else(|| wrong(say!("this transform is not read: `{}`", excerpt(text))))?;
            lines.transform = lines.transform.after(own);
        }
        open.push((element.end, lines.transform));
        lines.element(element).map_err(wrong)?;
    }
    Ok(lines.found)
}

struct Lines {
    found: Vec<[Point; 2]>,
    most: usize,
    transform: Transform,
}

impl Lines {
    fn element(&mut self, element: &Element) -> Result<(), String> {
        match element.name {
            "line" => {
                let value = |name: &str| {
                    let text = element.get(name).unwrap_or("0");
                    pixels(text).ok_or_else(|| say!("`{}` of a line must be a number and is `{}`", name, excerpt(text)))
                };
                self.add([value("x1")?, value("y1")?], [value("x2")?, value("y2")?])
            }
            "polyline" | "polygon" => {
                let text = element.get("points").unwrap_or_default();
                let numbers = NumberListParser::from(text).collect::<Result<Vec<f64>, _>>().ok();
                let numbers = numbers.filter(|numbers| numbers.len().is_multiple_of(2));
                let numbers = numbers.ok_or_else(|| say!("the points are damaged: `{}`", excerpt(text)))?;
                let (points, _) = numbers.as_chunks::<2>();
                points.windows(2).try_for_each(|pair| self.add(pair[0], pair[1]))?;
                match (element.name, points) {
                    ("polygon", [first, .., last]) => self.add(*last, *first),
                    _ => Ok(()),
                }
            }
            "path" => self.path(element.get("d").unwrap_or_default()),
            "use" => Err(say!("copies (`use`) are not read; write every line")),
            _ => Ok(()),
        }
    }

    fn path(&mut self, text: &str) -> Result<(), String> {
        let (mut start, mut here) = ([0.0; 2], [0.0; 2]);
        for segment in PathParser::from(text) {
            let segment = segment.map_err(|_| say!("the path is damaged: `{}`", excerpt(text)))?;
            let base = if segment.is_abs() { [0.0; 2] } else { here };
            let next = match segment {
                PathSegment::MoveTo { x, y, .. } | PathSegment::LineTo { x, y, .. } => [base[0] + x, base[1] + y],
                PathSegment::HorizontalLineTo { x, .. } => [base[0] + x, here[1]],
                PathSegment::VerticalLineTo { y, .. } => [here[0], base[1] + y],
                PathSegment::ClosePath { .. } => start,
                _ => {
                    let command = char::from(segment.command());
                    return Err(say!("curves (`{}` in a path) are not read", command));
                }
            };
            match segment {
                PathSegment::MoveTo { .. } => start = next,
                _ => self.add(here, next)?,
            }
            here = next;
        }
        Ok(())
    }

    fn add(&mut self, from: Point, to: Point) -> Result<(), String> {
        if self.found.len() == self.most {
            return Err(say!("there are more than {} segments", self.most));
        }
        let line = [from, to].map(|at| self.transform.of(at));
        if line.iter().flatten().any(|value| !value.is_finite()) {
            return Err(say!("a coordinate is too large"));
        }
        self.found.push(line);
        Ok(())
    }
}

/// A length in pixels. Other units need a size of the page.
fn pixels(text: &str) -> Option<f64> {
    let Length { number, unit } = Length::from_str(text.trim()).ok()?;
    Some(number).filter(|_| matches!(unit, LengthUnit::None | LengthUnit::Px))
}
