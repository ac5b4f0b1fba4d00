"""For Blender in the background: takes the passes of p.exr apart in the compositor and compares them with each other
and with p.png."""
import os
import sys

import bpy
import numpy

FOLDER = sys.argv[sys.argv.index("--") + 1]
NAMES = ("Combined", "Depth", "Shadow", "AO", "Normal", "Vector", "IndexOB", "UV", "Position")

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 480, 270, 100
scene.collection.objects.link(bpy.data.objects.new("camera", bpy.data.cameras.new("camera")))
scene.camera = bpy.data.objects["camera"]
scene.use_nodes = True
nodes, links = scene.node_tree.nodes, scene.node_tree.links
nodes.clear()
picture = bpy.data.images.load(os.path.join(FOLDER, "p.exr"))
source = nodes.new("CompositorNodeImage")
source.image = picture
offered = [output.name for output in source.outputs]
for name in NAMES + ("CryptoObject00", "CryptoObject01", "CryptoObject02"):
    assert name in offered, "Blender has no %s among %s" % (name, offered)
files = nodes.new("CompositorNodeOutputFile")
files.base_path = FOLDER
files.format.file_format = "OPEN_EXR"
files.format.color_depth = "32"
files.file_slots.clear()
for name in NAMES:
    files.file_slots.new(name + "_")
    links.new(source.outputs[name], files.inputs[-1])
matte = nodes.new("CompositorNodeCryptomatteV2")
matte.source = "IMAGE"
matte.image = picture
matte.layer_name = "CryptoObject"
matte.matte_id = "torus"
files.file_slots.new("Matte_")
links.new(matte.outputs["Matte"], files.inputs[-1])
nodes.new("CompositorNodeComposite")
links.new(source.outputs["Combined"], nodes["Composite"].inputs[0])
bpy.ops.render.render()


def pixels(file, color=False):
    image = bpy.data.images.load(os.path.join(FOLDER, file))
    if not color:
        image.colorspace_settings.name = "Non-Color"
    return numpy.array(image.pixels[:]).reshape(270, 480, -1)


found = {name: pixels(name + "_0001.exr") for name in NAMES + ("Matte",)}
body = found["IndexOB"][..., 0] == 1
print("%d pixels show the body; Blender's matte of it covers %.1f" % (body.sum(), found["Matte"][..., 0].sum()))
assert body.sum() > 2000
assert abs(found["Matte"][..., 0].sum() / body.sum() - 1) < 0.02
assert found["Matte"][..., 0][body].mean() > 0.97
depth = found["Depth"][..., 0][body]
assert 0.05 < depth.min() < depth.max() < 2, "metres from the camera"
assert abs(numpy.linalg.norm(found["Normal"][..., :3][body], axis=1) - 1).max() < 1e-4
for name in ("Shadow", "AO"):
    share = found[name][..., 0]
    print("%s from %.3f to %.3f" % (name, share.min(), share.max()))
    assert 0 <= share.min() < 0.2 and 0.99 < share.max() <= 1
light = found["Combined"][..., :3]
shown = pixels("p.png", color=True)[..., :3]  # sRGB, as stored
linear = numpy.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
dull = light.max(axis=2) < 0.5  # where the tone curve takes away a constant at most
gap = abs(light - linear)[dull]
print("beauty and picture differ by %.4f on average where the tone curve is straight" % gap.mean())
assert gap.mean() < 0.025
