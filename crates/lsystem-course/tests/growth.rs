//! Growth compared with brute force and with published values.

use lsystem_base::Limits;
use lsystem_course::growth::{Growth, GrowthKind, growth};
use lsystem_drawing::{System, expand};
use lsystem_syntax::Definition;

fn system(axiom: &str, rules: &str, angle: f64) -> System {
    let definition =
        Definition { axiom: axiom.into(), rules: rules.into(), angle, heading: 0.0, ..Definition::default() };
    System::new(&definition).expect("a system without errors")
}

fn of(axiom: &str, rules: &str, angle: f64) -> Growth {
    growth(&system(axiom, rules, angle), 12).expect("a plain system")
}

fn counts(text: &str) -> Vec<String> {
    text.split(' ').map(str::to_owned).collect()
}

fn symbols(growth: &Growth) -> Vec<String> {
    growth.table.iter().map(|row| row.symbols.digits.clone()).collect()
}

/// Deterministic random numbers.
struct Random(u64);

impl Random {
    fn below(&mut self, most: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % most
    }

    fn word(&mut self, alphabet: &[char], most: u64) -> String {
        (0..self.below(most + 1)).map(|_| alphabet[self.below(alphabet.len() as u64) as usize]).collect()
    }
}

/// The value of `s(n) = ...` from the values before it.
fn follows(recurrence: &str, values: &[i128], n: usize) -> i128 {
    let right = recurrence.split(" = ").nth(1).expect("an equation");
    let spaced = right.replace("- ", "-").replace("+ ", "+");
    let mut sum = 0;
    let mut factor = 1;
    for word in spaced.split(' ').filter(|word| *word != "0") {
        let (sign, word) = match word.strip_prefix('-') {
            Some(word) => (-1, word),
            None => (1, word.trim_start_matches('+')),
        };
        match word.strip_prefix("s(n-") {
            Some(back) => {
                let back: usize = back.trim_end_matches(')').parse().expect("a number");
                sum += factor * sign * values[n - back];
                factor = 1;
            }
            None => factor = sign * word.parse::<i128>().expect("a factor"),
        }
    }
    sum
}

/// The value of a closed form with whole roots.
fn value(closed: &str, n: u32) -> Option<f64> {
    if closed.contains('√') {
        return None;
    }
    let spaced = closed.replace("- ", "-").replace("+ ", "+");
    let mut sum = 0.0;
    for term in spaced.replace(" · ", "*").split(' ') {
        let (sign, term) = match term.strip_prefix('-') {
            Some(term) => (-1.0, term),
            None => (1.0, term.trim_start_matches('+')),
        };
        let product: f64 = (term.split('*'))
            .map(|part| match part.split_once('^') {
                Some(("n", power)) => libm::pow(f64::from(n), power.parse().expect("a power")),
                Some((root, _)) => libm::pow(root.trim_matches(['(', ')']).parse().expect("a root"), f64::from(n)),
                None if part == "n" => f64::from(n),
                None => match part.split_once('/') {
                    Some((over, under)) => over.parse::<f64>().unwrap() / under.parse::<f64>().unwrap(),
                    None => part.parse().expect("a number"),
                },
            })
            .product();
        sum += sign * product;
    }
    Some(sum)
}

