//! Answers of students: links and the output of programs. Any text is read without a panic.

use crate::make;
use crate::pieces::pieces;
use crate::{Gauge, Source};
use lsystem::course::{Verdict, answers, check, exercise_in};
use lsystem::files::packed::{pack, unpack};
use lsystem::files::{read_link, read_segments};
use lsystem::{Limits, SvgOptions, System, draw, expand, write_csv, write_svg};

/// Links, readable and compressed: what is read is a valid definition.
pub(super) fn links(source: &mut Source<'_>, gauge: &mut Gauge) {
    let mut fields = String::new();
    for _ in 0..source.between(0, 12) {
        let times = if source.once_in(60) { source.pick(&[300, 30_000]) } else { 1 };
        fields.push_str(&source.pick(pieces("links")).repeat(times));
        fields.push('&');
    }
    let mut text = fields.clone();
    if source.once_in(2) {
        let mut packed = pack(fields.as_bytes());
        assert_eq!(unpack(&packed, fields.len()).as_deref(), Ok(fields.as_bytes()));
        if source.once_in(2) {
            let at = source.below(packed.len());
            packed.replace_range(at..=at, source.pick(&["A", "_", "-", "", "%", "é"]));
        }
        text = format!("#v=1&z={packed}&{}", if source.once_in(3) { &*fields } else { "" });
    }
    let link = gauge.call("link", || read_link(&text));
    assert_eq!(link, read_link(&text), "the same text gives the same link");
    let Some(link) = link else { return };
    gauge.reach("link");
    assert_eq!(link.definition.out_of_range(), [], "a link gives valid values: {text}");
    assert!(link.others.iter().all(|(key, _)| key != "z" && key != "v"));
}

/// Tables of answers: rows, cells and links of any form. An answer's share is bounded, and a marked one has its row.
pub(super) fn tables(source: &mut Source<'_>, gauge: &mut Gauge) {
    let mut text = String::new();
    for _ in 0..source.between(0, 60) {
        if source.once_in(12) {
            let letters = source.pick(&[10, 60_000, 70_000]);
            text += &format!("#v=1&z={}", pack(format!("n=4&rules={}", "F".repeat(letters)).as_bytes()));
        }
        let times = if source.once_in(60) { source.pick(&[300, 30_000]) } else { 1 };
        text += &source.pick(pieces("tables")).repeat(times);
    }
    let found = gauge.call("answers", || answers(&text, "table", "abc").collect::<Vec<_>>());
    gauge.call("exercise", || exercise_in(&text));
    for answer in &found {
        gauge.reach("answer");
        assert!(answer.by.chars().count() <= 200 && !answer.name.is_empty());
        assert!(answer.link().is_none_or(|link| read_link(link).is_some()));
    }
}

/// The output of programs for a system: right, damaged, and anything else.
pub(super) fn outputs(source: &mut Source<'_>, gauge: &mut Gauge) {
    let definition = make::definition(source);
    let mut text = output(source, &definition).unwrap_or_default();
    let is_whole = !text.is_empty() && !source.once_in(2);
    if !is_whole {
        damage(source, &mut text);
    }
    if let Some(Ok(file)) = gauge.call("read", || read_segments(&text, 1000)) {
        gauge.reach("segments");
        assert!(file.segments.iter().flatten().flatten().all(|value| value.is_finite()) && file.rounding > 0.0);
    }
    let checked = gauge.call("check", || check(&definition, &text));
    assert!(!checked.words().is_empty());
    if matches!(checked.verdict, Verdict::Symbol(_) | Verdict::Segment { .. }) {
        gauge.reach("different");
    }
    if is_whole && checked.is_right() {
        gauge.reach("right");
    }
}

/// The output of a right program, in one of three forms.
fn output(source: &mut Source<'_>, definition: &lsystem::Definition) -> Option<String> {
    let limits = Limits { symbols: 20_000, segments: 5000, work: 100_000, memory: 64 << 20, ..Limits::default() };
    let system = System::new(definition).ok()?;
    let n = definition.iterations;
    match source.below(3) {
        0 => expand(&system, n, &limits).ok(),
        form => {
            let drawing = draw(&system, n, &limits).ok()?;
            let options = SvgOptions { most: 5000, ..SvgOptions::default() };
            match form {
                1 => write_csv(&drawing, 5000).ok(),
                _ => write_svg(&drawing, &system.style, &options).ok().map(|svg| svg.text),
            }
        }
    }
}

fn damage(source: &mut Source<'_>, text: &mut String) {
    for _ in 0..source.between(1, 8) {
        let at = source.place(text);
        let end = if source.once_in(3) { source.place(text).max(at) } else { at };
        let times = if source.once_in(40) { source.pick(&[20, 3000]) } else { 1 };
        text.replace_range(at..end, &source.pick(pieces("outputs")).repeat(times));
    }
}
