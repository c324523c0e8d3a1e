//! The straight lines of an SVG picture.

use super::{SegmentError, number};
use lsystem_base::say;
use lsystem_syntax::line_of;
use lsystem_syntax::notes::excerpt;

/// The most nested elements.
const DEEPEST: usize = 200;

/// A map of points: the images of the two axes, and of the origin.
type Affine = [f64; 6];
const IDENTITY: Affine = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0];

/// Reads all lines, polylines, polygons and straight paths, in the coordinates of the outermost element.
pub(super) fn read(text: &str, most: usize) -> Result<Vec<[[f64; 3]; 2]>, SegmentError> {
    let mut out = Segments { found: Vec::new(), most };
    // The transforms of the open elements, each with those around it.
    let mut open = vec![IDENTITY];
    let mut at = 0;
    while let Some(start) = text[at..].find('<').map(|offset| at + offset) {
        let wrong = |message: String| SegmentError { line: line_of(text, start), message };
        let rest = &text[start..];
        let ended = |end: &str| {
            rest.find(end).map(|offset| start + offset + end.len()).ok_or_else(|| wrong(say!("a tag has no end")))
        };
        if rest.starts_with("<!--") {
            at = ended("-->")?;
        } else if rest.starts_with("<![CDATA[") {
            at = ended("]]>")?;
        } else if rest.starts_with("<!") || rest.starts_with("<?") {
            at = ended(">")?;
        } else if rest.starts_with("</") {
            at = ended(">")?;
            if open.len() > 1 {
                open.pop();
            }
        } else {
            let end = tag_end(rest).ok_or_else(|| wrong(say!("a tag has no end")))?;
            at = start + end + 1;
            let tag = Tag::new(&rest[1..end]);
            let around = open.last().copied().unwrap_or(IDENTITY);
            let own = match tag.attribute("transform") {
                Some(text) => {
                    transform(text).ok_or_else(|| wrong(say!("this transform is not read: `{}`", excerpt(text))))?
                }
                None => IDENTITY,
            };
            let affine = compose(around, own);
            tag.draw(affine, &mut out).map_err(wrong)?;
            if !tag.is_closed {
                open.push(affine);
            }
            if open.len() > DEEPEST {
                return Err(wrong(say!("the elements are nested too deeply")));
            }
        }
    }
    Ok(out.found)
}

/// The index of the `>` that ends a tag. Quoted values may contain others.
fn tag_end(text: &str) -> Option<usize> {
    let mut quote = None;
    text.bytes().position(|byte| {
        match quote {
            None if matches!(byte, b'"' | b'\'') => quote = Some(byte),
            Some(open) if byte == open => quote = None,
            _ => {}
        }
        byte == b'>' && quote.is_none()
    })
}

/// The segments found so far.
struct Segments {
    found: Vec<[[f64; 3]; 2]>,
    most: usize,
}

impl Segments {
    fn add(&mut self, affine: Affine, from: [f64; 2], to: [f64; 2]) -> Result<(), String> {
        if self.found.len() == self.most {
            return Err(say!("there are more than {} segments", self.most));
        }
        let place = |[x, y]: [f64; 2]| {
            let [a, b, c, d, e, f] = affine;
            [a * x + c * y + e, b * x + d * y + f, 0.0]
        };
        let segment = [place(from), place(to)];
        if segment.iter().flatten().any(|value| !value.is_finite()) {
            return Err(say!("a coordinate is too large"));
        }
        self.found.push(segment);
        Ok(())
    }
}

/// A start tag.
struct Tag<'a> {
    name: &'a str,
    attributes: Vec<(&'a str, &'a str)>,
    /// Whether the element ends with this tag.
    is_closed: bool,
}

impl<'a> Tag<'a> {
    /// Reads a tag without its `<` and `>`.
    fn new(text: &'a str) -> Self {
        let body = text.trim_end();
        let (body, is_closed) = body.strip_suffix('/').map_or((body, false), |body| (body, true));
        let end = body.find(|c: char| c.is_whitespace()).unwrap_or(body.len());
        let (name, mut rest) = body.split_at(end);
        let mut attributes = Vec::new();
        while let Some((key, after)) = rest.split_once('=') {
            let after = after.trim_start();
            let Some(quote) = after.chars().next().filter(|c| matches!(c, '"' | '\'')) else { break };
            let Some((value, after)) = after[1..].split_once(quote) else { break };
            attributes.push((key.trim(), value));
            rest = after;
        }
        let name = name.rsplit(':').next().unwrap_or(name);
        Self { name, attributes, is_closed }
    }

    fn attribute(&self, name: &str) -> Option<&'a str> {
        self.attributes.iter().find(|(key, _)| *key == name).map(|(_, value)| *value)
    }

    fn draw(&self, affine: Affine, out: &mut Segments) -> Result<(), String> {
        match self.name {
            "line" => {
                let value = |name: &str| {
                    let text = self.attribute(name).unwrap_or("0");
                    number(text.trim().trim_end_matches("px"))
                        .ok_or_else(|| say!("`{}` of a line must be a number and is `{}`", name, excerpt(text)))
                };
                out.add(affine, [value("x1")?, value("y1")?], [value("x2")?, value("y2")?])
            }
            "polyline" | "polygon" => {
                let text = self.attribute("points").unwrap_or("");
                let numbers = numbers(text).filter(|numbers| numbers.len().is_multiple_of(2));
                let numbers = numbers.ok_or_else(|| say!("the points are damaged: `{}`", excerpt(text)))?;
                let (points, _) = numbers.as_chunks::<2>();
                points.windows(2).try_for_each(|pair| out.add(affine, pair[0], pair[1]))?;
                match (self.name, points) {
                    ("polygon", [first, .., last]) => out.add(affine, *last, *first),
                    _ => Ok(()),
                }
            }
            "path" => path(self.attribute("d").unwrap_or(""), affine, out),
            "use" => Err(say!("copies (`use`) are not read; write every line")),
            _ => Ok(()),
        }
    }
}

