//! Pages, ancestors and segments of derivations, compared with the naive reference.

use crate::naive;
use crate::naive::Module;
use crate::naive::systems::{Features, system};
use lsystem::derive::{Ancestor, GenerationReader, History};
use lsystem::drawing::symbol_of_polygon;
use lsystem::render::fitted_polygon;
use lsystem::{Definition, Figure, Limits, Plane, Progress, Solid, System, draw};
use proptest::prelude::*;
use std::sync::Arc;

/// The chain from the axiom to a module, from the words of the naive reference.
fn ancestry(words: &[Vec<Module>], mut index: usize) -> Vec<Ancestor> {
    let mut chain = vec![];
    for (generation, word) in words.iter().enumerate().rev() {
        let Module { symbol, arguments, production, position, parent, .. } = word[index].clone();
        let generation = generation as u32;
        chain.push(Ancestor { generation, symbol, arguments, index: index as u128, production, position });
        index = parent;
    }
    chain.reverse();
    chain
}

fn check<'a>(
    reader: impl Fn(u32) -> GenerationReader<'a>,
    words: &[Vec<Module>],
    drawn: &[usize],
    place: usize,
) -> Result<(), TestCaseError> {
    let n = words.len() - 1;
    let last = reader(n as u32);
    for (generation, word) in words.iter().enumerate() {
        let (own, length) = (reader(generation as u32), word.len());
        prop_assert_eq!(own.symbols(), Some(length as u128));
        let start = place % (length + 1);
        let page: Vec<_> = word.iter().skip(start).take(17).map(|m| (m.symbol, m.arguments.clone())).collect();
        let mut found = vec![];
        own.modules(start as u128, 17, &mut |symbol, arguments| found.push((symbol, arguments.to_vec())));
        prop_assert_eq!(found, page);
        prop_assert_eq!(own.ancestry(length as u128), vec![]);
        prop_assert_eq!(last.part(generation as u32, length as u128), None);
        if start == length {
            continue;
        }
        prop_assert_eq!(own.ancestry(start as u128), ancestry(&words[..=generation], start));
        // The descendants are consecutive modules in every later generation.
        let part = last.part(generation as u32, start as u128).unwrap();
        let mut heirs = vec![start];
        for later in &words[generation + 1..] {
            heirs = later.iter().filter(|module| heirs.contains(&module.parent)).map(|module| module.index).collect();
        }
        prop_assert_eq!(part.symbols.end - part.symbols.start, heirs.len() as u128);
        if let Some(&first) = heirs.first() {
            prop_assert_eq!(part.symbols.start, first as u128);
        }
        let before = |at: u128| drawn[..at as usize].iter().sum::<usize>() as u128;
        prop_assert_eq!(part.segments, before(part.symbols.start)..before(part.symbols.end));
    }
    let place = place % (words[n].len() + 1);
    prop_assert_eq!(last.segments_before(place as u128), Some(drawn[..place].iter().sum::<usize>() as u128));
    let owners: Vec<usize> = drawn.iter().enumerate().flat_map(|(at, &count)| vec![at; count]).collect();
    prop_assert_eq!(last.symbol_of_segment(owners.len() as u128), None);
    if let Some(segment) = place.checked_rem(owners.len()) {
        prop_assert_eq!(last.symbol_of_segment(segment as u128), Some(owners[segment] as u128));
    }
    Ok(())
}

fn remember(system: &System, n: u32, piece: usize) -> History {
    let mut history = system.history(n, &Limits::default()).unwrap();
    while history.step(piece) == Progress::More {}
    history
}

