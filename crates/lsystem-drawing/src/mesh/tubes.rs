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

/// Tubes in the making.
#[derive(Clone, Debug)]
pub(super) struct Tubes {
    /// The meshes by material. Without materials there is one.
    pub(super) meshes: Vec<(Material, Mesh)>,
    form: MeshForm,
    /// The indices of the meshes by material.
    known: HashMap<Material, usize>,
    /// The index of the mesh that grows.
    current: usize,
    /// The bytes of all meshes.
    size: u64,
    sides: u32,
    /// The least radius of a tube.
    least: f64,
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
    /// The direction of a ring's first corner, at right angles to `along`.
    across: Vector,
    /// The radius at the far end.
    radius: f64,
    colour: [u8; 3],
    /// The index of the first ring's first corner, in the mesh of the stroke's material.
    ring: u32,
}

impl Tubes {
    pub(super) fn new(form: MeshForm, sides: u32, least: f64) -> Self {
        let drawn = (form == MeshForm::Printed).then(HashSet::new);
        let (meshes, known) = (vec![], HashMap::new());
        Self { meshes, form, known, current: 0, size: 0, sides, least, drawn, last: None }
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
                self.reserve_corners(2 * vertices.len());
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
            MeshForm::Coloured | MeshForm::Printed => Material::default(),
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
        self.choose(colour, true);
        let is_printed = self.form == MeshForm::Printed;
        let outline = if is_printed { without_repeats(vertices) } else { vertices.to_vec() };
        let Triangles { facing: Some(normal), corners: triangles, .. } = triangulate(&outline) else { return };
        let half = if is_printed { self.least } else { 0.0 };
        let back = normal.map(|c| -c);
        let sides = [(normal, [0, 1, 2]), (back, [0, 2, 1])];
        let sides = if let MeshForm::Apart { .. } = self.form { &sides[..1] } else { &sides[..] };
        let first = self.mesh().positions.len() as u32;
        for &(normal, order) in sides {
            let first = self.mesh().positions.len() as u32;
            for &vertex in &outline {
                self.corner([0, 1, 2].map(|i| vertex[i] + half * normal[i]), normal, colour);
            }
            let face = |triangle: &[usize; 3]| order.map(|corner| first + triangle[corner] as u32);
            self.mesh().triangles.extend(triangles.iter().map(face));
        }
        if is_printed {
            // The rim has the corners of both sides, so that every edge joins two triangles.
            let count = outline.len() as u32;
            for at in 0..count {
                let [a, b] = [at, (at + 1) % count].map(|at| first + at);
                self.mesh().triangles.extend([[b, a, a + count], [b, a + count, b + count]]);
            }
        }
    }

    /// Adds a stroke.
    pub(super) fn add(&mut self, segment: &Segment<Solid>, colour: [u8; 3]) {
        let way = minus(segment.to, segment.from);
        let length = norm(way);
        if !(length > 0.0 && length.is_finite()) {
            return;
        }
        let along = way.map(|c| c / length);
        // Clamped to the range of `f32`, as coordinates are.
        let radii =
            [segment.width, segment.end_width].map(|width| (0.5 * width).max(self.least).min(f64::from(f32::MAX)));
        let radius = radii[0];
        if !self.is_new(segment, radii) {
            return self.close();
        }
        let gap = |last: &OpenTube| norm(minus(segment.from, last.to));
        let joined = self.last.filter(|last| gap(last) <= 1e-9 * length && dot(last.along, along) > SHARPEST);
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
        self.last = Some(OpenTube { to: segment.to, along, across, radius: radii[1], colour, ring });
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
        // A print has no colours, and its rings are not repeated.
        if colour == last.colour || self.form == MeshForm::Printed {
            return (across, ring);
        }
        // The same places to the last bit, so that programs that join corners by their places find no gap.
        let range = ring as usize..(ring + self.sides) as usize;
        let places: Vec<[f32; 3]> = self.mesh().positions[range].to_vec();
        self.choose(colour, false);
        let own = self.ring(last.to, along, across, half, radius, colour);
        self.mesh().positions[own as usize..].copy_from_slice(&places);
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
        mesh.positions.push(at.map(|c| c.clamp(-f64::from(f32::MAX), f64::from(f32::MAX)) as f32));
        mesh.normals.push(normal.map(|c| c as f32));
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
