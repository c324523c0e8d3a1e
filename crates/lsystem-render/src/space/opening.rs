//! The camera from which a drawing in space is seen at first.

use crate::Camera;
use lsystem_drawing::{Drawing, Solid};

/// The number of azimuths that are compared. Half a circle has all of them: from behind, a drawing spreads as much.
const AZIMUTHS: i32 = 8;
/// The degrees between two of them.
const STEP: f64 = 180.0 / AZIMUTHS as f64;
/// The number of segments that are measured.
const SAMPLES: u128 = 256;
/// Another azimuth than the default must show a spread larger by this factor. Most drawings spread about evenly, and
/// then the default shows some depth.
const GAIN: f64 = 1.1;

/// The default camera, at the azimuth from which the drawing spreads most in the picture: of eight, the one with the
/// greatest standard deviation of places to the side. It is the same for equal drawings, and takes the time of a few
/// hundred searches for a segment.
#[must_use]
pub(crate) fn opening_camera(drawing: &Drawing<Solid>) -> Camera {
    let usual = Camera::default();
    let sides = places(drawing);
    let spread = |azimuth: f64| {
        let (sin, cos) = (libm::sin(azimuth.to_radians()), libm::cos(azimuth.to_radians()));
        let across = sides.iter().map(|[x, z]| x * cos - z * sin);
        let count = sides.len().max(1) as f64;
        let (sum, squares) = across.fold((0.0, 0.0), |(sum, squares), x| (sum + x, squares + x * x));
        libm::sqrt((squares / count - (sum / count) * (sum / count)).max(0.0))
    };
    let least = GAIN * spread(usual.azimuth);
    // The default is in the middle, so that no drawing is turned by more than a quarter.
    let azimuths = (1 - AZIMUTHS / 2..=AZIMUTHS / 2).map(|step| usual.azimuth + f64::from(step) * STEP);
    let best = azimuths.map(|azimuth| (spread(azimuth), azimuth)).filter(|(spread, _)| *spread > least);
    let best = best.fold(None, |best: Option<(f64, f64)>, next| match best {
        Some(best) if best.0 >= next.0 => Some(best),
        _ => Some(next),
    });
    Camera { azimuth: best.map_or(usual.azimuth, |(_, azimuth)| azimuth), ..usual }
}

/// The horizontal coordinates, in units of the root block, of the middles of segments that are evenly spread over the
/// drawing.
fn places(drawing: &Drawing<Solid>) -> Vec<[f64; 2]> {
    let count = drawing.segment_count();
    let samples = SAMPLES.min(count);
    let unit = drawing.unit();
    let mut segments = drawing.segments();
    let mut passed = 0;
    let middle = |sample: u128| {
        let number = (count / samples) * sample + (count % samples) * sample / samples;
        segments.pass(number - passed);
        passed = number + 1;
        let segment = segments.next()?;
        let of = |axis: usize| (0.5 * segment.from[axis] + 0.5 * segment.to[axis] - drawing.start[axis]) / unit;
        let place = [of(0), of(2)];
        place.iter().all(|side| side.is_finite()).then_some(place)
    };
    (0..samples).filter_map(middle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_base::Limits;
    use lsystem_drawing::{Figure, System};
    use lsystem_syntax::{Definition, Dialect};

    fn azimuth(axiom: &str, rules: &str, n: u32) -> f64 {
        let dialect = Dialect::Abop;
        let definition =
            Definition { axiom: axiom.into(), rules: rules.into(), angle: 90.0, dialect, ..Definition::default() };
        match Figure::draw(&System::new(&definition).unwrap(), n, &Limits::default()).unwrap() {
            Figure::Plane(_) => panic!("in the plane"),
            Figure::Space(drawing) => opening_camera(&drawing).azimuth,
        }
    }

    #[test]
    fn flat_drawings_are_seen_from_their_broad_side() {
        // A comb to the left and right of the turtle, which begins upwards: best seen from the front, +z or nearly.
        let comb = azimuth("/(0)A", "A -> F[+FFFF][-FFFF]A", 20);
        assert!([2.5, -20.0].contains(&comb), "{comb}");
        // The same, rolled by a quarter: best seen from the side.
        let turned = azimuth("/(90)A", "A -> F[+FFFF][-FFFF]A", 20);
        assert!([92.5, 70.0, 115.0, -65.0].contains(&turned), "{turned}");
    }

    #[test]
    fn round_and_empty_drawings_keep_the_default() {
        assert_eq!(azimuth("A", "A -> F[+FF][-FF][&FF][^FF]A", 12), Camera::default().azimuth);
        assert_eq!(azimuth("/A", "A -> A", 3), Camera::default().azimuth);
        assert_eq!(azimuth("/F", "F -> FF", 200), Camera::default().azimuth);
    }

    #[test]
    fn huge_drawings_are_measured_like_small_ones() {
        let wide = |n| azimuth("/(90)X", "X -> F[+X][-X]\nF -> FF", n);
        assert_eq!(wide(60), wide(8));
        assert_ne!(wide(60), Camera::default().azimuth);
    }
}
