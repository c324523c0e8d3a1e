//! Pages as a single file: such a page works from a disk, in frames without an origin, and at any address.
//!
//! The file contains styles, scripts, icons and the files that the page would fetch (`www/js/base/files.js` reads them
//! there). Links to documents are left out, because the file may stand alone. The page's content security policy allows
//! its own scripts and styles by hash and forbids everything else, above all requests: frames of the site may fetch the
//! words of the reader's language there.

use crate::esbuild::Bundler;
use crate::html::{self, Parts};
use anyhow::{Context, Result, ensure};
use base64::Engine as _;
use base64::engine::general_purpose::{STANDARD as BASE64, URL_SAFE_NO_PAD as BASE64URL};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use fs_err as fs;
use lol_html::html_content::{ContentType, Element};
use lol_html::{HandlerResult, element, end_tag};
use sha2::{Digest, Sha256};
use std::cell::{Cell, RefCell};
use std::io::Write as _;
use std::path::Path;
use std::rc::Rc;

/// Makes single files of pages.
pub(crate) struct Maker<'a> {
    /// The folder of the site.
    pub(crate) site: &'a Path,
    pub(crate) bundler: &'a (dyn Bundler + Sync),
}

/// Where a single file stands alone.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Alone {
    /// It never asks for another file.
    Always,
    /// On the site it may ask for words; elsewhere it does without.
    Elsewhere,
    /// It runs programs of readers in a frame: its own policy names the frame's script, and keeps its words.
    Running,
}

impl Maker<'_> {
    /// A single file of a page. `carried` are the files that the page would fetch.
    pub(crate) fn make(&self, page: &str, carried: &[impl AsRef<str>], alone: Alone) -> Result<String> {
        let text = fs::read_to_string(self.site.join(page))?;
        self.one_file(&text, carried, alone).with_context(|| format!("making one file of {page}"))
    }

    fn one_file(&self, text: &str, carried: &[impl AsRef<str>], alone: Alone) -> Result<String> {
        let Parts { page, styles, module } = Parts::of(text)?;
        let styles = self.bundler.styles(&styles)?;
        ensure!(
            !styles.contains("</") && !styles.contains("@import") && !styles.contains("url("),
            "a style refers to another file or ends its element"
        );
        // The files and the module come last, so that the page is visible before they are read.
        let mut last = carried.iter().map(|name| self.carry(name.as_ref())).collect::<Result<String>>()?;
        let module = checked(self.bundler.module(&module)?)?;
        last += &format!("<script type=\"module\">{module}</script>\n");
        let (scripts, own) = (RefCell::new(vec![]), RefCell::new(String::new()));
        let page = html::rewrite(
            &without_documents(&page)?,
            [
                element!("meta[http-equiv=Content-Security-Policy]", |meta| {
                    *own.borrow_mut() = meta.get_attribute("content").unwrap_or_default();
                    Ok(meta.set_attribute("content", POLICY)?)
                }),
                element!("link[rel=icon]", |icon| {
                    let picture = fs::read(self.site.join(icon.get_attribute("href").context("an icon")?))?;
                    Ok(icon.set_attribute("href", &format!("data:image/svg+xml;base64,{}", BASE64.encode(picture)))?)
                }),
                // Other links preload files or install the page; a single file needs neither.
                element!("link:not([rel=icon])", |link| {
                    link.remove();
                    Ok(())
                }),
                element!("script[src]", |script| put_inside(script, self.site, &scripts)),
                element!("head", |head| {
                    head.append(&format!("<style>{styles}</style>\n"), ContentType::Html);
                    Ok(())
                }),
                element!("body", |body| {
                    body.append(&last, ContentType::Html);
                    Ok(())
                }),
            ],
        )?;
        ensure!(page.contains(POLICY), "the page has no content security policy");
        scripts.borrow_mut().push(hash(&module));
        let allowed = match alone {
            Alone::Running => own
                .take()
                .replace("script-src 'self'", &format!("script-src 'self' {}", scripts.take().join(" ")))
                .replace("style-src 'self'", &format!("style-src {}", hash(&styles))),
            _ => policy(&scripts.take(), &hash(&styles), alone),
        };
        Ok(page.replacen(POLICY, &allowed, 1))
    }

    /// A file as a script element of a type that browsers do not run.
    fn carry(&self, name: &str) -> Result<String> {
        let (kind, text) = match name.ends_with(".js") {
            true => ("text/plain", checked(fs::read_to_string(self.site.join(name))?)?),
            false => ("text/zlib", packed(&fs::read(self.site.join(name))?)?),
        };
        Ok(format!("<script type=\"{kind}\" data-file=\"{name}\">{text}</script>\n"))
    }
}

