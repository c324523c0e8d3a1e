//! Markdown to HTML. Raw HTML is refused, and every link leads to a page of the site or to another site.

use super::drawing;
use anyhow::{Result, bail, ensure};
use lsystem_base::say;
use pulldown_cmark::{CodeBlockKind, Event, HeadingLevel, LinkType, Options, Parser, Tag, TagEnd, html};
use std::collections::HashMap;
use std::fmt::Write as _;

/// From this number of sections on, a page has a table of contents.
const CONTENTS_FROM: usize = 4;
/// Code up to this length stays on one line, because its parts are hard to read; it fits on a phone. In characters.
const SHORT_CODE: usize = 28;
/// The longest summary, in characters.
const LONGEST_SUMMARY: usize = 160;

/// The possible targets of a document's links.
pub(super) struct Site<'a> {
    /// The names of the documents that are pages.
    pub(super) pages: &'a [&'a str],
    /// What the names of pages have before `.html`.
    pub(super) ending: &'a str,
    /// Whether the site has a file at this path.
    pub(super) is_shipped: &'a dyn Fn(&str) -> bool,
}

/// A rendered document.
#[derive(Debug)]
pub(super) struct Document {
    /// The first heading, as text.
    pub(super) title: String,
    /// The beginning of the first paragraph, as text.
    pub(super) summary: String,
    pub(super) body: String,
    /// The names of the pictures beside the document.
    pub(super) images: Vec<String>,
    /// The levels and ids of all headings.
    headings: Vec<(HeadingLevel, String)>,
    /// How many rows its tables have.
    rows: usize,
}

/// Renders a document. A translated one has the headings of the original, in order, with their ids, so that links to
/// sections hold in all languages.
pub(super) fn render(text: &str, site: &Site, original: Option<&Document>) -> Result<Document> {
    let mut renderer = Renderer {
        site,
        given: original.map(|original| &*original.headings),
        headings: vec![],
        rows: 0,
        out: vec![],
        ids: HashMap::new(),
        sections: vec![],
        section: String::new(),
        in_link: false,
        images: vec![],
    };
    let mut title = String::new();
    let mut summary = String::new();
    // Where the table of contents goes: in front of the first section.
    let mut first_section = None;
    let mut events = Parser::new_ext(text, Options::ENABLE_TABLES);
    while let Some(event) = events.next() {
        match event {
            Event::Start(Tag::Heading { level, .. }) => {
                if level == HeadingLevel::H2 {
                    first_section.get_or_insert(renderer.out.len());
                }
                let words = renderer.heading(level, inside(&mut events, TagEnd::Heading(level)))?;
                if level == HeadingLevel::H1 && title.is_empty() {
                    title = words;
                }
            }
            Event::Start(Tag::Paragraph) => {
                let inner = inside(&mut events, TagEnd::Paragraph);
                if summary.is_empty() {
                    summary = shortened(&plain(&inner));
                }
                renderer.out.push(Event::Start(Tag::Paragraph));
                renderer.events(inner)?;
                renderer.out.push(Event::End(TagEnd::Paragraph));
            }
            Event::Start(Tag::CodeBlock(kind)) => {
                let code = plain(&inside(&mut events, TagEnd::CodeBlock));
                renderer.code(&kind, &code)?;
            }
            event => renderer.event(event)?,
        }
    }
    ensure!(!title.is_empty(), "the document has no title");
    if renderer.sections.len() >= CONTENTS_FROM {
        let contents = Event::Html(contents(&renderer.sections).into());
        renderer.out.insert(first_section.unwrap_or_default(), contents);
    }
    let mut body = String::new();
    html::push_html(&mut body, renderer.out.into_iter());
    if let Some(original) = original {
        ensure!(renderer.headings.len() == original.headings.len(), "the original has other sections");
        ensure!(
            renderer.rows == original.rows,
            "the original has {} rows of tables, this {}",
            original.rows,
            renderer.rows
        );
        ensure!(renderer.images == original.images, "the original has other pictures");
    }
    Ok(Document { title, summary, body, images: renderer.images, headings: renderer.headings, rows: renderer.rows })
}

/// The events up to the end of an element, without the end.
fn inside<'a>(events: &mut Parser<'a>, end: TagEnd) -> Vec<Event<'a>> {
    events.take_while(|event| *event != Event::End(end)).collect()
}

