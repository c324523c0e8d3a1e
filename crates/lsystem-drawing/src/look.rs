//! The look of systems whose author chose none: what the turtle's actions say about the drawing decides.

use lsystem_base::word;
use lsystem_syntax::{Action, ColourBy, Style};

/// The kind of a drawing, as far as its look goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Branches in the plane: a thick stem, thinner branches, colours by level.
    Plant,
    /// Branches in space: the same with stouter tubes.
    Tree,
    /// A line without branches in the plane: thin against its own segments, colours along the path.
    Curve,
    /// The same in space.
    Path,
    /// Surfaces without lines.
    Surface,
}

/// A width in steps that exceeds the limit in every drawing, so that the limit decides alone.
const AT_LIMIT: f64 = 1e6;

impl Look {
    /// The look for a turtle with these actions.
    #[must_use]
    pub fn of(actions: &[Action], is_solid: bool) -> Self {
        let draws = actions.iter().any(|action| matches!(action, Action::Draw(_) | Action::DrawUnmarked(_)));
        match (actions.contains(&Action::Push), is_solid) {
            _ if !draws => Self::Surface,
            (true, false) => Self::Plant,
            (true, true) => Self::Tree,
            (false, false) => Self::Curve,
            (false, true) => Self::Path,
        }
    }

    /// In words, for people.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Plant => word!("Branches: a thick stem, thinner branches, colours by level."),
            Self::Tree => word!("Branches in space: a thick trunk, thinner boughs, colours by level."),
            Self::Curve => word!("A line: thinner than its segments are long, colours along the way."),
            Self::Path => word!("A line in space: a tube, colours along the way."),
            Self::Surface => word!("Surfaces without lines: colours by symbol."),
        }
    }

    /// The style with this look. Widths and colours that `actions` set are kept.
    #[must_use]
    pub fn applied(self, style: &Style, actions: &[Action]) -> Style {
        let any = |wanted: fn(&Action) -> bool| actions.iter().any(wanted);
        let sets_width = any(|action| matches!(action, Action::SetWidth(_)));
        let scales_width = any(|action| matches!(action, Action::ScaleWidth(_)));
        let sets_colour = any(|action| matches!(action, Action::SetColour(_) | Action::AddColour(_)));
        let (width, width_factor, min_width, max_width) = match self {
            Self::Plant => (AT_LIMIT, 0.7, 0.7, 1.1),
            Self::Tree => (AT_LIMIT, 0.66, 0.6, 2.5),
            Self::Curve => (0.3, 1.0, 0.9, 1.2),
            Self::Path => (0.3, 1.0, 0.9, 2.5),
            Self::Surface => (style.width, style.width_factor, style.min_width, style.max_width),
        };
        let colour_by = match self {
            _ if sets_colour => ColourBy::Symbol,
            Self::Surface => ColourBy::Symbol,
            Self::Plant | Self::Tree => ColourBy::Level,
            Self::Curve | Self::Path => ColourBy::Path,
        };
        let palette_holds = colour_by == ColourBy::Level || style.palette_holds;
        let looks = Style { colour_by, palette_holds, ..style.clone() };
        if sets_width {
            return looks;
        }
        // Rules that scale widths say how branches become thinner.
        let width_factor = if scales_width { 1.0 } else { width_factor };
        Style { width, width_factor, min_width, max_width, ..looks }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::System;
    use lsystem_syntax::Definition;

    fn system(axiom: &str, rules: &str) -> System {
        let style = Style { auto: true, ..Style::default() };
        System::new(&Definition {
            axiom: axiom.into(),
            rules: rules.into(),
            angle: 25.0,
            style,
            ..Definition::default()
        })
        .unwrap()
    }

    #[test]
    fn the_drawing_decides() {
        for (axiom, rules, look) in [
            ("F", "F -> F[+F]F", Look::Plant),
            ("A", "A -> F[&A]////[^A]/FA", Look::Tree),
            ("F", "F -> F+F--F+F", Look::Curve),
            ("F", "F -> F&F^F", Look::Path),
            ("[X]+[X]", "X -> X", Look::Surface),
            // A branch that never occurs does not count.
            ("F", "F -> F+F\nX -> [X]", Look::Curve),
        ] {
            let system = system(axiom, rules);
            assert_eq!(system.look(), look, "{rules}");
            assert_eq!(system.turtle.width, system.style.width);
        }
    }

    #[test]
    fn widths_and_colours_of_the_rules_are_kept() {
        let own = system("X", "X -> !(3)F'[+X]X").style;
        assert_eq!((own.width, own.colour_by), (Style::default().width, ColourBy::Symbol));
        let thinner = system("X", "X -> !F[+X]X").style;
        assert_eq!((thinner.width, thinner.width_factor), (AT_LIMIT, 1.0));
        let plain = system("X", "X -> F[+X]X").style;
        assert_eq!((plain.width, plain.colour_by, plain.palette_holds), (AT_LIMIT, ColourBy::Level, true));
    }

    /// Along no line there is no way for colours to follow.
    #[test]
    fn surfaces_have_the_colours_of_their_symbols() {
        let style = system("[X]+[X]", "X -> X").style;
        let own = Style::default();
        assert_eq!((style.colour_by, style.width, style.max_width), (ColourBy::Symbol, own.width, own.max_width));
    }

    #[test]
    fn other_styles_are_kept() {
        let style = Style { width: 3.0, ..Style::default() };
        let definition = Definition { axiom: "F".into(), rules: "F -> F[+F]".into(), style, ..Definition::default() };
        assert_eq!(System::new(&definition).unwrap().style, definition.style);
    }
}
