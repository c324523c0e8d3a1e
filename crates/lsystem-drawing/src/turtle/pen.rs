//! The pen: the state of the turtle, which performs operations and draws on a paper.

use crate::Plane;
use crate::exact_path::{By, Leg, Spot};
use crate::room::{bytes_of, reserve};
use crate::rotation::Axis;
use crate::space::{Geometry, unit_of};
use crate::style::{ColourChange, StyleChange, WidthChange};
use crate::tube::TubeEnd;
use crate::turtle::op::{BranchFactors, TurtleOp};
use crate::turtle::score::Score;
use crate::turtle::settings::Turtle;
use lsystem_syntax::CIRCLE_SIDES;

/// The corners of a circle with radius 1, counter-clockwise from +x.
const CORNERS: [[f64; 2]; CIRCLE_SIDES as usize] = {
    // The cosines of multiples of 11.25 degrees, from 0 to 90 degrees.
    const COSINES: [f64; 9] = [
        1.0,
        0.980_785_280_403_230_4,
        0.923_879_532_511_286_7,
        0.831_469_612_302_545_2,
        core::f64::consts::FRAC_1_SQRT_2,
        0.555_570_233_019_602_2,
        0.382_683_432_365_089_8,
        0.195_090_322_016_128_28,
        0.0,
    ];
    let mut corners = [[0.0; 2]; CIRCLE_SIDES as usize];
    let mut at = 0;
    while at < 8 {
        let [c, s] = [COSINES[at], COSINES[8 - at]];
        corners[at] = [c, s];
        corners[at + 8] = [-s, c];
        corners[at + 16] = [-c, -s];
        corners[at + 24] = [s, -c];
        at += 1;
    }
    corners
};

/// The state of the turtle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen<S: Geometry = Plane> {
    pub at: S::Point,
    /// The place, exactly.
    pub spot: Spot,
    pub heading: S::Turn,
    pub style: StyleChange,
    /// The factor of lengths, by branches and by [`TurtleOp::ScaleLength`].
    pub scale: f64,
    /// Whether left and right turns are exchanged.
    pub swapped: bool,
    /// The upward direction of the model, in the pen's frame. A sway turns it with the branch.
    pub vertical: S::Point,
    /// The last point of the tube.
    pub tube: TubeEnd<S>,
}

/// A receiver of segments and polygons.
pub(crate) trait Paper<S: Geometry> {
    /// Notes a leg of the turtle's way. Returns the place at its end.
    fn go(&mut self, leg: Leg<S>) -> Spot;
    /// Adds a segment of the branch.
    fn stroke(&mut self, ends: [S::Point; 2], spot: Spot, style: &StyleChange);
    /// Adds a segment beside the branch.
    fn side(&mut self, ends: [S::Point; 2], spot: Spot, style: &StyleChange);
    /// Adds a stroke of a tube, which tapers to the width `style.next`.
    fn tube(&mut self, ends: [S::Point; 2], style: &StyleChange);
    /// Interrupts the branch: the turtle moves.
    fn gap(&mut self);
    /// Opens a branch.
    fn branch(&mut self);
    /// Ends a branch and returns to the outer one.
    fn rejoin(&mut self);
    /// Opens a polygon.
    fn open(&mut self, style: &StyleChange);
    /// Adds a vertex to the innermost open polygon, if any, unless the polygon has vertices already.
    fn first_vertex(&mut self, at: S::Point, spot: Spot);
    /// Adds a vertex to the innermost open polygon, if any.
    fn vertex(&mut self, at: S::Point, spot: Spot);
    /// Closes the innermost open polygon, if any.
    fn close(&mut self);
}

impl Turtle {
    /// The orientation at the start, and the vertical.
    pub(crate) fn start<S: Geometry>(&self) -> (S::Turn, S::Point) {
        let mut pen = Pen::<S>::new(S::turn(Axis::Up, self.heading), StyleChange::NONE);
        if let Some(wind) = self.wind {
            pen.wind(wind.at_root::<S>(), &mut S::directions());
        }
        (pen.heading, pen.vertical)
    }
}

impl<S: Geometry> Pen<S> {
    /// A pen at the start of a drawing.
    pub(crate) fn start(turtle: &Turtle, score: &Score<S>) -> Self {
        let (heading, vertical) = turtle.start::<S>();
        Self { vertical, ..Self::new(heading, StyleChange::start(score.width)) }
    }

