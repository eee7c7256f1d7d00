"""Runs bindings/python/notebooks/paper_figures.ipynb, cell by cell, and looks at what its figures hold. Exit code 77: skipped.

    PYTHONPATH=build/test/python FACEPROBE_SAMPLES=.deps/data/samples python3 tests/python/notebook_test.py

NOTEBOOK_FIGURES=FOLDER in the environment keeps the figures there as PNG. Jupyter is not needed.
"""

import ast
import importlib.util
import json
import os
import sys
import unittest
import warnings
from pathlib import Path
from types import SimpleNamespace

NOTEBOOK = Path(__file__).parents[2] / "bindings/python/notebooks/paper_figures.ipynb"
PORTRAIT = Path(os.environ.get("FACEPROBE_SAMPLES", "")) / "grace_hopper.jpg"

for wanted, there in (("matplotlib", importlib.util.find_spec("matplotlib")), ("the sample photo", PORTRAIT.is_file())):
    if not there:
        print("skipped:", wanted, "is not there")
        sys.exit(77)

import matplotlib  # noqa: E402

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import faceprobe as fp  # noqa: E402

# Cell -> axes of the figure that it draws.
FIGURES = {"layers": 8, "maps": 4, "lights": 1, "spheres-figure": 8, "insert-figure": 6, "orders": 18, "sees": 3}


def cells(kind):
    return [cell for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == kind]


class File(unittest.TestCase):
    def test_is_of_format_4_5(self):
        book = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
        self.assertEqual((book["nbformat"], book["nbformat_minor"]), (4, 5))
        names = [cell["id"] for cell in book["cells"]]
        self.assertEqual(len(set(names)), len(names))
        for name in names:
            self.assertRegex(name, r"^[a-zA-Z0-9_-]{1,64}$")

    def test_holds_no_outputs(self):
        for cell in cells("code"):
            self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), cell["id"])

    def test_cells_are_short_and_explained(self):
        for cell in cells("code"):
            self.assertLessEqual(len(cell["source"]), 25, cell["id"])
            self.assertLessEqual(max(len(line.rstrip()) for line in cell["source"]), 120, cell["id"])
        self.assertGreaterEqual(len(cells("markdown")), len(cells("code")) - 2)  # two figures share the words of a helper

    def test_imports_little(self):
        found = set()
        for cell in cells("code"):
            for node in ast.walk(ast.parse("".join(cell["source"]))):
                if isinstance(node, ast.Import):
                    found |= {name.name.split(".")[0] for name in node.names}
                elif isinstance(node, ast.ImportFrom):
                    found.add(node.module.split(".")[0])
        self.assertEqual(found, {"os", "pathlib", "numpy", "matplotlib", "faceprobe"})


