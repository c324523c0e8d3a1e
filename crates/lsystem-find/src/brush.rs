//! Strokes as runs of pixels.

use lsystem_render::mask::{Mask, SIDE};

/// The number of pixels tested in the time that it takes to reject a system by its hull.
pub(crate) const PIXELS: u64 = 256;

/// Gives the pixels ink whose centres are at most `reach` pixels from a stroke.
pub(crate) fn put_stroke(mask: &mut Mask, stroke: [[f64; 2]; 2], reach: f64) {
    for_runs([SIDE, SIDE], stroke, reach, |y, first, last| mask.put_run(y, first, last));
}

/// Calls `put` for the row, the first and the last one of the pixels, of a picture with this width and height, whose
/// centres are at most `reach` pixels from a stroke.
pub(crate) fn for_runs(
    [width, height]: [usize; 2],
    [[x1, y1], [x2, y2]]: [[f64; 2]; 2],
    reach: f64,
    mut put: impl FnMut(usize, usize, usize),
) {
    let (dx, dy) = (x2 - x1, y2 - y1);
    let length = (dx * dx + dy * dy).sqrt();
    if !length.is_finite() {
        return;
    }
    // The pixels whose centres are between two places.
    let within = |low: f64, high: f64, side: usize| {
        let (low, high) = ((low - 0.5).max(0.0), high - 0.5);
        // Casts cut off; what has no pixels may be far away.
        let first = low.min(side as f64) as usize;
        let (first, last) =
            (first + usize::from((first as f64) < low), (high.max(0.0) as usize).min(side.saturating_sub(1)));
        (high >= 0.0 && first <= last && last < side).then_some((first, last))
    };
    let Some((top, bottom)) = within(y1.min(y2) - reach, y1.max(y2) + reach, height) else { return };
    // What is near a stroke has no gaps in a row: it is near an end, or beside the line between both.
    for y in top..=bottom {
        let middle = y as f64 + 0.5;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (x, off) in [(x1, middle - y1), (x2, middle - y2)] {
            let half = (reach * reach - off * off).sqrt();
            if half >= 0.0 {
                (low, high) = (low.min(x - half), high.max(x + half));
            }
        }
        if dy != 0.0 {
            // The middle line is here; the line's sides are further by this; and its ends are across it.
            let (x, aside) = (x1 + (middle - y1) * dx / dy, reach * length / dy.abs());
            let ends = [x1 - (middle - y1) * dy / dx, x2 - (middle - y2) * dy / dx];
            let [mut left, mut right] = [x - aside, x + aside];
            if dx == 0.0 {
                let is_between = y1.min(y2) <= middle && middle <= y1.max(y2);
                right = if is_between { right } else { f64::NEG_INFINITY };
            } else {
                (left, right) = (left.max(ends[0].min(ends[1])), right.min(ends[0].max(ends[1])));
            }
            if left <= right {
                (low, high) = (low.min(left), high.max(right));
            }
        } else if (middle - y1).abs() <= reach {
            (low, high) = (low.min(x1.min(x2)), high.max(x1.max(x2)));
        }
        if let Some((first, last)) = within(low, high, width) {
            put(y, first, last);
        }
    }
}
