//! Texts in the notations of other programs: any text is read without a panic, and every system of the result compiles.

use crate::{Gauge, Source, make, told};
use lsystem::System;
use lsystem::base::MAX_TEXT;
use lsystem::import::import;

/// Texts of every notation, mixed and damaged.
pub(super) fn import_text(source: &mut Source<'_>, gauge: &mut Gauge) {
    let text = text(source);
    let found = gauge.call("import", || import(&text));
    let again = import(&text);
    assert_eq!(found, again, "the same text gives the same systems");
    let Some(imported) = found else { return };
    assert!(!imported.entries.is_empty());
    gauge.reach(imported.notation);
    let mut at = 0;
    for part in &imported.account {
        assert!(part.span.start == at && part.span.end > at && text.is_char_boundary(part.span.end), "{part:?}");
        at = part.span.end;
    }
    assert_eq!(at, text.len(), "the account covers the text");
    let lines = text.matches(['\n', '\r']).count() + 1;
    for entry in &imported.entries {
        let refused = entry.remarks.iter().any(|remark| remark.refused);
        assert_eq!(refused, entry.definition.is_none(), "a system is refused with a reason: {entry:?}");
        assert!(entry.remarks.iter().all(|remark| (1..=lines).contains(&remark.line)), "{:?}", entry.remarks);
        entry.remarks.iter().for_each(|remark| told::check(&remark.message));
        if let Some(definition) = &entry.definition {
            gauge.reach("read");
            assert!(System::new(definition).0.is_some(), "{definition:?} does not compile");
        }
    }
}

/// The page's worker is ended after four seconds.
const LONG_STEPS: u32 = 4000 / 8;

/// Texts of up to 1 MiB that repeat a part of a notation, each time with other names: work that grows faster than the
/// text shows.
pub(super) fn long_texts(source: &mut Source<'_>, gauge: &mut Gauge) {
    let whole = source.pick(&WHOLE);
    let ends: Vec<usize> = whole.char_indices().map(|(at, _)| at).chain([whole.len()]).collect();
    let (from, to) = (source.pick(&ends), source.pick(&ends));
    let (before, part, after) = match source.below(3) {
        0 => ("", whole, ""),
        1 => ("", source.pick(&PIECES), whole),
        _ => (&whole[..from.min(to)], &whole[from.min(to)..from.max(to)], &whole[from.max(to)..]),
    };
    let most = source.pick(&[1 << 14, 1 << 16, 1 << 18, MAX_TEXT]).saturating_sub(before.len() + after.len());
    let names = source.below(4);
    let mut text = before.to_owned();
    for number in 0.. {
        // Letters, numbers and words in turn, so that lists of each grow.
        let part = match names {
            1 => part.replace(['F', 'X', 'A'], &char::from_u32(0x4e00 + number % 20_000).unwrap_or('F').to_string()),
            2 => part.replace(|c: char| c.is_ascii_digit(), &number.to_string()),
            3 => part.replace(['F', 'X', 'A'], &format!("n{number}")),
            _ => part.to_owned(),
        };
        if part.is_empty() || text.len() + part.len() > most {
            break;
        }
        text += &part;
    }
    text += after;
    if source.is_shown {
        println!("{} bytes of {part:?} after {before:?}", text.len());
    }
    if let Some(imported) = gauge.long_call("import", LONG_STEPS, || import(&text)) {
        gauge.reach(imported.notation);
        assert_eq!(
            imported.account.last().map(|part| part.span.end),
            Some(text.len()),
            "the account ends with the text"
        );
    }
}

