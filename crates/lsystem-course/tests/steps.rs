//! Steps compared with strings, with drawings, and with replacing text.

use lsystem_base::Limits;
use lsystem_course::steps::{Order, one_by_one, rows, trace};
use lsystem_drawing::{Plane, Solid, System, draw, expand};
use lsystem_syntax::Definition;

fn system(axiom: &str, rules: &str) -> System {
    let definition = Definition {
        axiom: axiom.into(),
        rules: rules.into(),
        angle: 35.0,
        seed: 5,
        length_factor: 0.8,
        ..Definition::default()
    };
    System::new(&definition).expect("a system without errors")
}

/// Systems of all kinds.
fn systems() -> Vec<System> {
    [
        ("X", "X -> F[+X]F[-X]+X\nF -> FF"),
        ("AB", "A -> AB\nB ->"),
        ("F", "F -> F[+F]F : 0.4\nF -> F[-F] : 0.6"),
        ("baaaa", "b < a -> b\nb -> a"),
        ("A(3)F", "A(x) : x > 0 -> F(x)[+A(x-1)]-(20)A(x-1)\nA(x) : x <= 0 -> F"),
        ("F1F1F1", "ignore: +-F\n0 < 1 > 0 -> 1\n1 < 1 > 0 -> 1[+F1F1]\n1 -> 0"),
        ("A", "A -> F[&A]////[^A]$F\\A"),
    ]
    .into_iter()
    .map(|(axiom, rules)| system(axiom, rules))
    .collect()
}

#[test]
fn children_in_order_are_the_next_generation() {
    for system in systems() {
        for n in 0..5 {
            let [now, next] = [n, n + 1].map(|n| expand(&system, n, &Limits::default()).unwrap());
            let rows = rows(&system, n, 0, 400).unwrap();
            let is_whole = rows.families.len().to_string() == rows.lengths[0];
            let parents: String = rows.families.iter().map(|family| family.parent.as_str()).collect();
            assert!(now.starts_with(&parents) && (!is_whole || now == parents), "{now} {parents}");
            let mut children = String::new();
            let mut count = 0;
            for family in &rows.families {
                assert_eq!(family.first, count.to_string());
                count += family.children.len();
                family.children.iter().for_each(|child| children += child);
            }
            assert!(next.starts_with(&children) && (!is_whole || next == children), "{next} {children}");
        }
    }
}

#[test]
fn any_place_of_any_generation_is_read() {
    let system = system("X", "X -> F[+X]F[-X]+X\nF -> FF");
    let whole = rows(&system, 5, 0, 400).unwrap();
    let part = rows(&system, 5, 137, 20).unwrap();
    assert_eq!(part.families[..], whole.families[137..157]);
    let far = rows(&system, 60, 10_u128.pow(20), 5).unwrap();
    assert_eq!((far.start.as_str(), far.families.len()), ("100000000000000000000", 5));
    assert!(rows(&system, 1000, 0, 5).is_err());
    let random = rows(&self::system("F", "F -> FF : 1\nF -> F+F : 1"), 60, 0, 5);
    assert!(random.unwrap_err().contains("too long"));
}

#[test]
fn one_symbol_at_a_time_differs_from_all_at_once() {
    let lengths = |axiom: &str, rules: &str| -> Vec<usize> {
        one_by_one(&system(axiom, rules), 4, Order::Leftmost).unwrap().iter().map(|single| single.length).collect()
    };
    // The question of the course: 1, 2, 4, 8 all at once.
    assert_eq!(lengths("S", "S -> SS"), [1, 2, 3, 4, 5]);
    assert_eq!(lengths("AAA", "A ->"), [3, 2, 1, 0]);
    let strings = |axiom: &str, rules: &str| -> Vec<String> {
        one_by_one(&system(axiom, rules), 4, Order::Leftmost).unwrap().into_iter().map(|single| single.text).collect()
    };
    assert_eq!(strings("AB", "A -> B\nB -> A"), ["AB", "BB", "AB", "BB", "AB"]);
    assert_eq!(strings("A", "A -> AB\nB -> A"), ["A", "AB", "ABB", "ABBB", "ABBBB"]);
    assert_eq!(one_by_one(&system("XA", "A -> BC"), 9, Order::Leftmost).unwrap()[1].made, Some([1, 2]));
    assert!(one_by_one(&system("AB", "A < B -> A"), 3, Order::Leftmost).is_err());
}

