//! What the modules of a generation are drawn as: productions below `draw:`, applied once (a homomorphism).

use super::step::{Fault, Modules, NotFinite, Place, Rewriter, Scratch};
use crate::Key;

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
    /// What the module at `place` of the last whole generation is drawn as: its image, or itself where it has none.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn image<'a>(&self, place: usize, image: &'a mut Image) -> Result<&'a Modules, Fault> {
        let Self { plan, word, neighbours, .. } = self;
        let Image { modules, scratch } = image;
        modules.clear();
        let rules = &plan.rules.images[usize::from(word.letters[place])];
        let key = if plan.random { word.key_of(place) } else { Key::root(0) };
        let at = Place { plan, word, neighbours, place, key, step: STEP };
        let rule = if rules.is_empty() { None } else { at.choose(rules, scratch, &mut 0) };
        match rule {
            None => modules.keep(word, place, &plan.rules),
            Some(rule) => {
                for template in &rule.successor {
                    modules
                        .push(template, (key, key), &scratch.slots, (plan.seed, STEP), (true, false))
                        .map_err(|NotFinite| Fault::NotFinite(Some(rule.production)))?;
                }
            }
        }
        Ok(modules)
    }
}
