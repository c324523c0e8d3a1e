//! Racket's `#lang lindenmayer`.
//!
//! ```text
//! #lang lindenmayer racket
//! ## axiom ##
//! F
//! ## rules ##
//! F -> FF-
//!      [-F+F+F]
//! ## variables ##
//! n=4
//! θ=22.5
//! ```
//!
//! Several systems are separated by a line of `-`. Racket code follows a line of `=`; it decides what the symbols do
//! and is not run. With the library `lindenmayer/turtle` the symbols are known: F draws and f moves by 2, the numbers
//! of + and
//! - are factors of θ, and ! sets the width.

use crate::draft::Draft;
use crate::rules::split_rule;
use lsystem_base::decimal;
use std::collections::BTreeSet;

pub(super) fn read(text: &str) -> Option<Vec<Draft>> {
    let first = text.lines().find(|line| !line.trim().is_empty())?;
    let has = |name: &str| text.lines().any(|line| heading(line).is_some_and(|found| found == name));
    if !(first.trim().starts_with("#lang lindenmayer") || has("axiom") && has("rules")) {
        return None;
    }
    let is_rule_of = |line: &str, mark: char| line.len() >= 3 && line.chars().all(|c| c == mark);
    let mut parts: Vec<(usize, Vec<(usize, &str)>)> = vec![(1, Vec::new())];
    let mut code = "";
    let mut offset = 0;
    for (at, line) in text.split('\n').enumerate() {
        offset += line.len() + 1;
        let trimmed = line.trim();
        if is_rule_of(trimmed, '=') {
            code = text.get(offset..).unwrap_or_default();
            break;
        }
        if is_rule_of(trimmed, '-') {
            parts.push((at + 2, Vec::new()));
        } else if !trimmed.is_empty()
            && !trimmed.starts_with("#lang")
            && let Some(part) = parts.last_mut()
        {
            part.1.push((at + 1, trimmed));
        }
    }
    let code = Code::new(code);
    parts.retain(|part| !part.1.is_empty());
    // One more than the limit, so that the limit is reported.
    parts.truncate(super::MAX_ENTRIES + 1);
    Some(parts.iter().map(|(line, lines)| system(*line, lines, &code)).collect())
}

/// The facts about the Racket code behind the systems.
struct Code<'a> {
    /// The first line.
    first: &'a str,
    /// Whether the symbols are those of `lindenmayer/turtle`.
    library: bool,
    /// The first positive number of degrees that the code turns by.
    turn: Option<f64>,
}

impl<'a> Code<'a> {
    fn new(code: &'a str) -> Self {
        // `(define (+ turtles variables) (turn 90 turtles))`
        let turns = code.split("(turn ").skip(1).filter_map(|rest| decimal::read(rest.split([' ', ')']).next()?));
        Self {
            first: code.trim().lines().next().unwrap_or_default(),
            library: code.contains("lindenmayer/turtle") || code.trim().is_empty(),
            turn: turns.into_iter().find(|angle| *angle > 0.0 && angle.is_finite()),
        }
    }
}

/// The name of a section: `## axiom ##`.
fn heading(line: &str) -> Option<&str> {
    let name = line.trim().strip_prefix("##")?.trim_end_matches('#').trim();
    (!name.is_empty()).then_some(name)
}

fn system(line: usize, lines: &[(usize, &str)], code: &Code<'_>) -> Draft {
    let mut draft = Draft::new("", line);
    let library = code.library;
    let (mut section, mut axiom) = ("", String::new());
    let mut rules: Vec<String> = Vec::new();
    let mut variables: Vec<(String, String)> = Vec::new();
    for (at, line) in lines {
        if let Some(name) = heading(line) {
            section = name;
            continue;
        }
        match section {
            "axiom" => axiom.push_str(line),
            "rules" => match (split_rule(line).filter(|_| line.contains(['→', '>'])), rules.last_mut()) {
                (Some(_), _) if is_rule(line) => rules.push((*line).to_owned()),
                (_, Some(last)) => {
                    last.push(' ');
                    last.push_str(line);
                }
                _ => draft.refuse(*at, line, "This rule has no arrow"),
            },
            "variables" => match line.split_once('=') {
                Some((name, value)) if name.trim() == "n" => draft.iterations(*at, value),
                Some((name, value)) => variables.push((name.trim().to_owned(), value.trim().to_owned())),
                None => draft.refuse(*at, line, "This variable has no value"),
            },
            _ => draft.refuse(*at, line, "This section cannot be read"),
        }
    }
    let clean = |text: &str| text.replace(['∧', '⌃'], "^");
    let (axiom, rules) = (clean(&axiom), rules.iter().map(|rule| clean(rule)).collect::<Vec<_>>());
    let scaled = |text: &str| if library { scale(text) } else { text.to_owned() };
    draft.definition.axiom = scaled(&axiom);
    let rules: Vec<String> = rules.iter().map(|rule| scaled(rule)).collect();
    angle(&mut draft, &variables, code);
    let body = format!("{}\n{}", draft.definition.axiom, rules.join("\n"));
    if body.contains('θ') && !variables.iter().any(|(name, _)| name == "θ") {
        variables.push(("θ".into(), "90".into()));
    }
    let used = names(&body);
    let constants: Vec<_> = variables.iter().filter(|(name, _)| used.contains(name)).collect();
    let lines = constants.iter().map(|(name, value)| format!("{name} = {value}"));
    draft.definition.rules = lines.chain(rules).collect::<Vec<_>>().join("\n");
    if library {
        draft.definition.step = 2.0;
        draft.others = Some("");
        let known = [('F', "draw"), ('f', "move"), ('+', "turn left"), ('-', "turn right"), ('!', "width 0.5")];
        for (symbol, actions) in known.into_iter().chain([('[', "open branch"), (']', "close branch")]) {
            draft.meaning(symbol, actions);
        }
    } else {
        let why = "The Racket code decides what symbols do and is not run; here symbols do the same as in ABOP";
        draft.note(line, code.first, why);
    }
    draft
}

