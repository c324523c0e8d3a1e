//! The descent through a drawing's graph, last item first, on an explicit stack so that it can stop anywhere.

use super::RenderStats;
use super::canvas::Canvas;
use super::inks::{Choice, Dye, InkTable, Inks, Shade};
use super::path::{Path, Span};
use super::polygon;
use super::seen::Seen;
use super::shape::Shape;
use super::stroke::Capsule;
use super::tile::{self, Key, Tile, Tiles};
use super::turns::Turns;
use super::view::{Camera, Detail, View, Viewport};
use super::wide::Wide;
use crate::{BlockId, Drawing, Heading, Item, Placed, Progress, Style, StyleChange};

/// The largest extent, in subsamples, at which a block is painted as a line.
const TINY: f64 = 2.0;
/// A straight block longer than this is taken apart, so that rounding stays far below a subsample.
const LONG: f64 = 1e6;
/// Strokes wider than twice this, in subsamples, are not painted into tiles.
const BROAD: f64 = 64.0;

/// The size of things in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Look {
    /// Half the smallest stroke width, in subsamples.
    pub hairline: f64,
    /// Subsamples in one step length.
    pub step: f64,
    /// Subsamples in one unit of the root block.
    pub scale: f64,
}

impl Look {
    fn radius(&self, width: f64) -> f64 {
        (width * self.step / 2.0).max(self.hairline)
    }
}

/// What the turtle carries apart from its position.
#[derive(Clone, Copy, Debug)]
struct Pen {
    /// Relative to what is painted on the canvas: the whole drawing, or a tile's block.
    shade: Shade,
    /// In step lengths.
    width: f64,
}

impl Pen {
    fn after(self, choice: Choice, change: &StyleChange) -> Self {
        Self { shade: choice.then(self.shade, choice.shade(change)), width: change.width.of(self.width) }
    }
}

/// A block being painted, from its last item to its first.
#[derive(Clone, Copy, Debug)]
struct Node {
    block: BlockId,
    /// The items from here on are done.
    cursor: u32,
    /// Which canvas it is painted on: 0 is the picture, others are tiles being made, by size.
    canvas: usize,
    place: Place,
    /// Where it is in the root block's frame, as long as it is large.
    far: Option<Far>,
    pen: Pen,
    /// Which part of the path it is, but for the items that are done.
    span: Span,
}

/// Where a block is in the root block's frame. On the canvas the origin of a block that is much larger than the picture
/// is a number so large that nothing is left of its fraction; here it is kept apart from the magnification.
#[derive(Clone, Copy, Debug)]
struct Far {
    at: [Wide; 2],
    /// Units of the root block in one of its own.
    scale: f64,
}

/// Blocks with more subsamples to a unit than this are placed by way of the root block's frame.
const FAR: f64 = (1_u64 << 24) as f64;

/// Where a block is on the canvas.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Its origin, in subsamples, y down.
    origin: [f64; 2],
    /// Subsamples in one of its units.
    scale: f64,
    heading: Heading,
    /// The heading's cosine and sine, times the scale.
    cos: f64,
    sin: f64,
}

impl Place {
    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.cos * x - self.sin * y, self.origin[1] - self.sin * x - self.cos * y]
    }
}

/// A tile being made.
#[derive(Clone, Copy, Debug)]
struct Making {
    key: Key,
    /// The stack's height before.
    height: usize,
    size: usize,
    /// The shades of its block.
    inks: Inks,
    /// From the cell of the origin to the tile's upper left corner.
    corner: [i64; 2],
    target: Target,
}

/// Where a tile is to be stamped.
#[derive(Clone, Copy, Debug)]
struct Target {
    canvas: usize,
    /// The cell of the origin.
    cell: [i64; 2],
    /// The shade at the block's entry.
    shade: Shade,
}

/// A picture in the making.
pub(super) struct Walk {
    /// Below this number of strokes on the picture, tiles are made only where they save much.
    pub simple: u64,
    /// The strokes on the picture so far.
    painted: u64,
    look: Look,
    camera: Option<Camera>,
    inks: InkTable,
    /// The picture, then a canvas for each size of tile.
    canvases: [Canvas; 1 + tile::SIZES],
    /// By canvas: how often it has been started anew.
    serials: [u64; 1 + tile::SIZES],
    tiles: Tiles,
    turns: Turns,
    stack: Vec<Node>,
    seen: Seen,
    /// Whether blocks may recur.
    repeats: bool,
    making: Vec<Making>,
    path: Path,
    pub stats: RenderStats,
}

