//! Drawings as triangles: strokes become tubes, polygons are triangulated.
//!
//! Strokes that join end to end share a ring of corners on the plane that halves the angle between them, so that a bent
//! path is one closed tube. A tube tapers to the width of the next stroke. A branch is a closed tube of its own that
//! begins inside its parent.

mod tubes;

use crate::drawing::{SolidMark, SolidReader};
use crate::{BlockFrame, BlockId, Drawing, Mark, Solid};
use lsystem_base::{LimitName, Meter};
use lsystem_syntax::{Diagnostic, Halt, Style, Work};
use tubes::Tubes;

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

/// The form of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshForm {
    /// One mesh with a colour at each corner. Polygons have two sides.
    Coloured,
    /// One mesh for a printer, without colours: polygons are slabs as thick as the thinnest tube, so that every part has a
    /// volume, and a stroke at the place of an earlier stroke of the same width is left out. Every edge joins exactly
    /// two triangles. The corners and the triangles of a closed body follow each other.
    Printed {
        /// Whether each stroke, and each triangle of a polygon, is a convex body of its own.
        in_pieces: bool,
    },
    /// A mesh for each material. Polygons have one side, because their material shows both.
    Apart {
        /// Whether each colour has a material of its own.
        by_colour: bool,
    },
}

impl MeshForm {
    /// A print of convex bodies.
    pub const PIECES: Self = Self::Printed { in_pieces: true };
}

/// The choices for a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshOptions {
    /// The form.
    pub form: MeshForm,
    /// The most segments, vertices of polygons and blocks left whole.
    pub most: u64,
    /// The most bytes of the mesh. While a list grows, its former bytes count extra.
    pub memory: u64,
    /// The least diameter of a tube, in parts of the drawing's longest side: in prints between opposite sides, elsewhere
    /// between opposite corners.
    pub thinnest: f64,
    /// Blocks with at most this many segments and polygons stay whole: [`MeshParts::blocks`] has their places instead.
    /// 0 for none.
    pub whole: u128,
}

impl Default for MeshOptions {
    fn default() -> Self {
        Self { form: MeshForm::Coloured, most: u64::MAX, memory: u64::MAX, thinnest: 0.0, whole: 0 }
    }
}

/// The material of a part of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Material {
    /// The colour: red, green and blue in sRGB. `None` if the corners have colours of their own.
    pub rgb: Option<[u8; 3]>,
    /// Whether this is the material of polygons, which have one side.
    pub is_leaf: bool,
}

/// The longer side, in pixels, of the picture for which [`Style::min_width`] is taken.
const PICTURE: f64 = 1024.0;

impl Mesh {
    /// Makes a mesh of all strokes and polygons. Tubes have eight sides for up to 20,000 strokes, six for up to
    /// 100,000, four for more. No stroke is thinner than [`Style::min_width`] in a picture of 1024 pixels. Strokes
    /// without length are left out. Coordinates and widths are clamped to the range of `f32`.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the drawing has more than `most` segments and vertices of
    /// polygons.
    pub fn new(drawing: &Drawing<Solid>, style: &Style, most: u64) -> Result<Self, Diagnostic> {
        Self::with(drawing, style, &MeshOptions { most, ..MeshOptions::default() })
    }