/// In another order the strings differ.
#[test]
fn the_order_matters() {
    let strings = |rules: &str, order| -> Vec<String> {
        one_by_one(&system("A", rules), 4, order).unwrap().into_iter().map(|single| single.text).collect()
    };
    let algae = "A -> AB\nB -> A";
    assert_eq!(strings(algae, Order::Leftmost), ["A", "AB", "ABB", "ABBB", "ABBBB"]);
    assert_eq!(strings(algae, Order::Rightmost), ["A", "AB", "AA", "AAB", "AAA"]);
    let last = one_by_one(&system("AXA", "A -> BC\nB ->"), 2, Order::Rightmost).unwrap();
    assert_eq!((last[1].made, last[2].text.as_str(), last[2].made), (Some([2, 2]), "AXC", Some([2, 0])));
}

/// Random systems, rewritten one symbol at a time by replacing text.
#[test]
fn one_symbol_at_a_time_is_replacing_text() {
    let mut seed = 9_u64;
    let mut below = |most: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % most
    };
    for _ in 0..200 {
        let mut word = |most| (0..below(most)).map(|_| ["A", "B", "C", "+"][below(4) as usize]).collect::<String>();
        let rules = [("A", word(4)), ("B", word(3)), ("C", word(2))];
        let axiom = format!("{}A", word(3));
        let text: Vec<String> = rules.iter().map(|(from, to)| format!("{from} -> {to}")).collect();
        let found = one_by_one(&system(&axiom, &text.join("\n")), 30, Order::Leftmost).unwrap();
        let mut expected = axiom;
        for single in &found {
            assert_eq!(single.text, expected, "{text:?}");
            assert_eq!(single.length, expected.len());
            let Some(at) = expected.find(['A', 'B', 'C']) else { break };
            let rule = rules.iter().find(|(from, _)| expected[at..].starts_with(from)).unwrap();
            expected.replace_range(at..=at, &rule.1);
        }
        assert!(found.len() == 31 || !expected.contains(['A', 'B', 'C']), "{text:?}");
    }
}

#[test]
fn the_turtle_draws_what_the_drawing_has() {
    for system in systems() {
        for n in 0..4 {
            let trace = trace(&system, n, 4000).unwrap();
            let segments: Vec<[[f64; 3]; 2]> = trace.states.iter().filter_map(|state| state.segment).collect();
            let limits = Limits::default();
            let expected: Vec<[[f64; 3]; 2]> = match system.is_solid() {
                true => draw::<Solid>(&system, n, &limits).unwrap().segments().map(|s| [s.from, s.to]).collect(),
                false => (draw::<Plane>(&system, n, &limits).unwrap().segments())
                    .map(|s| [s.from, s.to].map(|[x, y]| [x, y, 0.0]))
                    .collect(),
            };
            assert_eq!(segments.len(), expected.len(), "{n} {:?}", system.grammar);
            let ends = segments.iter().flatten().flatten().zip(expected.iter().flatten().flatten());
            assert!(ends.into_iter().all(|(a, b)| (a - b).abs() < 1e-9), "{n} {segments:?} {expected:?}");
            let text = expand(&system, n, &limits).unwrap();
            let read: String = trace.states.iter().map(|state| state.symbol.as_str()).collect();
            assert_eq!(read, text);
        }
    }
}

#[test]
fn the_stack_is_told() {
    let trace = trace(&system("F[+F[-F]F]F", ""), 0, 100).unwrap();
    let depths: Vec<usize> = trace.states.iter().map(|state| state.depth).collect();
    assert_eq!(depths, [0, 0, 1, 1, 1, 2, 2, 2, 1, 1, 0, 0]);
    assert_eq!(trace.states[5].stored.len(), 2);
    assert_eq!(trace.states[5].stored[1], [0.0, 1.0, 0.0]);
    let bent = Definition { axiom: "F".into(), elasticity: 0.2, tropism: [1.0, 0.0, 0.0], ..Definition::default() };
    assert!(lsystem_course::steps::trace(&System::new(&bent).unwrap(), 0, 9).is_err());
}