class Run(unittest.TestCase):
    """All cells, once; a warning is a failure."""

    @classmethod
    def setUpClass(cls):
        os.environ["FACEPROBE_PHOTO"] = str(PORTRAIT)
        keep = os.environ.get("NOTEBOOK_FIGURES")
        cls.names, cls.figures = {}, {}
        for cell in cells("code"):
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                exec(compile("".join(cell["source"]), cell["id"], "exec"), cls.names)
                for number in plt.get_fignums():
                    figure = plt.figure(number)
                    figure.canvas.draw()
                    cls.figures.setdefault(cell["id"], []).append(figure)
                    if keep:
                        os.makedirs(keep, exist_ok=True)
                        figure.savefig(Path(keep) / (cell["id"] + ".png"))
                    plt.close(figure)

    def pictures(self, cell):
        return [np.asarray(image.get_array()) for ax in self.figures[cell][0].axes for image in ax.images]

    def test_every_figure_has_its_axes(self):
        self.assertEqual({name: [len(f.axes) for f in made] for name, made in self.figures.items()},
                         {name: [count] for name, count in FIGURES.items()})

    def test_every_picture_shows_something(self):
        for name, count in FIGURES.items():
            pictures = self.pictures(name)
            self.assertEqual(len(pictures), count, name)
            for number, picture in enumerate(pictures):
                with self.subTest(figure=name, picture=number):
                    self.assertTrue(np.isfinite(picture).all())
                    self.assertGreaterEqual(picture.min(), 0)
                    self.assertLessEqual(picture.max(), 1)
                    # A map of order 0 is of one colour.
                    self.assertGreater(np.ptp(picture), -1 if (name, number) == ("orders", 0) else 0.2)

    def test_lights_are_drawn_where_the_map_is_bright(self):
        (figure,) = self.figures["lights"]
        face = self.names["face"]
        self.assertEqual(len(figure.axes[0].lines), len(face.lights))
        picture = self.pictures("lights")[0].mean(2)
        height, width = picture.shape
        middles = []
        for line in figure.axes[0].lines:
            azimuth, elevation = (np.nanmean(values) for values in line.get_data())
            middles.append(picture[int(height * (0.5 - elevation / 180)), int(width * (0.5 - azimuth / 360))])
        # A wide one may be the strongest, and another brighter; light from above fills rows of the map.
        self.assertGreater(max(middles), np.percentile(picture, 80))
        self.assertGreater(min(middles), np.median(picture))

    def test_harmonics_are_the_packages(self):
        face, radiance = self.names["face"], self.names["face"].environment.to_numpy()
        found = self.names["of_order"](radiance, 2)[1]
        # Both are sums over the texels' middles or corners of a map of 128 rows: 1e-3 of the largest.
        np.testing.assert_allclose(found, face.sh, atol=1e-3 * np.abs(face.sh).max())

    def test_harmonics_are_orthonormal(self):
        directions, solid_angles = self.names["texels"](256)
        self.assertAlmostEqual(solid_angles.sum(), 4 * np.pi)
        basis = self.names["harmonics"](directions, 4)
        np.testing.assert_allclose((basis * solid_angles[:, None]).T @ basis, np.eye(25), atol=1e-3)  # sums over middles

    def test_balls_mirror_the_right_side(self):
        light = np.zeros((64, 128, 3), np.float32)
        light[24:40, 24:40] = 1  # about a quarter of the width: the right of the photo
        for exponent in (1, 20, None):
            ball = self.names["ball"](light, exponent)[..., 0]
            with self.subTest(exponent=exponent):
                self.assertGreater(ball[:, 48:].sum(), 2 * ball[:, :48].sum())
                even = self.names["ball"](np.ones_like(light), exponent)
                np.testing.assert_allclose(even[even[..., 3] == 1], 1, atol=1e-5)  # sums of floats

    def test_traced_light_is_what_a_shiny_ball_shows(self):
        # A ball seen from far away, whose highlight falls off about one direction; skin all over.
        x, y = np.meshgrid(np.linspace(-1, 1, 140), np.linspace(1, -1, 140))
        inside = x * x + y * y < 1
        normals = np.stack([x, y, np.sqrt(np.maximum(1 - x * x - y * y, 0))], -1) * inside[..., None]
        lamp = np.array([0.6, 0.64, 0.48])

        def seen(directions):
            return np.repeat(np.maximum(directions @ lamp, 0)[..., None] ** 8, 3, -1)

        highlight = seen(2 * normals[..., 2:] * normals - [0, 0, 1])
        ball = SimpleNamespace(normals=normals, highlight=highlight, regions=inside.astype(np.uint8), crop=(0, 0, 1))
        photo = SimpleNamespace(width=140, height=140, focal_px=1e6)
        directions = self.names["texels"](64)[0]
        traced = self.names["trace"](ball, photo).reshape(-1, 3)
        ahead = directions[:, 2] > -0.7  # further round, the rim's few pixels stand for much
        # Eight neighbours lie within some two degrees, where the highlight changes by 0.05 at most.
        np.testing.assert_allclose(traced[ahead], seen(directions[ahead]), atol=0.05)

    def test_layers_put_together_are_the_insertion(self):
        pot, photo = self.names["pot"], self.names["photo"]
        x, y, width, height = pot.box
        alpha = np.zeros(photo.shape[:2])
        alpha[y : y + height, x : x + width] = pot.object[..., 3]
        difference = self.names["of_default"] - pot.picture
        # Off the pot they are the same but for rounding, and but for the horizon: no layer says how much of a pixel there is ground.
        self.assertLess((np.abs(difference[alpha == 0]) > 1e-6).mean(), 0.001)
        self.assertLess(abs(difference[alpha > 0.99].mean()), 0.01)  # grain is as often bright as dark
        self.assertGreater(np.abs(pot.picture - photo)[alpha > 0.99].mean(), 0.05)


if __name__ == "__main__":
    unittest.main(verbosity=2)
