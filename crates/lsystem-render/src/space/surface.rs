//! The surface of a stick: the points where lines of sight meet the surface, and the light there.

use super::lanes::{LANES, Lanes};
use super::light::{LIGHT, Light, LightKind, LocalLight};
use super::stroke::Stick;
use lsystem_drawing::rotation::Vector;

/// The surface of a stick on a tile. Places are relative to the middle of its first end.
pub(super) struct Surface<'a> {
    ink: [f32; 3],
    spots: &'a [LocalLight; 2],
    /// The depths of the ends.
    d0: f32,
    d1: f32,
    /// The unit vector along the axis in the picture, and the length of the axis in the picture.
    ex: f32,
    ey: f32,
    flat: f32,
    /// 1 / `flat`.
    per: f32,
    /// The change of depth, and of the place in the picture, for each unit of the axis' length.
    rise: f32,
    level: f32,
    /// `rise` / `level`, and 1 / `level`.
    slope: f32,
    steep: f32,
    /// The radius of the first end, and the second radius minus the first.
    radius: f32,
    grows: f32,
    /// The products of the light's direction with the parts of the normal: sideways, upwards, ahead, towards the
    /// viewer.
    side_light: f32,
    up_light: f32,
    ahead_light: f32,
    view_light: f32,
    /// The products of the direction up with these parts.
    up: [f32; 4],
}

impl<'a> Surface<'a> {
    /// The surface of a stick of this `length`, whose axis is `flat` long in the picture.
    #[inline(always)]
    pub(super) fn new(stick: &'a Stick, [flat, length]: [f64; 2], up: Vector) -> Self {
        let [[x0, y0, d0], [x1, y1, d1]] = stick.ends;
        let [ex, ey] = [(x1 - x0) / flat, (y1 - y0) / flat];
        let [rise, level] = [(d1 - d0) / length, flat / length];
        // The normal of the side is `u` sideways and `h` upwards; of the round ends also `w` ahead.
        let products = |[x, y, z]: Vector| {
            let ahead = x * ex + y * ey;
            [y * ex - x * ey, ahead * rise - level * z, ahead, -z].map(|product| product as f32)
        };
        let [side_light, up_light, ahead_light, view_light] = products(LIGHT);
        let [d0, d1, ex, ey] = [d0, d1, ex, ey].map(|c| c as f32);
        let [flat, rise, level] = [flat, rise, level].map(|c| c as f32);
        let [r0, r1] = stick.radii.map(|r| r as f32);
        let (per, slope, steep) = (1.0 / flat, rise / level, 1.0 / level);
        let grows = r1 - r0;
        Self {
            ink: stick.ink,
            spots: &stick.spots,
            d0,
            d1,
            ex,
            ey,
            flat,
            per,
            rise,
            level,
            slope,
            steep,
            radius: r0,
            grows,
            side_light,
            up_light,
            ahead_light,
            view_light,
            up: products(up),
        }
    }

    /// The unit vector along the axis in the picture, and the length of the axis in the picture.
    #[inline(always)]
    pub(super) fn axis(&self) -> ([f32; 2], f32) {
        ([self.ex, self.ey], self.flat)
    }

    /// A lower bound of the depth, given the larger of the two radii.
    #[inline(always)]
    pub(super) fn near(&self, widest: f32) -> f32 {
        self.d0.min(self.d1) - widest
    }

    /// Paints the samples at `x` of a row at `y`, as far as they are before `last` and the surface is nearer than their
    /// depths.
    #[inline(always)]
    pub(super) fn paint(
        &self,
        (x, last): (Lanes, Lanes),
        y: f32,
        (depths, colours): (&mut [f32; LANES], &mut [u32; LANES]),
        light: &Light,
    ) {
        let Self { d0, d1, ex, ey, flat, per, .. } = *self;
        let along = x * ex + y * ey;
        let sideways = x * -ey + y * ex;
        let radius = (along * per).at_least(0.0).at_most(1.0) * self.grows + self.radius;
        let inverse = radius.inverse();
        let u = sideways * inverse;
        let rest = Lanes::all(1.0) - u * u;
        let h = rest.root();
        let bulge = radius * h;
        let met = along - bulge * self.rise;
        let depth = Lanes(*depths);
        let before = met.below(Lanes::all(0.0));
        let beyond = Lanes::all(flat).below(met);
        let mut shown = Lanes::all(-1e-6).below(rest).and(x.below(last));
        let mut surface = along * self.slope + d0 - bulge * self.steep;
        let mut t = met * per;
        let mut to_light = u * self.side_light + h * self.up_light;
        let mut to_view = h * self.level;
        let [side_up, up_up, ahead_up, view_up] = self.up;
        let mut to_sky = u * side_up + h * up_up;
        if before.any() || beyond.any() {
            // The line of sight meets the ball at an end.
            let end = before.with(beyond);
            let start = Lanes::all(0.0).or(before, Lanes::all(flat));
            let w = (along - start) * inverse;
            let inside = rest - w * w;
            let top = inside.root();
            let cap = Lanes::all(d0).or(before, Lanes::all(d1)) - radius * top;
            surface = cap.or(end, surface);
            shown = shown.and(Lanes::all(-1e-6).below(inside.or(end, rest)));
            t = (start * per).or(end, t);
            to_light = (w * self.ahead_light + u * self.side_light + top * self.view_light).or(end, to_light);
            to_view = top.or(end, to_view);
            to_sky = (w * ahead_up + u * side_up + top * view_up).or(end, to_sky);
        }
        shown = shown.and(surface.below(depth));
        if !shown.any() {
            return;
        }
        *depths = surface.or(shown, depth).0;
        let colour = match light.kind {
            LightKind::None => return,
            LightKind::Simple => light.surfaces(self.ink, self.spots, t, to_light, to_view),
            LightKind::Full => light.full_surfaces(self.ink, self.spots, t, [to_light, to_view, to_sky]),
        };
        for ((old, new), shown) in colours.iter_mut().zip(colour).zip(shown.0) {
            *old = (new & shown) | (*old & !shown);
        }
    }
}
