//! The language of the pages.

use anyhow::Result;
use fs_err as fs;
use lsystem_catalogue::Catalogue;
use std::path::Path;
use std::sync::OnceLock;

/// The language, if it is not English.
static CATALOGUE: OnceLock<Catalogue> = OnceLock::new();

/// Chooses the language of all pages, a folder of `www/lang`.
pub(crate) fn choose(folder: &Path) -> Result<()> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let _ = CATALOGUE.set(Catalogue::new(&name, &fs::read_to_string(folder.join("words.json"))?)?);
    lsystem_base::words::set_reader(|text, number| CATALOGUE.get()?.find(text, number));
    Ok(())
}

/// The language's code, as in `lang` of HTML.
pub(crate) fn language() -> &'static str {
    CATALOGUE.get().map_or("en", Catalogue::code)
}

/// What the names of pages have before `.html`: nothing in English, else a point and the language.
pub(crate) fn ending() -> String {
    CATALOGUE.get().map_or_else(String::new, |own| format!(".{}", own.code()))
}
