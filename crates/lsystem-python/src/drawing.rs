//! Drawings as arrays.

use crate::check_interrupt;
use crate::problem::halted;
use lsystem::drawing::{Drawing, Mark, Space};
use lsystem::syntax::Halt;
use lsystem::{Figure, Style};
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

/// A drawing: a graph of shared blocks, whose segments become arrays when they are asked for.
#[pyclass(frozen, name = "Drawing", module = "lsystem_playground._core")]
pub(crate) struct CoreDrawing {
    pub(crate) figure: Figure,
    pub(crate) style: Style,
}

/// The buffer of an array. Python owns it, so that the array is neither copied nor read-only.
type Buffer<'py> = Bound<'py, PyByteArray>;

#[pymethods]
impl CoreDrawing {
    /// 2 in the plane, 3 in space.
    #[getter]
    fn dimension(&self) -> usize {
        if self.figure.is_solid() { 3 } else { 2 }
    }

    /// The least and the greatest coordinates; `None` if nothing is drawn.
    #[getter]
    fn bounds(&self) -> Option<[Vec<f64>; 2]> {
        self.figure.bounds()
    }

    /// The number of segments, without outlines of shapes; the greatest number stands for itself or any greater one.
    #[getter]
    fn segment_count(&self) -> u128 {
        self.figure.turtle_segments()
    }

    /// The buffers of all arrays, in the order of the fields of [`Arrays`].
    ///
    /// # Errors
    /// An exception if there are more than `most` segments and vertices of polygons.
    fn arrays<'py>(&self, py: Python<'py>, most: u64) -> PyResult<[Buffer<'py>; 8]> {
        let made = py.detach(|| match &self.figure {
            Figure::Plane(drawing) => Arrays::of(drawing, &self.style, most),
            Figure::Space(drawing) => Arrays::of(drawing, &self.style, most),
        });
        let Arrays { ends, widths, colours, indices, levels, vertices, sides, fills } =
            made.map_err(|halt| halted(py, halt))?;
        Ok([ends, widths, colours, indices, levels, vertices, sides, fills].map(|bytes| PyByteArray::new(py, &bytes)))
    }
}

/// The segments and polygons of a drawing, each in drawing order, as the bytes of arrays.
#[derive(Default)]
struct Arrays {
    /// Both ends of each segment, each with all coordinates: `f64`, model units.
    ends: Vec<u8>,
    /// The widths at both ends of each segment: `f64`, model units.
    widths: Vec<u8>,
    /// Red, green and blue of each segment.
    colours: Vec<u8>,
    /// The turtle's colour index of each segment: `i32`.
    indices: Vec<u8>,
    /// The number of open branches of each segment: `u32`.
    levels: Vec<u8>,
    /// The vertices of all polygons: `f64`.
    vertices: Vec<u8>,
    /// The number of vertices of each polygon: `u32`.
    sides: Vec<u8>,
    /// Red, green and blue of each polygon.
    fills: Vec<u8>,
}

impl Arrays {
    /// The number of marks between two looks for an interrupt.
    const SHARE: usize = 1 << 16;

    fn of<S: Space>(drawing: &Drawing<S>, style: &Style, most: u64) -> Result<Self, Halt> {
        drawing.check_size(most)?;
        let mut made = Self::default();
        // At most `most`, which is checked.
        let count = drawing.turtle_segments() as usize;
        made.ends.reserve_exact(count * size_of::<[S::Point; 2]>());
        made.widths.reserve_exact(count * 16);
        made.colours.reserve_exact(count * 3);
        made.indices.reserve_exact(count * 4);
        made.levels.reserve_exact(count * 4);
        for (at, mark) in drawing.marks().enumerate() {
            if at % Self::SHARE == 0 {
                check_interrupt()?;
            }
            match mark {
                // The outlines of shapes, which are last.
                Mark::Segment(..) if made.indices.len() == 4 * count => break,
                Mark::Segment(segment, tint) => {
                    let ends = segment.from.as_ref().iter().chain(segment.to.as_ref());
                    ends.for_each(|value| made.ends.extend_from_slice(&value.to_ne_bytes()));
                    made.widths.extend_from_slice(&segment.width.to_ne_bytes());
                    made.widths.extend_from_slice(&segment.end_width.to_ne_bytes());
                    made.colours.extend_from_slice(&style.colour_of(tint).rgb);
                    made.indices.extend_from_slice(&segment.colour.to_ne_bytes());
                    made.levels.extend_from_slice(&segment.level.to_ne_bytes());
                }
                Mark::Polygon(vertices, tint) => {
                    made.sides.extend_from_slice(&(vertices.len() as u32).to_ne_bytes());
                    let values = vertices.iter().flat_map(AsRef::as_ref);
                    values.for_each(|value| made.vertices.extend_from_slice(&value.to_ne_bytes()));
                    made.fills.extend_from_slice(&style.colour_of(tint).rgb);
                }
            }
        }
        Ok(made)
    }
}
