//! Strokes laid on the ink of a photograph by a small projection, since straightening leaves a small error.
//!
//! Places of the strokes are moved across their stroke to the middle of the nearest line, and the projection that does so
//! best is found by weighted least squares, again and again (iterative closest points; Chen and Medioni, "Object modelling
//! by registration of multiple range images", 1992). Where lines meet, the middle of their ink is beside each of them, and a
//! plant's forks all open upwards. So the middle is measured in the strokes' own ink too, where it is off by as much.

use crate::brush::put_stroke;
use crate::projection::Projection;
use crate::squares::{Squares, bisquare};
use lsystem_render::mask::{Mask, SIDE};

/// How far ink is sought on both sides of a stroke, in pixels: round by round.
const REACHES: [i32; 5] = [9, 9, 6, 4, 3];
/// The most places of the strokes, and the least way between two, in pixels.
const PLACES: f64 = 1000.0;
const APART: f64 = 2.0;
/// The pixels that are looked at.
pub(crate) const WORK: u64 = 60_000;
/// Half the side of a picture: the unit of the projection.
const HALF: f64 = SIDE as f64 / 2.0;
/// A run of ink across a stroke that is wider than this many strokes is a stroke along the way.
const WIDE: f64 = 3.0;
/// The most that a projection stretches and leans. Directions turn by at most this many radians each, so the angle between
/// two of them changes by at most twice as much, 2.3 degrees: less than half of the 5 degrees between 20, 25 and 30. So a
/// system does not become one with another angle.
const STRETCH: f64 = 0.02;
const LEAN: f64 = 0.02;
/// The most that it turns, in radians, grows, and moves, in parts of half a side: as near as a hull lies to the ink.
const TURN: f64 = 0.02;
const GROWTH: f64 = 0.04;
const MOVE: f64 = 0.04;

/// The changes of a place (x, y) around the middle: those of the place, and of the line far away.
type Change = [f64; 8];

/// The projection of the pixels that lays strokes on the ink.
pub(crate) fn aligned(strokes: &[[[f64; 2]; 2]], ink: &Mask, stroke: f64) -> Projection {
    let length = |[[x1, y1], [x2, y2]]: &[[f64; 2]; 2]| libm::hypot(x2 - x1, y2 - y1);
    let apart = (strokes.iter().map(length).sum::<f64>() / PLACES).max(APART);
    let mut own = Projection::NONE;
    for reach in REACHES {
        let by = around(own);
        let mut squares = Squares::<8>::NONE;
        let mut begin = 0.0;
        let laid: Vec<[[f64; 2]; 2]> = strokes.iter().map(|ends| ends.map(|at| by.place(at))).collect();
        let mut drawn = Mask::default();
        laid.iter().for_each(|&ends| put_stroke(&mut drawn, ends, stroke));
        for &[[x1, y1], [x2, y2]] in &laid {
            let long = libm::hypot(x2 - x1, y2 - y1);
            let across = [(y1 - y2) / long, (x2 - x1) / long];
            // Places are as far apart from stroke to stroke.
            while begin < long {
                let part = begin / long;
                let at = [x1 + (x2 - x1) * part, y1 + (y2 - y1) * part];
                let off = |mask: &Mask, reach: i32| off(mask, at, across, reach, WIDE * 2.0 * stroke + 1.0);
                if let (Some(there), Some(here)) = (off(ink, reach), off(&drawn, 0)) {
                    let off = there - here;
                    squares.add(row(at, across), off / HALF, bisquare(off, f64::from(reach + 1)));
                }
                begin += apart;
            }
            begin -= if long > 0.0 { long } else { 0.0 };
        }
        let Some(change) = squares.solved() else { break };
        own = bounded(projection(change).after(own));
    }
    around(own)
}

/// A projection around the middle of a picture, in pixels.
fn around(own: Projection) -> Projection {
    let middle = Projection::moved(HALF, HALF).after(Projection::scaled(HALF, HALF));
    middle.after(own).after(middle.inverse())
}

/// How far the middle of the nearest line lies across a stroke at a place, in pixels.
fn off(ink: &Mask, [x, y]: [f64; 2], across: [f64; 2], reach: i32, widest: f64) -> Option<f64> {
    let half = across.map(|across| across / 2.0);
    let has = |off: i32| {
        let (x, y) = (x + half[0] * f64::from(off), y + half[1] * f64::from(off));
        x >= 0.0 && y >= 0.0 && x < SIDE as f64 && y < SIDE as f64 && ink.has(x as usize, y as usize)
    };
    // In half pixels.
    let mut near = 0;
    while !has(near) && !has(-near) {
        near += 1;
        if near > 2 * reach {
            return None;
        }
    }
    let nearest = if has(near) { near } else { -near };
    let most = (2.0 * widest) as i32;
    let run = |by: i32| {
        let mut far = 1;
        while far <= most && has(nearest + by * far) {
            far += 1;
        }
        far
    };
    let (before, after) = (run(-1), run(1));
    (before + after <= most).then(|| f64::from(2 * nearest + after - before) / 4.0)
}

