//! The pixels of a picture in space. Finished tiles are copied into them.

use super::lanes::Lanes;
use super::light::Light;
use super::lighting::{Lighting, Spare};
use super::tile::ScreenTile;
use crate::{Pane, Viewport};
use lsystem_base::{Meter, Progress};

/// The pixels of a picture, or of a pane of one.
#[derive(Default)]
pub(super) struct Pixels {
    pub width: usize,
    pub height: usize,
    /// RGBA, row by row.
    pub bytes: Vec<u8>,
    /// The background.
    paper: [u8; 4],
    /// By row of pixels: the first pixel that may have been painted, and the pixel after the last.
    painted: Vec<[usize; 2]>,
    /// The number of rows, from the top, that are cleared of the picture before.
    wiped: usize,
}

impl Pixels {
    /// Whether the picture has this size.
    pub(super) fn fits(&self, viewport: Viewport) -> bool {
        (self.width, self.height) == (viewport.width as usize, viewport.height as usize)
    }

    /// Starts a picture of a pane. Returns its size in bytes.
    pub(super) fn begin(&mut self, pane: Pane, paper: [u8; 4]) -> usize {
        (self.width, self.height) = (pane.width as usize, pane.height as usize);
        let size = self.width * self.height * 4;
        if self.bytes.len() != size || self.paper != paper || self.painted.len() != self.height {
            self.paper = paper;
            self.bytes.clear();
            self.bytes.reserve_exact(size);
            self.bytes.resize(size, 0);
            self.bytes.as_chunks_mut::<4>().0.fill(paper);
            self.painted.clear();
            self.painted.resize(self.height, [0, 0]);
            self.wiped = self.height;
        } else {
            self.wiped = 0;
        }
        size
    }

    /// Takes the size of a pane whose pixels are kept elsewhere.
    pub(super) fn outline(&mut self, pane: Pane) {
        *self = Self { width: pane.width as usize, height: pane.height as usize, ..Self::default() };
    }

    /// Starts the same picture again.
    pub(super) fn begin_again(&mut self) {
        self.wiped = 0;
    }

    /// Goes on clearing the picture before.
    pub(super) fn wipe(&mut self, meter: &mut Meter) -> Progress {
        while self.wiped < self.height {
            if meter.is_spent() {
                return Progress::More;
            }
            let [from, to] = core::mem::take(&mut self.painted[self.wiped]);
            let row = self.wiped * self.width;
            let (pixels, _) = self.bytes[(row + from) * 4..(row + to) * 4].as_chunks_mut::<4>();
            pixels.fill(self.paper);
            self.wiped += 1;
            meter.charge(1 + (to - from) as u64 / 64);
        }
        Progress::Done
    }

    /// Copies a finished tile into the picture. The tile is `at` this column and row of tiles; tiles have `side` pixels
    /// across and down.
    pub(super) fn put(&mut self, tile: &ScreenTile, at: [usize; 2], side: [usize; 2], samples: usize) {
        let [x, y] = [0, 1].map(|i| at[i] * side[i]);
        let right = (x + side[0]).min(self.width);
        for row in y..(y + side[1]).min(self.height) {
            let [from, to] = tile.painted(row - y, samples);
            let to = to.min(right - x);
            if from < to {
                let first = row * self.width + x;
                tile.pixels(row - y, from, samples, &mut self.bytes[(first + from) * 4..(first + to) * 4]);
                self.note(row, [x + from, x + to]);
            }
        }
    }

    /// As [`Pixels::put`], in the light of a picture at rest. `corner` is the place of these pixels in the whole picture.
    /// Returns the sums of colours in full light and in their own.
    pub(super) fn put_lit(
        &mut self,
        tile: &ScreenTile,
        (at, side): ([usize; 2], [usize; 2]),
        corner: [usize; 2],
        light: &Light,
        lighting: &Lighting,
    ) -> [Lanes; 2] {
        let [x, y] = [0, 1].map(|i| at[i] * side[i]);
        let right = (x + side[0]).min(self.width);
        let place = [corner[0] + x, corner[1] + y];
        let mut spare = Spare::default();
        for row in y..(y + side[1]).min(self.height) {
            let first = row * self.width;
            let (out, _) = self.bytes[(first + x) * 4..(first + right) * 4].as_chunks_mut::<4>();
            let [from, to] = lighting.pixels((tile, light), row - y, place, (self.paper, out), &mut spare);
            if from < to {
                self.note(row, [x + from, x + to]);
            }
        }
        spare.sums
    }

    /// Notes that pixels of a row have been painted.
    fn note(&mut self, row: usize, [from, to]: [usize; 2]) {
        let painted = &mut self.painted[row];
        *painted = if painted[0] == painted[1] { [from, to] } else { [painted[0].min(from), painted[1].max(to)] };
    }
}
