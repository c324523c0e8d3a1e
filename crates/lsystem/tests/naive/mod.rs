//! The naive reference: every generation is a list of modules, and the turtle reads the last one.
//!
//! The reference uses none of the core's shortcuts: productions come from the grammar, not from the compiled rules, and
//! headings are sums of floating-point degrees.
#![allow(dead_code, unreachable_pub, unused_imports, reason = "each test binary uses its own part")]

use lsystem::derive::Quantity;
use lsystem::drawing::{Colouring, Segment, Space, Turtle};
use lsystem::syntax::{Action, Grammar};
use lsystem::{Dialect, System};

mod derive;
mod space;
pub mod systems;

use derive::aged_modules;
pub use derive::{Module, image_of_each, images, modules};
pub use space::{solid_polygons, solid_segments};

/// The word of generation `n` without its arguments.
pub fn expand(grammar: &Grammar, seed: u32, n: u32) -> String {
    modules(grammar, seed, n).expect("finite numbers").iter().map(|module| module.symbol).collect()
}

/// The state of the turtle, which a branch saves.
#[derive(Clone, Copy)]
struct State {
    at: [f64; 2],
    degrees: f64,
    pen: Pen,
    tube: TubePlace<2>,
}

/// A point of a tube: place, heading and width.
type TubePlace<const N: usize> = ([f64; N], [f64; N], f64);

/// The state of the turtle's pen, in the plane and in space.
#[derive(Clone, Copy)]
struct Pen {
    colour: i32,
    width: f64,
    level: u32,
    /// The factor of lengths.
    scale: f64,
    /// Whether left and right turns are exchanged.
    swapped: bool,
    /// The number of the branch's last segment, if the branch has not moved since.
    last: Option<usize>,
}

impl Pen {
    fn new(turtle: &Turtle) -> Self {
        Self { colour: 0, width: turtle.width, level: 0, scale: 1.0, swapped: false, last: None }
    }

    /// Draws a segment of the branch. The segment before it gets its width at the end.
    fn draw<S: Space>(&mut self, turtle: &Turtle, from: S::Point, to: S::Point, segments: &mut Vec<Segment<S>>) {
        let segment = self.segment(turtle, from, to);
        if let Some(last) = self.last.filter(|_| turtle.tapers) {
            segments[last].end_width = segment.width;
        }
        self.last = Some(segments.len());
        segments.push(segment);
    }

    fn begin(&mut self, turtle: &Turtle, module: &Module) {
        if turtle.colouring == Colouring::Generations {
            self.colour = module.since as i32;
        }
    }

    fn segment<S: Space>(&self, turtle: &Turtle, from: S::Point, to: S::Point) -> Segment<S> {
        let &Self { colour, level, width, .. } = self;
        let width = width * turtle.step.abs();
        Segment { from, to, colour, level, width, end_width: width }
    }

    /// Draws the part of a tube between two of its points.
    fn tube<const N: usize, S: Space<Point = [f64; N]>>(
        &mut self,
        turtle: &Turtle,
        from: TubePlace<N>,
        to: TubePlace<N>,
        segments: &mut Vec<Segment<S>>,
    ) {
        self.last = None;
        let (points, step) = (tube(from, to, 8), turtle.step.abs());
        let width = |at: usize| (from.2 + (to.2 - from.2) * at as f64 / 8.0) * step;
        for at in 0..8 {
            let segment = self.segment(turtle, points[at], points[at + 1]);
            segments.push(Segment { width: width(at), end_width: width(at + 1), ..segment });
        }
    }

    /// Applies an action to the pen, after the turtle.
    fn act(&mut self, turtle: &Turtle, action: Action) {
        match (action, turtle.colouring) {
            (Action::Push, _) => {
                self.level += 1;
                self.last = None;
                self.width *= turtle.width_factor;
                self.scale *= turtle.length_factor;
            }
            (Action::TurnLeft(_), Colouring::Turns([left, _])) => self.colour = left,
            (Action::TurnRight(_), Colouring::Turns([_, right])) => self.colour = right,
            (Action::SetColour(colour), Colouring::Symbols) => self.colour = colour,
            (Action::AddColour(by), Colouring::Symbols) => self.colour = self.colour.wrapping_add(by),
            (Action::SetWidth(width), _) => self.width = width,
            (Action::ScaleWidth(factor), _) => self.width *= factor,
            (Action::ScaleLength(factor), _) => self.scale *= factor.max(0.0),
            (Action::SwapTurns, _) => self.swapped = !self.swapped,
            (Action::Move(_) | Action::MoveUnmarked(_), _) => self.last = None,
            _ => {}
        }
    }

