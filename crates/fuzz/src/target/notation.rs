//! Texts: any text is read without a panic, and printed texts read back as the same.

use crate::make::{self, random_pieces};
use crate::told::check_diagnostic;
use crate::{Gauge, Source};
use lsystem::syntax::{
    Field, classify, parse, parse_overrides, print_axiom, print_overrides, print_rules, utf16_letters, utf16_span,
};
use lsystem::{Definition, Diagnostic, System, render_diagnostic};

/// Axiom, rules and overrides as text.
pub(super) fn notation(source: &mut Source<'_>, gauge: &mut Gauge) {
    let mut definition = make::definition(source);
    if source.given.is_none() && source.once_in(2) {
        let field = source.below(3);
        let text = [&mut definition.axiom, &mut definition.rules, &mut definition.overrides].into_iter().nth(field);
        if let Some(text) = text {
            *text = mixed(source, text);
        }
    }
    let (grammar, diagnostics) = gauge.call("parse", || parse(&definition.axiom, &definition.rules));
    check(&definition, &diagnostics);
    if !diagnostics.iter().any(Diagnostic::is_error) {
        gauge.reach("right");
        let (axiom, rules) = (print_axiom(&grammar), print_rules(&grammar));
        let (again, wrong) = parse(&axiom, &rules);
        assert!(!wrong.iter().any(Diagnostic::is_error), "printed text is wrong: {axiom}\n{rules}\n{wrong:?}");
        assert_eq!(again, grammar, "printed text reads as another grammar: {axiom}\n{rules}");
    }
    let mut problems = vec![];
    let system = gauge.call("define", || System::read(&definition, &mut problems));
    check(&definition, &problems);
    assert_eq!(system.is_none(), problems.iter().any(Diagnostic::is_error), "an error has no system");
    let classes = gauge.call("classify", || classify(&definition));
    let Definition { axiom, rules, overrides, .. } = &definition;
    for (text, classes) in [(axiom, classes.axiom), (rules, classes.rules), (overrides, classes.overrides)] {
        assert!(classes.is_empty() || classes.len() == text.len(), "a class for each byte");
        assert_eq!(utf16_letters(text, &classes).chars().count(), text.encode_utf16().count());
    }
    for place in classes.constants {
        assert!(rules.get(place.span.clone()).is_some(), "{place:?}");
    }
}

/// A text with another one inserted.
fn mixed(source: &mut Source<'_>, text: &str) -> String {
    let (from, to) = (source.place(text), source.place(text));
    format!("{}{}{}", &text[..from], random_pieces(source), &text[to.max(from)..])
}

/// Checks that diagnostics point into their texts and have messages.
pub(super) fn check(definition: &Definition, diagnostics: &[Diagnostic]) {
    for diagnostic in diagnostics {
        check_diagnostic(diagnostic);
        let text = definition.text(diagnostic.field).unwrap_or_default();
        if matches!(diagnostic.field, Field::Axiom | Field::Rules | Field::Overrides) {
            assert!(text.get(diagnostic.span.clone()).is_some(), "{diagnostic:?} points out of its text");
        }
        let _ = render_diagnostic(diagnostic, "text", text);
        let units = utf16_span(text, diagnostic.span.clone());
        assert!(units.start <= units.end && units.end <= text.encode_utf16().count());
    }
}

/// Overrides without a system.
pub(super) fn overrides(source: &mut Source<'_>, gauge: &mut Gauge) {
    let made = make::overrides(source);
    let text = if source.once_in(2) { mixed(source, &made) } else { made };
    let (overrides, diagnostics) = gauge.call("parse", || parse_overrides(&text));
    check(&Definition { overrides: text, ..Definition::default() }, &diagnostics);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return;
    }
    gauge.reach("right");
    let printed = print_overrides(&overrides);
    let (again, wrong) = parse_overrides(&printed);
    assert_eq!(again, overrides, "printed overrides read as others: {printed}");
    assert_eq!(wrong, [], "printed overrides are wrong: {printed}");
}
