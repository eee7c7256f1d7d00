"""A white sphere in an estimated light, rendered by Blender: is it bright where the report says that the lamp is?

    blender --background --factory-startup --python-exit-code 1 --python LIGHT/blender.py --python blender_same_side.py -- LIGHT

LIGHT is the folder of one face that `faceprobe estimate` wrote, and holds by_hand.exr beside it, the map of `--orient blender`. Vectors
are in the portrait's camera frame (+x right, +y up, +z to the viewer) unless their name ends in _blender.
"""

import json
import math
import os
import sys

import bpy
import numpy as np

SIZE, SAMPLES, SEEN = 64, 16, 1.1  # pixels, samples a pixel, half the width that the camera sees in radii
DOMINANT = 0.2  # share of the energy from which a main light alone says where the bright side is
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
folder = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
scene = bpy.context.scene
failures = []


def expect(holds, text):
    print("ok    " if holds else "FAILED", text)
    if not holds:
        failures.append(text)


def from_blender(v_blender):
    return np.array([v_blender[0], v_blender[2], -v_blender[1]])


def unit(v):
    return np.asarray(v, float) / np.linalg.norm(v)


def angle_deg(a, b):
    return math.degrees(math.acos(np.clip(np.dot(unit(a), unit(b)), -1, 1)))


def degrees_of(v):
    v = unit(v)
    return f"azimuth {math.degrees(math.atan2(v[0], v[2])):.1f}, elevation {math.degrees(math.asin(v[1])):.1f}"


def set_up_sphere():
    for item in list(scene.objects):
        if item.name != "Portrait lamp":
            bpy.data.objects.remove(item)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=128, ring_count=64, location=(0, 5, 0))
    bpy.ops.object.shade_smooth()
    white = bpy.data.materials.new("white")
    white.use_nodes = True
    tree = white.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(diffuse.outputs[0], out.inputs["Surface"])
    bpy.context.object.data.materials.append(white)

    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 2 * SEEN
    camera.rotation_euler = (math.radians(90), 0, 0)  # along +y
    scene.collection.objects.link(camera)
    scene.camera = camera

    scene.render.engine = "CYCLES"
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    scene.render.film_transparent = True
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.max_bounces = "CPU", SAMPLES, 0
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type = "BOX"


def sphere_normals():
    """Normals of the pixels well inside the sphere, and which those are; rows from the bottom, as Blender keeps pixels."""
    at = ((np.arange(SIZE) + 0.5) / SIZE * 2 - 1) * SEEN
    x, y = np.meshgrid(at, at)
    z_squared = 1 - x * x - y * y
    inside = z_squared > 0.06
    normals = np.stack([x, y, np.sqrt(np.maximum(z_squared, 0))], -1)
    return normals[inside], inside


def render(name):
    """Irradiance of the sphere's pixels, RGB."""
    path = os.path.join(folder, f"sphere_{name}.exr")
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(path)
    pixels = np.array(picture.pixels[:]).reshape(SIZE, SIZE, 4)
    bpy.data.images.remove(picture)
    expect(pixels[..., 3][inside].min() > 0.999, f"{name}: the sphere is where the camera looks")
    return math.pi * pixels[inside][:, :3]


def fibonacci(count):
    i = np.arange(count)
    height = 1 - (2 * i + 1) / count
    turn = i * math.pi * (3 - math.sqrt(5))
    radius = np.sqrt(1 - height * height)
    return np.stack([radius * np.cos(turn), height, radius * np.sin(turn)], -1)


def lamp_of(values):
    """Direction of the one lamp that, with an even surround, explains the shading best."""
    def best(directions):
        shading = np.maximum(normals @ directions.T, 0)
        shading -= shading.mean(0)
        spread = np.sqrt((shading * shading).sum(0)) + 1e-9
        return directions[np.argmax(shading.T @ (values - values.mean()) / spread)]

    rough = best(fibonacci(2000))
    near = rough + np.concatenate([r * fibonacci(200) for r in (0.01, 0.02, 0.04, 0.06)])
    return best(near / np.linalg.norm(near, axis=1, keepdims=True))


def irradiance_from_report(sh):
    """Of the report's first nine coefficients; order and constants as in docs/recipes.md."""
    x, y, z = normals.T
    one = np.ones_like(x)
    basis = np.stack([0.282095 * one, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z,
                      0.315392 * (3 * z * z - 1), 1.092548 * x * z, 0.546274 * (x * x - y * y)], -1)
    lobe = np.array([math.pi] + 3 * [2 * math.pi / 3] + 5 * [math.pi / 4])
    return (basis * lobe) @ np.array(sh[:9])


def relative_rms(a, b):
    return math.sqrt(((a - b) ** 2).mean() / (b ** 2).mean())


def expect_same_side(name, found, wanted, limit_deg):
    off = angle_deg(found, wanted)
    expect(off < limit_deg, f"{name}: lamp at {degrees_of(found)}; wanted {degrees_of(wanted)}; {off:.1f} degrees off")
    for axis, sides in ((0, "left and right"), (1, "down and up")):
        if abs(wanted[axis]) > 0.15:
            expect(found[axis] * wanted[axis] > 0, f"{name}: {sides} are not exchanged")


