//! The language of messages and help: that of `--language`, or else that of the environment, or else English.
//! The catalogues are those of the page.

use lsystem::base::words::set_reader;
use lsystem::course::PageWords;
use lsystem_catalogue::Catalogue;
use std::ffi::OsString;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// The codes of the languages beside English, and their catalogues.
const CATALOGUES: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/languages.rs"));

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
    catalogue().map_or("en", Catalogue::code)
}

/// The words for pages in this language; none in English.
pub(crate) fn page_words() -> Option<PageWords<'static>> {
    let (language, catalogue) = *CATALOGUES.iter().find(|(own, _)| *own == code())?;
    Some(PageWords { language, catalogue })
}

/// The catalogue of the language that texts have; none in English.
fn catalogue() -> Option<&'static Catalogue> {
    CATALOGUE.get().filter(|_| !STAYS_ENGLISH.load(Ordering::Relaxed))
}

/// Sets the language for all messages, by the arguments and the environment. An unknown language in the arguments is
/// left to the reader of the arguments.
pub(crate) fn choose(arguments: &[OsString]) {
    let asked = asked(arguments).unwrap_or_else(|| of_environment(|name| std::env::var(name).ok()));
    let Some((code, text)) = CATALOGUES.iter().find(|(code, _)| *code == asked) else { return };
    let Ok(words) = Catalogue::new(code, text) else { return };
    if CATALOGUE.set(words).is_ok() {
        set_reader(|text, number| catalogue()?.find(text, number));
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
}
