//! Picking: the segment or the polygon of a drawing in space under a pointer.

use super::camera::{Camera, Lens, NEAR};
use crate::search::{Aim, Order, Sight, covers, nearest_on, search};
use crate::{Pick, Pointer, Viewport};
use lsystem_drawing::BlockFrame;
use lsystem_drawing::rotation::{Vector, combine, cross, dot, minus, norm};
use lsystem_drawing::triangulate::facing;
use lsystem_drawing::{BlockId, Drawing, Placed, Polygon, Solid, Stroke, StyleChange};

/// The segment or the polygon under a pointer as the camera sees it. Among the polygons filled there and the segments
/// whose strokes are within a quarter of the tolerance, the nearest to the eye is picked, to about that quarter in
/// depth. If there are none, the nearest to the pointer is picked, to a 32nd of the tolerance. Where many blocks
/// overlap, the search ends with the pointer's visits. Segments and polygons beyond the first 2^128 - 1 are not found.
#[must_use]
pub(crate) fn pick(drawing: &Drawing<Solid>, viewport: Viewport, camera: &Camera, pointer: &Pointer) -> Option<Pick> {
    let lens = Lens::new(drawing, viewport, camera, 1.0);
    let [x, y] = [0, 1].map(|i| pointer.at[i] - lens.middle[i]);
    let towards = [x * lens.nearness, y * lens.nearness, 1.0];
    let ray = [[x, y, 0.0], towards.map(|c| c / norm(towards))];
    let mut sight = SolidSight { drawing, at: pointer.at, lens, unit: norm(lens.axes[0]), ray };
    let root = BlockFrame::new(1.0, StyleChange::start(drawing.width));
    search(drawing, pointer, &mut sight, root, Order::Likely)
}

/// Places the items of a drawing in space relative to a pointer.
struct SolidSight<'a> {
    drawing: &'a Drawing<Solid>,
    at: [f64; 2],
    lens: Lens,
    /// Pixels in a unit of the root block, at the depth of the target.
    unit: f64,
    /// The line of sight through the pointer: a place and a direction, as the lens sees them before perspective.
    ray: [Vector; 2],
}

impl Sight<Solid> for SolidSight<'_> {
    type Place = BlockFrame<Solid>;

    fn inside(&mut self, frame: &BlockFrame<Solid>, placed: &Placed<Solid>) -> BlockFrame<Solid> {
        frame.place(placed, self.drawing, &mut ())
    }

    fn scale(&self, frame: &BlockFrame<Solid>) -> f64 {
        self.unit * frame.scale
    }

    fn block(&self, id: BlockId, frame: &BlockFrame<Solid>) -> Option<Aim> {
        let (block, lens) = (&self.drawing.blocks[id.0 as usize], &self.lens);
        let widest = frame.style.widths().widest(block.widest).max(0.0) * lens.step / 2.0;
        // A little larger, because rounding may leave an end outside the hull.
        let radius = (block.hull.radius + 1e-9) * frame.scale * self.unit + widest;
        let centre = self.place(frame.transform(block.hull.centre()));
        let [near, far] = [centre[2] - radius, centre[2] + radius];
        if 1.0 + far * lens.nearness <= NEAR {
            return None;
        }
        let [from, towards] = self.ray;
        let away = norm(cross(minus(centre, from), towards));
        Some(Aim { distance: (away - radius) * lens.factor(far), depth: near, off: away / radius })
    }

    fn stroke(&self, frame: &BlockFrame<Solid>, stroke: &Stroke<Solid>) -> Option<Aim> {
        let lens = &self.lens;
        let parts = lens.before_eye([stroke.from, stroke.to].map(|end| self.place(frame.transform(end))))?;
        let (axis, depth, along) = self.beside(parts.map(|(end, _)| end));
        let style = frame.style.then(&self.drawing.styles[stroke.style.0 as usize]);
        let [first, last] = style.widths().ends();
        let [from, to] = parts.map(|(_, place)| place);
        let width = first + (from + along * (to - from)) * (last - first);
        let radius = (width * lens.step / 2.0).max(0.0);
        let off = axis / lens.factor(depth);
        let distance = (axis - radius * lens.factor(depth)).max(0.0);
        // The surface of the stick bulges towards the eye.
        let depth = depth - (radius * radius - off * off).max(0.0).sqrt();
        Some(Aim { distance, depth, off })
    }

    fn polygon(&self, frame: &BlockFrame<Solid>, polygon: &Polygon) -> Option<Aim> {
        let lens = &self.lens;
        let vertices = self.drawing.vertices_of(polygon).iter();
        let vertices: Vec<Vector> = vertices.map(|&vertex| self.place(frame.transform(vertex))).collect();
        // A polygon that reaches behind the eye is not painted.
        if vertices.iter().any(|vertex| 1.0 + vertex[2] * lens.nearness <= NEAR) {
            return None;
        }
        let outline: Vec<_> = vertices.iter().map(|&vertex| lens.project(vertex)).map(|[x, y, _]| [x, y]).collect();
        if covers(&outline, self.at) {
            // The depth at which the line of sight meets the polygon's plane.
            let [from, towards] = self.ray;
            let normal = facing(&vertices)?;
            let depth = dot(normal, minus(vertices[0], from)) / dot(normal, towards) * towards[2];
            return Some(Aim { distance: 0.0, depth, off: 0.0 });
        }
        let sides = vertices.iter().zip(vertices.iter().cycle().skip(1));
        let nearest = sides.map(|(&from, &to)| self.beside([from, to])).min_by(|a, b| a.0.total_cmp(&b.0));
        let (distance, depth, _) = nearest?;
        Some(Aim { distance, depth, off: 0.0 })
    }
}

impl SolidSight<'_> {
    /// The place of a point of the root block, as the lens sees it before perspective.
    // Not inlined, to keep the wasm small.
    #[inline(never)]
    fn place(&self, point: Vector) -> Vector {
        let [x, y, z] = combine(&self.lens.axes, point);
        let [x0, y0, z0] = self.lens.origin;
        [x0 + x, y0 + y, z0 + z]
    }

    /// The distance in pixels of the pointer from a line before the eye, and the line's nearest place: how far behind the
    /// target, in pixels, and how far along the line, from 0 to 1.
    // Not inlined, to keep the wasm small.
    #[inline(never)]
    fn beside(&self, ends: [Vector; 2]) -> (f64, f64, f64) {
        let ends = ends.map(|end| self.lens.project(end));
        let (axis, t) = nearest_on(self.at, ends.map(|[x, y, _]| [x, y]));
        let shown = ends[0][2] + t * (ends[1][2] - ends[0][2]);
        let depth = shown / (1.0 - shown * self.lens.nearness);
        // With perspective equal parts of the line are not equal in the picture.
        let [near, far] = ends.map(|end| 1.0 - end[2] * self.lens.nearness);
        (axis, depth, t * far / (near + t * (far - near)).max(f64::MIN_POSITIVE))
    }
}