impl Default for Walk {
    fn default() -> Self {
        Self {
            simple: tile::SIMPLE_STROKES,
            painted: 0,
            look: Look::default(),
            camera: None,
            inks: InkTable::default(),
            canvases: Default::default(),
            serials: Default::default(),
            tiles: Tiles::default(),
            turns: Turns::default(),
            stack: vec![],
            seen: Seen::default(),
            repeats: false,
            making: vec![],
            path: Path::default(),
            stats: RenderStats::default(),
        }
    }
}

impl Walk {
    /// Forgets everything about the drawing there was.
    pub(super) fn clear(&mut self) {
        self.stack.clear();
        self.making.clear();
        self.tiles.clear();
        self.inks.clear();
        self.path.clear();
    }

    /// Starts a picture of `width` by `height` pixels, of the segments before `upto` where that is given.
    pub(super) fn begin(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        viewport: Viewport,
        view: View,
        detail: Detail,
        upto: Option<u128>,
    ) {
        self.stats = RenderStats::default();
        self.repeats = drawing.memoised;
        self.painted = 0;
        self.seen.clear();
        self.stack.clear();
        self.making.clear();
        let camera = Camera::new(drawing, viewport, view, detail.samples() as f64);
        let min_width = (style.min_width * viewport.ratio).max(1.0);
        let min_width = if min_width.is_finite() { min_width } else { 1.0 };
        let hairline = min_width * detail.samples() as f64 / 2.0;
        let look = Look { hairline, step: camera.step, scale: camera.scale };
        if self.inks.prepare(drawing, style) || look != self.look {
            self.look = look;
            self.tiles.clear();
        }
        self.path.prepare(drawing, style);
        let [width, height] = [viewport.width, viewport.height].map(|side| side as usize * detail.samples());
        self.canvases[0].reset(width, height, self.inks.picture_planes());
        let Some((root, block)) = drawing.root.and_then(|id| Some((id, drawing.blocks.get(id.0 as usize)?))) else {
            return;
        };
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
        self.stack.push(Node {
            block: root,
            cursor: block.items.end,
            canvas: 0,
            place,
            far: Some(far),
            pen,
            span: Span::WHOLE,
        });
        if let Some(upto) = upto {
            self.leave_out(drawing, upto);
        }
    }

    pub(super) fn frame(&self) -> &Canvas {
        &self.canvases[0]
    }

    /// The palette entries of the picture's colours.
    pub(super) fn inks(&self) -> &[u32] {
        self.inks.used()
    }

    pub(super) fn step(&mut self, drawing: &Drawing, shapes: &[Shape], left: &mut i64) -> Progress {
        while *left > 0 {
            if let Some(making) = self.making.pop_if(|making| making.height == self.stack.len()) {
                let tile = self.tiles.insert(making.key, &self.canvases[1 + making.size], making.corner);
                self.stats.tiles += 1;
                *left -= self.stamp(&tile, making.inks, making.target);
                continue;
            }
            let Some(node) = self.stack.last_mut() else { return Progress::Done };
            if node.cursor <= drawing.blocks[node.block.0 as usize].items.start {
                self.stack.pop();
                continue;
            }
            node.cursor -= 1;
            let node = *node;
            *left -= 1;
            match &drawing.items[node.cursor as usize] {
                Item::Stroke(stroke) => {
                    let mut pen = node.pen.after(self.inks.choice, &drawing.styles[stroke.style.0 as usize]);
                    if self.path.counts() && node.canvas == 0 {
                        let span = self.path.stroke(node.block, node.span);
                        pen.shade = Shade { number: span.ink(), fixed: true };
                        if let Some(node) = self.stack.last_mut() {
                            node.span.end -= span.size;
                        }
                    }
                    let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
                    *left -= self.stroke(node.canvas, ends, pen);
                }
                Item::Polygon(polygon) => {
                    let mut pen = node.pen.after(self.inks.choice, &drawing.styles[polygon.style.0 as usize]);
                    if self.path.counts() && node.canvas == 0 {
                        pen.shade = Shade { number: self.path.stroke(node.block, node.span).ink(), fixed: true };
                    }
                    *left -= self.polygon(node, drawing.vertices_of(polygon), pen);
                }
                Item::Block(placed) => {
                    let child = self.child(drawing, node, placed);
                    if let Some(node) = self.stack.last_mut() {
                        node.span.end -= child.span.size;
                    }
                    let shape = &shapes[placed.block.0 as usize];
                    *left -= self.block(drawing, shape, child);
                }
            }
        }
        Progress::More
    }

