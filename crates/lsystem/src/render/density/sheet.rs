//! Sums of ink, pixel by pixel.
//!
//! The unit is one layer: a stroke as wide as a pixel or wider has 1 along its axis. What is thinner than a pixel or
//! shorter is spread over the four pixels around it, by how near they are, so that neither moving nor magnifying a
//! little makes ink jump or vanish.

use core::ops::Range;

/// What ink is added with it: how much it darkens red, green and blue ([`super::pigment`]).
pub(super) type Pigment = [f32; 3];

/// Wider strokes are filled, others put together from lines.
const BROAD: f64 = 4.0;
/// The least that is added of any ink: a 2^200th part of the most there can be. A trunk beside 10^100 twigs is there.
pub(super) const LEAST: f64 = 1.0 / (1_u128 << 110) as f64;
/// How many points of a line are drawn for each pixel of its length.
const POINTS: f64 = 2.0;
/// Rows into which a pixel is divided where areas are filled.
const ROWS: usize = 4;

/// Numbers of pixels, row by row. Coordinates are pixels, y down.
#[derive(Default)]
pub(super) struct Sheet {
    pub width: usize,
    pub height: usize,
    /// Numbers of a pixel: 1, the ink, or 4, the ink and its pigments.
    pub planes: usize,
    /// One unit is `2^exponent` layers of ink.
    pub exponent: i32,
    pub values: Vec<f32>,
    /// By row: where there may be anything.
    pub reach: Vec<Range<u32>>,
    crossings: Vec<(f64, i32)>,
}

/// Values to be added to a sheet: those of a small picture, in the same unit.
pub(super) struct Stamp<'a> {
    pub planes: usize,
    /// By row: its first column, its end, and where its values begin.
    pub rows: &'a [(u32, u32, u32)],
    pub values: &'a [f32],
}

impl Sheet {
    /// Makes it empty.
    pub(super) fn reset(&mut self, [width, height]: [usize; 2], planes: usize, exponent: i32) {
        self.exponent = exponent;
        if (self.width, self.height, self.planes) == (width, height, planes) {
            for (row, reach) in self.reach.iter_mut().enumerate() {
                let at = row * width;
                self.values[(at + reach.start as usize) * planes..(at + reach.end as usize) * planes].fill(0.0);
                *reach = 0..0;
            }
            return;
        }
        (self.width, self.height, self.planes) = (width, height, planes);
        self.values.clear();
        self.values.resize(width * height * planes, 0.0);
        self.reach.clear();
        self.reach.resize(height, 0..0);
    }

    /// One layer of ink, in units of this sheet.
    pub(super) fn layer(&self) -> f64 {
        libm::scalbn(1.0, self.exponent.saturating_neg()).max(LEAST)
    }

