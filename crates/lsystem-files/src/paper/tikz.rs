//! Drawings as TikZ pictures: paths in millimetres.

use super::figure::{Figure, coordinates, lengths};
use crate::number::Decimals;
use crate::strokes::StrokeLook;
use crate::{FileOptions, Writer};
use core::fmt::Write;
use lsystem_drawing::{Drawing, Mark, MarkReader, Plane};
use lsystem_syntax::{Diagnostic, Field, Ink, Kind, Meter, Progress, Style};
use std::sync::Arc;

/// The most segments and vertices of a picture: LaTeX takes about 15 seconds for them.
const MOST: u64 = 100_000;
/// The most segments of one path, which TeX holds in memory.
const PATH: usize = 1_000;
/// The number of points on a line of the file.
const LINE: usize = 8;
/// The units of work of one point.
const POINT_WORK: u64 = 4;

/// Writes a TikZ picture. Consecutive strokes of the same colour and width share a path.
pub struct TikzWriter {
    drawing: Arc<Drawing>,
    style: Style,
    figure: Figure,
    reader: MarkReader<Plane>,
    /// The file's start; empty once written.
    head: String,
    /// The colours with names: `c0`, `c1` and so on.
    colours: Vec<[u8; 3]>,
    /// The width of paths without a width of their own.
    usual: f64,
    open: Option<OpenPath>,
    /// The vertices of the open polygon, and the number of vertices written.
    outline: Option<(Vec<[f64; 2]>, usize)>,
    coordinates: Decimals,
    is_done: bool,
}

/// The path being written.
#[derive(Clone, Copy)]
struct OpenPath {
    look: StrokeLook,
    /// The end of the path so far, in units of the last decimal place.
    at: [f64; 2],
    /// The number of segments, and of points since the last line end.
    segments: usize,
    points: usize,
}

impl TikzWriter {
    /// A writer for a drawing.
    ///
    /// # Errors
    /// [`Kind::Limit`] if the drawing has more segments and vertices than the options allow, or more than 100,000.
    pub fn new(drawing: Arc<Drawing>, style: Style, options: &FileOptions) -> Result<Self, Diagnostic> {
        drawing.check_size(options.most.min(MOST))?;
        let figure = Figure::for_text(&drawing, &options.sheet);
        let usual = figure.start(&drawing, &style).width;
        Ok(Self {
            reader: MarkReader::new(&drawing),
            head: head(&figure, &style, options, usual),
            drawing,
            style,
            figure,
            colours: vec![],
            usual,
            open: None,
            outline: None,
            coordinates: coordinates(),
            is_done: false,
        })
    }

    fn stroke(&mut self, text: &mut String, from: [f64; 2], to: [f64; 2], look: StrokeLook) {
        let [start, end] = [from, to].map(|point| point.map(|c| self.coordinates.round(c)));
        let mut open = match self.open {
            Some(open) if open.look == look && open.segments < PATH => open,
            _ => {
                self.close(text);
                self.begin(text, "draw", look.rgb, (look.width != self.usual).then_some(look.width));
                OpenPath { look, at: [f64::NAN; 2], segments: 0, points: 0 }
            }
        };
        if open.at != start {
            self.point(text, from, &mut open.points);
        }
        text.push_str("--");
        self.point(text, to, &mut open.points);
        self.open = Some(OpenPath { at: end, segments: open.segments + 1, ..open });
    }

    /// Begins a command. A new colour gets its name first.
    fn begin(&mut self, text: &mut String, command: &str, rgb: [u8; 3], width: Option<f64>) {
        let number = self.colours.iter().position(|own| *own == rgb).unwrap_or_else(|| {
            let [r, g, b] = rgb;
            self.colours.push(rgb);
            // Writing to a `String` cannot fail.
            let _ = writeln!(text, "\\definecolor{{c{}}}{{RGB}}{{{r},{g},{b}}}", self.colours.len() - 1);
            self.colours.len() - 1
        });
        let _ = write!(text, "\\{command}[c{number}");
        if let Some(width) = width {
            text.push_str(",line width=");
            lengths().write(text, width);
            text.push_str("mm");
        }
        text.push(']');
    }

    fn point(&self, text: &mut String, [x, y]: [f64; 2], points: &mut usize) {
        if *points == LINE {
            text.push('\n');
            *points = 0;
        }
        *points += 1;
        text.push('(');
        self.coordinates.write(text, x);
        text.push(',');
        self.coordinates.write(text, y);
        text.push(')');
    }

    fn close(&mut self, text: &mut String) {
        if self.open.take().is_some() {
            text.push_str(";\n");
        }
    }

    /// Writes the next vertex of the open polygon, or its end. Returns whether a polygon was open.
    fn vertex(&mut self, text: &mut String) -> bool {
        let Some((vertices, written)) = self.outline.take() else { return false };
        let Some(&vertex) = vertices.get(written) else {
            text.push_str("--cycle;\n");
            return true;
        };
        let mut points = if written > 0 && written.is_multiple_of(LINE) { LINE } else { written % LINE };
        text.push_str(if written > 0 { "--" } else { "" });
        self.point(text, vertex, &mut points);
        self.outline = Some((vertices, written + 1));
        true
    }

