//! Tubes in the making, and polygons between them.

use super::{Material, Mesh, MeshForm};
use crate::rotation::{Vector, cross, dot, minus, norm};
use crate::triangulate::{Triangles, triangulate};
use crate::{Mark, Segment, Solid};
use lsystem_syntax::Style;
use std::collections::{HashMap, HashSet};

/// The least cosine of the angle between strokes that share a ring. At sharper angles (above about 96 degrees) the ring
/// would be too pointed.
const SHARPEST: f64 = -0.1;
/// The height of a tube's end, in radii.
pub(super) const ROUND: f64 = 0.6;
/// Shorter strokes of prints, and smaller details of polygons, are left out: a part of the whole. Places are `f32`.
const FINE: f64 = 1e-6;

/// Tubes in the making.
#[derive(Clone, Debug)]
pub(super) struct Tubes {
    /// The meshes by material. Without materials there is one.
    pub(super) meshes: Vec<(Material, Mesh)>,
    form: MeshForm,
    /// Whether the mesh is for a printer, and whether each stroke is a body then.
    is_printed: bool,
    in_pieces: bool,
    /// The indices of the meshes by material.
    known: HashMap<Material, usize>,
    /// The index of the mesh that grows.
    current: usize,
    /// The bytes of all meshes.
    size: u64,
    sides: u32,
    /// The least radius of a tube.
    least: f64,
    /// Half the thickness of a slab.
    half: f64,
    /// The length under which strokes of prints are left out.
    shortest: f64,
    /// As [`MeshParts::thin`](super::MeshParts::thin).
    pub(super) thin: (u64, f64),
    /// The ends and radii of all strokes, where a stroke is drawn once.
    drawn: Option<HashSet<StrokeKey>>,
    /// The stroke whose far end is still open.
    last: Option<OpenTube>,
}

/// The ends of a stroke, the lesser first, and the radii there, as bits of `f32`.
type StrokeKey = [u32; 8];

/// A stroke that has its first ring.
#[derive(Clone, Copy, Debug)]
struct OpenTube {
    to: Vector,
    /// The stroke's direction.
    along: Vector,
    length: f64,
    /// The direction of a ring's first corner, at right angles to `along`.
    across: Vector,
    /// The radius at the far end.
    radius: f64,
    colour: [u8; 3],
    /// The index of the first ring's first corner, in the mesh of the stroke's material.
    ring: u32,
}

impl Tubes {
    /// `least` is the least radius in parts of `extent`, the drawing's longest side.
    pub(super) fn new(form: MeshForm, sides: u32, least: f64, extent: f64) -> Self {
        let (is_printed, in_pieces) = (matches!(form, MeshForm::Printed { .. }), form == MeshForm::PIECES);
        // The sides of a tube are nearer to its axis than its corners.
        let flat = if is_printed { libm::cos(core::f64::consts::PI / f64::from(sides)) } else { 1.0 };
        Self {
            meshes: vec![],
            form,
            is_printed,
            in_pieces,
            known: HashMap::new(),
            current: 0,
            size: 0,
            sides,
            least: least * extent / flat,
            half: least * extent,
            shortest: if is_printed { FINE * extent } else { 0.0 },
            thin: (0, f64::INFINITY),
            drawn: is_printed.then(HashSet::new),
            last: None,
        }
    }

    /// The bytes of the meshes and of what is remembered for them. A hash set leaves an eighth of its places free.
    pub(super) fn bytes(&self) -> u64 {
        let places = self.drawn.as_ref().map_or(0, |drawn| drawn.capacity() / 7 * 8);
        self.size + (places * (size_of::<StrokeKey>() + 1)) as u64
    }

    pub(super) fn least_width(&self) -> f64 {
        2.0 * self.least
    }

