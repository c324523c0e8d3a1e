//! Which segment is at a place of a picture in the plane.

use super::descent::{Descent, Met, Node};
use super::inks::Choice;
use super::view::{Camera, View, Viewport};
use crate::{Drawing, Item, Stroke};

/// A place on a picture, and how hard to look there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pointer {
    /// Right of and below the upper left corner, in device pixels.
    pub at: [f64; 2],
    /// What is nearer than this may be meant, in device pixels.
    pub tolerance: f64,
    /// Only the first so many segments are there; all of them without it.
    pub upto: Option<u128>,
    /// Blocks and segments that are looked at, at most.
    pub visits: usize,
}

/// A segment found near a pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Its number in drawing order, 0-based.
    pub segment: u128,
    /// How far the pointer is from its stroke, in device pixels: 0 upon it. A stroke is as wide as in the model here,
    /// however thin that is.
    pub distance: f64,
}

impl Pointer {
    /// A segment this near is as good as any that is nearer.
    pub(crate) fn enough(&self) -> f64 {
        /// As a part of the tolerance.
        const CLOSE: f64 = 0.25;
        self.tolerance * CLOSE
    }
}

/// A segment must be this much nearer than another to be better, as a part of the tolerance; and a block that is smaller
/// is in one place.
pub(crate) const BETTER: f64 = 1.0 / 32.0;

/// A segment near a place of a picture: the nearest, to a 32nd of the tolerance, or one that is within a quarter of it,
/// later ones first. It descends as the renderer does, so it is right at any magnification at which the picture is.
/// Where many blocks overlap it gives the best of what it may look at. Polygons hide nothing, and segments beyond the
/// first 2^128 - 1 are not found.
#[must_use]
pub fn pick(drawing: &Drawing, viewport: Viewport, view: View, pointer: &Pointer) -> Option<Pick> {
    let camera = Camera::new(drawing, viewport, view, 1.0);
    let (mut descent, choice) = (Descent::default(), Choice::default());
    let mut stack = vec![descent.root(drawing, camera)?];
    if let Some(upto) = pointer.upto {
        descent.leave_out(drawing, choice, &mut stack, upto);
    }
    let (step, reach, visits) = (camera.step, pointer.tolerance, pointer.visits);
    let mut search = Search { drawing, pointer, descent, stack, choice, step, reach, visits, best: None };
    while search.visits > 0 && search.best.is_none_or(|best| best.distance > pointer.enough()) {
        let Some(Met { item, node }) = search.next(0) else { break };
        match item {
            Item::Stroke(stroke) => search.consider(stroke, &node),
            Item::Polygon(_) => {}
            Item::Block(_) => {
                if search.is_near(&node) {
                    search.stack.push(node);
                    if node.place.scale < pointer.tolerance * BETTER / 3.0 {
                        search.sample();
                    }
                }
            }
        }
    }
    search.best.filter(|pick| pick.segment < drawing.segment_count())
}

struct Search<'a> {
    drawing: &'a Drawing,
    pointer: &'a Pointer,
    descent: Descent,
    stack: Vec<Node>,
    choice: Choice,
    /// Device pixels in a step length.
    step: f64,
    /// Only what is nearer than this is of interest.
    reach: f64,
    visits: usize,
    best: Option<Pick>,
}

