//! Space of three dimensions: turns are rotation matrices.

use crate::rotation::Axis;
use crate::rotation::{Rotation, Vector, combine};
use crate::space::{Geometry, Tropism};
use lsystem_syntax::Heading;

/// Drawings in space: x to the right, y up, z towards the viewer. A turtle with the usual heading of 90 degrees starts
/// with heading +y, left -x and up +z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Solid;

impl Geometry for Solid {
    type Point = Vector;
    type Turn = Rotation;
    /// Heading, left and up.
    type Axes = [Vector; 3];
    type Directions = ();

    const AHEAD: Rotation = Rotation::NONE;
    const AXES: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const UPWARDS: Vector = [0.0, 1.0, 0.0];
    const LEVEL: bool = false;

    fn directions() {}

    fn turn(about: Axis, by: Heading) -> Rotation {
        Rotation::about(about, by)
    }

    fn then(first: Rotation, next: Rotation) -> Rotation {
        first.then(&next)
    }

    fn upright(turn: Rotation, vertical: &Vector) -> Rotation {
        turn.upright(*vertical)
    }

    fn seen(turn: Rotation, direction: Vector) -> Vector {
        turn.undo(direction)
    }

    fn bent(turn: Rotation, tropism: &Tropism) -> Rotation {
        turn.bent(tropism.vector, tropism.elasticity)
    }

    fn axes((): &mut (), turn: Rotation) -> [Vector; 3] {
        turn.columns()
    }

    fn scaled(axes: [Vector; 3], factor: f64) -> [Vector; 3] {
        axes.map(|axis| axis.map(|c| c * factor))
    }

    fn transform(axes: &[Vector; 3], at: Vector, point: Vector) -> Vector {
        let by = combine(axes, point);
        [at[0] + by[0], at[1] + by[1], at[2] + by[2]]
    }

    fn ahead([h, ..]: &[Vector; 3], at: Vector, length: f64) -> Vector {
        [at[0] + length * h[0], at[1] + length * h[1], at[2] + length * h[2]]
    }

    fn point(model: [f64; 3]) -> Vector {
        model
    }
}
