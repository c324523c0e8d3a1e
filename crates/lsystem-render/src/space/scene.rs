//! A drawing made ready for being looked at in space: every block becomes nodes of at most 16 contents, with a ball
//! around each, and with what is seen of it where it is too small to be looked into.

mod colour;
mod node;

pub(super) use node::direction;

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

    /// The samples of a node, those that are shown first before others.
    pub(super) fn samples(&self, node: u32) -> &[Sample] {
        let first = node as usize * self.kept;
        self.samples.get(first..first + self.kept).unwrap_or_default()
    }
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
