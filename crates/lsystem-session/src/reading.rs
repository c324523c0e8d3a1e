//! Reading a derivation: pages of its strings, the ancestry of symbols, and segments with their symbols. Numbers that may be
//! large are decimal digits; all numbers count from 0.

use crate::budget::HISTORY;
use crate::facts::{
    AncestryLink, Anchor, Descendants, Direction, Picked, Place, PolygonFacts, Pose, SegmentFacts, StringPage,
    SymbolFacts,
};
use crate::pace::{STEP, WORK};
use crate::session::Session;
use crate::surface::Screen;
use core::ops::Range;
use lsystem::derive::{Ancestor, DerivedPart, GenerationReader};
use lsystem::drawing::{Around, Origin, Segment, StyleChange};
use lsystem::render::{
    Closeup, Near, Pointer, Target, fitted_ends, fitted_outline, fitted_polygon, fitted_scale, seen_from, segment_near,
};
use lsystem::syntax::print_module;
use lsystem::{Figure, Progress, View, pick};
use std::sync::Arc;

/// The most blocks visited by one pick: some milliseconds, so that a pick takes no longer than a step.
const VISITS: usize = 20_000;

/// The most units of work to count the symbols of a string: some ten milliseconds, once for a string of more than 2^128
/// symbols.
const COUNTING: u64 = 64 * WORK as u64;

impl<S: Screen> Session<S> {
    /// Drops the remembered derivation. [`Session::remember`] derives again.
    pub fn forget(&mut self) {
        self.history = None;
    }

    /// Derives, for about [`STEP`] milliseconds, the history that reading generation `generation` needs, or the shown one
    /// without a number. Returns whether nothing is left to do. A generation that then still cannot be read is too long.
    pub fn remember(&mut self, generation: Option<u32>) -> bool {
        let end = (self.clock)() + STEP;
        let n = self.iterations();
        let generation = generation.unwrap_or(n);
        let Some(system) = &self.system else { return true };
        if system.word(generation).is_some() {
            return true;
        }
        if self.history.is_none() {
            self.history = system.history(n, &HISTORY);
        }
        let Some(history) = &mut self.history else { return true };
        loop {
            let known = if generation < n { history.symbols(generation).is_some() } else { history.is_complete() };
            if known || history.step(WORK) == Progress::Done {
                return true;
            }
            if (self.clock)() >= end {
                return false;
            }
        }
    }

    /// At most `count` symbols of a generation from position `start` on; a module with arguments is one symbol.
    pub fn string(&self, generation: u32, start: u128, count: usize) -> StringPage {
        let text = self.slice(generation, start, count);
        let length = text.is_some().then(|| self.string_length(generation)).flatten();
        StringPage { length, text, apart: self.is_apart() }
    }

    /// A symbol's ancestors, and its descendants in the shown generation.
    pub fn symbol(&self, generation: u32, index: u128) -> SymbolFacts {
        let part = self.part(generation, index, self.iterations());
        let first = part.as_ref().map(|part| part.segments.start);
        SymbolFacts {
            ancestry: self.ancestry(generation, index),
            stroke: first.and_then(|first| self.segment(first)),
            part: part.map(|part| self.descendants(part)),
        }
    }

    /// The position in generation `later` of the first symbol that derives from the symbol at `index` of `generation`;
    /// `None` if there is no such symbol or the later generation cannot be read.
    pub fn descendant(&self, generation: u32, index: u128, later: u32) -> Option<String> {
        Some(self.part(generation, index, later)?.symbols.start.to_string())
    }

    /// The mark within `tolerance` device pixels of a place on the canvas, in device pixels from the upper left corner.
    pub fn pick(&self, x: f64, y: f64, tolerance: f64) -> Picked {
        let pointer = Pointer { at: [x, y], tolerance, upto: self.upto, visits: VISITS };
        let Some(figure) = self.shown.as_ref().filter(|_| self.framing.is_none()) else { return Picked::default() };
        if let Some((closeup, near, view)) = self.closeup() {
            return self.pick_near(&closeup, &near, view, &pointer).unwrap_or_default();
        }
        let Some(found) = pick(figure, self.viewport, &self.vantage, &pointer) else { return Picked::default() };
        let (symbol, picked) = match found.target {
            Target::Segment(number) => {
                let (segment, stroke) = (Some(number.to_string()), self.segment(number));
                (self.symbol_of_segment(number), Picked { segment, stroke, ..Picked::default() })
            }
            Target::Polygon(number) => {
                let (polygon, filled) = (Some(number.to_string()), polygon_facts(figure, number));
                (self.symbol_of_polygon(number), Picked { polygon, filled, ..Picked::default() })
            }
        };
        let ancestry = symbol.map_or_else(Vec::new, |symbol| self.ancestry(self.iterations(), symbol));
        Picked { symbol: symbol.map(|symbol| symbol.to_string()), ancestry, ..picked }
    }

