//! Systems and drawings in words: the legend of symbols, the reason for an empty picture, a picture's text alternative.
use crate::System;
use crate::drawn::shown_by_letter;
use lsystem_base::sorted::set;
use lsystem_base::words::{grouped, said, shown};
use lsystem_base::{MAX_ITERATIONS, Meter, counted, say, word};
use lsystem_derive::{LetterId, Rewrite, Tally, weigh_until};
use lsystem_syntax::{Action, Grammar, NumberForm, Pattern, Production};

/// A symbol of a system and its actions, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LegendEntry {
    /// The symbol, with the names of its parameters in parentheses, if any: `F(l)`.
    pub module: String,
    /// The turtle's actions, in words.
    pub actions: String,
    /// Whether the turtle does nothing at the symbol.
    pub idle: bool,
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
                    Some(name) if at == 0 => numbered_words(action, name),
                    _ => action_words(system, action),
                });
                words.reduce(|first, then| say!("{}, then {}", first, then)).unwrap_or_default()
            } else {
                let words = images(id)
                    .iter()
                    .map(|image| lsystem_syntax::print::successor(&drawn[image.production - productions.len()]));
                say!("is drawn as {}", words.reduce(|one, other| say!("{} or {}", one, other)).unwrap_or_default())
            };
            let names = if names.is_empty() { String::new() } else { format!("({})", names.join(",")) };
            LegendEntry {
                module: match query {
                    Some(query) => format!("{query}{names}"),
                    None => format!("{symbol}{names}"),
                },
                idle: query.is_none() && actions.is_empty(),
                actions: match query {
                    Some(query) => said(query.words()),
                    None if actions.is_empty() => say!("draws nothing"),
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
            let first = action.map_or("x", |action| action.with(1.0).row().letter);
            [first, "y", "z", "u", "v", "p", "q", "r"].into_iter().take(arity).map(str::to_owned).collect()
        },
        |pattern| pattern.parameters.clone(),
    )
}

/// An action whose number is the parameter `name`, in words.
fn numbered_words(action: Action, name: &str) -> String {
    match action {
        Action::Surface(surface, _) => say!(action.row().numbered, surface, name),
        _ => say!(action.with(1.0).row().numbered, name),
    }
}

/// The kind of a system: `deterministic`, or all that hold of `stochastic`, `context-sensitive`, `parametric` and
/// `environmentally sensitive`, separated by commas.
#[must_use]
pub fn kind(system: &System) -> String {
    let productions = &system.grammar.productions;
    let kinds = [
        (word!("stochastic"), system.has_choices()),
        (word!("context-sensitive"), productions.iter().any(Production::is_context_sensitive)),
        (word!("parametric"), system.rules.is_parametric()),
        (word!("environmentally sensitive"), system.rules.asks()),
    ];
    let kinds: Vec<&str> = kinds.into_iter().filter(|(_, holds)| *holds).map(|(kind, _)| kind).collect();
    if kinds.is_empty() { word!("deterministic").to_owned() } else { kinds.join(", ") }
}

fn action_words(system: &System, action: Action) -> String {
    let figure = |value: f64| shown(&value.to_string());
    let (row, number) = (action.row(), action.number().map(figure));
    match action {
        Action::AddColour(1) => say!("takes the next colour"),
        Action::AddColour(-1) => say!("takes the previous colour"),
        Action::ScaleWidth(factor) => {
            let text = if factor < 1.0 { word!("draws thinner (x {})") } else { word!("draws thicker (x {})") };
            say!(text, shown(&format!("{factor:.3}")))
        }
        Action::Surface(surface, _) => match number {
            None => say!(row.legend, surface),
            Some(size) => say!(row.numbered, surface, size),
        },
        _ => match row.form {
            NumberForm::Length(_) => say!(row.legend, number.unwrap_or_else(|| say!("one step"))),
            NumberForm::Angle(_) => {
                say!(row.legend, number.unwrap_or_else(|| figure(system.turtle.angle(action).degrees())))
            }
            _ => say!(row.legend, number.unwrap_or_default()),
        },
    }
}

