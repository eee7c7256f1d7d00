import gc
import json
import os
import subprocess
import unittest

import numpy as np

import faceprobe as fp
from support import COMMAND, PORTRAIT, InFolder, encoded, needs_command, needs_portrait, portrait, portrait_light

LAYERS = ("picture", "highlight", "diffuse", "albedo", "shading", "normals")


@needs_portrait
class Estimate(InFolder):
    def test_has_a_face_and_its_light(self):
        estimate = portrait()
        self.assertEqual(len(estimate.faces), 1)
        face = estimate.faces[0]
        self.assertIs(estimate.largest, face)
        self.assertIsNone(estimate.joint)
        self.assertEqual(face.environment.to_numpy().shape, (128, 256, 3))
        self.assertEqual(face.confidence.to_numpy().shape, (128, 256, 3))
        self.assertLessEqual(face.confidence.to_numpy().max(), 1)
        self.assertGreater(estimate.focal_px, estimate.width)
        self.assertTrue(all(seconds >= 0 for _, seconds in estimate.timings))
        self.assertIsInstance(estimate.warnings, list)

    def test_shapes_and_types(self):
        face = portrait().faces[0]
        for name, shape, dtype in (
            ("landmarks", (468, 3), np.float32),
            ("camera_from_face", (4, 4), np.float64),
            ("position_m", (3,), np.float64),
            ("light_colour", (3,), np.float32),
            ("skin_albedo_mean", (3,), np.float32),
            ("sh", (9, 3), np.float64),
            ("sh4", (25, 3), np.float64),
        ):
            array = getattr(face, name)
            with self.subTest(name=name):
                self.assertEqual((array.shape, array.dtype), (shape, dtype))
                self.assertTrue(array.flags.c_contiguous)
        size = face.picture.shape[:2]
        self.assertLessEqual(max(size), 512)
        for name in LAYERS:
            array = getattr(face, name)
            with self.subTest(name=name):
                self.assertEqual((array.shape, array.dtype), ((*size, 3), np.float32))
        self.assertEqual((face.regions.shape, face.regions.dtype), (size, np.uint8))
        self.assertEqual((len(face.box), len(face.crop)), (4, 3))

    def test_numbers_hang_together(self):
        face = portrait().faces[0]
        np.testing.assert_allclose(face.highlight + face.diffuse, face.picture, atol=1e-5)
        lengths = np.linalg.norm(face.normals, axis=2)
        np.testing.assert_allclose(lengths[lengths > 0], 1, atol=1e-4)
        np.testing.assert_array_equal(face.camera_from_face[:3, 3], face.position_m)
        np.testing.assert_allclose(face.camera_from_face[:3, :3] @ face.camera_from_face[:3, :3].T, np.eye(3), atol=1e-9)
        self.assertLess(face.position_m[2], 0)
        x, y, width, height = face.box
        np.testing.assert_allclose(face.landmarks[:, 0].min(), x, atol=1e-3)
        np.testing.assert_allclose(face.landmarks[:, 1].max(), y + height, atol=1e-3)
        # The map's mean is its first coefficient.
        radiance = face.environment.to_numpy().astype(np.float64)
        angle = np.pi * (np.arange(129) / 128)
        weight = (np.cos(angle[:-1]) - np.cos(angle[1:]))[:, None] * 2 * np.pi / 256
        integral = (radiance * weight[..., None]).sum(axis=(0, 1))
        np.testing.assert_allclose(face.sh[0], integral * np.sqrt(1 / (4 * np.pi)), rtol=1e-3)

    def test_lights_point_where_the_map_is_bright(self):
        face = portrait().faces[0]
        self.assertGreater(len(face.lights), 0)
        light = face.lights[0]
        self.assertAlmostEqual(np.linalg.norm(light.direction), 1)
        self.assertAlmostEqual(light.colour @ [0.2126, 0.7152, 0.0722], 1, places=5)
        self.assertAlmostEqual(light.elevation_deg, np.degrees(np.arcsin(light.direction[1])), places=6)
        self.assertAlmostEqual(light.azimuth_deg, np.degrees(np.arctan2(light.direction[0], light.direction[2])), places=6)
        self.assertTrue(0 < light.share <= 1 and light.irradiance > 0 and light.solid_angle_sr > 0)
        seen = face.environment.sample(light.direction.astype(np.float32)[None])
        self.assertGreater(seen.mean(), face.environment.to_numpy().mean())

    def test_views_share_memory_and_outlive_the_estimate(self):
        estimate = fp.estimate(PORTRAIT, separator="yang", geometry="mesh", shading="regions", prior="smooth")
        face = estimate.faces[0]
        for name in (*LAYERS, "regions"):
            with self.subTest(name=name):
                self.assertTrue(np.shares_memory(getattr(face, name), getattr(estimate.faces[0], name)))
                self.assertFalse(getattr(face, name).flags.writeable)
        kept = {name: (getattr(face, name), getattr(face, name).copy()) for name in (*LAYERS, "regions")}
        environment = face.environment
        light = environment.to_numpy().copy()
        del estimate, face
        gc.collect()
        for array, copy in kept.values():
            np.testing.assert_array_equal(array, copy)
        np.testing.assert_array_equal(environment.to_numpy(), light)

    def test_arrays_and_files_give_the_same(self):
        light = portrait_light()
        np.testing.assert_allclose(fp.estimate(light).faces[0].box, portrait().faces[0].box, atol=1)
        from_bytes = fp.estimate(encoded(light), focal_px=900.0, deterministic=True)
        self.assertEqual(from_bytes.focal_px, 900)
        self.assertEqual(json.loads(from_bytes.to_json())["photo"]["source"], "array")
        from_file = fp.estimate(str(PORTRAIT), focal_px=900, deterministic=True)
        self.assertEqual((from_bytes.width, from_bytes.height), (from_file.width, from_file.height))
        np.testing.assert_allclose(from_bytes.faces[0].box, from_file.faces[0].box, atol=1)
        np.testing.assert_allclose(from_bytes.faces[0].sh, from_file.faces[0].sh, atol=0.1 * from_file.faces[0].sh.max())

    def test_options_do_what_the_commands_do(self):
        estimate = fp.estimate(
            PORTRAIT, separator="shen", geometry="mesh", shading="regions", prior="smooth", solver="paper",
            iterations=20, size="64x32", layer_px=128, threads=1, deterministic=True, device="cpu")
        options = json.loads(estimate.to_json())["options"]
        self.assertEqual(options["separator"], "shen")
        self.assertEqual(options["solver"], "paper")
        self.assertEqual(options["iterations"], 20)
        self.assertEqual(options["map_size_px"], [64, 32])
        self.assertEqual(estimate.faces[0].environment.width, 64)
        self.assertEqual(max(estimate.faces[0].picture.shape), 128)

    def test_regions_say_how_well_they_know_the_colour(self):
        self.assertIsNone(portrait().faces[0].light_colour_uncertainty_deg)
        by_regions = fp.estimate(PORTRAIT, shading="regions", prior="smooth", size=64).faces[0]
        self.assertTrue(0 < by_regions.light_colour_uncertainty_deg < 10)

    def test_one_light_for_the_photos_of_a_burst(self):
        estimator = fp.Estimator(deterministic=True)
        bright = portrait_light()
        one, other = estimator.estimate(bright), estimator.estimate(np.ascontiguousarray(0.5 * bright))
        joint = estimator.joint([one, other])
        # The same face at half the exposure: what it says of directions is the same, and the level lies between the two.
        means = [float(e.to_numpy().mean()) for e in (other.faces[0].environment, joint.environment, one.faces[0].environment)]
        self.assertLess(means[0], means[1])
        self.assertLess(means[1], means[2])
        alone, together = (light.lights[0].direction for light in (one.faces[0], joint))
        self.assertGreater(float(np.dot(alone, together)), np.cos(np.radians(10)))  # the prior sees twice the patches
        with self.assertRaisesRegex(fp.UsageError, "no estimate"):
            estimator.joint([])

    def test_one_skin_for_the_photos_of_a_person(self):
        estimator = fp.Estimator(deterministic=True, size=64)
        bright = portrait_light()
        warm = np.ascontiguousarray(bright * np.array([1.1, 1, 0.85], dtype=np.float32))
        apart = [estimator.estimate(bright), estimator.estimate(warm)]
        shared = estimator.same_person(apart)
        self.assertEqual(len(shared), 2)
        skins = [estimate.faces[0].skin_albedo_mean for estimate in shared]
        # One skin; regions that are blurred across their borders leave a little.
        self.assertLess(np.abs(np.log(skins[0] / skins[1])).max(), 0.03)
        for estimate, old in zip(shared, apart):
            self.assertIsNone(old.faces[0].shading_gain)
            self.assertEqual(estimate.faces[0].shading_gain.shape, (3,))
            self.assertEqual(json.loads(estimate.to_json())["faces"][0]["same_person"]["photos"], 2)
            self.assertGreater(estimate.faces[0].lights[0].direction_uncertainty_deg, 0)
            self.assertGreater(estimate.faces[0].lights[0].irradiance_uncertainty, 0)
        with self.assertRaisesRegex(fp.UsageError, "two at least"):
            estimator.same_person(apart[:1])

    def test_landmarks_stand_in_for_detection(self):
        points = portrait().faces[0].landmarks[[468 // 2, 0, 1, 2, 3], :2]  # any five that are no face's
        with self.assertRaises(TypeError):
            fp.Estimator(landmarks=points.astype(np.float64))
        with self.assertRaisesRegex(fp.UsageError, "5 or 68"):
            fp.Estimator(landmarks=[(1, 2), (3, 4)])
        # Eyes, nose tip, corners of the mouth, by the numbers of MediaPipe's mesh.
        mesh = portrait().faces[0].landmarks[:, :2]
        five = np.ascontiguousarray(
            [mesh[[33, 133]].mean(0), mesh[[362, 263]].mean(0), mesh[1], mesh[61], mesh[291]], np.float32)
        by_array = fp.estimate(PORTRAIT, landmarks=five, deterministic=True)
        by_pairs = fp.estimate(PORTRAIT, landmarks=[tuple(map(float, p)) for p in five], deterministic=True)
        np.testing.assert_allclose(by_array.faces[0].box, portrait().faces[0].box, atol=30)
        np.testing.assert_array_equal(by_array.faces[0].landmarks, by_pairs.faces[0].landmarks)

    def test_saves_the_commands_folder(self):
        files = portrait().save(self.folder / "light", overview=False)
        names = {file.name for file in files}
        self.assertIn("environment.exr", names)
        self.assertIn("report.json", names)
        self.assertNotIn("overview.png", names)
        self.assertEqual(names, set(os.listdir(self.folder / "light")))
        back = fp.read_env_map(self.folder / "light" / "environment.exr")
        np.testing.assert_allclose(back.to_numpy(), portrait().faces[0].environment.to_numpy(), rtol=1e-3, atol=1e-6)

    def test_separates_at_the_photos_size(self):
        layers = fp.Estimator(separator="yang").separate(PORTRAIT)
        self.assertEqual(layers.highlight.shape, (portrait().height, portrait().width, 3))
        self.assertEqual(layers.diffuse.dtype, np.float32)
        highlight = layers.highlight
        del layers
        gc.collect()
        self.assertGreater(highlight.max(), 0)

    @needs_command
    def test_equals_the_command(self):
        out = self.folder / "out"
        run = subprocess.run([COMMAND, "-q", "estimate", str(PORTRAIT), "-o", str(out), "--json", "--deterministic"],
                             stdout=subprocess.PIPE, check=True)
        theirs = json.loads(run.stdout)
        estimate = fp.estimate(PORTRAIT, deterministic=True)
        ours = json.loads(estimate.to_json())
        del theirs["timings"], ours["timings"]
        self.assertEqual(ours, theirs)
        face, told = estimate.faces[0], theirs["faces"][0]
        self.assertEqual(face.sh.tolist(), told["light"]["spherical_harmonics"]["rgb"])
        self.assertEqual(face.sh4.tolist(), told["light"]["spherical_harmonics_4"]["rgb"])
        np.testing.assert_allclose(face.sh4[:9], face.sh, rtol=0, atol=1e-9)
        for name in ("highlight_residual", "shading_residual", "light_to_ambient_ratio"):
            self.assertEqual(getattr(face, name), told["light"][name])
        self.assertTrue(0 < face.shading_residual < 1)
        self.assertEqual(face.position_m.tolist(), told["position_m"])
        self.assertEqual([light.share for light in face.lights],
                         [light["share_of_energy"] for light in told["light"]["main_lights"]])
        self.assertEqual(face.lights[0].direction.tolist(), told["light"]["main_lights"][0]["direction"])
        written = fp.read_env_map(out / "environment.exr").to_numpy()
        np.testing.assert_array_equal(written.astype(np.float16), face.environment.to_numpy().astype(np.float16))


class Refusals(InFolder):
    def test_a_photo_without_a_face(self):
        estimator = fp.Estimator(separator="yang", geometry="mesh", shading="regions", prior="smooth")
        for blank in (np.full((200, 300, 3), 128, np.uint8), np.full((200, 300, 3), 0.2, np.float32),
                      np.zeros((1, 1, 3), np.uint8)):
            for work in (estimator.estimate, estimator.separate):
                with self.assertRaises(fp.NoFaceError) as caught:
                    work(blank)
                self.assertEqual(caught.exception.code, 4)

    def test_files_that_are_no_photo(self):
        (self.folder / "text.jpg").write_text("not a photo")
        with self.assertRaisesRegex(fp.InputError, "missing.jpg"):
            fp.estimate(self.folder / "missing.jpg")
        with self.assertRaisesRegex(fp.InputError, "JPEG, PNG"):
            fp.estimate(str(self.folder / "text.jpg"))

    def test_arrays_that_are_no_photo(self):
        photo = np.zeros((20, 30, 3), np.uint8)
        for wrong in (photo.astype(np.float64), photo.astype(np.int32), photo.astype(bool), photo.astype(">f4")):
            with self.subTest(dtype=wrong.dtype), self.assertRaisesRegex(TypeError, "uint8 .* float32"):
                fp.estimate(wrong)
        for wrong in (photo.tolist(), None, 3):
            with self.assertRaisesRegex(TypeError, "photo must be"):
                fp.estimate(wrong)
        for wrong in (photo[..., 0].copy(), np.zeros((20, 30, 4), np.uint8), np.zeros((1, 20, 30, 3), np.uint8),
                      np.zeros((0, 30, 3), np.uint8)):
            with self.subTest(shape=wrong.shape), self.assertRaisesRegex(ValueError, r"shape \(N, N, 3\)"):
                fp.estimate(wrong)
        for wrong in (photo[:, ::2], photo.transpose(1, 0, 2), photo[..., ::-1]):
            with self.assertRaisesRegex(ValueError, "ascontiguousarray"):
                fp.estimate(wrong)
        for value in (np.nan, np.inf, -0.5):
            light = photo.astype(np.float32)
            light[3, 4, 1] = value
            with self.subTest(value=value), self.assertRaisesRegex(ValueError, "no light"):
                fp.estimate(light)
        with self.assertRaisesRegex(fp.InputError, "32768"):
            fp.estimate(np.zeros((1, 32769, 3), np.uint8))

    def test_options_that_are_none(self):
        for wrong in ({"separator": "magic"}, {"geometry": "scan"}, {"shading": "x"}, {"prior": "crystal"},
                      {"solver": "magic"}, {"iterations": 0}, {"size": 255}, {"size": "256x256"}, {"size": "large"},
                      {"layer_px": 5}, {"focal_px": -3}, {"focal_px": float("nan")}, {"threads": -1},
                      {"device": "gpu"}, {"separator": "yang", "weights": "w.safetensors"}):
            with self.subTest(**wrong), self.assertRaises(fp.UsageError) as caught:
                fp.Estimator(**wrong)
            self.assertEqual(caught.exception.code, 2)
        for wrong in ({"iterations": 2.5}, {"size": 256.0}, {"separator": 3}, {"conjure": 1}):
            with self.subTest(**wrong), self.assertRaises(TypeError):
                fp.Estimator(**wrong)
        with self.assertRaises(TypeError):
            fp.Estimator("net")

    def test_models_and_devices_that_are_not_there(self):
        with self.assertRaises(fp.DeviceError) as caught:
            fp.Estimator(device="cuda:1")
        self.assertEqual(caught.exception.code, 7)
        with self.assertRaises((fp.ModelError, fp.InputError)):
            fp.Estimator(weights=self.folder / "missing.safetensors")

    @needs_portrait
    def test_a_folder_that_cannot_be_written(self):
        (self.folder / "file").write_text("")
        with self.assertRaises(fp.OutputError):
            portrait().save(self.folder / "file")
        with self.assertRaises(fp.NoFaceError):
            fp.triangulate(portrait())


if __name__ == "__main__":
    unittest.main()
