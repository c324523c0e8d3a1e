//! Making nodes and their summaries.

use super::*;

impl Scene {
    /// A link to a run of the same block.
    pub(super) fn same(&self, node: u32, style: u32) -> Link {
        let Summary { widest, length, area, bundle, .. } = self.nodes[node as usize].summary;
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Link { node, style, at: [0.0; 3], axes, widest, length, area, bundle, same: true, before: 0.0, part: 0.0 }
    }

    /// Sets for each content the part of the node's segments that comes before.
    fn set_path(&self, run: &mut Run) {
        let count = run.count;
        for (link, before) in run.links.iter_mut().zip(&run.before[0]) {
            link.before = before.of(count);
            link.part = self.count(Some(link.node)).of(count);
        }
        for (line, before) in run.lines.iter_mut().zip(&run.before[1]) {
            line.before = before.of(count) as f32;
        }
    }

    /// Adds a node. Returns its number.
    pub(super) fn node(&mut self, mut run: Run) -> u32 {
        self.set_path(&mut run);
        let mut balls = [[0.0; WIDTH]; 4];
        let mut widest = WidthChange { factor: 0.0, offset: 0.0 };
        let (mut length, mut area, mut bundle) = (0.0_f32, 0.0_f32, Bundle::default());
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let mut main_lines: Vec<MainLine> = Vec::with_capacity(WIDTH);
        let mut put = |lane: usize, centre: Vector, radius: f64| {
            for i in 0..3 {
                balls[i][lane] = centre[i] as f32;
                low[i] = low[i].min(centre[i] - radius);
                high[i] = high[i].max(centre[i] + radius);
            }
            // A little larger, because centres are rounded.
            balls[3][lane] = (radius * (1.0 + 1e-6) + 1e-7) as f32;
        };
        for (lane, link) in run.links.iter().enumerate() {
            let own = &self.nodes[link.node as usize].summary;
            let [x, y, z] = combine(&link.axes, own.centre);
            let scale = if link.same { 1.0 } else { norm(link.axes[0]) };
            put(lane, [link.at[0] + x, link.at[1] + y, link.at[2] + z], own.radius * scale);
            main_lines.push(self.main_line_of(link, &own.main_line));
            widest = widest.widest(link.widest);
            length += link.length;
            area += link.area;
            bundle.add(&link.bundle, link.length);
        }
        for (lane, line) in run.lines.iter().enumerate() {
            let [from, to] = [line.from, line.to].map(|end| end.map(f64::from));
            let half = [0, 1, 2].map(|i| 0.5 * (to[i] - from[i]));
            let centre = [0, 1, 2].map(|i| from[i] + half[i]);
            let mut main_line = MainLine {
                from,
                to,
                style: self.style_of(line),
                bend: 0.0,
                reach: 0.0,
                before: f64::from(line.before),
            };
            if let Some(corner) = line.corner {
                let corner = corner.map(f64::from);
                put(run.links.len() + lane, centre, norm(half).max(norm(minus(corner, centre))));
                main_line.reach = distance(&main_line, corner);
                area += line.area();
            } else {
                put(run.links.len() + lane, centre, norm(half));
                widest = widest.widest(main_line.style.width);
            }
            main_lines.push(main_line);
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
        let main_line = longest(&main_lines);
        let needs = run.links.iter().map(|link| self.nodes[link.node as usize].summary.need);
        let need = (needs.sum::<f32>() + contents as f32).min(MAX_NEED);
        let [sampled, faces] = self.sample(&run, length);
        let summary =
            Summary { centre, radius, length, area, bundle, widest, main_line, need, sampled, faces, count: run.count };
        self.nodes.push(SceneNode {
            balls,
            first_link: self.links.len() as u32,
            first_line: self.lines.len() as u32,
            links: run.links.len() as u8,
            lines: run.lines.len() as u8,
            summary,
        });
        self.links.extend(run.links);
        self.lines.extend(run.lines);
        self.nodes.len() as u32 - 1
    }

    /// The main line of a node inside another, in the outer frame.
    pub(super) fn main_line_of(&self, link: &Link, main_line: &MainLine) -> MainLine {
        let [from, to] = [main_line.from, main_line.to].map(|end| {
            let [x, y, z] = combine(&link.axes, end);
            [link.at[0] + x, link.at[1] + y, link.at[2] + z]
        });
        let scale = if link.same { 1.0 } else { norm(link.axes[0]) };
        MainLine {
            from,
            to,
            style: self.styles[link.style as usize].then(&main_line.style),
            bend: main_line.bend,
            reach: main_line.reach * scale,
            before: link.before + link.part * main_line.before,
        }
    }

    /// Chooses the sample strokes of a new node from those of its contents. Each stands for a direction, because only
    /// the outer strokes of a crowd can be seen. Two random contents are compared, weighted by length, and the one
    /// whose sample lies farther in the direction gives its sample. Returns the mean length, and the part of triangles.
    pub(super) fn sample(&mut self, run: &Run, length: f32) -> [f32; 2] {
        let kept = self.kept;
        let nothing = SampleStroke::new([[0.0; 3]; 2], None, &StyleChange::NONE, 0.0);
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
        let (mut sum, mut faces) = (0.0, 0.0);
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
                        let outer = |point: [f32; 3]| {
                            let [x, y, z] = combine(&link.axes, point.map(f64::from));
                            [link.at[0] + x, link.at[1] + y, link.at[2] + z].map(|c| c as f32)
                        };
                        let style = self.styles[link.style as usize].then(&sample.style());
                        let before = link.before + link.part * f64::from(sample.before);
                        let ends = [sample.from, sample.to].map(outer);
                        SampleStroke::new(ends, sample.corner().map(outer), &style, before as f32)
                    }
                    None => match run.lines.get(lane - run.links.len()) {
                        Some(&SceneLine { from, to, corner, style, before }) => {
                            SampleStroke::new([from, to], corner, &self.styles[style as usize], before)
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
            faces += f32::from(sample.corner().is_some());
            self.samples.push(sample);
        }
        [sum, faces].map(|sum| sum / kept as f32)
    }
}

/// The main line of a node, given the main line of each content.
fn longest(main_lines: &[MainLine]) -> MainLine {
    let mut all = main_lines.iter();
    let Some(mut main_line) = all.next().copied() else {
        return MainLine { from: [0.0; 3], to: [0.0; 3], style: StyleChange::NONE, bend: 0.0, reach: 0.0, before: 0.0 };
    };
    for next in all {
        let way = minus(next.to, next.from);
        let long = norm(way);
        let length = norm(minus(next.to, main_line.from));
        let bend = if length > 0.0 { 1.0 - (1.0 - next.bend) * long / length } else { 0.0 };
        let whole = MainLine { to: next.to, style: next.style, bend, ..main_line };
        let goes_on = norm(minus(next.from, main_line.to)) <= STRAIGHT * long
            && main_line.style.goes_on(&next.style)
            && distance(&whole, main_line.to) <= STRAIGHT * long
            && length > norm(minus(main_line.to, main_line.from));
        if goes_on {
            main_line = whole;
        } else if long > norm(minus(main_line.to, main_line.from)) * LONGER {
            main_line = *next;
        }
    }
    let reach =
        main_lines.iter().map(|own| distance(&main_line, own.from).max(distance(&main_line, own.to)) + own.reach);
    MainLine { reach: reach.fold(0.0, f64::max), ..main_line }
}

/// The cosine and the sine of multiples of the golden angle.
#[rustfmt::skip]
const TURNS: [[f64; 2]; SAMPLE_STROKES] = [
    [1.000000, 0.000000], [-0.737369, 0.675490], [0.087426, -0.996171], [0.608439, 0.793601],
    [-0.984713, -0.174182], [0.843755, -0.536728], [-0.259604, 0.965715], [-0.460907, -0.887448],
    [0.939321, 0.343039], [-0.924346, 0.381556], [0.423846, -0.905734], [0.299284, 0.954164],
    [-0.865211, -0.501408], [0.976676, -0.214719], [-0.575129, 0.818062], [-0.128511, -0.991708],
];

/// The direction that a sample stroke stands for: evenly spread unit vectors along a spiral from pole to pole.
pub(in crate::space) fn direction(number: usize, count: usize) -> Vector {
    let y = 1.0 - (2.0 * number as f64 + 1.0) / count as f64;
    let [c, s] = TURNS[number % SAMPLE_STROKES];
    let level = (1.0 - y * y).sqrt();
    [c * level, y, s * level]
}

/// The distance of a point from a main line.
fn distance(main_line: &MainLine, point: Vector) -> f64 {
    let (way, to) = (minus(main_line.to, main_line.from), minus(point, main_line.from));
    let square = dot(way, way);
    let t = if square > 0.0 { (dot(way, to) / square).clamp(0.0, 1.0) } else { 0.0 };
    norm([0, 1, 2].map(|i| to[i] - t * way[i]))
}
