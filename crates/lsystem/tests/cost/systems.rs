//! Systems of every kind, with texts of different lengths.

// Each test file uses a part of these.
#![allow(dead_code, reason = "a phase may need only some of the generators")]

use lsystem::{Definition, Dialect, System};
use test_effort::is_thorough;

/// Lengths of successors and axioms, in symbols; the last is nearly the limit of a text.
pub(crate) const LENGTHS: [usize; 4] = [1, 100, 10_000, LONGEST];

/// The symbols of the longest rules. The rest of the text is for other parts of a system.
pub(crate) const LONGEST: usize = 50_000 - 1_000;

/// The symbols of the longest axiom.
const LONGEST_AXIOM: usize = 20_000;

/// The numbers of derivation steps for systems with texts of this length: fewer for longer texts, unless the test is
/// thorough.
pub(crate) fn generations(length: usize) -> &'static [u32] {
    match length {
        _ if is_thorough() => &[0, 1, 12, 40, 1000],
        ..1_000 => &[0, 1, 12, 40, 1000],
        1_000..20_000 => &[1, 12, 1000],
        _ => &[1, 12],
    }
}

/// A definition with a name.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// The kind of system, then the length of its text.
    pub(crate) name: String,
    /// The definition, for any number of derivation steps.
    pub(crate) definition: Definition,
}

impl Case {
    /// The compiled system.
    ///
    /// # Panics
    /// If the definition has errors.
    pub(crate) fn system(&self) -> System {
        System::new(&self.definition).unwrap_or_else(|diagnostics| panic!("{}: {diagnostics:?}", self.name))
    }
}

/// Every kind of system, with a longest text of `length` symbols.
pub(crate) fn cases(length: usize) -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |name: &str, axiom: String, rules: String| {
        let definition = Definition { axiom, rules, angle: 60.0, ..Definition::default() };
        cases.push(Case { name: format!("{name} x {length}"), definition });
    };
    let f = || "F".to_owned();
    let long = |piece: &str, rest: usize| word(piece, length.min(LONGEST_AXIOM - rest));

    add("axiom", long("F", 0), "F -> FF".into());
    add("successor", f(), format!("F -> {}", word("F+", length)));
    add("branches", f(), format!("F -> {}F", word("[+F]", length)));
    add("nested", f(), format!("F -> {}F{}", "[".repeat(length / 2), "]".repeat(length / 2)));
    add("unmatched", f(), format!("F -> F{}", "[".repeat(length)));
    add("polygons", f(), format!("F -> F{}", word("{F+F+F}", length)));
    add("styles", f(), format!("F -> F{}", word("!#';", length)));
    add("letters", symbol(0).to_string(), chain(length / 8));
    add("dead ends", "X".into(), format!("X -> {}X\nY -> {}", word("Y", length / 2), word("X", length / 2)));
    add("no segments", "X".into(), format!("X -> {}", word("X+", length)));

    add("stochastic", f(), format!("F -> {} : 1\nF -> {} : 1", word("F+", length / 2), word("F-", length / 2)));
    add("alternatives", f(), lines(length, "F -> FF : 1\n"));

    add("context", "AB".into(), format!("A < B -> AB\nA > B -> {}", word("A", length)));
    add("context ignored", format!("A{}B", long("+", 2)), "ignore: +\nA < B -> AB\nA > B -> BA".into());
    add("context branches", format!("A{}C", long("[B]", 2)), "A > [B][B]C -> AB\nB > A -> A\nA < B -> B".into());
    add("context productions", "AB".into(), lines(length, "A < C > A -> BB\n") + "A -> AB\nB -> C\nC -> A");
    add("shrinking", "AF".into(), shrinking(length / 4));

    add("parametric", "A(1)".into(), format!("A(x) : x < 9 -> {}\nA(x) -> F", word("F(x)A(x/2)", length)));
    add("conditions", "A(1)".into(), lines(length, "A(x) : x > 2 -> F\n") + "A(x) -> A(x)A(x)");
    add("random numbers", "A(1)".into(), format!("A(x) -> {}A(x)", word("F(random(1, 2))", length)));
    add("images", f(), format!("F -> FF\ndraw:\nF -> {}", word("F+", length)));
    add("cuts", f(), format!("F -> F[+F%F]{}", word("F%", length)));
    add("space", f(), format!("F -> {}", word("F&F/", length)));
    if let Some(space) = cases.last_mut() {
        space.definition.dialect = Dialect::Abop;
    }
    cases
}

/// `piece` repeated up to `length` symbols (at least once).
pub(crate) fn word(piece: &str, length: usize) -> String {
    piece.repeat((length / piece.len()).max(1))
}

/// `line` repeated up to `length` symbols (at least once).
pub(crate) fn lines(length: usize, line: &str) -> String {
    line.repeat((length / line.len()).max(1))
}

/// A different letter for each number, without white space, marks and digits.
pub(crate) fn symbol(number: usize) -> char {
    char::from_u32(0x4e00 + number as u32).unwrap_or('F')
}

/// Productions in which each letter makes two of the next letter: from 1 to 20,000 letters.
pub(crate) fn chain(letters: usize) -> String {
    let letters = letters.clamp(1, 20_000);
    let lines = (0..letters).map(|at| {
        let next = symbol(at + 1);
        let last = if at + 1 == letters { "F" } else { "" };
        format!("{} -> {next}{next}{last}\n", symbol(at))
    });
    lines.collect()
}

