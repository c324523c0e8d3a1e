//! The TikZ library `lindenmayersystems`.
//!
//! ```text
//! \pgfdeclarelindenmayersystem{Koch curve}{ \rule{F -> F-F++F-F} }
//! \draw [l-system={Koch curve, axiom=F++F++F, order=3, angle=60, step=2pt}] l-system;
//! ```

use super::draft::Draft;
use super::plain::{Plain, line_of};
use lsystem_syntax::decimal;

/// Reads every declared system with the options of its first use, and every rule set among options.
pub(super) fn read(text: &str) -> Option<Vec<Draft>> {
    if !text.contains("l-system") && !text.contains("lindenmayer") {
        return None;
    }
    let uses: Vec<&str> = text.match_indices("l-system").filter_map(|(at, _)| options(&text[at + 8..])).collect();
    let mut entries = Vec::new();
    for (at, mark) in text.match_indices("\\pgfdeclarelindenmayersystem") {
        let rest = &text[at + mark.len()..];
        let Some((name, after)) = group(rest) else { continue };
        let Some((body, _)) = group(after) else { continue };
        let mut draft = Plain::new(name, line_of(text, at));
        let line = line_of(text, at);
        for (place, mark) in body.match_indices("\\rule") {
            if let Some((rule, _)) = group(&body[place + mark.len()..]) {
                add_rule(rule, &mut draft, line);
            }
        }
        for (place, mark) in body.match_indices("\\symbol") {
            if let Some((symbol, after)) = group(&body[place + mark.len()..])
                && let Some((code, _)) = group(after)
            {
                add_symbol(symbol, code, &mut draft, line);
            }
        }
        let own = uses.iter().find(|options| options.split(',').any(|option| option.trim() == name.trim()));
        entries.push(finish(draft, own.or(uses.first()).copied().unwrap_or(""), line));
    }
    for options in uses {
        if let Some(at) = options.find("rule set") {
            let mut draft = Plain::new("", 1);
            let rest = options[at + 8..].trim_start().trim_start_matches('=');
            let (set, _) = group(rest).unwrap_or((rest, ""));
            set.split(',').filter(|rule| rule.contains("->")).for_each(|rule| add_rule(rule, &mut draft, 1));
            entries.push(finish(draft, options, 1));
        }
    }
    (!entries.is_empty()).then_some(entries)
}

/// The text between the braces at the start, and the rest.
fn group(text: &str) -> Option<(&str, &str)> {
    let inner = text.trim_start().strip_prefix('{')?;
    let mut depth = 1_usize;
    for (at, ch) in inner.char_indices() {
        match ch {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((&inner[..at], &inner[at + 1..]));
        }
    }
    None
}

/// The options behind `l-system`, in braces.
fn options(text: &str) -> Option<&str> {
    group(text.trim_start().trim_start_matches('=')).map(|(options, _)| options)
}

fn add_rule(rule: &str, draft: &mut Plain, line: usize) {
    let Some((predecessor, successor)) = rule.split_once("->") else {
        return draft.draft.refuse(line, rule, "This rule has no arrow");
    };
    let mut letters = predecessor.trim().chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) => draft.produce(letter, successor, None),
        _ => draft.draft.refuse(line, rule, "A rule for more than one plain symbol is not read"),
    }
}

/// The meaning of a symbol, by the commands of its code.
fn add_symbol(symbol: &str, code: &str, draft: &mut Plain, line: usize) {
    let Some(letter) = symbol.trim().chars().next() else { return };
    let commands = [
        ("drawforward", "draw"),
        ("moveforward", "move"),
        ("turnleft", "turn left"),
        ("turnright", "turn right"),
        ("savestate", "open branch"),
        ("restorestate", "close branch"),
    ];
    let known = commands.iter().find(|(command, _)| code.contains(command));
    match known {
        Some((_, actions)) => draft.draft.meaning(letter, *actions),
        None if code.trim().is_empty() => draft.draft.meaning(letter, "nothing"),
        None => draft.draft.refuse(line, code, format!("The meaning of `{letter}` is TeX code, which is not read")),
    }
}

fn finish(mut draft: Plain, options: &str, line: usize) -> Draft {
    let option = |name: &str| {
        options.split(',').find_map(|option| {
            let (key, value) = option.split_once('=')?;
            (key.trim().trim_start_matches('{') == name).then(|| value.trim().trim_matches(['{', '}']))
        })
    };
    match option("axiom") {
        Some(axiom) => draft.start(axiom),
        None => {
            draft.start("F");
            draft.draft.note(line, "", "There is no axiom; F is taken");
        }
    }
    // The library's own values, where an option is missing.
    draft.definition().angle = option("angle").and_then(decimal::read).unwrap_or(90.0);
    draft.iterate(option("order").and_then(decimal::read).unwrap_or(1.0));
    draft.definition().heading = 0.0;
    for option in ["randomize step percent", "randomize angle percent"] {
        if options.contains(option) {
            draft.draft.note(line, option, "The variation is not carried over; set it under Growth");
        }
    }
    draft.into_draft()
}
