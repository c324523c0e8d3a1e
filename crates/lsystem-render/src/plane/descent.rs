//! The descent through a drawing's graph: the places of blocks on a canvas, and the pen there.

use super::bottom_up::Part;
use super::path::{Path, Span};
use super::pen::Pen;
use super::shape::Shape;
use super::view::ViewTransform;
use super::wide::Wide;
use crate::ink::{Choice, Shade};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Directions;
use lsystem_drawing::{BlockId, Drawing, Geometry, Item, Placed, Plane, Widths};
use lsystem_syntax::Heading;

/// A block being painted, from its last item to its first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub block: BlockId,
    /// The items from this index on are done.
    pub cursor: u32,
    /// The canvas that the block is painted on: 0 is the picture, others are tiles being made, by size.
    pub canvas: usize,
    pub place: Place,
    /// The place in the root block's frame, as long as the block is large.
    pub root_place: Option<RootPlace>,
    pub pen: Pen,
    /// The part of the path that the items not yet done make.
    pub span: Span,
}

/// The place of a block in the root block's frame. If a block is much larger than the picture, the coordinates of its
/// origin on the canvas are so large that their fractions are lost. The coordinates here do not grow with the
/// magnification.
#[derive(Clone, Copy, Debug)]
pub(super) struct RootPlace {
    origin: [Wide; 2],
    /// Units of the root block in one unit of the block.
    pub scale: f64,
}

/// Blocks inside a block with more subsamples to a unit than this are placed by way of the root block's frame.
const LARGE_SCALE: f64 = (1_u64 << 24) as f64;

/// The place of a block on the canvas.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// The block's origin, in subsamples, y down.
    pub origin: [f64; 2],
    /// Subsamples in one unit of the block.
    pub scale: f64,
    pub heading: Heading,
    /// The heading's cosine and sine, times the scale.
    pub cos: f64,
    pub sin: f64,
}

impl Place {
    /// The place on the canvas of a point of the block.
    pub(super) fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.cos * x - self.sin * y, self.origin[1] - self.sin * x - self.cos * y]
    }

    /// The centre of a block on the canvas, and how far the block and its strokes reach from there, across and down.
    /// Half the width of its strokes is at most `radius`.
    pub(super) fn bounds(&self, shape: &Shape, radius: f64) -> ([f64; 2], [f64; 2]) {
        let [along, aside] = shape.half;
        let [cos, sin] = [self.cos.abs(), self.sin.abs()];
        (self.point(shape.centre), [cos * along + sin * aside + radius, sin * along + cos * aside + radius])
    }

    /// The point of the block at a place on the canvas.
    pub(super) fn within(&self, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = [at[0] - self.origin[0], self.origin[1] - at[1]];
        let square = self.scale * self.scale;
        [(self.cos * x + self.sin * y) / square, (self.cos * y - self.sin * x) / square]
    }

    /// Whether a rectangle along the axes of the block's frame is outside a picture of this `size`. The rectangle has
    /// its middle at `centre` and is widened by `radius`, all in subsamples; `half` its sides are in units of the
    /// block.
    pub(super) fn misses(&self, size: [f64; 2], centre: [f64; 2], half: [f64; 2], radius: f64) -> bool {
        let size = size.map(|side| side / 2.0);
        let [dx, dy] = [size[0] - centre[0], size[1] - centre[1]];
        // The coordinates of a rectangle far away are rounded.
        let radius = radius + 1e-12 * (dx.abs() + dy.abs());
        let is_outside = |[u, v]: [f64; 2], half: f64| {
            (dx * u + dy * v).abs() > self.scale * (self.scale * half + radius) + size[0] * u.abs() + size[1] * v.abs()
        };
        is_outside([self.cos, -self.sin], half[0]) || is_outside([-self.sin, -self.cos], half[1])
    }
}

/// An item of the descent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit<'a> {
    pub item: &'a Item,
    /// The node of a block. For a stroke or a polygon, the node of the block around it, with the pen of the item.
    pub node: Node,
}

/// The most items that are visited to estimate how much is done: small beside the 100,000 steps of the probe.
const MAX_ITEMS: usize = 1 << 14;

