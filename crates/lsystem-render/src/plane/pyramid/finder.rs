//! The tiles that may have ink: a search for a stroke that reaches into a tile.

use super::{Pyramid, TilePlace};
use crate::ink::Choice;
use crate::plane::descent::{Descent, Node, Visit};
use crate::plane::view::{Measure, ViewTransform};
use crate::viewport::Detail;
use lsystem_drawing::Item;

/// The most items that a search visits. In a tile with ink, a search ends after about as many items as the graph is deep.
const MAX_ITEMS: usize = 1 << 13;
/// The same for a sample of tiles, of which a deep level makes thousands of searches.
const MAX_SAMPLED: usize = 1 << 9;
/// The part of a coordinate that may be rounding.
const ROUNDING: f64 = 1e-12;

/// Searches the graph, one tile after the other.
pub(super) struct Finder {
    /// The most items that a search visits.
    most: usize,
    descent: Descent,
    stack: Vec<Node>,
}

impl Finder {
    pub(super) fn new() -> Self {
        Self { most: MAX_ITEMS, descent: Descent::default(), stack: vec![] }
    }

    /// For a sample of tiles.
    pub(super) fn of_sample() -> Self {
        Self { most: MAX_SAMPLED, ..Self::new() }
    }

    pub(super) fn may_have_ink(&mut self, pyramid: &Pyramid, tile: TilePlace) -> bool {
        let Pyramid { drawing, style, shapes, .. } = pyramid;
        let (viewport, samples) = (pyramid.viewport(), Detail::Fine.samples() as f64);
        let transform = ViewTransform::new(drawing, viewport, pyramid.view(tile), samples);
        let hairline = viewport.least_width(style) * samples;
        let measure = Measure { hairline, step: transform.step, scale: transform.scale };
        let size = [viewport.width, viewport.height].map(|side| f64::from(side) * samples);
        let (choice, descent) = (Choice::default(), &mut self.descent);
        self.stack.clear();
        self.stack.extend(descent.root(drawing, transform));
        for _ in 0..self.most {
            let Some(Visit { item, node }) = descent.next(drawing, choice, &mut self.stack, 0) else { return false };
            match item {
                Item::Polygon(polygon) => {
                    let vertices = drawing.vertices_of(polygon).iter().map(|&vertex| node.place.point(vertex));
                    if !box_misses(size, &vertices, 0.0) {
                        return true;
                    }
                }
                Item::Stroke(stroke) => {
                    let ends = [stroke.from, stroke.to].map(|end| node.place.point(end));
                    if !stroke_misses(
                        size,
                        ends,
                        node.pen.widths.ends().map(|width| measure.radius(width)).into_iter().fold(0.0, f64::max),
                    ) {
                        return true;
                    }
                }
                Item::Block(_) => {
                    let index = node.block.0 as usize;
                    let (block, shape) = (&drawing.blocks[index], &shapes.list[index]);
                    let radius = measure.widest(block, node.pen);
                    let centre = node.place.point(shape.centre);
                    if shape.strokes == 0 || node.place.misses(size, centre, shape.half, radius) {
                        continue;
                    }
                    let Some(line) = &shape.line else {
                        self.stack.push(node);
                        continue;
                    };
                    let ends = [line.from, line.to].map(|end| node.place.point(end));
                    if !stroke_misses(size, ends, radius) {
                        return true;
                    }
                }
            }
        }
        true
    }
}

/// Whether the bounds of some points, widened by `radius`, are outside a picture of this `size`.
fn box_misses(size: [f64; 2], points: &(impl Iterator<Item = [f64; 2]> + Clone), radius: f64) -> bool {
    (0..2).any(|axis| {
        let along = || points.clone().map(move |point| point[axis]);
        let (low, high) = (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
        let radius = radius + ROUNDING * (low.abs() + high.abs());
        high + radius < 0.0 || low - radius > size[axis]
    })
}

/// Whether a stroke with round caps is outside a picture of this `size`. A stroke near to a corner may count as inside.
fn stroke_misses(size: [f64; 2], ends: [[f64; 2]; 2], radius: f64) -> bool {
    if box_misses(size, &ends.into_iter(), radius) {
        return true;
    }
    let [from, to] = ends;
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let [cx, cy] = [size[0] / 2.0 - from[0], size[1] / 2.0 - from[1]];
    let length = libm::hypot(dx, dy);
    let radius = radius + ROUNDING * (cx.abs() + cy.abs() + length);
    (cx * dy - cy * dx).abs() > radius * length + (size[0] * dy.abs() + size[1] * dx.abs()) / 2.0
}

/// The tiles of a level that may have ink, in the order of a depth-first way.
pub struct Tiles<'a, F> {
    pyramid: &'a Pyramid,
    finder: Finder,
    level: u32,
    top: TilePlace,
    wanted: F,
    stack: Vec<TilePlace>,
}

impl<'a, F: Fn(TilePlace) -> bool> Tiles<'a, F> {
    pub(super) fn new(pyramid: &'a Pyramid, level: u32, top: TilePlace, wanted: F) -> Self {
        Self { pyramid, finder: Finder::new(), level, top, wanted, stack: vec![TilePlace::WHOLE] }
    }
}

impl<F: Fn(TilePlace) -> bool> Iterator for Tiles<'_, F> {
    type Item = TilePlace;

    fn next(&mut self) -> Option<TilePlace> {
        while let Some(tile) = self.stack.pop() {
            let is_on_the_way = tile.above(self.top.level) == self.top.above(tile.level);
            if !is_on_the_way || !(self.wanted)(tile) || !self.finder.may_have_ink(self.pyramid, tile) {
                continue;
            }
            if tile.level >= self.level {
                return Some(tile);
            }
            self.stack.extend(tile.below().into_iter().rev());
        }
        None
    }
}
