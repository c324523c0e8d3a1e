//! The descent through a scene, tile by tile and from front to back, on an explicit stack so that it can stop anywhere.

use super::Quality;
use super::camera::Camera;
use super::effort::Spent;
use super::frame::{Frame, Inside};
use super::painter::{LINE_WORK, TilePainter};
use super::pixels::Pixels;
use super::place::Place;
use super::scene::{Node, Scene};
use super::setup::Setup;
use super::shares::MOST;
use super::stand_in::{self, Disc};
use crate::plane::{Pane, Shade};
use crate::{RenderStats, Viewport};
use lsystem_drawing::{Drawing, Solid};
use lsystem_syntax::{Meter, Progress, Style};

/// Whole blocks are looked for behind others from this size on, in samples.
const HIDEABLE: f32 = 3.0;
/// Blocks that there is no time to look into are dots all the same up to this many times the radius of others.
const BLUR: f32 = 2.0;
/// So many strokes and nodes are drawn in time in any case, and each of them tells in so small a drawing.
const FEW: f32 = 16_000.0;
/// After so many shapes that were seen all over a tile what is behind them is hardly looked into, and after twice as many
/// not at all.
const COATS: f64 = 16.0;
/// What a node costs, in units of work.
const NODE_WORK: i64 = 8;
/// Samples of a tile that are emptied, or made pixels of, in a unit of work.
const TILE_WORK: u64 = 64;

/// A picture in the making.
#[derive(Default)]
pub(super) struct Picture {
    setup: Option<Setup>,
    stack: Vec<Frame>,
    painter: TilePainter,
    pixels: Pixels,
    /// The tiles from this one on are still to be painted.
    next: usize,
    painting: bool,
    /// What all tiles so far have taken.
    work: i64,
    /// The work of the tiles before this one.
    before: i64,
    /// Whether something had to go without.
    poor: bool,
}

impl Picture {
    /// Whether the picture before had the same size.
    pub(super) fn fits(&self, viewport: Viewport) -> bool {
        self.pixels.fits(viewport)
    }

    /// Starts a picture, or only a pane of it with this budget; the units of work that this took.
    pub(super) fn begin(
        &mut self,
        drawing: &Drawing<Solid>,
        style: &Style,
        viewport: Viewport,
        camera: &Camera,
        quality: Quality,
        only: Option<(Pane, f32)>,
    ) -> u64 {
        let pane = only.map_or(Pane::whole(viewport), |(pane, _)| pane.within(viewport));
        let budget = only.map(|(_, budget)| budget);
        self.setup = Some(Setup::new(drawing, style, viewport, camera, quality, (pane, budget)));
        let size = self.pixels.begin(pane, style.background.rgb);
        self.stack.clear();
        self.painter.stop();
        self.painter.stats = RenderStats::default();
        self.next = 0;
        self.painting = false;
        (self.work, self.poor) = (0, false);
        1 + size as u64 / 1024
    }

    /// What the picture, or the pane, has taken since it was started, with the budget it has now.
    pub(super) fn spent(&self) -> Spent {
        Spent { work: self.work as f64, poor: self.poor }
    }

    /// The picture so far.
    pub(super) fn pixels(&self) -> &[u8] {
        &self.pixels.bytes
    }

    pub(super) fn stats(&self) -> RenderStats {
        self.painter.stats
    }

    /// Gives up the picture that is being made.
    pub(super) fn stop(&mut self) {
        self.setup = None;
        self.stack.clear();
        self.painter.stop();
    }

    /// Starts again where the budget was too small. Whether it does.
    fn starts_again(&mut self) -> bool {
        let spent = self.spent();
        let Some(setup) = self.setup.as_mut().filter(|setup| !setup.pane) else { return false };
        if !setup.effort.is_too_small(spent) {
            return false;
        }
        (self.work, self.poor) = (0, false);
        self.next = 0;
        self.pixels.begin_again();
        true
    }

