//! Families of systems: each makes one by chance. What comes out is judged elsewhere.

mod curve;
mod head;
mod plant;
mod star;
mod tree;

use crate::dice::Dice;
use crate::palette::Palette;
use lsystem_syntax::Definition;

/// A family of systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// A line whose segments are replaced by longer ways (ABOP, section 1.2).
    Curve,
    /// The same around a polygon.
    Island,
    /// Branches in the plane (ABOP, section 1.6).
    Plant,
    /// Plants whose productions chance chooses (ABOP, section 1.7).
    Chance,
    /// Trees in space whose branches become shorter and thinner (ABOP, section 2.1).
    Tree,
    /// Plants around a point.
    Star,
    /// Florets on a spiral (ABOP, section 4.1).
    Head,
}

impl Family {
    /// All families.
    pub const ALL: [Self; 7] =
        [Self::Curve, Self::Island, Self::Plant, Self::Chance, Self::Tree, Self::Star, Self::Head];

    /// Makes a system of the family. Its number of iterations is still to be chosen by its drawings.
    pub(crate) fn make(self, dice: &mut Dice) -> Definition {
        match self {
            Self::Curve => curve::make(dice, false),
            Self::Island => curve::make(dice, true),
            Self::Plant => plant::make(dice, false),
            Self::Chance => plant::make(dice, true),
            Self::Tree => tree::make(dice),
            Self::Star => star::make(dice),
            Self::Head => head::make(dice),
        }
    }

    /// Whether the drawing has an upright, and begins at its foot.
    pub(crate) fn grows(self) -> bool {
        matches!(self, Self::Plant | Self::Chance | Self::Tree)
    }
}

/// Gives a definition these colours.
fn paint(definition: &mut Definition, palette: Palette) {
    definition.style.palette = palette.colours;
    definition.style.background = palette.paper;
}
