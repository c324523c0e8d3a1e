//! A drawing prepared for pictures in space: every block becomes nodes of at most 16 contents. Each content has a ball
//! around it, and each node a summary that is shown if the node is too small to be looked into.

mod colour;
mod node;

pub(super) use node::direction;

use super::light::Bundle;
use super::path::Stretch;
use crate::ink::{Amount, Choice, Shade};
use core::ops::Range;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::SceneSize;
use lsystem_drawing::rotation::{Vector, combine, cross, dot, minus, norm};
use lsystem_drawing::triangulate::triangulate;
use lsystem_drawing::{BlockId, ColourChange, Drawing, Item, Placed, Solid, StyleChange, WidthChange, Widths};
use lsystem_syntax::Style;

/// The most contents of a node.
pub(super) const WIDTH: usize = SceneSize::WIDTH;

/// The nodes of a drawing.
#[derive(Default)]
pub(super) struct Scene {
    pub(super) nodes: Vec<SceneNode>,
    pub(super) links: Vec<Link>,
    pub(super) lines: Vec<SceneLine>,
    pub(super) styles: Vec<StyleChange>,
    /// By node: `kept` sample strokes.
    samples: Vec<SampleStroke>,
    kept: usize,
    /// By node, then by the colour at its entry: the mean colour of its strokes.
    means: Vec<[f32; 3]>,
    /// By node, for additive ink: the length of all strokes, and the area of all triangles, without a limit.
    wholes: Vec<[Amount; 2]>,
    /// The number of colours at a node's entry that `means` distinguishes.
    entries: u32,
    /// The picture's inks.
    palette: Vec<[f32; 3]>,
    pub(super) choice: Choice,
    pub(super) root: Option<u32>,
    /// By block: its node; `None` if the block shows nothing.
    blocks: Vec<Option<u32>>,
    stage: Stage,
    unfinished: Option<UnfinishedNodes>,
    /// If given, only the first `upto` segments are shown.
    upto: Option<u128>,
    /// The numbers of nodes, links and lines of the whole drawing. Later ones belong to the part that is shown.
    whole: [usize; 3],
    memoised: bool,
    /// Whether colours follow the path, not the colour at a node's entry.
    pub(super) along: bool,
    /// The part of the path that is shown.
    pub(super) shown: Stretch,
    /// One segment, as a part of the path.
    pub(super) one: f64,
}

/// A block, or a run of a block's contents, in the block's frame.
pub(super) struct SceneNode {
    /// Balls around the contents, links first: x, y, z and radius of each, without the widths of strokes.
    pub(super) balls: [[f32; WIDTH]; 4],
    pub(super) first_link: u32,
    pub(super) first_line: u32,
    pub(super) links: u8,
    pub(super) lines: u8,
    pub(super) summary: Summary,
}

impl SceneNode {
    /// The centre of the ball around a content.
    pub(super) fn centre(&self, lane: usize) -> Vector {
        [0, 1, 2].map(|i| f64::from(self.balls[i][lane]))
    }
}

/// The facts about a node that are used without looking into it.
#[derive(Clone, Copy)]
pub(super) struct Summary {
    /// The ball around the node.
    centre: Vector,
    pub(super) radius: f64,
    /// The length of all strokes and of the longest sides of triangles.
    pub(super) length: f32,
    /// The area of all triangles.
    pub(super) area: f32,
    pub(super) bundle: Bundle,
    /// The change of the width at entry to an upper bound of all widths inside.
    pub(super) widest: WidthChange,
    pub(super) main_line: MainLine,
    /// The strokes and nodes inside, counted as often as they occur; at most [`MAX_NEED`].
    pub(super) need: f32,
    /// The mean length of the samples, and the part of them that are triangles.
    pub(super) sampled: f32,
    pub(super) faces: f32,
    /// The number of segments.
    count: Amount,
}

/// The longest straight part of a node in one style. The main line stands for the node if nothing else of the node
/// shows, or if the budget allows no more.
#[derive(Clone, Copy)]
pub(super) struct MainLine {
    pub(super) from: Vector,
    pub(super) to: Vector,
    /// The style of the last stroke. The other strokes have the same, but do not taper.
    pub(super) style: StyleChange,
    /// Where the last stroke begins, as a part of the line.
    pub(super) bend: f64,
    /// The farthest that any content of the node is from the line, without the widths of strokes.
    pub(super) reach: f64,
    /// The part of the node's segments that comes before.
    pub(super) before: f64,
}

