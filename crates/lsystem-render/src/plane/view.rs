//! The part of the drawing that a picture shows.

use super::pen::Pen;
use super::wide::Wide;
use crate::ink::Grid;
use crate::pane::Pane;
use crate::viewport::Viewport;
use lsystem_drawing::{Block, Drawing, Widths};

/// A place and a magnification, relative to the fitted drawing, so that the view stays when the drawing changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The picture's centre, right of the fitted centre, in fitted extents (the longer side of [`fit`]).
    pub x: f64,
    /// The picture's centre, above the fitted centre, in fitted extents.
    pub y: f64,
    /// 1 shows the whole drawing with a margin; 2 shows it twice as large.
    pub zoom: f64,
    /// Added to `x` and `y`: the part of the centre below their precision. The part matters where a single segment of a
    /// drawing 10^19 steps wide fills the picture.
    pub fine: [f64; 2],
}

impl Default for View {
    fn default() -> Self {
        Self { x: 0.0, y: 0.0, zoom: 1.0, fine: [0.0; 2] }
    }
}

/// An upright rectangle, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// The left side.
    pub x: f64,
    /// The lower side.
    pub y: f64,
    /// The width; not negative.
    pub width: f64,
    /// The height; not negative.
    pub height: f64,
}

impl Rect {
    pub(super) fn centre(&self) -> [f64; 2] {
        [self.x + self.width / 2.0, self.y + self.height / 2.0]
    }

    pub(super) fn longer_side(&self) -> f64 {
        self.width.max(self.height)
    }
}

/// The rectangle that the view at zoom 1 shows, without the margin, in model units: the bounds of all strokes' axes. An
/// empty drawing, or one that is only a point, gives a square with sides of one step.
#[must_use]
pub fn fit(drawing: &Drawing) -> Rect {
    let (unit, rect) = root_bounds(drawing);
    let [x, y] = drawing.start;
    Rect { x: x + unit * rect.x, y: y + unit * rect.y, width: unit * rect.width, height: unit * rect.height }
}

/// Device pixels in one fitted extent (the longer side of [`fit`]) at zoom 1. With this scale a finished picture can be
/// moved and magnified as the renderer would.
#[must_use]
pub(crate) fn fitted_scale(drawing: &Drawing, viewport: Viewport) -> f64 {
    PlaneFraming::of_root(drawing).fitted_scale(viewport)
}

/// The bounds of the drawing in units of its root block, never empty, and that unit in model units.
pub(super) fn root_bounds(drawing: &Drawing) -> (f64, Rect) {
    let Some(root) = drawing.root.and_then(|id| drawing.blocks.get(id.0 as usize)) else {
        let unit = if drawing.step.is_normal() { drawing.step.abs() } else { 1.0 };
        return (unit, Rect { x: -0.5, y: -0.5, width: 1.0, height: 1.0 });
    };
    let unit = libm::scalbn(drawing.step, root.exponent);
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for corner in drawing.corners_of(root) {
        for axis in 0..2 {
            low[axis] = low[axis].min(corner[axis]);
            high[axis] = high[axis].max(corner[axis]);
        }
    }
    let rect = Rect { x: low[0], y: low[1], width: high[0] - low[0], height: high[1] - low[1] };
    if rect.longer_side() > 0.0 && rect.longer_side().is_finite() {
        return (unit, rect);
    }
    let [x, y] = if low[0].is_finite() && low[1].is_finite() { low } else { [0.0; 2] };
    let side = libm::scalbn(1.0, -root.exponent);
    (unit, Rect { x: x - side / 2.0, y: y - side / 2.0, width: side, height: side })
}

/// The sizes of strokes in a picture. A sample is a subsample of opaque ink, or the place of one sum of ink that adds
/// up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Measure {
    /// The smallest stroke width, in samples.
    pub hairline: f64,
    /// Samples in one step length.
    pub step: f64,
    /// Samples in one unit of the root block.
    pub scale: f64,
}

/// The largest extent, in subsamples, at which a block is painted as a line.
pub(super) const TINY: f64 = 2.0;

impl Measure {
    /// The width of a stroke, in samples, from its width in step lengths.
    #[inline]
    pub(super) fn width(&self, width: f64) -> f64 {
        (width * self.step).max(self.hairline)
    }

    /// Half the width of a stroke, in samples, from its width in step lengths.
    pub(super) fn radius(&self, width: f64) -> f64 {
        self.width(width) / 2.0
    }

    /// Whether strokes of this radius are wider than hairlines.
    pub(super) fn is_wide(&self, radius: f64) -> bool {
        2.0 * radius > self.hairline
    }

    /// The most that half the width of a block's strokes is, in samples, from the pen at the block's entry.
    pub(super) fn widest(&self, block: &Block, entry: Pen) -> f64 {
        self.radius(entry.widths.widest(block.widest))
    }

    /// The pens of the strokes that stand for a whole block, the last drawn first: the pen of the block's `last` stroke
    /// and, if the block has much wider strokes, a pen as wide as the widest.
    pub(super) fn pens(&self, block: &Block, entry: Pen, last: Pen) -> impl Iterator<Item = Pen> + use<> {
        let last = last.even();
        let pen = Pen { widths: Widths::new(entry.widths.widest(block.widest)), ..last };
        let wider = self.radius(pen.widths.own) > self.radius(last.widths.own) + TINY;
        core::iter::once(last).chain(wider.then_some(pen))
    }
}

