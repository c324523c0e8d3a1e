//! Random choices keyed by place, not by draw order.
//!
//! Each module has a key for its place in the derivation. A choice is a pure function of the seed, the key and the
//! step. The same seed therefore gives the same plant on every machine, and iteration n + 1 extends the plant of
//! iteration n.

/// The place of a module in a derivation, as 64 mixed bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key(u64);

impl Key {
    /// The key of the axiom's module at `index` (0-based).
    #[must_use]
    pub fn root(index: u64) -> Self {
        Self(mix(0x6c73_7973_7465_6d00, index))
    }

    /// The key of the child at `index` (0-based) that a production made in derivation step `step` (1-based).
    #[must_use]
    pub fn child(self, step: u32, index: u64) -> Self {
        Self(mix(mix(self.0, u64::from(step)), index))
    }

    /// A uniform number in `0.0..1.0` for the choice of a production in `step` (1-based).
    #[must_use]
    pub fn choice(self, seed: u32, step: u32) -> f64 {
        unit(mix(mix(self.0, u64::from(seed) | 1 << 32), u64::from(step)))
    }

    /// A uniform number in `0.0..1.0` for the random number at `place` (0-based) of the production applied in `step`
    /// (1-based; 0 for the axiom).
    #[must_use]
    pub fn number(self, seed: u32, step: u32, place: u16) -> f64 {
        let slot = u64::from(step) | (u64::from(place) + 1) << 32;
        unit(mix(mix(self.0, u64::from(seed) | 1 << 32), slot))
    }

    /// A number from -1 to 1 for the variation of one length or angle of a module: the one at `slot` (0-based). The
    /// number does not depend on the step, so that a module that stays keeps its variation.
    #[must_use]
    pub fn variation(self, seed: u32, varied: Quantity, slot: u32) -> f64 {
        let slot = 1 << 63 | (varied as u64) << 32 | u64::from(slot);
        2.0 * unit(mix(mix(self.0, u64::from(seed) | 1 << 32), slot)) - 1.0
    }
}

/// The quantities that vary from module to module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The angle of a turn.
    Angle,
    /// The length of a step forward.
    Length,
}

/// The top 53 bits as a fraction in `0.0..1.0`.
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// Mixes two 64-bit words into one with two rounds of SplitMix64's finaliser (Steele, Lea and Flood, 2014).
fn mix(a: u64, b: u64) -> u64 {
    finalise(finalise(a.wrapping_add(0x9e37_79b9_7f4a_7c15)) ^ b.wrapping_mul(0xd6e8_feb8_6659_fd93))
}

fn finalise(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_uniform_and_uncorrelated() {
        let n = 100_000;
        let (mut sum, mut product) = (0.0, 0.0);
        for i in 0..n {
            let key = Key::root(0).child(1, i);
            let (a, b) = (key.choice(7, 2), Key::root(0).child(1, i + 1).choice(7, 2));
            sum += a;
            product += (a - 0.5) * (b - 0.5);
        }
        assert!((sum / n as f64 - 0.5).abs() < 0.005);
        assert!((product / n as f64).abs() < 0.002);
    }

    #[test]
    fn every_part_matters() {
        let key = Key::root(0);
        let all = [
            key.choice(0, 1),
            key.choice(1, 1),
            key.choice(0, 2),
            key.child(1, 0).choice(0, 1),
            key.child(2, 0).choice(0, 1),
            key.child(1, 1).choice(0, 1),
            Key::root(1).choice(0, 1),
        ];
        for (i, a) in all.iter().enumerate() {
            assert!((0.0..1.0).contains(a));
            assert!(!all[..i].contains(a));
        }
    }
}
