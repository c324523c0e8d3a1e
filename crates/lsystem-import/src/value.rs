//! Values in trees of programs and data: strings, numbers with arithmetic, brackets, and what stands before them.

mod sums;

use crate::tokens::{Kind, Node};
use crate::vocabulary::{Key, rows};
use core::ops::Range;
pub(super) use sums::{arithmetic, leading};

/// A value and its place in the text.
#[derive(Clone, Debug)]
pub(super) struct Value<'t> {
    pub(super) what: What<'t>,
    pub(super) span: Range<usize>,
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum What<'t> {
    Text(String),
    Number(f64, Unit),
    /// A bracket, and the name before it: `Rule` of `new Rule('F', "FF")`.
    Group(&'t Node, Option<&'t str>),
    /// A name, of which the last part counts: `None` of `Draw.None`.
    Name(&'t str),
    /// Code and other values that are not read.
    Code,
}

/// The number that a whole text is: `45`, `360/7`, `22.5°`.
pub(super) fn whole_number(text: &str) -> Option<f64> {
    let short = text.trim().get(..50).unwrap_or(text.trim());
    match arithmetic(&crate::tokens::tree(short).nodes) {
        What::Number(number, _) if short.len() == text.trim().len() => Some(number),
        _ => None,
    }
}

/// The unit of a number, as far as the text shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    /// A plain number.
    Unknown,
    Radians,
    Degrees,
}

impl<'t> Value<'t> {
    pub(super) fn text(&self) -> Option<&str> {
        if let What::Text(text) = &self.what { Some(text) } else { None }
    }

    pub(super) fn number(&self) -> Option<f64> {
        if let What::Number(number, _) = self.what { Some(number) } else { None }
    }

    /// The inside of a bracket.
    pub(super) fn items(&self) -> Option<&'t [Node]> {
        if let What::Group(node, _) = self.what { node.group() } else { None }
    }

    pub(super) fn members(&self) -> Vec<Member<'t>> {
        self.items().map(members).unwrap_or_default()
    }

    pub(super) fn elements(&self) -> Vec<Value<'t>> {
        self.items().map(elements).unwrap_or_default()
    }
}

/// A key with its value.
#[derive(Clone, Debug)]
pub(super) struct Member<'t> {
    pub(super) key: String,
    /// The index behind a key, as `"F"` of `rules["F"] = "FF"`.
    pub(super) index: Option<&'t Node>,
    pub(super) value: Value<'t>,
    /// The place of the key and the value.
    pub(super) span: Range<usize>,
    /// The first part behind the value.
    pub(super) next: usize,
}

/// The marks between a key and its value.
const SIGNS: [&str; 7] = [":", "=", "=>", ":=", "->", "<-", "→"];

/// The member that begins at a place of a bracket's inside.
pub(super) fn member(nodes: &[Node], at: usize) -> Option<Member<'_>> {
    let first = nodes.get(at)?;
    let behind = |next: usize, key: String, index| {
        let value = value(nodes, next)?;
        let span = first.span.start..value.0.span.end;
        Some(Member { key, index, value: value.0, span, next: value.1 })
    };
    let sign = |at: usize| nodes.get(at).is_some_and(|node| SIGNS.iter().any(|sign| node.is(sign)));
    // `:axiom "F"` of Lisp, if a value stands directly behind the name.
    if first.is(":")
        && let Some(name) = nodes.get(at + 1).filter(|node| node.span.start == first.span.end).and_then(Node::name)
        && matches!(nodes.get(at + 2)?.kind, Kind::Text(_) | Kind::Number(..) | Kind::Group(..))
    {
        return behind(at + 2, name.to_owned(), None);
    }
    // `["F"] = "FF"` of Lua, `['F']: "FF"` of JavaScript.
    if let Kind::Group('[', inside) = &first.kind
        && let [one] = &inside[..]
        && let Some(key) = one.text()
        && sign(at + 1)
    {
        return behind(at + 2, key.to_owned(), None);
    }
    let key = match &first.kind {
        Kind::Name(name) => name.clone(),
        Kind::Text(text) => text.clone(),
        // Digits are symbols, and chances.
        Kind::Number(number, unit) if unit.is_empty() && sign(at + 1) => lsystem_base::number::number(*number),
        _ => return None,
    };
    // `"F" to "FF"` of Kotlin.
    if nodes.get(at + 1)?.name() == Some("to") && first.text().is_some() {
        return behind(at + 2, key, None);
    }
    let mut next = at + 1;
    let index = match &nodes.get(next)?.kind {
        Kind::Group('[', inside) if first.name().is_some() => {
            next += 1;
            inside.first().filter(|_| inside.len() == 1)
        }
        _ => None,
    };
    if !sign(next) {
        return None;
    }
    // `axiom: string = "F"` of TypeScript, Swift and Rust.
    if nodes[next].is(":") {
        let is_type = |at: usize| {
            nodes.get(at).is_some_and(|node| {
                node.name().is_some()
                    || ["<", ">", ".", "&", "::"].iter().any(|mark| node.is(mark))
                    || matches!(node.kind, Kind::Group('[', _))
            })
        };
        let begins = |at: usize| is_type(at) && !nodes[at].is("<") && !nodes[at].is(".");
        let mut end = next + 1;
        while end < next + 12 && (end == next + 1 && begins(end) || is_type(end) && !nodes[end].is_first) {
            end = types(nodes, end).unwrap_or(end + 1);
        }
        if end > next + 1 && nodes.get(end).is_some_and(|node| node.is("=")) {
            next = end;
        }
    }
    behind(next + 1, key, index)
}

