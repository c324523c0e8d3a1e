//! The descent through a scene, tile by tile and from front to back. An explicit stack lets the descent stop anywhere.

use super::effort::Spent;
use super::lanes::Lanes;
use super::light::LightKind;
use super::lighting::Lighting;
use super::open_node::{Entry, OpenNode};
use super::painter::{LINE_WORK, TilePainter};
use super::pixels::Pixels;
use super::place::Place;
use super::plan::Plan;
use super::scene::{MainLine, Scene, SceneNode};
use super::setup::Setup;
use super::shares::UNLIMITED;
use super::stand_in::{self, Disc};
use crate::ink::{Pigment, Shade};
use crate::pane::{Pane, Pass};
use crate::{RenderStats, Viewport};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::rotation::{combine, minus};
use lsystem_drawing::{Drawing, Solid};
use lsystem_syntax::Ink;

/// Nodes with a larger radius than this, in samples, are checked for being hidden.
const LEAST_HIDDEN: f32 = 3.0;
/// The size of dots, relative to that of other dots, up to which a node without enough budget is a dot.
const LARGEST_DOT: f32 = 2.0;
/// A drawing of at most this many strokes and nodes is always drawn in full: it takes little time, and each stroke
/// shows.
const ALWAYS_DRAWN: f32 = 16_000.0;
/// After this many layers of primitives over a whole tile, nodes get no budget. After twice as many the tile ends.
const MAX_LAYERS: f64 = 16.0;
/// The units of work for a node.
const NODE_WORK: i64 = 8;
/// Samples of a tile that are emptied, or turned into pixels, in a unit of work.
const TILE_WORK: u64 = 64;
/// Samples of a tile that are lit and turned into pixels in a unit of work.
const LIT_WORK: u64 = 16;

/// A picture in space in the making.
#[derive(Default)]
pub(super) struct Picture {
    setup: Option<Setup>,
    stack: Vec<OpenNode>,
    painter: TilePainter,
    pixels: Pixels,
    /// The tiles from this one on are still to be painted.
    next: usize,
    painting: bool,
    /// The units of work of all tiles so far.
    work: i64,
    /// The units of work of the tiles before the present tile.
    before: i64,
    /// Whether the budget was too small for some node.
    lacks_budget: bool,
    /// The sums of colours in full light and in their own, of a picture with shadows.
    colours: [Lanes; 2],
}

impl Picture {
    /// Whether the picture before had the same size.
    pub(super) fn fits(&self, viewport: Viewport) -> bool {
        self.pixels.fits(viewport)
    }

    /// Starts a picture, or the pane of it that the plan asks for; `only_ink` is the pigment of a drawing in one ink.
    /// Returns the units of work.
    pub(super) fn begin(
        &mut self,
        drawing: &Drawing<Solid>,
        plan: &Plan,
        is_transparent: bool,
        only_ink: Option<Pigment>,
    ) -> u64 {
        let Plan { style, viewport, camera, quality, dim, pane: only } = plan;
        let (viewport, quality) = (*viewport, *quality);
        let (pane, pass) =
            only.map_or((Pane::whole(viewport), Pass::Only), |only| (only.pane.within(viewport), only.pass));
        let budget = only.map(|only| only.budget);
        let [r, g, b] = style.background.rgb;
        let paper = if is_transparent { [0; 4] } else { [r, g, b, u8::MAX] };
        let mut setup = Setup::new(drawing, style, viewport, camera, quality, (pane, budget), paper);
        setup.light.dim = *dim;
        self.colours = [Lanes::all(0.0); 2];
        let size = if style.ink == Ink::Density {
            self.pixels.outline(pane);
            self.setup = Some(setup.additive(pane));
            let additive = self.painter.additive.get_or_insert_default();
            additive.begin((style, is_transparent), viewport, (pane, pass), only_ink) as usize * 1024
        } else {
            self.painter.additive = None;
            self.setup = Some(setup);
            self.pixels.begin(pane, paper)
        };
        self.stack.clear();
        self.painter.stop();
        self.painter.stats = RenderStats::default();
        self.next = 0;
        self.painting = false;
        (self.work, self.lacks_budget) = (0, false);
        1 + size as u64 / 1024
    }

    /// Starts a depth picture.
    pub(super) fn begin_depths(&mut self, setup: Setup) {
        self.stop();
        (self.work, self.before, self.lacks_budget) = (0, 0, false);
        self.painting = false;
        self.setup = Some(setup);
    }

