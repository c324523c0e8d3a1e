//! Reading a derivation in place: pages of its strings, where a symbol comes from, what a segment is.

use crate::budget::HISTORY;
use crate::playground::Playground;
use crate::to_js;
use crate::viewer::{Views, WORK};
use core::ops::Range;
use lsystem::derive::{Ancestor, History, Word};
use lsystem::drawing::{Segment, Space, StyleChange, symbol_of_polygon};
use lsystem::render::{
    Pointer, Target, fitted_ends, fitted_outline, fitted_polygon, fitted_solid_ends, fitted_solid_polygon, pick_solid,
};
use lsystem::syntax::print_module;
use lsystem::{Drawing, Progress, pick};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// What reads a generation in place.
enum Reader<'a> {
    /// By counts of what letters become.
    Counted(Word<'a>),
    /// By what is remembered of its derivation.
    Remembered(&'a History),
}

/// One link of the chain from the axiom to a symbol; numbers that may be large are decimal strings.
#[derive(Serialize)]
struct Link {
    generation: u32,
    /// With its arguments in parentheses, where there are any.
    symbol: String,
    index: String,
    production: Option<usize>,
    position: usize,
}

/// One segment and the pose that the turtle has at its end.
#[derive(Serialize)]
struct Stroke {
    from: Vec<f64>,
    to: Vec<f64>,
    /// Both ends where the page finds them at any view.
    #[serde(rename = "fittedFrom")]
    fitted_from: Vec<f64>,
    #[serde(rename = "fittedTo")]
    fitted_to: Vec<f64>,
    heading: Direction,
    level: u32,
    colour: i32,
}

/// In degrees in the plane, in space a vector.
#[derive(Serialize)]
#[serde(untagged)]
enum Direction {
    Degrees(f64),
    Vector([f64; 3]),
}

/// What a symbol has become in a later generation; numbers are decimal strings, ranges half open.
#[derive(Serialize)]
struct Part {
    symbols: [String; 2],
    segments: [String; 2],
    /// The corners of a convex outline of its segments, in the plane; in space the ends of a single one. Empty unless the
    /// shown generation is meant.
    outline: Vec<Vec<f64>>,
}

/// One polygon.
#[derive(Serialize)]
struct Filled {
    /// Its vertices where the page finds them at any view.
    outline: Vec<Vec<f64>>,
    level: u32,
    colour: i32,
}

/// One of the numbers is there.
#[derive(Serialize)]
struct Picked {
    segment: Option<String>,
    polygon: Option<String>,
    symbol: Option<String>,
}

/// A budget for one look at what is under the pointer: some milliseconds at most.
const VISITS: usize = 20_000;

/// Work units for the length of a string: some ten milliseconds at most.
const COUNTING: u64 = 1 << 20;

#[wasm_bindgen]
impl Playground {
    /// Forgets what reading needs: it is derived again when somebody asks.
    pub fn forget(&mut self) {
        self.history = None;
    }

    /// Works towards what [`Playground::slice`] and others need to read generation `generation`, for about `budget`
    /// milliseconds; whether nothing is left to do. What cannot be had after that is too long.
    pub fn remember(&mut self, generation: u32, budget: f64) -> bool {
        let end = self.clock.now() + budget;
        let Some(system) = &self.system else { return true };
        if system.word(generation).is_some() {
            return true;
        }
        if self.is_saving() {
            return false;
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

    /// How many symbols a generation has, modules with arguments counted as one, as a decimal string; null where that is
    /// not known.
    #[wasm_bindgen(js_name = stringLength)]
    pub fn string_length(&self, generation: u32) -> Option<String> {
        match self.reader(generation)? {
            Reader::Counted(word) => {
                let symbols = word.symbols();
                if symbols < u128::MAX {
                    return Some(symbols.to_string());
                }
                let mut counter = self.system.as_ref()?.symbols(generation);
                counter.step(COUNTING);
                // All that can be reached is told where the rest takes too long to count.
                Some(counter.count().map_or_else(|| symbols.to_string(), ToString::to_string))
            }
            Reader::Remembered(history) => history.symbols(generation).map(|count| count.to_string()),
        }
    }

    /// The symbols of a generation from position `start` on, at most `length`; null where it cannot be read.
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
            Reader::Counted(word) => word.modules(start, length, &mut visit),
            Reader::Remembered(history) => {
                history.symbols(generation)?;
                history.modules(generation, start, length, &mut visit);
            }
        }
        Some(text)
    }

    /// The chain from the axiom to the symbol at `index`: `[{generation, symbol, index, production, position}]`;
    /// empty where there is no such symbol, or where it cannot be read.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn ancestry(&self, generation: u32, index: u128) -> Result<JsValue, JsValue> {
        let chain = match self.reader(generation) {
            None => vec![],
            Some(Reader::Counted(word)) => word.ancestry(index),
            Some(Reader::Remembered(history)) => history.ancestry(generation, index),
        };
        to_js(&chain.into_iter().map(|ancestor| self.link(ancestor)).collect::<Vec<_>>())
    }

    /// What the symbol at `index` of `generation` has become in generation `later`: `{symbols, segments, outline}`;
    /// null where there is no such symbol, or where it cannot be read. Segments and outline are there where `later`
    /// is the generation that is drawn.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn part(&self, generation: u32, index: u128, later: u32) -> Result<JsValue, JsValue> {
        let part = self.reader(later).and_then(|reader| match reader {
            Reader::Counted(word) => word.part(generation, index),
            Reader::Remembered(history) => history.part(generation, index, later),
        });
        to_js(&part.map(|lsystem::derive::Part { symbols, segments }| {
            let outline = if later == self.shown_iterations() { self.outline(segments.clone()) } else { vec![] };
            Part { symbols: ends(symbols), segments: ends(segments), outline }
        }))
    }

    /// The segment of that number: `{from, to, fittedFrom, fittedTo, heading, level, colour}`, `from` and `to` in model
    /// units. In the plane `heading` is in degrees, and `fittedFrom` and `fittedTo` are four numbers: right of and above
    /// the fitted centre, in fitted extents, and what is below the precision of these. In space `heading` is a vector, and
    /// they are three, in the directions of the model. Null beyond the last.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn segment(&self, number: u128) -> Result<JsValue, JsValue> {
        let Views { plane, solid, .. } = &self.views;
        let in_plane = plane.drawing.as_ref().and_then(|drawing| {
            let heading = |_: &Segment| drawing.heading_at(number).map(Direction::Degrees);
            stroke(drawing, number, fitted_ends(drawing, number)?, heading)
        });
        let in_space = || {
            let drawing = solid.drawing.as_ref()?;
            stroke(drawing, number, fitted_solid_ends(drawing, number)?, |Segment { from, to, .. }| {
                let way = [0, 1, 2].map(|i| to[i] - from[i]);
                let length = way.map(|c| c * c).iter().sum::<f64>().sqrt();
                Some(Direction::Vector(way.map(|c| if length > 0.0 { c / length } else { 0.0 })))
            })
        };
        to_js(&in_plane.or_else(in_space))
    }

    /// The polygon of that number: `{outline, level, colour}`, its vertices as the ends in [`Playground::segment`]. Null
    /// beyond the last.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn polygon(&self, number: u128) -> Result<JsValue, JsValue> {
        let Views { plane, solid, .. } = &self.views;
        let in_plane = plane.drawing.as_ref();
        let in_plane =
            in_plane.map(|drawing| (drawing.polygon_style(number), corners(fitted_polygon(drawing, number))));
        let found = in_plane.or_else(|| {
            let drawing = solid.drawing.as_ref()?;
            Some((drawing.polygon_style(number), corners(fitted_solid_polygon(drawing, number))))
        });
        to_js(&found.and_then(|(style, outline)| {
            let StyleChange { level, colour, .. } = style?;
            Some(Filled { outline, level, colour: colour.of(0) })
        }))
    }

    /// What is seen within `tolerance` device pixels of a place on the canvas: `{segment, polygon, symbol}` with the number of
    /// the segment or of the polygon, the other null, and of the symbol that draws or opens it, as decimal strings; null
    /// where there is nothing. The symbol is null where the generation cannot be read.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn pick(&self, x: f64, y: f64, tolerance: f64) -> Result<JsValue, JsValue> {
        let pointer = Pointer { at: [x, y], tolerance, upto: self.upto, visits: VISITS };
        let views = &self.views;
        let in_plane = views.plane.drawing.as_ref();
        let in_plane = in_plane.and_then(|drawing| pick(drawing, self.viewport, self.view, &pointer));
        let found = in_plane
            .or_else(|| pick_solid(views.solid.drawing.as_ref()?, self.viewport, &views.solid.camera, &pointer));
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

    /// How many segments the symbols before `index` draw, as a decimal string; null where that is not known.
    #[wasm_bindgen(js_name = segmentsBefore)]
    pub fn segments_before(&self, index: u128) -> Option<String> {
        let segments = match self.reader(self.shown_iterations())? {
            Reader::Counted(word) => word.segments_before(index),
            Reader::Remembered(history) => history.segments_before(index)?,
        };
        Some(segments.to_string())
    }

    /// The number of the symbol that draws a segment, as a decimal string; null where that is not known.
    #[wasm_bindgen(js_name = symbolOfSegment)]
    pub fn symbol_of_segment(&self, segment: u128) -> Option<String> {
        let symbol = match self.reader(self.shown_iterations())? {
            Reader::Counted(word) => word.symbol_of_segment(segment),
            Reader::Remembered(history) => history.symbol_of_segment(segment),
        };
        Some(symbol?.to_string())
    }
}

