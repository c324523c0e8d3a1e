//! The light of a picture at rest: ambient occlusion, shadows, the shade on the ground and haze.
//!
//! All of it follows from two depth pictures of the whole drawing, one from the eye and one from the sun. They are made
//! before the picture, with a fixed budget, and do not depend on the pane. So panes have the light of the whole picture.

use super::camera::{Camera, Lens};
use super::ground::Ground;
use super::lanes::{LANES, Lanes};
use super::light::Light;
use super::occlusion::Occlusion;
use super::picture::Picture;
use super::scene::Scene;
use super::setup::Setup;
use super::size::SAMPLE_BYTES;
use super::sun::Sun;
use super::tile::ScreenTile;
use super::{Plan, Quality};
use crate::Viewport;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Drawing, Solid};
use lsystem_syntax::Style;

#[cfg(test)]
mod tests;

/// The samples of a pixel: [`LANES`] along each side, as in the finest quality.
const ALL: f32 = (LANES * LANES) as f32;
const _: () = assert!(Quality::FINEST.samples() == LANES && Quality::BEST.samples() == LANES);
/// The most cells of the depth picture from the eye.
const MOST_CELLS: f64 = (1 << 19) as f64;
/// The most cells along a side.
const MOST_SIDE: f64 = 2048.0;
/// Surfaces of a pixel that are farther from each other than this, in samples, are lit apart.
const APART: f32 = 8.0;
/// The part of the sunlight that shadows take, by channel: shade is cool.
const SHADOW: [f32; 3] = [0.88, 0.86, 0.8];
/// The part of all light that occlusion takes, by channel.
const DARK: [f32; 3] = [0.74, 0.72, 0.68];
/// How much more saturated dark places are: light between leaves has their colour.
const VIVID: f32 = 0.45;
/// The weights of red, green and blue in brightness.
const LUMA: [f32; 3] = [0.3, 0.59, 0.11];
/// Full light is brighter than in a moving picture, so that pictures at rest are not darker on the whole.
const EXPOSURE: f32 = 1.07;
/// The colour of full shade on the ground.
const SHADE: [f32; 3] = [34.0, 40.0, 62.0];
/// The most that shade on the ground covers.
const MOST_SHADE: f32 = 0.6;
/// Pixels along the side of a block, which share the light at depths near each other. Tiles begin at blocks.
const BLOCK: usize = 2;
/// Pixels between places of a row where the shade on the ground is computed. It is interpolated between them.
const STRIDE: usize = 4;

/// The depth pictures for the light, and what follows from them.
#[derive(Default)]
pub(super) struct Lighting {
    /// The picture whose light is made, or ready.
    made: Option<(Style, Viewport, Camera)>,
    stage: Stage,
    walk: Picture,
    /// The settings of the depth picture from the sun.
    from_sun: Option<Setup>,
    occlusion: Occlusion,
    sun: Sun,
    ground: Ground,
    /// 1 / the distance of the eye, and the middle of the picture, in samples.
    nearness: f32,
    middle: [f32; 2],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stage {
    /// The depth picture from the eye.
    #[default]
    Eye,
    /// The pyramid of that picture.
    Occlusion,
    /// The depth picture from the sun.
    Sun,
    /// The shade on the ground.
    Ground,
    Ready,
}

impl Lighting {
    /// The most bytes of the light of a picture of this size.
    pub(super) fn most_bytes(viewport: Viewport) -> u64 {
        /// The bytes of a cell of the pyramid, and of all cells above it.
        const CELL: u64 = 8 + 3;
        /// The bytes of a place in the depth picture from the sun, with the shade on the ground.
        const TEXEL: u64 = 4 + 1;
        let size = Self::size(viewport).map(|cells| cells as u64);
        let [width, height] = [viewport.width, viewport.height].map(u64::from);
        // At most 1.5 times the diagonal, which is at most the sum of the sides.
        let sun = (3 * (width + height) / 2 + 16).min(Sun::MOST_SIDE);
        let room = size.map(|side| side.max(sun) + 16);
        size[0] * size[1] * CELL + sun * sun * TEXEL + room[0] * room[1] * SAMPLE_BYTES
    }

