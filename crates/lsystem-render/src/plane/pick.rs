//! Picking: the segment or the polygon at a place of a picture in the plane.

use super::descent::{Descent, Node};
use super::seen::Seen;
use super::view::{View, ViewTransform};
use crate::ink::Choice;
use crate::search::{Aim, Order, Pick, Pointer, Sight, covers, nearest_on, search};
use crate::viewport::Viewport;
use lsystem_base::fixed::Fixed;
use lsystem_drawing::{BlockId, Drawing, Item, Placed, Plane, Polygon, Stroke, count_of};

/// The segment or the polygon near a place of a picture. Among the polygons filled there and the segments within a
/// quarter of the tolerance, the last drawn is picked. If there are none, the nearest is picked, to a 32nd of the
/// tolerance. The search descends as the renderer does, so a pick is right at any magnification at which the picture
/// is. Where many blocks overlap, the search ends with the pointer's visits. Segments and polygons beyond the first
/// 2^128 - 1 are not found.
#[must_use]
pub(crate) fn pick(drawing: &Drawing, viewport: Viewport, view: View, pointer: &Pointer) -> Option<Pick> {
    let transform = ViewTransform::new(drawing, viewport, view, 1.0);
    let mut descent = Descent::default();
    let root = descent.root(drawing, transform)?;
    let mut sight = PlaneSight { drawing, at: pointer.at, descent, seen: Seen::default(), step: transform.step };
    search(drawing, pointer, &mut sight, root, Order::Best)
}

/// A place on a segment, found by [`segment_near`].
#[derive(Clone, Debug, PartialEq)]
pub struct Near {
    /// The segment's number (0-based).
    pub segment: Fixed,
    /// The part of the segment before the place, from 0 to less than 1.
    pub along: f64,
    /// The place in the picture, in device pixels from the upper left corner.
    pub at: [f64; 2],
}

/// A place on a segment within about `reach` device pixels of the place `at` in the picture, however many segments the
/// drawing has; `None` if there is none. Among several, one of the nearest is found, to a part of the reach.
#[must_use]
pub fn segment_near(drawing: &Drawing, viewport: Viewport, view: View, at: [f64; 2], reach: f64) -> Option<Near> {
    let counts = drawing.counts();
    // The nearest first. A block smaller than the reach has its first segment for all.
    [1.0 / 16.0, 0.25, 1.0].into_iter().find_map(|part| within(drawing, &counts, (viewport, view), at, reach * part))
}

/// As [`segment_near`], anywhere in reach.
fn within(
    drawing: &Drawing,
    counts: &[Fixed],
    (viewport, view): (Viewport, View),
    at: [f64; 2],
    near: f64,
) -> Option<Near> {
    /// The most items that are looked at: a few for each of some thousand nested blocks.
    const VISITS: usize = 1 << 15;
    /// The largest `f64` below 1.
    const LAST: f64 = 1.0 - f64::EPSILON / 2.0;
    let transform = ViewTransform::new(drawing, viewport, view, 1.0);
    let mut descent = Descent::default();
    let mut open = vec![(0.0, descent.root(drawing, transform)?, Fixed::default())];
    let mut sight = PlaneSight { drawing, at, descent, seen: Seen::default(), step: transform.step };
    let mut visits = 0;
    while let Some((distance, node, mut before)) = open.pop() {
        let id = node.block;
        if distance > near || visits > VISITS || counts[id.0 as usize].is_zero() {
            continue;
        }
        // All of a block has coordinates below 1, so that its first segment is as good as any.
        let small = node.place.scale < near;
        let siblings = open.len();
        for item in drawing.items_of(id) {
            visits += 1;
            match item {
                Item::Stroke(stroke) if small || sight.stroke(&node, stroke)?.distance <= near => {
                    let [from, to] = [stroke.from, stroke.to].map(|end| node.place.point(end));
                    let along = if small { 0.0 } else { nearest_on(at, [from, to]).1.min(LAST) };
                    let at = [0, 1].map(|axis| from[axis] + along * (to[axis] - from[axis]));
                    return Some(Near { segment: before, along, at });
                }
                Item::Stroke(_) | Item::Polygon(_) => {}
                Item::Block(placed) => {
                    let inner = sight.inside(&node, placed);
                    // In a small block, all is as near as the block.
                    let aim = sight.block(placed.block, &inner).map_or(f64::INFINITY, |aim| aim.distance);
                    let distance = if small { distance } else { aim };
                    // The nearest is looked into first.
                    let after = open[siblings..].iter().position(|(other, ..)| *other <= distance);
                    let after = after.map_or(open.len(), |after| siblings + after);
                    open.insert(after, (distance, inner, before.clone()));
                    if small && !counts[placed.block.0 as usize].is_zero() {
                        break;
                    }
                }
            }
            before = before.plus(&count_of(counts, item));
        }
    }
    None
}

