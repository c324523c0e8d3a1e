//! Texts in the notations of other programs: any text is read without a panic, and every system of the result compiles.

use crate::pieces::pieces;
use crate::{Gauge, Source, make, told};
use lsystem::System;
use lsystem::base::MAX_TEXT;
use lsystem::import::import;

/// Texts of every notation, mixed and damaged.
pub(super) fn import_text(source: &mut Source<'_>, gauge: &mut Gauge) {
    let text = text(source);
    let found = gauge.call("import", || import(&text));
    let again = import(&text);
    assert_eq!(found, again, "the same text gives the same systems");
    let Some(imported) = found else { return };
    assert!(!imported.entries.is_empty());
    gauge.reach(imported.notation);
    let mut at = 0;
    for part in &imported.account {
        assert!(part.span.start == at && part.span.end > at && text.is_char_boundary(part.span.end), "{part:?}");
        at = part.span.end;
    }
    assert_eq!(at, text.len(), "the account covers the text");
    let lines = text.matches(['\n', '\r']).count() + 1;
    for entry in &imported.entries {
        let refused = entry.remarks.iter().any(|remark| remark.refused);
        assert_eq!(refused, entry.definition.is_none(), "a system is refused with a reason: {entry:?}");
        assert!(entry.remarks.iter().all(|remark| (1..=lines).contains(&remark.line)), "{:?}", entry.remarks);
        entry.remarks.iter().for_each(|remark| told::check(&remark.message));
        if let Some(definition) = &entry.definition {
            gauge.reach("read");
            assert!(System::new(definition).is_ok(), "{definition:?} does not compile");
        }
    }
}

/// The page's worker is ended after four seconds.
const LONG_STEPS: u32 = 4000 / 8;

/// Texts of up to 1 MiB that repeat a part of a notation, each time with other names: work that grows faster than the
/// text shows.
pub(super) fn long_texts(source: &mut Source<'_>, gauge: &mut Gauge) {
    let whole = source.pick(pieces("whole imports"));
    let (from, to) = (source.place(whole), source.place(whole));
    let (before, part, after) = match source.below(3) {
        0 => ("", whole, ""),
        1 => ("", source.pick(pieces("imports")), whole),
        _ => (&whole[..from.min(to)], &whole[from.min(to)..from.max(to)], &whole[from.max(to)..]),
    };
    // Mostly short, so that there are many.
    let most = MAX_TEXT >> source.pick(&[0, 2, 4, 4, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7]);
    let most = most.saturating_sub(before.len() + after.len());
    let names = source.below(4);
    let mut text = before.to_owned();
    for number in 0.. {
        // Letters, numbers and words in turn, so that lists of each grow.
        let part = match names {
            1 => part.replace(['F', 'X', 'A'], &char::from_u32(0x4e00 + number % 20_000).unwrap_or('F').to_string()),
            2 => part.replace(|c: char| c.is_ascii_digit(), &number.to_string()),
            3 => part.replace(['F', 'X', 'A'], &format!("n{number}")),
            _ => part.to_owned(),
        };
        if part.is_empty() || text.len() + part.len() > most {
            break;
        }
        text += &part;
    }
    text += after;
    source.show(format_args!("{} bytes of {part:?} after {before:?}", text.len()));
    if let Some(imported) = gauge.long_call("import", LONG_STEPS, || import(&text)) {
        gauge.reach(imported.notation);
        let end = imported.account.last().map(|part| part.span.end);
        assert_eq!(end, Some(text.len()), "the account ends with the text");
    }
}

fn text(source: &mut Source<'_>) -> String {
    let mut text = String::new();
    for _ in 0..source.between(1, 3) {
        text.push_str(source.pick(pieces("whole imports")));
    }
    make::damage(source, &mut text, pieces("imports"), 12);
    text
}
