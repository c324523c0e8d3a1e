//! Projections from plane to plane.

/// A projection as a matrix of homogeneous coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection(pub(crate) [[f64; 3]; 3]);

impl Projection {
    pub(crate) const NONE: Self = Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);

    /// The projection of the unit square, from its corner at the origin on with (1, 0), (1, 1) and (0, 1), onto four
    /// corners (Heckbert, "Fundamentals of texture mapping and image warping", 1989). `None` if three are in a line.
    pub(crate) fn of_square([a, b, c, d]: [[f64; 2]; 4]) -> Option<Self> {
        let off = |axis: usize| a[axis] - b[axis] + c[axis] - d[axis];
        let [right, left] = [[b[0] - c[0], b[1] - c[1]], [d[0] - c[0], d[1] - c[1]]];
        let area = right[0] * left[1] - left[0] * right[1];
        let g = (off(0) * left[1] - left[0] * off(1)) / area;
        let h = (right[0] * off(1) - off(0) * right[1]) / area;
        let row = |axis: usize| [b[axis] - a[axis] + g * b[axis], d[axis] - a[axis] + h * d[axis], a[axis]];
        let own = Self([row(0), row(1), [g, h, 1.0]]);
        own.0.iter().flatten().all(|at| at.is_finite()).then_some(own)
    }

    /// This projection after another one.
    pub(crate) fn after(self, first: Self) -> Self {
        let entry = |row: usize, column: usize| (0..3).map(|at| self.0[row][at] * first.0[at][column]).sum();
        Self([0, 1, 2].map(|row| [0, 1, 2].map(|column| entry(row, column))))
    }

    /// The projection back, by the adjugate: a factor does not matter.
    pub(crate) fn inverse(self) -> Self {
        let m = self.0;
        let minor = |row: usize, column: usize| {
            let [a, b] = [(row + 1) % 3, (row + 2) % 3];
            let [c, d] = [(column + 1) % 3, (column + 2) % 3];
            m[a][c] * m[b][d] - m[a][d] * m[b][c]
        };
        Self([0, 1, 2].map(|row| [0, 1, 2].map(|column| minor(column, row))))
    }

    pub(crate) fn turn(radians: f64) -> Self {
        let (sin, cos) = libm::sincos(radians);
        Self([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    }

    pub(crate) const fn scaled(x: f64, y: f64) -> Self {
        Self([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, 1.0]])
    }

    pub(crate) const fn moved(x: f64, y: f64) -> Self {
        Self([[1.0, 0.0, x], [0.0, 1.0, y], [0.0, 0.0, 1.0]])
    }

    pub(crate) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [across, down, far] = self.0.map(|row| row[0] * x + row[1] * y + row[2]);
        [across / far, down / far]
    }

    /// The direction at a place, in any length.
    pub(crate) fn direction(&self, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) -> [f64; 2] {
        let [across, down, far] = self.0.map(|row| row[0] * x + row[1] * y + row[2]);
        let [by_x, by_y, by_far] = self.0.map(|row| row[0] * dx + row[1] * dy);
        [by_x * far - across * by_far, by_y * far - down * by_far]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_goes_to_its_corners_and_back() {
        let corners = [[3.0, 4.0], [90.0, 10.0], [80.0, 70.0], [-5.0, 60.0]];
        let there = Projection::of_square(corners).expect("corners");
        for (from, to) in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].into_iter().zip(corners) {
            let (at, back) = (there.place(from), there.inverse().place(to));
            let off = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]);
            assert!(off(at, to) < 1e-9 && off(back, from) < 1e-9, "{from:?} {at:?} {back:?}");
        }
        // A direction is that of a short way.
        let (from, way) = ([0.3, 0.6], [0.8, -0.6]);
        let ends = [there.place(from), there.place([from[0] + way[0] * 1e-6, from[1] + way[1] * 1e-6])];
        let direction = there.direction(from, way);
        let cross = direction[0] * (ends[1][1] - ends[0][1]) - direction[1] * (ends[1][0] - ends[0][0]);
        assert!(cross.abs() < 1e-6 * libm::hypot(direction[0], direction[1]), "{cross}");
        assert!(Projection::of_square([[0.0, 0.0]; 4]).is_none());
    }
}
