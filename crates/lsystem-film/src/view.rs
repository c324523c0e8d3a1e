//! Views between two views.

use lsystem_render::View;

/// Below this zoom the rounding remainders are far less than a pixel and are dropped, as on the page
/// (`www/js/view/view.js`).
const COARSE: f64 = 1e6;

/// The numbers of the view between two views, at `part` from 0 to 1: a zoom about the point that both views share, or a
/// pan. The page moves in the same way.
pub(crate) fn between(from: View, to: View, part: f64) -> Vec<f64> {
    if part == 0.0 {
        return numbers(from);
    }
    let zoom = mix_zoom(from.zoom, to.zoom, part);
    let whole = 1.0 / from.zoom - 1.0 / to.zoom;
    let is_pan = whole.abs() < 1e-9 / from.zoom;
    let left = if is_pan { 1.0 - part } else { (1.0 / zoom - 1.0 / to.zoom) / whole };
    let [x, fx] = sum(to.x, to.fine[0], (from.x - to.x + (from.fine[0] - to.fine[0])) * left);
    let [y, fy] = sum(to.y, to.fine[1], (from.y - to.y + (from.fine[1] - to.fine[1])) * left);
    numbers(View { x, y, zoom, fine: [fx, fy] })
}

/// The numbers of a view.
fn numbers(View { x, y, zoom, fine: [fx, fy] }: View) -> Vec<f64> {
    if zoom < COARSE { vec![x, y, zoom] } else { vec![x, y, zoom, fx, fy] }
}

/// `high + low + value` as a number and its rounding remainder (Knuth's two-sum).
fn sum(high: f64, low: f64, value: f64) -> [f64; 2] {
    let whole = high + value;
    let rest = whole - high;
    let fine = low + (high - (whole - rest) + (value - rest));
    [whole + fine, fine - (whole + fine - whole)]
}

/// A zoom between two zooms: equal parts of the time magnify by equal factors.
pub(crate) fn mix_zoom(from: f64, to: f64, part: f64) -> f64 {
    if from == to { from } else { from * libm::pow(to / from, part) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dive_ends_at_its_place_and_never_jumps() {
        let to = View { x: 0.125, y: -0.3, zoom: 1e19, fine: [1.25e-18, -3e-18] };
        let start = View::default();
        assert_eq!(between(start, to, 0.0), [0.0, 0.0, 1.0]);
        assert_eq!(between(start, to, 1.0), [0.125, -0.3, 1e19, 1.25e-18, -3e-18]);
        // The centre of the next view stays inside the picture of the view before.
        let steps = 250;
        let mut before = between(start, to, 0.0);
        for step in 1..=steps {
            let next = between(start, to, f64::from(step) / f64::from(steps));
            let fine = |view: &[f64], at: usize| view.get(at).copied().unwrap_or(0.0);
            for axis in 0..2 {
                let moved = next[axis] - before[axis] + (fine(&next, 3 + axis) - fine(&before, 3 + axis));
                assert!((moved * before[2]).abs() < 0.1, "{step}: {moved}");
            }
            assert!(next[2] / before[2] < 1.2);
            before = next;
        }
    }
}
