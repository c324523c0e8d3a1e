//! The rules of L-Py that are Python code: `if`, `produce` and assignments become conditions and successors.
//!
//! ```text
//! A(t) :
//!   if t < 3: produce F A(t+1)      A(t) : t < 3 --> F A(t+1)
//!   else:
//!     x = t/2                       A(t) --> F(t/2)
//!     produce F(x)
//! ```

use super::arithmetic::Arithmetic;
use super::assignments::{SEVERAL, TOO_LONG, Values, is_name, is_random, prints};
use super::macros::arguments;
use core::ops::Range;
use lsystem_base::say;
use std::borrow::Cow;

/// A successor, and when it is made. The order decides between successors whose conditions hold.
#[derive(Debug, PartialEq)]
pub(super) struct Made<'c> {
    pub(super) condition: String,
    /// A part of the text if no value is written into it.
    pub(super) successor: Cow<'c, str>,
}

/// A reason why code cannot be read, and the code.
pub(super) type Wrong<'c> = (&'c str, String);

/// A statement.
#[derive(Debug)]
enum Statement<'c> {
    Assign(&'c str, String),
    /// A word, and whether the rule ends behind it.
    Produce(&'c str, bool),
    /// Conditions, the last of them empty for `else`, and what follows.
    If(Vec<(&'c str, Vec<Self>)>),
    /// A loop over whole numbers.
    For(&'c str, &'c str, Vec<Self>),
}

/// A line with its indentation.
#[derive(Clone, Copy, Debug)]
struct Line<'c> {
    indent: usize,
    text: &'c str,
}

/// The most ways through a rule, and conditions of a way.
const MAX_WAYS: usize = 64;
/// The most turns of a loop.
const MAX_TURNS: f64 = 500.0;
/// The most bytes of all successors of a rule.
const LONGEST: usize = 20_000;

/// The successors of a rule, whose code is `inline` behind its colon and `lines` below.
pub(super) fn successors<'c>(
    inline: &'c str,
    lines: &[&'c str],
    arithmetic: &Arithmetic,
) -> Result<Vec<Made<'c>>, Wrong<'c>> {
    let mut all = Vec::new();
    if !inline.trim().is_empty() {
        all.push(Line { indent: usize::MAX, text: inline.trim() });
    }
    all.extend(lines.iter().filter(|line| !line.trim().is_empty()).map(|line| {
        let indent = line.chars().take_while(|c| c.is_whitespace()).map(|c| if c == '\t' { 8 } else { 1 }).sum();
        Line { indent, text: line.trim() }
    }));
    let mut at = 0;
    let statements = if let Some(Line { indent: usize::MAX, text }) = all.first() {
        at = 1;
        vec![simple(text)?].into_iter().flatten().collect()
    } else {
        block(&all, &mut at)?
    };
    if let Some(line) = all.get(at) {
        return Err((line.text, not_run()));
    }
    let mut ways = Ways { arithmetic, made: Vec::new(), length: 0 };
    let whole = all.first().map_or("", |line| line.text);
    let open = ways.run(&statements, vec![Way::default()]).map_err(|why| (whole, why))?;
    // A rule may also end without `produce`.
    for way in open.into_iter().filter(|way| way.has_made) {
        ways.end(way).map_err(|why| (whole, why))?;
    }
    Ok(ways.made)
}

fn not_run() -> String {
    say!("Python code is not run")
}

/// The statements of the lines that are as far in as the first.
fn block<'c>(lines: &[Line<'c>], at: &mut usize) -> Result<Vec<Statement<'c>>, Wrong<'c>> {
    let mut found = Vec::new();
    let Some(indent) = lines.get(*at).map(|line| line.indent) else { return Ok(found) };
    if indent > 400 {
        return Err((lines[*at].text, not_run()));
    }
    while let Some(&line) = lines.get(*at).filter(|line| line.indent == indent) {
        *at += 1;
        let Some((word, head)) = compound(line.text) else {
            found.extend(simple(line.text)?);
            continue;
        };
        let (head, inline) = head_and_rest(head).ok_or_else(|| (line.text, not_run()))?;
        let body = if inline.is_empty() {
            match lines.get(*at) {
                Some(next) if next.indent > indent => block(lines, at)?,
                _ => return Err((line.text, not_run())),
            }
        } else {
            simple(inline)?.into_iter().collect()
        };
        match (word, found.last_mut()) {
            ("if", _) => found.push(Statement::If(vec![(head, body)])),
            ("elif", Some(Statement::If(cases))) if cases.last().is_some_and(|(last, _)| !last.is_empty()) => {
                cases.push((head, body));
            }
            ("else", Some(Statement::If(cases))) if cases.last().is_some_and(|(last, _)| !last.is_empty()) => {
                cases.push(("", body));
            }
            ("for", _) => {
                let (name, range) = head.split_once(" in ").ok_or_else(|| (line.text, not_run()))?;
                if !is_name(name.trim()) {
                    return Err((line.text, not_run()));
                }
                found.push(Statement::For(name.trim(), range.trim(), body));
            }
            _ => return Err((line.text, not_run())),
        }
    }
    Ok(found)
}

