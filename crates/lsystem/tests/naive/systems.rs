//! Random systems with contexts, parameters, conditions, weights and images, as text.

use lsystem::{Definition, System};
use proptest::prelude::*;

/// A sway: strength and phase, often none.
pub fn wind() -> impl Strategy<Value = [f64; 2]> {
    prop_oneof![Just([0.0, 0.0]), (-20.0..20.0, -360.0..720.0).prop_map(|(strength, phase)| [strength, phase])]
}

/// The features of a random system.
#[derive(Clone, Copy, Default)]
pub struct Features {
    pub contexts: bool,
    pub parameters: bool,
    pub weights: bool,
    pub images: bool,
    pub cuts: bool,
}

/// Systems with these features. Letters without parameters are A, B, F, + and -; letters with parameters are P(_),
/// F(_), +(_) and Q(_, _).
pub fn system(features: Features) -> impl Strategy<Value = System> {
    let rules = prop::collection::vec(rule(features), 1..6);
    let images = prop::collection::vec(image(features), if features.images { 1..3 } else { 0..1 });
    let seen = prop::sample::select(vec!["", "ignore: +-F\n", "consider: AP\n"]);
    (word(features, &["1", "2.5", "r", "-1"]), rules, images, seen, any::<u32>()).prop_map(
        |(axiom, rules, images, seen, seed)| {
            let draw = if images.is_empty() { String::new() } else { format!("\ndraw:\n{}", images.join("\n")) };
            let rules = format!("r = 0.75\n{seen}{}{draw}", rules.join("\n"));
            let definition = Definition { axiom, rules, seed, angle: 25.0, ..Definition::default() };
            System::new(&definition).unwrap_or_else(|diagnostics| panic!("{definition:?}: {diagnostics:?}"))
        },
    )
}

/// A word with arguments from `expressions`.
fn word(features: Features, expressions: &[&'static str]) -> impl Strategy<Value = String> + use<> {
    let value = prop::sample::select(expressions.to_vec());
    let mut plain = vec!["A", "B", "F", "+", "-", "AB", "[A]", "[+B]", "[", "]"];
    if features.cuts {
        plain.extend(["%", "A[B%A]"]);
    }
    let plain = prop::sample::select(plain).prop_map(str::to_owned);
    let one = (prop::sample::select(vec!["P", "F", "+", "!"]), value.clone()).prop_map(|(s, x)| format!("{s}({x})"));
    let two = (value.clone(), value).prop_map(|(x, y)| format!("Q({x},{y})"));
    let share = if features.parameters { 2 } else { 0 };
    prop::collection::vec(prop_oneof![3 => plain, share => one, share => two], 1..5).prop_map(|parts| parts.concat())
}

/// A pattern with parameters of these names.
fn pattern(features: Features, names: [&'static str; 2]) -> impl Strategy<Value = String> {
    let [x, y] = names;
    let share = if features.parameters { 1 } else { 0 };
    prop_oneof![
        2 => prop::sample::select(vec!["A", "B", "F", "+"]).prop_map(str::to_owned),
        share => Just(format!("P({x})")),
        share => Just(format!("Q({x},{y})")),
    ]
}

/// A production.
fn rule(features: Features) -> impl Strategy<Value = String> {
    let share = u32::from(features.contexts);
    let left = prop_oneof![
        1 => Just(String::new()),
        share => pattern(features, ["a", "b"]).prop_map(|p| format!("{p} < ")),
        share => prop::sample::select(vec!["AB < ", "AA < ", "BA < "]).prop_map(str::to_owned),
    ];
    let right = prop_oneof![
        1 => Just(String::new()),
        share => pattern(features, ["c", "d"]).prop_map(|p| format!(" > {p}")),
        share => pattern(features, ["c", "d"]).prop_map(|p| format!(" > [{p}]")),
        share => prop::sample::select(vec![" > AB", " > [A]B", " > [B][A]", " > A[B[A]]"]).prop_map(str::to_owned),
    ];
    (left, pattern(features, ["x", "y"]), right).prop_flat_map(move |(left, strict, right)| {
        let names = ["a", "b", "c", "d", "x", "y"];
        // No other expression uses these names.
        let known = names.into_iter().filter(|name| [&left, &strict, &right].into_iter().any(|p| p.contains(name)));
        let known: Vec<&str> = known.collect();
        let mut values = vec!["1", "r"];
        let mut conditions = vec!["1 < 2"];
        for name in known {
            values.extend(VALUES.iter().filter(|(n, _)| *n == name).map(|(_, value)| *value));
            conditions.extend(CONDITIONS.iter().filter(|(n, _)| *n == name).map(|(_, value)| *value));
        }
        let condition = sometimes(
            if features.parameters { 0.4 } else { 0.0 },
            prop::sample::select(conditions).prop_map(|condition| format!(" : {condition}")),
        );
        let weight = sometimes(
            if features.weights { 0.7 } else { 0.0 },
            prop::sample::select(values.clone()).prop_map(|value| format!(" : {value}")),
        );
        if features.weights && features.parameters {
            values.extend(["random(0, 3)", "random(r, 2) - 1", "ran(2)", "nran(1, 0.5)"]);
        }
        (condition, word(features, &values), weight).prop_map(move |(condition, successor, weight)| {
            format!("{left}{strict}{right}{condition} -> {successor}{weight}")
        })
    })
}

/// A text with this probability, or an empty text.
fn sometimes(probability: f64, text: impl Strategy<Value = String>) -> impl Strategy<Value = String> {
    (0.0..1.0, text).prop_map(move |(roll, text)| if roll < probability { text } else { String::new() })
}

/// A production below `draw:`.
fn image(features: Features) -> impl Strategy<Value = String> {
    let plain = ["A -> F+F", "B -> [+F]", "A -> *", "+ -> ++F"];
    let parametric =
        ["P(x) -> F(x)+(10*x)", "P(x) : x > 1 -> [!(x)F]", "Q(x,y) -> '(x)F(y)", "A -> F(2)", "F(x) -> F(x/2)F(x/2)"];
    let random = ["A -> F : 2", "A -> +F : 1", "P(x) -> F(random(0, x))"];
    let mut all = plain.to_vec();
    if features.parameters {
        all.extend(parametric);
    }
    if features.parameters && features.weights {
        all.extend(random);
    }
    prop::sample::select(all).prop_map(str::to_owned)
}

/// Expressions, by the parameters that they need.
const VALUES: [(&str, &str); 14] = [
    ("x", "x"),
    ("x", "x + 1"),
    ("x", "x*r"),
    ("x", "-x^2"),
    ("x", "x % 3"),
    ("x", "1/x"),
    ("x", "floor(x) + 0.5"),
    ("y", "y"),
    ("y", "max(y, 2)"),
    ("y", "(y - 1)*2"),
    ("a", "a*0.5"),
    ("b", "b + r"),
    ("c", "abs(c)"),
    ("d", "min(d, 4)"),
];

const CONDITIONS: [(&str, &str); 8] = [
    ("x", "x > 1"),
    ("x", "not x == 1"),
    ("x", "x < 1 || x >= 2.5"),
    ("y", "y <= 2 && y > -3"),
    ("a", "a != 1"),
    ("c", "!(c = 1)"),
    ("b", "b"),
    ("d", "d > r"),
];
