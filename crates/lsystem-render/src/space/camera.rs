//! The camera: the view of a drawing in space.

use crate::Viewport;
use lsystem_drawing::rotation::{Vector, dot, minus, norm};
use lsystem_drawing::{Drawing, Solid};

/// A view of a drawing in space: the eye on a sphere about a target, upright, so that +y of the model is up in the
/// picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The angle of the eye around the vertical, in degrees: 0 looks from +z, 90 from +x.
    pub azimuth: f64,
    /// The angle of the eye above the level of the target, in degrees, -90 to 90.
    pub elevation: f64,
    /// 1 shows the whole drawing with a margin, from every side; 2 shows it twice as large.
    pub zoom: f64,
    /// The point in the middle of the picture, from the fitted centre, in fitted extents (the diameter of a ball around
    /// the drawing), in the directions of the model.
    pub target: [f64; 3],
    /// Whether nearer parts look larger. Without perspective the eye is infinitely far away.
    pub perspective: bool,
    /// The eye's distance from the target with perspective, in fitted extents; more than 0.
    pub distance: f64,
    /// How much the farthest parts fade into the background: 0 (not at all) to 1.
    pub fade: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            azimuth: 25.0,
            elevation: 12.0,
            zoom: 1.0,
            target: [0.0; 3],
            perspective: true,
            distance: DISTANCE,
            fade: 0.2,
        }
    }
}

impl Camera {
    /// The eye's distance from the target, in the unit of the radius of the ball around the drawing.
    fn eye(&self, radius: f64) -> f64 {
        let distance = if self.distance.is_finite() && self.distance > 0.0 { self.distance } else { DISTANCE };
        if self.perspective { 2.0 * distance * radius } else { f64::INFINITY }
    }
}

/// Device pixels in one fitted extent at zoom 1, on the plane through the target that faces the eye.
#[must_use]
pub(crate) fn fitted_scale(drawing: &Drawing<Solid>, viewport: Viewport, camera: &Camera) -> f64 {
    SpaceFraming::of_root(drawing).fitted_scale(viewport, camera)
}

/// The directions right and up in the picture and towards the eye, as unit vectors of the model.
#[must_use]
pub fn camera_axes(camera: &Camera) -> [[f64; 3]; 3] {
    let angle = |degrees: f64| if degrees.is_finite() { degrees.to_radians() } else { 0.0 };
    let (azimuth, elevation) = (angle(camera.azimuth), angle(camera.elevation.clamp(-90.0, 90.0)));
    let (sa, ca) = (libm::sin(azimuth), libm::cos(azimuth));
    let (se, ce) = (libm::sin(elevation), libm::cos(elevation));
    [[ca, 0.0, -sa], [-se * sa, ce, -se * ca], [ce * sa, se, ce * ca]]
}

/// The start and the end of the segment `number` (0-based), from the fitted centre, in fitted extents (the diameter of
/// a ball around the drawing), in the directions of the model, as [`Camera::target`]; `None` after the last segment.
#[must_use]
pub(crate) fn fitted_ends(drawing: &Drawing<Solid>, number: u128) -> Option<[[f64; 3]; 2]> {
    let (centre, radius) = ball(drawing);
    let segment = drawing.segments_from(number).next()?;
    let unit = drawing.unit();
    let sign = unit.signum();
    Some(
        [segment.from, segment.to]
            .map(|end| [0, 1, 2].map(|i| sign * ((end[i] - drawing.start[i]) / unit - centre[i]) / (2.0 * radius))),
    )
}

/// The vertices of the polygon `number` (0-based, in the order in which polygons are opened), in the coordinates of
/// [`fitted_ends`]. Each vertex is joined to the next and the last to the first. Empty after the last polygon.
#[must_use]
pub(crate) fn fitted_polygon(drawing: &Drawing<Solid>, number: u128) -> Vec<[f64; 3]> {
    let Some((polygon, frame)) = drawing.polygon(number) else { return vec![] };
    let (centre, radius) = ball(drawing);
    let sign = drawing.unit().signum();
    let fitted = |vertex: Vector| [0, 1, 2].map(|i| sign * (frame.transform(vertex)[i] - centre[i]) / (2.0 * radius));
    drawing.vertices_of(polygon).iter().map(|&vertex| fitted(vertex)).collect()
}

/// The centre and the radius of the ball around a drawing, in units of its root block. The radius is not 0: an empty
/// drawing, or one that is only a point, has a ball with a diameter of one step.
fn ball(drawing: &Drawing<Solid>) -> (Vector, f64) {
    let root = drawing.root.and_then(|id| drawing.blocks.get(id.0 as usize));
    // The root's hull is exact to a hundredth only.
    let (centre, radius) = drawing.extent().map_or(([0.0; 3], 0.0), |extent| (extent.centre(), extent.radius));
    let step = libm::scalbn(0.5, -root.map_or(0, |root| root.exponent));
    (centre, if radius > 0.0 { radius } else { step })
}

