//! Panes of a picture, which are made one by one where the whole would take too much memory.

use super::Viewport;
use lsystem_syntax::Ink;

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

/// What is done with a pane. A large picture is surveyed as a whole, so that all its panes are made in the same way; only
/// then are they shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pass {
    /// The pane is the only one: all is done for it.
    #[default]
    Only,
    /// Of the whole picture: how it can be made. There are no pixels.
    Survey,
    /// Where ink adds up: how much ink lies at how many of the pane's pixels. The tone depends on all panes.
    Count,
    /// The pixels of the pane.
    Show,
}

impl Pass {
    /// All that is done for a picture in panes of this size, in order.
    #[must_use]
    pub fn all(ink: Ink, viewport: Viewport, size: [u32; 2]) -> Vec<(Pane, Self)> {
        let panes = Pane::all(viewport, size);
        if panes.len() < 2 {
            return panes.into_iter().map(|pane| (pane, Self::Only)).collect();
        }
        let passes: &[Self] = if ink == Ink::Density { &[Self::Count, Self::Show] } else { &[Self::Show] };
        let each = passes.iter().flat_map(|&pass| panes.iter().map(move |&pane| (pane, pass)));
        [(Pane::whole(viewport), Self::Survey)].into_iter().chain(each).collect()
    }

    /// Whether there are pixels after it.
    #[must_use]
    pub fn shows(self) -> bool {
        matches!(self, Self::Only | Self::Show)
    }
}