    /// Pixels along the side of a cell of the depth picture from the eye.
    fn cell(viewport: Viewport) -> f64 {
        let [width, height] = [viewport.width, viewport.height].map(f64::from);
        (width * height / MOST_CELLS).sqrt().max(width.max(height) / MOST_SIDE).max(2.0)
    }

    /// The width and the height of the depth picture from the eye, in cells.
    fn size(viewport: Viewport) -> [usize; 2] {
        let cell = Self::cell(viewport);
        [viewport.width, viewport.height].map(|pixels| ((f64::from(pixels) / cell).ceil() as usize).max(1))
    }

    /// Forgets the light, because the drawing has changed.
    pub(super) fn forget(&mut self) {
        self.made = None;
    }

    /// Starts the light of a picture, unless it is made already.
    pub(super) fn begin(&mut self, drawing: &Drawing<Solid>, plan: &Plan) {
        let Plan { style, viewport, camera, .. } = plan;
        let viewport = *viewport;
        let made = Some((style.clone(), viewport, *camera));
        if self.made == made {
            return;
        }
        self.made = made;
        self.stage = Stage::Eye;
        let samples = LANES as f64;
        let [width, height] = [viewport.width, viewport.height].map(f64::from);
        let cell = Self::cell(viewport);
        let size = Self::size(viewport);
        let lens = Lens::new(drawing, viewport, camera, 1.0 / cell);
        self.occlusion.begin(size, 1.0 / (cell * samples), lens.nearness);
        let from_eye = (lens, size, 1.0 / cell);

        let eye = Lens::new(drawing, viewport, camera, samples);
        (self.nearness, self.middle) = (eye.nearness as f32, eye.middle.map(|c| c as f32));
        let lens = self.sun.begin(&eye, [width * samples, height * samples], samples);
        let scale = samples * lens.radius / eye.radius;
        let from_sun = (lens, [self.sun.side; 2], scale);
        // Both have the same room, so that the second finds the memory of the first.
        let room = size.map(|side| side.max(self.sun.side));
        let [from_eye, from_sun] =
            [from_eye, from_sun].map(|depths| Setup::depths(drawing, style, viewport, depths, room));
        self.walk.begin_depths(from_eye);
        self.from_sun = Some(from_sun);
        let tall = drawing.extent().map_or(0.0, |extent| extent.height());
        self.ground.begin(&eye, tall, &self.sun);
    }

    /// Goes on with the light.
    pub(super) fn step(&mut self, scene: &Scene, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            match self.stage {
                Stage::Eye => {
                    if self.walk.step_depths(scene, meter) == Progress::Done {
                        self.stage = Stage::Occlusion;
                    }
                }
                Stage::Occlusion => {
                    if self.occlusion.step(&mut self.walk, meter) == Progress::Done {
                        self.stage = Stage::Sun;
                        self.from_sun.take().into_iter().for_each(|setup| self.walk.begin_depths(setup));
                    }
                }
                Stage::Sun => {
                    if self.walk.step_depths(scene, meter) == Progress::Done {
                        self.sun.take(&mut self.walk);
                        meter.charge((self.sun.side * self.sun.side) as u64 / 64);
                        self.stage = Stage::Ground;
                    }
                }
                Stage::Ground => {
                    if self.ground.step(&self.sun, meter) == Progress::Done {
                        self.stage = Stage::Ready;
                    }
                }
                Stage::Ready => return Progress::Done,
            }
        }
        Progress::More
    }

