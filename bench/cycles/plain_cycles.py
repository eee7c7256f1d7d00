"""What every render of a benchmark asks of Cycles: all of the light, nothing denoised or clamped, passes written as they are."""


def plain_cycles(scene, width, height, threads, passes):
    """`threads`: 0 = all. `passes`: names of the view layer's use_pass_ switches."""
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.threads_mode = "FIXED" if threads > 0 else "AUTO"
    if threads > 0:
        scene.render.threads = threads
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Standard"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    for name in passes:
        setattr(scene.view_layers[0], f"use_pass_{name}", True)