#[test]
fn random_systems_are_counted_as_by_brute_force() {
    let mut random = Random(7);
    let (mut recurrences, mut closed_forms) = (0, 0);
    for _ in 0..400 {
        let alphabet: Vec<char> = "ABCDF+".chars().take(2 + random.below(5) as usize).collect();
        let axiom = format!("{}F", random.word(&alphabet, 4));
        let rules: Vec<String> = alphabet
            .iter()
            .filter(|symbol| **symbol != '+')
            .map(|symbol| format!("{symbol} -> {}", random.word(&alphabet, 3)))
            .collect();
        let system = system(&axiom, &rules.join("\n"), 60.0);
        let growth = growth(&system, 8).unwrap();
        for row in &growth.table {
            let Ok(text) = expand(&system, row.n, &Limits { symbols: 200_000, ..Limits::default() }) else { break };
            assert_eq!(row.symbols.digits, text.chars().count().to_string(), "{axiom} {rules:?} {}", row.n);
            assert_eq!(
                row.segments.digits,
                text.chars().filter(|c| "ABCDF".contains(*c) && *c == 'F').count().to_string()
            );
            for (letter, count) in growth.letters.iter().zip(&row.letters) {
                assert_eq!(count.digits, text.matches(letter.as_str()).count().to_string(), "{axiom} {rules:?}");
            }
        }
        let values: Vec<i128> = growth.table.iter().map(|row| row.symbols.digits.parse().unwrap()).collect();
        let series = &growth.symbols;
        let recurrence = series.recurrence.as_deref().expect("small systems have recurrences");
        for n in series.from..values.len() {
            assert_eq!(follows(recurrence, &values, n), values[n], "{axiom} {rules:?} {recurrence} at {n}");
        }
        recurrences += 1;
        if let Some(closed) = &series.closed {
            closed_forms += 1;
            for (n, expected) in values.iter().enumerate().skip(series.closed_from) {
                let Some(found) = value(closed, n as u32) else { break };
                let expected = *expected as f64;
                assert!(
                    (found - expected).abs() <= 1e-6 * expected.max(1.0),
                    "{axiom} {rules:?} {closed} at {n}: {found} {expected}"
                );
            }
        }
        // The factor agrees with quotients far out.
        if series.kind == GrowthKind::Exponential && series.factor > 1.1 {
            let far = growth_at(&system, 400);
            let quotient = (far[1] - far[0]) / 20.0 * core::f64::consts::LN_10;
            assert!(
                (libm::exp(quotient) - series.factor).abs() < 0.05 * series.factor,
                "{axiom} {rules:?}: {} {}",
                libm::exp(quotient),
                series.factor
            );
        }
    }
    assert!(recurrences == 400 && closed_forms > 200, "{recurrences} {closed_forms}");
}

/// The logarithms of the numbers of symbols at `n` and 20 steps before.
fn growth_at(system: &System, n: u32) -> [f64; 2] {
    let table = growth(system, n).unwrap().table;
    [n - 20, n].map(|n| table[n as usize].symbols.log10.unwrap())
}

