//! The drawing of a system in the space in which it lies, for readers to whom the space makes no difference.

use crate::describe::describe;
use crate::opening::symbol_of_polygon;
use crate::style::StyleChange;
use crate::{Drawer, Drawing, Outlook, Segment, Solid, Space, System};
use lsystem_base::{Limits, Progress};
use lsystem_derive::Tally;
use lsystem_syntax::Diagnostic;
use std::sync::Arc;

/// A drawing in the plane or in space.
#[derive(Clone, Debug)]
pub enum Figure {
    /// Of a system that does not [leave the plane](System::is_solid).
    Plane(Arc<Drawing>),
    /// Of any other system.
    Space(Arc<Drawing<Solid>>),
}

/// Evaluates an expression for the drawing, whatever its space.
macro_rules! either {
    ($figure:expr, $drawing:ident => $value:expr) => {
        match $figure {
            Figure::Plane($drawing) => $value,
            Figure::Space($drawing) => $value,
        }
    };
}

impl Figure {
    /// Draws generation `n` in the space of the system.
    ///
    /// # Errors
    /// As [`draw`](crate::draw).
    pub fn draw(system: &System, n: u32, limits: &Limits) -> Result<Self, Diagnostic> {
        Self::drawer(system, n, *limits).finish()
    }

    /// Prepares to draw generation `n` in the space of the system.
    #[must_use]
    pub fn drawer(system: &System, n: u32, limits: Limits) -> FigureDrawer {
        if system.is_solid() {
            FigureDrawer::Space(Box::new(Drawer::new(system, n, limits)))
        } else {
            FigureDrawer::Plane(Box::new(Drawer::new(system, n, limits)))
        }
    }

    /// Whether the drawing lies in space.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        matches!(self, Self::Space(_))
    }

    /// The turtle's stroke width at the start, in steps, after the limit of widths.
    #[must_use]
    pub fn width(&self) -> f64 {
        either!(self, drawing => drawing.width)
    }

    /// As [`Drawing::segment_count`].
    #[must_use]
    pub fn segment_count(&self) -> u128 {
        either!(self, drawing => drawing.segment_count())
    }

    /// As [`Drawing::turtle_segments`].
    #[must_use]
    pub fn turtle_segments(&self) -> u128 {
        either!(self, drawing => drawing.turtle_segments())
    }

    /// As [`Drawing::polygon_count`].
    #[must_use]
    pub fn polygon_count(&self) -> u128 {
        either!(self, drawing => drawing.polygon_count())
    }

    /// As [`Drawing::symbol_count`].
    #[must_use]
    pub fn symbol_count(&self) -> Option<u64> {
        either!(self, drawing => drawing.symbol_count())
    }

    /// As [`Drawing::check_size`].
    ///
    /// # Errors
    /// As [`Drawing::check_size`].
    pub fn check_size(&self, most: u64) -> Result<(), Diagnostic> {
        either!(self, drawing => drawing.check_size(most))
    }

    /// As [`Drawing::is_memoised`].
    #[must_use]
    pub fn is_memoised(&self) -> bool {
        either!(self, drawing => drawing.is_memoised())
    }

    /// As [`Drawing::block_count`].
    #[must_use]
    pub fn block_count(&self) -> usize {
        either!(self, drawing => drawing.block_count())
    }

    /// As [`Drawing::bytes`].
    #[must_use]
    pub fn bytes(&self) -> u64 {
        either!(self, drawing => drawing.bytes())
    }

    /// The least and the greatest coordinates, as [`Drawing::bounds`]: two of each in the plane, three in space.
    #[must_use]
    pub fn bounds(&self) -> Option<[Vec<f64>; 2]> {
        match self {
            Self::Plane(drawing) => drawing.bounds().map(|[x0, y0, x1, y1]| [vec![x0, y0], vec![x1, y1]]),
            Self::Space(drawing) => drawing.bounds().map(|corners| corners.map(Vec::from)),
        }
    }

    /// As [`Drawing::polygon_style`].
    #[must_use]
    pub fn polygon_style(&self, number: u128) -> Option<StyleChange> {
        either!(self, drawing => drawing.polygon_style(number))
    }

    /// The position (0-based, saturating) of the symbol that opens polygon `number` (0-based, in the order of opening)
    /// in generation `n`, which is drawn here. `None` beyond the last polygon.
    #[must_use]
    pub fn symbol_of_polygon(&self, system: &System, n: u32, number: u128) -> Option<u128> {
        either!(self, drawing => symbol_of_polygon(system, n, drawing, number))
    }

    /// The segments from number `start` (0-based) on, in model units. In the plane the third coordinate is 0.
    pub fn segments_from(&self, start: u128) -> impl Iterator<Item = Segment<Solid>> {
        let (plane, space) = match self {
            Self::Plane(drawing) => (Some(drawing.segments_from(start).map(in_space)), None),
            Self::Space(drawing) => (None, Some(drawing.segments_from(start))),
        };
        plane.into_iter().flatten().chain(space.into_iter().flatten())
    }

    /// The vertices of polygon `number` (0-based, in drawing order), in model units. In the plane the third coordinate
    /// is 0.
    #[must_use]
    pub fn vertices(&self, number: u128) -> Option<Vec<[f64; 3]>> {
        either!(self, drawing => vertices(drawing, number))
    }

    /// The drawing in the plane, or its projection. At most `most` segments and vertices of polygons are projected.
    ///
    /// # Errors
    /// As [`Drawing::seen_from`].
    pub fn seen_from(&self, outlook: &Outlook, most: u64) -> Result<Arc<Drawing>, Diagnostic> {
        match self {
            Self::Plane(drawing) => Ok(drawing.clone()),
            Self::Space(drawing) => drawing.seen_from(outlook, most).map(Arc::new),
        }
    }

    /// The exact number of [turtle's segments](Self::turtle_segments); `None` if it does not fit 128 bits.
    #[must_use]
    pub fn exact_segments(&self) -> Option<Tally> {
        Some(self.turtle_segments()).filter(|_| self.segment_count() < u128::MAX).map(Tally::from)
    }

    /// The text alternative of a picture of generation `n`, which is drawn here: the number of lines (`segments`, exactly),
    /// the proportions as seen from the front, and the number of shared blocks.
    #[must_use]
    pub fn describe(&self, system: &System, n: u32, segments: &Tally) -> String {
        let shared = self.is_memoised().then(|| self.block_count());
        let front = self.bounds().map(|[low, high]| [low[0], low[1], high[0], high[1]]);
        describe(system, n, segments, shared, front)
    }
}

