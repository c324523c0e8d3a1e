//! Systems with names, such as those of a gallery, which a search tries before all others.

use crate::drawn::without_spaces;
use crate::overlay::Overlay;
use crate::picture::Picture;
use crate::{Drawn, Found, Named, Question};
use lsystem_base::sorted;
use lsystem_drawing::System;
use lsystem_syntax::{Action, Definition};
use std::sync::Arc;

impl Named {
    /// The system, if it may be the one that is asked for.
    pub(crate) fn compiled(&self, question: &Question) -> Option<System> {
        let Definition { axiom, angle, heading, .. } = &self.definition;
        let is_axiom = |known: &String| without_spaces(known) == without_spaces(axiom);
        let is_near = |known: f64, own: f64| ((known - own) % 360.0).abs() < 0.01;
        let may_be = question.axiom.as_ref().is_none_or(is_axiom)
            && question.angle.is_none_or(|known| is_near(known, *angle))
            && question.heading.is_none_or(|known| is_near(known, *heading));
        let system = System::new(&self.definition).ok().filter(|system| may_be && !system.is_solid())?;
        let own = drawing_letters(&system);
        let is_drawing = |known: &String| {
            let all = known.chars().chain(own.chars());
            let occurs = |letter: &char| system.rules.letters.iter().any(|own| own.symbol == *letter);
            all.filter(occurs).all(|letter| known.contains(letter) == own.contains(letter))
        };
        question.draws.as_ref().is_none_or(is_drawing).then_some(system)
    }

    /// The system after `n` steps, if it can be laid on the picture; and the work in systems that are unlike the picture.
    pub(crate) fn drawn(self: &Arc<Self>, system: &System, n: u32, picture: &Picture) -> (Option<Drawn>, u64) {
        let Some(overlay) = Overlay::of(system, n, picture) else { return (None, 0) };
        let Definition { axiom, angle, heading, .. } = &self.definition;
        let drawn = Drawn {
            axiom: axiom.clone(),
            found: Found { rules: Vec::new(), n },
            draws: drawing_letters(system),
            angle: *angle,
            heading: *heading,
            agreement: overlay.agreement,
            named: Some(self.clone()),
        };
        (Some(drawn), overlay.work)
    }
}

/// The letters of a system that draw, in their order.
fn drawing_letters(system: &System) -> String {
    let draws = |actions: &Vec<Action>| {
        actions.iter().any(|action| matches!(action, Action::Draw(_) | Action::DrawUnmarked(_)))
    };
    let letters = system.rules.letters.iter().zip(&system.turtle.actions);
    let mut letters: Vec<char> =
        letters.filter(|(_, actions)| draws(actions)).map(|(letter, _)| letter.symbol).collect();
    sorted::sort(&mut letters);
    letters.dedup();
    letters.into_iter().collect()
}
