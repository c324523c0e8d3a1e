//! Stand-ins for a node that is not looked into: a dot, its main line, or some of its strokes.

use super::camera::NEAR;
use super::open_node::{Entry, OpenNode};
use super::painter::TilePainter;
use super::path::Stretch;
use super::place::Place;
use super::scene::{Link, SampleStroke, Scene, SceneNode, Summary};
use super::setup::Setup;
use super::stroke::{Dot, span};
use super::tile::ScreenTile;
use crate::ink::{Amount, Shade};
use lsystem_drawing::rotation::{self, Vector, minus, norm};

/// As many triangles stand for those of a node, though its share may allow fewer strokes: two or three large ones would
/// be seen as such.
const FACES: usize = 8;
/// Half the length of a leaf that stands for others, at most: in the radius of their node, and in the length of those.
const LONGEST: [f64; 2] = [0.4, 2.0];
/// The breadth of such a leaf, in its length.
const BROAD: f64 = 0.5;
/// A main line stands out if it is longer than this factor times the mean length of the sample strokes.
const OUTSTANDING: f64 = 2.0;

/// The ball around a node as it looks in the picture, in samples.
#[derive(Clone, Copy)]
pub(super) struct Disc {
    /// The middle, from the tile's upper left corner.
    pub at: [f64; 2],
    pub radius: f32,
    /// The depth of the nearest point.
    pub near: f32,
    /// Half the width of the widest stroke inside.
    pub stroke: f32,
    /// The scale there, relative to the scale at the target.
    pub factor: f64,
}

impl Disc {
    /// The columns and the rows of a tile in which the node may be; `None` if the node is outside.
    #[inline(always)]
    pub(super) fn spans(&self, tile: &ScreenTile, slack: f32) -> (Option<[usize; 2]>, Option<[usize; 2]>) {
        let reach = f64::from(self.radius + self.stroke + slack);
        let aside = reach + tile.slack();
        let [x, y] = self.at;
        let [width, height] = tile.size.map(|side| side as f64);
        (span(x - aside, x + aside, width), span(y - reach, y + reach, height))
    }
}

/// The dot that stands for the content `lane` of the open `node`.
#[inline]
pub(super) fn dot(
    scene: &Scene,
    setup: &Setup,
    corner: [f64; 2],
    (open, node, lane): (&OpenNode, &SceneNode, usize),
    disc: Disc,
    (shade, path): (Shade, Stretch),
) -> Dot {
    let Disc { at: [px, py], radius: ball, near, stroke: radius, factor } = disc;
    let link = &scene.links[node.first_link as usize + lane];
    let spot = setup.light.spot(open.place.point(node.centre(lane)));
    let ink = scene.mean(link.node, shade, path);
    let [light, view] = open.towards;
    let colour = setup.light.bundle(ink, &spot, &link.bundle, view, light);
    // As large as all strokes side by side, but not larger than the ball.
    let length = link.length * (open.place.scale * factor) as f32;
    let full = 0.8 * ball + radius;
    let scale = (open.place.scale * factor) as f32;
    let faces = link.area * scale * scale * core::f32::consts::FRAC_1_PI;
    let size = (length * radius * core::f32::consts::FRAC_2_PI + faces + radius * radius).min(full * full);
    Dot {
        at: [px + corner[0], py + corner[1], f64::from(near + 0.5 * ball - 0.5 * radius)],
        radius: f64::from(size.sqrt().max(0.71)),
        colour,
    }
}

/// An upper bound of a picture's ink, as an amount in layers times samples.
pub(super) fn most(scene: &Scene, setup: &Setup) -> Amount {
    let Some(root) = scene.root else { return Amount::default() };
    let widest = scene.nodes[root as usize].summary.widest;
    let [length, area] = scene.whole_of(root);
    let scale = Place::root(&setup.lens).scale / NEAR;
    let width = (setup.widths.widest(widest) * setup.lens.step / NEAR).max(2.0 * setup.hairline);
    length.times(scale).times(width).plus(area.times(scale).times(scale))
}

/// The ink of a link of an open node, whose unit has this `scale` in samples, as an amount in layers times samples.
pub(super) fn amount(scene: &Scene, (open, link): (&OpenNode, &Link), scale: f64, disc: Disc) -> Amount {
    let [length, area] = scene.whole_of(link.node);
    let scale = scale * disc.factor;
    let view = open.towards[1];
    // The mean of a stick's length as it is seen.
    let seen = f64::from((1.0 - link.bundle.along(view)).max(0.0)).sqrt();
    let strokes = length.times(scale * seen).times(2.0 * f64::from(disc.stroke));
    // A triangle in a random direction shows half its area.
    strokes.plus(area.times(scale).times(0.5 * scale))
}

/// Paints the main line of a node in the node's mean colour.
#[inline(always)]
pub(super) fn main_line(painter: &mut TilePainter, scene: &Scene, setup: &Setup, id: u32, entry: Entry) -> i64 {
    let Entry { place, shade, path, widths, .. } = entry;
    let main_line = &scene.nodes[id as usize].summary.main_line;
    let ink = scene.mean(id, shade, path);
    let parts = main_line.parts(widths);
    if painter.additive.is_some() {
        let length = norm(minus(main_line.to, main_line.from));
        let times = if length > 0.0 { scene.whole_of(id)[0].times(1.0 / length) } else { Amount::ONE };
        return parts
            .map(|(ends, widths)| painter.strokes(setup, ends.map(|end| place.point(end)), widths, times, ink))
            .sum();
    }
    parts.map(|(ends, widths)| painter.stick(setup, ends.map(|end| place.point(end)), widths, 1.0, ink)).sum()
}

