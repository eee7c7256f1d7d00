# Blender's monkey in the light of a portrait, seen as the portrait was: straight ahead. Run after the script that an estimate wrote:
#
#   blender --background --factory-startup --python out/demo/blender.py --python scripts/blender_demo.py -- out/demo/monkey.png
import math
import os
import sys

import bpy

picture = sys.argv[sys.argv.index("--") + 1]
scene = bpy.context.scene
for name in ("Light", "Cube"):  # of the scene that Blender starts with
    if name in bpy.data.objects:
        bpy.data.objects.remove(bpy.data.objects[name])

bpy.ops.mesh.primitive_monkey_add(size=2)
monkey = bpy.context.object
bpy.ops.object.shade_smooth()
monkey.modifiers.new("Smooth", "SUBSURF").render_levels = 2
plastic = bpy.data.materials.new("Plastic")
plastic.use_nodes = True
plastic.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.3
monkey.data.materials.append(plastic)

scene.camera.location = (0, -6, 0)
scene.camera.rotation_euler = (math.radians(90), 0, 0)
scene.view_settings.view_transform = "Standard"  # colours as the map has them
scene.view_settings.exposure = -0.6  # stops: plastic is whiter than the skin that the photo was exposed for
scene.render.engine = "CYCLES"
scene.cycles.samples = 64
scene.cycles.use_denoising = False  # Debian's Blender is built without
scene.render.resolution_x = scene.render.resolution_y = 512
scene.render.filepath = os.path.abspath(picture)
bpy.ops.render.render(write_still=True)
