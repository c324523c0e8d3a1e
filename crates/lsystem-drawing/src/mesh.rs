//! Drawings as triangles: strokes become tubes, polygons are triangulated.
//!
//! Strokes that join end to end share a ring of corners on the plane that halves the angle between them, so that a bent
//! path is one closed tube. A tube tapers to the width of the next stroke. A branch is a closed tube of its own that
//! begins inside its parent.

use crate::drawing::MarkReader;
use crate::rotation::{Vector, cross, dot, minus, norm};
use crate::triangulate::{Triangles, triangulate};
use crate::{Drawing, Mark, Segment, Solid};
use lsystem_syntax::{Diagnostic, LimitName, Meter, Progress, Style};
use std::collections::HashSet;

/// Triangles with colours, in model units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners: x, y, z.
    pub positions: Vec<[f32; 3]>,
    /// By corner: the outward direction of the surface, of length 1.
    pub normals: Vec<[f32; 3]>,
    /// By corner: red, green and blue in sRGB.
    pub colours: Vec<[u8; 3]>,
    /// The indices of three corners each, counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// The longer side, in pixels, of the picture for which [`Style::min_width`] is taken.
const PICTURE: f64 = 1024.0;
/// The least cosine of the angle between strokes that share a ring. At sharper angles (above about 96 degrees) the ring
/// would be too pointed.
const SHARPEST: f64 = -0.1;
/// The height of a tube's end, in radii.
const ROUND: f64 = 0.6;

impl Mesh {
    /// Makes a mesh of all strokes and polygons. Tubes have eight sides for up to 20,000 strokes, six for up to
    /// 100,000, four for more. No stroke is thinner than [`Style::min_width`] in a picture of 1024 pixels. Strokes
    /// without length are left out. Coordinates and widths are clamped to the range of `f32`.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the drawing has more than `most` segments and vertices of
    /// polygons.
    pub fn new(drawing: &Drawing<Solid>, style: &Style, most: u64) -> Result<Self, Diagnostic> {
        let mut maker = MeshMaker::new(drawing, style, most, u64::MAX)?;
        while maker.step(drawing, style, u64::MAX)? == Progress::More {}
        Ok(maker.finish())
    }

    /// As [`Mesh::new`], with polygons as slabs ([`MeshMaker::for_printing`]).
    ///
    /// # Errors
    /// As [`Mesh::new`].
    pub fn for_printing(drawing: &Drawing<Solid>, style: &Style, most: u64) -> Result<Self, Diagnostic> {
        let mut maker = MeshMaker::new(drawing, style, most, u64::MAX)?.for_printing();
        while maker.step(drawing, style, u64::MAX)? == Progress::More {}
        Ok(maker.finish())
    }

    /// The bytes that the mesh occupies.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let corners = size_of::<[f32; 3]>() * (self.positions.capacity() + self.normals.capacity());
        let rest = size_of::<[u8; 3]>() * self.colours.capacity() + size_of::<[u32; 3]>() * self.triangles.capacity();
        (corners + rest) as u64
    }

    /// Makes room for `more` corners and twice as many triangles. Lists grow by an eighth, so that little memory stays
    /// unused.
    fn reserve(&mut self, more: usize) {
        fn grow<T>(list: &mut Vec<T>, more: usize) {
            if list.capacity() - list.len() < more {
                list.reserve_exact(more.max(list.len() / 8));
            }
        }
        grow(&mut self.positions, more);
        grow(&mut self.normals, more);
        grow(&mut self.colours, more);
        grow(&mut self.triangles, 2 * more);
    }
}

/// Makes a mesh in steps. The maker does not borrow the drawing between steps.
#[derive(Clone, Debug)]
pub struct MeshMaker {
    reader: MarkReader<Solid>,
    tubes: Tubes,
    /// The most bytes that the mesh may take.
    memory: u64,
    spent: u64,
}

impl MeshMaker {
    /// Prepares a mesh of at most `memory` bytes. While a list grows, its former bytes count extra.
    ///
    /// # Errors
    /// As [`Mesh::new`].
    pub fn new(drawing: &Drawing<Solid>, style: &Style, most: u64, memory: u64) -> Result<Self, Diagnostic> {
        drawing.check_size(most)?;
        let extent = drawing.bounds().map_or(0.0, |[low, high]| (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max));
        let sides = match drawing.segment_count() {
            0..=20_000 => 8,
            20_001..=100_000 => 6,
            _ => 4,
        };
        let least = 0.5 * style.min_width.max(0.1) * extent / PICTURE;
        let tubes = Tubes { mesh: Mesh::default(), sides, least, thickness: 0.0, drawn: None, last: None };
        Ok(Self { reader: MarkReader::new(drawing), tubes, memory, spent: 0 })
    }