impl<'a> Search<'a> {
    fn next(&mut self, floor: usize) -> Option<Met<'a>> {
        self.visits = self.visits.saturating_sub(1);
        self.descent.next(self.drawing, self.choice, &mut self.stack, floor)
    }

    /// Takes the stroke that was met last, if it is better than what there is.
    fn consider(&mut self, stroke: &Stroke, node: &Node) {
        let axis = to_segment(self.pointer.at, [stroke.from, stroke.to].map(|end| node.place.point(end)));
        let distance = (axis - self.step * node.pen.width / 2.0).max(0.0);
        if distance < self.reach {
            self.best = Some(Pick { segment: self.number(), distance });
            self.reach = distance - self.pointer.tolerance * BETTER;
        }
    }

    /// Considers one stroke of the block on top of the stack, and is done with that.
    fn sample(&mut self) {
        let floor = self.stack.len() - 1;
        while let Some(Met { item, node }) = self.next(floor) {
            match item {
                Item::Block(_) if self.drawing.blocks[node.block.0 as usize].segments > 0 => self.stack.push(node),
                Item::Block(_) | Item::Polygon(_) => {}
                Item::Stroke(stroke) => {
                    self.consider(stroke, &node);
                    break;
                }
            }
        }
        self.stack.truncate(floor);
    }

    /// The number of the stroke that was met last: so many segments come before it on the way down to it.
    fn number(&self) -> u128 {
        let before = self.stack.iter().flat_map(|node| {
            let first = self.drawing.blocks[node.block.0 as usize].items.start;
            &self.drawing.items[first as usize..node.cursor as usize]
        });
        before.fold(0, |sum, item| sum.saturating_add(self.drawing.segments_in(item)))
    }

    /// Whether a block may have a stroke within reach.
    fn is_near(&self, node: &Node) -> bool {
        /// In units of the block: what hulls and places on a canvas are rounded by.
        const ROUGH: f64 = 1e-11;
        let Node { place, block, .. } = node;
        let block = &self.drawing.blocks[block.0 as usize];
        let corners = &self.drawing.corners[block.hull.start as usize..block.hull.end as usize];
        let Some(last) = corners.last().filter(|_| block.segments > 0) else { return false };
        let radius = self.step * block.widest.of(node.pen.width).max(0.0) / 2.0;
        let reach = self.reach + radius + ROUGH * place.scale;
        let at = self.pointer.at;
        let mut inside = corners.len() > 2;
        let mut from = place.point(*last);
        for &corner in corners {
            let to = place.point(corner);
            if to_segment(at, [from, to]) < reach {
                return true;
            }
            // Corners go counter-clockwise, and here y is down: inside is to the right of every side.
            let side = (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0]);
            inside &= side <= 0.0;
            from = to;
        }
        inside
    }
}

/// The distance from a point to a segment.
fn to_segment(point: [f64; 2], ends: [[f64; 2]; 2]) -> f64 {
    nearest_on(point, ends).0
}

