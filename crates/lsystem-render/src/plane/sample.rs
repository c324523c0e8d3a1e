//! Sample systems and a brute-force picture for the tests.

use super::View;
use super::view::ViewTransform;
use crate::viewport::Viewport;
use lsystem_base::Limits;
use lsystem_drawing::{BlockId, Drawing, Item, StyleChange, System, Widths, draw};
use lsystem_syntax::{Colour, Definition, Dialect, Ink, Style, Tint};

/// Subsamples along one side of a pixel.
const SAMPLES: f64 = 4.0;

/// A system that is drawn at several n.
#[derive(Clone, Debug)]
pub(super) struct Sample(pub Definition);

impl Sample {
    pub(super) fn abop(axiom: &str, rules: &[(char, &str)], angle: f64) -> Self {
        let rules: Vec<String> = rules.iter().map(|(predecessor, word)| format!("{predecessor} -> {word}")).collect();
        let style = Style { ink: Ink::Solid, ..Style::default() };
        Self(Definition { axiom: axiom.into(), rules: rules.join("\n"), angle, style, ..Definition::default() })
    }

    pub(super) fn lowercase(axiom: &str, rules: &[(char, &str)], angle: f64) -> Self {
        let Self(abop) = Self::abop(axiom, rules, angle);
        Self(Definition { dialect: Dialect::Lowercase, ..abop })
    }

    /// The system with this stroke width, in steps.
    pub(super) fn wide(mut self, width: f64) -> Self {
        (self.0.style.width, self.0.style.max_width) = (width, 0.0);
        self
    }

    pub(super) fn draw(&self, n: u32) -> Drawing {
        let system = System::new(&self.0).unwrap_or_else(|diagnostics| panic!("{diagnostics:?}"));
        draw(&system, n, &Limits::default()).unwrap_or_else(|d| panic!("{d:?}"))
    }
}

/// The turtle's colour index, branch level and widths in steps.
#[derive(Clone, Copy)]
struct Pen {
    colour: i32,
    level: u32,
    widths: Widths,
}

impl Pen {
    fn after(self, change: &StyleChange) -> Self {
        Self {
            colour: change.colour.of(self.colour),
            level: self.level + change.level,
            widths: self.widths.after(change),
        }
    }

    fn colour(self, style: &Style, place: f64) -> Colour {
        style.colour_of(Tint { index: self.colour, level: self.level, place })
    }
}

/// The picture by definition: every segment in drawing order, every subsample by its distance.
pub(super) fn brute_force(drawing: &Drawing, style: &Style, viewport: Viewport, view: View) -> Vec<u8> {
    brute_force_until(drawing, style, viewport, view, usize::MAX)
}

/// As [`brute_force`], of the first `upto` segments.
pub(super) fn brute_force_until(
    drawing: &Drawing,
    style: &Style,
    viewport: Viewport,
    view: View,
    upto: usize,
) -> Vec<u8> {
    let (mut left, mut ended) = (upto, false);
    let transform = ViewTransform::new(drawing, viewport, view, SAMPLES);
    let mut picture = Subsamples::new(viewport);
    let hairline = (style.min_width * viewport.ratio).max(1.0) * SAMPLES / 2.0;
    let pen = Pen { colour: 0, widths: Widths::new(drawing.width), level: 0 };
    let [x, y] = transform.place(Default::default());
    let start = ([x, -y], [transform.scale, 0.0]);
    visit(drawing, drawing.root.unwrap(), start, pen, &mut |points, filled, pen| {
        let all = drawing.segment_count() as f64;
        let number = (upto - left) as f64;
        if filled {
            if !ended {
                picture.fill(points, pen.colour(style, number / all));
            }
            return;
        }
        let Some(rest) = left.checked_sub(1) else {
            ended = true;
            return;
        };
        left = rest;
        let radii = pen.widths.ends().map(|width| (width * transform.step / 2.0).max(hairline));
        picture.stroke([points[0], points[1]], radii, pen.colour(style, (number + 0.5) / all));
    });
    picture.pixels(style.background)
}

/// The place of a block, y up: its origin, and the complex number that turns and scales its points.
type Placement = ([f64; 2], [f64; 2]);
/// Takes the points of a stroke or of a polygon, whether they are those of a polygon, and the pen.
type Out<'a> = dyn FnMut(&[[f64; 2]], bool, Pen) + 'a;

fn at((origin, turn): Placement, p: [f64; 2]) -> [f64; 2] {
    [origin[0] + turn[0] * p[0] - turn[1] * p[1], origin[1] + turn[1] * p[0] + turn[0] * p[1]]
}

