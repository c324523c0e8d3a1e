//! A system's drawing with its mask, made in steps.

use crate::compiled::compiled;
use crate::fit::Ends;
use crate::graph::is_same_graph;

use crate::same::Outline;
use lsystem_base::{Limits, Progress};
use lsystem_derive::Tally;
use lsystem_drawing::{Drawing, Figure, FigureDrawer, Outlook, Projection, Solid};
use lsystem_render::mask::{Mask, Tracing};
use lsystem_syntax::{Definition, Diagnostic};
use std::sync::Arc;

/// The most segments and vertices of polygons that are compared one by one, and that a view of a drawing in space has.
const MAX_SEGMENTS: u64 = 1_000_000;
/// The limits of a drawing. Beside it, two lists of segments and a picture fit into the memory of the page.
pub(crate) const LIMITS: Limits =
    Limits { symbols: 16 << 20, modules: 2 << 20, segments: u32::MAX as u64, work: 16 << 20, memory: 48 << 20 };

/// A drawing with its mask.
pub(crate) struct Sketch {
    pub(crate) figure: Figure,
    /// The drawing as seen: in the plane, the drawing itself.
    pub(crate) seen: Arc<Drawing>,
    pub(crate) mask: Mask,
}

/// A sketch in the making.
pub(crate) enum Sketching {
    Drawing(FigureDrawer),
    Projection(Arc<Drawing<Solid>>, Box<Projection>),
    Tracing(Figure, Arc<Drawing>, Box<Tracing>),
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
        Ok(Self::Drawing(Figure::drawer(&system, definition.iterations, LIMITS)))
    }

    /// Works for about `work` units.
    ///
    /// # Errors
    /// The limit that the drawing exceeds.
    pub(crate) fn step(self, work: u64) -> Result<Result<Sketch, Self>, Diagnostic> {
        Ok(Err(match self {
            Self::Drawing(mut drawer) => match drawer.step(work) {
                Progress::More => Self::Drawing(drawer),
                Progress::Done => match drawer.finish()? {
                    Figure::Plane(drawing) => Self::tracing(Figure::Plane(drawing.clone()), drawing),
                    Figure::Space(drawing) => {
                        let projection = Projection::new(&drawing, &Outlook::default(), MAX_SEGMENTS)?;
                        Self::Projection(drawing, Box::new(projection))
                    }
                },
            },
            Self::Projection(drawing, mut projection) => match projection.step(&drawing, work) {
                Progress::More => Self::Projection(drawing, projection),
                Progress::Done => {
                    let seen = Arc::new(projection.finish(&drawing));
                    Self::tracing(Figure::Space(drawing), seen)
                }
            },
            Self::Tracing(figure, seen, mut tracing) => match tracing.step(work) {
                Progress::More => Self::Tracing(figure, seen, tracing),
                Progress::Done => return Ok(Ok(Sketch { figure, seen, mask: tracing.finish() })),
            },
        }))
    }

    fn tracing(figure: Figure, seen: Arc<Drawing>) -> Self {
        Self::Tracing(figure, seen.clone(), Box::new(Tracing::new(seen)))
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

impl Sketch {
    /// Whether the graphs of both are equal, which proves equal pictures.
    pub(crate) fn has_graph_of(&self, other: &Self) -> bool {
        match (&self.figure, &other.figure) {
            (Figure::Plane(own), Figure::Plane(other)) => is_same_graph(own, other),
            (Figure::Space(own), Figure::Space(other)) => is_same_graph(own, other),
            _ => false,
        }
    }

    /// The exact number of segments of this sketch of `definition`; `None` if it is beyond 128 bits and does not follow
    /// from the rules.
    pub(crate) fn segments(&self, definition: &Definition) -> Option<Tally> {
        let summed = || {
            let system = compiled(definition).ok()?;
            let mut counter = system.segments(definition.iterations);
            counter.step(LIMITS.work);
            counter.count().cloned()
        };
        self.figure.exact_segments().or_else(summed)
    }

    /// The ink; `None` if there is too much to compare its segments one by one, or if they exceed the range of numbers.
    pub(crate) fn outline(&self) -> Option<Outline> {
        let (segments, sides) = self.lists()?;
        Outline::new(&segments, &sides)
    }

    /// Whether the ink is that of an outline; `None` as in [`Sketch::outline`].
    pub(crate) fn has_outline(&self, outline: &mut Outline) -> Option<bool> {
        let (segments, sides) = self.lists()?;
        outline.is_of(&segments, &sides)
    }

    /// As [`lists`].
    pub(crate) fn lists(&self) -> Option<(Vec<Ends>, Vec<Ends>)> {
        lists(&self.figure)
    }
}

/// The segments of a drawing, and the sides of all polygons; `None` if they are too many.
pub(crate) fn lists(figure: &Figure) -> Option<(Vec<Ends>, Vec<Ends>)> {
    figure.check_size(MAX_SEGMENTS).ok()?;
    let segments = figure.segments_from(0).map(|segment| [segment.from, segment.to]).collect();
    let mut sides = Vec::new();
    for number in 0..figure.polygon_count() {
        let corners = figure.vertices(number)?;
        sides.extend(corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&from, &to)| [from, to]));
    }
    Some((segments, sides))
}
