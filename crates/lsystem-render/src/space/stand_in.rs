//! What stands for a node that is not looked into: a dot, or some of its strokes.

use super::frame::{Frame, Inside};
use super::painter::TilePainter;
use super::path::Stretch;
use super::scene::{Node, Scene};
use super::setup::Setup;
use super::stroke::{Dot, span};
use super::tile::Tile;
use crate::plane::Shade;
use lsystem_drawing::rotation::{minus, norm};

/// A limb stands out among the samples of its node from so many times their length on.
const OUTSTANDING: f64 = 2.0;

/// How the ball around a node looks, in samples.
#[derive(Clone, Copy)]
pub(super) struct Disc {
    /// The middle, in the tile.
    pub at: [f64; 2],
    pub radius: f32,
    /// How deep its nearest point is.
    pub near: f32,
    /// Half the width of the widest stroke in it.
    pub stroke: f32,
    /// How much larger than at the target things look there.
    pub factor: f64,
}

impl Disc {
    /// The columns and rows of a tile where something of the node may be; a `None` tells that nothing is.
    #[inline(always)]
    pub(super) fn spans(&self, tile: &Tile) -> (Option<[usize; 2]>, Option<[usize; 2]>) {
        let reach = f64::from(self.radius + self.stroke);
        let aside = reach + tile.slack();
        let [x, y] = self.at;
        let [width, height] = tile.size.map(|side| side as f64);
        (span(x - aside, x + aside, width), span(y - reach, y + reach, height))
    }
}

/// The dot that stands for the node in a `lane` of `node`, which is being looked into.
#[inline]
pub(super) fn dot(
    scene: &Scene,
    setup: &Setup,
    corner: [f64; 2],
    (frame, node, lane): (&Frame, &Node, usize),
    disc: Disc,
    (shade, path): (Shade, Stretch),
) -> Dot {
    let Disc { at: [px, py], radius: ball, near, stroke: radius, factor } = disc;
    let link = &scene.links[node.first_link as usize + lane];
    let [bx, by, bz] = [0, 1, 2].map(|i| f64::from(node.balls[i][lane]));
    let spot = setup.light.spot(frame.place.lie([bx, by, bz]));
    let ink = scene.mean(link.node, shade, path);
    let [light, view] = frame.towards;
    let colour = setup.light.bundle(ink, &spot, &link.bundle, view, light);
    // As large as all strokes side by side, but not larger than they reach.
    let length = link.length * (frame.place.scale * factor) as f32;
    let full = 0.8 * ball + radius;
    let scale = (frame.place.scale * factor) as f32;
    let faces = link.area * scale * scale * core::f32::consts::FRAC_1_PI;
    let size = (length * radius * core::f32::consts::FRAC_2_PI + faces + radius * radius).min(full * full);
    Dot {
        at: [px + corner[0], py + corner[1], f64::from(near + 0.5 * ball - 0.5 * radius)],
        radius: f64::from(size.sqrt().max(0.71)),
        colour,
    }
}

/// Paints the limb of a node, in the colour that the node has on the whole.
#[inline(always)]
pub(super) fn limb(painter: &mut TilePainter, scene: &Scene, setup: &Setup, id: u32, inside: Inside) -> i64 {
    let Inside { place, shade, path, width, .. } = inside;
    let limb = &scene.nodes[id as usize].own.limb;
    let ends = [limb.from, limb.to].map(|end| place.lie(end));
    painter.stick(setup, ends, limb.style.width.of(width), 1.0, scene.mean(id, shade, path))
}

/// Paints as many strokes of a node as its share allows: its limb if that stands out, and samples that face the viewer.
pub(super) fn samples(painter: &mut TilePainter, scene: &Scene, setup: &Setup, id: u32, inside: &Inside) -> i64 {
    let Inside { place, shade, path, width, share } = *inside;
    let own = &scene.nodes[id as usize].own;
    let limb = &own.limb;
    let outstanding = norm(minus(limb.to, limb.from)) > OUTSTANDING * f64::from(own.sampled);
    let count = (share as usize).max(1);
    let all = scene.samples(id);
    let count = count.min(all.len());
    let order = place.facing(all.len());
    let samples = order.into_iter().take(count - usize::from(outstanding)).filter_map(|k| all.get(usize::from(k)));
    // As much as there is, on the whole, but not much wider than a pixel where they are not.
    let thicker = own.length / (count as f32 * own.sampled);
    let mut cost = 0;
    if outstanding {
        let ends = [limb.from, limb.to].map(|end| place.lie(end));
        let ink = scene.ink(scene.choice.then(shade, scene.choice.shade(&limb.style)), path, limb.before);
        cost += painter.stick(setup, ends, limb.style.width.of(width), 1.0, ink);
    }
    for sample in samples {
        let ends = [sample.from, sample.to].map(|end| place.lie(end.map(f64::from)));
        let shade = scene.choice.then(shade, scene.choice.shade(&sample.style));
        let ink = scene.ink(shade, path, f64::from(sample.before));
        cost += painter.stick(setup, ends, sample.style.width.of(width), thicker, ink);
    }
    cost
}
