"""The products of bench_solve in NumPy, which bench_solve starts:

    python3 solve_numpy.py FOLDER

FOLDER/job.json: {"cells", "rows", "runs", "stages": [{"rows", "iterations", "channels"}, ...]}; FOLDER/transport holds float32 rows of cells,
FOLDER/seen.N what stage N sees, float32 rows of channels. Writes FOLDER/light.float32.N and light.float64.N (float64, cells of channels) and
prints one JSON object: NumPy's version, the libraries that do its products, and seconds of every run by type. Ends with 3 where there is no
NumPy.
"""

import json
import pathlib
import sys
import time

try:
    import numpy as np
except ImportError:
    sys.exit(3)


def linear_algebra():
    """Which BLAS is loaded: NumPy does not say what an alternative of Debian's stands for."""
    mapped = pathlib.Path("/proc/self/maps").read_text().splitlines()
    names = {line.split("/")[-1] for line in mapped if "/" in line}
    return sorted(name for name in names if "blas" in name.lower() or "mkl" in name.lower())


def solve(transport, seen, stages):
    lights = []
    for stage, data in zip(stages, seen):
        rows = transport[: stage["rows"]]
        sensitivity = rows.sum(axis=0)[:, None]
        reached = sensitivity > 0
        light = np.ones((rows.shape[1], stage["channels"]), rows.dtype)
        for _ in range(stage["iterations"]):
            correction = rows.T @ (data / np.maximum(rows @ light, 1e-30))
            light = np.where(reached, light * correction / np.where(reached, sensitivity, 1), light)
        lights.append(light)
    return lights


def main():
    folder = pathlib.Path(sys.argv[1])
    job = json.loads((folder / "job.json").read_text())
    stages = job["stages"]
    read = np.fromfile(folder / "transport", np.float32).reshape(job["rows"], job["cells"])
    seen = [np.fromfile(folder / f"seen.{n}", np.float32).reshape(stage["rows"], stage["channels"])
            for n, stage in enumerate(stages)]
    report = {"version": np.__version__, "seconds": {}}
    for kind in ("float32", "float64"):
        transport = read.astype(kind)
        data = [values.astype(kind) for values in seen]
        seconds = []
        for _ in range(job["runs"]):
            start = time.perf_counter()
            lights = solve(transport, data, stages)
            seconds.append(time.perf_counter() - start)
        report["seconds"][kind] = seconds
        for n, light in enumerate(lights):
            light.astype(np.float64).tofile(folder / f"light.{kind}.{n}")
    report["libraries"] = linear_algebra()
    print(json.dumps(report))


if __name__ == "__main__":
    main()
