"""RMSE, PSNR and SSIM of eval/image_metrics.h beside scikit-image's. Needs numpy and scikit-image, else exit 77.

    python3 compare_skimage.py PRINT_METRICS        # prints the largest difference of each metric

Scikit-image is told to follow Wang et al. 2004: Gaussian weights, deviation 1.5 (11 x 11 pixels), population covariance, K1 .01, K2 .03. It gets
the same float pictures as doubles; of single precision it would compute in single precision. What differs by definition is checked as such:

- pictures smaller than a window: ours is NaN, theirs refuses;
- PSNR is 20 log10(255 / rmse) of the same error (psnr_of_rmse), and of 8-bit pictures what bench_separation prints;
- masks: theirs has none; SSIM is the mean of its full map over windows whose centre is in the mask.
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
    from skimage import metrics
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

# Relative above 1. Both sum thousands of values in doubles, in another order: some 1e-12. SSIM divides by variances, which are differences of
# squares, and loses three digits more where layers are bright and nearly flat.
TOLERANCE = {"rmse": 1e-9, "psnr": 1e-9, "si_rmse": 1e-9, "ssim": 1e-9}
WANG = {"gaussian_weights": True, "sigma": 1.5, "use_sample_covariance": False, "K1": 0.01, "K2": 0.03, "channel_axis": 2}
largest = dict.fromkeys(TOLERANCE, 0.0)


def ours(estimate, truth, mask=None):
    with tempfile.TemporaryDirectory() as folder:
        arrays = [estimate, truth] if mask is None else [estimate, truth, mask]
        files = [Path(folder) / str(i) for i in range(len(arrays))]
        for file, array in zip(files, arrays):
            array.tofile(file)
        height, width, channels = estimate.shape
        run = subprocess.run([PROGRAM, str(width), str(height), str(channels), *map(str, files)],
                             stdout=subprocess.PIPE, check=True, text=True)
    found = {name: float(value) for name, value in map(str.split, run.stdout.splitlines())}
    with np.errstate(divide="ignore"):
        found["psnr"] = 20 * np.log10(255 / np.float64(found["rmse"]))
    return found


def theirs(estimate, truth, mask=None):
    a, b = estimate.astype(np.float64), truth.astype(np.float64)
    where = np.s_[:] if mask is None else mask > 0
    energy = (a[where] ** 2).sum()
    fitted = a[where] * ((a[where] * b[where]).sum() / energy if energy else 0)
    with np.errstate(divide="ignore"):
        found = {
            "rmse": 255 * np.sqrt(metrics.mean_squared_error(a[where], b[where])),
            "psnr": metrics.peak_signal_noise_ratio(b[where], a[where], data_range=1),
            "si_rmse": np.sqrt(metrics.mean_squared_error(fitted, b[where])),
        }
    if min(a.shape[:2]) >= 11:
        found["ssim"], full = metrics.structural_similarity(a, b, data_range=1, full=True, **WANG)
        if mask is not None:
            found["ssim"] = full[5:-5, 5:-5][mask[5:-5, 5:-5] > 0].mean()
    return found


def noise(seed, height=48, width=61, channels=3):
    return np.random.default_rng(seed).random((height, width, channels), np.float32)


def flat(value, height=24, width=19, channels=3):
    return np.full((height, width, channels), value, np.float32)


def cases():
    a, b = noise(1), noise(2)
    yield "noise", a, b
    yield "half alike", a, 0.5 * (a + b)
    yield "one channel", a[..., :1].copy(), b[..., :1].copy()
    yield "faint", 1e-3 * a, 1e-3 * b
    yield "far above white", 50 * a, 50 * b
    yield "bright and nearly flat", 1 + 0.01 * a, 1 + 0.01 * b
    yield "negative", 1 - a, a
    yield "below 0", a - 1, b
    yield "the same", a, a
    yield "constant and the same", flat(0.3), flat(0.3)
    yield "constant", flat(0.25), flat(0.75)
    yield "black and white", flat(0), flat(1)
    yield "black and noise", np.zeros_like(a), a
    yield "both black", flat(0), flat(0)
    yield "a single window", noise(3, 11, 11), noise(4, 11, 11)
    yield "a row of windows", noise(3, 11, 40), noise(4, 11, 40)
    checks = np.indices((30, 40)).sum(0)[..., None] % 2 * np.ones(3)
    yield "a checkerboard and its negative", checks.astype(np.float32), (1 - checks).astype(np.float32)
    for at in ((0, 0), (12, 9)):  # in the corner it weighs little, in the middle much
        spot = flat(0)
        spot[at] = 1
        yield f"one pixel at {at}", spot, flat(0)
    yield "a step against a ramp", *(np.repeat(np.repeat(line[None, :, None], 20, 0), 3, 2).astype(np.float32)
                                      for line in (np.arange(50) >= 25, np.arange(50) / 49))
    yield "a picture in 8 bits", *((np.round(255 * picture) / 255).astype(np.float32) for picture in (a, b))


class Compare(unittest.TestCase):
    def agree(self, found, expected):
        for name, value in expected.items():
            with self.subTest(metric=name):
                if np.isfinite(value):
                    self.assertLessEqual(abs(found[name] - value), TOLERANCE[name] * max(1, abs(value)))
                    largest[name] = max(largest[name], abs(found[name] - value))
                else:
                    self.assertEqual(found[name], value)

    def test_pictures(self):
        for name, estimate, truth in cases():
            with self.subTest(case=name):
                expected = theirs(estimate, truth)
                self.assertEqual(set(expected), set(TOLERANCE))
                self.agree(ours(estimate, truth), expected)

    def test_masks(self):
        a, b = noise(1), noise(2)
        mask = (noise(5, channels=1)[..., 0] > 0.7).astype(np.uint8)
        half = np.zeros_like(mask)
        half[:, :30] = 255
        for where in (mask, half):
            self.agree(ours(a, b, where), theirs(a, b, where))

    def test_the_scale_of_255_is_the_same_measure(self):
        a, b = noise(1), 0.5 * (noise(1) + noise(2))
        bytes_a, bytes_b = (np.round(255 * picture).astype(np.uint8) for picture in (a, b))
        found = ours((bytes_a / np.float32(255)), (bytes_b / np.float32(255)))
        scaled = [picture.astype(np.float64) for picture in (bytes_a, bytes_b)]
        # Pictures over 255 are rounded to floats: 6e-8 of each value.
        self.assertAlmostEqual(found["ssim"], metrics.structural_similarity(*scaled, data_range=255, **WANG), places=6)
        self.assertAlmostEqual(found["rmse"], np.sqrt(metrics.mean_squared_error(*scaled)), places=5)
        self.assertAlmostEqual(found["psnr"], metrics.peak_signal_noise_ratio(bytes_a, bytes_b), places=6)

    def test_smaller_than_a_window(self):
        a, b = noise(1, 10, 40), noise(2, 10, 40)
        found = ours(a, b)
        self.agree(found, theirs(a, b))
        self.assertTrue(np.isnan(found["ssim"]))
        with self.assertRaises(ValueError):
            metrics.structural_similarity(a, b, data_range=1, **WANG)

    def test_not_a_number_is_not_left_out(self):
        a, b = noise(1), noise(2)
        a[20, 20, 1] = np.nan
        for value in (*ours(a, b).values(), *theirs(a, b).values()):
            self.assertTrue(np.isnan(value))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    done = unittest.main(verbosity=2, exit=False).result
    for name, difference in largest.items():
        print(f"{name}: they differ by {difference:.1e} at most")
    sys.exit(not done.wasSuccessful())
