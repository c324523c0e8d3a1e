//! The division of a pyramid among workers.

use super::TilePlace;

/// One of several equal parts of a pyramid. The tiles below a tile of a middle level belong to the same part, so that a
/// worker looks at few tiles of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileShare {
    part: u32,
    of: u32,
    /// The level at which parts divide.
    level: u32,
}

/// The least number of tiles of the middle level for each part, so that all parts take about the same time.
const TILES_OF_A_PART: u64 = 64;

impl TileShare {
    /// All tiles.
    pub const ALL: Self = Self { part: 0, of: 1, level: 0 };

    /// Part number `part` (0-based) of `of` parts; `None` if there is no such part.
    #[must_use]
    pub fn new(part: u32, of: u32) -> Option<Self> {
        let level = (0..32).find(|level| 1_u64 << (2 * level) >= TILES_OF_A_PART * u64::from(of)).unwrap_or(31);
        (part < of).then_some(if of == 1 { Self::ALL } else { Self { part, of, level } })
    }

    /// Whether a tile is one of the part's.
    #[must_use]
    pub fn has(self, tile: TilePlace) -> bool {
        let TilePlace { x, y, .. } = tile.above(self.level);
        spread(x).wrapping_add(2 * spread(y)) % u64::from(self.of) == u64::from(self.part)
    }

    /// Whether a tile or a tile below is one of the part's.
    #[must_use]
    pub fn leads_on(self, tile: TilePlace) -> bool {
        tile.level < self.level || self.has(tile)
    }
}

/// A number's binary digits with zeros between them (Morton 1966): adjacent tiles get different parts.
fn spread(number: u64) -> u64 {
    (0..32).fold(0, |sum, digit| sum | (number >> digit & 1) << (2 * digit))
}
