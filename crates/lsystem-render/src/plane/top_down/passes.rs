//! Pictures of broad strokes in one colour, painted in passes from coarse to fine.
//!
//! The order of painting is free there. Of blocks that are small beside the width of their strokes, one stroke each covers
//! most of what the others would add slivers to.

use super::Easel;
use crate::plane::descent::Node;
use crate::plane::painter::Painter;
use lsystem_drawing::{Drawing, Item};

/// From pass to pass the grain becomes finer by this.
const FINER: f64 = 4.0;
/// A grain of this, in subsamples, is fine enough.
const FINE: f64 = 32.0;
/// So many items of a block are looked at for one stroke of it, and so many for one stroke of the whole.
const LOOKED_AT: [usize; 2] = [4096, 1 << 15];

/// The passes of a picture.
#[derive(Default)]
pub(in crate::plane) struct Passes {
    /// The whole drawing, where it is painted in passes.
    root: Option<Node>,
    /// The extent of blocks of which this pass paints one stroke only; 0 in the last pass.
    pub grain: f64,
}

impl Passes {
    /// Starts a picture in passes.
    pub(in crate::plane) fn begin(&mut self, root: Node) {
        (self.root, self.grain) = (Some(root), f64::INFINITY);
    }

    /// Starts the next pass, if there is one: the whole drawing, and whether it is the first pass.
    pub(in crate::plane) fn next(&mut self, painter: &Painter, drawing: &Drawing) -> Option<(Node, bool)> {
        let root = self.root.filter(|_| self.grain > 0.0)?;
        let first = self.grain.is_infinite();
        self.grain = match self.grain {
            // Without repeats each pass would go through all there is.
            _ if first && painter.repeats => painter.widest(drawing, &root),
            grain if !first && grain > FINE => grain / FINER,
            _ => 0.0,
        };
        Some((root, first))
    }
}

/// Paints a stroke of a block: one that is near the middle of the picture, of which it may cover all.
pub(in crate::plane) fn sketch(easel: &mut Easel<'_>, node: &Node) -> u64 {
    let Easel { drawing, shapes, painter, descent } = easel;
    let mut node = *node;
    let choice = painter.inks.choice;
    let middle = painter.canvases[0].size().map(|side| side / 2.0);
    let away = |p: [f64; 2]| libm::hypot(p[0] - middle[0], p[1] - middle[1]);
    let mut looked_at = 0;
    let work = loop {
        // The last pass paints every stroke, so that none need be found here.
        let items = drawing.items_of(node.block);
        let every = items.len().div_ceil(LOOKED_AT[0]).max(1);
        looked_at += items.len() / every;
        if looked_at > LOOKED_AT[1] {
            break 0;
        }
        // Always on into what is nearest.
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
