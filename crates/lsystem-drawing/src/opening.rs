//! The search for the symbol that opens a polygon.

use crate::drawing::{BlockId, Item, Pieces, Space, StateWord, StateWords};
use crate::{Drawing, System};
use core::ops::Range;
use lsystem_base::sorted::set;
use lsystem_derive::{LetterId, Word};

/// The position (0-based, saturating) in generation `n` of the symbol that opens polygon `number` (0-based, in the
/// order of opening). `drawing` is the drawing of generation `n`. `None` beyond the last polygon.
#[must_use]
pub fn symbol_of_polygon<S: Space>(system: &System, n: u32, drawing: &Drawing<S>, number: u128) -> Option<u128> {
    match &drawing.pieces {
        _ if !drawing.is_memoised() => drawing.polygon(number).map(|(polygon, _)| polygon.symbol.into()),
        Pieces::States(words) => {
            let depth = words.levels.len();
            opening(drawing, words, words.members(words.axiom.clone(), depth), number)
        }
        Pieces::Letters(_) => {
            let letters = LetterSuccessors { drawing, word: system.word(n)? };
            opening(drawing, &letters, letters.letters(&system.rules.axiom.letters, n), number)
        }
        Pieces::None => None,
    }
}

/// The successors of symbols.
trait Successors {
    /// A symbol that is rewritten, with the number of derivation steps left.
    type Node: Copy;

    /// The word that replaces a symbol.
    fn successor(&self, node: Self::Node) -> Option<Vec<Member<Self::Node>>>;
}

/// A symbol of a word.
struct Member<N> {
    /// If the symbol is rewritten: its node, and the blocks that its derivation may draw: usually, and while left and
    /// right turns are exchanged.
    inner: Option<(N, [Option<BlockId>; 2])>,
    /// The number of symbols in its derivation; saturating.
    symbols: u128,
}

/// The words of plain letters, from the rules.
struct LetterSuccessors<'a, S: Space> {
    drawing: &'a Drawing<S>,
    word: Word<'a>,
}

impl<S: Space> LetterSuccessors<'_, S> {
    fn letters(&self, letters: &[LetterId], depth: u32) -> Vec<Member<(LetterId, u32)>> {
        let member = |&letter: &LetterId| {
            let [usual, other] = [false, true].map(|swapped| self.drawing.piece_of(letter, depth, swapped));
            let blocks = [usual, other].map(|piece| piece.and_then(|piece| piece.block));
            Member { inner: usual.map(|_| ((letter, depth), blocks)), symbols: self.word.derived(letter, depth) }
        };
        letters.iter().map(member).collect()
    }
}

impl<S: Space> Successors for LetterSuccessors<'_, S> {
    type Node = (LetterId, u32);

    fn successor(&self, (letter, depth): Self::Node) -> Option<Vec<Member<Self::Node>>> {
        Some(self.letters(self.word.successor(letter, depth)?, depth - 1))
    }
}

/// The words of modules with parameters, kept from the making of the drawing.
impl Successors for StateWords {
    /// The module's state, and the number of derivation steps left.
    type Node = (u32, usize);

    fn successor(&self, (state, depth): Self::Node) -> Option<Vec<Member<Self::Node>>> {
        let depth = depth.checked_sub(1)?;
        let StateWord { modules, .. } = self.levels.get(depth)?.get(state as usize)?;
        Some(self.members(modules.clone(), depth))
    }
}

impl StateWords {
    fn members(&self, modules: Range<u32>, depth: usize) -> Vec<Member<(u32, usize)>> {
        let states = depth.checked_sub(1).and_then(|below| self.levels.get(below));
        let member = |&state: &Option<u32>| {
            let word = state.zip(states).and_then(|(state, states)| Some((state, states.get(state as usize)?)));
            match word {
                Some((state, word)) => Member { inner: Some(((state, depth), word.blocks)), symbols: word.symbols },
                None => Member { inner: None, symbols: 1 },
            }
        };
        self.modules[modules.start as usize..modules.end as usize].iter().map(member).collect()
    }
}

/// Finds the symbol that opens a polygon, word by word from the axiom on. Every symbol that is rewritten has its own
/// block; the polygons of the other symbols are items of the block of their word.
fn opening<S: Space, W: Successors>(
    drawing: &Drawing<S>,
    words: &W,
    axiom: Vec<Member<W::Node>>,
    number: u128,
) -> Option<u128> {
    let (mut members, mut left) = (axiom, number);
    let (mut block, mut before) = (drawing.root?, 0_u128);
    loop {
        let inner = set(members.iter().filter_map(|m| m.inner.as_ref()).flat_map(|m| m.1).flatten());
        let mut contents = WordContents::default();
        contents.collect(drawing, block, &inner);
        let mut own = contents.own.into_iter().peekable();
        let mut blocks = contents.blocks.into_iter().peekable();
        // The block of the present member.
        let mut drawn = None;
        let held = members.iter().enumerate().find(|&(place, member)| {
            let mut count = 0_u128;
            match member.inner {
                Some((_, either)) => {
                    drawn = blocks.next_if(|&block| either.contains(&Some(block)));
                    count = drawn.map_or(0, |drawn| drawing.blocks[drawn.0 as usize].polygons);
                }
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
            before = before.saturating_add(member.symbols);
            false
        });
        let (_, member) = held?;
        let Some((node, _)) = member.inner else { return Some(before) };
        block = drawn?;
        members = words.successor(node)?;
    }
}

/// The contents of a word's block, in order.
#[derive(Default)]
struct WordContents {
    /// The places of the word's own symbols that open polygons.
    own: Vec<u32>,
    /// The blocks of the symbols that are rewritten.
    blocks: Vec<BlockId>,
}

impl WordContents {
    /// Collects the contents of a block. The block of a long word contains blocks of its parts.
    fn collect<S: Space>(&mut self, drawing: &Drawing<S>, block: BlockId, inner: &[BlockId]) {
        // `inner` is sorted. If only one symbol of a word draws, the word has that symbol's block.
        if inner.binary_search(&block).is_ok() {
            self.blocks.push(block);
            return;
        }
        for item in drawing.items_of(block) {
            match item {
                Item::Stroke(_) => {}
                Item::Polygon(polygon) => self.own.push(polygon.symbol),
                Item::Block(placed) => self.collect(drawing, placed.block, inner),
            }
        }
    }
}
