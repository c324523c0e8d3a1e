//! Whether the graphs of blocks of two drawings prove that both have the same ink, however many segments there are.

use lsystem_base::sorted;
use lsystem_drawing::{Block, BlockFrame, BlockId, Drawing, Item, Placed, Space, StyleChange};
use std::collections::{BTreeMap, HashSet};

/// Places differ by less than this part of a block's size if they are equal.
const NEAR: f64 = 1e-9;
/// The size of the cells in which equal items are looked up, as a part of a block's size. Rounding errors are far smaller.
const CELL: f64 = 1e-6;
/// Where the cells begin. Coordinates of drawings are seldom near a border then.
const BORDER: f64 = 0.377 * CELL;
/// The most items that are compared as sets.
const MAX_ITEMS: usize = 1 << 18;

/// Whether the graphs of two drawings prove equal pictures, up to the place and the size of the whole. Two blocks have
/// the same ink if their items are the same: strokes, polygons, and blocks that have the same ink in turn. Order,
/// direction and repeats do not count. The result `false` proves nothing, because other rules may give the same
/// picture.
pub(crate) fn is_same_graph<S: Space>(a: &Drawing<S>, b: &Drawing<S>) -> bool {
    let (Some(first), Some(second)) = (a.root, b.root) else { return a.root.is_none() && b.root.is_none() };
    let is_reflected = |drawing: &Drawing<S>| drawing.step < 0.0;
    if is_reflected(a) != is_reflected(b) {
        return false;
    }
    // Equal graphs may still share differently: a block of one may have several partners in the other.
    let most = 4 * (a.block_count() + b.block_count());
    let mut items_left = MAX_ITEMS;
    let mut known: HashSet<(BlockId, BlockId)> = HashSet::from([(first, second)]);
    let mut open = vec![(first, second)];
    while let Some((first, second)) = open.pop() {
        if known.len() > most {
            return false;
        }
        let pairs =
            pairs_in_order((a, first), (b, second)).or_else(|| pairs_of_sets((a, first), (b, second), &mut items_left));
        let Some(pairs) = pairs else { return false };
        open.extend(pairs.into_iter().filter(|pair| known.insert(*pair)));
    }
    true
}

type At<'a, S> = (&'a Drawing<S>, BlockId);

/// The pairs of blocks that must have the same ink, if the items of both blocks are the same one by one; `None` if they
/// are not.
fn pairs_in_order<S: Space>((a, first): At<'_, S>, (b, second): At<'_, S>) -> Option<Vec<(BlockId, BlockId)>> {
    let (own, others) = (a.items_of(first), b.items_of(second));
    if own.len() != others.len() {
        return None;
    }
    let mut pairs = Vec::new();
    for pair in own.iter().zip(others) {
        let is_same = match pair {
            (Item::Stroke(own), Item::Stroke(other)) => is_near(own.from, other.from) && is_near(own.to, other.to),
            (Item::Polygon(own), Item::Polygon(other)) => {
                let (own, others) = (a.vertices_of(own), b.vertices_of(other));
                own.len() == others.len() && own.iter().zip(others).all(|(own, other)| is_near(*own, *other))
            }
            (Item::Block(own), Item::Block(other)) => {
                pairs.push((own.block, other.block));
                corners(a, own).zip(corners(b, other)).all(|(own, other)| is_near(own, other))
            }
            _ => false,
        };
        if !is_same {
            return None;
        }
    }
    Some(pairs)
}

/// As [`pairs_in_order`], for the items as sets. Each looked-up item takes one from `left`; without any left, the result
/// is `None`.
fn pairs_of_sets<S: Space>(
    (a, first): At<'_, S>,
    (b, second): At<'_, S>,
    left: &mut usize,
) -> Option<Vec<(BlockId, BlockId)>> {
    let (own, others) = (Places::of(a, first, left)?, Places::of(b, second, left)?);
    if own.0.len() != others.0.len() {
        return None;
    }
    let mut pairs = Vec::new();
    for ((cells, one), (other_cells, other)) in own.0.iter().zip(&others.0) {
        let is_same = cells == other_cells
            && one.values.iter().zip(&other.values).all(|(a, b)| (a - b).abs() < NEAR)
            && one.blocks.len() == other.blocks.len();
        if !is_same {
            return None;
        }
        pairs.extend(one.blocks.iter().copied().zip(other.blocks.iter().copied()));
    }
    Some(pairs)
}

/// The items of a block without repeats, by the cells of their coordinates.
struct Places(BTreeMap<(u8, Vec<i64>), Place>);

/// Items at one place: a stroke, a polygon, or blocks.
struct Place {
    values: Vec<f64>,
    blocks: Vec<BlockId>,
}

impl Places {
    fn of<S: Space>(drawing: &Drawing<S>, block: BlockId, left: &mut usize) -> Option<Self> {
        let mut places = Self(BTreeMap::new());
        let items = drawing.items_of(block);
        *left = left.checked_sub(items.len())?;
        for item in items {
            match item {
                Item::Stroke(stroke) => {
                    let ends = [stroke.from, stroke.to].map(|end| end.as_ref().to_vec());
                    let [one, other] = [ends.concat(), [ends[1].as_slice(), &ends[0]].concat()];
                    // A stroke of no length has no ink.
                    if !is_near(stroke.from, stroke.to) {
                        places.add(0, if cells(&one) <= cells(&other) { one } else { other }, None);
                    }
                }
                Item::Polygon(polygon) => {
                    let vertices = drawing.vertices_of(polygon);
                    *left = left.checked_sub(vertices.len())?;
                    let values: Vec<f64> = vertices.iter().flat_map(|vertex| vertex.as_ref().to_vec()).collect();
                    places.add(1, values, None);
                }
                Item::Block(placed) if has_ink(&drawing.blocks[placed.block.0 as usize]) => {
                    let values = corners(drawing, placed).flat_map(|corner| corner.as_ref().to_vec()).collect();
                    places.add(2, values, Some(placed.block));
                }
                Item::Block(_) => {}
            }
        }
        // Different blocks at one place pair up by their sizes.
        for place in places.0.values_mut() {
            sorted::sort_by_key(&mut place.blocks, |block| drawing.blocks[block.0 as usize].segments);
        }
        Some(places)
    }

    fn add(&mut self, kind: u8, values: Vec<f64>, block: Option<BlockId>) {
        let place = self.0.entry((kind, cells(&values))).or_insert_with(|| Place { values, blocks: Vec::new() });
        place.blocks.extend(block.filter(|block| !place.blocks.contains(block)));
    }
}

fn has_ink<S: Space>(block: &Block<S>) -> bool {
    block.segments > 0 || block.polygons > 0
}

fn cells(values: &[f64]) -> Vec<i64> {
    values.iter().map(|value| libm::floor((value + BORDER) / CELL) as i64).collect()
}

/// The origin of a placed block and the ends of its axes, in the containing block.
fn corners<S: Space>(drawing: &Drawing<S>, placed: &Placed<S>) -> impl Iterator<Item = S::Point> {
    let frame = BlockFrame::new(1.0, StyleChange::start(0.0)).place(placed, drawing, &mut S::directions());
    let axes = S::Point::default().as_ref().len();
    (0..=axes).map(move |axis| {
        let mut corner = S::Point::default();
        corner.as_mut().iter_mut().take(axis).skip(axis.wrapping_sub(1)).for_each(|value| *value = 1.0);
        frame.transform(corner)
    })
}

fn is_near<P: AsRef<[f64]>>(a: P, b: P) -> bool {
    a.as_ref().iter().zip(b.as_ref()).all(|(a, b)| (a - b).abs() < NEAR)
}
