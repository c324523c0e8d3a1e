//! The turtle's state at each symbol, as it reads them.

use crate::steps::Why;
use crate::steps::rows::{Reader, text};
use lsystem_base::word;
use lsystem_drawing::rotation::Axis;
use lsystem_drawing::{Geometry, Solid, System, legend};
use lsystem_syntax::{Action, Motion};
use serde::Serialize;

/// The most symbols that are followed.
const MAX_SYMBOLS: usize = 4_000;
/// The most stored states that are listed; the depth is always listed.
const MAX_LISTED: usize = 8;

type Vector = [f64; 3];

/// The turtle's state after a symbol.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[cfg_attr(feature = "typescript", ts(rename = "TurtleState"))]
#[serde(rename_all = "camelCase")]
pub struct State {
    /// The symbol, with its arguments.
    pub symbol: String,
    /// The position, in model units.
    pub at: Vector,
    /// The heading, the left and the up of the turtle: unit vectors.
    pub axes: [Vector; 3],
    /// The number of stored states.
    pub depth: usize,
    /// The last stored positions, the newest first.
    pub stored: Vec<Vector>,
    /// The ends of the segment that the symbol draws.
    pub segment: Option<[Vector; 2]>,
}

/// The turtle's way through the beginning of a string.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Trace {
    /// The state at the start: the symbol is empty.
    pub states: Vec<State>,
    /// The number of symbols of the whole string.
    pub length: String,
    /// Whether the drawing leaves the plane.
    pub is_solid: bool,
    /// The symbols in use, with their parameters, and what they do in words.
    pub legend: Vec<[String; 2]>,
}

#[derive(Clone, Copy)]
struct Turtle {
    at: Vector,
    turn: <Solid as Geometry>::Turn,
    /// The factor of lengths.
    scale: f64,
    swaps: bool,
}

/// The states of the turtle at the first symbols of generation `n`, at most `count`.
///
/// # Errors
/// A sentence that says why the way is not shown.
pub fn trace(system: &System, n: u32, count: usize) -> Result<Trace, Why> {
    let settings = &system.turtle;
    let is_varied = settings.angle_variation != 0.0 || settings.length_variation != 0.0 || settings.growth != 1.0;
    if settings.tropism.is_some() || settings.wind.is_some() || is_varied {
        return Err(word!("The turtle bends or varies its way here, which is not shown symbol by symbol."));
    }
    let reader = Reader::new(system, n)?;
    let mut turtle = Turtle {
        at: [settings.start[0], settings.start[1], 0.0],
        turn: Solid::turn(Axis::Up, settings.heading),
        scale: 1.0,
        swaps: false,
    };
    let mut stack: Vec<Turtle> = Vec::new();
    let state = |symbol: String, turtle: &Turtle, stack: &[Turtle], segment| State {
        symbol,
        at: turtle.at,
        axes: turtle.axes(),
        depth: stack.len(),
        stored: stack.iter().rev().take(MAX_LISTED).map(|stored| stored.at).collect(),
        segment,
    };
    let mut states = vec![state(String::new(), &turtle, &stack, None)];
    reader.modules(false, 0, count.min(MAX_SYMBOLS), &mut |symbol, arguments| {
        let letter = system.rules.letter(symbol, arguments.len() as u8);
        let actions = letter.map_or(&[][..], |letter| settings.actions[usize::from(letter)].as_slice());
        let mut segment = None;
        for (at, &action) in actions.iter().enumerate() {
            let action = if at == 0 { arguments.first().map_or(action, |&number| action.with(number)) } else { action };
            let before = turtle.at;
            let has_drawn = turtle.act(action, system, &mut stack);
            segment = has_drawn.then_some([before, turtle.at]).or(segment);
        }
        states.push(state(text(symbol, arguments), &turtle, &stack, segment));
    });
    let legend = legend(system).into_iter().map(|entry| [entry.module, entry.actions]).collect();
    Ok(Trace { states, length: reader.lengths()[0].to_string(), is_solid: system.is_solid(), legend })
}

impl Turtle {
    /// Does an action. Returns whether it draws a segment.
    fn act(&mut self, action: Action, system: &System, stack: &mut Vec<Self>) -> bool {
        let settings = &system.turtle;
        let action = if self.swaps { action.mirrored() } else { action };
        if let Some(turn) = settings.rotation(action) {
            self.turn = Solid::then(self.turn, Solid::turn(turn.about, turn.signed()));
        }
        match action {
            _ if action.row().motion == Motion::Ahead => {
                let length = action.number().unwrap_or(settings.step) * self.scale;
                let axes = Solid::axes(&mut Solid::directions(), self.turn);
                self.at = Solid::ahead(&axes, self.at, length);
                return action.draws();
            }
            Action::RollUpright => self.turn = Solid::upright(self.turn, &Solid::UPWARDS),
            Action::Push => {
                stack.push(*self);
                self.scale *= settings.length_factor;
            }
            Action::Pop => {
                if let Some(stored) = stack.pop() {
                    *self = stored;
                }
            }
            Action::ScaleLength(factor) => self.scale *= factor,
            Action::SwapTurns => self.swaps = !self.swaps,
            _ => {}
        }
        false
    }

    /// The heading, the left and the up.
    fn axes(&self) -> [Vector; 3] {
        let axes = Solid::axes(&mut Solid::directions(), self.turn);
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| Solid::transform(&axes, [0.0; 3], axis))
    }
}
