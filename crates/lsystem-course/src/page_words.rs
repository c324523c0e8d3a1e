//! The words that pages show: a catalogue without the texts that do not stand in them, and single files with their own.

use lsystem_base::words::said;
use serde_json::{Map, Value};
use std::collections::HashMap;

/// The length of the shortest part of a text that is searched, in bytes.
const SHORTEST: usize = 4;
/// What lets a page of the site fetch words. Pages that leave the site have theirs inside, or are English.
const FETCHES: &str = "connect-src 'self'; ";

/// The words of a language for pages.
#[derive(Clone, Copy, Debug)]
pub struct PageWords<'a> {
    /// The code of the language, such as `de`.
    pub language: &'a str,
    /// The catalogue of the language, as JSON.
    pub catalogue: &'a str,
}

impl PageWords<'_> {
    /// A page in a single file, in this language: the translations of the texts in it stand after its title, where
    /// `www/js/words.js` reads them. The text for readers without scripts is translated by the reader of words.
    ///
    /// `also` are texts that the page shows and does not have as they are, as those of exercises in links. `None` if the
    /// page has no title or the catalogue is damaged.
    #[must_use]
    pub fn give_to(&self, page: &str, also: &str) -> Option<String> {
        let words = words_in(self.catalogue, &[page.as_bytes(), also.as_bytes()])?;
        let file = format!("lang/{}/words.json", self.language);
        let element = format!("\n<script type=\"text/bytes\" data-file=\"{file}\">{}</script>", ascii(&words));
        let (head, body) = page.split_at(page.find("</title>")? + "</title>".len());
        let head = head.replacen("<html lang=\"en\"", &format!("<html lang=\"{}\"", self.language), 1);
        Some(without_requests(&head) + &element + &without_scripts(body))
    }
}

/// A page that leaves the site: its policy forbids all requests.
pub(crate) fn without_requests(page: &str) -> String {
    page.replacen(FETCHES, "", 1)
}

/// The page with the text translated that it shows where scripts are switched off.
fn without_scripts(page: &str) -> String {
    const START: &str = "<noscript><p class=\"noscript\">";
    let translated = || {
        let (before, rest) = page.split_once(START)?;
        let (text, after) = rest.split_once("</p>")?;
        Some(format!("{before}{START}{}</p>{after}", said(text)))
    };
    translated().unwrap_or_else(|| page.to_owned())
}

/// The catalogue of the texts that stand in the files of a page: in scripts, markup, wasm or JSON. Catalogues are JSON.
///
/// An entry may be too much, if the parts of its text stand in the files at several places; none is missing. `None` if
/// the catalogue is damaged.
#[must_use]
pub fn words_in(catalogue: &str, files: &[&[u8]]) -> Option<String> {
    let mut words: Map<String, Value> = serde_json::from_str(catalogue).ok()?;
    let mut missing: HashMap<[u8; SHORTEST], Vec<Vec<u8>>> = HashMap::new();
    for part in words.keys().flat_map(|text| parts(text)) {
        missing.entry(start(&part)).or_default().push(part);
    }
    // One pass for all parts: there are thousands, and files have megabytes.
    for file in files {
        let file: Vec<u8> = plain(file).collect();
        for (at, start) in file.array_windows().enumerate() {
            if let Some(parts) = missing.get_mut(start) {
                parts.retain(|part| !file[at..].starts_with(part));
            }
        }
    }
    let is_missing = |part: &Vec<u8>| missing.get(&start(part)).is_some_and(|parts| parts.contains(part));
    words.retain(|text, _| !parts(text).iter().any(is_missing));
    serde_json::to_string(&words).ok()
}

fn start(part: &[u8]) -> [u8; SHORTEST] {
    part.first_chunk().copied().unwrap_or_default()
}

/// The parts of a text that stand in a file as they are: between values, line ends, marks that scripts, markup and JSON
/// escape, and characters that are not ASCII. Short parts say nothing.
fn parts(text: &str) -> Vec<Vec<u8>> {
    let ends =
        |c: char| matches!(c, '{' | '}' | '`' | '\'' | '"' | '\\' | '$' | '&' | '<' | '>') || !(' '..='~').contains(&c);
    // The number of a value stands in braces.
    let parts = text.split(ends).filter(|part| !part.bytes().all(|byte| byte.is_ascii_digit()));
    parts.map(|part| plain(part.as_bytes()).collect()).filter(|part: &Vec<u8>| part.len() >= SHORTEST).collect()
}

