//! The pages in single files that this program carries: the playground, the page of an exercise, and the page of steps
//! that packages for learning systems open with.
//!
//! `build.rs` hands them to the compiler, compressed by gzip. A program that was built without them reads a page from a
//! file.

use crate::{CommandFailure, input};
use flate2::read::GzDecoder;
use lsystem::base::say;
use std::io::Read;
use std::path::Path;

/// A page in a single file.
#[derive(Clone, Copy)]
pub(crate) struct Page {
    /// The name of its file on the built site.
    pub(crate) name: &'static str,
    /// The page compressed by gzip; empty if the program was built without it.
    carried: &'static [u8],
}

/// The playground.
pub(crate) const PLAYGROUND: Page =
    Page { name: "playground.html", carried: include_bytes!(concat!(env!("OUT_DIR"), "/playground.html.gz")) };

/// The page that shows one exercise and marks it.
#[allow(dead_code, reason = "for commands that pack exercises")]
pub(crate) const EXERCISE: Page =
    Page { name: "exercise.html", carried: include_bytes!(concat!(env!("OUT_DIR"), "/exercise.html.gz")) };

/// The page of steps of a package for learning systems.
pub(crate) const STEPS: Page =
    Page { name: "package.html", carried: include_bytes!(concat!(env!("OUT_DIR"), "/package.html.gz")) };

impl Page {
    /// The page's HTML, from the file `given` or else from this program.
    ///
    /// # Errors
    /// [`CommandFailure::Words`] if the file cannot be read or is no page in UTF-8, or if the program carries no page and
    /// no file is given.
    pub(crate) fn html(&self, given: Option<&Path>) -> Result<String, CommandFailure> {
        let (name, bytes) = match given {
            Some(file) => {
                let name = input::name_of(file);
                let bytes = input::bytes_of(file).map_err(|error| CommandFailure::io(&name, &error))?;
                (name, bytes)
            }
            None if self.carried.is_empty() => return Err(CommandFailure::Words(self.missing())),
            None => (self.name.to_owned(), unpack(self.carried)?),
        };
        let text = String::from_utf8(bytes).ok().filter(|text| text.trim_start().starts_with("<!doctype html"));
        text.ok_or_else(|| CommandFailure::Words(say!("{}: this is not {}", name, self.name)))
    }

    fn missing(&self) -> String {
        let name = self.name;
        say!(
            "this program was built without its pages: build it by `cargo xtask program`, or give the file with \
             --page {} (for `lsys scorm`, its folder with --pages), which `cargo xtask build` writes into dist",
            name
        )
    }
}

fn unpack(packed: &[u8]) -> Result<Vec<u8>, CommandFailure> {
    let mut bytes = Vec::new();
    let done = GzDecoder::new(packed).read_to_end(&mut bytes);
    done.map(|_| bytes).map_err(|error| CommandFailure::io(say!("the page in this program"), &error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::GzEncoder;
    use std::io::Write;

    fn words(result: Result<String, CommandFailure>) -> String {
        match result {
            Err(CommandFailure::Words(words)) => words,
            _ => panic!("no failure with words"),
        }
    }

    #[test]
    fn carried_pages_are_unpacked() {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(b"<!doctype html><p>\xc4\xa7</p>").unwrap();
        let page = Page { name: "a.html", carried: encoder.finish().unwrap().leak() };
        assert_eq!(page.html(None).ok().unwrap(), "<!doctype html><p>\u{127}</p>");
        let cut = Page { carried: &page.carried[..20], ..page };
        assert!(words(cut.html(None)).starts_with("the page in this program: "));
    }

    #[test]
    fn a_page_in_a_file_stands_in_for_a_carried_one() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.html");
        let page = Page { name: "playground.html", carried: b"" };
        assert!(words(page.html(None)).contains("--page playground.html"));
        std::fs::write(&file, "<!doctype html>\n<p>").unwrap();
        assert_eq!(page.html(Some(&file)).ok().unwrap(), "<!doctype html>\n<p>");
        std::fs::write(&file, "{}").unwrap();
        assert!(words(page.html(Some(&file))).ends_with("a.html: this is not playground.html"));
        assert!(words(page.html(Some(folder.path()))).contains("directory"));
    }
}
