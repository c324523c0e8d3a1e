//! Query modules and shapes, against a naive interpreter that walks each generation from the start.

use lsystem::base::Limits;
use lsystem::syntax::Definition;
use lsystem::{System, expand};

fn definition(axiom: &str, rules: &str, angle: f64) -> Definition {
    Definition { axiom: axiom.into(), rules: rules.into(), angle, ..Definition::default() }
}

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap_or_else(|problems| panic!("{problems}"))
}

fn string(definition: &Definition, n: u32) -> String {
    expand(&system(definition), n, &Limits::default()).unwrap()
}

/// The modules of a word: symbols (`?P` as `?P`) and their arguments.
fn modules(word: &str) -> Vec<(String, Vec<f64>)> {
    let mut found: Vec<(String, Vec<f64>)> = vec![];
    let mut rest = word;
    while let Some(first) = rest.chars().next() {
        let length = if first == '?' { 2 } else { first.len_utf8() };
        let symbol = rest[..length].to_owned();
        rest = &rest[length..];
        let mut arguments = vec![];
        if let Some(inside) = rest.strip_prefix('(') {
            let end = inside.find(')').unwrap();
            arguments = inside[..end].split(',').map(|number| number.parse().unwrap()).collect();
            rest = &inside[end + 1..];
        }
        found.push((symbol, arguments));
    }
    found
}

type Frame = [[f64; 3]; 4];

