//! XL, the language of GroIMP: `Axiom ==> A(1); A(x) ==> F(x) [ RU(30) A(x*0.8) ];`. It is recognised so that its rules
//! are not taken for those of another notation.

use crate::draft::Draft;
use crate::source::Source;
use lsystem_base::say;

/// Commands of its turtle that no other notation has.
const COMMANDS: [&str; 12] =
    ["RU(", "RL(", "RH(", "RV(", "RG", "F0", "M0", "LMul(", "DMul(", "RD(", "Translate(", "Rotate("];

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let start = text.match_indices("Axiom").map(|(at, _)| at).find(|at| {
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        !text[..*at].chars().next_back().is_some_and(is_part) && text[at + 5..].trim_start().starts_with("==>")
    })?;
    let is_class = text.contains("extends RGG") || text.contains("public void ") || text.contains("module ");
    if !is_class && text.matches("==>").count() < 2 && !COMMANDS.iter().any(|command| text.contains(command)) {
        return None;
    }
    let mut draft = Draft::new(source, "", source.line_of(start));
    let all = draft.place(text.trim());
    draft.covers(all.clone());
    let why = say!("This is XL, the language of GroIMP; its rules rewrite graphs with code, which is not run");
    draft.pass(all);
    let line = text[start..].lines().next().unwrap_or_default().trim_end();
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
    }
}
