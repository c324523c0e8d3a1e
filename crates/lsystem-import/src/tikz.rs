//! TikZ's library `lindenmayersystems`.
//!
//! ```text
//! \pgfdeclarelindenmayersystem{Koch}{\rule{F -> F-F++F-F}}
//! \draw [l-system={Koch, axiom=F++F++F, order=3, angle=60}] lindenmayer system;
//! \draw [l-system={rule set={F -> FF}, axiom=F}] lindenmayer system;
//! ```
//!
//! The turtle starts to the right. Angles are 90 degrees where they are missing. `F` draws, `f` moves,
//! `+ - [ ]` turn and branch; `\symbol` gives other symbols one of these actions.

use crate::draft::{Draft, production};
use crate::rules::split_rule;
use crate::source::Source;
use lsystem_base::number::number;
use lsystem_syntax::{Grammar, Module};

/// A declared system.
struct Declared<'a> {
    name: &'a str,
    body: &'a str,
}

/// The library's commands, in the words of custom symbols.
const COMMANDS: [(&str, &str); 6] = [
    ("\\pgflsystemdrawforward", "draw"),
    ("\\pgflsystemmoveforward", "move"),
    ("\\pgflsystemturnleft", "turn left"),
    ("\\pgflsystemturnright", "turn right"),
    ("\\pgflsystemsavestate", "open branch"),
    ("\\pgflsystemrestorestate", "close branch"),
];

/// The most declarations and the most uses that are read.
const MOST: usize = 500;

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let mut declared = Vec::new();
    for (at, mark) in text.match_indices("\\pgfdeclarelindenmayersystem").take(MOST) {
        let rest = &text[at + mark.len()..];
        let Some((name, after)) = group(rest) else { continue };
        let Some((body, _)) = group(after) else { continue };
        declared.push(Declared { name: name.trim(), body });
    }
    let mut drafts = Vec::new();
    let mut used = Vec::new();
    for key in ["l-system", "lindenmayer system"] {
        for (at, mark) in text.match_indices(key).take(MOST) {
            let rest = text[at + mark.len()..].trim_start();
            let Some((options, _)) = rest.strip_prefix('=').and_then(group) else { continue };
            let line = source.line_of(at);
            let (draft, name) = system(source, options, &declared, line);
            used.extend(name);
            drafts.push((at, draft));
        }
    }
    // A name in a style or in a path may stand without options.
    for one in declared.iter().filter(|one| !used.iter().any(|name: &String| name == one.name)).take(100) {
        let at = one.body.as_ptr() as usize - text.as_ptr() as usize;
        let mut draft = Draft::new(source, one.name, source.line_of(at));
        draft.refuse(source.line_of(at), one.name, "The text gives no axiom for this system");
        drafts.push((at, draft));
    }
    drafts.sort_by_key(|(at, _)| *at);
    let drafts: Vec<Draft> = drafts.into_iter().map(|(_, draft)| draft).collect();
    (!drafts.is_empty()).then_some(drafts)
}

/// The text in the braces at the start of a text, and the text behind. At most 10,000 characters are searched.
fn group(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start();
    let inside = text.strip_prefix('{')?;
    let mut depth = 1_usize;
    for (at, ch) in inside.char_indices().take(10_000) {
        match ch {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((&inside[..at], &inside[at + 1..]));
        }
    }
    None
}

/// The options between commas outside braces.
fn options(text: &str) -> Vec<&str> {
    let mut depth = 0_usize;
    let split = text.split(|c: char| {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        c == ',' && depth == 0
    });
    split.map(str::trim).filter(|part| !part.is_empty()).collect()
}

fn system<'a>(source: Source<'a>, text: &str, declared: &[Declared<'_>], line: usize) -> (Draft<'a>, Option<String>) {
    let mut draft = Draft::new(source, "", line);
    let mut grammar = Grammar::default();
    let mut name = None;
    let definition = &mut draft.definition;
    (definition.heading, definition.angle) = (0.0, 90.0);
    draft.others = Some("");
    for (symbol, actions) in [('F', "draw"), ('f', "move"), ('+', "turn left"), ('-', "turn right")] {
        draft.meaning(symbol, actions);
    }
    draft.meaning('[', "open branch");
    draft.meaning(']', "close branch");
    for option in options(text) {
        let (key, value) = option.split_once('=').map_or((option, ""), |(key, value)| (key.trim(), value.trim()));
        let value = group(value).map_or(value, |(inside, _)| inside.trim());
        let numeric = |draft: &mut Draft| {
            let number = lsystem_base::decimal::read(value.trim_end_matches('°').trim());
            if number.is_none() {
                draft.refuse(line, option, "This is not a number");
            }
            number.unwrap_or_default()
        };
        match key {
            "axiom" => {
                let symbols = value.chars().filter(|c| !c.is_whitespace());
                grammar.axiom = symbols.map(Module::from).collect();
            }
            "order" => draft.iterations(line, value),
            "angle" => {
                draft.definition.angle = numeric(&mut draft);
                draft.definition.right_angle = None;
            }
            "left angle" => {
                let right = draft.definition.right_angle.unwrap_or(draft.definition.angle);
                draft.definition.angle = numeric(&mut draft);
                draft.definition.right_angle = Some(right);
            }
            "right angle" => draft.definition.right_angle = Some(numeric(&mut draft)),
            "randomize angle percent" => draft.definition.angle_variation = numeric(&mut draft),
            "randomize step percent" => draft.definition.length_variation = numeric(&mut draft),
            "rule set" => options(value).into_iter().for_each(|rule| add_rule(rule, line, &mut grammar, &mut draft)),
            "step" | "anchor" => {}
            _ if value.is_empty() => match declared.iter().rev().find(|one| one.name == key) {
                Some(one) => {
                    name = Some(key.to_owned());
                    draft.definition.name = key.chars().take(200).collect();
                    body(one.body, line, &mut grammar, &mut draft);
                }
                None => draft.refuse(line, option, "The text does not declare this system"),
            },
            _ => draft.note(line, option, "This option is not carried over"),
        }
    }
    if grammar.axiom.is_empty() {
        draft.refuse(line, "", "The text gives no axiom for this system");
    }
    draft.grammar(&grammar);
    (draft, name)
}

