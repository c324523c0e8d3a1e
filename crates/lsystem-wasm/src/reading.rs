//! Reading a derivation: pages of its strings, the ancestry of symbols, and segments with their symbols.

use crate::budget::HISTORY;
use crate::playground::Playground;
use crate::to_js;
use crate::viewer::WORK;
use core::ops::Range;
use lsystem::derive::{Ancestor, History, Word};
use lsystem::drawing::{Segment, StyleChange};
use lsystem::render::{Pointer, Target, fitted_ends, fitted_outline, fitted_polygon};
use lsystem::syntax::print_module;
use lsystem::{Figure, Progress, pick};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// A source of the symbols of a generation.
enum GenerationReader<'a> {
    /// Counts of the symbols that letters derive.
    Counted(Word<'a>),
    /// A remembered derivation.
    Remembered(&'a History),
}

/// One link of the chain from the axiom to a symbol; numbers that may be large are decimal strings.
#[derive(Serialize)]
struct AncestryLink {
    generation: u32,
    /// The symbol, with its arguments in parentheses, if any.
    symbol: String,
    index: String,
    production: Option<usize>,
    position: usize,
}

/// One segment, with the turtle's heading, level and colour; the fields as in [`Playground::segment`].
#[derive(Serialize)]
struct SegmentFacts {
    from: Vec<f64>,
    to: Vec<f64>,
    #[serde(rename = "fittedFrom")]
    fitted_from: Vec<f64>,
    #[serde(rename = "fittedTo")]
    fitted_to: Vec<f64>,
    heading: Direction,
    level: u32,
    colour: i32,
}

/// A heading: degrees in the plane, a unit vector in space.
#[derive(Serialize)]
#[serde(untagged)]
enum Direction {
    Degrees(f64),
    Vector([f64; 3]),
}

/// The descendants of a symbol in a later generation, as half-open ranges of decimal strings.
#[derive(Serialize)]
struct Descendants {
    symbols: [String; 2],
    segments: [String; 2],
    /// In the plane the corners of a convex outline of the segments; in space the ends of a single segment. Empty
    /// unless the later generation is the shown one.
    outline: Vec<Vec<f64>>,
}

/// One polygon.
#[derive(Serialize)]
struct PolygonFacts {
    /// The vertices, in the units of `fittedFrom` in [`Playground::segment`].
    outline: Vec<Vec<f64>>,
    level: u32,
    colour: i32,
}

/// The mark under the pointer: either `segment` or `polygon` is a number.
#[derive(Serialize)]
struct Picked {
    segment: Option<String>,
    polygon: Option<String>,
    symbol: Option<String>,
}

/// The most blocks visited by one pick: some milliseconds.
const VISITS: usize = 20_000;

/// The most units of work to count the symbols of a string: about 10 milliseconds.
const COUNTING: u64 = 1 << 20;

#[wasm_bindgen]
impl Playground {
    /// Drops the remembered derivation. [`Playground::remember`] derives again.
    pub fn forget(&mut self) {
        self.history = None;
    }

    /// Derives, for about `budget` milliseconds, the history that [`Playground::slice`] and others need to read
    /// generation `generation`. Returns whether nothing is left to do. A generation that then still cannot be read is
    /// too long.
    pub fn remember(&mut self, generation: u32, budget: f64) -> bool {
        let end = self.clock.now() + budget;
        let Some(system) = &self.system else { return true };
        if system.word(generation).is_some() {
            return true;
        }
        let n = self.shown_iterations();
        if self.history.is_none() {
            self.history = system.history(n, &HISTORY);
        }
        let Some(history) = &mut self.history else { return true };
        loop {
            let known = if generation < n { history.symbols(generation).is_some() } else { history.is_complete() };
            if known || history.step(WORK) == Progress::Done {
                return true;
            }
            if self.clock.now() >= end {
                return false;
            }
        }
    }

    /// Whether [`Playground::slice`] ends every module with a line end, because some have arguments or names in
    /// backquotes.
    #[wasm_bindgen(getter)]
    pub fn apart(&self) -> bool {
        self.system.as_ref().is_some_and(|system| !system.rules.is_plain())
    }

    /// The number of symbols of a generation as a decimal string; a module with arguments is one symbol. `undefined` if
    /// the number is not known.
    #[wasm_bindgen(js_name = stringLength)]
    pub fn string_length(&self, generation: u32) -> Option<String> {
        match self.reader(generation)? {
            GenerationReader::Counted(word) => {
                let symbols = word.symbols();
                if symbols < u128::MAX {
                    return Some(symbols.to_string());
                }
                let mut counter = self.system.as_ref()?.symbols(generation);
                counter.step(COUNTING);
                // If counting takes too long, the number of symbols that can be read stands for the count.
                Some(counter.count().map_or_else(|| symbols.to_string(), ToString::to_string))
            }
            GenerationReader::Remembered(history) => history.symbols(generation).map(|count| count.to_string()),
        }
    }

    /// At most `length` symbols of a generation from position `start` on; `undefined` if the generation cannot be read.
    pub fn slice(&self, generation: u32, start: u128, length: usize) -> Option<String> {
        let reader = self.reader(generation)?;
        let mut text = String::new();
        let apart = self.apart();
        let mut visit = |symbol: char, arguments: &[f64]| {
            if !apart {
                return text.push(symbol);
            }
            print_module(symbol, arguments, &mut text);
            text.push('\n');
        };
        match reader {
            GenerationReader::Counted(word) => word.modules(start, length, &mut visit),
            GenerationReader::Remembered(history) => {
                history.symbols(generation)?;
                history.modules(generation, start, length, &mut visit);
            }
        }
        Some(text)
    }

    /// The chain from the axiom to the symbol at `index`: `[{generation, symbol, index, production, position}]`. Empty
    /// if there is no such symbol or the generation cannot be read.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn ancestry(&self, generation: u32, index: u128) -> Result<JsValue, JsValue> {
        let chain = match self.reader(generation) {
            None => vec![],
            Some(GenerationReader::Counted(word)) => word.ancestry(index),
            Some(GenerationReader::Remembered(history)) => history.ancestry(generation, index),
        };
        to_js(&chain.into_iter().map(|ancestor| self.link(ancestor)).collect::<Vec<_>>())
    }

    /// The descendants in generation `later` of the symbol at `index` of `generation`: `{symbols, segments, outline}`.
    /// Null if there is no such symbol or the generation cannot be read. The outline is empty unless `later` is the
    /// shown generation.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn part(&self, generation: u32, index: u128, later: u32) -> Result<JsValue, JsValue> {
        let part = self.reader(later).and_then(|reader| match reader {
            GenerationReader::Counted(word) => word.part(generation, index),
            GenerationReader::Remembered(history) => history.part(generation, index, later),
        });
        to_js(&part.map(|lsystem::derive::Part { symbols, segments }| {
            let shown = self.shown.as_ref().filter(|_| later == self.shown_iterations());
            let outline = shown.map_or_else(Vec::new, |figure| fitted_outline(figure, segments.clone()));
            Descendants { symbols: ends(symbols), segments: ends(segments), outline }
        }))
    }

    /// Segment `number` (0-based): `{from, to, fittedFrom, fittedTo, heading, level, colour}`, or null after the last.
    /// `from` and `to` are in model units; `fittedFrom` and `fittedTo` are relative to the fitted centre, in fitted
    /// extents. In the plane these two have four numbers (right, up, and a small correction of each), and `heading` is
    /// in degrees. In space they have three numbers, along the axes of the model, and `heading` is a unit vector.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn segment(&self, number: u128) -> Result<JsValue, JsValue> {
        to_js(&self.shown.as_ref().and_then(|figure| segment_facts(figure, number)))
    }

    /// Polygon `number` (0-based): `{outline, level, colour}`, or null after the last. The vertices are in the units of
    /// `fittedFrom` in [`Playground::segment`].
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn polygon(&self, number: u128) -> Result<JsValue, JsValue> {
        to_js(&self.shown.as_ref().and_then(|figure| {
            let StyleChange { level, colour, .. } = figure.polygon_style(number)?;
            Some(PolygonFacts { outline: fitted_polygon(figure, number), level, colour: colour.of(0) })
        }))
    }

    /// The mark within `tolerance` device pixels of a place on the canvas: `{segment, polygon, symbol}`, or null if
    /// there is none. Either `segment` or `polygon` is the mark's number; `symbol` is the position of its symbol, or
    /// null if the generation cannot be read. Numbers are decimal strings.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn pick(&self, x: f64, y: f64, tolerance: f64) -> Result<JsValue, JsValue> {
        let pointer = Pointer { at: [x, y], tolerance, upto: self.upto, visits: VISITS };
        let found = self.shown.as_ref().and_then(|figure| pick(figure, self.viewport, &self.vantage, &pointer));
        let picked = found.map(|pick| {
            let (segment, polygon, symbol) = match pick.target {
                Target::Segment(number) => (Some(number), None, self.symbol_of_segment(number)),
                Target::Polygon(number) => (None, Some(number), self.symbol_of_polygon(number)),
            };
            let [segment, polygon] = [segment, polygon].map(|number| number.map(|number| number.to_string()));
            Picked { segment, polygon, symbol }
        });
        to_js(&picked)
    }

    /// The number of segments that the symbols before `index` draw, as a decimal string; `undefined` if not known.
    #[wasm_bindgen(js_name = segmentsBefore)]
    pub fn segments_before(&self, index: u128) -> Option<String> {
        let segments = match self.reader(self.shown_iterations())? {
            GenerationReader::Counted(word) => word.segments_before(index),
            GenerationReader::Remembered(history) => history.segments_before(index)?,
        };
        Some(segments.to_string())
    }

    /// The position of the symbol that draws a segment, as a decimal string; `undefined` if not known.
    #[wasm_bindgen(js_name = symbolOfSegment)]
    pub fn symbol_of_segment(&self, segment: u128) -> Option<String> {
        let symbol = match self.reader(self.shown_iterations())? {
            GenerationReader::Counted(word) => word.symbol_of_segment(segment),
            GenerationReader::Remembered(history) => history.symbol_of_segment(segment),
        };
        Some(symbol?.to_string())
    }
}

