//! Words of symbols in the files of cpfg and L-Py.

use lsystem_syntax::Query;

/// One of the two programs.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Cpfg,
    LPy,
}

/// The symbols of a word without their arguments.
pub(super) fn without_arguments(word: &str) -> String {
    let mut is_inside = false;
    let outside = word.chars().filter(|c| {
        is_inside |= *c == '(';
        let keeps = !is_inside;
        is_inside &= *c != ')';
        keeps
    });
    outside.collect()
}

/// A symbol with arguments.
pub(super) fn numbered(symbol: char, arguments: &[String]) -> String {
    let name = Query::of_symbol(symbol).map_or_else(|| symbol.to_string(), |query| query.to_string());
    if arguments.is_empty() { name } else { format!("{name}({})", arguments.join(",")) }
}

/// A word on its way into a file.
pub(super) struct Words {
    kind: Kind,
    pub(super) text: String,
}

impl Words {
    pub(super) fn new(kind: Kind) -> Self {
        Self { kind, text: String::new() }
    }

    /// Appends a symbol. L-Py has symbols of several letters, such as `nF` and `EB`, which a blank prevents.
    pub(super) fn push(&mut self, next: &str) {
        let pair = (self.text.chars().next_back(), next.chars().next());
        if let (Kind::LPy, (Some(a), Some(b))) = (self.kind, pair)
            && a.is_ascii_alphabetic()
            && b.is_ascii_alphabetic()
        {
            self.text.push(' ');
        }
        self.text.push_str(next);
    }
}
