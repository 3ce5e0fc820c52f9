"""Enclosing Decimate: an add-on for Blender that makes coarse meshes around others, or inside of them, by the program prohull.

scripts/blender-addon makes a zip of it for Edit > Preferences > Add-ons > Install. docs/guides/blender.md says how to use it.
"""

import glob
import json
import math
import os
import shutil
import struct
import subprocess
import tempfile

import bpy

bl_info = {
    "name": "Enclosing Decimate",
    "description": "Coarse hulls that provably enclose a mesh, or lie inside of it, and convex pieces that cover it",
    "author": "prohull",
    "version": (0, 1, 0),
    "blender": (2, 93, 0),
    "location": "3D View > Object > Enclosing Decimate",
    "category": "Object",
}

SCALE_TOLERANCE = 1e-6  # Blender keeps matrices in single precision


class Failed(Exception):
    """What the user is told."""


class EnclosingDecimatePreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    program: bpy.props.StringProperty(name="Program", default="prohull", subtype="FILE_PATH",
                                      description="The program prohull: a path, or a name that is found in PATH")

    def draw(self, context):
        self.layout.prop(self, "program")


class OBJECT_OT_enclosing_decimate(bpy.types.Operator):
    """Make a coarse mesh that provably encloses the active mesh, or lies inside of it, or convex pieces that cover it"""

    bl_idname = "object.enclosing_decimate"
    bl_label = "Enclosing Decimate"
    bl_options = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(name="Make", default="OUTER", items=(
        ("OUTER", "Outer hull", "One mesh that encloses the object"),
        ("INNER", "Inner hull", "One mesh that the object encloses; the object must be closed"),
        ("PIECES", "Convex pieces", "Convex meshes that cover the object together")))
    budget: bpy.props.EnumProperty(name="Budget", default="FACES", items=(
        ("FACES", "Number", "At most as many faces, or pieces"),
        ("DISTANCE", "Distance", "As few faces, or pieces, as reach no farther from the object")))
    faces: bpy.props.IntProperty(name="Faces", default=500, min=4, max=10**9, description="Largest number of faces of the hull")
    pieces: bpy.props.IntProperty(name="Pieces", default=16, min=1, max=1000, description="Largest number of convex pieces")
    distance: bpy.props.FloatProperty(name="Distance", default=0.01, min=1e-6, subtype="DISTANCE", precision=4,
                                      description="How far the result may be from the object, at most")

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        for name in ("kind", "budget"):
            self.layout.prop(self, name)
        if self.kind == "PIECES":
            self.layout.prop(self, "pieces")
        elif self.budget == "FACES":
            self.layout.prop(self, "faces")
        if self.budget == "DISTANCE":
            self.layout.prop(self, "distance")

    def execute(self, context):
        try:
            made = self.made(context, context.object)
        except Failed as failed:
            self.report({"ERROR"}, str(failed))
            return {"CANCELLED"}
        for each in context.selected_objects:
            each.select_set(False)
        for each in made:
            each.select_set(True)
        context.view_layer.objects.active = made[0]
        if not made[0]["prohull_within_bounds"]:
            self.report({"WARNING"}, "The distance asked for could not be kept: allow more")
        if self.kind != "PIECES" and self.budget == "FACES" and len(made[0].data.polygons) > self.faces:
            self.report({"WARNING"}, f"The hull has more than {self.faces} faces: no face that is left can go")
        return {"FINISHED"}

    def made(self, context, source):
        with tempfile.TemporaryDirectory(prefix="prohull") as folder:
            write_obj(evaluated_triangles(context, source), os.path.join(folder, "mesh.obj"))
            report = run(program_of(context), folder, self.arguments(source))
            meshes = [read_stl(path) for path in sorted(glob.glob(os.path.join(glob.escape(folder), "made*.stl")))]
        if not meshes:
            raise Failed("prohull wrote nothing: it could not prove the result")
        facts = facts_of_pieces(report) if self.kind == "PIECES" else facts_of_hull(report)
        facts.update(prohull_original=source.name, prohull_kind=self.kind.lower(), prohull_version=report["version"])
        word = {"OUTER": "hull", "INNER": "inner hull", "PIECES": "piece"}[self.kind]
        return [new_object(context, source, f"{source.name} {word}", mesh, facts) for mesh in meshes]

    def arguments(self, source):
        """Of prohull, which works with the coordinates of the object itself."""
        by_distance = self.budget == "DISTANCE"
        bound = ["--max-distance", repr(self.distance / scale_of(source))] if by_distance else []
        if self.kind == "PIECES":
            return ["convex", "mesh.obj", "--pieces", str(self.pieces), *bound, "-o", "made.stl"]
        faces = "4" if by_distance else str(self.faces)
        return ["build", "mesh.obj", "--side", self.kind.lower(), "--faces", faces, *bound, "-o", "made.stl"]


