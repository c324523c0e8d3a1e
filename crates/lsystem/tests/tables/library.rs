//! The npm package's types of fields, formats and options: `fields.d.ts`.

use super::{kind, quoted};
use expect_test::expect_file;
use lsystem::files::{FILE_OPTIONS, FORMATS, Format, OptionKind};
use lsystem::syntax::FIELDS;
use std::fmt::Write;

/// Names as a union of types.
fn union(names: impl Iterator<Item = &'static str>) -> String {
    names.map(quoted).collect::<Vec<_>>().join(" | ")
}

/// The type of the values of a choice for files.
fn option_type(kind: OptionKind) -> String {
    let sides = "`${number}x${number}`";
    match kind {
        OptionKind::Flag => "boolean".to_owned(),
        OptionKind::Number { .. } => "number".to_owned(),
        OptionKind::Word { words, .. } => union(words.iter().map(|(word, _)| *word)),
        OptionKind::Sheet { words, .. } => union(words.iter().map(|(word, _)| *word)) + " | " + sides,
        OptionKind::Size => format!("{sides} | readonly [number, number]"),
    }
}

fn types() -> String {
    let mut text = String::from(
        "// Fields, formats and options: written by `cargo xtask tables` from the tables of the core, not by hand.\n\n\
         /** All fields of a system. */\nexport interface Fields {\n",
    );
    for spec in FIELDS.iter().filter(|spec| spec.is_defined()) {
        writeln!(text, "    /** {}: {} */", spec.help, spec.expected_words()).unwrap();
        writeln!(text, "    {}: {};", spec.name, kind(spec)).unwrap();
    }
    text += "}\n\n/** Formats of files. */\nexport type FileFormat =\n";
    for Format { name, label, help, .. } in &FORMATS {
        writeln!(text, "    /** {label}: {help} */\n    | {}", quoted(name)).unwrap();
    }
    let binary = union(FORMATS.iter().filter(|format| format.is_binary).map(|format| format.name));
    writeln!(text, "    ;\n\n/** Formats that are no texts. */\nexport type BinaryFormat = {binary};").unwrap();
    text += "\n/** Options of files; each format has some of them. */\nexport interface FileOptions {\n";
    for option in &FILE_OPTIONS {
        let readers = FORMATS.iter().filter(|format| format.options.contains(&option.name)).map(|format| format.name);
        let readers = readers.collect::<Vec<_>>().join(", ");
        writeln!(text, "    /** {}: {}. For {readers}. */", option.help, option.expected_words()).unwrap();
        let name = if option.name.contains('-') { quoted(option.name) } else { option.name.to_owned() };
        writeln!(text, "    {name}?: {};", option_type(option.kind)).unwrap();
    }
    text + "}\n"
}

#[test]
fn the_types_of_the_library_are_those_of_the_tables() {
    expect_file!["../../../lsystem-library-wasm/npm/fields.d.ts"].assert_eq(&types());
}