struct Renderer<'a, 's> {
    site: &'s Site<'s>,
    /// The headings of the original.
    given: Option<&'s [(HeadingLevel, String)]>,
    headings: Vec<(HeadingLevel, String)>,
    rows: usize,
    out: Vec<Event<'a>>,
    /// How many headings have had an id so far.
    ids: HashMap<String, usize>,
    /// The ids and words of the headings of level 2.
    sections: Vec<(String, String)>,
    /// The words of the last heading. Tables and code are named by it.
    section: String,
    /// Whether the current link leads anywhere. Links have no links inside.
    in_link: bool,
    images: Vec<String>,
}

impl<'a> Renderer<'a, '_> {
    fn html(&mut self, text: impl Into<String>) {
        self.out.push(Event::Html(text.into().into()));
    }

    fn inline(&mut self, text: impl Into<String>) {
        self.out.push(Event::InlineHtml(text.into().into()));
    }

    fn events(&mut self, events: Vec<Event<'a>>) -> Result<()> {
        let mut events = events.into_iter();
        while let Some(event) = events.next() {
            if let Event::Start(Tag::Image { dest_url, .. }) = event {
                let alt: Vec<_> = events.by_ref().take_while(|event| *event != Event::End(TagEnd::Image)).collect();
                self.image(&dest_url, &plain(&alt))?;
            } else {
                self.event(event)?;
            }
        }
        Ok(())
    }

    fn event(&mut self, event: Event<'a>) -> Result<()> {
        match event {
            Event::Html(text) | Event::InlineHtml(text) => {
                let text = text.trim();
                let comment = text.strip_prefix("<!--").and_then(|text| text.strip_suffix("-->"));
                ensure!(comment.is_some_and(|comment| !comment.contains("-->")), "raw HTML is not rendered: {text}");
            }
            Event::Start(Tag::HtmlBlock) | Event::End(TagEnd::HtmlBlock) => {}
            Event::Start(Tag::Link { link_type, dest_url, .. }) => {
                ensure!(link_type != LinkType::Email, "an e-mail address as a link: {dest_url}");
                let address = address(&dest_url, self.site)?;
                self.in_link = address.is_some();
                if let Some(address) = address {
                    let rel = if is_elsewhere(&address) { " rel=\"noopener\"" } else { "" };
                    self.inline(format!("<a href=\"{}\"{rel}>", escape(&address)));
                }
            }
            Event::End(TagEnd::Link) if self.in_link => self.inline("</a>"),
            Event::End(TagEnd::Link) => {}
            Event::Start(Tag::Image { .. }) => bail!("a picture must stand in a paragraph"),
            Event::Code(code) => {
                let class = if code.chars().count() <= SHORT_CODE { " class=\"short\"" } else { "" };
                self.inline(format!("<code{class}>{}</code>", escape(&code)));
            }
            Event::Start(Tag::TableRow) => {
                self.rows += 1;
                self.out.push(event);
            }
            // A table can be wider than a phone. Scrolling by keyboard needs the focus, and the focus a name.
            Event::Start(Tag::Table(alignments)) => {
                let name = escape(&say!("Table: {}", self.section));
                self.html(format!("<div class=\"table\" role=\"group\" aria-label=\"{name}\" tabindex=\"0\">"));
                self.out.push(Event::Start(Tag::Table(alignments)));
            }
            Event::End(TagEnd::Table) => {
                self.out.push(Event::End(TagEnd::Table));
                self.html("</div>\n");
            }
            other => self.out.push(other),
        }
        Ok(())
    }

    /// Writes a heading with an id, and returns its words.
    fn heading(&mut self, level: HeadingLevel, inner: Vec<Event<'a>>) -> Result<String> {
        let words = plain(&inner);
        let id = match self.given {
            None => self.id(&words),
            Some(given) => match given.get(self.headings.len()) {
                Some((of, id)) if *of == level => id.clone(),
                _ => bail!("the original has no such heading: {words}"),
            },
        };
        self.headings.push((level, id.clone()));
        if level == HeadingLevel::H2 {
            self.sections.push((id.clone(), words.clone()));
        }
        self.section.clone_from(&words);
        self.html(format!("<{level} id=\"{id}\">"));
        self.events(inner)?;
        self.html(format!("</{level}>\n"));
        Ok(words)
    }

    /// An id as code hosts make it, so that links to sections work on both.
    fn id(&mut self, words: &str) -> String {
        let kept = words.to_lowercase().replace(' ', "-");
        let id: String = kept.chars().filter(|c| c.is_alphanumeric() || ['-', '_'].contains(c)).collect();
        let count = self.ids.entry(id.clone()).or_default();
        *count += 1;
        if *count == 1 { id } else { format!("{id}-{}", *count - 1) }
    }

    fn code(&mut self, kind: &CodeBlockKind, code: &str) -> Result<()> {
        if matches!(kind, CodeBlockKind::Fenced(language) if &**language == "lsystem") {
            let frame = drawing::frame(code)?;
            self.html(frame);
        } else {
            let (name, code) = (escape(&say!("Code: {}", self.section)), escape(code));
            self.html(format!(
                "<pre class=\"block\" role=\"group\" aria-label=\"{name}\" tabindex=\"0\"><code>{code}</code></pre>\n"
            ));
        }
        Ok(())
    }

    fn image(&mut self, name: &str, alt: &str) -> Result<()> {
        let is_plain = !name.contains(['/', '\\', ':']) && [".svg", ".png"].iter().any(|end| name.ends_with(end));
        ensure!(is_plain, "a picture must be an SVG or PNG file beside the document: {name}");
        ensure!(!alt.is_empty(), "a picture needs a description: {name}");
        self.images.push(name.to_owned());
        self.inline(format!("<img src=\"{}\" alt=\"{}\" loading=\"lazy\">", escape(name), escape(alt)));
        Ok(())
    }
}

