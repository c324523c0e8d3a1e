//! The public address of the site. `homepage` of Cargo.toml is the only place that has it.

use crate::files;
use crate::html::rewrite;
use crate::workspace::Workspace;
use anyhow::{Context, Result, ensure};
use fs_err as fs;
use lol_html::element;
use lol_html::html_content::{ContentType, Element};
use std::path::Path;

/// The picture that a link to the page shows, and its size in pixels.
const PICTURE: (&str, &str, &str) = ("gallery/abop-1.24b.png", "1200", "630");

/// An address with a slash at its end, and the one that the documents name in its place.
pub(crate) struct Address {
    own: String,
    placeholder: String,
}

impl Address {
    /// The address in Cargo.toml.
    pub(crate) fn placeholder(workspace: &Workspace) -> Result<String> {
        let metadata = workspace.metadata()?;
        let mut homes = metadata["packages"].as_array().into_iter().flatten().map(|package| &package["homepage"]);
        Ok(homes.find_map(|home| home.as_str()).context("no crate has a homepage")?.to_owned())
    }

    /// A given address, or the placeholder if nothing is given.
    pub(crate) fn new(placeholder: &str, given: &str) -> Result<Self> {
        let own = if given.is_empty() { placeholder } else { given };
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-._~:/%".contains(c);
        ensure!(
            (own.starts_with("https://") || own.starts_with("http://")) && own.chars().all(is_plain),
            "an address is like https://example.org/l-systems/, without ? and #: {own}"
        );
        let own = format!("{}/", own.trim_end_matches('/'));
        Ok(Self { own, placeholder: placeholder.to_owned() })
    }

    pub(crate) fn as_str(&self) -> &str {
        &self.own
    }

    /// Names the address in the finished page and in the documents.
    pub(crate) fn name(&self, site: &Path) -> Result<()> {
        let index = site.join("index.html");
        files::write(&index, self.page(&fs::read_to_string(&index)?)?)?;
        let is_text = |path: &Path| path.extension().is_some_and(|ending| ending == "html" || ending == "md");
        let documents = [files::list(&site.join("docs"), is_text)?, files::list(&site.join("llms.txt"), |_| true)?];
        documents.iter().flatten().try_for_each(|file| files::write(file, self.document(&fs::read_to_string(file)?)))
    }

    /// The page with what chat programs and social networks show of a link to it. The hash, which holds the drawing, is
    /// not sent to a server, so that every drawing has this picture.
    fn page(&self, page: &str) -> Result<String> {
        let (picture, width, height) = PICTURE;
        let tags = format!(
            "<link rel=\"canonical\" href=\"{own}\"><meta property=\"og:type\" content=\"website\">\
             <meta property=\"og:title\" content=\"L-systems\"><meta property=\"og:url\" content=\"{own}\">\
             <meta property=\"og:image\" content=\"{own}{picture}\"><meta property=\"og:image:width\" content=\"{width}\">\
             <meta property=\"og:image:height\" content=\"{height}\"><meta name=\"twitter:card\" content=\"summary_large_image\">",
            own = self.own
        );
        let add = |description: &mut Element<'_, '_>| {
            let words = description.get_attribute("content").unwrap_or_default();
            let words = words.replace('"', "&quot;");
            let all = format!("<meta property=\"og:description\" content=\"{words}\">{tags}");
            description.after(&all, ContentType::Html);
            Ok(())
        };
        let named = rewrite(page, [element!("meta[name=description]", add)])?;
        ensure!(named != page, "the page has no description");
        Ok(named)
    }

    /// A document with this address and its origin in place of the placeholder's.
    fn document(&self, text: &str) -> String {
        let origin = |address: &str| address.splitn(4, '/').take(3).collect::<Vec<_>>().join("/");
        let text = text.replace(&self.placeholder, &self.own);
        // The origin stands in quotes, as a text of a program.
        let quoted = |address: &str, quote: &str| format!("{quote}{}{quote}", origin(address));
        ["'", "&#39;", "&#x27;"]
            .iter()
            .fold(text, |text, quote| text.replace(&quoted(&self.placeholder, quote), &quoted(&self.own, quote)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACEHOLDER: &str = "https://example.org/l-systems/";

    #[test]
    fn addresses_end_with_a_slash_and_hold_nothing_else() {
        let own = |given| Address::new(PLACEHOLDER, given).map(|address| address.own);
        assert_eq!(own("").unwrap(), PLACEHOLDER);
        assert_eq!(own("https://a.example").unwrap(), "https://a.example/");
        assert_eq!(own("http://localhost:8080/l/").unwrap(), "http://localhost:8080/l/");
        for wrong in ["a.example", "https://a.example/#v=1", "https://a.example/?a", "https://a.example/\"b"] {
            assert!(own(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_crates_have_an_address() {
        let found = Address::placeholder(&Workspace::find().unwrap()).unwrap();
        assert_eq!(Address::new(&found, "").unwrap().own, found);
    }

    #[test]
    fn pages_and_documents_name_the_address() {
        let address = Address::new(PLACEHOLDER, "https://a.example/b").unwrap();
        let page = address.page("<head><meta name=\"description\" content='A \"plant\"'></head>").unwrap();
        for part in [
            "og:description\" content=\"A &quot;plant&quot;\">",
            "og:image\" content=\"https://a.example/b/gallery/",
            "canonical\" href=\"https://a.example/b/\">",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert!(address.page("<head></head>").is_err());
        let text = "<a href=\"https://example.org/l-systems/v1/\"> const SITE = 'https://example.org'; https://example.org/other";
        let named = "<a href=\"https://a.example/b/v1/\"> const SITE = 'https://a.example'; https://example.org/other";
        assert_eq!(address.document(text), named);
    }
}
