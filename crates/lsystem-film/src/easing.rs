//! The pace between two keys.

use lsystem_base::named;

/// The pace from one key to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Easing {
    /// At constant speed.
    #[default]
    Linear,
    /// Slow at both ends.
    Smooth,
    /// Slow at the start.
    In,
    /// Slow at the end.
    Out,
    /// The key's value stays until the next key.
    Hold,
}

named!(Easing: Linear "linear", Smooth "smooth", In "in", Out "out", Hold "hold");

impl Easing {
    /// The part of the way that is done after the part `t` of the time; both 0 to 1.
    #[must_use]
    pub fn at(self, t: f64) -> f64 {
        match self {
            Self::Linear => t,
            Self::Smooth => t * t * (3.0 - 2.0 * t),
            Self::In => t * t,
            Self::Out => t * (2.0 - t),
            Self::Hold => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paces_begin_and_end_with_the_keys() {
        for easing in Easing::ALL {
            assert_eq!(Easing::named(easing.name()), Some(easing));
            assert_eq!(easing.at(0.0), 0.0);
            assert!(easing == Easing::Hold || easing.at(1.0) == 1.0);
            let values: Vec<f64> = (0..=100).map(|i| easing.at(f64::from(i) / 100.0)).collect();
            assert!(values.is_sorted(), "{easing:?}");
        }
    }
}
