//! Printing a grammar in the notation, as text that reads back as the same grammar.

use crate::characters::{disc, is_blank, is_invisible, look_alike};
use crate::grammar::{NamedCurve, NamedShape};
use crate::{Expr, Grammar, Module, Pattern, Production, Query, Seen};
use core::fmt::Write;
use lsystem_base::number::number;

/// The axiom on one line.
#[must_use]
pub fn print_axiom(grammar: &Grammar) -> String {
    let mut out = String::new();
    word(&grammar.axiom, &mut out);
    out
}

/// The rules in the notation: constants, the symbols that contexts see, productions, then the productions for drawing.
/// Each has one line, without a line end after the last.
#[must_use]
pub fn print_rules(grammar: &Grammar) -> String {
    let mut lines = Vec::new();
    for constant in &grammar.constants {
        lines.push(format!("{} = {}", constant.name, number(constant.value)));
    }
    for NamedShape { name, shape } in &grammar.shapes {
        lines.push(format!("shape {name} = {shape}"));
    }
    for NamedCurve { name, curve } in &grammar.curves {
        lines.push(format!("curve {name} = {curve}"));
    }
    match &grammar.seen {
        Seen::All => {}
        Seen::Except(list) => lines.push(symbols("ignore: ", list)),
        Seen::Only(list) => lines.push(symbols("consider: ", list)),
    }
    lines.extend(grammar.productions.iter().map(production));
    if !grammar.images.is_empty() {
        lines.push("draw:".to_owned());
        lines.extend(grammar.images.iter().map(production));
    }
    lines.join("\n")
}

fn symbols(heading: &str, list: &[char]) -> String {
    let mut line = heading.to_owned();
    for &ch in list {
        let comment = ch == '*' && line.ends_with('/');
        symbol(ch, comment, &mut line);
    }
    line
}

fn production(production: &Production) -> String {
    let mut line = String::new();
    if !production.left.is_empty() {
        patterns(&production.left, &mut line);
        line.push_str(" < ");
    }
    pattern(&production.predecessor, false, &mut line);
    if !production.right.is_empty() {
        line.push_str(" > ");
        patterns(&production.right, &mut line);
    }
    if let Some(condition) = &production.condition {
        line.push_str(" : ");
        expression(condition, 0, &mut line);
    }
    line.push_str(" -> ");
    if production.successor.is_empty() {
        line.push('*');
    }
    word(&production.successor, &mut line);
    if let Some(weight) = &production.weight {
        line.push_str(" : ");
        // Comparisons need parentheses in a weight.
        expression(weight, 4, &mut line);
    }
    line
}

/// The successor of a production in the notation; `nothing` if it is empty.
pub fn successor(production: &Production) -> String {
    let mut text = String::new();
    word(&production.successor, &mut text);
    if text.is_empty() { "nothing".to_owned() } else { text }
}

fn expression(expr: &Expr, outer: u8, out: &mut String) {
    // Writing to a string never fails.
    let _ = expr.write(out, outer);
}

/// A context.
fn patterns(patterns: &[Pattern], out: &mut String) {
    for one in patterns {
        let empty = patterns.len() == 1 && one.parameters.is_empty() && matches!(one.symbol, '*' | 'ε');
        // A line that begins with two slashes would be a comment.
        let comment = out.is_empty() && one.symbol == '/' || one.symbol == '*' && out.ends_with('/');
        pattern(one, empty || comment, out);
    }
}

fn pattern(pattern: &Pattern, quote: bool, out: &mut String) {
    if !query(pattern.symbol, pattern.parameters.len(), out) {
        symbol(pattern.symbol, quote || matches!(pattern.symbol, '<' | '>' | '#'), out);
    }
    if !pattern.parameters.is_empty() {
        out.push('(');
        out.push_str(&pattern.parameters.join(", "));
        out.push(')');
    }
}

fn word(modules: &[Module], out: &mut String) {
    for (at, module) in modules.iter().enumerate() {
        let last = at + 1 == modules.len();
        // A word that is only an arrow or a mark of the empty word would be misread.
        let alone = last
            && match module.symbol {
                '*' | 'ε' => at == 0,
                '>' => at == 1 || at == 2,
                _ => false,
            };
        // A slash and a star would begin a comment.
        let comment = module.symbol == '*' && out.ends_with('/');
        if !query(module.symbol, module.arguments.len(), out) {
            symbol(module.symbol, alone || comment, out);
        }
        for (at, argument) in module.arguments.iter().enumerate() {
            out.push(if at == 0 { '(' } else { ',' });
            expression(argument, 0, out);
        }
        if !module.arguments.is_empty() {
            out.push(')');
        }
    }
}

/// Appends one module of a derived word: the symbol, then the arguments in parentheses as the shortest decimals that
/// read back as the same numbers.
pub fn print_module(ch: char, arguments: &[f64], out: &mut String) {
    if !query(ch, arguments.len(), out) {
        symbol(ch, false, out);
    }
    for (at, argument) in arguments.iter().enumerate() {
        // Writing to a string never fails.
        let _ = write!(out, "{}{}", if at == 0 { '(' } else { ',' }, number(*argument));
    }
    if !arguments.is_empty() {
        out.push(')');
    }
}

/// Appends a query with its letter, if the symbol is one and has arguments. Returns whether it is.
fn query(symbol: char, arguments: usize, out: &mut String) -> bool {
    let query = Query::of_symbol(symbol).filter(|_| arguments > 0);
    // Writing to a string never fails.
    query.is_some_and(|query| write!(out, "{query}").is_ok())
}

/// Appends one symbol, in backquotes if it would be misread or if `quote`.
pub(crate) fn symbol(symbol: char, quote: bool, out: &mut String) {
    if is_blank(symbol) && symbol != ' ' || is_invisible(symbol) {
        out.push_str(&format!("`U+{:02X}`", u32::from(symbol)));
    } else if quote
        || out.ends_with('@') && disc(symbol).is_some()
        || out.ends_with('?') && Query::of_letter(symbol).is_some()
        || matches!(symbol, ' ' | '`' | '(' | ')' | ':' | '→')
        || look_alike(symbol).is_some()
    {
        out.push('`');
        out.push(symbol);
        out.push('`');
    } else {
        out.push(symbol);
    }
}
