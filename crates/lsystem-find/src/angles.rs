//! Estimates of the turning angle, from the directions of a picture's strokes.

use crate::picture::Picture;
use lsystem_render::mask::SIDE;

/// The angles that are tried where none is known, in degrees: those of the field's books.
const USUAL: [f64; 14] = [90.0, 60.0, 120.0, 45.0, 30.0, 36.0, 72.0, 22.5, 25.0, 20.0, 25.7, 15.0, 18.0, 85.0];
/// The least advantage, as a share of the strokes, by which another whole number of degrees must explain the strokes
/// better than all usual angles; and the most such angles that are tried.
const BETTER: f64 = 0.1;
const OTHERS: usize = 2;
/// The number of places in which the ink is sampled, roughly.
const PLACES: usize = 3000;
/// The shortest and the longest stroke, in pixels each way.
const SHORTEST: usize = 5;
const LONGEST: usize = 40;
/// The error of a stroke's direction, in degrees.
const OFF: f64 = 3.0;
/// The most turns from the first heading that are considered.
const TURNS: i32 = 8;

/// The angles in degrees, those first that explain the directions of the strokes best, with one of the headings.
pub(crate) fn suggested(picture: &Picture, headings: &[f64]) -> Vec<f64> {
    let histogram = histogram(picture);
    let score = |angle: f64| headings.iter().map(|&heading| score(&histogram, angle, heading)).fold(f64::MIN, f64::max);
    let sorted = |angles: &mut Vec<f64>| angles.sort_by(|&a, &b| score(b).total_cmp(&score(a)));
    let mut angles = USUAL.to_vec();
    sorted(&mut angles);
    let best = score(angles[0]);
    let mut others: Vec<f64> = (10..=90).map(f64::from).filter(|&angle| score(angle) > best + BETTER).collect();
    sorted(&mut others);
    others.truncate(OTHERS);
    others.extend(angles);
    others
}

/// The share of the strokes whose headings are multiples of an angle, minus the share expected by chance.
fn score(histogram: &[f64; 180], angle: f64, heading: f64) -> f64 {
    let is_led_to = |direction: usize| {
        (-TURNS..=TURNS).any(|turns| {
            let off = (heading + angle * f64::from(turns) - direction as f64).rem_euclid(180.0);
            off.min(180.0 - off) <= OFF
        })
    };
    let led_to: Vec<usize> = (0..180).filter(|&direction| is_led_to(direction)).collect();
    led_to.iter().map(|&direction| histogram[direction]).sum::<f64>() - led_to.len() as f64 / 180.0
}

/// The part of the strokes with each direction, in degrees from 0 to 179 counter-clockwise from the right.
fn histogram(picture: &Picture) -> [f64; 180] {
    let every = (picture.mask.count() as usize / PLACES).max(1);
    let places = (0..SIDE * SIDE).filter(|at| picture.mask.has(at % SIDE, at / SIDE)).step_by(every);
    let ways: Vec<(f64, f64)> = (0..180).map(|degrees| libm::sincos(f64::from(degrees).to_radians())).collect();
    let mut histogram = [0.0; 180];
    for place in places {
        let (x, y) = ((place % SIDE) as f64 + 0.5, (place / SIDE) as f64 + 0.5);
        let is_inked = |step: f64, (sin, cos): (f64, f64)| {
            let (x, y) = (x + step * cos, y - step * sin);
            x >= 0.0 && y >= 0.0 && x < SIDE as f64 && y < SIDE as f64 && picture.mask.has(x as usize, y as usize)
        };
        let run = |way: &(f64, f64)| {
            let ahead = |sign: f64| (1..=LONGEST).take_while(|&step| is_inked(sign * step as f64, *way)).count();
            ahead(1.0) + ahead(-1.0)
        };
        let runs: Vec<usize> = ways.iter().map(run).collect();
        let longest = runs.iter().copied().max().unwrap_or(0);
        if longest < 2 * SHORTEST {
            continue;
        }
        // The middle of the directions that are as long, as seen from the first of them.
        let first = (0..180).find(|&at| runs[at] == longest && runs[(at + 179) % 180] < longest).unwrap_or(0);
        let count = (0..180).take_while(|by| runs[(first + by) % 180] == longest).count();
        histogram[(first + (count - 1) / 2) % 180] += longest as f64;
    }
    let sum: f64 = histogram.iter().sum();
    histogram.iter_mut().for_each(|at| *at /= sum.max(1.0));
    histogram
}
