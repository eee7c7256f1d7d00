"""Renders heads of MakeHuman bodies under panoramas with Cycles, mirrored and other light apart; Blender runs it:

    blender --background --factory-startup --python-exit-code 1 --python render_people.py -- job.json

The job: {"package", "maps": [...], "count", "size", "samples", "seed", "threads", "folder"}. Each picture NNNN.exr in "folder" has the
passes Combined, DiffDir, DiffInd, DiffCol, GlossDir, GlossInd, GlossCol, Normal (in the world) and IndexMA (1 = skin). NNNN.json beside
it has the camera: "focal_px", and "world_from_camera", 3 x 3, of a camera that looks along -z with y up. What is there is left alone, so
a run that was stopped goes on.
"""

import json
import math
import pathlib
import random
import sys

import bpy
import mathutils

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "cycles")]
from people import Store  # noqa: E402
from plain_cycles import plain_cycles  # noqa: E402

METRES = 0.1  # MakeHuman counts in decimetres
SKIN_INDEX = 1


def picture_node(tree, path):
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.load(str(path), check_existing=True)
    return node


def material(name, path, roughness, strength):
    """Texture under a Beckmann lobe with Fresnel's factor for an index of 1.4, as skin's oil has (Ghosh et al. 2011 use 1.38 to 1.45)."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.pass_index = SKIN_INDEX if name == "skin" else 0
    tree = made.node_tree
    tree.nodes.clear()
    link = tree.links.new
    texture = picture_node(tree, path)
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    link(texture.outputs["Color"], diffuse.inputs["Color"])
    glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
    glossy.distribution = "BECKMANN"
    glossy.inputs["Roughness"].default_value = roughness**0.5  # Cycles squares it
    fresnel = tree.nodes.new("ShaderNodeFresnel")
    fresnel.inputs["IOR"].default_value = 1.4
    times = tree.nodes.new("ShaderNodeMath")
    times.operation = "MULTIPLY"
    times.inputs[1].default_value = strength
    link(fresnel.outputs[0], times.inputs[0])
    mix = tree.nodes.new("ShaderNodeMixShader")
    link(times.outputs[0], mix.inputs[0])
    link(diffuse.outputs[0], mix.inputs[1])
    link(glossy.outputs[0], mix.inputs[2])
    surface = mix
    if name == "hair":
        clear = tree.nodes.new("ShaderNodeBsdfTransparent")
        surface = tree.nodes.new("ShaderNodeMixShader")
        link(texture.outputs["Alpha"], surface.inputs[0])
        link(clear.outputs[0], surface.inputs[1])
        link(mix.outputs[0], surface.inputs[2])
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    link(surface.outputs[0], out.inputs["Surface"])
    return made


def place(part, look):
    name, vertices, corners, coordinates, uvs, picture = part
    mesh = bpy.data.meshes.new(name)
    # MakeHuman: x to the body's left, y up, z forward. Blender: z up, the face towards -y.
    mesh.from_pydata([(METRES * x, -METRES * z, METRES * y) for x, y, z in vertices], [], corners)
    layer = mesh.uv_layers.new()
    loops = [uvs[at] for polygon in coordinates for at in polygon]
    layer.data.foreach_set("uv", [float(value) for uv in loops for value in uv])
    mesh.polygons.foreach_set("use_smooth", [True] * len(corners))
    thing = bpy.data.objects.new(name, mesh)
    mesh.materials.append(material(name, picture, look["roughness"] if name == "skin" else 0.1 if name == "eyes" else 0.4,
                                   look["strength"] if name != "hair" else 0.5))
    if name == "skin":
        finer = thing.modifiers.new("finer", "SUBSURF")
        finer.levels = finer.render_levels = 2
    bpy.context.scene.collection.objects.link(thing)


def middle_of_head(store, shape):
    """Between the eyes, from the eyes' own vertices."""
    eyes, *_ = store.follow(store.data / "proxies" / "eyes" / "HighPolyEyes" / "HighPolyEyes.json", shape)
    x, y, z = eyes.mean(axis=0)
    return mathutils.Vector((METRES * x, -METRES * z, METRES * y))