/// The turtle's place and its heading, left and up at each query, by vectors and Rodrigues' formula.
fn walked(word: &str, angle: f64) -> Vec<Frame> {
    let mut state: Frame = [[0.0; 3], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let (mut saved, mut found) = (vec![], vec![]);
    for (symbol, arguments) in modules(word) {
        let number = arguments.first().copied();
        let (axis, sign) = match symbol.as_str() {
            "+" => (3, 1.0),
            "-" => (3, -1.0),
            "&" => (2, 1.0),
            "^" => (2, -1.0),
            "\\" => (1, 1.0),
            "/" => (1, -1.0),
            "F" | "f" => {
                let length = number.unwrap_or(1.0);
                (0..3).for_each(|i| state[0][i] += length * state[1][i]);
                continue;
            }
            "[" => {
                saved.push(state);
                continue;
            }
            "]" => {
                state = saved.pop().unwrap();
                continue;
            }
            query if query.starts_with('?') => {
                found.push(state);
                continue;
            }
            _ => continue,
        };
        let (sin, cos) = libm::sincos((sign * number.unwrap_or(angle)).to_radians());
        let about = state[axis];
        for vector in &mut state[1..] {
            let [x, y, z] = *vector;
            let [a, b, c] = about;
            let along = a * x + b * y + c * z;
            let cross = [b * z - c * y, c * x - a * z, a * y - b * x];
            *vector = [0, 1, 2].map(|i| vector[i] * cos + cross[i] * sin + about[i] * along * (1.0 - cos));
        }
    }
    found
}

#[test]
fn answers_are_those_of_a_turtle() {
    let rules = "A -> F[+(20)A?P(0,0,0)]/(100)[&A?H(0,0,0)]^(15)F(1.5)?L(0,0,0)?U(0,0,0)A\nF(l) -> F(l*1.1)";
    let definition = definition("A?P(9,9,9)", rules, 35.0);
    for n in 0..5 {
        let word = string(&definition, n);
        let queries: Vec<_> = modules(&word).into_iter().filter(|(symbol, _)| symbol.starts_with('?')).collect();
        let frames = walked(&word, 35.0);
        assert_eq!(queries.len(), frames.len());
        assert!(n == 0 || queries.len() > 3);
        for ((symbol, answer), frame) in queries.iter().zip(&frames) {
            let of = ["?P", "?H", "?L", "?U"].iter().position(|query| query == symbol).unwrap();
            let off = (0..3).map(|i| (answer[i] - frame[of][i]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-9, "n = {n}: {symbol} {answer:?}, not {:?}", frame[of]);
        }
    }
}

#[test]
fn answers_are_those_of_the_drawn_turtle() {
    // Symbols that only the rules for drawing have count as well.
    let grown = "A(w) -> I(w,1)[+A(w*0.8)?P(0,0,0)]/(70)[&A(w*0.7)?H(0,0,0)]?S(0,1)\nI(w,a) -> I(w,a+1)";
    let image = |(symbol, numbers): (String, Vec<f64>)| match symbol.as_str() {
        "I" => format!("F({})-(5)G({})", numbers[0], numbers[0] * numbers[1]),
        "A" => "[F(3)]".to_owned(),
        symbol if symbol.starts_with('?') => format!("{symbol}(0,0,0)"),
        symbol if numbers.is_empty() => symbol.to_owned(),
        symbol => format!("{symbol}({})", numbers[0]),
    };
    let own = definition("A(2)?P(9,9,9)", &format!("{grown}\ndraw:\nI(w,a) -> F(w)-(5)G(w*a)\nA(w) -> [F(3)]"), 35.0);
    for n in 1..6 {
        let word = string(&own, n);
        let drawn: String = modules(&word).into_iter().map(image).collect();
        let frames = walked(&drawn.replace('G', "F"), 35.0);
        let queries = modules(&word).into_iter().filter(|(symbol, _)| symbol.starts_with('?'));
        for ((symbol, answer), frame) in queries.zip(&frames) {
            let Some(of) = ["?P", "?H"].iter().position(|query| *query == symbol) else { continue };
            let off = (0..3).map(|i| (answer[i] - frame[of][i]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-9, "n = {n}: {symbol} {answer:?}, not {:?}", frame[of]);
        }
    }
    // Three heights have three different lights, in cubes that are one step wide.
    let lights = string(&definition("?S(0,1)A?S(0,1)A?S(0,1)", "draw:\nA -> F(3)", 90.0), 0);
    assert_eq!(lights, "?S(0.971875,1)A?S(0.975,1)A?S(1,1)");
}

#[test]
fn answers_follow_the_turtle_of_the_definition() {
    let mut own = definition("F[+F?P(0,0)]?H(0,0)", "X -> X", 90.0);
    (own.start, own.step, own.heading) = ([10.0, 20.0], 2.0, 0.0);
    assert_eq!(string(&own, 1), "F[+F?P(12,22)]?H(1,0)");
    // Growth of the last generation changes no decision of earlier ones.
    own.growth = 0.5;
    assert_eq!(string(&own, 1), "F[+F?P(12,22)]?H(1,0)");
}

#[test]
fn conditions_prune_what_leaves_a_shape() {
    // Synthetic Topiary (1994), after figure 1: branches outside of a square are cut.
    let rules = "shape square = box(-4, -1, -1, 4, 7, 1)\n\
        A -> F?P(0,0)[+A][-A]A\n\
        ?P(x,y) : not inside(square, x, y) -> %";
    let own = definition("A", rules, 40.0);
    for n in 1..9 {
        // A branch is seen to be outside, gets a `%`, and is cut: it is two segments longer then.
        let off = |at: f64, low: f64, high: f64| (low - at).max(at - high).max(0.0);
        for (symbol, answer) in modules(&string(&own, n)).iter().filter(|(symbol, _)| symbol == "?P") {
            let far = off(answer[0], -4.0, 4.0).max(off(answer[1], -1.0, 7.0));
            assert!(far < 2.5, "n = {n}: {symbol} {answer:?}");
        }
    }
    // Without the shape there is far more.
    let free = definition("A", "A -> F?P(0,0)[+A][-A]A", 40.0);
    let drawn = |definition: &Definition| string(definition, 11).matches('F').count();
    let counts = [drawn(&own), drawn(&free)];
    assert!(counts[0] * 2 < counts[1], "{counts:?}");
}

#[test]
fn trees_lean_away_from_each_other() {
    // Palubicki et al. 2009, as in their pictures of trees that compete for light: crowns side by side are narrower
    // where they meet, and far apart they are not.
    let path = format!("{}/../../data_in/garden/two-trees.json", env!("CARGO_MANIFEST_DIR"));
    let own = lsystem::read_json(&std::fs::read_to_string(path).unwrap()).0.unwrap();
    // How far the living buds of both trees reach: inwards and outwards.
    let reach = |apart: f64| {
        let axiom = own.axiom.replace("f(12)", &format!("f({apart})"));
        let word = string(&Definition { axiom, ..own.clone() }, 20);
        let buds = walked(&word, own.angle);
        let mut depth = 0;
        let first = modules(&word).into_iter().map_while(|(symbol, _)| {
            depth += i32::from(symbol == "[") - i32::from(symbol == "]");
            (depth > 0).then_some(symbol)
        });
        let split = first.filter(|symbol| symbol == "?S").count();
        assert!(split > 100 && buds.len() - split > 100, "{split} {}", buds.len());
        let most =
            |buds: &[Frame], side: f64, at: f64| buds.iter().map(|bud| side * (bud[0][0] - at)).fold(0.0, f64::max);
        let [left, right] = [&buds[..split], &buds[split..]];
        [most(left, 1.0, 0.0) + most(right, -1.0, apart), most(left, -1.0, 0.0) + most(right, 1.0, apart)]
    };
    for apart in [8.0, 12.0, 14.0] {
        let [inwards, outwards] = reach(apart);
        assert!(inwards < 0.6 * outwards, "{apart}: {inwards} {outwards}");
    }
    let [inwards, outwards] = reach(40.0);
    assert!(inwards > 0.75 * outwards, "{inwards} {outwards}");
}

#[test]
fn differences_of_distances_keep_ivy_on_its_trellis() {
    let path = format!("{}/../../data_in/garden/ivy-trellis.json", env!("CARGO_MANIFEST_DIR"));
    let own = lsystem::read_json(&std::fs::read_to_string(path).unwrap()).0.unwrap();
    // The bars as lines: two ends and a radius.
    let posts = [-5.0, 0.0, 5.0].map(|x| ([x, 0.0, 0.0], [x, 15.0, 0.0], 0.25));
    let bars = [3.0, 7.0, 11.0, 14.0].map(|y| ([-6.5, y, 0.0], [6.5, y, 0.0], 0.2));
    let off = |at: &[f64]| {
        let lines = posts.iter().chain(&bars).map(|&(from, to, radius): &([f64; 3], [f64; 3], f64)| {
            let points = (0..=1000).map(|part| {
                let t = f64::from(part) / 1000.0;
                let way = [0, 1, 2].map(|i| from[i] * (1.0 - t) + to[i] * t - at[i]);
                way.iter().map(|c| c * c).sum::<f64>().sqrt() - radius
            });
            points.fold(f64::INFINITY, f64::min)
        });
        lines.fold(f64::INFINITY, f64::min)
    };
    let median = |own: &Definition| {
        let word = string(own, 50);
        let places = modules(&word).into_iter().filter(|(symbol, _)| symbol == "?P").map(|(_, place)| place);
        let mut offs: Vec<f64> = places.map(|place| off(&place)).collect();
        offs.sort_by(f64::total_cmp);
        offs[offs.len() / 2]
    };
    let free = Definition { rules: own.rules.replace("-250", "0"), ..own.clone() };
    let [own, free] = [median(&own), median(&free)];
    assert!(own < 0.7 && free > 2.0 * own, "{own}, and {free} without the turns");
}

#[test]
fn crowds_and_light_are_asked_in_the_same_way() {
    // Five apices in a row, a step apart, and one above the middle of them.
    let axiom = "-(90)f[?C(0,1.5)?S(0,1)]f[?C(0,1.5)?S(0,1)]f[?C(0,1.5)?S(0,1)+(90)fff?S(0,1)]f[?C(0,1.5)?S(0,1)]f?C(0,1.5)?S(0,1)";
    let word = string(&definition(axiom, "X -> X", 90.0), 1);
    let of = |wanted: &str| -> Vec<f64> {
        modules(&word).into_iter().filter(|(symbol, _)| symbol == wanted).map(|(_, answer)| answer[0]).collect()
    };
    assert_eq!(of("?C"), [1.0, 2.0, 2.0, 2.0, 1.0]);
    // The shadow three layers below is an eighth of 0.2, and seven cubes wide.
    let light = of("?S");
    assert!(light.iter().all(|light| (light - 0.975).abs() < 1e-12 || *light == 1.0), "{light:?}");
    assert_eq!(light.iter().filter(|light| **light == 1.0).count(), 1);
}

#[test]
fn histories_and_pages_show_the_answers() {
    use lsystem::Figure;
    let own = definition("A", "A -> F?P(0,0)[+A]A", 30.0);
    let system = system(&own);
    let word = expand(&system, 4, &Limits::default()).unwrap();
    let figure = Figure::draw(&system, 4, &Limits::default()).unwrap();
    assert_eq!(figure.segment_count(), modules(&word).iter().filter(|(symbol, _)| symbol == "F").count() as u128);
}

#[test]
fn wrong_shapes_are_told_with_their_places() {
    let told = |rules: &str| -> Vec<String> {
        System::problems(&definition("A", rules, 30.0)).iter().map(|problem| problem.message.clone()).collect()
    };
    let use_it = "\nA -> F?P(0,0)A\n?P(x,y) : inside(s, x, y) -> *";
    for (shape, message) in [
        ("shape s = bal(1, 2, 3, 4)", "`bal` is not a solid with its numbers"),
        ("shape s = ball(1, 2, 3)", "`ball` takes 4 numbers, not 3"),
        ("shape s = outline(1, 2, 3, 4)", "`outline` takes two numbers for each of 3 to 2000 corners"),
        ("shape s = ball(1, 2, 3, 4) +", "A solid is missing"),
        ("shape s = ", "A solid is missing"),
        ("shape 1s = ball(1, 2, 3, 4)", "`1s` cannot be the name"),
    ] {
        let found = told(&format!("{shape}{use_it}"));
        assert!(found.iter().any(|one| one.contains(message)), "{shape}: {found:?}");
    }
    assert!(
        told("A -> F?P(0,0)A\n?P(x,y) : inside(crown, x, y) -> *")[0].contains("`crown` is not the name of a shape")
    );
    assert!(told("shape s = ball(0,0,0,1)\nA -> FA").iter().any(|one| one.contains("Nothing uses the shape `s`")));
    assert!(told(&format!("shape s = ball(1, 2, 3, 4){use_it}")).is_empty());
}

#[test]
fn what_is_printed_reads_back() {
    use lsystem::syntax::{parse, print_axiom, print_rules};
    let rules = "r = 2\n\
        shape s = ball(0, r, 0, 2*r) - (box(0, 0, 0, 1, 1, 1) + cone(0, 0, 0, 0, 1, 0, 1)) & outline(0, 0, 1, 0, 0, 1)\n\
        A < ?P(x,y,z) > B : distance(s, x, y, z) < 1 && inside(s, x, y) -> ?H(x,y,z)`?`P(1)?C(0,r)\n\
        `Ⓟ` -> `@`c";
    let (grammar, diagnostics) = parse("A?P(1,2,3)B", rules);
    assert_eq!(diagnostics.iter().filter(|d| d.is_error()).count(), 0, "{diagnostics:?}");
    let again = parse(&print_axiom(&grammar), &print_rules(&grammar)).0;
    assert_eq!(again, grammar, "{}", print_rules(&grammar));
    assert!(print_rules(&grammar).contains("?P(x, y, z)"));
}

#[test]
fn questions_have_bounded_work() {
    use lsystem::base::LimitName;
    use lsystem::syntax::Kind;
    // One module asks far around, so that all the others look at each other, and none is near enough to be counted.
    let own = definition("?C(0,100000)A", "A -> AA?C(0,0.000001)f(0.001)", 90.0);
    let limits = Limits { work: 200_000, ..Limits::default() };
    let error = expand(&system(&own), 14, &limits).unwrap_err();
    assert!(matches!(error.kind, Kind::Limit { limit: LimitName::Work, .. }), "{error:?}");
}
