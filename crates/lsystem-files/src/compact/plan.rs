//! The plan of a compact file: its symbols, and the strokes, polygons and placed symbols in them.

use super::styled_drawing::StyledDrawing;
use crate::strokes::{PATH, StrokeLook, cone};
use core::ops::Range;
use lsystem_base::LimitName;
use lsystem_drawing::{BlockFrame, BlockId, Directions, Item, Line, StyleChange, Widths};
use lsystem_syntax::{Diagnostic, Halt, Heading, Work};
use std::collections::{BinaryHeap, HashMap};

/// The content of a compact file.
pub(super) struct CompactPlan {
    /// Blocks of at most this many strokes are written out at each place.
    small: u32,
    /// The most strokes, vertices of polygons and placed blocks, and how many may still be planned.
    most: u64,
    left: u64,
    directions: Directions,
    symbols: Vec<Symbol>,
    /// The parts of all symbols, symbol by symbol.
    parts: Vec<SymbolPart>,
    /// The vertices of all polygons.
    vertices: Vec<[f64; 2]>,
    /// Symbols by block, scale, colour index, level and width.
    known: HashMap<(BlockId, u64, i32, u32, [u64; 2]), usize>,
    /// Symbols whose parts are not planned yet, by block.
    pending: BinaryHeap<(BlockId, usize)>,
    /// The symbol being planned.
    current: usize,
    /// The symbols that are defined once and placed by `<use>`, children after parents. Other symbols are written in
    /// place.
    pub(super) shared: Vec<usize>,
    /// The number of copies that expanding the whole picture makes.
    pub(super) copies: u128,
    /// The number of strokes and polygons in the expanded picture.
    pub(super) painted: u128,
}

/// A block at a scale and in a style.
#[derive(Clone, Debug)]
struct Symbol {
    /// The frame of the symbol, at the origin.
    frame: BlockFrame,
    parts: Range<usize>,
    /// The number of places in the file where the symbol is used.
    uses: usize,
    /// The number of copies when the whole picture is expanded.
    copies: u128,
}

/// A part of a symbol, in pixels, y up.
#[derive(Clone, Debug)]
pub(super) enum SymbolPart {
    Stroke([f64; 2], [f64; 2], StrokeLook),
    /// A polygon: the range of its vertices in the plan, and its colour.
    Polygon(Range<usize>, [u8; 3]),
    /// A placed symbol: its index, position and heading.
    Use(usize, [f64; 2], Heading),
}

impl CompactPlan {
    /// The symbol that is the whole picture.
    pub(super) const WHOLE: usize = 0;

    /// A plan that writes out blocks of at most `small` strokes at each place, and has at most `most` strokes, vertices
    /// of polygons and placed blocks. One unit of the root is `scale` pixels.
    pub(super) fn new(
        styled: &StyledDrawing<'_>,
        root: BlockId,
        scale: f64,
        small: u32,
        most: u64,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
        let mut plan = Self {
            small,
            most,
            left: most,
            directions: Directions::default(),
            symbols: vec![],
            parts: vec![],
            vertices: vec![],
            known: HashMap::new(),
            pending: BinaryHeap::new(),
            current: Self::WHOLE,
            shared: vec![],
            copies: 0,
            painted: 0,
        };
        let whole = plan.symbol(styled, root, scale, &StyleChange::start(styled.drawing.width));
        plan.symbols[whole].copies = 1;
        // Blocks come before the blocks that contain them, so a planned symbol is never used again.
        while let Some((block, symbol)) = plan.pending.pop() {
            plan.fill(styled, block, symbol, work)?;
        }
        Ok(plan)
    }

    /// Plans the parts of a symbol.
    fn fill(
        &mut self,
        styled: &StyledDrawing<'_>,
        block: BlockId,
        current: usize,
        work: &mut dyn Work,
    ) -> Result<(), Halt> {
        self.current = current;
        let symbol = &mut self.symbols[current];
        symbol.parts = self.parts.len()..self.parts.len();
        if symbol.uses > 1 {
            self.shared.push(current);
            self.copies = self.copies.saturating_add(symbol.copies);
        }
        // The blocks being read, outermost first: the items that remain, and the frame.
        let mut open = vec![(styled.drawing.items_of(block).iter(), symbol.frame)];
        while let Some((items, frame)) = open.last_mut() {
            work.charge(4)?;
            let Some(item) = items.next() else {
                open.pop();
                continue;
            };
            let frame = *frame;
            open.extend(self.read(styled, item, &frame, work)?);
        }
        let marks = self.parts_of(current).iter().filter(|part| !matches!(part, SymbolPart::Use(..))).count();
        self.painted = self.painted.saturating_add(self.symbols[current].copies.saturating_mul(marks as u128));
        Ok(())
    }

