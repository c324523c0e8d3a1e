//! The view from above of a drawing, told by its own lines: those of a system have few directions, which are multiples of
//! one angle.

use super::light::Grey;
use crate::projection::Projection;
use lsystem_base::sorted;
use std::f64::consts::{PI, TAU};

/// The most places whose direction is looked at.
const PLACES: usize = 4096;
/// A place is in a line if the light changes there nearly in one direction, as a part of all change.
const CLEAR: f64 = 0.8;
/// The half side of the neighbourhood of a place, in pixels.
const NEAR: i32 = 2;
/// The angles between neighbouring directions, as parts of a half turn: 90, 60, 45, 36, 30, 25.7, 22.5 and 20 degrees.
const PARTS: [usize; 8] = [2, 3, 4, 5, 6, 7, 8, 9];
/// Views that are tried first: tilts in degrees, and the directions of each.
const TILTS: [f64; 3] = [8.0, 16.0, 24.0];
const WAYS: usize = 16;
/// The focal length that is tried first, as a part of the picture's longer side.
const FOCAL: f64 = 0.95;
/// The most that a view stretches, and how near the line far away is: a tilt of 32 degrees and a short focal length.
const MAX: View = [0.62, 0.62, 0.09, 0.09];
const SHORTEST: f64 = 0.65;
/// Of the parts of a half turn, this many are looked at closely.
const CLOSE: usize = 4;
/// The changes of a view that are tried one after the other, of which each is half of the one before.
const CHANGE: f64 = 0.04;
const HALVES: usize = 10;
const ROUNDS: usize = 12;
/// The sides of the squares of a drawing with right angles are equal; a view changes them by at most this factor.
const UNEQUAL: f64 = 1.2;

/// A piece of a line: its place, its direction, and how much it counts.
#[derive(Clone, Copy, Debug)]
struct Piece {
    at: [f64; 2],
    direction: [f64; 2],
    weight: f64,
}

/// A view: how the plane is tilted, and how it is stretched, around the middle of the drawing.
type View = [f64; 4];

const fn projection([a, b, c, d]: View) -> Projection {
    // First tilted, with (a, b) as the line far away, then stretched.
    Projection([[1.0 + c, d, 0.0], [d, 1.0 - c, 0.0], [a, b, 1.0]])
}

/// The projection from the picture to the view from above, around the middle of the drawing. `None` if no view makes the
/// lines multiples of an angle.
pub(super) fn view(grey: &Grey) -> Option<Projection> {
    let mut pieces = pieces(grey);
    if pieces.len() < 64 {
        return None;
    }
    let count = pieces.len() as f64;
    let middle = [0, 1].map(|axis| pieces.iter().map(|piece| piece.at[axis]).sum::<f64>() / count);
    let size =
        pieces.iter().map(|piece| libm::hypot(piece.at[0] - middle[0], piece.at[1] - middle[1])).fold(1.0, f64::max);
    pieces.iter_mut().for_each(|piece| piece.at = [0, 1].map(|axis| (piece.at[axis] - middle[axis]) / size));
    let focal = FOCAL * grey.width.max(grey.height) as f64 / size;
    let few: Vec<Piece> = pieces.iter().copied().step_by(4).collect();
    let starts = starts(focal);
    let near = FOCAL / (focal * SHORTEST);
    let most = [MAX[0] * near, MAX[1] * near, MAX[2], 0.0];
    // For each part of a half turn its best start.
    let spreads: Vec<[f64; PARTS.len()]> = starts.iter().map(|&view| spreads(&few, view)).collect();
    let mut best: Vec<(f64, usize, View)> = (0..PARTS.len())
        .filter_map(|part| {
            let start = (0..starts.len()).min_by(|&a, &b| spreads[a][part].total_cmp(&spreads[b][part]))?;
            Some((spreads[start][part], part, starts[start]))
        })
        .collect();
    sorted::sort_by(&mut best, |a, b| a.0.total_cmp(&b.0));
    let near = best.iter().take(CLOSE).map(|&(_, part, view)| improved(&pieces, part, view, most));
    let (_, part, view) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let mut projection = projection(view);
    let unit = PI / PARTS[part] as f64;
    projection = Projection::turn(-off(&pieces, &projection, unit)).after(projection);
    if PARTS[part] == 2 {
        projection = squared(&pieces, projection, size).after(projection);
    }
    let around = Projection::scaled(size, size).after(projection).after(Projection::scaled(1.0 / size, 1.0 / size));
    Some(around.after(Projection::moved(-middle[0], -middle[1])))
}

