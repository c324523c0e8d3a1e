//! Pages as a single file: such a page works from a disk, in frames without an origin, and at any address.
//!
//! The file contains styles, scripts, icons and the files that the page would fetch (`www/js/files.js` reads them
//! there). Links to documents are left out, because the file may stand alone. The page's content security policy allows its own scripts and styles by hash and forbids everything else,
//! above all requests.

use crate::esbuild::Bundler;
use crate::files;
use anyhow::{Context, Result, ensure};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::Path;

/// Makes single files of pages.
pub(crate) struct Maker<'a> {
    /// The folder of the site.
    pub(crate) site: &'a Path,
    pub(crate) bundler: &'a (dyn Bundler + Sync),
}

impl Maker<'_> {
    /// A single file of a page. `carried` are the files that the page would fetch.
    pub(crate) fn make(&self, page: &str, carried: &[impl AsRef<str>]) -> Result<String> {
        let text = files::read_text(&self.site.join(page))?;
        Assembly { maker: self, policy: Policy::default() }
            .assemble(&text, carried)
            .with_context(|| format!("making one file of {page}"))
    }
}

/// A byte in a page: itself, or a character with the byte as its lower half where HTML would read the byte as a control or
/// a tag. Hosts compress such bytes as well as the file itself, in contrast to base64: a wasm takes a third less.
fn character(byte: u8) -> char {
    let is_plain = byte.is_ascii() && ![0, b'\r', b'<'].contains(&byte);
    char::from_u32(u32::from(byte) + if is_plain { 0 } else { 0x100 }).unwrap_or_default()
}

/// The hashes of the scripts and styles that the content security policy allows.
#[derive(Default)]
struct Policy {
    scripts: Vec<String>,
    styles: Vec<String>,
}

impl Policy {
    fn write(&self) -> String {
        let (scripts, styles) = (self.scripts.join(" "), self.styles.join(" "));
        format!(
            "default-src 'none'; script-src {scripts} 'wasm-unsafe-eval'; style-src {styles}; img-src blob: data:; \
             worker-src blob:; base-uri 'none'; form-action 'none'"
        )
    }
}

fn hash(text: &str) -> String {
    format!("'sha256-{}'", BASE64.encode(Sha256::digest(text)))
}

struct Assembly<'a> {
    maker: &'a Maker<'a>,
    policy: Policy,
}

/// A placeholder for the policy until all hashes are known.
const POLICY: &str = "<meta name=\"policy\">";

impl Assembly<'_> {
    fn assemble(mut self, text: &str, carried: &[impl AsRef<str>]) -> Result<String> {
        let mut page = String::new();
        let mut styles = vec![];
        let mut modules = vec![];
        for line in text.lines() {
            let tag = Tag(line);
            match (tag.name(), tag.attribute("rel"), tag.attribute("href").or(tag.attribute("src"))) {
                ("meta", ..) if tag.attribute("http-equiv") == Some("Content-Security-Policy") => page.push_str(POLICY),
                ("link", Some("stylesheet"), Some(name)) => styles.push(name),
                ("link", Some("icon"), Some(name)) => {
                    page.push_str(
                        &line.replace(name, &format!("data:image/svg+xml;base64,{}", BASE64.encode(self.read(name)?))),
                    );
                }
                // Other links preload files or install the page; a single file needs neither.
                ("link", ..) => {}
                ("script", _, Some(name)) if tag.attribute("type") == Some("module") => modules.push(name),
                ("script", _, Some(name)) => {
                    let script = self.read(name)?;
                    page.push_str(&self.script("", &script)?);
                }
                _ if line == "</head>" => {
                    let styles = self.maker.bundler.styles(&styles)?;
                    self.policy.styles.push(hash(&styles));
                    ensure!(
                        !styles.contains("</") && !styles.contains("@import") && !styles.contains("url("),
                        "a style refers to another file or ends its element"
                    );
                    write!(page, "<style>{styles}</style>\n{line}\n")?;
                }
                // The files and the script come last, so that the page is visible before they are read.
                _ if line == "</body>" => {
                    for name in carried {
                        page.push_str(&self.carry(name.as_ref())?);
                    }
                    for module in &modules {
                        let script = self.maker.bundler.module(module)?;
                        page.push_str(&self.script(" type=\"module\"", &script)?);
                    }
                    writeln!(page, "{line}")?;
                }
                _ => writeln!(page, "{}", without_documents(line)?)?,
            }
        }
        let policy = format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n", self.policy.write());
        ensure!(page.contains(POLICY), "the page has no content security policy");
        Ok(page.replacen(POLICY, &policy, 1))
    }

    fn read(&self, name: &str) -> Result<String> {
        files::read_text(&self.maker.site.join(name))
    }

    /// A script element, whose hash the policy allows.
    fn script(&mut self, kind: &str, text: &str) -> Result<String> {
        check_script(text)?;
        self.policy.scripts.push(hash(text));
        Ok(format!("<script{kind}>{text}</script>\n"))
    }

    /// A file as a script element of a type that browsers do not run.
    fn carry(&self, name: &str) -> Result<String> {
        if name.ends_with(".js") {
            let text = self.read(name)?;
            check_script(&text)?;
            return Ok(format!("<script type=\"text/plain\" data-file=\"{name}\">{text}</script>\n"));
        }
        let text: String = files::read(&self.maker.site.join(name))?.into_iter().map(character).collect();
        Ok(format!("<script type=\"text/bytes\" data-file=\"{name}\">{text}</script>\n"))
    }
}

