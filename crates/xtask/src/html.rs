//! Pages, read and rewritten: the elements that two pages share, and the styles and the module that a page asks for.

use anyhow::{Context, Result};
use lol_html::html_content::{ContentType, Element};
use lol_html::{ElementContentHandlers, RewriteStrSettings, Selector, doc_comments, element, end_tag, rewrite_str};
use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// What is done with the elements that a selector chooses.
pub(crate) type Handler<'h> = (Cow<'h, Selector>, ElementContentHandlers<'h>);

/// A page with some elements changed.
pub(crate) fn rewrite<'h>(page: &str, handlers: impl IntoIterator<Item = Handler<'h>>) -> Result<String> {
    let settings =
        handlers.into_iter().fold(RewriteStrSettings::new(), RewriteStrSettings::append_element_content_handler);
    Ok(rewrite_str(page, settings)?)
}

/// Replaces comments such as `<!-- index.html#reader -->` by the named elements of another page, or by what stands there
/// between `<!-- reader -->` and `<!-- /reader -->`. `name` is the other page's file name, `other` its text.
pub(crate) fn include(page: &str, name: &str, other: &str) -> Result<String> {
    let replace = doc_comments!(|comment| {
        let text = comment.text();
        if let Some(id) = text.trim().strip_prefix(name).and_then(|id| id.strip_prefix('#')) {
            let found = whole(other, id)?.or_else(|| between(other, id));
            let found = found.with_context(|| format!("{name} has no whole element #{id}"))?;
            comment.replace(found, ContentType::Html);
        }
        Ok(())
    });
    Ok(rewrite_str(page, RewriteStrSettings::new().append_document_content_handler(replace))?)
}

/// The text between two comments.
fn between<'a>(page: &'a str, name: &str) -> Option<&'a str> {
    let (_, after) = page.split_once(&format!("<!-- {name} -->\n"))?;
    Some(after.split_once(&format!("\n<!-- /{name} -->"))?.0)
}

/// The text of an element with its tags.
fn whole<'a>(page: &'a str, id: &str) -> Result<Option<&'a str>> {
    let found = Rc::new(Cell::new(None));
    let find = |element: &mut Element<'_, '_>| {
        let (start, found) = (element.source_location().bytes().start, found.clone());
        element.on_end_tag(end_tag!(move |end| {
            found.set(Some(start..end.source_location().bytes().end));
            Ok(())
        }))
    };
    rewrite(page, [element!(format!("[id=\"{id}\"]"), find)])?;
    Ok(found.take().map(|place| &page[place]))
}

/// A page without its styles and its module.
pub(crate) struct Parts {
    pub(crate) page: String,
    /// The styles that the page asks for, in order.
    pub(crate) styles: Vec<String>,
    pub(crate) module: String,
}

impl Parts {
    pub(crate) fn of(page: &str) -> Result<Self> {
        let (styles, modules) = (RefCell::default(), RefCell::default());
        let page = rewrite(
            page,
            [
                element!("link[rel=stylesheet]", |link| take(link, "href", &styles)),
                element!("script[type=module]", |script| take(script, "src", &modules)),
            ],
        )?;
        let module = modules.take().pop().context("the page has no module")?;
        Ok(Self { page, styles: styles.take(), module })
    }
}

/// Removes an element and keeps the name that it has.
fn take(element: &mut Element<'_, '_>, attribute: &str, names: &RefCell<Vec<String>>) -> lol_html::HandlerResult {
    names.borrow_mut().push(element.get_attribute(attribute).context("an element without a file")?);
    element.remove();
    Ok(())
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
        let head = include("<!-- o.html#c -->.", "o.html", "<!-- c -->\n<meta id=d>\n<p>\n<!-- /c -->").unwrap();
        assert_eq!(head, "<meta id=d>\n<p>.");
        assert!(include("<!-- o.html#a -->", "o.html", "<section id=\"a\">").is_err());
    }

    #[test]
    fn tags_may_stand_anywhere_on_a_line() {
        let page = "<head><link href=a.css\n rel='stylesheet'><link rel=icon href=a.svg><script src=\"a.js\" type=\"module\"></script></head>";
        let parts = Parts::of(page).unwrap();
        assert_eq!((parts.styles, parts.module), (vec!["a.css".to_owned()], "a.js".to_owned()));
        assert_eq!(parts.page, "<head><link rel=icon href=a.svg></head>");
        assert!(Parts::of("<head></head>").is_err());
    }
}
