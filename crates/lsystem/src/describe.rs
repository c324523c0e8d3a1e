//! Systems and drawings in words: the legend of symbols, why nothing is drawn, a picture's text alternative.

use crate::counts::count_segments;
use crate::program::Rewrite;
use crate::{Action, Heading, MAX_ITERATIONS, Production, System, Tally};

/// What one symbol of a system does, for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LegendEntry {
    /// The symbol.
    pub symbol: char,
    /// What it makes the turtle do, in words.
    pub actions: String,
    /// Whether a production replaces it.
    pub rewritten: bool,
}

/// The symbols that occur in any generation, sorted, with what they do.
#[must_use]
pub fn legend(system: &System) -> Vec<LegendEntry> {
    let program = &system.program;
    let reachable = program.reachable();
    (0..program.alphabet.len())
        .filter(|&id| reachable[id])
        .map(|id| {
            let actions: Vec<String> = system.turtle.actions[id].iter().map(|&a| action_words(system, a)).collect();
            LegendEntry {
                symbol: program.alphabet[id],
                actions: if actions.is_empty() { "draws nothing".to_owned() } else { actions.join(", then ") },
                rewritten: !matches!(program.rewrites[id], Rewrite::Keep),
            }
        })
        .fold(Vec::new(), |mut entries: Vec<LegendEntry>, entry| {
            // A symbol with several numbers of parameters is one entry.
            match entries.last_mut() {
                Some(last) if last.symbol == entry.symbol => last.rewritten |= entry.rewritten,
                _ => entries.push(entry),
            }
            entries
        })
}

/// What sort of system it is: `deterministic`, or those of `stochastic`, `context-sensitive`, `parametric` that hold,
/// separated by commas.
#[must_use]
pub fn kind(system: &System) -> String {
    let productions = &system.grammar.productions;
    let parametric = system.rules.as_ref().is_some_and(crate::Rules::is_parametric);
    let kinds = [
        ("stochastic", system.has_choices()),
        ("context-sensitive", productions.iter().any(Production::is_context_sensitive)),
        ("parametric", parametric),
    ];
    let kinds: Vec<&str> = kinds.into_iter().filter(|(_, holds)| *holds).map(|(kind, _)| kind).collect();
    if kinds.is_empty() { "deterministic".to_owned() } else { kinds.join(", ") }
}

fn action_words(system: &System, action: Action) -> String {
    let along = |verb: &str, length: Option<f64>| match length {
        None => format!("{verb} one step"),
        Some(length) => format!("{verb} {length}"),
    };
    let bend = |verb: &str, degrees: Option<f64>, own: Heading| {
        format!("{verb} by {}°", degrees.unwrap_or_else(|| own.degrees()))
    };
    match action {
        Action::Draw(length) | Action::DrawUnmarked(length) => along("draws", length),
        Action::Move(length) | Action::MoveUnmarked(length) => along("moves", length),
        Action::OpenPolygon => "begins a filled polygon".to_owned(),
        Action::Vertex => "is a vertex of the polygon".to_owned(),
        Action::ClosePolygon => "fills the polygon".to_owned(),
        Action::TurnLeft(degrees) => bend("turns left", degrees, system.turtle.left),
        Action::TurnRight(degrees) => bend("turns right", degrees, system.turtle.right),
        Action::PitchDown(degrees) => bend("pitches down", degrees, system.turtle.pitch_down),
        Action::PitchUp(degrees) => bend("pitches up", degrees, system.turtle.pitch_up),
        Action::RollLeft(degrees) => bend("rolls left", degrees, system.turtle.roll_left),
        Action::RollRight(degrees) => bend("rolls right", degrees, system.turtle.roll_right),
        Action::RollUpright => "rolls upright".to_owned(),
        Action::TurnRound => "turns round".to_owned(),
        Action::Cut => "cuts off the rest of its branch in the next step".to_owned(),
        Action::Push => "starts a branch".to_owned(),
        Action::Pop => "ends the branch".to_owned(),
        Action::SetColour(index) => format!("takes colour {index}"),
        Action::AddColour(1) => "takes the next colour".to_owned(),
        Action::AddColour(-1) => "takes the previous colour".to_owned(),
        Action::AddColour(by) => format!("goes {by} colours on"),
        Action::SetWidth(width) => format!("draws {width} steps wide"),
        Action::ScaleWidth(factor) if factor < 1.0 => format!("draws thinner (x {factor:.3})"),
        Action::ScaleWidth(factor) => format!("draws thicker (x {factor:.3})"),
    }
}

