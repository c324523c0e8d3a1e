//! What the modules of a generation are drawn as: productions below `draw:`, applied once (a homomorphism).

use super::choose::{Place, Scratch};
use super::modules::{Chance, Modules, NotFinite};
use super::step::{Fault, Rewriter};

/// The derivation step that images count as: the same for every generation, so that a module that stays looks the
/// same in the next.
const STEP: u32 = u32::MAX;

/// The modules that one module is drawn as; memory that is used again.
#[derive(Clone, Debug, Default)]
pub struct Image {
    modules: Modules,
    scratch: Scratch,
}

impl Rewriter {
    /// What the module at `place` of the last whole generation, whose arguments start at `argument`, is drawn as: its
    /// image, or itself where it has none.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn image<'a>(&self, place: usize, argument: usize, image: &'a mut Image) -> Result<&'a Modules, Fault> {
        let Self { plan, word, neighbours, .. } = self;
        let Image { modules, scratch } = image;
        modules.clear();
        let letter = usize::from(word.letters[place]);
        let own = argument..argument + usize::from(plan.arities[letter]);
        let chance = Chance { key: word.key_of(place), seed: plan.seed, step: STEP };
        let at = Place { plan, word, neighbours, place, own: &word.arguments[own.clone()], chance };
        match at.choose(&plan.rules.images[letter], scratch, &mut 0) {
            None => modules.keep(word, place..place + 1, own),
            Some(rule) => modules
                .make(&rule.successor, at.slots(rule, scratch), &chance, false)
                .map_err(|NotFinite| Fault::NotFinite(Some(rule.production)))?,
        }
        Ok(modules)
    }
}
