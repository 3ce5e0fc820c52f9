"""prohull.trimesh, with trimesh if it is installed, else with what stands in for its meshes."""

import json
import sys
import types

import numpy as np
import prohull
import prohull.trimesh
import pytest

try:
    from trimesh import Trimesh
except ImportError:

    class Trimesh:
        def __init__(self, vertices, faces, process=True):
            self.vertices, self.faces, self.metadata = np.asanyarray(vertices), np.asanyarray(faces), {}


@pytest.fixture(autouse=True)
def some_trimesh(monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", types.SimpleNamespace(Trimesh=Trimesh))


def test_pieces_cover_the_mesh_and_say_so(pony):
    mesh = Trimesh(pony.vertices, pony.faces, process=False)
    pieces = prohull.trimesh.convex_decomposition(mesh, maxConvexHulls=6, maxNumVerticesPerCH=24)
    assert len(pieces) == 6 and all(type(piece) is Trimesh and len(piece.vertices) <= 24 for piece in pieces)
    assert prohull.verify_union(pieces, mesh)
    told = pieces[0].metadata["prohull"]
    assert told["verdict"]["certified"] and told["verdict"]["encloses_solid"] and not told["within_bounds"]
    assert told["verdict"]["distance_to_solid"][1] > 0 and json.dumps(told)


def test_a_hull_encloses_the_mesh_and_says_so(pony):
    mesh = Trimesh(pony.vertices, pony.faces, process=False)
    hull = prohull.trimesh.simplify(mesh, face_count=200)
    assert type(hull) is Trimesh and len(hull.faces) <= 200 and prohull.verify(hull, mesh)
    told = hull.metadata["prohull"]
    assert told["certified"] and told["target_reached"] and told["distance_bound"] > 0 and json.dumps(told)


def test_percent_is_the_share_of_faces_that_go(pony):
    mesh = Trimesh(pony.vertices, pony.faces, process=False)
    assert len(prohull.trimesh.simplify(mesh, 0.9).faces) <= round(0.1 * len(mesh.faces))
    inner = prohull.trimesh.simplify(mesh, percent=0.9, side="inner")
    assert inner.metadata["prohull"]["side"] == "inner" and prohull.verify(inner, mesh, side="inner")


@pytest.mark.parametrize("arguments, told", [
    ({}, "percent=None, face_count=None: expected one of them"), ({"percent": 0.5, "face_count": 9}, "expected one"),
    ({"percent": 90}, "less than 1"), ({"percent": float("nan")}, "at least 0"), ({"percent": "most"}, "a number"),
    ({"face_count": 3}, "at least 4"), ({"face_count": [5, 6]}, "one whole number")])
def test_what_is_wrong_is_one_error(cube, arguments, told):
    with pytest.raises(prohull.InputError, match=told):
        prohull.trimesh.simplify(Trimesh(*cube), **arguments)


def test_hostile_meshes_are_one_error(cube):
    hostile = [None, 7, Trimesh(np.zeros((0, 3)), np.zeros((0, 3), int)), Trimesh(np.full((8, 3), np.nan), cube[1]),
               Trimesh(cube[0], cube[1] + 1), Trimesh(cube[0], None)]
    for mesh in hostile:
        with pytest.raises(prohull.InputError):
            prohull.trimesh.convex_decomposition(mesh)
        for how in ({"percent": 0.5}, {"face_count": 100}):
            with pytest.raises(prohull.InputError):
                prohull.trimesh.simplify(mesh, **how)
    with pytest.raises(FileNotFoundError):
        prohull.trimesh.simplify("missing.stl", face_count=100)
    with pytest.raises(TypeError):
        prohull.trimesh.convex_decomposition(Trimesh(*cube), resolution=400000)


def test_percent_is_that_of_a_file_too(pony, tmp_path):
    pony.save(tmp_path / "pony.ply")
    assert len(prohull.trimesh.simplify(tmp_path / "pony.ply", 0.9).faces) <= round(0.1 * len(pony.faces))


def test_without_trimesh_only_the_functions_fail_and_before_the_work(monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    for function in (prohull.trimesh.simplify, prohull.trimesh.convex_decomposition):
        with pytest.raises(ImportError):
            function("missing.stl")
