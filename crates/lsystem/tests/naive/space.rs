//! The turtle in space, the plain way: three vectors that are rotated by Rodrigues' formula.

use super::{actions, images, modules, replaced};
use lsystem::{Action, Segment, Solid, System};

type Vector = [f64; 3];

/// A turtle's state; all of it is saved by a branch.
#[derive(Clone, Copy)]
struct State {
    at: Vector,
    heading: Vector,
    left: Vector,
    up: Vector,
    colour: i32,
    width: f64,
    level: u32,
}

impl State {
    /// By the right-hand rule.
    fn rotate(&mut self, axis: Vector, radians: f64) {
        let (c, s) = (libm::cos(radians), libm::sin(radians));
        for v in [&mut self.heading, &mut self.left, &mut self.up] {
            let (across, along) = (cross(axis, *v), dot(axis, *v) * (1.0 - c));
            *v = [0, 1, 2].map(|i| v[i] * c + across[i] * s + axis[i] * along);
            // Axes that are not quite unit vectors any more would make it worse each time.
            let length = dot(*v, *v).sqrt();
            *v = v.map(|c| c / length);
        }
    }

    fn advance(&mut self, length: f64) {
        self.at = [0, 1, 2].map(|i| self.at[i] + length * self.heading[i]);
    }

    fn upright(&mut self) {
        let left = cross([0.0, 1.0, 0.0], self.heading);
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
    let turtle = &system.turtle;
    let mut state = State {
        at: [turtle.start[0], turtle.start[1], 0.0],
        heading: [1.0, 0.0, 0.0],
        left: [0.0, 1.0, 0.0],
        up: [0.0, 0.0, 1.0],
        colour: 0,
        width: turtle.width,
        level: 0,
    };
    state.rotate([0.0, 0.0, 1.0], turtle.heading.degrees().to_radians());
    let (mut saved, mut segments) = (Vec::new(), Vec::new());
    let word = modules(&system.grammar, system.seed, n).expect("finite numbers");
    let word = images(&system.grammar, system.seed, &word).expect("finite numbers");
    for module in word {
        for (index, action) in actions(system, module.symbol).iter().enumerate() {
            let number = module.arguments.first().filter(|_| index == 0);
            let by = |degrees: Option<f64>, own: lsystem::Heading| degrees.unwrap_or(own.degrees()).to_radians();
            match number.map_or(*action, |number| replaced(*action, *number)) {
                Action::Draw(length) => {
                    let from = state.at;
                    state.advance(length.unwrap_or(turtle.step));
                    segments.push(Segment {
                        from,
                        to: state.at,
                        colour: state.colour,
                        level: state.level,
                        width: state.width * turtle.step.abs(),
                    });
                    if let Some(tropism) = turtle.tropism {
                        state.bend(tropism.vector, tropism.elasticity);
                    }
                }
                Action::Move(length) => state.advance(length.unwrap_or(turtle.step)),
                Action::TurnLeft(degrees) => state.rotate(state.up, by(degrees, turtle.left)),
                Action::TurnRight(degrees) => state.rotate(state.up, -by(degrees, turtle.right)),
                Action::TurnRound => state.rotate(state.up, core::f64::consts::PI),
                Action::PitchDown(degrees) => state.rotate(state.left, by(degrees, turtle.pitch_down)),
                Action::PitchUp(degrees) => state.rotate(state.left, -by(degrees, turtle.pitch_up)),
                Action::RollLeft(degrees) => state.rotate(state.heading, by(degrees, turtle.roll_left)),
                Action::RollRight(degrees) => state.rotate(state.heading, -by(degrees, turtle.roll_right)),
                Action::RollUpright => state.upright(),
                Action::Cut => {}
                Action::Push => {
                    saved.push(state);
                    state.level += 1;
                }
                Action::Pop => state = saved.pop().unwrap_or(state),
                Action::SetColour(colour) => state.colour = colour,
                Action::AddColour(by) => state.colour = state.colour.wrapping_add(by),
                Action::SetWidth(width) => state.width = width,
                Action::ScaleWidth(factor) => state.width *= factor,
            }
        }
    }
    segments
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
