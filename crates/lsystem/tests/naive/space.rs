//! The naive turtle in space: three vectors, rotated by Rodrigues' formula.

use super::{Pen, TubePlace, actions, around, drawn, limit_widths, replaced, shorter, slot, swayed, variations};
use lsystem::drawing::Segment;
use lsystem::syntax::Action;
use lsystem::{Solid, System};

type Vector = [f64; 3];

/// The state of the turtle, which a branch saves.
#[derive(Clone, Copy)]
struct State {
    at: Vector,
    heading: Vector,
    left: Vector,
    up: Vector,
    /// The direction that `$` levels by: upwards, turned by each sway.
    vertical: Vector,
    pen: Pen,
    tube: TubePlace<3>,
}

/// A polygon: vertices, colour index, level, number of segments before it, and index of the module that opens it.
pub type Filled = (Vec<Vector>, i32, u32, usize, usize);

impl State {
    /// Rotates by the right-hand rule.
    fn rotate(&mut self, axis: Vector, radians: f64) {
        let (c, s) = (libm::cos(radians), libm::sin(radians));
        for v in [&mut self.heading, &mut self.left, &mut self.up] {
            let (across, along) = (cross(axis, *v), dot(axis, *v) * (1.0 - c));
            *v = [0, 1, 2].map(|i| v[i] * c + across[i] * s + axis[i] * along);
            // An axis of another length than 1 would increase the error with every rotation.
            let length = dot(*v, *v).sqrt();
            *v = v.map(|c| c / length);
        }
    }

    /// Turns the turtle, and the vertical with it.
    fn wind(&mut self, [left, down]: [f64; 2]) {
        let along = [self.heading, self.left, self.up].map(|axis| dot(axis, self.vertical));
        self.rotate(self.up, left);
        self.rotate(self.left, down);
        self.vertical = [0, 1, 2].map(|i| along[0] * self.heading[i] + along[1] * self.left[i] + along[2] * self.up[i]);
    }

    fn advance(&mut self, length: f64) {
        self.at = [0, 1, 2].map(|i| self.at[i] + length * self.heading[i]);
    }

    fn tube_place(&self) -> TubePlace<3> {
        (self.at, self.heading, self.pen.width)
    }

    /// The corners of a circle around the turtle.
    fn circle(&self, diameter: f64) -> Vec<Vector> {
        let corner = |corner: i32| {
            let mut there = *self;
            there.rotate(self.up, (11.25 * f64::from(corner)).to_radians());
            there.advance(0.5 * diameter);
            there.at
        };
        (0..32).map(corner).collect()
    }

    fn upright(&mut self) {
        let left = cross(self.vertical, self.heading);
        let length = dot(left, left).sqrt();
        if length > 1e-9 {
            self.left = left.map(|c| c / length);
            self.up = cross(self.heading, self.left);
        }
    }

    fn bend(&mut self, towards: Vector, elasticity: f64) {
        let torque = cross(self.heading, towards);
        let length = dot(torque, torque).sqrt();
        if length > 1e-12 {
            self.rotate(torque.map(|c| c / length), elasticity * length);
        }
    }
}

/// The segments of generation `n` in space, in drawing order.
pub fn solid_segments(system: &System, n: u32) -> Vec<Segment<Solid>> {
    run(system, n).0
}

/// The polygons of generation `n` in space, in the order in which they are opened.
pub fn solid_polygons(system: &System, n: u32) -> Vec<Filled> {
    run(system, n).1
}