/// Rules with contexts whose words grow fast. They once exceeded their limits by gigabytes before the limits were
/// checked.
pub(crate) fn shrinking(length: usize) -> String {
    format!("B < A > B -> F\nB < A -> F\nA > B -> F\nA -> A{} : 1\nA -> AA : 1", word("A", length))
}

/// Texts with errors or many warnings, each about `length` bytes long: axiom, rules and overrides.
pub(crate) fn texts(length: usize) -> Vec<(&'static str, Definition)> {
    let rules = |rules: String| Definition { axiom: "F".into(), rules, ..Definition::default() };
    let axiom = |axiom: String| Definition { axiom, ..Definition::default() };
    let overrides = |overrides: String| Definition { axiom: "F".into(), overrides, ..Definition::default() };
    let half = "(".repeat(length / 2);
    let count = length / 24;
    let numbered_lines = |line: &dyn Fn(usize) -> String| (0..count).map(line).collect::<String>();
    vec![
        ("empty lines", rules(lines(length, "\n"))),
        ("comments", rules(lines(length, "// F -> F\n"))),
        ("no arrows", rules(lines(length, "F F\n"))),
        ("arrows", rules(format!("F -> {}", word("->", length)))),
        ("apart arrows", rules(format!("F -> {}", word(" -> ", length)))),
        ("colons", rules(format!("F -> {}", word(":", length)))),
        ("one production", rules(lines(length, "F -> F\n"))),
        ("short rules", rules(lines(length, "F->\n"))),
        ("open", axiom(word("[", length))),
        ("closed", axiom(word("]", length))),
        ("parentheses", axiom(format!("F{half}"))),
        ("closed parentheses", axiom(word("F()", length))),
        ("open parentheses", rules(format!("F -> {}", word("F(", length)))),
        ("arguments", axiom(format!("F({}1)", word("1,", length)))),
        ("many arguments", axiom(word("F(1,2)", length))),
        ("operators", axiom(format!("F(1{})", word("+1", length)))),
        ("denials", rules(format!("F(x) : {}x -> F", word("!", length)))),
        ("names", rules(format!("F -> {}", word("F(y)", length)))),
        ("long name", rules(format!("{} = 1", word("x", length)))),
        ("words", rules(format!("F(x) : x{} -> F", word(" and x", length)))),
        ("look-alikes", rules(format!("F -> {}", word("−’", length)))),
        ("literals", rules(format!("F -> {}", word("`", length)))),
        ("quoted", rules(format!("F -> {}", word("`F`", length)))),
        ("spaces", rules(format!("F -> {}", word(" F", length)))),
        ("ignored", rules(format!("ignore: {}\nA < B -> F", (0..length / 4).map(symbol).collect::<String>()))),
        ("ignored, seen", rules(ignored(length))),
        ("context", rules(format!("{} < A -> F", word("A", length)))),
        ("parameters", rules(format!("A({}x) -> F", word("x,", length)))),
        ("letters", rules(numbered_lines(&|at| format!("{} -> {}\n", symbol(at % 20_000), symbol((at + 1) % 20_000))))),
        ("constants", rules(numbered_lines(&|at| format!("c{} = c{} + 1\n", at + 1, at)))),
        ("unknown", rules(numbered_lines(&|at| format!("d{at} = e{at}\n")))),
        ("slips", rules(format!("F -> {}+", word(" if # abc", length)))),
        ("conditions", rules(numbered_lines(&|at| format!("F(x) : x > {at} -> F\n")))),
        ("idle", rules(numbered_lines(&|at| format!("A{} < B -> F\n", symbol(at % 20_000))))),
        ("arities", axiom(numbered_lines(&|at| format!("{}(1)", symbol(at % 20_000))))),
        ("no polygons", rules(lines(length / 2, "draw: F -> F\n"))),
        ("many images", rules(images(length))),
        ("overrides", overrides(numbered_lines(&|at| format!("{}: draw {at}\n", symbol(at % 20_000))))),
        ("same override", overrides(lines(length, "F: draw\n"))),
        ("actions", overrides(format!("F: {}", word("draw,", length)))),
        ("unknown actions", overrides(format!("F: {}", word("drew,", length)))),
        ("actions of letters", actions_of_letters(length)),
    ]
}

/// Contexts that skip many symbols in the word.
fn ignored(length: usize) -> String {
    let symbols: String = (0..(length / 6).clamp(1, 20_000)).map(symbol).collect();
    format!("ignore: {symbols}\nA < B -> {symbols}\nB < A -> A")
}

/// Images that draw each letter as another.
fn images(length: usize) -> String {
    let letters = (length / 48).clamp(1, 20_000);
    let rules: String = (0..letters).map(|at| format!("{0} -> {0}{0}\n", symbol(at))).collect();
    let drawn: String = (0..letters).map(|at| format!("{} -> F\n", symbol(at))).collect();
    format!("{rules}draw:\n{drawn}")
}

/// Many letters, each with its own action.
fn actions_of_letters(length: usize) -> Definition {
    let letters = (length / 16).clamp(1, 20_000);
    Definition {
        axiom: (0..letters).map(symbol).collect(),
        overrides: (0..letters).map(|at| format!("{}: draw\n", symbol(at))).collect(),
        ..Definition::default()
    }
}
