//! Drawings of one system with many seeds, as statistics.

use crate::compiled::compiled;
use lsystem_base::Limits;
use lsystem_base::sorted;
use lsystem_drawing::{Drawer, Plane, System};
use lsystem_syntax::{Definition, Diagnostic};
use std::iter::repeat_n;

/// The number of seeds.
const SEEDS: u32 = 400;
/// The limits of each drawing.
const LIMITS: Limits = Limits { symbols: 1 << 18, modules: 1 << 16, segments: 10_000, work: 1 << 15, memory: 8 << 20 };
/// Two samples of the same system are farther apart than this once in a thousand times (Kolmogorov-Smirnov).
const FAR: f64 = 1.95 * core::f64::consts::SQRT_2 / 20.0;

/// Sizes that differ by less than this part of the largest one are equal.
const ROUNDING: f64 = 1e-9;

/// The measures of each drawing: segments, width and height.
const MEASURES: usize = 3;

/// Measures of drawings with one seed each, sorted.
#[derive(Default)]
pub(crate) struct Sample([Vec<f64>; MEASURES]);

/// A sample in the making.
pub(crate) struct Sampling {
    system: System,
    n: u32,
    first: u32,
    sample: Sample,
}

impl Sampling {
    /// `first` is the first of [`SEEDS`] seeds. Samples that are compared must have different seeds.
    ///
    /// # Errors
    /// The errors of the definition.
    pub(crate) fn new(definition: &Definition, first: u32) -> Result<Self, Vec<Diagnostic>> {
        let system = compiled(definition)?;
        Ok(Self { system, n: definition.iterations, first, sample: Sample::default() })
    }

    /// Draws with one more seed, or once if no seed draws anything else. Returns the sample after the last one.
    ///
    /// # Errors
    /// The limit that a drawing exceeds.
    pub(crate) fn step(&mut self) -> Result<Option<Sample>, Diagnostic> {
        let done = self.sample.0[0].len() as u32;
        if done == SEEDS {
            let mut sample = core::mem::take(&mut self.sample);
            sample.0.iter_mut().for_each(|measures| sorted::sort_by(measures, f64::total_cmp));
            return Ok(Some(sample));
        }
        self.system.seed = self.first + done;
        let drawing = Drawer::<Plane>::new(&self.system, self.n, LIMITS).finish()?;
        let [x0, y0, x1, y1] = drawing.bounds().unwrap_or_default();
        let measures = [drawing.segment_count() as f64, x1 - x0, y1 - y0];
        // Without chance, all seeds draw the same.
        let count = if self.system.is_stochastic() { 1 } else { SEEDS as usize };
        self.sample.0.iter_mut().zip(measures).for_each(|(list, measure)| list.extend(repeat_n(measure, count)));
        Ok(None)
    }
}

impl Sample {
    /// The largest distance of the distributions of a measure, from 0 to 1.
    ///
    /// It is 1 if a size is beyond the range of numbers, because such sizes cannot be compared.
    pub(crate) fn distance(&self, other: &Self) -> f64 {
        let all = || self.0.iter().chain(&other.0).flatten();
        if !all().all(|value| value.is_finite()) {
            return 1.0;
        }
        let sizes = self.0[1..].iter().chain(&other.0[1..]).flatten();
        let rounding = sizes.copied().fold(0.0, f64::max) * ROUNDING;
        let distances = self.0.iter().zip(&other.0).zip([0.0, rounding, rounding]);
        distances.map(|((a, b), rounding)| distance(a, b, rounding)).fold(0.0, f64::max)
    }

    /// Whether a distance is what chance alone may bring.
    pub(crate) fn is_near(distance: f64) -> bool {
        distance < FAR
    }
}

/// The largest difference of the parts below any value (Kolmogorov-Smirnov), of sorted lists. Values that differ by less
/// than `rounding` are equal.
fn distance(a: &[f64], b: &[f64], rounding: f64) -> f64 {
    let below = |list: &[f64], value: f64| list.partition_point(|other| *other <= value) as f64 / list.len() as f64;
    let values = a.iter().chain(b).map(|value| value + rounding);
    values.map(|value| (below(a, value) - below(b, value)).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_any_scale_are_compared() {
        let sample = |width: f64| Sample([vec![4.0], vec![width], vec![0.0]]);
        for scale in [1e-9, 1.0, 1e12, 1e300] {
            assert!(Sample::is_near(sample(scale).distance(&sample(scale * (1.0 + 1e-12)))), "{scale}");
            assert!(!Sample::is_near(sample(scale).distance(&sample(scale * 1.5))), "{scale}");
        }
        for unknown in [f64::INFINITY, f64::NAN] {
            assert!(!Sample::is_near(sample(unknown).distance(&sample(unknown))), "{unknown}");
        }
    }
}