/// The members of a bracket's inside, in order.
pub(super) fn members(nodes: &[Node]) -> Vec<Member<'_>> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < nodes.len() {
        match member(nodes, at) {
            Some(member) => {
                at = member.next.max(at + 1);
                found.push(member);
            }
            None => at += 1,
        }
    }
    found
}

/// The pairs of a list as members: `[("axiom", "F"), ("angle", 60)]`.
pub(super) fn pairs(nodes: &[Node]) -> Vec<Member<'_>> {
    let mut found = Vec::new();
    for one in elements(nodes) {
        let [from, to] = &one.elements()[..] else { return Vec::new() };
        let Some(key) = from.text().map(str::to_owned) else { return Vec::new() };
        found.push(Member { key, index: None, value: to.clone(), span: one.span.clone(), next: 0 });
    }
    found
}

/// The values of a bracket's inside.
pub(super) fn elements(nodes: &[Node]) -> Vec<Value<'_>> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < nodes.len() {
        match value(nodes, at) {
            Some((value, next)) => {
                at = next.max(at + 1);
                found.push(value);
            }
            None => at += 1,
        }
    }
    found
}

/// Whether an expression ends before a part: at a separator, or on a new line that does not go on with it.
fn ends(nodes: &[Node], from: usize, at: usize) -> bool {
    let Some(node) = nodes.get(at) else { return true };
    if node.is(",") || node.is(";") {
        return true;
    }
    // The members of a new object may begin on the next line: `new Dictionary<string, string>` and below it `{`.
    if nodes[from].name() == Some("new") && matches!(node.kind, Kind::Group('{', _)) {
        return false;
    }
    let goes_on = |node: &Node| ["+", "-", "*", "/", ".", "..", "&&", "||", "?"].iter().any(|mark| node.is(mark));
    at > from
        && node.is_first
        && !goes_on(node)
        && !nodes.get(at - 1).is_some_and(|before| goes_on(before) || before.is("="))
}

/// The most parts of an expression; a longer one is code that ends there.
const LONGEST: usize = 400;

/// The end of types in angle brackets behind a name: `<char, string>`.
fn types(nodes: &[Node], at: usize) -> Option<usize> {
    if !nodes.get(at)?.is("<") || nodes.get(at.checked_sub(1)?)?.name().is_none() {
        return None;
    }
    let inside =
        |node: &Node| node.name().is_some() || [",", ".", "::", "<", "?", "&"].iter().any(|mark| node.is(mark));
    let length = nodes[at..].iter().take(12).position(|node| !inside(node))?;
    nodes[at + length].is(">").then_some(at + length + 1)
}

