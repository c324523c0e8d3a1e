//! Which blocks a compact picture holds, and where it writes out or places them.

use super::paths::{Ink, PATH};
use super::scene::Scene;
use core::ops::Range;
use lsystem_drawing::{BlockId, Directions, Frame, Item, Line, StyleChange};
use lsystem_syntax::{Heading, Meter, Progress};
use std::collections::{BinaryHeap, HashMap};

/// What the file will hold, found in steps.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Strokes of a block that is written out wherever it stands, at most.
    small: u32,
    /// Strokes and placed blocks that may still be written.
    left: u64,
    directions: Directions,
    symbols: Vec<Symbol>,
    /// Of all symbols, one symbol after the other, and the vertices of their polygons.
    parts: Vec<Part>,
    vertices: Vec<[f64; 2]>,
    /// Symbols by block, scale, colour index, level and width.
    known: HashMap<(BlockId, u64, i32, u32, u64), usize>,
    /// Symbols whose parts are not known yet, by block.
    pending: BinaryHeap<(BlockId, usize)>,
    /// The symbol at hand, and its blocks that are being read, outermost first: the items still to be read, and where.
    current: usize,
    open: Vec<(Range<u32>, Frame)>,
    /// The symbols that are defined once and placed by `<use>`, children after parents. Others are written where they
    /// stand.
    pub(super) shared: Vec<usize>,
    /// How many copies expanding the whole picture makes.
    pub(super) instances: u128,
}

/// A block at a scale and in a style.
#[derive(Clone, Debug)]
struct Symbol {
    /// At the origin.
    frame: Frame,
    parts: Range<usize>,
    /// How often it is placed.
    uses: usize,
    /// How often it is met when the whole picture is expanded.
    copies: u128,
}

/// What a symbol holds, in pixels, y up.
#[derive(Clone, Debug)]
pub(super) enum Part {
    Stroke([f64; 2], [f64; 2], Ink),
    /// Its vertices among the plan's, and its colour.
    Polygon(Range<usize>, [u8; 3]),
    /// Which symbol, and where.
    Use(usize, [f64; 2], Heading),
}

impl Plan {
    /// The symbol that is the whole picture.
    pub(super) const WHOLE: usize = 0;

    /// A plan in which blocks of at most `small` strokes are no symbols, and at most `most` strokes and placed blocks are
    /// written; one unit of the root is `scale` pixels.
    pub(super) fn new(scene: &Scene<'_>, root: BlockId, scale: f64, small: u32, most: u64) -> Self {
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
        let whole = plan.symbol(scene, root, scale, &StyleChange::start(scene.drawing.width));
        plan.symbols[whole].copies = 1;
        plan
    }

    /// Goes on until the meter is spent; `None` where there is more to write than may be.
    pub(super) fn step(&mut self, scene: &Scene<'_>, meter: &mut Meter) -> Option<Progress> {
        while !meter.is_spent() {
            meter.charge(4);
            let Some((items, frame)) = self.open.last_mut() else {
                if !self.begin(scene) {
                    return Some(Progress::Done);
                }
                continue;
            };
            match items.next() {
                Some(item) => {
                    let frame = *frame;
                    self.read(scene, &scene.drawing.items[item as usize], &frame, meter)?;
                }
                None => {
                    self.open.pop();
                }
            }
        }
        Some(Progress::More)
    }

    /// Begins with the next symbol, if there is one.
    fn begin(&mut self, scene: &Scene<'_>) -> bool {
        // Blocks stand before those that hold them, so nothing asks for a symbol that has been dealt with.
        let Some((block, current)) = self.pending.pop() else { return false };
        let symbol = &mut self.symbols[current];
        symbol.parts = self.parts.len()..self.parts.len();
        if symbol.uses > 1 {
            self.shared.push(current);
            self.instances = self.instances.saturating_add(symbol.copies);
        }
        self.current = current;
        self.open.push((scene.drawing.blocks[block.0 as usize].items.clone(), symbol.frame));
        true
    }

    /// Makes an item a part of the current symbol, or opens the block that it is.
    fn read(&mut self, scene: &Scene<'_>, item: &Item, frame: &Frame, meter: &mut Meter) -> Option<()> {
        let drawing = scene.drawing;
        let stroke = |line: &Line, frame: &Frame| {
            Part::Stroke(frame.lie(line.from), frame.lie(line.to), scene.ink(&frame.style.then(&line.style)))
        };
        let part = match item {
            Item::Stroke(own) => stroke(&Line::new(own, drawing), frame),
            Item::Polygon(polygon) => {
                self.left = self.left.checked_sub(u64::from(polygon.count) - 1)?;
                meter.charge(u64::from(polygon.count) / 8);
                let first = self.vertices.len();
                self.vertices.extend(drawing.vertices_of(polygon).iter().map(|&vertex| frame.lie(vertex)));
                let style = frame.style.then(&drawing.styles[polygon.style.0 as usize]);
                Part::Polygon(first..self.vertices.len(), scene.ink(&style).rgb)
            }
            Item::Block(placed) => {
                let inner = frame.place(placed, drawing, &mut self.directions);
                match scene.features.one_stroke(placed.block, inner.scale) {
                    Some(line) => stroke(line, &inner),
                    None if scene.features.strokes(placed.block) <= self.small => {
                        self.open.push((drawing.blocks[placed.block.0 as usize].items.clone(), inner));
                        return Some(());
                    }
                    None => {
                        let target = self.symbol(scene, placed.block, inner.scale, &inner.style);
                        let copies = self.symbols[self.current].copies;
                        let symbol = &mut self.symbols[target];
                        symbol.uses += 1;
                        symbol.copies = symbol.copies.saturating_add(copies);
                        Part::Use(target, inner.at, inner.heading)
                    }
                }
            }
        };
        self.left = self.left.checked_sub(1)?;
        self.parts.push(part);
        self.symbols[self.current].parts.end = self.parts.len();
        Some(())
    }

    /// The symbol of a block; new ones are pending.
    fn symbol(&mut self, scene: &Scene<'_>, block: BlockId, scale: f64, style: &StyleChange) -> usize {
        let entry = scene.entry(block, style);
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

    pub(super) fn parts_of(&self, symbol: usize) -> &[Part] {
        &self.parts[self.symbols[symbol].parts.clone()]
    }

    pub(super) fn vertices_of(&self, vertices: &Range<usize>) -> &[[f64; 2]] {
        &self.vertices[vertices.clone()]
    }

    /// Whether a symbol is written as a single path.
    pub(super) fn is_one_path(&self, symbol: usize) -> bool {
        let parts = self.parts_of(symbol);
        let ink = |part: &Part| if let Part::Stroke(_, _, ink) = part { Some(*ink) } else { None };
        let first = parts.first().and_then(ink);
        first.is_some() && parts.len() <= PATH && parts.iter().all(|part| ink(part) == first)
    }
}
