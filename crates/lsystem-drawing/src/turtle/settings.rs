//! The settings of the turtle, and the actions of all letters.

use crate::space::{Tropism, finite};
use crate::wind::Wind;
use lsystem_syntax::{Action, ColourBy, Heading, Style, SurfacePoint};
use std::sync::Arc;

/// The corners of a triangle of a surface of size 1: ahead, left and up.
pub type Triangle = [SurfacePoint; 3];

/// The actions of all letters and the settings of the turtle.
#[derive(Clone, Debug, PartialEq)]
pub struct Turtle {
    /// The actions by letter ([`LetterId`]).
    pub actions: Vec<Vec<Action>>,
    /// The triangles of the surfaces that letters draw, by name.
    pub surfaces: Vec<(char, Arc<[Triangle]>)>,
    /// The wireframes of shapes that are drawn after all else, in model units.
    pub wires: Arc<[[[f64; 3]; 2]]>,
    /// The angle of a left turn, counter-clockwise.
    pub left: Heading,
    /// The angle of a right turn, clockwise.
    pub right: Heading,
    /// The angle of pitching down: the heading turns away from the turtle's up.
    pub pitch_down: Heading,
    /// The angle of pitching up.
    pub pitch_up: Heading,
    /// The angle of rolling left: by the right-hand rule about the heading, which lifts the turtle's left.
    pub roll_left: Heading,
    /// The angle of rolling right.
    pub roll_right: Heading,
    /// The tropism that bends the heading after each segment.
    pub tropism: Option<Tropism>,
    /// The sway of branches.
    pub wind: Option<Wind>,
    /// The heading at the start.
    pub heading: Heading,
    /// The position at the start, in model units.
    pub start: [f64; 2],
    /// The step length, in model units.
    pub step: f64,
    /// The stroke width at the start, in multiples of the step length.
    pub width: f64,
    /// The greatest stroke width, as a fraction of the drawing's longest side: if the widest stroke exceeds it, all
    /// strokes are thinner by the same factor. 0 for no limit.
    pub max_width: f64,
    /// Whether a stroke tapers to the width with which its branch goes on.
    pub tapers: bool,
    /// The factor of the stroke width in a branch.
    pub width_factor: f64,
    /// The factor of all lengths in a branch.
    pub length_factor: f64,
    /// The rule for the colour index.
    pub colouring: Colouring,
    /// The largest random deviation of an angle, as a fraction of the angle.
    pub angle_variation: f64,
    /// The largest random deviation of a length, as a fraction of the length.
    pub length_variation: f64,
    /// The growth of the modules that the last derivation step made, from 0 to 1: their angles and lengths times this
    /// factor. One module of a successor continues its predecessor and is fully grown: the first of the predecessor's
    /// letter, whose numbers then are this part of the way from the predecessor's; or else, if the predecessor draws,
    /// the first that draws.
    pub growth: f64,
}

/// The rule for the turtle's colour index.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colouring {
    /// The colour symbols set the index.
    #[default]
    Symbols,
    /// Turns set the index: to the first number after a left turn, to the second after a right turn.
    Turns([i32; 2]),
    /// The index is the derivation step that made the module. A module of its predecessor's letter keeps the
    /// predecessor's index.
    Generations,
}

impl Default for Turtle {
    /// A turtle at the origin with heading +y, step length 1, angles of 0 degrees, and no letters.
    fn default() -> Self {
        Self {
            actions: vec![],
            surfaces: vec![],
            wires: Arc::default(),
            left: Heading::EAST,
            right: Heading::EAST,
            pitch_down: Heading::EAST,
            pitch_up: Heading::EAST,
            roll_left: Heading::EAST,
            roll_right: Heading::EAST,
            tropism: None,
            wind: None,
            heading: Heading::UP,
            start: [0.0; 2],
            step: 1.0,
            width: 0.0,
            max_width: 0.0,
            tapers: false,
            width_factor: 1.0,
            length_factor: 1.0,
            colouring: Colouring::Symbols,
            angle_variation: 0.0,
            length_variation: 0.0,
            growth: 1.0,
        }
    }
}

impl Turtle {
    /// Takes widths and the rule for colours from a style.
    pub(crate) fn take_style(&mut self, style: &Style) {
        (self.width, self.max_width, self.width_factor) = (style.width, style.max_width / 100.0, style.width_factor);
        self.tapers = style.tapers;
        self.colouring = match style.colour_by {
            ColourBy::Turn => Colouring::Turns(style.turn_colours),
            ColourBy::Generation => Colouring::Generations,
            ColourBy::Symbol | ColourBy::Single | ColourBy::Level | ColourBy::Path | ColourBy::Density => {
                Colouring::Symbols
            }
        };
    }

    /// Whether a letter that may be drawn changes the width.
    pub(in crate::turtle) fn changes_width(&self, drawn: &[bool]) -> bool {
        self.actions.iter().zip(drawn).filter(|(_, drawn)| **drawn).flat_map(|(actions, _)| actions).any(|action| {
            match action {
                Action::SetWidth(_) | Action::ScaleWidth(_) => true,
                Action::Push => self.width_factor != 1.0,
                _ => false,
            }
        })
    }

    /// The default length in units of [`Turtle::unit`]: 0 if the step is zero or not finite, 1 otherwise.
    pub(in crate::turtle) fn steps(&self) -> f64 {
        if self.step == 0.0 || !self.step.is_finite() { 0.0 } else { 1.0 }
    }

    /// The step length in model units; 1 if the step is zero or not finite.
    pub(in crate::turtle) fn unit(&self) -> f64 {
        if self.steps() == 0.0 { 1.0 } else { self.step }
    }

    /// The triangles of a surface; none if the system has no surface of this name.
    pub(in crate::turtle) fn surface(&self, name: char) -> &[Triangle] {
        self.surfaces.iter().find(|(own, _)| *own == name).map_or(&[], |(_, triangles)| triangles)
    }

    /// A length in units of [`Turtle::unit`]; the step if there is none.
    pub(in crate::turtle) fn in_steps(&self, length: Option<f64>) -> f64 {
        length.map_or(self.steps(), |length| finite(length / self.unit()))
    }
}
