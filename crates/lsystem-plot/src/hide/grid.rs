//! A grid over the sheet: the bodies in each cell, and the depth below which the cell is covered.

use super::body::winding;
use super::scene::{Body, Scene, Shape};
use super::sight::Place;
use crate::page::Point;
use lsystem_syntax::{Halt, Work};

/// The most cells that are tried for each body, and the most for all bodies. Larger cells are fewer. Cells smaller than
/// the bodies are soon covered, and bodies behind are not listed there.
const EACH: f64 = 64.0;
const FEW: f64 = 1e5;
/// The most entries for each body beside [`FEW`]: 64 bytes.
const LISTED: usize = 8;
/// The most cells along a side.
const MAX_SIDE: f64 = 2048.0;
/// Bodies reach this much into the cells beside, in cells: far above rounding errors.
const MARGIN: f64 = 1e-6;

/// The bodies of a scene, by cell.
#[derive(Debug)]
pub(super) struct Grid {
    corner: Point,
    /// The side of a cell, in millimetres.
    side: f64,
    /// The numbers of columns and rows.
    size: [usize; 2],
    /// The range of each cell in `bodies`.
    starts: Vec<u32>,
    /// The bodies of each cell, the nearest first.
    bodies: Vec<u32>,
    /// By cell: lines below this depth are hidden.
    floors: Vec<f64>,
    /// By body: its nearest depth, and the box around it.
    reaches: Vec<(f64, [Point; 2])>,
}

/// A part of a line in a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit {
    pub(super) cell: usize,
    /// The places along the line at which it enters and leaves the cell.
    pub(super) from: f64,
    pub(super) to: f64,
}

/// How a body covers a cell.
enum Cover {
    Nothing,
    Part,
    /// All of the cell, below this depth.
    All(f64),
}

impl Grid {
    /// Sorts the bodies of a scene.
    pub(super) fn new(scene: &Scene, work: &mut dyn Work) -> Result<Self, Halt> {
        let mut boxes = Boxes::new(scene, work)?;
        let reaches = scene.bodies.iter().map(|body| (scene.near(body), scene.bounds(body))).collect();
        let mut grid = Self { reaches, ..boxes.grid() };
        boxes.list.sort_unstable_by(|(a, _), (b, _)| grid.near(*b).total_cmp(&grid.near(*a)).then(b.cmp(a)));
        loop {
            grid.floors = vec![f64::NEG_INFINITY; grid.size[0] * grid.size[1]];
            if let Some(entries) = grid.entries(scene, &boxes.list, work)? {
                grid.list(entries, work)?;
                return Ok(grid);
            }
            grid.side *= 2.0;
            grid.size = grid.size.map(|count| count.div_ceil(2));
        }
    }

    /// The cells and bodies that are not known to be covered, the nearest first; `None` if there are too many. Lifts the
    /// floors.
    fn entries(
        &mut self,
        scene: &Scene,
        boxes: &[(u32, [Point; 2])],
        work: &mut dyn Work,
    ) -> Result<Option<Vec<(u32, u32)>>, Halt> {
        let most = boxes.len() * LISTED + FEW as usize;
        let mut entries: Vec<(u32, u32)> = Vec::new();
        for &(number, bounds) in boxes {
            let body = &scene.bodies[number as usize];
            let [low, high] = bounds.map(|point| self.cell(point));
            for row in low[1]..=high[1] {
                for column in low[0]..=high[0] {
                    let cell = row * self.size[0] + column;
                    work.charge(1)?;
                    if self.near(number) <= self.floors[cell] {
                        continue;
                    }
                    work.charge(1 + body.corners() / 4)?;
                    match self.cover(scene, body, [column, row]) {
                        Cover::Nothing => continue,
                        Cover::Part => {}
                        Cover::All(depth) => self.floors[cell] = self.floors[cell].max(depth - scene.same),
                    }
                    entries.push((cell as u32, number));
                }
            }
            if entries.len() > most && self.size != [1; 2] {
                return Ok(None);
            }
        }
        Ok(Some(entries))
    }

