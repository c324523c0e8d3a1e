//! Reading a derivation in place: pages of its strings, where a symbol comes from, what a segment is.

use crate::playground::Playground;
use crate::{LIMITS, to_js};
use lsystem::{Word, count_symbols, expand};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// A string that had to be written down, because chance decides it.
#[derive(Debug)]
pub(crate) struct Written {
    generation: u32,
    /// Its characters, so that any of them is reached at once.
    symbols: Vec<char>,
}

/// One link of the chain from the axiom to a symbol; numbers that may be large are decimal strings.
#[derive(Serialize)]
struct Link {
    generation: u32,
    symbol: char,
    index: String,
    production: Option<usize>,
    position: usize,
}

/// One segment and the pose that the turtle has at its end.
#[derive(Serialize)]
struct Stroke {
    from: [f64; 2],
    to: [f64; 2],
    heading: f64,
    level: u32,
    colour: i32,
}

#[derive(Serialize)]
struct Picked {
    segment: String,
    symbol: Option<String>,
}

/// A budget for one look at what is under the pointer: well under a millisecond.
const VISITS: usize = 20_000;

#[wasm_bindgen]
impl Playground {
    /// How many symbols generation `generation` has, as a decimal string; null where it is too long to be known.
    #[wasm_bindgen(js_name = stringLength)]
    pub fn string_length(&mut self, generation: u32) -> Option<String> {
        let known = count_symbols(self.system.as_ref()?, generation);
        match known {
            Some(count) => Some(count.to_string()),
            None => Some(self.written(generation)?.symbols.len().to_string()),
        }
    }

    /// The symbols of a generation from position `start` on, at most `length`; null where the string is too long.
    pub fn slice(&mut self, generation: u32, start: u128, length: usize) -> Option<String> {
        if let Some(word) = Word::new(self.system.as_ref()?, generation) {
            return Some(word.slice(start, length));
        }
        let symbols = &self.written(generation)?.symbols;
        let start = usize::try_from(start).unwrap_or(usize::MAX).min(symbols.len());
        Some(symbols[start..].iter().take(length).collect())
    }

    /// The chain from the axiom to the symbol at `index`: `[{generation, symbol, index, production, position}]`;
    /// empty where there is no such symbol, or where chance decides the derivation.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn ancestry(&self, generation: u32, index: u128) -> Result<JsValue, JsValue> {
        let word = self.system.as_ref().and_then(|system| Word::new(system, generation));
        let chain = word.map(|word| word.ancestry(index)).unwrap_or_default();
        let links: Vec<Link> = (chain.into_iter())
            .map(|link| Link {
                generation: link.generation,
                symbol: link.symbol,
                index: link.index.to_string(),
                production: link.production,
                position: link.position,
            })
            .collect();
        to_js(&links)
    }

    /// The segment of that number: `{from, to, heading, level, colour}`, in model units and degrees; null beyond the
    /// last.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn segment(&self, number: u128) -> Result<JsValue, JsValue> {
        let stroke = self.drawing.as_ref().and_then(|drawing| {
            let segment = drawing.segments_from(number).next()?;
            let heading = drawing.heading_at(number)?;
            Some(Stroke { from: segment.from, to: segment.to, heading, level: segment.level, colour: segment.colour })
        });
        to_js(&stroke)
    }

    /// The segment within `tolerance` device pixels of a place on the canvas: `{segment, symbol}` with the numbers
    /// of the segment and of the symbol that draws it, as decimal strings; null where there is none. The symbol is
    /// null where chance decides the derivation.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn pick(&self, x: f64, y: f64, tolerance: f64) -> Result<JsValue, JsValue> {
        let (Some(system), Some(drawing)) = (&self.system, &self.drawing) else { return Ok(JsValue::NULL) };
        let at = |x: f64, y: f64| drawing.from_model(lsystem::to_model(drawing, self.viewport, self.view, x, y));
        let (centre, edge) = (at(x, y), at(x + tolerance, y));
        let found = drawing.pick(centre, (edge[0] - centre[0]).abs(), VISITS);
        to_js(&found.map(|pick| {
            Picked {
                segment: pick.segment.to_string(),
                symbol: Word::new(system, self.shown_iterations())
                    .and_then(|word| word.symbol_of_segment(pick.segment))
                    .map(|index| index.to_string()),
            }
        }))
    }

    /// How many segments the symbols before `index` draw, as a decimal string; null where chance decides.
    #[wasm_bindgen(js_name = segmentsBefore)]
    pub fn segments_before(&self, index: u128) -> Option<String> {
        let word = Word::new(self.system.as_ref()?, self.shown_iterations())?;
        Some(word.segments_before(index).to_string())
    }

    /// The number of the symbol that draws a segment, as a decimal string; null where chance decides.
    #[wasm_bindgen(js_name = symbolOfSegment)]
    pub fn symbol_of_segment(&self, segment: u128) -> Option<String> {
        let word = Word::new(self.system.as_ref()?, self.shown_iterations())?;
        Some(word.symbol_of_segment(segment)?.to_string())
    }
}

impl Playground {
    fn written(&mut self, generation: u32) -> Option<&Written> {
        if self.written.as_ref().is_none_or(|written| written.generation != generation) {
            self.written = None;
            let text = expand(self.system.as_ref()?, generation, &LIMITS).ok()?;
            self.written = Some(Written { generation, symbols: text.chars().collect() });
        }
        self.written.as_ref()
    }
}
