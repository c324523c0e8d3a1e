//! The page of a photograph: a light quadrilateral on what is darker.

use super::light::Grey;
use crate::picture::threshold;
use crate::projection::Projection;
use lsystem_base::sorted;
use std::ops::RangeInclusive;

/// The longer side of the picture in which a page is sought, in pixels.
const SMALL: usize = 320;
/// A page covers at least this part of the picture, and its corners enclose at most this part more than itself.
const LEAST: f64 = 0.1;
const LOOSE: f64 = 1.06;
/// A side of a page is looked for at this many places, along this part of it.
const PLACES: usize = 200;
const ALONG: f64 = 0.9;
/// The side as it is seen: the places further from the line than the median are left out this often.
const ROUNDS: usize = 4;
/// The margin of a page that is left out, as a part of its side: the shadow of its edge.
const INSET: f64 = 0.012;
/// The sides of usual pages and screens as parts of each other: A4, US Letter, 4:3, 3:2, 16:10, 16:9, and a square.
const USUAL: [f64; 7] = [1.0, 1.294, 1.333, 1.414, 1.5, 1.6, 1.778];
/// The focal length as a part of the picture's longer side where a page does not tell it: a telephone's.
const FOCAL: f64 = 0.9;
const FOCALS: RangeInclusive<f64> = 0.4..=4.0;

/// The page, seen from above, if all of it is in the picture.
pub(super) fn straightened(grey: &Grey) -> Option<Grey> {
    let corners = corners(grey)?;
    let far = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]);
    let [a, b, c, d] = corners;
    let wide = far(a, b).max(far(d, c));
    let ratio = usual(ratio(corners, grey)?);
    let high = wide / ratio;
    if !(wide > 16.0 && high > 16.0 && wide.max(high) < 2.0 * grey.width.max(grey.height) as f64) {
        return None;
    }
    let inner = Projection::moved(INSET, INSET).after(Projection::scaled(1.0 - 2.0 * INSET, 1.0 - 2.0 * INSET));
    let pixels = Projection::scaled(1.0 / wide, 1.0 / high);
    let from = Projection::of_square(corners)?.after(inner).after(pixels);
    Some(seen(grey, from, [wide as usize, high as usize]))
}

/// A picture whose places are those of another one by a projection; white outside.
pub(super) fn seen(grey: &Grey, from: Projection, [width, height]: [usize; 2]) -> Grey {
    let level = |at: usize| {
        let [x, y] = from.place([(at % width) as f64 + 0.5, (at / width) as f64 + 0.5]);
        let is_inside = x >= 0.0 && y >= 0.0 && x <= grey.width as f64 && y <= grey.height as f64;
        if is_inside { (grey.at(x, y) + 0.5) as u8 } else { 255 }
    };
    Grey { levels: (0..width * height).map(level).collect(), width, height }
}

/// The corners of the page: from that at the upper left on, clockwise.
fn corners(grey: &Grey) -> Option<[[f64; 2]; 4]> {
    let by = grey.width.max(grey.height).div_ceil(SMALL).max(1);
    let small = grey.smaller(by);
    if small.width < 16 || small.height < 16 {
        return None;
    }
    let level = threshold(&small.levels);
    let inside = largest(&small, |at| small.levels[at] > level);
    let hull = hull(&small, &inside);
    let mut corners = four(hull)?;
    let all = (small.width * small.height) as f64;
    let (own, covered) = (area(&corners), covered(&small, &inside) as f64);
    if own < all * LEAST || own > covered * LOOSE {
        return None;
    }
    let at_side =
        |[x, y]: [f64; 2]| [x <= 2.0, y <= 2.0, x >= small.width as f64 - 2.0, y >= small.height as f64 - 2.0];
    let is_cut = |at: usize| (0..4).any(|side| at_side(corners[at])[side] && at_side(corners[(at + 1) % 4])[side]);
    if (0..4).any(is_cut) {
        return None;
    }
    corners.iter_mut().flatten().for_each(|at| *at *= by as f64);
    let lines: Vec<Line> =
        (0..4).map(|at| edge(grey, corners[at], corners[(at + 1) % 4], 2.5 * by as f64)).collect::<Option<Vec<_>>>()?;
    let meeting = |at: usize| lines[(at + 3) % 4].meets(&lines[at]);
    let [a, b, c, d] = [meeting(0)?, meeting(1)?, meeting(2)?, meeting(3)?];
    let mut corners = [a, b, c, d];
    let first = (0..4).min_by(|&a, &b| (corners[a][0] + corners[a][1]).total_cmp(&(corners[b][0] + corners[b][1])))?;
    corners.rotate_left(first);
    Some(corners)
}

