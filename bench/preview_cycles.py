# SPDX-License-Identifier: Apache-2.0
"""Renders the plane of bench/preview_against_cycles.sh with Blender Cycles.

    blender -b --python bench/preview_cycles.py -- ENV ROUGHNESS EDGE SAMPLES SEED OUT

Blender's axes are kiln's turned around: its +X is kiln's +Z, its +Y kiln's +X, its +Z kiln's +Y.
Prints `rendering SECONDS CPU_SECONDS` for the rendering alone: Blender's start and the reading of
the images are over by then, its synchronisation and its writing are not.
"""
import resource
import sys
import time

import bpy


def make_plane():
    mesh = bpy.data.meshes.new("plane")
    corners = [(0, -1, -1), (0, 1, -1), (0, 1, 1), (0, -1, 1)]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    layer = mesh.uv_layers.new()
    for loop, uv in zip(layer.data, [(0, 0), (1, 0), (1, 1), (0, 1)]):
        loop.uv = uv
    plane = bpy.data.objects.new("plane", mesh)
    bpy.context.collection.objects.link(plane)
    return plane


def make_glossy(path):
    """White, GGX, no Fresnel; one roughness a texel."""
    material = bpy.data.materials.new("glossy")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    glossy = nodes.new("ShaderNodeBsdfGlossy")
    glossy.distribution = "GGX"
    glossy.inputs["Color"].default_value = (1, 1, 1, 1)
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = bpy.data.images.load(path)
    texture.image.colorspace_settings.name = "Non-Color"
    texture.interpolation = "Closest"
    links.new(texture.outputs["Color"], glossy.inputs["Roughness"])
    links.new(glossy.outputs["BSDF"], output.inputs["Surface"])
    return material


def make_world(path):
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputWorld")
    background = nodes.new("ShaderNodeBackground")
    texture = nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(path)
    texture.image.colorspace_settings.name = "Linear"
    texture.interpolation = "Linear"
    links.new(texture.outputs["Color"], background.inputs["Color"])
    links.new(background.outputs["Background"], output.inputs["Surface"])
    return world


def make_camera():
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 2
    camera.location = (4, 0, 0)
    half_turn = 3.141592653589793
    camera.rotation_euler = (0.5 * half_turn, 0, 0.5 * half_turn)
    bpy.context.collection.objects.link(camera)
    return camera


def main():
    env, roughness, edge, samples, seed, out = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    make_plane().data.materials.append(make_glossy(roughness))
    scene.world = make_world(env)
    scene.camera = make_camera()
    scene.render.resolution_x = scene.render.resolution_y = int(edge)
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = out
    scene.view_settings.view_transform = "Raw"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = int(samples)
    cycles.seed = int(seed)
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 0.01
    cycles.max_bounces = 1
    cycles.caustics_reflective = True
    cycles.blur_glossy = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    before = resource.getrusage(resource.RUSAGE_SELF)
    start = time.monotonic()
    bpy.ops.render.render(write_still=True)
    seconds = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_SELF)
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    print(f"rendering {seconds:.3f} {cpu:.3f}")


main()
