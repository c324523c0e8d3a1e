//! The L-system files of cpfg, and the arrow rules of L-Py.
//!
//! ```text
//! lsystem: 1                 Axiom: A
//! #define r 0.9              derivation length: 4
//! derivation length: 5       production:
//! axiom: A(1)                A --> F[+A]-A
//! A(s) : s > 0.1 --> F(s)[+A(s*r)]
//! homomorphism
//! F(s) --> !(0.1)F(s)
//! endlsystem
//! ```
//!
//! The rules are nearly in our notation. Names of several letters become single symbols. Decompositions are written into
//! the successors, and the values of local assignments in place of their names. Other blocks of code, includes, and
//! symbols that need other files are refused. The angle stands in another file.

use crate::assignments::inlined;
use crate::decomposition::Decomposition;
use crate::draft::{Draft, FreeSymbols};
use crate::source::Source;
use lsystem_syntax::{Diagnostic, parse};
use std::collections::{BTreeMap, BTreeSet};

/// A line without comments, with its number.
type Line = (usize, String);

/// The notation of a text.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Cpfg,
    LPy,
}

pub(super) fn read_cpfg<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let begins = |line: &str| keyword(line).is_some_and(|(word, _)| word == "lsystem");
    text.lines().any(begins).then(|| vec![system(source, Kind::Cpfg)])
}

pub(super) fn read_lpy<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let has =
        |names: &[&str]| text.lines().any(|line| keyword(line).is_some_and(|(word, _)| names.contains(&word.as_str())));
    let is_lpy =
        has(&["axiom"]) && has(&["production", "derivation length"]) && text.contains("-->") && !has(&["lsystem"]);
    (is_lpy || (has(&["axiom"]) && has(&["production"]))).then(|| vec![system(source, Kind::LPy)])
}

/// The words that begin a statement.
const KEYWORDS: [&str; 17] = [
    "lsystem",
    "axiom",
    "derivation length",
    "ignore",
    "consider",
    "seed",
    "homomorphism",
    "interpretation",
    "production",
    "decomposition",
    "maximum depth",
    "endlsystem",
    "start",
    "end",
    "starteach",
    "endeach",
    "group",
];

/// The keyword at the start of a line, in lower case, and the text behind its colon.
fn keyword(line: &str) -> Option<(String, &str)> {
    let line = line.trim();
    let (word, rest) = line.split_once(':').unwrap_or((line, ""));
    let word = word.trim().to_ascii_lowercase();
    let alone =
        matches!(word.as_str(), "homomorphism" | "interpretation" | "decomposition" | "endlsystem" | "production");
    (KEYWORDS.contains(&word.as_str()) && (alone || line.contains(':'))).then_some((word, rest.trim()))
}

/// The statements of a text: without comments, continued lines joined.
fn statements(text: &str, kind: Kind) -> Vec<Line> {
    let mut found: Vec<Line> = Vec::new();
    let (mut in_comment, mut continued) = (false, false);
    for (at, line) in text.lines().enumerate() {
        let mut own = String::new();
        let mut rest = line;
        while !rest.is_empty() {
            if in_comment {
                let Some(end) = rest.find("*/") else { break };
                (rest, in_comment) = (&rest[end + 2..], false);
                own.push(' ');
                continue;
            }
            let comment = rest.match_indices('/').find(|&(at, _)| rest[at + 1..].starts_with(['*', '/']));
            let comment = comment.map_or(rest.len(), |(at, _)| at);
            let hash = if kind == Kind::LPy { rest[..comment].find('#') } else { None };
            own.push_str(&rest[..hash.unwrap_or(comment)]);
            if hash.is_some() || !rest[comment..].starts_with("/*") {
                break;
            }
            (rest, in_comment) = (&rest[comment + 2..], true);
        }
        let own = own.trim_end();
        let (own, continues) = own.strip_suffix('\\').map_or((own, false), |own| (own, true));
        let indented =
            line.starts_with([' ', '\t']) && !own.contains("-->") && keyword(own).is_none() && !own.contains(':');
        match found.last_mut() {
            Some((_, last)) if continued || (indented && last.contains("-->")) => {
                last.push(' ');
                last.push_str(own.trim());
            }
            _ if own.trim().is_empty() => {}
            _ => found.push((at + 1, own.trim().to_owned())),
        }
        continued = continues;
    }
    found
}

