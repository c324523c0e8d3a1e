//! A search through the sources of the readers for loops over foreign data that nobody counts.
//!
//! A loop is counted if it charges a meter or names a limit (`MAX…`, `LONGEST…`). Two kinds of others are found:
//!
//! - a `while` or `loop` that neither takes the next item of an iterator, nor empties a stack, nor changes what its
//!   condition looks at;
//! - a pass over something in each round of a loop, if the loop has not made it: the work is the product of both.
//!   Constants and lists in brackets are short. What a loop shortens as it goes may be passed up to what is looked for.
//!
//! `loops.txt` lists those that were looked at, by the reason why they are bounded. Calls of other functions are not
//! followed.

use crate::program::root;

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Block, Expr, ExprMethodCall, Pat};

/// The files and folders that read what others wrote.
const READERS: &[&str] = &[
    "lsystem-course/src/check",
    "lsystem-course/src/class/answers.rs",
    "lsystem-course/src/exercise.rs",
    "lsystem-course/src/hint.rs",
    "lsystem-course/src/repair.rs",
    "lsystem-files/src/edit",
    "lsystem-files/src/edit.rs",
    "lsystem-files/src/embed",
    "lsystem-files/src/embed.rs",
    "lsystem-files/src/json",
    "lsystem-files/src/json.rs",
    "lsystem-files/src/link.rs",
    "lsystem-files/src/mesh_shape",
    "lsystem-files/src/mesh_shape.rs",
    "lsystem-files/src/packed.rs",
    "lsystem-files/src/png.rs",
    "lsystem-files/src/segments",
    "lsystem-files/src/segments.rs",
    "lsystem-files/src/xml.rs",
    "lsystem-find/src/picture.rs",
    "lsystem-import/src",
    "lsystem-svg/src",
    "lsys/src/answers.rs",
    "lsys/src/find/pixels.rs",
    "lsys/src/input.rs",
    "lsys/src/view",
];
/// What writes, and tests.
const OTHERS: [&str; 2] = ["write", "tests.rs"];

/// Passes that may end soon, and passes to the end.
const SHORT: &[&str] =
    &["bytes", "char_indices", "chars", "find", "iter", "iter_mut", "position", "split", "split_once"];
const WHOLE: &[&str] = &["contains", "count", "lines", "matches", "repeat", "rfind", "rsplit_once", "trim", "trim_end"];
/// Methods that call a closure for each item, and those that also single values have.
const EACH: &[&str] = &[
    "all",
    "any",
    "filter_map",
    "find_map",
    "flat_map",
    "fold",
    "for_each",
    "from_fn",
    "map_while",
    "position",
    "retain",
    "rposition",
    "skip_while",
    "take_while",
    "try_fold",
    "try_for_each",
];
const MAYBE_EACH: &[&str] = &["filter", "find", "map", "max_by_key", "min_by_key", "partition"];

/// A loop that is open.
struct Round {
    /// What is made in the loop, and what is changed.
    made: HashSet<String>,
    changed: HashSet<String>,
    is_counted: bool,
}

/// The loops of a source that nobody counts, by line.
struct Search<'a> {
    lines: Vec<&'a str>,
    rounds: Vec<Round>,
    found: BTreeSet<usize>,
}

/// The loops in a text that nobody counts: their first lines.
fn uncounted(source: &str) -> Vec<&str> {
    let mut search = Search { lines: source.lines().collect(), rounds: vec![], found: BTreeSet::new() };
    search.visit_file(&syn::parse_file(source).expect("a source"));
    search.found.iter().map(|&line| search.lines[line - 1].trim()).collect()
}

/// All names in a pattern or an expression; of changes, only the names that get a value.
#[derive(Default)]
struct Names {
    all: HashSet<String>,
    changed: HashSet<String>,
}

impl<'a> Visit<'a> for Names {
    fn visit_ident(&mut self, name: &'a syn::Ident) {
        self.all.insert(name.to_string());
    }

    fn visit_expr_assign(&mut self, change: &'a syn::ExprAssign) {
        match &*change.left {
            Expr::Tuple(tuple) => self.changed.extend(tuple.elems.iter().filter_map(root_of)),
            left => self.changed.extend(root_of(left)),
        }
        visit::visit_expr_assign(self, change);
    }

    fn visit_expr_binary(&mut self, change: &'a syn::ExprBinary) {
        if matches!(change.op, BinOp::AddAssign(_) | BinOp::SubAssign(_) | BinOp::MulAssign(_) | BinOp::DivAssign(_)) {
            self.changed.extend(root_of(&change.left));
        }
        visit::visit_expr_binary(self, change);
    }
}

fn names_of(walk: impl FnOnce(&mut Names)) -> Names {
    let mut names = Names::default();
    walk(&mut names);
    names
}

fn in_pattern(pattern: &Pat) -> HashSet<String> {
    names_of(|names| names.visit_pat(pattern)).all
}

