use crate::tests::check;
use expect_test::expect;

#[test]
fn entries_and_plain_rules() {
    check(
        "Koch1 { ; a comment\n  Angle 6\n  Axiom f--F--F\n  F=F+F--F+F ; more\n  }\n",
        expect![[r#"
            Fractint
            [Koch1]
            n 5, angle 60, heading 0, abop
              F--F--F
              F -> F+F--F+F
            note 1 "": The text gives no number of iterations; 5 is chosen by the size"#]],
    );
    check(
        "; collected\ncomment { not a system }\nTwo {\nangle 8\naxiom x\nx=f+[x]\nX=y ; joined\ny=\n}\n\nNamed = {\nAxiom=FX\nangle=4\nx fy\n}",
        expect![[r#"
                Fractint
                [Two]
                n 16, angle 45, heading 0, abop
                  X
                  X -> F+[X]Y
                  Y -> *
                note 3 "": The text gives no number of iterations; 16 is chosen by the size
                [Named]
                n 1, angle 90, heading 0, abop
                  FX
                  X -> FY
                note 11 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
    check(
        "Angle 6\nAxiom F--F--F\nF=F+F--F+F",
        expect![[r#"
            Fractint
            []
            n 5, angle 60, heading 0, abop
              F--F--F
              F -> F+F--F+F
            note 1 "": The text gives no number of iterations; 5 is chosen by the size"#]],
    );
}

#[test]
fn moves_and_letters_without_meaning() {
    check(
        "A {\nangle 4\naxiom fgh\nf=f+g$f\n}",
        expect![[r#"
            Fractint
            [A]
            n 12, angle 90, heading 0, abop
              FGH
              F -> F+G$F
              | $: nothing
              | G: move
            note 1 "": The text gives no number of iterations; 12 is chosen by the size"#]],
    );
    check(
        "D {\nangle 4\naxiom d+m|\nd=d\\45d/30m\n}",
        expect![[r#"
            Fractint
            [D]
            n 12, angle 90, heading 0, abop
              DM
              D -> DaDbM
              | D: draw
              | M: move
              | a: turn left 45
              | b: turn right 30
            note 1 "": The text gives no number of iterations; 12 is chosen by the size"#]],
    );
    check(
        "F {\nangle 4\naxiom f\\30f\n}",
        expect![[r#"
            Fractint
            [F]
            n 1, angle 90, heading 0, abop
              FF
            note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
}

#[test]
fn turns_round_and_swapped() {
    check(
        "Even {\nangle 6\naxiom f|f!+f\n}",
        expect![[r#"
                Fractint
                [Even]
                n 1, angle 60, heading 0, abop
                  F|F!+F
                  | !: swap turns
                note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
    check(
        "Odd {\nangle 5\naxiom f|f\n}",
        expect![[r#"
            Fractint
            [Odd]
            n 1, angle 72, heading 0, abop
              F|F
              | |: turn right 144
            note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
    check(
        "Odd {\nangle 5\naxiom f|f!+f\n}",
        expect![[r#"
            Fractint
            [Odd]
            refused 3 "f|f!+f": `|` is less than half a circle for an odd Angle, and `!` does not swap it: our turtle cannot do both"#]],
    );
}

#[test]
fn numbers() {
    check(
        "L {\nangle 4\naxiom a\na=f@.5f@q2f@iq2f@i2f@1.5.7a@.5\n}",
        expect![[r#"
                Fractint
                [L]
                n 16, angle 90, heading 0, abop
                  A
                  A -> FaFbFcFaFdAa
                  | a: length times 0.5
                  | b: length times 1.4142135623730951
                  | c: length times 0.7071067811865475
                  | d: length times 1.5
                note 1 "": The text gives no number of iterations; 16 is chosen by the size"#]],
    );
    check(
        "Z {\nangle 4\naxiom f@f\n}",
        expect![[r#"
                Fractint
                [Z]
                n 1, angle 90, heading 0, abop
                  FaF
                  | a: length times 0
                note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
    check(
        "C {\nangle 4\naxiom c1f<2f>f>3fc300f\n}",
        expect![[r#"
                Fractint
                [C]
                n 1, angle 90, heading 0, abop
                  haFbFcFdFeF
                  | a: colour 1
                  | b: next colour 2
                  | d: previous colour 3
                  | e: colour 44
                  | h: colour 15
                note 3 "c1f<2f>f>3fc300f": The text gives no palette; colours are those of Fractint’s default palette; there `<` and `>` leave out colour 0
                note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
}

#[test]
fn two_headings() {
    check(
        "Both {\nangle 4\naxiom f+\\90d-/90d@.5+\\90f\n}",
        expect![[r#"
                Fractint
                [Both]
                n 1, angle 90, heading 0, abop
                  F+D-Da+F
                  | D: draw
                  | a: length times 0.5
                note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
    check(
        "Straight {\nangle 4\naxiom fdfm\n}",
        expect![[r#"
            Fractint
            [Straight]
            n 1, angle 90, heading 0, abop
              FDFM
              | D: draw
              | M: move
            note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
    check(
        "Differ {\nangle 4\naxiom f\nf=f+d\n}",
        expect![[r#"
            Fractint
            [Differ]
            refused 4 "f+d": F and G go along one heading, turned by + - |, and D and M along another, turned by \ and /. Our turtle has one heading, and here the two differ"#]],
    );
}

#[test]
fn refused() {
    check(
        "E {\nangle 4\naxiom f]f\nf=f[+f\n}",
        expect![[r#"
                Fractint
                [E]
                note 3 "]f": Fractint ignores the rest of a word after a `]` that closes nothing
                refused 4 "f[+f": Fractint needs the `]` of a branch in the same word as its `[`"#]],
    );
    check(
        "E {\nangle 4\naxiom f f\n+=ff\n what is this\n}",
        expect![[r#"
            Fractint
            [E]
            refused 3 "f": Fractint does not allow more text after a blank
            refused 4 "+=ff": Fractint does not allow a rule for this symbol
            refused 5 "what is this": Fractint cannot read this line"#]],
    );
    check(
        "E {\nangle 2\naxiom f\nf=f+f }",
        expect![[r#"
            Fractint
            [E]
            n 13, angle 180, heading 0, abop
              F
              F -> F+F
            note 2 "angle 2": Fractint accepts angles from 3 to 50 only; 360 is divided by this number
            note 1 "": The text gives no number of iterations; 13 is chosen by the size"#]],
    );
    check(
        "E {\naxiom f\nf=f+f\n}",
        expect![[r#"
            Fractint
            [E]
            refused 1 "": There is no Angle from 3 to 50"#]],
    );
    check(
        "E {\nangle 4\nf=f+f\n}\nG {\nangle 4\naxiom f\n}",
        expect![[r#"
            Fractint
            [E]
            refused 1 "": There is no Axiom
            [G]
            n 1, angle 90, heading 0, abop
              F
            note 5 "": The text gives no number of iterations; 1 is chosen by the size"#]],
    );
}
