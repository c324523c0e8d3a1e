//! The light on strokes.
//!
//! A fixed light comes from the viewer's upper left. A stroke is lit as a round stick. A stroke is also brighter on the
//! side of the drawing that faces the light, and darker inside the drawing, as leaves in a crown are. Edges of sticks
//! are lighter on a dark background and darker on a light one.
//!
//! The light is a polynomial of the normal. So the mean light on many sticks, in a block too small to see, follows from
//! the mean of their directions.
//!
//! In a picture with shadows the colour of a sample is that in full light, and its highest byte is the part that comes
//! from the sun. Shadows and haze are added when the samples become pixels.

use super::camera::Lens;
use super::lanes::{LANES, Lanes};
use lsystem_drawing::rotation::{Vector, dot};
use lsystem_syntax::Style;

/// The direction towards the light, a unit vector: x to the right, y down, z away from the viewer.
pub(super) const LIGHT: Vector = [-0.48, -0.64, -0.6];
/// The share of the stroke's own normal in the light. The rest depends on the place in the drawing.
const OWN: f32 = 0.7;
/// The brightness without light.
const AMBIENT: f32 = 0.54;
/// The brightness that the light adds at most.
const DIFFUSE: f32 = 0.9;
/// The strength of the highlight.
const GLOSS: f32 = 0.16;
/// The part of the light that is missing in the middle of the drawing.
const SHADE: f32 = 0.25;
/// The change of brightness at edges on a light background.
const EDGE_DARK: f32 = -0.3;
/// The change of brightness at edges on a dark background.
const EDGE_LIGHT: f32 = 0.42;
/// How much brighter the sky makes a surface that faces up, in full light; a surface that faces down is as much darker.
const SKY: f32 = 0.16;
/// The brightness of sunlight that comes through a leaf.
const THROUGH: f32 = 0.8;
/// The tint of sunlight that comes through a leaf: warm and lighter.
const THROUGH_TINT: [f32; 3] = [1.3, 1.22, 0.75];
/// The mean height of a unit half circle, and the mean of its square.
const HEIGHT: f32 = core::f32::consts::FRAC_PI_4;
const HEIGHT_2: f32 = 2.0 / 3.0;

/// The light of a picture.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Light {
    pub(super) background: [f32; 3],
    edge: f32,
    fade: f32,
    /// 1 / the radius of the ball around the drawing, in samples.
    inverse: f64,
    centre: Vector,
    pub(super) kind: LightKind,
    /// The part of full light, by channel, in simple light.
    pub(super) dim: [f32; 3],
    /// The unit vector up in the model, as the lens sees it.
    pub(super) up: Vector,
}

/// The kinds of a picture's light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum LightKind {
    /// The samples of depth pictures have no colours.
    #[default]
    None,
    /// Colours as they are shown.
    Simple,
    /// Full light without shadows. Samples keep the part of their light that comes from the sun.
    Full,
}

/// The light at a place in the drawing.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalLight {
    /// How much the place faces the light: -0.3 to 0.3.
    facing: f32,
    /// The part of the light that reaches the place.
    open: f32,
    /// The part of the background in the colour.
    pub(super) haze: f32,
}

/// The mean of the directions of many sticks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Bundle {
    /// The mean of the products of direction vectors' coordinates: xx, yy, zz, xy, xz, yz.
    pub spread: [f32; 6],
}

impl Light {
    pub(super) fn new(style: &Style, lens: &Lens, fade: f64, kind: LightKind) -> Self {
        let [r, g, b] = style.background.rgb.map(f32::from);
        let dark = 0.3 * r + 0.59 * g + 0.11 * b < 110.0;
        Self {
            background: [r, g, b],
            edge: if dark { EDGE_LIGHT } else { EDGE_DARK },
            fade: if fade.is_finite() { fade.clamp(0.0, 1.0) as f32 } else { 0.0 },
            inverse: 1.0 / lens.radius,
            centre: lens.centre,
            kind,
            dim: [1.0; 3],
            up: lens.up,
        }
    }

    /// The light at a place, as the lens sees the place before perspective.
    #[inline]
    pub(super) fn spot(&self, at: Vector) -> LocalLight {
        let [x, y, z] = [0, 1, 2].map(|i| ((at[i] - self.centre[i]) * self.inverse) as f32);
        let out = (x * x + y * y + z * z).min(1.0);
        let facing = -(x * 0.48 + y * 0.64 + z * 0.6);
        LocalLight {
            facing: facing.clamp(-1.0, 1.0) * (1.0 - OWN),
            open: 1.0 - SHADE * (1.0 - out),
            haze: self.haze(z),
        }
    }

