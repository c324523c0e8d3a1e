//! Simpler drawings in space: every block that is too fine becomes one stroke.
//!
//! The graph is simplified, not the list of its segments, so that the work does not depend on the number of segments.

use super::block::{Block, BlockId, Item, Placed, Stroke};
use super::scene::SceneSize;
use super::{BlockFrame, Drawing, Pieces};
use crate::Solid;
use crate::chunks::Chunks;
use crate::exact_path::{ExactPath, Spot};
use crate::room::bytes_of;
use crate::rotation::Vector;
use crate::style::{StyleChange, StyleId, Styles};
use lsystem_base::LimitName;
use lsystem_syntax::{Diagnostic, Halt, Work};
use std::collections::HashMap;

impl Drawing<Solid> {
    /// The drawing with one stroke in place of every block that is less than `finest` across, in parts of the longest
    /// side of the drawing.
    ///
    /// The stroke for a block begins at the point of the block's box that is nearest to the turtle at the block's entry,
    /// so that it stays joined to its parent, and goes through the middle of the box. The stroke is as wide as the
    /// block's widest stroke and has the colour of the block's last one. A stroke without length stands for a block that
    /// lies around its entry; meshes leave such strokes out. The simpler drawing has the extent of the first one, and
    /// places along the path follow the drawing order.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the simpler drawing would take more than `memory` bytes.
    pub fn simplified(&self, finest: f64, memory: u64, work: &mut dyn Work) -> Result<Self, Halt> {
        let mut simplifier = Simplifier::new(self, finest);
        while !simplifier.open.is_empty() {
            work.charge(4)?;
            if !simplifier.read(self) {
                simplifier.close(self);
                if simplifier.bytes() > memory {
                    return Err(Diagnostic::limit(LimitName::Memory, memory, None).into());
                }
            }
        }
        Ok(simplifier.finish(self))
    }
}

/// A simpler drawing in the making.
struct Simplifier {
    /// Blocks less than this across are fine, in units of the root block.
    finest: f64,
    /// The simpler blocks by block and scale.
    known: HashMap<(BlockId, u64), BlockId>,
    /// The blocks in the making, outermost first.
    open: Vec<OpenBlock>,
    blocks: Vec<Block<Solid>>,
    items: Chunks<Item<Solid>>,
    styles: Styles,
}

/// A block in the making.
struct OpenBlock {
    block: BlockId,
    /// One unit of the block in units of the root block.
    scale: f64,
    /// The number of items read.
    read: usize,
    items: Vec<Item<Solid>>,
    segments: u128,
    polygons: u128,
}

impl Simplifier {
    fn new(drawing: &Drawing<Solid>, finest: f64) -> Self {
        let longest = drawing.extent().map_or(0.0, |extent| {
            let [low, high] = extent.sides;
            (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max)
        });
        let mut simplifier = Self {
            finest: finest * longest,
            known: HashMap::new(),
            open: vec![],
            blocks: vec![],
            items: Chunks::new(),
            styles: Styles::new(),
        };
        if let Some(root) = drawing.root {
            simplifier.enter(root, 1.0);
        }
        simplifier
    }

    fn enter(&mut self, block: BlockId, scale: f64) {
        self.open.push(OpenBlock { block, scale, read: 0, items: vec![], segments: 0, polygons: 0 });
    }

    /// The bytes that the simpler drawing occupies.
    fn bytes(&self) -> u64 {
        let known = self.known.capacity() / 7 * 8 * size_of::<((BlockId, u64), BlockId)>();
        bytes_of(&self.blocks) + self.items.bytes() + self.styles.bytes() + known as u64
    }

