//! The words that pages show: a catalogue without the texts that do not stand in them, and single files with their own.

use core::mem::take;
use lsystem_base::{sorted::sort, words::said};
use lsystem_files::packed::unpack;

/// The largest file that is searched in a page, in bytes: seven times a draft of the largest wasm.
const LARGEST: usize = 64 << 20;
/// The length of the shortest part of a text that is searched, in bytes.
const SHORTEST: usize = 4;
/// The element with which a page of the site fetches its texts. Pages that leave the site contain theirs, or are English.
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
    /// `www/js/base/words.js` reads them. The text for readers without scripts is translated by the reader of words.
    ///
    /// `also` are texts that the page shows and does not have as they are, as those of exercises in links. `None` if the
    /// page has no title or the catalogue is damaged.
    #[must_use]
    pub fn give_to(&self, page: &str, also: &str) -> Option<String> {
        let carried = carried(page);
        let files: Vec<&[u8]> = carried.iter().map(Vec::as_slice).chain([page.as_bytes(), also.as_bytes()]).collect();
        let words = words_in(self.catalogue, &files)?;
        let file = format!("lang/{}/words.json", self.language);
        let element = format!("\n<script type=\"text/plain\" data-file=\"{file}\">{}</script>", ascii(&words));
        let (head, body) = page.split_at(page.find("</title>")? + "</title>".len());
        let head = head.replacen(" data-catalogue=\"programs\"", "", 1);
        let head = head.replacen("<html lang=\"en\"", &format!("<html lang=\"{}\"", self.language), 1);
        Some(without_requests(&head) + &element + &without_scripts(body))
    }
}

