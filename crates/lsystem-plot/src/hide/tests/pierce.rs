//! Lines where bodies pass through each other, against samples of their surfaces.

use super::super::body::{Facet, Tube, winding};
use super::super::grid::Grid;
use super::super::meet::{Face, faces, tube_and_face};
use super::super::meet_tubes::tubes;
use super::super::pierce::Pierce;
use super::super::points::Points;
use super::super::runs::{Part, Runs};
use super::super::scene::Scene;
use super::super::sight::{Place, Sight, cross};
use super::super::visible::{On, Visible};
use super::{Chance, scene, tube};
use crate::options::PlotOptions;
use crate::page::Page;
use crate::pens::Pens;
use crate::sheet::Sheet;
use lsystem_base::{Limits, Meter};
use lsystem_drawing::{Figure, Outlook, System};
use lsystem_syntax::{Definition, Dialect};

/// The side of a square of samples.
const SIDE: f64 = 0.1;
const EXACT: f64 = 0.02;

/// A random polygon in a plane.
fn face(chance: &mut Chance) -> (Facet, Vec<Place>) {
    let mut slope = || chance.number(-1.5, 1.5);
    let slope = [slope(), slope()];
    let plane = Facet { depth: 5.0 - 5.0 * slope[0] - 5.0 * slope[1], slope };
    let vertices = (0..3 + chance.below(4)).map(|_| {
        let [x, y, _] = chance.place(10.0);
        [x, y, plane.at([x, y])]
    });
    let vertices = vertices.collect();
    (plane, vertices)
}

