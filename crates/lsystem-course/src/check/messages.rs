//! Checks in words.

use super::{Check, Output, SymbolDifference, Verdict};
use lsystem_base::words::grouped;
use lsystem_base::{counted, say};

impl Check {
    /// The result in words: a sentence, and lines that show the difference.
    #[must_use]
    pub fn words(&self) -> String {
        let n = self.generation;
        let is_text = self.output == Output::Text;
        let found = self.found;
        let counts = match self.expected {
            Some(expected) if expected != u128::from(found) => {
                let expected = grouped(&expected.to_string());
                if is_text {
                    counted!(
                        found,
                        "The output has {} symbol; generation {} has {}.",
                        "The output has {} symbols; generation {} has {}.",
                        n,
                        expected
                    )
                } else {
                    counted!(
                        found,
                        "The output has {} segment; generation {} has {}.",
                        "The output has {} segments; generation {} has {}.",
                        n,
                        expected
                    )
                }
            }
            _ if is_text => counted!(found, "Both have {} symbol.", "Both have {} symbols."),
            _ => counted!(found, "Both have {} segment.", "Both have {} segments."),
        };
        match &self.verdict {
            Verdict::Same if is_text => counted!(
                found,
                "The string is that of generation {1}: {0} symbol.",
                "The string is that of generation {1}: {0} symbols.",
                n
            ),
            Verdict::Same => counted!(
                found,
                "The segments are those of generation {1}, in the same order: {0} segment.",
                "The segments are those of generation {1}, in the same order: {0} segments.",
                n
            ),
            Verdict::Reordered => say!(
                "The picture is that of generation {}. Its segments are in another order or repeated. {}",
                n,
                counts
            ),
            Verdict::Placed { degrees: 180, is_mirrored: true } => {
                let words = say!("The picture is that of generation {}, but upside down.", n);
                if self.output == Output::Svg { format!("{words} {}", say!("In SVG, y points down.")) } else { words }
            }
            Verdict::Placed { degrees: 0, .. } => {
                say!("The picture is that of generation {}, but mirrored left to right.", n)
            }
            Verdict::Placed { degrees, is_mirrored: true } => say!(
                "The picture is that of generation {}, but mirrored left to right and turned by {} degrees.",
                n,
                degrees
            ),
            Verdict::Placed { degrees, .. } => {
                say!("The picture is that of generation {}, but turned by {} degrees.", n, degrees)
            }
            Verdict::Generation(other) => say!("The output is generation {}, not generation {}. {}", other, n, counts),
            Verdict::OneAfterAnother => say!(
                "In each step the rules were applied one after another. All symbols must be replaced at once. {}",
                counts
            ),
            Verdict::Symbol(difference) => format!("{}\n{counts}", symbol_words(difference, n)),
            Verdict::Segment { index, expected, found } => {
                let number = grouped(&(index + 1).to_string());
                format!(
                    "{}\n  {}\n  {}\n{counts}",
                    say!("Segment {} is the first that differs from generation {}.", number, n),
                    say!("expected: {}", segment_words(expected.as_ref())),
                    say!("found:    {}", segment_words(found.as_ref())),
                )
            }
            Verdict::Unreadable(reason) => say!("The output cannot be read: {}.", reason),
            Verdict::Failed(diagnostics) => {
                let messages: Vec<String> = diagnostics.iter().map(|problem| problem.message.clone()).collect();
                say!("The system cannot be compared. {}", messages.join(" "))
            }
        }
    }
}

fn symbol_words(difference: &SymbolDifference, n: u32) -> String {
    let SymbolDifference { index, before, expected, found, made_by } = difference;
    let number = grouped(&(index + 1).to_string());
    let start = if *index as usize > before.chars().count() { "…" } else { "" };
    let line = |text: &str| format!("{start}{before}{}", if text.is_empty() { say!("(end)") } else { text.to_owned() });
    let indent = say!("expected: {}", "").chars().count() + start.chars().count() + before.chars().count();
    let made = match made_by {
        Some((generation, production)) => {
            format!("\n{}", say!("Step {} makes the expected symbol by {}", generation, production))
        }
        None => String::new(),
    };
    format!(
        "{}\n  {}\n  {}\n  {}^{made}",
        say!("Symbol {} is the first that differs from generation {}.", number, n),
        say!("expected: {}", line(expected)),
        say!("found:    {}", line(found)),
        " ".repeat(indent),
    )
}

fn segment_words(segment: Option<&[[f64; 3]; 2]>) -> String {
    let Some(segment) = segment else { return say!("(no more segments)") };
    let is_flat = segment[0][2] == 0.0 && segment[1][2] == 0.0;
    let point = |[x, y, z]: [f64; 3]| {
        let values = if is_flat { vec![x, y] } else { vec![x, y, z] };
        // Six digits distinguish points of a picture.
        let values: Vec<String> =
            values.into_iter().map(|value| format!("{}", libm::round(value * 1e6) / 1e6)).collect();
        format!("({})", values.join(", "))
    };
    say!("{} to {}", point(segment[0]), point(segment[1]))
}
