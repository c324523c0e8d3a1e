//! Moves that are drawn between visible lines, against the ink of these lines.

use super::super::outline::EXACT;
use crate::ink::ink;
use crate::join::join;
use crate::merge::Piece;
use crate::options::PlotOptions;
use crate::page::{Page, Point, distance};
use crate::sheet::Sheet;
use lsystem_base::{Limits, Meter};
use lsystem_drawing::{System, draw};
use lsystem_syntax::Definition;

/// The distance of a point from the nearest piece of a layer.
pub(in crate::hide) fn away(pieces: &[Piece], layer: u32, point: Point) -> f64 {
    let far = |piece: &Piece| {
        let [from, to] = piece.ends;
        let (way, own) = ([to[0] - from[0], to[1] - from[1]], [point[0] - from[0], point[1] - from[1]]);
        let part = (own[0] * way[0] + own[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
        let part = part.clamp(0.0, 1.0);
        distance(point, [0, 1].map(|axis| from[axis] + part * way[axis]))
    };
    pieces.iter().filter(|piece| piece.layer == layer).map(far).fold(f64::INFINITY, f64::min)
}

#[test]
fn moves_that_are_drawn_hardly_leave_the_ink() {
    let rules = "F -> FF-[-F+F+F]+[+F-F-F]".into();
    let definition = Definition { axiom: "!(0.5)F".into(), rules, angle: 22.5, ..Definition::default() };
    let system = System::new(&definition).unwrap();
    let drawing = draw(&system, 3, &Limits::default()).unwrap();
    let options = PlotOptions { pen: 0.3, hide: true, ..PlotOptions::default() };
    let page = Page::new(&drawing, &Sheet { width: 60.0, height: 60.0, margin: 5.0 }, &options);
    let ink = || ink(&drawing, &definition.style, &page, options, 1_000_000, &mut Meter::new(0)).unwrap();
    let (mut apart, all) = (ink(), ink());
    let (pieces, spare) = (apart.pieces.clone(), core::mem::take(&mut apart.spare));
    let [apart, joined] = [apart, all].map(|ink| join(ink, &options, &mut Meter::new(0)).unwrap());
    let [few, many] = [&joined, &apart].map(|polylines| polylines.list.len());
    assert!(4 * few < 3 * many, "{few} {many}");
    let (mut drawn, mut farthest) = (0.0, 0.0_f64);
    for number in 0..few {
        for line in joined.points_of(number).windows(2) {
            let length = distance(line[0], line[1]);
            drawn += length;
            // Shorter lines may be points.
            if length < 1e-3 {
                continue;
            }
            // The sides of the line's ink, at places so near each other, and in the middle.
            let count = 2.0 * libm::ceil(length / 0.08);
            for part in (0..=count as u32).map(|step| f64::from(step) / count) {
                for side in [-0.5, 0.5] {
                    let aside = side * options.pen / length;
                    let [x, y] = [0, 1].map(|axis| line[0][axis] + part * (line[1][axis] - line[0][axis]));
                    let edge = [x - aside * (line[1][1] - line[0][1]), y + aside * (line[1][0] - line[0][0])];
                    farthest = farthest.max(away(&pieces, joined.layer(number), edge));
                }
            }
        }
    }
    let before: f64 = pieces.iter().map(|piece| distance(piece.ends[0], piece.ends[1])).sum();
    assert!(before + 1.0 < drawn && drawn < before + spare + 1e-6, "{before} {drawn} {spare}");
    assert!(farthest < (0.5 + EXACT) * options.pen + 1e-3 && farthest > 0.51 * options.pen, "{farthest}");
}
