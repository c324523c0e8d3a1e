//! The outlines of a picture as a shape that plants grow in.

use crate::SvgError;
use crate::work::{Kind, Work};
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_base::sorted;
use lsystem_base::words::said;
use lsystem_syntax::MAX_SIDES;

/// The longer side of the shape, in model units.
const SIZE: f64 = 20.0;
/// A corner is left out if the outline moves by at most this much, in model units.
const APART: f64 = 0.02;
/// Coordinates are multiples of this, in model units.
const GRID: f64 = 0.01;
/// The most outlines of a shape: pictures have more, letters and leaves have few.
const MAX_OUTLINES: usize = 16;
/// Outlines with less area than this part of the largest are dust.
const DUST: f64 = 1e-4;
/// The units of work of looking at a corner.
const CORNER: u64 = 10;

type Point = [f64; 2];

/// Polygons, and the names of what was left out.
pub(crate) type Filled = (Vec<Vec<Point>>, Vec<&'static str>);

/// The shape of filled polygons in pixels, y downwards.
///
/// # Errors
/// Why they are no shape.
pub(crate) fn shape(filled: Option<Filled>, work: &mut Work) -> Result<String, SvgError> {
    let (polygons, left_out) =
        filled.ok_or_else(|| SvgError::new(say!("this SVG has lines that are not filled, so it is no outline")))?;
    if !left_out.is_empty() {
        let left_out = left_out.into_iter().map(said).collect::<Vec<_>>().join(", ");
        return Err(SvgError::new(say!("this SVG is more than an outline: it has {}", left_out)));
    }
    let mut outlines: Vec<(f64, Vec<Point>)> = polygons.into_iter().map(|points| (area(&points), points)).collect();
    let largest = outlines.iter().map(|(area, _)| *area).fold(0.0, f64::max);
    outlines.retain(|(area, points)| points.len() >= 3 && *area > DUST * largest && largest < f64::INFINITY);
    if outlines.is_empty() {
        return Err(SvgError::new(say!("this SVG has nothing that is filled")));
    }
    if outlines.len() > MAX_OUTLINES {
        return Err(SvgError::new(say!(
            "this SVG has {} outlines, and a shape has at most {}",
            outlines.len(),
            MAX_OUTLINES
        )));
    }
    sorted::sort_by(&mut outlines, |(a, _), (b, _)| b.total_cmp(a));
    let placed = place(&outlines.into_iter().map(|(_, points)| points).collect::<Vec<_>>());
    let mut text = String::new();
    for (at, points) in placed.iter().enumerate() {
        let corners = simplified(points, work)?;
        if corners.len() > MAX_SIDES {
            return Err(SvgError::new(say!(
                "this outline has {} corners, and an outline has at most {}",
                corners.len(),
                MAX_SIDES
            )));
        }
        if corners.len() < 3 {
            continue;
        }
        work.charge(Kind::Segments, points.len() * at, CORNER)?;
        let around = placed[..at].iter().filter(|outer| is_inside(outer, points[0])).count();
        text += match (text.is_empty(), around % 2) {
            (true, _) => "",
            (_, 0) => " + ",
            _ => " - ",
        };
        let numbers: Vec<String> = corners.as_flattened().iter().map(|&value| number(value)).collect();
        text += &format!("outline({})", numbers.join(", "));
    }
    Ok(text)
}

/// Twice the area of a polygon.
fn area(points: &[Point]) -> f64 {
    let next = points.iter().skip(1).chain(points.first());
    points.iter().zip(next).map(|([a, b], [c, d])| a * d - b * c).sum::<f64>().abs()
}

/// Polygons in model units: y upwards from 0, x around 0.
fn place(outlines: &[Vec<Point>]) -> Vec<Vec<Point>> {
    let all = || outlines.iter().flatten();
    let least = [0, 1].map(|axis| all().map(|at| at[axis]).fold(f64::INFINITY, f64::min));
    let most = [0, 1].map(|axis| all().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max));
    let scale = SIZE / (most[0] - least[0]).max(most[1] - least[1]);
    let of = |[x, y]: Point| [(x - 0.5 * (least[0] + most[0])) * scale, (most[1] - y) * scale];
    outlines.iter().map(|points| points.iter().map(|&at| of(at)).collect()).collect()
}

/// The corners that are left, on the grid, by the method of Ramer (1972) and of Douglas and Peucker (1973).
fn simplified(points: &[Point], work: &mut Work) -> Result<Vec<Point>, SvgError> {
    let mut keep = vec![false; points.len() + 1];
    // The polygon is closed: its first point is its last as well, and the farthest from it is kept.
    let at = |index: usize| points[index % points.len()];
    let far =
        (0..points.len()).max_by(|&a, &b| from(at(a), [at(0); 2]).total_cmp(&from(at(b), [at(0); 2]))).unwrap_or(0);
    keep[0] = true;
    keep[far] = true;
    let mut open = vec![[0, far], [far, points.len()]];
    while let Some([first, last]) = open.pop() {
        work.charge(Kind::Segments, last - first, CORNER)?;
        let off = |index: usize| from(at(index), [at(first), at(last)]);
        let Some(middle) = (first + 1..last).max_by(|&a, &b| off(a).total_cmp(&off(b))) else { continue };
        if off(middle) > APART {
            keep[middle] = true;
            open.extend([[first, middle], [middle, last]]);
        }
    }
    let round = |value: f64| (value / GRID).round() * GRID;
    let kept = points.iter().zip(keep).filter(|(_, keep)| *keep);
    // A multiple of the grid has two digits after the point, and no sign if it is 0.
    let mut corners: Vec<Point> =
        kept.map(|(at, _)| at.map(|value| (round(value) * 100.0).round() / 100.0 + 0.0)).collect();
    corners.dedup();
    if corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    Ok(corners)
}

