//! The way down to what is under a pointer, in any space.

use lsystem_drawing::Space;
use lsystem_drawing::{BlockId, Drawing, Item, Placed, Polygon, Stroke};

/// A place on a picture, and how hard to look there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pointer {
    /// Right of and below the upper left corner, in device pixels.
    pub at: [f64; 2],
    /// What is nearer than this may be meant, in device pixels.
    pub tolerance: f64,
    /// Only the first so many segments are there, and the polygons before the next; everything without it.
    pub upto: Option<u128>,
    /// Blocks, segments and polygons that are looked at, at most; of many blocks in one, and of vertices, some count as one.
    pub visits: usize,
}

/// Something found near a pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// What it is.
    pub target: Target,
    /// How far the pointer is from it, in device pixels: 0 upon a stroke or inside a polygon. A stroke is as wide as in
    /// the model here, however thin that is.
    pub distance: f64,
}

/// What a pointer may be upon: the number of a segment or of a polygon among all of its sort, in drawing order, 0-based.
/// Polygons come in the order in which they are opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A segment.
    Segment(u128),
    /// A filled polygon.
    Polygon(u128),
}

impl Pointer {
    /// A segment this near is as good as any that is nearer.
    pub fn enough(&self) -> f64 {
        /// As a part of the tolerance.
        const CLOSE: f64 = 0.25;
        self.tolerance * CLOSE
    }

    /// A block of this size in pixels is in one place: whatever is in it will do.
    fn is_small(&self, size: f64) -> bool {
        size < self.tolerance * BETTER / 3.0
    }
}

/// Something must be this much nearer than another to be better, as a part of the tolerance; and a block that is smaller
/// is in one place.
const BETTER: f64 = 1.0 / 32.0;

/// Vertices of a polygon that are looked at in the time in which a segment is.
const VERTICES: usize = 8;

/// How something lies to the pointer.
#[derive(Clone, Copy)]
pub(crate) struct Aim {
    /// The least distance, in device pixels.
    pub distance: f64,
    /// How far behind the target it is at least; 0 in the plane, where what is drawn later hides what was there.
    pub depth: f64,
    /// How far the pointer is from its middle, as a part of its radius.
    pub off: f64,
}

/// Places what a drawing holds beside a pointer.
pub(crate) trait Sight<S: Space> {
    /// Where a block is.
    type Place: Copy;

    /// Where a block inside another is.
    fn inside(&mut self, place: &Self::Place, placed: &Placed<S>) -> Self::Place;

    /// Whether no block that draws the same has been looked into before, where that is known.
    fn is_new(&mut self, _id: BlockId, _place: &Self::Place) -> bool {
        true
    }

    /// Pixels in a unit of a block.
    fn scale(&self, place: &Self::Place) -> f64;

    /// How a block lies to the pointer; `None` where nothing of it can be seen.
    fn block(&self, id: BlockId, place: &Self::Place) -> Option<Aim>;

    /// The same of a stroke.
    fn stroke(&self, place: &Self::Place, stroke: &Stroke<S>) -> Option<Aim>;

    /// The same of a polygon.
    fn polygon(&self, place: &Self::Place, polygon: &Polygon) -> Option<Aim>;
}

/// In which order a search looks into the blocks that another holds.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Order {
    /// What is best if it is there.
    Best,
    /// Until something is found, that where this is most likely.
    Likely,
}

/// How well something is seen.
#[derive(Clone, Copy)]
struct Rank {
    /// Pixels from the pointer, or as many as are near enough.
    beside: f64,
    depth: f64,
    /// How many segments and polygons come before it.
    turn: u128,
}

impl Rank {
    /// Whether it lies before another, by more than `slack`.
    fn hides(&self, other: &Self, slack: f64) -> bool {
        self.depth < other.depth - slack || self.depth == other.depth && self.turn > other.turn
    }
}