    /// Lists the bodies of each cell, without those that are covered in the whole cell. The nearest entries come first.
    fn list(&mut self, mut entries: Vec<(u32, u32)>, work: &mut dyn Work) -> Result<(), Halt> {
        entries.retain(|&(cell, number)| self.near(number) > self.floors[cell as usize]);
        self.starts = vec![0; self.floors.len() + 1];
        for &(cell, _) in &entries {
            self.starts[cell as usize + 1] += 1;
        }
        for cell in 0..self.floors.len() {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.bodies = vec![0; entries.len()];
        let mut ends = self.starts.clone();
        for (cell, number) in entries {
            work.charge(1)?;
            let end = &mut ends[cell as usize];
            self.bodies[*end as usize] = number;
            *end += 1;
        }
        Ok(())
    }

    /// The bodies of a cell, the nearest first.
    pub(super) fn bodies(&self, cell: usize) -> &[u32] {
        &self.bodies[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// The cells of all bodies: the range of each body in the list, and the list.
    pub(super) fn cells(&self, work: &mut dyn Work) -> Result<(Vec<u32>, Vec<u32>), Halt> {
        let mut starts = vec![0; self.reaches.len() + 1];
        for &body in &self.bodies {
            starts[body as usize + 1] += 1;
        }
        for body in 0..self.reaches.len() {
            starts[body + 1] += starts[body];
        }
        let (mut ends, mut cells) = (starts.clone(), vec![0; self.bodies.len()]);
        for cell in 0..self.floors.len() {
            let bodies = self.bodies(cell);
            work.charge(1 + bodies.len() as u64)?;
            for &body in bodies {
                let end = &mut ends[body as usize];
                cells[*end as usize] = cell as u32;
                *end += 1;
            }
        }
        Ok((starts, cells))
    }

    /// The nearest depth of a body.
    pub(super) fn near(&self, body: u32) -> f64 {
        self.reaches[body as usize].0
    }

    /// The box around a body.
    pub(super) fn around(&self, body: u32) -> [Point; 2] {
        self.reaches[body as usize].1
    }

    /// Lines below this depth are hidden in a cell.
    pub(super) fn floor(&self, cell: usize) -> f64 {
        self.floors[cell]
    }

    /// Whether a body is surely hidden: it lies below the floors of all its cells.
    pub(super) fn hides(&self, scene: &Scene, number: u32) -> bool {
        let [low, high] = scene.bounds(&scene.bodies[number as usize]).map(|point| self.cell(point));
        let near = self.near(number);
        (low[1]..=high[1]).all(|row| (low[0]..=high[0]).all(|column| near < self.floors[row * self.size[0] + column]))
    }

    /// The column and the row of a point; those of the nearest cell if the point is outside.
    fn cell(&self, point: Point) -> [usize; 2] {
        [0, 1].map(|axis| {
            let place = libm::floor((point[axis] - self.corner[axis]) / self.side);
            (place.max(0.0) as usize).min(self.size[axis] - 1)
        })
    }

    /// The cells along a line, in order.
    pub(super) fn along(&self, [from, to]: [Place; 2]) -> impl Iterator<Item = Visit> {
        let columns = self.size[0];
        let cells = [from, to].map(|[x, y, _]| self.cell([x, y]).map(|place| place as i64));
        let line = [from, to].map(|[x, y, _]| [x, y]);
        cells_along(self.corner, self.side, line, cells).map(move |([column, row], from, to)| Visit {
            cell: row as usize * columns + column as usize,
            from,
            to,
        })
    }

    /// How a body covers a cell.
    fn cover(&self, scene: &Scene, body: &Body, at: [usize; 2]) -> Cover {
        let low = [0, 1].map(|axis| self.corner[axis] + (at[axis] as f64 - MARGIN) * self.side);
        let side = self.side * (1.0 + 2.0 * MARGIN);
        let middle = low.map(|part| part + side / 2.0);
        let corners = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]].map(|[x, y]| [low[0] + x, low[1] + y]);
        match &body.shape {
            Shape::Line(_) => Cover::Nothing,
            Shape::Tube(tube) => {
                let (unit, length) = tube.axis();
                let [dx, dy] = [middle[0] - tube.ends[0][0], middle[1] - tube.ends[0][1]];
                let along = (dx * unit[0] + dy * unit[1]).clamp(0.0, length);
                let [dx, dy] = [dx - along * unit[0], dy - along * unit[1]];
                let reach = tube.widest() + scene.same + side * core::f64::consts::FRAC_1_SQRT_2;
                if dx * dx + dy * dy > reach * reach {
                    Cover::Nothing
                } else if 2.0 * tube.widest() > side && corners.iter().all(|&corner| tube.has(corner)) {
                    Cover::All(tube.base())
                } else {
                    Cover::Part
                }
            }
            Shape::Face { vertices, plane, is_outlined } => {
                let Some(plane) = plane else { return Cover::Nothing };
                let vertices = &scene.vertices[vertices.start as usize..vertices.end as usize];
                let before = vertices[vertices.len() - 1..].iter().chain(vertices);
                if before.zip(vertices).any(|(a, b)| meets([a, b], low, side)) {
                    return Cover::Part;
                }
                if winding(vertices, middle) == 0 {
                    return Cover::Nothing;
                }
                // A triangle of a bent polygon does not hide the polygon itself.
                if !is_outlined {
                    return Cover::Part;
                }
                Cover::All(corners.iter().map(|&corner| plane.at(corner)).fold(f64::INFINITY, f64::min))
            }
        }
    }
}

/// The cells along a line between its first cell and its last one, in order: the column and the row of each, and the
/// places along the line at which it enters and leaves the cell. Column and row 0 begin at the corner.
pub(super) fn cells_along(
    corner: Point,
    side: f64,
    [from, to]: [Point; 2],
    [mut at, last]: [[i64; 2]; 2],
) -> impl Iterator<Item = ([i64; 2], f64, f64)> {
    let way = [to[0] - from[0], to[1] - from[1]];
    // The place along the line at which it leaves a column or a row.
    let leave = move |at: i64, axis: usize| {
        let border = corner[axis] + (at as f64 + if way[axis] > 0.0 { 1.0 } else { 0.0 }) * side;
        ((border - from[axis]) / way[axis]).clamp(0.0, 1.0)
    };
    let (mut entered, mut is_done) = (0.0, false);
    core::iter::from_fn(move || {
        if is_done {
            return None;
        }
        let cell = at;
        let next = [0, 1].map(|axis| if at[axis] == last[axis] { f64::INFINITY } else { leave(at[axis], axis) });
        let axis = usize::from(next[1] < next[0]);
        let (from, to) = (entered, next[axis].clamp(entered, 1.0));
        is_done = at == last;
        if !is_done {
            at[axis] += (last[axis] - at[axis]).signum();
        }
        entered = to;
        Some((cell, from, to))
    })
}

/// Whether two boxes are at most this far apart along both axes.
pub(super) fn are_near(a: [Point; 2], b: [Point; 2], apart: f64) -> bool {
    (0..2).all(|axis| a[0][axis] - b[1][axis] <= apart && b[0][axis] - a[1][axis] <= apart)
}

/// Whether a line on the sheet meets a square with this corner and side.
fn meets(ends: [&Place; 2], low: Point, side: f64) -> bool {
    let apart = |axis: usize| {
        let [a, b] = ends.map(|end| end[axis] - low[axis]);
        a.max(b) < 0.0 || a.min(b) > side
    };
    if apart(0) || apart(1) {
        return false;
    }
    let [a, b] = ends;
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let middle = low.map(|part| part + side / 2.0);
    let aside = dx * (middle[1] - a[1]) - dy * (middle[0] - a[0]);
    aside.abs() <= (dx.abs() + dy.abs()) * side / 2.0
}

/// The boxes around all bodies that cover lines.
struct Boxes {
    list: Vec<(u32, [Point; 2])>,
    /// The box around all lines.
    all: [Point; 2],
}

impl Boxes {
    fn new(scene: &Scene, work: &mut dyn Work) -> Result<Self, Halt> {
        let mut boxes = Self { list: vec![], all: [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]] };
        for (number, body) in (0..).zip(&scene.bodies) {
            work.charge(1 + body.corners() / 4)?;
            let bounds = scene.bounds(body);
            boxes.all[0] = [0, 1].map(|axis| boxes.all[0][axis].min(bounds[0][axis]));
            boxes.all[1] = [0, 1].map(|axis| boxes.all[1][axis].max(bounds[1][axis]));
            let covers = match &body.shape {
                Shape::Line(_) => false,
                Shape::Tube(_) => true,
                Shape::Face { plane, .. } => plane.is_some(),
            };
            if covers {
                boxes.list.push((number, bounds));
            }
        }
        Ok(boxes)
    }

