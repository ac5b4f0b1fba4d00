"""For Blender in the background: draws the stage that describe_stage wrote, with Cycles or EEVEE. Arguments after `--`:
see arguments().
"""
import argparse
import json
import math
import os
import sys

import bpy
import mathutils
import numpy


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("out")
    parser.add_argument("engine", choices=("CYCLES", "BLENDER_EEVEE"))
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--size", type=int, nargs=2, default=(1280, 720))
    parser.add_argument("--surface", choices=("layered", "principled"), default="layered")
    parser.add_argument("--inside", choices=("subsurface", "volume"), default="subsurface")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


GIVEN = arguments()
WIDTH, HEIGHT = GIVEN.size
BOUNCES = 128
FAR = 1000  # half the floor's width over the stage's size


def z_up(vectors):
    """From sprung's world, whose y axis points up."""
    vectors = numpy.asarray(vectors, dtype=float)
    return numpy.stack([vectors[..., 0], -vectors[..., 2], vectors[..., 1]], axis=-1)


def raw(name, kind, columns):
    return numpy.fromfile(os.path.join(GIVEN.folder, name), dtype=kind).reshape(-1, columns)


def node(material, kind):
    return material.node_tree.nodes.new("ShaderNode" + kind)


def link(material, source, target):
    material.node_tree.links.new(source, target)


def output(material):
    return material.node_tree.nodes["Material Output"]


def corners(material, layer):
    """The colours of a mesh by that name."""
    source = node(material, "VertexColor")
    source.layer_name = layer
    return source.outputs["Color"]


def principled(material, body):
    """Blender's shader for everything; its base gets all light, whatever the specular layer reflects."""
    shader = node(material, "BsdfPrincipled")
    shader.inputs["Specular"].default_value = 0.5  # a reflectance of 0.04 at right angles
    shader.inputs["Roughness"].default_value = body["roughness"]
    shader.inputs["Metallic"].default_value = 1 if body["look"] == "steel" else 0
    link(material, corners(material, "paint"), shader.inputs["Base Color"])
    if body["is_translucent"]:
        shader.subsurface_method = "RANDOM_WALK_FIXED_RADIUS"
        shader.inputs["Subsurface"].default_value = 1
        shader.inputs["Subsurface IOR"].default_value = body["medium"]["index"]
        link(material, corners(material, "paint"), shader.inputs["Subsurface Color"])
        link(material, corners(material, "radius"), shader.inputs["Subsurface Radius"])
    return shader


def base(material, body):
    """What is under the specular layer."""
    if not body["is_translucent"]:
        shader = node(material, "BsdfDiffuse")
    else:
        shader = node(material, "SubsurfaceScattering")
        shader.falloff = "RANDOM_WALK_FIXED_RADIUS"
        shader.inputs["Scale"].default_value = 1
        shader.inputs["IOR"].default_value = body["medium"]["index"]
        link(material, corners(material, "radius"), shader.inputs["Radius"])
    link(material, corners(material, "paint"), shader.inputs["Color"])
    return shader


def layered(material, body):
    """A specular layer over a base that gets what the layer leaves, by Fresnel's equations."""
    layer = node(material, "BsdfGlossy")
    layer.distribution = "GGX"
    layer.inputs["Roughness"].default_value = body["roughness"]
    if body["look"] == "steel":
        layer.distribution = "MULTI_GGX"
        link(material, corners(material, "paint"), layer.inputs["Color"])
        return layer
    fresnel, both = node(material, "Fresnel"), node(material, "MixShader")
    fresnel.inputs["IOR"].default_value = 1.5
    link(material, fresnel.outputs[0], both.inputs[0])
    link(material, base(material, body).outputs[0], both.inputs[1])
    link(material, layer.outputs[0], both.inputs[2])
    return both


def volume(material, body):
    """A rough dielectric around a medium, of the body's mean colour: light is refracted at the surface both ways."""
    medium = body["medium"]
    glass, scatter, absorb, both = (node(material, kind)
                                    for kind in ("BsdfGlass", "VolumeScatter", "VolumeAbsorption", "AddShader"))
    glass.distribution = "GGX"
    glass.inputs["Roughness"].default_value = body["roughness"]
    glass.inputs["IOR"].default_value = medium["index"]
    scatter.inputs["Color"].default_value = (1, 1, 1, 1)
    scatter.inputs["Density"].default_value = medium["scattering"]
    # Blender's absorption is the density times one minus the colour.
    density = max(max(medium["absorption"]), 1e-6)
    absorb.inputs["Density"].default_value = density
    absorb.inputs["Color"].default_value = [1 - a / density for a in medium["absorption"]] + [1]
    link(material, scatter.outputs[0], both.inputs[0])
    link(material, absorb.outputs[0], both.inputs[1])
    link(material, both.outputs[0], output(material).inputs["Volume"])
    return glass


def glowing(material, body, shader):
    """A chart's surface shows a fraction of its colour in any light."""
    if not body["glow"]:
        return shader
    light, both = node(material, "Emission"), node(material, "MixShader")
    link(material, corners(material, "paint"), light.inputs["Color"])
    both.inputs[0].default_value = body["glow"]
    link(material, shader.outputs[0], both.inputs[1])
    link(material, light.outputs[0], both.inputs[2])
    return both


def material_of(body):
    material = bpy.data.materials.new(body["stem"])
    material.use_nodes = True
    material.node_tree.nodes.remove(material.node_tree.nodes["Principled BSDF"])
    if body["is_translucent"] and GIVEN.inside == "volume" and GIVEN.engine == "CYCLES":
        shader = volume(material, body)
    else:
        make = layered if GIVEN.surface == "layered" else principled
        shader = glowing(material, body, make(material, body))
    link(material, shader.outputs[0], output(material).inputs["Surface"])
    return material