    /// The maker for a printer: polygons become slabs as thick as the thinnest tube, so that every part has a volume,
    /// and a stroke at the place of an earlier stroke of the same width is left out.
    #[must_use]
    pub fn for_printing(mut self) -> Self {
        self.tubes.thickness = 2.0 * self.tubes.least;
        self.tubes.drawn = Some(HashSet::new());
        self
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Continues for about `work` units. Every call needs the same drawing and style.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the mesh would take more than `memory` bytes.
    pub fn step(&mut self, drawing: &Drawing<Solid>, style: &Style, work: u64) -> Result<Progress, Diagnostic> {
        let mut meter = Meter::new(work);
        let mut progress = Progress::More;
        while progress == Progress::More && !meter.is_spent() {
            // A stroke has at most three rings and two ends, a polygon two sides and the corners of its rim.
            let mut corners = 3 * self.tubes.sides as usize + 2;
            let mark = self.reader.next(drawing);
            match &mark {
                Some(Mark::Polygon(vertices, _)) => corners += 6 * vertices.len(),
                Some(Mark::Segment(..)) => {}
                None => progress = Progress::Done,
            }
            meter.charge(mark.as_ref().map_or(8, |mark| MARK_WORK * mark.work()));
            self.tubes.mesh.reserve(corners);
            if self.tubes.bytes() > self.memory {
                self.tubes.mesh = Mesh::default();
                return Err(Diagnostic::limit(LimitName::Memory, self.memory, None));
            }
            match mark {
                Some(Mark::Segment(segment, tint)) => self.tubes.add(&segment, style.colour_of(tint).rgb),
                Some(Mark::Polygon(vertices, tint)) => self.tubes.fill(&vertices, style.colour_of(tint).rgb),
                None => self.tubes.close(),
            }
        }
        self.spent = self.spent.saturating_add(meter.spent());
        Ok(progress)
    }

    /// The mesh, when all steps are done.
    #[must_use]
    pub fn finish(self) -> Mesh {
        self.tubes.mesh
    }
}

/// The work of a mark in the mesh, in units of [`Mark::work`].
const MARK_WORK: u64 = 4;

/// Tubes in the making.
#[derive(Clone, Debug)]
struct Tubes {
    mesh: Mesh,
    sides: u32,
    /// The least radius of a tube.
    least: f64,
    /// The thickness of polygons; 0 for two sides at the same place.
    thickness: f64,
    /// The ends and radii of all strokes, where a stroke is drawn once.
    drawn: Option<HashSet<StrokeKey>>,
    /// The stroke whose far end is still open.
    last: Option<OpenTube>,
}

/// The ends of a stroke, the lesser first, and its radius, as bits of `f32`.
type StrokeKey = [u32; 7];

/// A stroke that has its first ring.
#[derive(Clone, Copy, Debug)]
struct OpenTube {
    to: Vector,
    /// The stroke's direction.
    along: Vector,
    /// The direction of a ring's first corner, at right angles to `along`.
    across: Vector,
    radius: f64,
    colour: [u8; 3],
    /// The index of the first ring's first corner.
    ring: u32,
}

impl Tubes {
    /// The bytes of the mesh and of what is remembered for it. A hash set leaves an eighth of its places free.
    fn bytes(&self) -> u64 {
        let places = self.drawn.as_ref().map_or(0, |drawn| drawn.capacity() / 7 * 8);
        self.mesh.bytes() + (places * (size_of::<StrokeKey>() + 1)) as u64
    }

    /// Whether a stroke is drawn for the first time, if repeats are left out.
    fn is_new(&mut self, segment: &Segment<Solid>, radius: f64) -> bool {
        let Some(drawn) = &mut self.drawn else { return true };
        // Zero has one sign, so that equal places have equal bits.
        let bits = |value: f64| (value as f32 + 0.0).to_bits();
        let [from, to] = [segment.from.map(bits), segment.to.map(bits)];
        let ([a, b, c], [d, e, f]) = if from <= to { (from, to) } else { (to, from) };
        drawn.insert([a, b, c, d, e, f, bits(radius)])
    }