/// The files that a single file carries compressed (`crates/xtask/src/one_file.rs`). A damaged one is left out.
fn carried(page: &str) -> Vec<Vec<u8>> {
    let elements = page.split("<script type=\"text/zlib\" ").skip(1);
    elements
        .filter_map(|element| {
            let (_, text) = element.split_once('>')?;
            let (text, _) = text.split_once('<')?;
            unpack(text, LARGEST).ok()
        })
        .collect()
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
/// the catalogue is no object or has no end.
#[must_use]
pub fn words_in(catalogue: &str, files: &[&[u8]]) -> Option<String> {
    let mut entries = entries(catalogue)?;
    let mut missing = Vec::new();
    for (entry, [key, _]) in entries.iter().enumerate() {
        missing.extend(parts(key).map(|part| (part, entry)));
    }
    sort(&mut missing);
    // One pass for all parts: there are thousands, and files have megabytes.
    for file in files {
        let file = plain(file);
        for (at, start) in file.windows(SHORTEST).enumerate() {
            let mut next = missing.partition_point(|(part, _)| part.as_slice() < start);
            while let Some((part, _)) = missing.get(next).filter(|(part, _)| part.starts_with(start)) {
                if file[at..].starts_with(part) {
                    missing.remove(next);
                } else {
                    next += 1;
                }
            }
        }
    }
    for (_, entry) in missing {
        entries[entry][0].clear();
    }
    let mut words = String::from('{');
    for [key, value] in entries.iter().filter(|[key, _]| !key.is_empty()) {
        for text in [key, ":", value, ","] {
            words += text;
        }
    }
    words.truncate(words.trim_end_matches(',').len());
    Some(words + "}")
}

/// The keys and values of a JSON object as they are written, without white space between texts.
fn entries(json: &str) -> Option<Vec<[String; 2]>> {
    let inside = json.trim().strip_prefix('{')?.strip_suffix('}')?;
    let (mut entries, mut key, mut written) = (Vec::new(), String::new(), String::new());
    let (mut depth, mut is_text, mut is_escaped) = (0, false, false);
    for character in inside.chars().chain([',']) {
        match character {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            '"' => is_text = !is_text,
            _ if is_text => {}
            ':' if depth == 0 => {
                key = take(&mut written);
                continue;
            }
            ',' if depth == 0 => {
                entries.push([take(&mut key), take(&mut written)]);
                continue;
            }
            '{' | '[' => depth += 1,
            '}' | ']' => depth -= 1,
            ' ' | '\t' | '\r' | '\n' => continue,
            _ => {}
        }
        written.push(character);
    }
    // Without an end of a text or value, the last comma is in it.
    written.is_empty().then_some(entries)
}

/// The parts of a key, as it is written in JSON, that stand in a file as they are: between values, line ends, marks that
/// scripts, markup and JSON escape, and characters that are not ASCII. Short parts say nothing.
fn parts(key: &str) -> impl Iterator<Item = Vec<u8>> {
    // How many characters of an escape follow.
    let mut escaped = 0;
    let ends = move |c| {
        let is_end = escaped > 0 || matches!(c, '{' | '}' | '`' | '\'' | '"' | '\\' | '$' | '&' | '<' | '>');
        escaped = match (escaped, c) {
            (0, '\\') => 1,
            (1, 'u') => 4,
            _ => escaped.max(1) - 1,
        };
        is_end || !(' '..='~').contains(&c)
    };
    key.split(ends).map(|part| plain(part.as_bytes())).filter(|part| part.len() >= SHORTEST)
}

/// The bytes of a file with one blank for white space, also where a script escapes a line end.
fn plain(mut bytes: &[u8]) -> Vec<u8> {
    let mut plain = Vec::with_capacity(bytes.len());
    while let Some((&byte, rest)) = bytes.split_first() {
        let end = bytes.strip_prefix(b"\\n");
        bytes = end.unwrap_or(rest);
        if end.is_none() && !byte.is_ascii_whitespace() {
            plain.push(byte);
        } else if plain.last() != Some(&b' ') {
            plain.push(b' ');
        }
    }
    plain
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
    use proptest::prelude::*;
    use serde_json::{Map, Value};

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
            page.split_once("</title>\n<script type=\"text/plain\" data-file=\"lang/de/words.json\">").unwrap();
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
    fn compressed_files_of_a_page_are_searched() {
        let element = |text: &str| format!("<script type=\"text/zlib\" data-file=\"a.wasm\">{text}</script>");
        let packed = lsystem_files::packed::pack(b"\0Nothing grows\xff");
        let page = PAGE.to_owned() + &element("damaged!") + &element(&packed);
        let words = PageWords { language: "de", catalogue: r#"{"Nothing grows": "A", "Nothing else": "B"}"# };
        let page = words.give_to(&page, "").unwrap();
        assert!(page.contains(r#"{"Nothing grows":"A"}"#), "{page}");
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

    /// The same texts as [`words_in`] gives, from decoded keys, by one search for each part.
    fn naive(catalogue: &str, file: &str) -> Map<String, Value> {
        let blank = |text: &str| {
            let mut text = text.replace("\\n", " ").replace(|c: char| c.is_ascii_whitespace(), " ");
            while text.contains("  ") {
                text = text.replace("  ", " ");
            }
            text
        };
        let file = blank(file);
        let mut words: Map<String, Value> = serde_json::from_str(catalogue).unwrap();
        words.retain(|key, _| {
            let mut parts = key.split(|c| "{}`'\"\\$&<>".contains(c) || !(' '..='~').contains(&c)).map(blank);
            parts.all(|part| part.len() < SHORTEST || file.contains(&part))
        });
        words
    }

    #[test]
    fn keys_are_read_as_by_a_reader_of_json() {
        let page = concat!(include_str!("../../../www/index.html"), include_str!("../../../www/js/main.js"));
        for code in ["de", "fr"] {
            let file = format!("{}/../../www/lang/{code}/words.json", env!("CARGO_MANIFEST_DIR"));
            let catalogue = std::fs::read_to_string(file).unwrap();
            let words = naive(&catalogue, page);
            assert!((10..1000).contains(&words.len()), "{}", words.len());
            let found = words_in(&catalogue, &[page.as_bytes()]).unwrap();
            assert_eq!(found, serde_json::to_string(&words).unwrap());
        }
    }

    proptest! {
        #![proptest_config(test_effort::config())]

        #[test]
        fn any_texts_are_read_as_by_a_reader_of_json(
            texts in prop::collection::btree_map("(four|abcd|n|u00| |[\"\\\\\n\t{}\\[\\]:,é…\u{1}😀]){0,6}", "[a\"\\\\{},:é]{0,4}", 0..6),
            file in "(four|abcd|n|u00| |\\\\n|\n){0,9}",
        ) {
            let list = texts.iter().map(|(key, value)| (key.clone(), serde_json::json!({ "one": value, "other": [value] })));
            let catalogue = Value::from_iter(list);
            for catalogue in [catalogue.to_string(), format!("{catalogue:#}\n")] {
                let found = words_in(&catalogue, &[file.as_bytes()]).unwrap();
                prop_assert_eq!(found, serde_json::to_string(&naive(&catalogue, &file)).unwrap());
            }
        }
    }

    #[test]
    fn what_is_no_page_or_no_catalogue_gets_nothing() {
        assert!(PageWords { language: "de", catalogue: "{}" }.give_to("<p>", "").is_none());
        for catalogue in ["", "[", "[]", "{", r#"{"a": "b"#, r#"{"a": "b\"}"#, r#"{"a": {"b": "c"}"#, "{}}"] {
            assert!(PageWords { language: "de", catalogue }.give_to(PAGE, "").is_none(), "{catalogue}");
        }
        assert_eq!(words_in(" {\n} ", &[]).unwrap(), "{}");
    }
}
