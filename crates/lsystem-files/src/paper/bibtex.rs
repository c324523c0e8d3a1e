//! BibTeX entries of a system's source and of its picture.

use super::tex;
use core::fmt::Write;
use lsystem_drawing::System;
use lsystem_syntax::Definition;

/// The program's name in entries.
const PROGRAM: &str = "L-system playground";

/// A book that sources name.
struct Book {
    title: &'static str,
    author: &'static str,
    publisher: &'static str,
    year: &'static str,
}

const BOOKS: [Book; 3] = [
    Book {
        title: "The Algorithmic Beauty of Plants",
        author: "Prusinkiewicz, Przemyslaw and Lindenmayer, Aristid",
        publisher: "Springer-Verlag, New York",
        year: "1990",
    },
    Book {
        title: "Lindenmayer Systems, Fractals, and Plants",
        author: "Prusinkiewicz, Przemyslaw and Hanan, James",
        publisher: "Springer-Verlag, New York",
        year: "1989",
    },
    Book {
        title: "The Fractal Geometry of Nature",
        author: "Mandelbrot, Benoit B.",
        publisher: "W. H. Freeman, San Francisco",
        year: "1982",
    },
];

/// BibTeX entries: one of the system's source, if it has one, and one of the picture. A source like `Authors, Title
/// (year), page 9` has its parts in fields; a source of another form becomes a note.
#[must_use]
pub fn bibtex(definition: &Definition, system: &System) -> String {
    let mut text = String::new();
    let source = definition.source.trim();
    let name = slug(&definition.name);
    let suffix = if name.is_empty() { String::new() } else { format!("-{name}") };
    if !source.is_empty() {
        let (kind, stem, fields) = entry_of(source, definition.label());
        entry(&mut text, kind, &format!("{stem}{suffix}"), &fields);
        text.push('\n');
    }
    let mut fields = vec![("title", definition.label().to_owned()), ("howpublished", format!("Drawn with {PROGRAM}"))];
    let seed = if system.is_stochastic() { format!(", seed {}", definition.seed) } else { String::new() };
    let steps = if definition.iterations == 1 { "step" } else { "steps" };
    fields.push(("note", format!("L-system after {} derivation {steps}{seed}", definition.iterations)));
    fields.push(("annote", definition.notes.clone()));
    entry(&mut text, "misc", &format!("picture{suffix}"), &fields);
    text
}

/// Writes an entry. Fields without a value are left out.
fn entry(text: &mut String, kind: &str, key: &str, fields: &[(&str, String)]) {
    // Writing to a `String` cannot fail.
    let _ = write!(text, "@{kind}{{{key}");
    if fields.iter().all(|(name, value)| *name != "author" || value.is_empty()) {
        // BibTeX sorts entries without an author by this field.
        let _ = write!(text, ",\n  key = {{{key}}}");
    }
    for (name, value) in fields.iter().filter(|(_, value)| !value.trim().is_empty()) {
        let value = tex::text(value.trim());
        // Inner braces keep the capitals of titles.
        let value = if *name == "title" { format!("{{{value}}}") } else { value };
        let _ = write!(text, ",\n  {name} = {{{value}}}");
    }
    text.push_str("\n}\n");
}

/// The kind, the start of the key, and the fields of a source's entry.
fn entry_of(source: &str, label: &str) -> (&'static str, String, Vec<(&'static str, String)>) {
    let cited = cited(source);
    let named = |book: &&Book| match &cited {
        Some(Cited { authors: Some(_), title, .. }) => *title == book.title,
        _ => source.contains(book.title),
    };
    if let Some(book) = BOOKS.iter().find(named) {
        let rest = match &cited {
            Some(Cited { authors: Some(_), rest, .. }) => *rest,
            _ => source,
        };
        let (pages, note) = pages(rest);
        let fields = vec![
            ("author", book.author.to_owned()),
            ("title", book.title.to_owned()),
            ("publisher", book.publisher.to_owned()),
            ("year", book.year.to_owned()),
            ("pages", pages.clone()),
            ("note", note),
        ];
        // A part of a book needs pages.
        let kind = if pages.is_empty() { "book" } else { "inbook" };
        let last = book.author.split(',').next().unwrap_or_default();
        return (kind, format!("{}{}", slug(last), book.year), fields);
    }
    match cited {
        Some(Cited { authors, title, venue, year, rest }) if authors.is_some() || rest.is_empty() => {
            let authors = authors.unwrap_or_default();
            let first = authors.split(" and ").next().unwrap_or_default();
            let last = first.split_whitespace().last().or(title.split_whitespace().next()).unwrap_or_default();
            let (pages, note) = pages(rest);
            let fields = vec![
                ("author", authors.to_owned()),
                ("title", title.to_owned()),
                ("howpublished", venue.to_owned()),
                ("year", year.to_owned()),
                ("pages", pages),
                ("note", note),
            ];
            ("misc", format!("{}{year}", slug(last)), fields)
        }
        _ => ("misc", "source".into(), vec![("title", label.to_owned()), ("note", source.to_owned())]),
    }
}