/// The parts of a system, as text in the source's notation.
#[derive(Default)]
struct Parts {
    axiom: (usize, String),
    constants: Vec<(String, String)>,
    headings: Vec<String>,
    rules: Vec<Line>,
    images: Vec<Line>,
    /// The line of the keyword, and the decompositions below it.
    decomposed: Option<usize>,
    decompositions: Vec<Line>,
    decomposition_depth: Option<String>,
    length: Option<(usize, String)>,
    depth: Option<String>,
}

/// The section of a file whose rules are being read.
#[derive(Clone, Copy, PartialEq)]
enum Section {
    Productions,
    Decompositions,
    Images,
}

fn system(source: Source<'_>, kind: Kind) -> Draft<'_> {
    let mut draft = Draft::new(source, "", 1);
    draft.definition.step = 1.0;
    if kind == Kind::LPy {
        // The other way round than in ABOP and cpfg.
        draft.meaning('/', "roll left");
        draft.meaning('\\', "roll right");
    }
    let mut parts = Parts::default();
    let mut macros: BTreeMap<String, String> = BTreeMap::new();
    let mut section = Section::Productions;
    let mut ended = false;
    for (at, line) in statements(source.text, kind) {
        if ended {
            break;
        }
        if let Some((word, rest)) = keyword(&line) {
            match word.as_str() {
                "axiom" => parts.axiom = (at, rest.to_owned()),
                "derivation length" => parts.length = Some((at, rest.to_owned())),
                "ignore" | "consider" => parts.headings.push(format!("{word}: {rest}")),
                "seed" => match rest.parse() {
                    Ok(seed) => draft.definition.seed = seed,
                    Err(_) => draft.note(at, &line, "The seed is not read"),
                },
                "homomorphism" | "interpretation" => section = Section::Images,
                "production" => section = Section::Productions,
                "decomposition" => {
                    section = Section::Decompositions;
                    parts.decomposed = Some(at);
                }
                "maximum depth" if section == Section::Decompositions => {
                    parts.decomposition_depth = Some(rest.to_owned());
                }
                "maximum depth" => parts.depth = Some(rest.to_owned()),
                "start" | "end" | "starteach" | "endeach" => draft.refuse(at, &line, "Code is not run"),
                "group" => draft.refuse(at, &line, "Groups of productions are not possible"),
                "endlsystem" => ended = true,
                _ => {}
            }
            continue;
        }
        if line.starts_with('#') && kind == Kind::Cpfg {
            directive(at, &line, &mut parts, &mut macros, &mut draft);
            continue;
        }
        if let Some(arrow) = line.find("-->") {
            let mut line = line;
            if line[..arrow].contains('{') {
                match inlined(&line) {
                    Some(own) if kind == Kind::Cpfg => line = own,
                    _ => draft.refuse(at, &line, "Of the code in a production, only assignments are read"),
                }
            }
            let list = match section {
                Section::Productions => &mut parts.rules,
                Section::Decompositions => &mut parts.decompositions,
                Section::Images => &mut parts.images,
            };
            list.push((at, line));
            continue;
        }
        other(at, &line, kind, &mut parts, &mut draft);
    }
    if parts.axiom.1.is_empty() {
        draft.refuse(1, "", "There is no axiom");
    }
    let rules = [&parts.rules, &parts.decompositions, &parts.images].into_iter().flatten();
    let size = rules.map(|(_, rule)| rule.len()).sum::<usize>() + parts.axiom.1.len();
    if size > 200_000 || parts.constants.len() > 1000 {
        draft.refuse(1, "", "The rules are too long");
    }
    if !draft.is_refused() {
        translate(&parts, &macros, kind, &mut draft);
    }
    draft
}

/// Reads a line of the preprocessor.
fn directive(at: usize, line: &str, parts: &mut Parts, macros: &mut BTreeMap<String, String>, draft: &mut Draft<'_>) {
    let Some(rest) = line.strip_prefix("#define").filter(|rest| rest.starts_with([' ', '\t'])) else {
        return draft.refuse(at, line, "Of the preprocessor, only #define is read");
    };
    let rest = rest.trim();
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
    let (name, value) = rest.split_at(end);
    if value.starts_with('(') {
        return draft.refuse(at, line, "Macros with parameters are not read");
    }
    let value = value.trim();
    if value.is_empty() {
        return;
    }
    if parts.constants.len() + macros.len() >= 200 {
        return draft.refuse(at, line, "At most 200 definitions are read");
    }
    // A value is a constant if it is arithmetic of the constants before it.
    let earlier: Vec<String> = parts.constants.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let constant = format!("{}\n{name} = {value}", earlier.join("\n"));
    let (grammar, diagnostics) = parse("", &constant);
    let is_constant =
        grammar.constant(name).is_some_and(f64::is_finite) && !diagnostics.iter().any(Diagnostic::is_error);
    if is_constant {
        parts.constants.push((name.to_owned(), value.to_owned()));
    } else {
        macros.insert(name.to_owned(), value.to_owned());
    }
}

/// Reads a line without a keyword and without an arrow.
fn other(at: usize, line: &str, kind: Kind, parts: &mut Parts, draft: &mut Draft<'_>) {
    if kind == Kind::Cpfg {
        return draft.refuse(at, line, "This line cannot be read");
    }
    if let Some((_, rest)) = line.split_once("setAngleIncrement(") {
        match rest.split(')').next().and_then(|angle| angle.trim().parse().ok()) {
            Some(angle) => {
                draft.definition.angle = angle;
                draft.meaning('\0', "");
            }
            None => draft.refuse(at, line, "Python code is not run"),
        }
        return;
    }
    let harmless = ["from ", "import ", "module ", "\"\"\"", "__lpy_code_version__", "context()"];
    match line.split_once('=') {
        Some((name, value))
            if value.trim().parse::<f64>().is_ok() && name.trim().chars().all(|c| c.is_alphanumeric() || c == '_') =>
        {
            parts.constants.push((name.trim().to_owned(), value.trim().to_owned()));
        }
        _ if line.starts_with("module ") => {}
        _ if harmless.iter().any(|start| line.starts_with(start)) => draft.note(at, line, "Python code is not run"),
        _ => draft.refuse(at, line, "Python code is not run"),
    }
}

fn translate(parts: &Parts, macros: &BTreeMap<String, String>, kind: Kind, draft: &mut Draft<'_>) {
    let mut free = FreeSymbols::default();
    let all = [&parts.rules[..], &parts.decompositions, &parts.images].concat();
    free.add_used(&parts.axiom.1);
    all.iter().for_each(|(_, rule)| free.add_used(rule));
    parts.constants.iter().for_each(|(name, _)| free.add_used(name));
    // Names of several letters: those that productions replace.
    let mut names: BTreeSet<String> = BTreeSet::new();
    for (_, rule) in &all {
        let head = strict(rule);
        let end = head.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(head.len());
        if head[..end].chars().nth(1).is_some() && names.len() < 500 {
            names.insert(head[..end].to_owned());
        }
    }
    let mut words = Words { names, macros, free, told: BTreeSet::new() };
    draft.definition.axiom = words.translate(&parts.axiom.1, parts.axiom.0, true, draft);
    let mut rule = |(at, rule): &Line, draft: &mut Draft| {
        let arrow = rule.find("-->").unwrap_or_default();
        let head = words.translate(without_label(&rule[..arrow]), *at, false, draft);
        format!("{} --> {}", head.trim(), words.translate(&rule[arrow + 3..], *at, true, draft).trim())
    };
    let rules: Vec<String> = parts.rules.iter().map(|line| rule(line, draft)).collect();
    let images: Vec<String> = parts.images.iter().map(|line| rule(line, draft)).collect();
    let decompositions: Vec<String> = parts.decompositions.iter().map(|line| rule(line, draft)).collect();
    let mut text = vec![draft.definition.axiom.clone()];
    text.extend([&rules[..], &images, &decompositions].concat());
    let text = text.join("\n");
    let used = identifiers(&text);
    let mut lines: Vec<String> = Vec::new();
    let mut needed = used;
    let mut constants: Vec<&(String, String)> = Vec::new();
    for constant in parts.constants.iter().rev() {
        if needed.contains(&constant.0) {
            needed.extend(identifiers(&constant.1));
            constants.push(constant);
        }
    }
    lines.extend(constants.iter().rev().map(|(name, value)| format!("{name} = {value}")));
    let decompositions = [&lines[..], &decompositions].concat().join("\n");
    lines.extend(parts.headings.iter().cloned());
    lines.extend(rules);
    if !images.is_empty() {
        lines.push("draw:".to_owned());
        lines.extend(images);
    }
    draft.definition.rules = lines.join("\n");
    if let Some(at) = parts.decomposed {
        decompose(parts, at, &decompositions, draft);
    }
    length(parts, macros, draft);
    let (grammar, _) = parse(&draft.definition.axiom, &draft.definition.rules);
    let imaged: BTreeSet<char> = grammar.images.iter().map(|image| image.predecessor.symbol).collect();
    let repeated = |module: &lsystem_syntax::Module| imaged.contains(&module.symbol);
    if parts.depth.as_deref() != Some("1") && grammar.images.iter().any(|image| image.successor.iter().any(repeated)) {
        let (at, line) = parts.images.first().cloned().unwrap_or_default();
        draft.refuse(at, &line, "The homomorphism is applied to its own results; here it is applied only once");
    }
    let plain_turn = grammar
        .made()
        .chain(grammar.images.iter().flat_map(|image| &image.successor))
        .any(|module| module.arguments.is_empty() && "+-&^/\\".contains(module.symbol));
    let known = draft.meanings.len();
    draft.meanings.retain(|(symbol, _)| *symbol != '\0');
    if draft.meanings.len() == known {
        draft.definition.angle = if kind == Kind::LPy { 60.0 } else { 90.0 };
        if plain_turn {
            let why = match kind {
                Kind::Cpfg => "The angle stands in cpfg's view file; 90 degrees is chosen",
                Kind::LPy => "The text gives no angle; 60 degrees is the default of L-Py",
            };
            draft.note(1, "", why);
        }
    }
}

/// Writes the decompositions, whose keyword stands in this line, into the axiom and the successors.
fn decompose(parts: &Parts, at: usize, decompositions: &str, draft: &mut Draft<'_>) {
    let (mut grammar, wrong) = parse(&draft.definition.axiom, &draft.definition.rules);
    let (own, own_wrong) = parse("", decompositions);
    if wrong.iter().chain(&own_wrong).any(Diagnostic::is_error) {
        return draft.refuse(at, "decomposition", "A decomposition or a production cannot be read");
    }
    let depth = match &parts.decomposition_depth {
        None => Some(1),
        Some(text) => text.trim().parse().ok(),
    };
    let Some(depth) = depth else { return draft.refuse(at, "decomposition", "The maximum depth cannot be read") };
    match Decomposition::new(&own, depth).and_then(|decomposition| decomposition.apply(&mut grammar)) {
        Ok(()) => draft.grammar(&grammar),
        Err(why) => draft.refuse(at, "decomposition", why),
    }
}

/// Takes over the derivation length: a number or a constant.
fn length(parts: &Parts, macros: &BTreeMap<String, String>, draft: &mut Draft<'_>) {
    let Some((at, text)) = &parts.length else { return };
    let text = macros.get(text).unwrap_or(text);
    let lines: Vec<String> = parts.constants.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let (grammar, _) = parse("", &format!("{}\nlength_ = {text}", lines.join("\n")));
    match grammar.constant("length_").filter(|value| value.is_finite()) {
        Some(value) => draft.iterations(*at, &value.to_string()),
        None => draft.note(*at, text, "The derivation length cannot be read"),
    }
}

/// The strict predecessor of a production and what follows it.
fn strict(rule: &str) -> &str {
    let head = without_label(&rule[..rule.find("-->").unwrap_or(rule.len())]);
    // A `<` in front of the condition separates the left context.
    let end = head.find(':').unwrap_or(head.len());
    head[..end].rfind('<').map_or(head, |at| &head[at + 1..]).trim()
}

/// A production without its label `p1:`.
fn without_label(text: &str) -> &str {
    let Some((name, rest)) = text.split_once(':') else { return text };
    let name = name.trim();
    let is_label =
        name.len() > 1 && name.chars().all(char::is_alphanumeric) && name.ends_with(|c: char| c.is_ascii_digit());
    if is_label { rest.trim_start() } else { text }
}

/// The names inside parentheses and conditions.
fn identifiers(text: &str) -> BTreeSet<String> {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
    words.map(str::to_owned).collect()
}

/// The translation of words.
struct Words<'a> {
    names: BTreeSet<String>,
    macros: &'a BTreeMap<String, String>,
    free: FreeSymbols,
    told: BTreeSet<String>,
}