    /// Writes the pixels of a row of a tile: the mean of each pixel's samples, in their light. `at` is the place of the
    /// tile's first pixel in the whole picture. Returns the first pixel that differs from the `paper`, and the one after
    /// the last.
    pub(super) fn pixels(
        &self,
        (tile, light): (&ScreenTile, &Light),
        row: usize,
        at: [usize; 2],
        (paper, out): ([u8; 4], &mut [[u8; 4]]),
        seen: &mut SeenRow,
    ) -> [usize; 2] {
        if row.is_multiple_of(BLOCK) {
            seen.clear(out.len());
        }
        let painted = tile.painted(row, LANES).map(|end| end.min(out.len()));
        let y = at[1] + row;
        let shaded = self.ground.columns(y).map(|end| end.saturating_sub(at[0]).min(out.len()));
        let range = match [painted, shaded] {
            [a, [from, to]] if from >= to => a,
            [[from, to], b] if from >= to => b,
            [a, b] => [a[0].min(b[0]), a[1].max(b[1])],
        };
        let mut ground = GroundRow::new(self, y);
        let is_clear = paper[3] == 0;
        let background = light.background;
        let shade = [0, 1, 2].map(|i| SHADE[i].min(0.3 * background[i]));
        for (i, pixel) in out.iter_mut().enumerate().take(range[1]).skip(range[0]) {
            let samples = if (painted[0]..painted[1]).contains(&i) { Samples::of(tile, row, i) } else { None };
            let (count, sum) = match &samples {
                Some(samples) => self.lit_pixel(samples, [at[0] + i, y], light, seen.block(i)),
                None => (0.0, [0.0; 3]),
            };
            let rest = ALL - count;
            let is_shaded = rest > 0.0 && (shaded[0]..shaded[1]).contains(&i);
            let part = if is_shaded { ground.at(at[0] + i) } else { 0.0 };
            if count + part <= 0.0 {
                *pixel = paper;
                continue;
            }
            let byte = |c: f32| (c + 0.5) as u8;
            *pixel = if is_clear {
                let opaque = count + rest * part;
                let [r, g, b] = [0, 1, 2].map(|i| byte((sum[i] + rest * part * shade[i]) / opaque));
                [r, g, b, byte(opaque * (255.0 / ALL))]
            } else {
                let [r, g, b] = [0, 1, 2].map(|i| {
                    let paper = background[i] + (shade[i] - background[i]) * part;
                    byte((sum[i] + rest * paper) * (1.0 / ALL))
                });
                [r, g, b, u8::MAX]
            };
        }
        range
    }

    /// The number of painted samples of a pixel, and the sum of their colours in their light.
    #[inline]
    fn lit_pixel(&self, samples: &Samples, at: [usize; 2], light: &Light, seen: &mut [Seen; 2]) -> (f32, [f32; 3]) {
        let split = samples.split();
        if split == f32::INFINITY {
            let only = samples.of_one_colour().unwrap_or_else(|| samples.between(f32::NEG_INFINITY, split));
            return (only.count, self.lit(&only, at, light, seen));
        }
        let near = samples.between(f32::NEG_INFINITY, split);
        let sum = self.lit(&near, at, light, seen);
        let far = samples.between(split, f32::INFINITY);
        let behind = self.lit(&far, at, light, seen);
        (near.count + far.count, [0, 1, 2].map(|i| sum[i] + behind[i]))
    }

    /// The colours of the samples of a surface in their light, summed up.
    fn lit(&self, surface: &Surface, at: [usize; 2], light: &Light, seen: &mut [Seen; 2]) -> [f32; 3] {
        let depth = surface.depth / surface.count;
        let known = seen.iter().find(|known| (known.depth - depth).abs() <= APART).copied();
        let Seen { dark, hidden, haze, .. } = known.unwrap_or_else(|| {
            let new = self.look(at, depth, light);
            seen[usize::from(seen[0].depth < f32::INFINITY)] = new;
            new
        });
        let lit = [0, 1, 2].map(|i| {
            EXPOSURE * (surface.colour[i] - surface.sunlight[i] * hidden * SHADOW[i]) * (1.0 - dark * DARK[i])
        });
        let luma = lit[0] * LUMA[0] + lit[1] * LUMA[1] + lit[2] * LUMA[2];
        let vivid = 1.0 + VIVID * dark.max(0.5 * hidden);
        [0, 1, 2].map(|i| {
            let lit = (luma + (lit[i] - luma) * vivid).clamp(0.0, 255.0 * surface.count);
            lit + (surface.count * light.background[i] - lit) * haze
        })
    }

