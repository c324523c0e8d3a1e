//! Exact places of a drawing.

use crate::drawing::Drawing;
use crate::drawing::block::{BlockId, Item, Placed};
use crate::exact_path::{By, Spot};
use lsystem_base::fixed::{Circle, Fixed, FixedPoint};
use lsystem_base::sorted::sort;
use lsystem_syntax::Heading;

/// The most places that are kept while they are computed.
const MAX_SPOTS: usize = 1 << 16;

/// Computes exact places. Their unit is that of the drawing's exact path.
pub(super) struct Exact<'a> {
    drawing: &'a Drawing,
    /// The binary places of points and of directions, in 32 bits.
    pub(super) places: [usize; 2],
    circle: Circle,
    /// The directions so far.
    directions: Vec<(Heading, FixedPoint)>,
    /// By place, the places so far, and their number.
    spots: Vec<Option<FixedPoint>>,
    known: usize,
}

impl<'a> Exact<'a> {
    pub(super) fn new(drawing: &'a Drawing, way: &[(BlockId, usize)], reach: i32) -> Self {
        // A block's own unit may be larger than the root's.
        let (mut scale, mut largest) = (1.0, 1.0_f64);
        for &(block, at) in way {
            if let Item::Block(placed) = &drawing.items_of(block)[at] {
                scale *= drawing.own_scale(block, placed);
                largest = largest.max(scale);
            }
        }
        let unit = drawing.exact_path.exponent;
        let size = drawing.blocks.iter().map(|block| block.exponent - unit).max().unwrap_or(0).max(0);
        // A guard of 96 bits below the reach, for the rounding of all sums.
        let bits = (96 + unit - reach + libm::frexp(largest).1).max(96);
        let places = [bits, bits + size + 64].map(|bits| bits.unsigned_abs().div_ceil(32) as usize);
        Self {
            drawing,
            places,
            circle: Circle::new(places[1]),
            directions: vec![],
            spots: vec![None; drawing.exact_path.legs.len() + 1],
            known: 0,
        }
    }

    /// The cosine and the sine of a heading.
    fn direction(&mut self, heading: Heading) -> FixedPoint {
        if let Some((_, direction)) = self.directions.iter().find(|(known, _)| *known == heading) {
            return direction.clone();
        }
        let direction = self.circle.at(heading.units(), Heading::TURN);
        self.directions.push((heading, direction.clone()));
        direction
    }

    /// The vector turned by a heading.
    #[inline(never)]
    pub(super) fn turned(&mut self, vector: &FixedPoint, heading: Heading) -> FixedPoint {
        if heading == Heading::EAST {
            return vector.clone();
        }
        vector.turned(&self.direction(heading), self.places[1])
    }

    /// A place in the frame of its piece; `None` if it takes too many others.
    fn spot(&mut self, spot: Spot) -> Option<FixedPoint> {
        let (mut asked, mut needed) = (vec![spot.0], vec![]);
        while let Some(number) = asked.pop() {
            // A place that is asked for twice is computed once: the first time makes it known as the origin.
            if number == 0 || self.spots[number as usize].is_some() {
                continue;
            }
            self.spots[number as usize] = Some(FixedPoint::default());
            needed.push(number);
            self.known += 1;
            if self.known > MAX_SPOTS {
                return None;
            }
            let leg = &self.drawing.exact_path.legs[number as usize - 1];
            asked.push(leg.from.0);
            if let By::Piece(Spot(end)) = leg.by {
                asked.push(end);
            }
        }
        // A leg comes after those that it builds on.
        sort(&mut needed);
        let [places, fine] = self.places;
        for number in needed {
            let leg = self.drawing.exact_path.legs[number as usize - 1];
            let by = match leg.by {
                By::Piece(end) => {
                    let end = self.known(end);
                    self.turned(&end, leg.heading)
                }
                By::Ahead => self.direction(leg.heading).shifted(32 * (places as i32 - fine as i32)),
                By::Corner(corner) => {
                    let corner = FixedPoint(corner.map(|c| Fixed::of(c, places)));
                    self.turned(&corner, leg.heading)
                }
            };
            self.spots[number as usize] = Some(self.known(leg.from).plus(&by.scaled(leg.factor)));
        }
        Some(self.known(spot))
    }

    /// A place that is computed already.
    fn known(&self, spot: Spot) -> FixedPoint {
        self.spots[spot.0 as usize].clone().unwrap_or_default()
    }

    /// A place in the frame of a block.
    #[inline(never)]
    pub(super) fn within(&mut self, block: BlockId, spot: Spot) -> Option<FixedPoint> {
        let origin = self.spot(self.drawing.blocks[block.0 as usize].origin)?;
        Some(self.spot(spot)?.minus(&origin))
    }

    /// The place on the segment to which a way leads, in the root's frame.
    pub(super) fn centre(&mut self, way: &[(BlockId, usize)], along: f64) -> Option<FixedPoint> {
        let mut centre = FixedPoint::default();
        for &(block, at) in way.iter().rev() {
            centre = match &self.drawing.items_of(block)[at] {
                Item::Stroke(stroke) => {
                    let start = self.within(block, self.drawing.exact_path.start(stroke.spot))?;
                    let whole = self.within(block, stroke.spot)?.minus(&start);
                    start.plus(&whole.scaled(along))
                }
                Item::Polygon(_) => return None,
                Item::Block(placed) => {
                    let at = self.within(block, placed.spot?)?;
                    at.plus(&self.turned(&centre, placed.heading).scaled(self.drawing.own_scale(block, placed)))
                }
            };
        }
        Some(centre)
    }
}

impl Drawing {
    /// The factor from the own unit of a placed block to that of its container.
    pub(super) fn own_scale(&self, block: BlockId, placed: &Placed) -> f64 {
        let exponent = |id: BlockId| self.blocks[id.0 as usize].exponent;
        libm::scalbn(placed.scale, exponent(block) - exponent(placed.block))
    }
}