/// The parts of a source like `Authors, Title (venue, year), rest`.
struct Cited<'a> {
    authors: Option<&'a str>,
    title: &'a str,
    /// What stands before the year in the parentheses, such as a magazine and a month.
    venue: &'a str,
    year: &'a str,
    rest: &'a str,
}

fn cited(source: &str) -> Option<Cited<'_>> {
    let (head, behind) = source.split_once(" (")?;
    let (inside, rest) = behind.split_once(')')?;
    let year = inside.get(inside.len().checked_sub(4)?..).filter(|year| year.bytes().all(|b| b.is_ascii_digit()))?;
    let venue = inside[..inside.len() - 4].trim_end_matches([' ', ',']);
    let rest = rest.trim_start_matches([',', ';', ' ']);
    let (authors, title) = match head.split_once(", ") {
        Some((authors, title)) if authors.split(" and ").all(is_name) => (Some(authors), title),
        _ => (None, head),
    };
    Some(Cited { authors, title, venue, year, rest })
}

/// Whether words are probably a person's name: at most four capitalised words, perhaps with particles, that do not
/// begin as titles do. This is a guess.
fn is_name(words: &str) -> bool {
    const PARTICLES: [&str; 7] = ["von", "van", "de", "der", "den", "la", "ten"];
    const NO_NAMES: [&str; 12] =
        ["A", "After", "An", "Assignment", "Course", "Exercise", "Figure", "From", "In", "Lecture", "Practical", "The"];
    let capital = |word: &str| word.chars().next().is_some_and(char::is_uppercase);
    let letters = |word: &str| word.chars().all(|c| c.is_alphabetic() || matches!(c, '.' | '-' | '\''));
    let count = words.split(' ').count();
    (1..=4).contains(&count)
        && words.split(' ').all(|word| letters(word) && (capital(word) || PARTICLES.contains(&word)))
        && words.split(' ').next().is_some_and(|first| !NO_NAMES.contains(&first))
        && words.split(' ').next_back().is_some_and(capital)
}

/// The page numbers in a text such as `figure 1.7a, page 9 (after Mandelbrot)`, and the text without them, as a note.
fn pages(rest: &str) -> (String, String) {
    let mut pages = String::new();
    let mut note: Vec<String> = Vec::new();
    for part in rest.split(", ") {
        let numbers = part.strip_prefix("pages ").or(part.strip_prefix("page "));
        let end = numbers.map_or(0, |n| n.find(|c: char| !c.is_ascii_digit() && !"-–".contains(c)).unwrap_or(n.len()));
        match numbers {
            Some(numbers) if end > 0 && pages.is_empty() => {
                pages = numbers[..end].replace(['-', '–'], "--");
                let more = numbers[end..].trim();
                match note.last_mut() {
                    _ if more.is_empty() => {}
                    Some(last) => last.push_str(&format!(" {more}")),
                    None => note.push(more.to_owned()),
                }
            }
            _ => note.push(part.to_owned()),
        }
    }
    let note = note.join(", ");
    let mut letters = note.chars();
    let note = letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default();
    (pages, note)
}