/// A random stroke or triangle of a node. Samples stand for a node that the budget does not allow to look into.
#[derive(Clone, Copy)]
pub(super) struct SampleStroke {
    /// The ends of a stroke, or of a triangle's longest side.
    pub(super) from: [f32; 3],
    pub(super) to: [f32; 3],
    colour: ColourChange,
    level: u32,
    /// Factor and offset of a stroke's width and of its next width, which are not numbers if there is none; or a
    /// triangle's third corner and [`FACE`]. One field for both, because samples take a third of a scene's memory.
    shape: [f32; 4],
    /// The part of the node's segments that comes before.
    pub(super) before: f32,
}

/// Stands behind the corner of a triangle.
const FACE: f32 = f32::INFINITY;

impl SampleStroke {
    fn new([from, to]: [[f32; 3]; 2], corner: Option<[f32; 3]>, style: &StyleChange, before: f32) -> Self {
        let &StyleChange { colour, width, level, next } = style;
        let short = |WidthChange { factor, offset }: WidthChange| {
            [factor, offset].map(|number| number.clamp(f32::MIN.into(), f32::MAX.into()) as f32)
        };
        let shape = match (corner, short(width), next.map_or([f32::NAN; 2], short)) {
            (Some([x, y, z]), ..) => [x, y, z, FACE],
            (None, [factor, offset], [next, then]) => [factor, offset, next, then],
        };
        Self { from, to, colour, level, shape, before }
    }

    /// A triangle's third corner; `None` for a stroke.
    pub(super) fn corner(&self) -> Option<[f32; 3]> {
        let [x, y, z, kind] = self.shape;
        (kind == FACE).then_some([x, y, z])
    }

    pub(super) fn style(&self) -> StyleChange {
        let Self { colour, level, shape: [factor, offset, next, then], .. } = *self;
        let change = |factor: f32, offset: f32| WidthChange { factor: factor.into(), offset: offset.into() };
        if self.corner().is_some() {
            return StyleChange { colour, level, ..StyleChange::NONE };
        }
        StyleChange { colour, width: change(factor, offset), level, next: (!next.is_nan()).then(|| change(next, then)) }
    }
}

/// A node inside another. A point `p` of the inner node is at `at + axes p` in the outer.
pub(super) struct Link {
    pub(super) node: u32,
    pub(super) style: u32,
    pub(super) at: Vector,
    /// The unit vectors of the inner node, times its scale.
    pub(super) axes: [Vector; 3],
    /// The inner node's [`Summary::widest`], from the entry of the outer node.
    pub(super) widest: WidthChange,
    /// The inner node's length, in units of the outer node.
    pub(super) length: f32,
    /// The inner node's area, in square units of the outer node.
    pub(super) area: f32,
    /// The inner node's bundle, in the frame of the outer node.
    pub(super) bundle: Bundle,
    /// Whether the inner node is a run of the same block.
    pub(super) same: bool,
    /// The part of the outer node's segments that comes before.
    pub(super) before: f64,
    /// The part of the outer node's segments that is in the inner node.
    pub(super) part: f64,
}

/// One segment, or a triangle of a polygon.
#[derive(Clone, Copy)]
pub(super) struct SceneLine {
    pub(super) from: [f32; 3],
    pub(super) to: [f32; 3],
    /// For a triangle: the corner that is not on its longest side, which is `from` to `to`.
    pub(super) corner: Option<[f32; 3]>,
    pub(super) style: u32,
    /// The part of the node's segments that comes before.
    pub(super) before: f32,
}

impl MainLine {
    /// The one or two strokes that the line is: only the last stroke may taper. `entry`: the widths at the node's entry.
    pub(super) fn parts(&self, entry: Widths) -> impl Iterator<Item = ([Vector; 2], Widths)> + use<> {
        let widths = entry.after(&self.style);
        let [first, last] = widths.ends();
        let splits = first != last && self.bend > 0.0;
        let bend = [0, 1, 2].map(|i| self.from[i] + self.bend * (self.to[i] - self.from[i]));
        let trunk = splits.then_some(([self.from, bend], widths.even()));
        trunk.into_iter().chain([([if splits { bend } else { self.from }, self.to], widths)])
    }
}

