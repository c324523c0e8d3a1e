//! Hidden lines against plain geometry.

mod pierce;
pub(super) mod touch;

use super::body::{Facet, Tube, winding};
use super::fill::fill;
use super::grid::Grid;
use super::hidden;
use super::outline::outline;
use super::runs::{Part, Runs};
use super::scene::{Body, Joints, Scene, Shape};
use super::sight::{Place, Sight};
use super::span::{Span, rest};
use super::visible::{On, Visible};
use crate::options::PlotOptions;
use crate::page::Page;
use crate::sheet::Sheet;
use lsystem_base::{Limits, Meter};
use lsystem_drawing::{Drawing, Mark, System, draw};
use lsystem_syntax::Definition;

/// Pseudo-random numbers.
pub(super) struct Chance(pub(super) u64);

impl Chance {
    /// A number from `low` to `high`.
    pub(super) fn number(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 33) as f64 / (1u64 << 31) as f64)
    }

    pub(super) fn below(&mut self, count: u32) -> u32 {
        self.number(0.0, f64::from(count)) as u32
    }

    pub(super) fn place(&mut self, size: f64) -> Place {
        [0, 1, 2].map(|_| self.number(0.0, size))
    }

    pub(super) fn tube(&mut self, size: f64) -> Tube {
        let from = self.place(size);
        // Some tubes are short, stand upright on the sheet or have a sharp end.
        let to = match self.below(6) {
            0 => [from[0], from[1], from[2] + self.number(-5.0, 5.0)],
            1 => from,
            _ => [0, 1, 2].map(|axis| from[axis] + self.number(-8.0, 8.0)),
        };
        let radii = [self.number(0.01, 3.0), if self.below(4) == 0 { 0.0 } else { self.number(0.01, 3.0) }];
        Tube { ends: [from, to], radii }
    }
}

pub(super) fn tube(body: &Body) -> Option<Tube> {
    if let Shape::Tube(tube) = body.shape { Some(tube) } else { None }
}

/// How far a point lies behind the front of a tube, or before it (negative): as the nearest of many balls. `None` if the
/// point is beside the tube.
fn behind(tube: &Tube, [x, y, depth]: Place) -> Option<f64> {
    let balls = (0..=2000).map(|number| {
        let part = f64::from(number) / 2000.0;
        let centre = [0, 1, 2].map(|axis| tube.ends[0][axis] + part * (tube.ends[1][axis] - tube.ends[0][axis]));
        (centre, tube.radii[0] + part * (tube.radii[1] - tube.radii[0]))
    });
    balls
        .filter_map(|([cx, cy, cz], radius)| {
            let square = radius * radius - (x - cx) * (x - cx) - (y - cy) * (y - cy);
            (square > 0.0).then(|| cz + square.sqrt() - depth)
        })
        .reduce(f64::max)
}

#[test]
fn tubes_hide_what_many_balls_hide() {
    let mut chance = Chance(1);
    let (mut hidden, mut visible, mut cut) = (0, 0, 0);
    for _ in 0..400 {
        let tube = chance.tube(10.0);
        let ends = [chance.place(12.0), chance.place(12.0)];
        let line = Sight::new(ends).unwrap();
        let span = tube.shadow(&line);
        cut += usize::from(!span.within(0.0, 1.0).is_empty());
        for number in 0..=100 {
            let place = f64::from(number) / 100.0;
            let is_in = |place: f64| span.low < place && place < span.high;
            // Near the ends of the stretch, the balls are too few.
            if is_in(place - 4e-3) != is_in(place + 4e-3) {
                continue;
            }
            let is_hidden = behind(&tube, line.at(place)).is_some_and(|depth| depth > 0.0);
            assert_eq!(is_in(place), is_hidden, "{tube:?} {ends:?} {place} {span:?}");
            *if is_hidden { &mut hidden } else { &mut visible } += 1;
        }
    }
    assert!(hidden > 2000 && visible > 2000 && cut > 50, "{hidden} {visible} {cut}");
}

#[test]
fn polygons_hide_what_lies_behind_their_planes() {
    let mut chance = Chance(2);
    let (mut hidden, mut visible) = (0, 0);
    for _ in 0..400 {
        let plane =
            Facet { depth: chance.number(2.0, 8.0), slope: [chance.number(-1.0, 1.0), chance.number(-1.0, 1.0)] };
        // Such outlines cross themselves.
        let vertices: Vec<Place> = (0..3 + chance.below(5))
            .map(|_| {
                let [x, y, _] = chance.place(10.0);
                [x, y, plane.at([x, y])]
            })
            .collect();
        let line = Sight::new([chance.place(10.0), chance.place(10.0)]).unwrap();
        let mut spans = vec![];
        plane.shadows(&vertices, Part(Runs::NONE, 0), &line, 0.0, &mut vec![], &mut spans);
        for number in 0..100 {
            let place = (f64::from(number) + 0.5) / 100.0;
            let [x, y, depth] = line.at(place);
            let margin = spans.iter().flat_map(|span| [span.low, span.high]).map(|end| (end - place).abs());
            if margin.fold(1.0, f64::min) < 1e-9 {
                continue;
            }
            let is_hidden = plane.at([x, y]) > depth && winding(&vertices, [x, y]) != 0;
            assert_eq!(spans.iter().any(|span| span.low < place && place < span.high), is_hidden, "{spans:?} {place}");
            *if is_hidden { &mut hidden } else { &mut visible } += 1;
        }
    }
    assert!(hidden > 2000 && visible > 2000, "{hidden} {visible}");
}

