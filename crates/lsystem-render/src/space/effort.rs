//! The budget of a picture in space, and the work that the picture should take.

use super::quality::Quality;
use crate::Viewport;

/// The most times that a picture is made again with a larger budget.
const MAX_RETRIES: u8 = 4;
/// The most that a budget grows at a time, as a factor.
const MAX_GROWTH: f32 = 8.0;
/// A picture is made again only if it took less than its work divided by this.
const LEAST_GROWTH: f32 = 1.6;

/// The work of a picture, or of some of its panes, with a budget.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spent {
    /// The units of work.
    pub work: f64,
    /// Whether the budget was too small for some node.
    pub poor: bool,
}

impl Spent {
    /// Adds what another pane took.
    pub fn add(&mut self, other: Self) {
        self.work += other.work;
        self.poor |= other.poor;
    }
}

/// The budget of a picture. A picture whose budget was too small is made again with a larger one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// The most contents of nodes that are looked into.
    pub(super) budget: f32,
    /// The units of work that the picture should take; 0 if the budget is fixed.
    pub(super) work: i64,
    /// How often the budget was too small.
    retries: u8,
}

impl Effort {
    /// The first budget of a picture.
    #[must_use]
    pub fn new(quality: Quality, viewport: Viewport) -> Self {
        Self { budget: quality.budget(), work: quality.work(viewport), retries: 0 }
    }

    /// The same effort with another budget, for panes that share the budget of their picture.
    #[must_use]
    pub fn with_budget(self, budget: f32) -> Self {
        Self { budget, ..self }
    }

    /// The most contents of nodes that are looked into.
    #[must_use]
    pub fn budget(&self) -> f32 {
        self.budget
    }

    /// Grows the budget if the picture took too little of its work though the budget was too small for some node: the
    /// budget that is needed cannot be known before. Returns whether the picture is to be made again.
    pub fn is_too_small(&mut self, spent: Spent) -> bool {
        let missing = self.work as f32 / spent.work.max(1.0) as f32;
        if !spent.poor || self.retries == MAX_RETRIES || missing < LEAST_GROWTH {
            return false;
        }
        self.budget *= (0.8 * missing).min(MAX_GROWTH);
        self.retries += 1;
        true
    }
}
