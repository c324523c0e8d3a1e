//! Reading a derivation in place: pages of its strings, where a symbol comes from, what a segment is.

use crate::playground::Playground;
use crate::{LIMITS, to_js};
use core::ops::Range;
use lsystem::{Drawing, Word, count_symbols, expand};
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
    /// Both ends where the page finds them at any view.
    #[serde(rename = "fittedFrom")]
    fitted_from: [f64; 2],
    #[serde(rename = "fittedTo")]
    fitted_to: [f64; 2],
    heading: f64,
    level: u32,
    colour: i32,
}

/// What a symbol has become in a later generation; numbers are decimal strings, ranges half open.
#[derive(Serialize)]
struct Part {
    symbols: [String; 2],
    segments: [String; 2],
    /// The corners of a convex outline of its segments, in fitted extents; empty unless the shown generation is meant.
    outline: Vec<[f64; 2]>,
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
    /// How many symbols [`Playground::slice`] can give of generation `generation`, as a decimal string; null where it is
    /// too long to be known. Where it has to be written down, characters count, those of parameters too.
    #[wasm_bindgen(js_name = stringLength)]
    pub fn string_length(&mut self, generation: u32) -> Option<String> {
        let system = self.system.as_ref()?;
        match Word::new(system, generation) {
            Some(_) => count_symbols(system, generation).map(|count| count.to_string()),
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

    /// What the symbol at `index` of `generation` has become in generation `later`: `{symbols, segments, outline}`;
    /// null where there is no such symbol, or where chance decides the derivation. The outline is there where `later`
    /// is the generation that is drawn.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn part(&self, generation: u32, index: u128, later: u32) -> Result<JsValue, JsValue> {
        let word = self.system.as_ref().and_then(|system| Word::new(system, later));
        let part = word.and_then(|word| word.part(generation, index));
        to_js(&part.map(|lsystem::Part { symbols, segments }| {
            let drawing = self.views.plane.drawing.as_ref().filter(|_| later == self.shown_iterations());
            let corners = drawing.map(|drawing| (drawing, drawing.outline(segments.clone())));
            let outline =
                corners.map(|(drawing, corners)| corners.into_iter().map(|corner| fitted(drawing, corner)).collect());
            Part { symbols: ends(symbols), segments: ends(segments), outline: outline.unwrap_or_default() }
        }))
    }

    /// The segment of that number: `{from, to, fittedFrom, fittedTo, heading, level, colour}`, in model units and
    /// degrees; `fittedFrom` and `fittedTo` in fitted extents from the fitted centre, y up. Null beyond the last.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn segment(&self, number: u128) -> Result<JsValue, JsValue> {
        let stroke = self.views.plane.drawing.as_ref().and_then(|drawing| {
            let segment = drawing.segments_from(number).next()?;
            let heading = drawing.heading_at(number)?;
            Some(Stroke {
                from: segment.from,
                to: segment.to,
                fitted_from: fitted(drawing, segment.from),
                fitted_to: fitted(drawing, segment.to),
                heading,
                level: segment.level,
                colour: segment.colour,
            })
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
        let (Some(system), Some(drawing)) = (&self.system, &self.views.plane.drawing) else { return Ok(JsValue::NULL) };
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

/// A model point relative to the fitted view: in fitted extents from its centre, y up.
fn fitted(drawing: &Drawing, [x, y]: [f64; 2]) -> [f64; 2] {
    let shown = lsystem::fit(drawing);
    let side = shown.width.max(shown.height);
    [(x - (shown.x + shown.width / 2.0)) / side, (y - (shown.y + shown.height / 2.0)) / side]
}

fn ends(range: Range<u128>) -> [String; 2] {
    [range.start.to_string(), range.end.to_string()]
}
