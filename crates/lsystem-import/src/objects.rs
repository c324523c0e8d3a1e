//! JavaScript and JSON objects of packages and web pages, and the same as assignments.
//!
//! ```text
//! new LSystem({axiom: 'F++F++F', productions: {'F': 'F-F++F-F'}})
//! {axiom: "X", rules: {X: "F+[[X]-X]"}, alpha: 0, theta: Math.PI / 3, iterations: 7}
//! axiom = "F"; rules = {"F": "F+F"}; angle = 60
//! ```
//!
//! The words of these programs are plain characters. What the symbols do stands in the program's code, which is not
//! read, so F and G draw and + turns left, as in most of them. An object with `theta` in radians is of the package
//! lindsvg, whose symbols are known: `F` draws, `B` moves, `+` turns right on the screen, and every letter without a rule
//! vanishes.

use crate::draft::{Draft, production};
use crate::rules::split_rule;
use crate::source::Source;
use crate::value::{Node, Scanner, Unit, Value};
use lsystem_syntax::{Dialect, Expr, Grammar, Module, Pattern};

const AXIOM: &[&str] = &["axiom", "start", "initial", "initiator", "omega", "startString", "start_string", "seed"];
const RULES: &[&str] = &["rules", "productions", "rule", "production", "ruleset", "production_rules"];
const ANGLE: &[&str] =
    &["angle", "delta", "theta", "turnAngle", "turn_angle", "angle_deg", "angleDeg", "degrees", "turn"];
const ITERATIONS: &[&str] = &[
    "iterations",
    "n",
    "depth",
    "generations",
    "generation",
    "order",
    "iters",
    "num_iters",
    "level",
    "levels",
    "steps",
];
const NAME: &[&str] = &["name", "title", "label", "id"];

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let first = text.trim_start();
    let mentions = |keys: &[&str]| keys.iter().any(|key| contains_word(text, key));
    if !mentions(AXIOM) || !mentions(RULES) {
        return None;
    }
    // Our own JSON and the course's have a reader of their own, which also explains mistakes in them.
    if first.starts_with('{') && contains_word(text, "initial") {
        return None;
    }
    if first.starts_with(['{', '/']) && lsystem_files::read_json(text).0.is_some_and(|found| !found.axiom.is_empty()) {
        return None;
    }
    let mut systems = Vec::new();
    let mut scanner = Scanner::new(text);
    while let Some(open) = text.get(scanner.at..).and_then(|rest| rest.find('{')) {
        let start = scanner.at + open;
        scanner.at = start;
        let name = name_before(text, start);
        match scanner.value(0) {
            Some(node) => collect(&node, &name, &mut systems),
            None => scanner.at = start + 1,
        }
        if scanner.is_exhausted() {
            break;
        }
    }
    if systems.is_empty() {
        systems.extend(assignments(text).map(|node| (String::new(), node)));
    }
    let single = systems.len() == 1;
    let drafts: Vec<Draft<'_>> = systems.iter().map(|(name, node)| system(source, name, node, single)).collect();
    (!drafts.is_empty()).then_some(drafts)
}

/// Whether a text contains a word, in any case, not as a part of a longer one.
fn contains_word(text: &str, word: &str) -> bool {
    let lower = text.to_ascii_lowercase();
    let word = word.to_ascii_lowercase();
    lower.match_indices(&word).any(|(at, _)| {
        let is_part = |c: Option<char>| c.is_some_and(|c| c.is_ascii_alphanumeric());
        !is_part(lower[..at].chars().next_back()) && !is_part(lower[at + word.len()..].chars().next())
    })
}

/// The name that an object is assigned to: `koch = {`, `"koch": {`.
fn name_before(text: &str, at: usize) -> String {
    let before = text[..at].trim_end();
    let Some(before) = before.strip_suffix(['=', ':']) else { return String::new() };
    let before = before.trim_end().trim_end_matches(['"', '\'']);
    let from = before
        .rfind(|c: char| !c.is_alphanumeric() && !matches!(c, '_' | '-' | '$'))
        .map_or(0, |at| at + before[at..].chars().next().map_or(1, char::len_utf8));
    before[from..].to_owned()
}

