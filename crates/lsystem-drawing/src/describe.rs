//! Systems and drawings in words: the legend of symbols, the reason for an empty picture, a picture's text alternative.
use crate::System;
use crate::drawn::shown_by_letter;
use lsystem_base::sorted::set;
use lsystem_base::{MAX_ITERATIONS, Meter};
use lsystem_derive::{LetterId, Rewrite, Tally, weigh_until};
use lsystem_syntax::message::grouped;
use lsystem_syntax::{Action, Grammar, Heading, Outline, Pattern, Production};

/// A symbol of a system and its actions, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LegendEntry {
    /// The symbol, with the names of its parameters in parentheses, if any: `F(l)`.
    pub module: String,
    /// The turtle's actions, in words.
    pub actions: String,
    /// Whether a production replaces the symbol.
    pub rewritten: bool,
}

/// The symbols that occur in a generation or in an image, sorted, with their actions. A symbol has one entry for each
/// number of parameters.
#[must_use]
pub fn legend(system: &System) -> Vec<LegendEntry> {
    let rules = &system.rules;
    let mut shown = rules.reachable();
    let images = |id: usize| rules.images[id].as_slice();
    for id in 0..shown.len() {
        if shown[id] {
            images(id).iter().flat_map(|image| &image.successor.letters).for_each(|&l| shown[usize::from(l)] = true);
        }
    }
    let Grammar { productions, images: drawn, .. } = &system.grammar;
    let by_predecessor = set(productions.iter().chain(drawn).enumerate().map(|(at, p)| (place_of(&p.predecessor), at)));
    (0..rules.letters.len())
        .filter(|&id| shown[id])
        .map(|id| {
            let symbol = rules.letters[id].symbol;
            let arity = usize::from(rules.letters[id].arity);
            let own = &system.turtle.actions[id];
            let query = rules.query(id as LetterId);
            let from = by_predecessor.partition_point(|&(place, _)| place < (symbol, arity));
            let mine = by_predecessor[from..].iter().take_while(|&&(place, _)| place == (symbol, arity));
            let mine = mine
                .map(|&(_, at)| at.checked_sub(productions.len()).map_or_else(|| &productions[at], |at| &drawn[at]));
            let names = parameters(mine.clone().next().map(|p| &p.predecessor), arity, own.first());
            let actions = if images(id).is_empty() {
                let words = own.iter().enumerate().map(|(at, &action)| match names.first() {
                    Some(name) if at == 0 => numbered_words(system, action, name),
                    _ => action_words(system, action),
                });
                words.collect::<Vec<_>>().join(", then ")
            } else {
                let words: Vec<String> = images(id)
                    .iter()
                    .map(|image| lsystem_syntax::print::successor(&drawn[image.production - productions.len()]))
                    .collect();
                format!("is drawn as {}", words.join(" or "))
            };
            let names = if names.is_empty() { String::new() } else { format!("({})", names.join(",")) };
            LegendEntry {
                module: match query {
                    Some(query) => format!("{query}{names}"),
                    None => format!("{symbol}{names}"),
                },
                actions: match query {
                    Some(query) => query.words().to_owned(),
                    None if actions.is_empty() => "draws nothing".to_owned(),
                    None => actions,
                },
                rewritten: !matches!(rules.rewrites[id], Rewrite::Keep),
            }
        })
        .collect()
}

fn place_of(pattern: &Pattern) -> (char, usize) {
    (pattern.symbol, pattern.parameters.len())
}

/// The names of a symbol's parameters: as in its first production, or else after their use by its first action.
fn parameters(first: Option<&Pattern>, arity: usize, action: Option<&Action>) -> Vec<String> {
    first.map_or_else(
        || {
            let first = match action.map(|action| action.with(1.0)) {
                Some(Action::SetWidth(_)) => "w",
                Some(Action::SetColour(_)) => "c",
                Some(Action::Draw(_) | Action::Move(_) | Action::DrawUnmarked(_) | Action::MoveUnmarked(_)) => "l",
                Some(Action::Circle(_) | Action::Fill(Outline::Disc, _)) => "d",
                Some(Action::Fill(..)) => "l",
                Some(Action::Surface(..)) => "s",
                Some(_) => "a",
                None => "x",
            };
            [first, "y", "z", "u", "v", "p", "q", "r"].into_iter().take(arity).map(str::to_owned).collect()
        },
        |pattern| pattern.parameters.clone(),
    )
}

