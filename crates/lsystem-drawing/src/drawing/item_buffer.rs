//! The items of a block in the making.

use super::builder::Builder;
use super::taper::{Flow, Taper, TaperItems};
use crate::chunks::Chunks;
use crate::drawing::block::{Item, Placed, Polygon, Space, Stroke};
use crate::exact_path::{ExactPath, Leg, Spot};
use crate::room::{bytes_of, reserve};
use crate::space::{Geometry, minus};
use crate::style::{StyleChange, Styles, WidthChange};
use crate::turtle::Paper;

/// An open polygon: the index of its item, and its vertices so far.
type OpenPolygon<S> = (usize, Vec<Vertex<S>>);
/// A vertex, and its exact place.
type Vertex<S> = (<S as Geometry>::Point, Spot);

/// The items that will form blocks, and the polygons that are still open.
#[derive(Clone, Debug)]
pub(super) struct ItemBuffer<S: Space> {
    pub items: Vec<Item<S>>,
    /// The open polygons, innermost last.
    open: Vec<OpenPolygon<S>>,
    /// The number of vertices of all open polygons.
    held: usize,
    /// The place of the symbol that is being drawn, as in [`Polygon::symbol`].
    pub symbol: u32,
    /// The items that wait for the widths at their ends, if strokes taper.
    pub taper: Option<Taper>,
}

impl<S: Space> ItemBuffer<S> {
    pub(super) fn new(tapers: bool) -> Self {
        Self { items: vec![], open: vec![], held: 0, symbol: 0, taper: tapers.then(Taper::new) }
    }

    /// Whether no polygon is open.
    pub(crate) fn is_closed(&self) -> bool {
        self.open.is_empty()
    }

    /// Removes polygons that were never closed or have fewer than three vertices.
    pub(super) fn finish(&mut self) {
        self.open.clear();
        self.items.retain(|item| !item.is_hollow());
    }

    /// The bytes that the buffer occupies. A list of vertices may have twice the capacity that it uses.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.items)
            + bytes_of(&self.open)
            + (2 * self.held * size_of::<Vertex<S>>()) as u64
            + self.taper.as_ref().map_or(0, Taper::bytes)
    }
}

/// The point at which an item begins.
pub(super) fn origin<S: Space>(builder: &Builder<S>, item: &Item<S>) -> (S::Point, Spot) {
    match item {
        Item::Stroke(stroke) => (stroke.from, builder.exact_path.start(stroke.spot)),
        Item::Polygon(polygon) => {
            let first = polygon.first as usize;
            (builder.vertices[first], builder.exact_path.vertices.get(first).copied().unwrap_or_default())
        }
        Item::Block(placed) => (placed.at, placed.spot.unwrap_or_default()),
    }
}

/// Makes all coordinates relative to `origin`.
pub(super) fn shift<S: Space>(builder: &mut Builder<S>, items: &mut [Item<S>], origin: &S::Point) {
    for item in items {
        match item {
            Item::Stroke(stroke) => {
                stroke.from = minus(stroke.from, origin);
                stroke.to = minus(stroke.to, origin);
            }
            Item::Polygon(polygon) => {
                let vertices = &mut builder.vertices[polygon.range()];
                vertices.iter_mut().for_each(|vertex| *vertex = minus(*vertex, origin));
            }
            Item::Block(placed) => placed.at = minus(placed.at, origin),
        }
    }
}

/// Adds strokes and polygons to a buffer, and their styles and vertices to the builder's lists.
pub(crate) struct ItemWriter<'a, S: Space> {
    pub buffer: &'a mut ItemBuffer<S>,
    pub made: &'a mut Chunks<Item<S>>,
    pub styles: &'a mut Styles,
    pub vertices: &'a mut Vec<S::Point>,
    pub exact_path: &'a mut ExactPath<S>,
}

