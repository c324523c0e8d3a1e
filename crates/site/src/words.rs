//! The language of the pages, and its words.

use anyhow::Result;
use fs_err as fs;
use icu_locale_core::Locale;
use icu_plurals::PluralRules;
use serde_json::{Map, Value};
use std::path::Path;
use std::sync::OnceLock;

/// A language, and its catalogue.
static WORDS: OnceLock<(String, Map<String, Value>)> = OnceLock::new();

/// Chooses the language of all pages, a folder of `www/lang`.
pub(crate) fn choose(folder: &Path) -> Result<()> {
    let catalogue = serde_json::from_str(&fs::read_to_string(folder.join("words.json"))?)?;
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let _ = WORDS.set((name, catalogue));
    lsystem_base::words::set_reader(read);
    Ok(())
}

/// A translation, in the plural form for the number.
fn read(text: &str, number: Option<u64>) -> Option<String> {
    let (language, words) = WORDS.get()?;
    let entry = words.get(text)?;
    let locale: Locale = language.parse().ok()?;
    let rules = PluralRules::try_new_cardinal((&locale).into()).ok()?;
    let category = format!("{:?}", rules.category_for(number.unwrap_or_default())).to_lowercase();
    let form = entry.as_str().or_else(|| entry.get(category).or_else(|| entry.get("other"))?.as_str());
    form.map(str::to_owned)
}

/// The language's code, as in `lang` of HTML.
pub(crate) fn language() -> &'static str {
    WORDS.get().map_or("en", |(name, _)| name)
}

/// What the names of pages have before `.html`: nothing in English, else a point and the language.
pub(crate) fn ending() -> String {
    WORDS.get().map_or_else(String::new, |(name, _)| format!(".{name}"))
}

/// The languages besides English: the folders of `www/lang`, sorted.
pub(crate) fn all(folder: &Path) -> Result<Vec<String>> {
    let names = fs::read_dir(folder)?.map(|language| Ok(language?.file_name().to_string_lossy().into_owned()));
    let mut names = names.collect::<Result<Vec<_>>>()?;
    names.sort();
    Ok(names)
}
