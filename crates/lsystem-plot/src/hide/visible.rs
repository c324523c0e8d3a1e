//! The visible parts of a line.

use super::grid::{Grid, are_near};
use super::runs::Part;
use super::scene::{Scene, Shape};
use super::sight::{Place, Sight};
use super::span::{Span, rest};
use lsystem_syntax::{Halt, Work};

/// The bodies beside a line that are passed by in a unit of work.
const PASSED: u64 = 8;

/// The body that a line lies on.
#[derive(Clone, Copy, Debug)]
pub(super) struct On {
    /// The body of the line. No part of its mark hides the line.
    pub(super) number: u32,
    /// The faces through which the line leads: of a line where two bodies meet, only these do not hide it.
    pub(super) faces: Option<[u32; 2]>,
}

impl On {
    fn is_on(self, scene: &Scene, other: u32) -> bool {
        match self.faces {
            None => scene.bodies[other as usize].mark == scene.bodies[self.number as usize].mark,
            Some(faces) => faces.contains(&other),
        }
    }
}

/// Finds the visible parts of lines, one line after the other.
pub(super) struct Visible<'a> {
    scene: &'a Scene,
    grid: &'a Grid,
    /// The stretches of the line that are hidden.
    hidden: Vec<Span>,
    crossings: Vec<(f64, i32)>,
}

impl<'a> Visible<'a> {
    pub(super) fn new(scene: &'a Scene, grid: &'a Grid) -> Self {
        Self { scene, grid, hidden: vec![], crossings: vec![] }
    }

    /// Finds what hides a line.
    pub(super) fn find(&mut self, on: On, ends: [Place; 2], line: &Sight, work: &mut dyn Work) -> Result<(), Halt> {
        self.hidden.clear();
        let scene = self.scene;
        for visit in self.grid.along(ends) {
            work.charge(1)?;
            let [a, b] = [visit.from, visit.to].map(|place| line.at(place));
            let [low, high] = [[0, 1, 2].map(|axis| a[axis].min(b[axis])), [0, 1, 2].map(|axis| a[axis].max(b[axis]))];
            let around = [low, high].map(|[x, y, _]| [x, y]);
            let [bottom, top] = [low[2], high[2]];
            if top < self.grid.floor(visit.cell) {
                self.hidden.push(Span { low: visit.from, high: visit.to });
                continue;
            }
            // In the cell, the line is hidden up to the first place and from the second one on.
            let (mut at, mut back, mut passed) = (visit.from, visit.to, 0);
            for &other in self.grid.bodies(visit.cell) {
                if at >= back || self.grid.near(other) <= bottom {
                    break;
                }
                // Tubes may be wider by `same`, where they hide.
                if !are_near(around, self.grid.around(other), 2.0 * scene.same) || on.is_on(scene, other) {
                    passed += 1;
                    continue;
                }
                // Bodies with many corners charge by runs of corners.
                work.charge(2 + scene.bodies[other as usize].corners() / 64)?;
                let before = self.hidden.len();
                scene.shadows(on.number, other, line, &mut self.crossings, &mut self.hidden);
                let mut kept = before;
                for place in before..self.hidden.len() {
                    let span = self.hidden[place].within(visit.from, visit.to);
                    if !span.is_empty() {
                        self.hidden[kept] = span;
                        kept += 1;
                        if span.low <= at {
                            at = at.max(span.high);
                        }
                        if span.high >= back {
                            back = back.min(span.low);
                        }
                    }
                }
                self.hidden.truncate(kept);
            }
            work.charge(passed / PASSED)?;
        }
        for tube in scene.joints.of(on.number) {
            work.charge(1)?;
            if let Shape::Tube(tube) = &scene.bodies[tube as usize].shape {
                let span = tube.grown(-scene.same).outline(line).within(0.0, 1.0);
                if !span.is_empty() {
                    self.hidden.push(span);
                }
            }
        }
        Ok(())
    }

    /// The visible parts of the line, in order.
    pub(super) fn parts(&mut self) -> impl Iterator<Item = Span> {
        rest(&mut self.hidden)
    }
}

impl Scene {
    /// Adds the stretches of a line of the body `own` that the body `other` hides. They may reach beyond the line.
    pub(super) fn shadows(
        &self,
        own: u32,
        other: u32,
        line: &Sight,
        crossings: &mut Vec<(f64, i32)>,
        hidden: &mut Vec<Span>,
    ) {
        let [before, body] = [own, other].map(|number| &self.bodies[number as usize]);
        match &body.shape {
            Shape::Line(_) | Shape::Face { plane: None, .. } => {}
            Shape::Tube(tube) => {
                // In the plane, a later stroke at the same place hides the outline, too. But the sides of strokes that
                // follow each other go on.
                let grows = !self.is_solid && !self.joints.meet(own, other);
                hidden.push(tube.grown(if grows { self.same } else { -self.same }).shadow(line));
            }
            Shape::Face { vertices, plane: Some(plane), .. } => {
                let runs = Part(&self.runs, vertices.start as usize);
                let vertices = &self.vertices[vertices.start as usize..vertices.end as usize];
                // Of polygons in the same plane, the one drawn later is in front.
                let nearer = if body.mark > before.mark { -self.same } else { self.same };
                plane.shadows(vertices, runs, line, nearer, crossings, hidden);
            }
        }
    }
}
