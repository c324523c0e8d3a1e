//! Rotations in space.

use lsystem_syntax::Heading;

/// One of the turtle's own axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The heading: a positive turn about it rolls the turtle's left upwards.
    Ahead,
    /// To the left: a positive turn about it pitches the heading down.
    Left,
    /// Upwards: a positive turn about it turns the heading to the left.
    Up,
}

/// A vector or a point: x, y, z.
pub type Vector = [f64; 3];

/// An orientation of the turtle: heading, left and up as unit vectors at right angles, with up = heading x left.
///
/// A matrix, so that quarter turns compose exactly. [`Rotation::then`] makes the matrix orthonormal again when rounding
/// has bent it, so that any number of rotations compose to a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Heading, left, up.
    columns: [Vector; 3],
}

/// The largest error, after one rounding, of scalar products that should be 1 or 0.
const ROUNDING: f64 = 1e-15;

impl Rotation {
    /// No rotation: heading along +x, left along +y, up along +z.
    pub const NONE: Self = Self { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };

    /// A rotation by the right-hand rule about one of the turtle's own axes.
    #[must_use]
    pub fn about(axis: Axis, by: Heading) -> Self {
        let (c, s) = by.cos_sin();
        Self {
            columns: match axis {
                Axis::Ahead => [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]],
                Axis::Left => [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]],
                Axis::Up => [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]],
            },
        }
    }

    /// The turtle's heading, left and up.
    #[must_use]
    pub fn columns(&self) -> [[f64; 3]; 3] {
        self.columns
    }

    /// The rotation as a unit quaternion: x, y, z, w with w at least 0.
    #[must_use]
    pub fn quaternion(&self) -> [f64; 4] {
        let [h, l, u] = self.columns;
        let trace = h[0] + l[1] + u[2];
        // Four times the squares of w, x, y, z. The largest divides the others without cancellation.
        let squares = [1.0 + trace, 1.0 + 2.0 * h[0] - trace, 1.0 + 2.0 * l[1] - trace, 1.0 + 2.0 * u[2] - trace];
        let largest = (0..4).max_by(|&a, &b| squares[a].total_cmp(&squares[b])).unwrap_or(0);
        let [w, x, y, z] = match largest {
            0 => [squares[0], l[2] - u[1], u[0] - h[2], h[1] - l[0]],
            1 => [l[2] - u[1], squares[1], h[1] + l[0], u[0] + h[2]],
            2 => [u[0] - h[2], h[1] + l[0], squares[2], l[2] + u[1]],
            _ => [h[1] - l[0], u[0] + h[2], l[2] + u[1], squares[3]],
        };
        let length = (w * w + x * x + y * y + z * z).sqrt();
        let scale = if w < 0.0 { -1.0 / length } else { 1.0 / length };
        [x, y, z, w].map(|c| c * scale)
    }

    /// This rotation, followed by `next` about the rotated axes.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self { columns: next.columns.map(|column| combine(&self.columns, column)) }.straightened()
    }

    /// Rotates a vector.
    #[must_use]
    pub fn apply(&self, vector: [f64; 3]) -> [f64; 3] {
        combine(&self.columns, vector)
    }

    /// Rotates a vector by the inverse rotation.
    #[must_use]
    pub fn undo(&self, vector: [f64; 3]) -> [f64; 3] {
        self.columns.map(|column| dot(column, vector))
    }

    /// The rotation rolled about the heading until left is level and up does not point below it (ABOP, section 2.1:
    /// L = V x H / |V x H|). `vertical` is a unit vector that points upwards. A vertical heading changes nothing.
    #[must_use]
    pub fn upright(&self, vertical: [f64; 3]) -> Self {
        let [h, ..] = self.columns;
        let left = cross(vertical, h);
        let length = norm(left);
        // If the heading is vertical, every left is level.
        if length < 1e-9 {
            return *self;
        }
        let left = left.map(|c| c / length);
        Self { columns: [h, left, cross(h, left)] }.straightened()
    }

    /// The rotation turned about the axis heading x `towards`, by `elasticity` times that product's length, in radians.
    #[must_use]
    pub fn bent(&self, towards: [f64; 3], elasticity: f64) -> Self {
        let torque = cross(self.columns[0], towards);
        let length = norm(torque);
        if length < 1e-12 {
            return *self;
        }
        let k = torque.map(|c| c / length);
        let angle = elasticity * length;
        let (c, s) = (libm::cos(angle), libm::sin(angle));
        // Rodrigues' formula.
        let turn = |v: Vector| {
            let (across, along) = (cross(k, v), dot(k, v) * (1.0 - c));
            [0, 1, 2].map(|i| v[i] * c + across[i] * s + k[i] * along)
        };
        Self { columns: self.columns.map(turn) }.straightened()
    }

    /// The rotation made orthonormal, if its error exceeds [`ROUNDING`].
    fn straightened(self) -> Self {
        let [h, l, _] = self.columns;
        let off = (dot(h, h) - 1.0).abs().max((dot(l, l) - 1.0).abs()).max(dot(h, l).abs());
        if off.is_nan() || off <= ROUNDING {
            return self;
        }
        let unit = |v: Vector| {
            let length = norm(v);
            v.map(|c| c / length)
        };
        let h = unit(h);
        let along = dot(h, l);
        let l = unit([0, 1, 2].map(|i| l[i] - along * h[i]));
        Self { columns: [h, l, cross(h, l)] }
    }
}

