//! The language of messages and help: that of `--language`, or else that of the environment, or else English.
//!
//! `lang/` has a catalogue for each language, a copy of the page's. A catalogue is JSON: the English texts and their
//! translations. A translation is a text, or for a text with a number its forms by the plural categories of CLDR.

use icu_locale_core::Locale;
use icu_plurals::{PluralCategory, PluralRules};
use lsystem::base::words::set_reader;
use serde::Deserialize;
use std::collections::HashMap;
use std::ffi::OsString;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// The codes of the languages beside English, and their catalogues.
const CATALOGUES: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/languages.rs"));

/// A translation.
#[derive(Deserialize)]
#[serde(untagged)]
enum Translation {
    Text(String),
    Forms(HashMap<String, String>),
}

struct Catalogue {
    code: &'static str,
    words: HashMap<String, Translation>,
    locale: Option<Locale>,
}

/// Whether texts stay English, as in outputs for programs.
static STAYS_ENGLISH: AtomicBool = AtomicBool::new(false);

static CATALOGUE: OnceLock<Catalogue> = OnceLock::new();

/// The codes of all languages.
pub(crate) fn known() -> impl Iterator<Item = &'static str> {
    std::iter::once("en").chain(CATALOGUES.iter().map(|(code, _)| *code))
}

/// Leaves all texts of this run English, because another program reads its output.
pub(crate) fn stay_english() {
    STAYS_ENGLISH.store(true, Ordering::Relaxed);
}

/// The code of the language that texts have.
pub(crate) fn code() -> &'static str {
    CATALOGUE.get().filter(|_| !STAYS_ENGLISH.load(Ordering::Relaxed)).map_or("en", |own| own.code)
}

/// Sets the language for all messages, by the arguments and the environment. An unknown language in the arguments is
/// left to the reader of the arguments.
pub(crate) fn choose(arguments: &[OsString]) {
    let asked = asked(arguments).unwrap_or_else(|| of_environment(|name| std::env::var(name).ok()));
    let Some((code, text)) = CATALOGUES.iter().find(|(code, _)| *code == asked) else { return };
    let Ok(words) = serde_json::from_str(text) else { return };
    if CATALOGUE.set(Catalogue { code, words, locale: code.parse().ok() }).is_ok() {
        set_reader(|text, number| {
            CATALOGUE.get().filter(|_| !STAYS_ENGLISH.load(Ordering::Relaxed))?.find(text, number)
        });
    }
}

impl Catalogue {
    fn find(&self, text: &str, number: Option<u64>) -> Option<String> {
        match self.words.get(text)? {
            Translation::Text(text) => Some(text.clone()),
            Translation::Forms(forms) => {
                let rules = self.locale.as_ref().and_then(|own| PluralRules::try_new_cardinal(own.into()).ok());
                let category =
                    rules.zip(number).map_or(PluralCategory::Other, |(own, number)| own.category_for(number));
                forms.get(name_of(category)).or_else(|| forms.get("other")).cloned()
            }
        }
    }
}

fn name_of(category: PluralCategory) -> &'static str {
    match category {
        PluralCategory::Zero => "zero",
        PluralCategory::One => "one",
        PluralCategory::Two => "two",
        PluralCategory::Few => "few",
        PluralCategory::Many => "many",
        PluralCategory::Other => "other",
    }
}

/// The value of the last `--language`, before the arguments are read.
fn asked(arguments: &[OsString]) -> Option<String> {
    let options: Vec<&str> = arguments.iter().map_while(|own| Some(own).filter(|own| *own != "--")?.to_str()).collect();
    let value = |(at, own): (usize, &&str)| match own.strip_prefix("--language")? {
        "" => options.get(at + 1).map(|value| (*value).to_owned()),
        rest => rest.strip_prefix('=').map(str::to_owned),
    };
    options.iter().enumerate().rev().find_map(value)
}

/// The language of the first of the variables of POSIX that is set, such as `de` for `de_DE.UTF-8`.
fn of_environment(get: impl Fn(&str) -> Option<String>) -> String {
    let value = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().filter_map(get).find(|value| !value.is_empty());
    value.unwrap_or_default().split(['_', '.', '@', '-']).next().unwrap_or_default().to_ascii_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_name_the_language() {
        let asked = |line: &str| asked(&line.split(' ').map(OsString::from).collect::<Vec<_>>());
        assert_eq!(asked("info --language de a.json").as_deref(), Some("de"));
        assert_eq!(asked("--language=de info --language=fr").as_deref(), Some("fr"));
        assert_eq!(asked("info -- --language de"), None);
        assert_eq!(asked("info --languages de"), None);
    }

    #[test]
    fn the_first_variable_that_is_set_names_the_language() {
        let language = |set: &[(&str, &str)]| {
            of_environment(|name| set.iter().find(|(own, _)| *own == name).map(|(_, value)| (*value).to_owned()))
        };
        assert_eq!(language(&[("LANG", "de_DE.UTF-8")]), "de");
        assert_eq!(language(&[("LANG", "de_DE.UTF-8"), ("LC_MESSAGES", "fr")]), "fr");
        assert_eq!(language(&[("LC_ALL", "C"), ("LC_MESSAGES", "fr")]), "c");
        assert_eq!(language(&[("LC_ALL", ""), ("LANG", "fr@euro")]), "fr");
        assert_eq!(language(&[]), "");
    }

    #[test]
    fn the_number_chooses_the_form() {
        let words =
            serde_json::from_str(r#"{"{} points": {"one": "{} punkt", "few": "{} punkty", "other": "{} punktów"}}"#);
        let catalogue = Catalogue { code: "pl", words: words.unwrap(), locale: "pl".parse().ok() };
        for (number, form) in [(1, "{} punkt"), (3, "{} punkty"), (5, "{} punktów"), (22, "{} punkty")] {
            assert_eq!(catalogue.find("{} points", Some(number)).as_deref(), Some(form), "{number}");
        }
        assert_eq!(catalogue.find("{} lines", Some(1)), None);
    }

    #[test]
    fn all_catalogues_can_be_read() {
        for (code, text) in CATALOGUES {
            let words: Result<HashMap<String, Translation>, _> = serde_json::from_str(text);
            assert!(words.is_ok_and(|words| !words.is_empty()), "{code}");
        }
    }
}
