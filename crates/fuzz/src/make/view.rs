//! Random picture sizes, views and cameras.
use crate::Source;
use lsystem::{Camera, View, Viewport};

/// The size of a picture; seldom large, because large pictures take long.
pub(crate) fn viewport(source: &mut Source<'_>) -> Viewport {
    let ratio = source.usual(10, &[1.0, 2.0, 0.5, 3.0]);
    let side = |source: &mut Source<'_>| source.pick(&[64, 100, 1, 2, 3, 17, 33, 160, 255, 320]);
    let [width, height] = match source.below(64) {
        63 => [1920, 1080],
        62 => [32_768, source.between(1, 4) as u32],
        61 => [source.between(1, 4) as u32, 32_768],
        60 => [source.pick(&[0, 1, 64, u32::MAX]), source.pick(&[0, 1, 2])],
        _ => [side(source), side(source)],
    };
    Viewport { width, height, ratio }
}

/// The view of a picture in the plane.
pub(crate) fn view(source: &mut Source<'_>) -> View {
    if source.once_in(2) {
        return View::default();
    }
    let place = |source: &mut Source<'_>| match source.below(12) {
        0 => source.number(),
        1 => source.pick(&[0.5, -0.5]),
        2..6 => 0.0,
        _ => source.part() - 0.5,
    };
    let zoom = match source.below(10) {
        0 => source.number(),
        1..6 => source.pick(&[1.0, 2.0, 10.0, 0.1, 1.5]),
        // A magnification up to 1e25.
        _ => libm::pow(10.0, source.part() * 25.0),
    };
    let fine = if source.once_in(3) { [source.number(), source.part() * 1e-17] } else { [0.0; 2] };
    View { x: place(source), y: place(source), zoom, fine }
}

/// The camera of a picture in space.
pub(crate) fn camera(source: &mut Source<'_>) -> Camera {
    if source.once_in(3) {
        return Camera::default();
    }
    Camera {
        azimuth: source.usual(10, &[0.0, 25.0, 90.0, 180.0, -360.0]),
        elevation: source.usual(10, &[0.0, 12.0, 90.0, -90.0]),
        zoom: match source.below(4) {
            0 => libm::pow(10.0, source.part() * 25.0),
            _ => source.usual(10, &[1.0, 3.0, 0.2, 50.0]),
        },
        target: [0, 1, 2].map(|_| source.usual(10, &[0.0, 0.0, 0.3, -0.5])),
        perspective: source.once_in(2),
        distance: source.usual(10, &[2.0, 2.0, 0.5, 1e9]),
        fade: source.usual(10, &[0.0, 0.5, 1.0]),
    }
}

/// The number of segments shown; `None` for all.
pub(crate) fn upto(source: &mut Source<'_>) -> Option<u128> {
    match source.below(8) {
        0..5 => None,
        5 => Some(source.between(0, 100) as u128),
        6 => Some(u128::from(source.word())),
        _ => Some(source.pick(&[0, 1, u128::MAX, u128::MAX - 1, 1 << 64])),
    }
}
