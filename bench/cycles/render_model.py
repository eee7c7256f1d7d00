"""Renders meshes of one material each under several environment maps with Cycles, all bounces; run by Blender, which bench_insert_cycles
starts:

    blender --background --factory-startup --python-exit-code 1 --python render_model.py -- job.json

The job: {"meshes": [{"file", "vertices", "triangles", "material"}, ...], "width", "height", "focal_px", "threads", "max_bounces", "report",
          "renders": [{"map", "samples", "seed", "out"}, ...]}
"file" holds float32 positions, float32 normals, int32 corners. "material" is {"kind", "colour", "roughness", "index"}, of kind diffuse,
metal, mirror, plastic or glass. Everything is in the camera's frame: x right, y up, the camera at the origin looking along -z. "map" is a
lat-long picture whose columns follow Blender's convention. Renders of one map follow one another. Each is written to "out" as EXR, and
"report" has its "seconds" and "cpu_seconds", start-up and files excluded, and the "set_up" of its map: seconds to build the ray-tracing
structure, which the renders' own do not have.
"""

import array
import json
import math
import pathlib
import sys
import time

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from plain_cycles import plain_cycles  # noqa: E402


def to_blender(values):
    """x, y, z of the camera's frame to Blender's, whose z is up: (x, -z, y)."""
    turned = array.array("f", values)
    for i in range(0, len(values), 3):
        turned[i + 1] = -values[i + 2]
        turned[i + 2] = values[i + 1]
    return turned


def read_mesh(entry):
    positions, normals, corners = array.array("f"), array.array("f"), array.array("i")
    with open(entry["file"], "rb") as file:
        positions.fromfile(file, 3 * entry["vertices"])
        normals.fromfile(file, 3 * entry["vertices"])
        corners.fromfile(file, 3 * entry["triangles"])
    positions, normals = to_blender(positions), to_blender(normals)

    mesh = bpy.data.meshes.new("part")
    mesh.vertices.add(entry["vertices"])
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(3 * entry["triangles"])
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(entry["triangles"])
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, 3 * entry["triangles"], 3)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [3]) * entry["triangles"])
    mesh.update()
    if mesh.validate(verbose=True):
        raise ValueError("Blender had to repair the mesh: the comparison would not be of the same surface.")
    # Their own normals in place of Blender's: smooth faces and "auto smooth" are what makes Cycles take them.
    mesh.polygons.foreach_set("use_smooth", array.array("b", [1]) * entry["triangles"])
    mesh.use_auto_smooth = True
    mesh.auto_smooth_angle = math.pi
    mesh.normals_split_custom_set_from_vertices(
        [normals[i : i + 3] for i in range(0, len(normals), 3)])
    return mesh


def surface_of(tree, finish):
    grey = (*[finish["colour"]] * 3, 1)

    def shader(name, distribution=None, colour=(1, 1, 1, 1), roughness=0.0):
        node = tree.nodes.new(name)
        if distribution:
            node.distribution = distribution
        node.inputs["Color"].default_value = colour
        node.inputs["Roughness"].default_value = roughness
        return node

    if finish["kind"] == "diffuse":
        return shader("ShaderNodeBsdfDiffuse", colour=grey)
    if finish["kind"] == "metal":
        return shader("ShaderNodeBsdfGlossy", "MULTI_GGX", grey, finish["roughness"])
    if finish["kind"] == "mirror":
        return shader("ShaderNodeBsdfGlossy", "SHARP", grey)
    if finish["kind"] == "glass":
        glass = shader("ShaderNodeBsdfGlass", "SHARP", grey)
        glass.inputs["IOR"].default_value = finish["index"]
        return glass
    fresnel = tree.nodes.new("ShaderNodeFresnel")
    fresnel.inputs["IOR"].default_value = finish["index"]
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(fresnel.outputs[0], mix.inputs[0])
    tree.links.new(shader("ShaderNodeBsdfDiffuse", colour=grey).outputs[0], mix.inputs[1])
    tree.links.new(shader("ShaderNodeBsdfGlossy", "SHARP").outputs[0], mix.inputs[2])
    return mix