impl<S: Space> ItemWriter<'_, S> {
    /// Hands the items that wait for the widths at their ends to `note`, if strokes taper.
    fn taper(&mut self, note: impl FnOnce(&mut Taper, usize, &mut TaperItems<'_, S>)) {
        let ItemBuffer { items, taper, .. } = &mut *self.buffer;
        if let Some(taper) = taper {
            let index = items.len();
            note(taper, index, &mut TaperItems { buffer: items, made: self.made, styles: self.styles });
        }
    }

    fn push(&mut self, [from, to]: [S::Point; 2], spot: Spot, style: &StyleChange) {
        reserve(&mut self.buffer.items, 1);
        self.buffer.items.push(Item::Stroke(Stroke { from, to, style: self.styles.id(style), spot }));
    }

    /// As [`Tree::place`](super::tree::Tree::place).
    pub(super) fn place(&mut self, placed: Option<Placed<S>>, flow: &Flow, entry: WidthChange) {
        self.taper(|taper, index, items| taper.piece(flow, entry, index, items));
        self.buffer.items.extend(placed.map(Item::Block));
    }
}

impl<S: Space> Paper<S> for ItemWriter<'_, S> {
    fn go(&mut self, leg: Leg<S>) -> Spot {
        self.exact_path.go(leg)
    }

    fn stroke(&mut self, ends: [S::Point; 2], spot: Spot, style: &StyleChange) {
        self.taper(|taper, index, items| taper.stroke(style.width, index, items));
        self.push(ends, spot, style);
    }

    fn side(&mut self, ends: [S::Point; 2], spot: Spot, style: &StyleChange) {
        let next = self.buffer.taper.is_some().then_some(style.width);
        self.push(ends, spot, &StyleChange { next, ..*style });
    }

    fn tube(&mut self, ends: [S::Point; 2], style: &StyleChange) {
        // Without tapers, an even stroke has no width at its end.
        let next = style.next.filter(|next| self.buffer.taper.is_some() || *next != style.width);
        self.push(ends, Spot::ENTRY, &StyleChange { next, ..*style });
    }

    fn gap(&mut self) {
        self.taper(|taper, _, items| taper.gap(items));
    }

    fn branch(&mut self) {
        self.taper(|taper, _, _| taper.open());
    }

    fn rejoin(&mut self) {
        self.taper(|taper, _, items| taper.close(items));
    }

    fn open(&mut self, style: &StyleChange) {
        // A polygon lies beneath the strokes that are drawn while it is open, so its item comes first.
        self.buffer.open.push((self.buffer.items.len(), vec![]));
        let ItemBuffer { items, symbol, .. } = self.buffer;
        items.push(Item::Polygon(Polygon { first: 0, count: 0, style: self.styles.id(style), symbol: *symbol }));
    }

    fn first_vertex(&mut self, at: S::Point, spot: Spot) {
        if self.buffer.open.last().is_some_and(|(_, vertices)| vertices.is_empty()) {
            self.vertex(at, spot);
        }
    }

    fn vertex(&mut self, at: S::Point, spot: Spot) {
        if let Some((_, vertices)) = self.buffer.open.last_mut()
            && vertices.last().is_none_or(|&(last, before)| last != at || before != spot && self.exact_path.kept)
        {
            vertices.push((at, spot));
            self.buffer.held += 1;
        }
    }

    fn close(&mut self) {
        let Some((place, vertices)) = self.buffer.open.pop() else { return };
        self.buffer.held -= vertices.len();
        if vertices.len() > 2
            && let Some(Item::Polygon(polygon)) = self.buffer.items.get_mut(place)
        {
            (polygon.first, polygon.count) = (self.vertices.len() as u32, vertices.len() as u32);
            reserve(self.vertices, vertices.len());
            self.vertices.extend(vertices.iter().map(|(at, _)| at));
            if self.exact_path.kept {
                self.exact_path.vertices.extend(vertices.iter().map(|(_, spot)| spot));
            }
        }
    }
}
