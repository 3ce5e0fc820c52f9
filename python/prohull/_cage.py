"""Cages: hulls that keep a gap from the mesh."""

from dataclasses import dataclass, field
from typing import Any, Optional

from . import _prohull
from ._covers import _covered
from ._meshes import Mesh
from ._shown import Shown
from ._types import Gap, MeshLike, Progress
from ._verify import Proven, Verdict, verdict_of
from ._view import Part, mesh_parts


class CageHull(Proven, Mesh):
    """A hull of a cage: closed, with faces that look outwards. Everything that a Mesh does, it does."""

    verdict: Verdict  #: whether it is proven, exactly, that it encloses the mesh (an inner one: is enclosed by it)
    is_disjoint: bool  #: whether no face of it touches the mesh, the other hull, or itself; exact
    keeps_gap: bool  #: whether `verdict.gap` is at least the gap asked for; an inner hull of a thin mesh may keep less
    void_ratio: float  #: the void, as a share of the volume of the mesh
    target_reached: bool  #: whether it has at most as many faces as were asked for
    smallest_angle_degrees: float  #: of all its triangles
    worst_aspect_ratio: float  #: longest edge of a triangle, divided by its shortest altitude
    notes: list[str]  #: what is not as it was asked for, and what is worth a look


@dataclass(frozen=True)
class Cage(Shown):
    """A nested pair of hulls, or an outer one alone; cage() makes it."""

    outer: CageHull
    inner: Optional[CageHull]
    gap: float  #: what was asked for, in the mesh's unit
    notes: list[str]  #: what is worth a look
    original: Mesh = field(repr=False)  #: what the cage is of

    def _view_parts(self) -> list[Part]:
        inner = [] if self.inner is None else mesh_parts(self.inner, "inner hull", "inner")
        return mesh_parts(self.outer, "outer hull", "outer") + inner


def cage(mesh: MeshLike, faces: int = 400, *, inner_faces: int = 0, gap: Gap = 0.0, even: bool = False,
         tight: bool = False, float32_coordinates: bool = False, threads: int = 0,
         progress: Optional[Progress] = None) -> Cage:
    """Builds a cage of a mesh, as `prohull cage` does: hulls that keep a gap from it.

    Guaranteed: if `certified` and `is_disjoint` of both hulls are True, the outer hull encloses the mesh, the mesh
    encloses the inner hull, and no face of one of the three touches another. This is decided exactly, on the very
    numbers in `vertices`. The same input gives the same bits, whatever `threads` is.

    mesh: the path of a file, or a mesh of prohull, trimesh or Open3D, or a tuple of vertices and faces.
    faces: the largest number of faces of the outer hull, at least 4.
    inner_faces: the largest number of faces of the inner hull, at least 4; with 0 there is none.
    gap: least distance of both hulls from the mesh, in the mesh's unit, or as in "0.5%" of the diagonal of its box; with 0 it is
        0.1 % of that.
    even: whether to make all triangles well shaped. The hulls then have more void.
    tight: whether to start from tight hulls, which takes longer (build).
    float32_coordinates: whether all coordinates shall be numbers that float32 keeps, as STL and GLB files do.
    threads: the largest number of threads; 0 means one for each core.
    progress: called as build() calls it. If it returns False, the work stops with KeyboardInterrupt, as for Ctrl-C.

    Raises InputError, a ValueError, for a file that cannot be read, a mesh without a finite triangle, an inner hull of a
    mesh that is not closed or where none is found, and arguments that are not as above.

        made = prohull.cage("organ.stl", 600, inner_faces=300, even=True)
        made.outer.save("outer.obj")
    """
    keywords = dict(faces=faces, inner_faces=inner_faces, gap=gap, even=even, tight=tight,
                    float32_coordinates=float32_coordinates, threads=threads)
    facts = _covered(_prohull.cage, mesh, progress, keywords)
    outer, inner = (hull and CageHull._with(hull.pop("mesh"), **{**hull, **verdict_of(hull)}) for hull in (facts["outer"], facts["inner"]))
    return Cage(outer, inner, facts["gap"], facts["notes"], facts["original"])