    /// The part of the background in a colour at the distance `z` behind the centre of the drawing, in radii.
    #[inline]
    fn haze(&self, z: f32) -> f32 {
        let depth = (0.5 + 0.5 * z).clamp(0.0, 1.0);
        self.fade * depth * (0.55 + 0.4 * depth)
    }

    /// As [`Light::haze`], at a distance behind the target in samples.
    #[inline]
    pub(super) fn haze_at(&self, z: f32) -> f32 {
        self.haze((z - self.centre[2] as f32) * self.inverse as f32)
    }

    /// The colour of a surface; `light` and `view` are the scalar products of its normal with the directions towards
    /// the light and the viewer.
    #[inline]
    pub(super) fn surface(&self, ink: [f32; 3], spot: &LocalLight, light: f32, view: f32) -> u32 {
        let wrap = 0.5 + 0.5 * (OWN * light + spot.facing);
        let square = wrap * wrap;
        let fourth = square * square;
        let edge = (1.0 - view) * (1.0 - view);
        self.colour(ink, spot, square, fourth * fourth, edge)
    }

    /// The colour of a flat surface, such as a leaf, in full light. The unit vector `normal` points to the viewer.
    pub(super) fn leaf(&self, ink: [f32; 3], spot: &LocalLight, normal: Vector) -> u32 {
        let [light, up] = [LIGHT, self.up].map(|direction| dot(normal, direction) as f32);
        let wrap = 0.5 + 0.5 * (OWN * light.abs() + spot.facing);
        let sun = if light < 0.0 { THROUGH } else { 1.0 } * DIFFUSE * wrap * wrap * spot.open;
        let sky = AMBIENT * (1.0 + SKY * up) * spot.open;
        let tint = if light < 0.0 { THROUGH_TINT } else { [1.0; 3] };
        let lit = [0, 1, 2].map(|i| ink[i] * (sky + sun * tint[i]));
        pack(lit, sun / (sun + sky))
    }

    /// As [`Light::surfaces`], in full light; `up` is the scalar product of the normal with the direction up.
    #[inline(always)]
    pub(super) fn full_surfaces(
        &self,
        ink: [f32; 3],
        [from, to]: &[LocalLight; 2],
        t: Lanes,
        [light, view, up]: [Lanes; 3],
    ) -> [u32; LANES] {
        let mix = |a: f32, b: f32| t * (b - a) + a;
        let (facing, open) = (mix(from.facing, to.facing), mix(from.open, to.open));
        let wrap = (light * OWN + facing) * 0.5 + 0.5;
        let square = wrap * wrap;
        let fourth = square * square;
        let away = Lanes::all(1.0) - view;
        let (sun, sky) = (square * DIFFUSE, up * (AMBIENT * SKY) + AMBIENT);
        let strength = (sun + sky) * open * (away * away * self.edge + 1.0);
        let shine = fourth * fourth * (255.0 * GLOSS) * open;
        let part = sun * (sun + sky).inverse();
        let mut packed = (part * 255.0).bytes().map(|part| part << 24);
        for (i, ink) in ink.iter().enumerate() {
            let bytes = (strength * *ink + shine).at_least(0.0).at_most(255.0).bytes();
            packed.iter_mut().zip(bytes).for_each(|(packed, byte)| *packed |= byte << (8 * i));
        }
        packed
    }

    /// As [`Light::surface`], for several samples of a stroke at `t`, from 0 at its first end to 1 at the other.
    #[inline(always)]
    pub(super) fn surfaces(
        &self,
        ink: [f32; 3],
        [from, to]: &[LocalLight; 2],
        t: Lanes,
        light: Lanes,
        view: Lanes,
    ) -> [u32; LANES] {
        let mix = |a: f32, b: f32| t * (b - a) + a;
        let (facing, open, haze) = (mix(from.facing, to.facing), mix(from.open, to.open), mix(from.haze, to.haze));
        let wrap = (light * OWN + facing) * 0.5 + 0.5;
        let square = wrap * wrap;
        let fourth = square * square;
        let away = Lanes::all(1.0) - view;
        let strength = (square * DIFFUSE + AMBIENT) * open * (away * away * self.edge + 1.0);
        let shine = fourth * fourth * (255.0 * GLOSS) * open;
        let mut packed = [0xff00_0000; LANES];
        for (i, (ink, background)) in ink.iter().zip(self.background).enumerate() {
            let lit = (strength * *ink + shine) * self.dim[i];
            let hazy = lit + (Lanes::all(background) - lit) * haze;
            let bytes = hazy.at_least(0.0).at_most(255.0).bytes();
            packed.iter_mut().zip(bytes).for_each(|(packed, byte)| *packed |= byte << (8 * i));
        }
        packed
    }