    fn with(drawing: &Drawing<Solid>, style: &Style, options: &MeshOptions) -> Result<Self, Diagnostic> {
        let parts = MeshParts::new(drawing, style, options, &mut Meter::new(u64::MAX));
        parts.map(MeshParts::into_first).map_err(Halt::diagnostic)
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

/// The meshes of a drawing or of a block, and the blocks left whole.
#[derive(Clone, Debug)]
pub struct MeshParts {
    /// The meshes by material, in the order of their first strokes; one mesh if materials are not apart.
    pub meshes: Vec<(Material, Mesh)>,
    /// The blocks that stay whole, in drawing order, and their frames in units of the root block.
    pub blocks: Vec<(BlockId, BlockFrame<Solid>)>,
    /// The number of segments, vertices of polygons and whole blocks.
    pub count: u64,
    /// The least diameter of a tube, in model units.
    pub least_width: f64,
    /// The number of strokes that are thinner in the drawing, and the thinnest one's diameter.
    pub thin: (u64, f64),
    /// The height of the lowest axis or vertex of a polygon, in model units.
    pub ground: f64,
}

impl MeshParts {
    /// The mesh of a drawing.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the mesh would exceed its limits.
    pub fn new(
        drawing: &Drawing<Solid>,
        style: &Style,
        options: &MeshOptions,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
        // If blocks stay whole, marks are counted while they are read.
        if options.whole == 0 && drawing.size() > u128::from(options.most) {
            return Err(Diagnostic::limit(LimitName::Mesh, options.most, None).into());
        }
        Self::read(SolidReader::new(drawing, options.whole), drawing, style, options, work)
    }

    /// The mesh of a block in a frame, in units of the root block. The frame's origin becomes the model's origin.
    ///
    /// # Errors
    /// As [`MeshParts::new`].
    pub fn within(
        drawing: &Drawing<Solid>,
        style: &Style,
        options: &MeshOptions,
        block: BlockId,
        frame: &BlockFrame<Solid>,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
        Self::read(SolidReader::within(drawing, block, frame), drawing, style, options, work)
    }

    /// The only mesh; the first one if materials are apart.
    #[must_use]
    pub fn into_first(self) -> Mesh {
        self.meshes.into_iter().next().map(|(_, mesh)| mesh).unwrap_or_default()
    }

    fn read(
        reader: SolidReader<'_>,
        drawing: &Drawing<Solid>,
        style: &Style,
        options: &MeshOptions,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
        let [low, high] = drawing.bounds().unwrap_or_default();
        let extent = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
        let sides = match drawing.segment_count() {
            0..=20_000 => 8,
            20_001..=100_000 => 6,
            _ => 4,
        };
        let thinnest = (style.min_width.max(0.1) / PICTURE).max(options.thinnest);
        let mut tubes = Tubes::new(options.form, sides, 0.5 * thinnest, extent);
        let (mut blocks, mut count) = (vec![], 0);
        let check_memory = |tubes: &Tubes| match tubes.bytes() > options.memory {
            true => Err(Diagnostic::limit(LimitName::Memory, options.memory, None)),
            false => Ok(()),
        };
        for mark in reader {
            let (marks, units) = match &mark {
                SolidMark::Mark(mark @ Mark::Polygon(vertices, _)) => (vertices.len() as u64, mark.work()),
                SolidMark::Mark(mark) => (1, mark.work()),
                SolidMark::Whole(..) => (1, 4),
            };
            work.charge(MARK_WORK * units)?;
            count += marks;
            if count > options.most {
                return Err(Diagnostic::limit(LimitName::Mesh, options.most, None).into());
            }
            match mark {
                SolidMark::Whole(block, frame) => blocks.push((block, frame)),
                SolidMark::Mark(mark) => {
                    tubes.reserve(&mark, style);
                    check_memory(&tubes)?;
                    match mark {
                        Mark::Segment(segment, tint) => tubes.add(&segment, style.colour_of(tint).rgb),
                        Mark::Polygon(vertices, tint) => tubes.fill(&vertices, style.colour_of(tint).rgb),
                    }
                }
            }
        }
        tubes.reserve_end();
        check_memory(&tubes)?;
        tubes.close();
        let (least_width, thin, ground) = (tubes.least_width(), tubes.thin, low[1]);
        Ok(Self { least_width, thin, ground, meshes: tubes.meshes, blocks, count })
    }
}

/// The work of a mark in the mesh, in units of [`Mark::work`].
const MARK_WORK: u64 = 4;

#[cfg(test)]
mod tests {
    use super::tubes::ROUND;
    use super::*;
    use crate::rotation::{cross, dot, norm};
    use crate::{System, draw};
    use lsystem_base::Limits;
    use lsystem_syntax::Definition;
    use std::collections::BTreeMap;

    fn mesh(axiom: &str, rules: &str, angle: f64, n: u32) -> Mesh {
        let style = Style { width: 0.1, min_width: 0.0, max_width: 0.0, ..Style::default() };
        let definition = Definition {
            axiom: axiom.into(),
            rules: rules.into(),
            angle,
            style: style.clone(),
            ..Definition::default()
        };
        let system = System::new(&definition).unwrap();
        Mesh::new(&draw::<Solid>(&system, n, &Limits::default()).unwrap(), &style, 100_000).unwrap()
    }

    fn printed(drawing: &Drawing<Solid>, style: &Style, in_pieces: bool) -> Mesh {
        let options = MeshOptions { form: MeshForm::Printed { in_pieces }, ..MeshOptions::default() };
        Mesh::with(drawing, style, &options).unwrap()
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
        let system = System::new(&definition).unwrap();
        let leaf = printed(&draw::<Solid>(&system, 0, &Limits::default()).unwrap(), &style, false);
        check_closed(&leaf);
        // The least width is a tenth of the extent, which is 1; the outline is a square.
        assert!((volume(&leaf) - 0.1).abs() < 1e-6, "{}", volume(&leaf));
        assert_eq!(leaf.triangles.len(), 2 * 2 + 4 * 2);
    }

    #[test]
    fn printed_strokes_are_drawn_once() {
        let definition = Definition { axiom: "F[F]FF|FF".into(), ..Definition::default() };
        let system = System::new(&definition).unwrap();
        let drawing = draw::<Solid>(&system, 0, &Limits::default()).unwrap();
        let print = printed(&drawing, &definition.style, false);
        check_closed(&print);
        // Two tubes are left: from 0 to 2 with three rings, and from 2 to 3.
        assert_eq!(print.positions.len(), (3 * 8 + 2) + (2 * 8 + 2));
    }

    #[test]
    fn polygons_have_no_triangles_without_area() {
        // The last vertex is the first one; the second one lies on the way to the third.
        for (axiom, triangles) in [("{f+f+f}", 2), ("{ff+f+f+ff}", 4), ("{f+f+f+f-f+f+f}", 6)] {
            let leaf = mesh(axiom, "", 120.0, 0);
            let area = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|corner| leaf.positions[corner as usize].map(f64::from));
                norm(cross(crate::rotation::minus(b, a), crate::rotation::minus(c, a)))
            };
            assert!(leaf.triangles.iter().all(|t| area(t) > 1e-6), "{axiom}");
            assert!(
                leaf.triangles.len() <= triangles && !leaf.triangles.is_empty(),
                "{axiom}: {}",
                leaf.triangles.len()
            );
        }
    }

