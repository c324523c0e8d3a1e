//! Checks in words.

use super::{Check, Output, SymbolDifference, Verdict};
use lsystem_syntax::message::grouped;

impl Check {
    /// The result in words: a sentence, and lines that show the difference.
    #[must_use]
    pub fn words(&self) -> String {
        let n = self.generation;
        let things = match self.output {
            Output::Text => "symbols",
            Output::Svg | Output::Table => "segments",
        };
        let (found, expected) =
            (grouped(&self.found.to_string()), self.expected.map(|count| grouped(&count.to_string())));
        let counts = match &expected {
            Some(expected) if *expected != found => {
                format!("The output has {found} {things}; generation {n} has {expected}.")
            }
            _ => format!("Both have {found} {things}."),
        };
        match &self.verdict {
            Verdict::Same if self.output == Output::Text => {
                format!("The string is that of generation {n}: {found} symbols.")
            }
            Verdict::Same => format!("The segments are those of generation {n}, in the same order: {found} segments."),
            Verdict::Reordered => {
                format!(
                    "The picture is that of generation {n}. Its segments are in another order or repeated. {counts}"
                )
            }
            Verdict::Placed { degrees: 180, is_mirrored: true } => {
                let reason = if self.output == Output::Svg { " In SVG, y points down." } else { "" };
                format!("The picture is that of generation {n}, but upside down.{reason}")
            }
            Verdict::Placed { degrees, is_mirrored } => {
                let mirrored = if *is_mirrored { "mirrored left to right" } else { "" };
                let turned = if *degrees > 0 { format!("turned by {degrees} degrees") } else { String::new() };
                let and = if *is_mirrored && *degrees > 0 { " and " } else { "" };
                format!("The picture is that of generation {n}, but {mirrored}{and}{turned}.")
            }
            Verdict::Generation(other) => format!("The output is generation {other}, not generation {n}. {counts}"),
            Verdict::OneAfterAnother => format!(
                "In each step the rules were applied one after another. All symbols must be replaced at once. {counts}"
            ),
            Verdict::Symbol(difference) => format!("{}\n{counts}", symbol_words(difference, n)),
            Verdict::Segment { index, expected, found } => {
                let number = grouped(&(index + 1).to_string());
                format!(
                    "Segment {number} is the first that differs from generation {n}.\n  expected: {}\n  found:    {}\n{counts}",
                    segment_words(expected.as_ref()),
                    segment_words(found.as_ref()),
                )
            }
            Verdict::Unreadable(reason) => format!("The output cannot be read: {reason}."),
            Verdict::Failed(diagnostics) => {
                let messages: Vec<String> = diagnostics.iter().map(lsystem_syntax::Diagnostic::message).collect();
                format!("The system cannot be compared. {}", messages.join(" "))
            }
        }
    }
}

fn symbol_words(difference: &SymbolDifference, n: u32) -> String {
    let SymbolDifference { index, before, expected, found, made_by } = difference;
    let number = grouped(&(index + 1).to_string());
    let start = if *index as usize > before.chars().count() { "…" } else { "" };
    let end = |text: &str| if text.is_empty() { "(end)".to_owned() } else { text.to_owned() };
    let place = " ".repeat(start.chars().count() + before.chars().count());
    let made = match made_by {
        Some((generation, production)) => format!("\nStep {generation} makes the expected symbol by {production}"),
        None => String::new(),
    };
    format!(
        "Symbol {number} is the first that differs from generation {n}.\n  expected: {start}{before}{}\n  found:    \
         {start}{before}{}\n            {place}^{made}",
        end(expected),
        end(found),
    )
}

fn segment_words(segment: Option<&[[f64; 3]; 2]>) -> String {
    let Some(segment) = segment else { return "(no more segments)".to_owned() };
    let is_flat = segment[0][2] == 0.0 && segment[1][2] == 0.0;
    let point = |[x, y, z]: [f64; 3]| {
        let values = if is_flat { vec![x, y] } else { vec![x, y, z] };
        // Six digits distinguish points of a picture.
        let values: Vec<String> =
            values.into_iter().map(|value| format!("{}", libm::round(value * 1e6) / 1e6)).collect();
        format!("({})", values.join(", "))
    };
    format!("{} to {}", point(segment[0]), point(segment[1]))
}
