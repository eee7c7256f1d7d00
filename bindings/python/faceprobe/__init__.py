"""The light that fell on a face, from one photo.

    import faceprobe as fp

    estimate = fp.estimate("portrait.jpg")
    face = estimate.largest
    radiance = face.environment.to_numpy()        # float32 (128, 256, 3), linear, a view
    face.environment.save("light.exr")
    for light in face.lights:
        print(light.azimuth_deg, light.elevation_deg, light.colour, light.share)

    with_pot = fp.insert("portrait.jpg", "pot", material="silver", estimate=estimate)
    with_pot.save("with_pot.png")

    dimmed = fp.relight("portrait.jpg", dim=1, estimate=estimate)

A photo is a path, a uint8 array of sRGB, or a float32 array of linear light. An array of any other kind is refused and never
converted: TypeError for its element type, ValueError for its shape or layout. All else that can go wrong is a FaceprobeError,
one class for each exit code of the command.

The frame is the camera's: +x to the right in the photo, +y up, +z towards the viewer; metres; directions go from the face to
the light. The GIL is released while anything is computed, read or written.
"""

import os as _os
from pathlib import Path as _Path


def _name_data_folder() -> None:
    # The library looks beside the running program, which is Python here: tell it where this package's models lie.
    package = _Path(__file__).resolve().parent
    for folder in (package / "data", package / "../../../../share/faceprobe"):
        if (folder / "face_landmark.tflite").is_file():
            _os.environ.setdefault("FACEPROBE_DATA_DIR", str(folder.resolve()))
            return


_name_data_folder()

from ._faceprobe import (  # noqa: E402
    DeviceError,
    EnvMap,
    Estimate,
    Estimator,
    Face,
    FaceprobeError,
    InputError,
    Insertion,
    Lamp,
    Layers,
    Light,
    LightResult,
    ModelError,
    NoFaceError,
    OutputError,
    UsageError,
    __version__,
    estimate,
    insert,
    read_env_map,
    relight,
    separate,
    triangulate,
)

__all__ = [
    "DeviceError",
    "EnvMap",
    "Estimate",
    "Estimator",
    "Face",
    "FaceprobeError",
    "InputError",
    "Insertion",
    "Lamp",
    "Layers",
    "Light",
    "LightResult",
    "ModelError",
    "NoFaceError",
    "OutputError",
    "UsageError",
    "__version__",
    "estimate",
    "insert",
    "read_env_map",
    "relight",
    "separate",
    "triangulate",
]
