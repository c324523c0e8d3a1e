//! A drawing on the sheet as lines, tubes and faces with depths.
//!
//! In the plane the depth is the place in the drawing order, so far apart that every mark is in front of all before.

use super::body::{Facet, Tube};
use super::outline::EXACT;
use super::runs::Runs;
use super::sight::Place;
use crate::cells::Cells;
use crate::merge::JOINT;
use crate::options::PlotOptions;
use crate::page::{Page, Point};
use crate::pens::Pens;
use core::ops::Range;
use lsystem_drawing::triangulate::{facing, triangulate};
use lsystem_drawing::{Drawing, Mark, Segment};
use lsystem_syntax::{Halt, Style, Work};
use std::collections::HashSet;

/// Depths that differ less are equal, in pens. Tubes are thinner by this where they cover lines, so that lines in their
/// surface are visible.
pub(super) const SAME: f64 = 0.002;
/// The largest radius, in millimetres: beyond the largest sheet.
const WIDEST: f64 = 1e5;

/// A mark on the sheet, or a part of one.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// The number of the mark, in drawing order.
    pub(super) mark: u32,
    pub(super) layer: u32,
    pub(super) shape: Shape,
}

/// The shape of a body.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A stroke as broad as the pen's line up to [`EXACT`] on each side, or narrower, which covers nothing.
    Line([Place; 2]),
    /// A broader stroke: the hull of the places of the pen's middle.
    Tube(Tube),
    /// A polygon: a range of the scene's vertices, and the plane in which the polygon covers lines. A polygon without a
    /// plane covers nothing; if it is bent, triangles that are not outlined follow.
    Face { vertices: Range<u32>, plane: Option<Facet>, is_outlined: bool },
}

/// All bodies on the sheet.
#[derive(Debug, Default)]
pub(super) struct Scene {
    /// In drawing order.
    pub(super) bodies: Vec<Body>,
    pub(super) vertices: Vec<Place>,
    pub(super) runs: Runs,
    /// Depths that differ less are equal, in millimetres.
    pub(super) same: f64,
    /// Whether the drawing is a projection of one in space.
    pub(super) is_solid: bool,
    pub(super) joints: Joints,
}

impl Body {
    /// The ends of a stroke.
    fn ends(&self) -> Option<[Place; 2]> {
        match self.shape {
            Shape::Line(ends) | Shape::Tube(Tube { ends, .. }) => Some(ends),
            Shape::Face { .. } => None,
        }
    }
}

impl Scene {
    /// Reads a drawing.
    ///
    /// # Errors
    /// If there are more than [`Pens::most`] bodies.
    pub(super) fn read(
        drawing: &Drawing,
        style: &Style,
        page: &Page,
        options: &PlotOptions,
        pens: &mut Pens,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
        let is_solid = !drawing.depths.is_empty();
        let mut scene = Self { same: SAME * options.pen, is_solid, ..Self::default() };
        let mut depths = drawing.depths.iter().map(|depth| depth * page.frame.scale.abs());
        for (mark, own) in (0..).zip(drawing.marks_in(page.frame, page.step)) {
            work.charge(own.work())?;
            let mut place = |[x, y]: Point| [x, page.size[1] - y, depths.next().unwrap_or(0.0)];
            let (points, widths, tint) = match own {
                Mark::Segment(Segment { from, to, width, end_width, .. }, tint) => {
                    (vec![place(from), place(to)], Some([width, end_width]), tint)
                }
                Mark::Polygon(vertices, tint) => (vertices.into_iter().map(place).collect(), None, tint),
            };
            if !points.iter().flatten().all(|part| part.is_finite()) {
                continue;
            }
            let layer = pens.layer(style.colour_of(tint).rgb);
            match widths {
                Some(widths) => {
                    let shape = stroke([points[0], points[1]], widths, options.pen);
                    scene.bodies.push(Body { mark, layer, shape });
                }
                None => scene.polygon(mark, layer, &points, work)?,
            }
            if scene.bodies.len().max(scene.vertices.len()) as u64 > pens.most {
                return Err(pens.too_many());
            }
        }
        scene.drop_equal(work)?;
        scene.runs = Runs::new(&scene.vertices);
        let joints = Joints::new(&mut scene.bodies, is_solid, work)?;
        if !is_solid {
            scene.joints = joints;
            scene.stack(work)?;
        }
        Ok(scene)
    }

