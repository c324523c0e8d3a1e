//! The interface of a drawing's viewer: there is one viewer for the plane and one for space.

use crate::facts::Pose;
use crate::surface::{Clock, Screen};
use lsystem::drawing::Origin;
use lsystem::{Style, Vantage, Viewport};
use serde::Serialize;
use ts_rs::TS;

/// The settings of a picture.
#[derive(Clone, PartialEq)]
pub(crate) struct PictureSettings {
    pub(crate) style: Style,
    /// The size of the painted picture; smaller than the canvas on the page if memory does not suffice.
    pub(crate) viewport: Viewport,
    /// Device pixels of the canvas on the page per fitted extent at zoom 1.
    pub(crate) scale: f64,
    pub(crate) vantage: Vantage,
    /// The place on a segment that is the origin of the view in the plane.
    pub(crate) origin: Option<Origin>,
    /// The number of segments shown; `None` for all.
    pub(crate) upto: Option<u128>,
    /// The number of mates that may help with a picture in space.
    pub(crate) mates: u32,
}

/// The picture on the canvas.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
#[ts(rename = "Drawn")]
pub struct CanvasPicture {
    /// Whether no finer picture follows.
    pub complete: bool,
    /// Device pixels per fitted extent at zoom 1.
    pub scale: f64,
    /// Whether the picture is the first one of a new view in space, made fast because the view is probably moving.
    pub moving: bool,
    /// Whether the picture is complete but not exact, because an exact one would take too long.
    pub rough: bool,
    /// Whether the picture is in space and took so long that mates would help.
    pub slow: bool,
    /// The one thing in a complete picture of a single colour.
    pub only: Option<Only>,
    /// The turtle after the last shown segment; null if all segments are shown.
    pub pose: Option<Pose>,
}

/// The one thing in a picture of a single colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "lowercase")]
pub enum Only {
    /// No ink.
    Background,
    /// Ink everywhere.
    Ink,
}

impl Only {
    /// The one thing in a picture; `None` if its pixels (RGBA) have several colours.
    pub(crate) fn of(pixels: &[u8], style: &Style) -> Option<Self> {
        let ([r, g, b, _], rest) = pixels.split_first_chunk()?;
        // Each pixel is compared with the one before.
        let single = *rest == pixels[..rest.len()];
        single.then_some(if [*r, *g, *b] == style.background.rgb { Self::Background } else { Self::Ink })
    }
}

/// Makes the pictures of a drawing in steps.
pub(crate) trait Viewer<S: Screen> {
    /// Starts a picture and cancels the picture in the making.
    fn begin(&mut self, settings: PictureSettings);

    /// Continues the picture. Returns the picture on the canvas if it is new.
    fn paint(&mut self, clock: &Clock, surface: &mut S) -> Result<Option<CanvasPicture>, S::Error>;

    /// Whether the finest picture is on the canvas.
    fn is_done(&self) -> bool;

    /// Whether a coarse picture is on the canvas and a finer one is in the making, so that there is no hurry.
    fn is_refining(&self) -> bool;
}
