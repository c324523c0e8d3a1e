//! The edges of a picture whose lines all have the same length: a graph that a turtle can walk on.
//!
//! From a corner of the picture's hull, lines are followed from node to node as long as they lie on ink. The lines that
//! are known give the length of a line and the place of the corner ever more exactly, by least squares.

use crate::brush::put_stroke;
use crate::hull::Target;
use crate::picture::Picture;
use crate::successors::{Alphabet, Symbol};
use lsystem_render::mask::{Mask, SIDE};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex};

/// The shortest line, in pixels: between shorter ones no paper is seen.
const SHORTEST: f64 = 3.0;
/// From one length that is tried to the next one: eight lines on, they are a sixth of a line apart.
const FINER: f64 = 0.98;
/// One in this many places on an edge may have no ink. Where there is no edge, half of them have none.
const GAPS: usize = 8;
/// The most directions: beside lines with more, other lines are on ink too.
const MAX_DIRECTIONS: usize = 24;
/// The most edges.
const MAX_EDGES: usize = 30_000;
/// The ink of all edges, each drawn by itself, is at most so many times the ink of the picture: no more than half of it
/// lies where edges meet.
const MAX_INK: f64 = 2.0;
/// The number of places that a step of the search looks at.
const SHARE: usize = 100_000;
/// After twice as many edges, and each time when their number has doubled, the fit is made better.
const REFINED: usize = 4;
/// The least part of the ink that agrees with the edges.
const AGREEMENT: f64 = 0.85;
/// The directions, in turns, in which the hull's corners are tried.
const CORNERS: [f64; 3] = [0.19, 0.44, 0.81];
/// Nodes are the same if their places, in lines, differ by less than the inverse.
const CELLS: f64 = 64.0;

/// Where an edge leads to.
#[derive(Clone, Copy, Debug)]
struct Way {
    node: u32,
    edge: u32,
}

/// Nodes, and edges of equal length between them.
#[derive(Clone, Debug)]
pub(crate) struct Lattice {
    ways: Vec<Option<Way>>,
    /// The directions of each node: the turtle's headings, and their opposites if these are no headings.
    directions: usize,
    pub(crate) edges: usize,
}

/// A turtle on a lattice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walker {
    pub(crate) node: u32,
    pub(crate) heading: usize,
}

impl Walker {
    /// Moves along the edge ahead, if there is one, and returns its index.
    pub(crate) fn go(&mut self, lattice: &Lattice) -> Option<u32> {
        let way = lattice.way(self.node, self.heading)?;
        self.node = way.node;
        Some(way.edge)
    }

    pub(crate) fn turn(&mut self, abc: Alphabet, turn: Symbol) {
        let by = if turn == abc.left() { 1 } else { abc.order - 1 };
        self.heading = (self.heading + by) % abc.order;
    }
}

/// A search for the lattice of a picture with the longest edges, in steps.
#[derive(Clone, Debug)]
pub(crate) struct LatticeSearch {
    /// The directions of edges, with the y axis upwards.
    directions: Vec<[f64; 2]>,
    /// The length of an edge that is tried next, in pixels.
    unit: f64,
    found: Option<Arc<Lattice>>,
}

/// The searches of lattices, each for its headings: many axioms and angles lead to the same ones.
#[derive(Debug, Default)]
pub(crate) struct Lattices(HashMap<[u32; 2], Arc<Mutex<LatticeSearch>>>);

impl Lattices {
    /// The searches for the headings of targets, each once.
    pub(crate) fn of(&mut self, targets: &[Target]) -> Vec<Arc<Mutex<LatticeSearch>>> {
        let mut keys: Vec<[u32; 2]> = Vec::new();
        let mut searches = Vec::new();
        for target in targets {
            let key = target.turned();
            if !keys.contains(&key) {
                keys.push(key);
                let search = || Arc::new(Mutex::new(LatticeSearch::new(target)));
                searches.push(Arc::clone(self.0.entry(key).or_insert_with(search)));
            }
        }
        searches
    }
}

impl LatticeSearch {
    /// The edges have the headings of the target, and their opposites if these are no headings.
    pub(crate) fn new(target: &Target) -> Self {
        let headings = &target.headings.all;
        let (first_cos, first_sin) = target.first;
        let mut directions: Vec<[f64; 2]> = (headings.iter())
            .map(|(cos, sin, ..)| [cos * first_cos - sin * first_sin, sin * first_cos + cos * first_sin])
            .collect();
        if !directions.len().is_multiple_of(2) {
            directions.extend(directions.clone().into_iter().map(|[x, y]| [-x, -y]));
        }
        let unit = if directions.len() > MAX_DIRECTIONS { 0.0 } else { SIDE as f64 };
        Self { directions, unit, found: None }
    }

    /// Whether a lattice is found, or all lengths were tried.
    pub(crate) fn is_done(&self) -> bool {
        self.unit < SHORTEST
    }

    /// The lattice that agrees with the ink, if one is found.
    pub(crate) fn found(&self) -> Option<Arc<Lattice>> {
        self.found.clone()
    }

