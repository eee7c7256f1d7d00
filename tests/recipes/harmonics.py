"""The report's spherical harmonics in three.js, Unity and Unreal, as docs/recipes.md says. Needs numpy, else exit 77.

Ours are orthonormal coefficients of radiance. three.js is written here from its shader's constants (shGetIrradianceAt) and its
look-up of lat-long pictures (equirectUv); Unity from the polynomials that its coefficients are of; Unreal from its basis. What is done to
our coefficients for the last two is read from the page. Random light, against sums over the sphere.
"""

import math
import re
import sys
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("there is no numpy")
    sys.exit(77)


def our_basis(directions):
    """As src/core/sh.cpp: Legendre recurrence about +z times the real and imaginary part of (x + iy)^m."""
    x, y, z = directions.T
    values = np.zeros((len(directions), 9))
    cosine, sine, diagonal = np.ones_like(x), np.zeros_like(x), math.sqrt(0.25 / math.pi)
    for m in range(3):
        before, current = np.zeros_like(x), np.full_like(x, diagonal)
        for band in range(m, 3):
            scale = math.sqrt(2) if m else 1
            values[:, band * (band + 1) + m] = scale * current * cosine
            if m:
                values[:, band * (band + 1) - m] = scale * current * sine
            n = band + 1
            a = math.sqrt((4 * n * n - 1) / (n * n - m * m))
            b = 0 if band == m else math.sqrt(((n - 1) ** 2 - m * m) / (4 * (n - 1) ** 2 - 1))
            before, current = current, a * (z * current - b * before)
        diagonal *= math.sqrt((2 * m + 3) / (2 * m + 2))
        cosine, sine = cosine * x - sine * y, cosine * y + sine * x
    return values


def three_irradiance(probe, normals):
    """three.js: irradiance of world-space normals from LightProbe.sh.coefficients, 9 x 3."""
    x, y, z = normals.T
    weights = np.stack([0.886227 + 0 * x, 2 * 0.511664 * y, 2 * 0.511664 * z, 2 * 0.511664 * x, 2 * 0.429043 * x * y,
                        2 * 0.429043 * y * z, 0.743125 * z * z - 0.247708, 2 * 0.429043 * x * z,
                        0.429043 * (x * x - y * y)], -1)
    return weights @ probe


def openexr_texels(width):
    """Directions and solid angles of our map, row by row from the top."""
    height = width // 2
    longitude = math.pi - (np.arange(width) + 0.5) / width * 2 * math.pi
    edges = np.cos(np.arange(height + 1) / height * math.pi)
    latitude = math.pi / 2 - (np.arange(height) + 0.5) / height * math.pi
    lon, lat = np.meshgrid(longitude, latitude)
    directions = np.stack([np.sin(lon) * np.cos(lat), np.sin(lat), np.cos(lon) * np.cos(lat)], -1)
    solid_angles = np.repeat((edges[:-1] - edges[1:])[:, None] * 2 * math.pi / width, width, 1)
    return directions.reshape(-1, 3), solid_angles.ravel()


def three_look_up(picture, directions):
    """three.js: equirectUv, whose v counts from the bottom."""
    height, width, _ = picture.shape
    u = np.arctan2(directions[:, 2], directions[:, 0]) / (2 * math.pi) + 0.5
    v = np.arcsin(np.clip(directions[:, 1], -1, 1)) / math.pi + 0.5
    column = np.minimum((u * width).astype(int), width - 1)
    row = np.minimum(((1 - v) * height).astype(int), height - 1)
    return picture[row, column]


def unity_shading(probe, normals):
    """Unity: what SphericalHarmonicsL2 of 9 x 3 says in its own axes; irradiance over pi."""
    x, y, z = normals.T
    return np.stack([1 + 0 * x, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y], -1) @ probe


def unreal_irradiance(vector, normals):
    """Unreal: FSHVector's basis, which has the Condon-Shortley sign, in its own axes, times the cosine's lobe."""
    x, y, z = normals.T
    basis = np.stack([0.282095 + 0 * x, -0.488603 * y, 0.488603 * z, -0.488603 * x, 1.092548 * x * y, -1.092548 * y * z,
                      0.315392 * (3 * z * z - 1), -1.092548 * x * z, 0.546274 * (x * x - y * y)], -1)
    return (basis * np.repeat([math.pi, 2 * math.pi / 3, math.pi / 4], [1, 3, 5])) @ vector


