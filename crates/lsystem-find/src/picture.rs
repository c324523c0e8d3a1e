//! A picture as ink: which pixels are drawn on, and how far the ink reaches in each direction.

use crate::brush::put_stroke;
use crate::enlarged::enlarged;
use crate::parts::drawing;
use crate::sheet::{self, MARGIN, Sheet, half_width};
use lsystem_base::word;
use lsystem_render::mask::{Mask, SIDE};

/// A picture whose ink covers more than this part of its hull shows no lines.
const MAX_COVERED: f64 = 0.85;
/// Half the width of the lines that segments are drawn with, in pixels.
const THIN: f64 = 0.75;
/// Half the width of these lines on the sheet, in pixels, and the sheet's pixels for one of the mask.
const THIN_ON_SHEET: f64 = 1.0;
const FINER: f64 = 4.0;
/// How far, in pixels, a stroke may lie beside the ink before it is laid on it.
pub(crate) const NEAR_INK: u32 = 2;
/// How much further, in pixels, a stroke may lie beside the ink of a photograph. Measured: of 48 photographs that were
/// straightened at all, the strokes of 46 lie at most 5 pixels beside the ink in 97 of 100 places, and the others 7 and 8.
pub(crate) const LOOSE: u32 = 3;
/// The directions of the hull whose area is measured.
const DIRECTIONS: usize = 360;

/// A picture of lines.
#[derive(Clone, Debug)]
pub struct Picture {
    pub(crate) mask: Mask,
    /// The ink and the pixels within two of it.
    pub(crate) near: Mask,
    /// The ink and the pixels beside it.
    pub(crate) close: Mask,
    /// Half the usual width of a line, in pixels.
    pub(crate) stroke: f64,
    /// The same ink, finer.
    pub(crate) sheet: Sheet,
    /// Whether the ink may lie beside where it was drawn, since a photograph was straightened.
    pub(crate) is_photograph: bool,
    /// The work that has made this picture, in systems that are unlike it.
    pub(crate) work: u64,
    /// The places of the ink at the outline of each row, with the y axis upwards.
    outline: Vec<[f64; 2]>,
}

/// The pixels that are ink.
struct Shown {
    own: Vec<bool>,
    size: [usize; 2],
}

/// The first and the last pixels of ink.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    left: usize,
    top: usize,
    right: usize,
    bottom: usize,
}

impl Bounds {
    fn longest(self) -> usize {
        (self.right - self.left).max(self.bottom - self.top) + 1
    }
}

impl Shown {
    fn all(&self) -> impl Iterator<Item = (usize, usize)> {
        let width = self.size[0];
        self.own.iter().enumerate().filter(|(_, own)| **own).map(move |(at, _)| (at % width, at / width))
    }

    fn ink(&self) -> Option<Bounds> {
        self.all().fold(None, |all: Option<Bounds>, (x, y)| {
            let Bounds { left, top, right, bottom } = all.unwrap_or(Bounds { left: x, top: y, right: x, bottom: y });
            Some(Bounds { left: left.min(x), top: top.min(y), right: right.max(x), bottom: bottom.max(y) })
        })
    }

    /// The same ink, `factor` times as large. What is ink in `grey` and not here is paper.
    fn enlarged(&self, ink: Bounds, grey: &[u8], level: f32, is_dark: bool, factor: f64) -> Self {
        // The soft edges of the outermost ink.
        let [width, height] = self.size;
        let (left, top) = (ink.left.saturating_sub(1), ink.top.saturating_sub(1));
        let (right, bottom) = ((ink.right + 2).min(width), (ink.bottom + 2).min(height));
        let ink_at = |at: usize| {
            let darker = level - f32::from(grey[at]);
            let ink = if is_dark { darker } else { -darker };
            if self.own[at] { ink } else { ink.min(0.0) }
        };
        let levels: Vec<f32> = (top..bottom).flat_map(|y| (left..right).map(move |x| ink_at(y * width + x))).collect();
        let (levels, size) = enlarged(&levels, [right - left, bottom - top], factor);
        Self { own: levels.into_iter().map(|ink| ink > 0.0).collect(), size }
    }
}