/// A scene of random strokes and polygons. Some tubes go on where another ends.
pub(super) fn scene(chance: &mut Chance, count: u32, is_solid: bool) -> Scene {
    let mut scene = Scene { same: 1e-3, is_solid, ..Scene::default() };
    for mark in 0..count {
        let layer = chance.below(2);
        match chance.below(4) {
            0 => {
                let ends = [chance.place(40.0), chance.place(40.0)];
                scene.bodies.push(Body { mark, layer, shape: Shape::Line(ends) });
            }
            1 => {
                let corner = chance.place(40.0);
                let points: Vec<Place> = (0..3 + chance.below(4))
                    .map(|_| {
                        [0, 1, 2].map(|axis| {
                            corner[axis] + chance.number(-6.0, 6.0) * if is_solid || axis < 2 { 1.0 } else { 0.0 }
                        })
                    })
                    .collect();
                scene.polygon(mark, layer, &points, &mut Meter::new(0)).unwrap();
            }
            _ => {
                let mut tube = chance.tube(40.0);
                let before = scene.bodies.last().and_then(self::tube).filter(|_| chance.below(2) == 0);
                if let Some(before) = before {
                    (tube.ends[0], tube.radii[0]) = (before.ends[1], before.radii[1]);
                }
                scene.bodies.push(Body { mark, layer, shape: Shape::Tube(tube) });
            }
        }
    }
    if !is_solid {
        scene.joints = Joints::new(&mut scene.bodies, false, &mut Meter::new(0)).unwrap();
        scene.stack(&mut Meter::new(0)).unwrap();
    }
    scene
}

/// The lines of a body.
fn lines(scene: &Scene, body: &Body) -> Vec<[Place; 2]> {
    match &body.shape {
        Shape::Line(ends) => vec![*ends],
        Shape::Tube(tube) => {
            let mut edges = vec![];
            outline(tube, 0.3, &mut edges);
            edges.iter().map(|edge| edge.ends).collect()
        }
        Shape::Face { vertices, .. } => {
            let vertices = &scene.vertices[vertices.start as usize..vertices.end as usize];
            vertices.iter().copied().zip(vertices.iter().copied().cycle().skip(1)).map(|(a, b)| [a, b]).collect()
        }
    }
}

/// The visible parts of a line, naively: every body is tried.
fn parts(scene: &Scene, number: u32, line: &Sight) -> Vec<Span> {
    let own = &scene.bodies[number as usize];
    let mut hidden = vec![];
    for other in (0..).take(scene.bodies.len()).filter(|&other: &u32| scene.bodies[other as usize].mark != own.mark) {
        scene.shadows(number, other, line, &mut vec![], &mut hidden);
    }
    for other in
        scene.bodies.iter().filter(|other| !scene.is_solid && other.layer == own.layer && other.mark != own.mark)
    {
        let ends = |body: &Body| match body.shape {
            Shape::Line(ends) | Shape::Tube(Tube { ends, .. }) => ends.map(|[x, y, _]| [x, y]).to_vec(),
            Shape::Face { .. } => vec![],
        };
        let meets = ends(own).iter().any(|end| ends(other).contains(end));
        if let Some(tube) = tube(other).filter(|_| meets) {
            hidden.push(tube.grown(-scene.same).outline(line));
        }
    }
    hidden.iter_mut().for_each(|span| *span = span.within(0.0, 1.0));
    hidden.retain(|span| !span.is_empty());
    rest(&mut hidden).collect()
}

