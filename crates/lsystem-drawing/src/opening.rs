//! Which symbol opens a polygon.

use crate::drawing::{BlockId, Item, Space};
use crate::{Drawing, System};
use lsystem_derive::{LetterId, Word};

/// The position of the symbol that opens the polygon `number` (0-based, in the order in which they are opened) of
/// generation `n`, which `drawing` shows; saturating. `None` beyond the last polygon.
#[must_use]
pub fn symbol_of_polygon<S: Space>(system: &System, n: u32, drawing: &Drawing<S>, number: u128) -> Option<u128> {
    if drawing.is_memoised() {
        opening(&system.word(n)?, (&system.rules.axiom.letters, n), drawing, drawing.root?, number)
    } else {
        drawing.polygon(number).map(|(polygon, _)| polygon.symbol.into())
    }
}

/// What polygons a drawing has, in whatever space.
trait Filled {
    /// The block of what a letter that is rewritten becomes in `depth` steps, if it draws anything.
    fn inner(&self, symbol: LetterId, depth: u32) -> Option<Option<BlockId>>;

    /// How many polygons a block fills.
    fn polygons(&self, block: BlockId) -> u128;

    /// The places of the symbols that open those among its items.
    fn opened(&self, block: BlockId) -> Vec<u32>;
}

impl<S: Space> Filled for Drawing<S> {
    fn inner(&self, symbol: LetterId, depth: u32) -> Option<Option<BlockId>> {
        self.piece(symbol, depth).map(|piece| piece.block)
    }

    fn polygons(&self, block: BlockId) -> u128 {
        self.blocks[block.0 as usize].polygons
    }

    fn opened(&self, block: BlockId) -> Vec<u32> {
        let opened = |item: &Item<S>| if let Item::Polygon(polygon) = item { Some(polygon.symbol) } else { None };
        self.items_of(block).iter().filter_map(opened).collect()
    }
}

/// As [`symbol_of_polygon`]. Every letter that is rewritten has a block of its own, and the polygons of those that
/// stay are among the items of the block of their word.
fn opening(
    word: &Word<'_>,
    (axiom, n): (&[LetterId], u32),
    drawing: &dyn Filled,
    root: BlockId,
    number: u128,
) -> Option<u128> {
    let (mut letters, mut depth, mut left) = (axiom, n, number);
    let (mut block, mut before) = (root, 0_u128);
    loop {
        // A word that draws nothing but what one of its letters does has that one's block.
        let alone = letters.iter().any(|&symbol| drawing.inner(symbol, depth) == Some(Some(block)));
        let mut own = if alone { vec![] } else { drawing.opened(block) }.into_iter().peekable();
        let held = letters.iter().enumerate().find(|&(place, &symbol)| {
            let mut count = 0_u128;
            match drawing.inner(symbol, depth) {
                Some(inner) => count = inner.map_or(0, |inner| drawing.polygons(inner)),
                None => {
                    while own.next_if_eq(&(place as u32)).is_some() {
                        count += 1;
                    }
                }
            }
            if left < count {
                return true;
            }
            left -= count;
            before = before.saturating_add(word.derived(symbol, depth));
            false
        });
        let (_, &symbol) = held?;
        let Some(inner) = drawing.inner(symbol, depth) else { return Some(before) };
        block = inner?;
        (letters, depth) = (word.successor(symbol, depth)?, depth - 1);
    }
}