impl Picture {
    /// A picture of `width` times `height` levels of grey, row by row from above; 0 is black. The lines are what there
    /// is less of, dark or light.
    ///
    /// # Errors
    /// Why no lines are seen.
    pub fn new(grey: &[u8], width: usize, height: usize) -> Result<Self, &'static str> {
        if width == 0 || height == 0 || grey.len() != width * height {
            return Err(word!("the picture is empty"));
        }
        let level = threshold(grey);
        let dark = grey.iter().filter(|&&at| at <= level).count();
        let is_dark = dark * 2 <= grey.len();
        let is_ink = |x: usize, y: usize| (grey[y * width + x] <= level) == is_dark;
        let filled = word!("the picture is filled: no lines are seen in it");
        let runs = drawing(width, height, false, is_ink).ok_or(filled)?;
        let mut own = vec![false; grey.len()];
        for run in &runs {
            own[run.y as usize * width..][run.left as usize..run.right as usize].fill(true);
        }
        let shown = Shown { own, size: [width, height] };
        let Some(ink) = shown.ink().filter(|_| grey.iter().any(|&at| at != grey[0])) else {
            return Err(word!("the picture has one shade of grey only"));
        };
        let side = SIDE - 2 * MARGIN;
        let (shown, ink) = match side as f64 / ink.longest() as f64 {
            factor if factor > 1.0 => {
                let larger = shown.enlarged(ink, grey, f32::from(level) + 0.5, is_dark, factor);
                let ink = larger.ink().unwrap_or(ink);
                (larger, ink)
            }
            _ => (shown, ink),
        };
        let longest = ink.longest();
        let scale = (longest as f64 / side as f64).max(1.0);
        let mut mask = Mask::default();
        // Pixels of the picture for one of the sheet.
        let coarser = (longest as f64 / sheet::MAX as f64).max(1.0);
        let on_sheet = |value: usize, first: usize| ((value - first) as f64 / coarser) as usize;
        let Bounds { left, top, right, bottom } = ink;
        let mut sheet = Sheet::new(on_sheet(right, left) + 1, on_sheet(bottom, top) + 1, scale / coarser);
        for (x, y) in shown.all() {
            let at = |value: usize, first: usize| ((value - first) as f64 / scale) as usize + MARGIN;
            mask.put(at(x, left).min(SIDE - 1), at(y, top).min(SIDE - 1));
            sheet.put(on_sheet(x, left), on_sheet(y, top));
        }
        let picture = Self::of(mask, sheet.finished());
        if picture.mask.count() as f64 > picture.hull_area() * MAX_COVERED {
            return Err(filled);
        }
        Ok(picture)
    }

    /// A picture of segments, given by the coordinates of both ends with the y axis upwards.
    ///
    /// # Errors
    /// Why no lines are seen.
    pub fn of_segments(segments: &[[f64; 4]]) -> Result<Self, &'static str> {
        let places = || segments.iter().flat_map(|&[x1, y1, x2, y2]| [[x1, y1], [x2, y2]]);
        let least = |axis: usize| places().map(|at| at[axis]).fold(f64::INFINITY, f64::min);
        let most = |axis: usize| places().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max);
        let (left, top) = (least(0), most(1));
        let longest = (most(0) - left).max(top - least(1));
        let no_length = word!("the segments have no length");
        if !(longest > 0.0 && longest.is_finite()) {
            return Err(no_length);
        }
        let scale = (SIDE - 2 * MARGIN) as f64 / longest;
        let pixel = |x: f64, y: f64| [(x - left) * scale + MARGIN as f64, (top - y) * scale + MARGIN as f64];
        let mut mask = Mask::default();
        let fine = |side: f64| ((side * scale * FINER) as usize).min(sheet::MAX - 2) + 2;
        let mut sheet = Sheet::new(fine(most(0) - left), fine(top - least(1)), FINER);
        for &[x1, y1, x2, y2] in segments {
            put_stroke(&mut mask, [pixel(x1, y1), pixel(x2, y2)], THIN);
            let fine = |x: f64, y: f64| [(x - left) * scale * FINER, (top - y) * scale * FINER];
            sheet.put_stroke([fine(x1, y1), fine(x2, y2)], THIN_ON_SHEET);
        }
        // Ends that are no numbers leave nothing.
        (mask.count() > 0).then(|| Self::of(mask, sheet.finished())).ok_or(no_length)
    }

    /// How much of the ink of both agrees, from 0 to 1.
    #[must_use]
    pub fn agreement(&self, other: &Self) -> f64 {
        self.mask.agreement(&other.mask)
    }

    fn of(mask: Mask, sheet: Sheet) -> Self {
        let mut outline = Vec::new();
        for y in 0..SIDE {
            let inked = |x: &usize| mask.has(*x, y);
            if let (Some(first), Some(last)) = ((0..SIDE).find(inked), (0..SIDE).rfind(inked)) {
                for x in [first, last] {
                    outline.push([x as f64 + 0.5, -(y as f64 + 0.5)]);
                }
            }
        }
        let close = mask.grown();
        let near = (1..NEAR_INK).fold(close.clone(), |near, _| near.grown());
        let stroke = half_width(SIDE, SIDE, |x, y| mask.has(x, y));
        Self { mask, near, close, stroke, sheet, is_photograph: false, work: 0, outline }
    }

    /// This picture as a photograph that was straightened with some work, in systems that are unlike it: strokes may lie
    /// a little further beside the ink.
    pub(crate) fn straightened(mut self, work: u64) -> Self {
        (0..LOOSE).for_each(|_| self.near = self.near.grown());
        Self { is_photograph: true, work, ..self }
    }

    /// How far the ink reaches in a direction in radians, counter-clockwise from the right, from the upper left corner.
    pub(crate) fn reach(&self, direction: f64) -> f64 {
        let (sin, cos) = libm::sincos(direction);
        let reach = self.outline.iter().map(|[x, y]| x * cos + y * sin).fold(f64::NEG_INFINITY, f64::max);
        // Places are centres of pixels.
        reach + 0.5
    }

    /// The box around the ink, from the upper left corner with the y axis upwards: its left, lower, right and upper side.
    pub(crate) fn bounds(&self) -> [f64; 4] {
        let quarter = std::f64::consts::FRAC_PI_2;
        [-self.reach(2.0 * quarter), -self.reach(3.0 * quarter), self.reach(0.0), self.reach(quarter)]
    }

    /// The middle of the line at the corner of the hull that lies furthest in a direction, in turns.
    pub(crate) fn corner(&self, direction: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(direction * std::f64::consts::TAU);
        let along = |[x, y]: &[f64; 2]| x * cos + y * sin;
        let furthest = self.outline.iter().max_by(|a, b| along(a).total_cmp(&along(b)));
        let [x, y] = furthest.copied().unwrap_or_default();
        [x - (self.stroke - 0.5) * cos, y - (self.stroke - 0.5) * sin]
    }

    /// The area of the hull, by Cauchy's formula.
    pub(crate) fn hull_area(&self) -> f64 {
        let step = std::f64::consts::TAU / DIRECTIONS as f64;
        let reach: Vec<f64> = (0..DIRECTIONS).map(|at| self.reach(at as f64 * step)).collect();
        let slope = |at: usize| (reach[(at + 1) % DIRECTIONS] - reach[at]) / step;
        (0..DIRECTIONS).map(|at| (reach[at] * reach[at] - slope(at) * slope(at)) * step / 2.0).sum()
    }
}