    /// Tries the next lengths.
    pub(crate) fn advance(&mut self, picture: &Picture) {
        let mut looked = 0;
        while looked < SHARE && !self.is_done() {
            for corner in CORNERS {
                let mut tracer = Tracer::new(picture, &self.directions, picture.corner(corner), self.unit);
                if tracer.trace() {
                    // Shorter edges that agree are parts of these.
                    self.unit = 0.0;
                    self.found = Some(Arc::new(tracer.lattice));
                    return;
                }
                looked += tracer.looked;
            }
            self.unit *= FINER;
        }
    }
}

impl Lattice {
    /// Where the edge leads to that goes from a node in a direction, if there is one.
    fn way(&self, node: u32, direction: usize) -> Option<Way> {
        self.ways[node as usize * self.directions + direction]
    }

    /// Where a turtle may begin that goes along each edge once.
    pub(crate) fn starts(&self) -> Vec<u32> {
        let all = || self.ways.chunks(self.directions).zip(0..);
        let odd = all().filter(|(ways, _)| !ways.iter().flatten().count().is_multiple_of(2));
        let odd: Vec<u32> = odd.map(|(_, node)| node).collect();
        match odd.len() {
            0 => all().map(|(_, node)| node).collect(),
            2 => odd,
            // No turtle can do this.
            _ => Vec::new(),
        }
    }

    const fn opposite(&self, direction: usize) -> usize {
        (direction + self.directions / 2) % self.directions
    }
}

/// A walk along the edges of a lattice, which measures its unit and its origin.
struct Tracer<'a> {
    picture: &'a Picture,
    directions: &'a [[f64; 2]],
    origin: [f64; 2],
    unit: f64,
    lattice: Lattice,
    /// The places of the nodes from the origin, in lines.
    places: Vec<[f64; 2]>,
    /// For the least squares: the sums of the products of each two of the coefficients and the observed place.
    sums: [[f64; 4]; 3],
    /// The number of places whose ink was looked at.
    looked: usize,
}

impl<'a> Tracer<'a> {
    fn new(picture: &'a Picture, directions: &'a [[f64; 2]], origin: [f64; 2], unit: f64) -> Self {
        let lattice = Lattice { ways: vec![None; directions.len()], directions: directions.len(), edges: 0 };
        let (places, sums, looked) = (vec![[0.0; 2]], [[0.0; 4]; 3], 0);
        Self { picture, directions, origin, unit, lattice, places, sums, looked }
    }

    /// Follows all edges from the origin, and once more from where it is known to be then. Whether the edges agree with
    /// the ink.
    fn trace(&mut self) -> bool {
        if !self.follow() || self.lattice.edges <= REFINED {
            return false;
        }
        self.refine();
        let again = Self::new(self.picture, self.directions, self.origin, self.unit);
        *self = Self { looked: self.looked, ..again };
        self.follow() && self.mask().agreement(&self.picture.mask) >= AGREEMENT
    }

    /// Follows all edges from the origin, if there are not too many.
    fn follow(&mut self) -> bool {
        let mut open = VecDeque::from([0_u32]);
        let mut nodes = HashMap::from([((0, 0), 0_u32)]);
        let mut refined = REFINED;
        let most = MAX_INK * self.picture.mask.count() as f64 / (2.0 * self.picture.stroke * self.unit);
        let most = (most as usize).min(MAX_EDGES);
        while let Some(node) = open.pop_front() {
            let [x, y] = self.places[node as usize];
            for direction in 0..self.directions.len() {
                if self.lattice.way(node, direction).is_some() {
                    continue;
                }
                let [dx, dy] = self.directions[direction];
                let Some(aside) = self.aside([x, y], [x + dx, y + dy]) else { continue };
                if self.lattice.edges >= most {
                    return false;
                }
                self.observe([x + dx / 2.0, y + dy / 2.0], [-dy, dx], aside);
                let cell = |at: f64| (at * CELLS).round() as i32;
                let count = self.places.len() as u32;
                let to = *nodes.entry((cell(x + dx), cell(y + dy))).or_insert(count);
                if to == count {
                    self.places.push([x + dx, y + dy]);
                    self.lattice.ways.extend(vec![None; self.directions.len()]);
                    open.push_back(to);
                }
                self.join(node, to, direction);
            }
            if self.lattice.edges >= 2 * refined {
                refined = self.lattice.edges;
                self.refine();
            }
        }
        true
    }

    fn join(&mut self, from: u32, to: u32, direction: usize) {
        let edge = self.lattice.edges as u32;
        let back = self.lattice.opposite(direction);
        self.lattice.ways[from as usize * self.directions.len() + direction] = Some(Way { node: to, edge });
        self.lattice.ways[to as usize * self.directions.len() + back] = Some(Way { node: from, edge });
        self.lattice.edges += 1;
    }

    fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.unit * x, self.origin[1] + self.unit * y]
    }

    fn has_ink(&self, [x, y]: [f64; 2]) -> bool {
        let (x, y) = (x, -y);
        x >= 0.0 && y >= 0.0 && x < SIDE as f64 && y < SIDE as f64 && self.picture.mask.has(x as usize, y as usize)
    }

    /// How far the ink of an edge lies to the left of it, in pixels, if it has ink.
    fn aside(&mut self, from: [f64; 2], to: [f64; 2]) -> Option<f64> {
        let ([x1, y1], [x2, y2]) = (self.pixel(from), self.pixel(to));
        let steps = self.unit.ceil() as usize;
        let along = |part: f64| [x1 + (x2 - x1) * part, y1 + (y2 - y1) * part];
        let [across_x, across_y] = [(y1 - y2) / self.unit, (x2 - x1) / self.unit];
        // Thin lines are stairs of pixels.
        let is_missing = |at: &usize| {
            let [x, y] = along(*at as f64 / steps as f64);
            [0.0, 0.5, -0.5].iter().all(|far| !self.has_ink([x + across_x * far, y + across_y * far]))
        };
        // Most ways have no ink at once.
        let gaps = (steps + 1) / GAPS;
        let stop = (0..=steps).filter(is_missing).nth(gaps);
        self.looked += stop.unwrap_or(steps) + 1;
        if stop.is_some() {
            return None;
        }
        // Across the edge in half pixels; a wider reach may come to the next line.
        let reach = ((self.picture.stroke + 1.5).min(self.unit / 2.0) * 2.0).ceil() as usize;
        let run = |part: f64, sign: f64| {
            let [x, y] = along(part);
            let inked = |at: &usize| {
                let far = sign * *at as f64 / 2.0;
                self.has_ink([x + across_x * far, y + across_y * far])
            };
            (1..=reach).take_while(inked).count()
        };
        let asides = [0.35, 0.5, 0.65].map(|part| (run(part, 1.0) as f64 - run(part, -1.0) as f64) / 4.0);
        Some(asides.iter().sum::<f64>() / asides.len() as f64)
    }

    /// The middle of an edge, in lines, was seen so far aside.
    fn observe(&mut self, middle: [f64; 2], across: [f64; 2], aside: f64) {
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let row = [across[0], across[1], dot(across, middle), dot(across, self.pixel(middle)) + aside];
        for (sums, own) in self.sums.iter_mut().zip(row) {
            for (sum, other) in sums.iter_mut().zip(row) {
                *sum += own * other;
            }
        }
    }

    /// Puts the origin and the unit where the observed edges are.
    fn refine(&mut self) {
        let mut rows = self.sums;
        for at in 0..3 {
            let Some(pivot) = (at..3).max_by(|&a, &b| rows[a][at].abs().total_cmp(&rows[b][at].abs())) else { return };
            rows.swap(at, pivot);
            if rows[at][at].abs() < 1e-6 {
                return;
            }
            let own = rows[at].map(|value| value / rows[at][at]);
            for (other, row) in rows.iter_mut().enumerate() {
                let factor = row[at];
                *row = if other == at { own } else { std::array::from_fn(|i| row[i] - factor * own[i]) };
            }
        }
        (self.origin, self.unit) = ([rows[0][3], rows[1][3]], rows[2][3].max(1.0));
    }

    /// The pixels of all edges.
    fn mask(&self) -> Mask {
        let mut mask = Mask::default();
        for (node, ways) in self.lattice.ways.chunks(self.directions.len()).enumerate() {
            for way in ways.iter().flatten().filter(|way| way.node as usize > node) {
                let [from, to] = [node, way.node as usize].map(|node| self.pixel(self.places[node]));
                put_stroke(&mut mask, [[from[0], -from[1]], [to[0], -to[1]]], self.picture.stroke.max(0.5));
            }
        }
        mask
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of a curve.
    pub(crate) fn picture(axiom: &str, rules: &str, angle: f64, n: u32) -> Picture {
        use lsystem_base::Limits;
        use lsystem_syntax::Definition;
        let definition =
            Definition { axiom: axiom.to_owned(), rules: rules.to_owned(), angle, ..Definition::default() };
        let system = lsystem_drawing::System::new(&definition).expect("a system");
        let drawing =
            lsystem_drawing::draw::<lsystem_drawing::Plane>(&system, n, &Limits::default()).expect("a drawing");
        let segments: Vec<[f64; 4]> =
            drawing.segments().map(|at| [at.from[0], at.from[1], at.to[0], at.to[1]]).collect();
        Picture::of_segments(&segments).expect("a picture")
    }

    #[test]
    fn edges_are_counted() {
        for (axiom, rules, angle, n, edges) in [
            ("F-F-F-F", "F -> F+FF-FF-F-F+F+FF-F-F+F+FF+FF-F", 90.0, 2, 1296),
            ("X", "X -> +YF-XFX-FY+\nY -> -XF+YFY+FX-", 90.0, 5, 1023),
            ("F", "F -> F+G++G-F--FF-G+\nG -> -F+GG++G+F--F-G", 60.0, 4, 2401),
        ] {
            let picture = picture(axiom, rules, angle, n);
            let target = Target::new(&picture, angle, 90.0);
            let mut search = LatticeSearch::new(&target);
            while !search.is_done() {
                search.advance(&picture);
            }
            assert_eq!(search.found().map(|lattice| lattice.edges), Some(edges), "{rules}");
        }
    }
}