    /// Goes on with a depth picture.
    pub(super) fn step_depths(&mut self, scene: &Scene, meter: &mut Meter) -> Progress {
        let Some(setup) = self.setup else { return Progress::Done };
        if !self.painting {
            self.painting = true;
            let size = setup.size.map(|count| count as usize);
            self.painter.begin(&setup, setup.corner, size);
            meter.charge((setup.side[0] * setup.side[1]) as u64 / TILE_WORK);
            self.enter(scene, &setup);
        }
        self.paint(scene, &setup, meter)
    }

    /// The first depths of a row of a depth picture.
    pub(super) fn depths(&mut self, row: usize, count: usize) -> &[f32] {
        self.painter.tile.row(row, [0, count - 1]).0
    }

    /// How much darker than full light shadows make the drawing on the whole, by channel; `None` without shadows.
    pub(super) fn dim(&self) -> Option<[f32; 3]> {
        let [full, lit] = self.colours;
        (full.0[1] > 0.0).then(|| [0, 1, 2].map(|i| (lit.0[i] / full.0[i].max(1.0)).min(1.0)))
    }

    /// The work of the picture, or of the pane, so far with its present budget.
    pub(super) fn spent(&self) -> Spent {
        Spent { work: self.work as f64, poor: self.lacks_budget }
    }

    /// The picture so far.
    pub(super) fn pixels(&self) -> &[u8] {
        self.painter.additive.as_ref().map_or(&self.pixels.bytes, |additive| additive.pixels())
    }

    pub(super) fn stats(&self) -> RenderStats {
        self.painter.stats
    }

    /// Gives up the unfinished picture.
    pub(super) fn stop(&mut self) {
        self.setup = None;
        self.stack.clear();
        self.painter.stop();
    }

    /// Starts again with a larger budget, if the budget was too small. Returns whether it does.
    fn starts_again(&mut self) -> bool {
        let spent = self.spent();
        let Some(setup) = self.setup.as_mut().filter(|setup| !setup.pane) else { return false };
        if !setup.effort.is_too_small(spent) {
            return false;
        }
        (self.work, self.lacks_budget) = (0, false);
        self.next = 0;
        self.pixels.begin_again();
        if let Some(additive) = &mut self.painter.additive {
            additive.begin_again();
        }
        true
    }

    /// Goes on with the picture, in a light that is ready if the picture has shadows.
    pub(super) fn step(&mut self, scene: &Scene, lighting: &Lighting, meter: &mut Meter) -> Progress {
        let Some(setup) = self.setup else { return Progress::Done };
        if self.painter.additive.is_some() {
            return self.step_additive(scene, &setup, meter);
        }
        // Pixels along the sides of a tile.
        let side = setup.side.map(|side| side / setup.samples);
        let across = self.pixels.width.div_ceil(side[0]);
        let count = across * self.pixels.height.div_ceil(side[1]);
        if self.pixels.wipe(meter) == Progress::More {
            return Progress::More;
        }
        while !meter.is_spent() {
            if self.next >= count {
                return if self.starts_again() { Progress::More } else { Progress::Done };
            }
            let at = [self.next % across, self.next / across];
            // The last tiles of rows and columns are cut at the edge of the picture.
            let rest = [self.pixels.width, self.pixels.height].map(|pixels| pixels * setup.samples);
            let size = [0, 1].map(|i| setup.side[i].min(rest[i] - at[i] * setup.side[i]));
            if !self.painting {
                self.painting = true;
                self.before = self.work;
                let corner = [0, 1].map(|i| setup.corner[i] + (at[i] * setup.side[i]) as f64);
                self.painter.begin(&setup, corner, size);
                meter.charge((size[0] * size[1]) as u64 / TILE_WORK);
                self.enter(scene, &setup);
            }
            if self.paint(scene, &setup, meter) == Progress::More {
                return Progress::More;
            }
            self.painting = false;
            if setup.light.kind == LightKind::Full {
                let corner = setup.corner.map(|c| c as usize / setup.samples);
                let [full, lit] = self.pixels.put_lit(&self.painter.tile, (at, side), corner, &setup.light, lighting);
                self.colours = [self.colours[0] + full, self.colours[1] + lit];
                meter.charge((size[0] * size[1]) as u64 / LIT_WORK);
            } else {
                self.pixels.put(&self.painter.tile, at, side, setup.samples);
                meter.charge((size[0] * size[1]) as u64 / TILE_WORK);
            }
            self.next += 1;
        }
        Progress::More
    }

