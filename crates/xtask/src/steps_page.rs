//! `package.html`: the lesson's page in one file, which packages for learning systems are made of.
//!
//! It shows exercises in frames of `exercise.html` beside it. What only the site has is left out: elements of the class
//! `of-site`. `data-packed` names a script in place of the site's. The policy allows the scripts inside and frames of the
//! same place, and forbids all requests.

use crate::{html, one_file};
use anyhow::{Context, Result, ensure};
use fs_err as fs;
use lol_html::element;
use std::cell::RefCell;
use std::path::Path;

/// The file of the page on the site.
pub(crate) const NAME: &str = "package.html";

/// Makes the page of steps of the lesson's page on the site. `minified` are styles in fewer bytes.
pub(crate) fn make(site: &Path, lesson: &str, minified: impl Fn(&str) -> Result<String>) -> Result<String> {
    let text = fs::read_to_string(site.join(lesson))?;
    let (head, rest) = text.split_once("<style>").context("no styles")?;
    let (styles, body) = rest.split_once("</style>").context("no end of the styles")?;
    let text = format!("{head}<style>{}</style>{body}", minified(styles)?);
    let hashes = RefCell::new(vec![]);
    let page = html::rewrite(
        &text,
        [
            element!(".of-site, meta[name=description], link[rel=icon]", |of_site| {
                of_site.remove();
                Ok(())
            }),
            element!("script[src]", |script| one_file::put_inside(script, site, &hashes)),
        ],
    )?;
    // Frames of a file are of no origin: `'self'` alone would refuse them.
    let policy = format!(
        "default-src 'none'; script-src {}; style-src 'unsafe-inline'; frame-src 'self' file:; base-uri 'none'; \
         form-action 'none'",
        hashes.take().join(" ")
    );
    let charset = "<meta charset=\"utf-8\">";
    ensure!(page.contains(charset), "{lesson} does not name its charset");
    for part in ["<!-- steps -->", "<!-- /steps -->", "<html", "<h1>", "<title>"] {
        ensure!(page.matches(part).count() == 1, "{lesson} must have one {part}");
    }
    for left in [" href=\"./", " href=\"docs/", " src=\""] {
        ensure!(!page.contains(left), "{lesson} refers to a file that packages do not have:{left}");
    }
    Ok(page.replacen(
        charset,
        &format!("{charset}\n<meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">"),
        1,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files;

    const LESSON: &str = "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>T</title>\
        <style>\n    a {}</style><link rel=\"icon\" href=\"icons/a.svg\"><script src=\"a.js\"></script></head>\n<body><header class=\"top of-site\">\
        <a href=\"./\">H</a></header><h1>T</h1><!-- steps --><p>S</p><!-- /steps --></body></html>\n";

    #[test]
    fn the_page_stands_alone() {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path();
        let make = |lesson: &str| {
            files::write(&site.join("course.html"), lesson).unwrap();
            make(site, "course.html", |styles| Ok(styles.replace("\n    ", "")))
        };
        files::write(&site.join("a.js"), "a()").unwrap();
        let page = make(LESSON).unwrap();
        for part in [
            "<script>a()</script>",
            "<style>a {}</style>",
            "<!-- steps --><p>S</p><!-- /steps -->",
            &format!("script-src {};", one_file::hash("a()")),
            "default-src 'none'",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert!(!page.contains("of-site") && !page.contains("icon"), "{page}");
        for (part, wrong) in [(" of-site", ""), ("<!-- steps -->", ""), ("<h1>T</h1>", "<p>T</p>")] {
            assert!(make(&LESSON.replacen(part, wrong, 1)).is_err(), "{part}");
        }
        files::write(&site.join("a.js"), "'</script>'").unwrap();
        assert!(make(LESSON).is_err());
    }
}