fn any_system() -> impl Strategy<Value = System> {
    any::<[bool; 5]>().prop_flat_map(|[contexts, parameters, weights, images, cuts]| {
        system(Features { contexts, parameters, weights, images, cuts })
    })
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn every_place_equals_that_of_the_plain_words(system in any_system(), n in 0_u32..7, piece in 1_usize..900, place: u16) {
        let word = |n: u32| naive::modules(&system.grammar, system.seed, n);
        let short = |word: &Vec<Module>| word.len() < 900;
        let words: Vec<_> = (0..=n).map_while(|n| word(n).filter(short)).collect();
        prop_assume!(!words.is_empty());
        let n = words.len() as u32 - 1;
        let drawn = naive::segments_of_each(&system, &words[n as usize]);
        let history = remember(&system, n, piece);
        prop_assert!(history.is_complete());
        check(|generation| GenerationReader::Remembered(&history, generation), &words, &drawn, place.into())?;
        if system.word(n).is_some() {
            check(|generation| GenerationReader::Counted(system.word(generation).unwrap()), &words, &drawn, place.into())?;
        }
        // The segments are numbered as in the drawing.
        if naive::images(&system.grammar, system.seed, &words[n as usize]).is_some() {
            let total = drawn.iter().sum::<usize>() as u128;
            prop_assert_eq!(draw::<Plane>(&system, n, &Limits::default()).unwrap().segment_count(), total);
        }
    }
}

/// A word with polygons, which may extend over several productions.
fn leafy(reaching: bool) -> impl Strategy<Value = String> {
    let mut parts = vec![
        "F",
        "F",
        "A",
        "B",
        "P(2)",
        "+",
        "-",
        "&",
        "[A]",
        "[+B]",
        "L",
        "{f+f+f}",
        "{.-f.+f.}",
        "{f+{f.-f.}f}",
        "{f}",
        "{}",
        "[{f&f-f}]",
        "{.[-f.][+f.]}",
        "●",
        "○",
        "@",
        "~",
        "~[+B]~",
    ];
    if reaching {
        parts.extend(["{.-f.+F[A]}", "{", "}", "{", "}", "]"]);
    }
    prop::collection::vec(prop::sample::select(parts), 1..6).prop_map(|parts| parts.concat())
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn polygons_come_from_the_symbols_that_open_them(
        words in any::<bool>().prop_flat_map(|reaching| prop::array::uniform4(leafy(reaching))),
        (n, chance, parametric, drawn, kept) in (0_u32..6, any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()),
    ) {
        let words = words.map(|word| if parametric { word } else { word.replace("P(2)", "B") });
        let [axiom, a, b, f] = words;
        let mut rules = if chance { format!("A -> {a} : 1\nA -> {b} : 2") } else { format!("A -> {a}\nB -> {b}") };
        // If `F` has no production, modules with parameters share blocks, too.
        rules += &if kept { String::new() } else { format!("\nF -> {f}F") };
        if parametric {
            rules += "\nP(x) : x > 0 -> {f+F(x)-F}P(x-1)";
        }
        if drawn {
            rules += "\ndraw:\nL -> {f-f-f}F";
        }
        // The naive turtle knows no custom symbols in systems with images.
        let overrides = if drawn { "" } else { "@: length times 0.8\n~: swap turns" }.into();
        let definition = Definition {
            axiom: format!("F{axiom}"), rules, angle: 25.7, right_angle: Some(31.0), overrides, ..Definition::default() };
        let system = System::new(&definition).unwrap_or_else(|problems| panic!("{definition:?}: {problems:?}"));
        prop_assume!((0..=n).all(|n| naive::modules(&system.grammar, 0, n).is_some_and(|word| word.len() < 900)));
        let expected = naive::solid_polygons(&system, n);
        // A polygon whose area is only a rounding error may be missing.
        let reach = expected.iter().flat_map(|p| p.0.iter().flatten()).fold(1.0_f64, |r, c| r.max(c.abs()));
        let steps = |outline: &[[f64; 3]]| {
            outline.windows(2).map(|p| (0..3).map(|i| (p[0][i] - p[1][i]).abs()).fold(0.0, f64::max)).fold(f64::INFINITY, f64::min)
        };
        prop_assume!(expected.iter().all(|polygon| steps(&polygon.0) > 1e-9 * reach));
        let solid = draw::<Solid>(&system, n, &Limits::default()).unwrap();
        let symbols = |count: u128, symbol: &dyn Fn(u128) -> Option<u128>| -> Vec<u128> {
            (0..count).map(|number| symbol(number).unwrap()).collect()
        };
        let plain = naive::solid_segments(&system, n);
        prop_assert_eq!(solid.segment_count(), plain.len() as u128);
        for (fast, plain) in solid.segments().zip(&plain) {
            let off = (0..3).map(|i| (fast.to[i] - plain.to[i]).abs()).fold(0.0, f64::max);
            prop_assert!(off < 1e-8 * reach, "{:?} {:?}", fast, plain);
        }
        let own: Vec<u128> = expected.iter().map(|polygon| polygon.4 as u128).collect();
        let found = symbols(solid.polygon_count(), &|number| symbol_of_polygon(&system, n, &solid, number));
        prop_assert_eq!(&found, &own);
        prop_assert_eq!(symbol_of_polygon(&system, n, &solid, own.len() as u128), None);
        if !system.is_solid() {
            let flat = draw::<Plane>(&system, n, &Limits::default()).unwrap();
            let found = symbols(flat.polygon_count(), &|number| symbol_of_polygon(&system, n, &flat, number));
            prop_assert_eq!(&found, &own);
            let rect = lsystem::fit(&flat);
            let (side, centre) = (rect.width.max(rect.height), [rect.x + rect.width / 2.0, rect.y + rect.height / 2.0]);
            let figure = Figure::Plane(Arc::new(flat));
            for (number, (outline, ..)) in expected.iter().enumerate() {
                let fitted = fitted_polygon(&figure, number as u128);
                prop_assert_eq!(fitted.len(), outline.len());
                for (a, b) in fitted.iter().zip(outline) {
                    let off = |i: usize| (centre[i] + side * (a[i] + a[i + 2]) - b[i]).abs();
                    prop_assert!(off(0).max(off(1)) < 1e-8 * reach.max(side), "{:?} {:?}", a, b);
                }
            }
        }
    }
}

