//! The layout of a bottom-up picture: the places of its parts, on a lattice that may be coarser than the picture's.

use super::parts::{Joint, Part, Parts};

/// The most words of the pictures of parts at a time: 24 MiB. The tiles are dropped before, which take up to 23 MiB.
pub(in crate::plane) const PART_WORDS: u64 = 24 << 17;
/// The most words of such pictures that are stamped in all: some tenths of a second.
const MAX_WORK: u64 = 400 << 20;
/// The sides of a cell that are tried, in subsamples of the picture. The smallest that meets the limits is taken.
const GRAINS: [u32; 3] = [1, 2, 4];

/// The least cells along the drawing's longer side for each level of parts inside each other. With a part off by a
/// quarter of a cell, all levels together are off by 3 % of the drawing.
const CELLS_PER_LEVEL: f64 = 8.0;

/// A rectangle of cells: its first column and row, and the column and row after its last.
pub(in crate::plane) type Area = [[i64; 2]; 2];

/// The parts on a lattice, each off by half a cell at most.
///
/// If every origin lay in the corner of a cell, a drawing with steps of one length would have all steps in one
/// direction off by the same, and the errors would add up. So a part's origin may lie anywhere in its cell: where the
/// parts inside are off least. The remaining error is about a quarter of a cell for each level of parts, at worst to
/// the same side.
#[derive(Default)]
pub(in crate::plane) struct Layout {
    /// The side of a cell, in subsamples of the picture.
    pub grain: u32,
    /// By joint: the cells from the cell of the part's origin to the cell of the inner part's origin.
    pub shifts: Vec<[i64; 2]>,
    /// By part: the area that is seen, from the cell of the part's origin.
    pub areas: Vec<Area>,
    /// By part: the place of its origin in the origin's cell, in cells from the upper left corner.
    pub phases: Vec<[f64; 2]>,
    /// By part: the number of levels of parts inside.
    heights: Vec<u32>,
    /// By part: how often its picture is still needed.
    pub uses: Vec<u32>,
    /// The cell of the whole drawing's origin.
    pub origin: [i64; 2],
}

/// The search for the finest lattice within the limits.
#[derive(Default)]
pub(in crate::plane) struct Trials {
    /// The index of the next grain.
    next: usize,
    /// A layout whose cost is not known yet.
    layout: Option<Layout>,
}

impl Trials {
    /// Goes on with the search, for the rectangle `seen` of a drawing whose origin is at `origin`, both in subsamples;
    /// `planes` gives the bit planes of a part. Returns `None` if no lattice is within the limits, and `Some(None)` as
    /// long as none is found. Each call looks at all joints a few times.
    pub(in crate::plane) fn step(
        &mut self,
        parts: &Parts,
        origin: [f64; 2],
        seen: [[f64; 2]; 2],
        planes: impl Fn(&Part) -> usize,
    ) -> Option<Option<Layout>> {
        let Some(layout) = self.layout.take() else {
            let grain = *GRAINS.get(self.next)?;
            self.next += 1;
            self.layout = Some(Layout::of_grain(parts, origin, seen, grain));
            return Some(None);
        };
        let [words, work] = layout.cost(parts, &planes);
        Some((layout.is_fine_enough(parts) && words <= PART_WORDS && work <= MAX_WORK).then_some(layout))
    }
}

impl Layout {
    fn of_grain(parts: &Parts, origin: [f64; 2], seen: [[f64; 2]; 2], grain: u32) -> Self {
        let scale = 1.0 / f64::from(grain);
        let cell = origin.map(|v| (v * scale).floor() as i64);
        let rest = [0, 1].map(|axis| origin[axis] * scale - cell[axis] as f64);
        let mut layout = Self {
            grain,
            shifts: vec![[0; 2]; parts.joints.len()],
            areas: vec![[[0; 2]; 2]; parts.list.len()],
            phases: vec![[0.0; 2]; parts.list.len()],
            heights: vec![0; parts.list.len()],
            uses: vec![0; parts.list.len()],
            origin: cell,
        };
        // The innermost parts first: the area that each part covers, with the parts inside, and its levels.
        for &index in parts.order.iter().rev() {
            let part = &parts.list[index];
            let joints = &parts.joints[part.joints.clone()];
            layout.heights[index] = joints.iter().map(|joint| layout.heights[joint.part] + 1).max().unwrap_or(0);
            let wanted = |joint: &Joint| [0, 1].map(|axis| layout.phases[joint.part][axis] - joint.at[axis] * scale);
            let wanted = joints.iter().map(wanted);
            let own = if Some(&index) == parts.order.first() { rest } else { middle(wanted) };
            layout.phases[index] = own;
            let [low, high] = part.bounds.map(|corner| [0, 1].map(|axis| corner[axis] * scale + own[axis]));
            let mut area = [low.map(|v| v.floor() as i64), high.map(|v| v.ceil() as i64 + 1)];
            area = area.map(|corner| corner.map(|v| v.clamp(-FARTHEST, FARTHEST)));
            for (joint, inner) in part.joints.clone().zip(joints) {
                let other = layout.phases[inner.part];
                let shift = [0, 1].map(|axis| (inner.at[axis] * scale + own[axis] - other[axis] + 0.5).floor() as i64);
                layout.shifts[joint] = shift;
                area = union(area, moved(layout.areas[inner.part], shift));
            }
            layout.areas[index] = area;
        }
        // The outermost parts first: the area of each part that is seen.
        let covers = core::mem::replace(&mut layout.areas, vec![NO_CELLS; parts.list.len()]);
        if let Some(&root) = parts.order.first() {
            let ends = [seen[0].map(|v| (v * scale).floor() as i64), seen[1].map(|v| (v * scale).ceil() as i64)];
            layout.areas[root] = common(moved(ends, cell.map(|v| -v)), covers[root]);
        }
        for &index in &parts.order {
            let area = layout.areas[index];
            for joint in parts.list[index].joints.clone().filter(|_| !is_empty(area)) {
                let inner = parts.joints[joint].part;
                let inside = common(moved(area, layout.shifts[joint].map(|v| -v)), covers[inner]);
                if !is_empty(inside) {
                    layout.uses[inner] += 1;
                    layout.areas[inner] = union(layout.areas[inner], inside);
                }
            }
        }
        layout
    }