    /// Makes room for a mark, and for the end of the open tube.
    pub(super) fn reserve(&mut self, mark: &Mark<Solid>, style: &Style) {
        self.reserve_end();
        match mark {
            Mark::Segment(_, tint) => {
                self.choose(style.colour_of(*tint).rgb, false);
                // A ring at each end, and the middles of the two ends.
                self.reserve_corners(2 * self.sides as usize + 2);
            }
            Mark::Polygon(vertices, tint) => {
                self.choose(style.colour_of(*tint).rgb, true);
                self.reserve_corners(if self.in_pieces { 6 } else { 2 } * vertices.len());
            }
        }
    }

    /// Makes room for the end of the open tube.
    pub(super) fn reserve_end(&mut self) {
        if let Some(last) = self.last {
            self.choose(last.colour, false);
            self.reserve_corners(self.sides as usize + 1);
        }
    }

    fn reserve_corners(&mut self, more: usize) {
        let mesh = self.mesh();
        let before = mesh.bytes();
        mesh.reserve(more);
        self.size += self.mesh().bytes() - before;
    }

    /// Lets the mesh with this material grow.
    fn choose(&mut self, colour: [u8; 3], is_leaf: bool) {
        let material = match self.form {
            MeshForm::Coloured | MeshForm::Printed { .. } => Material::default(),
            MeshForm::Apart { by_colour } => Material { rgb: by_colour.then_some(colour), is_leaf },
        };
        if self.meshes.get(self.current).is_some_and(|(current, _)| *current == material) {
            return;
        }
        let next = self.meshes.len();
        self.current = *self.known.entry(material).or_insert(next);
        if self.current == next {
            self.meshes.push((material, Mesh::default()));
        }
    }

    /// The mesh that grows: [`Tubes::choose`] comes first.
    fn mesh(&mut self) -> &mut Mesh {
        &mut self.meshes[self.current].1
    }

    /// Whether a stroke is drawn for the first time, if repeats are left out.
    fn is_new(&mut self, segment: &Segment<Solid>, radii: [f64; 2]) -> bool {
        let Some(drawn) = &mut self.drawn else { return true };
        // Zero has one sign, so that equal places have equal bits.
        let bits = |value: f64| (value as f32 + 0.0).to_bits();
        let [from, to] = [segment.from.map(bits), segment.to.map(bits)];
        let [first, last] = radii.map(bits);
        let ([a, b, c], [d, e, f], [g, h]) =
            if from <= to { (from, to, [first, last]) } else { (to, from, [last, first]) };
        drawn.insert([a, b, c, d, e, f, g, h])
    }

    /// Adds a polygon: one side, two sides or a slab, as the form has it.
    pub(super) fn fill(&mut self, vertices: &[Vector], colour: [u8; 3]) {
        // The corners of a body follow each other.
        if self.is_printed {
            self.close();
        }
        self.choose(colour, true);
        let (outline, size) = simple_outline(vertices);
        let Triangles { facing: Some(normal), corners: mut triangles, .. } = triangulate(&outline) else { return };
        if self.in_pieces {
            for triangle in triangles {
                self.slab(&triangle.map(|vertex| outline[vertex]), normal, &[[0, 1, 2]], colour);
            }
        } else if self.is_printed {
            self.slab(&outline, normal, &triangles, colour);
        } else {
            triangles.retain(|triangle| {
                let [a, b, c] = triangle.map(|vertex| outline[vertex]);
                norm(cross(minus(b, a), minus(c, a))) > FINE * FINE * size * size
            });
            self.sheet(&outline, normal, &triangles, colour);
            if self.form == MeshForm::Coloured {
                triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
                self.sheet(&outline, normal.map(|c| -c), &triangles, colour);
            }
        }
    }

    /// Adds triangles of these corners.
    fn sheet(&mut self, corners: &[Vector], normal: Vector, triangles: &[[usize; 3]], colour: [u8; 3]) {
        let first = self.mesh().positions.len() as u32;
        corners.iter().for_each(|&at| self.corner(at, normal, colour));
        self.mesh().triangles.extend(triangles.iter().map(|triangle| triangle.map(|corner| first + corner as u32)));
    }