    /// The action that a turtle performs instead of `action`, if left and right turns are exchanged.
    fn exchanged(&self, action: Action) -> Action {
        match action {
            Action::TurnLeft(by) if self.swapped => Action::TurnRight(by),
            Action::TurnRight(by) if self.swapped => Action::TurnLeft(by),
            other => other,
        }
    }
}

/// By module of a word: the number of segments that it draws.
pub fn segments_of_each(system: &System, word: &[Module]) -> Vec<usize> {
    let segments = |action: &Action| match action {
        Action::Draw(_) | Action::DrawUnmarked(_) => 1,
        Action::Circle(_) => 32,
        Action::TubePoint | Action::CloseTube => 8,
        _ => 0,
    };
    let draws = |module: &Module| actions(system, module.symbol).iter().map(segments).sum::<usize>();
    let images = image_of_each(&system.grammar, system.seed, word);
    images.iter().map(|modules| modules.iter().map(draws).sum()).collect()
}

/// The modules that draw generation `n`.
fn drawn(system: &System, n: u32) -> Vec<Module> {
    let aged = aged_modules(&system.grammar, system.seed, n, &|module| {
        let image = system.grammar.images.iter().filter(|image| image.predecessor.symbol == module.symbol);
        let mut symbols: Vec<char> = image.flat_map(|image| &image.successor).map(|m| m.symbol).collect();
        if symbols.is_empty() {
            symbols.push(module.symbol);
        }
        symbols.into_iter().any(|symbol| actions(system, symbol).iter().any(|action| action.draws()))
    });
    let mut aged = aged.expect("finite numbers");
    if n > 0 && system.turtle.growth < 1.0 {
        blend(&mut aged, &modules(&system.grammar, system.seed, n - 1).expect("finite numbers"), system.turtle.growth);
    }
    images(&system.grammar, system.seed, &aged).expect("finite numbers")
}

/// Under growth, the numbers of a module that continues one of the same letter are on the way from the numbers before.
fn blend(word: &mut [Module], before: &[Module], growth: f64) {
    let mut continued = std::collections::BTreeSet::new();
    for module in word.iter_mut().filter(|module| module.production.is_some()) {
        let parent = &before[module.parent];
        let is_like = (parent.symbol, parent.arguments.len()) == (module.symbol, module.arguments.len());
        if is_like && continued.insert(module.parent) {
            let numbers = module.arguments.iter_mut().zip(&parent.arguments);
            numbers.for_each(|(number, before)| *number = before + growth * (*number - before));
        }
    }
}

/// The factors of a module's length and angle, by variation and growth. `slot` is as in [`slot`].
fn variations(system: &System, n: u32, module: &Module, slot: usize) -> [f64; 2] {
    let turtle = &system.turtle;
    let grown = if module.made == n && n > 0 { turtle.growth } else { 1.0 };
    let of = |purpose, most: f64| grown * (1.0 + most * module.key.variation(system.seed, purpose, slot as u32));
    [of(Quantity::Length, turtle.length_variation), of(Quantity::Angle, turtle.angle_variation)]
}

/// The turns of a sway to the left and downwards, in radians: of a branch that `step` made, or of the plant's root.
fn swayed(turtle: &Turtle, step: Option<u32>) -> [f64; 2] {
    let Some(wind) = turtle.wind else { return [0.0; 2] };
    let phase = (wind.phase.degrees() - 40.0 * f64::from(step.unwrap_or(0))).to_radians();
    let strength = if step.is_some() { wind.strength } else { wind.strength / 3.0 };
    [strength * libm::sin(phase), 0.4 * strength * libm::cos(phase)].map(f64::to_radians)
}

/// The angle from -180 (exclusive) to 180 degrees.
fn shorter(degrees: f64) -> f64 {
    let within = degrees.rem_euclid(360.0);
    if within > 180.0 { within - 360.0 } else { within }
}