/// The address of a link's destination on the site; `None` for a file of the repository that the site does not have.
fn address(link: &str, site: &Site) -> Result<Option<String>> {
    if link.starts_with('#') || is_elsewhere(link) {
        return Ok(Some(link.to_owned()));
    }
    ensure!(!link.contains(':') && !link.starts_with('/'), "the link `{link}` has another scheme or leaves the site");
    let (path, hash) = link.find('#').map_or((link, ""), |at| link.split_at(at));
    if path == "../" {
        return Ok(Some(link.to_owned()));
    }
    if let Some(name) = path.strip_suffix(".md").filter(|name| site.pages.contains(name)) {
        return Ok(Some(format!("{name}{}.html{hash}", site.ending)));
    }
    // The repository keeps the pages of the site in `www`.
    let shipped = path.strip_prefix("../www/").filter(|path| (site.is_shipped)(path));
    Ok(shipped.map(|path| format!("../{path}{hash}")))
}

fn is_elsewhere(link: &str) -> bool {
    link.starts_with("https://") || link.starts_with("http://")
}

fn contents(sections: &[(String, String)]) -> String {
    let name = escape(&say!("On this page"));
    let mut text = format!("<nav class=\"contents\" aria-label=\"{name}\">\n<ul>\n");
    for (id, words) in sections {
        _ = writeln!(text, "<li><a href=\"#{id}\">{}</a></li>", escape(words));
    }
    text + "</ul>\n</nav>\n"
}

/// The text of events without markup.
fn plain(events: &[Event]) -> String {
    events.iter().fold(String::new(), |mut text, event| {
        match event {
            Event::Text(part) | Event::Code(part) => text.push_str(part),
            Event::SoftBreak | Event::HardBreak => text.push(' '),
            _ => {}
        }
        text
    })
}

/// The first whole words of a text.
pub(crate) fn shortened(text: &str) -> String {
    if text.chars().count() <= LONGEST_SUMMARY {
        return text.to_owned();
    }
    let start: String = text.chars().take(LONGEST_SUMMARY).collect();
    let words = start.rsplit_once(' ').map_or(&*start, |(words, _)| words);
    format!("{}…", words.trim_end_matches([',', ';', ':', '.']))
}