/// Whether a node is an object with an axiom and rules, and not of our own form.
fn is_system(node: &Node) -> bool {
    let ours = node.get(&["initial"]).is_some() && node.get(&["turtle", "style", "num_iters", "angle_deg"]).is_some();
    let axiom = node.get(AXIOM).is_some_and(|axiom| match &axiom.value {
        Value::Text(_) => true,
        Value::List(list) => list.iter().all(|one| one.text().is_some()) && !list.is_empty(),
        _ => false,
    });
    let rules = node.get(RULES).is_some_and(|rules| match &rules.value {
        Value::Object(_) | Value::List(_) => true,
        Value::Text(text) => text.contains(['=', '>', '→', ':']),
        _ => false,
    });
    axiom && rules && !ours
}

/// Collects the systems in a value.
fn collect(node: &Node, name: &str, systems: &mut Vec<(String, Node)>) {
    if is_system(node) {
        systems.push((name.to_owned(), node.clone()));
        return;
    }
    match &node.value {
        Value::Object(members) => members.iter().for_each(|(key, value)| collect(value, key, systems)),
        Value::List(list) => list.iter().for_each(|value| collect(value, "", systems)),
        _ => {}
    }
}

/// A system whose parts are assigned one by one: `axiom = "F"`, `rules = {..}`.
fn assignments(text: &str) -> Option<Node> {
    let mut members = Vec::new();
    let mut scanner = Scanner::new(text);
    let mut from = 0;
    while let Some(found) = text[from..].find(['=', ':']) {
        let sign = from + found;
        from = sign + 1;
        let key = name_before(text, sign + 1);
        let known = [AXIOM, RULES, ANGLE, ITERATIONS, NAME]
            .iter()
            .any(|keys| keys.iter().any(|k| k.eq_ignore_ascii_case(&key)));
        if !known {
            continue;
        }
        scanner.at = from;
        if let Some(node) = scanner.value(0)
            && !matches!(node.value, Value::Other)
        {
            from = node.end.max(from);
            members.push((key, node));
        }
        if scanner.is_exhausted() {
            break;
        }
    }
    let start = members.first()?.1.start;
    let node = Node { value: Value::Object(members), start, end: text.len() };
    is_system(&node).then_some(node)
}

struct Reader<'a> {
    text: &'a str,
    draft: Draft<'a>,
    grammar: Grammar,
}

fn system<'a>(source: Source<'a>, name: &str, node: &Node, single: bool) -> Draft<'a> {
    let title = node.get(NAME).and_then(Node::text).unwrap_or(name);
    let draft = Draft::new(source, title, source.line_of(node.start));
    let mut reader = Reader { text: source.text, draft, grammar: Grammar::default() };
    reader.read(node, single);
    reader.draft
}

/// A weight of a random choice.
const WEIGHT: &[&str] = &["weight", "p", "prob", "probability", "chance", "w", "odds"];
/// A successor.
const TO: &[&str] = &[
    "successor",
    "out",
    "to",
    "output",
    "replacement",
    "replace",
    "b",
    "body",
    "value",
    "result",
    "string",
    "rule",
    "right",
    "production",
    "rhs",
    "e",
    "after",
    "then",
];
/// A predecessor.
const FROM: &[&str] = &[
    "predecessor",
    "in",
    "from",
    "input",
    "symbol",
    "a",
    "key",
    "letter",
    "char",
    "character",
    "left",
    "lhs",
    "head",
    "before",
    "match",
    "find",
    "variable",
];

