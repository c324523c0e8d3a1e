//! Numbers for pairs of coordinates, so that pairs that differ by rounding errors only have the same number.

use core::hash::BuildHasherDefault;
use lsystem_base::Mixer;
use std::collections::HashMap;

/// Where the cells begin, in parts of a cell. Coordinates of drawings are seldom near a border then.
const BORDER: f64 = 0.377;
/// The part of a cell beyond each border that is searched, too.
const NEAR: f64 = 0.1;

/// Pairs of coordinates, numbered in the order of their arrival. Pairs of the same layer that are nearer than a tenth
/// of a cell have the same number, and pairs that are farther apart than 1.1 cells have different ones.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    size: [f64; 2],
    numbers: HashMap<(u32, i64, i64), u32, BuildHasherDefault<Mixer>>,
}

impl Cells {
    /// No pairs. A cell has this size.
    pub(crate) fn new(size: [f64; 2]) -> Self {
        Self { size, numbers: HashMap::default() }
    }

    /// The number of a pair, and whether the number is new.
    pub(crate) fn number(&mut self, layer: u32, pair: [f64; 2]) -> (u32, bool) {
        let scaled = [0, 1].map(|axis| pair[axis] / self.size[axis] + BORDER);
        let floor = scaled.map(libm::floor);
        let cell = floor.map(|value| value as i64);
        if let Some(&number) = self.numbers.get(&(layer, cell[0], cell[1])) {
            return (number, false);
        }
        let beside = [0, 1].map(|axis| match scaled[axis] - floor[axis] {
            part if part < NEAR => -1,
            part if part > 1.0 - NEAR => 1,
            _ => 0,
        });
        for step in [[beside[0], 0], [0, beside[1]], beside] {
            let other = (layer, cell[0].saturating_add(step[0]), cell[1].saturating_add(step[1]));
            if let Some(&number) = self.numbers.get(&other) {
                return (number, false);
            }
        }
        let number = self.numbers.len() as u32;
        self.numbers.insert((layer, cell[0], cell[1]), number);
        (number, true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_pairs_are_equal_on_both_sides_of_a_border() {
        for at in 0..1000 {
            let mut cells = Cells::new([1e-3; 2]);
            let x = f64::from(at) * 1.37e-6;
            let (first, is_new) = cells.number(0, [x, -x]);
            assert!(is_new);
            assert_eq!(cells.number(0, [x + 0.9e-4, -x - 0.9e-4]), (first, false));
            assert_eq!(cells.number(0, [x - 0.9e-4, -x]), (first, false));
            assert!(cells.number(1, [x, -x]).1);
            assert!(cells.number(0, [x + 1.3e-3, -x]).1);
        }
    }
}