impl SceneLine {
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

    /// The area of a triangle; 0 for a segment.
    fn area(&self) -> f32 {
        let Some(corner) = self.corner else { return 0.0 };
        let aside = [0, 1, 2].map(|i| f64::from(corner[i] - self.from[i]));
        0.5 * norm(cross(self.way(), aside)) as f32
    }

    fn way(&self) -> Vector {
        [0, 1, 2].map(|i| f64::from(self.to[i] - self.from[i]))
    }
}

/// A main line must be longer than the lines before by this factor, which is more than rounding.
const LONGER: f64 = 1.0 + 1e-9;
/// The greatest offset, relative to its length, of a line that continues another.
const STRAIGHT: f64 = 1e-4;
/// The most sample strokes of a node.
pub(super) const SAMPLE_STROKES: usize = SceneSize::samples(true);
/// Contents that are compared for a sample stroke.
const TRIES: usize = 2;
/// The greatest need that is counted, so that sums stay finite.
const MAX_NEED: f32 = 1e30;
/// The most mean colours that are remembered: 24 MiB.
const MAX_MEANS: usize = 1 << 21;

/// The stage of a scene.
#[derive(Debug, Default)]
enum Stage {
    /// Makes the nodes of all blocks.
    #[default]
    Blocks,
    /// Starts showing all, or the first segments.
    Show,
    /// Descends to the first segment that is left out.
    Cut(CutPath),
    /// Makes nodes of the items before that segment, from the innermost block outwards; holds the node made last.
    Inside(CutPath, Option<u32>),
    Ready,
}

/// The descent to the first segment that is left out.
#[derive(Debug)]
struct CutPath {
    /// For each block on the way: its items before that segment, and the inner block that contains the segment.
    kept: Vec<(Range<u32>, Option<Placed<Solid>>)>,
    block: BlockId,
    /// The item that is looked at.
    at: u32,
    /// The segments from that item on that are still kept.
    left: u128,
}

/// Nodes being made of items.
#[derive(Default)]
struct UnfinishedNodes {
    items: Range<u32>,
    /// The block placed after the items, and its node.
    last: Option<(Placed<Solid>, u32)>,
    run: Run,
    /// The triangles of the present item, the next one last.
    lines: Vec<SceneLine>,
    /// The nodes of the present level, which are not in another node yet.
    row: Vec<u32>,
    /// The number of nodes in `row` that are in a node of `above`.
    done: usize,
    /// The nodes of the level above.
    above: Vec<u32>,
}

/// The units of work for making a node.
const NODE_WORK: u64 = 64;
/// The units of work for making a line or a link.
const ITEM_WORK: u64 = 4;
/// The units of work for looking at an item on the way to a cut.
const LOOK_WORK: u64 = 1;

impl Scene {
    /// Reserves the memory that the drawing has counted for its scene, so that no list grows.
    fn reserve(&mut self, size: SceneSize) {
        self.nodes.reserve_exact(size.nodes);
        self.links.reserve_exact(size.links);
        self.lines.reserve_exact(size.lines);
        self.samples.reserve_exact(size.nodes * self.kept);
    }

    /// An empty scene for a drawing.
    pub(super) fn new(drawing: &Drawing<Solid>) -> Self {
        let mut styles = drawing.styles.clone();
        styles.push(StyleChange::NONE);
        let kept = SceneSize::samples(drawing.memoised);
        Self { styles, memoised: drawing.memoised, kept, ..Self::default() }
    }

    /// Shows the first `upto` segments and the polygons before the next, or all.
    pub(super) fn show(&mut self, upto: Option<u128>) {
        self.upto = upto;
        if !matches!(self.stage, Stage::Blocks) {
            (self.stage, self.unfinished) = (Stage::Show, None);
        }
    }

