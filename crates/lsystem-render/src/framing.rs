//! The place and the size of a fitted drawing, for pictures in which another drawing takes its place.

use crate::plane::PlaneFraming;
use crate::space::SpaceFraming;
use crate::{Vantage, Viewport};
use lsystem_drawing::Figure;

/// The place and the size of a drawing in the coordinates of its turtle. A picture of a growing plant with the framing
/// of the grown one shows the plant grow from the ground, where a fitted picture would shrink its beginnings.
#[derive(Clone, Debug, PartialEq)]
pub struct Framing(Space);

#[derive(Clone, Debug, PartialEq)]
enum Space {
    Plane(PlaneFraming),
    Space(SpaceFraming),
}

impl Framing {
    /// The framing of a figure.
    #[must_use]
    pub fn of(figure: &Figure) -> Self {
        Self(match figure {
            Figure::Plane(drawing) => Space::Plane(PlaneFraming::of(drawing)),
            Figure::Space(drawing) => Space::Space(SpaceFraming::of(drawing)),
        })
    }

    /// The vantage that shows `figure` where and as large as `vantage` shows the drawing of this framing. A figure in the
    /// other space is fitted.
    #[must_use]
    pub fn hold(&self, figure: &Figure, viewport: Viewport, vantage: &Vantage) -> Vantage {
        let Self(own) = Self::of(figure);
        match (&self.0, &own) {
            (held, own) if held == own => *vantage,
            (Space::Plane(held), Space::Plane(own)) => {
                Vantage { view: held.hold(own, viewport, vantage.view), ..*vantage }
            }
            (Space::Space(held), Space::Space(own)) => {
                Vantage { camera: held.hold(own, viewport, &vantage.camera), ..*vantage }
            }
            _ => *vantage,
        }
    }

    /// As [`fitted_scale`](crate::fitted_scale), of the drawing of this framing.
    #[must_use]
    pub fn fitted_scale(&self, viewport: Viewport, vantage: &Vantage) -> f64 {
        match &self.0 {
            Space::Plane(framing) => framing.fitted_scale(viewport),
            Space::Space(framing) => framing.fitted_scale(viewport, &vantage.camera),
        }
    }
}