#[test]
fn random_arguments_are_those_of_their_step() {
    // Without a choice of productions, counts give the place of reading.
    let system = read("A(0)A(1)", "A(x) -> B(x + random(0, 1))A(random(x, 9))\nB(x) -> B(x*2)A(x)");
    for n in 0..7 {
        let word = system.word(n).unwrap();
        let whole = lsystem::expand(&system, n, &Limits::default()).unwrap();
        assert_eq!(word.slice(0, usize::MAX), whole, "n = {n}");
    }
}

#[test]
fn polygons_of_a_generation_without_end() {
    // Each apex leaves a leaf of moves on either side. Leaves that are no polygons do not count.
    let system = read("X", "X -> F[+X{.f-f-f.}]{}{f}F[-X]{.+f+f+f.}X\nF -> FF");
    let n = 60;
    let drawing = draw::<Plane>(&system, n, &Limits::default()).unwrap();
    let word = system.word(n).unwrap();
    assert!(drawing.is_memoised());
    let count = drawing.polygon_count();
    // Beside a stem of more than 2^53 steps, the corners of a leaf have equal coordinates, but other exact places.
    assert_eq!(count, 3_u128.pow(n) - 1);
    let mut last = None;
    for k in 0..100 {
        let number = (count - 1) / 99 * k;
        let symbol = symbol_of_polygon(&system, n, &drawing, number).unwrap();
        assert!(Some(symbol) > last);
        last = Some(symbol);
        let text = word.slice(symbol, 9);
        assert!(text.starts_with("{.f-f-f.}") || text.starts_with("{.+f+f+f."), "{text}");
        assert_eq!(word.ancestry(symbol).last().unwrap().symbol, '{');
    }
    assert_eq!(symbol_of_polygon(&system, n, &drawing, count), None);
}

#[test]
fn polygons_of_a_long_word() {
    // The block of this long word contains blocks of its parts.
    let axiom = "A[{F+F+F}]F-".repeat(400);
    for rules in ["A -> FA{f-f-f}", "A -> FP(2){f-f-f}\nP(x) : x > 0 -> {.f.-f.-f.}P(x-1)F(x)"] {
        let system = read(&axiom, rules);
        let drawing = draw::<Plane>(&system, 3, &Limits::default()).unwrap();
        assert!(drawing.is_memoised());
        let opened = (0..drawing.polygon_count()).map(|number| symbol_of_polygon(&system, 3, &drawing, number));
        let expected = naive::solid_polygons(&system, 3);
        assert!(opened.eq(expected.iter().map(|polygon| Some(polygon.4 as u128))), "{rules}");
    }
}