    pub(super) fn step(&mut self, scene: &Scene, meter: &mut Meter) -> Progress {
        let Some(setup) = self.setup else { return Progress::Done };
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
            // What lies beside the picture is not painted.
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
            self.pixels.put(&self.painter.tile, at, side, setup.samples);
            meter.charge((size[0] * size[1]) as u64 / TILE_WORK);
            self.next += 1;
        }
        Progress::More
    }

    /// Puts the whole drawing on the stack.
    fn enter(&mut self, scene: &Scene, setup: &Setup) {
        let Some(root) = scene.root else { return };
        let shade = Shade { number: 0, fixed: true };
        let share = if few(scene) { MOST } else { setup.effort.budget };
        let place = Place::root(&setup.lens);
        self.open(scene, setup, root, Inside { place, shade, path: scene.shown, width: setup.width, share });
    }

    /// What is left of the picture is made with a part of the effort.
    pub(super) fn hurry(&mut self, scene: &Scene, part: f32) {
        if few(scene) {
            return;
        }
        if let Some(setup) = &mut self.setup {
            setup.effort = setup.effort.with_budget(setup.effort.budget * part);
        }
        for frame in &mut self.stack {
            frame.hurry(scene, part);
        }
    }

    /// Whether this tile alone has taken so many times what it may. What others have taken does not count: made by itself,
    /// as a pane, it is to be the same.
    fn is_tired(&self, setup: &Setup, times: u8) -> bool {
        let most = 2 * setup.effort.work * i64::from(times);
        most > 0 && self.work - self.before > most || self.painter.coats > COATS * f64::from(times)
    }

    /// Goes on with a tile.
    fn paint(&mut self, scene: &Scene, setup: &Setup, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            if self.is_tired(setup, 2) {
                // What is left is behind most of what is there.
                self.painter.stop();
                self.stack.clear();
                return Progress::Done;
            }
            if let Some(cost) = self.painter.go_on(setup) {
                self.work += cost;
                meter.charge(cost.unsigned_abs());
                continue;
            }
            let Some(frame) = self.stack.last_mut() else { return Progress::Done };
            if frame.left == 0 {
                let spare = frame.spare;
                self.stack.pop();
                if let Some(frame) = self.stack.last_mut() {
                    frame.spare += spare;
                }
                continue;
            }
            frame.left -= 1;
            let lane = usize::from(frame.order[usize::from(frame.left)]);
            let node = &scene.nodes[frame.node as usize];
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
        let Some(frame) = self.stack.last_mut() else { return 0 };
        let line = &scene.lines[line];
        let shade = scene.choice.then(frame.shade, scene.shade(line.style));
        let ink = scene.ink(shade, frame.path, f64::from(line.before));
        if let Some(corner) = line.corner {
            let corners = [line.from, line.to, corner].map(|corner| frame.place.lie(corner.map(f64::from)));
            return self.painter.face(setup, corners, ink);
        }
        let width = scene.styles[line.style as usize].width.of(frame.width);
        let ends = [line.from, line.to].map(|end| frame.place.lie(end.map(f64::from)));
        self.painter.stick(setup, ends, width, 1.0, ink)
    }

    /// Paints a node inside the one on top of the stack, or puts it there itself.
    fn link(&mut self, scene: &Scene, setup: &Setup, node: &Node, lane: usize) -> i64 {
        let tired = self.is_tired(setup, 1);
        let Some(frame) = self.stack.last_mut() else { return 0 };
        let link = &scene.links[node.first_link as usize + lane];
        let [x, y, ball, near] = [0, 1, 2, 3].map(|i| frame.seen[i][lane]);
        let factor = frame.place.scale_at(&setup.lens, near);
        let stroke = ((link.widest.of(frame.width) * setup.lens.step * factor / 2.0).max(setup.hairline)) as f32;
        let disc = Disc { at: [f64::from(x), f64::from(y)], radius: ball, near, stroke, factor };
        let mut share = frame.shares[lane];
        if setup.single {
            // What nearer contents did not need.
            let more = frame.spare / f32::from(frame.left + 1);
            frame.spare -= more;
            share += more;
        }
        let (Some(across), Some(down)) = disc.spans(&self.painter.tile) else {
            frame.spare += share.min(MOST);
            return 1;
        };
        let shade = scene.choice.then(frame.shade, scene.shade(link.style));
        let path = frame.path.part(link.before, link.part);
        let inner = &scene.nodes[link.node as usize];
        let fine = 2.0 * ball > setup.detail;
        let is_short = |share: f32| fine && share < f32::from(inner.links + inner.lines) && share < inner.own.need;
        self.poor |= is_short(share);
        if tired {
            share = 0.0;
        }
        let poor = is_short(share);
        if !fine || poor && ball <= 0.5 * BLUR * setup.detail {
            frame.spare += (share - 1.0).clamp(0.0, MOST);
            self.painter.stats.stamps += 1;
            let dot = stand_in::dot(scene, setup, self.painter.corner, (frame, node, lane), disc, (shade, path));
            return self.painter.dot(setup, dot);
        }
        if ball + stroke > HIDEABLE && self.painter.tile.hides(across, down, near - stroke) {
            frame.spare += share.min(MOST);
            return LINE_WORK;
        }
        let place = frame.place.inside(link);
        let width = scene.styles[link.style as usize].width.of(frame.width);
        let inside = |share: f32| Inside { place, shade, path, width, share };
        let thin = 2.0 * (inner.own.limb.off * place.scale * factor) as f32 <= setup.detail;
        if thin && (!scene.along || path.is_short()) {
            // Nothing stands out: the whole node is that line.
            frame.spare += (share - 1.0).clamp(0.0, MOST);
            return stand_in::limb(&mut self.painter, scene, setup, link.node, inside(share));
        }
        if poor {
            return stand_in::samples(&mut self.painter, scene, setup, link.node, &inside(share));
        }
        self.open(scene, setup, link.node, inside(share - 1.0));
        NODE_WORK
    }

    /// Puts a node on the stack: all its contents that may be seen in the tile, the nearest on top.
    fn open(&mut self, scene: &Scene, setup: &Setup, id: u32, inside: Inside) {
        self.painter.stats.blocks += 1;
        let share = inside.share;
        let frame = Frame::new(scene, setup, (self.painter.corner, self.painter.tile.size), id, inside);
        if frame.left > 0 {
            self.stack.push(frame);
        } else if let Some(outer) = self.stack.last_mut() {
            outer.spare += share.min(MOST);
        }
    }
}

/// Whether a drawing is so small that all of it is always looked into.
fn few(scene: &Scene) -> bool {
    scene.root.is_none_or(|root| scene.nodes[root as usize].own.need <= FEW)
}
