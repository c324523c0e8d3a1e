//! The descent through a scene, tile by tile and from front to back, on an explicit stack so that it can stop anywhere.

use super::Quality;
use super::camera::{Camera, Lens, NEAR};
use super::effort::{Effort, Spent};
use super::face::Face;
use super::light::{DIRECTIONS, LIGHT, Light};
use super::path::Stretch;
use super::scene::{Node, SAMPLES, Scene, WIDTH, direction};
use super::stroke::{Dot, Painted, Stick, span};
use super::tile::Tile;
use crate::plane::{Pane, Shade};
use crate::{RenderStats, Viewport};
use lsystem_drawing::rotation::{Vector, combine, cross, dot, minus, norm};
use lsystem_drawing::{Drawing, Solid};
use lsystem_syntax::{Meter, Progress, Style};
use std::collections::VecDeque;

/// Whole blocks are looked for behind others from this size on, in samples.
const HIDEABLE: f32 = 3.0;
/// Contents are sorted by depth where a node is at least so large, in samples.
const SORTED: f32 = 4.0;
/// Blocks that there is no time to look into are dots all the same up to this many times the radius of others.
const BLUR: f32 = 2.0;
/// From this radius on blocks have the same share of the budget, in samples.
const LARGE: f32 = 256.0;
/// Strokes that stand for others are made thicker up to this radius at most, in pixels.
const THICKER: f64 = 1.25;
/// A limb stands out among the samples of its node from so many times their length on.
const OUTSTANDING: f64 = 2.0;
/// How often what somebody does not need of a budget is shared out to the others.
const ROUNDS: usize = 2;
/// So many strokes and nodes are drawn in time in any case, and each of them tells in so small a drawing.
const FEW: f32 = 16_000.0;
/// After so many shapes that were seen all over a tile what is behind them is hardly looked into, and after twice as many
/// not at all.
const COATS: f64 = 16.0;
/// Enough for everything.
const MOST: f32 = 1e30;
/// What a node, a line, and a dot cost, in units of work, apart from the samples.
const NODE_WORK: i64 = 8;
const LINE_WORK: i64 = 4;
/// Samples in a unit of work.
const SAMPLES_WORK: i64 = 8;
/// Samples of a tile that are emptied, or made pixels of, in a unit of work.
const TILE_WORK: u64 = 64;

/// A node that is being looked into.
struct Frame {
    node: u32,
    /// How many of `order` are still to be visited, the nearest last.
    left: u8,
    order: [u8; WIDTH],
    /// By content: where its ball is in the picture, how large, and how deep its nearest point.
    seen: [[f32; WIDTH]; 4],
    place: Place,
    shade: Shade,
    path: Stretch,
    /// In step lengths.
    width: f64,
    /// By content: how many strokes and nodes may be looked into for it.
    shares: [f32; WIDTH],
    /// What was not needed of the shares so far.
    spare: f32,
    /// Towards the light and the viewer, in the node's own frame.
    towards: [[f32; 3]; 2],
}

/// What is painted on a tile.
#[derive(Clone, Copy)]
enum Shape {
    Stick(Stick),
    Face(Face),
    Dot(Dot),
}

/// Where a node is, as the lens sees it before perspective.
#[derive(Clone, Copy)]
struct Place {
    origin: Vector,
    axes: [Vector; 3],
    /// The length of the axes.
    scale: f64,
}

impl Place {
    fn lie(&self, point: Vector) -> Vector {
        let [x, y, z] = combine(&self.axes, point);
        [self.origin[0] + x, self.origin[1] + y, self.origin[2] + z]
    }
}

/// How a node is entered.
#[derive(Clone, Copy)]
struct Inside {
    place: Place,
    shade: Shade,
    path: Stretch,
    width: f64,
    share: f32,
}

/// A picture in the making.
#[derive(Default)]
pub(super) struct Walk {
    tile: Tile,
    look: Option<Look>,
    stack: Vec<Frame>,
    /// What is painted before anything else, and from which row on: wide strokes are painted band by band.
    shapes: VecDeque<(Shape, usize)>,
    /// The tiles from this one on are still to be painted.
    next: usize,
    painting: bool,
    width: usize,
    height: usize,
    pub(super) pixels: Vec<u8>,
    /// The colour of what nothing is painted on.
    paper: [u8; 4],
    /// By row of pixels: from where to where something may have been painted.
    painted: Vec<[usize; 2]>,
    /// The rows before this one hold nothing of the picture before.
    wiped: usize,
    /// What all tiles so far have taken.
    work: i64,
    /// The work of the tiles before this one.
    before: i64,
    /// How often this tile has been painted over, and how much of it the shape in hand has so far.
    coats: f64,
    coat: f64,
    /// Whether something had to go without.
    poor: bool,
    pub(super) stats: RenderStats,
}

