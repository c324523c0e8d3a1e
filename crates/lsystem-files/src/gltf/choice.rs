//! The choice of the blocks that a scene writes once and places.

use lsystem_drawing::{BlockId, Drawing, Item, Solid};
use lsystem_syntax::{Halt, Work};

/// The fewest segments and polygons of a drawing with placed parts: the file of a smaller drawing is small without them,
/// and its tubes taper across all joints.
const SMALL: u128 = 2_000;
/// The least size of a placed part, in segments and polygons. A part of fewer takes viewers as long as this one.
const LEAST: u128 = 64;
/// The most nodes of a scene. Viewers draw each node by itself, and more than some thousands take longer than a frame of
/// a film.
const MAX_NODES: u64 = 4_000;
/// The bytes of a node, and of a segment or polygon: means of files.
const NODE_BYTES: u64 = 110;
const MARK_BYTES: u64 = 600;

/// The size of parts with the smallest file: blocks of at most this many segments and polygons are parts. 0 for no parts.
/// A file may have at most `most` segments and polygons that are written out.
pub(super) fn size_of_parts(drawing: &Drawing<Solid>, most: u64, work: &mut dyn Work) -> Result<u128, Halt> {
    let all = drawing.segment_count().saturating_add(drawing.polygon_count());
    let Some(root) = drawing.root.filter(|_| drawing.is_memoised() && all > SMALL) else { return Ok(0) };
    let flat = u64::try_from(all).ok().filter(|&all| all <= most);
    // The bytes of the smallest file so far, and its size of parts.
    let mut best = flat.map(|all| (all.saturating_mul(MARK_BYTES), 0));
    let mut size = LEAST;
    while size < all {
        let (nodes, marks) = nodes_and_marks(drawing, root, size, work)?;
        let bytes = nodes.saturating_mul(NODE_BYTES).saturating_add(marks.saturating_mul(MARK_BYTES));
        if nodes <= MAX_NODES && best.is_none_or(|(best, _)| bytes < best) {
            best = Some((bytes, size));
        }
        size *= 2;
    }
    Ok(best.map_or(0, |(_, size)| size))
}

/// The nodes of a scene with parts of this size, and the segments and polygons that are written out.
fn nodes_and_marks(
    drawing: &Drawing<Solid>,
    root: BlockId,
    size: u128,
    work: &mut dyn Work,
) -> Result<(u64, u64), Halt> {
    let mut used = vec![false; drawing.block_count()];
    // By block: the nodes, and the marks outside parts. Then the marks of the parts in use.
    let (mut nodes_of, mut loose_of, mut parts) = (vec![], vec![], 0_u64);
    for block in (0..=root.0).map(BlockId) {
        work.charge(2 + drawing.items_of(block).len() as u64 / 4)?;
        let (mut nodes, mut loose) = (0_u64, 0_u64);
        if block == root || marks(drawing, block) > size {
            for item in drawing.items_of(block) {
                let Item::Block(placed) = item else {
                    loose = loose.saturating_add(1);
                    continue;
                };
                let (inner, count) = (placed.block.0 as usize, marks(drawing, placed.block));
                if count <= size && !core::mem::replace(&mut used[inner], true) {
                    parts = parts.saturating_add(count as u64);
                }
                nodes = nodes.saturating_add(nodes_of[inner]);
                loose = loose.saturating_add(loose_of[inner]);
            }
        } else {
            nodes = 1;
        }
        nodes_of.push(nodes);
        loose_of.push(loose);
    }
    let root = root.0 as usize;
    Ok((nodes_of[root], parts.saturating_add(loose_of[root])))
}

/// The number of segments and polygons of a block.
fn marks(drawing: &Drawing<Solid>, block: BlockId) -> u128 {
    let block = &drawing.blocks[block.0 as usize];
    block.segments.saturating_add(block.polygons)
}
