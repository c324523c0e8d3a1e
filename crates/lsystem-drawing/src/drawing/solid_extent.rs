//! The extent of a drawing in space, more exact than its bodies.

use super::body::{Body, CoordinateAlong, DistanceFrom, MaximumSearch};
use super::girth::{self, Girth, OutwardCoordinate};
use crate::Solid;
use crate::drawing::block::{BlockId, Contents, Enclosed, HullInput, Item, Space};
use crate::drawing::scene::SceneSize;
use crate::rotation::Vector;
use lsystem_base::Meter;

impl Space for Solid {
    type Hull = Body;
    type Extent = Extent;
    type Survey = SolidSurvey;

    fn longest(Extent { sides: [low, high], .. }: &Extent) -> f64 {
        (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max)
    }

    fn enclose(input: HullInput<'_, Self>, items: &[Item<Self>]) -> Enclosed<Self> {
        let HullInput { blocks, items: made, corners, vertices, .. } = input;
        Body::enclose(Contents { blocks, items: made, corners, vertices }, items)
    }

    fn measure(size: &mut SceneSize, items: &[Item<Self>]) {
        let (mut lines, mut links) = (0, 0);
        for item in items {
            match item {
                Item::Stroke(_) => lines += 1,
                // A polygon has two triangles fewer than vertices.
                Item::Polygon(polygon) => lines += (polygon.count as usize).saturating_sub(2),
                Item::Block(_) => links += 1,
            }
        }
        size.add(lines, links);
    }

    fn least_picture() -> u64 {
        SceneSize::LEAST
    }

    fn survey(root: BlockId) -> SolidSurvey {
        SolidSurvey::new(root)
    }

    fn advance(survey: &mut SolidSurvey, contents: Contents<'_, Self>, meter: &mut Meter) -> Option<Extent> {
        survey.step(contents, meter)
    }
}

/// The box, the ball and the girth of a whole drawing, in units of the root block. A drawing that is divided into other
/// blocks has the same extent, so that a growing drawing never jumps in a fitted picture.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// The least and the greatest coordinates.
    pub(super) sides: [Vector; 2],
    /// The radius of the ball about the centre of the box.
    pub radius: f64,
    /// The girth about the upright axis through the centre of the box.
    pub girth: Option<Girth>,
}

impl Extent {
    /// The centre of the box, the ball and the girth.
    #[must_use]
    pub fn centre(&self) -> Vector {
        let [low, high] = self.sides;
        [0, 1, 2].map(|i| 0.5 * (low[i] + high[i]))
    }

    /// The length of the box along the y axis.
    #[must_use]
    pub fn height(&self) -> f64 {
        let [low, high] = self.sides;
        high[1] - low[1]
    }
}

/// A search, with bounded effort, for the smallest box around a drawing and for its girth.
#[derive(Clone, Debug)]
pub struct SolidSurvey {
    root: BlockId,
    /// The sides found so far: the least coordinates, then the greatest.
    sides: Vec<f64>,
    /// The search for the next side.
    side: Option<MaximumSearch<CoordinateAlong>>,
    /// The search for the radius of the ball, and the radius.
    ball: Option<MaximumSearch<DistanceFrom>>,
    radius: Option<f64>,
    /// The distances found so far, for [`girth::girth`].
    reach: Vec<f64>,
    /// The search for the next distance.
    ring: Option<MaximumSearch<OutwardCoordinate>>,
}

impl SolidSurvey {
    pub fn new(root: BlockId) -> Self {
        Self { root, sides: vec![], side: None, ball: None, radius: None, reach: vec![], ring: None }
    }

    /// Continues until the meter is spent. Returns the extent at the end.
    pub fn step(&mut self, contents: Contents<'_, Solid>, meter: &mut Meter) -> Option<Extent> {
        const EXACT: f64 = 1e-11;
        const PATIENCE: (usize, u64) = (3_000, 1 << 18);
        let items = contents.items_of(self.root);
        while self.sides.len() < 6 {
            let (i, sign) = (self.sides.len() % 3, if self.sides.len() < 3 { -1.0 } else { 1.0 });
            let search = self.side.get_or_insert_with(|| {
                let mut direction = [0.0; 3];
                direction[i] = sign;
                MaximumSearch::new(
                    contents,
                    items,
                    CoordinateAlong { base: 0.0, direction, scale: 1.0 },
                    EXACT,
                    PATIENCE,
                )
            });
            let (most, _) = search.step(contents, meter)?;
            self.sides.push(sign * most);
            self.side = None;
        }
        let side = |i: usize| self.sides[i];
        let mut extent = Extent { sides: [[0, 1, 2].map(side), [3, 4, 5].map(side)], radius: 0.0, girth: None };
        let from = extent.centre();
        extent.radius = match self.radius {
            Some(radius) => radius,
            None => {
                let quantity = DistanceFrom { from, scale: 1.0 };
                let search = self
                    .ball
                    .get_or_insert_with(|| MaximumSearch::new(contents, items, quantity, girth::EXACT, PATIENCE));
                let (most, _) = search.step(contents, meter)?;
                *self.radius.insert(most)
            }
        };
        while let Some(quantity) = OutwardCoordinate::new(from, self.reach.len()) {
            let search =
                self.ring.get_or_insert_with(|| MaximumSearch::new(contents, items, quantity, girth::EXACT, PATIENCE));
            let (most, _) = search.step(contents, meter)?;
            self.reach.push(most);
            self.ring = None;
        }
        extent.girth = girth::girth(&self.reach);
        Some(extent)
    }
}