#[test]
fn published_values_are_found() {
    // Lindenmayer's algae: Fibonacci numbers, the golden section.
    let algae = of("A", "A -> AB\nB -> A", 90.0);
    assert_eq!(symbols(&algae)[..9], counts("1 2 3 5 8 13 21 34 55"));
    assert_eq!(algae.symbols.recurrence.as_deref(), Some("s(n) = s(n-1) + s(n-2)"));
    assert_eq!(algae.symbols.exact_factor.as_deref(), Some("(1 + √5)/2"));
    assert!((algae.symbols.factor - 1.618_033_988_749_895).abs() < 1e-12);
    assert_eq!(
        algae.symbols.closed.as_deref(),
        Some("((5 + 3√5)/10) · ((1 + √5)/2)^n + ((5 - 3√5)/10) · ((1 - √5)/2)^n")
    );
    // The filament of Anabaena catenula (ABOP, figure 1.4): r and l cells in capitals and small letters.
    let filament = of("A", "A -> aB\na -> bA\nB -> A\nb -> a", 90.0);
    assert_eq!(symbols(&filament)[..6], counts("1 2 3 5 8 13"));
    assert_eq!(filament.symbols.recurrence.as_deref(), Some("s(n) = s(n-1) + s(n-2)"));
    assert_eq!(
        filament.table[4].letters.iter().map(|count| count.digits.as_str()).collect::<Vec<_>>(),
        ["5", "0", "0", "3"]
    );
    // Curves: the factor of segments, the stretch, the dimension.
    let log = libm::log;
    for (name, axiom, rules, angle, factor, stretch, dimension) in [
        ("Koch", "F", "F -> F+F--F+F", 60.0, 4.0, 3.0, log(4.0) / log(3.0)),
        ("dragon", "F", "F -> F+G\nG -> F-G", 90.0, 2.0, libm::sqrt(2.0), 2.0),
        ("Levy", "F", "F -> +F--F+", 45.0, 2.0, libm::sqrt(2.0), 2.0),
        ("terdragon", "F", "F -> F+F-F", 120.0, 3.0, libm::sqrt(3.0), 2.0),
        ("Hilbert", "L", "L -> +RF-LFL-FR+\nR -> -LF+RFR+FL-", 90.0, 4.0, 2.0, 2.0),
        ("Gosper", "F", "F -> F+G++G-F--FF-G+\nG -> -F+GG++G+F--F-G", 60.0, 7.0, libm::sqrt(7.0), 2.0),
        ("arrowhead", "G", "F -> G+F+G\nG -> F-G-F", 60.0, 3.0, 2.0, log(3.0) / log(2.0)),
        ("Minkowski", "F", "F -> F+F-F-FF+F+F-F", 90.0, 8.0, 4.0, 1.5),
        ("weed", "F", "F -> F[+F]F[-F]F", 25.7, 5.0, 3.0, log(5.0) / log(3.0)),
    ] {
        let found = of(axiom, rules, angle);
        assert!((found.segments.factor - factor).abs() < 1e-9, "{name}: {}", found.segments.factor);
        assert!((found.stretch.unwrap() - stretch).abs() < 1e-6, "{name}: {:?}", found.stretch);
        assert!((found.dimension.unwrap() - dimension).abs() < 1e-6, "{name}: {:?}", found.dimension);
    }
    // Lengths and turning: the curve has 4^n segments and ends as it begins.
    let koch = of("F", "F -> F+F--F+F", 60.0);
    assert_eq!((koch.table[3].length, koch.table[3].turning), (Some(64.0), Some(0.0)));
    let curl = of("F", "F -> F+F", 90.0);
    assert_eq!(curl.table[..4].iter().map(|row| row.turning.unwrap()).collect::<Vec<_>>(), [0.0, 90.0, 270.0, 270.0]);
    assert_eq!(of("F", "F -> F[+F]F", 30.0).table[2].turning, None);
    // The edge of the Gosper island (Gardner 1976): three sides for one, as far apart as √7.
    let edge = Definition {
        axiom: "F".into(),
        rules: "F -> RF+F-FL".into(),
        overrides: "R: turn right 19.106605350869094\nL: turn left 19.106605350869094".into(),
        angle: 60.0,
        ..Definition::default()
    };
    let edge = growth(&System::new(&edge).unwrap(), 8).unwrap();
    assert!((edge.dimension.unwrap() - log(3.0) / log(libm::sqrt(7.0))).abs() < 1e-6, "{edge:?}");
}

#[test]
fn the_kinds_of_growth_are_told() {
    let kind = |axiom: &str, rules: &str| {
        let series = of(axiom, rules, 90.0).symbols;
        (series.kind, series.degree, series.closed.unwrap_or_default())
    };
    assert_eq!(kind("A", "A -> AB"), (GrowthKind::Polynomial, 1, "n + 1".into()));
    assert_eq!(kind("A", "A -> AB\nB -> BC"), (GrowthKind::Polynomial, 2, "1/2 · n^2 + 1/2 · n + 1".into()));
    assert_eq!(kind("A", "A -> B\nB -> A"), (GrowthKind::Bounded, 0, "1".into()));
    assert_eq!(kind("A", "A -> B\nB ->"), (GrowthKind::Dying, 0, "0".into()));
    assert_eq!(kind("A", "A -> ABA\nB -> BBB"), (GrowthKind::Exponential, 0, "3^n".into()));
    assert_eq!(kind("A", "A -> AAB\nB -> BB"), (GrowthKind::Exponential, 1, "1/2 · n · 2^n + 2^n".into()));
    let roots = "((4 + 3√2)/4) · (√2)^n + ((4 - 3√2)/4) · (-√2)^n";
    assert_eq!(kind("AB", "A -> BB\nB -> A"), (GrowthKind::Exponential, 0, roots.into()));
    assert_eq!(kind("A", "A -> BC\nB -> C\nC -> AA"), (GrowthKind::Exponential, 0, String::new()));
    let thue_morse = of("A", "A -> AB\nB -> BA", 90.0);
    assert_eq!(thue_morse.symbols.closed.as_deref(), Some("2^n"));
    assert!(thue_morse.sentences[0].contains("multiplies the number of symbols by 2"), "{:?}", thue_morse.sentences);
}