/// A block to be looked into.
struct Open<P> {
    block: BlockId,
    place: P,
    /// How many segments and how many polygons come before it.
    before: [u128; 2],
    /// Nothing inside is better.
    least: Rank,
    off: f64,
    /// Where in the list those begin that are in the same block.
    siblings: usize,
}

/// What the pointer is upon, in a drawing whose root is at `root`. Of what is within a quarter of the tolerance it is what
/// hides the rest, a polygon only if the pointer is inside; where there is nothing, it is the nearest, to a 32nd of the
/// tolerance. It is the best of what may be looked at. Nothing beyond the first 2^128 - 1 of its sort is found.
pub(crate) fn search<S: Space, V: Sight<S>>(
    drawing: &Drawing<S>,
    pointer: &Pointer,
    sight: &mut V,
    root: V::Place,
    order: Order,
) -> Option<Pick> {
    // Nothing is near a place that is no place.
    if !pointer.at.iter().all(|coordinate| coordinate.is_finite()) {
        return None;
    }
    let shown = drawing.segment_count().min(pointer.upto.unwrap_or(u128::MAX));
    let mut search = Search { drawing, pointer, sight, order, shown, open: vec![], best: None, visits: pointer.visits };
    search.add(drawing.root?, root, [0; 2], 0);
    while search.visits > 0 {
        let Some(block) = search.next() else { break };
        search.look_into(&block);
    }
    search.best.map(|(_, pick)| pick)
}

struct Search<'a, S: Space, V: Sight<S>> {
    drawing: &'a Drawing<S>,
    pointer: &'a Pointer,
    sight: &'a mut V,
    order: Order,
    /// How many segments are there.
    shown: u128,
    /// Those of inner blocks last.
    open: Vec<Open<V::Place>>,
    best: Option<(Rank, Pick)>,
    visits: usize,
}

