//! The images of modules: productions below `draw:`, applied once before drawing (a homomorphism).

use super::choose::{MAX_LOOKS, ModuleInContext, Scratch};
use super::modules::{Chance, Modules, NotFinite};
use super::step::{Fault, Rewriter};
use crate::rules::Rule;

/// The derivation step of images in random choices. It is the same for all generations, so that a module that stays
/// keeps its image.
const STEP: u32 = u32::MAX;

/// The image of one module: the modules that are drawn in its place. Its memory is reused.
#[derive(Clone, Debug, Default)]
pub struct Image {
    modules: Modules,
    scratch: Scratch,
    /// The productions tried and letters made since the last [`Image::take_spent`].
    work: u64,
}

impl Image {
    /// The work since the last call, in units of a [`Meter`](lsystem_base::Meter).
    pub fn take_spent(&mut self) -> u64 {
        core::mem::take(&mut self.work) / 4
    }
}

impl Image {
    /// The modules of the last image.
    pub fn modules(&self) -> &Modules {
        &self.modules
    }
}

impl Rewriter {
    /// The image of the module at `place` of the last whole generation, or the module itself if it has none. The
    /// module's arguments start at `argument`.
    ///
    /// # Errors
    /// If a number is not finite.
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

    /// The production of a module's image; `None` if the module has none.
    pub(super) fn image_rule(&self, place: usize, argument: usize, image: &mut Image) -> Option<usize> {
        let Image { scratch, work, .. } = image;
        self.choose_image(&self.pictured(place, argument), scratch, work).map(|rule| rule.production)
    }

    fn pictured(&self, place: usize, argument: usize) -> ModuleInContext<'_> {
        let Self { plan, word, neighbours, .. } = self;
        let own = argument..argument + usize::from(plan.arities[usize::from(word.letters[place])]);
        let chance = Chance { key: word.key_of(place), seed: plan.seed, step: STEP };
        ModuleInContext { plan, word, neighbours, place, own: &word.arguments[own], chance }
    }

    // Inlined twice, the function would enlarge the page's wasm for no gain in speed.
    #[inline(never)]
    fn choose_image<'a>(&'a self, at: &ModuleInContext<'a>, scratch: &mut Scratch, work: &mut u64) -> Option<&'a Rule> {
        let letter = usize::from(self.word.letters[at.place]);
        scratch.until = *work + MAX_LOOKS;
        at.choose(&self.plan.rules.images[letter], scratch, work)
    }
}