/// An action whose number is the parameter `name`, in words.
fn numbered_words(system: &System, action: Action, name: &str) -> String {
    match action.with(1.0) {
        Action::Draw(_) | Action::DrawUnmarked(_) => format!("draws {name}"),
        Action::Move(_) | Action::MoveUnmarked(_) => format!("moves {name}"),
        Action::TurnLeft(_) => format!("turns left by {name}°"),
        Action::TurnRight(_) => format!("turns right by {name}°"),
        Action::PitchDown(_) => format!("pitches down by {name}°"),
        Action::PitchUp(_) => format!("pitches up by {name}°"),
        Action::RollLeft(_) => format!("rolls left by {name}°"),
        Action::RollRight(_) => format!("rolls right by {name}°"),
        Action::SetColour(_) => format!("takes colour {name}"),
        Action::SetWidth(_) => format!("draws {name} steps wide"),
        Action::ScaleLength(_) => format!("multiplies lengths by {name}"),
        Action::Circle(_) => format!("draws a circle with the diameter {name}"),
        Action::Fill(Outline::Disc, _) => format!("fills a disc with the diameter {name}"),
        Action::Fill(outline, _) => format!("draws a {} of length {name}", leaf_words(outline)),
        Action::Surface(surface, _) => format!("draws the surface {surface}, {name} in size"),
        _ => action_words(system, action),
    }
}

/// The kind of a system: `deterministic`, or all that hold of `stochastic`, `context-sensitive`, `parametric` and
/// `environmentally sensitive`, separated by commas.
#[must_use]
pub fn kind(system: &System) -> String {
    let productions = &system.grammar.productions;
    let kinds = [
        ("stochastic", system.has_choices()),
        ("context-sensitive", productions.iter().any(Production::is_context_sensitive)),
        ("parametric", system.rules.is_parametric()),
        ("environmentally sensitive", system.rules.asks()),
    ];
    let kinds: Vec<&str> = kinds.into_iter().filter(|(_, holds)| *holds).map(|(kind, _)| kind).collect();
    if kinds.is_empty() { "deterministic".to_owned() } else { kinds.join(", ") }
}

/// A leaf in words.
fn leaf_words(outline: Outline) -> &'static str {
    match outline {
        Outline::Disc => "disc",
        Outline::Lance => "narrow leaf",
        Outline::Heart => "heart-shaped leaf",
        Outline::Oak => "lobed leaf",
        Outline::Needle => "needle",
        Outline::Petal => "petal",
    }
}

fn action_words(system: &System, action: Action) -> String {
    let along = |verb: &str, length: Option<f64>| match length {
        None => format!("{verb} one step"),
        Some(length) => format!("{verb} {length}"),
    };
    let round = |words: &str, diameter: Option<f64>| match diameter {
        None => format!("{words} one step wide"),
        Some(diameter) => format!("{words} {diameter} wide"),
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
        Action::OpenTube => "begins a smooth tube".to_owned(),
        Action::TubePoint => "draws the tube up to here".to_owned(),
        Action::CloseTube => "draws the tube up to here and ends it".to_owned(),
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
        Action::ScaleLength(factor) => format!("multiplies lengths by {factor}"),
        Action::SwapTurns => "exchanges left and right turns".to_owned(),
        Action::Circle(diameter) => round("draws a circle", diameter),
        Action::Fill(Outline::Disc, diameter) => round("fills a disc", diameter),
        Action::Surface(surface, None) => format!("draws the surface {surface}"),
        Action::Surface(surface, Some(size)) => format!("draws the surface {surface}, {size} in size"),
        Action::Fill(outline, length) => along(&format!("draws a {} of length", leaf_words(outline)), length),
    }
}

/// The reason why generation `n` draws nothing. `None` if the generation draws something, if random choices decide, or
/// if the search takes too long.
#[must_use]
pub fn why_empty(system: &System, n: u32) -> Option<String> {
    /// The most units of work for the search.
    const MOST: u64 = 1 << 20;
    if system.rules.is_cutting() {
        return None;
    }
    let drawn = shown_by_letter(system)?;
    // Every reachable letter occurs within as many steps as there are letters.
    let far = (n + 1 + system.rules.letters.len() as u32).min(MAX_ITERATIONS);
    let (mut at_first, mut here, mut later) = (false, None, None);
    let none = drawn.iter().all(|&segments| segments == 0);
    let known = none
        || weigh_until(
            &system.rules,
            far.max(n),
            |symbol| drawn[usize::from(symbol)],
            &mut Meter::new(MOST),
            |generation, drawn| {
                let draws = drawn == Some(true);
                at_first |= generation == 0 && draws;
                if generation == n {
                    here = drawn;
                }
                later = (generation > n && draws).then_some(generation);
                later.is_some() || (generation == n && drawn != Some(false))
            },
        );
    if !known || !none && here != Some(false) {
        return None;
    }
    if system.rules.axiom.letters.is_empty() {
        return Some("The axiom is empty: type a symbol to start from, for example F.".to_owned());
    }
    let first: String =
        system.rules.axiom.letters.iter().take(8).map(|&s| system.rules.letters[usize::from(s)].symbol).collect();
    if let Some(later) = later {
        let subject = if n == 0 { first } else { format!("Generation {n}") };
        return Some(format!("{subject} draws nothing yet: try n = {later}."));
    }
    if n > 0 && at_first {
        return Some("Every symbol that draws has been rewritten away: try fewer iterations.".to_owned());
    }
    let moves = |actions: &[Action]| matches!(actions, [Action::Move(_) | Action::MoveUnmarked(_)]);
    let mut letters = system.rules.letters.iter().zip(&system.turtle.actions);
    if let Some((letter, _)) = letters.find(|(letter, actions)| letter.symbol.is_lowercase() && moves(actions)) {
        let (small, large) = (letter.symbol, letter.symbol.to_ascii_uppercase());
        return Some(format!("{small} moves without a line: write a capital {large} to draw."));
    }
    let mut first = system.rules.axiom.letters.iter().map(|&letter| usize::from(letter));
    let unwritten = |&letter: &usize| {
        system.rules.letters[letter].symbol.is_alphabetic() && system.rules.by_letter[letter].is_empty()
    };
    if let Some(letter) = first.find(unwritten) {
        return Some(format!("Write a rule for {}: nothing replaces it.", system.rules.letters[letter].symbol));
    }
    Some(
        "No symbol of this system draws: use one that does (F in most dialects), or give one a meaning such as \
         `X: draw`."
            .to_owned(),
    )
}

