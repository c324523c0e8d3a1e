//! What a drawing is worth: measured on its segments, seen from the front.

use crate::{Family, Moments};
use lsystem_base::sorted;
use lsystem_base::{Limits, Progress};
use lsystem_drawing::{Figure, System};
use lsystem_syntax::Definition;

/// The sides of the grid on which ink is counted.
const SIDE: usize = 64;
/// The most segments and polygons of a drawing that is judged.
pub const SEGMENTS: u128 = 12_000;
/// Limits of a drawing that is judged.
pub const LIMITS: Limits =
    Limits { symbols: 1 << 18, modules: 1 << 17, segments: 1 << 17, work: 1 << 19, memory: 32 << 20 };

/// The most units of work for one generation of a system: some tens of milliseconds. Nearly all that pass take less.
const DRAWING_WORK: u64 = 300_000;
/// The units of work that stand for measuring one line.
const LINE_WORK: u64 = 4;

/// Why a system is not worth keeping.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Rejection {
    /// The system has an error, or its drawing passes a limit.
    Fails,
    /// There is nothing, or nearly nothing, to see.
    Empty,
    /// All lies in a narrow strip.
    Strip,
    /// The generations hardly grow, or explode.
    Growth,
    /// Much is drawn upon itself.
    Overlap,
    /// The picture is an even surface, or a heap of ink in a few places.
    Surface,
    /// The picture is nearly a single line.
    Line,
    /// The parts hang to one side, or below the foot.
    Balance,
    /// The gallery has the same drawing.
    Known,
}

/// Measurements of a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Merit {
    /// Segments and polygons.
    pub segments: u128,
    /// Shorter side / longer side.
    pub proportion: f64,
    /// The part of the segments that lie upon others.
    pub overlap: f64,
    /// The part of the grid's cells with ink.
    pub coverage: f64,
    /// The dimension by counting boxes.
    pub dimension: f64,
    /// The distance of the centre of ink from the middle of the picture, as a part of its side.
    pub lean: f64,
    /// How alike the picture's left and right side are, 0 to 1.
    pub symmetry: f64,
    /// All of these as one number; more is better.
    pub score: f64,
}

/// Measures a system of a family and finds its number of iterations: the largest whose drawing has few enough
/// segments, at most [`SEGMENTS`].
///
/// # Errors
/// Why nobody would keep it.
pub fn judge(definition: &mut Definition, family: Family) -> Result<Merit, Rejection> {
    judge_counted(definition, family, &mut 0)
}

/// As [`judge`]; adds the units of work that the drawings took.
pub(crate) fn judge_counted(definition: &mut Definition, family: Family, work: &mut u64) -> Result<Merit, Rejection> {
    let Ok(system) = System::new(definition) else { return Err(Rejection::Fails) };
    let most = match family {
        // Drawings made symbol by symbol take longer.
        Family::Chance | Family::Tree => SEGMENTS / 2,
        // Shorter segments would be hairlines.
        Family::Curve | Family::Island => SEGMENTS / 4,
        _ => SEGMENTS,
    };
    let mut draw = |n: u32| {
        let mut drawer = Figure::drawer(&system, n, LIMITS);
        let progress = drawer.step(DRAWING_WORK);
        *work = work.saturating_add(drawer.spent());
        if progress == Progress::More { Err(Rejection::Fails) } else { drawer.finish().map_err(|_| Rejection::Fails) }
    };
    let figure = if family == Family::Head {
        draw(definition.iterations)?
    } else {
        let (figure, n) = largest(&mut draw, most)?;
        definition.iterations = n;
        figure
    };
    let lines = lines(&figure);
    *work = work.saturating_add(LINE_WORK * lines.len() as u64);
    merit(&figure, &lines, family)
}

/// The largest drawing with few enough segments, and its number of iterations.
fn largest(mut draw: impl FnMut(u32) -> Result<Figure, Rejection>, most: u128) -> Result<(Figure, u32), Rejection> {
    let many = |figure: &Figure| figure.segment_count().saturating_add(figure.polygon_count());
    let mut best = None;
    let mut former = 0;
    for n in 1..=14 {
        let Ok(figure) = draw(n) else { break };
        let count = many(&figure);
        if count > most {
            break;
        }
        if n > 4 && 4 * count < 5 * former {
            return Err(Rejection::Growth);
        }
        former = count;
        best = Some((figure, n));
    }
    match best {
        Some((figure, n)) if n >= 3 => Ok((figure, n)),
        Some(_) => Err(Rejection::Growth),
        None => Err(Rejection::Fails),
    }
}