/// The state of leaving out the last segments, for the block on top of the stack.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    /// The number of segments still to be kept.
    left: u128,
    /// The number of items of the block that are kept so far.
    kept: usize,
    /// Whether the first item that is not kept has been found.
    found: bool,
    /// The part of the path of the items that are left out, as far as they are measured.
    rest: f64,
    /// The number of items left out that are measured.
    measured: usize,
}

impl Cut {
    /// Leaves out everything from the segment `from` (0-based) on.
    pub(super) fn new(from: u128) -> Self {
        Self { left: from, kept: 0, found: false, rest: 0.0, measured: 0 }
    }
}

/// Leads from a block to the blocks inside.
#[derive(Default)]
pub(super) struct Descent {
    transform: Option<ViewTransform>,
    directions: Directions,
    pub path: Path,
}

impl Descent {
    /// Starts a picture at the root, with no item done; `None` if the drawing is empty.
    pub(super) fn root(&mut self, drawing: &Drawing, transform: ViewTransform) -> Option<Node> {
        let block = drawing.root?;
        let cursor = drawing.blocks.get(block.0 as usize)?.items.end;
        let root_place = RootPlace { origin: [Wide::default(); 2], scale: 1.0 };
        let place = Place {
            origin: transform.place(root_place.origin),
            scale: transform.scale,
            heading: Heading::EAST,
            cos: transform.scale,
            sin: 0.0,
        };
        let pen = Pen { shade: Shade { number: 0, fixed: true }, widths: Widths::new(drawing.width) };
        self.transform = Some(transform);
        Some(Node { block, cursor, canvas: 0, place, root_place: Some(root_place), pen, span: Span::WHOLE })
    }

    /// The node of a part by itself, with its origin at `origin`, magnified by `times`.
    pub(super) fn part(&mut self, drawing: &Drawing, part: &Part, origin: [f64; 2], times: f64) -> Node {
        let Part { block, heading, widths, .. } = *part;
        let scale = part.scale * times;
        let (cos, sin) = Plane::scaled(self.directions.cos_sin(heading), scale);
        let place = Place { origin, scale, heading, cos, sin };
        let cursor = drawing.blocks[block.0 as usize].items.end;
        let pen = Pen { shade: Shade::default(), widths };
        Node { block, cursor, canvas: 1, place, root_place: None, pen, span: Span::WHOLE }
    }

