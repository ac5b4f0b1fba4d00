"""For Blender in the background: puts point caches on an imported OBJ, plays an imported animated .glb, and compares
their vertices with later OBJs."""
import os
import sys

import bpy
import numpy

FOLDER = sys.argv[sys.argv.index("--") + 1]
FRAMES = (1, 3, 6)


def file_of(frame):
    return os.path.join(FOLDER, "skin_%04d.obj" % frame)


def vertices_in(path):
    bodies = {}
    for line in open(path):
        if line.startswith("o "):
            places = bodies.setdefault(line[2:].strip(), [])
        if line.startswith("v "):
            places.append([float(word) for word in line.split()[1:4]])
    return bodies


def error_of(name, places, turn):
    thing = bpy.data.objects[name]
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    assert len(mesh.vertices) == len(places), (name, len(mesh.vertices), len(places))
    found = [thing.matrix_world @ vertex.co for vertex in mesh.vertices]
    return max(abs(a - b) for vertex, place in zip(found, places) for a, b in zip(vertex, turn(place)))


def compare(what, frame, error=1e-6, turn=lambda place: place):
    worst = max(error_of(name, places, turn) for name, places in vertices_in(file_of(frame)).items())
    print("%s frame %d: vertices differ by at most %.2g m" % (what, frame, worst))
    assert worst < error


names = list(vertices_in(file_of(1)))

bpy.ops.wm.read_factory_settings(use_empty=True)
# Both as they are, without turning y up into z up.
bpy.ops.wm.obj_import(filepath=file_of(1), forward_axis="Y", up_axis="Z")
for kind in ("PC2", "MDD"):
    for number, name in enumerate(names, 1):
        bpy.data.objects[name].modifiers.clear()
        modifier = bpy.data.objects[name].modifiers.new("film", "MESH_CACHE")
        modifier.cache_format = kind
        modifier.filepath = os.path.join(FOLDER, "points_%d.%s" % (number, kind.lower()))
        modifier.frame_start = 1
        modifier.forward_axis = "POS_Y"
        modifier.up_axis = "POS_Z"
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        compare(kind, frame)

numpy.bool = bool  # which Blender 3.4's importer of glTF still asks numpy for
for name, error in (("film.glb", 1e-6), ("quantized.glb", 5e-6)):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 24
    bpy.ops.import_scene.gltf(filepath=os.path.join(FOLDER, name))
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame - 1)  # it begins with 0
        compare(name, frame, error, lambda place: (place[0], -place[2], place[1]))  # z is up there