/// The expected numbers and their spread agree with many simulated derivations.
#[test]
fn chance_is_as_simulated() {
    let definition = Definition {
        axiom: "F".into(),
        rules: "F -> F[+F]F[-F]F : 0.5\nF -> F[+F]F : 0.3\nF -> F : 0.2".into(),
        ..Definition::default()
    };
    let growth = growth(&System::new(&definition).unwrap(), 4).unwrap();
    let row = &growth.table[4];
    let samples: Vec<f64> = (0..3000)
        .map(|seed| {
            let system = System::new(&Definition { seed, ..definition.clone() }).unwrap();
            expand(&system, 4, &Limits::default()).unwrap().matches('F').count() as f64
        })
        .collect();
    let mean = samples.iter().sum::<f64>() / 3000.0;
    let deviation = libm::sqrt(samples.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / 2999.0);
    let expected: f64 = row.segments.digits.parse().unwrap();
    assert!((expected - libm::pow(3.6, 4.0)).abs() < 1e-3, "{expected}");
    assert!((mean - expected).abs() < 4.0 * deviation / libm::sqrt(3000.0), "{mean} {expected}");
    assert!((deviation - row.spread.unwrap()).abs() < 0.08 * deviation, "{deviation} {:?}", row.spread);
    assert!(growth.sentences.iter().any(|words| words.contains("on average")));
}

#[test]
fn what_has_no_matrix_says_why() {
    for (rules, why) in [("A < B -> A", "neighbours"), ("A(x) -> A(x+1)", "parameters")] {
        let axiom = if rules.contains('x') { "A(1)" } else { "AB" };
        assert!(growth(&system(axiom, rules, 90.0), 5).unwrap_err().contains(why), "{rules}");
    }
}

#[test]
fn large_systems_take_bounded_work() {
    let letters: Vec<char> = ('\u{4e00}'..'\u{4ec8}').collect();
    let rules: Vec<String> = (0..200)
        .map(|at| {
            format!("{} -> {}{}{}", letters[at], letters[(at * 7 + 1) % 200], letters[(at + 1) % 200], letters[at])
        })
        .collect();
    let large = growth(&system(&letters[0].to_string(), &rules.join("\n"), 90.0), 1000).unwrap();
    assert!((large.symbols.factor - 3.0).abs() < 1e-9, "{}", large.symbols.factor);
    assert_eq!((large.letters.len(), large.letter_count), (24, 200));
    let digits: usize = large.table.iter().flat_map(|row| &row.letters).map(|count| count.digits.len()).sum();
    assert!(digits < 500_000);
}

#[test]
fn exports_have_the_numbers() {
    let koch = of("F", "F -> F+F--F+F", 60.0);
    let csv = koch.csv();
    assert!(
        csv.starts_with(
            "n,symbols,segments,width,height,length,turning_degrees,\"F\",\"+\",\"-\"\n0,1,1,1,0,1,0,1,0,0\n1,8,4,3,"
        ),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), koch.table.len() + 1);
    let tex = koch.latex();
    assert!(tex.contains("\\begin{pmatrix} 4 & 2 & 2 \\\\ 0 & 1 & 0 \\\\ 0 & 0 & 1 \\end{pmatrix}"), "{tex}");
    assert!(tex.contains("s_n = 4^{n}") && tex.contains("\\approx 1.261860"), "{tex}");
    assert!(koch.words().contains("After n steps there are 4^n segments."), "{}", koch.words());
}
