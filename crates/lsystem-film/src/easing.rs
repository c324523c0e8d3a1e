//! The pace between two keys.

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

impl Easing {
    /// All values, in the order of the page's list.
    pub const ALL: [Self; 5] = [Self::Linear, Self::Smooth, Self::In, Self::Out, Self::Hold];

    /// The names in scripts, in the order of [`Easing::ALL`].
    pub const NAMES: [&str; 5] = ["linear", "smooth", "in", "out", "hold"];

    /// The name in scripts.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// The easing with this name, if any.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|easing| easing.name() == name)
    }

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
