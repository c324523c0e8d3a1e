//! Sums of ink, pixel by pixel.
//!
//! The unit is one layer: a stroke as wide as a pixel or wider has 1 along its axis. Strokes that are thinner or
//! shorter than a pixel are shared by the four pixels around each point, by distance, so that a small change of the
//! view does not make ink jump or vanish.

use super::outline::{Crossing, MAX_SORTED, Side, sides_in};
use super::pigment::Pigment;
use core::ops::Range;
use lsystem_base::{Meter, Progress};

/// Strokes wider than this, in pixels, are filled as polygons. Others are put together from lines of points.
pub(crate) const BROAD: f64 = 4.0;
/// The least ink that is added, in units of the sheet: less counts as this much, so a trunk shows beside 10^100 twigs.
/// Sums stay below about 2^100 units.
pub(crate) const LEAST_INK: f64 = 1.0 / (1_u128 << 110) as f64;
/// Numbers that are cleared in a unit of work.
const NUMBERS_PER_UNIT: usize = 256;
/// Rows that are emptied between two looks at the meter.
const ROWS_AT_ONCE: usize = 64;
/// Pixels of a span to which ink is added in a unit of work.
const PIXELS_PER_UNIT: usize = 32;
/// Parts into which a row of pixels is divided to fill areas.
const PARTS: usize = 4;

/// Sums of ink by pixel, row by row. Coordinates are pixels, y down.
#[derive(Default)]
pub(crate) struct Sheet {
    pub width: usize,
    pub height: usize,
    /// Numbers of a pixel: 1 (the ink), or 4 (the ink, and the ink times its pigments).
    pub planes: usize,
    /// One unit is `2^exponent` layers of ink.
    pub exponent: i32,
    pub values: Vec<f32>,
    /// By row: the columns that may have ink.
    pub reach: Vec<Range<u32>>,
    filling: Filling,
    /// The number of empty rows, while the sheet is emptied in pieces.
    emptied: usize,
}

/// A polygon that is being filled.
#[derive(Default)]
struct Filling {
    vertices: Vec<[f64; 2]>,
    /// Parts of rows that are still to be filled.
    parts: Range<usize>,
    /// The units of ink that each part adds.
    layer: f32,
    pigment: Pigment,
    /// The sides that may cross the present row.
    sides: Vec<Side>,
    /// The crossings of the sides with the present part of the row.
    crossings: Vec<Crossing>,
    /// By column: the change of the winding number there, for very many crossings.
    changes: Vec<i32>,
}

/// The values of a tile, in the unit of the sheet that they are added to.
pub(crate) struct Stamp<'a> {
    pub planes: usize,
    /// The number of rows.
    pub rows: usize,
    pub bands: &'a [Band],
    pub values: &'a [f32],
}

/// The number of rows in a band.
pub(crate) const BAND: usize = 8;
/// The columns of a band are a multiple of this.
pub(crate) const LANES: usize = 4;

/// Neighbouring rows of a tile with the same columns. A loop over equal rows takes a fraction of the time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Band {
    /// The first column.
    pub first: u32,
    /// The number of columns.
    pub columns: u32,
    /// The index of the first value.
    pub at: u32,
}

impl Sheet {
    /// Empties the sheet. Returns the units of work.
    pub(crate) fn reset(&mut self, [width, height]: [usize; 2], planes: usize, exponent: i32) -> u64 {
        self.exponent = exponent;
        self.filling.parts = 0..0;
        let units = 1 + (width * height * planes / NUMBERS_PER_UNIT) as u64;
        self.emptied = 0;
        if (self.width, self.height, self.planes) == (width, height, planes) && self.reach.len() == height {
            for (row, reach) in self.reach.iter_mut().enumerate() {
                let at = row * width;
                self.values[(at + reach.start as usize) * planes..(at + reach.end as usize) * planes].fill(0.0);
                *reach = 0..0;
            }
            return units;
        }
        (self.width, self.height, self.planes) = (width, height, planes);
        self.values.clear();
        self.values.resize(width * height * planes, 0.0);
        self.reach.clear();
        self.reach.resize(height, 0..0);
        units
    }