impl Words<'_> {
    /// Replaces names and symbols of several characters. Arguments stay as they are.
    fn translate(&mut self, text: &str, line: usize, word: bool, draft: &mut Draft<'_>) -> String {
        let chars: Vec<char> = text.chars().collect();
        let mut out = String::new();
        let (mut at, mut depth) = (0, 0_usize);
        let mut head = true;
        while at < chars.len() {
            let ch = chars[at];
            depth = (depth + usize::from(ch == '(')).saturating_sub(usize::from(ch == ')'));
            head &= word || depth > 0 || ch != ':';
            let starts = ch.is_alphabetic() && (at == 0 || depth == 0 || !chars[at - 1].is_alphanumeric());
            if depth > 0 || !head {
                // A name is looked up only where it starts, so that each character is visited twice at most.
                let starts = starts && (at == 0 || !chars[at - 1].is_alphanumeric()) && !self.macros.is_empty();
                let length = chars[at..].iter().take_while(|c| starts && (c.is_alphanumeric() || **c == '_')).count();
                let name: String = chars[at..at + length].iter().collect();
                match self.macros.get(&name) {
                    Some(value) if starts => {
                        out.push_str(&format!("({value})"));
                        at += length;
                    }
                    _ => {
                        out.push(ch);
                        at += 1;
                    }
                }
                continue;
            }
            if starts && let Some((name, symbol)) = self.name(&chars[at..], line, draft) {
                out.push_str(&symbol);
                at += name;
                continue;
            }
            let next = chars.get(at + 1).copied();
            match (ch, next) {
                ('@', Some(kind @ ('o' | 'c' | 'O'))) => {
                    if kind == 'O' {
                        draft.note(line, "@O", "A sphere is drawn as a disc");
                    }
                    out.push('●');
                    at += 2;
                }
                // Rolls until the turtle's left is level, as `$` of ABOP.
                ('@', Some('v')) => {
                    out.push('$');
                    at += 2;
                }
                ('@' | '~' | '?', Some(kind)) if !kind.is_whitespace() => {
                    let why = "This symbol of cpfg has no equal here: it needs another file, or changes the turtle";
                    draft.refuse(line, &format!("{ch}{kind}"), why);
                    at += 2;
                }
                _ => {
                    out.push(ch);
                    at += 1;
                }
            }
        }
        out
    }

    /// The length of the longest known name at the start, and its replacement.
    fn name(&mut self, chars: &[char], line: usize, draft: &mut Draft<'_>) -> Option<(usize, String)> {
        if self.names.is_empty() && self.macros.is_empty() {
            return None;
        }
        const LONGEST: usize = 40;
        let is_part = |c: &char| c.is_alphanumeric() || *c == '_';
        let end = chars.iter().take(LONGEST).take_while(|c| is_part(c)).count();
        for length in (2..=end).rev() {
            let name: String = chars[..length].iter().collect();
            if self.names.contains(&name) {
                let symbol = self.free.get(&name);
                if self.told.insert(name.clone()) {
                    draft.note(line, &name, format!("The name `{name}` becomes the symbol `{symbol}`"));
                }
                return Some((length, symbol.to_string()));
            }
            if let Some(value) = self.macros.get(&name).filter(|_| length == end) {
                return Some((length, value.clone()));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn cpfg() {
        check(
            "lsystem: 1\n/* a tree\n of two lines */\n#define STEPS 4\n#define r 0.9\n#define UNUSED 2\nSeed: 7\nderivation length: STEPS\nignore: +-\naxiom: A(1) /* start */\np1: A(s) : s > 0.1 --> F(s)[+(30)A(s*r)] \\\n   [-(30)A(s*r)]\nA < B > C --> D\nhomomorphism\nA(s) --> ;(2)F(s)\nendlsystem\nnonsense",
            expect![[r#"
                cpfg
                []
                n 4, angle 90, heading 90, abop, seed 7
                  A(1)
                  r = 0.9
                  ignore: +-
                  A(s) : s > 0.1 --> F(s)[+(30)A(s*r)] [-(30)A(s*r)]
                  A < B > C --> D
                  draw:
                  A(s) --> ;(2)F(s)"#]],
        );
        check(
            "lsystem: 1\nderivation length: 3\naxiom: F\nF --> F+F : 0.5\nF --> FF : 0.5\n",
            expect![[r#"
            cpfg
            []
            n 3, angle 90, heading 90, abop
              F
              F --> F+F : 0.5
              F --> FF : 0.5
            note 1 "": The angle stands in cpfg's view file; 90 degrees is chosen"#]],
        );
        check(
            "lsystem: 1\nderivation length: 3\naxiom: Apex F\nApex --> F[+Apex]Leaf(1)\nLeaf(x) : x < 3 --> Leaf(x+1)\n",
            expect![[r#"
                cpfg
                []
                n 3, angle 90, heading 90, abop
                  b F
                  b --> F[+b]c(1)
                  c(x) : x < 3 --> c(x+1)
                note 3 "Apex": The name `Apex` becomes the symbol `b`
                note 4 "Leaf": The name `Leaf` becomes the symbol `c`
                note 1 "": The angle stands in cpfg's view file; 90 degrees is chosen"#]],
        );
    }

    #[test]
    fn refused() {
        check(
            "lsystem: 1\naxiom: A\n#include \"x.h\"\nA : {x = 1;} x > 0 --> B\ndecomposition\n",
            expect![[r##"
                cpfg
                []
                refused 3 "#include \"x.h\"": Of the preprocessor, only #define is read"##]],
        );
        check(
            "lsystem: 1\nderivation length: 2\naxiom: A\nA --> @M(1)~l?P(x)F\nF(a) --> F\n",
            expect![[r#"
            cpfg
            []
            refused 4 "@M": This symbol of cpfg has no equal here: it needs another file, or changes the turtle
            refused 4 "~l": This symbol of cpfg has no equal here: it needs another file, or changes the turtle
            refused 4 "?P": This symbol of cpfg has no equal here: it needs another file, or changes the turtle"#]],
        );
        check(
            "lsystem: 1\nderivation length: 2\naxiom: A\nA --> F\nhomomorphism\nF --> F[+F]\n",
            expect![[r#"
            cpfg
            []
            refused 6 "F --> F[+F]": The homomorphism is applied to its own results; here it is applied only once
            note 1 "": The angle stands in cpfg's view file; 90 degrees is chosen"#]],
        );
    }

    #[test]
    fn lpy() {
        check(
            "# a plant\nr = 0.8\nAxiom: A(1)\nderivation length: 4\nproduction:\nA(x) --> F(x)[+A(x*r)]\ninterpretation:\nA(x) --> f(x)\nendlsystem\n",
            expect![[r#"
                L-Py
                []
                n 4, angle 60, heading 90, abop
                  A(1)
                  r = 0.8
                  A(x) --> F(x)[+A(x*r)]
                  draw:
                  A(x) --> f(x)
                note 1 "": The text gives no angle; 60 degrees is the default of L-Py"#]],
        );
        check(
            "Axiom: A\nderivation length: 4\nproduction:\nA :\n  produce FA\nB --> F\n",
            expect![[r#"
            L-Py
            []
            refused 4 "A :": Python code is not run
            refused 5 "produce FA": Python code is not run"#]],
        );
    }
}