    /// A pen at the origin.
    pub(crate) fn new(heading: S::Turn, style: StyleChange) -> Self {
        let at = S::Point::default();
        let tube = TubeEnd { at, heading, width: style.width };
        Self { at, spot: Spot::ENTRY, heading, style, scale: 1.0, swapped: false, vertical: S::UPWARDS, tube }
    }

    /// Performs operations, with lengths times `scale`, and draws on `paper`. `saved` is the stack of open branches. A
    /// `Pop` without an open branch does nothing.
    pub(crate) fn act(
        &mut self,
        ops: &[TurtleOp<S>],
        saved: &mut Vec<Self>,
        scale: f64,
        directions: &mut S::Directions,
        paper: &mut impl Paper<S>,
    ) {
        for &op in ops {
            match op {
                TurtleOp::Draw(length) => {
                    let from = self.at;
                    self.forward(length, scale, directions, paper);
                    paper.stroke([from, self.at], self.spot, &self.style);
                }
                TurtleOp::Move(length) => {
                    self.forward(length, scale, directions, paper);
                    paper.gap();
                }
                TurtleOp::Turn(by) => self.heading = S::then(self.heading, by.turn(self.swapped)),
                TurtleOp::Wind(turn) => self.wind(turn, directions),
                TurtleOp::SwapTurns => self.swapped = !self.swapped,
                TurtleOp::ScaleLength(factor) => self.scale_by(factor),
                TurtleOp::Circle(diameter) => self.circle(diameter, scale, directions, paper),
                TurtleOp::Fill(outline, size) => {
                    paper.open(&self.style);
                    if let Some(corners) = outline.leaf() {
                        self.fill(corners.map(|[x, y]| [x, y, 0.0]), size, scale, directions, paper);
                    } else {
                        self.fill(CORNERS.iter().map(|[x, y]| [*x, *y, 0.0]), 0.5 * size, scale, directions, paper);
                    }
                    paper.close();
                }
                TurtleOp::Triangle { corners, size, .. } => {
                    paper.open(&self.style);
                    self.fill(corners.iter().copied(), size, scale, directions, paper);
                    paper.close();
                }
                TurtleOp::Upright => self.heading = S::upright(self.heading, &self.vertical),
                TurtleOp::Bend(tropism) => self.heading = S::bent(self.heading, &tropism),
                TurtleOp::Push(BranchFactors { width, length }) => {
                    reserve(saved, 1);
                    saved.push(*self);
                    paper.branch();
                    self.style.level = self.style.level.saturating_add(1);
                    self.style.width = self.style.width.then(WidthChange { factor: width, offset: 0.0 });
                    self.scale_by(length);
                }
                TurtleOp::Pop => {
                    if let Some(outer) = saved.pop() {
                        *self = outer;
                        paper.rejoin();
                    }
                }
                TurtleOp::Style(change) => self.style = self.style.then(&change),
                TurtleOp::TurnColour(sides) => {
                    self.style.colour = ColourChange::Set(sides[usize::from(self.swapped)]);
                }
                TurtleOp::OpenPolygon => paper.open(&self.style),
                TurtleOp::FirstVertex => paper.first_vertex(self.at, self.spot),
                TurtleOp::Vertex => paper.vertex(self.at, self.spot),
                TurtleOp::ClosePolygon => paper.close(),
                TurtleOp::OpenTube => self.tube = self.tube_end(),
                TurtleOp::Tube => self.draw_tube(directions, paper),
            }
        }
    }

    fn circle(&self, diameter: f64, scale: f64, directions: &mut S::Directions, paper: &mut impl Paper<S>) {
        let axes = self.axes(0.5 * diameter * scale, directions);
        let mut corner = [CORNERS[0][0], CORNERS[0][1], 0.0];
        let (mut from, mut spot) = self.corner(&axes, corner, 0.5 * diameter, paper);
        for [x, y] in CORNERS.into_iter().cycle().skip(1).take(CORNERS.len()) {
            let by = By::Corner([x - corner[0], y - corner[1]]);
            corner = [x, y, 0.0];
            let to = S::transform(&axes, self.at, S::point(corner));
            let factor = 0.5 * diameter * self.scale;
            spot = paper.go(Leg { from: spot, by, heading: self.heading, factor });
            paper.side([from, to], spot, &self.style);
            from = to;
        }
    }

