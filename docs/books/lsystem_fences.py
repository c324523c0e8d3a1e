"""Live drawings in books: fences of the language `lsystem` become elements `<l-system>`.

    mdBook     book.toml: [preprocessor.lsystem]  command = "python3 lsystem_fences.py"
    MkDocs     mkdocs.yml: hooks: [lsystem_fences.py]
    Sphinx     conf.py: extensions = ["myst_parser", "lsystem_fences"]; Jupyter Book 1 likewise

The element reads the text of the fence itself. It needs `l-system.js` and `embed.html` of the playground side by side:
docs/books.md shows where.
"""

import html
import json
import re
import sys

#: Any fence, so that a fence inside a longer one is left alone: indent, marks, language, text.
FENCE = re.compile(r"^( {0,3})(`{3,}|~{3,})([^\n]*)\n(.*?)^ {0,3}\2[`~]*[ \t]*$", re.MULTILINE | re.DOTALL)


def live(markdown):
    """The text of a page with its fences as HTML."""

    def element(fence):
        _, _, language, text = fence.groups()
        if language.strip().strip("{}.") != "lsystem":
            return fence[0]
        # Markdown ends HTML at an empty line: there is none inside, and one behind.
        text = html.escape(text.strip(), quote=False).replace("\n", "&#10;")
        return f'<div class="l-system"><l-system><pre>{text}</pre></l-system></div>\n'

    return FENCE.sub(element, markdown)


def on_page_markdown(markdown, **_):
    """The hook of MkDocs."""
    return live(markdown)


def setup(app):
    """The extension of Sphinx."""

    def read(app, _, source):
        if app.builder.format == "html":
            source[0] = live(source[0])

    app.connect("source-read", read)
    return {"parallel_read_safe": True}


def _chapters(items):
    for item in items:
        if isinstance(item, dict) and "Chapter" in item:
            item["Chapter"]["content"] = live(item["Chapter"]["content"])
            _chapters(item["Chapter"]["sub_items"])


if __name__ == "__main__":
    # mdBook first asks whether this is for its output, and then sends the book.
    if sys.argv[1:2] == ["supports"]:
        sys.exit(sys.argv[2] != "html")
    _, book = json.load(sys.stdin)
    _chapters(book.get("sections") or book.get("items"))
    json.dump(book, sys.stdout)
