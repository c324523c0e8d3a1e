//! Panes of a picture. A picture that would take too much memory is made pane by pane.

use crate::viewport::Viewport;
use lsystem_base::MAX_PICTURE_PIXELS;
use lsystem_syntax::Ink;

/// A rectangle of a picture's pixels, y down from the upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pane {
    /// The left side, in pixels from the left side of the picture.
    pub x: u32,
    /// The upper side, in pixels below the upper side of the picture.
    pub y: u32,
    /// The width in pixels.
    pub width: u32,
    /// The height in pixels.
    pub height: u32,
}

impl Pane {
    /// The pane that is the whole picture.
    #[must_use]
    pub fn whole(viewport: Viewport) -> Self {
        Self { x: 0, y: 0, width: viewport.width, height: viewport.height }
    }

    /// Panes of `[width, height]` pixels that cover the picture, row by row. The last pane of a row or a column may be
    /// smaller.
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

    /// The part of the pane inside the picture.
    pub fn within(self, viewport: Viewport) -> Self {
        let [x, y] = [self.x.min(viewport.width), self.y.min(viewport.height)];
        Self { x, y, width: self.width.min(viewport.width - x), height: self.height.min(viewport.height - y) }
    }

    /// The pane, cut at the bottom to at most [`MAX_PICTURE_PIXELS`].
    pub(crate) fn within_limits(self) -> Self {
        Self { height: self.height.min(MAX_PICTURE_PIXELS / self.width.max(1)), ..self }
    }
}

/// The work on a pane. A large picture is surveyed as a whole first, so that all panes are made in the same way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pass {
    /// All work for a picture of one pane.
    #[default]
    Only,
    /// Finds out how the whole picture can be made. Makes no pixels.
    Survey,
    /// For ink that adds up: counts how many of the pane's pixels have how much ink. The tone depends on all panes.
    /// The pane is the whole picture if the ink only shades.
    Count,
    /// Makes the pixels of the pane.
    Show,
}

impl Pass {
    /// The panes of a picture and their passes, in order; a pane is `size` = \[width, height\] pixels.
    #[must_use]
    pub fn all(ink: Ink, viewport: Viewport, size: [u32; 2]) -> Vec<(Pane, Self)> {
        let panes = Pane::all(viewport, size);
        if panes.len() < 2 {
            return panes.into_iter().map(|pane| (pane, Self::Only)).collect();
        }
        let whole = [Pane::whole(viewport)];
        let counted: &[Pane] = match ink {
            Ink::Solid => &[],
            Ink::Density => &panes,
            Ink::Auto => &whole,
        };
        let round = |panes: &[Pane], pass| panes.iter().map(|&pane| (pane, pass)).collect::<Vec<_>>();
        [round(&whole, Self::Survey), round(counted, Self::Count), round(&panes, Self::Show)].concat()
    }

    /// Whether the pass makes pixels.
    #[must_use]
    pub fn shows(self) -> bool {
        matches!(self, Self::Only | Self::Show)
    }
}