def add_part(scene, entry):
    material = bpy.data.materials.new("part")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(surface_of(tree, entry["material"]).outputs[0], out.inputs["Surface"])
    part = bpy.data.objects.new("part", read_mesh(entry))
    part.data.materials.append(material)
    # Shadow rays start at the triangle itself, not where Cycles' cure for coarse meshes would lift it to.
    part.cycles.shadow_terminator_offset = part.cycles.shadow_terminator_geometry_offset = 0
    scene.collection.objects.link(part)


def set_camera(scene, job):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.sensor_width = 36
    data.lens = 36 * job["focal_px"] / job["width"]
    data.clip_start, data.clip_end = 0.01, 100
    camera = bpy.data.objects.new("camera", data)
    camera.rotation_euler = (math.pi / 2, 0, 0)  # from looking down to looking along +y
    scene.collection.objects.link(camera)
    scene.camera = camera


def set_world(scene, path):
    for image in list(bpy.data.images):
        bpy.data.images.remove(image)
    tree = scene.world.node_tree
    tree.nodes.clear()
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(path)
    texture.image.colorspace_settings.name = "Non-Color"
    texture.interpolation = "Linear"
    background = tree.nodes.new("ShaderNodeBackground")
    out = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(texture.outputs[0], background.inputs[0])
    tree.links.new(background.outputs[0], out.inputs["Surface"])
    # Finer than the map, so that the light between two texels is drawn as often as it should be.
    scene.world.cycles.sampling_method = "MANUAL"
    scene.world.cycles.sample_map_resolution = 1024


def set_cycles(scene, job):
    plain_cycles(scene, job["width"], job["height"], job["threads"], ())
    scene.render.film_transparent = True
    scene.render.use_persistent_data = True  # the ray-tracing structure is built once a map, not once a render
    cycles = scene.cycles
    cycles.use_auto_tile = False
    cycles.pixel_filter_type = "BOX"
    cycles.caustics_reflective = cycles.caustics_refractive = True
    bounces = job["max_bounces"] - 1  # Cycles does not count the surface that the camera sees
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, "max_bounces" if kind == "max" else f"{kind}_bounces", bounces)


class Clock:
    """Seconds of the latest render, without files."""

    def __init__(self):
        bpy.app.handlers.render_pre.append(lambda *_: self.__dict__.update(start=self.now()))
        bpy.app.handlers.render_post.append(lambda *_: self.__dict__.update(end=self.now()))

    @staticmethod
    def now():
        return time.perf_counter(), time.process_time()

    def spent(self, which=0):
        return self.end[which] - self.start[which]


def set_up_map(scene, path, clock):
    """Loads the map and builds everything, then once more what the meshes need alone."""
    set_world(scene, path)
    scene.cycles.samples = 1
    seconds = []
    for rebuild in (True, True, False):
        if rebuild:
            for part in scene.objects:
                if part.type == "MESH":
                    part.data.update()
                    part.data.update_tag()
        bpy.ops.render.render()
        seconds.append(clock.spent())
    return max(0.0, seconds[1] - seconds[2])


def main():
    with open(sys.argv[sys.argv.index("--") + 1]) as file:
        job = json.load(file)
    scene = bpy.context.scene
    for item in list(scene.objects):
        bpy.data.objects.remove(item)
    scene.world.use_nodes = True
    for entry in job["meshes"]:
        add_part(scene, entry)
    set_camera(scene, job)
    set_cycles(scene, job)

    clock, current, done = Clock(), None, []
    for render in job["renders"]:
        if render["map"] != current:
            current = render["map"]
            set_up = set_up_map(scene, current, clock)
        scene.cycles.samples = render["samples"]
        scene.cycles.seed = render["seed"]
        scene.render.filepath = render["out"]
        bpy.ops.render.render(write_still=True)
        done.append({"seconds": clock.spent(), "cpu_seconds": clock.spent(1), "set_up": set_up})
    with open(job["report"], "w") as file:
        json.dump({"blender": bpy.app.version_string, "renders": done}, file)


main()