/// The word of a statement with a block, and what stands behind.
fn compound(text: &str) -> Option<(&'static str, &str)> {
    ["if", "elif", "else", "for"].into_iter().find_map(|word| {
        let rest = text.strip_prefix(word)?;
        rest.starts_with(|c: char| c.is_whitespace() || c == '(' || c == ':').then_some((word, rest))
    })
}

/// The parts before and behind the colon that begins a block.
pub(super) fn head_and_rest(text: &str) -> Option<(&str, &str)> {
    let mut depth = 0_usize;
    let colon = text.char_indices().find(|&(_, ch)| {
        depth = (depth + usize::from("([{".contains(ch))).saturating_sub(usize::from(")]}".contains(ch)));
        depth == 0 && ch == ':'
    });
    colon.map(|(at, _)| (text[..at].trim(), text[at + 1..].trim()))
}

/// A statement on one line; `None` for one without effect.
fn simple(text: &str) -> Result<Option<Statement<'_>>, Wrong<'_>> {
    if text == "pass" || prints(text) || text.starts_with(['"', '\'']) {
        return Ok(None);
    }
    for (word, ends) in [("produce", true), ("nproduce", false)] {
        let rest = text.strip_prefix(word);
        if let Some(rest) = rest.filter(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_')) {
            let word = rest.trim();
            return Ok(Some(Statement::Produce(if word == "*" { "" } else { word }, ends)));
        }
    }
    let (name, value) = text.split_once('=').ok_or_else(|| (text, not_run()))?;
    let (name, operator) = match name.trim_end().strip_suffix(['+', '-', '*', '/']) {
        Some(short) => (short.trim(), &name.trim_end()[short.len()..]),
        None => (name.trim(), ""),
    };
    if !is_name(name) || value.starts_with('=') || value.trim().is_empty() {
        return Err((text, not_run()));
    }
    let value = value.trim();
    Ok(Some(Statement::Assign(
        name,
        match operator {
            "" => value.to_owned(),
            operator => format!("{name} {operator} ({value})"),
        },
    )))
}

/// A way through a rule.
#[derive(Clone, Debug, Default)]
struct Way<'c> {
    conditions: Vec<String>,
    values: Values,
    made: Cow<'c, str>,
    has_made: bool,
}

/// All ways through a rule.
struct Ways<'p, 'c> {
    arithmetic: &'p Arithmetic,
    made: Vec<Made<'c>>,
    length: usize,
}