/// The bytes of a file with one blank for white space, also where a script escapes a line end.
fn plain(bytes: &[u8]) -> impl Iterator<Item = u8> {
    let (mut at, mut last) = (0, 0);
    core::iter::from_fn(move || {
        loop {
            let byte = *bytes.get(at)?;
            let is_end = bytes[at..].starts_with(b"\\n");
            at += if is_end { 2 } else { 1 };
            let byte = if is_end || byte.is_ascii_whitespace() { b' ' } else { byte };
            let is_again = byte == b' ' && last == b' ';
            last = byte;
            if !is_again {
                return Some(byte);
            }
        }
    })
}

/// JSON in ASCII without `<`, which stands in a page as it is.
fn ascii(json: &str) -> String {
    let mut units = [0; 2];
    let mut text = String::new();
    for character in json.chars() {
        if character.is_ascii() && character != '<' {
            text.push(character);
            continue;
        }
        for unit in character.encode_utf16(&mut units) {
            text += &format!("\\u{unit:04x}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "<!doctype html>\n<html lang=\"en\" data-theme=\"light\"><head>\
        <meta content=\"default-src 'none'; connect-src 'self'; base-uri 'none'\"><title>T</title></head>\n\
        <p>Find rules\n   that draw it</p><script>say`Variant ${n} of ${m}, for ${x}`;say`It\\'s done…`</script></html>";

    fn given(catalogue: &str) -> String {
        PageWords { language: "de", catalogue }.give_to(PAGE, "Grow\na tree").unwrap()
    }

    #[test]
    fn a_page_gets_the_words_that_it_shows() {
        let page = given(
            r#"{
                "Find rules that draw it": "Finde Regeln für es", "Variant {} of {}, for {}": {"one": "<1>", "other": "2"},
                "It's done…": "Fertig", "Grow": "Wachse", "Find {} words": "A", "Something else": "B", "Variant {} of 3, for {}": "C"
            }"#,
        );
        let (head, rest) =
            page.split_once("</title>\n<script type=\"text/bytes\" data-file=\"lang/de/words.json\">").unwrap();
        assert!(head.contains("<html lang=\"de\" data-theme=\"light\">"), "{head}");
        assert!(head.contains("default-src 'none'; base-uri 'none'"), "{head}");
        let (words, rest) = rest.split_once("</script>").unwrap();
        assert!(rest.starts_with("</head>\n<p>Find rules"));
        assert!(words.is_ascii() && !words.contains('<'), "{words}");
        let words: Value = serde_json::from_str(words).unwrap();
        let told = serde_json::json!({
            "Find rules that draw it": "Finde Regeln für es",
            "Variant {} of {}, for {}": {"one": "<1>", "other": "2"},
            "It's done…": "Fertig",
            "Grow": "Wachse"
        });
        assert_eq!(words, told);
    }

    #[test]
    fn no_text_of_a_page_is_missing() {
        for code in ["de", "fr"] {
            let file = format!("{}/../../www/lang/{code}/words.json", env!("CARGO_MANIFEST_DIR"));
            let catalogue = std::fs::read_to_string(file).unwrap();
            let words: Map<String, Value> = serde_json::from_str(&catalogue).unwrap();
            let script = |text: &str| {
                text.replace('\\', "\\\\").replace('`', "\\`").replace("{}", "${a(b)}").replace('\n', "\\n")
            };
            let markup = |text: &str| {
                text.replace('&', "&amp;").replace('<', "&lt;").replace("{}", "<b>c</b>").replace(' ', "\\n  ")
            };
            let json = |text: &str| Value::from(text).to_string();
            for write in [&script as &dyn Fn(&str) -> String, &markup, &json, &str::to_owned] {
                let texts: String = words.keys().map(|text| write(text) + "\n").collect();
                let found: Map<_, _> =
                    serde_json::from_str(&words_in(&catalogue, &[texts.as_bytes()]).unwrap()).unwrap();
                let missing: Vec<_> = words.keys().filter(|text| !found.contains_key(*text)).collect();
                assert!(missing.is_empty(), "{code}: {missing:?}");
            }
        }
    }

    #[test]
    fn what_is_no_page_or_no_catalogue_gets_nothing() {
        assert!(PageWords { language: "de", catalogue: "{}" }.give_to("<p>", "").is_none());
        assert!(PageWords { language: "de", catalogue: "[" }.give_to(PAGE, "").is_none());
    }
}
