//! A track: the values of a subject at certain times, and between them.

use crate::view;
use crate::{Easing, Subject};
use lsystem_render::View;

/// A value at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframe {
    /// Seconds from the start of the film.
    pub time: f64,
    /// The value: as many numbers as the subject has.
    pub value: Vec<f64>,
    /// The pace to the next key.
    pub easing: Easing,
}

/// A subject, and its values in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The changing number.
    pub subject: Subject,
    /// The keys, at ascending times; at least one. The first value holds before the first key, and the last value after
    /// the last key.
    pub keys: Vec<Keyframe>,
}

impl Track {
    /// The value at a time, in seconds.
    #[must_use]
    pub fn at(&self, time: f64) -> Vec<f64> {
        let next = self.keys.partition_point(|key| key.time <= time);
        let (before, after) = (next.checked_sub(1).and_then(|at| self.keys.get(at)), self.keys.get(next));
        let (from, to) = match (before, after) {
            (Some(from), Some(to)) => (from, to),
            (Some(only), None) | (None, Some(only)) => return only.value.clone(),
            (None, None) => return Vec::new(),
        };
        let part = from.easing.at((time - from.time) / (to.time - from.time));
        let mut value = match self.subject {
            Subject::View => view::between(view_of(&from.value), view_of(&to.value), part),
            Subject::Camera => camera_between(&from.value, &to.value, part),
            _ => from.value.iter().zip(&to.value).map(|(&from, &to)| mix(from, to, part)).collect(),
        };
        if self.subject.is_whole() {
            value.iter_mut().for_each(|number| *number = libm::floor(*number));
        }
        value
    }
}

/// `from` at 0, `to` at 1.
pub(crate) fn mix(from: f64, to: f64, part: f64) -> f64 {
    // A difference of two numbers may be infinite, a sum of their parts is not.
    from * (1.0 - part) + to * part
}

/// The view of a key.
pub(crate) fn view_of(value: &[f64]) -> View {
    let number = |at: usize, usual: f64| value.get(at).copied().unwrap_or(usual);
    View { x: number(0, 0.0), y: number(1, 0.0), zoom: number(2, 1.0), fine: [number(3, 0.0), number(4, 0.0)] }
}

/// Between two cameras, with as many numbers as both have.
fn camera_between(from: &[f64], to: &[f64], part: f64) -> Vec<f64> {
    const ZOOM: usize = 2;
    let between = |(at, (&from, &to))| if at == ZOOM { view::mix_zoom(from, to, part) } else { mix(from, to, part) };
    from.iter().zip(to).enumerate().map(between).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(name: &str, keys: &[(f64, f64, Easing)]) -> Track {
        let key = |&(time, value, easing): &(f64, f64, Easing)| Keyframe { time, value: vec![value], easing };
        Track { subject: Subject::named(name).unwrap(), keys: keys.iter().map(key).collect() }
    }

    #[test]
    fn values_are_those_of_the_keys_and_between_them() {
        let angle = track("angle", &[(1.0, 20.0, Easing::Linear), (3.0, 30.0, Easing::Hold), (5.0, 0.0, Easing::In)]);
        let at = |time| angle.at(time)[0];
        assert_eq!([0.0, 1.0, 2.0, 3.0, 4.9, 5.0, 9.0].map(at), [20.0, 20.0, 25.0, 30.0, 30.0, 0.0, 0.0]);
        let seed = track("seed", &[(0.0, 1.0, Easing::Linear), (3.0, 4.0, Easing::Linear)]);
        assert_eq!([0.0, 0.5, 1.5, 2.9, 3.0].map(|time| seed.at(time)[0]), [1.0, 1.0, 2.0, 3.0, 4.0]);
        let wide = track("angle", &[(0.0, -f64::MAX, Easing::Linear), (2.0, f64::MAX, Easing::Linear)]);
        assert_eq!(wide.at(1.0), [0.0]);
    }

    #[test]
    fn cameras_zoom_by_factors() {
        let keys = [(0.0, [0.0, 10.0, 1.0]), (2.0, [360.0, 10.0, 100.0])];
        let key = |&(time, value): &(f64, [f64; 3])| Keyframe { time, value: value.to_vec(), easing: Easing::Linear };
        let camera = Track { subject: Subject::Camera, keys: keys.iter().map(key).collect() };
        assert_eq!(camera.at(1.0), [180.0, 10.0, 10.0]);
    }
}
