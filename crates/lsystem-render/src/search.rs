//! The search for the segment or the polygon under a pointer, in any space.

use lsystem_drawing::Space;
use lsystem_drawing::{BlockId, Drawing, Item, Placed, Polygon, Stroke};

/// A place on a picture, and the limits of the search there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pointer {
    /// The place: right of and below the upper left corner, in device pixels.
    pub at: [f64; 2],
    /// Only segments and polygons nearer than this are found, in device pixels.
    pub tolerance: f64,
    /// If given, only the first `upto` segments are searched, and the polygons before the next segment.
    pub upto: Option<u128>,
    /// The most visits: a block, a segment or a polygon is one. So are 8 vertices, and the comparison of 16 blocks.
    pub visits: usize,
}

/// A segment or a polygon found near a pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// The segment or the polygon.
    pub target: Target,
    /// The distance from the pointer in device pixels: 0 on a stroke or inside a polygon. A stroke has the width of the
    /// model here, however thin that is.
    pub distance: f64,
}

/// A segment or a polygon, by its number (0-based): segments in drawing order, polygons in the order in which they are
/// opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A segment.
    Segment(u128),
    /// A filled polygon.
    Polygon(u128),
}

impl Pointer {
    /// The distance in device pixels below which segments count as equally near: a quarter of the tolerance.
    pub fn enough(&self) -> f64 {
        const NEAR: f64 = 0.25;
        self.tolerance * NEAR
    }

    /// Whether a block of this size in pixels counts as one place: any segment inside is as good as another.
    fn is_small(&self, size: f64) -> bool {
        size < self.tolerance * LEAST_GAIN / 3.0
    }
}

/// A segment must be this much nearer than another to replace it, as a part of the tolerance. The limit lets the search
/// leave out blocks that could gain less.
const LEAST_GAIN: f64 = 1.0 / 32.0;

/// Vertices of a polygon that take the time of one visit.
const VERTICES_PER_VISIT: usize = 8;

/// The position of an item relative to the pointer.
#[derive(Clone, Copy)]
pub(crate) struct Aim {
    /// The least distance, in device pixels.
    pub distance: f64,
    /// The least depth: how far behind the camera's target the item is. 0 in the plane, where later items hide earlier
    /// ones.
    pub depth: f64,
    /// The distance of the pointer from the item's middle, as a part of the item's radius.
    pub off: f64,
}

/// Places the items of a drawing relative to a pointer.
pub(crate) trait Sight<S: Space> {
    /// The place of a block.
    type Place: Copy;

    /// The place of a block inside another.
    fn inside(&mut self, place: &Self::Place, placed: &Placed<S>) -> Self::Place;

    /// Whether the block has not been looked into before at the same place, as far as that is known.
    fn is_new(&mut self, _id: BlockId, _place: &Self::Place) -> bool {
        true
    }

    /// Pixels in a unit of a block.
    fn scale(&self, place: &Self::Place) -> f64;

    /// The position of a block relative to the pointer; `None` if the block is out of sight.
    fn block(&self, id: BlockId, place: &Self::Place) -> Option<Aim>;

    /// The position of a stroke relative to the pointer; `None` if the stroke is out of sight.
    fn stroke(&self, place: &Self::Place, stroke: &Stroke<S>) -> Option<Aim>;

    /// The position of a polygon relative to the pointer; `None` if the polygon is out of sight.
    fn polygon(&self, place: &Self::Place, polygon: &Polygon) -> Option<Aim>;
}

/// The order in which a search looks into the blocks inside a block.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Order {
    /// The block with the best possible item first.
    Best,
    /// Until an item is found, the block whose middle is nearest first.
    Likely,
}

/// The order of preference among items.
#[derive(Clone, Copy)]
struct Rank {
    /// Pixels from the pointer, and at least [`Pointer::enough`].
    distance: f64,
    depth: f64,
    /// The number of segments and polygons that come before.
    turn: u128,
}

impl Rank {
    /// Whether the item lies before another by more than `slack` of depth, or is drawn later at the same depth.
    fn hides(&self, other: &Self, slack: f64) -> bool {
        self.depth < other.depth - slack || self.depth == other.depth && self.turn > other.turn
    }
}

