use crate::tests::check;
use expect_test::expect;

#[test]
fn packages() {
    check(
        "var koch = new LSystem({\n  axiom: 'F++F++F',\n  productions: {'F': 'F-F++F-F'}\n})\nkoch.iterate(2)",
        expect![[r#"
                a program
                []
                n 2, angle 90, heading 90, abop
                  F++F++F
                  F -> F-F++F-F
                note 1 "": The text gives no angle; 90 degrees is chosen
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
    );
    check(
        "new LSystem({axiom: 'X', productions: {'X': 'F-X', 'A<B>C': 'D', 'F': {successors: [{weight: 50, successor: 'FF'}, {weight: 50, successor: 'F'}]}}, finals: {'+': () => { ctx.rotate((Math.PI/180) * 60) }, 'F': function() { ctx.fillRect(0, 0, 10, 40) }}})",
        expect![[r#"
            a program
            []
            n 5, angle 60, heading 90, abop
              X
              ignore: +-&^/|\
              X -> F-X
              A<B>C -> D
              F -> FF : 50
              F -> F : 50
              | -: turn left
            note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
            note 1 "": The text gives no number of iterations; 5 is chosen by the size"#]],
    );
    check(
        "let lsParams = {\n  axiom: \"A---A\", // start\n  rules: {\n    F: \"F\",\n    A: \"B-F+Z+F-BA\",\n    Z: \"F-FF\"\n  },\n  alpha: 90 * Math.PI / 180,\n  theta: Math.PI / 3,\n  step: 15,\n  iterations: 7,\n};",
        expect![[r#"
                a program
                [lsParams]
                n 7, angle 60, heading -90, abop
                  A---A
                  F -> F
                  A -> B-F+Z+F-BA
                  Z -> F-FF
                  B -> *
                  | +: turn right
                  | -: turn left
                  | B: move
                note 10 "step: 15": The length of a step changes only the size, which is fitted"#]],
    );
    check(
        "lindsvg.getSVGCode({axiom: 'F-F', rules: {}, theta: 1.0471975511965976})",
        expect![[r#"
                a program
                []
                n 3, angle 60, heading 0, abop
                  F-F
                  F -> *
                  | -: turn left"#]],
    );
}

#[test]
fn functions_of_an_axiom_and_rules() {
    for text in [
        "derivation('X', {'F':'FF', 'X':'F[+X][-X]FX'})",
        "print(derivation(\"X\", {'F': 'FF', 'X': 'F[+X][-X]FX'}, 5))",
        "plant = LSystem(\"X\", {\"F\": \"FF\", \"X\": \"F[+X][-X]FX\"}, angle=25.7)",
    ] {
        let source = crate::import(text).unwrap_or_else(|| panic!("{text}"));
        let [entry] = &source.entries[..] else { panic!("{text}: {:?}", source.entries) };
        let definition = entry.definition.as_ref().unwrap_or_else(|| panic!("{text}: {:?}", entry.remarks));
        assert_eq!((&*definition.axiom, &*definition.rules), ("X", "F -> FF\nX -> F[+X][-X]FX"), "{text}");
    }
    assert_eq!(crate::import("the derivation(s) of it: {'a': 'b'}"), None);
}

#[test]
fn forms_of_rules() {
    check(
        r#"{"start": "F", "rules": [{"in": "F", "out": "F+F"}], "angle": 60, "n": 3, "color": "red"}"#,
        expect![[r#"
                a program
                []
                n 3, angle 60, heading 90, abop
                  F
                  F -> F+F
                note 1 "\"red\"": `color` is not carried over
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
    );
    check(
        r#"{"axiom": "F", "rules": [["F", "F+F"], ["X", "F"]], "delta": "25.7", "depth": 3}"#,
        expect![[r#"
                a program
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
                a program
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
                a program
                []
                n 14, angle 28.647889757, heading 90, abop
                  F
                  F -> FF : 0.5
                  F -> F : 0.5
                note 1 "angle: 0.5": This angle is read as radians
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                note 1 "": The text gives no number of iterations; 14 is chosen by the size"#]],
    );
    check(
        "{axiom: 'A', rules: {A: 'B-A-B', B: 'A+B+A'}, angle: 60}",
        expect![[r#"
                a program
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
                a program
                []
                n 4, angle 75, heading 90, abop
                  F--F
                  F -> F+F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
    );
    check(
        "const all = { koch: {axiom: 'F', rules: {F: 'F+F'}, angle: 60, n: 1}, other: {axiom: 'G', rules: {G: 'G-G'}, angle: 90, n: 2} };",
        expect![[r#"
                a program
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
                a program
                []
                refused 1 "() => 'FF'": This rule is code, which is not read
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
    );
    check(
        "{axiom: 'F', rules: {FX: 'FF'}, angle: a, n: 1}",
        expect![[r#"
                a program
                []
                refused 1 "angle: a": The angle is code, which is not read
                refused 1 "FX: 'FF'": The left side of a rule must be one symbol
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
    );
    check(
        "{axiom: 'F', rules: {F: {successor: 'FF', condition: () => true}}, angle: 60, n: 1}",
        expect![[r#"
                a program
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