/// A line of the page without its links to documents.
fn without_documents(line: &str) -> Result<String> {
    let mut kept = String::new();
    let mut rest = line;
    while let Some(at) = [" href=\"docs/", " href=\"course.html"].into_iter().filter_map(|link| rest.find(link)).min() {
        let start = rest[..at].rfind('<').with_context(|| format!("no tag begins in `{line}`"))?;
        ensure!(rest[start..].starts_with("<a "), "`{line}` loads a document");
        let end = rest[at..].find("</a>").map(|end| at + end);
        let end = end.with_context(|| format!("a link to a document must end in its line: `{line}`"))?;
        kept.push_str(&rest[..start]);
        rest = &rest[end + "</a>".len()..];
    }
    Ok(kept + rest)
}

/// Checks that a script does not end its element early.
fn check_script(script: &str) -> Result<()> {
    let lower = script.to_ascii_lowercase();
    ensure!(
        !["</script", "<script", "<!--"].iter().any(|end| lower.contains(end)),
        "a script contains text that would end its element"
    );
    Ok(())
}

/// A line that contains one tag, as in the heads of the pages.
pub(crate) struct Tag<'a>(pub(crate) &'a str);

impl<'a> Tag<'a> {
    pub(crate) fn name(&self) -> &'a str {
        let inside = self.0.strip_prefix('<').unwrap_or_default();
        inside.split([' ', '>']).next().unwrap_or_default()
    }

    pub(crate) fn attribute(&self, name: &str) -> Option<&'a str> {
        let (_, rest) = self.0.split_once(&format!(" {name}=\""))?;
        rest.split_once('"').map(|(value, _)| value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_the_lower_halves_of_characters() {
        let text: String = (0..=u8::MAX).map(character).collect();
        assert!(text.chars().zip(0..=u8::MAX).all(|(character, byte)| u32::from(character) & 0xff == u32::from(byte)));
        assert!(!text.contains(['\0', '\r', '<']));
        assert_eq!(text.len(), 256 + 131);
    }

    /// A bundler that returns files unchanged.
    struct Plain<'a>(&'a Path);

    impl Bundler for Plain<'_> {
        fn module(&self, entry: &str) -> Result<String> {
            files::read_text(&self.0.join(entry))
        }

        fn split(&self, _: &str) -> Result<Vec<(String, String)>> {
            unreachable!("a single file is not split")
        }

        fn styles(&self, names: &[&str]) -> Result<String> {
            names.iter().map(|name| files::read_text(&self.0.join(name))).collect()
        }
    }

    fn one_file(site: &Path, carried: &[&str]) -> Result<String> {
        Maker { site, bundler: &Plain(site) }.make("index.html", carried)
    }

    const PAGE: &str = r#"<!doctype html>
