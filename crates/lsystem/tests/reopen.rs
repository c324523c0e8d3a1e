//! Reading the system out of exported files.

use lsystem::base::{MAX_FILE, MAX_TEXT};
use lsystem::files::{PngOptions, SvgForm, collect, write_png};
use lsystem::syntax::Kind;
use lsystem::{
    Definition, Diagnostic, Figure, Limits, Plane, Style, SvgOptions, System, Vantage, Viewport, draw, read_file,
    read_json, write_json, write_svg,
};
use proptest::prelude::*;
use std::path::Path;

/// A PNG file of one pixel that holds a text in place of a system; none if the text is empty.
fn pixel(text: &str) -> Vec<u8> {
    let system = System::new(&Definition::default()).unwrap();
    let figure = Figure::draw(&system, 0, &Limits::default()).unwrap();
    let viewport = Viewport { width: 1, height: 1, ratio: 1.0 };
    let options = PngOptions { viewport, system: text.into(), ..PngOptions::default() };
    collect(|sink| write_png(&figure, &Style::default(), Vantage::default(), &options, sink)).unwrap().0
}

/// Files of all formats that contain a system.
fn files(definition: &Definition) -> Vec<Vec<u8>> {
    let json = write_json(definition);
    let mut files = vec![pixel(&json)];
    if let Ok(system) = System::new(definition) {
        let drawing = draw::<Plane>(&system, definition.iterations.min(3), &Limits::default()).unwrap();
        for form in [SvgForm::Flat, SvgForm::Compact] {
            let options = SvgOptions { title: "<T>".into(), system: json.clone(), form, ..SvgOptions::default() };
            files.push(write_svg(&drawing, &definition.style, &options).unwrap().text.into_bytes());
        }
    }
    files.push(json.into_bytes());
    files
}

fn check(definition: &Definition) {
    for file in files(definition) {
        let read = read_file(&file);
        assert_eq!((read.definition.as_ref(), read.diagnostics), (Some(definition), vec![]));
        assert_eq!(read_json(&read.json).0.as_ref(), Some(definition));
    }
}

#[test]
fn the_gallery() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    let mut checked = 0;
    for folder in std::fs::read_dir(data).unwrap().flatten() {
        for file in std::fs::read_dir(folder.path()).unwrap().flatten() {
            check(&read_json(&std::fs::read_to_string(file.path()).unwrap()).0.unwrap());
            checked += 1;
        }
    }
    assert!(checked > 80, "{checked}");
}

#[test]
fn odd_characters() {
    let text = "<&>\"' ]]> </metadata> &amp; \u{fffe}\u{ffff}\u{1}\u{7f}\r\n\t\u{85}\u{2028}🌿 é".to_owned();
    check(&Definition { axiom: "F".into(), title: text.clone(), notes: text, ..Definition::default() });
}

#[test]
fn texts_of_windows() {
    let definition = Definition { axiom: "F🌿".into(), title: "Blätter".into(), ..Definition::default() };
    let little = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>();
    let big = |text: &str| text.encode_utf16().flat_map(u16::to_be_bytes).collect::<Vec<_>>();
    let json = write_json(&definition).replace('\n', "\r\n");
    for file in [[b"\xff\xfe", &little(&json)[..]].concat(), [b"\xfe\xff", &big(&json)[..]].concat()] {
        let read = read_file(&file);
        assert_eq!((read.definition.as_ref(), read.diagnostics, &read.json), (Some(&definition), vec![], &json));
    }
    // A mark alone, half a character, and a mistake's place.
    for file in [&b"\xff\xfe"[..], b"\xfe\xff\xd8", b"\xff\xfe\x00\xd8\x7b"] {
        assert_eq!(read_file(file).definition, None, "{file:?}");
    }
    for text in ["\u{feff}{x".as_bytes(), &[b"\xff\xfe", &little("{x")[..]].concat()] {
        assert_eq!(read_file(text).diagnostics[0].span, 2..2);
    }
}