/// Paints as many strokes of a node as its share allows: the main line if it stands out, and samples that face the
/// viewer. Fewer and larger leaves stand for all, so that a crown has its ink whatever the share.
pub(super) fn samples(painter: &mut TilePainter, scene: &Scene, setup: &Setup, id: u32, entry: &Entry) -> i64 {
    let Entry { place, shade, path, widths, share } = *entry;
    let own = &scene.nodes[id as usize].summary;
    let main_line = &own.main_line;
    let outstanding = norm(minus(main_line.to, main_line.from)) > OUTSTANDING * f64::from(own.sampled);
    let count = (share as usize).max(1);
    let all = scene.samples(id);
    if painter.additive.is_some() {
        // All of them in any view, so that nothing flickers while the camera moves.
        let times =
            scene.whole_of(id)[0].times(1.0 / (f64::from(own.sampled) * all.len() as f64).max(f64::MIN_POSITIVE));
        let stroke = |sample: &SampleStroke| {
            let ends = [sample.from, sample.to].map(|end| place.point(end.map(f64::from)));
            let style = sample.style();
            let ink = scene.ink(scene.choice.then(shade, scene.choice.shade(&style)), path, f64::from(sample.before));
            painter.strokes(setup, ends, widths.after(&style), times, ink)
        };
        return all.iter().map(stroke).sum();
    }
    let count = count.min(all.len());
    let leaves = if own.area > 0.0 { count.max(FACES).min(all.len()) } else { 0 };
    let leaf = leaf_of(own, place.scale, leaves);
    let order = place.facing(all.len());
    let samples = order.into_iter().filter_map(|k| all.get(usize::from(k))).take(count.max(leaves)).enumerate();
    // The sample strokes are made thicker, so that together they cover as much as all strokes of the node.
    let thicker = own.length / (count as f32 * own.sampled);
    let mut cost = 0;
    if outstanding {
        let ink = scene.ink(scene.choice.then(shade, scene.choice.shade(&main_line.style)), path, main_line.before);
        for (ends, widths) in main_line.parts(widths) {
            cost += painter.stick(setup, ends.map(|end| place.point(end)), widths, 1.0, ink);
        }
    }
    for (number, sample) in samples {
        let ends = [sample.from, sample.to].map(|end| place.point(end.map(f64::from)));
        let style = sample.style();
        let shade = scene.choice.then(shade, scene.choice.shade(&style));
        let ink = scene.ink(shade, path, f64::from(sample.before));
        if let Some(corner) = sample.corner() {
            let corner = place.point(corner.map(f64::from));
            cost += rhombus(ends, corner, leaf).into_iter().map(|face| painter.face(setup, face, ink)).sum::<i64>();
        } else if number < count - usize::from(outstanding) {
            cost += painter.stick(setup, ends, widths.after(&style), thicker, ink);
        }
    }
    cost
}

/// Half the length of each leaf, so that those among `count` samples cover what all triangles of a node do, where many
/// lie behind each other.
fn leaf_of(own: &Summary, scale: f64, count: usize) -> f64 {
    let radius = own.radius * scale;
    // A triangle in a random direction shows half its area.
    let ball = 2.0 * core::f64::consts::PI * radius * radius;
    let area = f64::from(own.area) * scale * scale;
    let covered = ball * (1.0 - libm::exp(-area / ball.max(f64::MIN_POSITIVE)));
    let each = covered / (f64::from(own.faces) * count as f64).max(1.0);
    let [in_node, in_leaf] = LONGEST;
    (each / (2.0 * BROAD)).sqrt().min(in_node * radius).min(in_leaf * f64::from(own.sampled) * scale)
}

/// The two triangles of a leaf of this half length, in the place of a triangle with these `ends` of its longest side.
fn rhombus(ends: [Vector; 2], corner: Vector, half: f64) -> [[Vector; 3]; 2] {
    let way = minus(ends[1], ends[0]);
    let aside = minus(corner, ends[0]);
    let part = rotation::dot(aside, way) / rotation::dot(way, way).max(f64::MIN_POSITIVE);
    let across = [0, 1, 2].map(|i| aside[i] - part * way[i]);
    let [along, across] = [(way, half), (across, BROAD * half)].map(|(to, size)| {
        let factor = size / norm(to).max(f64::MIN_POSITIVE);
        to.map(|c| c * factor)
    });
    let middle = [0, 1, 2].map(|i| (ends[0][i] + ends[1][i] + corner[i]) / 3.0);
    let at = |way: Vector, sign: f64| [0, 1, 2].map(|i| middle[i] + sign * way[i]);
    let tips = [at(along, -1.0), at(along, 1.0)];
    [1.0, -1.0].map(|sign| [tips[0], at(across, sign), tips[1]])
}