    fn write(&mut self, text: &mut String, meter: &mut Meter) {
        text.push_str(&core::mem::take(&mut self.head));
        while !self.is_done && !meter.is_spent() {
            if self.vertex(text) {
                meter.charge(POINT_WORK);
                continue;
            }
            let mark = self.reader.next(&self.drawing);
            meter.charge(mark.as_ref().map_or(8, Mark::work));
            match mark {
                Some(Mark::Segment(segment, tint)) => {
                    let look = self.figure.look(&self.style, tint, segment.width);
                    self.stroke(text, self.figure.place(segment.from), self.figure.place(segment.to), look);
                }
                Some(Mark::Polygon(vertices, tint)) => {
                    self.close(text);
                    self.begin(text, "fill", self.style.colour_of(tint).rgb, None);
                    self.outline = Some((vertices.into_iter().map(|vertex| self.figure.place(vertex)).collect(), 0));
                }
                None => {
                    self.close(text);
                    text.push_str("\\end{tikzpicture}\n");
                    self.is_done = true;
                }
            }
        }
    }
}

/// The lines before the first path.
fn head(figure: &Figure, style: &Style, options: &FileOptions, usual: f64) -> String {
    let mut text = title(&options.title);
    text.push_str("% For documents with \\usepackage{tikz}. Lengths are in millimetres.\n");
    text.push_str("\\begin{tikzpicture}[x=1mm,y=1mm,line cap=round,line join=round,line width=");
    lengths().write(&mut text, usual);
    text.push_str("mm]\n");
    let [r, g, b] = style.background.rgb;
    // Writing to a `String` cannot fail.
    let _ = write!(text, "\\definecolor{{background}}{{RGB}}{{{r},{g},{b}}}\n\\fill[background](0,0)rectangle(");
    coordinates().write(&mut text, figure.size[0]);
    text.push(',');
    coordinates().write(&mut text, figure.size[1]);
    text.push_str(");\n");
    text
}

/// A title as a comment; nothing for an empty title.
pub(super) fn title(title: &str) -> String {
    let title: String = title.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    if title.is_empty() { title } else { format!("% {title}\n") }
}

impl Writer for TikzWriter {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        let mut text = String::new();
        self.write(&mut text, &mut Meter::new(work));
        file.append(&mut text.into_bytes());
        Ok(if self.is_done { Progress::Done } else { Progress::More })
    }

    fn remark(&self) -> Option<Diagnostic> {
        covering(&self.style)
    }
}

/// A warning if the drawing has additive ink, which files for papers do not have.
pub(super) fn covering(style: &Style) -> Option<Diagnostic> {
    (style.ink == Ink::Density).then_some(Diagnostic { kind: Kind::CoveringInk, field: Field::Numbers, span: 0..0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write_all;
    use expect_test::expect;
    use lsystem_drawing::{System, draw};
    use lsystem_syntax::{Definition, LimitName, Limits};

    fn writer(definition: &Definition, options: &FileOptions) -> Result<TikzWriter, Diagnostic> {
        let drawing =
            draw::<Plane>(&System::new(definition).0.unwrap(), definition.iterations, &Limits::default()).unwrap();
        TikzWriter::new(Arc::new(drawing), definition.style.clone(), options)
    }

    #[test]
    fn paths_and_polygons() {
        let definition = Definition {
            axiom: "F[+F'F]fF!(2)F{-f+f+f-|-f+f+f}".into(),
            angle: 22.5,
            style: Style { width: 0.5, ..Style::default() },
            ..Definition::default()
        };
        let options = FileOptions { title: "A leaf\n& more".into(), ..FileOptions::default() };
        let whole = write_all(&mut writer(&definition, &options).unwrap()).unwrap();
        expect![[r#"
            % A leaf & more
            % For documents with \usepackage{tikz}. Lengths are in millimetres.
            \begin{tikzpicture}[x=1mm,y=1mm,line cap=round,line join=round,line width=9.0418mm]
            \definecolor{background}{RGB}{251,250,245}
            \fill[background](0,0)rectangle(56.93,160);
            \definecolor{c0}{RGB}{31,92,58}
            \draw[c0](31.92,18.08)--(31.92,36.17)--(25,52.87);
            \definecolor{c1}{RGB}{95,143,47}
            \draw[c1](25,52.87)--(18.08,69.58);
            \draw[c0](31.92,54.25)--(31.92,72.33);
            \draw[c0,line width=36.1674mm](31.92,72.33)--(31.92,90.42);
            \fill[c0](31.92,90.42)--(38.84,107.13)--(38.84,125.21)--(31.92,141.92)--(25,125.21)--(25,107.13)--(31.92,90.42)--cycle;
            \end{tikzpicture}
        "#]].assert_eq(str::from_utf8(&whole).unwrap());

        let (mut small, mut file) = (writer(&definition, &options).unwrap(), vec![]);
        while small.step(&mut file, 1).unwrap() == Progress::More {}
        assert_eq!(file, whole);
    }

    #[test]
    fn limits_and_long_paths() {
        let koch = |iterations| Definition {
            axiom: "F".into(),
            rules: "F -> F+F--F+F".into(),
            angle: 60.0,
            iterations,
            ..Definition::default()
        };
        let text =
            String::from_utf8(write_all(&mut writer(&koch(6), &FileOptions::default()).unwrap()).unwrap()).unwrap();
        assert_eq!((text.matches("\\draw").count(), text.matches("--").count()), (5, 4096));
        assert!(text.lines().all(|line| line.len() < 200));
        let over = writer(&koch(9), &FileOptions::default()).err().map(|error| error.kind);
        assert_eq!(over, Some(Kind::Limit { limit: LimitName::Segments, value: MOST, largest: None }));
    }
}
