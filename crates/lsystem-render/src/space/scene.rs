//! A drawing made ready for being looked at in space: every block becomes nodes of at most 16 contents, with a ball
//! around each, and with what is seen of it where it is too small to be looked into.

use super::light::Bundle;
use super::path::Stretch;
use crate::plane::{Amount, Choice, Shade};
use core::ops::Range;
use lsystem_drawing::SceneSize;
use lsystem_drawing::rotation::{Vector, combine, cross, dot, minus, norm};
use lsystem_drawing::triangulate::triangulate;
use lsystem_drawing::{BlockId, Drawing, Item, Placed, Solid, StyleChange, WidthChange};
use lsystem_syntax::{ColourBy, Meter, Progress, Style};

/// Contents of a node at most.
pub(super) const WIDTH: usize = SceneSize::WIDTH;

/// The nodes of a drawing.
#[derive(Default)]
pub(super) struct Scene {
    pub(super) nodes: Vec<Node>,
    pub(super) links: Vec<Link>,
    pub(super) lines: Vec<Line>,
    pub(super) styles: Vec<StyleChange>,
    /// `kept` of each node, those that are shown first before others.
    samples: Vec<Sample>,
    kept: usize,
    /// By node, then by the colour at its entry: the mean colour of what it draws.
    means: Vec<[f32; 3]>,
    /// Colours at a node's entry that `means` tells apart.
    entries: u32,
    /// The picture's inks.
    palette: Vec<[f32; 3]>,
    pub(super) choice: Choice,
    pub(super) root: Option<u32>,
    /// By block: its node, if it shows anything.
    blocks: Vec<Option<u32>>,
    stage: Stage,
    making: Option<Making>,
    /// How many segments are asked for; all of them without it.
    upto: Option<u128>,
    /// How many nodes, links and lines there are for the whole drawing; those after them are of a part of it.
    whole: [usize; 3],
    memoised: bool,
    /// Whether colours follow the path, and not what is at a node's entry.
    pub(super) along: bool,
    /// What part of the path is shown, and what part one segment is.
    pub(super) shown: Stretch,
    pub(super) one: f64,
}

/// A block, or a run of a block's contents. Coordinates are the block's.
pub(super) struct Node {
    /// Balls around the contents, links first: x, y, z and radius of each, strokes' widths apart.
    pub(super) balls: [[f32; WIDTH]; 4],
    pub(super) first_link: u32,
    pub(super) first_line: u32,
    pub(super) links: u8,
    pub(super) lines: u8,
    pub(super) own: Own,
}

/// What is known of a node without looking into it.
#[derive(Clone, Copy)]
pub(super) struct Own {
    /// Of the ball around it.
    centre: Vector,
    radius: f64,
    /// The length of all it draws, and the area of all triangles.
    pub(super) length: f32,
    area: f32,
    bundle: Bundle,
    /// No stroke inside is wider than this change makes the width at entry.
    pub(super) widest: WidthChange,
    pub(super) limb: Limb,
    /// Strokes and nodes inside, as often as they are there; at most [`MANY`].
    pub(super) need: f32,
    /// The mean length of its samples.
    pub(super) sampled: f32,
    /// How many segments it has.
    count: Amount,
}

/// A straight part of a node, all of it drawn in one style: the longest, which stands for the node where nothing else
/// shows or where there is no time for more.
#[derive(Clone, Copy)]
pub(super) struct Limb {
    pub(super) from: Vector,
    pub(super) to: Vector,
    pub(super) style: StyleChange,
    /// How far from it anything of the node reaches, strokes' widths apart.
    pub(super) off: f64,
    /// What part of the node's segments comes before.
    pub(super) before: f64,
}

/// A stroke of a node, drawn by lot: what there is no time to look into shows some of these.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) from: [f32; 3],
    pub(super) to: [f32; 3],
    pub(super) style: StyleChange,
    /// What part of the node's segments comes before.
    pub(super) before: f32,
}