/// What does not change while a picture is made.
#[derive(Clone, Copy)]
struct Look {
    lens: Lens,
    light: Light,
    background: [u8; 3],
    samples: usize,
    /// Across and down the picture, in samples.
    size: [f64; 2],
    /// Of a tile, in samples.
    side: [usize; 2],
    /// Whether there is only one tile.
    single: bool,
    /// Blocks smaller than this are dots, in samples.
    detail: f32,
    effort: Effort,
    /// Whether it is only a pane of the picture, whose effort others know.
    pane: bool,
    /// Where it begins in the picture, in samples.
    corner: [f64; 2],
    /// Half the smallest stroke width, in samples.
    hairline: f64,
    /// The stroke width at the start, in step lengths.
    width: f64,
}

impl Walk {
    /// Whether the picture before had the same size.
    pub(super) fn fits(&self, viewport: Viewport) -> bool {
        (self.width, self.height) == (viewport.width as usize, viewport.height as usize)
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
        let samples = quality.samples();
        let lens = Lens::new(drawing, viewport, camera, samples as f64);
        let size = [viewport.width, viewport.height].map(|pixels| f64::from(pixels) * samples as f64);
        let side = quality.tile(viewport);
        let effort = Effort::new(quality, viewport);
        let pane = only.map_or(Pane::whole(viewport), |(pane, _)| pane.within(viewport));
        self.look = Some(Look {
            lens,
            light: Light::new(style, &lens, camera.fade),
            background: style.background.rgb,
            samples,
            size,
            side,
            single: (0..2).all(|i| side[i] as f64 >= size[i]),
            detail: quality.detail() as f32,
            effort: only.map_or(effort, |(_, budget)| effort.with_budget(budget)),
            pane: only.is_some(),
            corner: [pane.x, pane.y].map(|pixels| f64::from(pixels) * samples as f64),
            hairline: viewport.least_width(style) * samples as f64 / 2.0,
            width: drawing.width,
        });
        (self.width, self.height) = (pane.width as usize, pane.height as usize);
        let size = self.width * self.height * 4;
        let [r, g, b] = style.background.rgb;
        let paper = [r, g, b, u8::MAX];
        if self.pixels.len() != size || self.paper != paper || self.painted.len() != self.height {
            self.paper = paper;
            self.pixels.clear();
            self.pixels.reserve_exact(size);
            self.pixels.extend(paper.iter().cycle().take(size));
            self.painted.clear();
            self.painted.resize(self.height, [0, 0]);
            self.wiped = self.height;
        } else {
            self.wiped = 0;
        }
        self.stack.clear();
        self.shapes.clear();
        self.next = 0;
        self.painting = false;
        (self.work, self.poor) = (0, false);
        self.stats = RenderStats::default();
        1 + size as u64 / 1024
    }

    /// What the picture, or the pane, has taken since it was started, with the budget it has now.
    pub(super) fn spent(&self) -> Spent {
        Spent { work: self.work as f64, poor: self.poor }
    }

    /// Gives up the picture that is being made.
    pub(super) fn stop(&mut self) {
        self.look = None;
        self.stack.clear();
        self.shapes.clear();
    }

    /// Starts again where the budget was too small. Whether it does.
    fn starts_again(&mut self) -> bool {
        let spent = self.spent();
        let Some(look) = self.look.as_mut().filter(|look| !look.pane) else { return false };
        if !look.effort.is_too_small(spent) {
            return false;
        }
        (self.work, self.poor) = (0, false);
        (self.next, self.wiped) = (0, 0);
        true
    }