/// A text as part of HTML, also inside quotes.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rendered(text: &str) -> Result<Document> {
        let site = Site { pages: &["links", "lesson"], ending: "", is_shipped: &|path| path == "course.html" };
        render(&format!("# Title\n\n{text}\n"), &site, None)
    }

    fn body(text: &str) -> String {
        rendered(text).unwrap().body
    }

    #[track_caller]
    fn check(text: &str, expected: &str) {
        let body = body(text);
        assert!(body.contains(expected), "{expected}\n{body}");
    }

    #[test]
    fn links_lead_to_pages() {
        check("[a](links.md)", "<a href=\"links.html\">a</a>");
        check("[a](lesson.md#colours-by-level)", "<a href=\"lesson.html#colours-by-level\">a</a>");
        check("[a](#b)", "<a href=\"#b\">a</a>");
        check("[a](../)", "<a href=\"../\">a</a>");
        check("[a](../#v=1&n=2)", "<a href=\"../#v=1&amp;n=2\">a</a>");
        check("[a](../www/course.html)", "<a href=\"../course.html\">a</a>");
        check(
            "[`a`](https://a.example/?b&c)",
            "<a href=\"https://a.example/?b&amp;c\" rel=\"noopener\"><code class=\"short\">a</code></a>",
        );
    }

    #[test]
    fn links_to_files_of_the_repository_become_words() {
        for file in ["worker.md", "../README.md", "../www/test/unit/links.json", "../LICENSE-MIT"] {
            check(&format!("[*a*]({file}) b"), "<p><em>a</em> b</p>");
        }
        for link in ["javascript:alert(1)", "/etc", "data:text/html,a", "//a.example", "mailto:a@b.example"] {
            assert!(rendered(&format!("[a]({link})")).is_err(), "{link}");
        }
    }

    #[test]
    fn headings_have_ids_and_contents() {
        let three = "## A `B`, c!\n\n## Two\n\ntext\n\n## Two\n\n";
        check(three, "<h2 id=\"a-b-c\">A <code class=\"short\">B</code>, c!</h2>\n<h2 id=\"two\">Two</h2>");
        check(three, "<h2 id=\"two-1\">Two</h2>");
        assert!(!body(three).contains("<nav"));
        check(
            &format!("first\n\n{three}## <\n"),
            "<p>first</p>\n<nav class=\"contents\" aria-label=\"On this page\">\n<ul>\n\
             <li><a href=\"#a-b-c\">A B, c!</a></li>",
        );
        let document = rendered("An *L-system*\nrewrites.\n\nMore.").unwrap();
        assert_eq!((&*document.title, &*document.summary), ("Title", "An L-system rewrites."));
        assert_eq!(shortened(&"word, ".repeat(50)), format!("{}word…", "word, ".repeat(25)));
    }

    #[test]
    fn fenced_drawings_become_frames() {
        let text = "```lsystem\ntitle: Koch\naxiom: F\nrules: F -> F+F--F+F\nn: 3\nangle: 60\n```";
        check(
            text,
            "<iframe class=\"drawing\" title=\"Drawing: Koch\" loading=\"lazy\" src=\"../embed.html#v=1&amp;title=Koch",
        );
        assert!(rendered("```lsystem\nnothing: 1\n```").is_err());
    }

    #[test]
    fn code_and_tables_are_text() {
        check(
            "## A\n\n```html\n<script>a && \"b\"\n```",
            "aria-label=\"Code: A\" tabindex=\"0\"><code>&lt;script&gt;a &amp;&amp;",
        );
        check(
            "|a|b|\n|-|-|\n|`<b>`|c|",
            "<div class=\"table\" role=\"group\" aria-label=\"Table: Title\" tabindex=\"0\"><table>",
        );
        check(
            "|a|b|\n|-|-|\n|`<b>`|c|",
            "<td><code class=\"short\">&lt;b&gt;</code></td><td>c</td></tr>\n</tbody></table>\n</div>",
        );
    }

    #[test]
    fn no_raw_html_passes() {
        for html in ["<script>a</script>", "a <b>c</b>", "<img src=x onerror=a>", "<!-- a --> <i> <!-- b -->"] {
            assert!(rendered(html).is_err(), "{html}");
        }
        let body = body("<!-- fields: a -->\n| a | b |\n|---|---|\n| c | d |\n<!-- end -->\n\na <!-- b --> 1 < 2");
        assert!(!body.contains("<!--") && body.contains("<th>a</th>") && body.contains("1 &lt; 2"), "{body}");
    }

    #[test]
    fn pictures_stand_beside_the_document() {
        let document = rendered("![A *leaf*](leaf.svg)").unwrap();
        assert_eq!(document.images, ["leaf.svg"]);
        assert!(
            document.body.contains("<p><img src=\"leaf.svg\" alt=\"A leaf\" loading=\"lazy\"></p>"),
            "{}",
            document.body
        );
        for wrong in ["![a](../a.svg)", "![](a.svg)", "![a](https://a.example/a.png)", "![a](a.html)"] {
            assert!(rendered(wrong).is_err(), "{wrong}");
        }
    }
}
