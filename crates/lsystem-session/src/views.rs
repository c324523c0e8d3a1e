//! The viewers of the plane and of space together.

use crate::plane::PlaneView;
use crate::solid::SolidView;
use crate::surface::Screen;
use crate::viewer::Viewer;
use lsystem::Figure;
use lsystem::render::Closeup;

/// The viewers of both spaces. One of them shows the drawing.
#[derive(Default)]
pub(crate) struct Views {
    plane: PlaneView,
    pub(crate) solid: SolidView,
    is_solid: bool,
}

impl Views {
    /// Viewers of small pictures, within [`SMALL`](crate::budget::SMALL).
    pub(crate) fn small() -> Self {
        Self { plane: PlaneView::small(), ..Self::default() }
    }

    /// Takes the drawing of the next pictures.
    pub(crate) fn load(&mut self, figure: &Figure) {
        self.is_solid = figure.is_solid();
        match figure {
            Figure::Plane(drawing) => {
                self.solid.forget();
                self.plane.load(drawing.clone());
            }
            Figure::Space(drawing) => {
                self.plane.forget();
                self.solid.load(drawing.clone());
            }
        }
    }

    /// The close-up that was shown last, if any.
    pub(crate) fn closeup(&self) -> Option<&Closeup> {
        if self.is_solid { None } else { self.plane.closeup() }
    }

    pub(crate) fn get<S: Screen>(&self) -> &dyn Viewer<S> {
        if self.is_solid { &self.solid } else { &self.plane }
    }

    pub(crate) fn get_mut<S: Screen>(&mut self) -> &mut dyn Viewer<S> {
        if self.is_solid { &mut self.solid } else { &mut self.plane }
    }
}
