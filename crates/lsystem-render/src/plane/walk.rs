//! The descent through a drawing's graph, last item first, on an explicit stack so that it can stop anywhere.

use super::ascent::{Ascent, Climb, Start};
use super::canvas::Canvas;
use super::descent::{Cut, Descent, Node, Place};
use super::inks::{InkTable, Inks, Shade};
use super::parts::Scene;
use super::pen::Pen;
use super::polygon::Filling;
use super::seen::Seen;
use super::shape::Shape;
use super::stroke::Capsule;
use super::tile::{self, Key, Tile, Tiles};
use super::view::{Camera, Detail, Look, TINY, View, Viewport};
use super::{Pane, RenderStats};
use lsystem_drawing::{Drawing, Item};
use lsystem_syntax::{Meter, Progress, Style};

/// A straight block longer than this is taken apart, so that rounding stays far below a subsample.
const LONG: f64 = 1e6;
/// Where the way up cannot be taken, a picture is true as long as it takes no more steps than this: blocks looked into,
/// strokes and stamps. After a few seconds nobody waits for more, and what is left is painted as the outlines of ever
/// larger blocks.
const PATIENCE: u64 = 2_500_000;
/// After so many steps the way up is tried: that takes as long as some of them at most, whatever is left.
const SOON: u64 = 1_000_000;
/// It is tried after a tenth of them already where less than this part of the picture is done and more than one in so
/// many steps led to what is covered: what is a little off shows least in a crowd.
const SLOW: f64 = 1e-5;
const CROWD: u64 = 50;
/// A pane of a picture has a part of them: there are about so many panes for each of those who make them.
const PANES: u64 = 4;
/// The largest extent, in subsamples, of the outlines at first, and the steps after which it doubles.
const ROUGH: (f64, u64) = (16.0, 100_000);
/// A stroke of so many units of work takes as long as two steps.
const UNITS: u64 = 32;
/// Strokes wider than twice this, in subsamples, are broad: they are not painted into tiles.
const BROAD: f64 = 64.0;
/// From pass to pass the grain becomes finer by this.
const FINER: f64 = 4.0;
/// A grain of this, in subsamples, is fine enough.
const FINE: f64 = 32.0;
/// So many items of a block are looked at for one stroke of it, and so many for one stroke of the whole.
const LOOKED_AT: [usize; 2] = [4096, 1 << 15];
/// The part of a length that may be rounding.
const ROUNDING: f64 = 1e-9;

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

/// A picture that has been asked for.
struct Plan {
    style: Style,
    viewport: Viewport,
    camera: Camera,
    samples: usize,
    upto: Option<u128>,
    pane: Pane,
}

/// A picture in the making.
pub(super) struct Walk {
    /// What is to be made, until the drawing is ready for it.
    plan: Option<Plan>,
    /// How far segments have been left out, if some are.
    cut: Option<Cut>,
    /// The polygon in hand, and its canvas.
    filling: Filling,
    filled: usize,
    /// Below this number of strokes on the picture, tiles are made only where they save much.
    pub simple: u64,
    /// The strokes on the picture so far.
    painted: u64,
    look: Look,
    inks: InkTable,
    /// The picture, then a canvas for each size of tile.
    canvases: [Canvas; 1 + tile::SIZES],
    /// By canvas: how often it has been started anew.
    serials: [u64; 1 + tile::SIZES],
    tiles: Tiles,
    descent: Descent,
    stack: Vec<Node>,
    seen: Seen,
    /// Whether blocks may recur.
    repeats: bool,
    making: Vec<Making>,
    /// The largest extent at which a block's outline will do.
    rough: f64,
    /// The steps after which it becomes more.
    patience: u64,
    /// The whole drawing, where it is painted in passes from coarse to fine.
    root: Option<Node>,
    /// The extent of blocks of which this pass paints one stroke only; 0 in the last pass.
    grain: f64,
    /// The steps after which the way up is tried.
    pub soon: u64,
    /// The steps after which it is looked at whether it is to be tried.
    due: u64,
    /// The steps that led to what was covered already.
    covered: u64,
    /// Where it has not been tried and may be: the whole drawing, and the upper left and the lower right corner of the
    /// whole picture in subsamples, of which this may be a pane.
    untried: Option<(Node, [[f64; 2]; 2])>,
    /// How the way up is started, if it ever is.
    start: Option<Start>,
    ascent: Option<Box<dyn Climb>>,
    /// What outlines and broad strokes took beyond a step each.
    extra: u64,
    pub stats: RenderStats,
}

