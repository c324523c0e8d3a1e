//! What readers of blocks look into.

use super::{Block, BlockId, Item};
use crate::Space;

/// What blocks hold, while they are made and when they are.
#[derive(Clone, Copy, Debug)]
pub struct Contents<'a, S: Space> {
    pub blocks: &'a [Block<S>],
    pub items: &'a [Item<S>],
    pub corners: &'a [S::Point],
    pub vertices: &'a [S::Point],
}

impl<'a, S: Space> Contents<'a, S> {
    /// A block's items.
    pub fn items_of(&self, block: BlockId) -> &'a [Item<S>] {
        let range = &self.blocks[block.0 as usize].items;
        &self.items[range.start as usize..range.end as usize]
    }
}
