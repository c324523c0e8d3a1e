//! The points of the turtle's path in space at which bodies begin, bend and end.
//!
//! A branch begins inside the end of its stem: bodies that meet at a point of the path are one shape there, and do not
//! pass through each other.

use super::scene::{Body, Scene, Shape};
use super::sight::Place;
use crate::cells::Cells;
use crate::merge::JOINT;
use lsystem_syntax::{Halt, Work};

/// No body.
const NONE: u32 = u32::MAX;
/// The most strokes of a path that are followed back.
const FOLLOWED: usize = 16;

/// The points of a scene in space.
#[derive(Debug, Default)]
pub(super) struct Points {
    /// The range of each body in `numbers`.
    starts: Vec<usize>,
    /// By body: the numbers of its points.
    numbers: Vec<u32>,
    /// By number: the first stroke that ends there, or [`NONE`].
    into: Vec<u32>,
}

impl Points {
    /// Numbers the points of all bodies.
    pub(super) fn new(scene: &Scene, work: &mut dyn Work) -> Result<Self, Halt> {
        let (mut sheet, mut space) = (Cells::new([JOINT; 2]), Cells::new([JOINT; 2]));
        let mut points = Self { starts: vec![0], ..Self::default() };
        for (number, body) in (0..).zip(&scene.bodies) {
            let places = scene.places(body);
            work.charge(2 * places.len() as u64)?;
            for &[x, y, depth] in places {
                let column = sheet.number(0, [x, y]).0;
                let (point, is_new) = space.number(column, [depth, 0.0]);
                if is_new {
                    points.into.push(NONE);
                }
                points.numbers.push(point);
            }
            if !matches!(body.shape, Shape::Face { .. }) {
                let into = &mut points.into[points.numbers[points.numbers.len() - 1] as usize];
                *into = number.min(*into);
            }
            points.starts.push(points.numbers.len());
        }
        Ok(points)
    }

    fn of(&self, body: u32) -> &[u32] {
        &self.numbers[self.starts[body as usize]..self.starts[body as usize + 1]]
    }

    /// Whether two bodies have a common point.
    fn share_point(&self, a: u32, b: u32) -> bool {
        self.of(a).iter().any(|point| self.of(b).contains(point))
    }

    /// Whether two faces have a common edge.
    fn share_edge(&self, a: u32, b: u32) -> bool {
        let edges = |body: u32| {
            let (points, next) = (self.of(body), self.of(body).iter().cycle().skip(1));
            points.iter().zip(next).map(|(&from, &to)| [from.min(to), from.max(to)]).filter(|[from, to]| from != to)
        };
        edges(a).any(|edge| edges(b).any(|other| edge == other))
    }

    /// Whether two bodies are parts of one shape: faces with a common edge, or others with a common point. So are a tube
    /// and a body to which the path leads from the tube without leaving it.
    pub(super) fn are_joined(&self, scene: &Scene, pair: [u32; 2]) -> bool {
        let [a, b] = pair;
        let are_faces = pair.iter().all(|&body| matches!(scene.bodies[body as usize].shape, Shape::Face { .. }));
        if are_faces {
            return self.share_edge(a, b);
        }
        self.leads(scene, a, b) || self.leads(scene, b, a)
    }

    /// Whether a body has a point of another one, or begins in it and follows such a body.
    fn leads(&self, scene: &Scene, from: u32, to: u32) -> bool {
        let tube = if let Shape::Tube(tube) = &scene.bodies[from as usize].shape { Some(tube) } else { None };
        let mut at = to;
        for _ in 0..FOLLOWED {
            if self.share_point(from, at) {
                return true;
            }
            let into = self.into[self.of(at)[0] as usize];
            let start = scene.places(&scene.bodies[at as usize])[0];
            if into == NONE || into == at || !tube.is_some_and(|tube| tube.contains(start)) {
                return false;
            }
            at = into;
        }
        false
    }
}

impl Scene {
    /// The ends of a stroke, or the vertices of a polygon.
    pub(super) fn places<'a>(&'a self, body: &'a Body) -> &'a [Place] {
        match &body.shape {
            Shape::Line(ends) => ends,
            Shape::Tube(tube) => &tube.ends,
            Shape::Face { vertices, .. } => &self.vertices[vertices.start as usize..vertices.end as usize],
        }
    }
}
