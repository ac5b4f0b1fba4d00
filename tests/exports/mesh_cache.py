"""For Blender in the background: puts point caches on an imported OBJ and compares its vertices with later OBJs."""
import os
import sys

import bpy

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


def error_of(name, places):
    mesh = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    assert len(mesh.vertices) == len(places), name
    return max(abs(a - b) for vertex, place in zip(mesh.vertices, places) for a, b in zip(vertex.co, place))


bpy.ops.wm.read_factory_settings(use_empty=True)
# Both as they are, without turning y up into z up.
bpy.ops.wm.obj_import(filepath=file_of(1), forward_axis="Y", up_axis="Z")
names = list(vertices_in(file_of(1)))
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
        worst = max(error_of(name, places) for name, places in vertices_in(file_of(frame)).items())
        print("%s frame %d: vertices differ by at most %.2g m" % (kind, frame, worst))
        assert worst < 1e-6