    /// Empties the sheet in pieces.
    pub(crate) fn empty(&mut self, [width, height]: [usize; 2], planes: usize, meter: &mut Meter) -> Progress {
        if (self.width, self.height, self.planes) != (width, height, planes) {
            (self.width, self.height, self.planes) = (width, height, planes);
            self.values.clear();
            self.values.reserve_exact(width * height * planes);
            self.reach.clear();
            self.emptied = 0;
        }
        self.exponent = 0;
        self.filling.parts = 0..0;
        meter.charge(1);
        while self.emptied < height {
            let at = self.emptied * width;
            if let Some(reach) = self.reach.get_mut(self.emptied) {
                self.values[(at + reach.start as usize) * planes..(at + reach.end as usize) * planes].fill(0.0);
                *reach = 0..0;
            } else {
                self.values.resize((at + width) * planes, 0.0);
                self.reach.push(0..0);
            }
            self.emptied += 1;
            meter.charge(1 + (width * planes / NUMBERS_PER_UNIT) as u64);
            // Each call empties some rows, so that calls with a spent meter end.
            if meter.is_spent() && self.emptied < height && self.emptied.is_multiple_of(ROWS_AT_ONCE) {
                return Progress::More;
            }
        }
        self.emptied = 0;
        Progress::Done
    }

    /// Sets only the size, without memory for values, to see which blocks the sheet would show.
    pub(crate) fn outline(&mut self, [width, height]: [usize; 2], planes: usize) {
        *self = Self { width, height, planes, ..Self::default() };
    }

    /// The number of values.
    pub(crate) fn numbers(&self) -> usize {
        self.width * self.height * self.planes
    }

    /// One layer of ink, in units of this sheet.
    pub(crate) fn layer(&self) -> f64 {
        libm::scalbn(1.0, self.exponent.saturating_neg()).max(LEAST_INK)
    }

    /// Whether bounds are outside the sheet.
    pub(crate) fn misses(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        // Bounds that are not numbers count as outside.
        !(high[0] > -1.0 && high[1] > -1.0 && low[0] < self.width as f64 + 1.0 && low[1] < self.height as f64 + 1.0)
    }

    fn extend(&mut self, row: usize, first: usize, end: usize) {
        let reach = &mut self.reach[row];
        let (first, end) = (first as u32, end as u32);
        *reach = if reach.start == reach.end { first..end } else { reach.start.min(first)..reach.end.max(end) };
    }

    #[inline(always)]
    fn add(&mut self, at: usize, weight: f32, pigment: Pigment) {
        if self.planes == 1 {
            self.values[at] += weight;
        } else if let Some(values) = self.values.get_mut(at * 4..at * 4 + 4) {
            values[0] += weight;
            values[1] += weight * pigment[0];
            values[2] += weight * pigment[1];
            values[3] += weight * pigment[2];
        }
    }

    /// Adds `weight`, in units of this sheet, at a point.
    #[inline]
    pub(crate) fn dot(&mut self, [x, y]: [f64; 2], weight: f32, pigment: Pigment) {
        let (left, top) = ((x - 0.5).floor(), (y - 0.5).floor());
        if !(left >= -1.0 && top >= -1.0 && left < self.width as f64 && top < self.height as f64) {
            return;
        }
        let (across, down) = ((x - 0.5 - left) as f32, (y - 0.5 - top) as f32);
        let (left, top) = (left as i64, top as i64);
        for (row, part) in [(top, 1.0 - down), (top + 1, down)] {
            let Some(row) = usize::try_from(row).ok().filter(|&row| row < self.height) else { continue };
            let first = left.max(0) as usize;
            let end = ((left + 2) as usize).min(self.width);
            self.extend(row, first, end);
            for column in first..end {
                let near = if column as i64 == left { 1.0 - across } else { across };
                self.add(row * self.width + column, weight * part * near, pigment);
            }
        }
    }