    /// Adds a polygon with a thickness. The rim has the corners of both sides, so that every edge joins two triangles.
    fn slab(&mut self, outline: &[Vector], normal: Vector, triangles: &[[usize; 3]], colour: [u8; 3]) {
        let count = outline.len();
        let at = |side: f64| outline.iter().map(move |vertex| [0, 1, 2].map(|i| vertex[i] + side * normal[i]));
        let corners: Vec<Vector> = at(self.half).chain(at(-self.half)).collect();
        let rim = (0..count).map(|at| [at, (at + 1) % count]);
        let rim = rim.flat_map(|[a, b]| [[b, a, a + count], [b, a + count, b + count]]);
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b, c], [a + count, c + count, b + count]]);
        self.sheet(&corners, normal, &rim.chain(sides).collect::<Vec<_>>(), colour);
    }

    /// Adds a stroke.
    pub(super) fn add(&mut self, segment: &Segment<Solid>, colour: [u8; 3]) {
        let way = minus(segment.to, segment.from);
        let length = norm(way);
        if !(length > self.shortest && length.is_finite()) {
            return;
        }
        let along = way.map(|c| c / length);
        let thinnest = segment.width.min(segment.end_width);
        if thinnest < 2.0 * self.half {
            self.thin = (self.thin.0 + 1, self.thin.1.min(thinnest));
        }
        // Clamped to the range of `f32`, as coordinates are.
        let radii =
            [segment.width, segment.end_width].map(|width| (0.5 * width).max(self.least).min(f64::from(f32::MAX)));
        let radius = radii[0];
        if !self.is_new(segment, radii) {
            return self.close();
        }
        let gap = |last: &OpenTube| norm(minus(segment.from, last.to));
        // A ring of a print stays within the halves of its strokes: no tube is turned inside out.
        let fits = |last: &OpenTube, turn: f64| {
            let reach = radius.max(last.radius) * ((1.0 - turn) / (1.0 + turn)).max(0.0).sqrt();
            !self.is_printed || 2.0 * reach <= length.min(last.length)
        };
        let joined = self.last.filter(|last| {
            let turn = dot(last.along, along);
            gap(last) <= 1e-9 * length && turn > SHARPEST && fits(last, turn)
        });
        let (across, ring) = match joined {
            Some(last) => self.join(&last, along, radius, colour),
            None => {
                self.close();
                self.choose(colour, false);
                let across = across(along);
                let ring = self.ring(segment.from, along, across, along, radius, colour);
                self.end(segment.from, along.map(|c| -c), radius, colour, |side| [ring + side + 1, ring + side]);
                (across, ring)
            }
        };
        self.last = Some(OpenTube { to: segment.to, along, length, across, radius: radii[1], colour, ring });
    }

    /// Ends a stroke at the start of the next one, which goes along `along`. Returns the next stroke's `across` and
    /// `ring`, as in [`OpenTube`].
    fn join(&mut self, last: &OpenTube, along: Vector, radius: f64, colour: [u8; 3]) -> (Vector, u32) {
        self.choose(last.colour, false);
        let half = unit([0, 1, 2].map(|i| last.along[i] + along[i]));
        let ring = self.ring(last.to, last.along, last.across, half, radius, last.colour);
        self.wall(last.ring, ring);
        // The corners lie on the plane across `half`; projected along the next stroke they form a circle again.
        let on_plane = slide(last.across, last.along, half);
        let across = slide(on_plane, along, along);
        let across = unit(across);
        // A print has no colours, and its rings are repeated between bodies only.
        let is_shared = if self.is_printed { !self.in_pieces } else { colour == last.colour };
        if is_shared {
            return (across, ring);
        }
        // The same places to the last bit, so that programs that join corners by their places find no gap.
        let range = ring as usize..(ring + self.sides) as usize;
        let places: Vec<[f32; 3]> = self.mesh().positions[range].to_vec();
        self.choose(colour, false);
        let own = self.ring(last.to, along, across, half, radius, colour);
        self.mesh().positions[own as usize..].copy_from_slice(&places);
        if self.in_pieces {
            let caps = (2..self.sides)
                .flat_map(|side| [[ring, ring + side - 1, ring + side], [own, own + side, own + side - 1]]);
            // The first body's triangles come first.
            let (ends, starts): (Vec<_>, Vec<_>) = caps.partition(|cap| cap[0] == ring);
            self.mesh().triangles.extend(ends.into_iter().chain(starts));
        }
        (across, own)
    }

    /// Ends the open tube, if any.
    pub(super) fn close(&mut self) {
        if let Some(last) = self.last.take() {
            self.choose(last.colour, false);
            let ring = self.ring(last.to, last.along, last.across, last.along, last.radius, last.colour);
            self.wall(last.ring, ring);
            self.end(last.to, last.along, last.radius, last.colour, |side| [ring + side, ring + side + 1]);
        }
    }

    /// Adds the corners of a tube along `along` where the tube meets the plane across `plane`. Returns the first
    /// corner's index.
    fn ring(&mut self, at: Vector, along: Vector, across: Vector, plane: Vector, radius: f64, colour: [u8; 3]) -> u32 {
        let first = self.mesh().positions.len() as u32;
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
        let mesh = self.mesh();
        // Zero has one sign, so that programs find equal corners.
        mesh.positions.push(at.map(|c| c.clamp(-f64::from(f32::MAX), f64::from(f32::MAX)) as f32 + 0.0));
        mesh.normals.push(normal.map(|c| c as f32 + 0.0));
        mesh.colours.push(colour);
    }

    /// Adds the pointed end of a tube, which points along `out`. `edge` returns two neighbouring corners of its ring by
    /// the number of the side; an index just after the last corner stands for the first.
    fn end(&mut self, at: Vector, out: Vector, radius: f64, colour: [u8; 3], edge: impl Fn(u32) -> [u32; 2]) {
        let middle = self.mesh().positions.len() as u32;
        self.corner([0, 1, 2].map(|i| at[i] + ROUND * radius * out[i]), out, colour);
        for side in 0..self.sides {
            let [a, b] = edge(side).map(|corner| if corner == middle { middle - self.sides } else { corner });
            self.mesh().triangles.push([a, b, middle]);
        }
    }

    /// Adds the wall of a tube between two rings.
    fn wall(&mut self, from: u32, to: u32) {
        for side in 0..self.sides {
            let next = (side + 1) % self.sides;
            let triangles = [[from + side, from + next, to + next], [from + side, to + next, to + side]];
            self.mesh().triangles.extend(triangles);
        }
    }
}

/// An outline without vertices that enclose nothing: at the place of the one before, or on a line with their neighbours.
/// Returns the size of the outline too.
fn simple_outline(vertices: &[Vector]) -> (Vec<Vector>, f64) {
    let size = vertices.iter().map(|&vertex| norm(minus(vertex, vertices[0]))).fold(0.0, f64::max);
    let is_flat = |a: Vector, b: Vector, c: Vector| {
        let (to, on) = (minus(b, a), minus(c, b));
        norm(cross(to, on)) <= FINE * size * norm(to).max(norm(on))
    };
    let mut outline: Vec<Vector> = Vec::with_capacity(vertices.len());
    for &vertex in vertices {
        while let &[.., a, b] = &outline[..]
            && is_flat(a, b, vertex)
        {
            outline.pop();
        }
        if outline.last().is_none_or(|&last| norm(minus(vertex, last)) > FINE * size) {
            outline.push(vertex);
        }
    }
    // The same where the outline closes.
    let mut first = 0;
    while let &[a, b, .., y, z] = &outline[first..] {
        if is_flat(y, z, a) {
            outline.pop();
        } else if is_flat(z, a, b) {
            first += 1;
        } else {
            break;
        }
    }
    (outline.split_off(first), size)
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
