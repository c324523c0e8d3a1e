//! The descent through a drawing's graph, last item first, on an explicit stack so that it can stop anywhere.

use super::ascent::{Ascent, Climb, Start};
use super::canvas::Canvas;
use super::descent::{Cut, Descent, Node};
use super::inks::{Inks, Shade};
use super::painter::{BROAD, Painter};
use super::parts::Scene;
use super::passes::{Passes, sketch};
use super::shape::Shape;
use super::stroke::Capsule;
use super::switch::{Switch, Whole};
use super::tile;
use super::tiling::{Bounds, Tiling};
use super::view::{Camera, Detail, Look, View, Viewport};
use super::{Pane, RenderStats};
use lsystem_drawing::{Drawing, Item};
use lsystem_syntax::{Meter, Progress, Style};

/// Where the ascent cannot be taken, a picture is true as long as it takes no more steps than this: blocks looked into,
/// strokes and stamps. After a few seconds nobody waits for more, and what is left is painted as the outlines of ever
/// larger blocks.
const PATIENCE: u64 = 2_500_000;
/// Each pane gets a quarter of these steps: a picture in panes is a large one.
const PANES: u64 = 4;
/// The largest extent, in subsamples, of the outlines at first, and the steps after which it doubles.
const ROUGH: (f64, u64) = (16.0, 100_000);
/// The part of a length that may be rounding.
const ROUNDING: f64 = 1e-9;

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
    painter: Painter,
    pub tiling: Tiling,
    passes: Passes,
    descent: Descent,
    stack: Vec<Node>,
    /// The largest extent at which a block's outline will do.
    rough: f64,
    /// The steps after which it becomes more.
    patience: u64,
    pub switch: Switch,
    /// How the ascent is started, if it ever is.
    start: Option<Start>,
    ascent: Option<Box<dyn Climb>>,
}

impl Default for Walk {
    fn default() -> Self {
        Self::new(Some(Ascent::start))
    }
}

impl Walk {
    /// One that may take the ascent which is started like this.
    pub(super) fn new(start: Option<Start>) -> Self {
        Self {
            plan: None,
            cut: None,
            painter: Painter::default(),
            tiling: Tiling::default(),
            passes: Passes::default(),
            descent: Descent::default(),
            stack: vec![],
            rough: 0.0,
            patience: PATIENCE,
            switch: Switch::default(),
            start,
            ascent: None,
        }
    }

    /// Forgets everything about the drawing there was.
    pub(super) fn clear(&mut self) {
        self.stop();
        self.tiling.clear();
        self.painter.inks.clear();
        self.descent.path.clear();
    }

    /// Gives up the picture that is being made.
    fn stop(&mut self) {
        self.plan = None;
        self.cut = None;
        self.painter.stop();
        self.passes = Passes::default();
        self.stack.clear();
        self.tiling.stop();
        self.switch.forbid();
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
        self.painter.begin(drawing.memoised);
        let samples = detail.samples();
        let camera = Camera::new(drawing, viewport, view, samples as f64).of_pane(pane, samples as f64);
        self.patience = if pane == Pane::whole(viewport) { PATIENCE } else { PATIENCE / PANES };
        let hairline = viewport.least_width(style) * samples as f64 / 2.0;
        let look = Look { hairline, step: camera.step, scale: camera.scale };
        // Rough tiles would spoil this picture.
        let rough = core::mem::take(&mut self.rough) > 0.0;
        if self.painter.inks.choose(drawing, style) || look != self.painter.look || rough {
            self.painter.look = look;
            self.tiling.clear();
        }
        self.plan = Some(Plan { style: style.clone(), viewport, camera, samples, upto, pane });
    }

