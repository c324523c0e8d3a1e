//! The documents of `docs/` as pages of the site: `docs/NAME.html`, and in another language `docs/NAME.de.html`, from
//! `www/lang/de/docs/`. A document that a language does not have stands there in English, so that links lead somewhere.

mod drawing;
mod markdown;

use crate::language;
use anyhow::{Context, Result, bail};
use fs_err as fs;
use lsystem_base::words::said;
use lsystem_base::{say, word};
use markdown::Site;
pub(crate) use markdown::{escape, shortened};
use std::path::Path;

/// The documents that become pages. Documents for developers, such as `worker.md`, are left out.
const PAGES: &str = "lesson notation links embedding books notebooks exercises marking classroom growth find films papers \
    plotting meshes sound about security access hosting assistants imports scale";
/// The document that the site also has as Markdown, as `llms.txt` names it.
const PLAIN: &str = "assistants";
/// The pages in the navigation line, with their names.
const NAVIGATION: [(&str, &str); 6] = [
    ("lesson", word!("Lesson")),
    ("notation", word!("Notation")),
    ("links", word!("Links")),
    ("embedding", word!("Embedding")),
    ("exercises", word!("Exercises")),
    ("about", word!("About")),
];

/// Where documents are read and written.
pub(crate) struct Folders<'a> {
    /// The documents, and their pictures.
    pub(crate) docs: &'a Path,
    /// The documents in the language of the pages.
    pub(crate) told: Option<&'a Path>,
    pub(crate) template: &'a Path,
    pub(crate) site: &'a Path,
}

/// Writes the pages and their pictures into the folder of the site. The other pages of the site must be in place,
/// because documents link to them.
pub(crate) fn write_pages(folders: &Folders) -> Result<()> {
    let Folders { docs, told, template, site } = *folders;
    let out = site.join("docs");
    fs::create_dir_all(&out)?;
    let template = fs::read_to_string(template)?;
    let is_shipped = |path: &str| site.join(path).is_file();
    let ending = language::ending();
    let pages: Vec<&str> = PAGES.split_whitespace().collect();
    let rules = Site { pages: &pages, ending: &ending, is_shipped: &is_shipped };
    for &name in &pages {
        let text = fs::read_to_string(docs.join(format!("{name}.md")))?;
        let mut document = markdown::render(&text, &rules, None).with_context(|| format!("in docs/{name}.md"))?;
        let told = told.map(|told| told.join(format!("{name}.md"))).filter(|told| told.exists());
        let language = if told.is_some() { language::language() } else { "en" };
        if let Some(told) = told {
            let text = fs::read_to_string(&told)?;
            document = markdown::render(&text, &rules, Some(&document)).with_context(|| told.display().to_string())?;
        }
        let page = Page {
            docs: "",
            name,
            title: &document.title,
            description: &document.summary,
            head: "",
            language,
            body: &document.body,
        };
        fs::write(out.join(format!("{name}{ending}.html")), page.fill(&template)?)?;
        if name == PLAIN && ending.is_empty() {
            fs::write(out.join(format!("{name}.md")), &text)?;
        }
        for image in &document.images {
            fs::copy(docs.join(image), out.join(image))?;
        }
    }
    Ok(())
}

/// A page of text: what stands in the template `www/docs/page.html`.
pub(crate) struct Page<'a> {
    /// The way from the page's folder to `docs/`: empty, or with a slash at its end.
    pub(crate) docs: &'a str,
    /// The name in the navigation line; empty for none.
    pub(crate) name: &'a str,
    pub(crate) title: &'a str,
    pub(crate) description: &'a str,
    /// Further elements of the head, as HTML.
    pub(crate) head: &'a str,
    /// The language of the text.
    pub(crate) language: &'a str,
    /// The text, as HTML.
    pub(crate) body: &'a str,
}

impl Page<'_> {
    /// The template around the text.
    pub(crate) fn fill(&self, template: &str) -> Result<String> {
        let Page { docs, name, title, description, head, language, body } = self;
        let ending = language::ending();
        let navigation: String = NAVIGATION
            .iter()
            .map(|(page, words)| {
                let current = if page == name { " aria-current=\"page\"" } else { "" };
                let words = escape(&said(words));
                format!("<li><a href=\"{docs}{page}{ending}.html\"{current}>{words}</a></li>\n")
            })
            .collect();
        fill(
            template,
            &[
                ("title", &escape(title)),
                ("description", &escape(description)),
                ("head", head),
                ("docs", docs),
                ("navigation", &navigation),
                ("body", body),
                ("version", env!("CARGO_PKG_VERSION")),
                ("page language", language::language()),
                ("text language", language),
                ("ending", &ending),
                ("pages", &escape(&say!("Pages"))),
                ("skip", &escape(&say!("Skip to the text"))),
                ("open", &escape(&say!("Open the playground"))),
                ("about", &escape(&say!("About"))),
                ("security", &escape(&say!("Security"))),
            ],
        )
    }
}

/// Replaces `{{name}}` by the value of this name. Values are not searched for names.
pub(crate) fn fill(template: &str, values: &[(&str, &str)]) -> Result<String> {
    let mut filled = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").context("a placeholder does not end")?;
        let Some((_, value)) = values.iter().find(|(each, _)| *each == name) else {
            bail!("there is no value for the placeholder `{name}`");
        };
        filled.push_str(before);
        filled.push_str(value);
        rest = after;
    }
    Ok(filled + rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn writes_pages_and_pictures() {
        let folder = tempfile::tempdir().unwrap();
        let [docs, template, site] = ["docs", "page.html", "site"].map(|name| folder.path().join(name));
        fs::create_dir(&docs).unwrap();
        for name in PAGES.split_whitespace() {
            fs::write(docs.join(format!("{name}.md")), format!("# The {name}\n\nA & b.\n")).unwrap();
        }
        fs::write(docs.join("about.md"), "# About\n\n![A leaf](leaf.svg)\n").unwrap();
        fs::write(docs.join("leaf.svg"), "<svg/>").unwrap();
        fs::write(&template, "{{title}}|{{description}}|{{head}}{{docs}}{{navigation}}|{{body}}|{{version}}").unwrap();
        write_pages(&Folders { docs: &docs, told: None, template: &template, site: &site }).unwrap();
        let text = fs::read_to_string(site.join("docs/links.html")).unwrap();
        assert!(text.starts_with("The links|A &amp; b.|<li><a href=\"lesson.html\">"), "{text}");
        assert!(text.contains("<a href=\"links.html\" aria-current=\"page\">Links</a>"), "{text}");
        assert_eq!(text.matches("aria-current").count(), 1);
        assert!(text.ends_with(concat!("|", env!("CARGO_PKG_VERSION"))), "{text}");
        assert_eq!(fs::read_to_string(site.join("docs/leaf.svg")).unwrap(), "<svg/>");
        assert!(!site.join("docs/worker.html").exists());
        assert!(site.join("docs/assistants.md").exists() && !site.join("docs/links.md").exists());
    }

    #[test]
    fn fills_placeholders_once() {
        assert_eq!(fill("a {{x}} {{y}}{{x}}", &[("x", "{{y}}"), ("y", "2")]).unwrap(), "a {{y}} 2{{y}}");
        for wrong in ["{{z}}", "{{x"] {
            assert!(fill(wrong, &[("x", "1")]).is_err(), "{wrong}");
        }
    }
}
