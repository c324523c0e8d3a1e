//! Panes of a picture, which can be made one by one, and by several at the same time.

use super::Viewport;

/// A rectangle of a picture's pixels, y down from the upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pane {
    /// Its left side.
    pub x: u32,
    /// Its upper side.
    pub y: u32,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
}

impl Pane {
    /// All of a picture.
    #[must_use]
    pub fn whole(viewport: Viewport) -> Self {
        Self { x: 0, y: 0, width: viewport.width, height: viewport.height }
    }

    /// All of a picture in panes of this size, but for the last of each row and column, row by row.
    #[must_use]
    pub fn all(viewport: Viewport, [width, height]: [u32; 2]) -> Vec<Self> {
        let mut panes = Vec::new();
        let mut next = Self { x: 0, y: 0, width: width.max(1), height: height.max(1) };
        while next.y < viewport.height {
            while next.x < viewport.width {
                panes.push(next.within(viewport));
                next.x = next.x.saturating_add(next.width);
            }
            (next.x, next.y) = (0, next.y.saturating_add(next.height));
        }
        panes
    }

    /// What of it lies in a picture.
    pub fn within(self, viewport: Viewport) -> Self {
        let [x, y] = [self.x.min(viewport.width), self.y.min(viewport.height)];
        Self { x, y, width: self.width.min(viewport.width - x), height: self.height.min(viewport.height - y) }
    }
}