/// A count in words: with separators up to nine digits, then as `1.23 × 10^45` (rounded down).
#[must_use]
pub(crate) fn short_count(count: &Tally) -> String {
    let digits = count.to_string();
    if digits.len() > 9 {
        return format!("{}.{} × 10^{}", &digits[..1], &digits[1..3], digits.len() - 1);
    }
    grouped(&digits)
}

/// A picture's text alternative: the number of lines, the proportions and the number of shared blocks. `blocks` is
/// `None` if the drawing shares no blocks; `bounds` as [`Drawing::bounds`](crate::Drawing::bounds).
pub(crate) fn describe(
    system: &System,
    n: u32,
    segments: &Tally,
    blocks: Option<usize>,
    bounds: Option<[f64; 4]>,
) -> String {
    let Some([min_x, min_y, max_x, max_y]) = bounds else {
        return why_empty(system, n).unwrap_or_else(|| "Nothing is drawn.".to_owned());
    };
    let steps = if n == 1 { "step" } else { "steps" };
    let lines = if *segments == Tally::from(1_u64) { "line" } else { "lines" };
    let (width, height) = (max_x - min_x, max_y - min_y);
    let form = if width > 3.0 * height {
        "much wider than high"
    } else if height > 3.0 * width {
        "much taller than wide"
    } else if width > 1.25 * height {
        "wider than high"
    } else if height > 1.25 * width {
        "taller than wide"
    } else {
        "about as wide as high"
    };
    let branches = system.turtle.actions.iter().any(|actions| actions.contains(&Action::Push));
    let what = if branches { "A branching figure" } else { "A line figure" };
    let random = if !system.is_stochastic() { "" } else { ", one of many that chance can give" };
    let made = match blocks {
        None => "Every symbol was derived by itself.".to_owned(),
        Some(1) => "One piece makes it up.".to_owned(),
        Some(blocks) => format!("{blocks} shared pieces make it up."),
    };
    format!("{what} of {} {lines} after {n} derivation {steps}, {form}{random}. {made}", short_count(segments))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn legend_of(axiom: &str, rules: &str) -> Vec<(String, String)> {
        let definition = lsystem_syntax::Definition {
            axiom: axiom.into(),
            rules: rules.into(),
            angle: 20.0,
            ..lsystem_syntax::Definition::default()
        };
        let system = System::new(&definition).0.unwrap();
        legend(&system).into_iter().map(|entry| (entry.module, entry.actions)).collect()
    }

    #[test]
    fn the_legend_tells_of_parameters_and_images() {
        let told = |legend: &[(String, String)], module: &str| {
            legend.iter().find(|(name, _)| name == module).map(|(_, actions)| actions.clone()).unwrap_or_default()
        };
        let tree = legend_of("A(1,2)", "A(len,wid) -> !(wid)F(len)[+(30)A(len/2,wid)]F+");
        assert_eq!(told(&tree, "A(len,wid)"), "draws nothing");
        assert_eq!(told(&tree, "F(l)"), "draws l");
        assert_eq!(told(&tree, "F"), "draws one step");
        assert_eq!(told(&tree, "+(a)"), "turns left by a°");
        assert_eq!(told(&tree, "+"), "turns left by 20°");
        assert_eq!(told(&tree, "!(w)"), "draws w steps wide");
        assert_eq!(told(&tree, "["), "starts a branch");
        let drawn = legend_of("A(1)", "A(x) -> A(x*2)\ndraw:\nA(x) : x > 1 -> F(x)+\nA(x) -> f(x)");
        assert_eq!(told(&drawn, "A(x)"), "is drawn as F(x)+ or f(x)");
        assert_eq!(told(&drawn, "f(l)"), "moves l");
    }

    #[test]
    fn counts_are_short() {
        let short = |count: u128| short_count(&Tally::from(count));
        assert_eq!(short(0), "0");
        assert_eq!(short(1234), "1,234");
        assert_eq!(short(123_456_789), "123,456,789");
        assert_eq!(short(1_264_937_032_042_997_393_488_322_560), "1.26 × 10^27");
    }
}
