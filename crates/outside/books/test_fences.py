"""The plugins for books in docs/books, run as the tools run them."""

import json
import shutil
import subprocess
import sys
import unittest
from html.parser import HTMLParser
from pathlib import Path

import lsystem_playground as ls
from markdown_it import MarkdownIt

BOOKS = Path(__file__).parents[3] / "docs/books"
sys.path.insert(0, str(BOOKS))
from lsystem_fences import live  # noqa: E402

TEXT = """title: <Weed> & co.
axiom: X
angle: 25
n: 5
palette: #aa3300, #0033aa
controls: angle,n

// X is a bud
X -> F-[[X]+X]+F[+FX]-X
F < F > X -> *
F -> FF"""
PAGE = f"""# A plant

```lsystem
{TEXT}
```
Behind *it*.

````markdown
```lsystem
axiom: F
```
````

~~~{{lsystem}}
axiom: G
G -> GG
~~~
"""


class Elements(HTMLParser):
    """The texts in the elements of a page."""

    def __init__(self, page):
        super().__init__()
        self.texts, self.inside = [], False
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        if tag == "l-system":
            self.inside = True
            self.texts.append("")

    def handle_endtag(self, tag):
        self.inside = self.inside and tag != "l-system"

    def handle_data(self, data):
        if self.inside:
            self.texts[-1] += data


class Fences(unittest.TestCase):
    def check(self, page):
        self.assertEqual(Elements(page).texts, [TEXT, "axiom: G\nG -> GG"])

    def test_markdown_keeps_the_elements(self):
        page = MarkdownIt().render(live(PAGE))
        self.check(page)
        self.assertIn("<em>it</em>", page)
        self.assertIn("```lsystem\naxiom: F\n```", page)

    def test_mdbook(self):
        def mdbook(*words, **options):
            return subprocess.run([sys.executable, BOOKS / "lsystem_fences.py", *words], text=True, **options)

        self.assertEqual(mdbook("supports", "html").returncode, 0)
        self.assertNotEqual(mdbook("supports", "latex").returncode, 0)
        chapter = {"Chapter": {"content": PAGE, "sub_items": [{"Chapter": {"content": PAGE, "sub_items": []}}]}}
        for items in ["sections", "items"]:
            book = {items: [chapter, "Separator"]}
            made = mdbook(input=json.dumps([{}, book]), capture_output=True, check=True).stdout
            read = json.loads(made)[items][0]["Chapter"]
            self.check(MarkdownIt().render(read["content"]))
            self.check(MarkdownIt().render(read["sub_items"][0]["Chapter"]["content"]))

    def test_quarto_by_pandoc(self):
        pandoc = shutil.which("pandoc")
        if pandoc is None:
            self.skipTest("pandoc is missing")

        def convert(target):
            words = [pandoc, "--from=markdown", f"--to={target}"]
            words.append(f"--lua-filter={BOOKS / '_extensions/lsystem/lsystem.lua'}")
            return subprocess.run(words, input=PAGE, text=True, capture_output=True, check=True).stdout

        self.assertEqual(Elements(convert("html")).texts[0], TEXT)
        self.assertNotIn("l-system", convert("latex"))

    def test_myst(self):
        script = """
            const { default: plugin } = await import(process.argv[1]);
            const nodes = JSON.parse(process.argv[2]);
            plugin.transforms[0].plugin({}, { selectAll: () => nodes })({});
            console.log(JSON.stringify(nodes));
        """
        nodes = [{"type": "code", "lang": "lsystem", "value": TEXT}]
        words = ["node", "--input-type=module", "-e", script, (BOOKS / "lsystem.mjs").as_uri(), json.dumps(nodes)]
        [node] = json.loads(subprocess.run(words, text=True, capture_output=True, check=True).stdout)
        self.assertEqual(node["type"], "iframe")
        # The frame and the core read the same system.
        self.assertEqual(ls.System.read(node["src"]), ls.System.read(TEXT))


class Text(unittest.TestCase):
    def test_the_core_reads_the_fence(self):
        system = ls.System.read(TEXT)
        self.assertEqual((system.title, system.n, system.angle), ("<Weed> & co.", 5, 25))
        self.assertEqual((system.palette, system.auto), (["#aa3300", "#0033aa"], True))
        self.assertEqual(system.warnings, [])


if __name__ == "__main__":
    unittest.main()
