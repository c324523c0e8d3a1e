//! Texts of cpfg and L-Py are drawn as these programs draw them, or refused with a true reason.

use lsystem_base::Limits;
use lsystem_drawing::{Figure, System, expand};
use lsystem_import::{Entry, Fate, import};
use lsystem_syntax::Definition;

/// The only system of a text.
#[track_caller]
fn entry(text: &str) -> Entry {
    let mut imported = import(text).unwrap_or_else(|| panic!("not recognised: {text}"));
    assert!(matches!(imported.notation, "cpfg" | "L-Py"), "{}", imported.notation);
    assert_eq!(imported.entries.len(), 1);
    imported.entries.remove(0)
}

#[track_caller]
fn read(text: &str) -> Definition {
    let entry = entry(text);
    entry.definition.unwrap_or_else(|| panic!("{text}\n{:?}", entry.remarks))
}

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap()
}

/// The segments of a text after its iterations: the lengths along x, y and z, and the width.
#[track_caller]
fn segments(text: &str) -> Vec<([f64; 3], f64)> {
    let mut definition = read(text);
    definition.style.max_width = 0.0;
    let drawing = Figure::draw(&system(&definition), definition.iterations, &Limits::default()).unwrap();
    let segments = drawing.segments_from(0);
    segments.map(|s| (core::array::from_fn(|axis| s.to[axis] - s.from[axis]), s.width)).collect()
}

/// Whether the segments go along these vectors.
#[track_caller]
fn along(text: &str, expected: &[[f64; 3]]) {
    let found: Vec<[f64; 3]> = segments(text).into_iter().map(|(along, _)| along).collect();
    let near = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4);
    let equal = found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| near(a, b));
    assert!(equal, "{text}\n{found:?}\n{expected:?}");
}

/// The string after the iterations of the text.
#[track_caller]
fn word(text: &str) -> String {
    let definition = read(text);
    expand(&system(&definition), definition.iterations, &Limits::default()).unwrap()
}

/// Whether a text is refused with a reason that has these words.
#[track_caller]
fn refused(text: &str, words: &str) {
    let entry = entry(text);
    assert_eq!(entry.definition, None, "{text}");
    let reasons: Vec<&str> = entry.remarks.iter().filter(|r| r.refused).map(|r| r.message.as_str()).collect();
    assert!(reasons.iter().any(|reason| reason.contains(words)), "{text}\n{reasons:?}");
}

/// Whether a text is read with a remark that has these words.
#[track_caller]
fn noted(text: &str, words: &str) {
    let entry = entry(text);
    assert!(entry.definition.is_some(), "{:?}", entry.remarks);
    assert!(entry.remarks.iter().any(|remark| remark.message.contains(words)), "{:?}", entry.remarks);
}

fn cpfg(inside: &str) -> String {
    format!("lsystem: 1\n{inside}\nendlsystem\n")
}

const UP: [f64; 3] = [0.0, 1.0, 0.0];
const LEFT: [f64; 3] = [-1.0, 0.0, 0.0];

#[test]
fn statements_go_on_in_the_lines_below() {
    for text in [
        "derivation length: 1\naxiom: A(3)\nA(t) : t > 2 &&\n  t < 9 --> F(t)",
        "derivation length: 1\naxiom: A(3)\nA(t) : t > 2 &&\nt < 9 --> F(t)",
        "derivation length: 1\naxiom: A(3)\nA(t) : t > 2\n\t&& t < 9\n\t--> F(t)",
        "derivation length: 1\naxiom: A(3)\nB --> F\n  [+B]\n  A(t) : t > 2 &&\n    t < 9 --> F(t)",
        "derivation length: 1\naxiom: A(3)\nA(t) : t > 2 /* and\n below */ && t < 9 --> \\\n F(t)",
        "derivation length: 1\r\naxiom: A(3)\r\nA(t) : t > 2 &&\r\n\tt < 9 -->\r\n\tF(t)",
    ] {
        along(&cpfg(text), &[[0.0, 3.0, 0.0]]);
    }
    for axiom in ["F\n  [+F]\n  F", "F\n\t[+F]\n\tF", "F [\n+F]\n  F", "F[+F]F"] {
        along(&cpfg(&format!("derivation length: 0\naxiom: {axiom}\nA --> F")), &[UP, LEFT, UP]);
    }
    // A weight may stand in a line of its own.
    let weights = read(&cpfg("seed: 3\naxiom: A\nA --> F\n  [+A] : 2\nA --> F\n  : 1"));
    assert_eq!(weights.rules, "A --> F [+A] : 2\nA --> F : 1");
}

