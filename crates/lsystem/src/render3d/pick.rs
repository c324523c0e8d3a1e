//! Which segment of a drawing in space is under a pointer.

use super::camera::{Camera, Lens, NEAR};
use super::walk::before_eye;
use crate::drawing::Frame;
use crate::render::{BETTER, nearest_on};
use crate::rotation::{Vector, combine, cross, norm};
use crate::{BlockId, Drawing, Item, Pick, Pointer, Solid, Stroke, StyleChange, Viewport};

/// The segment under a pointer as the camera sees it. Of those whose strokes are within a quarter of the tolerance it is
/// the one nearest to the eye, to about that in depth; where there are none, the one nearest to the pointer, to a 32nd of
/// the tolerance. Where many blocks overlap it is the best of what may be looked at. Polygons hide nothing, and segments
/// beyond the first 2^128 - 1 are not found.
#[must_use]
pub fn pick_solid(drawing: &Drawing<Solid>, viewport: Viewport, camera: &Camera, pointer: &Pointer) -> Option<Pick> {
    let lens = Lens::new(drawing, viewport, camera, 1.0);
    let [x, y] = [0, 1].map(|i| pointer.at[i] - lens.middle[i]);
    let towards = [x * lens.nearness, y * lens.nearness, 1.0];
    let mut search = Search {
        drawing,
        pointer,
        lens,
        unit: norm(lens.axes[0]),
        ray: [[x, y, 0.0], towards.map(|c| c / norm(towards))],
        open: vec![],
        best: None,
        visits: pointer.visits,
    };
    let frame = Frame::new(1.0, StyleChange::start(drawing.width));
    search.open.extend(search.seen(drawing.root?, &frame, 0, 0));
    while let Some(block) = search.next().filter(|_| search.visits > 0) {
        search.look_into(&block);
    }
    let (_, pick) = search.best?;
    Some(pick).filter(|pick| pick.segment < drawing.segment_count())
}

/// How well something is seen: smaller is better.
#[derive(Clone, Copy)]
struct Rank {
    /// Pixels from the pointer, or as many as are near enough.
    beside: f64,
    /// How far it is behind the target, in pixels there.
    depth: f64,
}

/// A block to be looked into.
struct Open {
    block: BlockId,
    frame: Frame<Solid>,
    /// The number of its first segment.
    first: u128,
    /// No segment inside is better.
    least: Rank,
    /// How far the pointer is from its middle, as a part of its radius.
    off: f64,
    /// Where in the list those begin that are in the same block.
    siblings: usize,
}

struct Search<'a> {
    drawing: &'a Drawing<Solid>,
    pointer: &'a Pointer,
    lens: Lens,
    /// Pixels in a unit of the root block, at the target.
    unit: f64,
    /// What the pointer covers: a place and a direction, as the lens sees them before perspective.
    ray: [Vector; 2],
    /// Those of inner blocks last.
    open: Vec<Open>,
    best: Option<(Rank, Pick)>,
    visits: usize,
}