    /// Draws a part of a tube up to here.
    fn draw_tube(&mut self, directions: &mut S::Directions, paper: &mut impl Paper<S>) {
        let end = self.tube_end();
        let curve = self.tube.curve(&end, directions);
        self.tube = end;
        paper.gap();
        for ends in curve.windows(2) {
            let [(from, width), (to, next)] = [ends[0], ends[1]];
            paper.tube([from, to], &StyleChange { width, next: Some(next), ..self.style });
        }
    }

    /// The turtle's place as a point of a tube.
    fn tube_end(&self) -> TubeEnd<S> {
        TubeEnd { at: self.at, heading: self.heading, width: self.style.width }
    }

    /// Turns the heading by a sway. The vertical turns too: all of a branch moves as one, and pieces with `$` stay equal.
    pub(in crate::turtle) fn wind(&mut self, turn: S::Turn, directions: &mut S::Directions) {
        let still = self.heading;
        self.heading = S::then(still, turn);
        if !S::LEVEL {
            let axes = S::axes(directions, self.heading);
            self.vertical = S::transform(&axes, S::Point::default(), S::seen(still, self.vertical));
        }
    }

    /// Multiplies lengths from here on.
    pub(crate) fn scale_by(&mut self, factor: f64) {
        self.scale = scaled(self.scale, factor);
    }

    /// The turtle's axes times `size`.
    fn axes(&self, size: f64, directions: &mut S::Directions) -> S::Axes {
        S::scaled(S::axes(directions, self.heading), size * self.scale)
    }

    /// A corner of a shape of this size around the turtle, with these axes.
    fn corner(&self, axes: &S::Axes, corner: [f64; 3], size: f64, paper: &mut impl Paper<S>) -> (S::Point, Spot) {
        let by = By::Corner([corner[0], corner[1]]);
        let spot = paper.go(Leg { from: self.spot, by, heading: self.heading, factor: size * self.scale });
        (S::transform(axes, self.at, S::point(corner)), spot)
    }

    /// Adds corners of a shape of this size to the open polygon.
    fn fill(
        &self,
        corners: impl Iterator<Item = [f64; 3]>,
        size: f64,
        scale: f64,
        directions: &mut S::Directions,
        paper: &mut impl Paper<S>,
    ) {
        let axes = self.axes(size * scale, directions);
        corners.for_each(|corner| {
            let (at, spot) = self.corner(&axes, corner, size, paper);
            paper.vertex(at, spot);
        });
    }

    fn forward(&mut self, length: f64, scale: f64, directions: &mut S::Directions, paper: &mut impl Paper<S>) {
        let (heading, factor) = (self.heading, length * self.scale);
        self.at = S::ahead(&S::axes(directions, heading), self.at, length * scale * self.scale);
        self.spot = paper.go(Leg { from: self.spot, by: By::Ahead, heading, factor });
    }
}

/// A scale times `factor`, at most [`LARGEST_SCALE`].
pub(crate) fn scaled(scale: f64, factor: f64) -> f64 {
    (scale * factor).min(LARGEST_SCALE)
}

/// The factor of lengths along a word, without the rest of the turtle's state.
#[derive(Clone, Debug)]
pub(crate) struct ScaleTrace {
    pub scale: f64,
    saved: Vec<f64>,
}

impl ScaleTrace {
    /// The scale at the start of a word.
    pub(crate) fn new() -> Self {
        Self { scale: 1.0, saved: vec![] }
    }

    /// Applies an operation.
    pub(crate) fn follow<S: Geometry>(&mut self, op: &TurtleOp<S>) {
        match op {
            TurtleOp::Push(BranchFactors { length, .. }) => {
                reserve(&mut self.saved, 1);
                self.saved.push(self.scale);
                self.scale = scaled(self.scale, *length);
            }
            TurtleOp::Pop => self.scale = self.saved.pop().unwrap_or(self.scale),
            TurtleOp::ScaleLength(factor) => self.scale = scaled(self.scale, *factor),
            _ => {}
        }
    }

    /// The exponent of the scale; 0 without scaling.
    pub(crate) fn exponent(&self) -> i32 {
        if self.scale == 1.0 { 0 } else { unit_of(self.scale) }
    }

    /// The bytes that the saved scales occupy.
    pub(crate) fn bytes(&self) -> u64 {
        bytes_of(&self.saved)
    }
}

/// The largest factor of lengths: far beyond any picture.
pub(crate) const LARGEST_SCALE: f64 = 1e30;