#[test]
fn macros_are_replaced_as_the_preprocessor_does() {
    let drawn = |macros: &str, axiom: &str| {
        segments(
            &cpfg(&format!("derivation length: 0\naxiom: {axiom}"))
                .replace("lsystem: 1", &format!("{macros}\nlsystem: 1")),
        )
        .len()
    };
    assert_eq!(drawn("#define A FF", "A+A"), 4);
    assert_eq!(drawn("#define B_1 F[+F]", "B_1 F B_1"), 5);
    assert_eq!(drawn("#define TWICE(x) x x", "TWICE(F+F)"), 4);
    assert_eq!(drawn("#define TWICE(x) x x\n#define G4 TWICE(TWICE(F))", "G4"), 4);
    // `FA` is one name, which is no macro.
    assert_eq!(drawn("#define A FF", "FA"), 1);
    // A macro inside itself is not replaced again.
    assert_eq!(drawn("#define A FA", "A A"), 2);
    assert_eq!(drawn("#define A F A", "A A"), 2);
    along("#define half(x) ((x)/2)\nlsystem: 1\nderivation length: 1\naxiom: A(2)\nA(s) --> F(half(s))\n", &[UP]);
    // Functions are no macros where symbols stand.
    assert_eq!(word(&cpfg("derivation length: 0\naxiom: log(2)")), "log(2)");
    // The preprocessor writes sums without parentheses.
    along("#define S 1+2\nlsystem: 1\nderivation length: 0\naxiom: F(S*2)\n", &[[0.0, 5.0, 0.0]]);
    along("#define S (1+2)\nlsystem: 1\nderivation length: 0\naxiom: F(S*2)\n", &[[0.0, 6.0, 0.0]]);
    refused("#define MAC ?(2,1)B(3)$\nlsystem: 1\nderivation length: 0\naxiom: F MAC\nendlsystem\n", "sub-L-system");
    refused("#if 1\nlsystem: 1\naxiom: F\n#endif\n", "#if");
    refused("#include \"a.h\"\nlsystem: 1\naxiom: F\n", "another file");
    refused(
        "#define A B B\n#define B C C\n#define C D D\n#define D E E\n#define E H H\n#define H I I\n#define I J J\n#define J K K\n#define K L L\n#define L M M\n#define M N N\n#define N O O\n#define O P P\n#define P Q Q\n#define Q R R\n#define R S S\n#define S T T\n#define T U U\n#define U V V\n#define V W W\n#define W F F\nlsystem: 1\naxiom: A\n",
        "too long",
    );
}

#[test]
fn code_that_computes_numbers_is_computed() {
    along(&cpfg("Start: {b = 2; a = b/2;}\nderivation length: 1\naxiom: A\nA --> F(a)F(b)"), &[UP, [0.0, 2.0, 0.0]]);
    along(
        &cpfg("Start:\n{\n b = 2;\n a = b/2;\n}\nderivation length: b\naxiom: F(a)\nF(x) --> F(2*x)"),
        &[[0.0, 4.0, 0.0]],
    );
    let array = "Define: {array len[3] = {1, 2, 4};}\nderivation length: 2\naxiom: A(0)\nA(n) --> F(len[n])A(n+1)";
    along(&cpfg(array), &[UP, [0.0, 2.0, 0.0]]);
    along(&cpfg("Define: {array len[2] = {1, 3};}\nderivation length: 0\naxiom: F(len[1])"), &[[0.0, 3.0, 0.0]]);
    along(
        &cpfg("derivation length: 1\naxiom: A(8)\nA(x) : {y = log(x)/log(2); printf(\"%f\", y);} y <> 2 --> F(y)"),
        &[[0.0, 3.0, 0.0]],
    );
    refused(&cpfg("Start: {b = 2;}\naxiom: A\nA : {b = b + 1;} b < 5 --> F(b)A"), "number of the whole system");
    refused(&cpfg("StartEach: {while (b < 2) {b = b + 1;}}\naxiom: A\nA : b > 2 --> F"), "every step");
    refused(&cpfg("StartEach: {b = ran(1);}\naxiom: A\nA : b > 2 --> F"), "without chance");
    refused(&cpfg("Start: {while (b < 2) {b = b + 1;}}\naxiom: A\nA --> F"), "only assignments");
    refused(&cpfg("axiom: A(1)\nA(x) : {if (x > 2) {x = 1;}} 1 --> F"), "only assignments");
    refused(&cpfg("axiom: A(1)\nA(x) : {y = ran(1);} 1 --> F(y)[+F(y)]"), "random number that is used several times");
    assert_eq!(read(&cpfg("axiom: A(1)\nA(x) : {y = ran(1);} 1 --> F(y)")).rules, "A(x) --> F((ran(1)))");
    refused(&cpfg("axiom: A(1)\nA(x) --> F(func(1, x))"), "curve of another file");
    refused(&cpfg("axiom: A(1)\nA(x) --> F(bran(1, x))"), "`bran`");
    refused(&cpfg("axiom: A(1)\nA(x) --> F(-x^2)"), "parentheses");
    noted(&cpfg("End: {fclose(f);}\naxiom: F\nF --> FF"), "behind the last step");
}

#[test]
fn a_homomorphism_applies_to_its_own_results_up_to_its_depth() {
    let text =
        |depth: &str, rest: &str| cpfg(&format!("derivation length: 0\naxiom: A\nhomomorphism\n{depth}\n{rest}"));
    assert_eq!(segments(&text("maximum depth: 2", "A --> B+B\nB --> FF")).len(), 4);
    assert_eq!(segments(&text("maximum depth: 3", "A --> B+B\nB --> CC\nC --> F[+F]")).len(), 8);
    // The depth is 1 where none is given, and `C` draws nothing.
    assert_eq!(segments(&text("", "A --> B+F\nB --> FF")).len(), 1);
    assert_eq!(segments(&text("", "A --> F\nF --> F[+F]")).len(), 1);
    // A production that goes on for ever ends at the depth.
    assert_eq!(segments(&text("maximum depth: 4", "A --> FA")).len(), 4);
    // Conditions of numbers that are known only in the axiom.
    let recursive = "#define D 2\nlsystem: 1\nderivation length: 1\naxiom: A(4)\nhomomorphism\nmaximum depth: 100\nA(t) : t >= D --> F(1)A(t-1)\nA(t) : t < D --> [+F(t)]\nendlsystem\n";
    assert_eq!(segments(recursive).len(), 4);
    // What only the homomorphism makes is written into its results, however deep it is.
    let inner = "derivation length: 1\naxiom: A(0)\nA(t) --> A(t+2)\nhomomorphism\nmaximum depth: 99\n\
         A(t) --> B(t,90)\nB(t,n) : n > 0 --> F(t)B(t,n-1)";
    along(&cpfg(inner), &[[0.0, 2.0, 0.0]; 90]);
    // Conditions of parameters become cases: 7, 6, 5, 4 and 3 are long enough.
    let cases = "derivation length: 3\naxiom: A(4)\nA(t) --> A(t+1)\nhomomorphism\nmaximum depth: 9\nA(t) : t > 2 --> F(t)A(t-1)";
    let lengths: Vec<[f64; 3]> = (3..8).rev().map(|t| [0.0, f64::from(t), 0.0]).collect();
    along(&cpfg(cases), &lengths);
}