/// Views of a camera that is tilted more and more each way.
fn starts(focal: f64) -> Vec<View> {
    let tilted = |tilt: f64, way: usize| {
        let (sin, cos) = libm::sincos(way as f64 / WAYS as f64 * TAU);
        let tilt = tilt.to_radians();
        let far = libm::tan(tilt) / focal;
        // Longer in the direction of the tilt, with the same area.
        let longer = (1.0 - libm::cos(tilt)) / (1.0 + libm::cos(tilt));
        [-far * cos, -far * sin, longer * (cos * cos - sin * sin), longer * 2.0 * sin * cos]
    };
    let all = TILTS.into_iter().flat_map(|tilt| (0..WAYS).map(move |way| tilted(tilt, way)));
    std::iter::once([0.0; 4]).chain(all).collect()
}

/// The pieces of lines of dark ink on white: their directions by the structure tensor (Bigün and Granlund, "Optimal
/// orientation detection of linear symmetry", 1987).
fn pieces(grey: &Grey) -> Vec<Piece> {
    let (width, height) = (grey.width as i32, grey.height as i32);
    let level = |x: i32, y: i32| f64::from(grey.levels[(y * width + x) as usize]);
    let change = |x: i32, y: i32| {
        let [a, b, c] = [-1, 0, 1].map(|by| level(x + 1, y + by) - level(x - 1, y + by));
        let [d, e, f] = [-1, 0, 1].map(|by| level(x + by, y + 1) - level(x + by, y - 1));
        [3.0 * (a + c) + 10.0 * b, 3.0 * (d + f) + 10.0 * e]
    };
    let far = NEAR + 1;
    let inked: Vec<(i32, i32)> = (far..height - far)
        .flat_map(|y| (far..width - far).map(move |x| (x, y)))
        .filter(|&(x, y)| level(x, y) < 128.0)
        .collect();
    let every = inked.len().div_ceil(PLACES).max(1);
    let piece = |&(x, y): &(i32, i32)| {
        let (mut across, mut down, mut both) = (0.0, 0.0, 0.0);
        for (by_x, by_y) in (-NEAR..=NEAR).flat_map(|y| (-NEAR..=NEAR).map(move |x| (x, y))) {
            let [dx, dy] = change(x + by_x, y + by_y);
            across += dx * dx;
            down += dy * dy;
            both += dx * dy;
        }
        let clear = libm::hypot(across - down, 2.0 * both) / (across + down).max(1.0);
        // A line goes across the change.
        let (sin, cos) = libm::sincos(libm::atan2(2.0 * both, across - down) / 2.0);
        let at = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        (clear > CLEAR).then_some(Piece { at, direction: [-sin, cos], weight: clear })
    };
    inked.iter().step_by(every).filter_map(piece).collect()
}

/// Twice the direction of a piece in a view, as a complex number of length 1.
fn doubled(piece: &Piece, projection: &Projection) -> [f64; 2] {
    let [x, y] = projection.direction(piece.at, piece.direction);
    let length = (x * x + y * y).max(1e-12);
    [(x * x - y * y) / length, 2.0 * x * y / length]
}

