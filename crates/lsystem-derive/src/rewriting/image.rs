//! What the modules of a generation are drawn as: productions below `draw:`, applied once (a homomorphism).

use super::choose::{MOST_LOOKS, Place, Scratch};
use super::modules::{Chance, Modules, NotFinite};
use super::step::{Fault, Rewriter};
use crate::rules::Rule;

/// The derivation step that images count as: the same for every generation, so that a module that stays looks the
/// same in the next.
const STEP: u32 = u32::MAX;

/// The modules that one module is drawn as; memory that is used again.
#[derive(Clone, Debug, Default)]
pub struct Image {
    modules: Modules,
    scratch: Scratch,
    /// The productions looked at, and letters made, since somebody asked.
    work: u64,
}

impl Image {
    /// What has been done since the last call, in units of a [`Meter`](lsystem_syntax::Meter).
    pub fn take_spent(&mut self) -> u64 {
        core::mem::take(&mut self.work) / 4
    }
}

impl Image {
    /// The modules that were asked for last.
    pub fn modules(&self) -> &Modules {
        &self.modules
    }
}

impl Rewriter {
    /// What the module at `place` of the last whole generation, whose arguments start at `argument`, is drawn as: its
    /// image, or itself where it has none.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn image<'a>(&self, place: usize, argument: usize, image: &'a mut Image) -> Result<&'a Modules, Fault> {
        let Image { modules, scratch, work } = image;
        modules.clear();
        let at = self.pictured(place, argument);
        match self.choose_image(&at, scratch, work) {
            None => modules.keep(&self.word, place..place + 1, argument..argument + at.own.len()),
            Some(rule) => {
                *work += 4 * self.plan.costs[rule.production];
                modules
                    .make(&rule.successor, at.slots(rule, scratch), &at.chance, false)
                    .map_err(|NotFinite| Fault::NotFinite(Some(rule.production)))?;
            }
        }
        Ok(modules)
    }

    /// The production of its image, where it has one.
    pub(super) fn image_rule(&self, place: usize, argument: usize, image: &mut Image) -> Option<usize> {
        let Image { scratch, work, .. } = image;
        self.choose_image(&self.pictured(place, argument), scratch, work).map(|rule| rule.production)
    }

    fn pictured(&self, place: usize, argument: usize) -> Place<'_> {
        let Self { plan, word, neighbours, .. } = self;
        let own = argument..argument + usize::from(plan.arities[usize::from(word.letters[place])]);
        let chance = Chance { key: word.key_of(place), seed: plan.seed, step: STEP };
        Place { plan, word, neighbours, place, own: &word.arguments[own], chance }
    }

    // Twice it would be a part of what the page loads for nothing.
    #[inline(never)]
    fn choose_image<'a>(&'a self, at: &Place<'a>, scratch: &mut Scratch, work: &mut u64) -> Option<&'a Rule> {
        let letter = usize::from(self.word.letters[at.place]);
        scratch.until = *work + MOST_LOOKS;
        at.choose(&self.plan.rules.images[letter], scratch, work)
    }
}