/// The segments of a figure and the middle lines of its polygons, from the front.
pub fn lines(figure: &Figure) -> Vec<[[f64; 2]; 2]> {
    let flat = |point: [f64; 3]| [point[0], point[1]];
    let mut lines: Vec<_> = figure
        .segments_from(0)
        .map(|segment| [flat(segment.from), flat(segment.to)])
        .take(2 * SEGMENTS as usize)
        .collect();
    for number in 0..figure.polygon_count().min(SEGMENTS) {
        let vertices = figure.vertices(number).unwrap_or_default();
        if let (Some(first), Some(middle)) = (vertices.first(), vertices.get(vertices.len() / 2)) {
            lines.push([flat(*first), flat(*middle)]);
        }
    }
    lines
}

fn merit(figure: &Figure, lines: &[[[f64; 2]; 2]], family: Family) -> Result<Merit, Rejection> {
    let segments = figure.segment_count().saturating_add(figure.polygon_count());
    if segments < 60 || lines.is_empty() {
        return Err(Rejection::Empty);
    }
    if !figure.is_solid() && Moments::of(lines).is_in_gallery() {
        return Err(Rejection::Known);
    }
    let (low, size) = frame(lines);
    let longest = size[0].max(size[1]);
    if !longest.is_finite() || longest <= 0.0 {
        return Err(Rejection::Empty);
    }
    let proportion = size[0].min(size[1]) / longest;
    if proportion < 0.3 {
        return Err(Rejection::Strip);
    }
    let grid = Grid::of(lines, low, size, longest);
    let overlap = if figure.is_solid() { 0.0 } else { overlap(lines, longest) };
    if overlap > if family.grows() { 0.45 } else { 0.06 } {
        return Err(Rejection::Overlap);
    }
    let (coverage, dimension) = (grid.coverage(), grid.dimension());
    let (lean, symmetry) = (grid.lean(), grid.symmetry());
    let least = match family {
        Family::Curve | Family::Island => 0.22,
        _ => 0.1,
    };
    if coverage < least || dimension < 1.12 {
        return Err(Rejection::Line);
    }
    if coverage > 0.8 || grid.is_even() {
        return Err(Rejection::Surface);
    }
    let foot = lines.first().map_or(0.0, |line| (line[0][1] - low[1]) / longest);
    let aside = lines.first().map_or(0.0, |line| ((line[0][0] - low[0]) / size[0] - 0.5).abs());
    if family.grows() && (foot > 0.12 || aside > 0.32 || proportion < 0.4) || lean > 0.2 {
        return Err(Rejection::Balance);
    }
    let near = |value: f64, best: f64, width: f64| libm::exp(-((value - best) / width) * ((value - best) / width));
    let score = near(coverage, if family.grows() { 0.3 } else { 0.4 }, 0.25)
        + near(dimension, 1.6, 0.3)
        + 0.8 * proportion
        + 0.7 * symmetry
        + 0.5 * grid.variety()
        - 1.5 * overlap
        - 2.0 * lean;
    Ok(Merit { segments, proportion, overlap, coverage, dimension, lean, symmetry, score })
}

/// The least coordinates of some lines, and the width and height of all.
pub(crate) fn frame(lines: &[[[f64; 2]; 2]]) -> ([f64; 2], [f64; 2]) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in lines.iter().flatten() {
        for i in 0..2 {
            low[i] = low[i].min(point[i]);
            high[i] = high[i].max(point[i]);
        }
    }
    (low, [high[0] - low[0], high[1] - low[1]])
}

