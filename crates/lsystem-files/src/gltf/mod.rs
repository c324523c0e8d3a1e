//! Drawings in space as binary glTF 2.0 (`.glb`), the format of viewers, browsers and game engines.
//!
//! The drawing's graph becomes a scene: each part is a mesh that is written once, and nodes place it. Parts are shared by
//! plain nodes, which every viewer reads; the extension `EXT_mesh_gpu_instancing` is unknown to many. A node of glTF has
//! one parent, so that nodes cannot share inner nodes as blocks do: the file has a node for each copy. [`Choice`] finds
//! the size of parts with the smallest file.

mod choice;
mod scene;

use crate::compact::visible;
use choice::Choice;
use core::hash::{Hash, Hasher};
use lsystem_drawing::{
    BlockId, ColourChange, Drawing, Frame, Mesh, MeshForm, MeshMaker, MeshOptions, Solid, StyleChange, WidthChange,
    times,
};
use lsystem_syntax::{ColourBy, Diagnostic, LimitName, MAX_MESH_COPIES, Meter, Progress, Style};
use scene::{Data, Node, Scene, linear};
use std::collections::HashMap;
use std::collections::hash_map::DefaultHasher;

/// Writes a drawing: a material for each colour of strokes and of polygons, or colours at the corners where the colour
/// runs along the path. `name` becomes the name of the scene's outermost node. A drawing without strokes and polygons
/// gives an empty scene.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the file would have more than `most` segments, vertices of polygons
/// and nodes, or if a viewer would draw more than [`MAX_MESH_COPIES`] segments and vertices.
pub fn write_glb(drawing: &Drawing<Solid>, style: &Style, most: u64, name: &str) -> Result<Vec<u8>, Diagnostic> {
    let mut writer = GlbWriter::new(drawing, style, most, u64::MAX, name)?;
    let mut bytes = vec![];
    while writer.step(drawing, style, &mut bytes, u64::MAX)? == Progress::More {}
    Ok(bytes)
}

/// A writer of GLB in steps. It holds no drawing, and the caller may remove the written bytes between two steps.
#[derive(Clone, Debug)]
pub struct GlbWriter {
    options: MeshOptions,
    scene: Scene,
    /// The blocks of the parts and their frames, by part. Part 0 is what lies outside all other parts.
    blocks: Vec<(BlockId, Frame<Solid>)>,
    /// The parts by block, scale, colour index, level and width.
    known: HashMap<(BlockId, u64, i32, u32, u64), usize>,
    /// The indices of meshes by a hash of their corners.
    meshes: HashMap<u64, Vec<usize>>,
    stage: Stage,
    /// By sRGB value: the linear value.
    linear: Vec<u16>,
    spent: u64,
}

#[derive(Clone, Debug)]
enum Stage {
    /// Finding the size of parts.
    Choose(Box<Choice>),
    /// Making the mesh of a part.
    Make(Box<MeshMaker>),
    Head,
    Data(Data),
}

/// The bytes of the file's head that are written in a unit of work.
const HEAD_BYTES: u64 = 16;
/// The bytes of a node in memory and in the file's head.
const NODE_BYTES: u64 = 256;

