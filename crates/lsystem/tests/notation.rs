//! The notation: printed texts read back as the same, and no text causes a panic.

use lsystem::syntax::grammar::{NamedCurve, NamedShape};
use lsystem::syntax::{
    Constant, Curve, Expr, Function, Grammar, Module, Operator, Pattern, Production, Seen, Shape, parse,
    parse_overrides, print_axiom, print_overrides, print_rules,
};
use lsystem::{Definition, Diagnostic, System};
use proptest::prelude::*;
use std::sync::Arc;

/// Letters, all characters with a meaning in the notation, look-alikes, invisible characters, and others.
fn symbol() -> impl Strategy<Value = char> {
    prop_oneof![
        4 => prop::sample::select("FGXabcoPH?Ⓟ@●01+-[]".chars().collect::<Vec<_>>()),
        4 => prop::sample::select("`:->=#/*()<ε→.,;{}|\\^&$!'\"% \t\n\r_".chars().collect::<Vec<_>>()),
        1 => prop::sample::select("−–—’“ˆ（）＞⇒\u{feff}\u{200b}\u{a0}\u{2028}\u{0}\u{301}é木🌱".chars().collect::<Vec<_>>()),
        1 => any::<char>(),
    ]
}

/// Names that sometimes clash with each other, with constants and with functions.
fn name() -> impl Strategy<Value = String> {
    let reserved = |name: &String| !["and", "or", "not"].contains(&name.as_str());
    prop_oneof![4 => "[a-dα_]", 1 => "[a-zA-Zα_][a-z0-9_]{0,4}", 1 => Just("sin".to_owned())]
        .prop_filter("not reserved", reserved)
}

/// Expressions as the notation reads them: a number includes its sign.
fn expression(names: Vec<String>) -> impl Strategy<Value = Expr> {
    let leaf = if names.is_empty() {
        number().prop_map(Expr::Number).boxed()
    } else {
        prop_oneof![number().prop_map(Expr::Number), prop::sample::select(names).prop_map(Expr::Name)].boxed()
    };
    leaf.prop_recursive(4, 24, 3, |inner| {
        let two = || (inner.clone(), inner.clone());
        prop_oneof![
            inner.clone().prop_map(|a| match a {
                Expr::Number(value) => Expr::Number(-value),
                a => Expr::Negative(Box::new(a)),
            }),
            inner.clone().prop_map(|a| Expr::Not(Box::new(a))),
            inner.clone().prop_map(|a| Expr::Curve(CURVE.into(), Box::new(a))),
            (prop::sample::select(&Operator::ALL), two()).prop_map(|(operator, (a, b))| Expr::Binary(
                operator,
                Box::new(a),
                Box::new(b)
            )),
            (prop::sample::select(&Function::ALL), two()).prop_map(|(function, (a, b))| {
                let shape = function.takes_shape().then(|| Expr::Name(SHAPE.into()));
                let numbers = function.arity().min(2);
                Expr::Call(function, shape.into_iter().chain([a, b].into_iter().take(numbers)).collect())
            }),
        ]
    })
}

fn word(names: Vec<String>) -> impl Strategy<Value = Vec<Module>> {
    let arguments = prop_oneof![
        2 => Just(vec![]).boxed(),
        1 => prop::collection::vec(expression(names), 0..=3).boxed(),
    ];
    let module = (symbol(), arguments).prop_map(|(symbol, arguments)| Module { symbol, arguments });
    prop::collection::vec(module, 0..8)
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![9 => (-100..100).prop_map(f64::from), 1 => any::<f64>().prop_filter("finite", |v| v.is_finite())]
}

/// A left context, a predecessor and a right context, all with different names of parameters.
fn head(contexts: bool) -> impl Strategy<Value = (Vec<Pattern>, Pattern, Vec<Pattern>)> {
    let symbols = |most| prop::collection::vec((symbol(), 0_usize..3), 0..most);
    let most = if contexts { 4 } else { 1 };
    let names = prop::collection::btree_set(name(), 0..8);
    (symbols(most), (symbol(), 0_usize..3), symbols(most), any::<u32>(), names).prop_map(
        |(left, strict, right, branches, names)| {
            let mut names = names.into_iter();
            let mut pattern =
                |(symbol, count): (char, usize)| Pattern { symbol, parameters: names.by_ref().take(count).collect() };
            let bracket = |symbol: char| matches!(symbol, '[' | ']');
            let left = left.into_iter().filter(|(s, _)| !bracket(*s)).map(&mut pattern).collect();
            let strict = pattern(strict);
            let mut brackets = Vec::new();
            for (at, one) in right.into_iter().filter(|(s, _)| !bracket(*s)).enumerate() {
                // Random bits decide the places of branches.
                if branches >> at & 1 == 1 {
                    brackets.extend([Pattern::from('['), pattern(one), Pattern::from(']')]);
                } else {
                    brackets.push(pattern(one));
                }
            }
            (left, strict, brackets)
        },
    )
}

