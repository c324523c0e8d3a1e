//! Writing a grammar in the notation, so that reading it again gives the same grammar.

use crate::notation::token::{is_blank, is_invisible, look_alike};
use crate::{Grammar, Module};

/// The axiom on one line.
#[must_use]
pub fn print_axiom(grammar: &Grammar) -> String {
    let mut out = String::new();
    word(&grammar.axiom, &mut out);
    out
}

/// Constants, then productions, a line each, without a line end after the last.
#[must_use]
pub fn print_rules(grammar: &Grammar) -> String {
    let mut lines = Vec::new();
    for constant in &grammar.constants {
        lines.push(format!("{} = {}", constant.name, number(constant.value)));
    }
    for production in &grammar.productions {
        let mut line = String::new();
        symbol(production.predecessor.symbol, matches!(production.predecessor.symbol, '<' | '>' | '#'), &mut line);
        line.push_str(" -> ");
        if production.successor.is_empty() {
            line.push('*');
        }
        word(&production.successor, &mut line);
        if let Some(weight) = production.weight {
            line.push_str(" : ");
            line.push_str(&number(weight));
        }
        lines.push(line);
    }
    lines.join("\n")
}

/// The shortest decimal that reads back as `value`, with an exponent where it would be long otherwise.
#[must_use]
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-6..1e15).contains(&size) { format!("{value}") } else { format!("{value:e}") }
}

fn word(modules: &[Module], out: &mut String) {
    for (at, module) in modules.iter().enumerate() {
        let last = at + 1 == modules.len();
        // A word that is nothing but an arrow or a mark for the empty word would be read as such.
        let alone = last
            && match module.symbol {
                '*' | 'ε' => at == 0,
                '>' => at == 1 || at == 2,
                _ => false,
            };
        symbol(module.symbol, alone, out);
    }
}

/// One symbol, in backquotes where it would be misread.
pub(crate) fn symbol(symbol: char, quote: bool, out: &mut String) {
    if is_blank(symbol) && symbol != ' ' || is_invisible(symbol) {
        out.push_str(&format!("`U+{:02X}`", u32::from(symbol)));
    } else if quote || matches!(symbol, ' ' | '`' | '(' | ')' | ':' | '→') || look_alike(symbol).is_some() {
        out.push('`');
        out.push(symbol);
        out.push('`');
    } else {
        out.push(symbol);
    }
}