#[test]
fn the_grid_finds_all_that_hides_a_line() {
    let mut chance = Chance(3);
    let (mut whole, mut cut, mut none) = (0, 0, 0);
    for round in 0..24 {
        let scene = scene(&mut chance, 5 + 8 * round, round % 2 == 0);
        let grid = Grid::new(&scene, &mut Meter::new(0)).unwrap();
        let mut visible = Visible::new(&scene, &grid);
        for (number, body) in (0..).zip(&scene.bodies) {
            for ends in lines(&scene, body) {
                let Some(line) = Sight::new(ends) else { continue };
                let expected = parts(&scene, number, &line);
                visible.find(On { number, faces: None }, ends, &line, &mut Meter::new(0)).unwrap();
                let found: Vec<Span> = visible.parts().collect();
                let length = |spans: &[Span]| spans.iter().map(|span| span.high - span.low).sum::<f64>();
                assert!((length(&found) - length(&expected)).abs() < 1e-6, "{number} {ends:?} {found:?} {expected:?}");
                let is_in = |span: &Span| {
                    expected.iter().any(|other| other.low < span.low + 1e-6 && span.high < other.high + 1e-6)
                };
                assert!(found.iter().all(is_in), "{number} {ends:?} {found:?} {expected:?}");
                *match length(&found) {
                    length if length > 1.0 - 1e-9 => &mut whole,
                    length if length > 0.0 => &mut cut,
                    _ => &mut none,
                } += 1;
            }
        }
    }
    assert!(whole > 1000 && cut > 1000 && none > 1000, "{whole} {cut} {none}");
}

#[test]
fn shades_of_a_stick_go_on_where_the_next_stick_begins() {
    // Both lead towards the viewer.
    let ends = [[5.0, 5.0, 0.0], [15.0, 5.0, 4.0], [25.0, 5.0, 8.0]];
    let tubes = [0, 1].map(|first| Tube { ends: [ends[first], ends[first + 1]], radii: [2.0; 2] });
    let mut scene = Scene { same: 6e-4, is_solid: true, ..Scene::default() };
    for (mark, tube) in (0..).zip(tubes) {
        scene.bodies.push(Body { mark, layer: 0, shape: Shape::Tube(tube) });
    }
    for (own, other) in [(0, 1), (1, 0)] {
        let mut edges = vec![];
        let filled = fill(&scene, &scene.bodies[own], 0.05, 1000, &mut edges, &mut Meter::new(0)).unwrap();
        assert!(filled.is_some() && edges.len() >= 9, "{edges:?}");
        // Of each line, the first part and the last one are in the round ends.
        for edge in edges.iter().skip(1).step_by(3) {
            let line = Sight::new(edge.ends).unwrap();
            let span = tubes[other].grown(-scene.same).shadow(&line).within(0.0, 1.0);
            assert!(span.high - span.low < 0.02 || span.is_empty(), "{edge:?} {span:?}");
        }
    }
}

/// A drawing in the plane, with strokes and polygons of four colours.
fn leaves(seed: u64) -> (Drawing, Definition) {
    let definition = Definition {
        axiom: "X".into(),
        rules: "X -> !(w)F[+X]'F[-X]'L\nL -> {-F.+F.+F.-|-F.+F.+F.}\nw = 0.3".into(),
        angle: 31.0 + seed as f64,
        iterations: 4,
        ..Definition::default()
    };
    let system = System::new(&definition).unwrap_or_else(|diagnostics| panic!("{diagnostics:?}"));
    (draw(&system, definition.iterations, &Limits::default()).unwrap(), definition)
}

/// The painter's picture: by pixel the colour of the last mark that covers its middle.
fn painted(drawing: &Drawing, definition: &Definition, page: &Page, pen: f64, side: f64) -> Vec<Vec<Option<[u8; 3]>>> {
    let [width, height] = page.size.map(|length| (length / side) as usize);
    let mut picture = vec![vec![None; width]; height];
    for mark in drawing.marks_in(page.frame, page.step) {
        let (shape, tint) = match mark {
            Mark::Segment(segment, tint) => {
                let ends = [segment.from, segment.to].map(|[x, y]| [x, page.size[1] - y, 0.0]);
                let radii = [segment.width, segment.end_width].map(|width| width.max(pen) / 2.0);
                (Ok(Tube { ends, radii }), tint)
            }
            Mark::Polygon(vertices, tint) => {
                (Err(vertices.into_iter().map(|[x, y]| [x, page.size[1] - y, 0.0]).collect::<Vec<_>>()), tint)
            }
        };
        let rgb = definition.style.colour_of(tint).rgb;
        for (row, pixels) in picture.iter_mut().enumerate() {
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let at = [(column as f64 + 0.5) * side, (row as f64 + 0.5) * side];
                let is_in = match &shape {
                    Ok(tube) => behind_slowly(tube, at),
                    Err(vertices) => winding(vertices, at) != 0,
                };
                if is_in {
                    *pixel = Some(rgb);
                }
            }
        }
    }
    picture
}

/// Whether a point is within the outline of a tube: the least distance to its discs, by trying many.
fn behind_slowly(tube: &Tube, [x, y]: [f64; 2]) -> bool {
    (0..=64).any(|number| {
        let part = f64::from(number) / 64.0;
        let [dx, dy] =
            [0, 1].map(|axis| [x, y][axis] - tube.ends[0][axis] - part * (tube.ends[1][axis] - tube.ends[0][axis]));
        let radius = tube.radii[0] + part * (tube.radii[1] - tube.radii[0]);
        dx * dx + dy * dy < radius * radius
    })
}

