"""The package, as it is installed."""

import json
import math
import pickle
import tempfile
import unittest
from pathlib import Path

import lsystem_playground as ls
import numpy as np

WEED = ls.System(axiom="F", rules="F -> F[+F]F[-F]F", angle=25.7, n=2)


class Systems(unittest.TestCase):
    def test_text_in_our_notation(self):
        system = ls.System.read("axiom: X\nangle: 20\nn: 5\nX -> F[+X]F[-X]+X\nF -> FF")
        self.assertEqual((system.axiom, system.angle, system.n), ("X", 20, 5))
        self.assertEqual(system.rules, "X -> F[+X]F[-X]+X\nF -> FF")
        self.assertEqual(system.warnings, [])

    def test_every_form_gives_the_same_system(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "weed.json")
            path.write_text(WEED.json)
            picture = Path(folder, "weed.png")
            WEED.save(picture, size=(60, 50))
            forms = [
                WEED,
                WEED.json,
                WEED.link,
                WEED.values,
                json.loads(WEED.json),
                path,
                picture,
                pickle.loads(pickle.dumps(WEED)),
            ]
            for form in forms:
                self.assertEqual(ls.as_system(form), WEED)

    def test_fields_have_three_names(self):
        system = ls.System(initial="F", num_iters=3, colourBy="path", palette=["#102030"], start=np.array([1, 2]))
        self.assertEqual((system.axiom, system.iterations, system.colour_by), ("F", 3, "path"))
        self.assertEqual((system.palette, system.start), (["#102030"], [1, 2]))
        self.assertEqual(system.replace(right=30).right, 30)
        self.assertIsNone(system.right)
        with self.assertRaises(AttributeError):
            system.moon

    def test_repr_makes_the_same_system(self):
        self.assertEqual(eval(repr(WEED), {"System": ls.System}), WEED)

    def test_mistakes_are_told_with_their_place(self):
        with self.assertRaises(ls.LSystemError) as caught:
            ls.System(axiom="F", rules="// ü\nF = FF")
        self.assertIsInstance(caught.exception, ValueError)
        [problem] = caught.exception.diagnostics
        self.assertEqual((problem.severity, problem.field), ("error", "rules"))
        # Characters, not bytes.
        self.assertEqual("// ü\nF = FF"[problem.start : problem.end], "=")
        self.assertIn("F = FF\n", str(caught.exception))
        self.assertIn("F -> FF", problem.hint)
        for fields, words in [({"moon": 1}, "no field `moon`"), ({"n": -1}, "from 0 to 1,000"), ({"n": object()}, "")]:
            with self.assertRaisesRegex(ls.LSystemError, words):
                ls.System(**fields)
        with self.assertRaises(ls.LSystemError):
            ls.System.read("no system at all")

    def test_one_of_several_systems(self):
        text = "A {\n angle 4\n axiom F\n F=FF\n}\nB {\n angle 6\n axiom F\n F=F+F\n}"
        with self.assertRaisesRegex(ls.LSystemError, "A, B"):
            ls.System.read(text)
        self.assertEqual(ls.System.read(text, entry="B").angle, 60)


class Results(unittest.TestCase):
    def test_string_and_counts(self):
        self.assertEqual(ls.expand(WEED, 1), "F[+F]F[-F]F")
        self.assertEqual(ls.count(WEED, 3).segments, 125)
        self.assertEqual(ls.count(WEED, 1000).segments, 5**1000)
        # More digits than Python reads at once.
        self.assertEqual(ls.System(axiom="F", rules="F -> " + "F" * 40000).count(1000).symbols, 40000**1000)
        # Contexts are counted by derivation.
        context = ls.System(axiom="baaa", rules="b < a -> b\nb -> a", n=2)
        self.assertEqual(context.count(), (4, 0))
        with self.assertRaisesRegex(ls.LSystemError, "symbols"):
            WEED.expand(40)

    def test_arrays(self):
        drawing = ls.draw(ls.System(axiom="F+F", angle=90, step=2, width=0.5, palette=["#ff0000"]), 0)
        self.assertEqual((drawing.dimension, len(drawing)), (2, 2))
        np.testing.assert_allclose(drawing.segments, [[[0, 0], [0, 2]], [[0, 2], [-2, 2]]], atol=1e-15)
        np.testing.assert_allclose(drawing.bounds, [[-2, 0], [0, 2]], atol=1e-15)
        np.testing.assert_array_equal(drawing.colours, [[255, 0, 0]] * 2)
        np.testing.assert_array_equal(drawing.levels, [0, 0])
        self.assertEqual(drawing.widths.shape, (2, 2))
        drawing.segments[0, 0, 0] = 7
        self.assertEqual(drawing.segments[0, 0, 0], 7)

    def test_arrays_in_space_and_polygons(self):
        drawing = ls.draw({"axiom": "F&F{f+f+f}", "angle": 90})
        self.assertEqual((drawing.dimension, drawing.segments.shape), (3, (2, 2, 3)))
        self.assertEqual([polygon.shape[1] for polygon in drawing.polygons], [3])
        self.assertEqual(drawing.polygon_colours.shape, (1, 3))
        empty = ls.draw({"axiom": "X"})
        self.assertEqual((len(empty), empty.bounds, empty.segments.shape, empty.polygons), (0, None, (0, 2, 2), []))

    def test_segments_are_those_of_the_table(self):
        table = np.loadtxt(WEED.file("csv").decode().splitlines(), delimiter=",", skiprows=1)
        drawing = WEED.draw()
        np.testing.assert_array_equal(drawing.segments.reshape(-1, 4), table[:, :4])
        np.testing.assert_array_equal(drawing.levels, table[:, 4])
        np.testing.assert_array_equal(drawing.colour_indices, table[:, 5])

    def test_drawings_too_large_for_arrays(self):
        drawing = WEED.draw(200)
        self.assertEqual(drawing.count, 5**200)
        self.assertTrue(math.isfinite(drawing.bounds.sum()))
        with self.assertRaises(ls.LSystemError):
            drawing.segments
        self.assertEqual(list(drawing._repr_mimebundle_()), ["text/plain", "image/png"])

    def test_files(self):
        self.assertTrue(WEED.svg().startswith("<svg"))
        png = WEED.png(size="64x32")
        self.assertEqual((png[1:4], png[16:24]), (b"PNG", bytes([0, 0, 0, 64, 0, 0, 0, 32])))
        self.assertEqual(WEED.file("glb")[:4], b"glTF")
        self.assertNotEqual(WEED.file("plotter", min_length=100), WEED.file("plotter"))
        for wrong in [dict(format="moon"), dict(format="svg", size="x"), dict(format="svg", moon=1)]:
            with self.assertRaises(ls.LSystemError):
                WEED.file(**wrong)

    def test_notebooks_show_pictures(self):
        self.assertIn("image/svg+xml", WEED._repr_mimebundle_())


if __name__ == "__main__":
    unittest.main()
