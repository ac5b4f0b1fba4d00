"""Draws an animated .glb of sprung with Blender's Cycles, without a display:

blender -b --factory-startup -noaudio -P blender_film.py -- FILM.glb FOLDER [WIDTH HEIGHT SAMPLES FRAMES]
"""
import math
import sys

import bpy
import mathutils
import numpy

if not hasattr(numpy, "bool"):  # Debian 12: Blender 3.4's importer is older than its NumPy
    numpy.bool = bool

words = sys.argv[sys.argv.index("--") + 1 :]
film, folder = words[:2]
width, height, samples, frames = [int(word) for word in words[2:]] or [640, 360, 32, 0]

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=film)
bodies = [thing for thing in bpy.context.scene.objects if thing.type == "MESH"]
corners = [body.matrix_world @ mathutils.Vector(corner) for body in bodies for corner in body.bound_box]
low = mathutils.Vector([min(corner[axis] for corner in corners) for axis in range(3)])
high = mathutils.Vector([max(corner[axis] for corner in corners) for axis in range(3)])
low.z = min(low.z, 0)  # the floor: what falls stays in the picture
middle, size = (low + high) / 2, (high - low).length

bpy.ops.mesh.primitive_plane_add(size=20 * size, location=(middle.x, middle.y, 0))
bpy.ops.object.light_add(type="SUN", rotation=(0.6, 0.2, 0.4))
bpy.context.object.data.energy = 3
direction = mathutils.Vector((0.6, -1.5, 0.5)).normalized()
bpy.ops.object.camera_add(location=middle + 2.2 * size * direction, rotation=direction.to_track_quat("Z", "Y").to_euler())

scene = bpy.context.scene
scene.camera = bpy.context.object
scene.world = bpy.data.worlds.new("sky")
scene.world.color = (0.35, 0.4, 0.5)
scene.render.engine = "CYCLES"
scene.cycles.samples = samples
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.render.filepath = folder.rstrip("/") + "/frame_"
last = max(math.ceil(action.frame_range[1]) for action in bpy.data.actions)
scene.frame_end = min(last, frames) if frames else last
bpy.ops.render.render(animation=True)
print("%d frames of %d" % (scene.frame_end, last))
