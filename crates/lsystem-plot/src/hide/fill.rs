//! Lines that fill tubes and polygons: in the plane a pen's width apart, and in space the farther apart the brighter.

use super::body::{Facet, Tube};
use super::outline::Edge;
use super::scene::{Body, Scene, Shape};
use super::sight::Place;
use crate::hatch;
use lsystem_syntax::{Halt, Work};

/// The direction to the light, on the sheet (y down) and towards the viewer: a unit vector.
const LIGHT: Place = [-0.48, -0.64, 0.6];
/// The part of the light that comes from all sides.
const AMBIENT: f64 = 0.25;
/// Surfaces at which less ink would be are left white, as the part of the surface under ink.
const LEAST: f64 = 0.12;

/// Adds the lines that fill a body; `None` if there would be more than `most`.
pub(super) fn fill(
    scene: &Scene,
    body: &Body,
    pen: f64,
    most: u64,
    edges: &mut Vec<Edge>,
    work: &mut dyn Work,
) -> Result<Option<()>, Halt> {
    match &body.shape {
        Shape::Line(_) | Shape::Face { plane: None, .. } => Ok(Some(())),
        Shape::Tube(tube) => fill_tube(tube, scene.is_solid, pen, most, edges, work),
        Shape::Face { vertices, plane: Some(plane), .. } => {
            let Some(spacing) = spacing(scene.is_solid.then(|| normal(plane)), pen) else { return Ok(Some(())) };
            let vertices: Vec<_> = scene.vertices[vertices.start as usize..vertices.end as usize]
                .iter()
                .map(|&[x, y, _]| [x, y])
                .collect();
            let Some(crossings) = hatch::crossings(&vertices, spacing, most, work)? else { return Ok(None) };
            for ends in hatch::lines(crossings, spacing) {
                work.charge(1)?;
                edges.extend(ends.map(|ends| {
                    let ends = ends.map(|[x, y]| [x, y, plane.at([x, y])]);
                    Edge { ends, is_round: true }
                }));
            }
            Ok(Some(()))
        }
    }
}

/// Adds lines along a tube, on its front, into its round ends.
fn fill_tube(
    tube: &Tube,
    is_solid: bool,
    pen: f64,
    most: u64,
    edges: &mut Vec<Edge>,
    work: &mut dyn Work,
) -> Result<Option<()>, Halt> {
    let ([x, y], length) = tube.axis();
    let aside = [-y, x];
    // A section across the tube is tilted: its front is this far ahead of the axis and nearer, in radii.
    let rise = tube.ends[1][2] - tube.ends[0][2];
    let whole = (length * length + rise * rise).sqrt();
    let [ahead, nearer] = if length > 0.0 { [-rise / whole, length / whole] } else { [0.0, 1.0] };
    // Between the sides of the outline, in parts of the radius.
    let mut part = -1.0_f64;
    for _ in 0..=most {
        work.charge(1)?;
        let front = (1.0 - part * part).max(0.0).sqrt();
        let normal = is_solid.then_some([
            part * aside[0] + front * ahead * x,
            part * aside[1] + front * ahead * y,
            front * nearer,
        ]);
        // Where no line is drawn, the shade is tried again a pen farther.
        let spacing = spacing(normal, pen);
        if spacing.is_some() && part > -1.0 && length > 0.0 {
            let at = |end: usize, ahead: f64, nearer: f64| {
                let radius = tube.radii[end];
                let [cx, cy, depth] = tube.ends[end];
                [
                    cx + radius * (part * aside[0] + ahead * x),
                    cy + radius * (part * aside[1] + ahead * y),
                    depth + radius * nearer,
                ]
            };
            let [ahead, nearer] = [ahead, nearer].map(|share| share * front);
            let way = [at(0, -front, 0.0), at(0, ahead, nearer), at(1, ahead, nearer), at(1, front, 0.0)];
            edges.extend(way.windows(2).map(|pair| Edge { ends: [pair[0], pair[1]], is_round: true }));
        }
        part += spacing.unwrap_or(pen) / tube.widest();
        if part >= 1.0 {
            return Ok(Some(()));
        }
    }
    Ok(None)
}

/// The distance of lines on a surface with this normal; `None` if it stays white. Without a normal, the surface is full
/// of ink.
fn spacing(normal: Option<Place>, pen: f64) -> Option<f64> {
    let Some(normal) = normal else { return Some(pen) };
    let lit: f64 = normal.iter().zip(LIGHT).map(|(own, light)| own * light).sum();
    let ink = 1.0 - AMBIENT - (1.0 - AMBIENT) * lit.max(0.0);
    (ink >= LEAST).then(|| pen / ink)
}

/// The unit normal of a plane on the side of the viewer.
pub(super) fn normal(plane: &Facet) -> Place {
    let [x, y] = plane.slope;
    let length = (1.0 + x * x + y * y).sqrt();
    [-x / length, -y / length, 1.0 / length]
}
