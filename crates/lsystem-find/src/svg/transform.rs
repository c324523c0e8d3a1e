//! Affine maps of the plane.

use std::str::FromStr;

/// The map of x, y to a x + c y + e, b x + d y + f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform([f64; 6]);

impl Transform {
    pub(super) fn new(a: f64, b: f64, c: f64, d: f64, e: f64, f: f64) -> Self {
        Self([a, b, c, d, e, f])
    }

    pub(super) fn moved(x: f64, y: f64) -> Self {
        Self::new(1.0, 0.0, 0.0, 1.0, x, y)
    }

    /// The transform of an attribute, or none if the text is none.
    pub(super) fn read(text: &str) -> Option<Self> {
        let svgtypes::Transform { a, b, c, d, e, f } = svgtypes::Transform::from_str(text).ok()?;
        Some(Self::new(a, b, c, d, e, f))
    }

    /// First `inner`, then this one.
    pub(super) fn after(self, inner: Self) -> Self {
        let [a, b, c, d, e, f] = self.0;
        let [p, q, r, s, t, u] = inner.0;
        let [t, u] = [a * t + c * u + e, b * t + d * u + f];
        Self::new(a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, t, u)
    }

    pub(super) fn of(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d, e, f] = self.0;
        [a * x + c * y + e, b * x + d * y + f]
    }

    /// The side of a unit square's image, if that were a square.
    pub(super) fn scale(self) -> f64 {
        let [a, b, c, d, ..] = self.0;
        (a * d - b * c).abs().sqrt()
    }
}