    /// Finds out what the picture needs to know of the drawing, and empties the canvas.
    pub(super) fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        let Some(plan) = self.plan.take() else { return Progress::Done };
        if self.painter.inks.prepare(drawing, meter) == Progress::More
            || self.descent.path.prepare(drawing, &plan.style, meter) == Progress::More
        {
            self.plan = Some(plan);
            return Progress::More;
        }
        let size = [plan.pane.width, plan.pane.height].map(|side| side as usize * plan.samples);
        if self.painter.canvases[0].make_room(size, self.painter.inks.picture_planes(), meter) == Progress::More {
            self.plan = Some(plan);
            return Progress::More;
        }
        self.start(drawing, &plan);
        // That was counted while room was made.
        self.painter.canvases[0].take_work();
        Progress::Done
    }

    fn start(&mut self, drawing: &Drawing, plan: &Plan) {
        let Plan { viewport, camera, samples, upto, pane, .. } = *plan;
        let [width, height] = [pane.width, pane.height].map(|side| side as usize * samples);
        let frame = &mut self.painter.canvases[0];
        frame.reset(width, height, self.painter.inks.picture_planes());
        frame.holes = self.painter.repeats;
        let Some(root) = self.descent.root(drawing, camera) else { return };
        let free = upto.is_none() && !self.descent.path.counts();
        let one = matches!(self.painter.inks.of(root.block.0 as usize), Inks::One(_));
        if free && one && (BROAD..f64::INFINITY).contains(&self.painter.widest(drawing, &root)) {
            self.passes.begin(root);
            return;
        }
        self.stack.push(root);
        if free && self.painter.repeats {
            let samples = samples as f64;
            let corner = [pane.x, pane.y].map(|v| -f64::from(v) * samples);
            let [width, height] = [viewport.width, viewport.height].map(|v| f64::from(v) * samples);
            self.switch.allow((root, [corner, [corner[0] + width, corner[1] + height]]));
        }
        self.cut = upto.map(Cut::new);
    }

    /// Starts the next pass, if there is one; what that took.
    fn refine(&mut self, drawing: &Drawing, shapes: &[Shape]) -> Option<u64> {
        let (root, first) = self.passes.next(&self.painter, drawing)?;
        self.stack.push(root);
        Some(if first { sketch(&mut self.painter, &mut self.descent, drawing, shapes, &root) } else { 1 })
    }

    pub(super) fn frame(&self) -> &Canvas {
        &self.painter.canvases[0]
    }

    /// The palette entries of the picture's colours.
    pub(super) fn inks(&self) -> &[u32] {
        self.painter.inks.used()
    }

    pub(super) fn stats(&self) -> RenderStats {
        self.painter.stats
    }

    pub(super) fn step(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        if let Some(cut) = &mut self.cut {
            if self.descent.leave_out(drawing, self.painter.inks.choice, &mut self.stack, cut, meter) == Progress::More
            {
                return Progress::More;
            }
            self.cut = None;
        }
        while !meter.is_spent() {
            if self.painter.fill(meter) {
                continue;
            }
            if let Some(progress) = self.ascend(drawing, shapes, meter) {
                return progress;
            }
            if self.tiling.finish(&mut self.painter, self.stack.len(), meter) {
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
                    let mut pen = node.pen.after(self.painter.inks.choice, &drawing.styles[stroke.style.0 as usize]);
                    if self.descent.path.counts() && node.canvas == 0 {
                        let span = self.descent.path.stroke(node.block, node.span);
                        pen.shade = Shade { number: span.ink(), fixed: true };
                        node.span.end -= span.size;
                    }
                    let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
                    meter.charge(self.painter.stroke(canvas, ends, pen));
                }
                Item::Polygon(polygon) => {
                    let mut pen = node.pen.after(self.painter.inks.choice, &drawing.styles[polygon.style.0 as usize]);
                    if self.descent.path.counts() && node.canvas == 0 {
                        pen.shade =
                            Shade { number: self.descent.path.stroke(node.block, node.span).ink(), fixed: true };
                    }
                    let place = node.place;
                    meter.charge(self.painter.polygon(canvas, &place, drawing.vertices_of(polygon), pen));
                }
                Item::Block(placed) => {
                    let child = self.descent.child(drawing, self.painter.inks.choice, node, placed);
                    node.span.end -= child.span.size;
                    meter.charge(self.block(drawing, shapes, &child));
                }
            }
            // Looking whether broad strokes are covered takes as long as they do.
            let work = self.painter.canvases[canvas].take_work();
            self.painter.add_work(work);
            meter.charge(work);
        }
        Progress::More
    }

    /// Goes on with the ascent, if that is to be taken.
    fn ascend(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Option<Progress> {
        let due = self.due_ascent(drawing, shapes);
        let Painter { look, inks, canvases: [frame, ..], stats, .. } = &mut self.painter;
        let scene = Scene { drawing, shapes, inks };
        if let Some((root, seen)) = due {
            self.ascent = self.start.and_then(|start| start(scene, *look, root, seen));
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
                    self.tiling.free();
                    frame.reset(frame.strips * u64::BITS as usize, frame.height, frame.planes);
                }
            }
        }
        let progress = ascent.step(scene, &mut self.descent, frame, stats, meter);
        if progress == Progress::Done {
            self.ascent = None;
        }
        Some(progress)
    }

    /// What to start the ascent with, if it is to be tried now.
    fn due_ascent(&mut self, drawing: &Drawing, shapes: &[Shape]) -> Option<Whole> {
        let painter = &self.painter;
        let done = || {
            let (look, size) = (painter.look, painter.canvases[0].size());
            let is_seen = |node: &Node| {
                let (block, shape) = (&drawing.blocks[node.block.0 as usize], &shapes[node.block.0 as usize]);
                let centre = node.place.point(shape.centre);
                !node.place.misses(size, centre, shape.half, look.widest(block, node.pen.width))
            };
            self.descent.done(drawing, painter.inks.choice, &self.stack, is_seen)
        };
        self.switch.take(painter.steps(), done)
    }

    /// Lets outlines do for larger blocks, the longer the picture takes.
    fn grow_rough(&mut self) {
        let work = self.painter.steps();
        if self.painter.repeats && work > self.patience {
            self.rough = libm::scalbn(ROUGH.0, ((work - self.patience) / ROUGH.1).min(1000) as i32);
        }
    }

    /// Paints a block, or puts it on the stack.
    fn block(&mut self, drawing: &Drawing, shapes: &[Shape], node: &Node) -> u64 {
        let shape = &shapes[node.block.0 as usize];
        if shape.strokes == 0 {
            return 0;
        }
        let place = node.place;
        let radius = self.painter.widest(drawing, node);
        let (centre, reach) = place.bounds(shape, radius);
        let [across, down] = [0, 1]
            .map(|axis| [(centre[axis] - reach[axis]).floor() as i64, (centre[axis] + reach[axis]).ceil() as i64]);
        let canvas = &mut self.painter.canvases[node.canvas];
        let size = canvas.size();
        if canvas.is_full(across, down) {
            self.switch.covered += 1;
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
            if capsule.is_covered(&mut self.painter.canvases[node.canvas]) {
                return 1;
            }
        }
        // What is narrow is for a later pass.
        if radius < self.passes.grain {
            return 1;
        }
        if self.painter.repeats {
            let block = u64::from(node.block.0) << 32 ^ place.heading.units();
            let sizes = [tile::scale(place.scale), node.pen.width.to_bits(), self.passes.grain.to_bits()];
            if !self.painter.is_new(node.canvas, [block, sizes[0], sizes[1], sizes[2]], place.origin) {
                return 1;
            }
        }
        if let Some(work) = self.painter.straight(drawing, shape, node, plain) {
            return work;
        }
        if extent <= self.passes.grain {
            return sketch(&mut self.painter, &mut self.descent, drawing, shapes, node);
        }
        self.grow_rough();
        if extent <= self.rough {
            return self.painter.outline(drawing, shape, node, 2.0 * radius > extent);
        }
        let mut node = *node;
        if self.passes.grain == 0.0
            && plain
            && let Some(size) = self.tiling.tile_size(&self.painter, &node, shape.strokes, extent, radius)
        {
            let bounds = Bounds { centre, reach, radius };
            let (painter, height) = (&mut self.painter, self.stack.len());
            if let Some(work) = self.tiling.stamp_or_make(painter, (shape, &mut node), bounds, size, height) {
                return work;
            }
        }
        self.painter.stats.blocks += 1;
        self.stack.push(node);
        1
    }
}