fn changed_in(block: &Block) -> HashSet<String> {
    names_of(|names| names.visit_block(block)).changed
}

/// The name of what an expression is a part or a method of; `None` for constants and lists in brackets.
fn root_of(expression: &Expr) -> Option<String> {
    match expression {
        Expr::MethodCall(call) => root_of(&call.receiver),
        Expr::Field(field) => root_of(&field.base),
        Expr::Index(index) => root_of(&index.expr),
        Expr::Reference(inner) => root_of(&inner.expr),
        Expr::Paren(inner) => root_of(&inner.expr),
        Expr::Try(inner) => root_of(&inner.expr),
        Expr::Unary(inner) => root_of(&inner.expr),
        Expr::Cast(inner) => root_of(&inner.expr),
        Expr::Range(range) => [&range.end, &range.start].into_iter().flatten().find_map(|end| root_of(end)),
        Expr::Call(call) => call.args.first().and_then(root_of),
        Expr::Path(path) => {
            let name = path.path.segments.last()?.ident.to_string();
            name.contains(|c: char| c.is_lowercase()).then_some(name)
        }
        _ => None,
    }
}

/// Whether an expression is an iterator for sure.
fn is_iterator(expression: &Expr) -> bool {
    match expression {
        Expr::MethodCall(call) => {
            let name = call.method.to_string();
            let makes = ["into_iter", "zip", "enumerate", "windows", "chunks", "rev", "skip", "take", "values", "keys"];
            SHORT[..3].contains(&&*name)
                || ["iter", "iter_mut", "lines", "split"].contains(&&*name)
                || makes.contains(&&*name)
                || is_iterator(&call.receiver)
        }
        Expr::Paren(inner) => is_iterator(&inner.expr),
        expression => matches!(expression, Expr::Range(_)),
    }
}

impl Search<'_> {
    fn is_counted(&self, part: &impl Spanned) -> bool {
        let span = part.span();
        let text = self.lines[span.start().line - 1..span.end().line].join("\n");
        ["charge(", "spend(", "MAX", "LONGEST"].iter().any(|word| text.contains(word))
    }

    /// Looks at a pass over something, which is short if `is_short`.
    fn pass(&mut self, over: &Expr, is_short: bool, line: usize) {
        let Some(name) = root_of(over) else { return };
        // The rest of a text from a place that moves is as good as a text that becomes shorter.
        let moves = match over {
            Expr::Index(index) => match &*index.index {
                Expr::Range(range) => range.start.as_ref().and_then(|start| root_of(start)),
                _ => None,
            },
            _ => None,
        };
        let is_own = |round: &Round| {
            let is_changed = |name: &String| round.changed.contains(name) || round.made.contains(name);
            round.made.contains(&name)
                || is_short && (round.changed.contains(&name) || moves.as_ref().is_some_and(is_changed))
        };
        let is_repeated = !self.rounds.is_empty() && !self.rounds.iter().any(|round| round.is_counted || is_own(round));
        if is_repeated {
            self.found.insert(line);
        }
    }

    fn round(
        &mut self,
        part: &impl Spanned,
        made: HashSet<String>,
        changed: HashSet<String>,
        inside: impl FnOnce(&mut Self),
    ) {
        let is_counted = self.is_counted(part);
        self.rounds.push(Round { made, changed, is_counted });
        inside(self);
        self.rounds.pop();
    }

    fn make(&mut self, pattern: &Pat) {
        if let Some(round) = self.rounds.last_mut() {
            round.made.extend(in_pattern(pattern));
        }
    }
}