#[test]
fn symbols_of_cpfg() {
    along(&cpfg("derivation length: 0\naxiom: F//////F&F"), &[UP, UP, [0.0, 0.0, 1.0]]);
    along(&cpfg("derivation length: 1\naxiom: A\nA --> F[+~l(2)F]~k // a leaf at the tip\n"), &[UP, LEFT]);
    noted(&cpfg("axiom: F~l(1)\nF --> FF"), "The surface `~l` is not drawn");
    // A surface may be replaced as a symbol is.
    assert_eq!(word(&cpfg("derivation length: 2\naxiom: F~l(1)\n~l(s) : s < 2 --> ~l(s+1)F")), "Fa(2)F");
    along(&cpfg("derivation length: 0\naxiom: @M(3,4,0)@R(1,0,0)F+F"), &[[1.0, 0.0, 0.0], UP]);
    noted(&cpfg("axiom: @M(3,4,1)F\nF --> FF"), "where the turtle starts");
    refused(&cpfg("axiom: F@M(3,4,0)F\nF --> FF"), "place of its own");
    refused(&cpfg("axiom: F@R(1,0,0)F\nF --> FF"), "heading in space");
    assert_eq!(read(&cpfg("axiom: @Gsf@Gc(3)+f@Ge\nA --> FF")).axiom, "afb(3)+fd");
    noted(&cpfg("axiom: @Gsf@Gc(3)+f@Ge\nF --> FF"), "number of strips");
    assert_eq!(segments(&cpfg("derivation length: 0\naxiom: @Gsf@Gc+f@Ge")).len(), 16);
    let read_start = |start: &str| read(&cpfg(&format!("derivation length: 1\naxiom: @M({start})F"))).start;
    assert_eq!([read_start("1,2,0"), read_start("-3,0.5"), read_start("1,2,3")], [[1.0, 2.0], [-3.0, 0.5], [0.0; 2]]);
    let deep = "derivation length: 1\naxiom: @M(1,2,3)?P(0,0,0)A\n?P(x,y,z) < A --> F(x)";
    refused(&cpfg(deep), "in the plane z = 0");
    let asking = "derivation length: 2\naxiom: FF?P(0,0,0)?H(0,0,0)A\n?P(x,y,z) < ?H(a,b,c) : y > 1 --> [-F]?H(a,b,c)";
    assert_eq!(word(&cpfg(asking)), "FF?P(0,2,0)[-F][-F]?H(0,1,0)A");
    refused(&cpfg("derivation length: 1\naxiom: AB\nAB --> F"), "Several symbols as predecessor");
    refused(&cpfg("derivation length: 1\naxiom: A(1)B\nA(x)B --> F"), "Several symbols as predecessor");
    refused(&cpfg("ring Lsystem\naxiom: AB\nA --> F"), "Rings");
    noted(&cpfg("axiom: F!F\nF --> FF"), "view file; here it is a factor");
    noted(&cpfg("axiom: F$F\nF --> FF"), "rolls upright");
    noted(
        "lsystem: 1\nderivation length: 1\naxiom: F\nF --> FF\nendlsystem\nlsystem: 2\nderivation length: 1\naxiom: A\nA --> FA\nendlsystem\n",
        "second L-system is a sub-L-system",
    );
    refused(&cpfg("axiom: F(1(2\nF --> FF"), "not closed");
    refused(&cpfg("axiom: F\nF -> FF"), "no arrow `-->`");
}

#[test]
fn chance_is_that_of_cpfg() {
    let rules = |inside: &str| read(&cpfg(&format!("derivation length: 1\naxiom: A\n{inside}"))).rules;
    // A seed makes a system stochastic, and a missing probability is 1.
    assert_eq!(rules("seed: 3\nA --> F : 2\nA --> f"), "A --> F : 2\nA --> f : 1");
    assert_eq!(rules("seed: 3\nA --> F\nA --> f\nB --> A"), "A --> F : 1\nA --> f : 1\nB --> A");
    assert_eq!(rules("A --> F\nA --> f"), "A --> F\nA --> f");
    // A homomorphism takes the first production that applies.
    assert_eq!(rules("homomorphism\nA --> F : 1\nA --> f : 1"), "draw:\nA --> F\nA --> f");
    noted(&cpfg("axiom: A\nA --> AA\nhomomorphism\nA --> F : 1"), "whatever its probability");
}

#[test]
fn rules_that_look_like_comments_are_rules() {
    let width = "derivation length: 1\naxiom: #(1)F\n#(w) --> #(w*3)";
    assert_eq!(segments(&cpfg(width))[0].1, 3.0);
    along(&cpfg("derivation length: 0\naxiom: //F&(90)F"), &[UP, [0.0, 0.0, 1.0]]);
    along(&lpy("//(60)F", "A --> F"), &[UP]);
    assert_eq!(word(&cpfg("derivation length: 1\naxiom: //AF\n/ < A --> B")), "//BF");
}

