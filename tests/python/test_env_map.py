import gc
import unittest

import numpy as np

import faceprobe as fp
from support import InFolder


def gradient(height=8):
    return np.arange(height * 2 * height * 3, dtype=np.float32).reshape(height, 2 * height, 3)


class EnvMap(InFolder):
    def test_keeps_the_numbers_it_is_given(self):
        env = fp.EnvMap(gradient())
        self.assertEqual((env.width, env.height), (16, 8))
        self.assertEqual(env.to_numpy().dtype, np.float32)
        np.testing.assert_array_equal(env.to_numpy(), gradient())

    def test_is_a_copy_of_what_it_was_made_of(self):
        array = gradient()
        env = fp.EnvMap(array)
        array[:] = 0
        np.testing.assert_array_equal(env.to_numpy(), gradient())

    def test_views_share_memory_and_outlive_the_map(self):
        env = fp.EnvMap(gradient())
        first, second = env.to_numpy(), env.to_numpy()
        self.assertTrue(np.shares_memory(first, second))
        del env, second
        gc.collect()
        np.testing.assert_array_equal(first, gradient())

    def test_views_are_read_only(self):
        array = fp.EnvMap(gradient()).to_numpy()
        with self.assertRaises(ValueError):
            array[0, 0, 0] = 1
        with self.assertRaises(ValueError):
            array.flags.writeable = True

    def test_samples_directions(self):
        array = np.zeros((64, 128, 3), np.float32)
        array[:, 24:40, 0] = 1  # about a quarter of the width: +x, the right of the photo
        found = fp.EnvMap(array).sample(np.array([[2, 0, 0], [-1, 0, 0]], np.float32))
        self.assertEqual(found.dtype, np.float32)
        np.testing.assert_allclose(found, [[1, 0, 0], [0, 0, 0]], atol=1e-6)

    def test_refuses_other_element_types(self):
        for wrong in (np.float64, np.float16, np.uint8, np.int32, np.bool_, ">f4"):
            with self.subTest(wrong=wrong), self.assertRaisesRegex(TypeError, "float32"):
                fp.EnvMap(gradient().astype(wrong))
        for wrong in (gradient().tolist(), None, "map.exr"):
            with self.assertRaises(TypeError):
                fp.EnvMap(wrong)

    def test_refuses_masks_that_it_would_lose(self):
        with self.assertRaisesRegex(TypeError, "mask"):
            fp.EnvMap(np.ma.masked_array(gradient(), mask=gradient() > 3))

    def test_refuses_other_shapes_and_layouts(self):
        for wrong in (gradient()[0], gradient()[:, :, :2].copy(), np.zeros((0, 0, 3), np.float32)):
            with self.subTest(shape=wrong.shape), self.assertRaisesRegex(ValueError, "shape"):
                fp.EnvMap(wrong)
        with self.assertRaisesRegex(ValueError, "2N x N"):
            fp.EnvMap(np.zeros((8, 15, 3), np.float32))
        for wrong in (gradient()[:, ::-1], np.asfortranarray(gradient())):
            with self.assertRaisesRegex(ValueError, "C-contiguous"):
                fp.EnvMap(wrong)
        unaligned = np.zeros(gradient().nbytes + 1, np.uint8)[1:].view(np.float32).reshape(gradient().shape)
        with self.assertRaisesRegex(ValueError, "C-contiguous"):
            fp.EnvMap(unaligned)

    def test_refuses_what_is_no_light(self):
        for value in (np.nan, np.inf, -1):
            array = gradient()
            array[3, 4, 1] = value
            with self.subTest(value=value), self.assertRaisesRegex(ValueError, "light"):
                fp.EnvMap(array)

    def test_refuses_wrong_directions(self):
        env = fp.EnvMap(gradient())
        with self.assertRaises(TypeError):
            env.sample(np.eye(3))
        with self.assertRaises(TypeError):
            env.sample([[1, 0, 0]])
        with self.assertRaisesRegex(ValueError, "shape"):
            env.sample(np.array([1, 0, 0], np.float32))
        with self.assertRaisesRegex(ValueError, "infinite"):
            env.sample(np.array([[1, 0, np.nan]], np.float32))

    def test_files_come_back_in_every_orientation(self):
        env = fp.EnvMap(gradient())
        for orientation in ("openexr", "three", "blender", "debevec"):
            path = self.folder / (orientation + ".exr")
            env.save(path, orientation=orientation)
            back = fp.read_env_map(str(path), orientation=orientation)
            np.testing.assert_allclose(back.to_numpy(), gradient(), rtol=1e-3)
        rolled = fp.read_env_map(self.folder / "debevec.exr").to_numpy()
        np.testing.assert_allclose(rolled, np.roll(gradient(), 8, axis=1), rtol=1e-3)

    def test_errors_say_their_kind(self):
        env = fp.EnvMap(gradient())
        with self.assertRaisesRegex(fp.UsageError, "debevec, found 'mars'"):
            env.save(self.folder / "a.exr", orientation="mars")
        with self.assertRaises(fp.OutputError):
            env.save(self.folder / "missing" / "a.exr")
        with self.assertRaises(fp.InputError) as caught:
            fp.read_env_map(self.folder / "missing.exr")
        self.assertEqual(caught.exception.code, 3)
        self.assertIsInstance(caught.exception, fp.FaceprobeError)
        with self.assertRaisesRegex(fp.InputError, "\udcff"):  # a name that is no UTF-8
            fp.read_env_map(self.folder / "\udcff.exr")


if __name__ == "__main__":
    unittest.main()