/// The segments of generation `n`, in drawing order.
pub fn segments(system: &System, n: u32) -> Vec<Segment> {
    let turtle = &system.turtle;
    let (left, right) = (turtle.left.degrees(), turtle.right.degrees());
    let tube = (turtle.start, [0.0; 2], turtle.width);
    let start = State { at: turtle.start, degrees: turtle.heading.degrees(), pen: Pen::new(turtle), tube };
    let (mut state, mut saved, mut segments) = (start, Vec::new(), Vec::new());
    turn(&mut state, swayed(turtle, None)[0].to_degrees());
    state.tube = tube_place(&state);
    for module in drawn(system, n) {
        state.pen.begin(turtle, &module);
        for (index, action) in actions(system, module.symbol).iter().enumerate() {
            let number = module.arguments.first().filter(|_| index == 0);
            let [longer, farther] = variations(system, n, &module, slot(actions(system, module.symbol), index));
            let longer = longer * state.pen.scale;
            let turned = |degrees: f64| if farther == 1.0 { degrees } else { shorter(degrees) * farther };
            let action = state.pen.exchanged(number.map_or(*action, |number| replaced(*action, *number)));
            match action {
                Action::Draw(length) | Action::DrawUnmarked(length) => {
                    let from = state.at;
                    advance(&mut state, longer * length.unwrap_or(turtle.step));
                    state.pen.draw(turtle, from, state.at, &mut segments);
                    if let Some(tropism) = turtle.tropism {
                        let (radians, [x, y, _]) = (state.degrees.to_radians(), tropism.vector);
                        let across = libm::cos(radians) * y - libm::sin(radians) * x;
                        turn(&mut state, (tropism.elasticity * across).to_degrees());
                    }
                }
                Action::Move(length) | Action::MoveUnmarked(length) => {
                    advance(&mut state, longer * length.unwrap_or(turtle.step));
                }
                Action::TurnLeft(by) => turn(&mut state, turned(by.unwrap_or(left))),
                Action::TurnRight(by) => turn(&mut state, -turned(by.unwrap_or(right))),
                Action::TurnRound => {
                    turn(&mut state, 180.0 * if module.made == n && n > 0 { turtle.growth } else { 1.0 });
                }
                Action::Circle(diameter) => {
                    let corners = (0..32).map(|corner| {
                        let mut there = state;
                        turn(&mut there, 11.25 * f64::from(corner));
                        advance(&mut there, 0.5 * longer * diameter.unwrap_or(turtle.step));
                        there.at
                    });
                    segments
                        .extend(around(&corners.collect::<Vec<_>>(), |from, to| state.pen.segment(turtle, from, to)));
                }
                Action::OpenTube => state.tube = tube_place(&state),
                Action::TubePoint | Action::CloseTube => {
                    let to = tube_place(&state);
                    state.pen.tube(turtle, state.tube, to, &mut segments);
                    state.tube = to;
                }
                Action::Push => {
                    saved.push(state);
                    turn(&mut state, swayed(turtle, Some(module.step))[0].to_degrees());
                }
                Action::Pop => state = saved.pop().unwrap_or(state),
                // Polygons have no strokes. Other actions leave the plane or change only the pen.
                _ => {}
            }
            state.pen.act(turtle, action);
        }
    }
    segments
}

/// The segments of generation `n`, in drawing order, of a drawing with these bounds.
pub fn limited_segments(system: &System, n: u32, bounds: Option<[f64; 4]>) -> Vec<Segment> {
    let mut segments = segments(system, n);
    let longest = bounds.map_or(0.0, |[x0, y0, x1, y1]| (x1 - x0).max(y1 - y0));
    limit_widths(&mut segments, &system.turtle, longest);
    segments
}

/// Makes all segments thinner by one factor, so that the widest is at most a part of the drawing's longest side.
fn limit_widths<S: Space>(segments: &mut [Segment<S>], turtle: &Turtle, longest: f64) {
    let widest = segments.iter().fold(0.0_f64, |widest, segment| widest.max(segment.width).max(segment.end_width));
    let factor = if longest > 1e-9 * turtle.step.abs() { turtle.max_width * longest / widest } else { 0.0 };
    if factor > 0.0 && factor < 1.0 {
        for segment in segments {
            segment.width *= factor;
            segment.end_width *= factor;
        }
    }
}

/// The segments around a closed outline.
fn around<P: Copy, T>(corners: &[P], segment: impl Fn(P, P) -> T) -> Vec<T> {
    (0..corners.len()).map(|at| segment(corners[at], corners[(at + 1) % corners.len()])).collect()
}

/// The number of lengths and turns before the action at `index`.
fn slot(actions: &[Action], index: usize) -> usize {
    use Action::{PitchDown, PitchUp, RollLeft, RollRight, TurnLeft, TurnRight, TurnRound};
    let goes = |action: &Action| {
        matches!(action, Action::Draw(_) | Action::DrawUnmarked(_) | Action::Move(_) | Action::MoveUnmarked(_))
            || matches!(action, Action::Circle(_) | Action::Fill(..) | Action::Surface(..))
    };
    let turns = |action: &Action| {
        matches!(
            action,
            TurnLeft(_) | TurnRight(_) | TurnRound | PitchDown(_) | PitchUp(_) | RollLeft(_) | RollRight(_)
        )
    };
    actions[..index].iter().filter(|action| goes(action) || turns(action)).count()
}