    pub(super) fn step(&mut self, scene: &Scene, meter: &mut Meter) -> Progress {
        let Some(look) = self.look else { return Progress::Done };
        // Pixels along the sides of a tile.
        let side = look.side.map(|side| side / look.samples);
        let across = self.width.div_ceil(side[0]);
        let count = across * self.height.div_ceil(side[1]);
        while self.wiped < self.height {
            if meter.is_spent() {
                return Progress::More;
            }
            let [from, to] = core::mem::take(&mut self.painted[self.wiped]);
            let row = self.wiped * self.width;
            let (pixels, _) = self.pixels[(row + from) * 4..(row + to) * 4].as_chunks_mut::<4>();
            pixels.fill(self.paper);
            self.wiped += 1;
            meter.charge(1 + (to - from) as u64 / 64);
        }
        while !meter.is_spent() {
            if self.next >= count {
                return if self.starts_again() { Progress::More } else { Progress::Done };
            }
            let at = [self.next % across, self.next / across];
            let corner = [0, 1].map(|i| look.corner[i] + (at[i] * look.side[i]) as f64);
            // What lies beside the picture is not painted.
            let rest = [self.width, self.height].map(|pixels| pixels * look.samples);
            let size = [0, 1].map(|i| look.side[i].min(rest[i] - at[i] * look.side[i]));
            if !self.painting {
                self.painting = true;
                (self.before, self.coats, self.coat) = (self.work, 0.0, 0.0);
                self.tile.leans = look.samples == 4;
                self.tile.reset(size, look.side, look.background);
                meter.charge((size[0] * size[1]) as u64 / TILE_WORK);
                if let Some(root) = scene.root {
                    let Lens { origin, axes, .. } = look.lens;
                    let place = Place { origin, axes, scale: dot(axes[0], axes[0]).sqrt() };
                    let shade = Shade { number: 0, fixed: true };
                    let share = if few(scene) { MOST } else { look.effort.budget };
                    let inside = Inside { place, shade, path: scene.shown, width: look.width, share };
                    self.open(scene, &look, corner, root, inside);
                }
            }
            if self.paint(scene, &look, corner, meter) == Progress::More {
                return Progress::More;
            }
            self.painting = false;
            self.finish(at, side, look.samples);
            meter.charge((size[0] * size[1]) as u64 / TILE_WORK);
            self.next += 1;
        }
        Progress::More
    }

    /// What is left of the picture is made with a part of the effort.
    pub(super) fn hurry(&mut self, scene: &Scene, part: f32) {
        if few(scene) {
            return;
        }
        if let Some(look) = &mut self.look {
            look.effort = look.effort.with_budget(look.effort.budget * part);
        }
        for frame in &mut self.stack {
            frame.spare = 0.0;
            let node = &scene.nodes[frame.node as usize];
            let links = &scene.links[node.first_link as usize..][..usize::from(node.links)];
            for (share, link) in frame.shares.iter_mut().zip(links) {
                *share = share.min(scene.nodes[link.node as usize].own.need) * part;
            }
        }
    }

    /// Copies a finished tile into the picture.
    fn finish(&mut self, at: [usize; 2], side: [usize; 2], samples: usize) {
        let [x, y] = [0, 1].map(|i| at[i] * side[i]);
        let right = (x + side[0]).min(self.width);
        for row in y..(y + side[1]).min(self.height) {
            let [from, to] = self.tile.painted(row - y, samples);
            let to = to.min(right - x);
            if from < to {
                let first = row * self.width + x;
                self.tile.pixels(row - y, from, samples, &mut self.pixels[(first + from) * 4..(first + to) * 4]);
                let painted = &mut self.painted[row];
                *painted = match *painted {
                    [a, b] if a == b => [x + from, x + to],
                    [a, b] => [a.min(x + from), b.max(x + to)],
                };
            }
        }
    }

    /// Whether this tile alone has taken so many times what it may. What others have taken does not count: made by itself,
    /// as a pane, it is to be the same.
    fn is_tired(&self, look: &Look, times: u8) -> bool {
        let most = 2 * look.effort.work * i64::from(times);
        most > 0 && self.work - self.before > most || self.coats > COATS * f64::from(times)
    }

