//! What the core knows and the page shows: `www/js/tables.js` says the same. `cargo xtask tables` writes it anew.

use expect_test::expect_file;
use lsystem::Dialect;
use std::fmt::Write;

/// A string as the page's scripts write it.
fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\\', "\\\\").replace('\'', "\\'"))
}

#[test]
fn the_pages_tables_are_those_of_the_core() {
    let mut script =
        String::from("/** What the core knows and the page shows: written by `cargo xtask tables`, not by hand. */\n");
    script += "\n/** What symbols do, by the name of the dialect in files: what it is called, and what it does in words. */\n";
    script += "export const DIALECTS = Object.freeze({\n";
    for dialect in Dialect::ALL {
        let [label, help] = dialect.words().map(quoted);
        writeln!(script, "    {}: {{ label: {label}, help: {help} }},", quoted(dialect.name())).unwrap();
    }
    script += "});\n";
    expect_file!["../../../www/js/tables.js"].assert_eq(&script);
}

#[test]
fn dialects_have_one_name() {
    for dialect in Dialect::ALL {
        assert_eq!(serde_json::to_value(dialect).unwrap(), dialect.name());
    }
}