/// The matrix of three columns times a vector.
#[must_use]
pub fn combine([a, b, c]: &[Vector; 3], [x, y, z]: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] * x + b[i] * y + c[i] * z)
}

/// The scalar product.
#[must_use]
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a - b`.
#[must_use]
pub fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// The length of a vector.
#[must_use]
pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        let quarter = |axis| Rotation::about(axis, Heading::UP);
        let mut turned = Rotation::NONE;
        for _ in 0..1000 {
            for axis in [Axis::Up, Axis::Left, Axis::Ahead, Axis::Left] {
                turned = turned.then(&quarter(axis));
            }
        }
        assert!(turned.columns().as_flattened().iter().all(|c| [0.0, 1.0].contains(&c.abs())), "{turned:?}");
        // A turn to the left, a pitch down, and a roll that lifts the left.
        assert_eq!(quarter(Axis::Up).apply([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
        assert_eq!(quarter(Axis::Left).apply([1.0, 0.0, 0.0]), [0.0, 0.0, -1.0]);
        assert_eq!(quarter(Axis::Ahead).apply([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn many_rotations_stay_a_rotation() {
        let step = [Axis::Up, Axis::Left, Axis::Ahead]
            .map(|axis| Rotation::about(axis, Heading::from_degrees(25.7)))
            .iter()
            .fold(Rotation::NONE, |a, b| a.then(b));
        let turned = (0..1_000_000).fold(Rotation::NONE, |turned, _| turned.then(&step));
        let [h, l, u] = turned.columns();
        for (a, b, product) in [(h, h, 1.0), (l, l, 1.0), (u, u, 1.0), (h, l, 0.0), (l, u, 0.0), (u, h, 0.0)] {
            assert!((dot(a, b) - product).abs() < 4e-15, "{turned:?}");
        }
        assert!(dot(cross(h, l), u) > 0.99);
    }

    #[test]
    fn a_tropism_bends_towards_it() {
        let down = [0.0, -1.0, 0.0];
        let bent = Rotation::NONE.bent(down, 0.1);
        let [h, ..] = bent.columns();
        assert!((h[1] + libm::sin(0.1)).abs() < 1e-15 && h[2] == 0.0, "{h:?}");
        // A heading along the tropism does not bend.
        let along = Rotation::about(Axis::Up, Heading::from_degrees(-90.0));
        assert_eq!(along.bent(down, 0.1), along);
    }

    #[test]
    fn upright_is_level() {
        let tilted = [(Axis::Up, 30.0), (Axis::Left, 40.0), (Axis::Ahead, 50.0)]
            .map(|(axis, by)| Rotation::about(axis, Heading::from_degrees(by)))
            .iter()
            .fold(Rotation::NONE, |a, b| a.then(b));
        let [h, l, u] = tilted.upright([0.0, 1.0, 0.0]).columns();
        assert_eq!(h, tilted.columns()[0]);
        assert!(l[1].abs() < 1e-15 && u[1] > 0.0);
        let vertical = Rotation::about(Axis::Up, Heading::UP);
        assert_eq!(vertical.upright([0.0, 1.0, 0.0]), vertical);
    }
}
