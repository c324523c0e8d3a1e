//! Systems to mark, wrong and right changes of them.

use super::System;

/// Ten systems: the four of the course's assignment and six well-known ones, at small n.
pub(crate) fn systems() -> Vec<System> {
    let system = |name, axiom: &str, rules: &[(char, &str)], angle, n, every_letter| System {
        name,
        axiom: axiom.into(),
        rules: rules.iter().map(|&(symbol, successor)| (symbol, successor.to_owned())).collect(),
        angle,
        n,
        every_letter,
    };
    vec![
        system("left_plant", "F", &[('F', "F[+F]F")], 60.0, 4, true),
        system("crossout", "F+F+F+F", &[('F', "F-FF+F+FF-F")], 90.0, 2, true),
        system("hexerode", "-F+F+F+F+F+F", &[('F', "F-F++F-F")], 60.0, 2, true),
        system("flower_plant", "T", &[('T', "F[+T][-T]"), ('F', "FF")], 120.0, 4, true),
        system("Koch", "F", &[('F', "F+F--F+F")], 60.0, 3, false),
        system("dragon", "X", &[('X', "X+YF"), ('Y', "FX-Y")], 90.0, 6, false),
        system("Hilbert", "X", &[('X', "-YF+XFX+FY-"), ('Y', "+XF-YFY-FX+")], 90.0, 3, false),
        system("plant", "X", &[('X', "F[+X]F[-X]+X"), ('F', "FF")], 20.0, 3, false),
        system("arrowhead", "X", &[('X', "YF+XF+Y"), ('Y', "XF-YF-X")], 60.0, 4, false),
        system("bush", "F", &[('F', "FF-[-F+F]+[+F-F]")], 25.0, 2, false),
    ]
}

/// All texts with one symbol less, another, or one more.
pub(crate) fn one_symbol_edits(text: &str, alphabet: &[char]) -> Vec<String> {
    let symbols: Vec<char> = text.chars().collect();
    let joined = |before: usize, symbol: Option<char>, after: usize| -> String {
        symbols[..before].iter().copied().chain(symbol).chain(symbols[after..].iter().copied()).collect()
    };
    let mut edits = Vec::new();
    for at in 0..=symbols.len() {
        edits.extend(alphabet.iter().map(|&symbol| joined(at, Some(symbol), at)));
        if at < symbols.len() {
            edits.push(joined(at, None, at + 1));
            edits.extend(alphabet.iter().map(|&symbol| joined(at, Some(symbol), at + 1)));
        }
    }
    edits.sort();
    edits.dedup();
    edits
}

/// Other rules with the same picture, with the kind of each change.
pub(crate) fn rewritings(system: &System) -> Vec<(&'static str, System)> {
    let mut found = Vec::new();
    for (index, (_, successor)) in system.rules.iter().enumerate() {
        let places = || (0..=successor.chars().count()).filter(|at| at % 2 == 0);
        for (kind, text) in [
            ("turns that cancel", "+-"),
            ("turns that cancel", "-+"),
            ("an empty branch", "[]"),
            ("a branch without ink", "[+-+]"),
        ] {
            found.extend(places().map(|at| (kind, system.with_rule(index, inserted(successor, at, text)))));
        }
        if !system.every_letter {
            found.extend(
                places().map(|at| ("a letter without effect", system.with_rule(index, inserted(successor, at, "q")))),
            );
        }
        found.extend(
            swapped_branches(successor).map(|text| ("branches in another order", system.with_rule(index, text))),
        );
    }
    found.extend(renamed(system).map(|changed| ("another letter", changed)));
    found.extend(doubled(system).map(|changed| ("two letters in turn", changed)));
    found.extend(subdivided(system).map(|changed| ("shorter segments", changed)));
    found.extend(symmetric(system).map(|changed| ("the other way round", changed)));
    found
}

fn inserted(text: &str, at: usize, what: &str) -> String {
    let symbols: Vec<char> = text.chars().collect();
    symbols[..at].iter().copied().chain(what.chars()).chain(symbols[at..].iter().copied()).collect()
}

/// Two neighbouring branches change places.
fn swapped_branches(text: &str) -> Option<String> {
    let middle = text.find("][")?;
    let start = text[..middle].rfind('[')?;
    let end = middle + 2 + text[middle + 2..].find(']')?;
    let simple = !text[start + 1..middle].contains(']') && !text[middle + 2..end].contains('[');
    simple
        .then(|| format!("{}{}{}{}", &text[..start], &text[middle + 1..=end], &text[start..=middle], &text[end + 1..]))
}

/// A letter that draws nothing gets another name, or a letter that draws one that draws as well.
fn renamed(system: &System) -> Option<System> {
    let (from, to) = match system.rules[0].0 {
        'F' if system.every_letter => ('F', 'K'),
        'F' => ('F', 'G'),
        letter => (letter, 'Z'),
    };
    let rename = |text: &str| text.replace(from, &to.to_string());
    let mut changed = system.clone();
    changed.axiom = rename(&system.axiom);
    changed.rules =
        system.rules.iter().map(|(symbol, text)| (if *symbol == from { to } else { *symbol }, rename(text))).collect();
    Some(changed)
}

/// A second letter with the rule of the first takes its place in every other spot.
fn doubled(system: &System) -> Option<System> {
    let (from, to) = match system.rules[0].0 {
        'F' if system.every_letter => ('F', 'K'),
        'F' => ('F', 'G'),
        letter => (letter, 'Z'),
    };
    let alternate = |text: &str| {
        let mut odd = false;
        let swap = |c: char| {
            odd ^= c == from;
            if c == from && odd { to } else { c }
        };
        text.chars().map(swap).collect::<String>()
    };
    let mut changed = system.clone();
    changed.axiom = alternate(&system.axiom);
    changed.rules.iter_mut().for_each(|rule| rule.1 = alternate(&rule.1));
    let twin = changed.rules[0].1.clone();
    changed.rules.push((to, twin));
    Some(changed)
}

/// Each segment becomes two, where no rule rewrites the letter that draws.
fn subdivided(system: &System) -> Option<System> {
    let has_rule = system.every_letter || system.rules.iter().any(|(symbol, _)| *symbol == 'F');
    let mut changed = system.clone();
    changed.axiom = system.axiom.replace('F', "FF");
    changed.rules.iter_mut().for_each(|rule| rule.1 = rule.1.replace('F', "FF"));
    (!has_rule).then_some(changed)
}

/// The mirror image with the opposite angle.
fn symmetric(system: &System) -> Option<System> {
    let swap = |text: &str| text.replace('+', "*").replace('-', "+").replace('*', "-");
    let mut changed = system.clone();
    changed.axiom = swap(&system.axiom);
    changed.rules.iter_mut().for_each(|rule| rule.1 = swap(&rule.1));
    changed.angle = -system.angle;
    Some(changed)
}