/// Twice the signed area that three places enclose: positive if they turn clockwise, with the y axis downwards.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn area(corners: &[[f64; 2]]) -> f64 {
    let last = corners.len() - 1;
    let between = |at: usize| {
        let [a, b] = [corners[at], corners[if at == last { 0 } else { at + 1 }]];
        a[0] * b[1] - b[0] * a[1]
    };
    (0..=last).map(between).sum::<f64>().abs() / 2.0
}

/// The largest part of a picture that hangs together.
fn largest(grey: &Grey, is_in: impl Fn(usize) -> bool) -> Vec<bool> {
    let mut parts = vec![0_u32; grey.levels.len()];
    let (mut best, mut most, mut open) = (0, 0, Vec::new());
    for (first, number) in (0..grey.levels.len()).zip(1..) {
        if parts[first] != 0 || !is_in(first) {
            continue;
        }
        let mut count = 0;
        parts[first] = number;
        open.push(first);
        while let Some(at) = open.pop() {
            count += 1;
            let x = at % grey.width;
            let near = [
                (x > 0).then(|| at - 1),
                (x + 1 < grey.width).then_some(at + 1),
                at.checked_sub(grey.width),
                (at + grey.width < grey.levels.len()).then_some(at + grey.width),
            ];
            for next in near.into_iter().flatten() {
                if parts[next] == 0 && is_in(next) {
                    parts[next] = number;
                    open.push(next);
                }
            }
        }
        if count > most {
            (best, most) = (number, count);
        }
    }
    parts.iter().map(|&part| part == best && best != 0).collect()
}

/// The pixels of a part, and those between them in each row: a drawing is no hole of its page.
fn covered(grey: &Grey, inside: &[bool]) -> usize {
    let row = |row: &[bool]| {
        let ends = row.iter().position(|is| *is).zip(row.iter().rposition(|is| *is));
        ends.map_or(0, |(left, right)| right + 1 - left)
    };
    inside.chunks_exact(grey.width).map(row).sum()
}

/// The convex hull of pixels, clockwise with the y axis downwards (Andrew's monotone chain, by rows).
fn hull(grey: &Grey, inside: &[bool]) -> Vec<[f64; 2]> {
    let mut places = Vec::new();
    for y in 0..grey.height {
        let row = &inside[y * grey.width..(y + 1) * grey.width];
        if let (Some(left), Some(right)) = (row.iter().position(|is| *is), row.iter().rposition(|is| *is)) {
            for x in [left, right + 1] {
                places.extend([[x as f64, y as f64], [x as f64, (y + 1) as f64]]);
            }
        }
    }
    sorted::sort_by(&mut places, |a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut hull: Vec<[f64; 2]> = Vec::new();
    let mut chain = |places: &mut dyn Iterator<Item = [f64; 2]>| {
        let first = hull.len();
        for place in places {
            while hull.len() >= first + 2 && turn(hull[hull.len() - 2], hull[hull.len() - 1], place) <= 0.0 {
                hull.pop();
            }
            hull.push(place);
        }
        hull.pop();
    };
    chain(&mut places.iter().copied());
    chain(&mut places.iter().rev().copied());
    hull
}

/// A convex polygon around another one, with four corners: again and again the side is left out that adds the least area
/// where its neighbours are made longer.
fn four(mut hull: Vec<[f64; 2]>) -> Option<[[f64; 2]; 4]> {
    while hull.len() > 4 {
        let count = hull.len();
        let without = |at: usize| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|by| hull[(at + by) % count]);
            let met = Line::through(a, b).meets(&Line::through(d, c))?;
            // The neighbours meet beyond the side.
            let added = turn(b, met, c);
            (added >= 0.0).then_some((added, at, met))
        };
        let (_, at, met) = (0..count).filter_map(without).min_by(|a, b| a.0.total_cmp(&b.0))?;
        hull[(at + 1) % count] = met;
        hull.remove((at + 2) % count);
    }
    hull.try_into().ok()
}