/// A block that may be looked into.
struct Candidate<P> {
    block: BlockId,
    place: P,
    /// The numbers of segments and of polygons that come before the block.
    before: [u128; 2],
    /// No item inside has a better rank.
    best_rank: Rank,
    off: f64,
    /// The index of the first candidate inside the same block.
    siblings: usize,
}

/// The segment or the polygon at the pointer, in a drawing whose root is at `root`. Among segments within a quarter of
/// the tolerance and polygons around the pointer, the foremost is picked. If there are none, the nearest is picked, to
/// a 32nd of the tolerance. The search ends with the pointer's visits. Segments and polygons beyond the first 2^128 - 1
/// are not found.
pub(crate) fn search<S: Space, V: Sight<S>>(
    drawing: &Drawing<S>,
    pointer: &Pointer,
    sight: &mut V,
    root: V::Place,
    order: Order,
) -> Option<Pick> {
    // A place that is not a number is near nothing.
    if !pointer.at.iter().all(|coordinate| coordinate.is_finite()) {
        return None;
    }
    let shown = drawing.segment_count().min(pointer.upto.unwrap_or(u128::MAX));
    let (candidates, visits) = (vec![], pointer.visits);
    let mut search = Search { drawing, pointer, sight, order, shown, candidates, best: None, visits };
    search.add(drawing.root?, root, [0; 2], 0);
    while search.visits > 0 {
        let Some(block) = search.next() else { break };
        search.look_into(&block);
    }
    search.best.map(|(_, pick)| pick)
}

/// A search in progress.
struct Search<'a, S: Space, V: Sight<S>> {
    drawing: &'a Drawing<S>,
    pointer: &'a Pointer,
    sight: &'a mut V,
    order: Order,
    /// The number of segments that are searched.
    shown: u128,
    /// The candidates inside the innermost block are last.
    candidates: Vec<Candidate<V::Place>>,
    best: Option<(Rank, Pick)>,
    visits: usize,
}

