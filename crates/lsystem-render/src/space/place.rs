//! The place of a node in the picture.

use super::camera::{Lens, NEAR};
use super::scene::{Link, SAMPLE_STROKES, direction};
use lsystem_drawing::rotation::{Vector, combine, dot};

/// The place of a node, as the lens sees it before perspective, in samples.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub origin: Vector,
    pub axes: [Vector; 3],
    /// The length of the axes.
    pub scale: f64,
}

impl Place {
    /// The place of the root.
    pub(super) fn root(lens: &Lens) -> Self {
        let Lens { origin, axes, .. } = *lens;
        Self { origin, axes, scale: dot(axes[0], axes[0]).sqrt() }
    }

    /// The place of a node inside this node.
    #[inline]
    pub(super) fn inside(&self, link: &Link) -> Self {
        if link.same {
            return *self;
        }
        let axes = link.axes.map(|axis| combine(&self.axes, axis));
        Self { origin: self.point(link.at), axes, scale: dot(axes[0], axes[0]).sqrt() }
    }

    /// The place of a point of the node.
    #[inline]
    pub(super) fn point(&self, point: Vector) -> Vector {
        let [x, y, z] = combine(&self.axes, point);
        [self.origin[0] + x, self.origin[1] + y, self.origin[2] + z]
    }

    /// The scale at a depth of the picture, relative to the scale at the target.
    #[inline]
    pub(super) fn scale_at(&self, lens: &Lens, depth: f32) -> f64 {
        // Depth is z / (1 + z n), so 1 / (1 + z n) is 1 - depth n.
        (1.0 - f64::from(depth) * lens.nearness).clamp(0.0, 1.0 / NEAR)
    }

    /// The indices of a node's `count` sample strokes in order: strokes that face the viewer first.
    pub(super) fn facing(&self, count: usize) -> [u8; SAMPLE_STROKES] {
        let view = self.axes.map(|axis| -axis[2]);
        let mut order = [0; SAMPLE_STROKES];
        let mut scores = [0.0; SAMPLE_STROKES];
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