/// Visits all strokes and polygons of a block, in drawing order.
fn visit(drawing: &Drawing, block: BlockId, place: Placement, pen: Pen, out: &mut Out<'_>) {
    let range = drawing.blocks[block.0 as usize].items.clone();
    for item in &drawing.items[range.start as usize..range.end as usize] {
        match item {
            Item::Stroke(s) => {
                let ends = [at(place, s.from), at(place, s.to)];
                out(&ends, false, pen.after(&drawing.styles[s.style.0 as usize]));
            }
            Item::Polygon(p) => {
                let vertices: Vec<_> = drawing.vertices_of(p).iter().map(|&vertex| at(place, vertex)).collect();
                out(&vertices, true, pen.after(&drawing.styles[p.style.0 as usize]));
            }
            Item::Block(p) => {
                let (c, s) = p.heading.cos_sin();
                let turned = at(([0.0; 2], place.1), [c * p.scale, s * p.scale]);
                let pen = pen.after(&drawing.styles[p.style.0 as usize]);
                visit(drawing, p.block, (at(place, p.at), turned), pen, out);
            }
        }
    }
}

/// The colour of every subsample that is painted.
struct Subsamples {
    colours: Vec<Option<Colour>>,
    width: i64,
    height: i64,
}

impl Subsamples {
    fn new(viewport: Viewport) -> Self {
        let (width, height) = (viewport.width as i64 * 4, viewport.height as i64 * 4);
        Self { colours: vec![None; (width * height) as usize], width, height }
    }

    /// Paints the inside of an outline, y up.
    fn fill(&mut self, points: &[[f64; 2]], colour: Colour) {
        let points: Vec<[f64; 2]> = points.iter().map(|p| [p[0], -p[1]]).collect();
        let range = |axis: usize, end: i64| {
            let all = || points.iter().map(|p| p[axis]);
            let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
            low.clamp(0.0, end as f64) as i64..(high + 1.0).clamp(0.0, end as f64) as i64
        };
        let (rows, columns) = (range(1, self.height), range(0, self.width));
        for (row, column) in rows.flat_map(|row| columns.clone().map(move |column| (row, column))) {
            if winding(&points, [column as f64 + 0.5, row as f64 + 0.5]) != 0 {
                self.colours[(row * self.width + column) as usize] = Some(colour);
            }
        }
    }

    /// Paints the subsamples inside a disc that goes from one end of a segment to the other, y up. Its radius goes from
    /// the first of `radii` to the second.
    fn stroke(&mut self, ends: [[f64; 2]; 2], radii: [f64; 2], colour: Colour) {
        let [a, b] = ends.map(|end| [end[0], -end[1]]);
        let r = radii[0].max(radii[1]);
        let range = |axis: usize, end: i64| {
            let low = (a[axis].min(b[axis]) - r - 1.0).clamp(0.0, end as f64) as i64;
            low..(a[axis].max(b[axis]) + r + 2.0).clamp(0.0, end as f64) as i64
        };
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let norm = dx * dx + dy * dy;
        for row in range(1, self.height) {
            for column in range(0, self.width) {
                let (px, py) = (column as f64 + 0.5 - a[0], row as f64 + 0.5 - a[1]);
                let reaches = |t: f64| {
                    let (qx, qy) = (px - t * dx, py - t * dy);
                    let r = radii[0] + t * (radii[1] - radii[0]);
                    qx * qx + qy * qy <= r * r
                };
                let t = if norm > 0.0 { (px * dx + py * dy) / norm } else { 0.0 };
                // The disc that reaches farthest is nearer to the wide end than the nearest one.
                let lean = if norm > 0.0 { (radii[0] - radii[1]) / norm.sqrt() } else { 0.0 };
                let aside = if norm > 0.0 { (px * dy - py * dx).abs() / norm } else { 0.0 };
                let t = if lean.abs() < 1.0 { t - aside * lean / (1.0 - lean * lean).sqrt() } else { t };
                if reaches(t.clamp(0.0, 1.0)) || reaches(0.0) || reaches(1.0) {
                    self.colours[(row * self.width + column) as usize] = Some(colour);
                }
            }
        }
    }

    /// The mean colour of each pixel's subsamples, as RGBA.
    fn pixels(&self, background: Colour) -> Vec<u8> {
        let mut pixels = vec![];
        for y in 0..self.height / 4 {
            for x in 0..self.width / 4 {
                let mut sum = [0.0; 3];
                for (sy, sx) in (0..4).flat_map(|sy| (0..4).map(move |sx| (sy, sx))) {
                    let colour = self.colours[((y * 4 + sy) * self.width + x * 4 + sx) as usize];
                    for (sum, value) in sum.iter_mut().zip(colour.unwrap_or(background).rgb) {
                        *sum += f64::from(value) / 16.0;
                    }
                }
                pixels.extend(sum.map(|v| libm::round(v) as u8));
                pixels.push(u8::MAX);
            }
        }
        pixels
    }
}

/// The winding number of an outline around a point.
fn winding(vertices: &[[f64; 2]], [x, y]: [f64; 2]) -> i32 {
    let next = vertices.iter().cycle().skip(1);
    let crossings = vertices.iter().zip(next).map(|(a, b)| {
        let left = (b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1]);
        match (a[1] <= y, b[1] <= y) {
            (true, false) if left > 0.0 => 1,
            (false, true) if left < 0.0 => -1,
            _ => 0,
        }
    });
    crossings.sum()
}