/// The places where `x * normal[0] + y * normal[1]` is `far`.
#[derive(Clone, Copy, Debug)]
struct Line {
    normal: [f64; 2],
    far: f64,
}

impl Line {
    fn through(a: [f64; 2], b: [f64; 2]) -> Self {
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]).max(1e-9);
        let normal = [(a[1] - b[1]) / length, (b[0] - a[0]) / length];
        Self { normal, far: a[0] * normal[0] + a[1] * normal[1] }
    }

    fn off(&self, at: [f64; 2]) -> f64 {
        at[0] * self.normal[0] + at[1] * self.normal[1] - self.far
    }

    fn meets(&self, other: &Self) -> Option<[f64; 2]> {
        let ([a, b], [c, d]) = (self.normal, other.normal);
        let area = a * d - b * c;
        (area.abs() > 1e-6).then(|| [(self.far * d - other.far * b) / area, (a * other.far - c * self.far) / area])
    }

    /// The line nearest to places, by least squares across it.
    fn nearest(places: &[[f64; 2]]) -> Option<Self> {
        let count = places.len() as f64;
        let mean = [0, 1].map(|axis| places.iter().map(|at| at[axis]).sum::<f64>() / count);
        let moment = |a: usize, b: usize| places.iter().map(|at| (at[a] - mean[a]) * (at[b] - mean[b])).sum::<f64>();
        let along = libm::atan2(2.0 * moment(0, 1), moment(0, 0) - moment(1, 1)) / 2.0;
        let (sin, cos) = libm::sincos(along);
        (places.len() > 8).then_some(Self { normal: [-sin, cos], far: mean[1] * cos - mean[0] * sin })
    }
}

/// The side of the page near a line from corner to corner: where the light changes most across it.
fn edge(grey: &Grey, from: [f64; 2], to: [f64; 2], far: f64) -> Option<Line> {
    let about = Line::through(from, to);
    let mut places: Vec<[f64; 2]> = Vec::new();
    for place in 0..PLACES {
        let along = 0.5 + ALONG * ((place as f64 + 0.5) / PLACES as f64 - 0.5);
        let middle = [from[0] + (to[0] - from[0]) * along, from[1] + (to[1] - from[1]) * along];
        let at = |off: f64| [middle[0] + about.normal[0] * off, middle[1] + about.normal[1] * off];
        let level = |off: f64| grey.at(at(off)[0], at(off)[1]);
        let change = |off: f64| level(off + 2.0) + level(off + 1.0) - level(off - 1.0) - level(off - 2.0);
        let steps = (2.0 * far) as i32;
        let offs = (-steps..=steps).map(|step| f64::from(step) / 2.0);
        let (off, most) = offs.map(|off| (off, change(off))).max_by(|a, b| a.1.total_cmp(&b.1))?;
        // Between the steps, by a parabola.
        let (before, after) = (change(off - 0.5), change(off + 0.5));
        let bend = before + after - 2.0 * most;
        let off = off + if bend < 0.0 { 0.25 * (before - after) / bend } else { 0.0 };
        places.push(at(off));
    }
    let mut line = about;
    for _ in 0..ROUNDS {
        let mut offs: Vec<f64> = places.iter().map(|&at| line.off(at).abs()).collect();
        sorted::sort_by(&mut offs, f64::total_cmp);
        let most = 2.0 * offs.get(offs.len() / 2)?.max(0.25);
        let near: Vec<[f64; 2]> = places.iter().copied().filter(|&at| line.off(at).abs() <= most).collect();
        line = Line::nearest(&near)?;
    }
    Some(line)
}

