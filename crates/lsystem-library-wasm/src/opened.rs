//! Systems as scripts hold them: read, checked and compiled, with their problems in words.

use lsystem_base::Limits;
use lsystem_drawing::System;
use lsystem_files::{FileContent, read_fields, read_file};
use lsystem_syntax::fields::field;
use lsystem_syntax::{Definition, Diagnostic, Field, Kind, Problem, Value, problems, render_diagnostic};
use serde::Serialize;

/// The limits of strings and drawings.
pub(crate) const LIMITS: Limits = Limits::PAGE;

/// A compiled system.
#[derive(Debug)]
pub(crate) struct OpenSystem {
    pub(crate) definition: Definition,
    pub(crate) system: System,
}

/// The outcome of reading.
#[derive(Debug, Serialize)]
pub(crate) struct Reading {
    /// `None` if the system has errors.
    pub(crate) definition: Option<Definition>,
    #[serde(skip)]
    system: Option<System>,
    /// Errors and warnings.
    pub(crate) problems: Vec<ShownProblem>,
}

/// A problem, and the problem with its line and with marks below its place, as terminals show it.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct ShownProblem {
    #[serde(flatten)]
    problem: Problem,
    text: String,
}

/// The problems that keep a system from its result.
#[derive(Debug, Serialize)]
pub(crate) struct Refusal {
    /// The errors, as terminals show them.
    pub(crate) message: String,
    pub(crate) diagnostics: Vec<ShownProblem>,
}

impl Reading {
    /// Reads an object of [`read_fields`]. `n` replaces its number of iterations.
    pub(crate) fn of_object(json: &str, n: Option<f64>) -> Self {
        let (mut definition, mut diagnostics) = read_fields(json);
        if let (Some(definition), Some(n), Some(spec)) = (&mut definition, n, field("iterations")) {
            let n = Value::Number(n);
            if !(spec.admits(&n) && spec.set(definition, &n)) {
                diagnostics.push(spec.out_of_range());
            }
        }
        Self::new(definition, diagnostics, json)
    }

    /// Reads a file.
    pub(crate) fn of_file(bytes: &[u8]) -> Self {
        let FileContent { definition, diagnostics, json } = read_file(bytes);
        Self::new(definition, diagnostics, &json)
    }

    fn new(definition: Option<Definition>, mut diagnostics: Vec<Diagnostic>, json: &str) -> Self {
        let system = definition.as_ref().and_then(|definition| System::read(definition, &mut diagnostics));
        let has_errors = diagnostics.iter().any(Diagnostic::is_error);
        let mut problems = shown(&diagnostics, definition.as_ref().unwrap_or(&Definition::default()), json);
        if definition.is_none() && !has_errors {
            // Unknown keys are the only warnings that refuse a system.
            let unknown = diagnostics.iter().map(|diagnostic| matches!(diagnostic.kind, Kind::UnknownKey { .. }));
            problems
                .iter_mut()
                .zip(unknown)
                .filter(|(_, is_unknown)| *is_unknown)
                .for_each(|(shown, _)| shown.refuse());
        }
        Self { definition: definition.filter(|_| !has_errors), system: system.filter(|_| !has_errors), problems }
    }

    /// The problems of a system that was not read.
    pub(crate) fn refusal(self) -> Refusal {
        Refusal::new(self.problems)
    }
}

impl OpenSystem {
    /// Reads an object of [`read_fields`]. `n` replaces its number of iterations.
    pub(crate) fn read(json: &str, n: Option<f64>) -> Result<Self, Refusal> {
        match Reading::of_object(json, n) {
            Reading { definition: Some(definition), system: Some(system), .. } => Ok(Self { definition, system }),
            refused => Err(refused.refusal()),
        }
    }

    /// The number of derivation steps.
    pub(crate) fn n(&self) -> u32 {
        self.definition.iterations
    }

    /// The refusal for an exceeded limit.
    pub(crate) fn exceeds(&self, limit: &Diagnostic) -> Refusal {
        Refusal::new(shown(core::slice::from_ref(limit), &self.definition, ""))
    }
}