    /// Goes on with a tile.
    fn paint(&mut self, scene: &Scene, look: &Look, corner: [f64; 2], meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            if self.is_tired(look, 2) {
                // What is left is behind most of what is there.
                self.shapes.clear();
                self.stack.clear();
                return Progress::Done;
            }
            if let Some((shape, from)) = self.shapes.pop_front() {
                let Painted { looked, rest } = self.band(look, corner, &shape, from);
                if let Some(from) = rest {
                    self.shapes.push_front((shape, from));
                }
                let cost = looked as i64 / SAMPLES_WORK;
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
                self.link(scene, look, corner, node, lane)
            } else {
                let line = node.first_line as usize + lane - usize::from(node.links);
                self.line(scene, look, corner, line)
            };
            self.work += cost;
            meter.charge(cost.unsigned_abs());
        }
        Progress::More
    }

    /// Paints a line of the node on top of the stack.
    fn line(&mut self, scene: &Scene, look: &Look, tile: [f64; 2], line: usize) -> i64 {
        let Some(frame) = self.stack.last_mut() else { return 0 };
        let line = &scene.lines[line];
        let shade = scene.choice.then(frame.shade, scene.shade(line.style));
        let ink = scene.ink(shade, frame.path, f64::from(line.before));
        if let Some(corner) = line.corner {
            let corners = [line.from, line.to, corner].map(|corner| frame.place.lie(corner.map(f64::from)));
            return self.face(look, tile, corners, ink);
        }
        let width = scene.styles[line.style as usize].width.of(frame.width);
        let ends = [line.from, line.to].map(|end| frame.place.lie(end.map(f64::from)));
        self.stick(look, tile, ends, width, 1.0, ink)
    }

    /// Paints a triangle, which is seen from both sides; one that reaches behind the eye is left out.
    fn face(&mut self, look: &Look, tile: [f64; 2], corners: [Vector; 3], ink: [f32; 3]) -> i64 {
        let lens = &look.lens;
        if corners.iter().any(|corner| 1.0 + corner[2] * lens.nearness <= NEAR) {
            return 1;
        }
        self.stats.strokes += 1;
        let [a, b, c] = corners;
        let normal = cross(minus(b, a), minus(c, a));
        let size = norm(normal);
        if size <= 0.0 {
            return 1;
        }
        // Towards the viewer.
        let sign = if normal[2] > 0.0 { -1.0 } else { 1.0 };
        let normal = normal.map(|n| sign * n / size);
        let spot = look.light.spot([0, 1, 2].map(|i| (a[i] + b[i] + c[i]) / 3.0));
        let colour = look.light.surface(ink, &spot, dot(normal, LIGHT) as f32, -normal[2] as f32);
        let face = Face { corners: corners.map(|corner| lens.project(corner)), colour };
        self.shape(look, tile, Shape::Face(face))
    }

    /// Paints the first band of something, unless something else is to be painted before; the rest follows.
    fn shape(&mut self, look: &Look, corner: [f64; 2], shape: Shape) -> i64 {
        if !self.shapes.is_empty() {
            self.shapes.push_back((shape, 0));
            return LINE_WORK;
        }
        let Painted { looked, rest } = self.band(look, corner, &shape, 0);
        self.shapes.extend(rest.map(|from| (shape, from)));
        LINE_WORK + looked as i64 / SAMPLES_WORK
    }

    /// Paints a band of something, from a row on.
    fn band(&mut self, look: &Look, corner: [f64; 2], shape: &Shape, from: usize) -> Painted {
        let painted = match shape {
            Shape::Stick(stick) => stick.paint(&mut self.tile, corner, &look.light, from),
            Shape::Face(face) => face.paint(&mut self.tile, corner, from),
            Shape::Dot(dot) => dot.paint(&mut self.tile, corner, from),
        };
        let [width, height] = self.tile.size;
        self.coat += painted.looked as f64 / (width * height) as f64;
        if painted.rest.is_none() {
            // So that what is small does not count, however much there is of it.
            self.coats += self.coat * self.coat;
            self.coat = 0.0;
        }
        painted
    }

    /// Paints a stroke.
    fn stick(
        &mut self,
        look: &Look,
        corner: [f64; 2],
        ends: [Vector; 2],
        width: f64,
        thicker: f32,
        ink: [f32; 3],
    ) -> i64 {
        self.stats.strokes += 1;
        let Some(ends) = before_eye(&look.lens, ends) else { return 1 };
        let radius = |end: Vector| {
            let own = (width * look.lens.step * look.lens.factor(end[2]) / 2.0).max(look.hairline);
            (own * f64::from(thicker)).min(THICKER * look.samples as f64).max(own)
        };
        let stick = Stick {
            ends: ends.map(|end| look.lens.project(end)),
            radii: ends.map(radius),
            ink,
            spots: ends.map(|end| look.light.spot(end)),
        };
        self.shape(look, corner, Shape::Stick(stick))
    }

    /// Paints a node inside the one on top of the stack, or puts it there itself.
    fn link(&mut self, scene: &Scene, look: &Look, corner: [f64; 2], node: &Node, lane: usize) -> i64 {
        let tired = self.is_tired(look, 1);
        let Some(frame) = self.stack.last_mut() else { return 0 };
        let link = &scene.links[node.first_link as usize + lane];
        let [x, y, ball, near] = [0, 1, 2, 3].map(|i| frame.seen[i][lane]);
        let lens = &look.lens;
        let factor = frame.place.scale_at(lens, near);
        let radius = ((link.widest.of(frame.width) * lens.step * factor / 2.0).max(look.hairline)) as f32;
        let reach = f64::from(ball + radius);
        let aside = reach + self.tile.slack();
        let [px, py] = [f64::from(x), f64::from(y)];
        let mut share = frame.shares[lane];
        if look.single {
            // What nearer contents did not need.
            let more = frame.spare / f32::from(frame.left + 1);
            frame.spare -= more;
            share += more;
        }
        let [width, height] = self.tile.size.map(|side| side as f64);
        let (Some(across), Some(down)) = (span(px - aside, px + aside, width), span(py - reach, py + reach, height))
        else {
            frame.spare += share.min(MOST);
            return 1;
        };
        let shade = scene.choice.then(frame.shade, scene.shade(link.style));
        let path = frame.path.part(link.before, link.part);
        let inner = &scene.nodes[link.node as usize];
        let fine = 2.0 * ball > look.detail;
        let is_short = |share: f32| fine && share < f32::from(inner.links + inner.lines) && share < inner.own.need;
        self.poor |= is_short(share);
        if tired {
            share = 0.0;
        }
        let poor = is_short(share);
        if !fine || poor && ball <= 0.5 * BLUR * look.detail {
            frame.spare += (share - 1.0).clamp(0.0, MOST);
            self.stats.stamps += 1;
            let [bx, by, bz] = [0, 1, 2].map(|i| f64::from(node.balls[i][lane]));
            let spot = look.light.spot(frame.place.lie([bx, by, bz]));
            let ink = scene.mean(link.node, shade, path);
            let [light, view] = frame.towards;
            let colour = look.light.bundle(ink, &spot, &link.bundle, view, light);
            // As large as all strokes side by side, but not larger than they reach.
            let length = link.length * (frame.place.scale * factor) as f32;
            let full = 0.8 * ball + radius;
            let scale = (frame.place.scale * factor) as f32;
            let faces = link.area * scale * scale * core::f32::consts::FRAC_1_PI;
            let size = (length * radius * core::f32::consts::FRAC_2_PI + faces + radius * radius).min(full * full);
            let dot = Dot {
                at: [px + corner[0], py + corner[1], f64::from(near + 0.5 * ball - 0.5 * radius)],
                radius: f64::from(size.sqrt().max(0.71)),
                colour,
            };
            return self.shape(look, corner, Shape::Dot(dot));
        }
        let size = ball + radius;
        if size > HIDEABLE && self.tile.hides(across, down, near - radius) {
            frame.spare += share.min(MOST);
            return LINE_WORK;
        }
        let place = if link.same {
            frame.place
        } else {
            let axes = link.axes.map(|axis| combine(&frame.place.axes, axis));
            Place { origin: frame.place.lie(link.at), axes, scale: dot(axes[0], axes[0]).sqrt() }
        };
        let width = scene.styles[link.style as usize].width.of(frame.width);
        let limb = &inner.own.limb;
        let thin = 2.0 * (limb.off * place.scale * factor) as f32 <= look.detail;
        if thin && (!scene.along || path.is_short()) {
            // Nothing stands out: the whole node is that line, in the colour that it has on the whole.
            frame.spare += (share - 1.0).clamp(0.0, MOST);
            let ends = [limb.from, limb.to].map(|end| place.lie(end));
            return self.stick(look, corner, ends, limb.style.width.of(width), 1.0, scene.mean(link.node, shade, path));
        }
        if poor {
            let own = &inner.own;
            let outstanding = norm(minus(limb.to, limb.from)) > OUTSTANDING * f64::from(own.sampled);
            let count = (share as usize).max(1);
            let all = scene.samples(link.node);
            let count = count.min(all.len());
            let order = facing(&place, all.len());
            let samples =
                order.into_iter().take(count - usize::from(outstanding)).filter_map(|k| all.get(usize::from(k)));
            // As much as there is, on the whole, but not much wider than a pixel where they are not.
            let thicker = own.length / (count as f32 * own.sampled);
            let mut cost = 0;
            if outstanding {
                let ends = [limb.from, limb.to].map(|end| place.lie(end));
                let ink = scene.ink(scene.choice.then(shade, scene.choice.shade(&limb.style)), path, limb.before);
                cost += self.stick(look, corner, ends, limb.style.width.of(width), 1.0, ink);
            }
            for sample in samples {
                let ends = [sample.from, sample.to].map(|end| place.lie(end.map(f64::from)));
                let shade = scene.choice.then(shade, scene.choice.shade(&sample.style));
                let ink = scene.ink(shade, path, f64::from(sample.before));
                cost += self.stick(look, corner, ends, sample.style.width.of(width), thicker, ink);
            }
            return cost;
        }
        self.open(scene, look, corner, link.node, Inside { place, shade, path, width, share: share - 1.0 });
        NODE_WORK
    }

    /// Puts a node on the stack: all its contents that may be seen in the tile, the nearest on top.
    fn open(&mut self, scene: &Scene, look: &Look, corner: [f64; 2], id: u32, inside: Inside) {
        let Inside { place, shade, path, width, share } = inside;
        let node = &scene.nodes[id as usize];
        let lens = &look.lens;
        self.stats.blocks += 1;
        let mut seen = [[0.0_f32; WIDTH]; 4];
        let [ax, ay, az] = place.axes.map(|axis| axis.map(|c| c as f32));
        let origin = place.origin.map(|c| c as f32);
        let scale = place.scale as f32;
        let nearness = lens.nearness as f32;
        let middle = [0, 1].map(|i| (lens.middle[i] - corner[i]) as f32);
        // Rounding, where a node is much larger than the picture.
        let slack = 1e-6 * (origin[0].abs() + origin[1].abs() + origin[2].abs() + scale);
        let [bx, by, bz, br] = &node.balls;
        let least = NEAR as f32;
        for i in 0..WIDTH {
            let x = origin[0] + ax[0] * bx[i] + ay[0] * by[i] + az[0] * bz[i];
            let y = origin[1] + ax[1] * bx[i] + ay[1] * by[i] + az[1] * bz[i];
            let z = origin[2] + ax[2] * bx[i] + ay[2] * by[i] + az[2] * bz[i];
            let r = br[i] * scale + slack;
            let factor = 1.0 / (1.0 + z * nearness).max(least);
            let nearest = 1.0 / (1.0 + (z - r) * nearness).max(least);
            // Seen from near by, a ball reaches farther to the side than its middle does.
            let grows = nearest - factor;
            seen[0][i] = middle[0] + x * factor;
            seen[1][i] = middle[1] + y * factor;
            seen[2][i] = r * nearest + grows * x.abs().max(y.abs());
            seen[3][i] = (z - r) * nearest;
        }
        let nearest = (1.0 / NEAR).min(1.0 / (1.0 + (place.origin[2] - 2.0 * place.scale) * lens.nearness).max(NEAR));
        let widest = ((node.own.widest.of(width) * lens.step * nearest / 2.0).max(look.hairline)) as f32;
        let mut frame = Frame {
            node: id,
            left: 0,
            order: [0; WIDTH],
            seen,
            place,
            shade,
            path,
            width,
            shares: [MOST; WIDTH],
            spare: 0.0,
            towards: DIRECTIONS.map(|to| place.axes.map(|axis| (dot(axis, to) / place.scale) as f32)),
        };
        let count = usize::from(node.links) + usize::from(node.lines);
        let scarce = share < node.own.need;
        let mut weights = [0.0; WIDTH];
        let mut kept = 0;
        for (lane, weighs) in weights.iter_mut().enumerate().take(count) {
            let [x, y, r] = [0, 1, 2].map(|i| frame.seen[i][lane]);
            let reach = r + widest;
            let within = |low: [f64; 2], high: [f64; 2]| {
                let [low, high] = [low, high].map(|corner| corner.map(|c| c as f32));
                x + reach >= low[0] && x - reach <= high[0] && y + reach >= low[1] && y - reach <= high[1]
            };
            if within([0.0; 2], self.tile.size.map(|side| side as f64)) {
                frame.order[kept] = lane as u8;
                kept += 1;
            }
            // Outside of the picture; what is outside of this tile has its share, so that tiles agree.
            if scarce && lane < usize::from(node.links) {
                let seen = within(corner.map(|c| -c), [0, 1].map(|i| look.size[i] - corner[i]));
                *weighs = if seen { weight(r) } else { 0.0 };
            }
        }
        if scarce {
            let needs = |lane: usize| scene.nodes[scene.links[node.first_link as usize + lane].node as usize].own.need;
            frame.shares = shares(share - f32::from(node.lines), &weights[..usize::from(node.links)], needs);
        } else {
            frame.spare = (share - node.own.need).clamp(0.0, MOST);
        }
        frame.left = kept as u8;
        if scale > SORTED {
            let depth = &frame.seen[3];
            let order = &mut frame.order[..kept];
            for i in 1..kept {
                let mut j = i;
                while j > 0 && depth[usize::from(order[j - 1])] < depth[usize::from(order[j])] {
                    order.swap(j - 1, j);
                    j -= 1;
                }
            }
        }
        if kept > 0 {
            self.stack.push(frame);
        } else if let Some(outer) = self.stack.last_mut() {
            outer.spare += share.min(MOST);
        }
    }
}

