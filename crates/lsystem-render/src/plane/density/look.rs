//! The size of things in a picture of sums, and how much ink blocks lay down at that size.

use super::ink::{Ink, turned};
use crate::plane::Amount;
use crate::plane::descent::Node;

/// The size of things in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Look {
    /// The smallest stroke width, in pixels.
    pub hairline: f64,
    /// Pixels in one step length.
    pub step: f64,
    /// Pixels in one unit of the root block.
    pub scale: f64,
}

impl Look {
    /// The width of a stroke, in pixels.
    #[inline]
    pub(super) fn width(&self, width: f64) -> f64 {
        (width * self.step).max(self.hairline)
    }

    /// All ink of a block whose strokes are as wide as it is entered with: in layers, times pixels.
    #[inline]
    pub(super) fn amount(&self, ink: &Ink, node: &Node) -> Amount {
        let scale = node.place.scale.abs();
        ink.length.times(scale).times(self.width(node.pen.width)).plus(ink.area.times(scale).times(scale))
    }

    /// How the ink of a block lies about its centre, in pixels, up and to the right: the mean of x x, x y and y y. What its
    /// strokes reach across, as wide as it is entered with, counts as what they reach along.
    #[inline]
    pub(super) fn squares(&self, ink: &Ink, node: &Node) -> [f64; 3] {
        let (cos, sin) = node.place.heading.cos_sin();
        let width = self.width(node.pen.width);
        let along = turned(ink.spread, [node.place.cos, node.place.sin]);
        let across = turned(ink.across, [cos, sin]);
        // An even distribution over a length has a twelfth of its square.
        [0, 1, 2].map(|i| along[i] + width * width / 12.0 * across[i])
    }
}