/// The level of grey that divides dark from light best (Otsu, "A threshold selection method from gray-level
/// histograms", 1979): the darker ones are at most this.
pub(crate) fn threshold(grey: &[u8]) -> u8 {
    let mut counts = [0_u64; 256];
    grey.iter().for_each(|&at| counts[usize::from(at)] += 1);
    let total = |counts: &[u64], from: u64| counts.iter().zip(from..).map(|(count, at)| count * at).sum::<u64>() as f64;
    let (all, sum) = (grey.len() as f64, total(&counts, 0));
    let between = |level: usize| {
        let dark = counts[..=level].iter().sum::<u64>() as f64;
        let light = all - dark;
        if dark == 0.0 || light == 0.0 {
            return 0.0;
        }
        let below = total(&counts[..=level], 0);
        let apart = below / dark - (sum - below) / light;
        dark * light * apart * apart
    };
    // Between two shades any level is as good; the middle of the best ones leaves soft edges on both sides.
    let values: Vec<f64> = (0..255).map(between).collect();
    let most = values.iter().copied().fold(0.0, f64::max);
    let best: Vec<usize> = (0..255).filter(|&at| values[at] >= most * (1.0 - 1e-9)).collect();
    best[best.len() / 2] as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_what_there_is_less_of() {
        for (ink, paper) in [(0, 255), (255, 0), (90, 130)] {
            let mut grey = vec![paper; 100 * 60];
            for x in 10..90 {
                (grey[20 * 100 + x], grey[21 * 100 + x]) = (ink, ink);
                grey[(20 + x / 4) * 100 + x] = ink;
            }
            let picture = Picture::new(&grey, 100, 60).expect("lines");
            // The picture is enlarged: its longest line has 80 pixels.
            let side = (SIDE - 2 * MARGIN) as f64;
            let pixels = picture.mask.count() as f64 / (side * side) * 80.0 * 80.0;
            assert!(pixels > 200.0 && pixels < 250.0, "{pixels}");
            assert!((picture.reach(0.0) - side - 4.0).abs() < 1.01, "{}", picture.reach(0.0));
            assert!((picture.reach(std::f64::consts::FRAC_PI_2) + 4.0).abs() < 0.01);
        }
    }

    #[test]
    fn soft_edges_of_small_pictures_tell_where_a_line_is() {
        // A line that covers a third of the pixels in one row, and all in the next one.
        let mut grey = vec![255; 100 * 60];
        for x in 10..90 {
            (grey[20 * 100 + x], grey[21 * 100 + x], grey[40 * 100 + x]) = (170, 0, 0);
        }
        let picture = Picture::new(&grey, 100, 60).expect("lines");
        let rows = |from: usize, to: usize| (from..to).filter(|&y| picture.mask.has(SIDE / 2, y)).count();
        let factor = (SIDE - 2 * MARGIN) as f64 / 80.0;
        let (wide, thin) = (rows(0, 60), rows(60, SIDE));
        assert!(wide as f64 > thin as f64 + 0.15 * factor, "{wide} {thin} {factor}");
        assert!((thin as f64 - factor).abs() < factor / 2.0, "{thin} {factor}");
    }

    #[test]
    fn pictures_without_lines_are_told() {
        let mut square = vec![255; 100 * 100];
        (30..60).for_each(|y| square[y * 100 + 30..y * 100 + 60].fill(0));
        let cases = [(vec![], 0, 0, "empty"), (vec![7; 100], 10, 10, "one shade"), (square, 100, 100, "filled")];
        for (grey, width, height, said) in cases {
            let told = Picture::new(&grey, width, height);
            assert!(told.is_err_and(|why| why.contains(said)), "{said}");
        }
    }
}