    /// The light at a depth in the middle of the block that contains a pixel.
    fn look(&self, at: [usize; 2], depth: f32, light: &Light) -> Seen {
        let [x, y] = at.map(|pixel| (LANES * (pixel / BLOCK * BLOCK) + LANES * BLOCK / 2) as f32);
        // The place before perspective.
        let z = depth / (1.0 - depth * self.nearness).max(1e-3);
        let larger = 1.0 + z * self.nearness;
        Seen {
            depth,
            dark: self.occlusion.at([x, y, depth]),
            hidden: self.sun.hidden([(x - self.middle[0]) * larger, (y - self.middle[1]) * larger, z]),
            haze: light.haze_at(z),
        }
    }
}

/// The light at a depth of a block of pixels.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Infinite if the light is not known yet.
    depth: f32,
    /// The part of the light that the surroundings take, and the part of the sun that is hidden.
    dark: f32,
    hidden: f32,
    haze: f32,
}

/// The light that the pixels of a row of blocks share, at up to two depths in each block.
#[derive(Default)]
pub(super) struct SeenRow(Vec<[Seen; 2]>);

impl SeenRow {
    /// Forgets the light, for the next row of blocks.
    fn clear(&mut self, width: usize) {
        self.0.clear();
        self.0.resize(width.div_ceil(BLOCK), [Seen { depth: f32::INFINITY, dark: 0.0, hidden: 0.0, haze: 0.0 }; 2]);
    }

    #[inline]
    fn block(&mut self, column: usize) -> &mut [Seen; 2] {
        &mut self.0[column / BLOCK]
    }
}

/// The shade on the ground in a row of pixels, which is interpolated between some of them.
struct GroundRow<'a> {
    lighting: &'a Lighting,
    y: f32,
    /// The number of the present stretch of pixels, and the shade at both of its ends.
    stretch: usize,
    ends: [f32; 2],
}

impl<'a> GroundRow<'a> {
    fn new(lighting: &'a Lighting, y: usize) -> Self {
        Self { lighting, y: LANES as f32 * (y as f32 + 0.5), stretch: usize::MAX - 1, ends: [0.0; 2] }
    }

    /// The part of the background that the shade covers.
    #[inline]
    fn at(&mut self, column: usize) -> f32 {
        let stretch = column / STRIDE;
        if stretch != self.stretch {
            let Lighting { ground, sun, .. } = self.lighting;
            let end =
                |number: usize| MOST_SHADE * ground.at([(LANES * STRIDE * number + LANES / 2) as f32, self.y], sun);
            let first = if stretch == self.stretch + 1 { self.ends[1] } else { end(stretch) };
            (self.stretch, self.ends) = (stretch, [first, end(stretch + 1)]);
        }
        self.ends[0] + (column % STRIDE) as f32 * (1.0 / STRIDE as f32) * (self.ends[1] - self.ends[0])
    }
}

/// The samples of a pixel that belong to one surface, summed up.
#[derive(Clone, Copy, Debug, Default)]
struct Surface {
    count: f32,
    depth: f32,
    /// The colours in full light, and the parts of them that come from the sun.
    colour: [f32; 3],
    sunlight: [f32; 3],
}

/// The samples of a pixel: four rows of depths and colours.
struct Samples([([f32; LANES], [u32; LANES]); LANES]);

