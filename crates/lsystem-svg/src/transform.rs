//! Affine maps of the plane.

use lsystem_syntax::Heading;
use svgtypes::{TransformListParser, TransformListToken};

/// The map of x, y to a x + c y + e, b x + d y + f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Transform([f64; 6]);

impl Transform {
    pub(crate) fn new(a: f64, b: f64, c: f64, d: f64, e: f64, f: f64) -> Self {
        Self([a, b, c, d, e, f])
    }

    pub(crate) fn moved(x: f64, y: f64) -> Self {
        Self::new(1.0, 0.0, 0.0, 1.0, x, y)
    }

    /// The transform of an attribute, or none if the text is none.
    pub(crate) fn read(text: &str) -> Option<Self> {
        let mut whole = Self::moved(0.0, 0.0);
        for part in TransformListParser::from(text) {
            whole = whole.after(match part.ok()? {
                TransformListToken::Matrix { a, b, c, d, e, f } => Self::new(a, b, c, d, e, f),
                TransformListToken::Translate { tx, ty } => Self::moved(tx, ty),
                TransformListToken::Scale { sx, sy } => Self::new(sx, 0.0, 0.0, sy, 0.0, 0.0),
                TransformListToken::Rotate { angle } => {
                    let (cos, sin) = Heading::from_degrees(angle).cos_sin();
                    Self::new(cos, sin, -sin, cos, 0.0, 0.0)
                }
                TransformListToken::SkewX { angle } => {
                    Self::new(1.0, 0.0, libm::tan(angle.to_radians()), 1.0, 0.0, 0.0)
                }
                TransformListToken::SkewY { angle } => {
                    Self::new(1.0, libm::tan(angle.to_radians()), 0.0, 1.0, 0.0, 0.0)
                }
            });
        }
        Some(whole)
    }

    /// First `inner`, then this one.
    pub(crate) fn after(self, inner: Self) -> Self {
        let [a, b, c, d, e, f] = self.0;
        let [p, q, r, s, t, u] = inner.0;
        let [t, u] = [a * t + c * u + e, b * t + d * u + f];
        Self::new(a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, t, u)
    }

    pub(crate) fn of(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d, e, f] = self.0;
        [a * x + c * y + e, b * x + d * y + f]
    }

    /// The side of a unit square's image, if that were a square.
    pub(crate) fn scale(self) -> f64 {
        let [a, b, c, d, ..] = self.0;
        (a * d - b * c).abs().sqrt()
    }
}