/// Reads the data of a path.
fn path(text: &str, affine: Affine, out: &mut Segments) -> Result<(), String> {
    let damaged = || say!("the path is damaged: `{}`", excerpt(text));
    let (mut start, mut here) = ([0.0; 2], [0.0; 2]);
    let mut rest = text.trim_start();
    let mut is_first = true;
    while let Some(command) = rest.chars().next() {
        let (upper, is_relative) = (command.to_ascii_uppercase(), command.is_ascii_lowercase());
        match upper {
            'M' | 'L' | 'H' | 'V' | 'Z' => {}
            'C' | 'S' | 'Q' | 'T' | 'A' => return Err(say!("curves (`{}` in a path) are not read", command)),
            _ => return Err(damaged()),
        }
        rest = &rest[1..];
        let is_command = |c: char| c.is_ascii_alphabetic() && !matches!(c, 'e' | 'E');
        let end = rest.find(is_command).unwrap_or(rest.len());
        let values = numbers(&rest[..end]).ok_or_else(damaged)?;
        rest = &rest[end..];
        let taken = match upper {
            'Z' => 0,
            'H' | 'V' => 1,
            _ => 2,
        };
        let fits =
            if taken == 0 { values.is_empty() } else { !values.is_empty() && values.len().is_multiple_of(taken) };
        if !fits || (is_first && upper != 'M') {
            return Err(damaged());
        }
        is_first = false;
        if upper == 'Z' {
            out.add(affine, here, start)?;
            here = start;
        }
        for (at, value) in values.chunks(taken.max(1)).enumerate() {
            let base = if is_relative { here } else { [0.0; 2] };
            let next = match (upper, value) {
                ('H', &[x]) => [base[0] + x, here[1]],
                ('V', &[y]) => [here[0], base[1] + y],
                (_, &[x, y]) => [base[0] + x, base[1] + y],
                _ => return Err(damaged()),
            };
            if upper == 'M' && at == 0 {
                start = next;
            } else {
                out.add(affine, here, next)?;
            }
            here = next;
        }
    }
    Ok(())
}

/// The numbers of a list: `1-2.5.5e3` are four numbers.
fn numbers(text: &str) -> Option<Vec<f64>> {
    let bytes = text.as_bytes();
    let (mut found, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        if bytes[at].is_ascii_whitespace() || bytes[at] == b',' {
            at += 1;
            continue;
        }
        let start = at;
        let (mut has_point, mut has_exponent) = (false, false);
        while let Some(&byte) = bytes.get(at) {
            let after_exponent = at > start && matches!(bytes[at - 1], b'e' | b'E');
            match byte {
                b'0'..=b'9' => {}
                b'+' | b'-' if at == start || after_exponent => {}
                b'.' if !has_point && !has_exponent => has_point = true,
                b'e' | b'E' if !has_exponent && at > start => has_exponent = true,
                _ => break,
            }
            at += 1;
        }
        found.push(number(text.get(start..at)?)?);
    }
    Some(found)
}

/// The map of a `transform` attribute; `None` if it is not understood.
fn transform(text: &str) -> Option<Affine> {
    let mut whole = IDENTITY;
    let mut rest = text.trim();
    while !rest.is_empty() {
        let (name, after) = rest.split_once('(')?;
        let (list, after) = after.split_once(')')?;
        rest = after.trim_start_matches(|c: char| c == ',' || c.is_whitespace());
        let next = match (name.trim(), &numbers(list)?[..]) {
            ("translate", &[x]) => [1.0, 0.0, 0.0, 1.0, x, 0.0],
            ("translate", &[x, y]) => [1.0, 0.0, 0.0, 1.0, x, y],
            ("scale", &[s]) => [s, 0.0, 0.0, s, 0.0, 0.0],
            ("scale", &[x, y]) => [x, 0.0, 0.0, y, 0.0, 0.0],
            ("rotate", &[degrees]) => turn(degrees),
            ("rotate", &[degrees, x, y]) => {
                let there = compose([1.0, 0.0, 0.0, 1.0, x, y], turn(degrees));
                compose(there, [1.0, 0.0, 0.0, 1.0, -x, -y])
            }
            ("matrix", &[a, b, c, d, e, f]) => [a, b, c, d, e, f],
            _ => return None,
        };
        whole = compose(whole, next);
    }
    Some(whole)
}

fn turn(degrees: f64) -> Affine {
    let heading = lsystem_syntax::Heading::from_degrees(degrees);
    let (c, s) = heading.cos_sin();
    [c, s, -s, c, 0.0, 0.0]
}

/// The map that first does `inner`, then `outer`.
fn compose([a, b, c, d, e, f]: Affine, [g, h, i, j, k, l]: Affine) -> Affine {
    [a * g + c * h, b * g + d * h, a * i + c * j, b * i + d * j, a * k + c * l + e, b * k + d * l + f]
}
