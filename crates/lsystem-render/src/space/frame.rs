//! Nodes that are being looked into, on the stack of the descent.

use super::camera::{Lens, NEAR};
use super::light::DIRECTIONS;
use super::path::Stretch;
use super::place::Place;
use super::scene::{Node, Scene, WIDTH};
use super::setup::Setup;
use super::shares::{MOST, shares, weight};
use crate::plane::Shade;
use lsystem_drawing::rotation::dot;

/// Contents are sorted by depth where a node is at least so large, in samples.
const SORTED: f32 = 4.0;

/// A node that is being looked into.
pub(super) struct Frame {
    pub node: u32,
    /// How many of `order` are still to be visited, the nearest last.
    pub left: u8,
    pub order: [u8; WIDTH],
    /// By content: where its ball is in the picture, how large, and how deep its nearest point.
    pub seen: [[f32; WIDTH]; 4],
    pub place: Place,
    pub shade: Shade,
    pub path: Stretch,
    /// In step lengths.
    pub width: f64,
    /// By content: how many strokes and nodes may be looked into for it.
    pub shares: [f32; WIDTH],
    /// What was not needed of the shares so far.
    pub spare: f32,
    /// Towards the light and the viewer, in the node's own frame.
    pub towards: [[f32; 3]; 2],
}

/// How a node is entered.
#[derive(Clone, Copy)]
pub(super) struct Inside {
    pub place: Place,
    pub shade: Shade,
    pub path: Stretch,
    pub width: f64,
    pub share: f32,
}

impl Frame {
    /// A node with all its contents that may be seen in a tile, which has its upper left corner at `corner` and this size.
    #[inline]
    pub(super) fn new(
        scene: &Scene,
        setup: &Setup,
        (corner, size): ([f64; 2], [usize; 2]),
        id: u32,
        inside: Inside,
    ) -> Self {
        let Inside { place, shade, path, width, share } = inside;
        let node = &scene.nodes[id as usize];
        let lens = &setup.lens;
        let seen = balls_seen(node, &place, lens, corner);
        let nearest = (1.0 / NEAR).min(1.0 / (1.0 + (place.origin[2] - 2.0 * place.scale) * lens.nearness).max(NEAR));
        let widest = ((node.own.widest.of(width) * lens.step * nearest / 2.0).max(setup.hairline)) as f32;
        let mut frame = Self {
            node: id,
            left: 0,
            order: [0; WIDTH],
            seen,
            place,
            shade,
            path,
            width,
            shares: [MOST; WIDTH],
            spare: 0.0,
            towards: DIRECTIONS.map(|to| place.axes.map(|axis| (dot(axis, to) / place.scale) as f32)),
        };
        let count = usize::from(node.links) + usize::from(node.lines);
        let scarce = share < node.own.need;
        let mut weights = [0.0; WIDTH];
        let mut kept = 0;
        for (lane, weighs) in weights.iter_mut().enumerate().take(count) {
            let [x, y, r] = [0, 1, 2].map(|i| frame.seen[i][lane]);
            let reach = r + widest;
            let within = |low: [f64; 2], high: [f64; 2]| {
                let [low, high] = [low, high].map(|corner| corner.map(|c| c as f32));
                x + reach >= low[0] && x - reach <= high[0] && y + reach >= low[1] && y - reach <= high[1]
            };
            if within([0.0; 2], size.map(|side| side as f64)) {
                frame.order[kept] = lane as u8;
                kept += 1;
            }
            // Outside of the picture; what is outside of this tile has its share, so that tiles agree.
            if scarce && lane < usize::from(node.links) {
                let seen = within(corner.map(|c| -c), [0, 1].map(|i| setup.size[i] - corner[i]));
                *weighs = if seen { weight(r) } else { 0.0 };
            }
        }
        if scarce {
            let needs = |lane: usize| scene.nodes[scene.links[node.first_link as usize + lane].node as usize].own.need;
            frame.shares = shares(share - f32::from(node.lines), &weights[..usize::from(node.links)], needs);
        } else {
            frame.spare = (share - node.own.need).clamp(0.0, MOST);
        }
        frame.left = kept as u8;
        if place.scale as f32 > SORTED {
            sort_by_depth(&mut frame.order[..kept], &frame.seen[3]);
        }
        frame
    }

    /// Leaves so much of what may still be looked into.
    pub(super) fn hurry(&mut self, scene: &Scene, part: f32) {
        self.spare = 0.0;
        let node = &scene.nodes[self.node as usize];
        let links = &scene.links[node.first_link as usize..][..usize::from(node.links)];
        for (share, link) in self.shares.iter_mut().zip(links) {
            *share = share.min(scene.nodes[link.node as usize].own.need) * part;
        }
    }
}

/// By content of a node: where its ball is in a tile, how large, and how deep its nearest point.
#[inline]
fn balls_seen(node: &Node, place: &Place, lens: &Lens, corner: [f64; 2]) -> [[f32; WIDTH]; 4] {
    let mut seen = [[0.0_f32; WIDTH]; 4];
    let [ax, ay, az] = place.axes.map(|axis| axis.map(|c| c as f32));
    let origin = place.origin.map(|c| c as f32);
    let scale = place.scale as f32;
    let nearness = lens.nearness as f32;
    let middle = [0, 1].map(|i| (lens.middle[i] - corner[i]) as f32);
    // Rounding, where a node is much larger than the picture.
    let slack = 1e-6 * (origin[0].abs() + origin[1].abs() + origin[2].abs() + scale);
    let [bx, by, bz, br] = &node.balls;
    let least = NEAR as f32;
    for i in 0..WIDTH {
        let x = origin[0] + ax[0] * bx[i] + ay[0] * by[i] + az[0] * bz[i];
        let y = origin[1] + ax[1] * bx[i] + ay[1] * by[i] + az[1] * bz[i];
        let z = origin[2] + ax[2] * bx[i] + ay[2] * by[i] + az[2] * bz[i];
        let r = br[i] * scale + slack;
        let factor = 1.0 / (1.0 + z * nearness).max(least);
        let nearest = 1.0 / (1.0 + (z - r) * nearness).max(least);
        // Seen from near by, a ball reaches farther to the side than its middle does.
        let grows = nearest - factor;
        seen[0][i] = middle[0] + x * factor;
        seen[1][i] = middle[1] + y * factor;
        seen[2][i] = r * nearest + grows * x.abs().max(y.abs());
        seen[3][i] = (z - r) * nearest;
    }
    seen
}

/// Sorts contents by how deep they are, the nearest last.
#[inline]
fn sort_by_depth(order: &mut [u8], depth: &[f32; WIDTH]) {
    for i in 1..order.len() {
        let mut j = i;
        while j > 0 && depth[usize::from(order[j - 1])] < depth[usize::from(order[j])] {
            order.swap(j - 1, j);
            j -= 1;
        }
    }
}