/// The distance of a point from a straight line between two ends.
fn from([x, y]: Point, [[a, b], [c, d]]: [Point; 2]) -> f64 {
    let (way, off) = ([c - a, d - b], [x - a, y - b]);
    let square = way[0] * way[0] + way[1] * way[1];
    let part = if square > 0.0 { ((off[0] * way[0] + off[1] * way[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(off[0] - part * way[0], off[1] - part * way[1])
}

/// Whether a point is inside a polygon: a ray to the right crosses an odd number of sides.
fn is_inside(points: &[Point], [x, y]: Point) -> bool {
    let next = points.iter().skip(1).chain(points.first());
    let crosses = |([a, b], [c, d]): (&Point, &Point)| (*b > y) != (*d > y) && a + (y - b) / (d - b) * (c - a) > x;
    points.iter().zip(next).filter(|&(from, to)| crosses((from, to))).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use crate::outline_of_svg;

    fn check(content: &str, expected: Result<&str, &str>) {
        let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>{content}</svg>");
        assert_eq!(outline_of_svg(svg.as_bytes()).as_deref().map_err(|error| error.message.as_str()), expected);
    }

    #[test]
    fn outlines_stand_on_the_ground() {
        check("<path d='M10 10 H50 V90 H10 Z'/>", Ok("outline(-5, 20, 5, 20, 5, 0, -5, 0)"));
        check("<polygon points='0,0 40,0 20,10' stroke='red'/>", Ok("outline(-10, 5, 10, 5, 0, 0)"));
        // Points on a straight line are left out.
        check("<path d='M0 0 H10 20 30 40 V20 H0 V15 10 5 Z'/>", Ok("outline(-10, 10, 10, 10, 10, 0, -10, 0)"));
        check(
            "<path d='M0 0H40V40H0Z M10 10H30V30H10Z' transform='scale(2)'/>",
            Ok("outline(-10, 20, 10, 20, 10, 0, -10, 0) - outline(-5, 15, 5, 15, 5, 5, -5, 5)"),
        );
    }

    #[test]
    fn a_clip_path_around_the_page_is_passed_over() {
        let clipped = |rectangle: &str, group: &str| {
            format!(
                "<defs><clipPath id='a'><rect {rectangle}/></clipPath></defs><g clip-path='url(#a)'{group}>\
                 <rect fill='none' width='9' height='9'/><path d='M0 0L10.001 -10L20.003 0L10 10z'/></g>"
            )
        };
        let page = "width='100' height='100'";
        check(&clipped(page, ""), Ok("outline(-10, 10, 0, 20, 10, 10, 0, 0)"));
        check(&clipped("x='-10' y='-20' width='110' height='130'", ""), Ok("outline(-10, 10, 0, 20, 10, 10, 0, 0)"));
        let refused = Err("this SVG is more than an outline: it has clip paths");
        check(&clipped("width='50' height='100'", ""), refused);
        check(&clipped(page, " transform='translate(5 5)'"), refused);
        check(&clipped(&format!("{page} transform='scale(.1)'"), ""), refused);
    }

    #[test]
    fn other_pictures_are_refused() {
        check(
            "<path d='M0 0L5 5 9 0' fill='none' stroke='red'/>",
            Err("this SVG has lines that are not filled, so it is no outline"),
        );
        check("<rect width='9' height='9'/><text>a</text>", Err("this SVG is more than an outline: it has text"));
        check("", Err("this SVG has nothing that is filled"));
        let many = "<rect width='5' height='5'/>".repeat(17);
        check(&many, Err("this SVG has 17 outlines, and a shape has at most 16"));
    }

    #[test]
    fn curves_are_within_the_tolerance() {
        let circle =
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 80 80'><circle cx='40' cy='40' r='30'/></svg>";
        let text = outline_of_svg(circle.as_bytes()).unwrap();
        let numbers: Vec<f64> = text[8..text.len() - 1].split(", ").map(|number| number.parse().unwrap()).collect();
        let corners: Vec<[f64; 2]> = numbers.as_chunks::<2>().0.to_vec();
        assert!((20..80).contains(&corners.len()), "{}", corners.len());
        for (at, [a, b]) in corners.iter().enumerate() {
            let [c, d] = corners[(at + 1) % corners.len()];
            for [x, y] in [[*a, *b], [0.5 * (a + c), 0.5 * (b + d)]] {
                // Half of the grid's diagonal comes on top.
                assert!((libm::hypot(x, y - 10.0) - 10.0).abs() < 0.03, "{x} {y}");
            }
        }
    }
}
