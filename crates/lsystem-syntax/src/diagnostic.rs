//! Problems in a system or a file, as values: words, place and remedy, made where the problem is found.

use core::ops::Range;
use lsystem_base::words::grouped;
use lsystem_base::{LimitName, say};

/// One problem in a system, a file or a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Whether the system is usable.
    pub severity: Severity,
    /// The kind of problem, for programs.
    pub kind: Kind,
    /// The text that contains the problem.
    pub field: Field,
    /// The place in the text, in bytes; empty where something is missing, 0..0 if no place applies.
    pub span: Range<usize>,
    /// The problem, as one sentence without its full stop. Texts in it are excerpts of at most about 40 characters.
    pub message: String,
    /// A remedy, as one sentence.
    pub hint: Option<String>,
    /// The text that is probably meant in place of the span: empty where the span is to be removed, `None` where nothing
    /// is likely.
    pub fix: Option<String>,
}

/// All problems of a system that cannot be used: at least one is an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl Diagnostics {
    /// The first error.
    #[must_use]
    pub fn first_error(self) -> Option<Diagnostic> {
        self.0.into_iter().find(Diagnostic::is_error)
    }
}

impl core::fmt::Display for Diagnostics {
    /// The messages of the errors, one on each line.
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let errors: Vec<&str> = self.0.iter().filter(|one| one.is_error()).map(|one| one.message.as_str()).collect();
        f.write_str(&errors.join("\n"))
    }
}

impl core::error::Error for Diagnostics {}

/// The kinds of problems that programs tell apart. Most are [`Kind::Other`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// All that only readers tell apart.
    #[default]
    Other,
    /// A limit is passed.
    Limit {
        /// The limit's name.
        limit: LimitName,
        /// The limit's value.
        value: u64,
        /// The largest number of iterations within the limit, if known.
        largest: Option<u32>,
    },
    /// A number that became infinite or undefined during derivation.
    NotFinite,
    /// An unknown key. Its value is not read.
    UnknownKey {
        /// Whether it resembles a known key.
        is_like_another: bool,
    },
    /// A name that is neither a parameter nor a constant above.
    UnknownName {
        /// The name.
        name: Box<str>,
        /// Whether a parameter is possible there, too.
        may_be_parameter: bool,
    },
}

/// Whether the system is usable in spite of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The system is usable, but may not mean what its author intended.
    Warning,
    /// The system is not usable.
    Error,
}

/// The text that a diagnostic's span points into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Field {
    /// [`Definition::axiom`](crate::Definition::axiom).
    Axiom,
    /// [`Definition::rules`](crate::Definition::rules).
    Rules,
    /// [`Definition::overrides`](crate::Definition::overrides).
    Overrides,
    /// A file that was read.
    File,
    /// The definition's numbers. They have no text, so the span is 0..0.
    Numbers,
}

impl Field {
    /// The field's name in reports: `axiom`, `rules`, `overrides`, `file` or `numbers`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Axiom => "axiom",
            Self::Rules => "rules",
            Self::Overrides => "overrides",
            Self::File => "file",
            Self::Numbers => "numbers",
        }
    }
}

impl Diagnostic {
    /// An error in a sentence, in no place.
    #[must_use]
    pub fn error(message: String) -> Self {
        Self {
            severity: Severity::Error,
            kind: Kind::Other,
            field: Field::Numbers,
            span: 0..0,
            message,
            hint: None,
            fix: None,
        }
    }

    /// A warning in a sentence, in no place.
    #[must_use]
    pub fn warning(message: String) -> Self {
        Self { severity: Severity::Warning, ..Self::error(message) }
    }

    /// The diagnostic with a remedy.
    #[must_use]
    pub fn hint(self, hint: impl Into<Option<String>>) -> Self {
        Self { hint: hint.into(), ..self }
    }

    /// The diagnostic with the text that is probably meant. A text with an ellipsis is an excerpt, and no fix.
    #[must_use]
    pub fn fix(self, fix: impl Into<Option<String>>) -> Self {
        Self { fix: fix.into().filter(|text| !text.contains('…')), ..self }
    }

    /// The diagnostic with its kind.
    #[must_use]
    pub fn kind(self, kind: Kind) -> Self {
        Self { kind, ..self }
    }

    /// The diagnostic with its place. Where something is missing, nothing can be replaced.
    #[must_use]
    pub fn at(self, field: Field, span: Range<usize>) -> Self {
        let fix = self.fix.filter(|_| !span.is_empty());
        Self { field, span, fix, ..self }
    }

    /// Whether the diagnostic is an error: the system is not usable.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// The diagnostic for an exceeded limit. `largest` is the largest number of derivation steps within the limit, if
    /// known.
    #[must_use]
    pub fn limit(limit: LimitName, value: u64, largest: Option<u32>) -> Self {
        let kind = Kind::Limit { limit, value, largest };
        let mebibytes = grouped(&(value >> 20).to_string());
        let value = grouped(&value.to_string());
        let message = match limit {
            LimitName::Modules => say!("A generation would have more than {} modules", value),
            LimitName::Symbols => say!("The string would be longer than {} symbols", value),
            LimitName::Segments => say!("The drawing would have more than {} segments", value),
            LimitName::Work => say!("Deriving it would pass through more than {} symbols", value),
            LimitName::PlotStrokes => say!("The plot would have more than {} strokes", value),
            LimitName::PlotBlocks => say!("The plot would be made of more than {} parts of the drawing", value),
            LimitName::Comparisons => say!("To find what is hidden would take more than {} comparisons", value),
            LimitName::Mesh => say!("The mesh would have more than {} segments and vertices of polygons", value),
            LimitName::MeshCopies => say!("Viewers would draw more than {} segments and vertices of polygons", value),
            LimitName::Memory if mebibytes == "0" => {
                say!("The drawing would take more memory than is left: less than 1 MiB")
            }
            LimitName::Memory => say!("The drawing would take more than {} MiB of memory", mebibytes),
            LimitName::Iterations => say!("There can be at most {} iterations", value),
            LimitName::Text => say!("The text is longer than {} bytes", value),
            LimitName::Letters => say!("There can be at most {} different symbols", value),
            LimitName::Parameters => say!("A module can have at most {} parameters", value),
            LimitName::Context => say!("A context can have at most {} modules", value),
            LimitName::Actions => say!("A symbol can have at most {} actions", value),
        };
        let hint = match limit {
            LimitName::PlotStrokes | LimitName::PlotBlocks | LimitName::Comparisons => {
                Some(say!("A broader pen, a smaller sheet or fewer iterations make fewer."))
            }
            LimitName::Mesh | LimitName::MeshCopies => {
                Some(say!("Fewer iterations or a larger finest part make fewer."))
            }
            _ => largest.map(|n| say!("Up to {} iterations fit.", n)),
        };
        Self::error(message).kind(kind).hint(hint)
    }
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
            let problem = problems.iter().find(|problem| problem.fix.is_some()).unwrap_or_else(|| panic!("{rules}"));
            let mut fixed = rules.to_owned();
            fixed.replace_range(problem.span.clone(), problem.fix.as_deref().unwrap_or_default());
            assert_eq!(fixed, expected);
            assert!(parse("F", &fixed).1.iter().all(|left| left.message != problem.message), "{fixed}");
        }
    }

    #[test]
    fn what_is_not_known_has_no_fix() {
        assert!(parse("F", "F").1.iter().all(|problem| problem.fix.is_none()));
    }
}