#[test]
fn leaves_of_modules_with_parameters_are_shared() {
    // ABOP, figure 2.6a, with a leaf at the foot of every apex.
    let system = read(
        "A(1)",
        "A(l) -> F(l)[+B(l*0.6){.f(l).+f(l).+f(l).}]A(l*0.9)\nB(l) -> F(l)[-{.f(l).-f(l).-f(l).}][-B(l*0.9)]A(l*0.6)",
    );
    let n = 60;
    let drawing = draw::<Plane>(&system, n, &Limits::default()).unwrap();
    let word = system.word(n).unwrap();
    assert!(drawing.is_memoised() && drawing.polygon_count() > 1 << 40);
    let mut last = None;
    for k in 0..100 {
        let number = (drawing.polygon_count() - 1) / 99 * k;
        let symbol = symbol_of_polygon(&system, n, &drawing, number).unwrap();
        assert!(Some(symbol) > last);
        last = Some(symbol);
        assert!(word.slice(symbol, 5).starts_with("{.f("), "{}", word.slice(symbol, 5));
    }
}

fn read(axiom: &str, rules: &str) -> System {
    let definition = Definition { axiom: axiom.into(), rules: rules.into(), angle: 25.0, ..Definition::default() };
    System::new(&definition).unwrap()
}

#[test]
fn modules_with_parameters_in_a_generation_without_end() {
    // ABOP, figure 2.6a.
    let honda = read(
        "A(1,10)",
        "r1 = 0.9\nr2 = 0.6\nwr = 0.707\n\
         A(l,w) -> !(w)F(l)[&(45)B(l*r2,w*wr)]/(137.5)A(l*r1,w*wr)\n\
         B(l,w) -> !(w)F(l)[-(45)$C(l*r2,w*wr)]C(l*r1,w*wr)\n\
         C(l,w) -> !(w)F(l)[+(45)$B(l*r2,w*wr)]B(l*r1,w*wr)",
    );
    let word = honda.word(100).unwrap();
    assert!(word.symbols() > 1 << 100);
    assert_eq!(word.slice(0, 5), "!(10)F(1)[&(45)!(7.069999999999999)");
    let last = word.ancestry(word.symbols() - 1).pop().unwrap();
    assert_eq!((last.symbol, last.production, last.position), ('A', Some(0), 7));
    assert!((last.arguments[0] - libm::pow(0.9, 100.0)).abs() < 1e-15);
    assert_eq!(honda.word(10).unwrap().symbols(), 7_162);
}

#[test]
fn signals_are_traced_through_all_generations() {
    // ABOP, figure 1.31a (Hogeweg and Hesper).
    let signals = read(
        "F1F1F1",
        "ignore: +-F\n0 < 0 > 0 -> 0\n0 < 0 > 1 -> 1[+F1F1]\n0 < 1 > 0 -> 1\n0 < 1 > 1 -> 1\n\
         1 < 0 > 0 -> 0\n1 < 0 > 1 -> 1F1\n1 < 1 > 0 -> 0\n1 < 1 > 1 -> 0\n+ -> -\n- -> +",
    );
    let history = remember(&signals, 30, 1000);
    assert_eq!(history.symbols(30), Some(6_910));
    assert_eq!(history.slice(30, 0, 6_910), lsystem::expand(&signals, 30, &Limits::default()).unwrap());
    let chain = history.ancestry(30, 5_000);
    assert_eq!((chain.len(), chain[0].generation, chain[30].index), (31, 0, 5_000));
    for link in &chain {
        assert!(history.part(link.generation, link.index, 30).unwrap().symbols.contains(&5_000));
    }
    // The derivation ends before a generation that is too long. Earlier generations can be read.
    let limits = Limits { modules: 1_000, ..Limits::default() };
    let mut short = signals.history(30, &limits).unwrap();
    while short.step(100) == Progress::More {}
    assert!(!short.is_complete() && short.symbols(30).is_none());
    assert_eq!(short.symbols(10), history.symbols(10));
    assert_eq!(short.slice(10, 0, 99), history.slice(10, 0, 99));
}
