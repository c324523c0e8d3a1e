//! Bands of ink, which stand for a block that is small beside the width of its strokes.

use super::deposit::Deposit;
use crate::plane::descent::Node;
use crate::plane::view::Measure;

/// The part of a whole that may be rounding.
const ROUNDING: f64 = 1e-9;

/// Two bands that cross at the centre of a block, as one outline in pixels, and the area of both in square pixels. The
/// bands lie along the principal axes of the strokes' directions across, and are as long as the strokes are wide. The
/// first band is as broad as the block. The second is narrower, as fewer strokes have their width along it.
#[inline]
pub(super) fn bands(
    measure: &Measure,
    deposit: &Deposit,
    node: &Node,
) -> (impl Iterator<Item = [f64; 2]> + use<>, f64) {
    let [xx, xy, yy] = deposit.across;
    let (apart, most) = (xx - yy, libm::hypot(xx - yy, 2.0 * xy));
    // If no direction dominates, the bands lie along the axes of the block's frame.
    let angle = if most > ROUNDING { libm::atan2(2.0 * xy, apart) / 2.0 } else { 0.0 };
    let (sin, cos) = libm::sincos(angle);
    let (c, s) = node.place.heading.cos_sin();
    let (centre, width) = (node.place.point(deposit.centre), deposit.width(measure, node));
    let band = |[x, y]: [f64; 2], part: f64| {
        // The mean square of an even distribution is a twelfth of the square of its length.
        let [along, aside] = [[c * x - s * y, -s * x - c * y], [s * x + c * y, c * x - s * y]];
        let square = y * y * deposit.spread[0] - 2.0 * x * y * deposit.spread[1] + x * x * deposit.spread[2];
        let breadth = part * ((12.0 * square.max(0.0)).sqrt() * node.place.scale.abs()).max(1.0);
        let corner = |u: f64, v: f64| [0, 1].map(|i| centre[i] + u * width * along[i] + v * breadth * aside[i]);
        ([corner(0.5, 0.5), corner(-0.5, 0.5), corner(-0.5, -0.5), corner(0.5, -0.5)], width * breadth)
    };
    let (first, area) = band([cos, sin], 1.0);
    let (second, more) = band([-sin, cos], (1.0 - most).max(0.0) / (1.0 + most));
    // One outline goes around the first band, then around the second, and back.
    (first.into_iter().chain([first[0]]).chain(second).chain([second[0]]), area + more)
}