def scale_of(source):
    """Of lengths, from the object to the world."""
    to_world = source.matrix_world.to_3x3()
    squares = to_world.transposed() @ to_world  # the square of the scale times the identity
    square = squares[0][0]
    if square == 0 or max(abs(squares[i][j] - square * (i == j)) for i in range(3) for j in range(3)) > SCALE_TOLERANCE * square:
        raise Failed("A distance needs an object with the same scale along all axes: apply its scale (Ctrl A) first")
    return math.sqrt(square)


def program_of(context):
    named = context.preferences.addons[__name__].preferences.program
    found = shutil.which(bpy.path.abspath(named) if os.sep in named else named)
    if not found:
        raise Failed(f"The program {named} is not there: install prohull, or name it in the preferences of this add-on")
    return found


def run(program, folder, arguments):
    """Runs prohull in the folder. Returns its report."""
    report = os.path.join(folder, "report.json")
    try:
        done = subprocess.run([program, *arguments, "--report", report, "-q"], cwd=folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    except OSError as error:
        raise Failed(f"{program}: {error.strerror}") from None
    if done.returncode > 1 or not os.path.exists(report):
        lines = done.stderr.decode(errors="replace").strip().splitlines() or [f"{program}: exit code {done.returncode}"]
        raise Failed(lines[0].removeprefix("prohull: mesh.obj: "))
    with open(report, encoding="utf-8") as file:
        return json.load(file)


def evaluated_triangles(context, source):
    """Coordinates and triangles of the object with its modifiers."""
    evaluated = source.evaluated_get(context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    try:
        mesh.calc_loop_triangles()
        return [tuple(v.co) for v in mesh.vertices], [tuple(t.vertices) for t in mesh.loop_triangles]
    finally:
        evaluated.to_mesh_clear()


def write_obj(mesh, path):
    vertices, triangles = mesh
    if not triangles:
        raise Failed("The object has no faces")
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v {!r} {!r} {!r}\n".format(*v) for v in vertices)
        file.writelines("f {} {} {}\n".format(*(i + 1 for i in t)) for t in triangles)


def read_stl(path):
    """A binary STL file, with its corners joined again: they are equal bit for bit."""
    with open(path, "rb") as file:
        records = struct.iter_unpack("<12f2x", file.read()[84:])
        numbers, triangles = {}, []
        for record in records:
            corners = (record[3:6], record[6:9], record[9:12])
            triangles.append(tuple(numbers.setdefault(corner, len(numbers)) for corner in corners))
    return list(numbers), triangles


def new_object(context, source, name, mesh, facts):
    """A child of the source, which moves with it, with the facts as custom properties."""
    data = bpy.data.meshes.new(name)
    data.from_pydata(mesh[0], [], mesh[1])
    data.update()
    made = bpy.data.objects.new(name, data)
    made.parent = source
    made.display_type = "WIRE"
    for key, value in facts.items():
        made[key] = value
    context.collection.objects.link(made)
    return made


def facts_of_hull(report):
    hull = report["hull"]
    return described({**facts_of_verdict(hull["verdict"]), "void_ratio": hull["void_ratio"],
                      "within_bounds": hull["within_bounds"]})


def facts_of_pieces(report):
    """They are about all pieces together."""
    verdict = report["verdict"]
    return described({**facts_of_verdict(verdict), "void_ratio": report["void_ratio"],
                      "within_bounds": report["within_bounds"], "covers_inside": verdict["encloses_solid"] is True,
                      "pieces": len(report["pieces"])})


def facts_of_verdict(verdict):
    distance = verdict["distance_to_solid"] or verdict["distance_to_triangles"]
    return {"certified": verdict["certified"], "proof": verdict["proof"], "distance_bound": distance["upper"]}


def described(facts):
    return {f"prohull_{name}": "unknown" if value is None else value for name, value in facts.items()}


def menu(self, context):
    self.layout.operator(OBJECT_OT_enclosing_decimate.bl_idname)


CLASSES = (EnclosingDecimatePreferences, OBJECT_OT_enclosing_decimate)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.VIEW3D_MT_object.append(menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(menu)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
