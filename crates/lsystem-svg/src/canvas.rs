//! Pixels, and the inside of polygons on them.

use crate::SvgError;
use crate::transform::Transform;
use crate::work::{Kind, Work};
use lsystem_base::sorted;

/// The lines that are looked at in a row of pixels.
const LINES: usize = 4;
/// The units of an edge, of the crossing of an edge and a line, and of a pixel.
const EDGE: u64 = 20;
const CROSSING: u64 = 8;
const PIXEL: u64 = 2;
/// Places further away than this, in pixels, are left out with what ends there.
const FAR: f64 = 1e9;

/// A level of grey, from 0 to 255, and how opaque it is, from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shade {
    pub(crate) level: f64,
    pub(crate) alpha: f64,
}

/// A picture that is painted on nothing.
pub(crate) struct Canvas {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// The level of grey on black, and how opaque it is.
    pixels: Vec<[f32; 2]>,
    /// How much of each pixel is covered, as the difference to the pixel before.
    covered: Vec<f64>,
}

/// Polygons as edges that cross the lines of the picture.
pub(crate) struct Polygons {
    height: usize,
    width: f64,
    edges: Vec<Edge>,
}

#[derive(Clone, Copy)]
struct Edge {
    first: u32,
    /// After the last line.
    end: u32,
    /// At the line, and from one line to the next.
    x: f64,
    slope: f64,
    winding: i32,
}

impl Polygons {
    pub(crate) fn on(canvas: &Canvas) -> Self {
        Self { height: canvas.height, width: canvas.width as f64, edges: Vec::new() }
    }

    pub(crate) fn count(&self) -> usize {
        self.edges.len()
    }

    /// Adds a polygon; `transform` leads to pixels. A convex polygon winds around its inside once, clockwise.
    pub(crate) fn add(
        &mut self,
        points: &[[f64; 2]],
        is_convex: bool,
        transform: Transform,
        work: &mut Work,
    ) -> Result<(), SvgError> {
        work.charge(Kind::Segments, points.len(), EDGE)?;
        let next = |at: usize| transform.of(points[(at + 1) % points.len()]);
        let places = || points.iter().map(|&point| transform.of(point));
        if places().any(|[x, y]| !(x.abs() < FAR && y.abs() < FAR)) || places().all(|[x, _]| x >= self.width) {
            return Ok(());
        }
        let area: f64 = places().enumerate().map(|(at, [x, y])| x * next(at)[1] - next(at)[0] * y).sum();
        let sign = if is_convex && area < 0.0 { -1 } else { 1 };
        for (at, from) in places().enumerate() {
            self.edge(from, next(at), sign);
        }
        Ok(())
    }

    fn edge(&mut self, from: [f64; 2], to: [f64; 2], sign: i32) {
        let (winding, [x1, y1], [x2, y2]) = if from[1] < to[1] { (sign, from, to) } else { (-sign, to, from) };
        let line = |y: f64| (y * LINES as f64 - 0.5).ceil().clamp(0.0, (self.height * LINES) as f64);
        let (first, end) = (line(y1), line(y2));
        if first < end {
            let slope = (x2 - x1) / (y2 - y1);
            let x = x1 + slope * ((first + 0.5) / LINES as f64 - y1);
            self.edges.push(Edge { first: first as u32, end: end as u32, x, slope: slope / LINES as f64, winding });
        }
    }
}

impl Canvas {
    pub(crate) fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![[0.0; 2]; width * height], covered: vec![0.0; width + 2] }
    }

    /// Paints the inside of polygons and removes these. Overlapping ones are painted once.
    pub(crate) fn fill(
        &mut self,
        polygons: &mut Polygons,
        is_even_odd: bool,
        shade: Shade,
        work: &mut Work,
    ) -> Result<(), SvgError> {
        let edges = &mut polygons.edges;
        sorted::sort_by_key(edges, |edge| edge.first);
        let mut active: Vec<Edge> = Vec::new();
        let mut waiting = edges.drain(..).peekable();
        let mut line = 0;
        // The touched pixels of a row.
        let (mut left, mut right) = (usize::MAX, 0);
        loop {
            if active.is_empty() {
                let next = waiting.peek().map(|edge| edge.first as usize);
                // A row is painted once, though no edge may cross its middle.
                if next.is_none_or(|next| next / LINES != line / LINES) {
                    self.paint(line / LINES, left, right, shade, work)?;
                    (left, right) = (usize::MAX, 0);
                }
                match next {
                    Some(next) => line = next,
                    None => return Ok(()),
                }
            }
            while let Some(edge) = waiting.next_if(|edge| edge.first as usize <= line) {
                active.push(edge);
            }
            work.charge(Kind::Pixels, active.len(), CROSSING)?;
            active.sort_unstable_by(|a, b| a.x.total_cmp(&b.x));
            let (mut winding, mut from) = (0, 0.0);
            for edge in &mut active {
                let was_inside = if is_even_odd { winding % 2 != 0 } else { winding != 0 };
                winding += edge.winding;
                let is_inside = if is_even_odd { winding % 2 != 0 } else { winding != 0 };
                match (was_inside, is_inside) {
                    (false, true) => from = edge.x,
                    (true, false) => {
                        let [from, to] = [from, edge.x].map(|x| x.clamp(0.0, self.width as f64));
                        if from < to {
                            self.cover(from, 1.0);
                            self.cover(to, -1.0);
                            (left, right) = (left.min(from as usize), right.max(to as usize));
                        }
                    }
                    _ => {}
                }
                edge.x += edge.slope;
            }
            line += 1;
            active.retain(|edge| edge.end as usize > line);
            if line % LINES == 0 {
                self.paint(line / LINES - 1, left, right, shade, work)?;
                (left, right) = (usize::MAX, 0);
            }
        }
    }

    /// Covers what is right of a place by a line.
    fn cover(&mut self, x: f64, sign: f64) {
        let at = x as usize;
        let part = (at + 1) as f64 - x;
        self.covered[at] += sign * part;
        self.covered[at + 1] += sign * (1.0 - part);
    }

    /// Paints the covered part of a row, from `left` to `right`.
    fn paint(&mut self, row: usize, left: usize, right: usize, shade: Shade, work: &mut Work) -> Result<(), SvgError> {
        if left > right {
            return Ok(());
        }
        work.charge(Kind::Pixels, right - left + 1, PIXEL)?;
        let row = &mut self.pixels[row * self.width..][..self.width];
        let mut covered = 0.0;
        for at in left..=right {
            covered += self.covered[at];
            let Some([level, alpha]) = row.get_mut(at) else { break };
            let part = ((covered / LINES as f64).clamp(0.0, 1.0) * shade.alpha) as f32;
            *level = *level * (1.0 - part) + shade.level as f32 * part;
            *alpha = *alpha * (1.0 - part) + part;
        }
        self.covered[left..right + 2].fill(0.0);
        Ok(())
    }

    /// The levels of grey on paper of a level.
    pub(crate) fn on(&self, paper: f32) -> Vec<u8> {
        self.pixels.iter().map(|[level, alpha]| (level + paper * (1.0 - alpha) + 0.5) as u8).collect()
    }
}
