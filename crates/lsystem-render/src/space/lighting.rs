//! The light of a picture at rest: ambient occlusion, shadows, the shade on the ground and haze.
//!
//! All of it follows from two depth pictures of the whole drawing, one from the eye and one from the sun. They are made
//! before the picture, with a fixed budget, and do not depend on the pane. So panes have the light of the whole picture.

use super::camera::Lens;
use super::ground::Ground;
use super::lanes::{LANES, Lanes};
use super::light::Light;
use super::occlusion::{Around, Occlusion};
use super::picture::Picture;
use super::plan::Plan;
use super::quality::Quality;
use super::samples::{APART, SampleRow, Surface};
use super::scene::Scene;
use super::setup::Setup;
use super::size::SAMPLE_BYTES;
use super::sun::Sun;
use super::tile::ScreenTile;
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
const MAX_CELLS: f64 = (1 << 19) as f64;
/// How many times the budget is larger if the sun does not see all of the drawing, but more of it than the eye does.
const PARTIAL: f32 = 2.0;
/// The most cells along a side.
const MAX_SIDE: f64 = 2048.0;
/// The part of the sunlight that shadows take, by channel: shade is cool.
const SHADOW: Lanes = Lanes([0.88, 0.86, 0.8, 0.0]);
/// The part of all light that occlusion takes, by channel.
const DARK: Lanes = Lanes([0.74, 0.72, 0.68, 0.0]);
/// How much more saturated dark places are: light between leaves has their colour.
const VIVID: f32 = 0.45;
/// The weights of red, green and blue in brightness.
const LUMA: Lanes = Lanes([0.3, 0.59, 0.11, 0.0]);
/// Full light is brighter than in a moving picture, so that pictures at rest are not darker on the whole.
const EXPOSURE: f32 = 1.07;
/// The colour of full shade on the ground.
const SHADE: Lanes = Lanes([34.0, 40.0, 62.0, 0.0]);
/// The most that shade on the ground covers.
const MAX_SHADE: f32 = 0.6;
/// Pixels along the side of a block, which share the light at depths near each other. Tiles begin at blocks.
const BLOCK: usize = 2;
/// Pixels along the side of a square that shares the mean surfaces around it.
const AROUND: usize = 4;
/// Pixels between places of a row where the shade on the ground is computed. It is interpolated between them.
const STRIDE: usize = 8;

