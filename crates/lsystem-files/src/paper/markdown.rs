//! Systems typeset for Markdown: code spans and Unicode, so that any reader of Markdown shows them.

use super::facts;
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_drawing::System;
use lsystem_syntax::Query;
use lsystem_syntax::grammar::{NamedCurve, NamedShape};
use lsystem_syntax::{Definition, Expr, Module, Pattern, Production};

/// A system as Markdown: the title, the numbers, and a list with constants, axiom and productions.
#[must_use]
pub fn markdown(definition: &Definition, system: &System) -> String {
    let grammar = &system.grammar;
    let mut text = String::new();
    if !definition.label().is_empty() {
        text = format!("**{}**\n\n", escape(definition.label()));
    }
    let facts = facts::facts(definition, system);
    let facts = facts.iter().map(|fact| format!("{} = {}", fact.name, facts::plain(fact)));
    text.push_str(&facts.collect::<Vec<_>>().join(", "));
    text.push_str("\n\n");
    for constant in &grammar.constants {
        item(&mut text, &code(&format!("{} = {}", constant.name, number(constant.value))));
    }
    for NamedShape { name, shape } in &grammar.shapes {
        item(&mut text, &code(&format!("shape {name} = {shape}")));
    }
    for NamedCurve { name, curve } in &grammar.curves {
        item(&mut text, &code(&format!("curve {name} = {curve}")));
    }
    if let Some((word, symbols)) = facts::seen(grammar) {
        item(&mut text, &format!("{word}: {}", code(&symbols.iter().map(|&c| shown(c)).collect::<String>())));
    }
    item(&mut text, &format!("ω: {}", word(&grammar.axiom)));
    productions(&mut text, 'p', &grammar.productions);
    if !grammar.images.is_empty() {
        item(&mut text, "homomorphism:");
        productions(&mut text, 'h', &grammar.images);
    }
    if facts::has_free_weights(grammar) {
        item(&mut text, "Numbers in arrows are weights: probabilities are in proportion to them.");
    }
    for words in facts::meanings(definition) {
        item(&mut text, &escape(&words));
    }
    for (symbol, actions) in facts::custom(definition) {
        item(&mut text, &format!("{}: {}", code(&shown(symbol)), escape(actions)));
    }
    if !definition.source.is_empty() {
        let _ = writeln!(text, "\n{}", escape(&definition.source));
    }
    text
}

fn item(text: &mut String, content: &str) {
    // Writing to a `String` cannot fail.
    let _ = writeln!(text, "- {content}");
}

fn productions(text: &mut String, letter: char, productions: &[Production]) {
    for (at, production) in productions.iter().enumerate() {
        let index: String = (at + 1).to_string().bytes().map(lowered).collect();
        item(text, &format!("{letter}{index}: {}", rule(production)));
    }
}

/// A digit as a lower index.
fn lowered(digit: u8) -> char {
    char::from_u32(u32::from('₀') + u32::from(digit - b'0')).unwrap_or('₀')
}

fn rule(production: &Production) -> String {
    let mut before = String::new();
    if !production.left.is_empty() {
        before = format!("{} < ", patterns(&production.left));
    }
    before.push_str(&patterns(core::slice::from_ref(&production.predecessor)));
    if !production.right.is_empty() {
        before.push_str(&format!(" > {}", patterns(&production.right)));
    }
    let mut text = code(&before);
    if let Some(condition) = &production.condition {
        text.push_str(&format!(" : {}", code(&condition.to_string())));
    }
    match &production.weight {
        None => text.push_str(" → "),
        Some(Expr::Number(weight)) => text.push_str(&format!(" –{}→ ", number(*weight))),
        Some(weight) => text.push_str(&format!(" –{}→ ", code(&weight.to_string()))),
    }
    text.push_str(&word(&production.successor));
    text
}