/// The word of `A(t) --> A(t+1)` with the decomposition `A(t) : t > 2 --> F(t)[+A(t-2)]A(t-3)` up to a depth, module by
/// module.
fn decomposed_naively(steps: usize, depth: usize) -> String {
    fn decompose(t: f64, depth: usize, out: &mut Vec<Result<f64, String>>) {
        if depth == 0 || t <= 2.0 {
            return out.push(Ok(t));
        }
        out.push(Err(format!("F({t})[+")));
        decompose(t - 2.0, depth - 1, out);
        out.push(Err("]".to_owned()));
        decompose(t - 3.0, depth - 1, out);
    }
    let mut word = Vec::new();
    decompose(4.0, depth, &mut word);
    for _ in 0..steps {
        let mut next = Vec::new();
        for module in word {
            match module {
                Ok(t) => decompose(t + 1.0, depth, &mut next),
                text => next.push(text),
            }
        }
        word = next;
    }
    word.into_iter().map(|module| module.map_or_else(|text| text, |t| format!("A({t})"))).collect()
}

#[test]
fn parameters_decide_decompositions() {
    for depth in 1..4 {
        for steps in 0..6 {
            let text = format!(
                "derivation length: {steps}\naxiom: A(4)\nA(t) --> A(t+1)\ndecomposition\nmaximum depth: {depth}\n\
                 A(t) : t > 2 --> F(t)[+A(t-2)]A(t-3)"
            );
            assert_eq!(word(&cpfg(&text)), decomposed_naively(steps, depth), "{depth} {steps}");
        }
    }
    // What the depth ends goes on in the next step, if no production applies.
    let goes_on = |steps: usize| {
        let rules = "decomposition\nmaximum depth: 2\nM(n) : n > 0 --> F M(n-1)";
        cpfg(&format!("derivation length: {steps}\naxiom: M(5)\nM(n) : n > 9 --> f\n{rules}"))
    };
    assert_eq!(
        ["FFM(3)", "FFFFM(1)", "FFFFFM(0)"],
        [0, 1, 2].map(|steps| word(&goes_on(steps))).each_ref().map(|w| &**w)
    );
    noted(&goes_on(1), "go on in the next step");
    // The same for the results of a homomorphism.
    let image = "derivation length: 2\naxiom: A(0)\nA(t) --> A(t+1)[A(t)]\nhomomorphism\nmaximum depth: 2\n\
         A(t) --> B(t+1)\nB(t) : t > 2 --> F(t)\nB(t) : t > 1 --> f";
    along(&cpfg(image), &[[0.0, 3.0, 0.0]]);
    refused(&cpfg("axiom: A(1)\nA(t) --> A(t+1)\ndecomposition\nA(t) : t > ran(3) --> F"), "depends on chance");
    let many: String = (0..8).map(|at| format!("B(t+{at})")).collect();
    let many = format!("axiom: A(1)\nA(t) --> {many}\ndecomposition\nB(t) : t > 3 --> F");
    refused(&cpfg(&many), "too many cases");
}

#[test]
fn numbers_that_change_at_every_step_are_parameters() {
    let counted = |steps: usize, rules: &str| {
        cpfg(&format!(
            "Start: {{n = 0;}}\nStartEach: {{n = n + 1; h = n/2; printf(\"%f\", n);}}\nderivation length: {steps}\n{rules}"
        ))
    };
    // The number is 1 in the first step.
    let grows = |steps: usize| {
        let lengths = (1..=steps).filter(|step| *step > 2).map(|step| [0.0, step as f64 / 2.0, 0.0]);
        along(&counted(steps, "axiom: A\nA : n > 2 --> F(h)A"), &lengths.collect::<Vec<_>>());
    };
    (0..6).for_each(grows);
    // Symbols with an action are drawn as before, with and without an own image.
    for (steps, count) in [(1, 2), (2, 4), (3, 4)] {
        let rules = "axiom: F+F\nF : n == 2 --> FF";
        assert_eq!(segments(&counted(steps, rules)).len(), count);
        assert_eq!(segments(&counted(steps, &format!("{rules}\nhomomorphism\nF --> FF"))).len(), 2 * count);
    }
    // Contexts see the modules as before, whose own parameters hide numbers of the same name.
    let rules = "ignore: +\naxiom: B+A(7)A(5)\nB < A(n) --> C(n)\nA(x) : n > 1 --> D(x)";
    assert_eq!(word(&counted(1, rules)).split('A').next(), Some("B+C(7)"));
    assert_eq!(word(&counted(2, rules)), "B+C(7)D(5)");
    // With a seed, one of the productions that apply is chosen; none means that the module stays.
    along(&counted(4, "seed: 3\naxiom: A\nA : n > 3 --> F(n)\nA : n > 9 --> f"), &[[0.0, 4.0, 0.0]]);
    // The homomorphism sees the numbers behind the last step.
    let image = "Start: {t = 1;}\nEndEach: {t = t + 0.5;}\nderivation length: 3\naxiom: A\nhomomorphism\nA --> F(t)";
    along(&cpfg(image), &[[0.0, 2.5, 0.0]]);
    let both = "Start: {t = 1;}\nEndEach: {t = 2*t;}\nderivation length: 2\naxiom: A\nA --> F(t)A";
    along(&cpfg(both), &[UP, [0.0, 2.0, 0.0]]);
    refused(&counted(2, "axiom: A\nA --> B\ndecomposition\nB : n > 1 --> F"), "in decompositions");
}