/// Whether a line begins a rule: an arrow stands outside brackets behind the first symbol.
fn is_rule(line: &str) -> bool {
    ["->", "→", "⟶"].iter().any(|arrow| line.find(arrow).is_some_and(|at| !line[..at].contains('[')))
}

/// The names in arguments and conditions.
fn names(body: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for line in body.lines() {
        let condition = line.split_once(':').and_then(|(_, rest)| rest.split(['→', '-']).next()).unwrap_or_default();
        let mut depth = 0_usize;
        let inside = line.chars().map(|ch| {
            depth = (depth + usize::from(ch == '(')).saturating_sub(usize::from(ch == ')'));
            if depth > 0 { ch } else { ' ' }
        });
        let text: String = inside.chain([' ']).chain(condition.chars()).collect();
        let words = text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
        found.extend(words.map(str::to_owned));
    }
    found
}

/// Sets the angle from the variables or the code.
fn angle(draft: &mut Draft, variables: &[(String, String)], code: &Code<'_>) {
    let library = code.library;
    let variable = |names: &[&str]| {
        let found = names.iter().find_map(|name| variables.iter().find(|(own, _)| own == name))?;
        decimal::read(&found.1)
    };
    let found = variable(if library { &["θ"] } else { &["θ", "δ", "angle", "theta", "delta"] });
    draft.definition.angle = match found {
        Some(angle) => angle,
        None if library => 90.0,
        None => match code.turn {
            Some(angle) => {
                draft.note(draft.line, "", "The angle is read from the Racket code");
                angle
            }
            None => {
                draft.note(draft.line, "", "The text gives no angle; 90 degrees is chosen");
                90.0
            }
        },
    };
}

/// Multiplies the numbers of + and - by θ, as the library does.
fn scale(text: &str) -> String {
    let mut out = String::new();
    let mut depth = 0_usize;
    let mut scaled = None;
    let mut before = ' ';
    for ch in text.chars() {
        out.push(ch);
        match ch {
            '(' => {
                depth += 1;
                if depth == 1 && matches!(before, '+' | '-') {
                    out.push('(');
                    scaled = Some(depth);
                }
            }
            ')' => {
                if scaled == Some(depth) {
                    out.push_str("*θ)");
                    scaled = None;
                }
                depth = depth.saturating_sub(1);
            }
            _ => {}
        }
        before = ch;
    }
    out
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn cases() {
        check(
            "#lang lindenmayer racket\n\n## axiom ##\nF\n\n## rules ##\nF -> FF-\n     [-F+F+F]+\n     [+F-F-F]\n\n## variables ##\nn=4\nθ=22.5\n\n=====\n(require lindenmayer/turtle)\n",
            expect![[r#"
                Racket
                []
                n 4, angle 22.5, heading 90, abop, step 2
                  F
                  F -> FF- [-F+F+F]+ [+F-F-F]"#]],
        );
        check(
            "#lang lindenmayer racket\n## axiom ##\nA(0)\n## rules ##\nA(d) : d > 0 -> A(d+s)\nA(d) : d = 0 → F(1)[+(2)A(D)]F(1)A(0)\nF(a)         -> F(a*R)\n## variables ##\nD=1\nR=1.5\nn=5\ns=-1\nθ=45\nh=800\n----\n## axiom ##\nX\n## rules ##\nX → ^F∧X\n=====\n(require lindenmayer/turtle)",
            expect![[r#"
                Racket
                []
                n 5, angle 45, heading 90, abop, step 2
                  A(0)
                  D = 1
                  R = 1.5
                  s = -1
                  θ = 45
                  A(d) : d > 0 -> A(d+s)
                  A(d) : d = 0 → F(1)[+((2)*θ)A(D)]F(1)A(0)
                  F(a)         -> F(a*R)
                []
                n 16, angle 90, heading 90, abop, step 2
                  X
                  X → ^F^X
                  | ^: nothing
                note 16 "": The text gives no number of iterations; 16 is chosen by the size"#]],
        );
        check(
            "#lang lindenmayer racket\n## axiom ##\nF\n## rules ##\nF -> F + F\n## variables ##\nn=2\n=====\n(define (+ turtles variables)\n  (turn 60 turtles))",
            expect![[r#"
                Racket
                []
                n 2, angle 60, heading 90, abop
                  F
                  F -> F + F
                note 1 "": The angle is read from the Racket code
                note 1 "(define (+ turtles variables)": The Racket code decides what symbols do and is not run; here symbols do the same as in ABOP"#]],
        );
        check(
            "#lang lindenmayer\n## axiom ##\nF(\n## rules ##\nFF\n## colours ##\nred\n",
            expect![[r#"
            Racket
            []
            refused 5 "FF": This rule has no arrow
            refused 7 "red": This section cannot be read"#]],
        );
    }
}
