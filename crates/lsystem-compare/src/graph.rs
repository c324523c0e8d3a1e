//! Whether two drawings have equal graphs of blocks: the same segments in the same order, however many they are.

use lsystem_drawing::{BlockId, Drawing, Frame, Item, Space, StyleChange};
use std::collections::HashSet;

/// Places differ by less than this part of a block's size if they are equal.
const NEAR: f64 = 1e-9;

/// Whether the graphs of two drawings are equal up to the place and the size of the whole. Equal graphs prove equal
/// pictures; different ones prove nothing, because other rules may give the same picture.
pub(crate) fn is_same_graph<S: Space>(a: &Drawing<S>, b: &Drawing<S>) -> bool {
    let (Some(first), Some(second)) = (a.root, b.root) else { return a.root.is_none() && b.root.is_none() };
    let is_reflected = |drawing: &Drawing<S>| drawing.step < 0.0;
    if a.segment_count() != b.segment_count() || is_reflected(a) != is_reflected(b) {
        return false;
    }
    // Equal graphs may still share differently: a block of one may have several partners in the other.
    let most = 4 * (a.block_count() + b.block_count());
    let mut known: HashSet<(BlockId, BlockId)> = HashSet::from([(first, second)]);
    let mut open = vec![(first, second)];
    while let Some((first, second)) = open.pop() {
        let (own, others) = (a.items_of(first), b.items_of(second));
        if own.len() != others.len() || known.len() > most {
            return false;
        }
        for pair in own.iter().zip(others) {
            let is_same = match pair {
                (Item::Stroke(own), Item::Stroke(other)) => is_near(own.from, other.from) && is_near(own.to, other.to),
                (Item::Polygon(own), Item::Polygon(other)) => {
                    let (own, others) = (a.vertices_of(own), b.vertices_of(other));
                    own.len() == others.len() && own.iter().zip(others).all(|(own, other)| is_near(*own, *other))
                }
                (Item::Block(own), Item::Block(other)) => {
                    if known.insert((own.block, other.block)) {
                        open.push((own.block, other.block));
                    }
                    let frame = |placed, drawing| {
                        Frame::new(1.0, StyleChange::start(0.0)).place(placed, drawing, &mut S::directions())
                    };
                    let (own, other) = (frame(own, a), frame(other, b));
                    corners::<S>().all(|corner| is_near(own.transform(corner), other.transform(corner)))
                }
                _ => false,
            };
            if !is_same {
                return false;
            }
        }
    }
    true
}

/// The origin and the ends of the axes.
fn corners<S: Space>() -> impl Iterator<Item = S::Point> {
    let axes = S::Point::default().as_ref().len();
    (0..=axes).map(|axis| {
        let mut corner = S::Point::default();
        corner.as_mut().iter_mut().take(axis).skip(axis.wrapping_sub(1)).for_each(|value| *value = 1.0);
        corner
    })
}

fn is_near<P: AsRef<[f64]>>(a: P, b: P) -> bool {
    a.as_ref().iter().zip(b.as_ref()).all(|(a, b)| (a - b).abs() < NEAR)
}
