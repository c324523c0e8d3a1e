//! Marks in a drawing that tell what its lines do not: where branches begin, and which letters draw.
//!
//! A mark is a tiny triangle in a colour of its own. It moves nothing, so that the lines, their numbers and the sharing
//! of blocks stay the same.

use lsystem_drawing::{Colouring, System, Triangle};
use lsystem_syntax::Action;
use std::sync::Arc;

/// The colour index of all else.
const OTHER: i32 = 0;
/// The colour index of the mark at the beginning of a branch. A letter has its number plus [`LETTERS`].
pub(crate) const BRANCH: i32 = 1;
/// The first colour index of letters.
pub(crate) const LETTERS: i32 = 2;
/// The name of the surface that is a mark: no symbol of a system.
const MARK: char = '\0';
/// The size of marks in steps. A drawing with a few million steps from end to end has them all; a mark that is lost to
/// rounding leaves out a letter or a branch, not a line.
const SIZE: f64 = 1.0 / (1 << 30) as f64;
/// The corners of a mark about the turtle, ahead and to the left.
const CORNERS: Triangle = [[SIZE, 0.0, 0.0], [-0.5 * SIZE, SIZE, 0.0], [-0.5 * SIZE, -SIZE, 0.0]];

/// The system with marks in place of its colours and widths. The marks are for [`Walk`](crate::Walk).
#[must_use]
pub fn marked(system: &System) -> System {
    let mut system = system.clone();
    let turtle = &mut system.turtle;
    (turtle.colouring, turtle.tapers, turtle.max_width) = (Colouring::Symbols, false, 0.0);
    turtle.surfaces.push((MARK, Arc::new([CORNERS])));
    for (letter, actions) in (0..).zip(&mut turtle.actions) {
        let mut marked = Vec::with_capacity(actions.len());
        for &action in &*actions {
            marked.push(if action.is_look() { SILENT } else { action });
            let mark = match action {
                Action::Push => Some(BRANCH),
                _ if action.segments() > 0 => Some(LETTERS + letter),
                _ => None,
            };
            let point = Action::Surface(MARK, None);
            marked.extend(
                mark.into_iter().flat_map(|colour| [Action::SetColour(colour), point, Action::SetColour(OTHER)]),
            );
        }
        *actions = marked;
    }
    system
}

/// By letter: its number among the letters that draw lines.
pub(crate) fn drawing_letters(system: &System) -> Vec<usize> {
    let mut drawing = 0;
    let number = |actions: &Vec<Action>| {
        let own = drawing;
        drawing += usize::from(actions.iter().any(|action| action.segments() > 0));
        own
    };
    system.turtle.actions.iter().map(number).collect()
}

/// The action in place of one that is not heard: it does nothing to a drawing, also with a module's number.
const SILENT: Action = Action::Cut;
