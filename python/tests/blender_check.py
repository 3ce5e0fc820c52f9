"""Runs in Blender, for test_blender.py: installs the add-on from its zip and uses it as from the menu."""

import json
import math
import pathlib
import sys

import bpy

ZIP, PROGRAM, OUT = sys.argv[sys.argv.index("--") + 1:]
out = pathlib.Path(OUT)


def decimate(**options):
    """What the operator says if it refuses; else what it has made."""
    before = set(bpy.data.objects)
    try:
        assert bpy.ops.object.enclosing_decimate(**options) == {"FINISHED"}
    except RuntimeError as error:
        assert set(bpy.data.objects) == before
        return str(error)
    return [made for made in bpy.data.objects if made not in before]


def use(source):
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = source
    source.select_set(True)


def save(name, source):
    """In the coordinates of the object itself."""
    mesh = source.data
    mesh.calc_loop_triangles()
    lines = ["v {!r} {!r} {!r}".format(*v.co) for v in mesh.vertices]
    lines += ["f {} {} {}".format(*(i + 1 for i in t.vertices)) for t in mesh.loop_triangles]
    (out / f"{name}.obj").write_text("\n".join(lines) + "\n")


def facts_of(made):
    return {key: made[key] for key in made.keys() if key.startswith("prohull_")}


bpy.ops.preferences.addon_install(filepath=ZIP)
bpy.ops.preferences.addon_enable(module="enclosing_decimate")
preferences = bpy.context.preferences.addons["enclosing_decimate"].preferences
preferences.program = PROGRAM
told = {}

bpy.ops.mesh.primitive_torus_add(major_segments=48, minor_segments=24, location=(1, 2, 3), rotation=(1, 0, 0))
torus = bpy.context.object
torus.scale = (2, 2, 2)
bpy.context.view_layer.update()
save("torus", torus)
for name, options in {"outer": {"faces": 200}, "inner": {"kind": "INNER", "faces": 200},
                      "near": {"budget": "DISTANCE", "distance": 0.1}, "pieces": {"kind": "PIECES", "pieces": 4}}.items():
    use(torus)
    made = decimate(**options)
    assert isinstance(made, list), made
    bpy.context.view_layer.update()
    assert all(each.matrix_world == torus.matrix_world for each in made)
    for i, each in enumerate(made):
        save(f"{name}_{i}", each)
    told[name] = {"count": len(made), "faces": len(made[0].data.polygons), **facts_of(made[0])}

use(torus)
torus.modifiers.new("Subdivision", "SUBSURF").levels = 1
told["modifier"] = facts_of(decimate(faces=100)[0])
torus.modifiers.clear()

torus.scale = (1, 2, 3)
bpy.context.view_layer.update()
use(torus)
told["uneven scale"] = decimate(budget="DISTANCE")
use(torus)
decimate(kind="INNER", faces=4)
torus.scale = (1, 1, 1)
torus.rotation_euler = (0, 0, math.pi / 4)
torus.parent = bpy.data.objects.new("uneven", None)
torus.parent.scale = (2, 1, math.sqrt(2.5))  # all axes of the torus become as long
bpy.context.collection.objects.link(torus.parent)
bpy.context.view_layer.update()
use(torus)
told["shear"] = decimate(budget="DISTANCE")
preferences.program = "/nowhere/prohull"
told["no program"] = decimate()
preferences.program = "/bin/false"
told["another program"] = decimate()
preferences.program = PROGRAM
empty = bpy.data.objects.new("empty", bpy.data.meshes.new("empty"))
bpy.context.collection.objects.link(empty)
use(empty)
told["empty"] = decimate()
bpy.ops.mesh.primitive_grid_add()
told["open"] = decimate(kind="INNER")
for vertex in bpy.context.object.data.vertices:
    vertex.co.x = float("nan")
told["nan"] = decimate()
(out / "told.json").write_text(json.dumps(told))