    /// Adds the two sides of a polygon.
    fn fill(&mut self, vertices: &[Vector], colour: [u8; 3]) {
        let outline = if self.thickness > 0.0 { without_repeats(vertices) } else { vertices.to_vec() };
        let vertices = &outline[..];
        let Triangles { facing: Some(normal), corners: triangles, .. } = triangulate(vertices) else { return };
        let half = 0.5 * self.thickness;
        let lifted = |vertex: Vector, normal: Vector| [0, 1, 2].map(|i| vertex[i] + half * normal[i]);
        let back = normal.map(|c| -c);
        for (normal, order) in [(normal, [0, 1, 2]), (back, [0, 2, 1])] {
            let first = self.mesh.positions.len() as u32;
            vertices.iter().for_each(|&vertex| self.corner(lifted(vertex, normal), normal, colour));
            let face = |triangle: &[usize; 3]| order.map(|corner| first + triangle[corner] as u32);
            self.mesh.triangles.extend(triangles.iter().map(face));
        }
        let count = if half > 0.0 { vertices.len() } else { 0 };
        for at in 0..count {
            let edge = [vertices[at], vertices[(at + 1) % count]];
            let out = unit(cross(minus(edge[1], edge[0]), normal));
            let first = self.mesh.positions.len() as u32;
            for side in [normal, back] {
                edge.iter().for_each(|&vertex| self.corner(lifted(vertex, side), out, colour));
            }
            self.mesh.triangles.extend([[1, 0, 2], [1, 2, 3]].map(|corners| corners.map(|corner| first + corner)));
        }
    }

    /// Adds a stroke.
    fn add(&mut self, segment: &Segment<Solid>, colour: [u8; 3]) {
        let way = minus(segment.to, segment.from);
        let length = norm(way);
        if !(length > 0.0 && length.is_finite()) {
            return;
        }
        let along = way.map(|c| c / length);
        // Clamped to the range of `f32`, as coordinates are.
        let radius = (0.5 * segment.width).max(self.least).min(f64::from(f32::MAX));
        if !self.is_new(segment, radius) {
            return self.close();
        }
        let gap = |last: &OpenTube| norm(minus(segment.from, last.to));
        let joined = self.last.filter(|last| gap(last) <= 1e-9 * length && dot(last.along, along) > SHARPEST);
        let (across, ring) = match joined {
            Some(last) => self.join(&last, along, radius, colour),
            None => {
                self.close();
                let across = across(along);
                let ring = self.ring(segment.from, along, across, along, radius, colour);
                self.end(segment.from, along.map(|c| -c), radius, colour, |side| [ring + side + 1, ring + side]);
                (across, ring)
            }
        };
        self.last = Some(OpenTube { to: segment.to, along, across, radius, colour, ring });
    }

    /// Ends a stroke at the start of the next one, which goes along `along`. Returns the next stroke's `across` and
    /// `ring`, as in [`OpenTube`].
    fn join(&mut self, last: &OpenTube, along: Vector, radius: f64, colour: [u8; 3]) -> (Vector, u32) {
        let half = unit([0, 1, 2].map(|i| last.along[i] + along[i]));
        let ring = self.ring(last.to, last.along, last.across, half, radius, last.colour);
        self.wall(last.ring, ring);
        // The corners lie on the plane across `half`; projected along the next stroke they form a circle again.
        let on_plane = slide(last.across, last.along, half);
        let across = slide(on_plane, along, along);
        let across = unit(across);
        if colour == last.colour {
            return (across, ring);
        }
        let own = self.ring(last.to, along, across, half, radius, colour);
        // The same places to the last bit, so that programs that join corners by their places find no gap.
        let [from, to] = [ring as usize, own as usize];
        self.mesh.positions.copy_within(from..from + self.sides as usize, to);
        (across, own)
    }

    /// Ends the open tube, if any.
    fn close(&mut self) {
        if let Some(last) = self.last.take() {
            let ring = self.ring(last.to, last.along, last.across, last.along, last.radius, last.colour);
            self.wall(last.ring, ring);
            self.end(last.to, last.along, last.radius, last.colour, |side| [ring + side, ring + side + 1]);
        }
    }

