//! Segments, as arrays and page by page.

use crate::opened::{LIMITS, OpenSystem, Refusal};
use lsystem_base::LimitName;
use lsystem_drawing::{Figure, SegmentArrays};
use lsystem_syntax::Diagnostic;

/// The most bytes of arrays: as much again is there while JavaScript copies them. The instance holds nothing else.
const ARRAY_BYTES: u64 = 352 << 20;
/// The bytes of a segment's colour and level.
const STYLE_BYTES: u64 = 4 + 2;
/// The bytes of a coordinate.
const COORDINATE: u64 = 4;
/// The segments of a page.
const PAGE: usize = 1 << 12;

/// The segments of a drawing.
pub(crate) struct Drawn {
    /// 2 in the plane, 3 in space.
    pub(crate) dimension: u32,
    /// Of space, `ends` has three coordinates for each end.
    pub(crate) arrays: SegmentArrays,
}

const fn dimension(figure: &Figure) -> u32 {
    match figure {
        Figure::Plane(_) => 2,
        Figure::Space(_) => 3,
    }
}

/// The most segments in arrays.
const fn most(dimension: u32) -> u64 {
    ARRAY_BYTES / (2 * dimension as u64 * COORDINATE + STYLE_BYTES)
}
const _: () = assert!(most(2) == 16 << 20);

fn figure(open: &OpenSystem) -> Result<Figure, Refusal> {
    Figure::draw(&open.system, open.n(), &LIMITS).map_err(|limit| open.exceeds(&limit))
}

pub(crate) fn draw(open: &OpenSystem) -> Result<Drawn, Refusal> {
    let figure = figure(open)?;
    let (dimension, mut arrays) = (dimension(&figure), SegmentArrays::default());
    let (most, count) = (most(dimension), figure.segment_count());
    // Outlines of shapes are no segments of the plant.
    let own = figure.turtle_segments() as usize;
    if count > u128::from(most) {
        return Err(open.exceeds(&Diagnostic::limit(LimitName::Segments, most, None)));
    }
    match &figure {
        Figure::Plane(drawing) => {
            drawing.write_segments(most, &mut arrays).map_err(|limit| open.exceeds(&limit))?;
            arrays.ends.truncate(4 * own);
            arrays.colours.truncate(own);
            arrays.levels.truncate(own);
        }
        Figure::Space(drawing) => {
            arrays.ends.reserve_exact(6 * own);
            arrays.colours.reserve_exact(own);
            arrays.levels.reserve_exact(own);
            for segment in drawing.segments_from(0).take(own) {
                arrays.ends.extend([segment.from, segment.to].as_flattened().iter().map(|&place| place as f32));
                arrays.colours.push(segment.colour);
                arrays.levels.push(u16::try_from(segment.level).unwrap_or(u16::MAX));
            }
        }
    }
    Ok(Drawn { dimension, arrays })
}

/// A reader of segments that never holds all of them.
#[derive(Debug)]
pub(crate) struct SegmentPages {
    figure: Figure,
    at: u128,
}

impl SegmentPages {
    pub(crate) fn new(open: &OpenSystem) -> Result<Self, Refusal> {
        Ok(Self { figure: figure(open)?, at: 0 })
    }

    pub(crate) fn dimension(&self) -> u32 {
        dimension(&self.figure)
    }