impl<S: Space, V: Sight<S>> Search<'_, S, V> {
    /// Whether something is better than the best so far, by enough to matter.
    fn is_better(&self, rank: &Rank) -> bool {
        let (tolerance, enough) = (self.pointer.tolerance, self.pointer.enough());
        match &self.best {
            None => rank.beside < tolerance,
            Some((best, _)) if rank.beside > enough => rank.beside < best.beside - tolerance * BETTER,
            Some((best, _)) => best.beside > enough || rank.hides(best, enough),
        }
    }

    /// Takes a block of those that were found last, unless nothing there is better than what there is.
    fn next(&mut self) -> Option<Open<V::Place>> {
        let likely = self.order == Order::Likely && self.best.is_none();
        /// Blocks that are compared in the time in which one is looked at.
        const COMPARED: usize = 16;
        loop {
            let siblings = self.open.last()?.siblings;
            // Long blocks hold so many that choosing one of them takes longer than looking into it.
            self.visits = self.visits.saturating_sub((self.open.len() - siblings) / COMPARED);
            let mut best = siblings;
            for i in siblings..self.open.len() {
                let [a, b] = [i, best].map(|i| &self.open[i]);
                let [least, other] = [a.least, b.least];
                let sooner = if likely {
                    a.off < b.off
                } else {
                    least.beside < other.beside || least.beside == other.beside && least.hides(&other, 0.0)
                };
                if sooner {
                    best = i;
                }
            }
            if self.is_better(&self.open[best].least) {
                return Some(self.open.swap_remove(best));
            }
            self.open.truncate(siblings);
        }
    }

    /// Considers what a block holds.
    fn look_into(&mut self, block: &Open<V::Place>) {
        let Open { place, before, .. } = *block;
        let [mut segments, mut polygons] = before;
        // Of what repeats something exactly the last is looked into first.
        let whole = self.drawing.blocks[block.block.0 as usize].segments.saturating_add(segments) <= self.shown;
        if whole && !self.sight.is_new(block.block, &place) {
            return;
        }
        let small = self.pointer.is_small(self.sight.scale(&place));
        let siblings = self.open.len();
        for item in self.drawing.items_of(block.block) {
            // Nobody can count to what comes after so many.
            if self.visits == 0 || segments > self.shown || segments == u128::MAX {
                break;
            }
            self.visits -= 1;
            match item {
                Item::Stroke(stroke) => {
                    if segments < self.shown
                        && let Some(aim) = self.sight.stroke(&place, stroke)
                    {
                        let beside = aim.distance.max(self.pointer.enough());
                        self.consider(aim, beside, Target::Segment(segments), segments.saturating_add(polygons));
                    }
                }
                Item::Polygon(polygon) => {
                    self.visits = self.visits.saturating_sub(polygon.count as usize / VERTICES);
                    if polygons < self.drawing.polygon_count()
                        && let Some(aim) = self.sight.polygon(&place, polygon)
                    {
                        /// Beside what one sees there is nothing of it, but for what is too small to be aimed at.
                        const OUTSIDE: f64 = 1.0 + 1e-9;
                        let outside = if aim.distance > 0.0 && !small { OUTSIDE } else { 1.0 };
                        let beside = aim.distance.max(self.pointer.enough() * outside);
                        self.consider(aim, beside, Target::Polygon(polygons), segments.saturating_add(polygons));
                    }
                }
                Item::Block(placed) => {
                    let inner = self.sight.inside(&place, placed);
                    self.add(placed.block, inner, [segments, polygons], siblings);
                }
            }
            segments = segments.saturating_add(self.drawing.segments_in(item));
            polygons = polygons.saturating_add(self.drawing.polygons_in(item));
            // A small block is in one place: anything inside will do.
            if small && [segments, polygons] != before {
                break;
            }
        }
    }

    /// Adds a block to be looked into, if there may be something better.
    fn add(&mut self, id: BlockId, place: V::Place, before: [u128; 2], siblings: usize) {
        let block = &self.drawing.blocks[id.0 as usize];
        let own = block.segments.saturating_add(block.polygons);
        let Some(Aim { distance, depth, off }) = self.sight.block(id, &place).filter(|_| own > 0) else { return };
        let turn = before[0].saturating_add(before[1]).saturating_add(own - 1);
        let least = Rank { beside: distance.max(self.pointer.enough()), depth, turn };
        if self.is_better(&least) {
            self.open.push(Open { block: id, place, before, least, off, siblings });
        }
    }

    /// Takes something, if it is better than what there is.
    fn consider(&mut self, Aim { distance, depth, .. }: Aim, beside: f64, target: Target, turn: u128) {
        let rank = Rank { beside, depth, turn };
        // What is magnified beyond all numbers is near nothing.
        if !distance.is_nan() && self.is_better(&rank) {
            self.best = Some((rank, Pick { target, distance }));
        }
    }
}

/// The distance from a point to a segment, and which part of the segment is before the place nearest to it.
pub(crate) fn nearest_on(point: [f64; 2], [from, to]: [[f64; 2]; 2]) -> (f64, f64) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let away = [point[0] - from[0], point[1] - from[1]];
    // Squares of what is far beyond the picture are no numbers.
    let reach = along[0].abs().max(along[1].abs());
    let [x, y] = along.map(|c| c / reach);
    let part = if reach > 0.0 { ((away[0] * x + away[1] * y) / (x * x + y * y) / reach).clamp(0.0, 1.0) } else { 0.0 };
    (libm::hypot(away[0] - part * along[0], away[1] - part * along[1]), part)
}

/// Whether a polygon is filled at a point: whether its outline winds around that a number of times other than zero.
pub(crate) fn covers(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = outline.iter().cycle().skip(1);
    let winding = outline.iter().zip(next).map(|(&[x0, y0], &[x1, y1])| {
        let crosses = (y0 <= y) != (y1 <= y) && x0 + (y - y0) / (y1 - y0) * (x1 - x0) > x;
        i32::from(crosses) * if y0 < y1 { 1 } else { -1 }
    });
    winding.sum::<i32>() != 0
}