impl Reader<'_> {
    fn line(&self, node: &Node) -> usize {
        self.draft.source.line_of(node.start)
    }

    fn source(&self, node: &Node) -> String {
        self.text.get(node.start..node.end).unwrap_or_default().to_owned()
    }

    fn refuse(&mut self, node: &Node, why: &str) {
        let (line, source) = (self.line(node), self.source(node));
        self.draft.refuse(line, &source, why);
    }

    fn note(&mut self, node: &Node, why: &str) {
        let (line, source) = (self.line(node), self.source(node));
        self.draft.note(line, &source, why);
    }

    fn read(&mut self, node: &Node, single: bool) {
        let Value::Object(members) = &node.value else { return };
        let is_lindsvg = node.get(&["theta"]).is_some()
            && node.get(&["axiom"]).is_some()
            && (node.get(&["alpha"]).is_some() || self.text.contains("lindsvg"));
        if let Some(axiom) = node.get(AXIOM) {
            let word = match &axiom.value {
                Value::List(list) => list.iter().filter_map(Node::text).collect(),
                _ => axiom.text().unwrap_or_default().to_owned(),
            };
            self.grammar.axiom = modules(&word);
        }
        if let Some(rules) = node.get(RULES) {
            self.productions(rules);
        }
        if is_lindsvg {
            self.lindsvg(node);
        } else {
            self.meanings(node);
            match node.get(ANGLE) {
                Some(angle) => self.angle(angle),
                None => self.angle_in_code(node),
            }
        }
        let calls = || {
            let rest = self.text.split(".iterate(").nth(1).filter(|_| single)?;
            rest.split(')').next().map(str::to_owned)
        };
        match node.get(ITERATIONS).map(|node| (node, &node.value)) {
            Some((at, Value::Number(n, _))) => self.draft.iterations(self.line(at), &n.to_string()),
            Some((at, Value::Text(n))) => self.draft.iterations(self.line(at), n),
            _ if is_lindsvg => self.draft.iterations(self.draft.line, "3"),
            _ => {
                if let Some(n) = calls().filter(|n| n.trim().parse::<u32>().is_ok()) {
                    self.draft.iterations(self.draft.line, &n);
                }
            }
        }
        let known: [&[&str]; 6] =
            [AXIOM, RULES, ANGLE, ITERATIONS, NAME, if is_lindsvg { &["alpha", "step"] } else { &[] }];
        for (key, value) in members {
            if known.iter().all(|keys| keys.iter().all(|known| !known.eq_ignore_ascii_case(key))) {
                self.note(value, &format!("`{key}` is not carried over"));
            }
        }
        let grammar = core::mem::take(&mut self.grammar);
        self.draft.grammar(&grammar);
    }

    /// Reads the rules of any form.
    fn productions(&mut self, node: &Node) {
        match &node.value {
            Value::Object(members) => members.iter().for_each(|(key, value)| self.keyed(key, value)),
            Value::List(list) => list.iter().for_each(|one| self.listed(one)),
            Value::Text(text) => self.lines(text, node),
            _ => self.refuse(node, "The rules are code, which is not read"),
        }
    }

    /// Reads one element of a list of rules.
    fn listed(&mut self, node: &Node) {
        match &node.value {
            Value::Text(text) => self.lines(text, node),
            Value::List(pair) => match &pair[..] {
                [from, to] if from.text().is_some() => self.keyed(from.text().unwrap_or_default(), to),
                [from, to, weight] if from.text().is_some() && matches!(weight.value, Value::Number(..)) => {
                    let Value::Number(weight, _) = weight.value else { return };
                    match to.text() {
                        Some(to) => self.production(from.text().unwrap_or_default(), to, Some(weight), node),
                        None => self.refuse(node, "This rule cannot be read"),
                    }
                }
                _ => self.refuse(node, "This rule cannot be read"),
            },
            Value::Object(members) => match (node.get(FROM).and_then(Node::text), node.get(TO)) {
                (Some(from), Some(to)) => {
                    let from = from.to_owned();
                    match (&to.value, self.weight(node)) {
                        (Value::Text(to), weight) => self.production(&from, to, weight, node),
                        _ => self.keyed(&from, to),
                    }
                }
                // `[{"F": "FF"}, {"X": "F"}]`
                _ => members.iter().for_each(|(key, value)| self.keyed(key, value)),
            },
            _ => self.refuse(node, "This rule is code, which is not read"),
        }
    }

    /// Reads rules in the lines of a string.
    fn lines(&mut self, text: &str, node: &Node) {
        for rule in text.split(['\n', ';', ',']).map(str::trim).filter(|rule| !rule.is_empty()) {
            match split_rule(rule) {
                Some((from, to)) => self.production(from, to, None, node),
                None => self.refuse(node, "This rule has no arrow"),
            }
        }
    }

    fn weight(&self, node: &Node) -> Option<f64> {
        let Some(Node { value: Value::Number(weight, _), .. }) = node.get(WEIGHT) else { return None };
        Some(*weight)
    }

    /// Reads a rule whose predecessor is a key.
    fn keyed(&mut self, key: &str, node: &Node) {
        match &node.value {
            Value::Text(to) => self.production(key, to, None, node),
            Value::List(list) if list.iter().all(|one| one.text().is_some_and(|text| text.chars().count() == 1)) => {
                let word: String = list.iter().filter_map(Node::text).collect();
                self.production(key, &word, None, node);
            }
            Value::List(list) => {
                for one in list {
                    let to = one.text().or_else(|| one.get(TO).and_then(Node::text));
                    let pair = if let Value::List(pair) = &one.value { Some(&pair[..]) } else { None };
                    match (to, pair) {
                        (Some(to), _) => self.production(key, to, self.weight(one).or(Some(1.0)), one),
                        (
                            None,
                            Some(
                                [Node { value: Value::Number(p, _), .. }, to]
                                | [to, Node { value: Value::Number(p, _), .. }],
                            ),
                        ) if to.text().is_some() => {
                            self.production(key, to.text().unwrap_or_default(), Some(*p), one);
                        }
                        _ => self.refuse(one, "This successor cannot be read: it has parameters or is code"),
                    }
                }
            }
            Value::Object(members) => {
                if let Some(code) = node.get(&["condition"]) {
                    return self.refuse(code, "Conditions are code, which is not read");
                }
                if let Some(successors) = node.get(&["successors", "productions", "options"]) {
                    return self.keyed(key, successors);
                }
                let context = |keys| node.get(keys).and_then(Node::text).unwrap_or_default();
                let (left, right) = (context(&["leftCtx", "left"]), context(&["rightCtx", "right"]));
                let weighted = members.iter().all(|(_, value)| matches!(value.value, Value::Number(..)));
                match node
                    .get(&["successor", "to", "out", "output", "replacement", "rule", "value"])
                    .and_then(Node::text)
                {
                    Some(to) => {
                        let mut from = key.to_owned();
                        if !left.is_empty() {
                            from = format!("{left}<{from}");
                        }
                        if !right.is_empty() {
                            from = format!("{from}>{right}");
                        }
                        self.production(&from, to, self.weight(node), node);
                    }
                    // `{"F": {"FF": 0.5, "F": 0.5}}`
                    None if weighted && !members.is_empty() => {
                        for (to, weight) in members {
                            if let Value::Number(p, _) = weight.value {
                                self.production(key, to, Some(p), weight);
                            }
                        }
                    }
                    None => self.refuse(node, "This rule cannot be read"),
                }
            }
            _ => self.refuse(node, "This rule is code, which is not read"),
        }
    }

    fn production(&mut self, from: &str, to: &str, weight: Option<f64>, node: &Node) {
        let from: String = from.chars().filter(|c| !c.is_whitespace()).collect();
        if to.contains('(') || from.contains('(') {
            return self.refuse(node, "Words with parameters in parentheses are not read from objects");
        }
        let (left, rest) = match from.split_once('<') {
            Some((left, rest)) if !left.is_empty() && !rest.is_empty() => (left, rest),
            _ => ("", from.as_str()),
        };
        let (strict, right) = match rest.split_once('>') {
            Some((strict, right)) if !strict.is_empty() && !right.is_empty() => (strict, right),
            _ => (rest, ""),
        };
        let mut letters = strict.chars();
        let (Some(letter), None) = (letters.next(), letters.next()) else {
            return self.refuse(node, "The left side of a rule must be one symbol");
        };
        let mut rule = production(letter, to.chars().filter(|c| !c.is_whitespace()));
        let patterns = |word: &str| word.chars().map(|symbol| Pattern { symbol, parameters: Vec::new() }).collect();
        (rule.left, rule.right) = (patterns(left), patterns(right));
        match weight {
            Some(0.0) => return,
            Some(p) if p.is_finite() && p > 0.0 => rule.weight = Some(Expr::Number(p)),
            Some(_) => return self.refuse(node, "The weight of a random choice must be positive"),
            None => {}
        }
        self.grammar.productions.push(rule);
    }

    /// Sets the heading, the angle and the symbols of lindsvg.
    fn lindsvg(&mut self, node: &Node) {
        let degrees = |key| match node.get(&[key]).map(|node| &node.value) {
            Some(Value::Number(value, Unit::Degrees)) => Some(*value),
            Some(Value::Number(value, _)) => Some(tidy(value.to_degrees())),
            Some(_) => None,
            None => Some(0.0),
        };
        match (degrees("alpha"), degrees("theta")) {
            (Some(alpha), Some(theta)) => {
                self.draft.definition.heading = alpha;
                self.draft.definition.angle = theta;
            }
            _ => self.refuse(node, "The angles alpha and theta are code, which is not read"),
        }
        self.draft.others = Some("");
        let meanings = [("F", "draw"), ("B", "move"), ("+", "turn right"), ("-", "turn left")];
        for (symbol, actions) in meanings.into_iter().chain([("[", "open branch"), ("]", "close branch")]) {
            self.draft.meaning(symbol.chars().next().unwrap_or_default(), actions);
        }
        // lindsvg drops letters without a rule at the next iteration.
        let mut letters = lsystem_base::sorted::set(self.grammar.made().map(|module| module.symbol));
        let has_rule = |letter: char| self.grammar.productions.iter().any(|rule| rule.predecessor.symbol == letter);
        letters.retain(|&letter| !"+-[]".contains(letter) && !has_rule(letter));
        self.grammar.productions.extend(letters.into_iter().map(|letter| production(letter, [])));
    }

    /// Chooses the dialect, because the text does not say what the symbols do.
    fn meanings(&mut self, node: &Node) {
        let symbols: Vec<char> = self.grammar.made().map(|module| module.symbol).collect();
        let line = self.line(node);
        let draws = symbols.iter().any(|c| matches!(c, 'F' | 'G'));
        if draws {
            self.draft.note(
                line,
                "",
                "The text does not say what symbols do; here F and G draw, f moves, + turns left",
            );
            self.draft.others = Some("");
            let known =
                [('F', "draw"), ('G', "draw"), ('f', "move"), ('g', "move"), ('+', "turn left"), ('-', "turn right")];
            for (symbol, actions) in
                known.into_iter().chain([('|', "turn round"), ('[', "open branch"), (']', "close branch")])
            {
                self.draft.meaning(symbol, actions);
            }
        } else {
            self.draft.note(line, "", "The text does not say what symbols do; here every letter draws, + turns left");
            self.draft.definition.dialect = Dialect::EveryLetter;
            for symbol in symbols.into_iter().filter(|c| !c.is_alphanumeric() && !"+-[]".contains(*c)) {
                self.draft.meaning(symbol, "");
            }
        }
    }

    fn angle(&mut self, node: &Node) {
        let value = match &node.value {
            Value::Number(value, unit) => Some((*value, *unit)),
            Value::Text(text) => {
                let degrees = text.trim().trim_end_matches(['°', 'º']).trim_end_matches("deg").trim();
                degrees.parse().ok().map(|value| (value, Unit::Unknown))
            }
            _ => None,
        };
        self.draft.definition.angle = match value {
            Some((value, Unit::Radians)) => tidy(value.to_degrees()),
            Some((value, Unit::Unknown)) if value.abs() < 6.3 && value.fract() != 0.0 => {
                self.note(node, "This angle is read as radians");
                tidy(value.to_degrees())
            }
            Some((value, _)) => value,
            None => return self.refuse(node, "The angle is code, which is not read"),
        };
    }

    /// Finds the angle in the code of `+`, as in `'+': () => ctx.rotate(Math.PI / 180 * 60)`.
    fn angle_in_code(&mut self, node: &Node) {
        let finals = node.get(&["finals", "actions", "commands", "draw"]);
        let code = finals.and_then(|finals| finals.get(&["+"]).or_else(|| finals.get(&["-"])));
        if let Some(code) = code {
            let source = self.source(code);
            let numbers = source.split(|c: char| !c.is_ascii_digit() && c != '.');
            let mut numbers: Vec<f64> = numbers.filter_map(|n| n.parse().ok()).filter(|n| *n != 180.0).collect();
            numbers.dedup();
            if let [angle] = numbers[..]
                && angle > 6.3
            {
                self.draft.definition.angle = angle;
                return self.note(code, "The angle is read from this code");
            }
        }
        self.draft.definition.angle = 90.0;
        if self.grammar.made().any(|module| matches!(module.symbol, '+' | '-')) {
            self.note(node, "The text gives no angle; 90 degrees is chosen");
        }
    }
}