fn production(contexts: bool, constants: Vec<String>) -> impl Strategy<Value = Production> {
    head(contexts).prop_flat_map(move |(left, predecessor, right)| {
        let all = left.iter().chain([&predecessor]).chain(&right);
        let mut names: Vec<String> = all.flat_map(|p| p.parameters.clone()).collect();
        names.extend(constants.clone());
        let weight = prop_oneof![0.001..10.0, 1e-99..1e-90, 1e90..1e99].prop_map(Expr::Number);
        let weight = prop_oneof![weight, expression(names.clone())];
        let condition = prop::option::of(expression(names.clone()));
        (condition, word(names), prop::option::of(weight)).prop_map(move |(condition, successor, weight)| Production {
            left: left.clone(),
            predecessor: predecessor.clone(),
            right: right.clone(),
            condition,
            successor,
            weight,
        })
    })
}

/// Names that no random name equals.
const SHAPE: &str = "crown_of_the_tree";
const CURVE: &str = "taper_of_the_stem";

fn curve() -> Curve {
    Curve::new(vec![[-1.0, 1.5], [0.25, 1e-7], [0.25, -3.0], [1e9, 0.1]]).unwrap()
}

fn shape() -> Shape {
    let solids = [
        Shape::Ball([0.0, 10.5, 0.0, 5.0]),
        Shape::Block([-1.0, 0.0, -1.0, 1.0, 2.0, 1.0]),
        Shape::Cylinder([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.25]),
        Shape::Cone([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.25]),
        Shape::Half([0.0, 3.0, 0.0, 0.0, -1.0, 0.0]),
        Shape::Outline(vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1e-3]]),
    ];
    let [a, b, c, d, e, f] = solids.map(Box::new);
    let inner = Shape::Difference(b, Box::new(Shape::Union(c, d)));
    Shape::Intersection(Box::new(Shape::Union(a, Box::new(inner))), Box::new(Shape::Difference(e, f)))
}

fn seen() -> impl Strategy<Value = Seen> {
    let list = || prop::collection::vec(symbol(), 0..5);
    prop_oneof![Just(Seen::All), list().prop_map(Seen::Except), list().prop_map(Seen::Only)]
}

fn grammar() -> impl Strategy<Value = Grammar> {
    prop::collection::btree_map(name(), number(), 0..3).prop_flat_map(|constants| {
        let names: Vec<String> = constants.keys().cloned().collect();
        let constants: Vec<Constant> = constants.into_iter().map(|(name, value)| Constant { name, value }).collect();
        let productions = prop::collection::vec(production(true, names.clone()), 0..5);
        let images = prop::collection::vec(production(false, names.clone()), 0..3);
        (word(names), productions, images, seen()).prop_map(move |(axiom, productions, images, seen)| Grammar {
            axiom,
            productions,
            images,
            constants: constants.clone(),
            shapes: vec![NamedShape { name: SHAPE.into(), shape: Arc::new(shape()) }],
            curves: vec![NamedCurve { name: CURVE.into(), curve: Arc::new(curve()) }],
            seen,
        })
    })
}

/// Whether a constant expression of the grammar has no finite value, or a weight is out of range.
fn is_wrong(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.message.contains("is not a finite number") || d.message.contains("cannot be a weight"))
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn printed_grammars_read_back(grammar in grammar()) {
        let (axiom, rules) = (print_axiom(&grammar), print_rules(&grammar));
        let (read, diagnostics) = parse(&axiom, &rules);
        if is_wrong(&diagnostics) {
            return Ok(());
        }
        prop_assert_eq!(read, grammar, "{}\n{}\n{:?}", axiom, rules, diagnostics);
        prop_assert!(!diagnostics.iter().any(Diagnostic::is_error), "{:?}", diagnostics);
    }

    #[test]
    fn no_text_panics(
        axiom in prop::collection::vec(symbol(), 0..40),
        rules in prop::collection::vec(symbol(), 0..120),
        overrides in prop::collection::vec(symbol(), 0..40),
    ) {
        let text = |chars: Vec<char>| chars.into_iter().collect::<String>();
        let definition =
            Definition { axiom: text(axiom), rules: text(rules), overrides: text(overrides), ..Definition::default() };
        let is_wrong = System::new(&definition).is_err();
        let diagnostics = System::problems(&definition);
        prop_assert_eq!(is_wrong, diagnostics.iter().any(Diagnostic::is_error));
        for diagnostic in diagnostics {
            let text = match diagnostic.field {
                lsystem::syntax::Field::Axiom => &definition.axiom,
                lsystem::syntax::Field::Rules => &definition.rules,
                lsystem::syntax::Field::Overrides => &definition.overrides,
                _ => continue,
            };
            prop_assert!(text.get(diagnostic.span.clone()).is_some(), "{:?} in {:?}", diagnostic, text);
            prop_assert!(!diagnostic.message.is_empty());
        }
    }

    #[test]
    fn overrides_read_back(text in "([A-G#:,/]: ?(draw|MOVE|turn left|turn right|width|colour|color|next colour|previous color|thicker|thinner|pop|push|nothing|turn round|width times)( -?[0-9]{1,3}(\\.5)?)?(, draw)?\n){0,5}") {
        let (overrides, _) = parse_overrides(&text);
        let (again, diagnostics) = parse_overrides(&print_overrides(&overrides));
        prop_assert_eq!(again, overrides);
        prop_assert_eq!(diagnostics, vec![]);
    }
}

#[test]
fn a_context_of_slashes_is_no_comment() {
    let (grammar, diagnostics) = parse("", "`/`/ < F -> G");
    assert!(!is_wrong(&diagnostics), "{diagnostics:?}");
    assert_eq!(print_rules(&grammar), "`/`/ < F -> G");
}