impl Place {
    /// How much larger than at the target things look at a depth of the picture.
    fn scale_at(&self, lens: &Lens, depth: f32) -> f64 {
        // Depth is z / (1 + z n), so 1 / (1 + z n) is 1 - depth n.
        (1.0 - f64::from(depth) * lens.nearness).clamp(0.0, 1.0 / NEAR)
    }
}

/// Whether a drawing is so small that all of it is always looked into.
fn few(scene: &Scene) -> bool {
    scene.root.is_none_or(|root| scene.nodes[root as usize].own.need <= FEW)
}

/// How a node's budget is shared out to the nodes in it: by the room that they take, as far as it can be in the tile.
fn weight(ball: f32) -> f32 {
    let size = ball.min(LARGE);
    size * size + 1.0
}

/// The samples of a node in order, those that face the viewer first.
fn facing(place: &Place, count: usize) -> [u8; SAMPLES] {
    let view = place.axes.map(|axis| -axis[2]);
    let mut order = [0; SAMPLES];
    let mut scores = [0.0; SAMPLES];
    for k in 0..count {
        let score = dot(direction(k, count), view);
        let mut at = k;
        while at > 0 && scores[at - 1] < score {
            (scores[at], order[at]) = (scores[at - 1], order[at - 1]);
            at -= 1;
        }
        (scores[at], order[at]) = (score, k as u8);
    }
    order
}

