import threading
import time
import unittest

import numpy as np

import faceprobe as fp
from support import PORTRAIT, needs_portrait, portrait


@needs_portrait
class Threads(unittest.TestCase):
    def ticks_during(self, work):
        ticks, done = [], threading.Event()

        def tick():
            while not done.wait(0.002):
                ticks.append(time.monotonic())

        ticker = threading.Thread(target=tick)
        ticker.start()
        start = time.monotonic()
        work()
        end = time.monotonic()
        done.set()
        ticker.join()
        # The longest stretch during which no other thread of Python ran.
        times = [start, *(t for t in ticks if start < t < end), end]
        return end - start, max(b - a for a, b in zip(times, times[1:]))

    def test_others_run_meanwhile(self):
        portrait()
        for name, work in (
            ("estimator", fp.Estimator),
            ("estimate", lambda: fp.estimate(PORTRAIT)),
            ("insert", lambda: fp.insert(PORTRAIT, "cube", samples=16, estimate=portrait())),
            ("relight", lambda: fp.relight(PORTRAIT, dim=1, estimate=portrait())),
            ("sample", lambda: fp.EnvMap(np.ones((64, 128, 3), np.float32)).sample(np.ones((4000000, 3), np.float32))),
        ):
            seconds, silence = self.ticks_during(work)
            with self.subTest(name=name, seconds=seconds, silence=silence):
                self.assertLess(silence, max(0.05, 0.5 * seconds))

    def run_all(self, *works):
        results, faults = [None] * len(works), []

        def run(i):
            try:
                results[i] = works[i]()
            except Exception as fault:  # noqa: BLE001
                faults.append(fault)

        threads = [threading.Thread(target=run, args=(i,)) for i in range(len(works))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])
        return results

    def test_two_estimators_at_once(self):
        alone = fp.estimate(PORTRAIT, deterministic=True, threads=1)
        work = lambda: fp.Estimator(deterministic=True, threads=1).estimate(PORTRAIT)  # noqa: E731
        for result in self.run_all(work, work):
            np.testing.assert_array_equal(result.faces[0].sh, alone.faces[0].sh)

    def test_one_estimator_is_shared_by_turns(self):
        estimator = fp.Estimator(separator="yang", geometry="mesh", shading="regions", prior="smooth", deterministic=True)
        work = lambda: estimator.estimate(PORTRAIT)  # noqa: E731
        first, second, third = self.run_all(work, work, work)
        np.testing.assert_array_equal(first.faces[0].sh, second.faces[0].sh)
        np.testing.assert_array_equal(first.faces[0].sh, third.faces[0].sh)


if __name__ == "__main__":
    unittest.main()
