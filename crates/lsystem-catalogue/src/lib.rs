//! Catalogues: the texts of the product in one language, for programs.
//!
//! A catalogue is JSON: the English texts and their translations. A translation is a text, or for a text with a number
//! its forms by the plural categories of CLDR. `null` stands for a translation that is still to be made. In the browser,
//! `www/js/base/words.js` reads the same files.

use icu_locale_core::Locale;
use icu_plurals::{PluralCategory, PluralRules};
use serde::Deserialize;
use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::Path;

/// The translations into one language.
pub struct Catalogue {
    code: String,
    words: HashMap<String, Option<Translation>>,
    locale: Option<Locale>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Translation {
    Text(String),
    Forms(HashMap<String, String>),
}

impl Catalogue {
    /// Reads the catalogue of the language with this code, such as `de`.
    ///
    /// # Errors
    /// If the text is no catalogue.
    pub fn new(code: &str, json: &str) -> serde_json::Result<Self> {
        Ok(Self { code: code.to_owned(), words: serde_json::from_str(json)?, locale: code.parse().ok() })
    }

    /// The code of the language.
    #[must_use]
    pub fn code(&self) -> &str {
        &self.code
    }

    /// The translation of an English text, in the form that the number needs. `None` if there is none.
    #[must_use]
    pub fn find(&self, text: &str, number: Option<u64>) -> Option<String> {
        match self.words.get(text)?.as_ref()? {
            Translation::Text(text) => Some(text.clone()),
            Translation::Forms(forms) => {
                let form = number.map_or("other", |number| self.category(number));
                forms.get(form).or_else(|| forms.get("other")).cloned()
            }
        }
    }

    /// The plural category of a number.
    fn category(&self, number: u64) -> &'static str {
        let rules = self.locale.as_ref().and_then(|own| PluralRules::try_new_cardinal(own.into()).ok());
        match rules.map_or(PluralCategory::Other, |own| own.category_for(number)) {
            PluralCategory::Zero => "zero",
            PluralCategory::One => "one",
            PluralCategory::Two => "two",
            PluralCategory::Few => "few",
            PluralCategory::Many => "many",
            PluralCategory::Other => "other",
        }
    }
}

/// The codes of the languages besides English: the names in a folder with one folder for each, sorted.
///
/// # Errors
/// If the folder cannot be read.
pub fn languages(folder: &Path) -> io::Result<Vec<String>> {
    let names = fs::read_dir(folder)?.map(|language| Ok(language?.file_name().to_string_lossy().into_owned()));
    let mut names = names.collect::<io::Result<Vec<_>>>()?;
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_chooses_the_form() {
        let words = r#"{
            "{} points": {"one": "{} punkt", "few": "{} punkty", "other": "{} punktów"}, "Point": "Punkt", "Line": null
        }"#;
        let catalogue = Catalogue::new("pl", words).unwrap();
        for (number, form) in [(1, "{} punkt"), (3, "{} punkty"), (5, "{} punktów"), (22, "{} punkty")] {
            assert_eq!(catalogue.find("{} points", Some(number)).as_deref(), Some(form), "{number}");
        }
        assert_eq!(catalogue.find("{} points", None).as_deref(), Some("{} punktów"));
        assert_eq!(catalogue.find("Point", Some(3)).as_deref(), Some("Punkt"));
        assert_eq!(catalogue.find("Line", None), None);
        assert_eq!(catalogue.find("Circle", None), None);
    }

    #[test]
    fn all_catalogues_of_the_page_can_be_read() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../www/lang");
        let languages = languages(&folder).unwrap();
        assert!(languages.windows(2).all(|pair| pair[0] < pair[1]) && languages.contains(&"de".to_owned()));
        for code in languages {
            let words = fs::read_to_string(folder.join(&code).join("words.json")).unwrap();
            assert!(Catalogue::new(&code, &words).is_ok_and(|own| !own.words.is_empty()), "{code}");
        }
    }
}