/// How far each change moves a place across.
fn row(at: [f64; 2], [u, v]: [f64; 2]) -> Change {
    let [x, y] = at.map(|at| (at - HALF) / HALF);
    let lean = u * x + v * y;
    [u * x, u * y, u, v * x, v * y, v, -lean * x, -lean * y]
}

const fn projection([a, b, c, d, e, f, g, h]: Change) -> Projection {
    Projection([[1.0 + a, b, c], [d, 1.0 + e, f], [g, h, 1.0]])
}

/// The projection, but with no part larger than allowed.
fn bounded(Projection(m): Projection) -> Projection {
    let whole = m[2][2];
    let [[a, b, c], [d, e, f], [g, h, _]] = m.map(|row| row.map(|at| at / whole));
    let short = |[x, y]: [f64; 2], most: f64| {
        let part = (most / libm::hypot(x, y).max(1e-12)).min(1.0);
        [x * part, y * part]
    };
    let [stretch, slant] = short([(a - e) / 2.0, (b + d) / 2.0], STRETCH);
    let growth = ((a + e) / 2.0 - 1.0).clamp(-GROWTH, GROWTH);
    let turn = ((d - b) / 2.0).clamp(-TURN, TURN);
    let ([c, f], [g, h]) = (short([c, f], MOVE), short([g, h], LEAN));
    projection([growth + stretch, slant - turn, c, slant + turn, growth - stretch, f, g, h])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The strokes of `F -> F[+F]F[-F]F` after three steps, in pixels.
    fn plant(angle: f64) -> Vec<[[f64; 2]; 2]> {
        fn grow(strokes: &mut Vec<[[f64; 2]; 2]>, n: u32, from: [f64; 2], heading: f64, angle: f64) -> [f64; 2] {
            if n == 0 {
                let (sin, cos) = libm::sincos(heading.to_radians());
                let to = [from[0] + 18.0 * cos, from[1] - 18.0 * sin];
                strokes.push([from, to]);
                return to;
            }
            let fork = grow(strokes, n - 1, from, heading, angle);
            grow(strokes, n - 1, fork, heading + angle, angle);
            let fork = grow(strokes, n - 1, fork, heading, angle);
            grow(strokes, n - 1, fork, heading - angle, angle);
            grow(strokes, n - 1, fork, heading, angle)
        }
        let mut strokes = Vec::new();
        grow(&mut strokes, 3, [256.0, 500.0], 90.0, angle);
        strokes
    }

    fn ink(strokes: &[[[f64; 2]; 2]], by: Projection) -> Mask {
        let mut mask = Mask::default();
        strokes.iter().for_each(|ends| put_stroke(&mut mask, ends.map(|at| by.place(at)), 1.5));
        mask
    }

    #[test]
    fn another_angle_stays_another() {
        for (own, other) in [(25.0, 30.0), (25.0, 20.0), (30.0, 36.0)] {
            let (own, other) = (plant(own), plant(other));
            let target = ink(&other, Projection::NONE);
            let agreement = ink(&own, aligned(&own, &target, 1.5)).agreement(&target);
            assert!(agreement < crate::FOUND, "{agreement}");
        }
    }

    #[test]
    fn a_small_projection_is_undone() {
        let plant = plant(25.0);
        let changes = [
            [0.0; 8],
            [0.01, 0.0, 0.0, 0.0, -0.01, 0.0, 0.0, 0.0],
            [0.0, 0.012, 0.01, 0.0, 0.0, -0.01, 0.0, 0.015],
            [0.005, -0.01, -0.01, 0.01, 0.012, 0.005, -0.014, 0.005],
        ];
        for change in changes {
            let truth = around(projection(change));
            let ink = ink(&plant, truth);
            let by = aligned(&plant, &ink, 1.5);
            let off = |at: [f64; 2]| {
                let ([x, y], [u, v]) = (by.place(at), truth.place(at));
                libm::hypot(x - u, y - v)
            };
            let most = plant.iter().flatten().map(|&at| off(at)).fold(0.0, f64::max);
            assert!(most < 1.0, "{change:?}: {most}");
        }
    }

    #[test]
    fn no_part_of_a_projection_is_too_large() {
        let nothing = bounded(projection([0.3, -0.2, 0.5, 0.4, -0.1, 0.3, 0.2, -0.1]));
        let Projection([[a, b, c], [d, e, f], [g, h, _]]) = nothing;
        assert!(libm::hypot(a - e, b + d) / 2.0 <= STRETCH + 1e-9 && libm::hypot(g, h) <= LEAN + 1e-9);
        assert!(libm::hypot(c, f) <= MOVE + 1e-9 && (d - b).abs() / 2.0 <= TURN + 1e-9);
        // Neither ink nor strokes tell anything.
        for strokes in [vec![], vec![[[9.0, 9.0], [9.0, 9.0]]], plant(25.0)] {
            assert_eq!(aligned(&strokes, &Mask::default(), 1.5).place([100.0, 30.0]), [100.0, 30.0]);
        }
    }
}