    /// Adds a polygon, and its triangles if it is bent.
    pub(super) fn polygon(&mut self, mark: u32, layer: u32, points: &[Place], work: &mut dyn Work) -> Result<(), Halt> {
        let mut face = |vertices: &mut Vec<Place>, points: &mut dyn Iterator<Item = Place>, plane, is_outlined| {
            let start = vertices.len() as u32;
            vertices.extend(points);
            let shape = Shape::Face { vertices: start..vertices.len() as u32, plane, is_outlined };
            self.bodies.push(Body { mark, layer, shape });
        };
        let plane = facing(points).and_then(|normal| Facet::new(middle(points), normal));
        let is_flat =
            plane.is_none_or(|plane| points.iter().all(|&[x, y, depth]| (plane.at([x, y]) - depth).abs() <= self.same));
        face(&mut self.vertices, &mut points.iter().copied(), plane.filter(|_| is_flat), true);
        if is_flat {
            return Ok(());
        }
        let triangles = triangulate(points);
        work.charge(triangles.work)?;
        for corners in triangles.corners {
            let corners = corners.map(|corner| points[corner]);
            let plane = facing(&corners).and_then(|normal| Facet::new(corners[0], normal));
            if plane.is_some() {
                face(&mut self.vertices, &mut corners.into_iter(), plane, false);
            }
        }
        Ok(())
    }

    /// Drops polygons that lie once more at the same place later, which hides them.
    fn drop_equal(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let vertices = &self.vertices;
        let mut known = HashSet::new();
        let mut is_last = vec![true; self.bodies.len()];
        for (is_last, body) in is_last.iter_mut().zip(&self.bodies).rev() {
            let Shape::Face { vertices: range, plane, is_outlined } = &body.shape else { continue };
            work.charge(1 + body.corners() / 4)?;
            let corner = |place: &Place| place.map(|part| libm::round(part / JOINT) as i64);
            let mut corners: Vec<_> = vertices[range.start as usize..range.end as usize].iter().map(corner).collect();
            let first = (0..corners.len()).min_by_key(|&at| corners[at]).unwrap_or_default();
            corners.rotate_left(first);
            *is_last = known.insert((corners, *is_outlined, plane.is_none().then_some(body.layer)));
        }
        let mut last = is_last.iter();
        self.bodies.retain(|_| last.next() == Some(&true));
        Ok(())
    }

    /// Gives each mark a depth in front of all before.
    pub(super) fn stack(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let radius = |body: &Body| if let Shape::Tube(tube) = &body.shape { tube.widest() } else { 0.0 };
        let apart = 1.0 + 2.0 * self.bodies.iter().map(radius).fold(0.0, f64::max);
        for body in &mut self.bodies {
            work.charge(1)?;
            let own = f64::from(body.mark) * apart;
            match &mut body.shape {
                Shape::Line(ends) | Shape::Tube(Tube { ends, .. }) => ends.iter_mut().for_each(|end| end[2] = own),
                Shape::Face { vertices, plane, .. } => {
                    *plane = Some(Facet { depth: own, slope: [0.0; 2] });
                    let range = vertices.start as usize..vertices.end as usize;
                    self.vertices[range].iter_mut().for_each(|vertex| vertex[2] = own);
                }
            }
        }
        Ok(())
    }
}

/// The shape of a stroke with these widths at its ends.
fn stroke(ends: [Place; 2], widths: [f64; 2], pen: f64) -> Shape {
    // The pen's line reaches the sides of the stroke.
    let radii = widths.map(|width| ((width - pen) / 2.0).clamp(0.0, WIDEST));
    // An outline so near to the axis is drawn as the axis. A width that is not a number has no radius either.
    if radii[0].max(radii[1]) > EXACT * pen { Shape::Tube(Tube { ends, radii }) } else { Shape::Line(ends) }
}

/// The middle of some points.
fn middle(points: &[Place]) -> Place {
    [0, 1, 2].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64)
}

/// Strokes of one colour that end at the same points of the plane. They are one shape: no line of one lies within
/// another.
#[derive(Debug, Default)]
pub(super) struct Joints {
    /// By body: the numbers of its ends. Empty in space.
    ends: Vec<[u32; 2]>,
    /// The range of each point in `tubes`.
    starts: Vec<u32>,
    /// The tubes at each point, in drawing order.
    tubes: Vec<u32>,
}

impl Joints {
    /// No point.
    const NONE: u32 = u32::MAX;
    /// The most tubes at a point that are one with a stroke there. More tubes are seldom, and the time grows with the
    /// square of their number.
    const MAX: usize = 64;

    /// Finds the joints of some bodies. Of equal strokes, only the last one stays: it hides the others.
    /// In space there are no joints.
    pub(super) fn new(bodies: &mut Vec<Body>, is_solid: bool, work: &mut dyn Work) -> Result<Self, Halt> {
        let mut joints = Self::default();
        let count = joints.number(bodies, is_solid, work)?;
        joints.drop_equal(bodies, work)?;
        if is_solid {
            return Ok(Self::default());
        }
        let mut counts = vec![0; count];
        for (body, ends) in bodies.iter().zip(&joints.ends) {
            work.charge(1)?;
            if matches!(body.shape, Shape::Tube(_)) {
                ends.iter().for_each(|&end| counts[end as usize] += 1);
            }
        }
        joints.starts.push(0);
        for count in &counts {
            joints.starts.push(joints.starts[joints.starts.len() - 1] + count);
        }
        joints.tubes = vec![0; joints.starts[counts.len()] as usize];
        for (number, body) in (0..).zip(&*bodies) {
            work.charge(2)?;
            for end in joints.ends[number as usize] {
                if matches!(body.shape, Shape::Tube(_)) {
                    counts[end as usize] -= 1;
                    joints.tubes[(joints.starts[end as usize + 1] - counts[end as usize] - 1) as usize] = number;
                }
            }
        }
        Ok(joints)
    }

