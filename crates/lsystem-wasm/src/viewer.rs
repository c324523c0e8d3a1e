//! What shows a drawing: there is one viewer for the plane and one for space.

use crate::clock::Clock;
use crate::plane::PlaneView;
use crate::report::Report;
use crate::solid::SolidView;
use crate::surface::Surface;
use lsystem::derive::{Counter, Tally};
use lsystem::drawing::{Space, describe};
use lsystem::render::Pane;
use lsystem::{Diagnostic, Drawer, Drawing, Limits, Progress, Style, System, View, Viewport};
use serde::Serialize;
use std::sync::Arc;
use wasm_bindgen::JsValue;

/// Work units between two looks at the clock: well under a millisecond each.
pub(crate) const WORK: usize = 16_384;

/// What a picture is to show.
#[derive(Clone, PartialEq)]
pub(crate) struct Scene {
    pub(crate) style: Style,
    /// The picture as it is painted, and as it is shown.
    pub(crate) viewport: Viewport,
    pub(crate) screen: Viewport,
    /// Of a drawing in the plane; one in space is seen from its viewer's camera.
    pub(crate) view: View,
    /// How many segments; all of them without it.
    pub(crate) upto: Option<u128>,
    /// How many mates may help with it, in space.
    pub(crate) mates: u32,
}

/// What is on the canvas.
#[derive(Serialize)]
pub(crate) struct Drawn {
    /// Whether nothing finer follows.
    pub(crate) complete: bool,
    /// Device pixels per fitted extent at zoom 1.
    pub(crate) scale: f64,
    /// Whether things move, so that the next picture is more likely to be of something else than a finer one.
    pub(crate) moving: bool,
    /// Whether not every line is in its place, for good, because that would take too long.
    pub(crate) rough: bool,
    /// Whether it is in space and took so long that mates would help.
    pub(crate) slow: bool,
}

/// Builds a drawing and makes its pictures, both in steps.
pub(crate) trait Viewer {
    /// Starts building the drawing of a generation; the former one is shown until it is there.
    fn start(&mut self, system: &System, n: u32, limits: Limits);

    /// Gives up the drawing that is being built.
    fn stop(&mut self);

    /// Goes on building; nothing while there is more to do.
    fn build(&mut self) -> Option<Result<(), Diagnostic>>;

    /// Shows nothing any more.
    fn forget(&mut self);

    /// Completes a report with what the drawing tells; its segments are exactly as `counted`, once that is known.
    fn describe(&self, report: &mut Report, system: &System, n: u32, counted: Option<&Counter>);

    /// Starts a picture; one that is under way is given up.
    fn begin(&mut self, scene: Scene);

    /// Goes on with the picture; what is on the canvas after that, if anything new is.
    fn paint(&mut self, clock: &Clock, surface: &Surface) -> Result<Option<Drawn>, JsValue>;

    /// Whether nothing finer than what is on the canvas follows.
    fn is_done(&self) -> bool;

    /// Whether a picture has been shown and a finer one of the same is being made, so that there is no hurry.
    fn is_refining(&self) -> bool {
        false
    }

    /// Starts the whole picture for another canvas, or tells why it cannot be made.
    fn snapshot(&self, scene: Scene) -> Result<Box<dyn Snapshot>, &'static str>;
}

/// Why there is no picture.
pub(crate) const NOTHING: &str = "nothing has been drawn yet";

/// A picture for a file, made band by band to save memory, and in steps, so that the worker answers the page meanwhile.
/// The first band is begun already.
pub(crate) trait Snapshot {
    /// Begins the next band; false where there is none.
    fn next(&mut self) -> bool;

    /// Goes on with the band.
    fn step(&mut self) -> Progress;

    /// The pixels of the band, RGBA, the size of the picture, and where the band is in it; `None` where the band has only
    /// been looked at.
    fn band(&self) -> Option<(&[u8], Viewport, Pane)>;
}

/// Goes on with the drawing that is being built; it itself when it is there, or what went wrong.
pub(crate) fn go_on<S: Space>(drawer: &mut Option<Box<Drawer<S>>>) -> Option<Result<Arc<Drawing<S>>, Diagnostic>> {
    if drawer.as_mut()?.step(WORK as u64) == Progress::More {
        return None;
    }
    Some(drawer.take()?.finish().map(Arc::new))
}

/// Where a drawing is.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Realm {
    Plane,
    Space,
}

impl Realm {
    /// Where a system draws.
    pub(crate) fn of(system: &System) -> Self {
        if system.is_solid() { Self::Space } else { Self::Plane }
    }
}

/// The viewers there are.
#[derive(Default)]
pub(crate) struct Views {
    pub(crate) plane: PlaneView,
    pub(crate) solid: SolidView,
}

impl Views {
    /// For small pictures, within [`SMALL`](crate::budget::SMALL).
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

/// Completes a report with what a drawing tells; `bounds` are those of its picture.
pub(crate) fn describe_drawing<S: Space>(
    report: &mut Report,
    system: &System,
    n: u32,
    drawing: &Drawing<S>,
    bounds: Option<[f64; 4]>,
    counted: Option<&Counter>,
) {
    // Where counts depend on chance the drawing is unfolded, and its count is exact.
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