    /// A grid without entries. Its cells are as small as the number of entries allows.
    fn grid(&self) -> Grid {
        let [low, high] = self.all;
        let sides = [0, 1].map(|axis| (high[axis] - low[axis]).max(1e-3));
        let sides = if sides[0].is_finite() { sides } else { [1.0; 2] };
        let corner = if low[0].is_finite() { low } else { [0.0; 2] };
        let count = self.list.len() as f64;
        let mut side = (sides[0] * sides[1] / (4.0 * count + 1.0)).sqrt().max(sides[0].max(sides[1]) / MAX_SIDE);
        let entries = |side: f64| -> f64 {
            let of = |[low, high]: [Point; 2]| {
                [0, 1].iter().map(|&axis| (high[axis] - low[axis]) / side + 1.0).product::<f64>()
            };
            self.list.iter().map(|&(_, bounds)| of(bounds)).sum()
        };
        while entries(side) > EACH * count + FEW && side < sides[0].max(sides[1]) {
            side *= 1.5;
        }
        let size = sides.map(|length| (libm::ceil(length / side) as usize).max(1));
        Grid { corner, side, size, starts: vec![], bodies: vec![], floors: vec![], reaches: vec![] }
    }
}

impl Body {
    /// The number of corners that a test looks at.
    pub(super) fn corners(&self) -> u64 {
        if let Shape::Face { vertices, .. } = &self.shape { vertices.len() as u64 } else { 4 }
    }
}