fn patterns(patterns: &[Pattern]) -> String {
    let pattern = |pattern: &Pattern| match &pattern.parameters[..] {
        [] => shown(pattern.symbol),
        names => format!("{}({})", shown(pattern.symbol), names.join(",")),
    };
    patterns.iter().map(pattern).collect()
}

/// The modules of an axiom or a successor.
fn word(modules: &[Module]) -> String {
    let module = |module: &Module| match &module.arguments[..] {
        [] => shown(module.symbol),
        arguments => {
            let arguments: Vec<String> = arguments.iter().map(ToString::to_string).collect();
            format!("{}({})", shown(module.symbol), arguments.join(","))
        }
    };
    if modules.is_empty() { "ε".into() } else { code(&modules.iter().map(module).collect::<String>()) }
}

/// A symbol that can be seen: white space and control characters become marks.
fn shown(symbol: char) -> String {
    match symbol {
        ' ' => "␣".into(),
        c if Query::of_symbol(c).is_some() => {
            Query::of_symbol(c).map_or(String::new(), |query| format!("?{}", query.letter()))
        }
        c if c.is_whitespace() || c.is_control() => format!("⟨U+{:02X}⟩", u32::from(c)),
        c => c.into(),
    }
}

/// A code span. Its fence is longer than any run of backquotes inside (`CommonMark`, section 6.1).
fn code(text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    let space = if text.starts_with('`') || text.ends_with('`') { " " } else { "" };
    format!("{fence}{space}{text}{space}{fence}")
}

/// A text in which no character marks anything.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            c if c.is_control() => escaped.push(' '),
            c if c.is_ascii_punctuation()
                && !matches!(c, ',' | ';' | ':' | '\'' | '"' | '/' | '?' | '%' | '=' | '@') =>
            {
                // A point, a hyphen or a plus marks a list only at a line's start, where no text stands.
                escaped.push_str(if matches!(c, '.' | '-' | '+' | '(' | ')' | '!') { "" } else { "\\" });
                escaped.push(c);
            }
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::expect;

    #[test]
    fn a_system_with_everything() {
        let definition = Definition {
            title: "A *weed* & <more>".into(),
            source: "Prusinkiewicz and Lindenmayer (1990), page 1_2".into(),
            axiom: "```A(1)` `".into(),
            rules: "r = 0.9\nconsider: AB\nA(x) < B(y) > C : x > r -> F(x*r)[+B(y)] : 0.5\nA(x) < B(y) > C -> * : x\nC -> |\ndraw:\nA -> F".into(),
            angle: 25.7,
            iterations: 3,
            tropism: [0.0, -1.0, 0.0],
            elasticity: 0.2,
            length_variation: 5.0,
            overrides: "G: move".into(),
            ..Definition::default()
        };
        expect![[r#"
            **A \*weed\* \& \<more\>**

            n = 3, δ = 25.7°, tropism T = (0, -1, 0), elasticity e = 0.2, length variation = 5 %, seed = 0

            - `r = 0.9`
            - consider: `AB`
            - ω: `` `A(1)␣ ``
            - p₁: `A(x) < B(y) > C` : `x > r` –0.5→ `F(x*r)[+B(y)]`
            - p₂: `A(x) < B(y) > C` –`x`→ ε
            - p₃: `C` → `|`
            - homomorphism:
            - h₁: `A` → `F`
            - `G`: move

            Prusinkiewicz and Lindenmayer (1990), page 1\_2
        "#]]
        .assert_eq(&markdown(&definition, &System::new(&definition).unwrap()));
    }

    #[test]
    fn any_symbol_fits_a_code_span() {
        assert_eq!(["F", "`", "a``b", "|"].map(code), ["`F`", "`` ` ``", "```a``b```", "`|`"]);
        assert_eq!(lowered(b'7'), '₇');
        assert_eq!([' ', '\n', 'é'].map(shown), ["␣", "⟨U+0A⟩", "é"]);
    }
}
