//! A drawing made ready for being looked at in space: every block becomes nodes of at most 16 contents, with a ball
//! around each, and with what is seen of it where it is too small to be looked into.

use super::light::Bundle;
use super::path::Stretch;
use crate::render::{Amount, Choice, Shade};
use crate::rotation::{Vector, combine, cross, dot, minus, norm};
use crate::triangulate::triangulate;
use crate::{BlockId, ColourBy, Drawing, Item, Placed, Solid, Style, StyleChange, WidthChange};

/// Contents of a node at most.
pub(super) const WIDTH: usize = 16;

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
    /// By block: its node.
    blocks: Vec<u32>,
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
pub(super) const SAMPLES: usize = 16;
/// The same where every node stands for itself, so that there are many.
const FEW_SAMPLES: usize = 8;
/// Contents that are looked at for a sample.
const TRIES: usize = 2;
/// More contents than anybody can look into.
const MANY: f32 = 1e30;
/// Mean colours that are remembered at most.
const MEANS: usize = 1 << 21;

impl Scene {
    pub(super) fn new(drawing: &Drawing<Solid>) -> Self {
        let mut styles = drawing.styles.clone();
        styles.push(StyleChange::NONE);
        let kept = if drawing.memoised { SAMPLES } else { FEW_SAMPLES };
        let mut scene = Self { styles, memoised: drawing.memoised, kept, ..Self::default() };
        scene.blocks.reserve_exact(drawing.blocks.len());
        for (id, block) in drawing.blocks.iter().enumerate() {
            let node = scene.contents(drawing, drawing.items_of(BlockId(id as u32)), None).unwrap_or_default();
            if let Some(node) = scene.nodes.get_mut(node as usize) {
                // The drawing knows a tighter ball than one around balls.
                if block.hull.radius < node.own.radius {
                    (node.own.centre, node.own.radius) = (block.hull.centre(), block.hull.radius);
                }
            }
            scene.blocks.push(node);
        }
        scene.whole = [scene.nodes.len(), scene.links.len(), scene.lines.len()];
        scene.show(drawing, None);
        scene
    }

    /// Shows the first `upto` segments and the polygons before them, or all: on the way down to the first that is left
    /// out every block becomes a node with what is before it.
    pub(super) fn show(&mut self, drawing: &Drawing<Solid>, upto: Option<u128>) {
        let [nodes, links, lines] = self.whole;
        self.nodes.truncate(nodes);
        self.links.truncate(links);
        self.lines.truncate(lines);
        self.samples.truncate(nodes * self.kept);
        self.means.truncate(nodes * self.entries as usize);
        self.root = drawing.root.and_then(|root| self.blocks.get(root.0 as usize).copied());
        let all = self.count(self.root);
        self.one = Amount::ONE.of(all);
        let (Some(mut left), Some(mut block)) = (upto.filter(|&upto| upto < drawing.segment_count()), drawing.root)
        else {
            self.shown = Stretch { from: 0.0, size: 1.0 };
            return;
        };
        let mut way = Vec::new();
        loop {
            let items = drawing.items_of(block);
            let (cut, within) = drawing.before(items, left);
            left = within;
            let (before, after) = items.split_at(cut);
            let Some(Item::Block(placed)) = after.first() else {
                way.push((before, None));
                break;
            };
            way.push((before, Some(placed)));
            block = placed.block;
        }
        self.root = way
            .into_iter()
            .rev()
            .fold(None, |inside, (before, placed)| self.contents(drawing, before, placed.zip(inside)));
        self.shown = Stretch { from: 0.0, size: self.count(self.root).of(all) };
    }

    fn count(&self, node: Option<u32>) -> Amount {
        node.and_then(|node| self.nodes.get(node as usize)).map_or(Amount::default(), |node| node.own.count)
    }

    /// Makes nodes of a block's contents, the last of which may be placed where another block would be; the one that
    /// holds them all, if there are any.
    fn contents(
        &mut self,
        drawing: &Drawing<Solid>,
        items: &[Item<Solid>],
        last: Option<(&Placed<Solid>, u32)>,
    ) -> Option<u32> {
        let mut row: Vec<u32> = Vec::new();
        let mut run = Run::default();
        for item in items {
            let mut lines = Vec::new();
            match item {
                Item::Stroke(stroke) => lines.push(Line::new([stroke.from, stroke.to], stroke.style.0)),
                Item::Polygon(polygon) => {
                    let vertices = drawing.vertices_of(polygon);
                    let triangles = triangulate(vertices).map(|(_, triangles)| triangles).unwrap_or_default();
                    let corners = triangles.into_iter().map(|corners| corners.map(|corner| vertices[corner]));
                    lines.extend(corners.map(|corners| Line::face(corners, polygon.style.0)));
                }
                Item::Block(placed) => {
                    let node = self.blocks[placed.block.0 as usize];
                    run.hold(self.link(placed, node), self.count(Some(node)));
                    self.full(&mut run, &mut row);
                }
            }
            for line in lines {
                run.draw(line);
                self.full(&mut run, &mut row);
            }
        }
        if let Some((placed, node)) = last {
            run.hold(self.link(placed, node), self.count(Some(node)));
        }
        if !(run.links.is_empty() && run.lines.is_empty()) {
            row.push(self.node(run));
        }
        let same = self.styles.len() as u32 - 1;
        while row.len() > 1 {
            let rows = row.chunks(WIDTH).map(|nodes| {
                let mut run = Run::default();
                nodes.iter().for_each(|&node| run.hold(self.same(node, same), self.count(Some(node))));
                self.node(run)
            });
            row = rows.collect();
        }
        row.first().copied()
    }

    /// Makes a node of a run that has as many contents as a node may.
    fn full(&mut self, run: &mut Run, row: &mut Vec<u32>) {
        if run.links.len() + run.lines.len() == WIDTH {
            row.push(self.node(core::mem::take(run)));
        }
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

    /// Makes the mean colours for a style, unless they are there.
    pub(super) fn dye(&mut self, style: &Style) {
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
        for node in self.nodes.get(known..).unwrap_or_default() {
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
