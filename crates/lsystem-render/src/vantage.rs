//! A place to look from, whatever the space of the drawing.

use crate::{Camera, View};

/// The view of a drawing in the plane and the camera on a drawing in space. A picture uses one of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vantage {
    /// In the plane.
    pub view: View,
    /// In space.
    pub camera: Camera,
}

impl From<View> for Vantage {
    fn from(view: View) -> Self {
        Self { view, ..Self::default() }
    }
}

impl From<Camera> for Vantage {
    fn from(camera: Camera) -> Self {
        Self { camera, ..Self::default() }
    }
}
