"""What the tests of the Python package share. The environment says where things are:

FACEPROBE_SAMPLES   folder with the sample photos that scripts/setup.sh fetched
FACEPROBE_COMMAND   the command, to compare with
"""

import os
import tempfile
import unittest
from functools import lru_cache
from pathlib import Path

import numpy as np

import faceprobe as fp

SAMPLES = Path(os.environ.get("FACEPROBE_SAMPLES", ""))
COMMAND = os.environ.get("FACEPROBE_COMMAND", "")
PORTRAIT = SAMPLES / "grace_hopper.jpg"

needs_portrait = unittest.skipUnless(PORTRAIT.is_file(), "the sample photo is not there; scripts/setup.sh fetches it")
needs_command = unittest.skipUnless(os.path.isfile(COMMAND), "FACEPROBE_COMMAND names no command")


@lru_cache(maxsize=None)
def portrait() -> fp.Estimate:
    return fp.estimate(PORTRAIT)


@lru_cache(maxsize=None)
def portrait_light() -> np.ndarray:
    """The portrait's linear light: what highlight and diffuse add up to."""
    layers = fp.separate(PORTRAIT, separator="yang")
    light = layers.highlight + layers.diffuse
    light.flags.writeable = False
    return light


def encoded(light: np.ndarray) -> np.ndarray:
    curve = np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)
    return np.round(255 * np.clip(curve, 0, 1)).astype(np.uint8)


class InFolder(unittest.TestCase):
    """Has an empty folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