impl Search<'_> {
    /// Whether something is better than the best so far, by enough to matter.
    fn is_better(&self, rank: Rank) -> bool {
        let (tolerance, enough) = (self.pointer.tolerance, self.pointer.enough());
        match &self.best {
            None => rank.beside < tolerance,
            Some((best, _)) if rank.beside > enough => rank.beside < best.beside - tolerance * BETTER,
            Some((best, _)) => best.beside > enough || rank.depth < best.depth - enough,
        }
    }

    /// Takes a block of those that were found last, unless nothing there is better than what there is: the one whose
    /// middle is nearest to the pointer, so that something is found soon, and then the nearest to the eye.
    fn next(&mut self) -> Option<Open> {
        loop {
            let siblings = self.open.last()?.siblings;
            let mut best = siblings;
            for i in siblings..self.open.len() {
                let [a, b] = [i, best].map(|i| &self.open[i]);
                let nearer = if self.best.is_none() {
                    a.off < b.off
                } else {
                    let [a, b] = [a.least, b.least];
                    a.beside < b.beside || a.beside == b.beside && a.depth < b.depth
                };
                if nearer {
                    best = i;
                }
            }
            if self.is_better(self.open[best].least) {
                return Some(self.open.swap_remove(best));
            }
            self.open.truncate(siblings);
        }
    }

    /// Considers what a block holds.
    fn look_into(&mut self, block: &Open) {
        let drawing = self.drawing;
        let Open { frame, mut first, .. } = *block;
        let small = self.unit * frame.scale < self.pointer.tolerance * BETTER / 3.0;
        let siblings = self.open.len();
        for item in drawing.items_of(block.block) {
            if self.visits == 0 || self.pointer.upto.is_some_and(|upto| first >= upto) {
                break;
            }
            self.visits -= 1;
            match item {
                Item::Stroke(stroke) => self.consider(stroke, &frame, first),
                Item::Polygon(_) => {}
                Item::Block(placed) => {
                    let inner = frame.place(placed, drawing, &mut ());
                    let seen = self.seen(placed.block, &inner, first, siblings);
                    self.open.extend(seen.filter(|open| self.is_better(open.least)));
                }
            }
            first = first.saturating_add(drawing.segments_in(item));
            // A small block is in one place: any of its segments will do.
            if small && first > block.first {
                break;
            }
        }
    }

    /// Takes a stroke, if it is better than what there is.
    fn consider(&mut self, stroke: &Stroke<Solid>, frame: &Frame<Solid>, segment: u128) {
        let lens = &self.lens;
        let ends = [stroke.from, stroke.to].map(|end| self.place(frame.lie(end)));
        let Some(ends) = before_eye(lens, ends).map(|ends| ends.map(|end| lens.project(end))) else { return };
        let (axis, t) = nearest_on(self.pointer.at, ends.map(|[x, y, _]| [x, y]));
        let shown = ends[0][2] + t * (ends[1][2] - ends[0][2]);
        let depth = shown / (1.0 - shown * lens.nearness);
        let style = frame.style.then(&self.drawing.styles[stroke.style.0 as usize]);
        let radius = (style.width.of(0.0) * lens.step / 2.0).max(0.0);
        let off = axis / lens.factor(depth);
        let distance = (axis - radius * lens.factor(depth)).max(0.0);
        // Its surface bulges towards the eye.
        let depth = depth - (radius * radius - off * off).max(0.0).sqrt();
        let rank = Rank { beside: distance.max(self.pointer.enough()), depth };
        if self.is_better(rank) {
            self.best = Some((rank, Pick { segment, distance }));
        }
    }

    /// A block, unless none of its segments is before the eye.
    fn seen(&self, id: BlockId, frame: &Frame<Solid>, first: u128, siblings: usize) -> Option<Open> {
        let (block, lens) = (&self.drawing.blocks[id.0 as usize], &self.lens);
        let widest = block.widest.of(frame.style.width.of(0.0)).max(0.0) * lens.step / 2.0;
        // Rounding may leave an end out.
        let radius = (block.hull.radius + 1e-9) * frame.scale * self.unit + widest;
        let centre = self.place(frame.lie(block.hull.centre()));
        let [near, far] = [centre[2] - radius, centre[2] + radius];
        if block.segments == 0 || 1.0 + far * lens.nearness <= NEAR {
            return None;
        }
        let [from, towards] = self.ray;
        let away = norm(cross([0, 1, 2].map(|i| centre[i] - from[i]), towards));
        let beside = ((away - radius) * lens.factor(far)).max(self.pointer.enough());
        Some(Open {
            block: id,
            frame: *frame,
            first,
            least: Rank { beside, depth: near },
            off: away / radius,
            siblings,
        })
    }

    /// Where a point of the root block lies, as the lens sees it before perspective.
    fn place(&self, point: Vector) -> Vector {
        let [x, y, z] = combine(&self.lens.axes, point);
        let [x0, y0, z0] = self.lens.origin;
        [x0 + x, y0 + y, z0 + z]
    }
}
