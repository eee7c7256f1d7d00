import gc
import json
import os
import unittest

import numpy as np

import faceprobe as fp
from support import PORTRAIT, InFolder, needs_portrait, portrait, portrait_light


def insert(photo=None, object="cube", **options):
    options = {"samples": 16, "estimate": portrait(), **options}
    return fp.insert(portrait_light() if photo is None else photo, object, **options)


@needs_portrait
class Insert(InFolder):
    def test_changes_the_objects_neighbourhood_alone(self):
        done = insert()
        picture = done.picture
        self.assertEqual((picture.shape, picture.dtype), (portrait_light().shape, np.float32))
        x, y, width, height = done.box
        self.assertLess(width * height, picture.shape[0] * picture.shape[1])
        changed = (picture != portrait_light()).any(axis=2)
        self.assertTrue(changed[y : y + height, x : x + width].any())
        changed[y : y + height, x : x + width] = False
        self.assertFalse(changed.any())

    def test_layers_cover_the_box(self):
        done = insert()
        size = (done.box[3], done.box[2])
        for name, channels in (("object", (4,)), ("shadow", (3,)), ("depth", ()), ("normal", (3,))):
            array = getattr(done, name)
            with self.subTest(name=name):
                self.assertEqual((array.shape, array.dtype), ((*size, *channels), np.float32))
                self.assertFalse(array.flags.writeable)
                self.assertTrue(np.shares_memory(array, getattr(done, name)))
        alpha = done.object[..., 3]
        self.assertGreater(alpha.max(), 0.99)
        self.assertTrue((done.depth[alpha > 0.99] > 0.1).all())
        depth, copy = done.depth, done.depth.copy()
        del done, array, alpha
        gc.collect()
        np.testing.assert_array_equal(depth, copy)

    def test_stands_where_it_is_told(self):
        done = insert(at=(120, 500), height=0.05, distance=0.6, ground=False)
        rows, columns = np.nonzero(done.object[..., 3] > 0.5)
        self.assertAlmostEqual(done.box[0] + columns.mean(), 120, delta=15)
        self.assertLess(done.box[1] + rows.max(), 525)
        self.assertTrue((done.shadow == 1).all())
        self.assertTrue(json.loads(done.to_json())["ground"] is None)

    def test_stands_beside_the_face(self):
        face = portrait().largest
        done = insert(object="sphere", beside=-0.12, height=0.05, ground=False)
        columns = np.nonzero(done.object[..., 3] > 0.5)[1]
        wanted = portrait().width / 2 + (face.position_m[0] - 0.12) * portrait().focal_px / -face.position_m[2]
        # Its foot is there, and heads, which tell what is up, lean by a few degrees: .025 m higher that is a pixel or two.
        self.assertAlmostEqual(done.box[0] + columns.mean() + 0.5, wanted, delta=3)
        with self.assertRaisesRegex(fp.UsageError, "twice"):
            insert(beside=0.1, at=(100, 500))

    def test_is_of_what_it_is_told(self):
        def colour_of(**options):
            done = insert(object="sphere", height=0.05, at=(100, 500), ground=False, samples=64, noise=0.0, **options)
            alpha = done.object[..., 3]
            return done.object[alpha > 0.99][:, :3].mean(axis=0)

        red = colour_of(material="diffuse", colour=(0.6, 0.01, 0.01))
        grey = colour_of(material="diffuse", colour=(0.6, 0.6, 0.6))
        self.assertAlmostEqual(red[0] / grey[0], 1, delta=0.01)  # the same rays
        self.assertLess(red[1] / grey[1], 0.05)  # 1 / 60, and noise
        np.testing.assert_allclose(colour_of(material="diffuse", colour="#ffffff"), grey / 0.6, rtol=0.01)
        smooth, rough = (insert(kind="metal", roughness=roughness).object for roughness in (0.1, 0.8))
        self.assertTrue((smooth != rough).any())

    def test_the_seed_decides(self):
        np.testing.assert_array_equal(insert().picture, insert(threads=1).picture)
        self.assertTrue((insert(noise=0.0).object != insert(noise=0.0, seed=2).object).any())

    def test_one_object_after_another(self):
        first = insert(at=(60, 560), height=0.05)
        second = insert(first.picture, "sphere", material="gold", at=(400, 560), height=0.05)
        x, y, width, height = first.box
        left = np.s_[y : y + height, x : second.box[0]]
        np.testing.assert_array_equal(second.picture[left], first.picture[left])

    def test_without_an_estimate_it_makes_one(self):
        done = fp.insert(PORTRAIT, samples=1)
        self.assertEqual(done.picture.shape, portrait_light().shape)
        self.assertEqual(done.warnings, portrait().warnings)

    def test_a_matte_hides_it(self):
        everyone = np.ones(portrait_light().shape[:2], np.float32)
        far = insert(matte=everyone, distance=50.0, at=(300, 300), height=5.0, ground=False)
        np.testing.assert_array_equal(far.picture, portrait_light())
        with self.assertRaises(TypeError):
            insert(matte=everyone.astype(np.float64))
        with self.assertRaisesRegex(ValueError, "0 to 1"):
            insert(matte=2 * everyone)
        with self.assertRaisesRegex(fp.UsageError, "matte"):
            insert(matte=np.ones((5, 5), np.float32))

    def test_saves_a_picture_or_a_folder(self):
        done = insert()
        for name in ("a.png", "a.exr", "a.hdr"):
            self.assertEqual(done.save(self.folder / name), [self.folder / name])
            self.assertTrue((self.folder / name).is_file())
        files = done.save(str(self.folder / "all"))
        self.assertEqual({file.name for file in files}, set(os.listdir(self.folder / "all")))
        self.assertIn("object.png", os.listdir(self.folder / "all"))
        with self.assertRaises(fp.OutputError):
            done.save(self.folder / "missing" / "a.png")

    def test_refuses(self):
        for wrong in ({"object": "unicorn"}, {"material": "cheese"}, {"samples": 0}, {"noise": -1.0}, {"height": -1.0},
                      {"distance": float("nan")}, {"threads": -1}, {"at": (1e9, 0)}, {"beside": 1e9}, {"kind": "wood"},
                      {"colour": "crimson"}, {"colour": (2, 0, 0)}, {"kind": "metal", "roughness": 1.5},
                      {"kind": "glass", "roughness": 0.5}, {"kind": "glass", "ior": 0.5},
                      {"kind": "metal", "ior": 1.4}):
            with self.subTest(**wrong), self.assertRaises(fp.UsageError):
                insert(**wrong)
        with self.assertRaisesRegex(fp.UsageError, "The estimate is of a photo of"):
            insert(np.zeros((10, 10, 3), np.uint8))
        with self.assertRaises(fp.InputError):
            insert(object=self.folder / "missing.ply")
        with self.assertRaises(TypeError):
            insert(at=(1, 2, 3))
        with self.assertRaises(TypeError):
            insert(estimate=3)


