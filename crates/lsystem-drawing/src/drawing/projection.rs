//! Parallel projection of drawings in space to drawings in the plane, for the export formats of the plane.

use super::Drawing;
use super::builder::Builder;
use super::extent::{PlaneSurvey, falling};
use super::pieces::Pieces;
use super::segments::{BlockFrame, Cursor, ItemRef};
use super::tree::Tree;
use crate::Solid;
use crate::drawing::block::{BlockId, Space};
use crate::exact_path::{ExactPath, Spot};
use crate::plane::Plane;
use crate::rotation::dot;
use crate::style::StyleChange;
use crate::turtle::Paper;
use core::cmp::Reverse;
use core::ops::Range;
use lsystem_base::{Meter, Progress};
use lsystem_syntax::Diagnostic;
use std::collections::BinaryHeap;
use std::sync::OnceLock;

/// The direction of a parallel projection, with +y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlook {
    /// The viewer's angle around the vertical, in degrees: 0 looks from +z, 90 from +x.
    pub azimuth: f64,
    /// The viewer's angle above the horizon, in degrees: 0 looks level, 90 straight down.
    pub elevation: f64,
}

impl Default for Outlook {
    /// A little from the right and from above.
    fn default() -> Self {
        Self { azimuth: 25.0, elevation: 12.0 }
    }
}

impl Outlook {
    /// The directions to the right and up in the picture, and towards the viewer: unit vectors of the model.
    #[must_use]
    pub fn axes(&self) -> [[f64; 3]; 3] {
        let cos_sin = |degrees: f64| lsystem_syntax::Heading::from_degrees(degrees).cos_sin();
        let ((ca, sa), (ce, se)) = (cos_sin(self.azimuth), cos_sin(self.elevation));
        [[ca, 0.0, -sa], [-se * sa, ce, -se * ca], [ce * sa, se, ce * ca]]
    }
}

impl Drawing<Solid> {
    /// The projected drawing: every segment and polygon, the farthest first, so that near ones cover far ones. The
    /// depth is that of the middle. Coordinates are exact to 1e-9 of the drawing's size.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if there are more than `most` segments and vertices of polygons.
    pub fn seen_from(&self, outlook: &Outlook, most: u64) -> Result<Drawing, Diagnostic> {
        let mut projection = Projection::new(self, outlook, most)?;
        while projection.step(self, u64::MAX) == Progress::More {}
        Ok(projection.finish(self))
    }
}

/// As [`Drawing::seen_from`], in steps. A projection does not borrow the drawing between steps.
#[derive(Clone, Debug)]
pub struct Projection {
    /// As [`Outlook::axes`].
    axes: [[f64; 3]; 3],
    cursor: Cursor<Solid>,
    /// The number of segments read so far.
    segments: f64,
    /// The marks read so far, in drawing order.
    seen: Vec<ProjectedMark>,
    /// The ends and vertices of these marks, and their depths: greater ones are nearer to the viewer.
    points: Vec<[f64; 2]>,
    depths: Vec<f64>,
    /// The depths and numbers of the marks not yet drawn, the farthest first.
    order: BinaryHeap<(i64, Reverse<u32>)>,
    builder: Builder<Plane>,
    tree: Tree<Plane>,
    /// The places of the marks drawn so far, as [`Drawing::places`].
    places: Vec<f64>,
    /// The depths of the ends and vertices drawn so far.
    drawn: Vec<f64>,
    stage: Stage,
    spent: u64,
}

/// A segment or a polygon in the picture.
#[derive(Clone, Debug)]
struct ProjectedMark {
    points: Range<u32>,
    filled: bool,
    style: StyleChange,
    /// As in [`Drawing::places`].
    place: f64,
}

/// The stage of a projection.
#[derive(Clone, Debug)]
enum Stage {
    /// Read the marks.
    Read,
    /// Draw the marks, the farthest first.
    Draw,
    /// Make the last blocks.
    Close,
    Survey(BlockId, Box<PlaneSurvey>),
    Done(Option<(BlockId, [f64; 4])>),
}