impl ShownProblem {
    fn refuse(&mut self) {
        self.problem.severity = "error";
        if let Some(rest) = self.text.strip_prefix("warning") {
            self.text = format!("error{rest}");
        }
    }
}

impl Refusal {
    fn new(diagnostics: Vec<ShownProblem>) -> Self {
        let errors = diagnostics.iter().filter(|shown| shown.problem.severity == "error");
        let all = errors.map(|shown| shown.text.trim_end()).collect::<Vec<_>>().join("\n");
        // The name of the error's class stands before the message.
        let message = all.strip_prefix("error: ").unwrap_or(&all).to_owned();
        Self { message, diagnostics }
    }

    /// The refusal of a call, in a sentence.
    pub(crate) fn words(message: String) -> Self {
        Self { message, diagnostics: vec![] }
    }
}

fn shown(diagnostics: &[Diagnostic], definition: &Definition, json: &str) -> Vec<ShownProblem> {
    let text = |diagnostic: &Diagnostic| match diagnostic.field {
        Field::File => render_diagnostic(diagnostic, "system", json),
        Field::Numbers => render_diagnostic(diagnostic, "system", ""),
        field => render_diagnostic(diagnostic, field.name(), definition.text(field).unwrap_or_default()),
    };
    let told = problems(diagnostics, definition, json);
    told.into_iter().zip(diagnostics).map(|(problem, told)| ShownProblem { problem, text: text(told) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The message of a refusal.
    fn refused(json: &str, n: Option<f64>) -> String {
        OpenSystem::read(json, n).map(|open| open.n()).unwrap_err().message
    }

    #[test]
    fn a_system_has_its_own_iterations_unless_others_are_asked_for() {
        let read = |n| OpenSystem::read(r#"{"axiom": "F", "rules": {"F": "FF"}, "iterations": 3}"#, n).unwrap().n();
        assert_eq!([read(None), read(Some(5.0))], [3, 5]);
        for n in [2.5, -1.0, 1001.0, f64::NAN, f64::INFINITY] {
            let message = refused(r#"{"axiom": "F"}"#, Some(n));
            assert_eq!(message, "Iterations must be a whole number from 0 to 1,000\n --> system", "{n}");
        }
    }

    #[test]
    fn unknown_fields_are_refused_with_the_nearest_name() {
        let refusal = OpenSystem::read("{\n  \"axiom\": \"F\",\n  \"angel\": 60\n}", None).unwrap_err();
        let lines = [
            "Unknown key `angel`",
            " --> system:3:3",
            "  |",
            "3 |   \"angel\": 60",
            "  |   ^^^^^^^",
            "  = help: Did you mean `angle`?",
        ];
        assert_eq!(refusal.message, lines.join("\n"));
        let problem = &refusal.diagnostics[0].problem;
        assert_eq!((problem.severity, problem.field), ("error", "file"));
        assert!(refused(r#"{"axiom": "F", "productions": {}}"#, None).contains("`rules`"));
    }

    #[test]
    fn errors_of_texts_show_their_place() {
        let message = refused(r#"{"axiom": "F", "rules": "F = FF", "angle": 60}"#, None);
        assert!(message.contains(" --> rules:1:3") && message.contains("write `F -> FF`"), "{message}");
        assert!(refused("7", None).contains("an object") && refused("null", None).contains("null"));
    }

    #[test]
    fn warnings_do_not_refuse() {
        let reading = Reading::of_object(r#"{"axiom": "F]", "rules": "F -> FF"}"#, None);
        assert!(reading.system.is_some() && reading.problems.len() == 1);
        assert!(reading.problems[0].text.starts_with("warning: "), "{}", reading.problems[0].text);
    }

    #[test]
    fn files_keep_keys_of_others() {
        let reading = Reading::of_file(br#"{"initial": "F", "rules": {"F": "FF",}, "author": "A"}"#);
        assert!(reading.definition.is_some() && reading.problems[0].text.contains("`author`"));
        let reading = Reading::of_file(br#"{"initial": "F", "rules": "F = FF"}"#);
        assert!(reading.definition.is_none() && reading.refusal().message.contains("rules:1:3"));
    }
}
