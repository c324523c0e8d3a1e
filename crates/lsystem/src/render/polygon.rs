//! A filled polygon, row by row.

use super::canvas::{Canvas, GROUP, NOTHING, Spans};

/// Paints every subsample whose centre the outline winds around a number of times other than zero; `vertices` on the
/// subsample lattice, y down. Returns how many rows and spans it took.
pub(super) fn paint(canvas: &mut Canvas, vertices: &[[f64; 2]], colour: u32) -> usize {
    let [right, height] = canvas.size();
    if vertices.iter().flatten().any(|c| !c.is_finite()) {
        return 0;
    }
    let ends =
        vertices.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [_, y]| [low.min(*y), high.max(*y)]);
    let first = (ends[0] - 0.5).ceil().max(0.0);
    let last = (ends[1] - 0.5).floor().min(height - 1.0);
    if first > last {
        return 0;
    }
    let mut work = 0;
    // Where the outline crosses a row, and whether downwards.
    let mut crossings: Vec<(f64, i32)> = Vec::new();
    // The first spans of the rows of a group, their second spans, and so on.
    let mut layers: Vec<Spans> = Vec::new();
    let (first, end) = (first as usize, last as usize + 1);
    for group in first / GROUP..end.div_ceil(GROUP) {
        let rows = first.max(group * GROUP)..end.min(group * GROUP + GROUP);
        layers.clear();
        for row in rows.clone() {
            let y = row as f64 + 0.5;
            crossings.clear();
            let next = vertices.iter().cycle().skip(1);
            for (&[x0, y0], &[x1, y1]) in vertices.iter().zip(next) {
                if (y0 <= y) != (y1 <= y) {
                    let x = x0 + (y - y0) / (y1 - y0) * (x1 - x0);
                    crossings.push((x, if y0 < y1 { 1 } else { -1 }));
                }
            }
            crossings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let (mut winding, mut start, mut layer) = (0, 0.0, 0);
            for &(x, way) in &crossings {
                if winding == 0 {
                    start = x;
                }
                winding += way;
                if winding == 0 {
                    // From the first to the last centre between the two.
                    let from = (start - 0.5).ceil().clamp(0.0, right) as i64;
                    let to = (x - 0.5).floor().clamp(-1.0, right - 1.0) as i64;
                    if from <= to {
                        if layer == layers.len() {
                            layers.push([NOTHING; GROUP]);
                        }
                        layers[layer][row % GROUP] = [from, to];
                        layer += 1;
                    }
                    work += 1;
                }
            }
            work += vertices.len() / 8;
        }
        for layer in &layers {
            let reach = layer.iter().fold(NOTHING, |[a, b], &[first, last]| [a.min(first), b.max(last)]);
            canvas.fill(
                rows.clone(),
                colour,
                |_| reach,
                |_, spans| {
                    *spans = *layer;
                    reach
                },
            );
        }
    }
    work
}
