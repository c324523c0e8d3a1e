//! Which blocks a compact picture holds, and where it writes out or places them.

use super::paths::{Ink, PATH};
use lsystem_drawing::Directions;
use lsystem_drawing::{BlockId, ColourChange, Drawing, Item, StyleChange, WidthChange};
use lsystem_drawing::{Frame, Line, Shape, shapes};
use lsystem_syntax::{ColourBy, Heading, Style};
use std::collections::{BinaryHeap, HashMap};

/// Blocks less than this across are one stroke, in pixels.
const DOT: f64 = 1.0;

/// A drawing at a size.
pub(super) struct Scene<'a> {
    drawing: &'a Drawing,
    style: &'a Style,
    /// The step length, in pixels.
    step: f64,
    /// By block.
    shapes: Vec<Shape>,
    /// By block: how many strokes draw it at this size, saturating. A block that lengths are scaled for may have others
    /// where it is placed.
    strokes: Vec<u32>,
}

impl<'a> Scene<'a> {
    /// A drawing with a root; one unit of it is `scale` pixels, and a step is `step` pixels.
    pub(super) fn new(drawing: &'a Drawing, root: BlockId, style: &'a Style, scale: f64, step: f64) -> Self {
        let shapes = shapes(drawing);
        let mut strokes: Vec<u32> = Vec::with_capacity(shapes.len());
        let exponent = drawing.blocks[root.0 as usize].exponent;
        for ((at, block), shape) in drawing.blocks.iter().enumerate().zip(&shapes) {
            let own = scale * libm::scalbn(1.0, block.exponent.saturating_sub(exponent));
            strokes.push(match one_stroke(shape, own) {
                Some(_) => 1,
                None => (drawing.items_of(BlockId(at as u32)).iter())
                    .map(|item| match item {
                        Item::Stroke(_) | Item::Polygon(_) => 1,
                        Item::Block(placed) => strokes[placed.block.0 as usize],
                    })
                    .fold(0, u32::saturating_add),
            });
        }
        Self { drawing, style, step, shapes, strokes }
    }

    pub(super) fn ink(&self, style: &StyleChange) -> Ink {
        Ink::of(self.style, style, self.step, 1.0)
    }

    /// The style in which a block is entered, as far as that shows.
    fn entry(&self, block: BlockId, style: &StyleChange) -> Entry {
        let colours = self.style.palette.len().clamp(1, i32::MAX as usize) as i32;
        let seen = |index: i32| {
            if self.style.holds() { index.clamp(0, colours - 1) } else { index.rem_euclid(colours) }
        };
        let (colour, level) = match self.style.colour_by {
            ColourBy::Single | ColourBy::Path | ColourBy::Density => (0, 0),
            ColourBy::Symbol | ColourBy::Turn | ColourBy::Generation => (seen(style.colour.of(0)), 0),
            ColourBy::Level => (0, seen(i32::try_from(style.level).unwrap_or(i32::MAX)).cast_unsigned()),
        };
        let width = style.width.of(0.0);
        // Where all strokes are as thin as strokes can be, the width does not show.
        let widest = self.drawing.blocks[block.0 as usize].widest.of(width) * self.step;
        Entry { colour, level, width: if widest <= self.style.min_width { 0.0 } else { width } }
    }

    fn stroke(&self, line: &Line, frame: &Frame) -> Part {
        Part::Stroke(frame.lie(line.from), frame.lie(line.to), self.ink(&frame.style.then(&line.style)))
    }
}

/// The stroke that draws a block where one of its units is `scale` pixels, if one does.
fn one_stroke(shape: &Shape, scale: f64) -> Option<&Line> {
    let dot = (shape.longest.length() * scale.abs() < DOT).then_some(&shape.longest);
    shape.straight.as_ref().or(dot)
}

/// A style at a block's entry.
#[derive(Clone, Copy)]
struct Entry {
    colour: i32,
    level: u32,
    width: f64,
}

impl From<Entry> for StyleChange {
    fn from(Entry { colour, level, width }: Entry) -> Self {
        Self { colour: ColourChange::Set(colour), width: WidthChange { factor: 0.0, offset: width }, level }
    }
}

/// What the file will hold.
pub(super) struct Plan<'a> {
    scene: &'a Scene<'a>,
    /// Strokes of a block that is written out wherever it stands, at most.
    small: u32,
    /// Strokes and placed blocks that may still be written.
    left: u64,
    directions: Directions,
    pub(super) symbols: Vec<Symbol>,
    /// Symbols by block, scale, colour index, level and width.
    known: HashMap<(BlockId, u64, i32, u32, u64), usize>,
    /// Symbols whose parts are not known yet, by block.
    pending: BinaryHeap<(BlockId, usize)>,
    /// All symbols, children after parents; the first is the whole picture.
    pub(super) order: Vec<usize>,
}

/// A block at a scale and in a style.
pub(super) struct Symbol {
    block: BlockId,
    /// At the origin.
    frame: Frame,
    pub(super) parts: Vec<Part>,
    /// How often it is placed.
    uses: usize,
}

