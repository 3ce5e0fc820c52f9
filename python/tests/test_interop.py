"""trimesh and Open3D need not be installed: what stands in for them has their shape."""

import sys
import types

import numpy as np
import prohull
import pytest


class Trimesh:
    def __init__(self, vertices, faces, process=True):
        self.vertices, self.faces, self.process = vertices, faces, process


class Vector(list):
    """Like Open3D's, known to numpy by its items only."""

    def __init__(self, rows):
        super().__init__(np.asarray(rows).tolist())


class Open3DMesh:
    def __init__(self, vertices, triangles):
        self.vertices, self.triangles = vertices, triangles


class Tensor:
    def __init__(self, array):
        self.array = array

    def cpu(self):
        return self

    def numpy(self):
        return self.array


def test_trimesh(cube, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", types.SimpleNamespace(Trimesh=Trimesh))
    hull = prohull.build(Trimesh(*cube), target_faces=12)
    mesh = hull.to_trimesh()
    assert mesh.faces.dtype == np.int64 and mesh.process is False
    assert mesh.vertices.flags.writeable, "a mesh of its own"
    assert prohull.verify(mesh, Trimesh(*cube))


def test_open3d(cube, monkeypatch):
    monkeypatch.setitem(sys.modules, "open3d", types.SimpleNamespace(
        geometry=types.SimpleNamespace(TriangleMesh=Open3DMesh),
        utility=types.SimpleNamespace(Vector3dVector=Vector, Vector3iVector=Vector)))
    hull = prohull.build(Open3DMesh(Vector(cube[0]), Vector(cube[1])), target_faces=12)
    mesh = hull.to_open3d()
    assert isinstance(mesh.vertices, Vector) and prohull.verify(mesh, cube)


def test_open3d_tensors(cube):
    mesh = types.SimpleNamespace(vertex={"positions": Tensor(cube[0].astype(np.float32))},
                                 triangle={"indices": Tensor(cube[1])})
    assert len(prohull.build(mesh, target_faces=12).faces) == 12


@pytest.mark.parametrize("thing, named", [(None, "NoneType"), (7, "7"), ([1, 2], "a list"), (object(), "a object"),
                                          (np.zeros((8, 3)), r"an array of shape \(8, 3\)")])
def test_what_is_no_mesh_is_named(thing, named):
    for call in (prohull.build, lambda mesh: prohull.distance_bounds(mesh, mesh)):
        with pytest.raises(prohull.InputError, match=named + " is no mesh; expected the path of a file, vertices and faces"):
            call(thing)