/// A node inside another: `p -> at + axes p`.
pub(super) struct Link {
    pub(super) node: u32,
    pub(super) style: u32,
    pub(super) at: Vector,
    /// Times the scale.
    pub(super) axes: [Vector; 3],
    /// As the node's, from the entry of the node that holds it.
    pub(super) widest: WidthChange,
    /// Of all it draws, in units of the node that holds it.
    pub(super) length: f32,
    /// Of all its triangles, in the same units.
    pub(super) area: f32,
    /// In the frame of the node that holds it.
    pub(super) bundle: Bundle,
    /// Whether it is a run of the same block.
    pub(super) same: bool,
    /// What part of all segments in the node that holds it comes before, and what part is in it.
    pub(super) before: f64,
    pub(super) part: f64,
}

/// One segment, or a triangle of a polygon.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub(super) from: [f32; 3],
    pub(super) to: [f32; 3],
    /// Of a triangle: the corner that is not on its longest side.
    pub(super) corner: Option<[f32; 3]>,
    pub(super) style: u32,
    /// What part of the node's segments comes before.
    pub(super) before: f32,
}

impl Line {
    fn new(ends: [Vector; 2], style: u32) -> Self {
        let [from, to] = ends.map(|end| end.map(|c| c as f32));
        Self { from, to, corner: None, style, before: 0.0 }
    }

    fn face([a, b, c]: [Vector; 3], style: u32) -> Self {
        let long = |a: Vector, b: Vector| norm(minus(b, a));
        let turned = [[a, b, c], [b, c, a], [c, a, b]];
        let most = turned.into_iter().max_by(|p, q| long(p[0], p[1]).total_cmp(&long(q[0], q[1])));
        let [from, to, corner] = most.unwrap_or([a, b, c]);
        Self { corner: Some(corner.map(|c| c as f32)), ..Self::new([from, to], style) }
    }

    /// Of a triangle.
    fn area(&self) -> f32 {
        let Some(corner) = self.corner else { return 0.0 };
        let aside = [0, 1, 2].map(|i| f64::from(corner[i] - self.from[i]));
        0.5 * norm(cross(self.way(), aside)) as f32
    }

    fn way(&self) -> Vector {
        [0, 1, 2].map(|i| f64::from(self.to[i] - self.from[i]))
    }
}

/// How much longer a limb must be than those before it to stand for them: more than by rounding.
const LONGER: f64 = 1.0 + 1e-9;
/// How far one may be from going straight on with another, for its length.
const STRAIGHT: f64 = 1e-4;
/// Samples of a node.
pub(super) const SAMPLES: usize = SceneSize::samples(true);
/// Contents that are looked at for a sample.
const TRIES: usize = 2;
/// More contents than anybody can look into.
const MANY: f32 = 1e30;
/// Mean colours that are remembered at most.
const MEANS: usize = 1 << 21;

/// How far a scene is made.
#[derive(Debug, Default)]
enum Stage {
    /// Nodes of all blocks are being made.
    #[default]
    Blocks,
    /// What is to be shown is not known yet.
    Show,
    /// On the way down to the first segment that is left out.
    Cut(Way),
    /// Nodes are being made of what comes before that, from the innermost block outwards; the node of the last.
    Inside(Way, Option<u32>),
    Ready,
}

/// The way down to the first segment that is left out.
#[derive(Debug)]
struct Way {
    /// By block: its items before that segment, and the block that has it.
    kept: Vec<(Range<u32>, Option<Placed<Solid>>)>,
    block: BlockId,
    /// The item that is looked at, and how many segments come before the one that is left out.
    at: u32,
    left: u128,
}

/// Nodes being made of items.
#[derive(Default)]
struct Making {
    items: Range<u32>,
    /// What the last of them places, and the node of it.
    last: Option<(Placed<Solid>, u32)>,
    run: Run,
    /// Of the item in hand, the next one last.
    lines: Vec<Line>,
    /// Nodes that are not in another yet, how many of them have been done, and those around these.
    row: Vec<u32>,
    done: usize,
    above: Vec<u32>,
}

/// What it costs to make a node, to make a line or a link, and to look at a segment, in units of work.
const NODE_WORK: u64 = 64;
const ITEM_WORK: u64 = 4;
const LOOK_WORK: u64 = 1;