/// The usual distance of the eye from the target, in fitted extents.
const DISTANCE: f64 = 2.0;
/// The steps in which half a ring is sampled.
const RING_STEPS: u32 = 12;
/// Parts nearer to the eye than this part of the target's distance are not shown.
pub(super) const NEAR: f64 = 0.05;

/// Maps the root block's frame to the picture. Places are in samples: x to the right, y down, and z away from the eye,
/// 0 at the target. The origin of x and y is the middle of the picture before perspective, and the upper left corner
/// after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lens {
    /// The place of the root block's origin before perspective, from the middle of the picture.
    pub origin: Vector,
    /// The root block's unit vectors.
    pub axes: [Vector; 3],
    /// 1 / the eye's distance from the target; 0 without perspective.
    pub nearness: f64,
    /// The middle of the picture.
    pub middle: [f64; 2],
    /// Samples in one step length, at the target.
    pub step: f64,
    /// The centre of the ball around the drawing before perspective, from the middle of the picture.
    pub centre: Vector,
    /// The radius of that ball.
    pub radius: f64,
    /// Samples in one fitted extent at this zoom.
    pub extent: f64,
    /// The unit vector up in the model, before perspective.
    pub up: Vector,
}

/// How far a ring about the upright axis reaches to the side, and up or down, in the picture. `aside` is the radius of
/// the ring and `height` its height. `upright` and `back` are the parts of the model's vertical that lead up in the
/// picture and to the eye. `distance` is the eye's distance from the target.
fn reach([aside, height]: [f64; 2], [upright, back]: [f64; 2], distance: f64) -> [f64; 2] {
    let mut reach = [0.0_f64; 2];
    for step in 0..=RING_STEPS {
        let angle = core::f64::consts::PI * f64::from(step) / f64::from(RING_STEPS);
        let (side, near) = (aside * libm::sin(angle), aside * libm::cos(angle));
        let larger = 1.0 / (1.0 - (height * back + near * upright) / distance).max(NEAR);
        reach = [reach[0].max(side * larger), reach[1].max(((height * upright - near * back) * larger).abs())];
    }
    reach
}

/// The least room for a drawing at zoom 1: a ball around it, and circles about its upright axis that contain it in their
/// convex hull.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SpaceFraming {
    /// The centre of the ball.
    centre: Vector,
    /// The radius of the ball.
    radius: f64,
    /// The width of the widest stroke.
    pad: f64,
    /// The circles: their radii, and their heights above the centre.
    rings: Vec<[f64; 2]>,
}

impl SpaceFraming {
    /// The framing in model units.
    pub(crate) fn of(drawing: &Drawing<Solid>) -> Self {
        let Self { centre, radius, pad, rings } = Self::of_root(drawing);
        let unit = drawing.unit();
        let size = unit.abs();
        Self {
            centre: [0, 1, 2].map(|axis| drawing.start[axis] + unit * centre[axis]),
            radius: size * radius,
            pad: size * pad,
            rings: rings.iter().map(|ring| ring.map(|part| size * part)).collect(),
        }
    }

    /// The framing in units of the root block; heights are upwards in the picture.
    fn of_root(drawing: &Drawing<Solid>) -> Self {
        let root = drawing.root.and_then(|id| drawing.blocks.get(id.0 as usize));
        let sign = if drawing.step < 0.0 { -1.0 } else { 1.0 };
        let (centre, radius) = ball(drawing);
        let pad = root.map_or(0.0, |root| libm::scalbn(root.widest.of(drawing.width).max(0.0), -root.exponent));
        let girth = drawing.extent().and_then(|extent| extent.girth);
        let ball = [[radius, 0.0], [0.0, radius], [0.0, -radius]];
        let rings = girth.as_ref().map_or(&ball[..], |girth| girth);
        let rings = rings.iter().map(|&[aside, height]| [aside, sign * height]).collect();
        Self { centre, radius, pad: if pad.is_finite() { pad } else { 0.0 }, rings }
    }

