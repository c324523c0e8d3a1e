//! Drawings in space as binary glTF 2.0 (`.glb`), the format of viewers, browsers and game engines.
//!
//! The drawing's graph becomes a scene: each part is a mesh that is written once, and nodes place it. Parts are shared by
//! plain nodes, which every viewer reads; the extension `EXT_mesh_gpu_instancing` is unknown to many. A node of glTF has
//! one parent, so that nodes cannot share inner nodes as blocks do: the file has a node for each copy. [`choice`] finds
//! the size of parts with the smallest file.

mod choice;
mod scene;

use crate::{FileOptions, Sink, collect};
use core::hash::{Hash, Hasher};
use lsystem_base::{LimitName, MAX_MESH_COPIES};
use lsystem_drawing::{
    BlockFrame, BlockId, ColourChange, Drawing, Mesh, MeshForm, MeshOptions, MeshParts, Solid, StyleChange, Widths,
    times,
};
use lsystem_syntax::{Diagnostic, Halt, Style, Work};
use scene::{Node, Scene};
use std::collections::HashMap;
use std::collections::hash_map::DefaultHasher;
use std::sync::Arc;

/// Writes a drawing: a material for each colour of strokes and of polygons, or colours at the corners where the colour
/// runs along the path. `name` becomes the name of the scene's outermost node. A drawing without strokes and polygons
/// gives an empty scene.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the file would have more than `most` segments, vertices of polygons
/// and nodes, or if a viewer would draw more than [`MAX_MESH_COPIES`] segments and vertices.
pub fn write_glb(drawing: &Drawing<Solid>, style: &Style, most: u64, name: &str) -> Result<Vec<u8>, Diagnostic> {
    let options = FileOptions { title: name.to_owned(), most, ..FileOptions::default() };
    collect(|sink| scene(drawing, style, &options, sink)?.write(sink)).map(|(file, ())| file)
}

/// As [`write_glb`], piece by piece, within [`FileOptions::memory`]. The drawing is dropped before the scene is written.
pub(crate) fn glb_file(
    drawing: Arc<Drawing<Solid>>,
    style: &Style,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<(), Halt> {
    let scene = scene(&drawing, style, options, sink)?;
    drop(drawing);
    scene.write(sink)
}

/// The bytes of a node in memory and in the file's head.
const NODE_BYTES: u64 = 256;

/// The scene of a drawing.
fn scene(drawing: &Drawing<Solid>, style: &Style, options: &FileOptions, work: &mut dyn Work) -> Result<Scene, Halt> {
    if drawing.size() > u128::from(MAX_MESH_COPIES) {
        return Err(Diagnostic::limit(LimitName::MeshCopies, MAX_MESH_COPIES, None).into());
    }
    let by_colour = style.colour_by.source().is_shared();
    let &FileOptions { most, memory, .. } = options;
    let whole = if by_colour { choice::size_of_parts(drawing, most, work)? } else { 0 };
    let form = MeshForm::Apart { by_colour };
    let mut maker = SceneMaker {
        drawing,
        style,
        options: MeshOptions { form, most, memory, whole, ..MeshOptions::default() },
        scene: Scene { name: options.title.clone(), has_colours: !by_colour, ..Scene::default() },
        parts: vec![],
        known: HashMap::new(),
        meshes: HashMap::new(),
    };
    let rest = MeshParts::new(drawing, style, &maker.options, work)?;
    for (block, frame) in &rest.blocks {
        maker.place(rest.least_width, *block, frame)?;
    }
    maker.options.whole = 0;
    maker.add(rest)?;
    maker.scene.nodes.insert(0, Node { part: 0, at: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0] });
    for (block, frame) in core::mem::take(&mut maker.parts) {
        let mesh = MeshParts::within(drawing, style, &maker.options, block, &frame, work)?;
        maker.add(mesh)?;
    }
    maker.drop_empty();
    maker.scene.set_height(options.height, work)?;
    Ok(maker.scene)
}