/// The part of the segments that lie upon others.
pub(crate) fn overlap(lines: &[[[f64; 2]; 2]], longest: f64) -> f64 {
    let cell = longest * 1e-6;
    let key = |line: &[[f64; 2]; 2]| {
        let place = |point: [f64; 2]| point.map(|c| (c / cell + 0.5).floor() as i64);
        let (a, b) = (place(line[0]), place(line[1]));
        (a.min(b), a.max(b))
    };
    let mut keys: Vec<_> = lines.iter().map(key).collect();
    sorted::sort(&mut keys);
    keys.dedup();
    1.0 - keys.len() as f64 / lines.len() as f64
}

/// The ink of a picture in square cells.
struct Grid {
    cells: Vec<f32>,
    /// Columns and rows with a part of the picture.
    used: [usize; 2],
}

impl Grid {
    fn of(lines: &[[[f64; 2]; 2]], low: [f64; 2], size: [f64; 2], longest: f64) -> Self {
        let scale = SIDE as f64 / longest * (1.0 - 1e-9);
        let mut cells = vec![0.0; SIDE * SIDE];
        for [from, to] in lines {
            let (x, y) = (to[0] - from[0], to[1] - from[1]);
            let length = libm::sqrt(x * x + y * y) * scale;
            let steps = (2.0 * length).ceil().clamp(1.0, 256.0) as usize;
            for step in 0..steps {
                let part = (step as f64 + 0.5) / steps as f64;
                let at = |i: usize| (((from[i] + part * (to[i] - from[i]) - low[i]) * scale) as usize).min(SIDE - 1);
                cells[at(1) * SIDE + at(0)] += (length / steps as f64) as f32;
            }
        }
        let used = size.map(|side| ((side * scale).ceil() as usize).clamp(1, SIDE));
        Self { cells, used }
    }

    fn is_inked(&self, column: usize, row: usize) -> bool {
        self.cells[row * SIDE + column] > 0.0
    }

    /// The cells of the picture.
    fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let [columns, rows] = self.used;
        (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)))
    }

    fn inked(&self) -> usize {
        self.places().filter(|&(column, row)| self.is_inked(column, row)).count()
    }

    fn coverage(&self) -> f64 {
        self.inked() as f64 / (self.used[0] * self.used[1]) as f64
    }

    /// By counting cells with ink, and cells four times as wide.
    fn dimension(&self) -> f64 {
        let mut wide = [false; (SIDE / 4) * (SIDE / 4)];
        for (column, row) in self.places().filter(|&(column, row)| self.is_inked(column, row)) {
            wide[row / 4 * (SIDE / 4) + column / 4] = true;
        }
        let wide = wide.iter().filter(|inked| **inked).count();
        libm::log(self.inked() as f64 / wide.max(1) as f64) / libm::log(4.0)
    }

    /// The mean amount of ink in a cell with ink, and its standard deviation.
    fn spread(&self) -> (f64, f64) {
        let inks = || self.cells.iter().filter(|ink| **ink > 0.0).map(|ink| f64::from(*ink));
        let count = inks().count().max(1) as f64;
        let mean = inks().sum::<f64>() / count;
        let variance = inks().map(|ink| (ink - mean) * (ink - mean)).sum::<f64>() / count;
        (mean, libm::sqrt(variance))
    }

    /// Whether the picture is one surface of even ink.
    fn is_even(&self) -> bool {
        let (mean, deviation) = self.spread();
        self.coverage() > 0.7 && deviation < 0.4 * mean
    }

    /// How different the cells are, 0 to 1.
    fn variety(&self) -> f64 {
        let (mean, deviation) = self.spread();
        (deviation / mean).min(1.0)
    }

    /// The distance of the centre of the cells with ink from the middle, as a part of the side.
    fn lean(&self) -> f64 {
        let count = self.inked().max(1) as f64;
        let inked = || self.places().filter(|&(column, row)| self.is_inked(column, row));
        let x = inked().map(|(column, _)| column as f64 + 0.5).sum::<f64>() / count;
        (x - 0.5 * self.used[0] as f64).abs() / SIDE as f64
    }

    /// The part of the cells with ink whose mirror image about the upright has ink.
    fn symmetry(&self) -> f64 {
        let [columns, _] = self.used;
        let alike = self
            .places()
            .filter(|&(column, row)| self.is_inked(column, row) && self.is_inked(columns - 1 - column, row))
            .count();
        alike as f64 / self.inked().max(1) as f64
    }
}
