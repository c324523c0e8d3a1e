//! Nodes that are being looked into, on the stack of the descent.

use super::camera::{Lens, NEAR};
use super::light::DIRECTIONS;
use super::path::Stretch;
use super::place::Place;
use super::scene::{Scene, SceneNode, WIDTH};
use super::setup::Setup;
use super::shares::{UNLIMITED, shares, weight};
use crate::ink::Shade;
use lsystem_drawing::Widths;
use lsystem_drawing::rotation::dot;

/// A node with more samples to a unit than this has its contents sorted by depth.
const SORTED: f32 = 4.0;

/// A node that is being looked into.
pub(super) struct OpenNode {
    pub node: u32,
    /// The number of contents in `order` that are still to be visited.
    pub left: u8,
    /// The contents that may be visible, the nearest last.
    pub order: [u8; WIDTH],
    /// The balls of the contents in the tile, in samples: x, y, radius, and the depth of the nearest point.
    pub balls: [[f32; WIDTH]; 4],
    pub place: Place,
    pub shade: Shade,
    pub path: Stretch,
    pub widths: Widths,
    /// By content: the strokes and nodes that may be looked into.
    pub shares: [f32; WIDTH],
    /// The rest that contents did not need of their shares so far.
    pub spare: f32,
    /// The directions towards the light and the viewer, in the node's own frame.
    pub towards: [[f32; 3]; 2],
}

/// The state in which a node is entered.
#[derive(Clone, Copy)]
pub(super) struct Entry {
    pub place: Place,
    pub shade: Shade,
    pub path: Stretch,
    pub widths: Widths,
    pub share: f32,
}

impl OpenNode {
    /// Opens a node, with all contents that may be visible in a tile of this `size` whose upper left corner is at
    /// `corner`.
    #[inline]
    pub(super) fn new(
        scene: &Scene,
        setup: &Setup,
        (corner, size): ([f64; 2], [usize; 2]),
        id: u32,
        entry: Entry,
    ) -> Self {
        let Entry { place, shade, path, widths, share } = entry;
        let node = &scene.nodes[id as usize];
        let lens = &setup.lens;
        let balls = balls_in_tile(node, &place, lens, corner);
        let nearest = (1.0 / NEAR).min(1.0 / (1.0 + (place.origin[2] - 2.0 * place.scale) * lens.nearness).max(NEAR));
        let widest = ((widths.widest(node.summary.widest) * lens.step * nearest / 2.0).max(setup.hairline)) as f32;
        let mut open = Self {
            node: id,
            left: 0,
            order: [0; WIDTH],
            balls,
            place,
            shade,
            path,
            widths,
            shares: [UNLIMITED; WIDTH],
            spare: 0.0,
            towards: DIRECTIONS.map(|to| place.axes.map(|axis| (dot(axis, to) / place.scale) as f32)),
        };
        let count = usize::from(node.links) + usize::from(node.lines);
        let scarce = share < node.summary.need;
        let mut weights = [0.0; WIDTH];
        let mut kept = 0;
        for (lane, weighs) in weights.iter_mut().enumerate().take(count) {
            let [x, y, r] = [0, 1, 2].map(|i| open.balls[i][lane]);
            let reach = r + widest + setup.slack;
            let within = |low: [f64; 2], high: [f64; 2]| {
                let [low, high] = [low, high].map(|corner| corner.map(|c| c as f32));
                x + reach >= low[0] && x - reach <= high[0] && y + reach >= low[1] && y - reach <= high[1]
            };
            if within([0.0; 2], size.map(|side| side as f64)) {
                open.order[kept] = lane as u8;
                kept += 1;
            }
            // Contents outside the picture get no share. Contents outside this tile do, so that all tiles agree.
            if scarce && lane < usize::from(node.links) {
                let is_visible = within(corner.map(|c| -c), [0, 1].map(|i| setup.size[i] - corner[i]));
                *weighs = if is_visible { weight(r) } else { 0.0 };
            }
        }
        if scarce {
            let needs =
                |lane: usize| scene.nodes[scene.links[node.first_link as usize + lane].node as usize].summary.need;
            open.shares = shares(share - f32::from(node.lines), &weights[..usize::from(node.links)], needs);
        } else {
            open.spare = (share - node.summary.need).clamp(0.0, UNLIMITED);
        }
        open.left = kept as u8;
        if place.scale as f32 > SORTED {
            sort_by_depth(&mut open.order[..kept], &open.balls[3]);
        }
        open
    }

    /// Reduces the shares of the remaining contents to a `part`.
    pub(super) fn scale_budget(&mut self, scene: &Scene, part: f32) {
        self.spare = 0.0;
        let node = &scene.nodes[self.node as usize];
        let links = &scene.links[node.first_link as usize..][..usize::from(node.links)];
        for (share, link) in self.shares.iter_mut().zip(links) {
            *share = share.min(scene.nodes[link.node as usize].summary.need) * part;
        }
    }
}

/// The balls of a node's contents in a tile, in samples: x, y, radius, and the depth of the nearest point.
#[inline]
fn balls_in_tile(node: &SceneNode, place: &Place, lens: &Lens, corner: [f64; 2]) -> [[f32; WIDTH]; 4] {
    let mut balls = [[0.0_f32; WIDTH]; 4];
    let [ax, ay, az] = place.axes.map(|axis| axis.map(|c| c as f32));
    let origin = place.origin.map(|c| c as f32);
    let scale = place.scale as f32;
    let nearness = lens.nearness as f32;
    let middle = [0, 1].map(|i| (lens.middle[i] - corner[i]) as f32);
    // Allows for rounding in a node much larger than the picture.
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
        // With perspective the near side of a ball appears farther from the middle of the picture than its centre.
        let grows = nearest - factor;
        balls[0][i] = middle[0] + x * factor;
        balls[1][i] = middle[1] + y * factor;
        balls[2][i] = r * nearest + grows * x.abs().max(y.abs());
        balls[3][i] = (z - r) * nearest;
    }
    balls
}

/// Sorts contents by depth, the nearest last.
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
