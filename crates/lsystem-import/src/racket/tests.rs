use crate::tests::check;
use expect_test::expect;

#[test]
fn cases() {
    check(
        "#lang lindenmayer racket\n\n## axiom ##\nF\n\n## rules ##\nF -> FF-\n     [-F+F+F]+\n     [+F-F-F]\n\n## variables ##\nn=4\nθ=22.5\n\n=====\n(require lindenmayer/turtle)\n",
        expect![[r#"
                Racket
                []
                n 4, angle 22.5, heading 90, abop, step 2
                  F
                  F -> FF- [-F+F+F]+ [+F-F-F]"#]],
    );
    check(
        "#lang lindenmayer racket\n## axiom ##\nA(0)\n## rules ##\nA(d) : d > 0 -> A(d+s)\nA(d) : d = 0 → F(1)[+(2)A(D)]F(1)A(0)\nF(a)         -> F(a*R)\n## variables ##\nD=1\nR=1.5\nn=5\ns=-1\nθ=45\nh=800\n----\n## axiom ##\nX\n## rules ##\nX → ^F∧X\n=====\n(require lindenmayer/turtle)",
        expect![[r#"
                Racket
                []
                n 5, angle 45, heading 90, abop, step 2
                  A(0)
                  D = 1
                  R = 1.5
                  s = -1
                  θ = 45
                  A(d) : d > 0 -> A(d+s)
                  A(d) : d = 0 → F(1)[+((2)*θ)A(D)]F(1)A(0)
                  F(a)         -> F(a*R)
                []
                n 16, angle 90, heading 90, abop, step 2
                  X
                  X → ^F^X
                  | ^: nothing
                note 16 "": The text gives no number of iterations; 16 is chosen by the size"#]],
    );
    check(
        "#lang lindenmayer racket\n## axiom ##\nF\n## rules ##\nF -> F + F\n## variables ##\nn=2\n=====\n(define (+ turtles variables)\n  (turn 60 turtles))",
        expect![[r#"
                Racket
                []
                n 2, angle 60, heading 90, abop
                  F
                  F -> F + F
                note 1 "": The angle is read from the Racket code
                note 9 "(define (+ turtles variables)\n  (turn 60…": The Racket code decides what symbols do and is not run; here symbols do the same as in ABOP"#]],
    );
    check(
        "#lang lindenmayer\n## axiom ##\nF(\n## rules ##\nFF\n## colours ##\nred\n",
        expect![[r#"
            Racket
            []
            refused 5 "FF": This rule has no arrow
            refused 7 "red": This section cannot be read"#]],
    );
}