impl Scene {
    /// Takes the memory that the drawing has been counted to need, so that no list grows.
    fn reserve(&mut self, size: SceneSize) {
        self.nodes.reserve_exact(size.nodes);
        self.links.reserve_exact(size.links);
        self.lines.reserve_exact(size.lines);
        self.samples.reserve_exact(size.nodes * self.kept);
    }

    /// A scene with nothing in it yet.
    pub(super) fn new(drawing: &Drawing<Solid>) -> Self {
        let mut styles = drawing.styles.clone();
        styles.push(StyleChange::NONE);
        let kept = SceneSize::samples(drawing.memoised);
        Self { styles, memoised: drawing.memoised, kept, ..Self::default() }
    }

    /// Asks for the first `upto` segments and the polygons before them, or for all.
    pub(super) fn show(&mut self, upto: Option<u128>) {
        self.upto = upto;
        if !matches!(self.stage, Stage::Blocks) {
            (self.stage, self.making) = (Stage::Show, None);
        }
    }

    /// Goes on with making the nodes, until what is asked for can be shown.
    pub(super) fn step(&mut self, drawing: &Drawing<Solid>, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            match core::mem::take(&mut self.stage) {
                Stage::Blocks => self.next_block(drawing, meter),
                Stage::Show => self.stage = self.start_showing(drawing),
                Stage::Cut(way) => self.stage = self.cut(drawing, way, meter),
                Stage::Inside(way, inside) => self.stage = self.inside(drawing, way, inside, meter),
                Stage::Ready => {
                    self.stage = Stage::Ready;
                    return Progress::Done;
                }
            }
        }
        Progress::More
    }

    /// Goes on with the nodes of a block.
    fn next_block(&mut self, drawing: &Drawing<Solid>, meter: &mut Meter) {
        if self.blocks.is_empty() && self.making.is_none() {
            self.reserve(drawing.scene);
        }
        let Some(block) = drawing.blocks.get(self.blocks.len()) else {
            self.whole = [self.nodes.len(), self.links.len(), self.lines.len()];
            self.stage = Stage::Show;
            return;
        };
        let mut making = self.making.take().unwrap_or_else(|| Making::new(block.items.clone(), None));
        if self.contents(drawing, &mut making, meter) == Progress::More {
            self.making = Some(making);
            return;
        }
        meter.charge(1);
        let node = making.node();
        if let Some(node) = node.and_then(|node| self.nodes.get_mut(node as usize)) {
            // The drawing knows a tighter ball than one around balls.
            if block.hull.radius < node.own.radius {
                (node.own.centre, node.own.radius) = (block.hull.centre(), block.hull.radius);
            }
        }
        self.blocks.push(node);
    }

    /// Shows all, or begins to look for the first segment that is left out: on the way down to it every block becomes a node
    /// with what is before it.
    fn start_showing(&mut self, drawing: &Drawing<Solid>) -> Stage {
        let [nodes, links, lines] = self.whole;
        self.nodes.truncate(nodes);
        self.links.truncate(links);
        self.lines.truncate(lines);
        self.samples.truncate(nodes * self.kept);
        self.means.truncate(nodes * self.entries as usize);
        self.root = drawing.root.and_then(|root| self.blocks.get(root.0 as usize).copied().flatten());
        self.one = Amount::ONE.of(self.count(self.root));
        self.shown = Stretch { from: 0.0, size: 1.0 };
        let upto = self.upto.filter(|&upto| upto < drawing.segment_count());
        match upto.zip(drawing.root) {
            Some((left, block)) => Stage::Cut(Way::new(drawing, block, left)),
            None => Stage::Ready,
        }
    }

    /// Goes on to the first segment that is left out.
    fn cut(&mut self, drawing: &Drawing<Solid>, mut way: Way, meter: &mut Meter) -> Stage {
        let items = drawing.blocks[way.block.0 as usize].items.clone();
        while !meter.is_spent() {
            meter.charge(LOOK_WORK);
            let item = drawing.items.get(way.at as usize).filter(|_| way.at < items.end);
            let count = item.map_or(0, |item| drawing.segments_in(item));
            if item.is_some() && count <= way.left {
                way.left -= count;
                way.at += 1;
                continue;
            }
            let Some(Item::Block(placed)) = item else {
                way.kept.push((items.start..way.at, None));
                return Stage::Inside(way, None);
            };
            way.kept.push((items.start..way.at, Some(*placed)));
            (way.block, way.at) = (placed.block, drawing.blocks[placed.block.0 as usize].items.start);
            return Stage::Cut(way);
        }
        Stage::Cut(way)
    }

    /// Goes on with the nodes of what comes before.
    fn inside(&mut self, drawing: &Drawing<Solid>, mut way: Way, inside: Option<u32>, meter: &mut Meter) -> Stage {
        let mut making = match (self.making.take(), way.kept.last()) {
            (Some(making), _) => making,
            (None, Some((items, placed))) => Making::new(items.clone(), placed.zip(inside)),
            (None, None) => {
                let all = self.count(self.root);
                self.root = inside;
                self.shown = Stretch { from: 0.0, size: self.count(self.root).of(all) };
                return Stage::Ready;
            }
        };
        if self.contents(drawing, &mut making, meter) == Progress::More {
            self.making = Some(making);
            return Stage::Inside(way, inside);
        }
        way.kept.pop();
        Stage::Inside(way, making.node())
    }

    fn count(&self, node: Option<u32>) -> Amount {
        node.and_then(|node| self.nodes.get(node as usize)).map_or(Amount::default(), |node| node.own.count)
    }

    /// Goes on with making nodes of items.
    fn contents(&mut self, drawing: &Drawing<Solid>, making: &mut Making, meter: &mut Meter) -> Progress {
        let same = self.styles.len() as u32 - 1;
        while !meter.is_spent() {
            if making.run.len() == WIDTH {
                meter.charge(NODE_WORK);
                making.row.push(self.node(core::mem::take(&mut making.run)));
            } else if let Some(line) = making.lines.pop() {
                meter.charge(ITEM_WORK);
                making.run.draw(line);
            } else if let Some(item) = making.items.next() {
                meter.charge(self.add(drawing, making, &drawing.items[item as usize]));
            } else if let Some((placed, node)) = making.last.take() {
                making.run.hold(self.link(&placed, node), self.count(Some(node)));
            } else if making.run.len() > 0 {
                meter.charge(NODE_WORK);
                making.row.push(self.node(core::mem::take(&mut making.run)));
            } else if making.row.len() <= 1 {
                return Progress::Done;
            } else if making.done < making.row.len() {
                meter.charge(NODE_WORK);
                let mut run = Run::default();
                for &node in making.row[making.done..].iter().take(WIDTH) {
                    run.hold(self.same(node, same), self.count(Some(node)));
                }
                making.done += run.len();
                making.above.push(self.node(run));
            } else {
                (making.row, making.done) = (core::mem::take(&mut making.above), 0);
            }
        }
        Progress::More
    }

    /// Adds an item to the nodes that are being made; the units of work that this took. A block that shows nothing, as
    /// polygons without an area do, has no node.
    fn add(&self, drawing: &Drawing<Solid>, making: &mut Making, item: &Item<Solid>) -> u64 {
        match item {
            Item::Stroke(stroke) => making.run.draw(Line::new([stroke.from, stroke.to], stroke.style.0)),
            Item::Polygon(polygon) => {
                let vertices = drawing.vertices_of(polygon);
                let triangles = triangulate(vertices);
                let corners = triangles.corners.into_iter().rev().map(|corners| corners.map(|corner| vertices[corner]));
                making.lines.extend(corners.map(|corners| Line::face(corners, polygon.style.0)));
                return ITEM_WORK * vertices.len() as u64 + triangles.work;
            }
            Item::Block(placed) => {
                if let Some(node) = self.blocks[placed.block.0 as usize] {
                    making.run.hold(self.link(placed, node), self.count(Some(node)));
                }
            }
        }
        ITEM_WORK
    }

    fn link(&self, placed: &Placed<Solid>, node: u32) -> Link {
        let own = &self.nodes[node as usize].own;
        let columns = placed.heading.columns();
        Link {
            node,
            style: placed.style.0,
            at: placed.at,
            axes: columns.map(|column| column.map(|c| c * placed.scale)),
            widest: self.styles[placed.style.0 as usize].width.then(own.widest),
            // Sums of these stay finite.
            length: (own.length * placed.scale as f32).min(1e30),
            area: (own.area * (placed.scale * placed.scale) as f32).min(1e30),
            bundle: own.bundle.turned(&columns),
            same: false,
            before: 0.0,
            part: 0.0,
        }
    }

    /// What the pen does for a line that stands for others: a triangle's longest side has no width.
    fn style_of(&self, line: &Line) -> StyleChange {
        let style = self.styles[line.style as usize];
        let width = if line.corner.is_some() { WidthChange { factor: 0.0, offset: 0.0 } } else { style.width };
        StyleChange { width, ..style }
    }

    /// A link to a run of the same block.
    fn same(&self, node: u32, style: u32) -> Link {
        let Own { widest, length, area, bundle, .. } = self.nodes[node as usize].own;
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Link { node, style, at: [0.0; 3], axes, widest, length, area, bundle, same: true, before: 0.0, part: 0.0 }
    }

    /// Adds a node; returns its number.
    fn node(&mut self, mut run: Run) -> u32 {
        let count = run.count;
        for (link, before) in run.links.iter_mut().zip(&run.before[0]) {
            link.before = before.of(count);
            link.part = self.count(Some(link.node)).of(count);
        }
        for (line, before) in run.lines.iter_mut().zip(&run.before[1]) {
            line.before = before.of(count) as f32;
        }
        let mut balls = [[0.0; WIDTH]; 4];
        let mut widest = WidthChange { factor: 0.0, offset: 0.0 };
        let (mut length, mut area, mut bundle) = (0.0_f32, 0.0_f32, Bundle::default());
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let mut limbs: Vec<Limb> = Vec::with_capacity(WIDTH);
        let mut put = |lane: usize, centre: Vector, radius: f64| {
            for i in 0..3 {
                balls[i][lane] = centre[i] as f32;
                low[i] = low[i].min(centre[i] - radius);
                high[i] = high[i].max(centre[i] + radius);
            }
            // Centres are rounded.
            balls[3][lane] = (radius * (1.0 + 1e-6) + 1e-7) as f32;
        };
        for (lane, link) in run.links.iter().enumerate() {
            let own = &self.nodes[link.node as usize].own;
            let [x, y, z] = combine(&link.axes, own.centre);
            let scale = if link.same { 1.0 } else { norm(link.axes[0]) };
            put(lane, [link.at[0] + x, link.at[1] + y, link.at[2] + z], own.radius * scale);
            limbs.push(self.limb_of(link, &own.limb));
            widest = widest.widest(link.widest);
            length += link.length;
            area += link.area;
            bundle.add(&link.bundle, link.length);
        }
        for (lane, line) in run.lines.iter().enumerate() {
            let [from, to] = [line.from, line.to].map(|end| end.map(f64::from));
            let half = [0, 1, 2].map(|i| 0.5 * (to[i] - from[i]));
            let centre = [0, 1, 2].map(|i| from[i] + half[i]);
            let mut limb = Limb { from, to, style: self.style_of(line), off: 0.0, before: f64::from(line.before) };
            if let Some(corner) = line.corner {
                let corner = corner.map(f64::from);
                put(run.links.len() + lane, centre, norm(half).max(norm(minus(corner, centre))));
                limb.off = distance(&limb, corner);
                area += line.area();
            } else {
                put(run.links.len() + lane, centre, norm(half));
                widest = widest.widest(limb.style.width);
            }
            limbs.push(limb);
            let own = 2.0 * norm(half) as f32;
            length += own;
            bundle.add(&Bundle::of(half), own);
        }
        if length > 0.0 && length.is_finite() {
            bundle.spread.iter_mut().for_each(|c| *c /= length);
        } else {
            bundle = Bundle::of([0.0; 3]);
        }
        let centre = [0, 1, 2].map(|i| 0.5 * (low[i] + high[i]));
        let contents = run.links.len() + run.lines.len();
        let farthest = (0..contents).map(|lane| {
            let [x, y, z, radius] = [0, 1, 2, 3].map(|i| f64::from(balls[i][lane]));
            norm([x - centre[0], y - centre[1], z - centre[2]]) + radius
        });
        let radius = farthest.fold(0.0, f64::max);
        let limb = longest(&limbs);
        let needs = run.links.iter().map(|link| self.nodes[link.node as usize].own.need);
        let need = (needs.sum::<f32>() + contents as f32).min(MANY);
        let sampled = self.sample(&run, length);
        let own = Own { centre, radius, length, area, bundle, widest, limb, need, sampled, count };
        self.nodes.push(Node {
            balls,
            first_link: self.links.len() as u32,
            first_line: self.lines.len() as u32,
            links: run.links.len() as u8,
            lines: run.lines.len() as u8,
            own,
        });
        self.links.extend(run.links);
        self.lines.extend(run.lines);
        self.nodes.len() as u32 - 1
    }

    /// A limb of a node inside another.
    fn limb_of(&self, link: &Link, limb: &Limb) -> Limb {
        let [from, to] = [limb.from, limb.to].map(|end| {
            let [x, y, z] = combine(&link.axes, end);
            [link.at[0] + x, link.at[1] + y, link.at[2] + z]
        });
        let scale = if link.same { 1.0 } else { norm(link.axes[0]) };
        Limb {
            from,
            to,
            style: self.styles[link.style as usize].then(&limb.style),
            off: limb.off * scale,
            before: link.before + link.part * limb.before,
        }
    }

    /// Chooses the samples of a new node from those of its contents. Each stands for a direction: of two contents drawn
    /// by lot, the longer all their strokes the likelier, the one that has a sample farther in that direction gives it;
    /// for what can be seen of many strokes in one place are the outer ones. Returns their mean length.
    fn sample(&mut self, run: &Run, length: f32) -> f32 {
        let kept = self.kept;
        let nothing = Sample { from: [0.0; 3], to: [0.0; 3], style: StyleChange::NONE, before: 0.0 };
        let mut passed = 0.0;
        let mut ends = [0.0_f32; WIDTH];
        let lengths =
            run.links.iter().map(|link| link.length).chain(run.lines.iter().map(|line| norm(line.way()) as f32));
        for (end, own) in ends.iter_mut().zip(lengths) {
            passed += own;
            *end = passed;
        }
        let count = run.links.len() + run.lines.len();
        let mut state = self.nodes.len() as u32;
        let mut draw = |limit: f32| {
            state = state.wrapping_mul(0x9e37_79b9).wrapping_add(0x7f4a_7c15);
            let mark = (state >> 8) as f32 * limit / (1 << 24) as f32;
            ends[..count].iter().position(|&end| mark < end).unwrap_or(count - 1)
        };
        let mut sum = 0.0;
        for k in 0..kept {
            let towards = direction(k, kept);
            let mut best = (f64::NEG_INFINITY, nothing);
            for _ in 0..TRIES {
                let lane = draw(length);
                let sample = match run.links.get(lane) {
                    Some(link) => {
                        let own = link.axes.map(|axis| dot(axis, towards));
                        let facing = (0..kept)
                            .max_by(|&a, &b| dot(direction(a, kept), own).total_cmp(&dot(direction(b, kept), own)));
                        let sample = self.samples[link.node as usize * kept + facing.unwrap_or(0)];
                        let [from, to] = [sample.from, sample.to].map(|end| {
                            let [x, y, z] = combine(&link.axes, end.map(f64::from));
                            [link.at[0] + x, link.at[1] + y, link.at[2] + z].map(|c| c as f32)
                        });
                        let style = self.styles[link.style as usize].then(&sample.style);
                        let before = link.before + link.part * f64::from(sample.before);
                        Sample { from, to, style, before: before as f32 }
                    }
                    None => match run.lines.get(lane - run.links.len()) {
                        Some(&Line { from, to, style, before, .. }) => {
                            Sample { from, to, style: self.styles[style as usize], before }
                        }
                        None => nothing,
                    },
                };
                let middle = [0, 1, 2].map(|i| f64::from(0.5 * (sample.from[i] + sample.to[i])));
                let reach = dot(middle, towards);
                if reach > best.0 {
                    best = (reach, sample);
                }
            }
            let sample = best.1;
            sum += norm([0, 1, 2].map(|i| f64::from(sample.to[i] - sample.from[i]))) as f32;
            self.samples.push(sample);
        }
        sum / kept as f32
    }

    /// The samples of a node, those that are shown first before others.
    pub(super) fn samples(&self, node: u32) -> &[Sample] {
        let first = node as usize * self.kept;
        self.samples.get(first..first + self.kept).unwrap_or_default()
    }

    /// Goes on with making the mean colours for a style, until they are there.
    pub(super) fn dye(&mut self, style: &Style, meter: &mut Meter) -> Progress {
        let choice = Choice::new(style, &self.styles);
        let colours = choice.colours;
        let palette: Vec<[f32; 3]> = (0..colours).map(|ink| style.ink(ink).rgb.map(f32::from)).collect();
        if choice != self.choice || palette != self.palette || self.means.is_empty() && !self.along {
            (self.choice, self.palette) = (choice, palette);
            // What does not memoise has its colours as they are, whatever is at the entry.
            let few = !self.memoised || self.whole[0].saturating_mul(colours as usize) > MEANS;
            // Along the path they follow from that.
            self.along = style.colour_by == ColourBy::Path;
            self.entries = if self.along {
                0
            } else if few {
                1
            } else {
                colours
            };
            self.means.clear();
            self.means.reserve_exact(self.nodes.len() * self.entries as usize);
        }
        let known = self.means.len() / self.entries.max(1) as usize;
        for node in self.nodes.get(known..).unwrap_or_default().iter().filter(|_| self.entries > 0) {
            if meter.is_spent() {
                return Progress::More;
            }
            meter.charge(1 + u64::from(self.entries) * u64::from(node.links + node.lines) / 4);
            for entry in 0..self.entries {
                let (mut sum, mut weight) = ([0.0_f32; 3], 0.0_f32);
                let mut add = |colour: [f32; 3], length: f32| {
                    // What has no length counts where there is nothing else.
                    let length = length.max(1e-30);
                    weight += length;
                    sum.iter_mut().zip(colour).for_each(|(sum, c)| *sum += length * c);
                };
                for link in &self.links[node.first_link as usize..][..usize::from(node.links)] {
                    let shade = self.choice.then(Shade { number: entry, fixed: true }, self.shade(link.style));
                    add(self.mean(link.node, shade, Stretch::default()), link.length);
                }
                for line in &self.lines[node.first_line as usize..][..usize::from(node.lines)] {
                    let shade = self.choice.then(Shade { number: entry, fixed: true }, self.shade(line.style));
                    add(self.ink(shade, Stretch::default(), 0.0), norm(line.way()) as f32);
                }
                let mean = if weight.is_finite() {
                    sum.map(|c| c / weight)
                } else {
                    self.ink(Shade { number: entry, fixed: true }, Stretch::default(), 0.0)
                };
                self.means.push(mean);
            }
        }
        Progress::Done
    }

    /// What a style does to the colour.
    #[inline]
    pub(super) fn shade(&self, style: u32) -> Shade {
        self.choice.shade(&self.styles[style as usize])
    }

    /// The mean colour of a node that is entered with a shade and has a part of the path.
    #[inline]
    pub(super) fn mean(&self, node: u32, shade: Shade, path: Stretch) -> [f32; 3] {
        if self.along {
            return path.mean(&self.palette);
        }
        let entry = shade.number;
        let entry = if entry < self.entries { entry } else { 0 };
        self.means.get((node * self.entries + entry) as usize).copied().unwrap_or_default()
    }

    /// The colour of a stroke with a shade, before which there is a part of the path's stretch.
    #[inline]
    pub(super) fn ink(&self, shade: Shade, path: Stretch, before: f64) -> [f32; 3] {
        let entry = if self.along { Stretch { size: self.one, ..path.part(before, 0.0) }.ink() } else { shade.number };
        self.palette.get(entry as usize).copied().unwrap_or_default()
    }
}