impl Samples {
    /// The samples of a pixel of a tile; `None` if nothing is painted.
    #[inline]
    fn of(tile: &ScreenTile, row: usize, column: usize) -> Option<Self> {
        let mut rows = [([f32::INFINITY; LANES], [0; LANES]); LANES];
        let mut near = Lanes::all(f32::INFINITY);
        for (line, (depths, colours)) in rows.iter_mut().enumerate() {
            let first = (row * LANES + line) * tile.stride + column * LANES;
            depths.copy_from_slice(&tile.depth[first..first + LANES]);
            colours.copy_from_slice(&tile.colour[first..first + LANES]);
            near = near.at_most_of(Lanes(*depths));
        }
        near.below(Lanes::all(f32::INFINITY)).any().then_some(Self(rows))
    }

    /// The depth that lies between the nearest surface and those farther away; infinite if all are near each other.
    #[inline]
    fn split(&self) -> f32 {
        let (mut near, mut far) = (Lanes::all(f32::INFINITY), Lanes::all(f32::NEG_INFINITY));
        for (depths, _) in &self.0 {
            let depths = Lanes(*depths);
            near = near.at_most_of(depths);
            far = far.at_least_of(depths.or(depths.below(Lanes::all(f32::INFINITY)), far));
        }
        let near = near.0.iter().fold(f32::INFINITY, |a, b| a.min(*b));
        let far = far.0.iter().fold(f32::NEG_INFINITY, |a, b| a.max(*b));
        if far - near > APART { 0.5 * (near + far) } else { f32::INFINITY }
    }

    /// All samples, if all are painted in one colour, as inside a leaf.
    #[inline]
    fn of_one_colour(&self) -> Option<Surface> {
        let first = self.0[0].1[0];
        let mut differs = [0; LANES];
        let mut depth = Lanes::all(0.0);
        for (depths, colours) in &self.0 {
            differs.iter_mut().zip(colours).for_each(|(differs, colour)| *differs |= colour ^ first);
            depth = depth + Lanes(*depths);
        }
        let depth: f32 = depth.0.iter().sum();
        if differs != [0; LANES] || depth == f32::INFINITY {
            return None;
        }
        let [r, g, b, sun] = first.to_le_bytes().map(f32::from);
        let colour = [r, g, b].map(|c| ALL * c);
        Some(Surface { count: ALL, depth, colour, sunlight: colour.map(|c| c * sun * (1.0 / 255.0)) })
    }

    /// The samples between two depths, the first included.
    #[inline]
    fn between(&self, from: f32, to: f32) -> Surface {
        let none = Lanes::all(0.0);
        let (mut count, mut depth, mut colour, mut sunlight) = (none, none, [none; 3], [none; 3]);
        for (depths, colours) in &self.0 {
            let depths = Lanes(*depths);
            let shown = depths.below(Lanes::all(to)).without(depths.below(Lanes::all(from)));
            // Masked as bits, so that there are no branches.
            let bits: [u32; LANES] = core::array::from_fn(|i| colours[i] & shown.0[i]);
            let channel = |shift: u32| Lanes(core::array::from_fn(|i| (bits[i] >> shift & 0xff) as i32 as f32));
            count = count + Lanes(core::array::from_fn(|i| (shown.0[i] & 1) as i32 as f32));
            depth = depth + Lanes(core::array::from_fn(|i| f32::from_bits(depths.0[i].to_bits() & shown.0[i])));
            let sun = channel(24);
            for (i, (colour, sunlight)) in colour.iter_mut().zip(&mut sunlight).enumerate() {
                let own = channel(8 * i as u32);
                *colour = *colour + own;
                *sunlight = *sunlight + own * sun;
            }
        }
        let sum = |lanes: Lanes| lanes.0[0] + lanes.0[1] + (lanes.0[2] + lanes.0[3]);
        Surface {
            count: sum(count),
            depth: sum(depth),
            colour: colour.map(sum),
            sunlight: sunlight.map(|light| sum(light) * (1.0 / 255.0)),
        }
    }
}
