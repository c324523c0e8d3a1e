//! The polylines of one pen.

use crate::join::Polylines;
use crate::order::Tour;
use crate::page::Point;

/// The lines of one pen.
#[derive(Clone, Debug)]
pub struct Layer {
    /// The colour.
    pub rgb: [u8; 3],
    pub(crate) tour: Tour,
    /// By place in the tour: the point at which a closed polyline starts; 0 for others.
    pub(crate) starts: Vec<u32>,
}

impl Layer {
    /// Point `number` of the polyline at a place in the tour, as it is drawn.
    pub(crate) fn point(&self, polylines: &Polylines, place: usize, number: usize) -> Point {
        let (polyline, is_flipped) = self.tour[place];
        let points = polylines.points_of(polyline as usize);
        let last = points.len() - 1;
        let at = match self.starts[place] as usize {
            0 => number,
            // The first point and the last one of a closed polyline are the same.
            start => (start + number) % last,
        };
        points[if is_flipped { last - at } else { at }]
    }
}