/// Why generation `n` draws nothing, or `None` when it draws something or that is up to random choices.
#[must_use]
pub fn why_empty(system: &System, n: u32) -> Option<String> {
    let drawn_at = |n: u32| count_segments(system, n);
    if drawn_at(n)? != Tally::ZERO {
        return None;
    }
    if system.program.axiom.is_empty() {
        return Some("The axiom is empty: type a symbol to start from, for example F.".to_owned());
    }
    // A letter that can be reached at all is reached within as many steps as there are letters.
    let far = (n + 1 + system.program.alphabet.len() as u32).min(MAX_ITERATIONS);
    let first: String = system.program.axiom.iter().take(8).map(|&s| system.program.alphabet[usize::from(s)]).collect();
    for later in n + 1..=far {
        if drawn_at(later).is_some_and(|segments| segments != Tally::ZERO) {
            let subject = if n == 0 { first } else { format!("Generation {n}") };
            return Some(format!("{subject} draws nothing yet: try n = {later}."));
        }
    }
    if n > 0 && drawn_at(0).is_some_and(|segments| segments != Tally::ZERO) {
        return Some("Every symbol that draws has been rewritten away: try fewer iterations.".to_owned());
    }
    Some(
        "No symbol of this system draws: use one that does (F in most dialects), or give one a meaning such as \
         `X: draw`."
            .to_owned(),
    )
}

/// A count for people: whole with separators up to nine digits, then as `1.23 × 10^45`.
#[must_use]
pub fn short_count(count: &Tally) -> String {
    let digits = count.to_string();
    if digits.len() > 9 {
        return format!("{}.{} × 10^{}", &digits[..1], &digits[1..3], digits.len() - 1);
    }
    let mut grouped = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// A picture's text alternative: how much is drawn and how large it is. `bounds` as
/// [`Drawing::bounds`](crate::Drawing::bounds).
#[must_use]
pub fn describe(system: &System, n: u32, segments: &Tally, bounds: Option<[f64; 4]>) -> String {
    let Some([min_x, min_y, max_x, max_y]) = bounds else {
        return why_empty(system, n).unwrap_or_else(|| "Nothing is drawn.".to_owned());
    };
    let steps = if n == 1 { "step" } else { "steps" };
    let lines = if *segments == Tally::from(1_u64) { "line" } else { "lines" };
    let (width, height) = (max_x - min_x, max_y - min_y);
    let form = if width > 3.0 * height {
        "much wider than high"
    } else if height > 3.0 * width {
        "much higher than wide"
    } else if width > 1.25 * height {
        "wider than high"
    } else if height > 1.25 * width {
        "higher than wide"
    } else {
        "about as wide as high"
    };
    let branches = system.turtle.actions.iter().any(|actions| actions.contains(&Action::Push));
    let what = if branches { "A branching figure" } else { "A line figure" };
    let random = if !system.is_stochastic() { "" } else { ", one of many that chance can give" };
    format!("{what} of {} {lines} after {n} derivation {steps}, {form}{random}.", short_count(segments))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_short() {
        let short = |count: u128| short_count(&Tally::from(count));
        assert_eq!(short(0), "0");
        assert_eq!(short(1234), "1,234");
        assert_eq!(short(123_456_789), "123,456,789");
        assert_eq!(short(1_264_937_032_042_997_393_488_322_560), "1.26 × 10^27");
    }
}
