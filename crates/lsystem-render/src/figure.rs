//! Places of a figure, whatever its space.

use crate::plane;
use crate::search::{Pick, Pointer};
use crate::{Camera, Vantage, Viewport, space};
use core::ops::Range;
use lsystem_drawing::Figure;

/// The segment or the polygon near a place of a picture. The search descends as the renderer does, so a pick is right at
/// any magnification at which the picture is. Where many blocks overlap, the search ends with the pointer's visits.
/// Segments and polygons beyond the first 2^128 - 1 are not found.
///
/// In the plane, among the polygons filled there and the segments within a quarter of the tolerance, the last drawn is
/// picked. In space the nearest to the eye is picked, to about that quarter in depth. If there are none, the nearest to
/// the pointer is picked, to a 32nd of the tolerance.
#[must_use]
pub fn pick(figure: &Figure, viewport: Viewport, vantage: &Vantage, pointer: &Pointer) -> Option<Pick> {
    match figure {
        Figure::Plane(drawing) => plane::pick(drawing, viewport, vantage.view, pointer),
        Figure::Space(drawing) => space::pick(drawing, viewport, &vantage.camera, pointer),
    }
}

/// The camera where none is named: the default one, which sees a drawing in space from the azimuth at which it spreads most
/// in the picture. Of eight azimuths the best is chosen, if it is better than the default by a tenth.
#[must_use]
pub fn opening_camera(figure: &Figure) -> Camera {
    match figure {
        Figure::Plane(_) => Camera::default(),
        Figure::Space(drawing) => space::opening_camera(drawing),
    }
}

/// Device pixels in one fitted extent at zoom 1: in the plane the longer side of [`fit`](crate::fit); in space the diameter
/// of a ball around the drawing, on the plane through the camera's target that faces the eye. With this scale a finished
/// picture in the plane can be moved and magnified as the renderer would.
#[must_use]
pub fn fitted_scale(figure: &Figure, viewport: Viewport, vantage: &Vantage) -> f64 {
    match figure {
        Figure::Plane(drawing) => plane::fitted_scale(drawing, viewport),
        Figure::Space(drawing) => space::fitted_scale(drawing, viewport, &vantage.camera),
    }
}

/// The start and the end of the segment `number` (0-based), from the fitted centre, in fitted extents (as in
/// [`fitted_scale`]); `None` after the last segment. In the plane a place is `[x, y, fine_x, fine_y]`: `x + fine_x` right of
/// the centre and `y + fine_y` above it, with the fine part below the precision of `x` and `y`, as in
/// [`View::fine`](crate::View::fine). In space a place has three coordinates, in the directions of the model, as
/// [`Camera::target`](crate::Camera::target).
#[must_use]
pub fn fitted_ends(figure: &Figure, number: u128) -> Option<[Vec<f64>; 2]> {
    match figure {
        Figure::Plane(drawing) => Some(plane::fitted_ends(drawing, number)?.map(Vec::from)),
        Figure::Space(drawing) => Some(space::fitted_ends(drawing, number)?.map(Vec::from)),
    }
}

/// The vertices of the polygon `number` (0-based, in the order in which polygons are opened), each as in
/// [`fitted_ends`]. Each vertex is joined to the next and the last to the first. Empty after the last polygon.
#[must_use]
pub fn fitted_polygon(figure: &Figure, number: u128) -> Vec<Vec<f64>> {
    match figure {
        Figure::Plane(drawing) => plane::fitted_polygon(drawing, number).into_iter().map(Vec::from).collect(),
        Figure::Space(drawing) => space::fitted_polygon(drawing, number).into_iter().map(Vec::from).collect(),
    }
}

/// The places, each as in [`fitted_ends`], of the segments with these numbers (0-based, in drawing order). In the plane
/// the corners, counter-clockwise, of a convex polygon around their axes: one or two corners if the segments point on a
/// point or a line, none without segments. The polygon is the convex hull, unless that has very many corners. Blocks are
/// taken whole, so the time grows with the depth to which blocks are nested, not with the number of segments. In space
/// the ends of a single segment, and nothing for more.
#[must_use]
pub fn fitted_outline(figure: &Figure, segments: Range<u128>) -> Vec<Vec<f64>> {
    match figure {
        Figure::Plane(drawing) => plane::fitted_outline(drawing, segments).into_iter().map(Vec::from).collect(),
        Figure::Space(_) if segments.end.checked_sub(segments.start) == Some(1) => {
            fitted_ends(figure, segments.start).into_iter().flatten().collect()
        }
        Figure::Space(_) => vec![],
    }
}
