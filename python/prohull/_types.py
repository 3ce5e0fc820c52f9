"""The types of arguments, which editors complete and mypy checks."""

import os
from collections.abc import Sequence
from typing import Any, Callable, Literal, Optional, Protocol, Union

from numpy.typing import NDArray

#: The name of a file.
Path = Union[str, "os.PathLike[str]"]
#: A distance in the mesh's unit; or as in "0.5%", of the diagonal of the mesh's bounding box.
Gap = Union[float, str]
#: A function that is called with the stage and a fraction in [0, 1]. False, or numpy's, stops what runs; None and 0 do not.
Progress = Callable[[str, float], Optional[bool]]

# The names that the library knows; a test compares them.
Axis = Literal["x", "y", "z"]
Side = Literal["outer", "inner"]
Strategy = Literal["lazy", "paper1", "paper2"]
Repair = Literal["auto", "none", "wrap"]
OpenShells = Literal["close", "keep"]
Source = Literal["mesh", "convex-hull", "wrap"]
PieceShape = Literal["polytope", "box", "capsule", "sphere"]
SelfIntersections = Literal["by-strategy", "refused", "allowed"]
Proof = Literal["", "replay", "enclosure", "coverage", "padding"]
EngineName = Literal["auto", "bvh", "filter", "brute", "refinement", "paper-refinement", "walk"]


class _BecomesArray(Protocol):
    """What numpy.asarray takes."""

    def __array__(self) -> NDArray[Any]: ...


class _HasFaces(Protocol):
    """Such as trimesh.Trimesh and prohull.Mesh."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class _HasTriangles(Protocol):
    """Such as open3d.geometry.TriangleMesh."""

    @property
    def vertices(self) -> Any: ...
    @property
    def triangles(self) -> Any: ...


class _HasTensors(Protocol):
    """Such as open3d.t.geometry.TriangleMesh."""

    @property
    def vertex(self) -> Any: ...
    @property
    def triangle(self) -> Any: ...


#: A number for each of something.
Numbers = Union[NDArray[Any], Sequence[float]]
#: An array with two axes, or what numpy makes one of. ArrayLike would also take a file's name, and a number.
Rows = Union[NDArray[Any], _BecomesArray, Sequence[Sequence[float]], Sequence[NDArray[Any]]]
#: What is taken for a mesh: a path, vertices and faces, or a mesh of prohull, trimesh or Open3D.
MeshLike = Union[Path, tuple[Rows, Rows], _HasFaces, _HasTriangles, _HasTensors]


class _HasParts(Protocol):
    """Such as prohull.ConvexCover and prohull.robot.Robot."""

    def _view_parts(self) -> list[Any]: ...


#: What a page shows: a mesh or a path, a cover, a cage, a robot; or a list of meshes, which are convex pieces.
Viewable = Union[MeshLike, _HasParts, Sequence[MeshLike]]
