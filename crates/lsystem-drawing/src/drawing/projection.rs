//! Drawings in space as drawings in the plane, for everything that is made for paper.

use super::Drawing;
use super::builder::Builder;
use super::extent::{Survey, falling};
use super::pieces::Pieces;
use super::segments::{Frame, Part, Standing};
use super::tree::Tree;
use crate::Solid;
use crate::drawing::block::{BlockId, Space};
use crate::plane::Plane;
use crate::rotation::dot;
use crate::style::StyleChange;
use crate::turtle::Paper;
use core::cmp::Reverse;
use core::ops::Range;
use lsystem_syntax::{Diagnostic, Meter, Progress};
use std::collections::BinaryHeap;
use std::sync::OnceLock;

/// From where a drawing in space is seen on paper. Lines that are parallel stay so, and +y is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlook {
    /// Around the vertical, in degrees: 0 looks from +z, 90 from +x.
    pub azimuth: f64,
    /// How far from above, in degrees: 0 looks level, 90 straight down.
    pub elevation: f64,
}

impl Default for Outlook {
    /// A little from the right and from above.
    fn default() -> Self {
        Self { azimuth: 25.0, elevation: 12.0 }
    }
}

impl Outlook {
    /// To the right and upwards on the paper, and towards who looks at it: unit vectors of the model.
    #[must_use]
    pub fn axes(&self) -> [[f64; 3]; 3] {
        let cos_sin = |degrees: f64| lsystem_syntax::Heading::from_degrees(degrees).cos_sin();
        let ((ca, sa), (ce, se)) = (cos_sin(self.azimuth), cos_sin(self.elevation));
        [[ca, 0.0, -sa], [-se * sa, ce, -se * ca], [ce * sa, se, ce * ca]]
    }
}

impl Drawing<Solid> {
    /// The drawing as it is seen: every segment and polygon where it lies on the paper, those whose middles are
    /// farther away before those that are nearer, so that these cover them. Depths apart, coordinates are exact to 1e-9 of the extent.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) where there are more than `most` segments and vertices of polygons.
    pub fn seen_from(&self, outlook: &Outlook, most: u64) -> Result<Drawing, Diagnostic> {
        let mut projection = Projection::new(self, outlook, most)?;
        while projection.step(self, u64::MAX) == Progress::More {}
        Ok(projection.finish(self))
    }
}

/// The same in steps. It holds no drawing.
#[derive(Clone, Debug)]
pub struct Projection {
    /// To the right, upwards and towards who looks.
    axes: [[f64; 3]; 3],
    standing: Standing<Solid>,
    /// How many segments have been read.
    segments: f64,
    /// What has been read, in the order of the drawing, and its ends and vertices.
    seen: Vec<Seen>,
    points: Vec<[f64; 2]>,
    /// The numbers of what has been read and not been drawn yet, the farthest first.
    order: BinaryHeap<(i64, Reverse<u32>)>,
    builder: Builder<Plane>,
    tree: Tree<Plane>,
    /// Of what has been drawn.
    places: Vec<f64>,
    stage: Stage,
    spent: u64,
}

/// A segment or a polygon on the paper.
#[derive(Clone, Debug)]
struct Seen {
    points: Range<u32>,
    filled: bool,
    style: StyleChange,
    /// Along the path.
    place: f64,
}

/// How far a projection is.
#[derive(Clone, Debug)]
enum Stage {
    Read,
    Draw,
    /// Making the last blocks.
    Close,
    Survey(BlockId, Box<Survey>),
    Done(Option<(BlockId, [f64; 4])>),
}

impl Projection {
    /// Ready to project a drawing.
    ///
    /// # Errors
    /// As [`Drawing::seen_from`].
    pub fn new(drawing: &Drawing<Solid>, outlook: &Outlook, most: u64) -> Result<Self, Diagnostic> {
        drawing.check_size(most)?;
        let mut standing = Standing::new();
        if let Some(root) = drawing.root {
            standing.enter(drawing, root, &Frame::new(1.0, StyleChange::start(drawing.width)));
        }
        // Coordinates in space are within 1, those on paper within √3 then.
        let exponent = drawing.root.map_or(0, |root| drawing.blocks[root.0 as usize].exponent);
        Ok(Self {
            axes: outlook.axes(),
            standing,
            segments: 0.0,
            seen: vec![],
            points: vec![],
            order: BinaryHeap::new(),
            builder: Builder::new(),
            tree: Tree::new(exponent),
            places: vec![],
            stage: Stage::Read,
            spent: 0,
        })
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Goes on for about `work` units; the drawing is the same each time.
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

    /// Works on in the present stage; returns the next one when this one is over.
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

    /// Reads the next segment or polygon; whether there was one.
    fn read(&mut self, drawing: &Drawing<Solid>, meter: &mut Meter) -> bool {
        let Some((part, frame)) = self.standing.next_part(drawing) else { return false };
        let (points, filled, id) = match part {
            Part::Stroke(stroke) => (&[stroke.from, stroke.to][..], false, stroke.style),
            Part::Polygon(polygon) => (drawing.vertices_of(polygon), true, polygon.style),
        };
        meter.charge(8 + points.len() as u64 / 4);
        let [right, up, back] = self.axes;
        let first = self.points.len() as u32;
        let depths = points.iter().map(|&point| {
            let point = frame.lie(point);
            self.points.push([dot(right, point), dot(up, point)]);
            dot(back, point)
        });
        let depth = depths.sum::<f64>() / points.len() as f64;
        // A negative step turns the picture round.
        let sign = if drawing.step < 0.0 { -1.0 } else { 1.0 };
        self.order.push((falling(sign * depth), Reverse(self.seen.len() as u32)));
        let style = frame.style.then(&drawing.styles[id.0 as usize]);
        let all = drawing.segment_count() as f64;
        let place = if all > 0.0 { (self.segments + 0.5) / all } else { 0.0 };
        self.segments += if filled { 0.0 } else { 1.0 };
        self.seen.push(Seen { points: first..self.points.len() as u32, filled, style, place });
        true
    }

    /// Draws the farthest that is left; whether there was something.
    fn draw(&mut self, meter: &mut Meter) -> bool {
        let Some((_, Reverse(number))) = self.order.pop() else { return false };
        let Seen { points, filled, style, place } = &self.seen[number as usize];
        let points = &self.points[points.start as usize..points.end as usize];
        self.tree.draw(&mut self.builder, 0, |desk, _| match points {
            [from, to] if !filled => desk.stroke(*from, *to, style),
            points => {
                desk.open(style);
                points.iter().for_each(|&point| desk.vertex(point));
                desk.close();
            }
        });
        self.places.push(*place);
        meter.charge(8 + points.len() as u64 / 4 + self.builder.take_work());
        true
    }

    /// The drawing on paper, when all steps are done.
    #[must_use]
    pub fn finish(self, drawing: &Drawing<Solid>) -> Drawing {
        let Self { axes: [right, up, _], builder, places, stage, .. } = self;
        let (root, extent) = match stage {
            Stage::Done(Some((root, extent))) => (Some(root), OnceLock::from(Some(extent))),
            _ => (None, OnceLock::new()),
        };
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
            memoised: false,
            places,
            symbols: drawing.symbols,
            scene: builder.scene,
            extent,
        }
    }
}