    /// Reads the next item of the innermost open block, or opens the item's block. Returns whether there was one.
    fn read(&mut self, drawing: &Drawing<Solid>) -> bool {
        let Some(open) = self.open.last_mut() else { return false };
        let Some(item) = drawing.items_of(open.block).get(open.read) else { return false };
        let styles = &mut self.styles;
        let mut style = |id: StyleId| styles.id(&drawing.styles[id.0 as usize]);
        let (item, segments, polygons) = match *item {
            Item::Stroke(stroke) => (Item::Stroke(Stroke { style: style(stroke.style), ..stroke }), 1, 0),
            Item::Polygon(polygon) => (Item::Polygon(super::Polygon { style: style(polygon.style), ..polygon }), 0, 1),
            Item::Block(placed) => {
                let (inner, scale) = (&drawing.blocks[placed.block.0 as usize], open.scale * placed.scale);
                if 2.0 * inner.hull.radius * scale.abs() < self.finest {
                    let home = BlockFrame::new(1.0, StyleChange::NONE).place(&placed, drawing, &mut ());
                    let [from, to] = span(inner).map(|end| home.transform(end));
                    let look = home.style.then(&StyleChange {
                        width: inner.widest,
                        next: Some(inner.widest),
                        ..last(drawing, inner)
                    });
                    (Item::Stroke(Stroke { from, to, style: styles.id(&look), spot: Spot::ENTRY }), 1, 0)
                } else if let Some(&block) = self.known.get(&(placed.block, scale.to_bits())) {
                    let simple = &self.blocks[block.0 as usize];
                    let placed = Placed { block, style: style(placed.style), ..placed };
                    (Item::Block(placed), simple.segments, simple.polygons)
                } else {
                    self.enter(placed.block, scale);
                    return true;
                }
            }
        };
        open.read += 1;
        open.items.push(item);
        open.segments = open.segments.saturating_add(segments);
        open.polygons = open.polygons.saturating_add(polygons);
        true
    }

    /// Ends the innermost open block.
    fn close(&mut self, drawing: &Drawing<Solid>) {
        let Some(OpenBlock { block, scale, items, segments, polygons, .. }) = self.open.pop() else { return };
        self.known.insert((block, scale.to_bits()), BlockId(self.blocks.len() as u32));
        let items = self.items.push(items.into_iter());
        self.blocks.push(Block { items, segments, polygons, ..drawing.blocks[block.0 as usize].clone() });
    }

    fn finish(self, drawing: &Drawing<Solid>) -> Drawing<Solid> {
        Drawing {
            root: self.blocks.len().checked_sub(1).map(|last| BlockId(last as u32)),
            blocks: self.blocks,
            items: self.items,
            corners: vec![],
            vertices: drawing.vertices.clone(),
            styles: self.styles.list,
            start: drawing.start,
            step: drawing.step,
            width: drawing.width,
            pieces: Pieces::None,
            exact_path: ExactPath::new(),
            memoised: drawing.memoised,
            places: vec![],
            depths: vec![],
            wires: drawing.wires,
            symbols: drawing.symbols,
            scene: SceneSize::default(),
            extent: drawing.extent.clone(),
        }
    }
}

/// The stroke that stands for a block, in block units.
fn span(block: &Block<Solid>) -> [Vector; 2] {
    let body = &block.hull;
    let from = [0, 1, 2].map(|i| 0.0_f64.max(body.low[i]).min(body.high[i]));
    [from, [0, 1, 2].map(|i| body.low[i] + body.high[i] - from[i])]
}

/// The style of a block's last stroke or polygon.
fn last(drawing: &Drawing<Solid>, block: &Block<Solid>) -> StyleChange {
    let (mut style, mut block) = (StyleChange::NONE, block);
    loop {
        let (id, inner) = match drawing.contents(block).last() {
            None => return style,
            Some(Item::Stroke(stroke)) => (stroke.style, None),
            Some(Item::Polygon(polygon)) => (polygon.style, None),
            Some(Item::Block(placed)) => (placed.style, Some(placed.block)),
        };
        style = style.then(&drawing.styles[id.0 as usize]);
        let Some(inner) = inner else { return style };
        block = &drawing.blocks[inner.0 as usize];
    }
}
