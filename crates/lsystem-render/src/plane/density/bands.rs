//! Bands of ink: what stands for a block that is small beside the width of its strokes.

use super::deposit::Deposit;
use crate::plane::descent::Node;
use crate::plane::view::Measure;

/// The part of a whole that may be rounding.
const ROUNDING: f64 = 1e-9;

/// Two bands that cross at the centre of a block, as one outline in pixels, and the area of both. The bands lie along the
/// axes of the strokes' directions and are as long as the strokes are wide. Each is as broad as the block is there, the
/// second by so much less as fewer strokes have its direction.
#[inline]
pub(super) fn bands(
    measure: &Measure,
    deposit: &Deposit,
    node: &Node,
) -> (impl Iterator<Item = [f64; 2]> + use<>, f64) {
    let [xx, xy, yy] = deposit.across;
    let (apart, most) = (xx - yy, libm::hypot(xx - yy, 2.0 * xy));
    // Where no direction stands out, those of the block's own frame.
    let angle = if most > ROUNDING { libm::atan2(2.0 * xy, apart) / 2.0 } else { 0.0 };
    let (sin, cos) = libm::sincos(angle);
    let (c, s) = node.place.heading.cos_sin();
    let (centre, width) = (node.place.point(deposit.centre), measure.width(node.pen.width));
    let band = |[x, y]: [f64; 2], part: f64| {
        // Along the band, and aside; an even distribution over a length has a twelfth of its square.
        let [along, aside] = [[c * x - s * y, -s * x - c * y], [s * x + c * y, c * x - s * y]];
        let square = y * y * deposit.spread[0] - 2.0 * x * y * deposit.spread[1] + x * x * deposit.spread[2];
        let breadth = part * ((12.0 * square.max(0.0)).sqrt() * node.place.scale.abs()).max(1.0);
        let corner = |u: f64, v: f64| [0, 1].map(|i| centre[i] + u * width * along[i] + v * breadth * aside[i]);
        ([corner(0.5, 0.5), corner(-0.5, 0.5), corner(-0.5, -0.5), corner(0.5, -0.5)], width * breadth)
    };
    let (first, area) = band([cos, sin], 1.0);
    let (second, more) = band([-sin, cos], (1.0 - most).max(0.0) / (1.0 + most));
    // From one to the other and back.
    (first.into_iter().chain([first[0]]).chain(second).chain([second[0]]), area + more)
}