    /// Adds `layer` units of ink along a stroke with flat ends, as lines of at least `points` points a pixel. Its widths at
    /// the ends are in pixels; a width below 1 adds less ink. [`Sheet::go_on`] fills a broad stroke. Returns the units of
    /// work.
    pub(crate) fn stroke(
        &mut self,
        ends: [[f64; 2]; 2],
        widths: [f64; 2],
        (layer, points): (f64, f64),
        pigment: Pigment,
    ) -> u64 {
        let broadest = widths[0].max(widths[1]);
        let Some([(from, first), (to, last)]) = self.clipped(ends, broadest) else { return 1 };
        let width_at = |place: f64| widths[0] + place * (widths[1] - widths[0]);
        let widths = [width_at(first), width_at(last)];
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = (dx * dx + dy * dy).sqrt();
        if length == 0.0 {
            return 1;
        }
        let aside = [-dy / length, dx / length];
        if broadest > BROAD {
            let side = |p: [f64; 2], half: f64| [0, 1].map(|i| p[i] + half * aside[i]);
            let [a, b] = widths.map(|width| 0.5 * width);
            let corners = [side(from, a), side(to, b), side(to, -b), side(from, -a)];
            return self.fill(corners.into_iter(), layer, pigment);
        }
        let lines = broadest.ceil().max(1.0);
        let points = (length * points).ceil().max(1.0);
        let step = [dx / points, dy / points];
        let wider = (widths[1] - widths[0]) / points;
        for line in 0..lines as usize {
            let across = (line as f64 + 0.5) / lines - 0.5;
            let at = |width: f64| [0, 1].map(|i| from[i] + across * width * aside[i] + 0.5 * step[i]);
            let weight = |width: f64| (layer * width * length / (lines * points)) as f32;
            let (mut start, mut ink) = (at(widths[0]), weight(widths[0]));
            for point in 0..points as usize {
                let point = point as f64;
                if wider != 0.0 {
                    let width = widths[0] + (point + 0.5) * wider;
                    (start, ink) = (at(width), weight(width));
                }
                self.dot([start[0] + point * step[0], start[1] + point * step[1]], ink, pigment);
            }
        }
        (lines * points) as u64 / 4 + 1
    }