impl Scene {
    /// The nearest depth of a body.
    fn near(&self, body: &Body) -> f64 {
        match &body.shape {
            Shape::Line(ends) => ends[0][2].max(ends[1][2]),
            Shape::Tube(tube) => tube.near(),
            Shape::Face { vertices, .. } => {
                let vertices = &self.vertices[vertices.start as usize..vertices.end as usize];
                vertices.iter().map(|vertex| vertex[2]).fold(f64::NEG_INFINITY, f64::max) + 2.0 * self.same
            }
        }
    }

    /// The farthest depth of a body that covers lines.
    pub(super) fn far(&self, body: &Body) -> f64 {
        let radius = if let Shape::Tube(tube) = &body.shape { tube.widest() } else { 0.0 };
        self.places(body).iter().map(|place| place[2]).fold(f64::INFINITY, f64::min) - radius
    }

    /// The box around a body.
    fn bounds(&self, body: &Body) -> [Point; 2] {
        let (points, radius) = match &body.shape {
            Shape::Line(ends) => (&ends[..], 0.0),
            Shape::Tube(tube) => (&tube.ends[..], tube.widest()),
            Shape::Face { vertices, .. } => (&self.vertices[vertices.start as usize..vertices.end as usize], 0.0),
        };
        let bound = |pick: fn(f64, f64) -> f64, start: f64, radius: f64| {
            [0, 1].map(|axis| points.iter().map(|point| point[axis]).fold(start, pick) + radius)
        };
        [bound(f64::min, f64::INFINITY, -radius), bound(f64::max, f64::NEG_INFINITY, radius)]
    }
}
