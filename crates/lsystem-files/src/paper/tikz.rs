//! Drawings as TikZ pictures: paths in millimetres.

use super::figure::{Figure, coordinates, lengths};
use crate::number::Decimals;
use crate::strokes::{StrokeFile, StrokeLook, VERTEX_WORK, write_marks};
use crate::svg::warning;
use crate::{FileOptions, Notes, Sink};
use core::fmt::Write;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Halt, Style, Work};

/// The most segments and vertices of a picture: LaTeX takes about 15 seconds for them.
const MAX: u64 = 100_000;
/// The most segments of one path, which TeX holds in memory.
const PATH: usize = 1_000;
/// The number of points on a line of the file.
const LINE: usize = 8;

/// Writes a TikZ picture. Consecutive strokes of the same colour and width share a path.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the drawing has more segments and vertices than the options allow, or
/// more than 100,000.
pub(crate) fn write_tikz(
    drawing: &Drawing,
    style: &Style,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    drawing.check_size(options.most.min(MAX))?;
    let figure = Figure::for_text(drawing, &options.sheet);
    let usual = figure.start(drawing, style).width;
    write_head(&figure, style, options, usual, &mut sink.text);
    let mut picture = Picture { sink, colours: vec![], usual, open: None, coordinates: coordinates() };
    let look = |tint, width| figure.look(style, tint, width);
    write_marks(drawing, style, |point| figure.place(point), look, &mut picture)?;
    sink.text.push_str("\\end{tikzpicture}\n");
    Ok(Notes { remark: warning(0, style.ink), ..Notes::default() })
}

/// A picture in the making.
struct Picture<'a, 'o> {
    sink: &'a mut Sink<'o>,
    /// The colours with names: `c0`, `c1` and so on.
    colours: Vec<[u8; 3]>,
    /// The width of paths without a width of their own.
    usual: f64,
    open: Option<OpenPath>,
    coordinates: Decimals,
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

impl Picture<'_, '_> {
    /// Begins a command. A new colour gets its name first.
    fn begin(&mut self, command: &str, rgb: [u8; 3], width: Option<f64>) {
        let text = &mut self.sink.text;
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

    fn point(&mut self, [x, y]: [f64; 2], points: &mut usize) {
        let text = &mut self.sink.text;
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
}

impl Work for Picture<'_, '_> {
    fn charge(&mut self, units: u64) -> Result<(), Halt> {
        self.sink.charge(units)
    }
}

impl StrokeFile for Picture<'_, '_> {
    fn stroke(&mut self, from: [f64; 2], to: [f64; 2], look: StrokeLook) {
        let [start, end] = [from, to].map(|point| point.map(|c| self.coordinates.round(c)));
        let mut open = match self.open {
            Some(open) if open.look == look && open.segments < PATH => open,
            _ => {
                self.close();
                self.begin("draw", look.rgb, (look.width != self.usual).then_some(look.width));
                OpenPath { look, at: [f64::NAN; 2], segments: 0, points: 0 }
            }
        };
        if open.at != start {
            self.point(from, &mut open.points);
        }
        self.sink.text.push_str("--");
        self.point(to, &mut open.points);
        self.open = Some(OpenPath { at: end, segments: open.segments + 1, ..open });
    }

    fn fill(&mut self, vertices: impl Iterator<Item = [f64; 2]>, rgb: [u8; 3]) -> Result<(), Halt> {
        self.close();
        self.begin("fill", rgb, None);
        let mut points = 0;
        for (number, vertex) in vertices.enumerate() {
            self.charge(VERTEX_WORK)?;
            self.sink.text.push_str(if number > 0 { "--" } else { "" });
            self.point(vertex, &mut points);
        }
        self.sink.text.push_str("--cycle;\n");
        Ok(())
    }

    fn close(&mut self) {
        if self.open.take().is_some() {
            self.sink.text.push_str(";\n");
        }
    }
}

/// The lines before the first path.
fn write_head(figure: &Figure, style: &Style, options: &FileOptions, usual: f64, text: &mut String) {
    text.push_str(&title(&options.title));
    text.push_str("% For documents with \\usepackage{tikz}. Lengths are in millimetres.\n");
    text.push_str("\\begin{tikzpicture}[x=1mm,y=1mm,line cap=round,line join=round,line width=");
    lengths().write(text, usual);
    text.push_str("mm]\n");
    let [r, g, b] = style.background.rgb;
    // Writing to a `String` cannot fail.
    let _ = write!(text, "\\definecolor{{background}}{{RGB}}{{{r},{g},{b}}}\n\\fill[background](0,0)rectangle(");
    coordinates().write(text, figure.size[0]);
    text.push(',');
    coordinates().write(text, figure.size[1]);
    text.push_str(");\n");
}

/// A title as a comment; nothing for an empty title.
pub(super) fn title(title: &str) -> String {
    let title: String = title.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    if title.is_empty() { title } else { format!("% {title}\n") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collect;
    use expect_test::expect;
    use lsystem_base::{LimitName, Limits};
    use lsystem_drawing::{Plane, System, draw};
    use lsystem_syntax::{Definition, Diagnostic, Kind};

    fn written(definition: &Definition, options: &FileOptions) -> Result<String, Diagnostic> {
        let drawing =
            draw::<Plane>(&System::new(definition).unwrap(), definition.iterations, &Limits::default()).unwrap();
        collect(|sink| write_tikz(&drawing, &definition.style, options, sink)).map(|(text, _)| text)
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
        let whole = written(&definition, &options).unwrap();
        expect![[r#"
            % A leaf & more
            % For documents with \usepackage{tikz}. Lengths are in millimetres.
            \begin{tikzpicture}[x=1mm,y=1mm,line cap=round,line join=round,line width=0.6192mm]
            \definecolor{background}{RGB}{251,250,245}
            \fill[background](0,0)rectangle(56.93,160);
            \definecolor{c0}{RGB}{31,92,58}
            \draw[c0](31.92,18.08)--(31.92,36.17)--(25,52.87);
            \definecolor{c1}{RGB}{95,143,47}
            \draw[c1](25,52.87)--(18.08,69.58);
            \fill[c0](33.16,72.27)--(33.09,72.76)--(32.82,73.19)--(32.41,73.47)--(31.92,73.57)--(31.44,73.47)--(31.03,73.19)--(30.76,72.76)--
            (30.69,72.27)--(31.62,54.24)--(31.64,54.12)--(31.71,54.03)--(31.81,53.96)--(31.92,53.94)--(32.04,53.96)--(32.14,54.03)--
            (32.21,54.12)--(32.23,54.24)--cycle;
            \draw[c0,line width=2.4767mm](31.92,72.33)--(31.92,90.42);
            \fill[c0](31.92,90.42)--(38.84,107.13)--(38.84,125.21)--(31.92,141.92)--(25,125.21)--(25,107.13)--(31.92,90.42)--cycle;
            \end{tikzpicture}
        "#]].assert_eq(&whole);
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
        let text = written(&koch(6), &FileOptions::default()).unwrap();
        assert_eq!((text.matches("\\draw").count(), text.matches("--").count()), (5, 4096));
        assert!(text.lines().all(|line| line.len() < 200));
        let over = written(&koch(9), &FileOptions::default()).err().map(|error| error.kind);
        assert_eq!(over, Some(Kind::Limit { limit: LimitName::Segments, value: MAX, largest: None }));
    }
}