fn in_space(segment: Segment) -> Segment<Solid> {
    let Segment { from: [x0, y0], to: [x1, y1], colour, level, width, end_width } = segment;
    Segment { from: [x0, y0, 0.0], to: [x1, y1, 0.0], colour, level, width, end_width }
}

fn vertices<S: Space>(drawing: &Drawing<S>, number: u128) -> Option<Vec<[f64; 3]>> {
    let (polygon, frame) = drawing.polygon(number)?;
    let unit = drawing.unit();
    let vertices = drawing.vertices_of(polygon).iter().map(|&vertex| {
        let mut model = [0.0; 3];
        let point = frame.transform(vertex);
        for (at, (start, coordinate)) in model.iter_mut().zip(drawing.start.as_ref().iter().zip(point.as_ref())) {
            *at = start + unit * coordinate;
        }
        model
    });
    Some(vertices.collect())
}

/// A [`Figure`] in the making, as [`Drawer`].
#[derive(Clone, Debug)]
pub enum FigureDrawer {
    /// In the plane.
    Plane(Box<Drawer>),
    /// In space.
    Space(Box<Drawer<Solid>>),
}

impl FigureDrawer {
    /// As [`Drawer::step`].
    pub fn step(&mut self, work: u64) -> Progress {
        match self {
            Self::Plane(drawer) => drawer.step(work),
            Self::Space(drawer) => drawer.step(work),
        }
    }

    /// As [`Drawer::spent`].
    #[must_use]
    pub fn spent(&self) -> u64 {
        match self {
            Self::Plane(drawer) => drawer.spent(),
            Self::Space(drawer) => drawer.spent(),
        }
    }

    /// As [`Drawer::bytes`].
    #[must_use]
    pub fn bytes(&self) -> u64 {
        match self {
            Self::Plane(drawer) => drawer.bytes(),
            Self::Space(drawer) => drawer.bytes(),
        }
    }

    /// Runs all steps left and returns the figure.
    ///
    /// # Errors
    /// As [`draw`](crate::draw).
    pub fn finish(self) -> Result<Figure, Diagnostic> {
        Ok(match self {
            Self::Plane(drawer) => Figure::Plane(Arc::new(drawer.finish()?)),
            Self::Space(drawer) => Figure::Space(Arc::new(drawer.finish()?)),
        })
    }
}