    /// The ends of the part of a segment near the sheet, and their places from 0 to 1 along the segment; `None` if there
    /// is none, or if numbers are not finite.
    fn clipped(&self, [from, to]: [[f64; 2]; 2], width: f64) -> Option<[([f64; 2], f64); 2]> {
        let margin = width / 2.0 + 2.0;
        let size = [self.width as f64, self.height as f64];
        let delta = [to[0] - from[0], to[1] - from[1]];
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (low, high) = (-margin, size[axis] + margin);
            if delta[axis] == 0.0 {
                if !(from[axis] >= low && from[axis] <= high) {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - from[axis]) / delta[axis], (high - from[axis]) / delta[axis]);
            start = start.max(a.min(b));
            end = end.min(a.max(b));
        }
        // Numbers that are not finite leave nothing.
        if !(start < end && delta.iter().chain(&from).all(|v| v.is_finite())) {
            return None;
        }
        let at = |t: f64| [from[0] + t * delta[0], from[1] + t * delta[1]];
        Some([
            if start > 0.0 { (at(start), start) } else { (from, 0.0) },
            if end < 1.0 { (at(end), end) } else { (to, 1.0) },
        ])
    }

    /// Starts to add `layer` units of ink inside an outline, where its winding number is not 0. [`Sheet::go_on`] does
    /// the filling. Returns the units of work.
    pub(crate) fn fill(&mut self, vertices: impl Iterator<Item = [f64; 2]>, layer: f64, pigment: Pigment) -> u64 {
        let filling = &mut self.filling;
        filling.vertices.clear();
        filling.vertices.extend(vertices);
        (filling.layer, filling.pigment, filling.parts) = ((layer / PARTS as f64) as f32, pigment, 0..0);
        let (low, high) = filling
            .vertices
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), vertex| (low.min(vertex[1]), high.max(vertex[1])));
        if low < high && filling.vertices.iter().flatten().all(|v| v.is_finite()) {
            let rows = (low.max(0.0) as usize).min(self.height)..(high.ceil().max(0.0) as usize).min(self.height);
            filling.parts = rows.start * PARTS..rows.end * PARTS;
        }
        1 + filling.vertices.len() as u64 / 8
    }

    /// Whether no polygon is unfinished.
    pub(crate) fn is_filled(&self) -> bool {
        self.filling.parts.is_empty()
    }

    /// Goes on with the unfinished polygon, a part of a row at a time.
    pub(crate) fn go_on(&mut self, meter: &mut Meter) {
        let mut filling = core::mem::take(&mut self.filling);
        while !meter.is_spent()
            && let Some(part) = filling.parts.next()
        {
            if part % PARTS == 0 || filling.sides.is_empty() {
                let centre = |part: usize| (part as f64 + 0.5) / PARTS as f64;
                let ends = [part, part / PARTS * PARTS + PARTS - 1].map(centre);
                meter.charge(sides_in(&filling.vertices, ends, &mut filling.sides));
            }
            meter.charge(1 + self.fill_part(&mut filling, part));
        }
        self.filling = filling;
    }

    /// Fills a part of a row. Returns the units of work.
    fn fill_part(&mut self, filling: &mut Filling, part: usize) -> u64 {
        let Filling { sides, crossings, changes, layer, pigment, .. } = filling;
        let y = (part as f64 + 0.5) / PARTS as f64;
        crossings.clear();
        crossings.extend(sides.iter().filter_map(|[a, b]| {
            let turn = i32::from(a[1] <= y) - i32::from(b[1] <= y);
            (turn != 0).then(|| (a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), turn))
        }));
        let mut work = 0;
        if crossings.len() > MAX_SORTED {
            // Each crossing counts at the nearest border of a column.
            changes.clear();
            changes.resize(self.width + 1, 0);
            for &(x, turn) in &*crossings {
                changes[libm::round(x).clamp(0.0, self.width as f64) as usize] += turn;
            }
            let mut winding = 0;
            for (column, change) in changes.iter().enumerate().take(self.width) {
                winding += change;
                if winding != 0 {
                    work += self.span(part / PARTS, [column as f64, column as f64 + 1.0], *layer, *pigment);
                }
            }
            work += self.width + crossings.len();
        } else {
            crossings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let mut winding = 0;
            for pair in crossings.windows(2) {
                winding += pair[0].1;
                if winding != 0 {
                    work += self.span(part / PARTS, [pair[0].0, pair[1].0], *layer, *pigment);
                }
            }
            work += 8 * crossings.len();
        }
        (work / PIXELS_PER_UNIT + sides.len() / 8) as u64
    }

    /// Adds ink to a part of a row between two sides. Returns the number of pixels.
    fn span(&mut self, row: usize, sides: [f64; 2], layer: f32, pigment: Pigment) -> usize {
        let [left, right] = sides.map(|x| x.clamp(0.0, self.width as f64));
        if left >= right {
            return 1;
        }
        let (first, end) = (left as usize, (right.ceil() as usize).min(self.width));
        self.extend(row, first, end);
        for column in first..end {
            let part = (right.min(column as f64 + 1.0) - left.max(column as f64)) as f32;
            self.add(row * self.width + column, layer * part, pigment);
        }
        end - first
    }

    /// Adds a tile with its upper left corner at (`x`, `y`). A tile without pigments of its own takes `pigment`.
    /// Returns the units of work.
    pub(crate) fn stamp(&mut self, stamp: &Stamp<'_>, [x, y]: [i64; 2], pigment: Pigment) -> u64 {
        let mut work = 1;
        for (number, band) in stamp.bands.iter().enumerate() {
            let first = x + i64::from(band.first);
            let (left, right) = (first.max(0), (first + i64::from(band.columns)).min(self.width as i64));
            let top = y + (number * BAND) as i64;
            let rows = (stamp.rows - number * BAND).min(BAND);
            let (above, below) = ((-top).clamp(0, rows as i64), (self.height as i64 - top).clamp(0, rows as i64));
            if left >= right || above >= below {
                continue;
            }
            let skipped = (left - first) as usize * stamp.planes;
            let (left, count) = (left as usize, (right - left) as usize);
            let stride = band.columns as usize * stamp.planes;
            for row in above as usize..below as usize {
                let to = (top + row as i64) as usize;
                self.extend(to, left, left + count);
                let from = band.at as usize + row * stride + skipped;
                let source = &stamp.values[from..from + count * stamp.planes];
                let at = (to * self.width + left) * self.planes;
                let target = &mut self.values[at..at + count * self.planes];
                if stamp.planes == self.planes {
                    add(target, source);
                } else {
                    let layer = [1.0, pigment[0], pigment[1], pigment[2]];
                    for (values, more) in target.as_chunks_mut::<4>().0.iter_mut().zip(source) {
                        (0..4).for_each(|plane| values[plane] += more * layer[plane]);
                    }
                }
            }
            work += (below - above) as u64 * (count * self.planes) as u64;
        }
        (work + stamp.rows as u64) / 32 + 1
    }
}

/// Adds numbers to others.
#[inline(always)]
fn add(target: &mut [f32], source: &[f32]) {
    let ((target, rest), (source, more)) = (target.as_chunks_mut::<LANES>(), source.as_chunks::<LANES>());
    for (values, more) in target.iter_mut().zip(source) {
        (0..LANES).for_each(|lane| values[lane] += more[lane]);
    }
    rest.iter_mut().zip(more).for_each(|(value, more)| *value += more);
}