def background_strength(value):
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = value


def remove_lamps():
    for item in list(scene.objects):
        if item.type == "LIGHT":
            bpy.data.objects.remove(item)


def write_made_up_map(path, red, blue):
    """A strong red lamp and a weak blue one on an even surround, in OpenEXR's columns."""
    width, height = 128, 64
    longitude = math.pi - (np.arange(width) + 0.5) / width * 2 * math.pi
    latitude = -math.pi / 2 + (np.arange(height) + 0.5) / height * math.pi  # rows from the bottom
    lon, lat = np.meshgrid(longitude, latitude)
    directions = np.stack([np.sin(lon) * np.cos(lat), np.sin(lat), np.cos(lon) * np.cos(lat)], -1)
    pixels = np.full((height, width, 4), 0.1, np.float32)
    pixels[..., 3] = 1
    pixels[..., 0][directions @ red > math.cos(math.radians(15))] = 20
    pixels[..., 2][directions @ blue > math.cos(math.radians(15))] = 4
    image = bpy.data.images.new("made up", width, height, float_buffer=True)
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = path, "OPEN_EXR"
    image.save()
    bpy.data.images.remove(image)


def world_by_hand(map_path):
    world = bpy.data.worlds.new("by hand")
    world.use_nodes = True
    tree = world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(map_path)
    tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    scene.world = world
    background_strength(1)


def expect_whole_light(name, seen, light, lamps):
    """All of the light: where its harmonics have it, and there where the main light is if that is much of the light."""
    wanted = irradiance_from_report(light["spherical_harmonics"]["rgb"])
    error = relative_rms(seen, wanted)
    expect(error < 0.1, f"{name}: shading is {100 * error:.1f} % from the report's harmonics")
    found = lamp_of(seen @ LUMINANCE)
    expect_same_side(f"{name}, by the harmonics", found, lamp_of(wanted @ LUMINANCE), 10)
    if lamps:
        share = lamps[0]["share_of_energy"]
        limit_deg = 20 if share > DOMINANT else 45
        expect_same_side(f"{name}, by the main light of {100 * share:.0f} %", found, lamps[0]["direction"], limit_deg)


def check_script(light, lamps):
    expect_whole_light("script", render("script"), light, lamps)
    if lamps:
        background_strength(0)
        alone = render("lamp") @ LUMINANCE
        background_strength(1)
        expect_same_side("script, lamp alone", lamp_of(alone), lamps[0]["direction"], 5)
        wanted = lamps[0]["irradiance"] * np.maximum(normals @ np.array(lamps[0]["direction"]), 0)
        ratio = alone.sum() / wanted.sum()
        expect(abs(ratio - 1) < 0.05, f"script, lamp alone: {ratio:.3f} of the report's irradiance")


def check_made_up_map():
    red, blue = np.array([1.0, 0, 0]), unit([-1, 1, 0.5])
    write_made_up_map(os.path.join(folder, "made_up.exr"), red, blue)
    remove_lamps()
    path = os.path.join(folder, "blender.py")
    with open(path) as file:
        text = file.read()
    text = text.replace('"environment_rest.exr"', '"made_up.exr"').replace("\ntry:", "\nLAMP = None\ntry:", 1)
    exec(compile(text, path, "exec"), {"__name__": "__main__", "__file__": path})
    seen = render("made_up")
    expect_same_side("red lamp at camera right", lamp_of(seen[:, 0]), red, 10)
    expect_same_side("blue lamp up left", lamp_of(seen[:, 2]), blue, 10)


def check_by_hand(light, lamps):
    remove_lamps()
    world_by_hand(os.path.join(folder, "by_hand.exr"))
    expect_whole_light("by hand", render("by_hand"), light, lamps)


def check_usd(lamps):
    if not getattr(bpy.app.build_options, "usd", False):
        print("--     light.usda: this Blender was built without USD")
        return
    remove_lamps()
    bpy.ops.wm.usd_import(filepath=os.path.join(folder, "light.usda"), import_lights=True)
    suns = [item for item in scene.objects if item.type == "LIGHT" and item.data.type == "SUN"]
    expect(len(suns) == min(len(lamps), 1), f"light.usda: {len(suns)} lamp")
    if suns:
        z_blender = suns[0].matrix_world.to_3x3().col[2]
        expect_same_side("light.usda", from_blender(z_blender), lamps[0]["direction"], 1)


with open(os.path.join(folder, "report.json")) as file:
    report = json.load(file)
light = report["faces"][report["largest_face"]]["light"]
lamps = light["main_lights"]
set_up_sphere()
normals, inside = sphere_normals()
check_script(light, lamps)
check_made_up_map()
check_by_hand(light, lamps)
check_usd(lamps)
if failures:
    raise SystemExit(f"{len(failures)} failed")
