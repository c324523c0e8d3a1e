//! The plan of a picture.

use super::camera::Camera;
use super::quality::Quality;
use crate::{Pane, Pass, Viewport};
use lsystem_syntax::Style;

/// Everything that a picture is asked to show.
pub(super) struct Plan {
    pub(super) style: Style,
    pub(super) viewport: Viewport,
    pub(super) camera: Camera,
    pub(super) quality: Quality,
    /// The part of full light, by channel, in a picture without shadows.
    pub(super) dim: [f32; 3],
    /// If given, only this pane is made.
    pub(super) pane: Option<PlannedPane>,
}

/// A pane of a picture that is made in several.
#[derive(Clone, Copy)]
pub(super) struct PlannedPane {
    pub(super) pane: Pane,
    pub(super) pass: Pass,
    /// The budget that all panes share.
    pub(super) budget: f32,
}