/// The least room for a drawing at zoom 1: the bounds of the axes of its strokes, and around them half the width of the
/// widest stroke, so that strokes at the ends stay inside the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlaneFraming {
    /// The centre.
    centre: [f64; 2],
    /// The longer side of the bounds.
    side: f64,
    /// The width and the height of the room.
    room: [f64; 2],
}

impl PlaneFraming {
    /// The framing in model units.
    pub(crate) fn of(drawing: &Drawing) -> Self {
        let (unit, _) = root_bounds(drawing);
        let Self { centre, side, room } = Self::of_root(drawing);
        let [x, y] = drawing.start;
        let start = [x, y].map(|start| start * unit.signum());
        let unit = unit.abs();
        Self {
            centre: [0, 1].map(|axis| start[axis] + unit * centre[axis]),
            side: unit * side,
            room: room.map(|side| unit * side),
        }
    }

    /// The framing in units of the root block.
    pub(super) fn of_root(drawing: &Drawing) -> Self {
        let (_, rect) = root_bounds(drawing);
        let pad = drawing.root.and_then(|id| drawing.blocks.get(id.0 as usize)).map_or(0.0, |root| {
            let widest = root.widest.factor * drawing.width + root.widest.offset;
            libm::scalbn(widest.max(0.0), -root.exponent)
        });
        let pad = if pad.is_finite() { pad } else { 0.0 };
        Self { centre: rect.centre(), side: rect.longer_side(), room: [rect.width + pad, rect.height + pad] }
    }

    /// Pixels in one unit at zoom 1.
    pub(super) fn scale(&self, viewport: Viewport) -> f64 {
        let [width, height] = viewport.usable();
        (width / self.room[0]).min(height / self.room[1])
    }

    /// Pixels in one fitted extent at zoom 1.
    pub(crate) fn fitted_scale(&self, viewport: Viewport) -> f64 {
        self.scale(viewport) * self.side
    }

    /// The view of a drawing with the framing `own` that shows the same part of the plane as `view` of this one.
    pub(crate) fn hold(&self, own: &Self, viewport: Viewport, view: View) -> View {
        let ratio = self.side / own.side;
        let [x, y] = [0, 1].map(|axis| (self.centre[axis] - own.centre[axis]) / own.side);
        View {
            x: x + view.x * ratio,
            y: y + view.y * ratio,
            zoom: view.zoom * self.scale(viewport) / own.scale(viewport),
            fine: view.fine.map(|fine| fine * ratio),
        }
    }
}

/// Maps the root block's frame (y up) to the subsample lattice (y down).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ViewTransform {
    /// The point in the middle of the picture, in units of the root block, y up.
    pub centre: [Wide; 2],
    /// The middle of the picture, in subsamples.
    pub middle: [f64; 2],
    /// Subsamples in one unit of the root block.
    pub scale: f64,
    /// Subsamples in one step length.
    pub step: f64,
}

impl ViewTransform {
    /// The transform of a view, with `samples` subsamples along one side of a pixel.
    pub(super) fn new(drawing: &Drawing, viewport: Viewport, view: View, samples: f64) -> Self {
        let (_, rect) = root_bounds(drawing);
        let exponent = drawing.root.and_then(|id| drawing.blocks.get(id.0 as usize)).map_or(0, |root| root.exponent);
        let (width, height) = (f64::from(viewport.width), f64::from(viewport.height));
        let fitted = PlaneFraming::of_root(drawing).scale(viewport) * samples;
        let zoom = if view.zoom.is_finite() && view.zoom > 0.0 { view.zoom } else { 1.0 };
        let scale = fitted * zoom;
        let side = rect.longer_side();
        let [cx, cy] = rect.centre();
        let along = |centre: f64, offset: f64, fine: f64| {
            let finite = |v: f64| if v.is_finite() { v } else { 0.0 };
            Wide::product(finite(offset), side).plus_wide(Wide::product(finite(fine), side)).plus(centre)
        };
        Self {
            centre: [along(cx, view.x, view.fine[0]), along(cy, view.y, view.fine[1])],
            middle: [width * samples / 2.0, height * samples / 2.0],
            scale,
            step: libm::scalbn(scale, -exponent),
        }
    }

    /// The transform with the origin in the upper left corner of a pane.
    pub(super) fn of_pane(self, pane: Pane, samples: f64) -> Self {
        let [x, y] = [pane.x, pane.y].map(|corner| f64::from(corner) * samples);
        Self { middle: [self.middle[0] - x, self.middle[1] - y], ..self }
    }

    /// The transform with the origin in the upper left corner of a pane's first place of sums.
    pub(super) fn of_grid(self, grid: Grid, pane: Pane) -> Self {
        let transform = self.of_pane(pane, grid.samples());
        Self { middle: transform.middle.map(|middle| middle + f64::from(grid.margin)), ..transform }
    }

    /// The place of a point of the root block's frame, in subsamples.
    pub(super) fn place(&self, at: [Wide; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|axis| at[axis].minus(self.centre[axis]) * self.scale);
        [self.middle[0] + x, self.middle[1] - y]
    }
}
