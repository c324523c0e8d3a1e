//! What readers of blocks look into.

use super::{Block, BlockId, Item};
use crate::Space;

/// What blocks hold, while they are made and when they are.
#[derive(Clone, Copy, Debug)]
pub struct Contents<'a, S: Space> {
    pub(crate) blocks: &'a [Block<S>],
    pub(crate) items: &'a [Item<S>],
    pub(crate) corners: &'a [S::Point],
    pub(crate) vertices: &'a [S::Point],
}

impl<'a, S: Space> Contents<'a, S> {
    /// A block's items.
    pub(crate) fn items_of(&self, block: BlockId) -> &'a [Item<S>] {
        let range = &self.blocks[block.0 as usize].items;
        &self.items[range.start as usize..range.end as usize]
    }
}