    /// Goes on making nodes, until the scene can be shown.
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
        if self.blocks.is_empty() && self.unfinished.is_none() {
            self.reserve(drawing.scene);
        }
        let Some(block) = drawing.blocks.get(self.blocks.len()) else {
            self.whole = [self.nodes.len(), self.links.len(), self.lines.len()];
            self.stage = Stage::Show;
            return;
        };
        let mut unfinished = self.unfinished.take().unwrap_or_else(|| UnfinishedNodes::new(block.items.clone(), None));
        if self.contents(drawing, &mut unfinished, meter) == Progress::More {
            self.unfinished = Some(unfinished);
            return;
        }
        meter.charge(1);
        let node = unfinished.node();
        if let Some(node) = node.and_then(|node| self.nodes.get_mut(node as usize)) {
            // The drawing's ball around the block may be tighter than the ball around the contents' balls.
            if block.hull.radius < node.summary.radius {
                (node.summary.centre, node.summary.radius) = (block.hull.centre(), block.hull.radius);
            }
        }
        self.blocks.push(node);
    }

    /// Shows all, or starts the descent to the first segment that is left out: each block on the way gets a node with
    /// the items before that segment.
    fn start_showing(&mut self, drawing: &Drawing<Solid>) -> Stage {
        let [nodes, links, lines] = self.whole;
        self.nodes.truncate(nodes);
        self.links.truncate(links);
        self.lines.truncate(lines);
        self.samples.truncate(nodes * self.kept);
        self.means.truncate(nodes * self.entries as usize);
        self.wholes.truncate(nodes);
        self.root = drawing.root.and_then(|root| self.blocks.get(root.0 as usize).copied().flatten());
        self.one = Amount::ONE.of(self.count(self.root));
        self.shown = Stretch { from: 0.0, size: 1.0 };
        let upto = self.upto.filter(|&upto| upto < drawing.segment_count());
        match upto.zip(drawing.root) {
            Some((left, block)) => Stage::Cut(CutPath::new(drawing, block, left)),
            None => Stage::Ready,
        }
    }

    /// Goes on with the descent to the first segment that is left out.
    fn cut(&mut self, drawing: &Drawing<Solid>, mut way: CutPath, meter: &mut Meter) -> Stage {
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

    /// Goes on with the nodes of the items before that segment.
    fn inside(&mut self, drawing: &Drawing<Solid>, mut way: CutPath, inside: Option<u32>, meter: &mut Meter) -> Stage {
        let mut unfinished = match (self.unfinished.take(), way.kept.last()) {
            (Some(unfinished), _) => unfinished,
            (None, Some((items, placed))) => UnfinishedNodes::new(items.clone(), placed.zip(inside)),
            (None, None) => {
                let all = self.count(self.root);
                self.root = inside;
                self.shown = Stretch { from: 0.0, size: self.count(self.root).of(all) };
                return Stage::Ready;
            }
        };
        if self.contents(drawing, &mut unfinished, meter) == Progress::More {
            self.unfinished = Some(unfinished);
            return Stage::Inside(way, inside);
        }
        way.kept.pop();
        Stage::Inside(way, unfinished.node())
    }

    fn count(&self, node: Option<u32>) -> Amount {
        node.and_then(|node| self.nodes.get(node as usize)).map_or(Amount::default(), |node| node.summary.count)
    }

    /// Goes on with the unfinished nodes.
    fn contents(&mut self, drawing: &Drawing<Solid>, unfinished: &mut UnfinishedNodes, meter: &mut Meter) -> Progress {
        let same = self.styles.len() as u32 - 1;
        while !meter.is_spent() {
            if unfinished.run.len() == WIDTH {
                meter.charge(NODE_WORK);
                unfinished.row.push(self.node(core::mem::take(&mut unfinished.run)));
            } else if let Some(line) = unfinished.lines.pop() {
                meter.charge(ITEM_WORK);
                unfinished.run.add_line(line);
            } else if let Some(item) = unfinished.items.next() {
                meter.charge(self.add(drawing, unfinished, &drawing.items[item as usize]));
            } else if let Some((placed, node)) = unfinished.last.take() {
                unfinished.run.add_link(self.link(&placed, node), self.count(Some(node)));
            } else if unfinished.run.len() > 0 {
                meter.charge(NODE_WORK);
                unfinished.row.push(self.node(core::mem::take(&mut unfinished.run)));
            } else if unfinished.row.len() <= 1 {
                return Progress::Done;
            } else if unfinished.done < unfinished.row.len() {
                meter.charge(NODE_WORK);
                let mut run = Run::default();
                for &node in unfinished.row[unfinished.done..].iter().take(WIDTH) {
                    run.add_link(self.same(node, same), self.count(Some(node)));
                }
                unfinished.done += run.len();
                unfinished.above.push(self.node(run));
            } else {
                (unfinished.row, unfinished.done) = (core::mem::take(&mut unfinished.above), 0);
            }
        }
        Progress::More
    }

    /// Adds an item to the unfinished nodes. Returns the units of work. A block that shows nothing, such as polygons
    /// without an area, has no node.
    fn add(&self, drawing: &Drawing<Solid>, unfinished: &mut UnfinishedNodes, item: &Item<Solid>) -> u64 {
        match item {
            Item::Stroke(stroke) => unfinished.run.add_line(SceneLine::new([stroke.from, stroke.to], stroke.style.0)),
            Item::Polygon(polygon) => {
                let vertices = drawing.vertices_of(polygon);
                let triangles = triangulate(vertices);
                let corners = triangles.corners.into_iter().rev().map(|corners| corners.map(|corner| vertices[corner]));
                unfinished.lines.extend(corners.map(|corners| SceneLine::face(corners, polygon.style.0)));
                return ITEM_WORK * vertices.len() as u64 + triangles.work;
            }
            Item::Block(placed) => {
                if let Some(node) = self.blocks[placed.block.0 as usize] {
                    unfinished.run.add_link(self.link(placed, node), self.count(Some(node)));
                }
            }
        }
        ITEM_WORK
    }

    fn link(&self, placed: &Placed<Solid>, node: u32) -> Link {
        let own = &self.nodes[node as usize].summary;
        let columns = placed.heading.columns();
        Link {
            node,
            style: placed.style.0,
            at: placed.at,
            axes: columns.map(|column| column.map(|c| c * placed.scale)),
            widest: self.styles[placed.style.0 as usize].width.then(own.widest),
            // Limited, so that sums stay finite.
            length: (own.length * placed.scale as f32).min(1e30),
            area: (own.area * (placed.scale * placed.scale) as f32).min(1e30),
            bundle: own.bundle.turned(&columns),
            same: false,
            before: 0.0,
            part: 0.0,
        }
    }

    /// The style of a main line made of this line: the longest side of a triangle has no width.
    fn style_of(&self, line: &SceneLine) -> StyleChange {
        let style = self.styles[line.style as usize];
        let none = WidthChange { factor: 0.0, offset: 0.0 };
        if line.corner.is_some() { StyleChange { width: none, next: Some(none), ..style } } else { style }
    }

    /// The sample strokes of a node, by direction.
    pub(super) fn samples(&self, node: u32) -> &[SampleStroke] {
        let first = node as usize * self.kept;
        self.samples.get(first..first + self.kept).unwrap_or_default()
    }
}

