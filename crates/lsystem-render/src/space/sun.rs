//! Shadows: the drawing as a depth picture from the sun, whose nearest surfaces are in the light.
//!
//! The sun is the light of moving pictures, at the viewer's upper left: a drawing on a turntable turns under a fixed
//! lamp, and a picture that comes to rest keeps its lit sides.
//!
//! A place is compared with several depths around its own in that picture. The mean is the part of the sun that the
//! place sees, so that shadows have soft edges.

use super::camera::Lens;
use super::lanes::{LANES, Lanes};
use super::light::LIGHT;
use super::picture::Picture;
use lsystem_drawing::rotation::{Vector, cross, dot, norm};

/// The most texels along the side of the depth picture.
const MAX: f64 = 1024.0;
/// The reach of the picture around its middle, in halves of the diagonal of the picture from the eye.
const REACH: f64 = 1.5;
/// The radius of the disc of compared depths, in texels.
const SOFT: f32 = 4.0;
/// The offsets of the compared depths, in texels: a spiral by the golden angle.
const DISC_X: [[f32; LANES]; 3] =
    [[0.816, -1.043, 0.160, 1.314], [-2.412, 2.285, -0.764, -1.458], [3.162, -3.290, 1.586, 1.172]];
const DISC_Y: [[f32; LANES]; 3] =
    [[0.000, 0.955, -1.819, 1.714], [-0.427, -1.453, 2.843, -2.806], [1.155, 1.358, -3.389, 3.736]];
/// Surfaces up to so many texels ahead cast no shadow, so that a stick does not shade its own lit side.
const AHEAD: f32 = 2.5;
/// Surfaces so many texels farther ahead cast a full shadow.
const RAMP: f32 = 4.0;

/// The depth picture from the sun.
#[derive(Default)]
pub(super) struct Sun {
    /// Texels along a side.
    pub(super) side: usize,
    /// The depths, row by row; infinite where nothing is.
    pub(super) depths: Vec<f32>,
    /// The directions right, down and away from the sun, as the eye's lens sees them, in texels.
    pub(super) turned: [Vector; 3],
    /// Whether the picture shows only the drawing's part around the target.
    pub(super) is_partial: bool,
    /// The middle, as the eye's lens sees it.
    pub(super) focus: Vector,
    /// The same directions, and the place of the eye's origin in the depth picture.
    rows: [[f32; 3]; 3],
    base: [f32; 3],
}

impl Sun {
    /// The most texels along a side.
    pub(super) const MAX_SIDE: u64 = MAX as u64;

    /// Starts the depth picture for a picture from the eye of `size` samples with `samples` along a pixel. Returns the
    /// lens.
    pub(super) fn begin(&mut self, eye: &Lens, size: [f64; 2], samples: f64) -> Lens {
        let view = REACH * 0.5 * (size[0] * size[0] + size[1] * size[1]).sqrt();
        // A little more than the ball around the drawing, because strokes have a width.
        let ball = 1.05 * eye.radius + 4.0 * samples;
        self.is_partial = ball > view;
        self.focus = if self.is_partial { [0.0; 3] } else { eye.centre };
        let reach = ball.min(view).max(samples);
        let texel = samples.max(2.0 * reach / MAX);
        self.side = ((2.0 * reach / texel).ceil() as usize).max(1);
        let away = LIGHT.map(|c| -c);
        let right = cross(away, eye.up);
        let right = if norm(right) > 1e-3 { right } else { [1.0, 0.0, 0.0] };
        let right = right.map(|c| c / norm(right));
        let down = cross(away, right);
        self.turned = [right, down, away].map(|direction| direction.map(|c| c / texel));
        self.rows = self.turned.map(|row| row.map(|c| c as f32));
        let [x, y, z] = self.turned.map(|row| -dot(row, self.focus));
        let half = self.side as f64 / 2.0;
        self.base = [x + half, y + half, z].map(|c| c as f32);
        eye.seen_aside(self.turned, self.focus, self.side as f64)
    }

    /// Takes the finished depth picture.
    pub(super) fn take(&mut self, picture: &mut Picture) {
        self.depths.clear();
        self.depths.reserve_exact(self.side * self.side);
        for row in 0..self.side {
            self.depths.extend_from_slice(picture.depths(row, self.side));
        }
    }

    /// The place in the depth picture of a place as the eye's lens sees it.
    #[inline]
    pub(super) fn place(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        [0, 1, 2].map(|i| {
            let [across, down, away] = self.rows[i];
            self.base[i] + across * x + down * y + away * z
        })
    }

    /// The part of the sun that is hidden from a place, as the eye's lens sees it: 0 to 1. Outside the depth picture
    /// all places are in the light.
    pub(super) fn hidden(&self, at: [f32; 3]) -> f32 {
        let [x, y, z] = self.place(at);
        let far = self.side as f32 - SOFT - 1.0;
        if !(x > SOFT && y > SOFT && x < far && y < far) {
            return 0.0;
        }
        let mut sum = Lanes::all(0.0);
        let [x, y, z] = [x - 0.5, y - 0.5, z - AHEAD];
        for (dx, dy) in DISC_X.iter().zip(&DISC_Y) {
            let (column, row) = ((Lanes(*dx) + x).round(), (Lanes(*dy) + y).round());
            // At most 2^20, so single precision is exact.
            let depths = Lanes((row * self.side as f32 + column).indices().map(|at| self.depths[at]));
            sum = sum + ((Lanes::all(z) - depths) * (1.0 / RAMP)).at_least(0.0).at_most(1.0);
        }
        sum.sum() / (DISC_X.len() * LANES) as f32
    }
}