    /// The next item, last items first; `None` when all nodes on the stack above `floor` are done. A block is looked
    /// into only if the caller puts its node on the stack.
    pub(super) fn next<'a>(
        &mut self,
        drawing: &'a Drawing,
        choice: Choice,
        stack: &mut Vec<Node>,
        floor: usize,
    ) -> Option<Visit<'a>> {
        let node = loop {
            let node = stack.get_mut(floor..)?.last_mut()?;
            if node.cursor > drawing.blocks[node.block.0 as usize].items.start {
                node.cursor -= 1;
                break *node;
            }
            stack.pop();
        };
        let item = &drawing.items[node.cursor as usize];
        let style = match item {
            Item::Stroke(stroke) => stroke.style,
            Item::Polygon(polygon) => polygon.style,
            Item::Block(placed) => {
                let child = self.child(drawing, choice, &node, placed);
                if let Some(node) = stack.last_mut() {
                    node.span.end -= child.span.size;
                }
                return Some(Visit { item, node: child });
            }
        };
        let mut pen = node.pen.after(choice, &drawing.styles[style.0 as usize]);
        if self.path.counts() && node.canvas == 0 {
            let span = self.path.stroke(node.block, node.span);
            pen.shade = Shade { number: span.ink(), fixed: true };
            if let (Item::Stroke(_), Some(node)) = (item, stack.last_mut()) {
                node.span.end -= span.size;
            }
        }
        Some(Visit { item, node: Node { pen, ..node } })
    }

    /// The node of a block inside another, with no item done.
    pub(super) fn child(&mut self, drawing: &Drawing, choice: Choice, node: &Node, placed: &Placed) -> Node {
        let heading = node.place.heading + placed.heading;
        let scale = node.place.scale * placed.scale;
        let (c, s) = self.directions.cos_sin(heading);
        let root_place = node.root_place.filter(|_| node.place.scale > LARGE_SCALE).map(|outer| {
            let (c, s) = Plane::scaled(self.directions.cos_sin(node.place.heading), outer.scale);
            let [x, y] = placed.at;
            let origin = [outer.origin[0].plus(c * x - s * y), outer.origin[1].plus(s * x + c * y)];
            RootPlace { origin, scale: outer.scale * placed.scale }
        });
        let origin = match (&root_place, &self.transform) {
            (Some(root_place), Some(transform)) => transform.place(root_place.origin),
            _ => node.place.point(placed.at),
        };
        let place = Place { origin, scale, heading, cos: scale * c, sin: scale * s };
        let mut pen = node.pen.after(choice, &drawing.styles[placed.style.0 as usize]);
        let span = self.path.block(node.block, node.span, placed.block);
        if self.path.counts() && node.canvas == 0 {
            pen.shade = Shade { number: span.ink(), fixed: true };
        }
        let cursor = drawing.blocks[placed.block.0 as usize].items.end;
        Node { block: placed.block, cursor, canvas: node.canvas, place, root_place, pen, span }
    }

    /// The part of the picture that is done, from 0 to 1: the share of the segments in blocks that `counts` accepts.
    /// `None` if too many items would have to be looked at.
    pub(super) fn done(
        &mut self,
        drawing: &Drawing,
        choice: Choice,
        stack: &[Node],
        counts: impl Fn(&Node) -> bool,
    ) -> Option<f64> {
        let (mut done, mut share) = (0.0, 1.0);
        let mut looked_at = 0;
        for node in stack.iter().take_while(|node| node.canvas == 0) {
            let (mut all, mut after, mut own) = (0.0, 0.0, 0.0);
            looked_at += drawing.items_of(node.block).len();
            if looked_at > MAX_ITEMS {
                return None;
            }
            for index in drawing.blocks[node.block.0 as usize].items.clone() {
                let weight = match &drawing.items[index as usize] {
                    Item::Block(placed) if counts(&self.child(drawing, choice, node, placed)) => {
                        drawing.blocks[placed.block.0 as usize].segments as f64
                    }
                    Item::Block(_) => 0.0,
                    _ => 1.0,
                };
                all += weight;
                after += if index > node.cursor { weight } else { 0.0 };
                own += if index == node.cursor { weight } else { 0.0 };
            }
            if own == 0.0 {
                break;
            }
            done += share * after / all;
            share *= own / all;
        }
        Some(done)
    }

    /// Leaves out everything from a segment on, at the start of a picture: in the blocks on the way down to that
    /// segment, all later items count as done.
    pub(super) fn leave_out(
        &mut self,
        drawing: &Drawing,
        choice: Choice,
        stack: &mut Vec<Node>,
        cut: &mut Cut,
        meter: &mut Meter,
    ) -> Progress {
        while let Some(node) = stack.last().copied() {
            let items = drawing.items_of(node.block);
            // Polygons before the first segment that is left out are kept.
            while let Some(count) = items.get(cut.kept).map(|item| drawing.segments_in(item)).filter(|_| !cut.found) {
                if meter.is_spent() {
                    return Progress::More;
                }
                meter.charge(1);
                cut.found = count > cut.left;
                if !cut.found {
                    cut.left -= count;
                    cut.kept += 1;
                }
            }
            cut.found = true;
            if self.path.counts() {
                while let Some(item) = items.get(cut.kept + cut.measured) {
                    if meter.is_spent() {
                        return Progress::More;
                    }
                    meter.charge(1);
                    cut.rest += self.path.size(node.block, node.span, item);
                    cut.measured += 1;
                }
            }
            let node = Node {
                cursor: node.cursor - (items.len() - cut.kept) as u32,
                span: Span { end: node.span.end - cut.rest, ..node.span },
                ..node
            };
            if let Some(top) = stack.last_mut() {
                *top = node;
            }
            match items.get(cut.kept) {
                Some(Item::Block(placed)) => {
                    let size = self.path.block(node.block, node.span, placed.block).size;
                    let around = Node { span: Span { end: node.span.end + size, ..node.span }, ..node };
                    let child = self.child(drawing, choice, &around, placed);
                    stack.push(child);
                    *cut = Cut::new(cut.left);
                }
                _ => return Progress::Done,
            }
        }
        Progress::Done
    }
}