const fn product([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

/// For each part of a half turn, how far the directions of the pieces spread around its multiples: 0 for not at all, 1 for
/// evenly (the circular variance; Mardia and Jupp, "Directional statistics", 2000).
fn spreads(pieces: &[Piece], view: View) -> [f64; PARTS.len()] {
    let projection = projection(view);
    let mut sums = [[0.0; 2]; PARTS.len()];
    for piece in pieces {
        let once = doubled(piece, &projection);
        let mut power = once;
        for sum in &mut sums {
            power = product(power, once);
            *sum = [sum[0] + piece.weight * power[0], sum[1] + piece.weight * power[1]];
        }
    }
    let all: f64 = pieces.iter().map(|piece| piece.weight).sum();
    sums.map(|[x, y]| 1.0 - libm::hypot(x, y) / all)
}

/// The view near one in which the directions spread least.
fn improved(pieces: &[Piece], part: usize, start: View, most: View) -> (f64, usize, View) {
    let is_usual = |[a, b, c, d]: View| libm::hypot(a, b) <= most[0] && libm::hypot(c, d) <= most[2];
    let spread = |view: View| if is_usual(view) { spreads(pieces, view)[part] } else { f64::INFINITY };
    let (mut best, mut least, mut change) = (start, spread(start), CHANGE);
    for _ in 0..HALVES {
        for _ in 0..ROUNDS {
            let before = least;
            for (axis, by) in (0..4).flat_map(|axis| [(axis, change), (axis, -change)]) {
                let mut view = best;
                view[axis] += by;
                let value = spread(view);
                if value < least {
                    (best, least) = (view, value);
                }
            }
            if least == before {
                break;
            }
        }
        change /= 2.0;
    }
    (least, part, best)
}

/// The turn that brings the directions to multiples of `unit`, as seen from the vertical or, of the few that books begin
/// with, from another one: the smallest.
fn off(pieces: &[Piece], projection: &Projection, unit: f64) -> f64 {
    let parts = (PI / unit).round() as usize;
    let mut sum = [0.0; 2];
    for piece in pieces {
        let once = doubled(piece, projection);
        let power = (1..parts).fold(once, |power, _| product(power, once));
        sum = [sum[0] + piece.weight * power[0], sum[1] + piece.weight * power[1]];
    }
    let own = libm::atan2(sum[1], sum[0]) / (2.0 * parts as f64);
    let headings: &[f64] = if parts <= 4 { &[90.0, 0.0, 45.0] } else { &[90.0] };
    let turns = headings.iter().map(|heading| {
        let off = own - heading.to_radians();
        off - (off / unit).round() * unit
    });
    turns.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or_default()
}

/// The stretch after which the lines of a drawing with right angles are as far apart both ways.
fn squared(pieces: &[Piece], projection: Projection, size: f64) -> Projection {
    // A drawing that stands on its corner is laid on its side for the measure.
    let quarter = PI / 4.0;
    let is_upright = off(pieces, &projection, PI / 2.0).abs() < quarter / 2.0 && {
        let mean: f64 = pieces.iter().map(|piece| doubled(piece, &projection)).map(|once| product(once, once)[0]).sum();
        mean > 0.0
    };
    let turned = if is_upright { 0.0 } else { quarter };
    let laid = Projection::turn(turned).after(projection);
    let mut across: Vec<f64> = Vec::new();
    let mut down: Vec<f64> = Vec::new();
    for piece in pieces {
        let ([x, y], [cos, _]) = (laid.place(piece.at), doubled(piece, &laid));
        if cos > 0.9 {
            down.push(y * size);
        } else if cos < -0.9 {
            across.push(x * size);
        }
    }
    if across.len() < 64 || down.len() < 64 {
        return Projection::NONE;
    }
    let lengths = lengths(size);
    let [across, down] =
        [&across, &down].map(|places| lengths.iter().map(|&length| comb(places, length)).collect::<Vec<f64>>());
    let mut most = (0.0, 1.0);
    for (at, one) in across.iter().enumerate().rev() {
        for (other, two) in down.iter().enumerate().rev() {
            let ratio = lengths[at] / lengths[other];
            // Longer steps come first: each fits a half of it too.
            if ratio < UNEQUAL && ratio > 1.0 / UNEQUAL && one * two > 1.15 * most.0
                || one * two > most.0 && (ratio / most.1 - 1.0).abs() < 0.01
            {
                most = (one * two, ratio);
            }
        }
    }
    let root = libm::sqrt(most.1);
    Projection::turn(-turned).after(Projection::scaled(1.0 / root, root)).after(Projection::turn(turned))
}

/// The lengths of a step that are tried, in pixels: so near to each other that the last line differs by less than a part
/// of a step.
fn lengths(size: f64) -> Vec<f64> {
    let mut lengths = vec![6.0];
    while let Some(&last) = lengths.last().filter(|last| **last < size) {
        lengths.push(last + last * last / (12.0 * size));
    }
    lengths
}

/// How well places are multiples of a length, from 0 to 1.
fn comb(places: &[f64], length: f64) -> f64 {
    let sum = places.iter().fold([0.0, 0.0], |sum, at| {
        let (sin, cos) = libm::sincos(at / length * TAU);
        [sum[0] + cos, sum[1] + sin]
    });
    libm::hypot(sum[0], sum[1]) / places.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_are_those_of_the_angles() {
        let pieces: Vec<Piece> = (0..50)
            .map(|at| {
                let (sin, cos) = libm::sincos(f64::from(at * at) * 0.37);
                let weight = 0.5 + f64::from(at % 5) / 10.0;
                Piece { at: [f64::from(at % 7) / 7.0 - 0.5, f64::from(at) / 50.0 - 0.5], direction: [cos, sin], weight }
            })
            .collect();
        for view in [[0.0; 4], [0.1, -0.05, 0.03, 0.02]] {
            let projection = projection(view);
            for (part, spread) in PARTS.into_iter().zip(spreads(&pieces, view)) {
                let (mut across, mut down, mut all) = (0.0, 0.0, 0.0);
                for piece in &pieces {
                    // The direction of a short way.
                    let ends = [-1e-6, 1e-6]
                        .map(|by| projection.place([0, 1].map(|axis| piece.at[axis] + by * piece.direction[axis])));
                    let angle = libm::atan2(ends[1][1] - ends[0][1], ends[1][0] - ends[0][0]);
                    let (sin, cos) = libm::sincos(2.0 * part as f64 * angle);
                    across += piece.weight * cos;
                    down += piece.weight * sin;
                    all += piece.weight;
                }
                let naive = 1.0 - libm::hypot(across, down) / all;
                assert!((spread - naive).abs() < 1e-6, "{part}: {spread} {naive}");
            }
        }
    }
}
