use crate::tests::check;
use expect_test::expect;

#[test]
fn cases() {
    check(
        "\\pgfdeclarelindenmayersystem{Koch curve}{\n  \\rule{F -> F-F++F-F}}\n\\begin{tikzpicture}\n\\draw [l-system={Koch curve, axiom=F++F++F, order=3, angle=60, step=2pt}] lindenmayer system;\n\\end{tikzpicture}",
        expect![[r#"
                TikZ
                [Koch curve]
                n 3, angle 60, heading 0, abop
                  F++F++F
                  F -> F-F++F-F"#]],
    );
    check(
        "\\draw [green, l-system={rule set={F -> FF-[-F+F]+[+F-F], X -> f}, axiom=F, order=4, left angle=25, randomize angle percent=25}] l-system;",
        expect![[r#"
                TikZ
                []
                n 4, angle 25, right 90, heading 0, abop
                  F
                  F -> FF-[-F+F]+[+F-F]
                  X -> f
                note 1 "green": How the path is drawn is not carried over"#]],
    );
    check(
        "\\pgfdeclarelindenmayersystem{H}{\\symbol{A}{\\pgflsystemdrawforward}\\symbol{B}{\\code}\\rule{A -> AB}}\n\\draw[lindenmayer system={H, axiom=A, order=2}] (0,0) lindenmayer system; \\pgfdeclarelindenmayersystem{I}{\\rule{F->F}}",
        expect![[r#"
                TikZ
                [H]
                refused 1 "\\code": The code of this symbol is not run
                [I]
                refused 2 "I": The text gives no axiom for this system"#]],
    );
}