    /// Goes on with a picture in additive ink, which has a single tile.
    fn step_additive(&mut self, scene: &Scene, setup: &Setup, meter: &mut Meter) -> Progress {
        let Some(additive) = &mut self.painter.additive else { return Progress::Done };
        if additive.paints() && self.next == 0 {
            let most = || stand_in::most(scene, setup);
            if !self.painting {
                if additive.prepare(most, meter) == Progress::More {
                    return Progress::More;
                }
                self.painting = true;
                self.before = self.work;
                self.painter.begin(setup, setup.corner, setup.side);
                self.enter(scene, setup);
            }
            if self.paint(scene, setup, meter) == Progress::More {
                return Progress::More;
            }
            self.painting = false;
            if self.starts_again() {
                return Progress::More;
            }
            self.next = 1;
        }
        self.painter.additive.as_mut().map_or(Progress::Done, |additive| additive.resolve(meter))
    }

    /// Puts the whole drawing on the stack.
    fn enter(&mut self, scene: &Scene, setup: &Setup) {
        let Some(root) = scene.root else { return };
        let shade = Shade { number: 0, fixed: true };
        let share = if is_always_drawn(scene) { UNLIMITED } else { setup.effort.budget };
        let place = Place::root(&setup.lens);
        self.open(scene, setup, root, Entry { place, shade, path: scene.shown, widths: setup.widths, share });
    }

    /// Reduces the budget of the rest of the picture to a `part`.
    pub(super) fn scale_budget(&mut self, scene: &Scene, part: f32) {
        if is_always_drawn(scene) {
            return;
        }
        if let Some(setup) = &mut self.setup {
            setup.effort = setup.effort.with_budget(setup.effort.budget * part);
        }
        for open in &mut self.stack {
            open.scale_budget(scene, part);
        }
    }

    /// Whether this tile has taken more than `times` its work. The work of other tiles does not count, because a pane
    /// of this tile alone must have the same pixels.
    fn exceeds_work(&self, setup: &Setup, times: u8) -> bool {
        let most = 2 * setup.effort.work * i64::from(times);
        most > 0 && self.work - self.before > most || self.painter.layers > MAX_LAYERS * f64::from(times)
    }