    /// A place on a segment within about `reach` device pixels of a place on the canvas, as an origin for deeper views;
    /// `None` if there is none, or if the drawing cannot be seen from near a segment.
    pub fn anchor(&self, x: f64, y: f64, reach: f64) -> Option<Anchor> {
        let Figure::Plane(whole) = self.shown.as_ref().filter(|_| (x + y).is_finite())? else { return None };
        let (viewport, view) = (self.viewport, self.vantage.view);
        let found = |drawing, view| segment_near(drawing, viewport, view, [x, y], reach);
        let (origin, [x, y]) = match self.closeup() {
            Some((_, near, own)) => {
                let Near { segment, along, at } = found(&near.drawing, own)?;
                (near.origin_on(&segment, along)?, at)
            }
            None => {
                let Near { segment, along, at } = found(whole, view)?;
                (Origin { segment, along }, at)
            }
        };
        // A drawing that cannot be seen from near keeps its origin.
        Closeup::new(whole.clone(), origin.clone()).show(viewport, view)?;
        let pixels = fitted_scale(self.shown.as_ref()?, viewport, &self.vantage) * view.zoom;
        let [x, y] = [f64::from(viewport.width) / 2.0 - x, y - f64::from(viewport.height) / 2.0].map(|c| c / pixels);
        // Where the place is seen, so that nothing moves.
        let place = seen_from([x, y, 0.0, 0.0], [view.x, view.y, view.fine[0], view.fine[1]]);
        Some(Anchor { at: origin.text(), place: place.to_vec() })
    }

    /// The close-up of the present view, what lies around it, and its view; `None` for a view of the whole drawing.
    fn closeup(&self) -> Option<(Closeup, Arc<Around>, View)> {
        let (Some(origin), Some(Figure::Plane(whole))) = (self.origin.as_ref(), &self.shown) else { return None };
        // The picture may be of a view before.
        let known = self.views.closeup().filter(|known| known.origin == *origin);
        let mut closeup = known.cloned().unwrap_or_else(|| Closeup::new(whole.clone(), origin.clone()));
        let (near, view) = closeup.show(self.viewport, self.vantage.view)?;
        Some((closeup, near, view))
    }

    /// As [`Session::pick`], in a close-up.
    fn pick_near(&self, closeup: &Closeup, near: &Around, view: View, pointer: &Pointer) -> Option<Picked> {
        let figure = Figure::Plane(near.drawing.clone());
        let upto = pointer.upto.map(|upto| near.among_first(upto));
        let found = pick(&figure, self.viewport, &view.into(), &Pointer { upto, ..*pointer })?;
        Some(match found.target {
            Target::Segment(local) => {
                let stroke = self.near_facts(closeup, near, local)?;
                let segment = near.number_of(local)?.decimal();
                let symbol = segment.parse().ok().and_then(|number| self.symbol_of_segment(number));
                let ancestry = symbol.map_or_else(Vec::new, |symbol| self.ancestry(self.iterations(), symbol));
                let symbol = symbol.map(|symbol| symbol.to_string());
                Picked { segment: Some(segment), symbol, ancestry, stroke: Some(stroke), ..Picked::default() }
            }
            Target::Polygon(local) => {
                let mut filled = polygon_facts(&figure, local)?;
                filled.outline.iter_mut().for_each(|place| outside(closeup, place));
                Picked { filled: Some(filled), ..Picked::default() }
            }
        })
    }

    /// A segment of a close-up (0-based there).
    fn near_facts(&self, closeup: &Closeup, near: &Around, local: u128) -> Option<SegmentFacts> {
        let mut facts = segment_facts(&Figure::Plane(near.drawing.clone()), local)?;
        [&mut facts.fitted_from, &mut facts.fitted_to].into_iter().for_each(|place| outside(closeup, place));
        if let (Some(Figure::Plane(whole)), [x, y]) = (&self.shown, near.origin) {
            let origin = [whole.start[0] + whole.unit() * x, whole.start[1] + whole.unit() * y];
            for end in [&mut facts.from, &mut facts.to] {
                end.iter_mut().zip(origin).for_each(|(at, origin)| *at += origin);
            }
        }
        Some(facts)
    }

    /// A place as one from the origin of the view.
    fn seen_from_origin(&self, place: Place) -> Place {
        let origin = self.closeup().and_then(|(closeup, ..)| closeup.place());
        match (origin, place[..].try_into()) {
            (Some(origin), Ok(at)) => seen_from(origin, at).to_vec(),
            _ => place,
        }
    }

    /// Segment `number`; `None` after the last.
    pub fn segment(&self, number: u128) -> Option<SegmentFacts> {
        // The items of a close-up are exact only there.
        if let Some((closeup, near, _)) = self.closeup()
            && let Some(local) = near.local(number)
        {
            return self.near_facts(&closeup, &near, local);
        }
        let facts = segment_facts(self.shown.as_ref()?, number)?;
        let [fitted_from, fitted_to] = [facts.fitted_from, facts.fitted_to].map(|place| self.seen_from_origin(place));
        Some(SegmentFacts { fitted_from, fitted_to, ..facts })
    }