impl<'c> Ways<'_, 'c> {
    /// Follows the statements. Returns the ways that reach their end.
    fn run(&mut self, statements: &[Statement<'c>], mut open: Vec<Way<'c>>) -> Result<Vec<Way<'c>>, String> {
        for statement in statements {
            if open.len() > MAX_WAYS {
                return Err(TOO_LONG.to_owned());
            }
            self.arithmetic.macros.spend(open.iter().map(|way| 20 + way.made.len()).sum())?;
            open = match statement {
                Statement::Assign(name, value) => {
                    for way in &mut open {
                        way.values.assign(name, value)?;
                    }
                    open
                }
                Statement::Produce(word, ends) => {
                    for way in &mut open {
                        let own = way.values.put(word, 0)?;
                        if way.made.is_empty() && own == *word {
                            way.made = Cow::Borrowed(word);
                        } else {
                            way.made.to_mut().push_str(&own);
                        }
                        way.has_made = true;
                        if way.made.len() > LONGEST {
                            return Err(TOO_LONG.to_owned());
                        }
                    }
                    if *ends {
                        open.into_iter().try_for_each(|way| self.end(way))?;
                        Vec::new()
                    } else {
                        open
                    }
                }
                Statement::If(cases) => self.cases(cases, open)?,
                Statement::For(name, range, body) => {
                    let mut next = Vec::new();
                    for way in open {
                        let range = way.values.put(range, 1)?;
                        let mut ways = vec![way];
                        for value in self.range(&range)? {
                            for way in &mut ways {
                                way.values.assign(name, &value.to_string())?;
                            }
                            ways = self.run(body, ways)?;
                        }
                        next.extend(ways);
                    }
                    next
                }
            };
        }
        Ok(open)
    }

    fn cases(&mut self, cases: &[(&'c str, Vec<Statement<'c>>)], open: Vec<Way<'c>>) -> Result<Vec<Way<'c>>, String> {
        let mut next = Vec::new();
        for way in open {
            let mut others = way;
            let mut has_else = false;
            for (condition, body) in cases {
                if next.len() > MAX_WAYS || others.conditions.len() > MAX_WAYS {
                    return Err(TOO_LONG.to_owned());
                }
                let condition = others.values.put(condition, 1)?;
                has_else |= condition.is_empty();
                let mut own = others.clone();
                if !condition.is_empty() {
                    own.conditions.push(condition.clone());
                }
                let made = self.made.len();
                let ends = self.run(body, vec![own])?;
                // Each rule would draw another number.
                let rules = self.made.len() - made + ends.len();
                if is_random(&condition) && (rules > 1 || !ends.is_empty()) {
                    return Err(SEVERAL.to_owned());
                }
                // Where each way of this case makes a successor, the order of the rules says the rest.
                if !condition.is_empty() && !ends.is_empty() {
                    others.conditions.push(format!("not ({condition})"));
                }
                next.extend(ends);
            }
            if !has_else {
                next.push(others);
            }
        }
        Ok(next)
    }

    fn end(&mut self, way: Way<'c>) -> Result<(), String> {
        let conditions = way.conditions;
        let condition = match conditions.as_slice() {
            [one] => one.clone(),
            several => several.iter().map(|one| format!("({one})")).collect::<Vec<_>>().join(" and "),
        };
        self.length += condition.len() + way.made.len();
        if self.length > LONGEST {
            return Err(TOO_LONG.to_owned());
        }
        self.made.push(Made { condition, successor: way.made });
        Ok(())
    }

    /// The numbers of `range(...)`.
    fn range(&self, text: &str) -> Result<Range<i64>, String> {
        let wrong = || say!("Python code is not run: a loop over `{}`", text);
        let inside = text.strip_prefix("range").or_else(|| text.strip_prefix("xrange")).ok_or_else(wrong)?;
        let (given, behind) = inside.trim_start().strip_prefix('(').and_then(arguments).ok_or_else(wrong)?;
        let values: Option<Vec<f64>> = given.iter().map(|value| self.arithmetic.value(value)).collect();
        let range = match (values.as_deref(), behind.trim()) {
            (Some(&[end]), "") => 0.0..end,
            (Some(&[start, end]), "") => start..end,
            _ => return Err(wrong()),
        };
        if range.end - range.start > MAX_TURNS {
            return Err(TOO_LONG.to_owned());
        }
        Ok(range.start as i64..range.end as i64)
    }
}