/// Reads the body of a declaration.
fn body(text: &str, line: usize, grammar: &mut Grammar, draft: &mut Draft<'_>) {
    for (at, mark) in text.match_indices("\\rule") {
        match group(&text[at + mark.len()..]) {
            Some((rule, _)) => add_rule(rule, line, grammar, draft),
            None => draft.refuse(line, "", "This rule has no braces"),
        }
    }
    for (at, mark) in text.match_indices("\\symbol") {
        let parts =
            group(&text[at + mark.len()..]).and_then(|(symbol, rest)| Some((symbol.trim(), group(rest)?.0.trim())));
        let Some((symbol, code)) = parts else { continue };
        let Some(actions) = actions(code) else {
            draft.refuse(line, code, "The code of this symbol is not run");
            continue;
        };
        if let Some(symbol) = symbol.chars().next() {
            draft.meaning(symbol, actions);
        }
    }
}

/// The actions of a code of known commands, in the words of custom symbols; `None` for other code.
fn actions(code: &str) -> Option<String> {
    let mut found = Vec::new();
    let mut rest = code.trim();
    while !rest.is_empty() {
        if let Some((angle, behind)) = rest.strip_prefix("\\pgftransformrotate").and_then(group) {
            let angle = lsystem_base::decimal::read(angle.trim()).filter(|angle| angle.is_finite())?;
            let side = if angle < 0.0 { "right" } else { "left" };
            found.push(format!("turn {side} {}", number(angle.abs())));
            rest = behind.trim_start();
            continue;
        }
        let (command, words) = COMMANDS.iter().find(|(command, _)| rest.starts_with(command))?;
        found.push((*words).to_owned());
        rest = rest[command.len()..].trim_start();
    }
    Some(found.join(", "))
}

fn add_rule(text: &str, line: usize, grammar: &mut Grammar, draft: &mut Draft<'_>) {
    let (from, to) = split_rule(text).unwrap_or_default();
    let mut letters = from.chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) => {
            grammar.productions.push(production(letter, to.chars().filter(|c| !c.is_whitespace())));
        }
        _ => draft.refuse(line, text, "This rule cannot be read"),
    }
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn cases() {
        check(
            "\\pgfdeclarelindenmayersystem{Koch curve}{\n  \\rule{F -> F-F++F-F}}\n\\begin{tikzpicture}\n\\draw [l-system={Koch curve, axiom=F++F++F, order=3, angle=60, step=2pt}] lindenmayer system;\n\\end{tikzpicture}",
            expect![[r#"
                TikZ
                [Koch curve]
                n 3, angle 60, heading 0, abop
                  F++F++F
                  F -> F-F++F-F"#]],
        );
        check(
            "\\draw [green, l-system={rule set={F -> FF-[-F+F]+[+F-F], X -> f}, axiom=F, order=4, left angle=25, randomize angle percent=25}] l-system;",
            expect![[r#"
                TikZ
                []
                n 4, angle 25, right 90, heading 0, abop
                  F
                  F -> FF-[-F+F]+[+F-F]
                  X -> f"#]],
        );
        check(
            "\\pgfdeclarelindenmayersystem{H}{\\symbol{A}{\\pgflsystemdrawforward}\\symbol{B}{\\code}\\rule{A -> AB}}\n\\draw[lindenmayer system={H, axiom=A, order=2}] (0,0) lindenmayer system; \\pgfdeclarelindenmayersystem{I}{\\rule{F->F}}",
            expect![[r#"
                TikZ
                [H]
                refused 2 "\\code": The code of this symbol is not run
                [I]
                refused 2 "I": The text gives no axiom for this system"#]],
        );
    }
}
