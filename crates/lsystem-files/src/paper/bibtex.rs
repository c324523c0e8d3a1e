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
    /// The authors as sources name them.
    cited_as: &'static str,
    publisher: &'static str,
    year: &'static str,
}

const BOOKS: [Book; 3] = [
    Book {
        title: "The Algorithmic Beauty of Plants",
        author: "Prusinkiewicz, Przemyslaw and Lindenmayer, Aristid",
        cited_as: "Prusinkiewicz and Lindenmayer",
        publisher: "Springer-Verlag, New York",
        year: "1990",
    },
    Book {
        title: "Lindenmayer Systems, Fractals, and Plants",
        author: "Prusinkiewicz, Przemyslaw and Hanan, James",
        cited_as: "Prusinkiewicz and Hanan",
        publisher: "Springer-Verlag, New York",
        year: "1989",
    },
    Book {
        title: "The Fractal Geometry of Nature",
        author: "Mandelbrot, Benoit B.",
        cited_as: "Benoit Mandelbrot",
        publisher: "W. H. Freeman, San Francisco",
        year: "1982",
    },
];

/// BibTeX entries: one of the system's source, if it has one, and one of the picture. A source in a
/// known book has its parts in fields; any other source is a note.
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
    // A book that stands behind the first year is not the source itself.
    let cited = source.split(" (").next().unwrap_or_default();
    let Some(book) = BOOKS.iter().find(|book| cited.contains(book.title)) else {
        return ("misc", "source".into(), vec![("title", label.to_owned()), ("note", source.to_owned())]);
    };
    let cited = format!("{} ({})", book.title, book.year);
    // The book's own names and title are in fields; a source that names it in other words stays as it is.
    let rest = match source.split_once(&cited) {
        Some((authors, rest)) if authors.trim_end_matches([',', ' ']) == book.cited_as => {
            rest.trim_start_matches([',', ';', ' '])
        }
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
    (kind, format!("{}{}", slug(last), book.year), fields)
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
        bibtex(definition, &System::new(definition).unwrap())
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
            "McWorter and Tazelaar, Creating Fractals (Byte, August 1987)",
            &expect![[r#"
            @misc{source-1.7a,
              key = {source-1.7a},
              title = {{1.7a}},
              note = {McWorter and Tazelaar, Creating Fractals (Byte, August 1987)}
            }"#]],
        );
        check(
            "Roger Penrose, Pentaplexity (1979); after Lindenmayer Systems, Fractals, and Plants (1989)",
            &expect![[r#"
            @misc{source-1.7a,
              key = {source-1.7a},
              title = {{1.7a}},
              note = {Roger Penrose, Pentaplexity (1979); after Lindenmayer Systems, Fractals, and Plants (1989)}
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
