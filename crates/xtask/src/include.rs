//! Elements that two pages have in common: they stand in one page, and the other includes them.

use anyhow::{Context, Result};

/// Replaces comments such as `<!-- index.html#reader -->` by the named elements of another page. `name` is the other
/// page's file name, `other` its text.
pub(crate) fn include(page: &str, name: &str, other: &str) -> Result<String> {
    let mut result = String::new();
    let mut rest = page;
    let mark = format!("<!-- {name}#");
    while let Some((before, after)) = rest.split_once(&mark) {
        let (id, after) = after.split_once(" -->").context("a comment does not end")?;
        result.push_str(before);
        result.push_str(element(other, id).with_context(|| format!("{name} has no whole element #{id}"))?);
        rest = after;
    }
    result.push_str(rest);
    Ok(result)
}

/// The text of an element with its tags.
fn element<'a>(page: &'a str, id: &str) -> Option<&'a str> {
    let start = page[..page.find(&format!(" id=\"{id}\""))?].rfind('<')?;
    let text = &page[start..];
    let name = text[1..].split(|character: char| !character.is_ascii_alphanumeric()).next()?;
    let (opening, closing) = (format!("<{name}"), format!("</{name}>"));
    let mut depth = 0;
    let mut at = 0;
    loop {
        let close = at + text[at..].find(&closing)?;
        let opened = text[at..close].match_indices(&opening);
        // The name of another tag may begin with this name.
        depth += opened.filter(|(place, _)| text[at + place + opening.len()..].starts_with([' ', '>'])).count();
        depth -= 1;
        at = close + closing.len();
        if depth == 0 {
            return Some(&text[..at]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn includes_elements_of_another_page() {
        let other =
            "<section id=\"a\"><section>1</section><p>2</section><section id=\"b\"></section><sectional></section>";
        let page = include("<p><!-- o.html#a --></p><!-- o.html#b -->", "o.html", other).unwrap();
        assert_eq!(page, "<p><section id=\"a\"><section>1</section><p>2</section></p><section id=\"b\"></section>");
        assert!(include("<!-- o.html#c -->", "o.html", other).is_err());
        assert!(include("<!-- o.html#a -->", "o.html", "<section id=\"a\">").is_err());
    }
}