/// Shares out a budget: nobody gets more than is needed, others by their weights.
fn shares(mut budget: f32, weights: &[f32], needs: impl Fn(usize) -> f32) -> [f32; WIDTH] {
    let mut shares = [0.0; WIDTH];
    let mut open = [0.0; WIDTH];
    open[..weights.len()].copy_from_slice(weights);
    let mut sum: f32 = weights.iter().sum();
    for _ in 0..ROUNDS {
        let per = (budget / sum.max(1e-30)).max(0.0);
        for lane in 0..weights.len() {
            let need = needs(lane) + 1.0;
            if open[lane] > 0.0 && need <= per * open[lane] {
                shares[lane] = need;
                budget -= need;
                sum -= open[lane];
                open[lane] = 0.0;
            }
        }
    }
    let per = (budget / sum.max(1e-30)).max(0.0);
    for lane in 0..weights.len() {
        if open[lane] > 0.0 {
            shares[lane] = per * open[lane];
        }
    }
    shares
}

/// What of a line lies before the eye.
pub(super) fn before_eye(lens: &Lens, ends: [Vector; 2]) -> Option<[Vector; 2]> {
    let ahead = ends.map(|end| 1.0 + end[2] * lens.nearness - NEAR);
    match ahead.map(|a| a > 0.0) {
        [true, true] => Some(ends),
        [false, false] => None,
        [first, _] => {
            let t = ahead[0] / (ahead[0] - ahead[1]);
            let cut = [0, 1, 2].map(|i| ends[0][i] + t * (ends[1][i] - ends[0][i]));
            Some(if first { [ends[0], cut] } else { [cut, ends[1]] })
        }
    }
}
