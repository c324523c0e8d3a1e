//! The length of what is drawn, and the turning of the whole way.

use crate::growth::process::Process;
use lsystem_drawing::{AxisTurn, System};
use lsystem_syntax::{Action, Heading, Motion};

/// The length and the turning that each letter adds.
pub(crate) struct Path {
    lengths: Vec<f64>,
    /// In units of [`Heading::units`]; `None` with branches, which turn back, and in space.
    turns: Option<Vec<u64>>,
}

impl Path {
    /// `None` if lengths are scaled on the way, or vary.
    pub(crate) fn new(system: &System, process: &Process, is_flat: bool) -> Option<Self> {
        let turtle = &system.turtle;
        let is_varied = turtle.length_factor != 1.0 || turtle.length_variation != 0.0;
        let (mut lengths, mut turns) = (Vec::new(), Some(Vec::new()));
        for &symbol in &process.symbols {
            let letter = system.rules.letter(symbol, 0)?;
            let (mut length, mut turn) = (0.0, Some(Heading::EAST));
            for action in &turtle.actions[usize::from(letter)] {
                let by = match (action.row().motion, action.draws()) {
                    // A circle or a tube: its length is not the turtle's way.
                    (Motion::Still, _) if action.segments() > 0 => return None,
                    (Motion::Ahead, true) => {
                        length += action.number().unwrap_or(turtle.step).abs();
                        Some(Heading::EAST)
                    }
                    (Motion::Still | Motion::Ahead, _) => Some(Heading::EAST),
                    (Motion::Turn, _) => turtle.rotation(*action).map(AxisTurn::signed),
                    (Motion::Later, _) if *action != Action::SwapTurns => return None,
                    (Motion::Branch | Motion::Later, _) => None,
                };
                turn = turn.zip(by).map(|(turn, by)| turn + by);
            }
            lengths.push(length);
            turns = turns.zip(turn).map(|(mut turns, turn)| {
                turns.push(turn.units());
                turns
            });
        }
        let turns = turns.filter(|_| is_flat && turtle.angle_variation == 0.0);
        (!is_varied).then_some(Self { lengths, turns })
    }

    /// The length that these numbers of letters draw; `None` if it is out of range.
    pub(crate) fn length(&self, counts: impl Iterator<Item = f64>) -> Option<f64> {
        let parts = counts.zip(&self.lengths).filter(|(_, length)| **length > 0.0);
        Some(parts.map(|(count, length)| count * length).sum()).filter(|length: &f64| length.is_finite())
    }

    /// The units of a full turn.
    pub(crate) fn full_turn() -> u64 {
        2 * Heading::HALF.units()
    }

    /// The turning of the whole way, in degrees from 0 up to 360, counter-clockwise. The counts are modulo
    /// [`Path::full_turn`].
    pub(crate) fn turning(&self, counts: &[u64]) -> Option<f64> {
        let full = u128::from(Self::full_turn());
        let add = |total: u128, (count, turn): (&u64, &u64)| (total + u128::from(*count) * u128::from(*turn)) % full;
        let total = counts.iter().zip(self.turns.as_ref()?).fold(0, add);
        Some(total as f64 / full as f64 * 360.0)
    }
}
