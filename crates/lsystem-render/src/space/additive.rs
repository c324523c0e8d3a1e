//! Additive ink in space: strokes, triangles and dots add up on a sheet, in any order, and nothing hides anything.
//!
//! Sums and tones are those of pictures in the plane. A stroke leaves as much ink as its outline in the picture is
//! large, and less the more it fades into the background.

use super::setup::Setup;
use crate::ink::{Amount, Grid, Pigment, Print, Sheet, Tone};
use crate::pane::Pass;
use crate::{Detail, Pane, Viewport};
use lsystem_base::{Meter, Progress};
use lsystem_syntax::{Ink, Style};
use std::collections::VecDeque;

/// Sums stay below about 2 to this power, so that an `f32` (below 2^128) holds them and their pigments.
const LARGEST_EXPONENT: i32 = 100;

/// The width in pixels from which on a dot is a band.
const BROAD: f64 = 1.5;

/// Ink that waits until a broad stroke or a triangle is filled.
enum Deposit {
    Stroke { ends: [[f64; 2]; 2], widths: [f64; 2], layer: f64, pigment: Pigment },
    Triangle { corners: [[f64; 2]; 3], layer: f64, pigment: Pigment },
    Dot { at: [f64; 2], units: f32, pigment: Pigment },
}

/// The ink of a picture, or of a pane.
#[derive(Default)]
pub(super) struct Additive {
    sheet: Sheet,
    tone: Tone,
    queue: VecDeque<Deposit>,
    grid: Option<Grid>,
    planes: usize,
    size: [usize; 2],
    empty: bool,
    pass: Pass,
    /// The pigment of a picture in one ink.
    only: Pigment,
}

impl Additive {
    /// Starts a picture or a pane of it, in one ink or in several. Returns the units of work.
    pub(super) fn begin(
        &mut self,
        (style, is_transparent): (&Style, bool),
        viewport: Viewport,
        (pane, pass): (Pane, Pass),
        only: Option<Pigment>,
    ) -> u64 {
        let grid = Grid::new(Ink::Density, viewport, Detail::Fine);
        self.grid = Some(grid);
        self.planes = if only.is_some() { 1 } else { 4 };
        self.only = only.unwrap_or_default();
        self.size = [pane.width, pane.height].map(|side| side as usize);
        self.pass = pass;
        self.begin_again();
        self.tone.begin(&Print { style, pane, pass, is_transparent }, grid)
    }

    /// Starts to add up anew.
    pub(super) fn begin_again(&mut self) {
        self.empty = false;
        self.queue.clear();
    }

    /// Whether the pass adds up ink.
    pub(super) fn paints(&self) -> bool {
        self.pass != Pass::Survey
    }

    /// Goes on emptying the sheet. `most` is the greatest amount of ink that the picture can have.
    pub(super) fn prepare(&mut self, most: impl FnOnce() -> Amount, meter: &mut Meter) -> Progress {
        if self.empty {
            return Progress::Done;
        }
        if self.sheet.empty(self.size, self.planes, meter) == Progress::More {
            return Progress::More;
        }
        self.sheet.exponent = most().exponent().map_or(0, |exponent| (exponent - LARGEST_EXPONENT).max(0));
        self.empty = true;
        Progress::Done
    }

    /// Adds `times` strokes between two places of the pane, with these widths there.
    pub(super) fn stroke(&mut self, ends: [[f64; 2]; 2], widths: [f64; 2], times: Amount, pigment: Pigment) -> i64 {
        let layer = times.units(self.sheet.exponent);
        self.deposit(Deposit::Stroke { ends, widths, layer, pigment })
    }

    /// Adds a triangle, as strong as a part (0 to 1) of a layer.
    pub(super) fn triangle(&mut self, corners: [[f64; 2]; 3], part: f64, pigment: Pigment) -> i64 {
        let layer = self.sheet.layer() * part;
        self.deposit(Deposit::Triangle { corners, layer, pigment })
    }

    /// Adds an amount of ink, in layers times pixels, at a place of the pane: on a band across broad strokes, which are
    /// `width` wide and run in a direction.
    pub(super) fn dot(
        &mut self,
        at: [f64; 2],
        (width, [x, y]): (f64, [f64; 2]),
        amount: Amount,
        pigment: Pigment,
    ) -> i64 {
        let length = (x * x + y * y).sqrt();
        if width > BROAD && length > 0.0 {
            let ends = [-0.5, 0.5].map(|side| [at[0] + side * x / length, at[1] + side * y / length]);
            return self.stroke(ends, [width; 2], amount.times(1.0 / width), pigment);
        }
        let units = amount.units(self.sheet.exponent) as f32;
        self.deposit(Deposit::Dot { at, units, pigment })
    }

    fn deposit(&mut self, deposit: Deposit) -> i64 {
        if self.sheet.is_filled() && self.queue.is_empty() {
            return self.add(&deposit) as i64;
        }
        self.queue.push_back(deposit);
        1
    }

    fn add(&mut self, deposit: &Deposit) -> u64 {
        let Some(grid) = self.grid else { return 1 };
        match *deposit {
            Deposit::Stroke { ends, widths, layer, pigment } => {
                self.sheet.stroke(ends, widths, (layer, grid.points), pigment)
            }
            Deposit::Triangle { corners, layer, pigment } => self.sheet.fill(corners.into_iter(), layer, pigment),
            Deposit::Dot { at, units, pigment } => {
                self.sheet.dot(at, units, pigment);
                1
            }
        }
    }

    /// Goes on with a broad stroke or a triangle, or adds what waits for it. Returns the units of work; `None` if there
    /// is nothing left.
    pub(super) fn go_on(&mut self, meter: &mut Meter) -> Option<i64> {
        if !self.sheet.is_filled() {
            let before = meter.spent();
            self.sheet.go_on(meter);
            return Some((meter.spent() - before) as i64);
        }
        let deposit = self.queue.pop_front()?;
        let work = self.add(&deposit);
        meter.charge(work);
        Some(work as i64)
    }

    /// Turns the sums into pixels, or counts them.
    pub(super) fn resolve(&mut self, meter: &mut Meter) -> Progress {
        self.tone.step(&self.sheet, self.only, None, meter)
    }

    /// RGBA, row by row.
    pub(super) fn pixels(&self) -> &[u8] {
        self.tone.pixels()
    }
}

impl Setup {
    /// The settings of a picture in additive ink: a sum for each pixel, on one sheet.
    pub(super) fn additive(self, pane: Pane) -> Self {
        Self {
            side: [pane.width, pane.height].map(|side| side as usize),
            single: false,
            detail: self.detail.min(DOT),
            slack: 1.0,
            ..self
        }
    }
}

/// The extent below which a block's ink is added at one place, in pixels.
const DOT: f32 = 1.0;