    /// A block inside another, none of it done.
    fn child(&mut self, drawing: &Drawing, node: Node, placed: &Placed) -> Node {
        let heading = node.place.heading + placed.heading;
        let scale = node.place.scale * placed.scale;
        let [c, s] = self.turns.cos_sin(heading);
        let far = node.far.filter(|_| node.place.scale > FAR).map(|far| {
            let [c, s] = self.turns.cos_sin(node.place.heading).map(|v| v * far.scale);
            let [x, y] = placed.at;
            let at = [far.at[0].plus(c * x - s * y), far.at[1].plus(s * x + c * y)];
            Far { at, scale: far.scale * placed.scale }
        });
        let origin = match (&far, &self.camera) {
            (Some(far), Some(camera)) => camera.place(far.at),
            _ => node.place.point(placed.at),
        };
        let place = Place { origin, scale, heading, cos: scale * c, sin: scale * s };
        let mut pen = node.pen.after(self.inks.choice, &drawing.styles[placed.style.0 as usize]);
        let span = self.path.block(node.block, node.span, placed.block);
        if self.path.counts() && node.canvas == 0 {
            pen.shade = Shade { number: span.ink(), fixed: true };
        }
        let cursor = drawing.blocks[placed.block.0 as usize].items.end;
        Node { block: placed.block, cursor, canvas: node.canvas, place, far, pen, span }
    }

    /// Leaves out everything from the segment `from` (0-based) on, of a picture that has just begun: along the way
    /// down to that segment, what comes after it counts as done.
    fn leave_out(&mut self, drawing: &Drawing, from: u128) {
        let mut left = from;
        while let Some(node) = self.stack.last().copied() {
            let items = &drawing.blocks[node.block.0 as usize].items;
            let mut cut = None;
            let mut cursor = items.start;
            // Polygons before the first segment that is left out are there.
            while cursor < items.end && cut.is_none() {
                let segments = match &drawing.items[cursor as usize] {
                    Item::Stroke(_) => 1,
                    Item::Polygon(_) => 0,
                    Item::Block(placed) => drawing.blocks[placed.block.0 as usize].segments,
                };
                if segments > left {
                    cut = Some(&drawing.items[cursor as usize]);
                } else {
                    left -= segments;
                    cursor += 1;
                }
            }
            if let Some(top) = self.stack.last_mut() {
                top.cursor = cursor;
                top.span.end -=
                    self.path.rest(top.block, top.span, &drawing.items[cursor as usize..items.end as usize]);
            }
            let node = self.stack.last().copied().unwrap_or(node);
            match cut {
                Some(Item::Block(placed)) => {
                    let size = self.path.block(node.block, node.span, placed.block).size;
                    let around = Node { span: Span { end: node.span.end + size, ..node.span }, ..node };
                    let child = self.child(drawing, around, placed);
                    self.stack.push(child);
                }
                _ => return,
            }
        }
    }

    fn stroke(&mut self, canvas: usize, [from, to]: [[f64; 2]; 2], pen: Pen) -> i64 {
        let radius = self.look.radius(pen.width);
        if self.repeats && !self.seen.paint([self.tag(canvas), radius.to_bits()], [from, to]) {
            return 0;
        }
        self.stats.strokes += 1;
        self.painted += u64::from(canvas == 0);
        let colour = self.inks.code(pen.shade);
        Capsule { from, to, radius }.paint(&mut self.canvases[canvas], colour) as i64 / 4
    }

    /// What tells a canvas from others, former tiles included.
    fn tag(&self, canvas: usize) -> u64 {
        self.serials[canvas] << 8 | canvas as u64
    }

    fn polygon(&mut self, node: Node, vertices: &[[f64; 2]], pen: Pen) -> i64 {
        self.stats.strokes += 1;
        self.painted += u64::from(node.canvas == 0);
        let colour = self.inks.code(pen.shade);
        let vertices: Vec<_> = vertices.iter().map(|&vertex| node.place.point(vertex)).collect();
        polygon::paint(&mut self.canvases[node.canvas], &vertices, colour) as i64 / 4
    }

