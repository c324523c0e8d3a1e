//! The language of the pages.

use anyhow::{Result, anyhow};
use fs_err as fs;
use lsystem_catalogue::Catalogue;
use std::path::Path;
use std::sync::RwLock;

/// The language of the pages that are being made, if it is not English.
static CATALOGUE: RwLock<Option<&'static Catalogue>> = RwLock::new(None);

fn catalogue() -> Option<&'static Catalogue> {
    CATALOGUE.read().map_or(None, |own| *own)
}

/// Chooses the language of all pages that follow, a folder of `www/lang`.
pub(crate) fn choose(folder: &Path) -> Result<()> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    // Few, and each until the end of the program.
    let own = Box::leak(Box::new(Catalogue::new(&name, &fs::read_to_string(folder.join("words.json"))?)?));
    *CATALOGUE.write().map_err(|_| anyhow!("a thread has panicked"))? = Some(own);
    lsystem_base::words::set_reader(|text, number| catalogue()?.find(text, number));
    Ok(())
}

/// The language's code, as in `lang` of HTML.
pub(crate) fn language() -> &'static str {
    catalogue().map_or("en", Catalogue::code)
}

/// What the names of pages have before `.html`: nothing in English, else a point and the language.
pub(crate) fn ending() -> String {
    catalogue().map_or_else(String::new, |own| format!(".{}", own.code()))
}