    /// Goes on with a tile.
    fn paint(&mut self, scene: &Scene, setup: &Setup, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            if self.painter.additive.is_none() && self.exceeds_work(setup, 2) {
                // Most of the remaining nodes are hidden, because the nearest come first.
                self.painter.stop();
                self.stack.clear();
                return Progress::Done;
            }
            if let Some(cost) = self.painter.go_on(setup, meter) {
                self.work += cost;
                continue;
            }
            let Some(open) = self.stack.last_mut() else { return Progress::Done };
            if open.left == 0 {
                let spare = open.spare;
                self.stack.pop();
                if let Some(open) = self.stack.last_mut() {
                    open.spare += spare;
                }
                continue;
            }
            open.left -= 1;
            let lane = usize::from(open.order[usize::from(open.left)]);
            let node = &scene.nodes[open.node as usize];
            let cost = if lane < usize::from(node.links) {
                self.link(scene, setup, node, lane)
            } else {
                let line = node.first_line as usize + lane - usize::from(node.links);
                self.line(scene, setup, line)
            };
            self.work += cost;
            meter.charge(cost.unsigned_abs());
        }
        Progress::More
    }

    /// Paints a line of the node on top of the stack.
    fn line(&mut self, scene: &Scene, setup: &Setup, line: usize) -> i64 {
        let Some(open) = self.stack.last_mut() else { return 0 };
        let line = &scene.lines[line];
        let shade = scene.choice.then(open.shade, scene.shade(line.style));
        let ink = scene.ink(shade, open.path, f64::from(line.before));
        if let Some(corner) = line.corner {
            let corners = [line.from, line.to, corner].map(|corner| open.place.point(corner.map(f64::from)));
            return self.painter.face(setup, corners, ink);
        }
        let widths = open.widths.after(&scene.styles[line.style as usize]);
        let ends = [line.from, line.to].map(|end| open.place.point(end.map(f64::from)));
        self.painter.stick(setup, ends, widths, 1.0, ink)
    }

    /// Paints a node inside the node on top of the stack, or puts it on the stack.
    fn link(&mut self, scene: &Scene, setup: &Setup, node: &SceneNode, lane: usize) -> i64 {
        let over_work = self.exceeds_work(setup, 1);
        let Some(open) = self.stack.last_mut() else { return 0 };
        let link = &scene.links[node.first_link as usize + lane];
        let [x, y, ball, near] = [0, 1, 2, 3].map(|i| open.balls[i][lane]);
        let factor = open.place.scale_at(&setup.lens, near);
        let stroke = ((open.widths.widest(link.widest) * setup.lens.step * factor / 2.0).max(setup.hairline)) as f32;
        let disc = Disc { at: [f64::from(x), f64::from(y)], radius: ball, near, stroke, factor };
        let inner = &scene.nodes[link.node as usize];
        let mut share = open.shares[lane].min(inner.summary.need + 1.0);
        if setup.single {
            // With a single tile, the rest that nearer contents did not need is passed on.
            let more = open.spare / f32::from(open.left + 1);
            open.spare -= more;
            share += more;
        }
        let (Some(across), Some(down)) = disc.spans(&self.painter.tile, setup.slack) else {
            open.spare += share;
            return 1;
        };
        let shade = scene.choice.then(open.shade, scene.shade(link.style));
        let path = open.path.part(link.before, link.part);
        let fine = 2.0 * ball > setup.detail;
        let is_short = |share: f32| fine && share < f32::from(inner.links + inner.lines) && share < inner.summary.need;
        self.lacks_budget |= is_short(share);
        if over_work {
            share = 0.0;
        }
        let lacks_budget = is_short(share);
        let is_dot = !fine || lacks_budget && ball <= 0.5 * LARGEST_DOT * setup.detail;
        if let Some(additive) = &mut self.painter.additive
            && (is_dot || over_work)
        {
            open.spare += (share - 1.0).clamp(0.0, UNLIMITED);
            self.painter.stats.stamps += 1;
            let clear = 1.0 - setup.light.spot(open.place.point(node.centre(lane))).haze;
            let place = open.place.inside(link);
            let amount = stand_in::amount(scene, (open, link), place.scale, disc).times(clear.into());
            let MainLine { from, to, .. } = inner.summary.main_line;
            let [x, y, _] = combine(&place.axes, minus(to, from));
            return additive.dot(
                disc.at,
                (2.0 * f64::from(stroke), [x, y]),
                amount,
                scene.mean(link.node, shade, path),
            );
        }
        if is_dot {
            open.spare += (share - 1.0).clamp(0.0, UNLIMITED);
            self.painter.stats.stamps += 1;
            let dot = stand_in::dot(scene, setup, self.painter.corner, (open, node, lane), disc, (shade, path));
            return self.painter.dot(setup, dot);
        }
        if self.painter.additive.is_none()
            && ball + stroke > LEAST_HIDDEN
            && self.painter.tile.hides(across, down, near - stroke)
        {
            open.spare += share;
            return LINE_WORK;
        }
        let place = open.place.inside(link);
        let widths = open.widths.after(&scene.styles[link.style as usize]);
        let entry = |share: f32| Entry { place, shade, path, widths, share };
        let thin = 2.0 * (inner.summary.main_line.reach * place.scale * factor) as f32 <= setup.detail;
        if thin && (!scene.along || path.is_short()) {
            // No content is visibly off the main line, so the main line stands for the node.
            open.spare += (share - 1.0).clamp(0.0, UNLIMITED);
            return stand_in::main_line(&mut self.painter, scene, setup, link.node, entry(share));
        }
        if lacks_budget {
            return stand_in::samples(&mut self.painter, scene, setup, link.node, &entry(share));
        }
        self.open(scene, setup, link.node, entry(share - 1.0));
        NODE_WORK
    }

    /// Puts a node on the stack, with its contents that may be visible in the tile.
    fn open(&mut self, scene: &Scene, setup: &Setup, id: u32, entry: Entry) {
        self.painter.stats.blocks += 1;
        let share = entry.share;
        let open = OpenNode::new(scene, setup, (self.painter.corner, self.painter.tile.size), id, entry);
        if open.left > 0 {
            self.stack.push(open);
        } else if let Some(outer) = self.stack.last_mut() {
            outer.spare += share.min(UNLIMITED);
        }
    }
}

/// Whether a drawing is so small that all of it is looked into.
fn is_always_drawn(scene: &Scene) -> bool {
    scene.root.is_none_or(|root| scene.nodes[root as usize].summary.need <= ALWAYS_DRAWN)
}
