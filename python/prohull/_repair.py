"""Closed solids of meshes."""

from typing import Optional

from . import _prohull
from ._covers import _covered
from ._meshes import Mesh
from ._types import Gap, MeshLike, OpenShells, Progress, Source
from ._verify import Proven, Verdict


class Solid(Proven, Mesh):
    """A closed mesh whose faces look outwards, which repair() makes. Everything that a Mesh does, it does."""

    verdict: Verdict  #: what is proven, exactly: whether it covers every finite triangle of the mesh
    source: Source  #: "mesh"; or "wrap", which is another solid than the mesh
    wrap_spacing: float  #: of the grid that a wrap was made on, in the mesh's unit; 0 if it is none
    repairs: list[str]  #: what was changed
    obstacle: str  #: the defect that repairs have left, so that there is a wrap; empty if they left none
    closed_openings: int  #: number of openings that got a cap
    largest_opening: float  #: the diameter of the largest of these, in the mesh's unit
    original: Mesh  #: what it was made of


def repair(mesh: MeshLike, *, spacing: Gap = 0.0, open_shells: OpenShells = "close", keep_cavities: bool = True,
           float32_coordinates: bool = False, progress: Optional[Progress] = None) -> Solid:
    """Makes a closed solid of any triangles, as `prohull repair` does: what build() takes as the solid of the mesh.

    Openings get caps. Where repairs do not give a closed mesh that covers all triangles, the solid is a wrap, a new
    closed surface around them; `source` says so.

    Guaranteed: a solid whose `certified` is True covers every finite triangle of the mesh. This is decided exactly, on
    the very numbers in `vertices`.

    mesh: the path of a file, or a mesh of prohull, trimesh or Open3D, or a tuple of vertices and faces.
    spacing: of the grid that a wrap is made on, in the mesh's unit, at least 0; or as in "0.5%" of the diagonal of the
        mesh's bounding box. With 0 it is 1/256 of that diagonal.
    open_shells: "close" gives openings caps; "keep" makes a thin solid of the triangles.
    keep_cavities: whether to keep components that lie inside of others.
    float32_coordinates: whether all coordinates shall be numbers that float32 keeps, as STL and GLB files do.
    progress: called as build() calls it, with the stages "wrap" and "verify".

    Raises InputError, a ValueError, for a file that cannot be read, a mesh without a finite triangle, and arguments that
    are not as above.

        solid = prohull.repair("scan.stl")
        solid.save("scan_solid.ply")
    """
    keywords = dict(spacing=spacing, open_shells=open_shells, keep_cavities=keep_cavities,
                    float32_coordinates=float32_coordinates)
    facts = _covered(_prohull.repair, mesh, progress, keywords)
    return Solid._with(facts.pop("mesh"), **facts)