impl Playground {
    /// The number of the symbol that opens a polygon.
    fn symbol_of_polygon(&self, number: u128) -> Option<String> {
        let (system, n) = (self.system.as_ref()?, self.shown_iterations());
        let Views { plane, solid, .. } = &self.views;
        let symbol = match &plane.drawing {
            Some(drawing) => symbol_of_polygon(system, n, drawing, number),
            None => symbol_of_polygon(system, n, solid.drawing.as_ref()?, number),
        };
        Some(symbol?.to_string())
    }

    fn reader(&self, generation: u32) -> Option<Reader<'_>> {
        let word = self.system.as_ref()?.word(generation).map(Reader::Counted);
        word.or_else(|| self.history.as_ref().map(Reader::Remembered))
    }

    /// What is around these segments of the drawing.
    fn outline(&self, segments: Range<u128>) -> Vec<Vec<f64>> {
        let Views { plane, solid, .. } = &self.views;
        if let Some(drawing) = &plane.drawing {
            return corners(fitted_outline(drawing, segments));
        }
        let single = segments.end.checked_sub(segments.start) == Some(1);
        let drawing = solid.drawing.as_ref().filter(|_| single);
        let ends = drawing.and_then(|drawing| fitted_solid_ends(drawing, segments.start));
        ends.into_iter().flatten().map(Vec::from).collect()
    }

    fn link(&self, ancestor: Ancestor) -> Link {
        let Ancestor { generation, symbol, arguments, index, production, position } = ancestor;
        let mut module = String::new();
        if self.apart() {
            print_module(symbol, &arguments, &mut module);
        } else {
            module.push(symbol);
        }
        Link { generation, symbol: module, index: index.to_string(), production, position }
    }
}

fn stroke<S: Space, const N: usize>(
    drawing: &Drawing<S>,
    number: u128,
    fitted: [[f64; N]; 2],
    heading: impl FnOnce(&Segment<S>) -> Option<Direction>,
) -> Option<Stroke> {
    let segment = drawing.segments_from(number).next()?;
    let heading = heading(&segment)?;
    let Segment { from, to, level, colour, .. } = segment;
    let [fitted_from, fitted_to] = fitted.map(Vec::from);
    Some(Stroke { from: from.as_ref().into(), to: to.as_ref().into(), fitted_from, fitted_to, heading, level, colour })
}

fn corners<const N: usize>(outline: Vec<[f64; N]>) -> Vec<Vec<f64>> {
    outline.into_iter().map(Vec::from).collect()
}

fn ends(range: Range<u128>) -> [String; 2] {
    [range.start.to_string(), range.end.to_string()]
}
