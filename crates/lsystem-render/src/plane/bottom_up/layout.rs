//! Where the parts of a picture are, on a lattice that may be coarser than the picture's.

use super::parts::{Joint, Part, Parts};

/// Words that the pictures of parts may take at a time: 24 MiB, where tiles, which are dropped before, take 23.
pub(in crate::plane) const ROOM: u64 = 24 << 17;
/// Words of such pictures that may be painted in all: some tenths of a second.
const WORK: u64 = 400 << 20;
/// How many subsamples of the picture a cell of the lattice has along its side: the finest that will do is taken.
const GRAINS: [u32; 3] = [1, 2, 4];

/// The fewest cells along the drawing's longer side for each of the parts that are inside each other: 3 % of the drawing is
/// the most that anything is off.
const LEAST: f64 = 8.0;

/// The cells from the first to before the second: columns and rows.
pub(in crate::plane) type Area = [[i64; 2]; 2];

/// The parts on a lattice, each off by half a cell at most.
///
/// If all had their origins in the corners of cells, a drawing whose steps are of one length would have each step in some
/// direction off by the same, and the more of them the more. So a part's origin may lie anywhere in its cell: where those
/// inside it are off least. What is left is about a quarter of a cell for each of the parts inside each other,
/// at worst to the same side.
#[derive(Default)]
pub(in crate::plane) struct Layout {
    /// How many subsamples of the picture there are along the side of a cell.
    pub grain: u32,
    /// By joint: cells from the origin's cell of a part to that of the one inside.
    pub shifts: Vec<[i64; 2]>,
    /// By part: what of it is seen, from its origin's cell.
    pub areas: Vec<Area>,
    /// By part: where its origin lies, from the upper left corner of the origin's cell.
    pub phases: Vec<[f64; 2]>,
    /// By part: how many others are inside each other in it.
    heights: Vec<u32>,
    /// By part: how often it is needed.
    pub uses: Vec<u32>,
    /// The cell of the whole drawing's origin.
    pub origin: [i64; 2],
}

/// The lattices tried so far, from the finest on.
#[derive(Default)]
pub(in crate::plane) struct Trials {
    next: usize,
    /// One of which it is not known yet what it takes.
    layout: Option<Layout>,
}

impl Trials {
    /// Tries a lattice for the part `seen` of a drawing whose origin is at `origin`, both in subsamples; `planes` tells how
    /// many planes a part has. One that takes no more memory and time than it may, when it is found; `None` where there
    /// is none. Each call looks at all joints a few times.
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
        let [room, work] = layout.cost(parts, &planes);
        Some((layout.is_true(parts) && room <= ROOM && work <= WORK).then_some(layout))
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
        // What each covers, with what it contains where that is put; and how many are inside each other there.
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
            area = area.map(|corner| corner.map(|v| v.clamp(-FAR, FAR)));
            for (joint, inner) in part.joints.clone().zip(joints) {
                let other = layout.phases[inner.part];
                let shift = [0, 1].map(|axis| (inner.at[axis] * scale + own[axis] - other[axis] + 0.5).floor() as i64);
                layout.shifts[joint] = shift;
                area = union(area, moved(layout.areas[inner.part], shift));
            }
            layout.areas[index] = area;
        }
        // What of that is seen, from the whole on.
        let covers = core::mem::replace(&mut layout.areas, vec![NOTHING; parts.list.len()]);
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

    /// Whether the lattice is fine enough for the parts that are inside each other.
    fn is_true(&self, parts: &Parts) -> bool {
        parts.order.first().is_some_and(|&root| {
            let [low, high] = parts.list[root].bounds;
            let side = (high[0] - low[0]).max(high[1] - low[1]) / f64::from(self.grain);
            side >= LEAST * f64::from(self.heights[root])
        })
    }

    /// The joints of a part whose picture shows something of what they join.
    pub(in crate::plane) fn is_used(&self, parts: &Parts, index: usize, joint: usize) -> bool {
        let inner = parts.joints[joint].part;
        !is_empty(common(moved(self.areas[index], self.shifts[joint].map(|v| -v)), self.areas[inner]))
    }

    /// The most words at a time, and the words painted in all, if parts are done one after the other from the last on.
    fn cost(&self, parts: &Parts, planes: impl Fn(&Part) -> usize) -> [u64; 2] {
        let words = |index: usize| {
            let [width, height] = size(self.areas[index]);
            width.div_ceil(u64::BITS.into()) * height * (1 + planes(&parts.list[index]) as u64)
        };
        let mut uses = self.uses.clone();
        let (mut now, mut most, mut work) = (0_u64, 0, 0_u64);
        for &index in parts.order.iter().rev().filter(|&&index| !is_empty(self.areas[index])) {
            // On the canvas and as it is kept.
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

/// The middle of what places in a cell are, apart from whole cells: as seen from the first of them.
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

/// Farther away nothing is.
const FAR: i64 = 1 << 40;
/// No cells.
const NOTHING: Area = [[FAR; 2], [-FAR; 2]];

pub(in crate::plane) fn is_empty([low, high]: Area) -> bool {
    low[0] >= high[0] || low[1] >= high[1]
}

/// Columns and rows.
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