/// A system in each notation.
const WHOLE: [&str; 26] = [
    "g = new Grammar(\"X\");\ng.addRule('X', \"F+X\"); // x\nangle = radians(25);\n",
    "rules = new Dictionary<char, string> { {'X', \"F+X\"} };\naxiom = \"X\";\ncase '+': right(25); case 'F': forward(1);\n",
    "<lsystem angle=\"25\"><axiom>X</axiom><rule char=\"X\">F+X</rule></lsystem>",
    "| Axiom | Rules | Angle |\n|---|---|---|\n| F | F -> F+F | 60 |\n",
    "axiom : 0\nrules : (1 → 11), (0 → 1[0]0)\n0: draw a line\n[: push position, turn left 45 degrees\n",
    "\\begin{align} \\omega &: X \\\\ p_1 &: X \\rightarrow F[+X] \\end{align} $\\delta = 2\\pi/5$",
    "Koch {\n  Angle 6 ; six\n  Axiom F--F--F\n  F=F+F--F+F\n  X=@.5C1\\30D/30[!|M]\n}\n",
    "new LSystem({axiom: 'F++F', productions: {'F': 'F-F', 'A<B>C': [{weight: 2, successor: 'X'}]}})",
    "{axiom: \"A\", rules: [[\"A\", \"B-F\"], {in: 'F', out: 'FF'}], alpha: 0, theta: Math.PI / 3, iterations: 3}",
    "axiom: X\nrules:\n X => F+[X]\ndepth: 4\nangle: 90\nactions:\n F => draw(10)\n",
    "#lang lindenmayer racket\n## axiom ##\nA(1)\n## rules ##\nA(d) : d > 0 -> F(d)[+(2)A(d-1)]\n## variables ##\nn=3\nθ=45\n",
    "axiom X, angle 25°, rules (X → F+[[X]-X]), (F → FF)",
    "n=5, δ=25.7°\nF\nF→F[+F]F[-F]F",
    "\\pgfdeclarelindenmayersystem{K}{\\rule{F -> F-F}\\symbol{G}{\\pgflsystemdrawforward}}\\draw[l-system={K, axiom=F, order=3}]",
    "lsystem: 1\n#define r 0.9\nderivation length: 3\naxiom: Ab(1)\nAb(s) : s > 0 --> F(s)[+Ab(s*r)]\nhomomorphism\nAb(s) --> @o(1)\n",
    "lsystem: 1\nderivation length: 3\naxiom: A(1)\nA(x) : {y=x+1; z=y*y;} y<3 {w=z;} --> B(w)A(y)\ndecomposition\nmaximum depth: 9\nB(x) : x < 2 --> F(x)[B(x+x)]\nB(x) --> *\n",
    "Axiom: A\nderivation length: 2\nproduction:\nA --> F[+A]\n",
    "#define H(x) ((x)/2)\n#define L FF\nlsystem: 1\nseed: 2\nStart: {a = 2; b = a*a;}\nDefine: {array c[2] = {1, 2};}\nderivation length: 2\nignore: ~+\naxiom: L A(0)\nA(n) : n < 2 &&\n\tn > -1 --> F(H(c[n]))~l(n)\n\t[+A(n+1)]\nhomomorphism\nmaximum depth: 3\nF --> G+G\nG --> f(b)F\nendlsystem\n",
    "x = 2\nmodule Apex\nAxiom: Apex(0)Sphere(x)\nderivation length: 2\nproduction:\nApex(t):\n  y = t+1\n  if t < x:\n    for i in range(2): nproduce [/(i*90)F(y)]\n    produce Apex(y)\n  else: produce *\ninterpretation:\nF(a) --> _(a)F(a)\nendlsystem\n",
    "Premise: A(0)\nRule 1: A(i):i<=3=FA(i+1)\nAngle: 30\n",
    "#v=1&axiom=F&rules=F%20-%3E%20FF&n=3&do=F%3A%20draw",
    "#v=1&z=eNpLrMjMz7WNUCsqzUktto1Q0LVTcIvWjoh1i9aNiNWO4HIDi7ip5dmaqiXmpeek2hqZ6pkDAMlCD48&n=3",
    "{\"initial\": \"F\", \"rules\": [\"F -> F[+F]F : 0.5\"], \"turtle\": {\"overrides\": {\"G\": \"move\"}}}\n",
    "https://anvaka.github.io/lsystem/?code=axiom%3A%20F%0Arules%3A%0A%20F%20%3D%3E%20F%2BF%0Adirection:%200,1,1%0A",
    "#lang lindenmayer racket\n## axiom ##\nF!(2)G\n## rules ##\nG -> GG\n## variables ##\nθ=1/2\n===\n(require lindenmayer/turtle)\n(define G F)\n(define (X t v) t)\n",
    "\\begin{tikzpicture}[rotate=9] % {\n\\draw[rotate=90] (0,0) [l-system={rule set={F -> F-F}, % a\n axiom=F}] l-system;\n\\end{tikzpicture}\nAxiom ==> A(1); A(x) ==> F(x) [RU(30) A(x)];\n",
];

/// Parts of the notations.
const PIECES: [&str; 48] = [
    "{", "}", "[", "]", "(", ")", "<", ">", ":", "=", "->", "→", "-->", "\n", "\n\n", " ", ",", ";", "'", "\"", "`",
    "\\", "/*", "*/", "//", "#", "##", "@", "@iq2", "C300", "F", "f", "X", "+", "-", "|", "!", "0.5", "1e999", "π",
    "°", "axiom", "rules", "Angle 7", "n=3", "é", "\u{feff}", "\r",
];

fn text(source: &mut Source<'_>) -> String {
    let mut text = String::new();
    for _ in 0..source.between(1, 3) {
        text.push_str(source.pick(&WHOLE));
    }
    make::damage(source, &mut text, &PIECES, 12);
    text
}