class Components:
    """x, y and z of many vectors, as shaders write them."""
    def __init__(self, x, y, z):
        self.x, self.y, self.z = x, y, z


def of_page(pattern):
    found = re.search(pattern, PAGE, re.S)
    if not found:
        sys.exit(f"docs/recipes.md has nothing like {pattern}")
    return found.group(1)


def material_shading(code, report, normals):
    """The lines of Unreal's Custom node, which are Python as well."""
    names = {f"C{i}": row for i, row in enumerate(report)}
    names["N"] = Components(*(column[:, None] for column in normals.T))
    names["float3"] = Components
    first, rest = code.split(";", 1)
    names["n"] = eval(first.split("=", 1)[1].strip(), names)
    return eval("(" + rest.strip().removeprefix("return").rstrip("; \n") + ")", names)


def direct_irradiance(radiance, directions, solid_angles, normals):
    return (np.maximum(normals @ directions.T, 0) * solid_angles) @ radiance


def check(name, found, wanted, limit):
    error = np.abs(found - wanted).max() / np.abs(wanted).max()
    print(f"{'ok    ' if error < limit else 'FAILED'} {name}: largest error {100 * error:.4f} %, allowed {100 * limit:g} %")
    return error < limit


PAGE = (Path(__file__).resolve().parents[2] / "docs" / "recipes.md").read_text(encoding="utf-8")
random = np.random.default_rng(7)
directions, solid_angles = openexr_texels(256)
ours = our_basis(directions)
normals = random.normal(size=(200, 3))
normals /= np.linalg.norm(normals, axis=1, keepdims=True)
passed = [check("basis is orthonormal", (ours * solid_angles[:, None]).T @ ours, np.eye(9), 0.001)]

# Light of order two: three.js's irradiance is exact.
report = random.normal(size=(9, 3))
probe = report.copy()  # the recipe
passed.append(check("order 2 light, copied coefficients", three_irradiance(probe, normals),
                    direct_irradiance(ours @ report, directions, solid_angles, normals), 0.001))

# Any light: of its first nine coefficients.
picture = random.exponential(size=(128, 256, 3)) ** 3
picture[40:60, 50:70] += (200, 20, 20)
report = ours.T @ (picture.reshape(-1, 3) * solid_angles[:, None])
passed.append(check("any light, its part of order 2", three_irradiance(report, normals),
                    direct_irradiance(ours @ report, directions, solid_angles, normals), 0.001))

# Unity: +x, +y, +z of ours are its x, y, -z. The page's constants have six digits.
in_unity = normals * [1, 1, -1]
wanted = direct_irradiance(ours @ report, directions, solid_angles, normals)
factors = np.array([float(number.strip(" f")) for number in of_page(r"Factor = \{([^}]*)\}").split(",")])
passed.append(check("Unity, the page's factors", unity_shading(factors[:, None] * report, in_unity), wanted / math.pi, 0.001))

# Unreal: they are its y, z, -x.
in_unreal = np.stack([-normals[:, 2], normals[:, 0], normals[:, 1]], -1)
code = of_page(r"```hlsl\n(.*?)```")
passed.append(check("Unreal, the page's material", material_shading(code, report, in_unreal), wanted / math.pi, 0.001))
vector = np.stack(eval(of_page(r"`V` is\s+```\n\s*([^`]*?)\s*```"), {f"c{i}": row for i, row in enumerate(report)}))
passed.append(check("Unreal, the page's vector", unreal_irradiance(vector, in_unreal), wanted, 0.001))

# `--orient three` rolls by a quarter to the right; three.js then finds in the file what the report says.
rolled = np.roll(picture, picture.shape[1] // 4, axis=1)
seen = three_look_up(rolled, directions)
passed.append(check("file of --orient three, looked up as three.js does", seen, picture.reshape(-1, 3), 1e-9))

# One lamp at camera right.
lamp = ours.T @ (np.where(directions @ [1, 0, 0] > 0.97, 10.0, 0.0)[:, None] * solid_angles[:, None] * [1, 0.1, 0.1])
right, left, up, down = three_irradiance(lamp, np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]))[:, 0]
print(f"a red lamp at camera right: irradiance right {right:.3f}, left {left:.3f}, up {up:.3f}, down {down:.3f}")
passed.append(bool(right > 3 * max(abs(left), abs(up), abs(down)) and abs(up - down) < 1e-3 * right))
sys.exit(0 if all(passed) else 1)