/// The value that begins at a place of a bracket's inside, and the first part behind it.
pub(super) fn value(nodes: &[Node], from: usize) -> Option<(Value<'_>, usize)> {
    if ends(nodes, from, from) {
        return None;
    }
    let mut to = from + 1;
    while !ends(nodes, from, to) && to - from < LONGEST {
        to = types(nodes, to).unwrap_or(to + 1);
    }
    let part = &nodes[from..to];
    let span = part.first()?.span.start..part.last()?.span.end;
    // Values of Lisp stand side by side without a mark between them: the first one is meant.
    let alone = |node: &Node| matches!(node.kind, Kind::Text(_) | Kind::Number(..) | Kind::Group(..));
    if part.len() > 1 && part.iter().all(alone) && !matches!(part[0].kind, Kind::Group(..)) {
        let texts = part.iter().all(|node| node.text().is_some());
        // Python and C join strings that stand side by side.
        let joined = texts && part.iter().skip(1).all(|node| node.is_first) && part.len() > 2;
        if !joined {
            return Some((Value { what: single(&part[0]), span: part[0].span.clone() }, from + 1));
        }
    }
    if part.len() > 2 && part[1].is(":") && alone(&part[0]) && part[2].name().is_some() {
        return Some((Value { what: single(&part[0]), span: part[0].span.clone() }, from + 1));
    }
    Some((Value { what: what(part), span }, to))
}

fn single(node: &Node) -> What<'_> {
    match &node.kind {
        Kind::Text(text) => What::Text(text.clone()),
        Kind::Number(..) => arithmetic(core::slice::from_ref(node)),
        Kind::Group(..) => What::Group(node, None),
        _ => What::Code,
    }
}

fn what(part: &[Node]) -> What<'_> {
    // `lambda: {..}`
    if let [lambda, colon, rest @ ..] = part
        && lambda.name() == Some("lambda")
        && colon.is(":")
    {
        return what(rest);
    }
    // `field(default_factory=..)` of a class
    if let [.., function, call] = part
        && matches!(function.name(), Some("field" | "ib"))
        && let Some(inside) = call.group()
        && let Some(default) = members(inside).into_iter().find(|member| member.key.starts_with("default"))
    {
        return default.value.what;
    }
    // Calls at the end that change nothing: `"F".to_string()`, `[..].freeze`.
    let mut part = part;
    let is_harmless = |before: &[Node], dot: &Node, name: &Node| {
        !before.is_empty() && dot.is(".") && name.name().is_some_and(|name| rows(name).has(Key::Harmless))
    };
    loop {
        part = match part {
            [before @ .., dot, name, call] if call.group().is_some() && is_harmless(before, dot, name) => before,
            [before @ .., dot, name] if is_harmless(before, dot, name) => before,
            _ => break,
        };
    }
    if let [node] = part {
        return match &node.kind {
            // `("F+F" "F-F")` joins strings; `(60)` is a number.
            Kind::Group('(', inside) if !inside.iter().any(|node| node.is(",")) && !inside.is_empty() => {
                match what(inside) {
                    What::Code => What::Group(node, None),
                    inner => inner,
                }
            }
            _ => single(node),
        };
    }
    if let Some(text) = joined(part) {
        return What::Text(text);
    }
    if let number @ What::Number(..) = arithmetic(part) {
        return number;
    }
    // A bracket, behind a type, a constructor or a call: `new Map<char, String> {..}`, `dict(..)`, `map[rune]string{..}`.
    let Some((last, before)) = part.split_last() else { return What::Code };
    let allowed = |node: &Node| match &node.kind {
        Kind::Name(_) => true,
        Kind::Group(_, inside) => inside.len() <= 1,
        Kind::Mark(mark) => {
            matches!(*mark, "." | "::" | "<" | ">" | "!" | "&" | "*" | "@" | "%" | "#" | "$" | "," | "'" | "?" | ">=")
        }
        _ => false,
    };
    if last.group().is_some() && before.iter().all(allowed) {
        let name = before.iter().rev().find_map(Node::name);
        if let Some("radians" | "degrees" | "range" | "random" | "randint" | "choice" | "function") = name {
            return What::Code;
        }
        // `char('F')`, `String("F")`, `str("F")`.
        if let Some([one]) = last.group()
            && let (Kind::Text(text), Some("char" | "String" | "str" | "string" | "list" | "Array" | "from")) =
                (&one.kind, name)
        {
            return What::Text(text.clone());
        }
        return What::Group(last, name);
    }
    match last.name() {
        Some(name) if before.iter().all(|node| node.name().is_some() || node.is(".")) => What::Name(name),
        _ => What::Code,
    }
}

/// Strings that `+`, `..` or nothing joins.
fn joined(part: &[Node]) -> Option<String> {
    let mut text = String::new();
    let mut is_text = false;
    for node in part {
        match &node.kind {
            Kind::Text(own) => {
                text.push_str(own);
                is_text = true;
            }
            Kind::Mark("+" | ".." | "\\") if is_text => {}
            _ => return None,
        }
    }
    is_text.then_some(text)
}
