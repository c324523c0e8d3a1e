//! A system's drawing with its mask, made in steps.

use crate::compiled::compiled;
use crate::fit::{Segment, in_space};
use crate::graph::is_same_graph;
use crate::ink::{Mask, Tracing};
use crate::same::Outline;
use lsystem_drawing::{Drawer, Drawing, Outlook, Projection, Solid, Space};
use lsystem_syntax::{Definition, Diagnostic, Limits, Progress};
use std::sync::Arc;

/// The most segments and vertices of polygons that are compared one by one, and that a view of a drawing in space has.
const MAX_SEGMENTS: u64 = 1_000_000;
/// The limits of a drawing. Beside it, two lists of segments and a picture fit into the memory of the page.
const LIMITS: Limits =
    Limits { symbols: 16 << 20, modules: 2 << 20, segments: u32::MAX as u64, work: 16 << 20, memory: 48 << 20 };

/// A drawing in the plane or in space.
pub(crate) enum Shape {
    Plane(Arc<Drawing>),
    Solid(Box<Drawing<Solid>>),
}

/// A drawing with its mask.
pub(crate) struct Sketch {
    pub(crate) shape: Shape,
    /// The drawing as seen: in the plane, the drawing itself.
    pub(crate) seen: Arc<Drawing>,
    pub(crate) mask: Mask,
}

/// A sketch in the making.
pub(crate) enum Sketching {
    Plane(Box<Drawer>),
    Solid(Box<Drawer<Solid>>),
    Projection(Box<Drawing<Solid>>, Box<Projection>),
    Tracing(Shape, Arc<Drawing>, Box<Tracing>),
}

impl Sketching {
    /// # Errors
    /// The errors of the definition.
    pub(crate) fn new(definition: &Definition) -> Result<Self, Vec<Diagnostic>> {
        // Lines have one width, whatever the style says.
        let mut thin = definition.clone();
        (thin.style.width, thin.style.width_factor) = (0.0, 1.0);
        Self::with_widths(&thin)
    }

    /// As [`Sketching::new`], with the widths of the style.
    ///
    /// # Errors
    /// The errors of the definition.
    pub(crate) fn with_widths(definition: &Definition) -> Result<Self, Vec<Diagnostic>> {
        let system = compiled(definition)?;
        Ok(match system.is_solid() {
            true => Self::Solid(Box::new(Drawer::solid(&system, definition.iterations, LIMITS))),
            false => Self::Plane(Box::new(Drawer::new(&system, definition.iterations, LIMITS))),
        })
    }

    /// Works for about `work` units.
    ///
    /// # Errors
    /// The limit that the drawing exceeds.
    pub(crate) fn step(self, work: u64) -> Result<Result<Sketch, Self>, Diagnostic> {
        Ok(Err(match self {
            Self::Plane(mut drawer) => match drawer.step(work) {
                Progress::More => Self::Plane(drawer),
                Progress::Done => {
                    let drawing = Arc::new(drawer.finish()?);
                    Self::Tracing(Shape::Plane(drawing.clone()), drawing.clone(), Box::new(Tracing::new(drawing)))
                }
            },
            Self::Solid(mut drawer) => match drawer.step(work) {
                Progress::More => Self::Solid(drawer),
                Progress::Done => {
                    let drawing = Box::new(drawer.finish()?);
                    let projection = Projection::new(&drawing, &Outlook::default(), MAX_SEGMENTS)?;
                    Self::Projection(drawing, Box::new(projection))
                }
            },
            Self::Projection(drawing, mut projection) => match projection.step(&drawing, work) {
                Progress::More => Self::Projection(drawing, projection),
                Progress::Done => {
                    let seen = Arc::new(projection.finish(&drawing));
                    Self::Tracing(Shape::Solid(drawing), seen.clone(), Box::new(Tracing::new(seen)))
                }
            },
            Self::Tracing(shape, seen, mut tracing) => match tracing.step(work) {
                Progress::More => Self::Tracing(shape, seen, tracing),
                Progress::Done => return Ok(Ok(Sketch { shape, seen, mask: tracing.finish() })),
            },
        }))
    }

    /// Runs all steps.
    ///
    /// # Errors
    /// As [`Sketching::step`].
    pub(crate) fn finish(mut self) -> Result<Sketch, Diagnostic> {
        loop {
            match self.step(u64::MAX)? {
                Ok(sketch) => return Ok(sketch),
                Err(more) => self = more,
            }
        }
    }
}

impl Shape {
    pub(crate) fn segment_count(&self) -> u128 {
        match self {
            Self::Plane(drawing) => drawing.segment_count(),
            Self::Solid(drawing) => drawing.segment_count(),
        }
    }

    /// Whether the graphs of both are equal, which proves equal pictures.
    pub(crate) fn has_graph_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Plane(own), Self::Plane(other)) => is_same_graph(own, other),
            (Self::Solid(own), Self::Solid(other)) => is_same_graph(own, other),
            _ => false,
        }
    }

    /// The ink; `None` if there is too much to compare its segments one by one, or if they exceed the range of numbers.
    pub(crate) fn outline(&self) -> Option<Outline> {
        let (segments, sides) = self.lists()?;
        Outline::new(&segments, &sides)
    }

    /// Whether the ink is that of an outline; `None` as in [`Shape::outline`].
    pub(crate) fn has_outline(&self, outline: &mut Outline) -> Option<bool> {
        let (segments, sides) = self.lists()?;
        outline.is_of(&segments, &sides)
    }

    /// The segments, and the sides of all polygons.
    pub(crate) fn lists(&self) -> Option<(Vec<Segment>, Vec<Segment>)> {
        match self {
            Self::Plane(drawing) => lists(drawing),
            Self::Solid(drawing) => lists(drawing),
        }
    }
}

fn lists<S: Space>(drawing: &Drawing<S>) -> Option<(Vec<Segment>, Vec<Segment>)> {
    drawing.check_size(MAX_SEGMENTS).ok()?;
    let segments = drawing.segments().map(|segment| [in_space(segment.from), in_space(segment.to)]).collect();
    let mut sides = Vec::new();
    for number in 0..drawing.polygon_count() {
        let (polygon, frame) = drawing.polygon(number)?;
        let corners: Vec<[f64; 3]> = (drawing.vertices_of(polygon).iter())
            .map(|&vertex| {
                let mut point = frame.transform(vertex);
                let unit = drawing.unit();
                point.as_mut().iter_mut().zip(drawing.start.as_ref()).for_each(|(at, start)| *at = start + unit * *at);
                in_space(point)
            })
            .collect();
        sides.extend(corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&from, &to)| [from, to]));
    }
    Some((segments, sides))
}