impl Default for Walk {
    fn default() -> Self {
        Self::new(Some(Ascent::start))
    }
}

impl Walk {
    /// One that may take the way up which is started like this.
    pub(super) fn new(start: Option<Start>) -> Self {
        Self {
            plan: None,
            cut: None,
            filling: Filling::default(),
            filled: 0,
            simple: tile::SIMPLE_STROKES,
            painted: 0,
            look: Look::default(),
            inks: InkTable::default(),
            canvases: Default::default(),
            serials: Default::default(),
            tiles: Tiles::default(),
            descent: Descent::default(),
            stack: vec![],
            seen: Seen::default(),
            repeats: false,
            making: vec![],
            rough: 0.0,
            patience: PATIENCE,
            root: None,
            grain: 0.0,
            soon: SOON,
            due: 0,
            covered: 0,
            untried: None,
            start,
            ascent: None,
            extra: 0,
            stats: RenderStats::default(),
        }
    }

    /// Forgets everything about the drawing there was.
    pub(super) fn clear(&mut self) {
        self.stop();
        self.tiles.clear();
        self.inks.clear();
        self.descent.path.clear();
    }

    /// Gives up the picture that is being made.
    fn stop(&mut self) {
        self.plan = None;
        self.cut = None;
        self.filling = Filling::default();
        self.root = None;
        self.stack.clear();
        self.making.clear();
        self.untried = None;
        self.ascent = None;
    }

    /// Starts a pane of a picture, of the segments before `upto` where that is given.
    #[expect(clippy::too_many_arguments, reason = "each is another kind of thing")]
    pub(super) fn begin(
        &mut self,
        drawing: &Drawing,
        style: &Style,
        viewport: Viewport,
        view: View,
        detail: Detail,
        upto: Option<u128>,
        pane: Pane,
    ) {
        self.stop();
        self.stats = RenderStats::default();
        self.repeats = drawing.memoised;
        (self.painted, self.extra, self.grain) = (0, 0, 0.0);
        self.seen.clear();
        let samples = detail.samples();
        let camera = Camera::new(drawing, viewport, view, samples as f64).of_pane(pane, samples as f64);
        self.patience = if pane == Pane::whole(viewport) { PATIENCE } else { PATIENCE / PANES };
        let hairline = viewport.least_width(style) * samples as f64 / 2.0;
        let look = Look { hairline, step: camera.step, scale: camera.scale };
        // Rough tiles would spoil this picture.
        let rough = core::mem::take(&mut self.rough) > 0.0;
        if self.inks.choose(drawing, style) || look != self.look || rough {
            self.look = look;
            self.tiles.clear();
        }
        self.plan = Some(Plan { style: style.clone(), viewport, camera, samples, upto, pane });
    }

