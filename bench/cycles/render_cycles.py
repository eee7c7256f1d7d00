"""Renders one mesh under several environment maps with Cycles; run by Blender, which bench_synth_cycles starts:

    blender --background --factory-startup --python-exit-code 1 --python render_cycles.py -- job.json

The job: {"mesh", "vertices", "triangles", "width", "height", "focal_px", "alpha", "threads", "report",
          "renders": [{"map", "samples", "seed", "light_threshold", "out"}, ...]}
"mesh" is a file of float32 positions, float32 normals, int32 corners. Everything is in the camera's frame: x right, y up, the
camera at the origin looking along -z. "map" is a lat-long picture whose columns follow Blender's convention. Every render is
written to "out" as EXR with its passes, and "report" lists the seconds of each, start-up and files excluded.
"""

import array
import json
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


def read_mesh(job):
    positions, normals, corners = array.array("f"), array.array("f"), array.array("i")
    with open(job["mesh"], "rb") as file:
        positions.fromfile(file, 3 * job["vertices"])
        normals.fromfile(file, 3 * job["vertices"])
        corners.fromfile(file, 3 * job["triangles"])
    positions, normals = to_blender(positions), to_blender(normals)

    mesh = bpy.data.meshes.new("face")
    mesh.vertices.add(job["vertices"])
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(3 * job["triangles"])
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(job["triangles"])
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, 3 * job["triangles"], 3)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [3]) * job["triangles"])
    mesh.update()
    if mesh.validate(verbose=True):
        raise ValueError("Blender had to repair the mesh: the comparison would not be of the same surface.")
    # Their own normals in place of Blender's: smooth faces and "auto smooth" are what makes Cycles take them.
    mesh.polygons.foreach_set("use_smooth", array.array("b", [1]) * job["triangles"])
    mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices(
        [normals[i : i + 3] for i in range(0, len(normals), 3)])
    return mesh


def white_with_lobe(alpha):
    """Lambert of albedo 1 under a Beckmann lobe without Fresnel term; the passes keep the two apart."""
    material = bpy.data.materials.new("face")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    diffuse.inputs["Roughness"].default_value = 0
    glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
    glossy.distribution = "BECKMANN"
    glossy.inputs["Color"].default_value = (1, 1, 1, 1)
    glossy.inputs["Roughness"].default_value = alpha**0.5  # Cycles squares it
    both = tree.nodes.new("ShaderNodeAddShader")
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(diffuse.outputs[0], both.inputs[0])
    tree.links.new(glossy.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], out.inputs["Surface"])
    return material


def set_camera(scene, job):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.sensor_width = 36
    data.lens = 36 * job["focal_px"] / job["width"]
    data.clip_start, data.clip_end = 0.01, 100
    camera = bpy.data.objects.new("camera", data)
    camera.rotation_euler = (1.5707963267948966, 0, 0)  # from looking down to looking along +y
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
    texture.interpolation = "Closest"  # texels of even radiance: their solid angles times their values are the map's energy
    background = tree.nodes.new("ShaderNodeBackground")
    out = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(texture.outputs[0], background.inputs[0])
    tree.links.new(background.outputs[0], out.inputs["Surface"])
    scene.world.cycles.sampling_method = "MANUAL"
    scene.world.cycles.sample_map_resolution = 1024


def set_cycles(scene, job):
    plain_cycles(scene, job["width"], job["height"], job["threads"], ("diffuse_direct", "glossy_direct"))
    scene.render.film_transparent = True
    scene.render.use_persistent_data = True  # the ray-tracing structure is built once, not once a render
    scene.cycles.use_auto_tile = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.max_bounces = 0  # direct light; light that the lobe's own samples find is part of it


def main():
    with open(sys.argv[sys.argv.index("--") + 1]) as file:
        job = json.load(file)
    scene = bpy.context.scene
    for item in list(scene.objects):
        bpy.data.objects.remove(item)
    scene.world.use_nodes = True
    face = bpy.data.objects.new("face", read_mesh(job))
    face.data.materials.append(white_with_lobe(job["alpha"]))
    scene.collection.objects.link(face)
    set_camera(scene, job)
    set_cycles(scene, job)

    clock = {}
    bpy.app.handlers.render_pre.append(lambda *_: clock.update(start=time.perf_counter()))
    bpy.app.handlers.render_post.append(lambda *_: clock.update(end=time.perf_counter()))
    current, seconds = None, []
    for render in job["renders"]:
        if render["map"] != current:
            current = render["map"]
            set_world(scene, current)
            scene.cycles.samples = 1  # loads the map and builds what is kept, so that it does not count below
            bpy.ops.render.render()
        scene.cycles.samples = render["samples"]
        scene.cycles.seed = render["seed"]
        scene.cycles.light_sampling_threshold = render["light_threshold"]
        scene.render.filepath = render["out"]
        bpy.ops.render.render(write_still=True)
        seconds.append(clock["end"] - clock["start"])
    with open(job["report"], "w") as file:
        json.dump({"blender": bpy.app.version_string, "seconds": seconds}, file)


main()
