//! The way down through a drawing's graph: where its blocks are on a canvas, and what the turtle carries there.

use super::bottom_up::Part;
use super::inks::{Choice, Shade};
use super::path::{Path, Span};
use super::pen::Pen;
use super::shape::Shape;
use super::view::Camera;
use super::wide::Wide;
use lsystem_drawing::Directions;
use lsystem_drawing::{BlockId, Drawing, Geometry, Item, Placed, Plane};
use lsystem_syntax::{Heading, Meter, Progress};

/// A block being painted, from its last item to its first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub block: BlockId,
    /// The items from here on are done.
    pub cursor: u32,
    /// Which canvas it is painted on: 0 is the picture, others are tiles being made, by size.
    pub canvas: usize,
    pub place: Place,
    /// Where it is in the root block's frame, as long as it is large.
    pub far: Option<Far>,
    pub pen: Pen,
    /// Which part of the path it is, but for the items that are done.
    pub span: Span,
}

/// Where a block is in the root block's frame. On the canvas the origin of a block that is much larger than the picture
/// is a number so large that nothing is left of its fraction; here it is kept apart from the magnification.
#[derive(Clone, Copy, Debug)]
pub(super) struct Far {
    at: [Wide; 2],
    /// Units of the root block in one of its own.
    pub scale: f64,
}

/// Blocks with more subsamples to a unit than this are placed by way of the root block's frame.
const FAR: f64 = (1_u64 << 24) as f64;

/// Where a block is on the canvas.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Its origin, in subsamples, y down.
    pub origin: [f64; 2],
    /// Subsamples in one of its units.
    pub scale: f64,
    pub heading: Heading,
    /// The heading's cosine and sine, times the scale.
    pub cos: f64,
    pub sin: f64,
}

impl Place {
    pub(super) fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.cos * x - self.sin * y, self.origin[1] - self.sin * x - self.cos * y]
    }

    /// The centre of a block on the canvas, and how far it reaches from there across and down, its strokes as well: half
    /// their width is `radius`, at most.
    pub(super) fn bounds(&self, shape: &Shape, radius: f64) -> ([f64; 2], [f64; 2]) {
        let [along, aside] = shape.half;
        let [cos, sin] = [self.cos.abs(), self.sin.abs()];
        (self.point(shape.centre), [cos * along + sin * aside + radius, sin * along + cos * aside + radius])
    }

    /// Which point of the block is at a place on the canvas.
    pub(super) fn within(&self, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = [at[0] - self.origin[0], self.origin[1] - at[1]];
        let square = self.scale * self.scale;
        [(self.cos * x + self.sin * y) / square, (self.cos * y - self.sin * x) / square]
    }

    /// Whether a rectangle along the axes of the frame, about `centre` and widened by `radius`, is beside a picture of
    /// this `size`; all in subsamples, but half its sides in units.
    pub(super) fn misses(&self, size: [f64; 2], centre: [f64; 2], half: [f64; 2], radius: f64) -> bool {
        let size = size.map(|side| side / 2.0);
        let [dx, dy] = [size[0] - centre[0], size[1] - centre[1]];
        // Far away numbers are rough.
        let radius = radius + 1e-12 * (dx.abs() + dy.abs());
        let beside = |[u, v]: [f64; 2], half: f64| {
            (dx * u + dy * v).abs() > self.scale * (self.scale * half + radius) + size[0] * u.abs() + size[1] * v.abs()
        };
        beside([self.cos, -self.sin], half[0]) || beside([-self.sin, -self.cos], half[1])
    }
}

/// Something met on the way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met<'a> {
    pub item: &'a Item,
    /// Where it is: a block itself, or the block that a stroke or a polygon is in, with the pen it is drawn with.
    pub node: Node,
}

/// Items that are looked at to tell how much is done, at most.
const LOOKED_AT: usize = 1 << 14;

/// How far segments have been left out: the place in the block on top of the stack.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    /// How many segments are still to be kept.
    left: u128,
    /// How many items of the block are kept, and whether the next is known to be the first that is not.
    kept: usize,
    found: bool,
    /// How large those are that are not kept, of which so many have been measured.
    rest: f64,
    measured: usize,
}

