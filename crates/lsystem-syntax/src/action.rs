//! The turtle's actions, and their table: words, number, legend, and all else that other rooms must know of an action.
//!
//! A new action is a variant of [`Action`], a row of [`ACTIONS`], and its operation in the turtle (`lsystem-drawing`).

use crate::{CIRCLE_SIDES, Expected, Outline};
use core::f64::consts::{FRAC_1_SQRT_2, SQRT_2};
use lsystem_base::word;

/// The number of strokes of a part of a tube. With 8 strokes, a part whose headings differ from its chord by up to 60
/// degrees stays within 1/90 of the length of the chord of the true curve.
pub const TUBE_STROKES: u32 = 8;

/// One action of the turtle. Each symbol has a list of actions, from the [`Dialect`](crate::Dialect) or an override.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Go forward and draw. The length is in model units, times the length scale; `None` is the system's step length.
    /// The end becomes a vertex of an open polygon; the start, too, if the polygon has no vertex yet.
    Draw(Option<f64>),
    /// Go forward without drawing. Length and vertices as in [`Action::Draw`].
    Move(Option<f64>),
    /// As [`Action::Draw`], without recording a vertex of an open polygon.
    DrawUnmarked(Option<f64>),
    /// As [`Action::Move`], without recording a vertex of an open polygon.
    MoveUnmarked(Option<f64>),
    /// Open a polygon, filled in the turtle's current colour. Strokes drawn before it is closed lie on top of it.
    OpenPolygon,
    /// Record the turtle's position as a vertex of the innermost open polygon.
    Vertex,
    /// Fill the innermost open polygon, and continue with the polygon around it.
    ClosePolygon,
    /// Turn counter-clockwise, by degrees; `None` is the system's left angle.
    TurnLeft(Option<f64>),
    /// Turn clockwise, by degrees; `None` is the system's right angle.
    TurnRight(Option<f64>),
    /// Turn by 180 degrees.
    TurnRound,
    /// Pitch the heading down, away from the turtle's up, by degrees; `None` is the system's pitch angle.
    PitchDown(Option<f64>),
    /// Pitch the heading up, towards the turtle's up, by degrees; `None` is the system's pitch angle.
    PitchUp(Option<f64>),
    /// Roll about the heading so that the turtle's left rises, by degrees; `None` is the system's roll angle.
    RollLeft(Option<f64>),
    /// Roll about the heading so that the turtle's left sinks, by degrees; `None` is the system's roll angle.
    RollRight(Option<f64>),
    /// Roll about the heading until the turtle's left is level and its up does not point below the horizon.
    RollUpright,
    /// Save position, heading, colour, width, length and the exchange of turns, and go one branch level deeper.
    Push,
    /// Restore the state that the matching [`Action::Push`] saved.
    Pop,
    /// Set the palette index, 0-based.
    SetColour(i32),
    /// Add to the palette index.
    AddColour(i32),
    /// Set the stroke width, in multiples of the step length.
    SetWidth(f64),
    /// Multiply the stroke width.
    ScaleWidth(f64),
    /// Multiply all lengths from here on.
    ScaleLength(f64),
    /// From here on, exchange left and right turns: [`Action::TurnLeft`] and [`Action::TurnRight`] do what the other
    /// does. A second exchange ends the first.
    SwapTurns,
    /// Draw a circle around the turtle, in the plane of its heading and its left. The diameter is in model units, times
    /// the length scale; `None` is the system's step length. The circle is drawn as [`CIRCLE_SIDES`] segments.
    Circle(Option<f64>),
    /// Fill an outline in the turtle's current colour, in the plane of its heading and its left. The size is in model
    /// units, times the length scale; `None` is the system's step length.
    Fill(Outline, Option<f64>),
    /// Begin a tube here: a generalized cylinder, as `@Gs` of cpfg.
    OpenTube,
    /// Draw the tube up to here, as `@Gc` of cpfg: a smooth curve from the last point of the tube on this branch, which
    /// may be in the branch around it. The curve leaves the last point and reaches this one along the turtle's headings
    /// there. The width changes evenly from the one to the other. The curve is drawn as [`TUBE_STROKES`] segments.
    /// Without [`Action::OpenTube`], the tube begins where the turtle starts.
    TubePoint,
    /// Draw the tube up to here and end it, as `@Ge` of cpfg.
    CloseTube,
    /// Draw the surface of this name at the turtle, in its current colour. The size is in model units, times the length
    /// scale; `None` is the system's step length.
    Surface(char, Option<f64>),
    /// In the next derivation step, remove this symbol and the rest of its branch. The turtle ignores the symbol.
    Cut,
}

