//! Colours along the path: the position of a node among all segments.

use lsystem_syntax::GRADIENT;
use lsystem_syntax::style::{gradient_step, is_one_step};

/// A part of the path, from the first segment at 0 to the last at 1.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stretch {
    pub from: f64,
    pub size: f64,
}

impl Stretch {
    /// A part of the stretch, given the parts of the stretch that come `before` and that it takes.
    #[inline]
    pub(super) fn part(self, before: f64, size: f64) -> Self {
        Self { from: self.from + self.size * before, size: self.size * size }
    }

    /// Whether the stretch has one colour.
    #[inline]
    pub(super) fn is_short(self) -> bool {
        is_one_step(self.size)
    }

    /// The number of the colour in the middle.
    #[inline]
    pub(super) fn ink(self) -> u32 {
        gradient_step(self.from + 0.5 * self.size)
    }

    /// The mean colour, from the palette's RGB.
    pub(super) fn mean(self, palette: &[[f32; 3]]) -> [f32; 3] {
        let half = 0.5 * self.size.min(1.0 / f64::from(GRADIENT));
        let [first, last] = [self.from + half, self.from + self.size - half].map(gradient_step);
        let inks = palette.get(first as usize..=last as usize).unwrap_or_default();
        let sum = inks.iter().fold([0.0; 3], |sum: [f32; 3], ink| [0, 1, 2].map(|i| sum[i] + ink[i]));
        sum.map(|c| c / inks.len().max(1) as f32)
    }
}