impl Cut {
    /// Everything from the segment `from` (0-based) on is left out.
    pub(super) fn new(from: u128) -> Self {
        Self { left: from, kept: 0, found: false, rest: 0.0, measured: 0 }
    }
}

/// What leads from a block to those inside.
#[derive(Default)]
pub(super) struct Descent {
    camera: Option<Camera>,
    directions: Directions,
    pub path: Path,
}

impl Descent {
    /// Starts a picture: the whole drawing, none of it done; `None` where nothing is drawn.
    pub(super) fn root(&mut self, drawing: &Drawing, camera: Camera) -> Option<Node> {
        let block = drawing.root?;
        let cursor = drawing.blocks.get(block.0 as usize)?.items.end;
        let far = Far { at: [Wide::default(); 2], scale: 1.0 };
        let place = Place {
            origin: camera.place(far.at),
            scale: camera.scale,
            heading: Heading::EAST,
            cos: camera.scale,
            sin: 0.0,
        };
        let pen = Pen { shade: Shade { number: 0, fixed: true }, width: drawing.width };
        self.camera = Some(camera);
        Some(Node { block, cursor, canvas: 0, place, far: Some(far), pen, span: Span::WHOLE })
    }

    /// A part by itself, with its origin at `origin`, so many times as large.
    pub(super) fn alone(&mut self, drawing: &Drawing, part: &Part, origin: [f64; 2], times: f64) -> Node {
        let Part { block, heading, width, .. } = *part;
        let scale = part.scale * times;
        let (cos, sin) = Plane::scaled(self.directions.cos_sin(heading), scale);
        let place = Place { origin, scale, heading, cos, sin };
        let cursor = drawing.blocks[block.0 as usize].items.end;
        let pen = Pen { shade: Shade::default(), width };
        Node { block, cursor, canvas: 1, place, far: None, pen, span: Span::WHOLE }
    }

    /// The next item on the way, last items first; `None` when what is on the stack above `floor` is done. A block is
    /// not looked into, unless it is put on the stack.
    pub(super) fn next<'a>(
        &mut self,
        drawing: &'a Drawing,
        choice: Choice,
        stack: &mut Vec<Node>,
        floor: usize,
    ) -> Option<Met<'a>> {
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
                return Some(Met { item, node: child });
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
        Some(Met { item, node: Node { pen, ..node } })
    }

    /// A block inside another, none of it done.
    pub(super) fn child(&mut self, drawing: &Drawing, choice: Choice, node: &Node, placed: &Placed) -> Node {
        let heading = node.place.heading + placed.heading;
        let scale = node.place.scale * placed.scale;
        let (c, s) = self.directions.cos_sin(heading);
        let far = node.far.filter(|_| node.place.scale > FAR).map(|far| {
            let (c, s) = Plane::scaled(self.directions.cos_sin(node.place.heading), far.scale);
            let [x, y] = placed.at;
            let at = [far.at[0].plus(c * x - s * y), far.at[1].plus(s * x + c * y)];
            Far { at, scale: far.scale * placed.scale }
        });
        let origin = match (&far, &self.camera) {
            (Some(far), Some(camera)) => camera.place(far.at),
            _ => node.place.point(placed.at),
        };
        let place = Place { origin, scale, heading, cos: scale * c, sin: scale * s };
        let mut pen = node.pen.after(choice, &drawing.styles[placed.style.0 as usize]);
        let span = self.path.block(node.block, node.span, placed.block);
        if self.path.counts() && node.canvas == 0 {
            pen.shade = Shade { number: span.ink(), fixed: true };
        }
        let cursor = drawing.blocks[placed.block.0 as usize].items.end;
        Node { block: placed.block, cursor, canvas: node.canvas, place, far, pen, span }
    }

    /// Which part of a picture is done, as the segments tell that are in blocks that `counts`; `None` where too many items
    /// would have to be looked at.
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
            if looked_at > LOOKED_AT {
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

    /// Leaves out everything from a segment on, of a picture that has just begun: along the way down to that segment, what
    /// comes after it counts as done.
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
            // Polygons before the first segment that is left out are there.
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