    #[test]
    fn strokes_of_a_print_in_pieces_are_closed_bodies() {
        let definition = Definition { axiom: "F+F[{f+f+f+f}]F/F&F".into(), angle: 50.0, ..Definition::default() };
        let drawing = draw::<Solid>(&System::new(&definition).unwrap(), 0, &Limits::default()).unwrap();
        let style = Style { width: 0.1, max_width: 0.0, ..Style::default() };
        let [chains, pieces] = [false, true].map(|in_pieces| printed(&drawing, &style, in_pieces));
        check_closed(&pieces);
        assert!((volume(&chains) - volume(&pieces)).abs() < 1e-6, "{} {}", volume(&chains), volume(&pieces));
        // Four rings in the chains have a body on each side.
        assert!(pieces.positions.len() > chains.positions.len() && pieces.triangles.len() > chains.triangles.len());
        // A joint that does not fit into its short strokes is none.
        let thick = Style { width: 1.5, ..style };
        let zigzag =
            Definition { axiom: "F+F-F+F-F".into(), angle: 80.0, style: thick.clone(), ..Definition::default() };
        let drawing = draw::<Solid>(&System::new(&zigzag).unwrap(), 0, &Limits::default()).unwrap();
        assert_eq!(printed(&drawing, &thick, false).positions.len(), 5 * 18);
    }

    #[test]
    fn trees_are_meshes() {
        let tree = mesh("A", "A -> F[&A][/+A]^!F\\'A\nF -> FF", 25.7, 5);
        check_closed(&tree);
        assert!(volume(&tree) > 0.0 && tree.triangles.len() > 1_000);
        assert_eq!(mesh("A", "", 0.0, 0), Mesh::default());
    }
}
