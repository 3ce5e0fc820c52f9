"""The call that makes hulls."""

import math
from collections.abc import Sequence
from typing import Any, Optional, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _prohull
from ._files import bound_of, distance_of, mesh_of, naming
from ._hull import Hull
from ._meshes import Mesh
from ._prohull import InputError
from ._types import Axis, Gap, MeshLike, Numbers, OpenShells, Progress, Repair, Rows, SelfIntersections, Side, Strategy


@overload
def build(mesh: MeshLike, target_faces: int = 2000, *, side: Side = ..., tight: bool = ..., levels: bool = ...,
          max_distance: Gap = ..., max_void_percent: float = ..., gap: Gap = ...,
          tolerances: Optional[Numbers] = ..., mirror: Optional[Axis] = ..., repair: Repair = ..., keep_cavities: bool = ...,
          open_shells: OpenShells = ..., seal_holes: Gap = ...,
          float32_coordinates: bool = ..., strategy: Strategy = ..., best_of: int = ..., seed: int = ...,
          threads: int = ..., self_intersections: SelfIntersections = ..., relax_guards: bool = ...,
          max_valence: int = ..., min_compactness_ratio: float = ..., sufficient_compactness: float = ...,
          max_normal_deviation_degrees: float = ..., max_overhang: float = ...,
          progress: Optional[Progress] = ...) -> Hull: ...
@overload
def build(mesh: MeshLike, target_faces: Sequence[int], *, side: Side = ..., tight: bool = ..., levels: bool = ...,
          max_distance: Gap = ..., max_void_percent: float = ..., gap: Gap = ...,
          tolerances: Optional[Numbers] = ..., mirror: Optional[Axis] = ..., repair: Repair = ..., keep_cavities: bool = ...,
          open_shells: OpenShells = ..., seal_holes: Gap = ...,
          float32_coordinates: bool = ..., strategy: Strategy = ..., best_of: int = ..., seed: int = ...,
          threads: int = ..., self_intersections: SelfIntersections = ..., relax_guards: bool = ...,
          max_valence: int = ..., min_compactness_ratio: float = ..., sufficient_compactness: float = ...,
          max_normal_deviation_degrees: float = ..., max_overhang: float = ...,
          progress: Optional[Progress] = ...) -> list[Hull]: ...
@overload
def build(vertices: Rows, /, faces: Rows, target_faces: int = 2000, *, side: Side = ..., tight: bool = ...,
          levels: bool = ..., max_distance: Gap = ..., max_void_percent: float = ...,
          gap: Gap = ..., tolerances: Optional[Numbers] = ..., mirror: Optional[Axis] = ..., repair: Repair = ..., keep_cavities: bool = ...,
          open_shells: OpenShells = ..., seal_holes: Gap = ...,
          float32_coordinates: bool = ..., strategy: Strategy = ..., best_of: int = ..., seed: int = ...,
          threads: int = ..., self_intersections: SelfIntersections = ..., relax_guards: bool = ...,
          max_valence: int = ..., min_compactness_ratio: float = ..., sufficient_compactness: float = ...,
          max_normal_deviation_degrees: float = ..., max_overhang: float = ...,
          progress: Optional[Progress] = ...) -> Hull: ...
@overload
def build(vertices: Rows, /, faces: Rows, target_faces: Sequence[int], *, side: Side = ..., tight: bool = ...,
          levels: bool = ..., max_distance: Gap = ..., max_void_percent: float = ...,
          gap: Gap = ..., tolerances: Optional[Numbers] = ..., mirror: Optional[Axis] = ..., repair: Repair = ..., keep_cavities: bool = ...,
          open_shells: OpenShells = ..., seal_holes: Gap = ...,
          float32_coordinates: bool = ..., strategy: Strategy = ..., best_of: int = ..., seed: int = ...,
          threads: int = ..., self_intersections: SelfIntersections = ..., relax_guards: bool = ...,
          max_valence: int = ..., min_compactness_ratio: float = ..., sufficient_compactness: float = ...,
          max_normal_deviation_degrees: float = ..., max_overhang: float = ...,
          progress: Optional[Progress] = ...) -> list[Hull]: ...