/// The longest straight part of some contents, given the limb of each, and how far from it they reach.
fn longest(limbs: &[Limb]) -> Limb {
    let mut all = limbs.iter();
    let Some(mut limb) = all.next().copied() else {
        return Limb { from: [0.0; 3], to: [0.0; 3], style: StyleChange::NONE, off: 0.0, before: 0.0 };
    };
    for next in all {
        let way = minus(next.to, next.from);
        let long = norm(way);
        let whole = Limb { to: next.to, ..limb };
        let goes_on = norm(minus(next.from, limb.to)) <= STRAIGHT * long
            && next.style == limb.style
            && distance(&whole, limb.to) <= STRAIGHT * long
            && norm(minus(next.to, limb.from)) > norm(minus(limb.to, limb.from));
        if goes_on {
            limb = whole;
        } else if long > norm(minus(limb.to, limb.from)) * LONGER {
            limb = *next;
        }
    }
    let off = limbs.iter().map(|own| distance(&limb, own.from).max(distance(&limb, own.to)) + own.off);
    Limb { off: off.fold(0.0, f64::max), ..limb }
}

/// Cosine and sine of multiples of the golden angle.
#[rustfmt::skip]
const TURNS: [[f64; 2]; SAMPLES] = [
    [1.000000, 0.000000], [-0.737369, 0.675490], [0.087426, -0.996171], [0.608439, 0.793601],
    [-0.984713, -0.174182], [0.843755, -0.536728], [-0.259604, 0.965715], [-0.460907, -0.887448],
    [0.939321, 0.343039], [-0.924346, 0.381556], [0.423846, -0.905734], [0.299284, 0.954164],
    [-0.865211, -0.501408], [0.976676, -0.214719], [-0.575129, 0.818062], [-0.128511, -0.991708],
];

