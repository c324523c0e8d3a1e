//! The plan of a compact file: its symbols, and the strokes, polygons and placed symbols in them.

use super::styled_drawing::StyledDrawing;
use crate::strokes::{PATH, StrokeLook};
use core::ops::Range;
use lsystem_drawing::{BlockId, Directions, Frame, Item, Line, StyleChange};
use lsystem_syntax::{Heading, Meter, Progress};
use std::collections::{BinaryHeap, HashMap};

/// The content of a compact file, planned in steps.
#[derive(Clone, Debug)]
pub(super) struct CompactPlan {
    /// Blocks of at most this many strokes are written out at each place.
    small: u32,
    /// The number of strokes, vertices of polygons and placed blocks that may still be planned.
    left: u64,
    directions: Directions,
    symbols: Vec<Symbol>,
    /// The parts of all symbols, symbol by symbol.
    parts: Vec<SymbolPart>,
    /// The vertices of all polygons.
    vertices: Vec<[f64; 2]>,
    /// Symbols by block, scale, colour index, level and width.
    known: HashMap<(BlockId, u64, i32, u32, u64), usize>,
    /// Symbols whose parts are not planned yet, by block.
    pending: BinaryHeap<(BlockId, usize)>,
    /// The symbol being planned.
    current: usize,
    /// The blocks of the current symbol that are being read, outermost first: the items that remain, and the frame.
    open: Vec<(Range<u32>, Frame)>,
    /// The symbols that are defined once and placed by `<use>`, children after parents. Other symbols are written in
    /// place.
    pub(super) shared: Vec<usize>,
    /// The number of copies that expanding the whole picture makes.
    pub(super) instances: u128,
}

/// A block at a scale and in a style.
#[derive(Clone, Debug)]
struct Symbol {
    /// The frame of the symbol, at the origin.
    frame: Frame,
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
    pub(super) fn new(styled: &StyledDrawing<'_>, root: BlockId, scale: f64, small: u32, most: u64) -> Self {
        let mut plan = Self {
            small,
            left: most,
            directions: Directions::default(),
            symbols: vec![],
            parts: vec![],
            vertices: vec![],
            known: HashMap::new(),
            pending: BinaryHeap::new(),
            current: Self::WHOLE,
            open: vec![],
            shared: vec![],
            instances: 0,
        };
        let whole = plan.symbol(styled, root, scale, &StyleChange::start(styled.drawing.width));
        plan.symbols[whole].copies = 1;
        plan
    }

    /// Continues the plan until the meter is spent; `None` if the plan exceeds its limit.
    pub(super) fn step(&mut self, styled: &StyledDrawing<'_>, meter: &mut Meter) -> Option<Progress> {
        while !meter.is_spent() {
            meter.charge(4);
            let Some((items, frame)) = self.open.last_mut() else {
                if !self.begin(styled) {
                    return Some(Progress::Done);
                }
                continue;
            };
            match items.next() {
                Some(item) => {
                    let frame = *frame;
                    self.read(styled, &styled.drawing.items[item as usize], &frame, meter)?;
                }
                None => {
                    self.open.pop();
                }
            }
        }
        Some(Progress::More)
    }

    /// Begins the next symbol. Returns whether there was one.
    fn begin(&mut self, styled: &StyledDrawing<'_>) -> bool {
        // Blocks come before the blocks that contain them, so a planned symbol is never used again.
        let Some((block, current)) = self.pending.pop() else { return false };
        let symbol = &mut self.symbols[current];
        symbol.parts = self.parts.len()..self.parts.len();
        if symbol.uses > 1 {
            self.shared.push(current);
            self.instances = self.instances.saturating_add(symbol.copies);
        }
        self.current = current;
        self.open.push((styled.drawing.blocks[block.0 as usize].items.clone(), symbol.frame));
        true
    }

    /// Adds an item to the current symbol, or opens its block to write it out.
    fn read(&mut self, styled: &StyledDrawing<'_>, item: &Item, frame: &Frame, meter: &mut Meter) -> Option<()> {
        let drawing = styled.drawing;
        let stroke = |line: &Line, frame: &Frame| {
            SymbolPart::Stroke(
                frame.transform(line.from),
                frame.transform(line.to),
                styled.look(&frame.style.then(&line.style)),
            )
        };
        let part = match item {
            Item::Stroke(own) => stroke(&Line::new(own, drawing), frame),
            Item::Polygon(polygon) => {
                self.left = self.left.checked_sub(u64::from(polygon.count) - 1)?;
                meter.charge(u64::from(polygon.count) / 8);
                let first = self.vertices.len();
                self.vertices.extend(drawing.vertices_of(polygon).iter().map(|&vertex| frame.transform(vertex)));
                let style = frame.style.then(&drawing.styles[polygon.style.0 as usize]);
                SymbolPart::Polygon(first..self.vertices.len(), styled.look(&style).rgb)
            }
            Item::Block(placed) => {
                let inner = frame.place(placed, drawing, &mut self.directions);
                match styled.features.one_stroke(placed.block, inner.scale) {
                    Some(line) => stroke(line, &inner),
                    None if styled.features.strokes(placed.block) <= self.small => {
                        self.open.push((drawing.blocks[placed.block.0 as usize].items.clone(), inner));
                        return Some(());
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
        self.left = self.left.checked_sub(1)?;
        self.parts.push(part);
        self.symbols[self.current].parts.end = self.parts.len();
        Some(())
    }

    /// The symbol of a block. A new symbol becomes pending.
    fn symbol(&mut self, styled: &StyledDrawing<'_>, block: BlockId, scale: f64, style: &StyleChange) -> usize {
        let entry = styled.entry(block, style);
        let key = (block, scale.to_bits(), entry.colour, entry.level, entry.width.to_bits());
        let next = self.symbols.len();
        let symbol = *self.known.entry(key).or_insert(next);
        if symbol == next {
            let frame = Frame::new(scale, entry.into());
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
