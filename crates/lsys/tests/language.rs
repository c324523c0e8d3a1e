//! The language of messages and help.

use crate::program;

use program::root;
use std::process::{Command, Output};

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

#[test]
fn help_and_errors_have_no_words_of_clap_in_other_languages() {
    let told = |words: &str| {
        let output = lsys(words, None);
        String::from_utf8([output.stdout, output.stderr].concat()).expect("UTF-8")
    };
    let english = [
        "Usage:",
        "Commands:",
        "Arguments:\n",
        "default:",
        "possible values",
        "Possible values",
        "alias:",
        "error:",
        "tip:",
        "unexpected",
        "required",
        "invalid value",
        "similar",
        "more information",
        "Animated",
        "provided",
        "not in",
        "too large",
    ];
    for language in ["de", "fr"] {
        for line in [
            "--help",
            "draw --help",
            "animate --help",
            "animate -h",
            "scorm -h",
            "completions --help",
            "info a.json --jsn",
            "info --nothing",
            "inof a.json",
            "animate a.json",
            "draw a.json --format pgn",
            "draw a.json --dpi 1x",
            "info",
            "view a.json --port 0",
            "view a.json --port 99999999999",
            "scorm a --lesson --to b",
            "info a.json --growth txt x -- -y",
            "draw a.json b.json c.json d.json",
            "view a.json b.json",
            "info - -",
            "link a.json --page",
        ] {
            let text = told(&format!("--language {language} {line}"));
            let mut found = english.into_iter().filter(|word| text.contains(word));
            // `Usage` and `Options` are French, too.
            let found = found.find(|word| language == "de" || *word != "Usage:");
            assert_eq!(found, None, "{line}: {text}");
        }
    }
    assert!(told("--language de --help").contains("\nAufruf: lsys [OPTIONS] <COMMAND>\n\nBefehle:\n  view "));
    let error = told("--language de info a.json --jsn");
    let start = "Fehler: unbekanntes Argument '--jsn'\n\n  Tipp: ein \u{e4}hnliches Argument gibt es: '--json'\n\nAufruf: lsys info ";
    assert!(error.starts_with(start) && error.ends_with("\n\nMehr dazu zeigt '--help'.\n"), "{error}");
    let error = told("--language fr animate a.json");
    assert!(error.starts_with("erreur\u{a0}: ces arguments obligatoires manquent\u{a0}:\n  --to <OUT>\n"), "{error}");
    let set = told("--language fr info data_in/abop/1.24f.json --set width=wide");
    assert!(!set.contains("Stroke width"), "{set}");
}