/// The distance from a point to a segment, and which part of the segment is before the place nearest to it.
pub(crate) fn nearest_on(point: [f64; 2], [from, to]: [[f64; 2]; 2]) -> (f64, f64) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let away = [point[0] - from[0], point[1] - from[1]];
    let length2 = along[0] * along[0] + along[1] * along[1];
    let part = if length2 > 0.0 { ((away[0] * along[0] + away[1] * along[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (away[0] - part * along[0], away[1] - part * along[1]);
    ((x * x + y * y).sqrt(), part)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{hard, picture};
    use super::*;
    use crate::{ColourBy, PlaneRenderer, Renderer, Style, fitted_ends};
    use std::sync::Arc;

    const VIEWPORT: Viewport = Viewport { width: 320, height: 200, ratio: 1.0 };

    /// Where the view shows the middle of a segment, in device pixels, and its ends.
    fn shown(drawing: &Drawing, view: View, number: u128) -> [[f64; 2]; 2] {
        let scale = crate::fitted_scale(drawing, VIEWPORT) * view.zoom;
        fitted_ends(drawing, number).unwrap().map(|[x, y, fine_x, fine_y]| {
            let [dx, dy] = [x - view.x + (fine_x - view.fine[0]), y - view.y + (fine_y - view.fine[1])];
            [160.0 + scale * dx, 100.0 - scale * dy]
        })
    }

    /// The number of some segment of the smallest blocks, in the midst of a drawing.
    fn deep(drawing: &Drawing, way: usize) -> u128 {
        let (mut block, mut number) = (drawing.root.unwrap(), 0);
        for depth in 0.. {
            let items = drawing.items_of(block);
            let inner = |item: &Item| match item {
                Item::Block(placed) => Some(placed.block),
                _ => None,
            };
            let blocks: Vec<usize> = (0..items.len()).filter(|&i| inner(&items[i]).is_some()).collect();
            let stroke = items.iter().position(|item| matches!(item, Item::Stroke(_)));
            let chosen =
                if blocks.is_empty() { stroke } else { Some(blocks[(way + depth % (2 + way)) % blocks.len()]) };
            let chosen = chosen.unwrap();
            number += items[..chosen].iter().map(|item| drawing.segments_in(item)).sum::<u128>();
            match inner(&items[chosen]) {
                Some(inside) => block = inside,
                None => break,
            }
        }
        number
    }

    /// At any magnification a segment is found where it is, what is found is there, and it is what the picture shows.
    #[test]
    fn segments_are_found_at_any_depth() {
        let mut renderer = Renderer::new();
        let mut deepest = 0;
        for (name, sample) in hard() {
            let style = Style { colour_by: ColourBy::Single, ..Style::default() };
            let n = match name {
                "dragon" => 120,
                "plant f" | "plant d" => 60,
                _ => 40,
            };
            let drawing = Arc::new(sample.draw(n));
            assert!(drawing.segment_count() < u128::MAX);
            let fitted = crate::fitted_scale(&drawing, VIEWPORT);
            // Too many blocks lie upon each other to look into all of them.
            let crowded = name == "bush" || name == "coloured c";
            renderer.load(drawing.clone());
            for (zoom, way) in [1.0, 1e6, 1e12, 1e15, 1e18].into_iter().flat_map(|zoom| [(zoom, 0), (zoom, 3)]) {
                let number = deep(&drawing, way);
                let [from, to] = fitted_ends(&drawing, number).unwrap();
                // The segment goes through a place a little aside of the middle of the picture.
                let aside = [23.0, -17.0].map(|pixels| pixels / (fitted * zoom));
                let view = View { x: from[0], y: from[1], zoom, fine: [from[2] - aside[0], from[3] - aside[1]] };
                let ends = shown(&drawing, view, number);
                if (ends[1][0] - ends[0][0]).abs().max((ends[1][1] - ends[0][1]).abs()) > 1e6 {
                    continue;
                }
                let at = [183.0, 117.0];
                assert!(to_segment(at, ends) < 1e-3, "{name} {zoom} {ends:?} {to:?}");
                // Its outline is it, however short it is beside the drawing.
                for end in [from, to] {
                    let on = |corner: &[f64; 4]| {
                        [0, 1].map(|i| fitted * zoom * (corner[i] - end[i] + (corner[i + 2] - end[i + 2])).abs())
                    };
                    let outline = crate::fitted_outline(&drawing, number..number + 1);
                    assert!(
                        outline.len() == 2 && outline.iter().any(|corner| on(corner).iter().all(|&off| off < 0.01))
                    );
                }
                let pointer = Pointer { at, tolerance: 2.0, upto: None, visits: 20_000 };
                let Some(found) = pick(&drawing, VIEWPORT, view, &pointer) else {
                    assert!(crowded, "{name} {zoom}");
                    continue;
                };
                let away = to_segment(at, shown(&drawing, view, found.segment));
                assert!((found.distance - away).abs() < 1e-3 && away <= 0.5, "{name} {zoom} {found:?} {away}");
                deepest += i32::from(zoom >= 1e15);
                // Played up to there, it is not there any more.
                let before = pick(&drawing, VIEWPORT, view, &Pointer { upto: Some(number), ..pointer });
                assert!(before.is_none_or(|pick| pick.segment < number), "{name} {zoom} {before:?}");

                if crowded {
                    continue;
                }
                picture(&mut renderer, &style, VIEWPORT, view);
                let ink = |x: usize, y: usize| renderer.pixels()[4 * (y * 320 + x)] != style.background.rgb[0];
                for k in 0..60 {
                    let (x, y) = (k * 67 % 320, k * 31 % 200);
                    let pixel = [x as f64 + 0.5, y as f64 + 0.5];
                    let near = |tolerance| Pointer { at: pixel, tolerance, ..pointer };
                    if pick(&drawing, VIEWPORT, view, &near(0.2)).is_some() {
                        assert!(ink(x, y), "{name} {zoom} {pixel:?}");
                    } else if pick(&drawing, VIEWPORT, view, &near(1.3)).is_none() {
                        assert!(!ink(x, y), "{name} {zoom} {pixel:?}");
                    }
                }
            }
        }
        assert!(deepest > 12, "{deepest}");
    }
}