/// The directions that samples stand for, as even as so many can be: unit vectors along a spiral from pole to pole.
pub(super) fn direction(number: usize, count: usize) -> Vector {
    let y = 1.0 - (2.0 * number as f64 + 1.0) / count as f64;
    let [c, s] = TURNS[number % SAMPLES];
    let level = (1.0 - y * y).sqrt();
    [c * level, y, s * level]
}

/// How far a point is from a limb.
fn distance(limb: &Limb, point: Vector) -> f64 {
    let (way, to) = (minus(limb.to, limb.from), minus(point, limb.from));
    let square = dot(way, way);
    let t = if square > 0.0 { (dot(way, to) / square).clamp(0.0, 1.0) } else { 0.0 };
    norm([0, 1, 2].map(|i| to[i] - t * way[i]))
}

impl Making {
    fn new(items: Range<u32>, last: Option<(Placed<Solid>, u32)>) -> Self {
        Self { items, last, ..Self::default() }
    }

    /// The node that holds all, when they are made, if there is any.
    fn node(&self) -> Option<u32> {
        self.row.first().copied()
    }
}

impl Way {
    fn new(drawing: &Drawing<Solid>, block: BlockId, left: u128) -> Self {
        Self { kept: vec![], block, at: drawing.blocks[block.0 as usize].items.start, left }
    }
}

/// What becomes a node.
#[derive(Default)]
struct Run {
    links: Vec<Link>,
    lines: Vec<Line>,
    /// Segments before each link, and before each line.
    before: [Vec<Amount>; 2],
    count: Amount,
}

impl Run {
    fn len(&self) -> usize {
        self.links.len() + self.lines.len()
    }

    /// Goes on with a link to so many segments.
    fn hold(&mut self, link: Link, count: Amount) {
        self.links.push(link);
        self.before[0].push(self.count);
        self.count = self.count.plus(count);
    }

    fn draw(&mut self, line: Line) {
        self.before[1].push(self.count);
        if line.corner.is_none() {
            self.count = self.count.plus(Amount::ONE);
        }
        self.lines.push(line);
    }
}