    /// Adds the corners of a tube along `along` where the tube meets the plane across `plane`. Returns the first
    /// corner's index.
    fn ring(&mut self, at: Vector, along: Vector, across: Vector, plane: Vector, radius: f64, colour: [u8; 3]) -> u32 {
        let first = self.mesh.positions.len() as u32;
        let third = cross(along, across);
        for side in 0..self.sides {
            let (c, s) =
                lsystem_syntax::Heading::from_degrees(360.0 * f64::from(side) / f64::from(self.sides)).cos_sin();
            let out = [0, 1, 2].map(|i| c * across[i] + s * third[i]);
            let corner = slide(out, along, plane);
            self.corner([0, 1, 2].map(|i| at[i] + radius * corner[i]), unit(slide(out, plane, plane)), colour);
        }
        first
    }

    fn corner(&mut self, at: Vector, normal: Vector, colour: [u8; 3]) {
        self.mesh.positions.push(at.map(|c| c.clamp(-f64::from(f32::MAX), f64::from(f32::MAX)) as f32));
        self.mesh.normals.push(normal.map(|c| c as f32));
        self.mesh.colours.push(colour);
    }

    /// Adds the pointed end of a tube, which points along `out`. `edge` returns two neighbouring corners of its ring by
    /// the number of the side; an index just after the last corner stands for the first.
    fn end(&mut self, at: Vector, out: Vector, radius: f64, colour: [u8; 3], edge: impl Fn(u32) -> [u32; 2]) {
        let middle = self.mesh.positions.len() as u32;
        self.corner([0, 1, 2].map(|i| at[i] + ROUND * radius * out[i]), out, colour);
        for side in 0..self.sides {
            let [a, b] = edge(side).map(|corner| if corner == middle { middle - self.sides } else { corner });
            self.mesh.triangles.push([a, b, middle]);
        }
    }

