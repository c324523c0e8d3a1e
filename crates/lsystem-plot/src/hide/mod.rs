//! Plots that hide what is behind: the visible parts of all lines, exactly up to the pen's width.
//!
//! A mark is a line, a tube or a polygon on the sheet (`scene`). In space the depths are those of the projection, and in
//! the plane what is drawn later is nearer. A tube is drawn as its outline (`outline`). The part of a line that a tube
//! hides is one stretch, and ends where quadratic equations say; the part that a polygon hides lies between crossings of
//! its sides (`body`). A grid finds the bodies that may hide a part of a line (`grid`).
//!
//! In space, the lines where polygons and tubes pass through each other are drawn, too (`pierce`, `meet`), but for bodies
//! that are joined (`points`).
//!
//! Crossed lines hide nothing: only strokes broader than the pen by more than twice [`EXACT`] and polygons do. Visible
//! parts shorter than a pen that lie in ink of their colour are left out (`specks`).

mod body;
mod fill;
mod grid;
mod meet;
mod meet_tubes;
mod outline;
mod pierce;
mod points;
mod runs;
mod scene;
mod sight;
mod span;
mod specks;
#[cfg(test)]
mod tests;
mod visible;

use crate::options::PlotOptions;
use crate::page::{Page, Point, distance};
use crate::pens::Pens;
use grid::Grid;
use lsystem_base::{LimitName, MAX_COMPARISONS};
use lsystem_drawing::Drawing;
use lsystem_syntax::{Diagnostic, Halt, Style, Work};
use outline::{EXACT, Edge, outline};
use pierce::Pierce;
use scene::{Scene, Shape};
use sight::{Place, Sight};
use specks::Lines;
use visible::{On, Visible};

/// A shorter line that ends where another body begins is left out, in pens: its ink is that of the body's outline.
const SHORT: f64 = 0.5;

/// The longest line between two ends whose ink leaves that of their round ends by at most [`EXACT`], in pens.
pub(crate) fn touching() -> f64 {
    // In the middle, half a pen aside of the line and half the line from an end.
    2.0 * ((0.5 + EXACT) * (0.5 + EXACT) - 0.25).sqrt()
}

/// The visible lines of a drawing, with at most `most` strokes.
///
/// # Errors
/// If there are too many strokes, or too many that may hide each other.
pub(crate) fn hidden(
    drawing: &Drawing,
    style: &Style,
    page: &Page,
    options: &PlotOptions,
    most: u64,
    work: &mut dyn Work,
) -> Result<Pens, Halt> {
    let work = &mut Compared { work, left: MAX_COMPARISONS };
    let mut pens = Pens::new(page, options);
    pens.most = most;
    let scene = Scene::read(drawing, style, page, options, &mut pens, work)?;
    let grid = Grid::new(&scene, work)?;
    let visible = Visible::new(&scene, &grid);
    let (run, lines) = (Run::default(), Lines::default());
    let mut draw = Draw { visible, pen: options.pen, run, lines };
    let mut pierce = Pierce::new(&scene, &grid, options.pen, work)?;
    let mut edges = vec![];
    for (number, body) in (0..).zip(&scene.bodies) {
        work.charge(1)?;
        if grid.hides(&scene, number) {
            continue;
        }
        edges.clear();
        match &body.shape {
            Shape::Line(ends) => edges.push(Edge { ends: *ends, is_round: true }),
            Shape::Tube(tube) => outline(tube, options.pen, &mut edges),
            Shape::Face { vertices, is_outlined: true, .. } => {
                let vertices = &scene.vertices[vertices.start as usize..vertices.end as usize];
                let before = vertices[vertices.len() - 1..].iter().chain(vertices);
                edges.extend(before.zip(vertices).map(|(a, b)| Edge { ends: [*a, *b], is_round: true }));
            }
            Shape::Face { .. } => {}
        }
        let on = On { number, faces: None };
        draw.edges(on, body.layer, &edges, work)?;
        pierce.start(number, work)?;
        while let Some((on, edges)) = pierce.next(work)? {
            draw.edges(on, body.layer, edges, work)?;
        }
        if options.hatch {
            edges.clear();
            let left = most.saturating_sub(draw.lines.count());
            fill::fill(&scene, body, options.pen, left, &mut edges, work)?.ok_or_else(|| pens.too_many())?;
            draw.single(on, body.layer, &edges, work)?;
        }
        if draw.lines.count() > most {
            return Err(pens.too_many());
        }
    }
    draw.lines.draw(options.pen, &mut pens, work)?;
    Ok(pens)
}

/// Counts comparisons up to a limit: strokes that lie over each other are compared with each other.
struct Compared<'a> {
    work: &'a mut dyn Work,
    left: u64,
}

impl Work for Compared<'_> {
    fn charge(&mut self, units: u64) -> Result<(), Halt> {
        let too_many = || Diagnostic::limit(LimitName::Comparisons, MAX_COMPARISONS, None);
        self.left = self.left.checked_sub(units).ok_or_else(too_many)?;
        self.work.charge(units)
    }
}

/// Draws the visible parts of lines.
struct Draw<'a> {
    visible: Visible<'a>,
    pen: f64,
    run: Run,
    lines: Lines,
}

/// Visible parts of lines that follow each other.
#[derive(Default)]
struct Run {
    parts: Vec<[Point; 2]>,
    /// Whether something hides the line before or after.
    is_cut: bool,
    /// Whether there is a part of a tube's side.
    has_side: bool,
}

impl Draw<'_> {
    /// Draws lines that follow each other.
    fn edges(&mut self, on: On, layer: u32, edges: &[Edge], work: &mut dyn Work) -> Result<(), Halt> {
        self.run.is_cut = on.faces.is_some();
        for edge in edges {
            let Some(line) = Sight::new(edge.ends) else { continue };
            let mut at = 0.0;
            self.visible.find(on, edge.ends, &line, work)?;
            for span in self.visible.parts() {
                if span.low > at {
                    self.run.is_cut = true;
                    self.run.draw(layer, self.pen, &mut self.lines);
                    self.run.is_cut = true;
                }
                self.run.parts.push([span.low, span.high].map(|place| on_sheet(line.at(place))));
                self.run.has_side |= !edge.is_round;
                at = span.high;
            }
            if at < 1.0 {
                self.run.is_cut = true;
                self.run.draw(layer, self.pen, &mut self.lines);
                self.run.is_cut = true;
            }
        }
        self.run.draw(layer, self.pen, &mut self.lines);
        Ok(())
    }

    /// Draws single lines.
    fn single(&mut self, on: On, layer: u32, edges: &[Edge], work: &mut dyn Work) -> Result<(), Halt> {
        edges.chunks(1).try_for_each(|edge| self.edges(on, layer, edge, work))
    }
}

impl Run {
    /// Draws the parts, unless they are short and end at another body. The next run is empty.
    fn draw(&mut self, layer: u32, pen: f64, lines: &mut Lines) {
        let length: f64 = self.parts.iter().map(|[from, to]| distance(*from, *to)).sum();
        if !self.is_cut || self.has_side || length > SHORT * pen {
            lines.add(layer, &self.parts, self.is_cut && length < pen);
        }
        self.parts.clear();
        (self.is_cut, self.has_side) = (false, false);
    }
}

fn on_sheet([x, y, _]: Place) -> Point {
    [x, y]
}