    /// The turtle after the last shown segment, or before the first one; `None` if all segments are shown.
    pub(crate) fn pose(&self) -> Option<Pose> {
        let upto = self.upto?;
        let SegmentFacts { from, to, fitted_from, fitted_to, heading, level, .. } =
            self.segment(upto.saturating_sub(1))?;
        let (at, fitted) = if upto > 0 { (to, fitted_to) } else { (from, fitted_from) };
        Some(Pose { at, fitted, heading, level })
    }

    /// The number of iterations of the drawn definition.
    fn iterations(&self) -> u32 {
        self.definition.iterations
    }

    /// Whether some symbols have arguments or names in backquotes.
    fn is_apart(&self) -> bool {
        self.system.as_ref().is_some_and(|system| !system.rules.is_plain())
    }

    fn string_length(&self, generation: u32) -> Option<String> {
        let reader = self.reader(generation)?;
        let symbols = reader.symbols()?;
        if symbols < u128::MAX || matches!(reader, GenerationReader::Remembered(..)) {
            return Some(symbols.to_string());
        }
        let mut counter = self.system.as_ref()?.symbols(generation);
        counter.step(COUNTING);
        // If counting takes too long, the number of symbols that can be read stands for the count.
        Some(counter.count().map_or_else(|| symbols.to_string(), ToString::to_string))
    }

    fn slice(&self, generation: u32, start: u128, length: usize) -> Option<String> {
        let reader = self.reader(generation)?;
        let mut text = String::new();
        let apart = self.is_apart();
        let mut visit = |symbol: char, arguments: &[f64]| {
            if !apart {
                return text.push(symbol);
            }
            print_module(symbol, arguments, &mut text);
            text.push('\n');
        };
        reader.symbols()?;
        reader.modules(start, length, &mut visit);
        Some(text)
    }

    /// The chain from the axiom to the symbol at `index`. Empty if there is no such symbol or the generation cannot be
    /// read.
    fn ancestry(&self, generation: u32, index: u128) -> Vec<AncestryLink> {
        let chain = self.reader(generation).map_or_else(Vec::new, |reader| reader.ancestry(index));
        chain.into_iter().map(|ancestor| self.link(ancestor)).collect()
    }

    /// The descendants in generation `later` of the symbol at `index` of `generation`.
    fn part(&self, generation: u32, index: u128, later: u32) -> Option<DerivedPart> {
        self.reader(later)?.part(generation, index)
    }

    /// A part of the shown generation.
    fn descendants(&self, DerivedPart { symbols, segments }: DerivedPart) -> Descendants {
        let outline = self.shown.as_ref().map_or_else(Vec::new, |figure| fitted_outline(figure, segments.clone()));
        let outline = outline.into_iter().map(|place| self.seen_from_origin(place)).collect();
        Descendants { symbols: ends(symbols), segments: ends(segments), outline }
    }

    /// The position of the symbol that draws a segment.
    pub(crate) fn symbol_of_segment(&self, segment: u128) -> Option<u128> {
        self.reader(self.iterations())?.symbol_of_segment(segment)
    }

    /// The position of the symbol that opens a polygon.
    fn symbol_of_polygon(&self, number: u128) -> Option<u128> {
        self.shown.as_ref()?.symbol_of_polygon(self.system.as_ref()?, self.iterations(), number)
    }

    fn reader(&self, generation: u32) -> Option<GenerationReader<'_>> {
        let word = self.system.as_ref()?.word(generation).map(GenerationReader::Counted);
        word.or_else(|| Some(GenerationReader::Remembered(self.history.as_ref()?, generation)))
    }

    fn link(&self, ancestor: Ancestor) -> AncestryLink {
        let Ancestor { generation, symbol, arguments, index, production, position } = ancestor;
        let mut module = String::new();
        if self.is_apart() {
            print_module(symbol, &arguments, &mut module);
        } else {
            module.push(symbol);
        }
        AncestryLink { generation, symbol: module, index: index.to_string(), production, position }
    }
}

/// Makes a place in a close-up one from the origin of the view.
fn outside(closeup: &Closeup, place: &mut Place) {
    if let Some(out) = place[..].try_into().ok().and_then(|place| closeup.outside(place)) {
        *place = out.to_vec();
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

fn polygon_facts(figure: &Figure, number: u128) -> Option<PolygonFacts> {
    let StyleChange { level, colour, .. } = figure.polygon_style(number)?;
    Some(PolygonFacts { outline: fitted_polygon(figure, number), level, colour: colour.of(0) })
}

fn ends(range: Range<u128>) -> [String; 2] {
    [range.start.to_string(), range.end.to_string()]
}