/// The width of a rectangle as a part of its height, from its corners in a photograph whose middle is that of the lens
/// (Zhang and He, "Whiteboard scanning and image enhancement", 2007).
fn ratio(corners: [[f64; 2]; 4], grey: &Grey) -> Option<f64> {
    let middle = [grey.width as f64 / 2.0, grey.height as f64 / 2.0];
    let Projection(m) = Projection::of_square(corners.map(|[x, y]| [x - middle[0], y - middle[1]]))?;
    let [[ax, bx, _], [ay, by, _], [g, h, _]] = m;
    let longer = grey.width.max(grey.height) as f64;
    // The sides are at right angles.
    let square = -(ax * bx + ay * by) / (g * h);
    let own = libm::sqrt(square) / longer;
    let focal = if FOCALS.contains(&own) { own } else { FOCAL } * longer;
    let length = |x: f64, y: f64, far: f64| libm::sqrt((x * x + y * y) / (focal * focal) + far * far);
    let ratio = length(ax, ay, g) / length(bx, by, h);
    ratio.is_finite().then_some(ratio)
}

/// The usual ratio nearest to one, if it is near.
fn usual(ratio: f64) -> f64 {
    let both = USUAL.into_iter().flat_map(|usual| [usual, 1.0 / usual]);
    let off = |usual: &f64| libm::log(usual / ratio).abs();
    let nearest = both.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(ratio);
    if off(&nearest) < 0.05 { nearest } else { ratio }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A light quadrilateral on a dark table, each pixel by the mean of sixteen places.
    fn table(corners: &[[f64; 2]; 4]) -> Grey {
        let (width, height) = (640, 480);
        let is_in = |at: [f64; 2]| (0..4).all(|side| turn(corners[side], corners[(side + 1) % 4], at) > 0.0);
        let level = |at: usize| {
            let place = |sub: usize| {
                let off = |number: usize| (number as f64 + 0.5) / 4.0;
                [(at % width) as f64 + off(sub % 4), (at / width) as f64 + off(sub / 4)]
            };
            let inside = (0..16).filter(|&sub| is_in(place(sub))).count();
            (60 + 150 * inside / 16) as u8
        };
        Grey { levels: (0..width * height).map(level).collect(), width, height }
    }

    #[test]
    fn corners_are_found_where_they_were_drawn() {
        let pages = [
            [[100.0, 60.0], [560.0, 90.0], [520.0, 420.0], [80.0, 400.0]],
            [[60.0, 120.0], [500.0, 40.0], [600.0, 380.0], [120.0, 450.0]],
        ];
        for page in pages {
            let found = corners(&table(&page)).expect("a page");
            for (found, drawn) in found.into_iter().zip(page) {
                let off = libm::hypot(found[0] - drawn[0], found[1] - drawn[1]);
                assert!(off < 0.5, "{found:?} {drawn:?}");
            }
        }
        assert!(corners(&Grey { levels: vec![90; 640 * 480], width: 640, height: 480 }).is_none());
    }

    #[test]
    fn no_pixel_lies_outside_the_hull() {
        let (width, height) = (40, 30);
        let inside: Vec<bool> = (0..width * height).map(|at| (at * at) % 97 == 3 && at % width > 4).collect();
        let grey = Grey { levels: vec![0; width * height], width, height };
        let hull = hull(&grey, &inside);
        let corners: Vec<[f64; 2]> = (0..width * height)
            .filter(|&at| inside[at])
            .flat_map(|at| [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[x, y]| [at % width + x, at / width + y]))
            .map(|at| at.map(|at| at as f64))
            .collect();
        for (at, &a) in hull.iter().enumerate() {
            let b = hull[(at + 1) % hull.len()];
            assert!(corners.contains(&a) && corners.iter().all(|&place| turn(a, b, place) >= 0.0), "{a:?} {b:?}");
        }
    }
}