<html lang="en">
<head>
<meta http-equiv="Content-Security-Policy" content="default-src 'self'">
<link rel="icon" href="icons/icon.svg" type="image/svg+xml">
<link rel="manifest" href="manifest.webmanifest">
<script src="early.js"></script>
<link rel="stylesheet" href="a.css">
<link rel="stylesheet" href="b.css">
<script type="module" src="main.js"></script>
</head>
<body>
<p>text</p>
</body>
</html>
"#;

    fn site() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in [
            ("index.html", PAGE),
            ("icons/icon.svg", "<svg/>"),
            ("early.js", "early()"),
            ("a.css", "a {}"),
            ("b.css", "b {}"),
            ("main.js", "main()"),
            ("worker.js", "work()"),
            ("data.wasm", "data"),
        ] {
            files::write(&folder.path().join(name), text).unwrap();
        }
        folder
    }

    #[test]
    fn puts_everything_into_the_page() {
        let folder = site();
        let page = one_file(folder.path(), &["worker.js", "data.wasm"]).unwrap();
        for part in [
            "<link rel=\"icon\" href=\"data:image/svg+xml;base64,PHN2Zy8+\" type=\"image/svg+xml\">",
            "<script>early()</script>",
            "<style>a {}b {}</style>\n</head>",
            "<p>text</p>\n<script type=\"text/plain\" data-file=\"worker.js\">work()</script>\n",
            "<script type=\"text/bytes\" data-file=\"data.wasm\">data</script>",
            "<script type=\"module\">main()</script>\n</body>",
        ] {
            assert!(page.contains(part), "{part}\n{page}");
        }
        for gone in ["manifest", "src=", "'self'"] {
            assert!(!page.contains(gone), "{gone}\n{page}");
        }
    }

    #[test]
    fn names_scripts_and_styles_by_their_hashes() {
        let folder = site();
        let page = one_file(folder.path(), &[]).unwrap();
        assert_eq!(hash("early()"), "'sha256-G2Y/0fpEoq/QMzbid/byF0KE5sX9e6ar19Om2+xoMnU='");
        assert!(page.contains(&format!("script-src {} 'sha256-", hash("early()"))), "{page}");
        assert!(page.contains(&format!("style-src {};", hash("a {}b {}"))), "{page}");
        assert!(page.contains("default-src 'none'") && page.contains("worker-src blob:"), "{page}");
    }

    #[test]
    fn leaves_links_to_documents_out() {
        let kept = |line: &str| without_documents(line).unwrap();
        let link = "<a class=\"b\" href=\"docs/a.html\" rel=\"noopener\">A <b>c</b></a>";
        assert_eq!(kept(&format!("<p>1 {link}, <a href=\"#d\">d</a>{link}</p>")), "<p>1 , <a href=\"#d\">d</a></p>");
        assert_eq!(kept("<a href=\"https://a.example/docs/\">a</a>"), "<a href=\"https://a.example/docs/\">a</a>");
        for wrong in ["<a href=\"docs/a.html\">", "<a>b</a><a href=\"docs/a.html\">", "<link href=\"docs/docs.css\">"] {
            assert!(without_documents(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn refuses_what_would_end_its_element() {
        let folder = site();
        for (name, text) in [
            ("early.js", "'</script>'"),
            ("main.js", "'<!--'\n"),
            ("a.css", "a { background: url(b.png) }"),
            ("worker.js", "'<SCRIPT'"),
        ] {
            let path = folder.path().join(name);
            let before = files::read_text(&path).unwrap();
            files::write(&path, text).unwrap();
            assert!(one_file(folder.path(), &["worker.js"]).is_err(), "{name}");
            files::write(&path, before).unwrap();
        }
    }
}