impl<S: Space, V: Sight<S>> Search<'_, S, V> {
    /// Whether a rank is better than the best so far, by enough to matter.
    fn is_better(&self, rank: &Rank) -> bool {
        let (tolerance, enough) = (self.pointer.tolerance, self.pointer.enough());
        match &self.best {
            None => rank.distance < tolerance,
            Some((best, _)) if rank.distance > enough => rank.distance < best.distance - tolerance * LEAST_GAIN,
            Some((best, _)) => best.distance > enough || rank.hides(best, enough),
        }
    }

    /// Takes the next candidate out of the innermost block that has a candidate better than the best item so far.
    fn next(&mut self) -> Option<Candidate<V::Place>> {
        let likely = self.order == Order::Likely && self.best.is_none();
        /// Candidates that are compared in the time of one visit.
        const COMPARED_PER_VISIT: usize = 16;
        loop {
            let siblings = self.candidates.last()?.siblings;
            // A long block holds so many candidates that the choice among them takes longer than a visit.
            self.visits = self.visits.saturating_sub((self.candidates.len() - siblings) / COMPARED_PER_VISIT);
            let mut best = siblings;
            for i in siblings..self.candidates.len() {
                let [a, b] = [i, best].map(|i| &self.candidates[i]);
                let [rank, other] = [a.best_rank, b.best_rank];
                let sooner = if likely {
                    a.off < b.off
                } else {
                    rank.distance < other.distance || rank.distance == other.distance && rank.hides(&other, 0.0)
                };
                if sooner {
                    best = i;
                }
            }
            if self.is_better(&self.candidates[best].best_rank) {
                return Some(self.candidates.swap_remove(best));
            }
            self.candidates.truncate(siblings);
        }
    }

    /// Considers the items of a block.
    fn look_into(&mut self, block: &Candidate<V::Place>) {
        let Candidate { place, before, .. } = *block;
        let [mut segments, mut polygons] = before;
        // Among exact repeats the last drawn is looked into first, so the others can be left out.
        let whole = self.drawing.blocks[block.block.0 as usize].segments.saturating_add(segments) <= self.shown;
        if whole && !self.sight.is_new(block.block, &place) {
            return;
        }
        let small = self.pointer.is_small(self.sight.scale(&place));
        let siblings = self.candidates.len();
        for item in self.drawing.items_of(block.block) {
            // Beyond the range of `u128` items have no numbers.
            if self.visits == 0 || segments > self.shown || segments == u128::MAX {
                break;
            }
            self.visits -= 1;
            match item {
                Item::Stroke(stroke) => {
                    if segments < self.shown
                        && let Some(aim) = self.sight.stroke(&place, stroke)
                    {
                        let distance = aim.distance.max(self.pointer.enough());
                        self.consider(aim, distance, Target::Segment(segments), segments.saturating_add(polygons));
                    }
                }
                Item::Polygon(polygon) => {
                    self.visits = self.visits.saturating_sub(polygon.count as usize / VERTICES_PER_VISIT);
                    if polygons < self.drawing.polygon_count()
                        && let Some(aim) = self.sight.polygon(&place, polygon)
                    {
                        /// Makes a polygon beside the pointer farther than near enough, unless the polygon is too small
                        /// to be aimed at.
                        const OUTSIDE: f64 = 1.0 + 1e-9;
                        let outside = if aim.distance > 0.0 && !small { OUTSIDE } else { 1.0 };
                        let distance = aim.distance.max(self.pointer.enough() * outside);
                        self.consider(aim, distance, Target::Polygon(polygons), segments.saturating_add(polygons));
                    }
                }
                Item::Block(placed) => {
                    let inner = self.sight.inside(&place, placed);
                    self.add(placed.block, inner, [segments, polygons], siblings);
                }
            }
            segments = segments.saturating_add(self.drawing.segments_in(item));
            polygons = polygons.saturating_add(self.drawing.polygons_in(item));
            // In a small block the first item is as good as any other.
            if small && [segments, polygons] != before {
                break;
            }
        }
    }

    /// Adds a block to the candidates, if an item inside may be better than the best so far.
    fn add(&mut self, id: BlockId, place: V::Place, before: [u128; 2], siblings: usize) {
        let block = &self.drawing.blocks[id.0 as usize];
        let own = block.segments.saturating_add(block.polygons);
        let Some(Aim { distance, depth, off }) = self.sight.block(id, &place).filter(|_| own > 0) else { return };
        let turn = before[0].saturating_add(before[1]).saturating_add(own - 1);
        let best_rank = Rank { distance: distance.max(self.pointer.enough()), depth, turn };
        if self.is_better(&best_rank) {
            self.candidates.push(Candidate { block: id, place, before, best_rank, off, siblings });
        }
    }

    /// Takes an item whose rank counts it as `ranked` pixels away, if the item is better than the best so far.
    fn consider(&mut self, Aim { distance, depth, .. }: Aim, ranked: f64, target: Target, turn: u128) {
        let rank = Rank { distance: ranked, depth, turn };
        // Magnified beyond the range of numbers, an item is near nothing.
        if !distance.is_nan() && self.is_better(&rank) {
            self.best = Some((rank, Pick { target, distance }));
        }
    }
}

/// The distance from a point to a segment, and the place on the segment nearest to it: from 0 at the start to 1 at the
/// end.
pub(crate) fn nearest_on(point: [f64; 2], [from, to]: [[f64; 2]; 2]) -> (f64, f64) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let away = [point[0] - from[0], point[1] - from[1]];
    // Coordinates far beyond the picture are scaled, because their squares overflow.
    let reach = along[0].abs().max(along[1].abs());
    let [x, y] = along.map(|c| c / reach);
    let part = if reach > 0.0 { ((away[0] * x + away[1] * y) / (x * x + y * y) / reach).clamp(0.0, 1.0) } else { 0.0 };
    (libm::hypot(away[0] - part * along[0], away[1] - part * along[1]), part)
}

/// Whether a polygon is filled at a point: whether the winding number of its outline is not zero there.
pub(crate) fn covers(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = outline.iter().cycle().skip(1);
    let winding = outline.iter().zip(next).map(|(&[x0, y0], &[x1, y1])| {
        let crosses = (y0 <= y) != (y1 <= y) && x0 + (y - y0) / (y1 - y0) * (x1 - x0) > x;
        i32::from(crosses) * if y0 < y1 { 1 } else { -1 }
    });
    winding.sum::<i32>() != 0
}
