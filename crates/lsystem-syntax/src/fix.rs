//! Remedies that can be applied at once.

use crate::diagnostic::{Diagnostic, Kind};

impl Diagnostic {
    /// The text that is probably meant in place of the diagnostic's span: empty where the span is to be removed, `None`
    /// where nothing is likely.
    #[must_use]
    pub fn fix(&self) -> Option<String> {
        let text = match &self.kind {
            Kind::NoArrow { suggestion: Some(production) } => production.clone(),
            Kind::EqualsForArrow { .. } => "->".into(),
            Kind::LookAlike { read_as, .. } => read_as.to_string(),
            Kind::UnknownConstant { similar: Some(similar), below: false, .. } => similar.clone(),
            Kind::UnknownFunction { similar: Some(similar), .. }
            | Kind::UnknownAction { similar: Some(similar), .. } => (*similar).to_owned(),
            Kind::Quotes { inside } => inside.clone(),
            Kind::DigitsBehind { symbol: '+' | '-' | '\\' | '/' | '&' | '^' | '|' | '<' | '>', digits } => {
                format!("({digits})")
            }
            Kind::ParenthesesForBranch { inside } => format!("[{inside}]"),
            Kind::LongPredecessor { text } => only_symbol(text)?.to_string(),
            Kind::CommentBehind | Kind::CommaBehind | Kind::UnmatchedClose { .. } | Kind::UnmatchedOpen { .. } => {
                String::new()
            }
            _ => return None,
        };
        // A long text is quoted with an ellipsis.
        (!text.contains('…') && !self.span.is_empty()).then_some(text)
    }
}

/// The predecessor in a text like `"F"` or `1.F`: quotes, bullets and numbers around one letter.
fn only_symbol(text: &str) -> Option<char> {
    let mut letters = text.chars().filter(|ch| ch.is_alphabetic());
    let letter = letters.next()?;
    let others = text
        .chars()
        .all(|ch| ch == letter || ch.is_ascii_digit() || matches!(ch, '"' | '\'' | '.' | ')' | '-' | '*' | '•'));
    (letters.next().is_none() && others).then_some(letter)
}

#[cfg(test)]
mod tests {
    use crate::parse;

    #[test]
    fn a_fix_ends_its_problem() {
        for (rules, expected) in [
            ("F := FF", "F -> FF"),
            ("F = FF", "F -> FF"),
            ("ratio = 2\nA(x) -> F(ratoi)", "ratio = 2\nA(x) -> F(ratio)"),
            ("A(x) -> F(sqr(x))", "A(x) -> F(sqrt(x))"),
            ("F -> F\u{2212}F", "F -> F-F"),
            ("F -> \"FF\"", "F -> FF"),
            ("\"F\" -> FF", "F -> FF"),
            ("1. F -> FF", "F -> FF"),
            ("F -> FF,", "F -> FF"),
            ("F -> FF ; doubled", "F -> FF "),
            ("F -> F(+F)F", "F -> F[+F]F"),
            ("F: \"FF-F\",", "F -> FF-F"),
            ("L is replaced by LR", "L -> LR"),
            ("A(i):i<=3=FA(i+1)", "A(i):i<=3 -> FA(i+1)"),
            ("; a comment", "// a comment"),
        ] {
            let problems = parse("F", rules).1;
            let problem = problems.iter().find(|problem| problem.fix().is_some()).unwrap_or_else(|| panic!("{rules}"));
            let mut fixed = rules.to_owned();
            fixed.replace_range(problem.span.clone(), &problem.fix().unwrap_or_default());
            assert_eq!(fixed, expected);
            assert!(parse("F", &fixed).1.iter().all(|left| left.kind != problem.kind), "{fixed}");
        }
    }

    #[test]
    fn what_is_not_known_has_no_fix() {
        assert!(parse("F", "F").1.iter().all(|problem| problem.fix().is_none()));
    }
}