    /// Pixels in one unit at zoom 1, at the target.
    fn scale(&self, viewport: Viewport, camera: &Camera) -> f64 {
        let [_, up, back] = camera_axes(camera);
        let distance = camera.eye(self.radius);
        let sides = self.rings.iter().map(|&ring| reach(ring, [up[1], back[1]], distance));
        let sides = sides.fold([0.0_f64; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
        let [across, down] = sides.map(|side| (2.0 * side + self.pad).max(1e-3 * self.radius));
        let [width, height] = viewport.usable();
        (width / across).min(height / down)
    }

    /// Pixels in one fitted extent at zoom 1, at the target.
    pub(crate) fn fitted_scale(&self, viewport: Viewport, camera: &Camera) -> f64 {
        2.0 * self.radius * self.scale(viewport, camera)
    }

    /// The camera on a drawing with the framing `own` that shows the same part of space as `camera` on this one.
    pub(crate) fn hold(&self, own: &Self, viewport: Viewport, camera: &Camera) -> Camera {
        let ratio = self.radius / own.radius;
        let centre = [0, 1, 2].map(|axis| (self.centre[axis] - own.centre[axis]) / (2.0 * own.radius));
        let held = Camera {
            target: [0, 1, 2].map(|axis| centre[axis] + camera.target[axis] * ratio),
            distance: camera.distance * ratio,
            ..*camera
        };
        Camera { zoom: camera.zoom * self.scale(viewport, camera) / own.scale(viewport, &held), ..held }
    }
}

impl Lens {
    /// The lens of a camera, with `samples` along the side of a pixel.
    pub(super) fn new(drawing: &Drawing<Solid>, viewport: Viewport, camera: &Camera, samples: f64) -> Self {
        let root = drawing.root.and_then(|id| drawing.blocks.get(id.0 as usize));
        let exponent = root.map_or(0, |root| root.exponent);
        let sign = if drawing.step < 0.0 { -1.0 } else { 1.0 };
        let framing = SpaceFraming::of_root(drawing);
        let SpaceFraming { centre, radius, .. } = framing;
        let (width, height) = (f64::from(viewport.width), f64::from(viewport.height));
        let zoom = if camera.zoom.is_finite() && camera.zoom > 0.0 { camera.zoom } else { 1.0 };
        let [right, up, back] = camera_axes(camera);
        let scale = framing.scale(viewport, camera) * zoom * samples;
        let seen = |p: Vector| [dot(right, p), -dot(up, p), -dot(back, p)];
        let axes = [0, 1, 2].map(|i| {
            let mut unit = [0.0; 3];
            unit[i] = scale * sign;
            seen(unit)
        });
        let finite = |v: f64| if v.is_finite() { v } else { 0.0 };
        let target = camera.target.map(|c| finite(c) * 2.0 * radius * scale);
        let middle = seen(centre.map(|c| c * scale * sign));
        let shift = seen(target);
        let centre = shift.map(|c| -c);
        Self {
            origin: [0, 1, 2].map(|i| centre[i] - middle[i]),
            axes,
            nearness: 1.0 / (camera.eye(radius) * scale),
            middle: [width * samples / 2.0, height * samples / 2.0],
            step: libm::scalbn(scale, -exponent),
            centre,
            radius: radius * scale,
            extent: 2.0 * radius * scale,
            up: seen([0.0, 1.0, 0.0]),
        }
    }

    /// The lens of a picture without perspective from another side, around the place `focus` of this lens. `turned` has
    /// the new directions right, down and away as this lens sees them, times the scale, and `size` is the width and the
    /// height of the picture in samples.
    pub(super) fn seen_aside(&self, turned: [Vector; 3], focus: Vector, size: f64) -> Self {
        let see = |p: Vector| turned.map(|direction| dot(direction, p));
        let scale = norm(turned[0]);
        Self {
            origin: see(minus(self.origin, focus)),
            axes: self.axes.map(see),
            nearness: 0.0,
            middle: [size / 2.0; 2],
            step: self.step * scale,
            centre: see(minus(self.centre, focus)),
            radius: self.radius * scale,
            extent: self.extent * scale,
            up: see(self.up).map(|c| c / scale),
        }
    }

    /// The scale `z` samples behind the target, relative to the scale at the target.
    #[inline]
    pub(super) fn factor(&self, z: f64) -> f64 {
        1.0 / (1.0 + z * self.nearness).max(NEAR)
    }

    /// The place in the picture, and a depth behind the target that keeps straight lines straight: `z` times the scale.
    #[inline]
    pub(super) fn project(&self, [x, y, z]: Vector) -> Vector {
        let factor = self.factor(z);
        [self.middle[0] + x * factor, self.middle[1] + y * factor, z * factor]
    }

    /// The ends of the part of a line before the eye, and their places from 0 to 1 along the line; `None` if there is
    /// none.
    pub(super) fn before_eye(&self, ends: [Vector; 2]) -> Option<[(Vector, f64); 2]> {
        let [whole, other] = [(ends[0], 0.0), (ends[1], 1.0)];
        let ahead = ends.map(|end| 1.0 + end[2] * self.nearness - NEAR);
        match ahead.map(|a| a > 0.0) {
            [true, true] => Some([whole, other]),
            [false, false] => None,
            [first, _] => {
                let t = ahead[0] / (ahead[0] - ahead[1]);
                let cut = [0, 1, 2].map(|i| ends[0][i] + t * (ends[1][i] - ends[0][i]));
                Some(if first { [whole, (cut, t)] } else { [(cut, t), other] })
            }
        }
    }
}