    /// Stamps a tile whose block has these shades.
    fn stamp(&mut self, tile: &Tile, inks: Inks, target: Target) -> i64 {
        self.stats.stamps += 1;
        let at = [0, 1].map(|axis| target.cell[axis] + tile.corner[axis]);
        let entry = match inks {
            Inks::One(shade) => self.inks.choice.then(target.shade, shade),
            _ => target.shade,
        };
        let dye = Dye { entry, colours: self.inks.choice.colours, digits: self.inks.digits() };
        self.canvases[target.canvas].stamp(&self.tiles.bits(tile), at, &dye);
        (tile.strips * tile.rows) as i64 / 64
    }

    /// Paints a block, or puts it on the stack.
    fn block(&mut self, drawing: &Drawing, shape: &Shape, mut node: Node) -> i64 {
        if shape.strokes == 0 {
            return 0;
        }
        let block = &drawing.blocks[node.block.0 as usize];
        let place = node.place;
        let radius = self.look.radius(block.widest.of(node.pen.width));
        let centre = place.point(shape.centre);
        let reach = [
            place.cos.abs() * shape.half[0] + place.sin.abs() * shape.half[1] + radius,
            place.sin.abs() * shape.half[0] + place.cos.abs() * shape.half[1] + radius,
        ];
        let [across, down] = [0, 1]
            .map(|axis| [(centre[axis] - reach[axis]).floor() as i64, (centre[axis] + reach[axis]).ceil() as i64]);
        if self.canvases[node.canvas].is_full(across, down) {
            return 1;
        }
        // A part of the path that has one colour is like any other block.
        let plain = !self.path.counts() || node.canvas != 0 || node.span.is_short();
        let extent = 2.0 * place.scale * shape.half[0].max(shape.half[1]);
        if self.repeats {
            let block = u64::from(node.block.0) << 32 ^ place.heading.units();
            let sizes = [tile::scale(place.scale), node.pen.width.to_bits()];
            if !self.seen.paint([self.tag(node.canvas), block, sizes[0], sizes[1]], [place.origin]) {
                return 1;
            }
        }
        if let Some(line) = &shape.line
            && extent < LONG
            && plain
        {
            let ends = [line.from, line.to].map(|p| place.point(p));
            return self.stroke(node.canvas, ends, node.pen.after(self.inks.choice, &line.style));
        }
        if extent <= TINY {
            let along = if shape.half[0] >= shape.half[1] { [shape.half[0], 0.0] } else { [0.0, shape.half[1]] };
            let ends = [-1.0, 1.0]
                .map(|sign| place.point([shape.centre[0] + sign * along[0], shape.centre[1] + sign * along[1]]));
            return self.stroke(node.canvas, ends, node.pen.after(self.inks.choice, &shape.last));
        }
        node.cursor = block.items.end;
        let simple = node.canvas == 0 && self.painted < self.simple;
        if let Some(size) = tile::size(extent, shape.strokes, simple)
            && size + 1 > node.canvas
            && radius <= BROAD
            && self.repeats
            && plain
        {
            let fine = !self.tiles.crowded && tile::is_sparse(extent, shape.strokes);
            let snapped = tile::snap(place.origin, size, fine);
            let key = Key {
                block: node.block,
                heading: place.heading,
                scale: tile::scale(place.scale),
                offset: snapped.offset,
                fine,
                width: (radius > self.look.hairline).then_some(node.pen.width.to_bits()),
            };
            let inks = self.inks.of(node.block.0 as usize);
            let target = Target { canvas: node.canvas, cell: snapped.cell, shade: node.pen.shade };
            if let Some(tile) = self.tiles.get(&key) {
                return self.stamp(&tile, inks, target);
            }
            let from_origin = [0, 1].map(|axis| centre[axis] - place.origin[axis] + snapped.rest[axis]);
            let corner = [0, 1].map(|axis| (from_origin[axis] - reach[axis]).floor() as i64);
            let far = [0, 1].map(|axis| (from_origin[axis] + reach[axis]).ceil() as i64 - corner[axis]);
            let far = far.map(|side| side.max(1) as usize);
            let planes = self.inks.planes(inks);
            if Tiles::fits(far, planes) {
                self.canvases[1 + size].reset(far[0], far[1], planes);
                self.serials[1 + size] += 1;
                node.place.origin = [0, 1].map(|axis| snapped.rest[axis] - corner[axis] as f64);
                node.canvas = 1 + size;
                node.pen.shade = Shade::default();
                self.making.push(Making { key, height: self.stack.len(), size, inks, corner, target });
            }
        }
        self.stats.blocks += 1;
        self.stack.push(node);
        1
    }
}
