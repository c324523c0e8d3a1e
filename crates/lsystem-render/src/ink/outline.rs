//! The sides of an outline near rows of a picture.

/// A place where the outline crosses a row: its x, and 1 downwards or -1 upwards.
pub(crate) type Crossing = (f64, i32);
/// A side of an outline, from one corner to the next.
pub(crate) type Side = [[f64; 2]; 2];
/// A row with more crossings than this is filled without sorting them, to bound the work of a row.
pub(crate) const MAX_SORTED: usize = 1 << 12;
/// Sides of an outline that are looked at in a unit of work.
pub(crate) const SIDES_PER_UNIT: usize = 8;

/// Collects the sides of an outline that lie between two heights, at least in part. Returns the units of work.
pub(crate) fn sides_in(vertices: &[[f64; 2]], [top, bottom]: [f64; 2], sides: &mut Vec<Side>) -> u64 {
    sides.clear();
    let next = vertices.iter().cycle().skip(1);
    // A side that ends above the first row, or begins below the last, crosses none of them.
    let crosses = |&(a, b): &(&[f64; 2], &[f64; 2])| a[1].max(b[1]) >= top && a[1].min(b[1]) <= bottom;
    sides.extend(vertices.iter().zip(next).filter(crosses).map(|(&a, &b)| [a, b]));
    1 + (vertices.len() / SIDES_PER_UNIT) as u64
}