impl GlbWriter {
    /// A writer for a drawing that takes at most `memory` bytes.
    ///
    /// # Errors
    /// As [`write_glb`].
    pub fn new(
        drawing: &Drawing<Solid>,
        style: &Style,
        most: u64,
        memory: u64,
        name: &str,
    ) -> Result<Self, Diagnostic> {
        if drawing.size() > u128::from(MAX_MESH_COPIES) {
            return Err(Diagnostic::limit(LimitName::MeshCopies, MAX_MESH_COPIES, None));
        }
        let by_colour = style.colour_by != ColourBy::Path;
        let form = MeshForm::Apart { by_colour };
        let options = MeshOptions { form, most, memory, ..MeshOptions::default() };
        let stage = match Choice::new(drawing, most).filter(|_| by_colour) {
            Some(choice) => Stage::Choose(Box::new(choice)),
            None => Stage::Make(Box::new(MeshMaker::new(drawing, style, &options)?)),
        };
        let linear = (0..=u8::MAX).map(|value| libm::round(linear(value) * f64::from(u16::MAX)) as u16).collect();
        let scene = Scene { name: name.to_owned(), has_colours: !by_colour, ..Scene::default() };
        let (known, meshes) = (HashMap::new(), HashMap::new());
        Ok(Self { options, scene, blocks: vec![], known, meshes, stage, linear, spent: 0 })
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Appends bytes for about `work` units of work. Every call needs the same drawing and style.
    ///
    /// # Errors
    /// As [`write_glb`].
    pub fn step(
        &mut self,
        drawing: &Drawing<Solid>,
        style: &Style,
        bytes: &mut Vec<u8>,
        work: u64,
    ) -> Result<Progress, Diagnostic> {
        let mut meter = Meter::new(work);
        let mut progress = Progress::More;
        while progress == Progress::More && !meter.is_spent() {
            match &mut self.stage {
                Stage::Choose(choice) => {
                    if choice.step(drawing, &mut meter) == Progress::Done {
                        self.options.whole = choice.best();
                        self.stage = Stage::Make(Box::new(MeshMaker::new(drawing, style, &self.options)?));
                    }
                }
                Stage::Make(maker) => {
                    let before = maker.spent();
                    let done = maker.step(drawing, style, meter.left())? == Progress::Done;
                    meter.charge(maker.spent() - before);
                    let (blocks, width) = (maker.take_blocks(), maker.least_width());
                    for (block, frame) in blocks {
                        self.place(drawing, style, width, block, &frame)?;
                    }
                    if done {
                        self.end_part(drawing, style)?;
                    }
                }
                Stage::Head => {
                    let head = self.scene.head();
                    meter.charge(head.len() as u64 / HEAD_BYTES);
                    bytes.extend(head);
                    self.stage = Stage::Data(Data::default());
                }
                Stage::Data(data) => progress = data.step(&self.scene, &self.linear, bytes, &mut meter),
            }
        }
        self.spent = self.spent.saturating_add(meter.spent());
        Ok(progress)
    }

    /// Places a part. A new part is made later. Tubes have at least the width `least`, in model units.
    fn place(
        &mut self,
        drawing: &Drawing<Solid>,
        style: &Style,
        least: f64,
        block: BlockId,
        frame: &Frame<Solid>,
    ) -> Result<(), Diagnostic> {
        let left = self.options.memory.checked_sub(NODE_BYTES);
        self.options.memory = left.ok_or_else(|| Diagnostic::limit(LimitName::Memory, self.options.memory, None))?;
        let (colour, level) = visible(style, &frame.style);
        let width = frame.style.width.of(0.0);
        // If all tubes have the least width, the width is not visible.
        let widest = drawing.blocks[block.0 as usize].widest.of(width) * drawing.step.abs();
        let width = if widest <= least { 0.0 } else { width };
        let next = self.blocks.len() + 1;
        let key = (block, frame.scale.to_bits(), colour, level, width.to_bits());
        let part = *self.known.entry(key).or_insert(next);
        if part == next {
            let width = WidthChange { factor: 0.0, offset: width };
            let entry = StyleChange { colour: ColourChange::Set(colour), width, level };
            self.blocks.push((block, Frame::new(frame.scale, entry)));
        }
        let [x, y, z] = times(frame.at, drawing.unit());
        let [x0, y0, z0] = drawing.start;
        self.scene.nodes.push(Node { part, at: [x0 + x, y0 + y, z0 + z], rotation: frame.heading.quaternion() });
        Ok(())
    }

    /// Ends the mesh of a part, and begins the next.
    fn end_part(&mut self, drawing: &Drawing<Solid>, style: &Style) -> Result<(), Diagnostic> {
        let made = self.scene.parts.len();
        let next = self.blocks.get(made).copied();
        let Stage::Make(maker) = core::mem::replace(&mut self.stage, Stage::Head) else { return Ok(()) };
        let MeshOptions { most, memory, .. } = self.options;
        let left = most.checked_sub(maker.count());
        self.options.most = left.ok_or_else(|| Diagnostic::limit(LimitName::Mesh, most, None))?;
        let left = memory.checked_sub(maker.bytes());
        self.options.memory = left.ok_or_else(|| Diagnostic::limit(LimitName::Memory, memory, None))?;
        let mut part = vec![];
        for (material, mesh) in maker.finish_apart() {
            if !mesh.triangles.is_empty() {
                part.push((material, self.share(mesh)));
            }
        }
        self.scene.parts.push(part);
        if made == 0 {
            self.scene.nodes.insert(0, Node { part: 0, at: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0] });
        }
        match next {
            Some((block, frame)) => {
                let options = MeshOptions { whole: 0, ..self.options };
                self.stage = Stage::Make(Box::new(MeshMaker::within(drawing, style, &options, block, &frame)));
            }
            None => self.drop_empty(),
        }
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
