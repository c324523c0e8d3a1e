//! Where a node is in the picture.

use super::camera::{Lens, NEAR};
use super::scene::{Link, SAMPLES, direction};
use lsystem_drawing::rotation::{Vector, combine, dot};

/// Where a node is, as the lens sees it before perspective.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub origin: Vector,
    pub axes: [Vector; 3],
    /// The length of the axes.
    pub scale: f64,
}

impl Place {
    /// Where the root of a drawing is.
    pub(super) fn root(lens: &Lens) -> Self {
        let Lens { origin, axes, .. } = *lens;
        Self { origin, axes, scale: dot(axes[0], axes[0]).sqrt() }
    }

    /// Where a node inside this one is.
    #[inline]
    pub(super) fn inside(&self, link: &Link) -> Self {
        if link.same {
            return *self;
        }
        let axes = link.axes.map(|axis| combine(&self.axes, axis));
        Self { origin: self.lie(link.at), axes, scale: dot(axes[0], axes[0]).sqrt() }
    }

    /// Where a point of the node is.
    #[inline]
    pub(super) fn lie(&self, point: Vector) -> Vector {
        let [x, y, z] = combine(&self.axes, point);
        [self.origin[0] + x, self.origin[1] + y, self.origin[2] + z]
    }

    /// How much larger than at the target things look at a depth of the picture.
    #[inline]
    pub(super) fn scale_at(&self, lens: &Lens, depth: f32) -> f64 {
        // Depth is z / (1 + z n), so 1 / (1 + z n) is 1 - depth n.
        (1.0 - f64::from(depth) * lens.nearness).clamp(0.0, 1.0 / NEAR)
    }

    /// The samples of the node in order, those that face the viewer first.
    pub(super) fn facing(&self, count: usize) -> [u8; SAMPLES] {
        let view = self.axes.map(|axis| -axis[2]);
        let mut order = [0; SAMPLES];
        let mut scores = [0.0; SAMPLES];
        for k in 0..count {
            let score = dot(direction(k, count), view);
            let mut at = k;
            while at > 0 && scores[at - 1] < score {
                (scores[at], order[at]) = (scores[at - 1], order[at - 1]);
                at -= 1;
            }
            (scores[at], order[at]) = (score, k as u8);
        }
        order
    }
}