/// The depth pictures for the light, and what follows from them.
#[derive(Default)]
pub(super) struct Lighting {
    /// The style of the picture whose light is made, or ready, and what its light depends on: its lens and the least width
    /// of its strokes.
    made: Option<(Style, (Lens, f64))>,
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
        /// The bytes of a place in the depth picture from the sun, with the shade on the ground.
        const TEXEL: u64 = 4 + 1;
        let size = Self::size(viewport);
        let [width, height] = [viewport.width, viewport.height].map(u64::from);
        // At most 1.5 times the diagonal, which is at most the sum of the sides.
        let sun = (3 * (width + height) / 2 + 16).min(Sun::MAX_SIDE);
        let room = size.map(|side| (side as u64).max(sun) + 16);
        Occlusion::bytes(size) + sun * sun * TEXEL + room[0] * room[1] * SAMPLE_BYTES
    }

    /// Pixels along the side of a cell of the depth picture from the eye.
    fn cell(viewport: Viewport) -> f64 {
        let [width, height] = [viewport.width, viewport.height].map(f64::from);
        (width * height / MAX_CELLS).sqrt().max(width.max(height) / MAX_SIDE).max(2.0)
    }

    /// The width and the height of the depth picture from the eye, in cells.
    fn size(viewport: Viewport) -> [usize; 2] {
        let cell = Self::cell(viewport);
        [viewport.width, viewport.height].map(|pixels| ((f64::from(pixels) / cell).ceil() as usize).max(1))
    }

    /// The style of the picture whose light this is.
    pub(super) fn style(&self) -> Option<&Style> {
        self.made.as_ref().map(|(style, ..)| style)
    }

    /// Forgets the light, because the drawing has changed.
    pub(super) fn forget(&mut self) {
        self.made = None;
    }

    /// Starts the light of a picture, unless it is made already.
    pub(super) fn begin(&mut self, drawing: &Drawing<Solid>, plan: &Plan) {
        let &Plan { ref style, viewport, ref camera, .. } = plan;
        let samples = LANES as f64;
        let eye = Lens::new(drawing, viewport, camera, samples);
        // The plan's own numbers may be NaN, which equals nothing: then each pane would make the light anew.
        let key = (eye, viewport.least_width(style));
        let is_made = self.made.as_ref().is_some_and(|(_, made)| *made == key);
        self.made = Some((style.clone(), key));
        if is_made {
            return;
        }
        self.stage = Stage::Eye;
        let [width, height] = [viewport.width, viewport.height].map(f64::from);
        let cell = Self::cell(viewport);
        let size = Self::size(viewport);
        let lens = Lens::new(drawing, viewport, camera, 1.0 / cell);
        self.occlusion.begin(size, 1.0 / (cell * samples), lens.nearness);
        let from_eye = (lens, size, 1.0 / cell, 1.0);

        (self.nearness, self.middle) = (eye.nearness as f32, eye.middle.map(|c| c as f32));
        let lens = self.sun.begin(&eye, [width * samples, height * samples], samples);
        let scale = samples * lens.radius / eye.radius;
        let more = if self.sun.is_partial { PARTIAL } else { 1.0 };
        let from_sun = (lens, [self.sun.side; 2], scale, more);
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
    /// tile's first pixel in the whole picture. Pixels that show nothing stay as they are. Returns the first pixel that
    /// may be written, and the one after the last.
    pub(super) fn pixels(
        &self,
        (tile, light): (&ScreenTile, &Light),
        row: usize,
        at: [usize; 2],
        (paper, out): ([u8; 4], &mut [[u8; 4]]),
        spare: &mut Spare,
    ) -> [usize; 2] {
        if row.is_multiple_of(BLOCK) {
            spare.forget(row, out.len());
        }
        let Spare { seen, around, shades, sums } = spare;
        let painted = tile.painted(row, LANES).map(|end| end.min(out.len()));
        let y = at[1] + row;
        let shaded = self.ground.columns(y).map(|end| end.saturating_sub(at[0]).min(out.len()));
        let range = match [painted, shaded] {
            [a, [from, to]] if from >= to => a,
            [[from, to], b] if from >= to => b,
            [a, b] => [a[0].min(b[0]), a[1].max(b[1])],
        };
        shades.clear();
        shades.resize(out.len(), 0.0);
        self.shade([at[0] + shaded[0], y], &mut shades[shaded[0]..shaded[1].max(shaded[0])]);
        let samples = SampleRow::of(tile, row, out.len());
        let [r, g, b] = light.background;
        let background = Lanes([r, g, b, 0.0]);
        let shade = SHADE.at_most_of(background * 0.3);
        for i in range[0]..range[1] {
            let (surfaces, part) = (samples.surfaces(i), shades[i]);
            let (count, sum) = match &surfaces {
                Some((near, far)) => {
                    let (at, seen, around) = ([at[0] + i, y], &mut seen[i / BLOCK], &mut around[i / AROUND]);
                    let lit = self.lit(near, at, light, seen, around);
                    *sums = [sums[0] + near.colour, sums[1] + lit];
                    match far {
                        Some(far) => (near.count + far.count, lit + self.lit(far, at, light, seen, around)),
                        None => (near.count, lit),
                    }
                }
                None if part <= 0.0 => continue,
                None => (0.0, Lanes::all(0.0)),
            };
            let rest = ALL - count;
            out[i] = if paper[3] == 0 {
                let opaque = count + rest * part;
                let [r, g, b, _] = ((sum + shade * (rest * part)) * (1.0 / opaque)).bytes();
                [r as u8, g as u8, b as u8, (opaque * (255.0 / ALL) + 0.5) as u8]
            } else {
                let paper = background + (shade - background) * part;
                let [r, g, b, _] = ((sum + paper * rest) * (1.0 / ALL)).bytes();
                [r as u8, g as u8, b as u8, u8::MAX]
            };
        }
        range
    }

    /// The colours of the samples of a surface in their light, summed up.
    #[inline(always)]
    fn lit(
        &self,
        surface: &Surface,
        at: [usize; 2],
        light: &Light,
        seen: &mut [Seen; 2],
        around: &mut Option<Around>,
    ) -> Lanes {
        let Surface { count, depth, colour, sunny } = *surface;
        let known = seen.iter().find(|known| (known.depth - depth).abs() <= APART).copied();
        let Seen { dark, hidden, haze, .. } = known.unwrap_or_else(|| {
            let new = self.look(at, depth, light, around);
            seen[usize::from(seen[0].depth < f32::INFINITY)] = new;
            new
        });
        let open = SHADOW * (-hidden * sunny) + 1.0;
        let lit = colour * open * (DARK * -dark + 1.0) * EXPOSURE;
        let luma = Lanes::all((lit * LUMA).sum());
        let lit = (luma + (lit - luma) * (1.0 + VIVID * dark.max(0.5 * hidden))).at_least(0.0).at_most(255.0 * count);
        let [r, g, b] = light.background;
        lit + (Lanes([r, g, b, 0.0]) * count - lit) * haze
    }

    /// Finds the shade on the ground in pixels of a row from `at` on. It is interpolated between some of them.
    fn shade(&self, [left, y]: [usize; 2], shades: &mut [f32]) {
        let y = LANES as f32 * (y as f32 + 0.5);
        let place = |number: usize| [(LANES * STRIDE * number + LANES / 2) as f32, y];
        let mut next = None;
        let mut at = left;
        while at < left + shades.len() {
            let stretch = at / STRIDE;
            let first = next.unwrap_or_else(|| self.ground.at(place(stretch), &self.sun));
            let last = self.ground.at(place(stretch + 1), &self.sun);
            next = Some(last);
            let end = ((stretch + 1) * STRIDE).min(left + shades.len());
            if first + last > 0.0 {
                for column in at..end {
                    let part = (column % STRIDE) as f32 * (1.0 / STRIDE as f32);
                    shades[column - left] = MAX_SHADE * (first + part * (last - first));
                }
            }
            at = end;
        }
    }

    /// The light at a depth in the middle of the block that contains a pixel.
    // Most pixels find the light of their block, so a call costs little and one copy is enough.
    #[inline(never)]
    fn look(&self, at: [usize; 2], depth: f32, light: &Light, around: &mut Option<Around>) -> Seen {
        let middle = |size: usize| at.map(|pixel| (LANES * (pixel / size * size) + LANES * size / 2) as f32);
        let around = around.get_or_insert_with(|| self.occlusion.around(middle(AROUND)));
        let [x, y] = middle(BLOCK);
        // The place before perspective.
        let z = depth / (1.0 - depth * self.nearness).max(1e-3);
        let larger = 1.0 + z * self.nearness;
        Seen {
            depth,
            dark: self.occlusion.at([x, y, depth], around),
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

/// Memory for rows of pixels.
#[derive(Default)]
pub(super) struct Spare {
    /// By block of the present row of blocks: the light that its pixels share, at up to two depths.
    seen: Vec<[Seen; 2]>,
    /// By square of [`AROUND`] pixels: the mean surfaces around it, if known.
    around: Vec<Option<Around>>,
    /// By pixel: the part of the background that the shade on the ground covers.
    shades: Vec<f32>,
    /// The colours of all nearest surfaces in full light, and in their own.
    pub(super) sums: [Lanes; 2],
}

impl Spare {
    /// Forgets the light, for the row of blocks that begins at a row of pixels.
    fn forget(&mut self, row: usize, width: usize) {
        if row.is_multiple_of(AROUND) {
            self.around.clear();
            self.around.resize(width.div_ceil(AROUND), None);
        }
        self.seen.clear();
        self.seen.resize(width.div_ceil(BLOCK), [Seen { depth: f32::INFINITY, dark: 0.0, hidden: 0.0, haze: 0.0 }; 2]);
    }
}
