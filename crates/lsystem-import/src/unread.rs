//! Notations that are known by strong signs and refused by their names, so that their rules are not taken for those of
//! another one: XL, the language of GroIMP (`Axiom ==> A(1); A(x) ==> F(x) [ RU(30) A(x*0.8) ];`), L+C, the language of
//! lpfg, and the tables for LaTeX that this library writes.

use crate::draft::Draft;
use crate::source::Source;
use lsystem_base::say;

/// Commands of GroIMP's turtle that no other notation has.
const COMMANDS: [&str; 12] =
    ["RU(", "RL(", "RH(", "RV(", "RG", "F0", "M0", "LMul(", "DMul(", "RD(", "Translate(", "Rotate("];

pub(super) fn xl<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let start = text.match_indices("Axiom").map(|(at, _)| at).find(|at| {
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        !text[..*at].chars().next_back().is_some_and(is_part) && text[at + 5..].trim_start().starts_with("==>")
    })?;
    let is_class = text.contains("extends RGG") || text.contains("public void ") || text.contains("module ");
    if !is_class && text.matches("==>").count() < 2 && !COMMANDS.iter().any(|command| text.contains(command)) {
        return None;
    }
    refused(
        source,
        start,
        say!("This is XL, the language of GroIMP; its rules rewrite graphs with code, which is not run"),
    )
}

pub(super) fn l_plus_c<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let is_statement = |line: &str| line.trim_start().starts_with("produce ") && line.trim_end().ends_with(';');
    let axiom = || source.text.find("Axiom:").filter(|_| source.text.lines().any(is_statement));
    let start = source.text.find("#include <lpfgall.h>").or_else(axiom)?;
    refused(source, start, say!("This is L+C, the language of lpfg; its rules are C++, which is not run"))
}

pub(super) fn latex<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let start = source.text.find(lsystem_files::LATEX_START)?;
    refused(source, start, say!("This is typeset for LaTeX, and not read"))
}

/// The system that begins in the line at a place, refused.
fn refused<'a>(source: Source<'a>, start: usize, why: String) -> Option<Vec<Draft<'a>>> {
    let mut draft = Draft::new(source, "", source.line_of(start));
    let all = draft.place(source.text.trim());
    draft.covers(all.clone());
    draft.pass(all);
    let line = source.text[start..].lines().next().unwrap_or_default().trim_end();
    draft.refuse_at(draft.place(line), why);
    Some(vec![draft])
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn cases() {
        check(
            "Axiom ==> A(1);\nA(x) ==> F(x) [RU(30) A(x*0.8)]",
            expect![[r#"
            GroIMP’s XL
            []
            refused 1 "Axiom ==> A(1);": This is XL, the language of GroIMP; its rules rewrite graphs with code, which is not run"#]],
        );
        check(
            "module A(float len);\nprotected void init()\n[\n  Axiom ==> A(1);\n]\npublic void run()\n[\n  A(x) ==> F(x) [RU(30) RH(90) A(x*0.8)];\n]\n",
            expect![[r#"
                GroIMP’s XL
                []
                refused 4 "Axiom ==> A(1);": This is XL, the language of GroIMP; its rules rewrite graphs with code, which is not run"#]],
        );
        check(
            "#include <lpfgall.h>\nderivation length: 3;\nAxiom: F(1.0);\nF(v) :\n{\n  produce F(v) Left(60) F(v);\n}\n",
            expect![[r##"
                L+C
                []
                refused 1 "#include <lpfgall.h>": This is L+C, the language of lpfg; its rules are C++, which is not run"##]],
        );
    }
}