/// The distance of a point of the sheet from lines.
fn distance(lines: &[[Place; 2]], [x, y]: [f64; 2]) -> f64 {
    let to = |[a, b]: &[Place; 2]| {
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let part = (((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        libm::hypot(x - a[0] - part * dx, y - a[1] - part * dy)
    };
    lines.iter().map(to).fold(f64::INFINITY, f64::min)
}

/// Compares lines on a face with samples of its plane: `inside` changes its sign at a line, and nowhere else within the
/// polygons. Returns the numbers of the changes and of the points of lines.
fn compare(
    lines: &[[Place; 2]],
    polygons: &[&[Place]],
    plane: &Facet,
    inside: impl Fn(Place) -> f64,
    slack: f64,
) -> [usize; 2] {
    let at = |[x, y]: [f64; 2]| inside([x, y, plane.at([x, y])]);
    let covers = |at: [f64; 2]| polygons.iter().all(|polygon| winding(polygon, at) != 0);
    let mut counts = [0; 2];
    for row in 0..100 {
        for column in 0..100 {
            let corner = [f64::from(column) * SIDE, f64::from(row) * SIDE];
            let next = [[corner[0] + SIDE, corner[1]], [corner[0], corner[1] + SIDE]];
            for next in next.into_iter().filter(|next| covers(corner) && covers(*next)) {
                if (at(corner) > 0.0) != (at(next) > 0.0) {
                    assert!(distance(lines, corner) < SIDE + slack, "{corner:?} {lines:?}");
                    counts[0] += 1;
                }
            }
        }
    }
    for &[a, b] in lines {
        for number in 1..20 {
            let part = f64::from(number) / 20.0;
            let place = [0, 1, 2].map(|axis| a[axis] + part * (b[axis] - a[axis]));
            assert!(inside(place).abs() < slack, "{place:?} {}", inside(place));
            let around = (0..16).map(|way| {
                let (sin, cos) = libm::sincos(f64::from(way) / 16.0 * core::f64::consts::TAU);
                [place[0] + 1e-6 * cos, place[1] + 1e-6 * sin]
            });
            assert!(around.into_iter().any(covers), "{place:?}");
            counts[1] += 1;
        }
    }
    counts
}

#[test]
fn faces_meet_where_one_passes_from_the_front_of_the_other_to_its_back() {
    let mut chance = Chance(11);
    let mut counts = [0; 2];
    for _ in 0..200 {
        let [a, b] = [face(&mut chance), face(&mut chance)];
        let mut lines = vec![];
        let pair = [&a, &b].map(|(plane, vertices)| Face { plane, vertices, runs: Part(Runs::NONE, 0) });
        faces(pair, 1e-3, &mut lines);
        let own = compare(&lines, &[&a.1, &b.1], &a.0, |[x, y, depth]| depth - b.0.at([x, y]), 1e-9);
        counts = [counts[0] + own[0], counts[1] + own[1]];
    }
    assert!(counts[0] > 1000 && counts[1] > 500, "{counts:?}");
}

#[test]
fn faces_in_one_plane_do_not_meet() {
    let mut chance = Chance(12);
    let (plane, vertices) = face(&mut chance);
    let tilted = Facet { depth: plane.depth + 2e-4, slope: [plane.slope[0] - 4e-5, plane.slope[1]] };
    for (other, same, is_met) in [(plane, 1e-3, false), (tilted, 1e-3, false), (tilted, 1e-6, true)] {
        let mut lines = vec![];
        faces(
            [&plane, &other].map(|plane| Face { plane, vertices: &vertices, runs: Part(Runs::NONE, 0) }),
            same,
            &mut lines,
        );
        assert_eq!(!lines.is_empty(), is_met, "{lines:?}");
    }
}

fn far(a: Place, b: Place) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum::<f64>().sqrt()
}

/// The distance of a place from the surface of a tube, less than 0 inside: that of the nearest of many balls.
fn apart(tube: &Tube, place: Place) -> f64 {
    let balls = (0..=400).map(|number| {
        let part = f64::from(number) / 400.0;
        let centre = [0, 1, 2].map(|axis| tube.ends[0][axis] + part * (tube.ends[1][axis] - tube.ends[0][axis]));
        far(place, centre) - tube.radii[0] - part * (tube.radii[1] - tube.radii[0])
    });
    balls.fold(f64::INFINITY, f64::min)
}

#[test]
fn a_tube_meets_a_face_on_its_surface() {
    let mut chance = Chance(13);
    let mut counts = [0; 2];
    for _ in 0..150 {
        let (plane, vertices) = face(&mut chance);
        let tube = chance.tube(10.0);
        let mut lines = vec![];
        tube_and_face(&tube, Face { plane: &plane, vertices: &vertices, runs: Part(Runs::NONE, 0) }, EXACT, &mut lines);
        let own = compare(&lines, &[&vertices], &plane, |place| apart(&tube, place), 2.0 * EXACT);
        counts = [counts[0] + own[0], counts[1] + own[1]];
        assert!(lines.len() < 400, "{tube:?} {}", lines.len());
    }
    assert!(counts[0] > 250 && counts[1] > 3000, "{counts:?}");
}

#[test]
fn tubes_meet_on_both_surfaces() {
    let mut chance = Chance(15);
    let mut counts = [0; 2];
    for _ in 0..150 {
        let pair = [chance.tube(10.0), chance.tube(10.0)];
        let mut lines = vec![];
        tubes([&pair[0], &pair[1]], EXACT, &mut lines);
        for [a, b] in &lines {
            for number in 0..=4 {
                let part = f64::from(number) / 4.0;
                let place = [0, 1, 2].map(|axis| a[axis] + part * (b[axis] - a[axis]));
                for tube in &pair {
                    let apart = apart(tube, place);
                    assert!(-0.5 * EXACT < apart && apart < 1.5 * EXACT, "{pair:?} {place:?} {apart}");
                }
            }
        }
        assert!(lines.len() < 1000, "{pair:?} {}", lines.len());
        // Naively: places on the side of the thinner tube, as many on each of many rings, are inside the other one or
        // not. Where that changes, a line is near.
        let [thin, thick] = if pair[0].widest() <= pair[1].widest() { pair } else { [pair[1], pair[0]] };
        let [thin, thick] = [thin, thick].map(|tube| tube.grown(EXACT));
        let is_inside = |ring: u32, way: u32| on_side(&thin, ring, way).map(|place| apart(&thick, place) < 0.0);
        let sides: Vec<Option<bool>> = (0..=RINGS)
            .flat_map(|ring| (0..=RINGS).map(move |way| [ring, way]))
            .map(|[ring, way]| is_inside(ring, way))
            .collect();
        let inside = |ring: u32, way: u32| sides[(ring * (RINGS + 1) + way) as usize];
        for ring in 0..RINGS {
            for way in 0..RINGS {
                let (Some(own), Some(next), Some(beside)) =
                    (inside(ring, way), inside(ring + 1, way), inside(ring, way + 1))
                else {
                    continue;
                };
                for (changes, other) in [(own != next, [ring + 1, way]), (own != beside, [ring, way + 1])] {
                    if changes {
                        let [from, to] = [[ring, way], other].map(|[ring, way]| on_side(&thin, ring, way).unwrap());
                        let near = lines.iter().map(|&line| near_line(line, from)).fold(f64::INFINITY, f64::min);
                        let step = far(to, from);
                        assert!(near < step + 2.0 * EXACT, "{pair:?} {from:?} {near} {step}");
                        counts[0] += 1;
                    }
                }
            }
        }
        counts[1] += usize::from(!lines.is_empty());
    }
    assert!(counts[0] > 1000 && counts[1] > 15, "{counts:?}");
}

/// The rings along a tube, and the places on each.
const RINGS: u32 = 40;

/// A place on the side of a tube, between its round ends.
fn on_side(tube: &Tube, ring: u32, way: u32) -> Option<Place> {
    let axis = [0, 1, 2].map(|at| tube.ends[1][at] - tube.ends[0][at]);
    let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
    let [[y0, x0], [y1, x1]] = tube.sides(length)?;
    let along = axis.map(|part| part / length);
    // Across the axis, by Gram and Schmidt.
    let start = if along[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
    let part: f64 = (0..3).map(|at| start[at] * along[at]).sum();
    let first = [0, 1, 2].map(|at| start[at] - part * along[at]);
    let size = first.iter().map(|part| part * part).sum::<f64>().sqrt();
    let first = first.map(|part| part / size);
    let last = cross(along, first);
    let far = f64::from(ring) / f64::from(RINGS);
    let (sin, cos) = libm::sincos(f64::from(way) / f64::from(RINGS) * core::f64::consts::TAU);
    let radius = x0 + far * (x1 - x0);
    Some(
        [0, 1, 2].map(|at| {
            tube.ends[0][at] + (y0 + far * (y1 - y0)) * along[at] + radius * (cos * first[at] + sin * last[at])
        }),
    )
}

/// The distance of a place from a line in space.
fn near_line([from, to]: [Place; 2], place: Place) -> f64 {
    let steps = (0..=20).map(|number| {
        let part = f64::from(number) / 20.0;
        far([0, 1, 2].map(|at| from[at] + part * (to[at] - from[at])), place)
    });
    steps.fold(f64::INFINITY, f64::min)
}

/// The lines where bodies meet, with their bodies.
fn met(scene: &Scene, grid: &Grid) -> Vec<(u32, [u32; 2], [Place; 2])> {
    let mut pierce = Pierce::new(scene, grid, 0.3, &mut Meter::new(0)).unwrap();
    let mut found = vec![];
    for number in 0..scene.bodies.len() as u32 {
        pierce.start(number, &mut Meter::new(0)).unwrap();
        while let Some((on, edges)) = pierce.next(&mut Meter::new(0)).unwrap() {
            found.extend(edges.iter().map(|edge| (on.number, on.faces.unwrap(), edge.ends)));
        }
    }
    found
}

/// The faces among two bodies, and the lines where the bodies meet.
fn naive(scene: &Scene, pair: [u32; 2]) -> ([u32; 2], Vec<[Place; 2]>) {
    let [a, b] = pair.map(|number| &scene.bodies[number as usize]);
    let mut lines = vec![];
    let faces_of = match (scene.face(a), scene.face(b), tube(a), tube(b)) {
        (Some(a), Some(b), ..) => {
            faces([a, b], scene.same, &mut lines);
            pair
        }
        (Some(face), _, _, Some(tube)) => {
            tube_and_face(&tube, face, 0.015, &mut lines);
            [pair[0], u32::MAX]
        }
        (_, Some(face), Some(tube), _) => {
            tube_and_face(&tube, face, 0.015, &mut lines);
            [pair[1], u32::MAX]
        }
        (_, _, Some(a), Some(b)) => {
            tubes([&a, &b], 0.015, &mut lines);
            [u32::MAX; 2]
        }
        _ => [u32::MAX; 2],
    };
    (faces_of, lines)
}

#[test]
fn the_grid_finds_all_bodies_that_meet_where_they_are_visible() {
    let mut chance = Chance(14);
    let (mut pairs, mut length) = ([0; 2], 0.0);
    for round in 0..16 {
        let scene = scene(&mut chance, 5 + 12 * round, true);
        let grid = Grid::new(&scene, &mut Meter::new(0)).unwrap();
        let points = Points::new(&scene, &mut Meter::new(0)).unwrap();
        let found = met(&scene, &grid);
        let mut visible = Visible::new(&scene, &grid);
        let mut visible = |on: On, ends: [Place; 2]| {
            let line = Sight::new(ends).unwrap();
            visible.find(on, ends, &line, &mut Meter::new(0)).unwrap();
            let whole = libm::hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
            visible.parts().map(|span| span.high - span.low).sum::<f64>() * whole
        };
        for last in 0..scene.bodies.len() as u32 {
            for first in 0..last {
                let (faces_of, lines) = naive(&scene, [first, last]);
                let is_one = scene.bodies[first as usize].mark == scene.bodies[last as usize].mark;
                if is_one || points.are_joined(&scene, [first, last]) {
                    pairs[1] += usize::from(!lines.is_empty());
                    continue;
                }
                let on = On { number: last, faces: Some(faces_of) };
                let seen: f64 = lines.iter().map(|&line| visible(on, line)).sum();
                let own = found.iter().filter(|(number, faces, _)| *number == last && *faces == faces_of);
                let got: f64 = own.map(|&(_, _, line)| visible(on, line)).sum();
                // Lines with several tubes have the same key.
                assert!(got >= seen - 1e-9, "{first} {last} {got} {seen}");
                pairs[0] += usize::from(seen > 0.0);
                length += seen;
            }
        }
    }
    assert!(pairs[0] > 200 && pairs[1] > 20 && length > 100.0, "{pairs:?} {length}");
}

/// The lines where bodies of a drawing meet.
fn met_in(axiom: &str, rules: &str, n: u32) -> usize {
    let definition = Definition {
        axiom: axiom.into(),
        rules: rules.into(),
        angle: 40.0,
        dialect: Dialect::Abop,
        ..Definition::default()
    };
    let figure = Figure::draw(&System::new(&definition).unwrap(), n, &Limits::default()).unwrap();
    let drawing = figure.seen_from(&Outlook::default(), 100_000).unwrap();
    let options = PlotOptions { hide: true, ..PlotOptions::default() };
    let page = Page::new(&drawing, &Sheet::default(), &options);
    let mut meter = Meter::new(0);
    let mut pens = Pens::new(&page, &options);
    let scene = Scene::read(&drawing, &definition.style, &page, &options, &mut pens, &mut meter).unwrap();
    assert!(scene.is_solid && scene.bodies.len() > 1, "{scene:?}");
    met(&scene, &Grid::new(&scene, &mut meter).unwrap()).len()
}

#[test]
fn joints_have_no_rings() {
    // Leaves and short, thick branches begin inside their stem.
    let plant = "A -> !(w)F[&(50)A]/(130)F[&(40)L]/(70)A\nL -> {.-f.+f.+f.-|-f.+f.}\nw = 8";
    assert_eq!(met_in("A", plant, 3), 0);
    assert_eq!(met_in("!(9)F[&(50)!(3)F(0.01)F(0.01)F]F", "", 0), 0);
    assert_eq!(met_in("!(9)F(2)[&(-60)!(1)F(0.01)F(0.01){.-f.+f.+f.-|-f.+f.}]F", "", 0), 0);
    // After a gap in the path, and where a leaf passes right through.
    assert!(met_in("!(9)F(2)[&(-60)f(0.002)!(1)F(0.01)F(0.01){.-f.+f.+f.-|-f.+f.}]F", "", 0) > 0);
    assert!(met_in("!(4)F(3)&(20)f(-1.5)&(70)f(-1.2){.-f.+f.+f.-|-f.+f.}", "", 0) > 0);
}

#[test]
fn leaves_of_a_node_meet_and_the_faces_of_a_mesh_do_not() {
    // Around a common axis: both have its ends, and no common edge.
    let leaf = "{.-(30)f(1).+(60)f(1).+(120)f(1).+(60)f(1).}";
    assert_eq!(met_in(&format!("[/(20){leaf}][/(80){leaf}]"), "", 0), 1);
    let leaf = "{.-(30)f(1).+(30)f(1).+(90)f(1).}";
    assert_eq!(met_in(&format!("[/(20)+(5){leaf}][/(80){leaf}]"), "", 0), 1);
    let page = "{.f(1).+(90)f(1).+(90)f(1).}";
    assert_eq!(met_in(&format!("[/(20){page}][/(80){page}]"), "", 0), 0);
}