impl Playground {
    /// The position of the symbol that opens a polygon.
    fn symbol_of_polygon(&self, number: u128) -> Option<String> {
        let symbol = self.shown.as_ref()?.symbol_of_polygon(self.system.as_ref()?, self.shown_iterations(), number)?;
        Some(symbol.to_string())
    }

    fn reader(&self, generation: u32) -> Option<GenerationReader<'_>> {
        let word = self.system.as_ref()?.word(generation).map(GenerationReader::Counted);
        word.or_else(|| self.history.as_ref().map(GenerationReader::Remembered))
    }

    fn link(&self, ancestor: Ancestor) -> AncestryLink {
        let Ancestor { generation, symbol, arguments, index, production, position } = ancestor;
        let mut module = String::new();
        if self.apart() {
            print_module(symbol, &arguments, &mut module);
        } else {
            module.push(symbol);
        }
        AncestryLink { generation, symbol: module, index: index.to_string(), production, position }
    }
}

fn segment_facts(figure: &Figure, number: u128) -> Option<SegmentFacts> {
    let Segment { from, to, level, colour, .. } = figure.segments_from(number).next()?;
    let [fitted_from, fitted_to] = fitted_ends(figure, number)?;
    let (heading, dimensions) = match figure {
        Figure::Plane(drawing) => (Direction::Degrees(drawing.heading_at(number)?), 2),
        Figure::Space(_) => {
            let way = [0, 1, 2].map(|i| to[i] - from[i]);
            let length = way.map(|c| c * c).iter().sum::<f64>().sqrt();
            (Direction::Vector(way.map(|c| if length > 0.0 { c / length } else { 0.0 })), 3)
        }
    };
    let [from, to] = [from, to].map(|end| end.into_iter().take(dimensions).collect());
    Some(SegmentFacts { from, to, fitted_from, fitted_to, heading, level, colour })
}

fn ends(range: Range<u128>) -> [String; 2] {
    [range.start.to_string(), range.end.to_string()]
}
