//! The lines where bodies pass through each other in space.

use super::body::Place;
use super::grid::Grid;
use super::meet::{Face, faces, tube_and_face};
use super::outline::{EXACT, Edge};
use super::points::Points;
use super::scene::{Scene, Shape};
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
        let (others, lines, edges) = Default::default();
        Ok(Self { scene, grid, points, starts, cells, far, exact: EXACT * pen, others, lines, edges })
    }

    /// Gives the lines where a body meets those before it in the drawing, a list for each.
    pub(super) fn lines(
        &mut self,
        number: u32,
        work: &mut dyn Work,
        each: &mut dyn FnMut(On, &[Edge], &mut dyn Work) -> Result<(), Halt>,
    ) -> Result<(), Halt> {
        self.find_others(number, work)?;
        for at in 0..self.others.len() {
            let pair = [self.others[at], number];
            let bodies = pair.map(|number| &self.scene.bodies[number as usize]);
            work.charge(2 + (bodies[0].corners() + bodies[1].corners()) / 2)?;
            self.lines.clear();
            let faces = self.meet(pair);
            if self.lines.is_empty() || self.points.are_joined(self.scene, pair) {
                continue;
            }
            work.charge(4 * self.lines.len() as u64)?;
            self.edges.clear();
            self.edges.extend(self.lines.iter().map(|&ends| Edge { ends, is_round: true }));
            each(On { number, faces: Some(faces) }, &self.edges, work)?;
        }
        Ok(())
    }

    /// Lists the bodies before a body that may meet it where it is visible.
    fn find_others(&mut self, number: u32, work: &mut dyn Work) -> Result<(), Halt> {
        self.others.clear();
        let at = number as usize;
        let [Some(&start), Some(&end)] = [at, at + 1].map(|at| self.starts.get(at)) else { return Ok(()) };
        let (near, mark) = (self.grid.near(number), self.scene.bodies[at].mark);
        for &cell in &self.cells[start as usize..end as usize] {
            for &other in self.grid.bodies(cell as usize) {
                work.charge(1)?;
                if self.grid.near(other) <= self.far[at] {
                    break;
                }
                if other < number && self.far[other as usize] < near && self.scene.bodies[other as usize].mark != mark {
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
        let face = |number: u32| match &scene.bodies[number as usize] {
            body @ super::scene::Body { shape: Shape::Face { plane: Some(plane), .. }, .. } => {
                Some(Face { plane, vertices: scene.places(body) })
            }
            _ => None,
        };
        match pair.map(face) {
            [Some(a), Some(b)] => {
                faces([a, b], scene.same, &mut self.lines);
                pair
            }
            [Some(face), None] | [None, Some(face)] => {
                let is_first = matches!(scene.bodies[pair[0] as usize].shape, Shape::Face { .. });
                let [own, other] = if is_first { pair } else { [pair[1], pair[0]] };
                if let Shape::Tube(tube) = &scene.bodies[other as usize].shape {
                    tube_and_face(tube, face, self.exact, &mut self.lines);
                }
                [own, NONE]
            }
            [None, None] => [NONE; 2],
        }
    }
}
