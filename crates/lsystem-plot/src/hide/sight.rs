//! Lines between places on the sheet, with their depths in millimetres, which grow towards the viewer.

/// A point of the sheet and its depth.
pub(super) type Place = [f64; 3];

/// A line between two places, with the quantities that every test needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    pub(super) from: Place,
    pub(super) way: Place,
    /// The square of the length on the sheet; above 0 but for tests in space.
    pub(super) square: f64,
    /// The greatest depth.
    pub(super) top: f64,
    /// The least depth.
    pub(super) bottom: f64,
}

impl Sight {
    /// The line between two places; `None` if they are one point of the sheet.
    pub(super) fn new(ends: [Place; 2]) -> Option<Self> {
        Some(Self::through(ends)).filter(|line| line.square > 0.0)
    }

    /// The line between two places, for tests in space.
    pub(super) fn through([from, to]: [Place; 2]) -> Self {
        let way = minus(to, from);
        let square = way[0] * way[0] + way[1] * way[1];
        let [top, bottom] = [from[2].max(to[2]), from[2].min(to[2])];
        Self { from, way, square, top, bottom }
    }

    pub(super) fn at(&self, place: f64) -> Place {
        [0, 1, 2].map(|axis| self.from[axis] + place * self.way[axis])
    }
}

pub(super) fn minus(a: Place, b: Place) -> Place {
    [0, 1, 2].map(|axis| a[axis] - b[axis])
}

pub(super) fn cross(a: Place, b: Place) -> Place {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