    /// The mean colour of many sticks at one place. `view` and `light` are unit vectors towards the viewer and the
    /// light, in the frame of the sticks.
    #[inline]
    pub(super) fn bundle(
        &self,
        ink: [f32; 3],
        spot: &LocalLight,
        bundle: &Bundle,
        view: [f32; 3],
        light: [f32; 3],
    ) -> u32 {
        let [xx, yy, zz, xy, xz, yz] = bundle.spread;
        let spread =
            |[x, y, z]: [f32; 3]| [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z];
        let product = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let of_view = spread(view);
        // The mean squared cosine of the angle between sticks and view.
        let end_on = product(of_view, view);
        let rise = (1.0 - end_on).max(1e-3).sqrt();
        let up = (product(view, light) - product(of_view, light)) / rise;
        let side = (1.0 - product(spread(light), light) - up * up).max(0.0);
        let mean = OWN * HEIGHT * up;
        let square = OWN * OWN * (side * (1.0 - HEIGHT_2) + up * up * HEIGHT_2);
        let facing = spot.facing;
        let wrap = 0.25 * (1.0 + 2.0 * (mean + facing) + square + 2.0 * mean * facing + facing * facing);
        let edge = 1.0 - 2.0 * HEIGHT * rise + HEIGHT_2 * rise * rise;
        let fourth = wrap * wrap;
        self.colour(ink, spot, wrap, fourth * fourth * 1.4, edge)
    }

    #[inline]
    fn colour(&self, ink: [f32; 3], spot: &LocalLight, diffuse: f32, gloss: f32, edge: f32) -> u32 {
        let strength = (AMBIENT + DIFFUSE * diffuse) * spot.open * (1.0 + self.edge * edge);
        let shine = 255.0 * GLOSS * gloss * spot.open;
        if self.kind == LightKind::Full {
            return pack(ink.map(|ink| ink * strength + shine), DIFFUSE * diffuse / (AMBIENT + DIFFUSE * diffuse));
        }
        let mut packed = 0xff00_0000;
        for (i, (ink, background)) in ink.iter().zip(self.background).enumerate() {
            let lit = (ink * strength + shine) * self.dim[i];
            let hazy = lit + (background - lit) * spot.haze;
            packed |= u32::from((hazy + 0.5) as u8) << (8 * i);
        }
        packed
    }
}

/// A colour in full light, 0 to 255, and the part of it that comes from the sun.
#[inline]
fn pack(lit: [f32; 3], sun: f32) -> u32 {
    let [r, g, b] = lit.map(|c| u32::from((c + 0.5) as u8));
    r | g << 8 | b << 16 | u32::from((sun * 255.0 + 0.5) as u8) << 24
}

impl LocalLight {
    /// The light between this place (`t` = 0) and another (`t` = 1).
    #[inline]
    pub(super) fn towards(&self, other: &Self, t: f32) -> Self {
        let mix = |a: f32, b: f32| a + t * (b - a);
        Self {
            facing: mix(self.facing, other.facing),
            open: mix(self.open, other.open),
            haze: mix(self.haze, other.haze),
        }
    }
}

impl Bundle {
    /// The bundle of one stick.
    pub(super) fn of(direction: Vector) -> Self {
        let square = dot(direction, direction);
        if square <= 0.0 {
            return Self { spread: [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0, 0.0, 0.0] };
        }
        let [x, y, z] = direction.map(|c| c / square.sqrt());
        Self { spread: [x * x, y * y, z * z, x * y, x * z, y * z].map(|c| c as f32) }
    }

    /// The bundle after the rotation with these columns.
    pub(super) fn turned(&self, columns: &[Vector; 3]) -> Self {
        let [xx, yy, zz, xy, xz, yz] = self.spread.map(f64::from);
        let spread = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let entry = |i: usize, j: usize| {
            let mut sum = 0.0;
            for k in 0..3 {
                for l in 0..3 {
                    sum += columns[k][i] * spread[k][l] * columns[l][j];
                }
            }
            sum as f32
        };
        Self { spread: [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)] }
    }

    /// The mean square of the sticks' parts along a direction.
    pub(super) fn along(&self, [x, y, z]: [f32; 3]) -> f32 {
        let [xx, yy, zz, xy, xz, yz] = self.spread;
        x * x * xx + y * y * yy + z * z * zz + 2.0 * (x * y * xy + x * z * xz + y * z * yz)
    }

    /// Adds another bundle, times `weight`.
    pub(super) fn add(&mut self, other: &Self, weight: f32) {
        self.spread.iter_mut().zip(other.spread).for_each(|(sum, c)| *sum += weight * c);
    }
}

/// The directions towards the light and towards the viewer.
pub(super) const DIRECTIONS: [Vector; 2] = [LIGHT, [0.0, 0.0, -1.0]];
