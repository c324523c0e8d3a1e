//! The shares of a node's budget for the nodes inside.

use super::scene::WIDTH;

/// Nodes with at least this radius, in samples, have the same weight.
const LARGEST_RADIUS: f32 = 256.0;
/// How often the rest that nodes do not need is shared out to the others.
const ROUNDS: usize = 2;
/// A budget for any number of contents.
pub(super) const UNLIMITED: f32 = 1e30;

/// The weight of a node whose ball has this radius in samples: about its area in the picture.
#[inline]
pub(super) fn weight(ball: f32) -> f32 {
    let size = ball.min(LARGEST_RADIUS);
    size * size + 1.0
}

/// Shares out a budget by weights. A node that needs less than its share gets only its need and 1 more.
pub(super) fn shares(mut budget: f32, weights: &[f32], needs: impl Fn(usize) -> f32) -> [f32; WIDTH] {
    let mut shares = [0.0; WIDTH];
    let mut open = [0.0; WIDTH];
    open[..weights.len()].copy_from_slice(weights);
    let mut sum: f32 = weights.iter().sum();
    for _ in 0..ROUNDS {
        let per = (budget / sum.max(1e-30)).max(0.0);
        for lane in 0..weights.len() {
            let need = needs(lane) + 1.0;
            if open[lane] > 0.0 && need <= per * open[lane] {
                shares[lane] = need;
                budget -= need;
                sum -= open[lane];
                open[lane] = 0.0;
            }
        }
    }
    let per = (budget / sum.max(1e-30)).max(0.0);
    for lane in 0..weights.len() {
        if open[lane] > 0.0 {
            shares[lane] = per * open[lane];
        }
    }
    shares
}