/// What a symbol holds, in pixels, y up.
pub(super) enum Part {
    Stroke([f64; 2], [f64; 2], Ink),
    /// Its vertices and its colour.
    Polygon(Vec<[f64; 2]>, [u8; 3]),
    /// Which symbol, and where.
    Use(usize, [f64; 2], Heading),
}

impl<'a> Plan<'a> {
    /// A plan in which blocks of at most `small` strokes are no symbols; `None` where more than `most` strokes and
    /// placed blocks were to be written.
    pub(super) fn new(
        scene: &'a Scene<'a>,
        root: BlockId,
        scale: f64,
        start: &StyleChange,
        small: u32,
        most: u64,
    ) -> Option<Self> {
        let mut plan = Self {
            scene,
            small,
            left: most,
            directions: Directions::default(),
            symbols: vec![],
            known: HashMap::new(),
            pending: BinaryHeap::new(),
            order: vec![],
        };
        plan.symbol(root, scale, start);
        // Blocks stand before those that hold them, so nothing asks for a symbol that has been dealt with.
        while let Some((_, symbol)) = plan.pending.pop() {
            plan.symbols[symbol].parts = plan.parts(symbol)?;
            plan.order.push(symbol);
        }
        Some(plan)
    }

    /// The symbol of a block; new ones are pending.
    fn symbol(&mut self, block: BlockId, scale: f64, style: &StyleChange) -> usize {
        let entry = self.scene.entry(block, style);
        let key = (block, scale.to_bits(), entry.colour, entry.level, entry.width.to_bits());
        let next = self.symbols.len();
        let symbol = *self.known.entry(key).or_insert(next);
        if symbol == next {
            let frame = Frame::new(scale, entry.into());
            self.symbols.push(Symbol { block, frame, parts: vec![], uses: 0 });
            self.pending.push((block, symbol));
        }
        symbol
    }

    fn parts(&mut self, symbol: usize) -> Option<Vec<Part>> {
        let (scene, drawing) = (self.scene, self.scene.drawing);
        let mut parts = Vec::new();
        let mut open = vec![(drawing.items_of(self.symbols[symbol].block).iter(), self.symbols[symbol].frame)];
        while let Some((items, frame)) = open.last_mut() {
            let frame = *frame;
            let Some(item) = items.next() else {
                open.pop();
                continue;
            };
            let part = match item {
                Item::Stroke(stroke) => scene.stroke(&Line::new(stroke, drawing), &frame),
                Item::Polygon(polygon) => {
                    self.left = self.left.checked_sub(u64::from(polygon.count) - 1)?;
                    let vertices = drawing.vertices_of(polygon).iter().map(|&vertex| frame.lie(vertex)).collect();
                    let style = frame.style.then(&drawing.styles[polygon.style.0 as usize]);
                    Part::Polygon(vertices, scene.ink(&style).rgb)
                }
                Item::Block(placed) => {
                    let inner = frame.place(placed, drawing, &mut self.directions);
                    match one_stroke(&scene.shapes[placed.block.0 as usize], inner.scale) {
                        Some(line) => scene.stroke(line, &inner),
                        None if scene.strokes[placed.block.0 as usize] <= self.small => {
                            open.push((drawing.items_of(placed.block).iter(), inner));
                            continue;
                        }
                        None => {
                            let target = self.symbol(placed.block, inner.scale, &inner.style);
                            self.symbols[target].uses += 1;
                            Part::Use(target, inner.at, inner.heading)
                        }
                    }
                }
            };
            self.left = self.left.checked_sub(1)?;
            parts.push(part);
        }
        Some(parts)
    }

    /// Whether a symbol is defined once and placed by `<use>`; others are written where they stand.
    pub(super) fn is_shared(&self, symbol: usize) -> bool {
        self.symbols[symbol].uses > 1
    }

    /// Whether a symbol is written as a single path.
    pub(super) fn is_one_path(&self, symbol: usize) -> bool {
        let parts = &self.symbols[symbol].parts;
        let ink = |part: &Part| if let Part::Stroke(_, _, ink) = part { Some(*ink) } else { None };
        let first = parts.first().and_then(ink);
        first.is_some() && parts.len() <= PATH && parts.iter().all(|part| ink(part) == first)
    }

    /// How many copies expanding the whole picture makes.
    pub(super) fn instances(&self) -> u128 {
        let mut instances = vec![0_u128; self.symbols.len()];
        for &symbol in self.order.iter().rev() {
            instances[symbol] = (self.symbols[symbol].parts.iter())
                .map(|part| match *part {
                    Part::Stroke(..) | Part::Polygon(..) => 0,
                    Part::Use(target, ..) => instances[target].saturating_add(u128::from(self.is_shared(target))),
                })
                .fold(0, u128::saturating_add);
        }
        self.order.first().map_or(0, |&root| instances[root])
    }
}
