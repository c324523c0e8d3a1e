//! Diagnostics of a text while it is read.

use crate::{Class, Diagnostic, Field};
use core::ops::Range;
use lsystem_base::say;

/// The diagnostics of one text while it is read: at most 100, sorted by place at the end. Optionally also the class of
/// each byte of the text.
#[derive(Debug)]
pub struct DiagnosticList {
    field: Field,
    list: Vec<Diagnostic>,
    left_out: usize,
    /// The look-alikes noted so far. Each is noted once.
    look_alikes: Vec<char>,
    /// By byte of the text; empty if classes are not wanted.
    classes: Vec<Class>,
}

/// The most diagnostics of one text. More do not help the reader.
const MAX: usize = 100;

impl DiagnosticList {
    /// An empty list for the text of a field.
    pub fn new(field: Field) -> Self {
        Self { field, list: Vec::new(), left_out: 0, look_alikes: Vec::new(), classes: Vec::new() }
    }

    /// An empty list that also collects the classes of `text`.
    pub fn classing(field: Field, text: &str) -> Self {
        Self { classes: vec![Class::Plain; text.len()], ..Self::new(field) }
    }

    /// Sets the class of the bytes in `span`. Later calls overwrite earlier ones.
    pub fn class(&mut self, class: Class, span: Range<usize>) {
        if let Some(part) = self.classes.get_mut(span) {
            part.fill(class);
        }
    }

    /// The class of each byte of the text.
    pub fn into_classes(self) -> Vec<Class> {
        self.classes
    }

    /// Adds an error with its remedy.
    pub fn error(&mut self, span: Range<usize>, message: String, hint: String) {
        self.add(span, Diagnostic::error(message).hint(hint));
    }

    /// Adds a warning with its remedy.
    pub fn warn(&mut self, span: Range<usize>, message: String, hint: String) {
        self.add(span, Diagnostic::warning(message).hint(hint));
    }

    /// Adds a diagnostic at this place of the text, or counts it if the list is full.
    pub fn add(&mut self, span: Range<usize>, diagnostic: Diagnostic) {
        let diagnostic = diagnostic.at(self.field, span);
        if self.list.len() < MAX {
            self.list.push(diagnostic);
            return;
        }
        self.left_out += 1;
        // An error replaces a warning, because errors decide whether the system is usable.
        if diagnostic.is_error()
            && let Some(warning) = self.list.iter_mut().rev().find(|d| !d.is_error())
        {
            *warning = diagnostic;
        }
    }

    /// Warns of a character that is read as another, once for each character.
    pub fn look_alike(&mut self, found: char, read_as: char, span: Range<usize>) {
        if !self.look_alikes.contains(&found) {
            self.look_alikes.push(found);
            let warning = if read_as == ' ' {
                Diagnostic::warning(say!("An invisible character ({}) is read as white space", code(found)))
            } else {
                let mut literal = String::new();
                crate::print::symbol(found, true, &mut literal);
                Diagnostic::warning(say!("`{}` ({}) is read as `{}`", found, code(found), read_as))
                    .hint(say!("For the character itself as a symbol write {}.", literal))
            };
            self.add(span, warning.fix(read_as.to_string()));
        }
    }

    /// Changes every listed diagnostic.
    pub fn each(&mut self, change: impl FnMut(&mut Diagnostic)) {
        self.list.iter_mut().for_each(change);
    }

    /// Whether the list is full, so that finding a hint for a further diagnostic may be wasted work.
    pub fn is_full(&self) -> bool {
        self.list.len() >= MAX
    }

    /// The diagnostics in the order of the text.
    pub fn finish(mut self) -> Vec<Diagnostic> {
        // An insertion sort suffices for so few, and is stable.
        for end in 1..self.list.len() {
            let place = |d: &Diagnostic| (d.span.start, d.span.end);
            let at = self.list[..end].partition_point(|d| place(d) <= place(&self.list[end]));
            self.list[at..=end].rotate_right(1);
        }
        if self.left_out > 0 {
            let end = self.list.last().map_or(0, |d| d.span.end);
            self.list.push(Diagnostic::warning(say!("And {} more", self.left_out)).at(self.field, end..end));
        }
        self.list
    }
}

/// `text` cut to 40 characters, with an ellipsis if cut.
pub fn excerpt(text: &str) -> String {
    const LONGEST: usize = 40;
    let text = text.trim();
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// A symbol as shown in a sentence.
pub(crate) fn named(symbol: char) -> String {
    match symbol {
        ' ' => say!("The space"),
        _ if symbol.is_whitespace() || symbol.is_control() => code(symbol),
        _ => format!("`{symbol}`"),
    }
}

fn code(ch: char) -> String {
    format!("U+{:04X}", u32::from(ch))
}

/// The candidate most similar to `word`, if one is similar enough. Only the first 256 candidates of a similar length
/// are compared.
pub fn similar<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word: Vec<char> = word.chars().map(|c| c.to_ascii_lowercase()).take(64).collect();
    /// The most candidates compared, among those of a similar length.
    const MAX: usize = 256;
    let enough = (word.len() / 3).max(1);
    let like = candidates.into_iter().filter(|c| c.chars().take(64).count().abs_diff(word.len()) <= enough);
    (like.take(MAX).map(|c| (distance(&word, c), c)))
        .filter(|(d, c)| *d <= enough && *d < c.chars().count())
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

/// Edit distance, where a swap of neighbours counts as one edit (Damerau, 1964; the restricted form).
fn distance(a: &[char], b: &str) -> usize {
    let b: Vec<char> = b.chars().map(|c| c.to_ascii_lowercase()).take(64).collect();
    let mut rows = [vec![0; b.len() + 1], (0..=b.len()).collect::<Vec<_>>(), vec![0; b.len() + 1]];
    for i in 1..=a.len() {
        rows[2][0] = i;
        for j in 1..=b.len() {
            let replace = rows[1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replace.min(rows[1][j] + 1).min(rows[2][j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[0][j - 2] + 1);
            }
            rows[2][j] = best;
        }
        rows.rotate_left(1);
    }
    rows[1][b.len()]
}
