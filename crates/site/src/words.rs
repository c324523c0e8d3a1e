//! The language of the pages, and its words.

use anyhow::Result;
use fs_err as fs;
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
    lsystem_base::words::set_reader(|text, _| WORDS.get()?.1.get(text)?.as_str().map(str::to_owned));
    Ok(())
}

/// The language's code, as in `lang` of HTML.
pub(crate) fn language() -> &'static str {
    WORDS.get().map_or("en", |(name, _)| name)
}

/// What the names of pages have before `.html`: nothing in English, else a point and the language.
pub(crate) fn ending() -> String {
    WORDS.get().map_or_else(String::new, |(name, _)| format!(".{name}"))
}
