//! The language of messages and help.

use expect_test::expect_file;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs `lsys` in the repository's root with one variable for the language, or none.
fn lsys(words: &str, variable: Option<(&str, &str)>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lsys"));
    for name in ["LC_ALL", "LC_MESSAGES", "LANG"] {
        command.env_remove(name);
    }
    command.args(words.split(' ')).envs(variable).current_dir(root()).output().expect("lsys runs")
}

fn help(words: &str, variable: Option<(&str, &str)>) -> String {
    let output = lsys(words, variable);
    assert_eq!(output.status.code(), Some(0), "{words}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The help ends with the name of the language.
#[test]
fn the_language_is_that_of_the_arguments_or_of_the_environment() {
    for (words, variable, name) in [
        ("--help", None, "English"),
        ("--language de --help", None, "Deutsch"),
        ("info --language=fr --help", None, "Français"),
        ("--help", Some(("LANG", "de_DE.UTF-8")), "Deutsch"),
        ("--help", Some(("LC_MESSAGES", "fr_FR")), "Français"),
        ("--help", Some(("LC_ALL", "C")), "English"),
        ("--help", Some(("LANG", "xx_XX.UTF-8")), "English"),
        ("--language en --help", Some(("LANG", "de_DE.UTF-8")), "English"),
    ] {
        assert!(help(words, variable).contains(&format!("({name})")), "{words} {variable:?}");
    }
}

#[test]
fn an_unknown_language_is_an_error_that_names_the_known_ones() {
    let output = lsys("info data_in/abop/1.24f.json --language xx", None);
    let words = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{words}");
    assert!(words.contains("en, de, fr"), "{words}");
}

#[test]
fn json_is_the_same_in_all_languages() {
    let json = |language: &str| {
        help(&format!("info --json data_in/abop/1.24f.json --language {language}"), Some(("LANG", "de_DE.UTF-8")))
    };
    assert_eq!(json("de"), json("en"));
    assert_eq!(json("fr"), json("en"));
}

/// With `UPDATE_EXPECT=1` this writes the program's catalogues anew.
#[test]
fn the_program_carries_the_catalogues_of_the_page() {
    let folder = root().join("www/lang");
    let codes = lsystem_catalogue::languages(&folder).expect("a folder");
    for code in &codes {
        let words = std::fs::read_to_string(folder.join(code).join("words.json")).expect("words");
        expect_file![format!("{}/lang/{code}.json", env!("CARGO_MANIFEST_DIR"))].assert_eq(&words);
    }
    assert!(!codes.is_empty());
    let carried = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("lang")).expect("a folder");
    assert_eq!(carried.count(), codes.len());
}