    /// Adds an item to the current symbol. Returns the block that is written out in place of a placed one.
    fn read<'a>(
        &mut self,
        styled: &StyledDrawing<'a>,
        item: &Item,
        frame: &BlockFrame,
        work: &mut dyn Work,
    ) -> Result<Option<(core::slice::Iter<'a, Item>, BlockFrame)>, Halt> {
        let drawing = styled.drawing;
        let part = match item {
            Item::Stroke(own) => return self.line(styled, &Line::new(own, drawing), frame).map(|()| None),
            Item::Polygon(polygon) => {
                self.take(u64::from(polygon.count) - 1)?;
                work.charge(u64::from(polygon.count) / 8)?;
                let first = self.vertices.len();
                self.vertices.extend(drawing.vertices_of(polygon).iter().map(|&vertex| frame.transform(vertex)));
                let style = frame.style.then(&drawing.styles[polygon.style.0 as usize]);
                SymbolPart::Polygon(first..self.vertices.len(), styled.look(&style).rgb)
            }
            Item::Block(placed) => {
                let inner = frame.place(placed, drawing, &mut self.directions);
                match styled.features.one_stroke(placed.block, inner.scale) {
                    Some(line) => return self.line(styled, line, &inner).map(|()| None),
                    None if styled.features.strokes(placed.block) <= self.small => {
                        return Ok(Some((drawing.items_of(placed.block).iter(), inner)));
                    }
                    None => {
                        let target = self.symbol(styled, placed.block, inner.scale, &inner.style);
                        let copies = self.symbols[self.current].copies;
                        let symbol = &mut self.symbols[target];
                        symbol.uses += 1;
                        symbol.copies = symbol.copies.saturating_add(copies);
                        SymbolPart::Use(target, inner.at, inner.heading)
                    }
                }
            }
        };
        self.add(part)?;
        Ok(None)
    }

    /// Adds the strokes of a line to the current symbol; a stroke that tapers as its outline.
    fn line(&mut self, styled: &StyledDrawing<'_>, line: &Line, frame: &BlockFrame) -> Result<(), Halt> {
        let style = frame.style.then(&line.style);
        for (ends, widths) in line.parts(style.widths()) {
            let ends = ends.map(|end| frame.transform(end));
            let [first, last] = widths.ends().map(|own| {
                styled.look(&StyleChange { level: style.level, colour: style.colour, ..Widths::new(own).into() })
            });
            if first.width == last.width {
                self.add(SymbolPart::Stroke(ends[0], ends[1], first))?;
                continue;
            }
            let before = self.vertices.len();
            self.vertices.extend(cone(ends, [first.width, last.width]));
            self.take((self.vertices.len() - before) as u64 - 1)?;
            self.add(SymbolPart::Polygon(before..self.vertices.len(), first.rgb))?;
        }
        Ok(())
    }

    fn add(&mut self, part: SymbolPart) -> Result<(), Diagnostic> {
        self.take(1)?;
        self.parts.push(part);
        self.symbols[self.current].parts.end = self.parts.len();
        Ok(())
    }

    fn take(&mut self, count: u64) -> Result<(), Diagnostic> {
        let left = self.left.checked_sub(count);
        self.left = left.ok_or_else(|| Diagnostic::limit(LimitName::Segments, self.most, None))?;
        Ok(())
    }

    /// The symbol of a block. A new symbol becomes pending.
    fn symbol(&mut self, styled: &StyledDrawing<'_>, block: BlockId, scale: f64, style: &StyleChange) -> usize {
        let entry = styled.entry(block, style);
        let key = (block, scale.to_bits(), entry.colour, entry.level, entry.widths.key());
        let next = self.symbols.len();
        let symbol = *self.known.entry(key).or_insert(next);
        if symbol == next {
            let frame = BlockFrame::new(scale, entry.into());
            self.symbols.push(Symbol { frame, parts: 0..0, uses: 0, copies: 0 });
            self.pending.push((block, symbol));
        }
        symbol
    }

    pub(super) fn parts_of(&self, symbol: usize) -> &[SymbolPart] {
        &self.parts[self.symbols[symbol].parts.clone()]
    }

    pub(super) fn vertices_of(&self, vertices: &Range<usize>) -> &[[f64; 2]] {
        &self.vertices[vertices.clone()]
    }

    /// Whether a symbol is written as a single path.
    pub(super) fn is_one_path(&self, symbol: usize) -> bool {
        let parts = self.parts_of(symbol);
        let look = |part: &SymbolPart| if let SymbolPart::Stroke(_, _, look) = part { Some(*look) } else { None };
        let first = parts.first().and_then(look);
        first.is_some() && parts.len() <= PATH && parts.iter().all(|part| look(part) == first)
    }
}
