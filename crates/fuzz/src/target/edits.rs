//! New values in files of all encodings and layouts: the rest of the file stays.

use crate::make::{self, change_field};
use crate::{Gauge, Source};
use lsystem::files::edit_file;
use lsystem::{Definition, read_file, read_json, write_json};

/// A file with comments and keys of others, and a system that replaces its own.
pub(super) fn edits(source: &mut Source<'_>, gauge: &mut Gauge) {
    let first = make::definition(source);
    let (text, notes) = decorated(source, &write_json(&first));
    let units = |text: &str, write: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(write).collect::<Vec<u8>>();
    let encode: &dyn Fn(&str) -> Vec<u8> = match source.below(4) {
        0 => &|text| text.into(),
        1 => &|text| format!("\u{feff}{text}").into(),
        2 => &|text| units(&format!("\u{feff}{text}"), u16::to_le_bytes),
        _ => &|text| units(&format!("\u{feff}{text}"), u16::to_be_bytes),
    };
    let bytes = encode(&text);
    let Some(former) = read_file(&bytes).definition else { return };
    gauge.reach("read");
    let definition = changed(source, &former);
    let Some(edited) = gauge.call("edit", || edit_file(&bytes, &definition)) else {
        // Only a comment may be in the way of a system that a file can hold.
        let can_be_held = read_json(&write_json(&definition)).0.as_ref() == Some(&definition);
        assert!(!can_be_held || notes.iter().any(|note| note.starts_with('/')), "not edited:\n{text}\n{definition:?}");
        return;
    };
    gauge.reach("edited");
    assert_eq!(read_file(&edited).definition.as_ref(), Some(&definition), "{text}");
    let after = plain(&edited);
    assert!(edited == encode(&after), "the encoding stays");
    let mut rest = &after[..];
    for note in &notes {
        let at = rest.find(note).unwrap_or_else(|| panic!("{note} is gone:\n{text}\n{after}"));
        rest = &rest[at + note.len()..];
    }
    if former == definition {
        assert_eq!(edited, bytes);
    } else if one_value(&former, &definition) {
        gauge.reach("one value");
        let start = text.bytes().zip(after.bytes()).take_while(|(a, b)| a == b).count();
        let same_end = text.bytes().rev().zip(after.bytes().rev()).take_while(|(a, b)| a == b).count();
        let replaced = text.as_bytes().get(start..text.len() - same_end).unwrap_or_default();
        assert!(!replaced.iter().any(|byte| b"\r\n:".contains(byte)), "more than a value:\n{text}\n{after}");
    }
}

/// Whether two systems differ in the number of iterations, the angle or the seed only.
fn one_value(former: &Definition, definition: &Definition) -> bool {
    let Definition { iterations, angle, seed, .. } = *former;
    let changes = [iterations != definition.iterations, angle != definition.angle, seed != definition.seed];
    changes.iter().filter(|&&is_changed| is_changed).count() == 1
        && *former == Definition { iterations, angle, seed, ..definition.clone() }
}

/// A system with some other values.
fn changed(source: &mut Source<'_>, former: &Definition) -> Definition {
    let mut definition = former.clone();
    let other = make::definition(source);
    for _ in 0..source.pick(&[1, 1, 1, 2, 5]) {
        match source.below(9) {
            0 => definition.iterations = other.iterations,
            1 => definition.angle = other.angle,
            2 => definition.rules.clone_from(&other.rules),
            3 => definition.axiom.clone_from(&other.axiom),
            4 => definition.overrides.clone_from(&other.overrides),
            5 => definition.title = "a \"title\" \u{e9}\u{1f33f}".into(),
            6 => {
                let mut lines: Vec<&str> = former.rules.split('\n').collect();
                let line = source.below(lines.len());
                match source.below(3) {
                    0 => drop(lines.remove(line)),
                    1 => lines.insert(line, "F -> F"),
                    _ => lines[line] = "G -> GF",
                }
                definition.rules = lines.join("\n");
            }
            _ => change_field(source, &mut definition),
        }
    }
    definition
}

/// A JSON text in another layout, with comments and keys of others; and these, in order.
fn decorated(source: &mut Source<'_>, text: &str) -> (String, Vec<String>) {
    let is_one_line = source.once_in(4);
    let has_comments = source.once_in(2);
    let line_ends: &[&str] = source.pick(&[&["\n"][..], &["\r\n"], &["\r"], &["\n", "\r\n"]]);
    let (mut decorated, mut notes) = (String::new(), Vec::new());
    for (number, line) in text.lines().enumerate() {
        decorated += if is_one_line { line.trim_start() } else { line };
        if number == 0 && source.once_in(2) {
            notes.push(format!("\"own\": [{number}, {{\"step\": 1}}]"));
            decorated += &format!("\"num_iters\": 77, {},", notes[notes.len() - 1]);
        }
        if has_comments && source.once_in(4) {
            let is_block = is_one_line || source.once_in(2);
            notes.push(if is_block { format!("/* {number} */") } else { format!("// {number} of all") });
            decorated += &format!(" {}", notes[notes.len() - 1]);
        }
        decorated += if is_one_line { source.pick(&["", " "]) } else { source.pick(line_ends) };
    }
    (decorated, notes)
}

/// The text in a file, without its mark.
fn plain(bytes: &[u8]) -> String {
    let units = |read: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes.chunks_exact(2).map(|pair| read([pair[0], pair[1]])).collect();
        String::from_utf16_lossy(&units)
    };
    let text = match bytes {
        [0xff, 0xfe, ..] => units(u16::from_le_bytes),
        [0xfe, 0xff, ..] => units(u16::from_be_bytes),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    };
    text.trim_start_matches('\u{feff}').to_owned()
}