impl UnfinishedNodes {
    fn new(items: Range<u32>, last: Option<(Placed<Solid>, u32)>) -> Self {
        Self { items, last, ..Self::default() }
    }

    /// The node that contains all others, when they are done; `None` if there is none.
    fn node(&self) -> Option<u32> {
        self.row.first().copied()
    }
}

impl CutPath {
    fn new(drawing: &Drawing<Solid>, block: BlockId, left: u128) -> Self {
        Self { kept: vec![], block, at: drawing.blocks[block.0 as usize].items.start, left }
    }
}

/// The contents of the next node.
#[derive(Default)]
struct Run {
    links: Vec<Link>,
    lines: Vec<SceneLine>,
    /// The number of segments before each link, and before each line.
    before: [Vec<Amount>; 2],
    /// The number of segments.
    count: Amount,
}

impl Run {
    fn len(&self) -> usize {
        self.links.len() + self.lines.len()
    }

    /// Adds a link to a node of `count` segments.
    fn add_link(&mut self, link: Link, count: Amount) {
        self.links.push(link);
        self.before[0].push(self.count);
        self.count = self.count.plus(count);
    }

    /// Adds a segment or a triangle.
    fn add_line(&mut self, line: SceneLine) {
        self.before[1].push(self.count);
        if line.corner.is_none() {
            self.count = self.count.plus(Amount::ONE);
        }
        self.lines.push(line);
    }
}
