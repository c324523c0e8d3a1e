//! Pictures of broad strokes in one colour, painted in passes from coarse to fine.
//!
//! In one colour the order of painting is free. If a block is small beside the width of its strokes, one stroke covers
//! most of the block, and the others only add slivers.

use super::Context;
use crate::plane::descent::Node;
use crate::plane::painter::Painter;
use lsystem_drawing::{Drawing, Item};

/// The grain of each pass is that of the pass before, divided by this.
const FINER: f64 = 4.0;
/// A grain up to this, in subsamples (8 pixels), is followed by the last pass.
const FINEST_GRAIN: f64 = 32.0;
/// The most items that are looked at in a block for one stroke of it.
const MAX_ITEMS_OF_BLOCK: usize = 4096;
/// The most items that are looked at in all blocks on the way to that stroke.
const MAX_ITEMS: usize = 1 << 15;

/// The passes of a picture.
#[derive(Default)]
pub(in crate::plane) struct Passes {
    /// The root, if the picture is painted in passes.
    root: Option<Node>,
    /// In this pass blocks up to this extent, in subsamples, are one stroke; 0 in the last pass.
    pub grain: f64,
}

impl Passes {
    /// Starts a picture in passes.
    pub(in crate::plane) fn begin(&mut self, root: Node) {
        (self.root, self.grain) = (Some(root), f64::INFINITY);
    }

    /// Starts the next pass. Returns the root and whether the pass is the first; `None` after the last pass.
    pub(in crate::plane) fn next(&mut self, painter: &Painter, drawing: &Drawing) -> Option<(Node, bool)> {
        let root = self.root.filter(|_| self.grain > 0.0)?;
        let first = self.grain.is_infinite();
        self.grain = match self.grain {
            // Without repeats each pass would visit every segment, so the last pass follows at once.
            _ if first && painter.repeats => painter.widest(drawing, &root),
            grain if !first && grain > FINEST_GRAIN => grain / FINER,
            _ => 0.0,
        };
        Some((root, first))
    }
}

/// Paints one stroke of a block: a stroke near the middle of the picture, because it may cover the whole picture.
pub(in crate::plane) fn sketch(context: &mut Context<'_>, node: &Node) -> u64 {
    let Context { drawing, shapes, painter, descent } = context;
    let mut node = *node;
    let choice = painter.inks.choice;
    let middle = painter.canvases[0].size().map(|side| side / 2.0);
    let away = |p: [f64; 2]| libm::hypot(p[0] - middle[0], p[1] - middle[1]);
    let mut looked_at = 0;
    let work = loop {
        // The search may fail: the last pass paints every stroke.
        let items = drawing.items_of(node.block);
        let every = items.len().div_ceil(MAX_ITEMS_OF_BLOCK).max(1);
        looked_at += items.len() / every;
        if looked_at > MAX_ITEMS {
            break 0;
        }
        // The search descends into the nearest block.
        let (mut least, mut next, mut nearest) = (f64::INFINITY, None, None);
        for item in items.iter().step_by(every) {
            match item {
                Item::Stroke(stroke) => {
                    let ends = [stroke.from, stroke.to].map(|p| node.place.point(p));
                    let distance = ends.map(away).into_iter().fold(f64::INFINITY, f64::min);
                    if distance < least {
                        let pen = node.pen.after(choice, &drawing.styles[stroke.style.0 as usize]);
                        (least, next, nearest) = (distance, None, Some((ends, pen)));
                    }
                }
                Item::Block(placed) if shapes[placed.block.0 as usize].strokes > 0 => {
                    let child = descent.child(drawing, choice, &node, placed);
                    let distance = away(child.place.point(shapes[placed.block.0 as usize].centre));
                    if distance < least {
                        (least, next, nearest) = (distance, Some(child), None);
                    }
                }
                _ => {}
            }
        }
        if let Some((ends, pen)) = nearest {
            break painter.stroke(0, ends, pen);
        }
        let Some(child) = next else { break 0 };
        if let Some(work) = painter.straight(drawing, &shapes[child.block.0 as usize], &child, true) {
            break work;
        }
        node = child;
    };
    painter.add_work(looked_at as u64);
    looked_at as u64 + work
}