#[test]
fn small_words_of_cpfg() {
    // `=` is the rest of a branch.
    let rest = "derivation length: 1\naxiom: A[BX]A[XB]A[X][-BX]\nA > [B=] --> C\nA > [=][-B=] --> D";
    assert_eq!(word(&cpfg(rest)), "C[BX]A[XB]D[X][-BX]");
    refused(&cpfg("axiom: A\nA > B=C --> F"), "only in front of `]`");
    along(&cpfg("derivation length: 1\naxiom: A (2)\nA (x) --> F (x)"), &[[0.0, 2.0, 0.0]]);
    // The choice binds loosest, and to the right.
    for (choice, length) in [("2 > 1 ? 3 : 4", 3.0), ("(2 < 1 ? 3 : (4))+1", 5.0), ("0 ? 1 : 1 ? 2 : 3", 2.0)] {
        along(&cpfg(&format!("derivation length: 0\naxiom: F({choice})")), &[[0.0, length, 0.0]]);
    }
    refused(&cpfg("axiom: F(ran(1) < 0.5 ? 1 : 2)"), "by chance");
    refused(&cpfg("axiom: F(1 ? 2)"), "has no `:`");
    // A rule of the letter of a surface replaces the surface.
    let surface = "derivation length: 2\naxiom: ~b(1)b(1)\nb(s) --> b(s*3)";
    assert_eq!(word(&cpfg(surface)), "a(9)b(9)");
    // A group whose symbols nothing makes.
    noted(&cpfg("axiom: F(1)\nXF(x) --> FF"), "never applies");
    refused(&cpfg("axiom: XF(1)\nXF(x) --> FF"), "Several symbols");
    noted(&cpfg("axiom: @Gt(1.5,1)@Gr(1)@Gs@!(5)f@Ge"), "swing out");
    refused(&cpfg("axiom: @Gr(0,1,0,1)@Gs f@Ge"), "How the width");
    assert_eq!(read(&cpfg("derivation length: 0\n#define SIZE 3\naxiom: F(SIZE+SIZE)")).axiom, "F(SIZE+SIZE)");
}

#[test]
fn other_notations_are_left_to_their_readers() {
    for text in [
        "Axiom: F\nProduction: F -> FF\nAngle: 60\n",
        "Axiom: F\nderivation length: 3\nF -> FF\n",
        "Axiom: F\nderivation length: 3\nF = FF\n",
    ] {
        let notation = import(text).map(|imported| imported.notation);
        assert!(!matches!(notation, Some("cpfg" | "L-Py")), "{text}");
    }
    refused(&cpfg("axiom: F\nhomomorphism: F --> G\nF --> FF"), "Nothing can stand behind `homomorphism`");
}

fn lpy(axiom: &str, rules: &str) -> String {
    format!("Axiom: {axiom}\nderivation length: 1\nproduction:\n{rules}\nendlsystem\n")
}

#[test]
fn symbols_of_lpy() {
    // Two rolls; `/` rolls to the left there.
    let h = 0.5_f64.sqrt();
    along(&lpy("A", "A --> F//(30)[&(90)F]F"), &[UP, [-1.0, 0.0, 0.0], UP]);
    along(&lpy("A", "A --> F/(45)&(90)F"), &[UP, [-h, 0.0, -h]]);
    along(&lpy("A", "A --> F\\(45)&(90)F"), &[UP, [h, 0.0, -h]]);
    along(&lpy("F RollL(90) Down(90) F", "A --> F"), &[UP, LEFT]);
    along(&lpy("F Left(90) F Right(90) F TurnAround F", "A --> F"), &[UP, LEFT, UP, [0.0, -1.0, 0.0]]);
    along(&lpy("SB Left(90) F EB F", "A --> F"), &[LEFT, UP]);
    assert_eq!(segments(&lpy("Frame(2) F(1)", "A --> F")).len(), 1);
    noted(&lpy("Frame(2) F(1)", "A --> F"), "not drawn");
    assert_eq!(segments(&lpy("F G g F", "A --> F")).len(), 2);
    assert_eq!(read(&lpy("@O(1)", "A --> F")).axiom, "●(2)");
    assert_eq!(read(&lpy("Sphere(min(1, 2))", "A --> F")).axiom, "●(2*(min(1, 2)))");
    assert_eq!(segments(&lpy("F_(2)F", "A --> F"))[1].1, 2.0);
    assert_eq!(segments(&lpy("FSetWidth(3)F!(0.5)F", "A --> F"))[1].1, 3.0);
    // What is not drawn may have any arguments, unless a rule replaces it.
    along(&lpy("F @L('a text') @g(scene[0]) F", "A --> F"), &[UP, UP]);
    refused(&lpy("F ~l(name.x)", "~l(x) --> F"), "The arguments of `~l`");
    refused(&lpy("F MoveTo(1,2,3) F", "A --> F"), "place of its own");
    refused(&lpy("F Sweep(c,s,1,1) F", "A --> F"), "Sweeps");
    assert_eq!(word(&lpy("FF?P(0,0,0)GetHead(0,0,0)", "A --> F")), "FF?P(0,2,0)?H(0,1,0)");
    // L-Py's turtle starts along z, with its left side towards -y.
    let asks =
        |query: &str| lpy(&format!("Left(90)F(2){query}(0,0,0)A"), &format!("{query}(a,b,c) < A --> F(a)f(b)F(c)"));
    assert_eq!(word(&asks("?P")).split('A').next(), Some("+(90)F(2)?P(-2,0,0)F(0)f(-2)F(0)"));
    assert_eq!(word(&asks("?U")).rsplit('?').next(), Some("U(0,0,1)F(1)f(0)F(0)"));
    refused(&lpy("?P(0,0)A", "?P(x,y) < A --> F"), "three numbers");
    // Names that the text declares are single modules, and other letters are single.
    assert_eq!(word(&format!("module Apex, Leaf\n{}", lpy("Apex Leaf", "Apex --> F Apex"))), "Fbc");
    assert_eq!(word(&lpy("AB", "A --> F\nB --> f")), "Ff");
    along("derivation length: 0\nAxiom: F(1)-(120)F(1)\n", &[UP, [0.75_f64.sqrt(), -0.5, 0.0]]);
    along("# a triangle\nx = 2\nAxiom: F(x)\nderivation length: 0\n", &[[0.0, 2.0, 0.0]]);
}