impl Action {
    /// The action with a module's first argument as its number: a length, degrees, a width, a factor or a palette
    /// index. Actions without a number stay the same. [`Action::AddColour`] and [`Action::ScaleWidth`] become
    /// [`Action::SetColour`] and [`Action::SetWidth`].
    #[must_use]
    pub fn with(mut self, number: f64) -> Self {
        match &mut self {
            Self::Draw(own)
            | Self::Move(own)
            | Self::DrawUnmarked(own)
            | Self::MoveUnmarked(own)
            | Self::TurnLeft(own)
            | Self::TurnRight(own)
            | Self::PitchDown(own)
            | Self::PitchUp(own)
            | Self::RollLeft(own)
            | Self::RollRight(own)
            | Self::Circle(own)
            | Self::Fill(_, own)
            | Self::Surface(_, own) => *own = Some(number),
            Self::ScaleLength(factor) => *factor = number,
            Self::SetWidth(_) | Self::ScaleWidth(_) => self = Self::SetWidth(number),
            // The cast takes the nearest `i32` for numbers out of range.
            Self::SetColour(_) | Self::AddColour(_) => self = Self::SetColour(libm::floor(number) as i32),
            Self::TurnRound
            | Self::SwapTurns
            | Self::RollUpright
            | Self::Push
            | Self::Pop
            | Self::Cut
            | Self::OpenPolygon
            | Self::Vertex
            | Self::ClosePolygon
            | Self::OpenTube
            | Self::TubePoint
            | Self::CloseTube => {}
        }
        self
    }

    /// The action's own number; `None` if it has none, or takes the system's.
    #[must_use]
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Draw(own) | Self::Move(own) | Self::DrawUnmarked(own) | Self::MoveUnmarked(own) => own,
            Self::TurnLeft(own) | Self::TurnRight(own) => own,
            Self::PitchDown(own) | Self::PitchUp(own) | Self::RollLeft(own) | Self::RollRight(own) => own,
            Self::Circle(own) | Self::Fill(_, own) | Self::Surface(_, own) => own,
            Self::ScaleLength(number) | Self::SetWidth(number) | Self::ScaleWidth(number) => Some(number),
            Self::SetColour(index) | Self::AddColour(index) => Some(f64::from(index)),
            _ => None,
        }
    }

    /// Whether the action goes forward and draws.
    #[must_use]
    pub fn draws(self) -> bool {
        matches!(self, Self::Draw(_) | Self::DrawUnmarked(_))
    }

    /// The number of segments that the action draws.
    #[must_use]
    pub fn segments(self) -> u64 {
        u64::from(self.row().segments)
    }

    /// The number of segments that the action draws, or 1 if the action fills something.
    #[must_use]
    pub fn marks(self) -> u64 {
        let row = self.row();
        u64::from(row.segments.max(u32::from(row.fills)))
    }

    /// The turn to the other side for a left or a right turn; other actions stay the same.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::TurnLeft(own) => Self::TurnRight(own),
            Self::TurnRight(own) => Self::TurnLeft(own),
            other => other,
        }
    }

    /// The action's length, size or diameter, if the action has one: `Some(None)` is the system's step length.
    #[must_use]
    pub fn length(self) -> Option<Option<f64>> {
        matches!(self.row().form, NumberForm::Length(_) | NumberForm::Surface).then(|| self.number())
    }

    /// The action without recording vertices.
    #[must_use]
    pub fn unmarked(self) -> Self {
        match self {
            Self::Draw(length) => Self::DrawUnmarked(length),
            Self::Move(length) => Self::MoveUnmarked(length),
            other => other,
        }
    }

    /// Whether the action leads out of the plane: a pitch or a roll.
    #[must_use]
    pub fn is_solid(self) -> bool {
        self.row().part == Vocabulary::Space
    }

    /// Whether the action changes only how strokes look: their colour or width.
    #[must_use]
    pub fn is_look(self) -> bool {
        self.row().part == Vocabulary::Looks
    }
}