    /// Numbers the ends of strokes. Returns the number of numbers.
    fn number(&mut self, bodies: &[Body], is_solid: bool, work: &mut dyn Work) -> Result<usize, Halt> {
        let [mut sheet, mut space] = [(); 2].map(|()| Cells::new([JOINT; 2]));
        let mut count = 0;
        for body in bodies {
            work.charge(2)?;
            let ends = body.ends().map(|ends| {
                ends.map(|[x, y, depth]| {
                    let (column, is_new) = sheet.number(body.layer, [x, y]);
                    let (number, is_new) = if is_solid { space.number(column, [depth, 0.0]) } else { (column, is_new) };
                    count += usize::from(is_new);
                    number
                })
            });
            self.ends.push(ends.unwrap_or([Self::NONE; 2]));
        }
        Ok(count)
    }

    /// Drops strokes that are drawn once more later, in the same colour: a curve may pass many times.
    fn drop_equal(&mut self, bodies: &mut Vec<Body>, work: &mut dyn Work) -> Result<(), Halt> {
        let mut known = HashSet::new();
        let mut is_last = vec![true; bodies.len()];
        for (at, body) in bodies.iter().enumerate().rev() {
            work.charge(1)?;
            let radii = match &body.shape {
                Shape::Line(_) => [0; 2],
                Shape::Tube(tube) => tube.radii.map(|radius| 1 + libm::round(radius / JOINT) as u64),
                Shape::Face { .. } => continue,
            };
            let [a, b] = self.ends[at];
            let key = if a <= b { [(a, radii[0]), (b, radii[1])] } else { [(b, radii[1]), (a, radii[0])] };
            is_last[at] = known.insert(key);
        }
        let mut last = is_last.iter();
        bodies.retain(|_| last.next() == Some(&true));
        let mut last = is_last.iter();
        self.ends.retain(|_| last.next() == Some(&true));
        Ok(())
    }

    /// Whether two bodies are strokes of one colour that end at the same point.
    pub(super) fn meet(&self, a: u32, b: u32) -> bool {
        let [a, b] = [a, b].map(|body| self.ends.get(body as usize).copied().unwrap_or([Self::NONE; 2]));
        a.iter().any(|&end| end != Self::NONE && b.contains(&end))
    }

    /// The tubes before a body that are one shape with it.
    pub(super) fn of(&self, body: u32) -> impl Iterator<Item = u32> + '_ {
        let ends = self.ends.get(body as usize).copied().unwrap_or([Self::NONE; 2]);
        let at = move |end: u32| {
            let range = (end != Self::NONE).then(|| [end, end + 1].map(|end| self.starts[end as usize] as usize));
            let tubes = range.map_or(&[][..], |[start, end]| &self.tubes[start..end]);
            let before = tubes.partition_point(|&tube| tube < body);
            tubes[before.saturating_sub(Self::MAX)..before].iter().copied()
        };
        ends.into_iter().flat_map(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_base::Meter;

    #[test]
    fn strokes_hardly_broader_than_the_pen_are_lines() {
        let ends = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
        for (widths, is_line) in [
            ([0.3, 0.5], true),
            ([0.5, 0.5], true),
            ([0.5, 0.549], true),
            ([0.551, 0.3], false),
            ([0.6, 0.6], false),
            ([f64::NAN, f64::NAN], true),
        ] {
            let shape = stroke(ends, widths, 0.5);
            assert_eq!(matches!(shape, Shape::Line(_)), is_line, "{widths:?}");
            // Around the tube, the pen's middle leaves the axis by more.
            assert!(is_line || matches!(shape, Shape::Tube(tube) if tube.widest() > EXACT * 0.5));
        }
    }

    #[test]
    fn in_space_strokes_at_one_place_of_the_sheet_are_equal_at_one_depth_only() {
        let body = |mark: u32, layer: u32, depth: f64, radius: f64| {
            let shape = Shape::Tube(Tube { ends: [[1.0, 2.0, 3.0], [4.0, 5.0, depth]], radii: [radius; 2] });
            Body { mark, layer, shape }
        };
        let all = [(0, 3.0, 1.0), (0, 3.0, 1.0), (0, 3.5, 1.0), (1, 3.0, 1.0), (0, 3.0, 2.0), (0, 3.0 + 1e-8, 1.0)];
        let mut bodies: Vec<Body> =
            (0..).zip(all).map(|(mark, (layer, depth, radius))| body(mark, layer, depth, radius)).collect();
        let joints = Joints::new(&mut bodies, true, &mut Meter::new(0)).unwrap();
        assert!(bodies.iter().map(|body| body.mark).eq([2, 3, 4, 5]));
        assert!(!joints.meet(0, 1));
    }
}