    /// Finds out what the picture needs to know of the drawing, and empties the canvas.
    pub(super) fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        let Some(plan) = self.plan.take() else { return Progress::Done };
        if self.inks.prepare(drawing, meter) == Progress::More
            || self.descent.path.prepare(drawing, &plan.style, meter) == Progress::More
        {
            self.plan = Some(plan);
            return Progress::More;
        }
        let size = [plan.pane.width, plan.pane.height].map(|side| side as usize * plan.samples);
        if self.canvases[0].make_room(size, self.inks.picture_planes(), meter) == Progress::More {
            self.plan = Some(plan);
            return Progress::More;
        }
        self.start(drawing, &plan);
        // That was counted while room was made.
        self.canvases[0].take_work();
        Progress::Done
    }

    fn start(&mut self, drawing: &Drawing, plan: &Plan) {
        let Plan { viewport, camera, samples, upto, pane, .. } = *plan;
        let [width, height] = [pane.width, pane.height].map(|side| side as usize * samples);
        self.canvases[0].reset(width, height, self.inks.picture_planes());
        self.canvases[0].holes = self.repeats;
        let Some(root) = self.descent.root(drawing, camera) else { return };
        let free = upto.is_none() && !self.descent.path.counts();
        let one = matches!(self.inks.of(root.block.0 as usize), Inks::One(_));
        if free && one && (BROAD..f64::INFINITY).contains(&self.widest(drawing, &root)) {
            (self.root, self.grain) = (Some(root), f64::INFINITY);
            return;
        }
        self.stack.push(root);
        if free && self.repeats {
            let samples = samples as f64;
            let corner = [pane.x, pane.y].map(|v| -f64::from(v) * samples);
            let [width, height] = [viewport.width, viewport.height].map(|v| f64::from(v) * samples);
            self.untried = Some((root, [corner, [corner[0] + width, corner[1] + height]]));
            (self.due, self.covered) = (self.soon / 10, 0);
        }
        self.cut = upto.map(Cut::new);
    }

    /// Half the width of a block's widest stroke, at most.
    fn widest(&self, drawing: &Drawing, node: &Node) -> f64 {
        self.look.widest(&drawing.blocks[node.block.0 as usize], node.pen.width)
    }

    /// Whether the way up is to be tried now.
    fn is_late(&mut self, drawing: &Drawing, shapes: &[Shape]) -> bool {
        let work = self.work();
        if self.untried.is_none() || work <= self.due {
            return false;
        }
        if work > self.soon {
            return true;
        }
        self.due = self.soon;
        let (look, size) = (self.look, self.canvases[0].size());
        let is_seen = |node: &Node| {
            let (block, shape) = (&drawing.blocks[node.block.0 as usize], &shapes[node.block.0 as usize]);
            let centre = node.place.point(shape.centre);
            !node.place.misses(size, centre, shape.half, look.widest(block, node.pen.width))
        };
        self.covered * CROWD > work
            && self.descent.done(drawing, self.inks.choice, &self.stack, is_seen).is_some_and(|done| done < SLOW)
    }

    /// Starts the next pass, if there is one; what it took. Where all is in one colour, the order is free: of blocks that
    /// are small beside the width of their strokes, one stroke each covers most of what the others would add slivers to.
    fn refine(&mut self, drawing: &Drawing, shapes: &[Shape]) -> Option<u64> {
        let root = self.root.filter(|_| self.grain > 0.0)?;
        self.stack.push(root);
        let first = self.grain.is_infinite();
        self.grain = match self.grain {
            // Without repeats each pass would go through all there is.
            _ if first && self.repeats => self.widest(drawing, &root),
            grain if !first && grain > FINE => grain / FINER,
            _ => 0.0,
        };
        Some(if first { self.sketch(drawing, shapes, &root) } else { 1 })
    }

    /// Paints a stroke of a block: one that is near the middle of the picture, of which it may cover all.
    fn sketch(&mut self, drawing: &Drawing, shapes: &[Shape], node: &Node) -> u64 {
        let mut node = *node;
        let middle = self.canvases[0].size().map(|side| side / 2.0);
        let away = |p: [f64; 2]| libm::hypot(p[0] - middle[0], p[1] - middle[1]);
        let mut looked_at = 0;
        let work = loop {
            // The last pass paints every stroke, so that none need be found here.
            let items = drawing.items_of(node.block);
            let every = items.len().div_ceil(LOOKED_AT[0]).max(1);
            looked_at += items.len() / every;
            if looked_at > LOOKED_AT[1] {
                break 0;
            }
            // Always on into what is nearest.
            let (mut least, mut next, mut nearest) = (f64::INFINITY, None, None);
            for item in items.iter().step_by(every) {
                match item {
                    Item::Stroke(stroke) => {
                        let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
                        let distance = ends.map(away).into_iter().fold(f64::INFINITY, f64::min);
                        if distance < least {
                            let pen = node.pen.after(self.inks.choice, &drawing.styles[stroke.style.0 as usize]);
                            (least, next, nearest) = (distance, None, Some((ends, pen)));
                        }
                    }
                    Item::Block(placed) if shapes[placed.block.0 as usize].strokes > 0 => {
                        let child = self.descent.child(drawing, self.inks.choice, &node, placed);
                        let distance = away(child.place.point(shapes[placed.block.0 as usize].centre));
                        if distance < least {
                            (least, next, nearest) = (distance, Some(child), None);
                        }
                    }
                    _ => {}
                }
            }
            if let Some((ends, pen)) = nearest {
                break self.stroke(0, ends, pen);
            }
            let Some(child) = next else { break 0 };
            if let Some(work) = self.straight(drawing, &shapes[child.block.0 as usize], &child, true) {
                break work;
            }
            node = child;
        };
        self.extra += looked_at as u64 / UNITS;
        looked_at as u64 + work
    }

    pub(super) fn frame(&self) -> &Canvas {
        &self.canvases[0]
    }

    /// The palette entries of the picture's colours.
    pub(super) fn inks(&self) -> &[u32] {
        self.inks.used()
    }

    pub(super) fn step(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        if let Some(cut) = &mut self.cut {
            if self.descent.leave_out(drawing, self.inks.choice, &mut self.stack, cut, meter) == Progress::More {
                return Progress::More;
            }
            self.cut = None;
        }
        while !meter.is_spent() {
            if !self.filling.is_done() {
                self.filling.step(&mut self.canvases[self.filled], meter);
                continue;
            }
            if let Some(progress) = self.ascend(drawing, shapes, meter) {
                return progress;
            }
            if let Some(making) = self.making.pop_if(|making| making.height == self.stack.len()) {
                let canvas = &mut self.canvases[1 + making.size];
                canvas.settle();
                // As much again to keep it.
                meter.charge(1 + 2 * canvas.take_work());
                let tile = self.tiles.insert(making.key, canvas, making.corner);
                self.stats.tiles += 1;
                meter.charge(self.stamp(&tile, making.inks, making.target));
                continue;
            }
            let Some(node) = self.stack.last_mut() else {
                let Some(work) = self.refine(drawing, shapes) else { return Progress::Done };
                meter.charge(work);
                continue;
            };
            if node.cursor <= drawing.blocks[node.block.0 as usize].items.start {
                self.stack.pop();
                continue;
            }
            node.cursor -= 1;
            meter.charge(1);
            let canvas = node.canvas;
            match &drawing.items[node.cursor as usize] {
                Item::Stroke(stroke) => {
                    let mut pen = node.pen.after(self.inks.choice, &drawing.styles[stroke.style.0 as usize]);
                    if self.descent.path.counts() && node.canvas == 0 {
                        let span = self.descent.path.stroke(node.block, node.span);
                        pen.shade = Shade { number: span.ink(), fixed: true };
                        node.span.end -= span.size;
                    }
                    let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
                    meter.charge(self.stroke(canvas, ends, pen));
                }
                Item::Polygon(polygon) => {
                    let mut pen = node.pen.after(self.inks.choice, &drawing.styles[polygon.style.0 as usize]);
                    if self.descent.path.counts() && node.canvas == 0 {
                        pen.shade =
                            Shade { number: self.descent.path.stroke(node.block, node.span).ink(), fixed: true };
                    }
                    let place = node.place;
                    meter.charge(self.polygon(canvas, &place, drawing.vertices_of(polygon), pen));
                }
                Item::Block(placed) => {
                    let child = self.descent.child(drawing, self.inks.choice, node, placed);
                    node.span.end -= child.span.size;
                    meter.charge(self.block(drawing, shapes, &child));
                }
            }
            // Looking whether broad strokes are covered takes as long as they do.
            let work = self.canvases[canvas].take_work();
            self.extra += work / UNITS;
            meter.charge(work);
        }
        Progress::More
    }

    /// Goes on with the way up, if that is to be taken.
    fn ascend(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Option<Progress> {
        let late = self.is_late(drawing, shapes);
        let scene = Scene { drawing, shapes, inks: &self.inks };
        if late && let Some((root, seen)) = self.untried.take() {
            self.ascent = self.start.and_then(|start| start(scene, self.look, root, seen));
        }
        let ascent = self.ascent.as_mut()?;
        if !ascent.is_planned() {
            match ascent.plan(scene, &mut self.descent, meter) {
                None => {
                    self.ascent = None;
                    return None;
                }
                Some(Progress::More) => return Some(Progress::More),
                Some(Progress::Done) => {
                    // Its picture is of one kind throughout, and its parts take the tiles' memory.
                    self.stack.clear();
                    self.making.clear();
                    self.tiles = Tiles::default();
                    let frame = &mut self.canvases[0];
                    frame.reset(frame.strips * u64::BITS as usize, frame.height, frame.planes);
                }
            }
        }
        let progress = ascent.step(scene, &mut self.descent, &mut self.canvases[0], &mut self.stats, meter);
        if progress == Progress::Done {
            self.ascent = None;
        }
        Some(progress)
    }

    fn stroke(&mut self, canvas: usize, [from, to]: [[f64; 2]; 2], pen: Pen) -> u64 {
        let radius = self.look.radius(pen.width);
        if self.repeats && !self.seen.paint([self.tag(canvas), radius.to_bits()], [from, to]) {
            return 0;
        }
        self.stats.strokes += 1;
        self.painted += u64::from(canvas == 0);
        let colour = self.inks.code(pen.shade);
        let rows = Capsule { from, to, radius }.paint(&mut self.canvases[canvas], colour);
        let work = rows as u64 / 4 + self.canvases[canvas].take_work();
        self.extra += work / UNITS;
        work
    }

    /// What tells a canvas from others, former tiles included.
    fn tag(&self, canvas: usize) -> u64 {
        self.serials[canvas] << 8 | canvas as u64
    }

    /// Starts to fill a polygon.
    fn polygon(&mut self, canvas: usize, place: &Place, vertices: &[[f64; 2]], pen: Pen) -> u64 {
        self.stats.strokes += 1;
        self.painted += u64::from(canvas == 0);
        let colour = self.inks.code(pen.shade);
        self.filled = canvas;
        self.filling.begin(&self.canvases[canvas], vertices.iter().map(|&vertex| place.point(vertex)), colour)
    }

    /// The steps so far.
    fn work(&self) -> u64 {
        self.stats.blocks + self.stats.strokes + self.stats.stamps + self.extra
    }

    /// Lets outlines do for larger blocks, the longer the picture takes.
    fn grow_rough(&mut self) {
        let work = self.work();
        if self.repeats && work > self.patience {
            self.rough = libm::scalbn(ROUGH.0, ((work - self.patience) / ROUGH.1).min(1000) as i32);
        }
    }

    /// Paints what a block's hull encloses, in the colour of what it draws last; where strokes are broader than the
    /// block, one of them.
    fn outline(&mut self, drawing: &Drawing, shape: &Shape, node: &Node, broad: bool) -> u64 {
        self.stats.outlines += 1;
        if broad {
            return self.axis(drawing, shape, node);
        }
        let hull = &drawing.blocks[node.block.0 as usize].hull;
        let pen = node.pen.after(self.inks.choice, &shape.last);
        match &drawing.corners[hull.start as usize..hull.end as usize] {
            [from, to] => self.stroke(node.canvas, [*from, *to].map(|p| node.place.point(p)), pen),
            corners => {
                let work = self.polygon(node.canvas, &node.place, corners, pen);
                let work = work + self.filling.finish(&mut self.canvases[node.canvas]);
                self.extra += self.filling.work as u64 / 4;
                work
            }
        }
    }

    /// Paints a stroke along a block, in the colour of what it draws last; and below it one as wide as its widest, if that
    /// is much wider.
    fn axis(&mut self, drawing: &Drawing, shape: &Shape, node: &Node) -> u64 {
        let ends = shape.axis().map(|end| node.place.point(end));
        let pen = node.pen.after(self.inks.choice, &shape.last);
        let pens = self.look.pens(&drawing.blocks[node.block.0 as usize], node.pen, pen);
        pens.map(|pen| self.stroke(node.canvas, ends, pen)).sum()
    }

    /// Stamps a tile whose block has these shades.
    fn stamp(&mut self, tile: &Tile, inks: Inks, target: Target) -> u64 {
        self.stats.stamps += 1;
        let at = [0, 1].map(|axis| target.cell[axis] + tile.corner[axis]);
        let dye = self.inks.dye(inks, target.shade);
        self.canvases[target.canvas].stamp(&self.tiles.bits(tile, &dye), at, &dye);
        1 + (tile.strips * tile.rows * (1 + tile.planes())) as u64 / 32
    }

    /// Paints a block that is a straight line in one colour, or too small to tell from one.
    fn straight(&mut self, drawing: &Drawing, shape: &Shape, node: &Node, plain: bool) -> Option<u64> {
        let extent = shape.extent(node.place.scale);
        if let Some(line) = &shape.line
            && extent < LONG
            && plain
        {
            let ends = [line.from, line.to].map(|p| node.place.point(p));
            return Some(self.stroke(node.canvas, ends, node.pen.after(self.inks.choice, &line.style)));
        }
        (extent <= TINY).then(|| self.axis(drawing, shape, node))
    }

    /// Paints a block, or puts it on the stack.
    fn block(&mut self, drawing: &Drawing, shapes: &[Shape], node: &Node) -> u64 {
        let shape = &shapes[node.block.0 as usize];
        if shape.strokes == 0 {
            return 0;
        }
        let place = node.place;
        let radius = self.widest(drawing, node);
        let (centre, reach) = place.bounds(shape, radius);
        let [across, down] = [0, 1]
            .map(|axis| [(centre[axis] - reach[axis]).floor() as i64, (centre[axis] + reach[axis]).ceil() as i64]);
        let canvas = &mut self.canvases[node.canvas];
        let size = canvas.size();
        if canvas.is_full(across, down) {
            self.covered += 1;
            return 1;
        }
        if node.canvas == 0 && place.misses(size, centre, shape.half, radius) {
            return 1;
        }
        // A part of the path that has one colour is like any other block.
        let plain = !self.descent.path.counts() || node.canvas != 0 || node.span.is_short();
        let extent = shape.extent(place.scale);
        if radius > BROAD.max(extent) {
            // Broad strokes leave out the corners of their bounds.
            let [from, to] = shape.axis().map(|p| place.point(p));
            let around = radius + place.scale * shape.half[0].min(shape.half[1]);
            let capsule = Capsule { from, to, radius: around * (1.0 + ROUNDING) };
            if capsule.is_covered(&mut self.canvases[node.canvas]) {
                return 1;
            }
        }
        // What is narrow is for a later pass.
        if radius < self.grain {
            return 1;
        }
        if self.repeats {
            let block = u64::from(node.block.0) << 32 ^ place.heading.units();
            let sizes = [tile::scale(place.scale), node.pen.width.to_bits(), self.grain.to_bits()];
            if !self.seen.paint([self.tag(node.canvas), block, sizes[0], sizes[1], sizes[2]], [place.origin]) {
                return 1;
            }
        }
        if let Some(work) = self.straight(drawing, shape, node, plain) {
            return work;
        }
        if extent <= self.grain {
            return self.sketch(drawing, shapes, node);
        }
        self.grow_rough();
        if extent <= self.rough {
            return self.outline(drawing, shape, node, 2.0 * radius > extent);
        }
        let mut node = *node;
        let simple = node.canvas == 0 && self.painted < self.simple;
        let inks = self.inks.of(node.block.0 as usize);
        if let Some(size) = tile::size(extent, shape.strokes, inks, simple)
            && size + 1 > node.canvas
            && radius <= BROAD
            && self.repeats
            && self.grain == 0.0
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
