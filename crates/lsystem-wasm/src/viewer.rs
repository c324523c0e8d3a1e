//! The interface of a drawing's viewer: there is one viewer for the plane and one for space.

use crate::clock::Clock;
use crate::plane::PlaneView;
use crate::report::Report;
use crate::solid::SolidView;
use crate::surface::CanvasSurface;
use lsystem::derive::{Counter, Tally};
use lsystem::drawing::{Space, describe};
use lsystem::render::Pane;
use lsystem::{Diagnostic, Drawer, Drawing, Limits, Progress, Style, System, View, Viewport};
use serde::Serialize;
use std::sync::Arc;
use wasm_bindgen::JsValue;

/// The units of work between two checks of the clock: well under a millisecond.
pub(crate) const WORK: usize = 16_384;

/// The settings of a picture.
#[derive(Clone, PartialEq)]
pub(crate) struct PictureSettings {
    pub(crate) style: Style,
    /// The size of the painted picture; smaller than `screen` if memory does not suffice.
    pub(crate) viewport: Viewport,
    /// The size of the canvas on the page.
    pub(crate) screen: Viewport,
    /// The view of a drawing in the plane; in space the viewer has a camera.
    pub(crate) view: View,
    /// The number of segments shown; `None` for all.
    pub(crate) upto: Option<u128>,
    /// The number of mates that may help with a picture in space.
    pub(crate) mates: u32,
}

/// The picture on the canvas.
#[derive(Serialize)]
pub(crate) struct Drawn {
    /// Whether no finer picture follows.
    pub(crate) complete: bool,
    /// Device pixels per fitted extent at zoom 1.
    pub(crate) scale: f64,
    /// Whether the picture is the first one of a new view in space, made fast because the view is probably moving.
    pub(crate) moving: bool,
    /// Whether the picture is complete but not exact, because an exact one would take too long.
    pub(crate) rough: bool,
    /// Whether the picture is in space and took so long that mates would help.
    pub(crate) slow: bool,
    /// The one thing in view: only complete pictures tell.
    pub(crate) only: Option<Only>,
}

/// The one thing in a picture of a single colour.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Only {
    Background,
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

/// Builds a drawing and makes its pictures, both in steps.
pub(crate) trait Viewer {
    /// Starts building the drawing of a generation. The previous drawing stays until the new one is complete.
    fn start(&mut self, system: &System, n: u32, limits: Limits);

    /// Cancels the drawing that is being built.
    fn stop(&mut self);

    /// Continues building. Returns `None` while there is more to do.
    fn build(&mut self) -> Option<Result<(), Diagnostic>>;

    /// Drops the shown drawing.
    fn forget(&mut self);

    /// Adds the properties of the drawing to a report. `counted` counts the segments exactly.
    fn describe(&self, report: &mut Report, system: &System, n: u32, counted: Option<&Counter>);

    /// Starts a picture and cancels the picture in the making.
    fn begin(&mut self, settings: PictureSettings);

    /// Continues the picture. Returns the picture on the canvas if it is new.
    fn paint(&mut self, clock: &Clock, surface: &CanvasSurface) -> Result<Option<Drawn>, JsValue>;

    /// Whether the finest picture is on the canvas.
    fn is_done(&self) -> bool;

    /// Whether a coarse picture is on the canvas and a finer one is in the making, so that there is no hurry.
    fn is_refining(&self) -> bool {
        false
    }

    /// Starts a picture for another canvas, or returns the reason why it cannot be made.
    fn snapshot(&self, settings: PictureSettings) -> Result<Box<dyn Snapshot>, &'static str>;
}

/// The reason why a canvas has no picture to save.
pub(crate) const NOTHING: &str = "nothing has been drawn yet";

/// A picture for a file. It is made band by band to save memory, and in steps so that the worker can answer the page. A
/// new snapshot has begun its first band.
pub(crate) trait Snapshot {
    /// Begins the next band. Returns false if there is none.
    fn next(&mut self) -> bool;

    /// Continues the band.
    fn step(&mut self) -> Progress;

    /// The pixels of the band (RGBA), the size of the picture, and the place of the band. `None` if this pass over the
    /// band only measures.
    fn band(&self) -> Option<(&[u8], Viewport, Pane)>;
}

/// Continues the drawing that is being built. Returns the drawing or an error at the end.
pub(crate) fn step_drawer<S: Space>(
    drawer: &mut Option<Box<Drawer<S>>>,
) -> Option<Result<Arc<Drawing<S>>, Diagnostic>> {
    if drawer.as_mut()?.step(WORK as u64) == Progress::More {
        return None;
    }
    Some(drawer.take()?.finish().map(Arc::new))
}

/// The space of a drawing.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Realm {
    Plane,
    Space,
}

impl Realm {
    /// The space in which a system draws.
    pub(crate) fn of(system: &System) -> Self {
        if system.is_solid() { Self::Space } else { Self::Plane }
    }
}

/// The viewers of both spaces.
#[derive(Default)]
pub(crate) struct Views {
    pub(crate) plane: PlaneView,
    pub(crate) solid: SolidView,
}

impl Views {
    /// Viewers of small pictures, within [`SMALL`](crate::budget::SMALL).
    pub(crate) fn small() -> Self {
        Self { plane: PlaneView::small(), solid: SolidView::default() }
    }

    pub(crate) fn get(&self, realm: Realm) -> &dyn Viewer {
        match realm {
            Realm::Plane => &self.plane,
            Realm::Space => &self.solid,
        }
    }

    pub(crate) fn at(&mut self, realm: Realm) -> &mut dyn Viewer {
        match realm {
            Realm::Plane => &mut self.plane,
            Realm::Space => &mut self.solid,
        }
    }
}

/// Adds the properties of a drawing to a report; `bounds` as for [`describe`].
pub(crate) fn describe_drawing<S: Space>(
    report: &mut Report,
    system: &System,
    n: u32,
    drawing: &Drawing<S>,
    bounds: Option<[f64; 4]>,
    counted: Option<&Counter>,
) {
    // If the count depends on chance, the drawing is unfolded and has an exact count.
    let exact = || Some(drawing.segment_count()).filter(|&count| count < u128::MAX).map(Tally::from);
    let segments = counted.and_then(Counter::count).cloned().or_else(exact);
    if let Some(symbols) = drawing.symbol_count() {
        report.symbols = Some(symbols.to_string());
    }
    report.memoised = Some(drawing.is_memoised());
    report.blocks = Some(drawing.block_count());
    let shared = drawing.is_memoised().then(|| drawing.block_count());
    if let Some(segments) = segments {
        report.description = describe(system, n, &segments, shared, bounds);
        report.segments = Some(segments.to_string());
    }
}
