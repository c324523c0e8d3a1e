//! The public address of the site. `homepage` of Cargo.toml is the only place that has it.

use crate::files;
use crate::html::rewrite;
use anyhow::{Result, ensure};
use fs_err as fs;
use lol_html::element;
use lol_html::html_content::{ContentType, Element};
use std::path::Path;

/// The picture that a link to the page shows, and its size in pixels.
const PICTURE: (&str, &str, &str) = ("gallery/abop-1.24b.png", "1200", "630");

/// The address that the documents name in place of the site's.
const PLACEHOLDER: &str = "https://example.org/l-systems/";

/// An address with a slash at its end.
pub(crate) struct Address(String);

impl Address {
    /// A given address, or that of Cargo.toml if nothing is given.
    pub(crate) fn new(given: &str) -> Result<Self> {
        let own = if given.is_empty() { env!("CARGO_PKG_HOMEPAGE") } else { given };
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-._~:/%".contains(c);
        ensure!(
            (own.starts_with("https://") || own.starts_with("http://")) && own.chars().all(is_plain),
            "an address is like https://example.org/l-systems/, without ? and #: {own}"
        );
        Ok(Self(format!("{}/", own.trim_end_matches('/'))))
    }

    pub(crate) fn as_str(&self) -> &str {
        &self.0
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
            own = self.0
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

    /// A document with this address and its origin in place of those of Cargo.toml. The origin stands in quotes, as a text
    /// of a program.
    fn document(&self, text: &str) -> String {
        let quoted = |address| format!("'{}'", origin(address));
        text.replace(PLACEHOLDER, &self.0).replace(&quoted(PLACEHOLDER), &quoted(&self.0))
    }
}

/// The address without its path.
fn origin(address: &str) -> &str {
    let path = address.match_indices('/').nth(2).map_or(address.len(), |(at, _)| at);
    &address[..path]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_end_with_a_slash_and_hold_nothing_else() {
        let own = |given| Address::new(given).map(|address| address.0);
        assert_eq!(own("").unwrap(), env!("CARGO_PKG_HOMEPAGE"));
        assert_eq!(own("https://a.example").unwrap(), "https://a.example/");
        assert_eq!(own("http://localhost:8080/l/").unwrap(), "http://localhost:8080/l/");
        for wrong in ["a.example", "https://a.example/#v=1", "https://a.example/?a", "https://a.example/\"b"] {
            assert!(own(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn pages_and_documents_name_the_address() {
        let address = Address::new("https://a.example/b").unwrap();
        let page = address.page("<head><meta name=\"description\" content='A \"plant\"'></head>").unwrap();
        for part in [
            "og:description\" content=\"A &quot;plant&quot;\">",
            "og:image\" content=\"https://a.example/b/gallery/",
            "canonical\" href=\"https://a.example/b/\">",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert!(address.page("<head></head>").is_err());
        let root = crate::workspace::Workspace::find().unwrap().root;
        for document in ["docs/embedding.md", "docs/assistants.md", "www/llms.txt"] {
            assert!(fs::read_to_string(root.join(document)).unwrap().contains(PLACEHOLDER), "{document}");
        }
        let own = origin(PLACEHOLDER);
        let text = format!("<a href=\"{PLACEHOLDER}v1/\"> const SITE = '{own}'; {own}/other");
        let named = format!("<a href=\"https://a.example/b/v1/\"> const SITE = 'https://a.example'; {own}/other");
        assert_eq!(address.document(&text), named);
    }
}