def add_colors(mesh, name, colors):
    layer = mesh.color_attributes.new(name, "FLOAT_COLOR", "CORNER")
    layer.data.foreach_set("color", numpy.hstack([colors, numpy.ones((len(colors), 1))]).astype("f4").ravel())


def add(name, mesh, material, number):
    thing = bpy.data.objects.new(name, mesh)
    thing.pass_index = number
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(thing)


def add_body(body):
    positions = z_up(raw(body["stem"] + "_positions.raw", "<f4", 3))
    triangles = raw(body["stem"] + "_triangles.raw", "<i4", 3)
    mesh = bpy.data.meshes.new(body["stem"])
    mesh.from_pydata(positions.tolist(), [], triangles.tolist())
    add_colors(mesh, "paint", raw(body["stem"] + "_colors.raw", "<f4", 3))
    if body["is_translucent"]:  # Cycles divides a radius by 4 pi
        add_colors(mesh, "radius", 4 * math.pi * raw(body["stem"] + "_extinction_lengths.raw", "<f4", 3))
    mesh.polygons.foreach_set("use_smooth", [True] * len(triangles))
    mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices(z_up(raw(body["stem"] + "_normals.raw", "<f4", 3)).tolist())
    add(body["name"], mesh, material_of(body), body["id"])


def add_floor(stage):
    floor = stage["floor"]
    far = FAR * stage["size"]
    center = z_up(stage["center"])
    ends = [(center[0] + x * far, center[1] + y * far, floor["height"])
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    mesh = bpy.data.meshes.new("floor")
    mesh.from_pydata(ends, [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("floor")
    material.use_nodes = True
    diffuse = node(material, "BsdfDiffuse")
    diffuse.inputs["Color"].default_value = floor["albedo"] + [1]
    link(material, diffuse.outputs[0], output(material).inputs["Surface"])
    add("floor", mesh, material, 0)


def add_light(light):
    sun = bpy.data.lights.new("key", "SUN")
    strength = max(light["key"])
    sun.energy = math.pi * strength
    sun.color = [c / strength for c in light["key"]]
    sun.angle = light["key_angle"]
    thing = bpy.data.objects.new("key", sun)
    thing.rotation_mode = "QUATERNION"
    thing.rotation_quaternion = mathutils.Vector(z_up(light["to_key"])).to_track_quat("Z", "Y")
    bpy.context.scene.collection.objects.link(thing)


def add_surroundings(light):
    height = light["panorama_height"]
    rows = raw("panorama.raw", "<f4", 3).reshape(height, 2 * height, 3)[::-1]
    picture = bpy.data.images.new("panorama", 2 * height, height, float_buffer=True)
    picture.colorspace_settings.name = "Non-Color"
    picture.pixels.foreach_set(numpy.dstack([rows, numpy.ones(rows.shape[:2])]).astype("f4").ravel())
    picture.update()
    world = bpy.data.worlds.new("surroundings")
    world.use_nodes = True
    world.cycles.sampling_method = "MANUAL"
    world.cycles.sample_map_resolution = 1024
    texture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = picture
    world.node_tree.links.new(texture.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
    bpy.context.scene.world = world


def add_camera(camera, size):
    data = bpy.data.cameras.new("camera")
    eye, target, up = (mathutils.Vector(z_up(camera[key])) for key in ("eye", "target", "up"))
    half = math.radians(camera["vertical_field_of_view"]) / 2
    aspect = WIDTH / HEIGHT
    data.sensor_fit = "VERTICAL"
    data.angle = 2 * half
    data.shift_x = -camera["shift"] * aspect / 2
    if camera["orthographic"]:
        data.type = "ORTHO"
        data.ortho_scale = 2 * (target - eye).length * math.tan(half)
    data.clip_start, data.clip_end = 1e-3 * size, 2 * FAR * size
    back = (eye - target).normalized()
    right = up.cross(back).normalized()
    axes = mathutils.Matrix((right, back.cross(right), back)).transposed()
    thing = bpy.data.objects.new("camera", data)
    thing.matrix_world = mathutils.Matrix.Translation(eye) @ axes.to_4x4()
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def set_up_cycles(scene):
    cycles = scene.cycles
    cycles.samples = GIVEN.samples
    cycles.seed = GIVEN.seed
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"  # as sprung's
    cycles.filter_width = 1
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    for kind in ("max", "diffuse", "glossy", "transmission", "volume", "transparent_max"):
        setattr(cycles, kind + "_bounces", BOUNCES)


def set_up_eevee(scene):
    eevee = scene.eevee
    eevee.taa_render_samples = GIVEN.samples
    eevee.use_soft_shadows = eevee.use_gtao = eevee.use_ssr = True
    eevee.gtao_distance = 1
    eevee.shadow_cascade_size = "2048"


def set_up_picture(scene):
    render = scene.render
    render.engine = GIVEN.engine
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100
    if GIVEN.threads:
        render.threads_mode, render.threads = "FIXED", GIVEN.threads
    render.use_file_extension = False
    render.filepath = GIVEN.out
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "ZIP"
    scene.view_layers[0].use_pass_object_index = GIVEN.engine == "CYCLES"
    (set_up_cycles if GIVEN.engine == "CYCLES" else set_up_eevee)(scene)


bpy.ops.wm.read_factory_settings(use_empty=True)
with open(os.path.join(GIVEN.folder, "stage.json")) as file:
    STAGE = json.load(file)
for each in STAGE["bodies"]:
    add_body(each)
if "floor" in STAGE:
    add_floor(STAGE)
add_light(STAGE["light"])
add_surroundings(STAGE["light"])
add_camera(STAGE["camera"], STAGE["size"])
set_up_picture(bpy.context.scene)
bpy.ops.render.render(write_still=True)