/// The number after an action's words.
#[derive(Clone, Copy, Debug)]
pub enum NumberForm {
    /// No number: the words mean this action.
    Plain(Action),
    /// An optional length between -[`MAX`] and [`MAX`]; without it, the system's step length.
    Length(fn(Option<f64>) -> Action),
    /// An optional angle between -[`MAX`] and [`MAX`], in degrees; without it, an angle of the system.
    Angle(fn(Option<f64>) -> Action),
    /// The name of a surface, then its size: a length.
    Surface,
    /// A number in this range, and an example with a space before it.
    Number(fn(f64) -> Action, Expected, &'static str),
    /// A palette index.
    Index,
    /// An optional number of places along the palette, 1 by default, times this direction.
    Along(i64),
}

/// The largest length, angle, width or factor that is accepted.
pub(crate) const MAX: f64 = 1e9;

/// A part of the turtle's vocabulary. Notations of other programs have only some of the parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vocabulary {
    /// Steps, turns in the plane and branches. All notations have these.
    Basic,
    /// Colours and widths.
    Looks,
    /// Turns out of the plane.
    Space,
    /// Changes of lengths.
    Scaling,
    /// Exchanges of left and right turns.
    SwappedTurns,
    /// Filled polygons.
    Polygons,
    /// Circles, discs and leaves.
    Circles,
    /// Smooth tubes.
    Tubes,
    /// Bezier surfaces.
    Surfaces,
    /// Cuts of branches.
    Cuts,
}

/// The effect of an action on the turtle's way after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// The turtle stays where it is; lengths and turns stay, too.
    Still,
    /// The turtle goes ahead by the action's length.
    Ahead,
    /// The turtle turns.
    Turn,
    /// The turtle's state is saved or restored.
    Branch,
    /// Later lengths or turns change.
    Later,
}

/// A row of [`ACTIONS`].
#[derive(Debug)]
pub struct ActionRow {
    /// The words in overrides, and other spellings of them.
    pub words: &'static [&'static str],
    /// The number after the words.
    pub form: NumberForm,
    /// The legend's sentence; `{}` stands for the action's own number.
    pub legend: &'static str,
    /// The same for a symbol whose parameter is the number.
    pub numbered: &'static str,
    /// The usual letter for that parameter.
    pub letter: &'static str,
    /// The number of segments that the action draws.
    pub segments: u32,
    /// Whether the action fills an area.
    pub fills: bool,
    /// The effect on the turtle's way.
    pub motion: Motion,
    /// The part of the vocabulary.
    pub part: Vocabulary,
}