/// Places the items of a drawing in the plane relative to a pointer.
struct PlaneSight<'a> {
    drawing: &'a Drawing,
    at: [f64; 2],
    descent: Descent,
    seen: Seen,
    /// Device pixels in a step length.
    step: f64,
}

impl PlaneSight<'_> {
    /// The position of an item that is `distance` pixels away.
    fn aim(distance: f64) -> Aim {
        Aim { distance, depth: 0.0, off: 0.0 }
    }
}

impl Sight<Plane> for PlaneSight<'_> {
    type Place = Node;

    fn inside(&mut self, node: &Node, placed: &Placed) -> Node {
        self.descent.child(self.drawing, Choice::default(), node, placed)
    }

    fn is_new(&mut self, id: BlockId, Node { place, pen, .. }: &Node) -> bool {
        // Larger blocks are few, and their places are rounded too much to be compared.
        const LARGE: f64 = (1_u64 << 24) as f64;
        let along = [place.origin[0] + place.cos, place.origin[1] + place.sin];
        place.scale > LARGE || {
            let [width, next] = pen.widths.key();
            self.seen.paint([u64::from(id.0), width, next], [place.origin, along])
        }
    }

    fn scale(&self, node: &Node) -> f64 {
        node.place.scale
    }

    fn block(&self, id: BlockId, Node { place, pen, .. }: &Node) -> Option<Aim> {
        /// The rounding of hulls and of places on a canvas, in units of the block.
        const ROUNDING: f64 = 1e-11;
        let block = &self.drawing.blocks[id.0 as usize];
        let corners = self.drawing.corners_of(block);
        // In units of the block.
        let at = place.within(self.at);
        let (mut away, mut inside) = (f64::INFINITY, corners.len() > 2);
        let mut from = *corners.last()?;
        for &to in corners {
            away = away.min(nearest_on(at, [from, to]).0);
            // Corners go counter-clockwise.
            inside &= (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0]) >= 0.0;
            from = to;
        }
        let radius = self.step * pen.widths.widest(block.widest).max(0.0) / 2.0;
        let distance = if inside { 0.0 } else { (place.scale * (away - ROUNDING) - radius).max(0.0) };
        Some(Self::aim(distance))
    }

    fn stroke(&self, node: &Node, stroke: &Stroke) -> Option<Aim> {
        let (axis, along) = nearest_on(self.at, [stroke.from, stroke.to].map(|end| node.place.point(end)));
        let pen = node.pen.after(Choice::default(), &self.drawing.styles[stroke.style.0 as usize]);
        let [width, end] = pen.widths.ends();
        let width = width + along * (end - width);
        Some(Self::aim((axis - self.step * width / 2.0).max(0.0)))
    }

    fn polygon(&self, node: &Node, polygon: &Polygon) -> Option<Aim> {
        let vertices = self.drawing.vertices_of(polygon).iter();
        let outline: Vec<_> = vertices.map(|&vertex| node.place.point(vertex)).collect();
        let sides = outline.iter().zip(outline.iter().cycle().skip(1));
        let beside = sides.map(|(&from, &to)| nearest_on(self.at, [from, to]).0).fold(f64::INFINITY, f64::min);
        Some(Self::aim(if covers(&outline, self.at) { 0.0 } else { beside }))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{hard, picture};
    use super::super::{fitted_ends, fitted_outline, fitted_scale};
    use super::*;
    use crate::Renderer;
    use crate::search::Target;
    use lsystem_syntax::{ColourBy, Style};
    use std::sync::Arc;

    const VIEWPORT: Viewport = Viewport { width: 320, height: 200, ratio: 1.0 };

    /// The ends of a segment in the picture, in device pixels.
    fn shown(drawing: &Drawing, view: View, number: u128) -> [[f64; 2]; 2] {
        let scale = fitted_scale(drawing, VIEWPORT) * view.zoom;
        fitted_ends(drawing, number).unwrap().map(|[x, y, fine_x, fine_y]| {
            let [dx, dy] = [x - view.x + (fine_x - view.fine[0]), y - view.y + (fine_y - view.fine[1])];
            [160.0 + scale * dx, 100.0 - scale * dy]
        })
    }

    /// The number of a segment in the innermost blocks; `way` selects the blocks on the way down.
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

    /// At any magnification a segment is found at its place, the found segment is there, and the picture shows it.
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
            let fitted = fitted_scale(&drawing, VIEWPORT);
            // Too many blocks overlap to look into all of them.
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
                assert!(nearest_on(at, ends).0 < 1e-3, "{name} {zoom} {ends:?} {to:?}");
                // The outline of one segment is the segment, however short.
                for end in [from, to] {
                    let on = |corner: &[f64; 4]| {
                        [0, 1].map(|i| fitted * zoom * (corner[i] - end[i] + (corner[i + 2] - end[i + 2])).abs())
                    };
                    let outline = fitted_outline(&drawing, number..number + 1);
                    assert!(
                        outline.len() == 2 && outline.iter().any(|corner| on(corner).iter().all(|&off| off < 0.01))
                    );
                }
                let pointer = Pointer { at, tolerance: 2.0, upto: None, visits: 20_000 };
                let Some(found) = pick(&drawing, VIEWPORT, view, &pointer) else {
                    assert!(crowded, "{name} {zoom}");
                    continue;
                };
                let Target::Segment(segment) = found.target else { panic!("{name} has no polygons") };
                let away = nearest_on(at, shown(&drawing, view, segment)).0;
                assert!((found.distance - away).abs() < 1e-3 && away <= 0.5, "{name} {zoom} {found:?} {away}");
                deepest += i32::from(zoom >= 1e15);
                // Played back up to this segment, the segment is not shown yet.
                let before = pick(&drawing, VIEWPORT, view, &Pointer { upto: Some(number), ..pointer });
                assert!(
                    before.is_none_or(|pick| matches!(pick.target, Target::Segment(other) if other < number)),
                    "{name} {zoom} {before:?}"
                );

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

    /// Near any segment the visits suffice to find a segment as near.
    #[test]
    fn crowds_are_picked_within_a_budget() {
        let viewport = Viewport { width: 1280, height: 800, ratio: 1.0 };
        for (name, sample) in hard() {
            let drawing = sample.draw(40);
            let fitted = fitted_scale(&drawing, viewport);
            for zoom in [1.0, 30.0, 1e3, 1e6, 1e9] {
                for k in 0..50 {
                    let number = drawing.segment_count() / 51 * (k + 1) + 977 * k;
                    let [from, _] = fitted_ends(&drawing, number).unwrap();
                    let aside = [23.0, -17.0].map(|pixels| pixels / (fitted * zoom));
                    let view = View { x: from[0], y: from[1], zoom, fine: [from[2] - aside[0], from[3] - aside[1]] };
                    let pointer = Pointer { at: [663.0, 417.0], tolerance: 2.0, upto: None, visits: 20_000 };
                    let found = pick(&drawing, viewport, view, &pointer);
                    assert!(
                        found.is_some_and(|pick| pick.distance <= pointer.enough()),
                        "{name} {zoom} {number} {found:?}"
                    );
                }
            }
        }
    }
}
