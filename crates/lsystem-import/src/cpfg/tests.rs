//! Cases of cpfg and L-Py.

use crate::tests::check;
use expect_test::expect;

#[test]
fn cpfg() {
    check(
        "lsystem: 1\n/* a tree\n of two lines */\n#define STEPS 4\n#define r 0.9\n#define UNUSED 2\nSeed: 7\nderivation length: STEPS\nignore: +-\naxiom: A(1) /* start */\np1: A(s) : s > 0.1 --> F(s)[+(30)A(s*r)] \\\n   [-(30)A(s*r)]\nA < B > C --> D\nhomomorphism\nA(s) --> ;(2)F(s)\nendlsystem\nnonsense",
        expect![[r#"
            cpfg
            []
            n 4, angle 90, heading 90, abop, seed 7
              A(1)
              r = 0.9
              ignore: +-
              A(s) : s > 0.1 --> F(s)[+(30)A(s*r)] [-(30)A(s*r)]
              A < B > C --> D
              draw:
              A(s) --> ;(2)F(s)"#]],
    );
    check(
        "lsystem: 1\nderivation length: 3\naxiom: F\nF --> F+F : 0.5\nF --> FF : 0.5\n",
        expect![[r#"
        cpfg
        []
        n 3, angle 90, heading 90, abop
          F
          F --> F+F : 0.5
          F --> FF : 0.5
        note 1 "": The angle stands in cpfg's view file; 90 degrees is chosen"#]],
    );
    check(
        "lsystem: 1\nderivation length: 3\naxiom: Apex F\nApex --> F[+Apex]Leaf(1)\nLeaf(x) : x < 3 --> Leaf(x+1)\n",
        expect![[r#"
            cpfg
            []
            n 3, angle 90, heading 90, abop
              b F
              b --> F[+b]c(1)
              c(x) : x < 3 --> c(x+1)
            note 3 "Apex": The name `Apex` becomes the symbol `b`
            note 4 "Leaf": The name `Leaf` becomes the symbol `c`
            note 1 "": The angle stands in cpfg's view file; 90 degrees is chosen"#]],
    );
}

#[test]
fn refused() {
    check(
        "lsystem: 1\naxiom: A\n#include \"x.h\"\nA : {x = 1;} x > 0 --> B\ndecomposition\n",
        expect![[r##"
            cpfg
            []
            refused 3 "#include \"x.h\"": `#include` reads another file"##]],
    );
    check(
        "lsystem: 1\nderivation length: 2\naxiom: A\nA --> @M(1)~l?P(x)F\nF(a) --> F\n",
        expect![[r#"
            cpfg
            []
            refused 4 "@M": This moves the turtle to a place of its own, which has no equal here
            note 4 "~l": The surface `~l` is not drawn: its file is not given"#]],
    );
    check(
        "Axiom: A\nderivation length: 4\nproduction:\nA(x) :\n  while x < 3: x += 1\n  produce FA\nB --> F\n",
        expect![[r#"
            L-Py
            []
            refused 5 "while x < 3: x += 1": Python code is not run"#]],
    );
}

#[test]
fn a_homomorphism_applies_once_where_no_depth_is_given() {
    check(
        "lsystem: 1\nderivation length: 2\naxiom: A\nA --> F\nhomomorphism\nF --> F[+F]\n",
        expect![[r#"
            cpfg
            []
            n 2, angle 90, heading 90, abop
              A
              A --> F
              draw:
              F --> F[+F]
            note 1 "": The angle stands in cpfg's view file; 90 degrees is chosen"#]],
    );
}

#[test]
fn lpy() {
    check(
        "# a plant\nr = 0.8\nAxiom: A(1)\nderivation length: 4\nproduction:\nA(x) --> F(x)[+A(x*r)]\ninterpretation:\nA(x) --> f(x)\nendlsystem\n",
        expect![[r#"
            L-Py
            []
            n 4, angle 60, heading 90, abop
              A(1)
              r = 0.8
              A(x) --> F(x)[+A(x*r)]
              draw:
              A(x) --> f(x)
            note 1 "": The text gives no angle; 60 degrees is the default of L-Py"#]],
    );
    check(
        "Axiom: A\nderivation length: 4\nproduction:\nA :\n  produce FA\nB --> F\n",
        expect![[r#"
            L-Py
            []
            n 4, angle 60, heading 90, abop
              A
              A --> FA
              B --> F"#]],
    );
}
