//! Collecting the diagnostics of a text while it is read.

use crate::{Class, Diagnostic, Field, Kind};
use core::ops::Range;

/// The diagnostics of one text while it is read: bounded in number, in the order of the text at the end. Where they are
/// asked for, the classes of its parts as well.
#[derive(Debug)]
pub struct Notes {
    field: Field,
    list: Vec<Diagnostic>,
    left_out: usize,
    /// Look-alikes noted already: once each is enough.
    look_alikes: Vec<char>,
    /// By byte of the text; empty where nobody asked.
    classes: Vec<Class>,
}

/// More than this many diagnostics of one text help nobody.
const MOST: usize = 100;

impl Notes {
    /// An empty list for the text of a field.
    pub fn new(field: Field) -> Self {
        Self { field, list: Vec::new(), left_out: 0, look_alikes: Vec::new(), classes: Vec::new() }
    }

    /// The same, for the classes of `text` as well.
    pub fn classing(field: Field, text: &str) -> Self {
        Self { classes: vec![Class::Plain; text.len()], ..Self::new(field) }
    }

    /// Notes what stands at `span`; what is noted later is noted over it.
    pub fn class(&mut self, class: Class, span: Range<usize>) {
        if let Some(part) = self.classes.get_mut(span) {
            part.fill(class);
        }
    }

    /// The class of each byte of the text.
    pub fn into_classes(self) -> Vec<Class> {
        self.classes
    }

    /// Lists one diagnostic, or counts it where the list is full.
    pub fn add(&mut self, kind: Kind, span: Range<usize>) {
        let diagnostic = Diagnostic { kind, field: self.field, span };
        if self.list.len() < MOST {
            self.list.push(diagnostic);
            return;
        }
        self.left_out += 1;
        // An error must never be left out in favour of warnings: it decides whether the system can be used.
        if diagnostic.is_error()
            && let Some(warning) = self.list.iter_mut().rev().find(|d| !d.is_error())
        {
            *warning = diagnostic;
        }
    }

    /// Warns of a character that is read as another, once for each.
    pub fn look_alike(&mut self, found: char, read_as: char, span: Range<usize>) {
        if !self.look_alikes.contains(&found) {
            self.look_alikes.push(found);
            self.add(Kind::LookAlike { found, read_as }, span);
        }
    }

    /// Changes every listed diagnostic.
    pub fn each(&mut self, change: impl FnMut(&mut Diagnostic)) {
        self.list.iter_mut().for_each(change);
    }

    /// Whether a further diagnostic may not be listed, so that work on its hint would be lost.
    pub fn is_full(&self) -> bool {
        self.list.len() >= MOST
    }

    /// The diagnostics in the order of the text.
    pub fn finish(mut self) -> Vec<Diagnostic> {
        // Few enough for the simplest sort, which keeps the order of those in the same place.
        for end in 1..self.list.len() {
            let place = |d: &Diagnostic| (d.span.start, d.span.end);
            let at = self.list[..end].partition_point(|d| place(d) <= place(&self.list[end]));
            self.list[at..=end].rotate_right(1);
        }
        if self.left_out > 0 {
            let kind = Kind::More { left_out: self.left_out };
            let end = self.list.last().map_or(0, |d| d.span.end);
            self.list.push(Diagnostic { kind, field: self.field, span: end..end });
        }
        self.list
    }
}

/// `text` cut to what a message can carry.
pub fn excerpt(text: &str) -> String {
    const LONGEST: usize = 40;
    let text = text.trim();
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// The candidate most similar to `word`, if any is similar enough to be what was meant; of very many the first are looked
/// at.
pub fn similar<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word: Vec<char> = word.chars().map(|c| c.to_ascii_lowercase()).take(64).collect();
    /// Names of other lengths are passed by.
    const MOST: usize = 256;
    let enough = (word.len() / 3).max(1);
    let like = candidates.into_iter().filter(|c| c.chars().take(64).count().abs_diff(word.len()) <= enough);
    (like.take(MOST).map(|c| (distance(&word, c), c)))
        .filter(|(d, c)| *d <= enough && *d < c.chars().count())
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

/// Edit distance, a swap of neighbours counting as one (Damerau, 1964; the restricted form).
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