/// A text as a part of a key: ASCII letters, digits, points and hyphens.
pub(super) fn slug(text: &str) -> String {
    let mut slug = String::new();
    for c in text.chars().flat_map(char::to_lowercase) {
        match c {
            'a'..='z' | '0'..='9' | '.' => slug.push(c),
            'à'..='å' => slug.push('a'),
            'ç' => slug.push('c'),
            'è'..='ë' => slug.push('e'),
            'ì'..='ï' => slug.push('i'),
            'ñ' | 'ń' => slug.push('n'),
            'ò'..='ö' | 'ø' => slug.push('o'),
            'ù'..='ü' => slug.push('u'),
            'ł' => slug.push('l'),
            'ß' => slug.push_str("ss"),
            _ if slug.is_empty() || slug.ends_with('-') => {}
            _ => slug.push('-'),
        }
    }
    slug.trim_end_matches('-').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};

    fn written(definition: &Definition) -> String {
        bibtex(definition, &System::new(definition).0.unwrap())
    }

    fn check(source: &str, expected: &Expect) {
        let definition = Definition { name: "1.7a".into(), source: source.into(), ..Definition::default() };
        expected.assert_eq(written(&definition).split("\n\n").next().unwrap());
    }

    #[test]
    fn a_page_of_a_book_and_a_picture() {
        let definition = Definition {
            name: "1.7a".into(),
            title: "50% of {an} island".into(),
            source: "Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants (1990), figure 1.7a, page 9 (after Mandelbrot)".into(),
            notes: "Notes & more".into(),
            axiom: "F".into(),
            rules: "F -> FF : 1\nF -> F : 2".into(),
            iterations: 2,
            seed: 3,
            ..Definition::default()
        };
        expect![[r#"
            @inbook{prusinkiewicz1990-1.7a,
              author = {Prusinkiewicz, Przemyslaw and Lindenmayer, Aristid},
              title = {{The Algorithmic Beauty of Plants}},
              publisher = {Springer-Verlag, New York},
              year = {1990},
              pages = {9},
              note = {Figure 1.7a (after Mandelbrot)}
            }

            @misc{picture-1.7a,
              key = {picture-1.7a},
              title = {{50\% of \textbraceleft{}an\textbraceright{} island}},
              howpublished = {Drawn with L-system playground},
              note = {L-system after 2 derivation steps, seed 3},
              annote = {Notes \& more}
            }
        "#]]
        .assert_eq(&written(&definition));
    }

    #[test]
    fn sources() {
        check(
            "After figure 1.27 of The Algorithmic Beauty of Plants (1990), with widths",
            &expect![[r#"
            @book{prusinkiewicz1990-1.7a,
              author = {Prusinkiewicz, Przemyslaw and Lindenmayer, Aristid},
              title = {{The Algorithmic Beauty of Plants}},
              publisher = {Springer-Verlag, New York},
              year = {1990},
              note = {After figure 1.27 of The Algorithmic Beauty of Plants (1990), with widths}
            }"#]],
        );
        check(
            "Wacław Sierpiński, Sur une nouvelle courbe continue qui remplit toute une aire plane (1912)",
            &expect![[r#"
            @misc{sierpinski1912-1.7a,
              author = {Wacław Sierpiński},
              title = {{Sur une nouvelle courbe continue qui remplit toute une aire plane}},
              year = {1912}
            }"#]],
        );
        check(
            "McWorter and Tazelaar, Creating Fractals (Byte, August 1987)",
            &expect![[r#"
            @misc{mcworter1987-1.7a,
              author = {McWorter and Tazelaar},
              title = {{Creating Fractals}},
              howpublished = {Byte, August},
              year = {1987}
            }"#]],
        );
        check(
            "Lecture Computer Graphics, Assignment 8: Lindenmayer Systems (2019)",
            &expect![[r#"
            @misc{lecture2019-1.7a,
              key = {lecture2019-1.7a},
              title = {{Lecture Computer Graphics, Assignment 8: Lindenmayer Systems}},
              year = {2019}
            }"#]],
        );
        check(
            "Four of P. Lévy's curves (1938) around a square",
            &expect![[r#"
            @misc{source-1.7a,
              key = {source-1.7a},
              title = {{1.7a}},
              note = {Four of P. Lévy's curves (1938) around a square}
            }"#]],
        );
        check(
            "(",
            &expect![[r#"
            @misc{source-1.7a,
              key = {source-1.7a},
              title = {{1.7a}},
              note = {(}
            }"#]],
        );
        check(
            "x (é90)",
            &expect![[r#"
            @misc{source-1.7a,
              key = {source-1.7a},
              title = {{1.7a}},
              note = {x (é90)}
            }"#]],
        );
    }

    #[test]
    fn without_a_source() {
        expect![[r#"
            @misc{picture,
              key = {picture},
              howpublished = {Drawn with L-system playground},
              note = {L-system after 1 derivation step}
            }
        "#]]
        .assert_eq(&written(&Definition::default()));
    }
}
