use crate::tests::check;
use expect_test::expect;

#[test]
fn cases() {
    check(
        "// dragon\naxiom: X\nrules: \n X => X+YF+\n Y => -FX-Y\n\ndepth: 10\nangle: 90",
        expect![[r#"
                anvaka’s page
                [dragon]
                n 10, angle 90, heading 0, abop, step 10
                  X
                  X -> X+YF+
                  Y -> -FX-Y"#]],
    );
    check(
        "axiom: F^F\nrules:\n  F => F f&[F]\n  f =>\ncolor: #ff0000\nstepsPerFrame: 10\ndirection: [0, 1, 0]\nactions:\n  F => draw()\n  f => move(5)\n  - => rotate(-90)\n  ^ => rotate(60)\n  & => rotate(-60.5)",
        expect![[r#"
                anvaka’s page
                []
                n 5, angle 60, heading 90, abop, step 10
                  F^F
                  F -> Ff&[F]
                  f -> *
                  | &: turn right 60.5
                  | ^: turn left 60
                  | f: move 5
                note 5 "color: #ff0000": This is not carried over
                note 6 "stepsPerFrame: 10": This is not carried over"#]],
    );
    check(
        "axiom: F\nrules:\n F -> F+F\n F -> FF\nactions:\n + => rotateX(10)\n - => jump(3)",
        expect![[r#"
                anvaka’s page
                []
                note 3 "F -> F+F": A later rule for the same symbol replaces this one
                refused 7 "- => jump(3)": This action cannot be read"#]],
    );
    check(
        "axiom: F\nrules:\n F -> F+F\n",
        expect![[r#"
                a description
                []
                n 13, angle 90, heading 90, abop
                  F
                  F -> F+F
                note 1 "": The text gives no angle; 90 degrees is chosen
                note 1 "": The text gives no number of iterations; 13 is chosen by the size"#]],
    );
}