/// The reason why generation `n` draws nothing. `None` if the generation draws something, if random choices decide, or
/// if the search takes too long.
#[must_use]
pub fn why_empty(system: &System, n: u32) -> Option<String> {
    /// The most units of work for the search.
    const MAX: u64 = 1 << 20;
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
            &mut Meter::new(MAX),
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
        return Some(say!("The axiom is empty: type a symbol to start from, for example F."));
    }
    let first: String =
        system.rules.axiom.letters.iter().take(8).map(|&s| system.rules.letters[usize::from(s)].symbol).collect();
    if let Some(later) = later {
        return Some(if n == 0 {
            say!("{} draws nothing yet: try n = {}.", first, later)
        } else {
            say!("Generation {} draws nothing yet: try n = {}.", n, later)
        });
    }
    if n > 0 && at_first {
        return Some(say!("Every symbol that draws has been rewritten away: try fewer iterations."));
    }
    let moves = |actions: &[Action]| matches!(actions, [Action::Move(_) | Action::MoveUnmarked(_)]);
    let mut letters = system.rules.letters.iter().zip(&system.turtle.actions);
    if let Some((letter, _)) = letters.find(|(letter, actions)| letter.symbol.is_lowercase() && moves(actions)) {
        let (small, large) = (letter.symbol, letter.symbol.to_ascii_uppercase());
        return Some(say!("{} moves without a line: write a capital {} to draw.", small, large));
    }
    let mut first = system.rules.axiom.letters.iter().map(|&letter| usize::from(letter));
    let unwritten = |&letter: &usize| {
        system.rules.letters[letter].symbol.is_alphabetic() && system.rules.by_letter[letter].is_empty()
    };
    if let Some(letter) = first.find(unwritten) {
        return Some(say!("Write a rule for {}: nothing replaces it.", system.rules.letters[letter].symbol));
    }
    Some(say!(
        "No symbol of this system draws: use one that does (F in most dialects), or give one a meaning such as \
         `X: draw`."
    ))
}

/// A count in words: with separators up to nine digits, then as `1.23 × 10^45` (rounded down).
#[must_use]
pub(crate) fn short_count(count: &Tally) -> String {
    let digits = count.to_string();
    if digits.len() > 9 {
        return format!("{} × 10^{}", shown(&format!("{}.{}", &digits[..1], &digits[1..3])), digits.len() - 1);
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
        return why_empty(system, n).unwrap_or_else(|| say!("Nothing is drawn."));
    };
    let (width, height) = (max_x - min_x, max_y - min_y);
    let form = if width > 3.0 * height {
        say!("much wider than high")
    } else if height > 3.0 * width {
        say!("much taller than wide")
    } else if width > 1.25 * height {
        say!("wider than high")
    } else if height > 1.25 * width {
        say!("taller than wide")
    } else {
        say!("about as wide as high")
    };
    let (number, lines) = (segments.to_string().parse().unwrap_or(u64::MAX), short_count(segments));
    let branches = system.turtle.actions.iter().any(|actions| actions.contains(&Action::Push));
    let what = if branches {
        counted!(number, "A branching figure of {1} line", "A branching figure of {1} lines", lines)
    } else {
        counted!(number, "A line figure of {1} line", "A line figure of {1} lines", lines)
    };
    let after = counted!(n, "after {1} derivation step", "after {1} derivation steps", n);
    let made = match blocks {
        None => say!("Every symbol was derived by itself."),
        Some(1) => say!("One piece makes it up."),
        Some(blocks) => say!("{} shared pieces make it up.", blocks),
    };
    if system.is_stochastic() {
        say!("{} {}, {}, one of many that chance can give. {}", what, after, form, made)
    } else {
        format!("{what} {after}, {form}. {made}")
    }
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
        let system = System::new(&definition).unwrap();
        let entries = legend(&system);
        assert!(entries.iter().all(|entry| entry.idle == (entry.actions == "draws nothing")), "{entries:?}");
        entries.into_iter().map(|entry| (entry.module, entry.actions)).collect()
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