def build(mesh: Any, faces: Any = None, target_faces: Any = None, *,  # type: ignore[misc]  # the two ways of calls
          side: Side = "outer", tight: bool = False, levels: bool = False, max_distance: Gap = math.inf,
          max_void_percent: float = math.inf, gap: Gap = 0.0,
          tolerances: Optional[Numbers] = None, mirror: Optional[Axis] = None, repair: Repair = "auto",
          keep_cavities: bool = False, open_shells: OpenShells = "close", seal_holes: Gap = 0.0,
          float32_coordinates: bool = False,
          strategy: Strategy = "lazy", best_of: int = 1, seed: int = 0, threads: int = 0,
          self_intersections: SelfIntersections = "by-strategy", relax_guards: bool = True, max_valence: int = 12,
          min_compactness_ratio: float = 0.8, sufficient_compactness: float = 0.15,
          max_normal_deviation_degrees: float = 45.0, max_overhang: float = 0.1,
          progress: Optional[Progress] = None) -> Union[Hull, list[Hull]]:
    """Builds a certified hull of any triangles: build(mesh, target_faces) or build(vertices, faces, target_faces).

    A mesh that is not clean is repaired, and its openings get caps. The hull is the best one of hulls of that mesh, of
    its convex hull and of wraps, which are new closed surfaces around it; `source` says which (docs/repair.md).

    Guaranteed: a hull whose `certified` is True encloses every finite triangle of the mesh (with side="inner": is
    enclosed by the mesh). This is decided exactly, on the very numbers in `vertices`. The same input gives the same
    bits, whatever `threads` is.

    mesh: the path of a file (docs/formats.md), or a mesh of prohull, trimesh or Open3D.
    vertices, faces: (n, 3) of any floating point or integer dtype, and (m, 3) of the rows of vertices.
    target_faces: the largest number of faces, at least 4; 2000 unless given. A sequence of them gives a list of hulls,
        in the same order. A hull may keep more faces where no legal collapse is left; `target_reached` and `notes` say
        so.
    side: "outer" for a hull that encloses the mesh; "inner" for one that the mesh encloses, which must then be closed.
    tight: whether to move vertices towards the mesh between collapses. This leaves far less void, takes some 4 times as
        long (1.5 to 14 times at 100 faces), and keeps no levels.
    levels: whether to keep levels whatever the source is. Vertices then do not move after the last collapse, neither
        back towards the mesh nor over its folds, and the hull may have much more void.
    max_distance: largest distance of a point of the hull from the mesh, at least 0, said as gap is. It is proven.
        The hull is the coarsest one found, of at least target_faces faces, that keeps this bound and the next.
    max_void_percent: largest void, in per cent of the mesh's volume, at least 0.
    gap: least distance between hull and mesh, in the mesh's unit, at least 0; or as in "0.5%" of the diagonal of the
        mesh's bounding box. It is proven. All points that near are inside of an outer hull. An inner hull leaves out
        what is thinner than two gaps. max_distance must be greater. For hulls without levels only.
    tolerances: a number for each face of the mesh, at least 0: no point of the face is farther from the hull, in the
        mesh's unit. It is proven. 0 keeps the face, so that the hull has it with the same coordinates; math.inf allows
        any distance. Numbers for each vertex become such ones by `per_vertex[faces].min(axis=1)`. For hulls of meshes
        that can be closed, without tight and gap. Save such a hull as .ply, .obj or .off: .stl and .glb round it.
    mirror: "x", "y" or "z" for a hull that is exactly its own mirror image in the plane through the middle of the
        mesh's bounding box that is perpendicular to this axis. The mesh must be so too, bit for bit. Without tight, gap
        and tolerances. level() then gives symmetric levels.
    repair: "auto" repairs the mesh and takes the best source; "none" refuses what is not closed; "wrap" does without
        the mesh itself as a source.
    keep_cavities: whether to keep components that lie inside of others. Inner hulls always keep them.
    open_shells: "close" gives openings caps, so that what they lead into is inside; "keep" encloses the triangles only,
        as those of a thin shell. A leaf or a bedsheet always stays a sheet.
    seal_holes: largest diameter of openings that a wrap closes, at least 0, said as gap is.
    float32_coordinates: whether all coordinates shall be numbers that float32 keeps. Hull.save() makes them such for
        .stl and .glb files in any case.
    strategy: "lazy"; or "paper1" or "paper2", the two of Platis and Theoharis (2003).
    best_of: number of hulls to build, at least 1, each with a seed of its own; the one of least void is kept.
    seed: the first of the seeds, at least 0. Another seed gives a slightly different hull.
    threads: the largest number of threads; 0 means one for each core.
    self_intersections: "refused" refuses every collapse that would make the hull intersect itself; "allowed" is faster;
        "by-strategy" refuses them with "lazy", and allows them with the paper's two.
    relax_guards: whether the five guards that follow give way, in four steps, where target_faces is not reached
        otherwise.
    max_valence: largest number of faces around a new vertex, in [3, 1000].
    min_compactness_ratio: smallest compactness of a triangle after a collapse, relative to before, in [0, 1].
        Compactness is 1 for an equilateral triangle, and 0 for one without area.
    sufficient_compactness: compactness that is enough whatever it was before, in [0, 1]; with "lazy" only.
    max_normal_deviation_degrees: largest angle by which a collapse may turn a face, in degrees, in [0, 90].
    max_overhang: how far a new vertex may lie outside of the box of the mesh, along each axis, relative to the diagonal
        of the box; at least 0.
    progress: a function that is called with the stage and a fraction in [0, 1], some 20 times a second, on the calling
        thread. The last call is ("done", 1.0). If it returns False (or numpy's; not None or 0), the build stops with
        KeyboardInterrupt, as for Ctrl-C. What it raises stops the build and reaches the caller.

    Raises InputError, a ValueError, for a file that cannot be read, a mesh without a finite triangle, a mesh that is
    not closed where it has to be, and arguments that are not as above.

        hull = prohull.build("part.stl", 500, tight=True)
        hull.save("part_collision.stl")
    """
    keywords = {name: value for name, value in locals().items() if name not in ("mesh", "faces", "target_faces", "progress")}
    given, targets = _given(mesh, faces, target_faces)
    keywords.update(max_distance=bound_of("max_distance", max_distance, given), gap=distance_of("gap", gap, given),
                    seal_holes=bound_of("seal_holes", seal_holes, given),
                    tolerances=() if tolerances is None else tolerances)
    with naming(mesh):
        made = _prohull.build(given._core, [int(n) for n in np.atleast_1d(targets)], progress, keywords)
    hulls = [Hull._made(dict(facts, _mirror=mirror), side) for facts in made]
    return hulls if targets.ndim > 0 else hulls[0]


_CALLS = "expected build(mesh, target_faces) or build(vertices, faces, target_faces)"


def _given(mesh: Any, faces: Any, target_faces: Any) -> tuple[Mesh, NDArray[Any]]:
    """The mesh, and the number of faces or several of them, whichever of the two calls it is."""
    if _arrays.is_mesh(mesh):
        if faces is not None and target_faces is not None:
            raise InputError(f"{_arrays.described(mesh)} is a mesh already: {_CALLS}")
        targets = _targets(target_faces if faces is None else faces)
        return mesh_of(mesh, keep_non_finite=True), targets
    if faces is None:
        raise InputError(f"{_arrays.described(mesh)} is no mesh; {_arrays.MESHES}")
    if np.ndim(faces) == 0:
        raise InputError(f"{_arrays.described(mesh)}, {faces!r}: {_CALLS}")
    return Mesh(mesh, faces), _targets(target_faces)


def _targets(target_faces: Any) -> NDArray[Any]:
    return _arrays.face_counts("target_faces", 2000 if target_faces is None else target_faces)