/// The actions of a symbol itself, not of its image.
fn actions(system: &System, symbol: char) -> &[Action] {
    match system.rules.letters.binary_search_by_key(&symbol, |letter| letter.symbol) {
        // In plain systems the turtle has the images' actions. The tests use images of plain symbols only in this
        // dialect.
        _ if system.rules.is_plain() && !system.grammar.images.is_empty() => Dialect::Abop.actions(symbol),
        Ok(id) => &system.turtle.actions[id],
        Err(_) => &[],
    }
}

/// An action whose number is replaced by an argument.
fn replaced(action: Action, number: f64) -> Action {
    match action {
        Action::Draw(_) => Action::Draw(Some(number)),
        Action::Move(_) => Action::Move(Some(number)),
        Action::TurnLeft(_) => Action::TurnLeft(Some(number)),
        Action::TurnRight(_) => Action::TurnRight(Some(number)),
        Action::SetWidth(_) | Action::ScaleWidth(_) => Action::SetWidth(number.max(0.0)),
        Action::SetColour(_) | Action::AddColour(_) => Action::SetColour(number.floor() as i32),
        Action::PitchDown(_) => Action::PitchDown(Some(number)),
        Action::PitchUp(_) => Action::PitchUp(Some(number)),
        Action::RollLeft(_) => Action::RollLeft(Some(number)),
        Action::RollRight(_) => Action::RollRight(Some(number)),
        Action::DrawUnmarked(_) => Action::DrawUnmarked(Some(number)),
        Action::MoveUnmarked(_) => Action::MoveUnmarked(Some(number)),
        Action::ScaleLength(_) => Action::ScaleLength(number),
        Action::Circle(_) => Action::Circle(Some(number)),
        Action::Fill(outline, _) => Action::Fill(outline, Some(number)),
        Action::Surface(name, _) => Action::Surface(name, Some(number)),
        Action::SwapTurns | Action::TurnRound | Action::RollUpright | Action::Push | Action::Pop | Action::Cut => {
            action
        }
        Action::OpenPolygon | Action::Vertex | Action::ClosePolygon => action,
        Action::OpenTube | Action::TubePoint | Action::CloseTube => action,
    }
}

fn tube_place(state: &State) -> TubePlace<2> {
    let radians = state.degrees.to_radians();
    (state.at, [libm::cos(radians), libm::sin(radians)], state.pen.width)
}

/// The points of the curve between two points of a tube, in this number of parts, by de Casteljau's construction.
pub fn tube<const N: usize>(from: TubePlace<N>, to: TubePlace<N>, parts: usize) -> Vec<[f64; N]> {
    let squares = (0..N).map(|i| (to.0[i] - from.0[i]) * (to.0[i] - from.0[i]));
    let third = squares.sum::<f64>().sqrt() / 3.0;
    let [first, last] =
        [(from, third), (to, -third)].map(|(end, by)| core::array::from_fn(|i| end.0[i] + by * end.1[i]));
    let point = |at: usize| {
        let t = at as f64 / parts as f64;
        let mut points = vec![from.0, first, last, to.0];
        while points.len() > 1 {
            points = points.windows(2).map(|p| core::array::from_fn(|i| p[0][i] + t * (p[1][i] - p[0][i]))).collect();
        }
        points[0]
    };
    (0..=parts).map(point).collect()
}

fn turn(state: &mut State, degrees: f64) {
    state.degrees = (state.degrees + degrees) % 360.0;
}

fn advance(state: &mut State, length: f64) {
    let radians = state.degrees.to_radians();
    state.at[0] += length * libm::cos(radians);
    state.at[1] += length * libm::sin(radians);
}

/// The smallest box around the segments' axes: min x, min y, max x, max y; `None` without segments.
pub fn bounds(segments: &[Segment]) -> Option<[f64; 4]> {
    let mut ends = segments.iter().flat_map(|s| [s.from, s.to]);
    let [x, y] = ends.next()?;
    Some(ends.fold([x, y, x, y], |b, [x, y]| [b[0].min(x), b[1].min(y), b[2].max(x), b[3].max(y)]))
}