fn run(system: &System, n: u32) -> (Vec<Segment<Solid>>, Vec<Filled>) {
    let turtle = &system.turtle;
    let mut state = State {
        at: [turtle.start[0], turtle.start[1], 0.0],
        heading: [1.0, 0.0, 0.0],
        left: [0.0, 1.0, 0.0],
        up: [0.0, 0.0, 1.0],
        vertical: [0.0, 1.0, 0.0],
        pen: Pen::new(turtle),
        tube: ([0.0; 3], [0.0; 3], 0.0),
    };
    // All polygons, the indices of the open ones, and the indices of the closed ones.
    let (mut polygons, mut open, mut closed): (Vec<Filled>, Vec<usize>, Vec<usize>) = Default::default();
    state.rotate([0.0, 0.0, 1.0], turtle.heading.degrees().to_radians());
    state.wind(swayed(turtle, None));
    state.tube = state.tube_place();
    let (mut saved, mut segments) = (Vec::new(), Vec::new());
    for module in drawn(system, n) {
        state.pen.begin(turtle, &module);
        let grown = if module.made == n && n > 0 { turtle.growth } else { 1.0 };
        for (index, action) in actions(system, module.symbol).iter().enumerate() {
            let number = module.arguments.first().filter(|_| index == 0);
            let [longer, farther] = variations(system, n, &module, slot(actions(system, module.symbol), index));
            let longer = longer * state.pen.scale;
            let by = |degrees: Option<f64>, own: lsystem::syntax::Heading| {
                (shorter(degrees.unwrap_or(own.degrees())) * farther).to_radians()
            };
            let before = state.at;
            let marks = matches!(action, Action::Draw(_) | Action::Move(_));
            let action = state.pen.exchanged(number.map_or(*action, |number| replaced(*action, *number)));
            match action {
                Action::Draw(length) | Action::DrawUnmarked(length) => {
                    let from = state.at;
                    state.advance(longer * length.unwrap_or(turtle.step));
                    state.pen.draw(turtle, from, state.at, &mut segments);
                    if let Some(tropism) = turtle.tropism {
                        state.bend(tropism.vector, tropism.elasticity);
                    }
                }
                Action::Move(length) | Action::MoveUnmarked(length) => {
                    state.advance(longer * length.unwrap_or(turtle.step));
                }
                Action::OpenPolygon => {
                    open.push(polygons.len());
                    polygons.push((vec![], state.pen.colour, state.pen.level, segments.len(), module.index));
                }
                Action::Vertex => {
                    if let Some(&place) = open.last() {
                        polygons[place].0.push(state.at);
                    }
                }
                Action::ClosePolygon => closed.extend(open.pop()),
                Action::TurnLeft(degrees) => state.rotate(state.up, by(degrees, turtle.left)),
                Action::TurnRight(degrees) => state.rotate(state.up, -by(degrees, turtle.right)),
                Action::TurnRound => state.rotate(state.up, core::f64::consts::PI * grown),
                Action::PitchDown(degrees) => state.rotate(state.left, by(degrees, turtle.pitch_down)),
                Action::PitchUp(degrees) => state.rotate(state.left, -by(degrees, turtle.pitch_up)),
                Action::RollLeft(degrees) => state.rotate(state.heading, by(degrees, turtle.roll_left)),
                Action::RollRight(degrees) => state.rotate(state.heading, -by(degrees, turtle.roll_right)),
                Action::RollUpright => state.upright(),
                Action::Circle(diameter) => {
                    let corners = state.circle(longer * diameter.unwrap_or(turtle.step));
                    segments.extend(around(&corners, |from, to| state.pen.segment(turtle, from, to)));
                }
                Action::Fill(outline, size) => {
                    closed.push(polygons.len());
                    let size = longer * size.unwrap_or(turtle.step);
                    let corners = match outline.leaf() {
                        None => state.circle(size),
                        Some(leaf) => leaf
                            .map(|[x, y]| {
                                [0, 1, 2].map(|i| state.at[i] + size * (x * state.heading[i] + y * state.left[i]))
                            })
                            .collect(),
                    };
                    polygons.push((corners, state.pen.colour, state.pen.level, segments.len(), module.index));
                }
                Action::Surface(name, size) => {
                    let size = longer * size.unwrap_or(turtle.step);
                    let triangles = turtle.surfaces.iter().filter(|surface| surface.0 == name);
                    for corners in triangles.flat_map(|surface| surface.1.iter()) {
                        let at = |[x, y, z]: Vector| {
                            let axes = [state.heading, state.left, state.up];
                            [0, 1, 2].map(|i| state.at[i] + size * (x * axes[0][i] + y * axes[1][i] + z * axes[2][i]))
                        };
                        closed.push(polygons.len());
                        let corners = corners.map(at).to_vec();
                        polygons.push((corners, state.pen.colour, state.pen.level, segments.len(), module.index));
                    }
                }
                Action::OpenTube => state.tube = state.tube_place(),
                Action::TubePoint | Action::CloseTube => {
                    let to = state.tube_place();
                    state.pen.tube(turtle, state.tube, to, &mut segments);
                    state.tube = to;
                }
                Action::Push => {
                    saved.push(state);
                    state.wind(swayed(turtle, Some(module.step)));
                }
                Action::Pop => state = saved.pop().unwrap_or(state),
                // Other actions change only the pen.
                _ => {}
            }
            state.pen.act(turtle, action);
            if let Some(&place) = open.last().filter(|_| marks) {
                if polygons[place].0.is_empty() {
                    polygons[place].0.push(before);
                }
                polygons[place].0.push(state.at);
            }
        }
    }
    for (vertices, ..) in &mut polygons {
        vertices.dedup();
    }
    let mut place = 0;
    polygons.retain(|(vertices, ..)| {
        place += 1;
        closed.contains(&(place - 1)) && vertices.len() > 2
    });
    let points = || segments.iter().flat_map(|s| [s.from, s.to]).chain(polygons.iter().flat_map(|p| p.0.clone()));
    let side = |axis: usize| {
        let along = || points().map(|point| point[axis]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    let longest = (0..3).map(side).fold(0.0, f64::max);
    limit_widths(&mut segments, turtle, longest);
    (segments, polygons)
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