/// A scene in the making.
struct SceneMaker<'a> {
    drawing: &'a Drawing<Solid>,
    style: &'a Style,
    /// The form, and the limits that are left.
    options: MeshOptions,
    scene: Scene,
    /// The blocks of the parts and their frames. Part 0 of the scene is what lies outside these parts.
    parts: Vec<(BlockId, BlockFrame<Solid>)>,
    /// The parts of the scene by block, scale, colour index, level and width.
    known: HashMap<(BlockId, u64, i32, u32, [u64; 2]), usize>,
    /// The indices of meshes by a hash of their corners.
    meshes: HashMap<u64, Vec<usize>>,
}

impl SceneMaker<'_> {
    /// Places a part. A new part is made later. Tubes have at least the width `least`, in model units.
    fn place(&mut self, least: f64, block: BlockId, frame: &BlockFrame<Solid>) -> Result<(), Diagnostic> {
        self.take_memory(NODE_BYTES)?;
        let (colour, level) = frame.style.seen(self.style);
        let widths = frame.style.widths();
        // If all tubes have the least width, the width is not visible.
        let widest = widths.widest(self.drawing.blocks[block.0 as usize].widest) * self.drawing.step.abs();
        let widths = if widest <= least { Widths::new(0.0) } else { widths };
        let next = self.parts.len() + 1;
        let key = (block, frame.scale.to_bits(), colour, level, widths.key());
        let part = *self.known.entry(key).or_insert(next);
        if part == next {
            let entry = StyleChange { colour: ColourChange::Set(colour), level, ..widths.into() };
            self.parts.push((block, BlockFrame::new(frame.scale, entry)));
        }
        let [x, y, z] = times(frame.at, self.drawing.unit());
        let [x0, y0, z0] = self.drawing.start;
        self.scene.nodes.push(Node { part, at: [x0 + x, y0 + y, z0 + z], rotation: frame.heading.quaternion() });
        Ok(())
    }

    /// Adds the meshes of the next part.
    fn add(&mut self, made: MeshParts) -> Result<(), Diagnostic> {
        let most = self.options.most;
        let left = most.checked_sub(made.count);
        self.options.most = left.ok_or_else(|| Diagnostic::limit(LimitName::Mesh, most, None))?;
        self.take_memory(made.meshes.iter().map(|(_, mesh)| mesh.bytes()).sum())?;
        let mut part = vec![];
        for (material, mesh) in made.meshes {
            if !mesh.triangles.is_empty() {
                part.push((material, self.share(mesh)));
            }
        }
        self.scene.parts.push(part);
        Ok(())
    }

    fn take_memory(&mut self, bytes: u64) -> Result<(), Diagnostic> {
        let memory = self.options.memory;
        let left = memory.checked_sub(bytes);
        self.options.memory = left.ok_or_else(|| Diagnostic::limit(LimitName::Memory, memory, None))?;
        Ok(())
    }

    /// Adds a mesh, if no equal one is there, and returns its index. Equal parts of different colours share their meshes.
    fn share(&mut self, mesh: Mesh) -> usize {
        let mesh = if self.scene.has_colours { mesh } else { Mesh { colours: vec![], ..mesh } };
        let mut hash = DefaultHasher::new();
        mesh.triangles.len().hash(&mut hash);
        mesh.positions.iter().flatten().for_each(|value| value.to_bits().hash(&mut hash));
        let alike = self.meshes.entry(hash.finish()).or_default();
        if let Some(&same) = alike.iter().find(|&&other| self.scene.meshes[other] == mesh) {
            return same;
        }
        let next = self.scene.meshes.len();
        alike.push(next);
        self.scene.meshes.push(mesh);
        next
    }

    /// Removes parts without triangles, and their nodes.
    fn drop_empty(&mut self) {
        let mut kept = 0;
        let numbers: Vec<Option<usize>> = (self.scene.parts.iter())
            .map(|part| {
                kept += usize::from(!part.is_empty());
                (!part.is_empty()).then(|| kept - 1)
            })
            .collect();
        self.scene.parts.retain(|part| !part.is_empty());
        self.scene.nodes.retain_mut(|node| {
            numbers[node.part].is_some_and(|part| {
                node.part = part;
                true
            })
        });
    }
}
