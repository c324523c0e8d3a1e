//! Files for papers: figures and typeset systems that LaTeX and viewers can read.

use super::drawing::flat;
use crate::{Gauge, Source, make};
use lsystem::files::{Content, FORMATS, FileOptions, Format, Purpose};
use lsystem::plot::Sheet;
use lsystem::{read_file, write_json};
use miniz_oxide::inflate::decompress_to_vec_zlib;

/// The most segments of a file in this target.
const MAX: u64 = 20_000;

/// Writes a random system in every format for papers.
pub(super) fn papers(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((mut definition, system)) = make::system(source) else { return };
    if source.once_in(3) {
        let words = ["{", "}", "%", "\\", "$", "é", "🌿", "a_b^c", "\n", "*", "&"];
        definition.title = (0..source.between(1, 6)).map(|_| source.pick(&words)).collect();
    }
    let options = FileOptions {
        title: definition.title.clone(),
        system: write_json(&definition),
        most: MAX,
        sheet: Sheet { margin: source.pick(&[10.0, 0.0, 500.0]), ..Sheet::default() },
        is_cropped: source.once_in(2),
        ..FileOptions::default()
    };
    for format in FORMATS.iter().filter(|format| format.purposes.contains(&Purpose::Paper)) {
        if let Content::Words(write) = format.content {
            let written = gauge.file(format.name, usize::MAX, |sink| write(&definition, &system, &options, sink));
            let Ok((file, _)) = written else { continue };
            check_words(format, &file);
        }
    }
    let Some(drawing) = flat(source, &system, definition.iterations, gauge) else { return };
    for format in FORMATS.iter().filter(|format| format.purposes.contains(&Purpose::Paper)) {
        if let Content::Paper(write) = format.content {
            let written =
                gauge.file(format.name, usize::MAX, |sink| write(drawing.clone(), &system.style, &options, sink));
            let Ok((file, _)) = written else { continue };
            gauge.reach(format.name);
            match format.name {
                "pdf" => check_pdf(&file, &options.system),
                _ => check_figure(&file),
            }
        }
    }
}

/// Checks a typeset system.
fn check_words(format: &Format, file: &[u8]) {
    let text = core::str::from_utf8(file).expect("UTF-8");
    assert!(!text.is_empty() && text.ends_with('\n'), "{}: {text:?}", format.name);
    for word in ["= NaN", "= inf", "= -inf"] {
        assert!(!text.contains(word), "{}: a number that is not finite in {text}", format.name);
    }
    if format.ending != "md" {
        check_braces(text);
    }
}

/// Checks that the braces, brackets of math and environments of a text for TeX are balanced.
fn check_braces(text: &str) {
    let (mut depth, mut dollars) = (0_u32, 0);
    for line in text.lines() {
        let mut characters = line.chars();
        while let Some(character) = characters.next() {
            match character {
                '\\' => drop(characters.next()),
                '%' => break,
                '{' => depth += 1,
                '}' => depth = depth.checked_sub(1).unwrap_or_else(|| panic!("a brace closes nothing: {line}")),
                '$' => dollars += 1,
                _ => {}
            }
        }
    }
    assert!(depth == 0 && dollars % 2 == 0, "{depth} open braces, {dollars} dollar signs in {text}");
    assert_eq!(text.matches("\\begin{").count(), text.matches("\\end{").count(), "environments in {text}");
}

/// Checks a TikZ picture: balanced, with finite numbers.
fn check_figure(file: &[u8]) {
    let text = core::str::from_utf8(file).expect("UTF-8");
    check_braces(text);
    for line in text.lines().filter(|line| !line.trim_start().starts_with('%')) {
        for point in line.split('(').skip(1).filter_map(|rest| rest.split_once(')')).map(|(point, _)| point) {
            let mut numbers = point.split(',').map(|word| word.trim_end_matches("mm").parse::<f64>());
            assert!(numbers.all(|number| number.is_ok_and(f64::is_finite)), "no point: {line}");
        }
    }
}

/// Checks a PDF: complete, with its system, and with finite numbers in all streams of content.
fn check_pdf(file: &[u8], system: &str) {
    assert!(file.starts_with(b"%PDF-") && file.trim_ascii_end().ends_with(b"%%EOF"));
    let found = read_file(file).definition.map(|definition| write_json(&definition));
    assert_eq!(found.as_deref(), Some(system), "the system in the file");
    let mut rest = file;
    while let Some(at) = find(rest, b"/FlateDecode") {
        let Some(start) = find(&rest[at..], b"stream\n").map(|start| at + start + b"stream\n".len()) else { break };
        let end = start + find(&rest[start..], b"endstream").expect("the end of a stream");
        if let Ok(content) = decompress_to_vec_zlib(&rest[start..end]) {
            let text = String::from_utf8_lossy(&content);
            let bad = text.split_ascii_whitespace().find(|word| ["NaN", "inf", "-inf"].contains(word));
            assert_eq!(bad, None, "a number that is not finite in PDF");
        }
        rest = &rest[end..];
    }
}

fn find(bytes: &[u8], needle: &[u8]) -> Option<usize> {
    bytes.windows(needle.len()).position(|window| window == needle)
}
