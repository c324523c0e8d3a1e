//! How much a picture in space may show for the work that it is worth.

use super::Quality;
use crate::Viewport;

/// How often a picture is made again at most, when a budget is too small, and how many times larger the next one is.
const AGAIN: u8 = 4;
const MORE: f32 = 8.0;
/// It is not made again for less than this part more.
const WORTH: f32 = 1.6;

/// What a picture has taken with its budget, or some of its panes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spent {
    /// In units of work.
    pub work: f64,
    /// Whether something had to go without.
    pub poor: bool,
}

impl Spent {
    /// Adds what another pane has taken.
    pub fn add(&mut self, other: Self) {
        self.work += other.work;
        self.poor |= other.poor;
    }
}

/// The budget of a picture, which is made again with a larger one where it was too small.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Contents of nodes that are looked into at most.
    pub(super) budget: f32,
    /// Units of work that the picture is worth.
    pub(super) work: i64,
    /// How often it has been made with too small a budget.
    again: u8,
}

impl Effort {
    /// For a picture's first time.
    #[must_use]
    pub fn new(quality: Quality, viewport: Viewport) -> Self {
        Self { budget: quality.budget(), work: quality.work(viewport), again: 0 }
    }

    /// For a picture that others make panes of, with the budget that they are told.
    #[must_use]
    pub fn with_budget(self, budget: f32) -> Self {
        Self { budget, ..self }
    }

    /// Contents of nodes that are looked into at most.
    #[must_use]
    pub fn budget(&self) -> f32 {
        self.budget
    }

    /// Gives a larger budget where little of the work that the picture is worth was done, though something had to go
    /// without: how much of a budget is needed nobody knows before. Whether it does, and the picture is to be made again.
    pub fn is_too_small(&mut self, spent: Spent) -> bool {
        let missing = self.work as f32 / spent.work.max(1.0) as f32;
        if !spent.poor || self.again == AGAIN || missing < WORTH {
            return false;
        }
        self.budget *= (0.8 * missing).min(MORE);
        self.again += 1;
        true
    }
}