#[test]
fn lines_are_where_colours_meet_in_the_painters_picture() {
    let (pen, side) = (0.3, 0.25);
    for seed in 0..3 {
        let (drawing, definition) = leaves(seed);
        let options = PlotOptions { pen, hide: true, ..PlotOptions::default() };
        let page = Page::new(&drawing, &Sheet { width: 60.0, height: 60.0, margin: 5.0 }, &options);
        let picture = painted(&drawing, &definition, &page, pen, side);
        let pens = hidden(&drawing, &definition.style, &page, &options, 1_000_000, &mut Meter::new(0)).unwrap();
        let colours = pens.colours.clone();
        let (pieces, length) = pens.strokes.finish(&mut Meter::new(0)).unwrap();
        assert!(length > 100.0 && colours.len() > 2, "{length} {colours:?}");
        // The colours of the pixels around a point, and whether a pixel has ink nearby.
        let mut inked = vec![vec![false; picture[0].len()]; picture.len()];
        let (mut beside, mut all) = (0, 0);
        for piece in &pieces {
            let [a, b] = piece.ends;
            for number in 0..=200 {
                let part = f64::from(number) / 200.0;
                let [x, y] = [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis]));
                let [column, row] = [x, y].map(|value| (value / side) as usize);
                let around = (row.saturating_sub(2)..=row + 2)
                    .flat_map(|row| (column.saturating_sub(2)..=column + 2).map(move |column| [row, column]))
                    .filter(|&[row, column]| row < picture.len() && column < picture[0].len());
                let own = Some(colours[piece.layer as usize]);
                let mut is_near = false;
                for [row, column] in around {
                    inked[row][column] = true;
                    is_near |= picture[row][column] == own;
                }
                all += 1;
                beside += usize::from(!is_near);
            }
        }
        assert!(beside * 100 < all, "{beside} of {all}");
        let borders = (1..picture.len()).flat_map(|row| (1..picture[0].len()).map(move |column| [row, column]));
        let mut missed = 0;
        let mut count = 0;
        for [row, column] in borders {
            let own = picture[row][column];
            if picture[row - 1][column] != own || picture[row][column - 1] != own {
                count += 1;
                missed += usize::from(!inked[row][column]);
            }
        }
        assert!(count > 500 && missed == 0, "{missed} of {count}");
    }
}

/// The work to plot a plant of so many steps with broad strokes, and the number of its strokes.
fn work(n: u32) -> (u64, u64) {
    let rules = "A -> !(w)F[+A][-A]FA\nw = 0.7".into();
    let definition = Definition { axiom: "A".into(), rules, angle: 28.0, ..Definition::default() };
    let system = System::new(&definition).unwrap();
    let drawing: Drawing = draw(&system, n, &Limits::default()).unwrap();
    let options = PlotOptions { hide: true, ..PlotOptions::default() };
    let page = Page::new(&drawing, &Sheet::default(), &options);
    let mut meter = Meter::new(0);
    hidden(&drawing, &definition.style, &page, &options, 1_000_000, &mut meter).unwrap();
    (meter.spent(), drawing.segment_count() as u64)
}

#[test]
fn the_work_grows_with_the_strokes_and_not_with_their_pairs() {
    let [few, many] = [7, 10].map(work);
    assert!(few.1 > 2000 && many.1 > 25 * few.1, "{few:?} {many:?}");
    assert!(many.0 < 2 * 27 * few.0 && many.0 < 400 * many.1, "{few:?} {many:?}");
}

#[test]
fn a_way_that_is_drawn_many_times_is_hidden_once() {
    let plot = |n: u32| {
        // Around a square, again and again.
        let (axiom, rules) = ("!(3)F".into(), "F -> F+F".into());
        let definition = Definition { axiom, rules, angle: 90.0, ..Definition::default() };
        let drawing = draw(&System::new(&definition).unwrap(), n, &Limits::default()).unwrap();
        let options = PlotOptions { hide: true, ..PlotOptions::default() };
        let page = Page::new(&drawing, &Sheet::default(), &options);
        let mut meter = Meter::new(0);
        let pens = hidden(&drawing, &definition.style, &page, &options, 1_000_000, &mut meter).unwrap();
        (drawing.segment_count() as u64, meter.spent(), pens.strokes.finish(&mut Meter::new(0)).unwrap())
    };
    let (once, often) = (plot(2), plot(10));
    assert!(once.0 >= 4 && often.0 > 200 * once.0, "{} {}", once.0, often.0);
    assert_eq!(once.2, often.2);
    assert!(often.1 < 40 * often.0, "{} {}", often.0, often.1);
}
