//! Drawings in space as drawings in the plane, for everything that is made for paper.

use super::Drawing;
use super::builder::Builder;
use super::segments::{Frame, Part, Strokes};
use super::tree::Tree;
use crate::Solid;
use crate::plane::Plane;
use crate::rotation::dot;
use crate::style::StyleChange;
use crate::turtle::Paper;
use lsystem_syntax::Diagnostic;
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

/// A segment or a polygon on the paper.
struct Seen {
    /// How near it is.
    depth: f64,
    points: Vec<[f64; 2]>,
    filled: bool,
    style: StyleChange,
    /// Along the path.
    place: f64,
}

impl Drawing<Solid> {
    /// The drawing as it is seen: every segment and polygon where it lies on the paper, those whose middles are
    /// farther away before those that are nearer, so that these cover them. Depths apart, coordinates are exact to 1e-9 of the extent.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) where there are more than `most` segments and vertices of polygons.
    pub fn seen_from(&self, outlook: &Outlook, most: u64) -> Result<Drawing, Diagnostic> {
        self.check_size(most)?;
        let [right, up, back] = outlook.axes();
        let paper = |point: [f64; 3]| [dot(right, point), dot(up, point)];
        let mut strokes = Strokes::new(self);
        if let Some(root) = self.root {
            strokes.enter(root, &Frame::new(1.0, StyleChange::start(self.width)));
        }
        // A negative step turns the picture round.
        let sign = if self.step < 0.0 { -1.0 } else { 1.0 };
        let mut seen = Vec::new();
        let (all, mut before) = (self.segment_count() as f64, 0.0);
        while let Some((part, frame)) = strokes.next_part() {
            let (points, filled, id) = match part {
                Part::Stroke(stroke) => (&[stroke.from, stroke.to][..], false, stroke.style),
                Part::Polygon(polygon) => (self.vertices_of(polygon), true, polygon.style),
            };
            let points = points.iter().map(|&point| frame.lie(point));
            let depth = points.clone().map(|point| dot(back, point)).sum::<f64>() / points.len() as f64;
            let style = frame.style.then(&self.styles[id.0 as usize]);
            let place = if all > 0.0 { (before + 0.5) / all } else { 0.0 };
            before += if filled { 0.0 } else { 1.0 };
            seen.push(Seen { depth: sign * depth, points: points.map(paper).collect(), filled, style, place });
        }
        seen.sort_by(|a, b| a.depth.total_cmp(&b.depth));

        let mut builder: Builder<Plane> = Builder::new();
        // Coordinates in space are within 1, those on paper within √3 then.
        let mut tree = Tree::new(self.root.map_or(0, |root| self.blocks[root.0 as usize].exponent));
        for Seen { points, filled, style, .. } in &seen {
            tree.draw(&mut builder, 0, |desk, _| match points.as_slice() {
                [from, to] if !filled => desk.stroke(*from, *to, style),
                points => {
                    desk.open(style);
                    points.iter().for_each(|&point| desk.vertex(point));
                    desk.close();
                }
            });
        }
        let root = tree.finish(&mut builder);
        Ok(Drawing {
            blocks: builder.blocks,
            items: builder.items,
            corners: builder.corners,
            vertices: builder.vertices,
            styles: builder.styles.list,
            root,
            start: paper(self.start),
            step: self.step,
            width: self.width,
            pieces: vec![],
            memoised: false,
            places: seen.iter().map(|seen| seen.place).collect(),
            symbols: self.symbols,
            scene: builder.scene,
            extent: OnceLock::new(),
        })
    }
}