    /// Whether something with these bounds does not show.
    pub(super) fn misses(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        // Not a number shows nothing either.
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
    pub(super) fn dot(&mut self, [x, y]: [f64; 2], weight: f32, pigment: Pigment) {
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

    /// Adds a stroke with flat ends that lays down `layer` units of ink wherever it is, and is `width` pixels wide: less
    /// than one means so much less ink. Returns how much work it was.
    pub(super) fn stroke(&mut self, ends: [[f64; 2]; 2], width: f64, layer: f64, pigment: Pigment) -> i64 {
        let Some([from, to]) = self.clipped(ends, width) else { return 1 };
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = (dx * dx + dy * dy).sqrt();
        if length == 0.0 {
            return 1;
        }
        let aside = [-dy / length, dx / length];
        if width > BROAD {
            let side = |p: [f64; 2], sign: f64| [0, 1].map(|i| p[i] + sign * 0.5 * width * aside[i]);
            return self.fill(&[side(from, 1.0), side(to, 1.0), side(to, -1.0), side(from, -1.0)], layer, pigment);
        }
        let lines = width.ceil().max(1.0);
        let points = (length * POINTS).ceil().max(1.0);
        let weight = (layer * width * length / (lines * points)) as f32;
        let step = [dx / points, dy / points];
        for line in 0..lines as usize {
            let off = ((line as f64 + 0.5) / lines - 0.5) * width;
            let start = [0, 1].map(|i| from[i] + off * aside[i] + 0.5 * step[i]);
            for point in 0..points as usize {
                let point = point as f64;
                self.dot([start[0] + point * step[0], start[1] + point * step[1]], weight, pigment);
            }
        }
        (lines * points) as i64 / 4 + 1
    }

    /// The part of a segment that can be seen.
    fn clipped(&self, [from, to]: [[f64; 2]; 2], width: f64) -> Option<[[f64; 2]; 2]> {
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
        // Numbers out of range leave nothing either.
        if !(start < end && delta.iter().chain(&from).all(|v| v.is_finite())) {
            return None;
        }
        let at = |t: f64| [from[0] + t * delta[0], from[1] + t * delta[1]];
        Some([if start > 0.0 { at(start) } else { from }, if end < 1.0 { at(end) } else { to }])
    }

    /// Adds `layer` units of ink inside an outline, where it winds around a number of times other than zero. Returns
    /// how much work it was.
    pub(super) fn fill(&mut self, vertices: &[[f64; 2]], layer: f64, pigment: Pigment) -> i64 {
        let (low, high) = vertices
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), vertex| (low.min(vertex[1]), high.max(vertex[1])));
        if !(low < high && vertices.iter().flatten().all(|v| v.is_finite())) {
            return 1;
        }
        let rows = (low.max(0.0) as usize).min(self.height)..(high.ceil().max(0.0) as usize).min(self.height);
        let layer = (layer / ROWS as f64) as f32;
        let mut crossings = core::mem::take(&mut self.crossings);
        let mut work = 0;
        for part in rows.start * ROWS..rows.end * ROWS {
            let y = (part as f64 + 0.5) / ROWS as f64;
            crossings.clear();
            let next = vertices.iter().cycle().skip(1);
            crossings.extend(vertices.iter().zip(next).filter_map(|(a, b)| {
                let turn = i32::from(a[1] <= y) - i32::from(b[1] <= y);
                (turn != 0).then(|| (a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), turn))
            }));
            crossings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let mut winding = 0;
            for pair in crossings.windows(2) {
                winding += pair[0].1;
                if winding != 0 {
                    work += self.span(part / ROWS, [pair[0].0, pair[1].0], layer, pigment);
                }
            }
        }
        self.crossings = crossings;
        (work + (rows.len() * vertices.len()) as i64) / 16 + 1
    }

    /// Adds to a part of a row.
    fn span(&mut self, row: usize, sides: [f64; 2], layer: f32, pigment: Pigment) -> i64 {
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
        (end - first) as i64
    }

    /// Adds a small picture with its upper left corner at (`x`, `y`). Without pigments of its own it takes this one.
    pub(super) fn stamp(&mut self, stamp: &Stamp<'_>, [x, y]: [i64; 2], pigment: Pigment) -> i64 {
        let mut work = 1;
        let above = (-y).clamp(0, stamp.rows.len() as i64) as usize;
        for (row, &(first, end, at)) in stamp.rows.iter().enumerate().skip(above) {
            let to = (y + row as i64) as usize;
            if to >= self.height {
                break;
            }
            let left = (x + i64::from(first)).max(0);
            let right = (x + i64::from(end)).min(self.width as i64);
            if left >= right {
                continue;
            }
            let from = at as usize + (left - x - i64::from(first)) as usize * stamp.planes;
            let (left, right) = (left as usize, right as usize);
            self.extend(to, left, right);
            let source = &stamp.values[from..from + (right - left) * stamp.planes];
            let at = to * self.width;
            let target = &mut self.values[(at + left) * self.planes..(at + right) * self.planes];
            if stamp.planes == self.planes {
                for (value, more) in target.iter_mut().zip(source) {
                    *value += more;
                }
            } else {
                let [r, g, b] = pigment;
                for (values, more) in target.chunks_exact_mut(4).zip(source) {
                    values[0] += more;
                    values[1] += more * r;
                    values[2] += more * g;
                    values[3] += more * b;
                }
            }
            work += (right - left) as i64 * self.planes as i64;
        }
        work / 64 + 1
    }
}
