//! How a node's budget is shared out to the nodes in it.

use super::scene::WIDTH;

/// From this radius on nodes have the same share of the budget, in samples.
const LARGE: f32 = 256.0;
/// How often what a node does not need of a budget is shared out to the others.
const ROUNDS: usize = 2;
/// Enough for everything.
pub(super) const MOST: f32 = 1e30;

/// The weight of a node whose ball has this radius: by the room that it takes, as far as that can be in the tile.
#[inline]
pub(super) fn weight(ball: f32) -> f32 {
    let size = ball.min(LARGE);
    size * size + 1.0
}

/// Shares out a budget: no node gets more than it needs, others by their weights.
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