#[test]
fn rules_of_python_are_conditions_and_successors() {
    let rules = |text: &str| read(&lpy("A(1)", text)).rules;
    assert_eq!(rules("A(x):\n  produce F(x)A(x+1)"), "A(x) --> F(x)A(x+1)");
    assert_eq!(rules("A(x): produce F(x)"), "A(x) --> F(x)");
    assert_eq!(
        rules(
            "A(x):\n  # older\n  if x < 3: produce F(x)\n  elif x == 3:\n    y = x/2\n    produce F(y)\n  else:\n    produce *\n"
        ),
        "A(x) : x < 3 --> F(x)\nA(x) : x == 3 --> F((x/2))\nA(x) -->"
    );
    // A branch that makes nothing leaves the module, and `else` does not apply then.
    assert_eq!(
        rules("A(x):\n  if x < 3:\n    if x > 1: produce F\n  else: produce f"),
        "A(x) : (x < 3) and (x > 1) --> F\nA(x) : not (x < 3) --> f"
    );
    assert_eq!(
        rules("A(x):\n  y = 2\n  if x < 3: y = 1\n  produce F(y)"),
        "A(x) : x < 3 --> F((1))\nA(x) : not (x < 3) --> F((2))"
    );
    assert_eq!(
        rules("A(x):\n  for i in range(2):\n    nproduce [/(i*90)F(x)]\n  produce A(x)"),
        "A(x) --> [/((0)*90)F(x)][/((1)*90)F(x)]A(x)"
    );
    assert_eq!(
        rules("A(x):\n  if x ** 2 > 4 and not x == 5: produce F(int(x))"),
        "A(x) : x ^ 2 > 4 and not x == 5 --> F((floor(abs(x))*(((x) > 0) - ((x) < 0))))"
    );
    // A number of chance that decides once.
    assert_eq!(
        rules("A(x):\n  y = random()\n  if y < 0.5: produce F\n  else: produce f"),
        "A(x) : (random(0, 1)) < 0.5 --> F\nA(x) --> f"
    );
    // Angles of Python's functions are radians.
    along(
        "from math import *\nAxiom: F(sin(radians(30)))\nderivation length: 0\nproduction:\nendlsystem\n",
        &[[0.0, 0.5, 0.0]],
    );
    along("import math\na = math.cos(math.pi)\nAxiom: F(-a)\nderivation length: 0\nproduction:\nendlsystem\n", &[UP]);
    // A function within another is turned into degrees once.
    along(
        "from math import *\nAxiom: F(degrees(asin(0.5)))\nderivation length: 0\nproduction:\nendlsystem\n",
        &[[0.0, 30.0, 0.0]],
    );
    for (rule, why) in [
        ("A(x):\n  while x < 3: x += 1\n  produce F(x)", "Python code is not run"),
        ("A(x):\n  produce F(size(x))", "Python code is not run: `size(...)`"),
        ("A(x):\n  global y\n  produce F(x)", "Python code is not run"),
        ("A(x):\n  for i in things:\n    nproduce F\n  produce A(x)", "Python code is not run: a loop over `things`"),
        ("A(x) --> F(1 if x > 2 else 3)", "`if` in arithmetic"),
        ("A(x) --> F(x // 2)", "whole division"),
        ("A(x) << B : produce F", "in the new string"),
        (
            "A(x):\n  y = random()\n  if y < 0.5:\n    if x > 2: produce F\n    else: produce f\n  else: produce B",
            "random number that is used several times",
        ),
        ("A(x):\n  if random() < 0.5: x = 3\n  produce F(x)", "random number that is used several times"),
        ("A(x):\n  y = random()\n  produce F(y)[+F(y)]", "random number that is used several times"),
    ] {
        refused(&lpy("A(1)", rule), why);
    }
    refused(&format!("size = lambda x: 2*x\n{}", lpy("A(1)", "A(x) --> F(size(x))")), "`size(...)`");
    refused(&format!("size = open('f').read()\n{}", lpy("A(1)", "A(x) --> F(size)")), "Python code");
    refused(&format!("def StartEach():\n  global a\n  a = 2\n{}", lpy("A(1)", "A(x) --> F(x)")), "StartEach");
    refused(&format!("while True: pass\n{}", lpy("A(1)", "A(x) --> F(x)")), "Python code is not run");
    noted(&format!("import os\n{}", lpy("A(1)", "A(x) --> F(x)")), "Python code is not run");
    along(&format!("extern(a = 3)\n{}", lpy("A(1)", "A(x) --> F(a)")), &[[0.0, 3.0, 0.0]]);
    along(&format!("setAngleIncrement(90)\n{}", lpy("F+F", "A --> F")), &[UP, LEFT]);
}