def set_camera(scene, eyes, rng):
    distance = math.exp(rng.uniform(math.log(0.4), math.log(1.5)))
    yaw, pitch, roll = math.radians(rng.gauss(0, 20)), math.radians(rng.gauss(0, 8)), math.radians(rng.gauss(0, 5))
    middle = eyes + mathutils.Vector((0, 0.03, -0.03 + rng.gauss(0, 0.01)))
    towards = mathutils.Vector((math.sin(yaw) * math.cos(pitch), -math.cos(yaw) * math.cos(pitch), math.sin(pitch)))
    data = bpy.data.cameras.new("camera")
    data.sensor_width = 36
    data.clip_start = 0.01
    shown = rng.uniform(0.25, 0.34)  # metres across at the face
    data.lens = 36 * distance / shown
    camera = bpy.data.objects.new("camera", data)
    camera.location = middle + distance * towards
    turn = (-towards).to_track_quat("-Z", "Y")
    camera.rotation_euler = (turn @ mathutils.Quaternion((0, 0, 1), roll)).to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    rotation = camera.rotation_euler.to_matrix()
    return {"focal_over_width": data.lens / data.sensor_width, "world_from_camera": [list(row) for row in rotation]}


def set_world(scene, path, yaw):
    tree = scene.world.node_tree
    tree.nodes.clear()
    link = tree.links.new
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Rotation"].default_value[2] = yaw
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(path, check_existing=True)
    background = tree.nodes.new("ShaderNodeBackground")
    out = tree.nodes.new("ShaderNodeOutputWorld")
    link(coordinates.outputs["Generated"], mapping.inputs["Vector"])
    link(mapping.outputs[0], texture.inputs["Vector"])
    link(texture.outputs[0], background.inputs[0])
    link(background.outputs[0], out.inputs["Surface"])


PASSES = ("diffuse_direct", "diffuse_indirect", "diffuse_color", "glossy_direct", "glossy_indirect", "glossy_color", "normal",
          "material_index")


def write_whole(path, text):
    part = path.with_suffix(".part")
    part.write_text(text)
    part.rename(path)


def make(job, store, number):
    """The scene, and the camera's file beside the picture."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    rng = random.Random(f"{job['seed']} {number}")
    person = store.draw(rng)
    look = {"roughness": rng.uniform(0.22, 0.4), "strength": rng.uniform(0.5, 1.5)}
    for part in store.parts(person):
        place(part, look)
    camera = set_camera(scene, middle_of_head(store, store.shape(person)), rng)
    set_world(scene, rng.choice(job["maps"]), rng.uniform(0, 2 * math.pi))
    camera["focal_px"] = job["size"] * camera.pop("focal_over_width")
    write_whole(pathlib.Path(job["folder"]) / f"{number:04}.json", json.dumps(camera))
    return scene


def render(job, store, number):
    scene = make(job, store, number)
    plain_cycles(scene, job["size"], job["size"], job["threads"], PASSES)
    scene.cycles.samples = job["samples"]
    scene.cycles.max_bounces = 3
    scene.cycles.seed = number
    # A name that is not the result's, so that a picture is there whole or not at all.
    out = pathlib.Path(job["folder"]) / f"{number:04}.exr"
    scene.render.filepath = str(out.with_suffix(".part.exr"))
    bpy.ops.render.render(write_still=True)
    out.with_suffix(".part.exr").rename(out)


def main():
    with open(sys.argv[sys.argv.index("--") + 1]) as file:
        job = json.load(file)
    package = pathlib.Path(job["package"])
    store = Store(package / "public" / "data", package / "src" / "json")
    for number in range(job["count"]):
        picture = pathlib.Path(job["folder"]) / f"{number:04}.exr"
        if not picture.exists():
            render(job, store, number)
        elif not picture.with_suffix(".json").exists():
            make(job, store, number)


main()