    /// Eight numbers for each of the next segments: three coordinates of each end, the colour, the level. Empty at the
    /// end.
    pub(crate) fn next_page(&mut self) -> Vec<f64> {
        let mut numbers = Vec::with_capacity(8 * PAGE);
        let left = self.figure.turtle_segments().saturating_sub(self.at).min(PAGE as u128);
        for segment in self.figure.segments_from(self.at).take(left as usize) {
            numbers.extend(segment.from);
            numbers.extend(segment.to);
            numbers.extend([f64::from(segment.colour), f64::from(segment.level)]);
        }
        self.at = self.at.saturating_add((numbers.len() / 8) as u128);
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(json: &str) -> OpenSystem {
        OpenSystem::read(json, None).unwrap()
    }

    #[test]
    fn outlines_of_shapes_are_no_segments() {
        let rules = r#""?P(x,y) < A : inside(s, x, y) -> F?P(0,0)A""#;
        for (shape, axiom) in [("ball(0, 0, 0, 2)", "?P(0,0)A"), ("box(-1, -1, -1, 1, 3, 1)", "/?P(0,0)A")] {
            let json = format!(r#"{{"axiom": "{axiom}", "rules": ["shape s = {shape}", {rules}], "iterations": 2}}"#);
            let open = open(&json);
            let whole = figure(&open).unwrap();
            assert_eq!((whole.turtle_segments(), whole.segment_count() > 10), (2, true), "{shape}");
            let drawn = draw(&open).unwrap();
            let ends = 2 * drawn.dimension as usize;
            assert_eq!(
                (drawn.arrays.ends.len() / ends, drawn.arrays.colours.len(), drawn.arrays.levels.len()),
                (2, 2, 2)
            );
            let mut pages = SegmentPages::new(&open).unwrap();
            assert_eq!([pages.next_page().len(), pages.next_page().len()], [16, 0]);
            assert_eq!(crate::strings::count(&open).unwrap()[1], "2");
        }
    }

    #[test]
    fn the_plane_has_two_coordinates_and_space_three() {
        let flat =
            draw(&open(r#"{"axiom": "f+[f]-f", "dialect": "lowercase", "angle": 90, "iterations": 0}"#)).unwrap();
        assert_eq!(flat.dimension, 2);
        assert_eq!(flat.arrays.ends, [0.0, 0.0, 0.0, 1.0, 0.0, 1.0, -1.0, 1.0, 0.0, 1.0, 0.0, 2.0]);
        assert_eq!((flat.arrays.colours, flat.arrays.levels), (vec![0, 1, 2], vec![0, 1, 0]));
        // Pitched down by a quarter turn, the turtle leaves the plane.
        let bent = draw(&open(r#"{"axiom": "F[&F]", "angle": 90, "iterations": 0}"#)).unwrap();
        assert_eq!((bent.dimension, bent.arrays.ends.len()), (3, 12));
        assert_eq!(bent.arrays.ends[..9], [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
        assert_eq!(bent.arrays.ends[9..11], [0.0, 1.0]);
        assert_eq!(bent.arrays.ends[11].abs(), 1.0);
        assert_eq!(bent.arrays.levels, [0, 1]);
    }

    #[test]
    fn pages_together_are_the_arrays() {
        for turn in ["+", "&"] {
            let open = open(&format!(
                r#"{{"axiom": "F", "rules": "F -> F[{turn}F]F[{turn}F]", "angle": 25, "iterations": 7}}"#
            ));
            let (drawn, mut pages) = (draw(&open).unwrap(), SegmentPages::new(&open).unwrap());
            let mut numbers = vec![];
            loop {
                let page = pages.next_page();
                if page.is_empty() {
                    break;
                }
                numbers.extend(page);
            }
            assert_eq!((pages.dimension(), numbers.len()), (drawn.dimension, 8 * drawn.arrays.levels.len()));
            let dimension = drawn.dimension as usize;
            for (number, segment) in numbers.chunks(8).enumerate() {
                let ends = &drawn.arrays.ends[2 * dimension * number..2 * dimension * (number + 1)];
                let paged = segment[..dimension].iter().chain(&segment[3..3 + dimension]);
                assert!(ends.iter().zip(paged).all(|(&a, &b)| (f64::from(a) - b).abs() < 1e-3), "{number}");
                assert_eq!(
                    segment[6..],
                    [f64::from(drawn.arrays.colours[number]), f64::from(drawn.arrays.levels[number])]
                );
            }
        }
    }

    #[test]
    fn too_many_segments_are_refused() {
        for turn in ["+", "&"] {
            let json = format!(r#"{{"axiom": "F", "rules": "F -> F{turn}F", "angle": 20, "iterations": 30}}"#);
            assert!(draw(&open(&json)).err().unwrap().message.contains("segments"), "{turn}");
            assert_eq!(SegmentPages::new(&open(&json)).unwrap().next_page().len(), 8 * PAGE);
        }
    }
}