#[test]
fn every_part_of_a_system_has_its_fate() {
    let texts = [
        "/* a tree */\n#define N 3 /* steps */\nlsystem: 1\nseed: 4\nderivation length: N\nignore: +-\naxiom: A(1)\nA(x) : x < 3 --> F~l(x)\n\t[+A(x)]\nhomomorphism\nF --> !F\nendlsystem\n",
        "import os\nx = 2 # two\nAxiom: A(x)\nderivation length: 3\nproduction:\nA(x):\n  if x < 3: produce F A(x+1)\nB --> F\ninterpretation:\nA(x) --> f\nendlsystem\n",
    ];
    for text in texts {
        let imported = import(text).unwrap();
        let end = imported.account.last().map_or(0, |part| part.span.end);
        assert_eq!(end, text.len());
        for part in &imported.account {
            let own = text[part.span.clone()].trim();
            let comment = own.starts_with("/*") || own.starts_with('#');
            assert!(part.fate != Fate::Passed || own.is_empty() || comment, "{own}");
            assert_ne!(part.words, "This is not understood", "{own}");
        }
    }
}

/// A text of several files: a system, its view file, and a surface that lies in the plane of x and y, with its heading
/// along y, and is 20 long and 10 wide.
fn with_surface(body: &str) -> String {
    let row =
        |y: f64| -> String { (0..4).map(|at| format!("{} {y} 5  ", 10.0 + f64::from(at) * 10.0 / 3.0)).collect() };
    let rows: Vec<String> = (0..4).map(|at| row(f64::from(at) * 20.0 / 3.0)).collect();
    format!(
        "==> plant.l <==\n{}==> plant.v <==\nangle factor: 12\nsurface: l leaf.s 2 3 3\nline width: 3\n==> leaf.s <==\n\
         10 20   0 20   5 5\nCONTACT POINT  X: 15.00 Y: 0.00 Z: 5.00\nEND POINT  X: 1 Y: 2 Z: 3\n\
         HEADING  X: 0.00 Y: 3.00 Z: 0.00\nUP  X: 0.00 Y: 0.10 Z: 1.00\nSIZE: 10\nthe_patch\n\
         TOP COLOR: 32 DIFFUSE: 0.00 BOTTOM COLOR: 32 DIFFUSE: 0.00\nAL: ~ A: ~ AR: ~ \nL: ~ R: ~ \nBL: ~ B: ~ BR: ~ \n{}\n",
        cpfg(body),
        rows.join("\n")
    )
}

#[test]
fn surfaces_of_other_files() {
    let text = with_surface("derivation length: 1\naxiom: F+~l(0.5)A\nA --> [~l(2)~k]F");
    let definition = read(&text);
    assert_eq!(definition.angle, 30.0);
    let surfaces = lsystem_syntax::parse_surfaces(&definition.surfaces).unwrap();
    // Times 2, divided by the size of 10: 4 long, 1 to either side of the turtle.
    let patch = surfaces[0].patches[0];
    assert_eq!([patch[0], patch[3], patch[12]], [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [4.0, 1.0, 0.0]]);
    let system = System::new(&definition);
    let figure = Figure::draw(&system.unwrap(), 1, &Limits::default()).unwrap();
    assert_eq!(figure.polygon_count(), 2 * 72);
    noted(&text, "The surface `~k` is not drawn");
    noted(&text.replace("==> leaf.s", "==> other.s"), "The file `leaf.s` is missing");
    noted(&text.replace("SIZE: 10", "SIZE: 0"), "no surface that can be read");
    // Many surfaces, and many patches of one, are refused by name and in a bounded time.
    noted(&text.replace("surface: l", &"surface: m none.s\nsurface: l".repeat(40)), "At most 32 surfaces");
    // What is written reads back.
    let notation = lsystem_import::write::Notation::named("cpfg").unwrap();
    let written = lsystem_import::write::export(&definition, notation).unwrap().text;
    let again = read(&written);
    assert_eq!(again.surfaces, definition.surfaces, "{written}");
    let again = System::new(&again);
    let again = Figure::draw(&again.unwrap(), 1, &Limits::default()).unwrap();
    assert_eq!((again.polygon_count(), again.bounds()), (figure.polygon_count(), figure.bounds()), "{written}");
}

#[test]
fn function_files_are_curves() {
    let system =
        |which: &str| cpfg(&format!("derivation length: 1\naxiom: A(0)A(0.5)A(2)\nA(x) --> F(1+10*func({which}, x))"));
    // Bernstein polynomials: at 0.5 the value is (3*1 + 3*2)/8, at the ends 0.
    let lengths = [1.0, 12.25, 1.0];
    let third = 1.0 / 3.0;
    let old = format!("range: 0.0 1.0\npoints: 4\n0 0\n{third} 1\n{} 2\n1 0\n", 2.0 * third);
    let new = |times: usize| {
        let points = format!("0.0 0.0 1\n{third} 1 {times}\n{} 2 1\n1 0 1\n", 2.0 * third);
        format!("fver 1 1\nname: hill\nsamples: 100\nflip: off\npoints: 4\n{points}")
    };
    let view = "\n==> a/plant.v <==\nangle factor: 8\nfunction: other.func 100\nfunction: hill.func 100\n";
    for file in [&old, &new(1)] {
        let others = "==> other.func <==\nrange: 0 1\npoints: 0\n";
        let all = format!("{}{view}==> hill.func <==\n{file}{others}", system("2"));
        let found: Vec<f64> = segments(&all).iter().map(|(along, _)| along[1]).collect();
        assert!(found.iter().zip(lengths).all(|(a, b)| (a - b).abs() < 1e-6) && found.len() == 3, "{found:?}");
        noted(&all, "`other.func` is no function");
        refused(&all.replace("func(2", "func(1"), "not given or cannot be read");
        refused(&all.replace("func(2", "func(3"), "not given or cannot be read");
    }
    let set = format!(
        "{}==> functions.fset <==\nfuncgalleryver 1 1\nitems: 2\n{}{}",
        system("hill"),
        new(2),
        new(1).replace("hill", "other")
    );
    let rules = read(&set).rules;
    let twice = format!("({third}, 1) ({third}, 1)");
    assert!(rules.starts_with(&format!("curve hill = (0, 0) {twice} (0.666")) && !rules.contains("other"), "{rules}");
    noted(&format!("{}{view}", system("1").replace("func(1, x)", "x")), "is missing");
    // In an axiom, and in a homomorphism that is written into it.
    let recursive = "derivation length: 0\naxiom: F(1+func(1, 0.5))A(3)\nhomomorphism\nmaximum depth: 9\n\
         A(n) : n > 1 --> F(func(1, n/4))A(n-1)";
    let lengths = [2.125, 0.984375, 1.125].map(|length| [0.0, length, 0.0]);
    along(
        &format!("{}\n==> a/plant.v <==\nfunction: hill.func 100\n==> hill.func <==\n{old}", cpfg(recursive)),
        &lengths,
    );
    // The curve has a name that is free in our notation.
    let named = format!("{}{view}==> hill.func <==\n{old}", system("2"));
    let rules = read(&named.replace("A(x)", "A(hill)").replace(" x)", " hill)")).rules;
    assert!(rules.contains("10*hill_( hill)"), "{rules}");
}