#[test]
fn the_longest_texts() {
    let axiom = format!("\"{}\"", "\\\"".repeat(MAX_TEXT / 2 - 1));
    assert_eq!(axiom.len(), MAX_TEXT);
    let rules = "F -> F+F\n".repeat(5_000);
    check(&Definition { axiom, rules, notes: "\"\n".repeat(5_000), ..Definition::default() });
}

#[test]
fn a_derived_string_as_an_axiom_is_the_drawing_of_its_system() {
    let (successor, n) = ("F+F--F+F", 8);
    let koch =
        Definition { axiom: "F".into(), rules: format!("F -> {successor}"), angle: 60.0, ..Definition::default() };
    let derived = (0..n).fold(koch.axiom.clone(), |string, _| string.replace('F', successor));
    assert!(derived.len() > 150_000);
    let string = Definition { axiom: derived, rules: String::new(), ..koch.clone() };
    let figure = |definition: &Definition, n| {
        let system = System::new(definition).unwrap();
        let figure = Figure::draw(&system, n, &Limits::PAGE).unwrap();
        (figure.segment_count(), figure.bounds().unwrap().concat())
    };
    let ((segments, bounds), (expected, frame)) = (figure(&string, 0), figure(&koch, n));
    assert_eq!(segments, expected);
    assert!(bounds.iter().zip(&frame).all(|(a, b)| (a - b).abs() < 1e-6), "{bounds:?} {frame:?}");
    check(&string);
}

/// The folder has a small plant, saved by the programs that its files are named after.
#[test]
fn pictures_that_other_programs_have_saved() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/saved");
    let read = |name: &str| read_file(&std::fs::read(folder.join(name)).unwrap());
    let files: Vec<String> =
        std::fs::read_dir(&folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    assert!(files.len() > 12, "{files:?}");
    for name in files {
        let found = read(&name);
        // Encrypted.
        if name == "qpdf-encrypted.pdf" {
            assert_eq!(found.diagnostics[0].message, "This PDF holds no L-system");
            assert!(found.diagnostics[0].hint.as_ref().unwrap().contains("pdfdetach"));
            continue;
        }
        assert_eq!(found.diagnostics, vec![], "{name}");
        let definition = found.definition.unwrap();
        assert_eq!((&*definition.title, &*definition.axiom, definition.iterations), ("É <&> \"x\"", "X", 2), "{name}");
        assert_eq!(definition.rules, "X -> F-[[X]+X]+F[+FX]-X\nF -> FF", "{name}");
    }
}

#[test]
fn what_holds_no_system() {
    let check = |bytes: &[u8], expected: &str| {
        let read = read_file(bytes);
        let words: Vec<String> = read.diagnostics.iter().map(|problem| problem.message.clone()).collect();
        assert_eq!((read.definition, words), (None, vec![expected.to_owned()]));
    };
    check(&pixel(""), "This PNG holds no L-system");
    check(b"\xef\xbb\xbf <svg xmlns=\"http://www.w3.org/2000/svg\"/>", "This SVG holds no L-system");
    check(b"<svg><metadata id=\"L-system\">{\"initial\": \"F\"}", "This SVG holds no L-system");
    check(b"{\n\"initial\": \"\xff\"}", "Line 2 is not UTF-8 text");
    check(b"", "The file holds nothing");
    check(b"<svg><metadata id=\"L-system\">[1]</metadata></svg>", "The file must hold an object, not a list");
    let long = read_file(&pixel(&" ".repeat(MAX_FILE + 1)));
    assert!(matches!(long.diagnostics[0].kind, Kind::Limit { .. }));
}

proptest! {
    #[test]
    fn damaged_files(at in 0_usize..1_000_000, byte: u8, cut in 0_usize..1_000_000, form in 0_usize..4) {
        let definition = Definition { axiom: "F".into(), rules: "F -> F+F".into(), ..Definition::default() };
        let mut file = files(&definition).swap_remove(form);
        let length = file.len();
        file[at % length] = byte;
        file.truncate(cut % length + 1);
        let read = read_file(&file);
        prop_assert!(read.definition.is_some() || read.diagnostics.iter().any(Diagnostic::is_error));
    }
}
