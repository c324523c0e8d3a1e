//! Whether two pictures have the same ink, whatever the order of their segments, their repeats and their subdivision.

use crate::fit::{Fit, Segment, extent, length};

/// Places, directions and lengths that differ by less are equal, in pictures whose longest side is 1.
const NEAR: f64 = 1e-7;

/// A stretch of ink: the line that carries it, and where it starts and ends along the line.
type Stretch = ([u32; 6], f64, f64);

/// Whether two pictures have the same ink after the centre of each is moved to the origin and its longest side is made
/// 1. Pictures without ink are equal.
///
/// The work grows as m log m in the number of segments.
#[must_use]
pub fn is_same_picture(a: &[Segment], b: &[Segment]) -> bool {
    let (a, b) = (placed(a), placed(b));
    if a.is_empty() || b.is_empty() {
        return a.is_empty() == b.is_empty();
    }
    let (a, b) = stretches(&a, &b);
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 2.0 * NEAR && (a.2 - b.2).abs() < 2.0 * NEAR)
}

/// The segments that are more than points, with the centre of all at the origin and the longest side 1.
fn placed(segments: &[Segment]) -> Vec<Segment> {
    if !extent(segments).as_flattened().iter().all(|value| value.is_finite()) {
        return Vec::new();
    }
    let fit = Fit::whole(segments);
    segments
        .iter()
        .map(|segment| fit.place(segment))
        .filter(|[from, to]| (0..3).any(|axis| (to[axis] - from[axis]).abs() > NEAR))
        .collect()
}

/// The ink of both pictures as disjoint stretches in order. Equal lines have equal numbers in both.
fn stretches(a: &[Segment], b: &[Segment]) -> (Vec<Stretch>, Vec<Stretch>) {
    let lines: Vec<[f64; 8]> = a.iter().chain(b).map(line).collect();
    let mut numbers = vec![[0; 6]; lines.len()];
    let mut order: Vec<usize> = (0..lines.len()).collect();
    for coordinate in 0..6 {
        order.sort_unstable_by(|&i, &j| lines[i][coordinate].total_cmp(&lines[j][coordinate]));
        let (mut number, mut last) = (0, f64::NEG_INFINITY);
        for &i in &order {
            number += u32::from(lines[i][coordinate] - last > NEAR);
            last = lines[i][coordinate];
            numbers[i][coordinate] = number;
        }
    }
    let all: Vec<Stretch> = numbers.into_iter().zip(&lines).map(|(number, line)| (number, line[6], line[7])).collect();
    let (a, b) = all.split_at(a.len());
    (merged(a), merged(b))
}

/// The line that carries a segment, as its direction and its point nearest to the origin, and where the segment starts
/// and ends along it.
fn line(segment: &Segment) -> [f64; 8] {
    let [from, to] = segment;
    let along = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    let length = length(segment);
    // Both ways along a line are the same line.
    let sign = along.into_iter().find(|part| part.abs() > NEAR * length).unwrap_or(1.0).signum();
    let way = along.map(|part| part * sign / length);
    let (start, end) = (dot(*from, way), dot(*to, way));
    let middle = f64::midpoint(start, end);
    let near = [0, 1, 2].map(|axis| f64::midpoint(from[axis], to[axis]) - middle * way[axis]);
    [way[0], way[1], way[2], near[0], near[1], near[2], start.min(end), start.max(end)]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Stretches that touch or overlap become one.
fn merged(stretches: &[Stretch]) -> Vec<Stretch> {
    let mut sorted = stretches.to_vec();
    sorted.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut merged: Vec<Stretch> = Vec::new();
    for stretch in sorted {
        match merged.last_mut() {
            Some(last) if last.0 == stretch.0 && stretch.1 < last.2 + NEAR => last.2 = last.2.max(stretch.2),
            _ => merged.push(stretch),
        }
    }
    merged
}