#[test]
fn curves_are_written_as_function_files() {
    let rules = "curve line = (-1, 2) (3, 4)\ncurve arch = (0, 1) (0.5, 3) (1, 1)\n\
        curve wave = (0, 1) (2, 3) (2, 1) (4, 5) (8, 1)\n\
        A(x) : x < 8 -> F(line(x - 1) + arch(x/8))[+F(wave(x))]A(x + 0.5)";
    let definition = Definition { axiom: "A(0)".into(), rules: rules.into(), iterations: 20, ..Definition::default() };
    let notation = |name: &str| lsystem_import::write::NOTATIONS.iter().find(|notation| notation.name == name).unwrap();
    let text = lsystem_import::write::export(&definition, notation("cpfg")).unwrap().text;
    let lengths = |definition: &Definition| -> Vec<f64> {
        let figure = Figure::draw(&system(definition), 20, &Limits::default()).unwrap();
        let square = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| libm::pow(a[axis] - b[axis], 2.0)).sum::<f64>();
        figure.segments_from(0).map(|s| square(s.from, s.to).sqrt()).collect()
    };
    let (ours, theirs) = (lengths(&definition), lengths(&read(&text)));
    assert_eq!((ours.len(), theirs.len()), (32, 32), "{text}");
    let scale = theirs[0] / ours[0];
    assert!(ours.iter().zip(&theirs).all(|(a, b)| (a * scale - b).abs() < 1e-6), "{ours:?} {theirs:?}");
    assert!(lsystem_import::write::export(&definition, notation("houdini")).is_err());
}

#[test]
fn functions_are_written_in_the_words_of_python() {
    let sum = "sqrt(t) + sin(30*t)^2 + cos(t)*tan(t) + asin(t/9) + acos(t/9) + atan(t) + atan2(t, 2) + exp(-t) + ln(t + 1) \
         + abs(t - 3) + floor(t/2) + ceil(t/2) + min(t, 3) + max(t, 3) + (-t)^2";
    let rules = format!("A(t) : t < 7 -> F({sum})A(t + 1)");
    let definition = Definition { axiom: "A(1)".into(), rules, iterations: 6, ..Definition::default() };
    let notation = lsystem_import::write::Notation::named("lpy").unwrap();
    let text = lsystem_import::write::export(&definition, notation).unwrap().text;
    assert!(text.starts_with("from math import *") && text.contains("sin(radians(30*t))**2"), "{text}");
    let lengths = |definition: &Definition| -> Vec<f64> {
        let figure = Figure::draw(&system(definition), 6, &Limits::default()).unwrap();
        figure.segments_from(0).map(|s| s.to[1] - s.from[1]).collect()
    };
    let (ours, theirs) = (lengths(&definition), lengths(&read(&text)));
    assert_eq!((ours.len(), theirs.len()), (6, 6), "{text}");
    assert!(ours.iter().zip(&theirs).all(|(a, b)| (a / ours[0] - b / theirs[0]).abs() < 1e-9), "{ours:?} {theirs:?}");
}

#[test]
fn functions_of_lpy_are_curves() {
    let rules = lpy("A(0)A(0.5)A(1)", "A(x) --> F(1+10*hill(x))");
    let points = "Vector3(0,0,1),Vector3(0.25,1,1),Vector3(0.75,2,1),Vector3(1,0,1)";
    let code = format!("hill = QuantisedFunction(NurbsCurve2D(Point3Array([{points}])))\n{rules}");
    let plain = points.replace("Vector3", "");
    let kept = format!(
        "{rules}###### INITIALISATION ######\ndef __initialiseContext__(context):\n\timport openalea.plantgl.all as pgl\n\t\
         hill = pgl.NurbsCurve2D(ctrlPointList = pgl.Point3Array([{plain}]) ,)\n"
    );
    // Bernstein polynomials: at 0.5 the value is (3*1 + 3*2)/8, at the ends 0.
    for text in [&code, &kept, &code.replace("Nurbs", "Bezier")] {
        let found: Vec<f64> = segments(text).iter().map(|(along, _)| along[1]).collect();
        assert!(
            found.len() == 3 && found.iter().zip([1.0, 12.25, 1.0]).all(|(a, b)| (a - b).abs() < 1e-6),
            "{found:?}"
        );
    }
    refused(&code.replace("0.25,1,1", "0.25,1,2"), "no clamped cubic");
    refused(&code.replace("])))", "]), degree = 1))"), "no clamped cubic");
}