impl ActionRow {
    const fn new(words: &'static [&'static str], form: NumberForm, legend: &'static str) -> Self {
        let (motion, part) = (Motion::Still, Vocabulary::Basic);
        Self { words, form, legend, numbered: legend, letter: "a", segments: 0, fills: false, motion, part }
    }

    const fn plain(words: &'static [&'static str], action: Action, legend: &'static str) -> Self {
        Self::new(words, NumberForm::Plain(action), legend)
    }

    const fn length(words: &'static [&'static str], make: fn(Option<f64>) -> Action, legend: &'static str) -> Self {
        Self { letter: "l", ..Self::new(words, NumberForm::Length(make), legend) }
    }

    const fn angle(words: &'static [&'static str], make: fn(Option<f64>) -> Action, legend: &'static str) -> Self {
        Self { motion: Motion::Turn, ..Self::new(words, NumberForm::Angle(make), legend) }
    }

    const fn with_parameter(self, letter: &'static str, numbered: &'static str) -> Self {
        Self { letter, numbered, ..self }
    }

    const fn segments(self, segments: u32) -> Self {
        Self { segments, ..self }
    }

    const fn fills(self) -> Self {
        Self { fills: true, ..self }
    }

    const fn motion(self, motion: Motion) -> Self {
        Self { motion, ..self }
    }

    const fn part(self, part: Vocabulary) -> Self {
        Self { part, ..self }
    }

    /// The words with the name that belongs to them, and a number if they need one: `surface l`; `width` and ` 2`.
    #[must_use]
    pub fn example(&self) -> (String, &'static str) {
        let words = self.words[0].to_owned();
        match self.form {
            NumberForm::Surface => (words + " l", ""),
            NumberForm::Index => (words, " 2"),
            NumberForm::Number(_, _, number) => (words, number),
            NumberForm::Plain(_) | NumberForm::Length(_) | NumberForm::Angle(_) | NumberForm::Along(_) => (words, ""),
        }
    }

    /// Whether the row is of this action.
    fn is_of(&self, action: Action) -> bool {
        let is_like = |sample: Action| match (sample, action) {
            (Action::Fill(one, _), Action::Fill(other, _)) => one == other,
            _ => core::mem::discriminant(&sample) == core::mem::discriminant(&action),
        };
        match self.form {
            NumberForm::Plain(own) => own == action,
            NumberForm::Length(make) | NumberForm::Angle(make) => is_like(make(None)),
            NumberForm::Surface => matches!(action, Action::Surface(..)),
            NumberForm::Number(make, ..) => is_like(make(0.0)),
            NumberForm::Index => matches!(action, Action::SetColour(_)),
            NumberForm::Along(direction) => matches!(action, Action::AddColour(by) if (by < 0) == (direction < 0)),
        }
    }
}

impl Action {
    /// The action's row in the table.
    #[must_use]
    pub fn row(self) -> &'static ActionRow {
        let rows = ACTIONS.iter().filter(|row| row.is_of(self));
        // Two rows may fit: `thicker` is also `width times 1.41`, and the row without a number is meant. Each action has a
        // row (tested), so the row at 0 only stands in for none.
        rows.min_by_key(|row| !matches!(row.form, NumberForm::Plain(_))).unwrap_or(&ACTIONS[0])
    }
}