@needs_portrait
class Relight(InFolder):
    def test_changes_the_face_alone(self):
        dimmed = fp.relight(portrait_light(), dim=1, estimate=portrait())
        self.assertEqual((dimmed.shape, dimmed.dtype), (portrait_light().shape, np.float32))
        changed = (dimmed != portrait_light()).any(axis=2)
        rows, columns = np.nonzero(changed)
        x, y, width, height = portrait().faces[0].box
        self.assertGreater(columns.min(), x - width)
        self.assertLess(columns.max(), x + 2 * width)
        self.assertLess(dimmed.mean(), portrait_light().mean())

    def test_dims_by_shares(self):
        out = fp.relight(portrait_light(), dim=1, estimate=portrait())
        half = fp.relight(portrait_light(), dim={1: 0.5}, estimate=portrait())
        self.assertLess(out.mean(), half.mean())
        self.assertLess(half.mean(), portrait_light().mean())
        np.testing.assert_array_equal(fp.relight(portrait_light(), dim=[1], estimate=portrait()), out)

    def test_takes_maps_and_their_files(self):
        env = portrait().faces[0].environment
        env.save(self.folder / "map.exr")
        by_map = fp.relight(portrait_light(), map=env, turn=90, estimate=portrait())
        by_file = fp.relight(portrait_light(), map=self.folder / "map.exr", turn=90, estimate=portrait())
        np.testing.assert_allclose(by_map, by_file, atol=0.01)
        self.assertGreater(np.abs(by_map - portrait_light()).max(), 0.01)

    def test_one_stop_is_twice_the_light(self):
        brighter = fp.relight(portrait_light(), exposure=1, estimate=portrait())
        x, y, width, height = (int(v) for v in portrait().faces[0].box)
        inside = np.s_[y + height // 3 : y + 2 * height // 3, x + width // 3 : x + 2 * width // 3]
        before, after = portrait_light()[inside], brighter[inside]
        self.assertAlmostEqual(np.median(after[before > 0.01] / before[before > 0.01]), 2, delta=0.3)

    def test_refuses(self):
        dark = fp.EnvMap(np.zeros((8, 16, 3), np.float32))
        with self.assertRaisesRegex(TypeError, r"map must be an EnvMap or a path, found ndarray; .*EnvMap\(array\)"):
            fp.relight(portrait_light(), estimate=portrait(), map=dark.to_numpy())
        for wrong in ({}, {"dim": 6}, {"dim": -1}, {"dim": [1, 1]}, {"dim": {1: 1.5}}, {"turn": float("nan")},
                      {"exposure": 1e9}, {"map": dark, "dim": 1}):
            with self.subTest(**wrong), self.assertRaises(fp.UsageError):
                fp.relight(portrait_light(), estimate=portrait(), **wrong)
        with self.assertRaisesRegex(fp.InputError, "no light"):
            fp.relight(portrait_light(), estimate=portrait(), map=dark)
        with self.assertRaises(fp.InputError):
            fp.relight(portrait_light(), estimate=portrait(), map=self.folder / "missing.exr")


@needs_portrait
class SeveralFaces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        photo = np.ascontiguousarray(np.concatenate([portrait_light(), portrait_light()], axis=1))
        cls.estimate = fp.estimate(photo, separator="yang", geometry="mesh", shading="regions", prior="smooth")

    def test_have_a_joint_light(self):
        self.assertEqual(len(self.estimate.faces), 2)
        self.assertLess(self.estimate.faces[0].box[0], self.estimate.faces[1].box[0])
        joint = self.estimate.joint
        self.assertIsInstance(joint, fp.LightResult)
        self.assertNotIsInstance(joint, fp.Face)
        self.assertEqual(joint.environment.width, 256)
        self.assertEqual(joint.sh.shape, (9, 3))

    def test_tell_of_lamps(self):
        lamps = fp.triangulate(self.estimate)
        self.assertGreater(len(lamps), 0)
        for lamp in lamps:
            self.assertEqual(lamp.direction.shape, (3,))
            self.assertGreater(lamp.intensity, 0)
            self.assertEqual({face for face, _ in lamp.seen}, {0, 1})
            self.assertEqual(lamp.position_m is not None, lamp.near)
            self.assertEqual(lamp.covariance_m2 is not None, lamp.near)


if __name__ == "__main__":
    unittest.main()