/// Bytes as a text: compressed by zlib and written in base64url, as in long links (`lsystem_files::packed`).
fn packed(bytes: &[u8]) -> Result<String> {
    let mut encoder = ZlibEncoder::new(vec![], Compression::best());
    encoder.write_all(bytes)?;
    Ok(BASE64URL.encode(encoder.finish()?))
}

/// A placeholder for the policy until all hashes are known.
const POLICY: &str = "the policy of a single file";

/// The policy that allows scripts and styles by their hashes.
fn policy(scripts: &[String], styles: &str, alone: Alone) -> String {
    let words = if alone == Alone::Always { "" } else { "connect-src 'self'; " };
    format!(
        "default-src 'none'; {words}script-src {} 'wasm-unsafe-eval'; style-src {styles}; img-src blob: data:; \
         worker-src blob:; base-uri 'none'; form-action 'none'",
        scripts.join(" ")
    )
}

/// Puts a script, or the one that stands for it in single files, into its element, and notes its hash.
pub(crate) fn put_inside(script: &mut Element<'_, '_>, site: &Path, hashes: &RefCell<Vec<String>>) -> HandlerResult {
    let name = script.get_attribute("data-packed").or_else(|| script.get_attribute("src")).unwrap_or_default();
    let text = checked(fs::read_to_string(site.join(name))?)?;
    ["data-packed", "src"].into_iter().for_each(|name| script.remove_attribute(name));
    script.set_inner_content(&text, ContentType::Html);
    hashes.borrow_mut().push(hash(&text));
    Ok(())
}

pub(crate) fn hash(text: &str) -> String {
    format!("'sha256-{}'", BASE64.encode(Sha256::digest(text)))
}

/// The page without its links to documents.
fn without_documents(page: &str) -> Result<String> {
    let open = Rc::new(Cell::new(0));
    let remove = |link: &mut Element<'_, '_>| {
        ensure!(link.tag_name() == "a", "a <{}> loads a document", link.tag_name());
        link.remove();
        open.set(open.get() + 1);
        let open = open.clone();
        link.on_end_tag(end_tag!(move |_| {
            open.set(open.get() - 1);
            Ok(())
        }))
        .map_err(|error| anyhow::anyhow!(error))
    };
    let page = html::rewrite(
        page,
        ["docs/", "course.html"].map(|start| element!(format!("[href^=\"{start}\"]"), |link| Ok(remove(link)?))),
    )?;
    ensure!(open.get() == 0, "a link to a document does not end");
    Ok(page)
}

/// A script, if it does not end its element early.
fn checked(script: String) -> Result<String> {
    let lower = script.to_ascii_lowercase();
    ensure!(
        !["</script", "<script", "<!--"].iter().any(|end| lower.contains(end)),
        "a script contains text that would end its element"
    );
    Ok(script)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files;

    /// A bundler that returns files unchanged.
    struct Plain<'a>(&'a Path);

    impl Bundler for Plain<'_> {
        fn module(&self, entry: &str) -> Result<String> {
            Ok(fs::read_to_string(self.0.join(entry))?)
        }

        fn split(&self, _: &str, _: &str, _: &Path) -> Result<Vec<String>> {
            anyhow::bail!("a single file has one module")
        }

        fn styles(&self, names: &[String]) -> Result<String> {
            names.iter().map(|name| Ok(fs::read_to_string(self.0.join(name))?)).collect()
        }
    }

    fn one_file(site: &Path, carried: &[&str]) -> Result<String> {
        Maker { site, bundler: &Plain(site) }.make("index.html", carried, Alone::Always)
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
            &format!("<script type=\"text/zlib\" data-file=\"data.wasm\">{}</script>", packed(b"data").unwrap()),
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
            let before = fs::read_to_string(&path).unwrap();
            files::write(&path, text).unwrap();
            assert!(one_file(folder.path(), &["worker.js"]).is_err(), "{name}");
            files::write(&path, before).unwrap();
        }
    }
}
