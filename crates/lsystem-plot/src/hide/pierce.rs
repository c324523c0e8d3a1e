//! The lines where bodies pass through each other in space.

use super::grid::{Grid, are_near};
use super::meet::{Face, faces, tube_and_face};
use super::meet_tubes::tubes;
use super::outline::{EXACT, Edge};
use super::points::Points;
use super::runs::Part;
use super::scene::{Body, Scene, Shape};
use super::sight::Place;
use super::visible::On;
use lsystem_syntax::{Halt, Work};

/// No face.
const NONE: u32 = u32::MAX;

/// Finds these lines, body after body.
pub(super) struct Pierce<'a> {
    scene: &'a Scene,
    grid: &'a Grid,
    points: Points,
    /// The cells of all bodies, as [`Grid::cells`] has them.
    starts: Vec<u32>,
    cells: Vec<u32>,
    /// By body: its farthest depth.
    far: Vec<f64>,
    /// By how much a line may leave a tube's surface, in millimetres.
    exact: f64,
    /// The body, and those before it that are left.
    number: u32,
    others: Vec<u32>,
    lines: Vec<[Place; 2]>,
    edges: Vec<Edge>,
}

impl<'a> Pierce<'a> {
    pub(super) fn new(scene: &'a Scene, grid: &'a Grid, pen: f64, work: &mut dyn Work) -> Result<Self, Halt> {
        // In the plane, nothing passes through anything.
        let (points, (starts, cells)) = match scene.is_solid {
            true => (Points::new(scene, work)?, grid.cells(work)?),
            false => Default::default(),
        };
        let far = if scene.is_solid { scene.bodies.iter().map(|body| scene.far(body)).collect() } else { vec![] };
        let (number, others, lines, edges) = Default::default();
        Ok(Self { scene, grid, points, starts, cells, far, exact: EXACT * pen, number, others, lines, edges })
    }

    /// Starts with a body.
    pub(super) fn start(&mut self, number: u32, work: &mut dyn Work) -> Result<(), Halt> {
        self.number = number;
        self.find_others(number, work)
    }

    /// The lines where the body meets the next one of those before it in the drawing.
    pub(super) fn next(&mut self, work: &mut dyn Work) -> Result<Option<(On, &[Edge])>, Halt> {
        while let Some(other) = self.others.pop() {
            let pair = [other, self.number];
            let bodies = pair.map(|number| &self.scene.bodies[number as usize]);
            work.charge(2 + (bodies[0].corners() + bodies[1].corners()) / 2)?;
            let are_faces = bodies.iter().all(|body| matches!(body.shape, Shape::Face { .. }));
            // Of pairs with tubes, most are joined. Few faces meet at all, and to compare all corners takes longer.
            if !are_faces && self.points.are_joined(self.scene, pair) {
                continue;
            }
            self.lines.clear();
            let faces = self.meet(pair);
            if self.lines.is_empty() || are_faces && self.points.are_joined(self.scene, pair) {
                continue;
            }
            work.charge(4 * self.lines.len() as u64)?;
            self.edges.clear();
            self.edges.extend(self.lines.iter().map(|&ends| Edge { ends, is_round: true }));
            return Ok(Some((On { number: self.number, faces: Some(faces) }, &self.edges)));
        }
        Ok(None)
    }

    /// Lists the bodies before a body that may meet it where it is visible.
    fn find_others(&mut self, number: u32, work: &mut dyn Work) -> Result<(), Halt> {
        self.others.clear();
        let at = number as usize;
        let [Some(&start), Some(&end)] = [at, at + 1].map(|at| self.starts.get(at)) else { return Ok(()) };
        let (near, around, mark) = (self.grid.near(number), self.grid.around(number), self.scene.bodies[at].mark);
        for &cell in &self.cells[start as usize..end as usize] {
            for &other in self.grid.bodies(cell as usize) {
                work.charge(1)?;
                if self.grid.near(other) <= self.far[at] {
                    break;
                }
                // Tubes are wider by `exact`.
                if other < number
                    && self.far[other as usize] < near
                    && are_near(around, self.grid.around(other), 2.0 * self.exact)
                    && self.scene.bodies[other as usize].mark != mark
                {
                    self.others.push(other);
                }
            }
        }
        self.others.sort_unstable();
        self.others.dedup();
        Ok(())
    }

    /// Finds the lines where two bodies meet. Returns the faces among them.
    fn meet(&mut self, pair: [u32; 2]) -> [u32; 2] {
        let scene = self.scene;
        let lines = &mut self.lines;
        let [a, b] = pair.map(|number| &scene.bodies[number as usize]);
        match (&a.shape, &b.shape) {
            (Shape::Tube(first), Shape::Tube(last)) => {
                tubes([first, last], self.exact, lines);
                [NONE; 2]
            }
            (Shape::Tube(tube), _) => {
                scene.face(b).into_iter().for_each(|face| tube_and_face(tube, face, self.exact, lines));
                [pair[1], NONE]
            }
            (_, Shape::Tube(tube)) => {
                scene.face(a).into_iter().for_each(|face| tube_and_face(tube, face, self.exact, lines));
                [pair[0], NONE]
            }
            _ => {
                if let (Some(first), Some(last)) = (scene.face(a), scene.face(b)) {
                    faces([first, last], scene.same, lines);
                }
                pair
            }
        }
    }
}

impl Scene {
    /// A body as a polygon in its plane, if it is one.
    pub(super) fn face<'a>(&'a self, body: &'a Body) -> Option<Face<'a>> {
        match &body.shape {
            Shape::Face { plane: Some(plane), vertices, .. } => {
                let runs = Part(&self.runs, vertices.start as usize);
                Some(Face { plane, vertices: self.places(body), runs })
            }
            _ => None,
        }
    }
}