    /// Whether the lattice is fine enough for the levels of parts.
    fn is_fine_enough(&self, parts: &Parts) -> bool {
        parts.order.first().is_some_and(|&root| {
            let [low, high] = parts.list[root].bounds;
            let side = (high[0] - low[0]).max(high[1] - low[1]) / f64::from(self.grain);
            side >= CELLS_PER_LEVEL * f64::from(self.heights[root])
        })
    }

    /// Whether the picture of a part shows any cell of the part at a joint.
    pub(in crate::plane) fn is_used(&self, parts: &Parts, index: usize, joint: usize) -> bool {
        let inner = parts.joints[joint].part;
        !is_empty(common(moved(self.areas[index], self.shifts[joint].map(|v| -v)), self.areas[inner]))
    }

    /// The most words at a time, and the words stamped in all, if the parts are made one after the other, the last
    /// first.
    fn cost(&self, parts: &Parts, planes: impl Fn(&Part) -> usize) -> [u64; 2] {
        let words = |index: usize| {
            let [width, height] = size(self.areas[index]);
            width.div_ceil(u64::BITS.into()) * height * (1 + planes(&parts.list[index]) as u64)
        };
        let mut uses = self.uses.clone();
        let (mut now, mut most, mut work) = (0_u64, 0, 0_u64);
        for &index in parts.order.iter().rev().filter(|&&index| !is_empty(self.areas[index])) {
            // The part is on the canvas and in the kept picture at the same time.
            most = most.max(now + 2 * words(index));
            now += words(index);
            for joint in parts.list[index].joints.clone().filter(|&joint| self.is_used(parts, index, joint)) {
                let inner = parts.joints[joint].part;
                work += words(inner);
                uses[inner] -= 1;
                if uses[inner] == 0 {
                    now -= words(inner);
                }
            }
        }
        [most, work]
    }
}

/// The mean of places modulo whole cells, from 0 to 1 each way. Each place counts as near as possible to the first.
fn middle(mut places: impl ExactSizeIterator<Item = [f64; 2]>) -> [f64; 2] {
    let count = places.len() as f64;
    let Some(first) = places.next() else { return [0.0; 2] };
    let mut sum = [0.0; 2];
    for place in places {
        for axis in 0..2 {
            let apart = place[axis] - first[axis];
            sum[axis] += apart - libm::round(apart);
        }
    }
    [0, 1].map(|axis| first[axis] + sum[axis] / count).map(|v| v - v.floor())
}

/// Areas are cut at this many cells from the origin, to keep sums in range.
const FARTHEST: i64 = 1 << 40;
/// The empty area.
const NO_CELLS: Area = [[FARTHEST; 2], [-FARTHEST; 2]];

pub(in crate::plane) fn is_empty([low, high]: Area) -> bool {
    low[0] >= high[0] || low[1] >= high[1]
}

/// The numbers of columns and rows.
pub(in crate::plane) fn size([low, high]: Area) -> [u64; 2] {
    [0, 1].map(|axis| (high[axis] - low[axis]).max(0) as u64)
}

fn moved(area: Area, by: [i64; 2]) -> Area {
    area.map(|corner| [corner[0] + by[0], corner[1] + by[1]])
}

fn union(a: Area, b: Area) -> Area {
    [[0, 1].map(|axis| a[0][axis].min(b[0][axis])), [0, 1].map(|axis| a[1][axis].max(b[1][axis]))]
}

fn common(a: Area, b: Area) -> Area {
    [[0, 1].map(|axis| a[0][axis].max(b[0][axis])), [0, 1].map(|axis| a[1][axis].min(b[1][axis]))]
}
