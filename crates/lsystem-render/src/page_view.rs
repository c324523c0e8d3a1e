//! Views and cameras as the page's state has them.

use crate::{Camera, View};
use lsystem_drawing::Origin;
use serde::Deserialize;

/// A [`View`] of the page's state.
#[derive(Clone, Debug, Deserialize)]
pub struct PageView {
    x: f64,
    y: f64,
    zoom: f64,
    #[serde(default)]
    fx: f64,
    #[serde(default)]
    fy: f64,
    /// The origin, as [`Origin::text`] writes it; empty for the fitted centre.
    #[serde(default)]
    at: String,
}

impl PageView {
    /// The place that is the origin; `None` for the fitted centre.
    #[must_use]
    pub fn origin(&self) -> Option<Origin> {
        Origin::read(&self.at)
    }
}

impl From<PageView> for View {
    fn from(PageView { x, y, zoom, fx, fy, .. }: PageView) -> Self {
        Self { x, y, zoom, fine: [fx, fy] }
    }
}

/// A [`Camera`] of the page's state.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct PageCamera {
    azimuth: f64,
    elevation: f64,
    zoom: f64,
    x: f64,
    y: f64,
    z: f64,
    perspective: bool,
    fade: f64,
}

impl From<PageCamera> for Camera {
    fn from(PageCamera { azimuth, elevation, zoom, x, y, z, perspective, fade }: PageCamera) -> Self {
        Self { azimuth, elevation, zoom, target: [x, y, z], perspective, fade, ..Self::default() }
    }
}