/// A word of plain characters without white space.
fn modules(text: &str) -> Vec<Module> {
    text.chars().filter(|c| !c.is_whitespace()).map(Module::from).collect()
}

/// Removes the error of a conversion from radians.
fn tidy(degrees: f64) -> f64 {
    let near = (degrees * 1e9).round() / 1e9;
    if (near - degrees).abs() < 1e-9 { near } else { degrees }
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn packages() {
        check(
            "var koch = new LSystem({\n  axiom: 'F++F++F',\n  productions: {'F': 'F-F++F-F'}\n})\nkoch.iterate(2)",
            expect![[r#"
                JavaScript
                []
                n 2, angle 90, heading 90, abop
                  F++F++F
                  F -> F-F++F-F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                note 1 "{\n  axiom: 'F++F++F',\n  productions: {'F…": The text gives no angle; 90 degrees is chosen"#]],
        );
        check(
            "new LSystem({axiom: 'X', productions: {'X': 'F-X', 'A<B>C': 'D', 'F': {successors: [{weight: 50, successor: 'FF'}, {weight: 50, successor: 'F'}]}}, finals: {'+': () => { ctx.rotate((Math.PI/180) * 60) }, 'F': function() { ctx.fillRect(0, 0, 10, 40) }}})",
            expect![[r#"
                JavaScript
                []
                n 5, angle 60, heading 90, abop
                  X
                  X -> F-X
                  A < B > C -> D
                  F -> FF : 50
                  F -> F : 50
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                note 1 "() => { ctx.rotate((Math.PI/180) * 60) }": The angle is read from this code
                note 1 "{'+': () => { ctx.rotate((Math.PI/180) *…": `finals` is not carried over
                note 1 "": The text gives no number of iterations; 5 is chosen by the size"#]],
        );
        check(
            "let lsParams = {\n  axiom: \"A---A\", // start\n  rules: {\n    F: \"F\",\n    A: \"B-F+Z+F-BA\",\n    Z: \"F-FF\"\n  },\n  alpha: 90 * Math.PI / 180,\n  theta: Math.PI / 3,\n  step: 15,\n  iterations: 7,\n};",
            expect![[r#"
                JavaScript
                [lsParams]
                n 7, angle 60, heading 90, abop
                  A---A
                  F -> F
                  A -> B-F+Z+F-BA
                  Z -> F-FF
                  B -> *
                  | +: turn right
                  | -: turn left
                  | B: move"#]],
        );
        check(
            "lindsvg.getSVGCode({axiom: 'F-F', rules: {}, theta: 1.0471975511965976})",
            expect![[r#"
                JavaScript
                []
                n 3, angle 60, heading 0, abop
                  F-F
                  F -> *
                  | -: turn left"#]],
        );
    }

    #[test]
    fn forms_of_rules() {
        check(
            r#"{"start": "F", "rules": [{"in": "F", "out": "F+F"}], "angle": 60, "n": 3, "color": "red"}"#,
            expect![[r#"
                JavaScript
                []
                n 3, angle 60, heading 90, abop
                  F
                  F -> F+F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                note 1 "\"red\"": `color` is not carried over"#]],
        );
        check(
            r#"{"axiom": "F", "rules": [["F", "F+F"], ["X", "F"]], "delta": "25.7", "depth": 3}"#,
            expect![[r#"
                JavaScript
                []
                n 3, angle 25.7, heading 90, abop
                  F
                  F -> F+F
                  X -> F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "const tree = { axiom: 'F', rules: ['F -> F[+F]', 'X=>F'], angle: radians(25), generations: 4 }",
            expect![[r#"
                JavaScript
                [tree]
                n 4, angle 25, heading 90, abop
                  F
                  F -> F[+F]
                  X -> F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "{axiom: 'F', rules: {F: [{p: 0.5, rule: 'FF'}, {p: 0.5, rule: 'F'}]}, angle: 0.5}",
            expect![[r#"
                JavaScript
                []
                n 14, angle 28.647889757, heading 90, abop
                  F
                  F -> FF : 0.5
                  F -> F : 0.5
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                note 1 "0.5": This angle is read as radians
                note 1 "": The text gives no number of iterations; 14 is chosen by the size"#]],
        );
        check(
            "{axiom: 'A', rules: {A: 'B-A-B', B: 'A+B+A'}, angle: 60}",
            expect![[r#"
                JavaScript
                []
                n 8, angle 60, heading 90, every-letter
                  A
                  A -> B-A-B
                  B -> A+B+A
                note 1 "": The text does not say what symbols do; here every letter draws, + turns left
                note 1 "": The text gives no number of iterations; 8 is chosen by the size"#]],
        );
        check(
            "axiom = \"F--F\"\nrules = {\"F\": \"F+F\"}\niters = 4\nangle=75",
            expect![[r#"
                JavaScript
                []
                n 4, angle 75, heading 90, abop
                  F--F
                  F -> F+F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "const all = { koch: {axiom: 'F', rules: {F: 'F+F'}, angle: 60, n: 1}, other: {axiom: 'G', rules: {G: 'G-G'}, angle: 90, n: 2} };",
            expect![[r#"
                JavaScript
                [koch]
                n 1, angle 60, heading 90, abop
                  F
                  F -> F+F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                [other]
                n 2, angle 90, heading 90, abop
                  G
                  G -> G-G
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
    }

    #[test]
    fn refused() {
        check(
            "{axiom: 'F', rules: {F: () => 'FF'}, angle: 60, n: 1}",
            expect![[r#"
                JavaScript
                []
                refused 1 "() => 'FF'": This rule is code, which is not read
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "{axiom: 'F', rules: {FX: 'FF'}, angle: a, n: 1}",
            expect![[r#"
                JavaScript
                []
                refused 1 "'FF'": The left side of a rule must be one symbol
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                refused 1 "a": The angle is code, which is not read"#]],
        );
        check(
            "{axiom: 'F', rules: {F: {successor: 'FF', condition: () => true}}, angle: 60, n: 1}",
            expect![[r#"
                JavaScript
                []
                refused 1 "() => true": Conditions are code, which is not read
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            r#"{"initial": "F", "rules": {"F": "F+F"}, "angle_deg": 60, "num_iters": 2}"#,
            expect![[r#"
                our own JSON
                []
                n 2, angle 60, heading 90, every-letter
                  F
                  F -> F+F"#]],
        );
        check(
            r#"{"initial": "F", "rules": ["F -> F+F"], "turtle": {}}"#,
            expect![[r#"
                our own JSON
                []
                n 1, angle 0, heading 90, abop
                  F
                  F -> F+F"#]],
        );
        check(
            r#"{"initial": "F", "rules": {"F": "FF"}"#,
            expect![[r#"
                our own JSON
                []
                refused 1 "{": This object is never closed. Add `}`."#]],
        );
    }
}