impl Projection {
    /// Prepares the projection of a drawing.
    ///
    /// # Errors
    /// As [`Drawing::seen_from`].
    pub fn new(drawing: &Drawing<Solid>, outlook: &Outlook, most: u64) -> Result<Self, Diagnostic> {
        drawing.check_size(most)?;
        let mut cursor = Cursor::new();
        if let Some(root) = drawing.root {
            cursor.enter(drawing, root, &BlockFrame::new(1.0, StyleChange::start(drawing.width)));
        }
        // Coordinates in space are within 1, so those in the picture are within √3.
        let exponent = drawing.root.map_or(0, |root| drawing.blocks[root.0 as usize].exponent);
        Ok(Self {
            axes: outlook.axes(),
            cursor,
            segments: 0.0,
            seen: vec![],
            points: vec![],
            depths: vec![],
            order: BinaryHeap::new(),
            builder: Builder::new(),
            tree: Tree::new(exponent, false),
            places: vec![],
            drawn: vec![],
            stage: Stage::Read,
            spent: 0,
        })
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Continues for about `work` units. Every call needs the same drawing.
    pub fn step(&mut self, drawing: &Drawing<Solid>, work: u64) -> Progress {
        let mut meter = Meter::new(work);
        while !meter.is_spent() && !matches!(self.stage, Stage::Done(_)) {
            if let Some(next) = self.advance(drawing, &mut meter) {
                self.stage = next;
            }
        }
        self.spent = self.spent.saturating_add(meter.spent());
        if matches!(self.stage, Stage::Done(_)) { Progress::Done } else { Progress::More }
    }

    /// Continues in the present stage. Returns the next stage when this one is over.
    fn advance(&mut self, drawing: &Drawing<Solid>, meter: &mut Meter) -> Option<Stage> {
        match &mut self.stage {
            Stage::Read => (!self.read(drawing, meter)).then_some(Stage::Draw),
            Stage::Draw => (!self.draw(meter)).then_some(Stage::Close),
            Stage::Close => {
                let root = self.tree.finish_one(&mut self.builder);
                meter.charge(8 + self.builder.take_work());
                Some(match root? {
                    Some(root) => Stage::Survey(root, Box::new(Plane::survey(root))),
                    None => Stage::Done(None),
                })
            }
            Stage::Survey(root, survey) => {
                let extent = Plane::advance(survey, self.builder.contents(), meter)?;
                Some(Stage::Done(Some((*root, extent))))
            }
            Stage::Done(_) => None,
        }
    }

    /// Reads the next segment or polygon. Returns false if there is none.
    fn read(&mut self, drawing: &Drawing<Solid>, meter: &mut Meter) -> bool {
        let Some((part, frame)) = self.cursor.next_part(drawing) else { return false };
        let (points, filled, id) = match part {
            ItemRef::Stroke(stroke) => (&[stroke.from, stroke.to][..], false, stroke.style),
            ItemRef::Polygon(polygon) => (drawing.vertices_of(polygon), true, polygon.style),
        };
        meter.charge(8 + points.len() as u64 / 4);
        let [right, up, back] = self.axes;
        let first = self.points.len() as u32;
        // A negative step reflects the drawing, so that near becomes far.
        let sign = if drawing.step < 0.0 { -1.0 } else { 1.0 };
        for &point in points {
            let point = frame.transform(point);
            self.points.push([dot(right, point), dot(up, point)]);
            self.depths.push(sign * dot(back, point));
        }
        let depth = self.depths[first as usize..].iter().sum::<f64>() / points.len() as f64;
        self.order.push((falling(depth), Reverse(self.seen.len() as u32)));
        let style = frame.style.then(&drawing.styles[id.0 as usize]);
        let all = drawing.segment_count() as f64;
        let place = if all > 0.0 { (self.segments + 0.5) / all } else { 0.0 };
        self.segments += if filled { 0.0 } else { 1.0 };
        self.seen.push(ProjectedMark { points: first..self.points.len() as u32, filled, style, place });
        true
    }

    /// Draws the farthest mark left. Returns false if there is none.
    fn draw(&mut self, meter: &mut Meter) -> bool {
        let Some((_, Reverse(number))) = self.order.pop() else { return false };
        let ProjectedMark { points, filled, style, place } = &self.seen[number as usize];
        let range = points.start as usize..points.end as usize;
        let points = &self.points[range.clone()];
        self.tree.draw(&mut self.builder, 0, |paper, _| match points {
            [from, to] if !filled => paper.stroke([*from, *to], Spot::ENTRY, style),
            points => {
                paper.open(style);
                points.iter().for_each(|&point| paper.vertex(point, Spot::ENTRY));
                paper.close();
            }
        });
        self.places.push(*place);
        self.drawn.extend_from_slice(&self.depths[range]);
        meter.charge(8 + points.len() as u64 / 4 + self.builder.take_work());
        true
    }

    /// The projected drawing, when all steps are done.
    #[must_use]
    pub fn finish(self, drawing: &Drawing<Solid>) -> Drawing {
        let Self { axes: [right, up, _], builder, places, drawn: mut depths, stage, .. } = self;
        let (root, extent) = match stage {
            Stage::Done(Some((root, extent))) => (Some(root), OnceLock::from(Some(extent))),
            _ => (None, OnceLock::new()),
        };
        // The depths are in units of the root block in space.
        if let (Some(BlockId(own)), Some(BlockId(before))) = (root, drawing.root) {
            let [own, before] = [builder.blocks[own as usize].exponent, drawing.blocks[before as usize].exponent];
            let unit = libm::scalbn(1.0, before.saturating_sub(own));
            depths.iter_mut().for_each(|depth| *depth *= unit);
        }
        Drawing {
            blocks: builder.blocks,
            items: builder.items,
            corners: builder.corners,
            vertices: builder.vertices,
            styles: builder.styles.list,
            root,
            start: [dot(right, drawing.start), dot(up, drawing.start)],
            step: drawing.step,
            width: drawing.width,
            pieces: Pieces::None,
            exact_path: ExactPath::new(),
            memoised: false,
            places,
            depths,
            wires: drawing.wires,
            symbols: drawing.symbols,
            scene: builder.scene,
            extent,
        }
    }
}
