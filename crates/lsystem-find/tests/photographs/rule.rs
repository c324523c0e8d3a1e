//! When two figures are the same, told naively: place by place, without the finder.

use super::camera::unit;

/// The sides of the plane in which figures are compared, in pixels of a page.
const SIDES: [usize; 2] = [1000, 800];
/// The pixels between two places of a stroke.
const APART: f64 = 0.5;

/// Whether all places of each figure are at most `width` pixels of the page from some place of the other one, both laid on
/// the page by the middles of their boxes.
pub(crate) fn are_within(one: &[[f64; 4]], other: &[[f64; 4]], width: f64) -> bool {
    let [one, other] = [places(one), places(other)];
    let is_near = |all: &[[f64; 2]], from: &[[f64; 2]]| {
        let near = near(from, width);
        all.iter().all(|&[x, y]| near[y as usize * SIDES[0] + x as usize])
    };
    is_near(&one, &other) && is_near(&other, &one)
}

fn places(segments: &[[f64; 4]]) -> Vec<[f64; 2]> {
    let (unit, middle) = unit(segments);
    let place = |x: f64, y: f64| {
        [(x - middle[0]) * unit + SIDES[0] as f64 / 2.0, (middle[1] - y) * unit + SIDES[1] as f64 / 2.0]
    };
    let mut places = Vec::new();
    for &[a, b, c, d] in segments {
        let ([x1, y1], [x2, y2]) = (place(a, b), place(c, d));
        let steps = (libm::hypot(x2 - x1, y2 - y1) / APART).ceil().max(1.0);
        for step in 0..=steps as usize {
            let along = step as f64 / steps;
            places.push([x1 + (x2 - x1) * along, y1 + (y2 - y1) * along]);
        }
    }
    places
}

/// The pixels whose middles are at most `width` from a place, and half a pixel for theirs.
fn near(places: &[[f64; 2]], width: f64) -> Vec<bool> {
    let far = width + 0.5;
    let mut near = vec![false; SIDES[0] * SIDES[1]];
    let mut last = [-1.0, -1.0];
    for &[x, y] in places {
        // Places of short strokes lie in the same pixel again and again.
        if [x.floor(), y.floor()] == last {
            continue;
        }
        last = [x.floor(), y.floor()];
        for row in (y - far).max(0.0) as usize..=((y + far) as usize).min(SIDES[1] - 1) {
            for column in (x - far).max(0.0) as usize..=((x + far) as usize).min(SIDES[0] - 1) {
                near[row * SIDES[0] + column] |= libm::hypot(column as f64 + 0.5 - x, row as f64 + 0.5 - y) <= far;
            }
        }
    }
    near
}
