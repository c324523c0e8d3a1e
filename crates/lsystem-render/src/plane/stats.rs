//! Counts of the parts of a picture in the plane.

/// Counts of a picture's parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// Blocks looked into.
    pub blocks: u64,
    /// Strokes painted one by one.
    pub strokes: u64,
    /// Tiles painted.
    pub stamps: u64,
    /// Tiles made.
    pub tiles: u64,
    /// Blocks of which only the outline was painted, because the picture took too long. Fine detail is left out if
    /// there are any.
    pub outlines: u64,
    /// Pictures of parts in a bottom-up picture. If there are any, strokes are a little off their places: by some
    /// pixels where many parts are inside each other.
    pub parts: u64,
}

impl RenderStats {
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            blocks: self.blocks + other.blocks,
            strokes: self.strokes + other.strokes,
            stamps: self.stamps + other.stamps,
            tiles: self.tiles + other.tiles,
            outlines: self.outlines + other.outlines,
            parts: self.parts + other.parts,
        }
    }

    /// Whether some strokes are missing or off their places.
    #[must_use]
    pub fn is_rough(&self) -> bool {
        self.outlines + self.parts > 0
    }
}
