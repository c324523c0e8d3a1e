//! Drawings in space.

use super::Drawing;
use super::solid_extent::Extent;
use crate::Solid;

impl Drawing<Solid> {
    /// A box around all segments' axes and polygons, without stroke widths: the least and the greatest coordinates, in
    /// model units. The box is exact to 1e-9 of its size, but may be a little larger if very many shared blocks come
    /// close to a side. `None` if nothing is drawn. Coordinates beyond the range of `f64` are infinite.
    #[must_use]
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        let unit = self.unit();
        let model = |point: [f64; 3]| [0, 1, 2].map(|i| self.start[i] + unit * point[i]);
        let [a, b] = self.extent()?.sides.map(model);
        // A negative step reflects the picture, so that minimum and maximum change places.
        Some([[0, 1, 2].map(|i| a[i].min(b[i])), [0, 1, 2].map(|i| a[i].max(b[i]))])
    }

    /// The root's extent in root units.
    pub fn extent(&self) -> Option<Extent> {
        self.surveyed()
    }
}
