//! No assertion of any crate is always true: none compares an expression with itself, and none is a constant.

use std::fs;
use std::path::Path;

#[test]
fn no_assertion_is_always_true() {
    let (mut count, mut failures) = (0, vec![]);
    visit(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."), &mut |path, text| {
        for (line, is_equality, arguments) in assertions(text) {
            count += 1;
            if is_always_true(is_equality, &arguments) {
                failures.push(format!("{}:{line}: {}", path.display(), arguments.join(", ")));
            }
        }
    });
    assert!(count > 1500, "{count} assertions were read");
    assert!(failures.is_empty(), "always true:\n{}", failures.join("\n"));
}

#[test]
fn assertions_that_are_always_true_are_seen() {
    let check = |rest: &str| {
        let found = assertions(&format!("f();\n    prop_assert{rest};")).next().expect("an assertion");
        assert_eq!(found.0, 2);
        is_always_true(found.1, &found.2)
    };
    for rest in
        ["_eq!(a(1, 2), &a(1,\n 2))", "_eq!(\"x, y\", \"x, y\")", "!(b && a == a)", "!(true, \"{x}\")", "!(c || true)"]
    {
        assert!(check(rest), "{rest}");
    }
    for rest in ["_eq!(a(1, 2), a(1, 3))", "_eq!(a, '\"', \"{a}\")", "!(a == b && a <= c)", "!(f(|| a), \"a == a\")"] {
        assert!(!check(rest), "{rest}");
    }
}

/// Gives every file of Rust below a folder, and its text.
fn visit(folder: &Path, file: &mut dyn FnMut(&Path, &str)) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() && path.file_name().is_some_and(|name| name != "target" && name != "node_modules") {
            visit(&path, file);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            file(&path, &fs::read_to_string(&path).expect("UTF-8"));
        }
    }
}

/// The assertions in a text: the line, whether two values must be equal, and the arguments without white space. Two
/// equal arguments of `assert_ne!` are no fault, because they can only differ if they are random.
fn assertions(text: &str) -> impl Iterator<Item = (usize, bool, Vec<String>)> {
    text.match_indices("assert").filter_map(|(at, word)| {
        let rest = &text[at + word.len()..];
        let (is_equality, rest) = match rest.strip_prefix("_eq!(") {
            Some(rest) => (true, rest),
            None => (false, rest.strip_prefix("!(")?),
        };
        Some((text[..at].matches('\n').count() + 1, is_equality, arguments(rest)))
    })
}

/// The arguments up to the closing parenthesis, without white space outside of strings.
fn arguments(text: &str) -> Vec<String> {
    let (mut arguments, mut depth, mut rest) = (vec![String::new()], 0, text);
    while let Some(c) = rest.chars().next() {
        let length = literal(rest).unwrap_or(c.len_utf8());
        match c {
            ')' | ']' | '}' if depth == 0 => break,
            ',' if depth == 0 => arguments.push(String::new()),
            _ if c.is_whitespace() => {}
            _ => arguments.last_mut().expect("one argument").push_str(&rest[..length]),
        }
        depth += i32::from("([{".contains(c)) - i32::from(")]}".contains(c));
        rest = &rest[length..];
    }
    arguments
}

/// The length of the string or character at the beginning of a text.
fn literal(text: &str) -> Option<usize> {
    let mut characters = text.char_indices();
    let (_, quote) = characters.next().filter(|(_, c)| ['"', '\''].contains(c))?;
    let mut is_escaped = false;
    let end = characters.find_map(|(at, c)| {
        let ends = c == quote && !is_escaped;
        is_escaped = c == '\\' && !is_escaped;
        ends.then_some(at)
    })?;
    // A lifetime has no closing quote near it.
    (quote == '"' || end <= 4 || text[1..].starts_with('\\')).then_some(end + 1)
}

/// Whether an assertion with these arguments cannot fail.
fn is_always_true(is_equality: bool, arguments: &[String]) -> bool {
    let same = |a: &str, b: &str| a.trim_start_matches(['&', '*']) == b.trim_start_matches(['&', '*']);
    let [first, rest @ ..] = arguments else { return false };
    if is_equality {
        return rest.first().is_some_and(|second| same(first, second));
    }
    let compares_itself = |part: &str| {
        let mut sides = ["==", "<=", ">="].iter().filter_map(|sign| part.split_once(sign));
        sides.any(|(left, right)| same(left, right))
    };
    first == "true"
        || first.ends_with("||true")
        || first.split("&&").flat_map(|part| part.split("||")).any(compares_itself)
}