impl<'a> Visit<'a> for Search<'_> {
    fn visit_item_mod(&mut self, module: &'a syn::ItemMod) {
        if module.ident != "tests" {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_local(&mut self, local: &'a syn::Local) {
        self.make(&local.pat);
        visit::visit_local(self, local);
    }

    fn visit_expr_let(&mut self, binding: &'a syn::ExprLet) {
        self.make(&binding.pat);
        visit::visit_expr_let(self, binding);
    }

    fn visit_arm(&mut self, arm: &'a syn::Arm) {
        self.make(&arm.pat);
        visit::visit_arm(self, arm);
    }

    fn visit_expr_for_loop(&mut self, each: &'a syn::ExprForLoop) {
        let line = each.span().start().line;
        self.pass(&each.expr, false, line);
        self.visit_expr(&each.expr);
        if root_of(&each.expr).is_none() {
            return self.visit_block(&each.body);
        }
        self.round(each, in_pattern(&each.pat), changed_in(&each.body), |search| search.visit_block(&each.body));
    }

    fn visit_expr_while(&mut self, each: &'a syn::ExprWhile) {
        let line = each.span().start().line;
        let names = names_of(|names| names.visit_expr(&each.cond)).all;
        let changed = changed_in(&each.body);
        let body = names_of(|names| names.visit_block(&each.body)).all;
        let takes = ["next", "next_element", "next_if", "pop_front"].iter().any(|name| names.contains(*name));
        let empties = names.contains("pop") && ["push", "extend", "insert"].iter().all(|name| !body.contains(*name));
        if changed.is_disjoint(&names) && !takes && !empties && !self.is_counted(each) {
            self.found.insert(line);
        }
        self.round(each, HashSet::new(), changed, |search| {
            search.visit_expr(&each.cond);
            search.visit_block(&each.body);
        });
    }

    fn visit_expr_loop(&mut self, each: &'a syn::ExprLoop) {
        if !self.is_counted(each) {
            self.found.insert(each.span().start().line);
        }
        self.round(each, HashSet::new(), changed_in(&each.body), |search| search.visit_block(&each.body));
    }

    fn visit_expr_method_call(&mut self, call: &'a ExprMethodCall) {
        let name = call.method.to_string();
        let is_short = SHORT.contains(&&*name);
        if is_short || WHOLE.contains(&&*name) {
            self.pass(&call.receiver, is_short, call.method.span().start().line);
        }
        self.visit_expr(&call.receiver);
        let is_long = root_of(&call.receiver).is_some();
        let is_each = EACH.contains(&&*name) || MAYBE_EACH.contains(&&*name) && is_iterator(&call.receiver);
        for argument in &call.args {
            match argument {
                Expr::Closure(closure) if is_each && is_long => {
                    let made = closure.inputs.iter().flat_map(in_pattern).collect();
                    let changed = names_of(|names| names.visit_expr(&closure.body)).changed;
                    self.round(closure, made, changed, |search| search.visit_expr(&closure.body));
                }
                argument => self.visit_expr(argument),
            }
        }
    }
}

/// The sources of the readers.
fn sources(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).expect("a folder").map(|entry| entry.expect("readable").path());
    let is_source = |path: &PathBuf| path.is_dir() || path.extension().is_some_and(|extension| extension == "rs");
    let entries = entries.filter(|path| is_source(path) && !OTHERS.iter().any(|name| path.ends_with(name)));
    entries.flat_map(|path| sources(&path)).collect()
}

#[test]
fn loops_over_foreign_data_are_counted() {
    let crates = root().join("crates");
    let mut found = BTreeSet::new();
    for path in READERS.iter().flat_map(|reader| sources(&crates.join(reader))) {
        let name = path.strip_prefix(&crates).expect("below").display().to_string();
        let source = fs::read_to_string(&path).expect("a source");
        found.extend(uncounted(&source).into_iter().map(|line| format!("{name}: {line}")));
    }
    let listed = include_str!("loops.txt").lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let listed: BTreeSet<String> = listed.map(str::to_owned).collect();
    let new: Vec<_> = found.difference(&listed).collect();
    assert!(new.is_empty(), "charge a meter, name a limit, or say in loops.txt why these are bounded:\n{new:#?}");
    let gone: Vec<_> = listed.difference(&found).collect();
    assert!(gone.is_empty(), "no such loops any more:\n{gone:#?}");
}

#[test]
fn the_search_finds_what_was_wrong() {
    let checks: BTreeMap<&str, usize> = BTreeMap::from([
        // Nodes of a mesh that contain each other; the same with a limit.
        ("while let Some(node) = open.pop() { open.extend(children(node)); }", 1),
        (
            "while let Some(node) = open.pop() { visits += 1; if visits > MAX { return; } open.extend(children(node)); }",
            0,
        ),
        ("while let Some(node) = open.pop() { done += node.count; }", 0),
        ("for node in nodes { if nodes.iter().any(|other| other.has(node)) { roots.push(node); } }", 1),
        ("let roots = nodes.iter().filter(|node| !nodes.iter().any(|other| other.has(node))).count();", 1),
        ("let roots = nodes.iter().filter(|node| !NAMES.iter().any(|name| name == node)).count();", 0),
        // A cell that grows and is looked through at each quote; one look at each cell.
        ("while let Some(c) = rest.next() { if cell.trim().is_empty() { cell.push(c); } }", 1),
        ("for c in text.chars() { if cell.contains('#') { cell.push(c); } }", 1),
        ("for cell in cells { if cell.contains('#') { links.push(cell); } }", 0),
        ("for c in text.chars() { work.charge(cell.len())?; if cell.contains('#') { cell.push(c); } }", 0),
        // A text that becomes shorter: up to what is found, and as a whole.
        ("while let Some(at) = rest.find(';') { rest = &rest[at + 1..]; }", 0),
        ("while let Some(at) = rest.find(';') { rest = &rest[at + 1..]; if rest.contains('#') { return; } }", 1),
        ("while let Some(c) = text[at..].chars().next() { at += c.len_utf8(); }", 0),
        ("while let Some(c) = text[..at].chars().next() { at += c.len_utf8(); }", 1),
        ("loop { step(); }", 1),
        ("while is_open(text) { step(); }", 1),
    ]);
    for (body, count) in checks {
        assert_eq!(uncounted(&format!("fn read() {{\n{body}\n}}")).len(), count, "{body}");
    }
}
