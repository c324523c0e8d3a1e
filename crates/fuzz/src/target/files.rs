//! Readers of files: any bytes are read without a panic, and written files read back as the same.

use crate::make::{self, random_pieces};
use crate::pieces::pieces;
use crate::told::check_diagnostic;
use crate::{Gauge, Source};
use lsystem::files::{PngOptions, collect, write_png};
use lsystem::syntax::Field;
use lsystem::{
    Definition, Diagnostic, Figure, Limits, Style, SvgOptions, System, Vantage, Viewport, draw, read_file, read_json,
    render_diagnostic, write_json, write_svg,
};

/// Valid and damaged JSON.
pub(super) fn json(source: &mut Source<'_>, gauge: &mut Gauge) {
    let definition = make::definition(source);
    let written = gauge.call("write", || write_json(&definition));
    if System::new(&definition).is_ok() {
        gauge.reach("right");
        let (read, diagnostics) = gauge.call("read", || read_json(&written));
        assert!(!diagnostics.iter().any(Diagnostic::is_error), "{written}: {diagnostics:?}");
        let again = read.map(|read| write_json(&read));
        assert_eq!(again.as_ref(), Some(&written), "a file that is read and written again stays the same");
    }
    let text = if source.once_in(8) { tokens(source) } else { written };
    let damaged = damaged(source, text.into_bytes());
    read(&damaged, gauge);
}

/// Pieces of JSON in any order.
fn tokens(source: &mut Source<'_>) -> String {
    let mut text = String::new();
    for _ in 0..source.between(1, 60) {
        let piece = source.pick(pieces("files"));
        let times = if source.once_in(40) { source.pick(&[10, 600, 20_000]) } else { 1 };
        text.push_str(&piece.repeat(times));
    }
    text
}

/// `bytes` with some of them changed, removed or inserted.
fn damaged(source: &mut Source<'_>, mut bytes: Vec<u8>) -> Vec<u8> {
    for _ in 0..source.between(0, 5) {
        let at = source.below(bytes.len() + 1);
        match source.below(5) {
            0 => bytes.truncate(at),
            1 => {
                let end = (at + source.between(0, 30)).min(bytes.len());
                bytes.drain(at..end);
            }
            2 => {
                let text = random_pieces(source).into_bytes();
                bytes.splice(at..at, text);
            }
            3 => {
                let other = source.bytes(8);
                bytes.splice(at..at, other.iter().copied());
            }
            _ => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << source.below(8);
                }
            }
        }
    }
    bytes
}

/// Reads a file, and checks that its diagnostics point into its text.
fn read(bytes: &[u8], gauge: &mut Gauge) -> Option<Definition> {
    let content = gauge.call("read_file", || read_file(bytes));
    if content.definition.is_some() {
        gauge.reach("read");
    }
    assert_eq!(content.definition.is_none(), content.diagnostics.iter().any(Diagnostic::is_error));
    for diagnostic in &content.diagnostics {
        check_diagnostic(diagnostic);
        if diagnostic.field == Field::File {
            assert!(content.json.get(diagnostic.span.clone()).is_some(), "{diagnostic:?} points out of the file");
            let _ = render_diagnostic(diagnostic, "file", &content.json);
        }
    }
    content.definition
}

/// A PNG file of one pixel with a system inside.
fn pixel(system: String) -> Option<Vec<u8>> {
    let line = System::new(&Definition { axiom: "F".into(), ..Definition::default() }).ok()?;
    let figure = Figure::draw(&line, 0, &Limits::default()).ok()?;
    let viewport = Viewport { width: 1, height: 1, ratio: 1.0 };
    let options = PngOptions { viewport, system, ..PngOptions::default() };
    let file = collect(|sink| write_png(&figure, &Style::default(), Vantage::default(), &options, sink));
    Some(file.ok()?.0)
}

/// Pictures with a system inside, complete and damaged.
pub(super) fn pictures(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let written = write_json(&definition);
    let bytes = if source.once_in(2) {
        let limits = Limits { segments: 200, work: 2_000, modules: 1_000, symbols: 1_000, ..Limits::default() };
        let Ok(drawing) = draw(&system, definition.iterations.min(3), &limits) else { return };
        let options = SvgOptions {
            title: random_pieces(source),
            description: random_pieces(source),
            system: written.clone(),
            most: 1_000,
            ..SvgOptions::default()
        };
        let Ok(svg) = write_svg(&drawing, &system.style, &options) else { return };
        svg.text.into_bytes()
    } else {
        pixel(written.clone()).expect("a picture of one pixel is within all limits")
    };
    gauge.reach("made");
    let read_back = read(&bytes, gauge).map(|read| write_json(&read));
    assert_eq!(read_back, Some(written), "a picture's system is the one put into it");
    let broken = damaged(source, bytes);
    read(&broken, gauge);
}

/// Any bytes after the beginning of some file format.
pub(super) fn bytes(source: &mut Source<'_>, gauge: &mut Gauge) {
    let head: &[u8] = source.pick(&[
        &b""[..],
        b"\x89PNG\r\n\x1a\n",
        b"\x89PNG\r\n\x1a\n\0\0\0\x08iTXt",
        b"\x89PNG\r\n\x1a\n\xff\xff\xff\xffzTXtL-system\0\0",
        b"<svg><metadata>",
        b"<?xml version='1.0'?><!--",
        b"\xff\xfe",
        b"\xfe\xff",
        b"\xef\xbb\xbf{",
        b"{",
        b"{\"rules\": [",
        b"[[[[",
    ]);
    let mut bytes = head.to_vec();
    if source.once_in(2) {
        let tail = source.bytes(4096);
        bytes.extend(tail);
    } else {
        bytes.extend(tokens(source).bytes());
    }
    read(&bytes, gauge);
}
