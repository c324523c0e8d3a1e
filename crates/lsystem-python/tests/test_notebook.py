"""The package in a notebook, which is run without a browser."""

import html
import json
import re
import unittest
from unittest import mock

import lsystem_playground as ls
import nbformat
from nbclient import NotebookClient

CELLS = [
    "import lsystem_playground as ls",
    'weed = ls.System(axiom="F", rules="F -> F[+F]F[-F]F", angle=25.7, n=4)\nweed',
    "weed.draw().segments.shape",
    'live = weed.widget(controls=["n"])\nlive',
    "live.n = 3\nlive.system.count()",
    "live.system = weed.replace(angle=60)\nlive.angle, live.system.angle",
]


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cells = [nbformat.v4.new_code_cell(cell) for cell in CELLS]
        notebook = nbformat.v4.new_notebook(cells=cells)
        NotebookClient(notebook, timeout=60, kernel_name="python3").execute()
        cls.results = [[output["data"] for output in cell.outputs if "data" in output] for cell in notebook.cells]

    def test_a_cell_draws(self):
        [[picture]] = [self.results[1]]
        self.assertIn("<svg", picture["image/svg+xml"])

    def test_arrays(self):
        self.assertEqual(self.results[2][0]["text/plain"], "(625, 2, 2)")

    def test_the_widget_is_shown_and_has_a_picture_for_other_viewers(self):
        [[shown]] = [self.results[3]]
        self.assertIn("application/vnd.jupyter.widget-view+json", shown)
        self.assertIn("image/svg+xml", shown)

    def test_the_widget_follows_python(self):
        self.assertEqual(self.results[4][0]["text/plain"], "Counts(symbols=311, segments=125)")
        self.assertEqual(self.results[5][0]["text/plain"], "(60.0, 60)")


class Messages(unittest.TestCase):
    def test_the_frame_hears_of_python_only(self):
        weed = ls.System(axiom="F", rules="F -> F[+F]F[-F]F", angle=25, n=4)
        live, sent = weed.widget(seed=3), []
        live.send = lambda message, buffers=None: sent.append(message)
        self.assertEqual((live.link, live.seed), (weed.link, 3))
        live.n = 3
        live.set_state({"n": 2, "angle": 31.0, "link": weed.replace(n=2, angle=31).link})
        self.assertEqual(sent, [{"lsystem": "set", "values": {"n": 3}}])
        self.assertEqual(live.system, weed.replace(n=2, angle=31, seed=3))
        live.system = weed
        live.link = weed.replace(angle=60).link
        self.assertEqual(live.angle, 60)
        opened = [{"lsystem": "open", "link": system.link} for system in (weed, weed.replace(angle=60))]
        self.assertEqual(sent[1:], opened)

    def test_a_frame_carries_its_page_and_its_system(self):
        weed = ls.System(axiom="F", rules="F -> F[+F]F", title='"</script>&')
        with mock.patch("lsystem_playground._frame.page", lambda: b"<!doctype html><head><script>page</script>"):
            text = weed.frame(controls=["n", "rules"], height=300)._repr_html_()
        self.assertTrue(text.startswith("<iframe ") and "height: 300px" in text)
        [page] = re.findall(' srcdoc="([^"]*)"></iframe>$', text)
        head, place, rest = re.split("location.hash = (.*?)</script>", html.unescape(page))
        self.assertEqual((head, rest), ("<!doctype html><head><script>", "<script>page</script>"))
        link, options = json.loads(place).split("&controls=")
        self.assertEqual((ls.System.read(link), options), (weed, "n,rules&theme=&away=0"))

    def test_pictures_are_sent_when_asked_for(self):
        live, sent = ls.System(axiom="F").widget(), []
        live.send = lambda message, buffers: sent.append((message, buffers[0][:4]))
        live._answer(live, "picture", [])
        self.assertEqual(sent, [("picture", b"\x89PNG")])


if __name__ == "__main__":
    unittest.main()