/// All actions but `nothing`, in the order of the message that lists them.
pub static ACTIONS: [ActionRow; 38] = {
    use Motion::{Ahead, Branch, Later, Turn};
    use Vocabulary::{Circles, Cuts, Looks, Polygons, Scaling, Space, Surfaces, SwappedTurns, Tubes};
    type Row = ActionRow;
    [
        Row::length(&["draw"], Action::Draw, word!("draws {}")).motion(Ahead).segments(1),
        Row::length(&["move"], Action::Move, word!("moves {}")).motion(Ahead),
        Row::length(&["draw unmarked"], Action::DrawUnmarked, word!("draws {}")).motion(Ahead).segments(1),
        Row::length(&["move unmarked"], Action::MoveUnmarked, word!("moves {}")).motion(Ahead),
        Row::angle(&["turn left"], Action::TurnLeft, word!("turns left by {}°")),
        Row::angle(&["turn right"], Action::TurnRight, word!("turns right by {}°")),
        Row::plain(&["turn round", "turn around"], Action::TurnRound, word!("turns round")).motion(Turn),
        Row::angle(&["pitch down"], Action::PitchDown, word!("pitches down by {}°")).part(Space),
        Row::angle(&["pitch up"], Action::PitchUp, word!("pitches up by {}°")).part(Space),
        Row::angle(&["roll left"], Action::RollLeft, word!("rolls left by {}°")).part(Space),
        Row::angle(&["roll right"], Action::RollRight, word!("rolls right by {}°")).part(Space),
        Row::plain(&["roll upright"], Action::RollUpright, word!("rolls upright")).motion(Turn).part(Space),
        Row::plain(&["open branch", "push"], Action::Push, word!("starts a branch")).motion(Branch),
        Row::plain(&["close branch", "pop"], Action::Pop, word!("ends the branch")).motion(Branch),
        Row::plain(&["cut branch"], Action::Cut, word!("cuts off the rest of its branch in the next step")).part(Cuts),
        Row::plain(&["open polygon"], Action::OpenPolygon, word!("begins a filled polygon")).part(Polygons),
        // Outside of polygons and tubes, their other actions do nothing.
        Row::plain(&["vertex"], Action::Vertex, word!("is a vertex of the polygon")),
        Row::plain(&["close polygon"], Action::ClosePolygon, word!("fills the polygon")).fills(),
        Row::plain(&["open tube"], Action::OpenTube, word!("begins a smooth tube")),
        Row::plain(&["tube point"], Action::TubePoint, word!("draws the tube up to here"))
            .segments(TUBE_STROKES)
            .part(Tubes),
        Row::plain(&["close tube"], Action::CloseTube, word!("draws the tube up to here and ends it"))
            .segments(TUBE_STROKES)
            .part(Tubes),
        Row::new(&["colour", "color"], NumberForm::Index, word!("takes colour {}"))
            .with_parameter("c", word!("takes colour {}"))
            .part(Looks),
        Row::new(&["next colour", "next color"], NumberForm::Along(1), word!("goes {} colours on")).part(Looks),
        Row::new(&["previous colour", "previous color"], NumberForm::Along(-1), word!("goes {} colours on"))
            .part(Looks),
        Row::new(
            &["width"],
            NumberForm::Number(Action::SetWidth, Expected::Between(0.0, MAX), " 2"),
            word!("draws {} steps wide"),
        )
        .with_parameter("w", word!("draws {} steps wide"))
        .part(Looks),
        Row::new(
            &["width times"],
            NumberForm::Number(Action::ScaleWidth, Expected::PositiveUpTo(MAX), " 0.5"),
            word!("draws thicker (x {})"),
        )
        .part(Looks),
        Row::plain(&["thicker"], Action::ScaleWidth(SQRT_2), word!("draws thicker (x {})")).part(Looks),
        Row::plain(&["thinner"], Action::ScaleWidth(FRAC_1_SQRT_2), word!("draws thinner (x {})")).part(Looks),
        Row::new(
            &["length times"],
            NumberForm::Number(Action::ScaleLength, Expected::Between(0.0, MAX), " 0.5"),
            word!("multiplies lengths by {}"),
        )
        .motion(Later)
        .part(Scaling),
        Row::plain(&["swap turns"], Action::SwapTurns, word!("exchanges left and right turns"))
            .motion(Later)
            .part(SwappedTurns),
        Row::length(&["circle"], Action::Circle, word!("draws a circle {} wide"))
            .with_parameter("d", word!("draws a circle with the diameter {}"))
            .segments(CIRCLE_SIDES)
            .part(Circles),
        Row::length(&["disc", "disk"], |size| Action::Fill(Outline::Disc, size), word!("fills a disc {} wide"))
            .with_parameter("d", word!("fills a disc with the diameter {}"))
            .fills()
            .part(Circles),
        Row::length(
            &["leaf lance"],
            |size| Action::Fill(Outline::Lance, size),
            word!("draws a narrow leaf of length {}"),
        )
        .fills()
        .part(Circles),
        Row::length(
            &["leaf heart"],
            |size| Action::Fill(Outline::Heart, size),
            word!("draws a heart-shaped leaf of length {}"),
        )
        .fills()
        .part(Circles),
        Row::length(&["leaf oak"], |size| Action::Fill(Outline::Oak, size), word!("draws a lobed leaf of length {}"))
            .fills()
            .part(Circles),
        Row::length(&["leaf needle"], |size| Action::Fill(Outline::Needle, size), word!("draws a needle of length {}"))
            .fills()
            .part(Circles),
        Row::length(&["leaf petal"], |size| Action::Fill(Outline::Petal, size), word!("draws a petal of length {}"))
            .fills()
            .part(Circles),
        Row::new(&["surface"], NumberForm::Surface, word!("draws the surface {}"))
            .with_parameter("s", word!("draws the surface {}, {} in size"))
            .fills()
            .part(Surfaces),
    ]
};