    /// Adds the wall of a tube between two rings.
    fn wall(&mut self, from: u32, to: u32) {
        for side in 0..self.sides {
            let next = (side + 1) % self.sides;
            self.mesh.triangles.push([from + side, from + next, to + next]);
            self.mesh.triangles.push([from + side, to + next, to + side]);
        }
    }
}

/// An outline without vertices at the place of the one before.
fn without_repeats(vertices: &[Vector]) -> Vec<Vector> {
    let size = vertices.iter().map(|&vertex| norm(minus(vertex, vertices[0]))).fold(0.0, f64::max);
    let is_same = |a: &Vector, b: &Vector| norm(minus(*a, *b)) <= 1e-9 * size;
    let mut outline: Vec<Vector> = Vec::with_capacity(vertices.len());
    for vertex in vertices {
        if outline.last().is_none_or(|last| !is_same(last, vertex)) {
            outline.push(*vertex);
        }
    }
    if outline.len() > 1 && is_same(&outline[0], &outline[outline.len() - 1]) {
        outline.pop();
    }
    outline
}

/// A vector moved along `along` onto the plane through the origin across `plane`.
fn slide(vector: Vector, along: Vector, plane: Vector) -> Vector {
    let by = dot(vector, plane) / dot(along, plane);
    [0, 1, 2].map(|i| vector[i] - by * along[i])
}

/// A unit vector at right angles to `along`.
fn across(along: Vector) -> Vector {
    // The axis at the largest angle to `along` gives the most exact product.
    let least = (0..3).min_by(|&a, &b| along[a].abs().total_cmp(&along[b].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    unit(cross(along, axis))
}

fn unit(vector: Vector) -> Vector {
    let length = norm(vector);
    vector.map(|c| c / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{System, draw_solid};
    use lsystem_syntax::{Definition, Limits};
    use std::collections::BTreeMap;

    fn mesh(axiom: &str, rules: &str, angle: f64, n: u32) -> Mesh {
        let style = Style { width: 0.1, min_width: 0.0, ..Style::default() };
        let definition = Definition {
            axiom: axiom.into(),
            rules: rules.into(),
            angle,
            style: style.clone(),
            ..Definition::default()
        };
        let system = System::new(&definition).0.unwrap();
        Mesh::new(&draw_solid(&system, n, &Limits::default()).unwrap(), &style, 100_000).unwrap()
    }

    /// The volume inside; triangles that face inwards count as negative.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |index: u32| mesh.positions[index as usize].map(f64::from);
        mesh.triangles.iter().map(|t| dot(corner(t[0]), cross(corner(t[1]), corner(t[2]))) / 6.0).sum()
    }

    /// Checks that every edge has a triangle on each side. Edges are compared by coordinates, not by corner numbers.
    fn check_closed(mesh: &Mesh) {
        let mut edges = BTreeMap::<_, i32>::new();
        let place = |index: u32| mesh.positions[index as usize].map(|c| (f64::from(c) * 1e5).round() as i64);
        for t in &mesh.triangles {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                *edges.entry((place(a), place(b))).or_default() += 1;
                *edges.entry((place(b), place(a))).or_default() -= 1;
            }
        }
        assert!(edges.values().all(|&count| count == 0));
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            assert!(position.iter().all(|c| c.is_finite()));
            assert!((norm(normal.map(f64::from)) - 1.0).abs() < 1e-6, "{normal:?}");
        }
    }

    #[test]
    fn a_stroke_is_a_closed_tube() {
        let tube = mesh("F", "", 0.0, 0);
        check_closed(&tube);
        assert_eq!((tube.positions.len(), tube.triangles.len()), (18, 32));
        // A prism of eight sides, and two pyramids on its ends.
        let base = 8.0 * 0.5 * 0.05 * 0.05 * libm::sin(core::f64::consts::FRAC_PI_4);
        assert!((volume(&tube) - base * (1.0 + 2.0 * ROUND * 0.05 / 3.0)).abs() < 1e-8, "{}", volume(&tube));
    }

    #[test]
    fn paths_bend_without_gaps() {
        // Five strokes with six rings, and two ends.
        let path = mesh("F+F&F/F-F", "", 60.0, 0);
        check_closed(&path);
        assert_eq!((path.positions.len(), path.triangles.len()), (6 * 8 + 2, (5 * 2 + 2) * 8));
        // At a bend the volume lost on one side equals the volume gained on the other.
        let straight = mesh("FFFFF", "", 0.0, 0);
        assert!((volume(&path) - volume(&straight)).abs() < 1e-6);
        // A new colour needs a new ring, and a stroke that turns back needs a new tube.
        assert_eq!(mesh("F'F", "", 0.0, 0).positions.len(), 4 * 8 + 2);
        assert_eq!(mesh("F|F", "", 0.0, 0).positions.len(), 2 * 18);
        check_closed(&mesh("F'F+'F^F[&F][/+F]!F", "", 25.7, 0));
    }

    #[test]
    fn leaves_have_two_sides() {
        let leaf = mesh("{-f+f+f-|-f+f+f}", "", 22.5, 0);
        check_closed(&leaf);
        assert!(leaf.triangles.len() >= 8 && volume(&leaf).abs() < 1e-9);
    }

    #[test]
    fn printed_leaves_have_a_volume() {
        let definition = Definition { axiom: "{f+f+f}".into(), angle: 90.0, ..Definition::default() };
        let style = Style { min_width: 102.4, ..Style::default() };
        let system = System::new(&definition).0.unwrap();
        let leaf = Mesh::for_printing(&draw_solid(&system, 0, &Limits::default()).unwrap(), &style, 100).unwrap();
        check_closed(&leaf);
        // The least width is a tenth of the extent, which is 1; the outline is a square.
        assert!((volume(&leaf) - 0.1).abs() < 1e-6, "{}", volume(&leaf));
        assert_eq!(leaf.triangles.len(), 2 * 2 + 4 * 2);
    }

    #[test]
    fn printed_strokes_are_drawn_once() {
        let definition = Definition { axiom: "F[F]FF|FF".into(), ..Definition::default() };
        let system = System::new(&definition).0.unwrap();
        let drawing = draw_solid(&system, 0, &Limits::default()).unwrap();
        let print = Mesh::for_printing(&drawing, &definition.style, 100).unwrap();
        check_closed(&print);
        // Two tubes are left: from 0 to 2 with three rings, and from 2 to 3.
        assert_eq!(print.positions.len(), (3 * 8 + 2) + (2 * 8 + 2));
    }

    #[test]
    fn trees_are_meshes() {
        let tree = mesh("A", "A -> F[&A][/+A]^!F\\'A\nF -> FF", 25.7, 5);
        check_closed(&tree);
        assert!(volume(&tree) > 0.0 && tree.triangles.len() > 1_000);
        assert_eq!(mesh("A", "", 0.0, 0), Mesh::default());
    }
}
