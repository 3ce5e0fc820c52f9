"""Two functions of the form that users of trimesh call, with proofs: trimesh.Trimesh in and out (docs/python.md).

    parts = prohull.trimesh.convex_decomposition(mesh, maxConvexHulls=16)
    coarse = prohull.trimesh.simplify(mesh, face_count=500)
    assert coarse.metadata["prohull"]["certified"]

`metadata["prohull"]` of each result says what is proven. Importing this module does not need trimesh; its functions do.
"""

from __future__ import annotations

import math
from dataclasses import asdict
from importlib import import_module
from typing import TYPE_CHECKING, Any, Optional

from . import _arrays
from ._build import build
from ._covers import convex_pieces
from ._files import mesh_of
from ._meshes import Mesh
from ._prohull import InputError
from ._types import Gap, MeshLike

if TYPE_CHECKING:
    import trimesh

__all__ = ["convex_decomposition", "simplify"]


def convex_decomposition(mesh: MeshLike, *, maxConvexHulls: int = 64, maxNumVerticesPerCH: int = 64,
                         minimumVolumePercentErrorAllowed: float = 1.0, max_distance: Gap = math.inf) -> list[trimesh.Trimesh]:
    """Covers a mesh by convex pieces, in place of `mesh.convex_decomposition()`, which calls V-HACD. Nothing sticks out.

    The keywords and their defaults are those of V-HACD. Its others say how it searches, and are not taken here.

    mesh: a mesh of trimesh, or whatever convex_pieces() takes.
    maxConvexHulls: the largest number of pieces, at least 1.
    maxNumVerticesPerCH: the largest number of vertices of a piece, at least 4.
    minimumVolumePercentErrorAllowed: how much more volume than the mesh the pieces may have together, in per cent,
        greater than 0. There are as few pieces as keep it; if maxConvexHulls do not, `within_bounds` is False.
    max_distance: how far the pieces may reach out of the mesh, as of convex_pieces().

    Each piece has in `metadata["prohull"]` what is proven of all of them together: `verdict`, with
    the fields of Verdict as a dictionary, `within_bounds`, `void_ratio` and `notes`, as ConvexCover has them.

    Raises InputError as convex_pieces() does, and ImportError if trimesh is not installed.
    """
    import_module("trimesh")  # before the work
    cover = convex_pieces(mesh, maxConvexHulls, vertices=maxNumVerticesPerCH, max_distance=max_distance,
                          max_void_percent=minimumVolumePercentErrorAllowed)
    names = ("within_bounds", "void_ratio", "notes")
    facts = {"verdict": asdict(cover.verdict), **{name: getattr(cover, name) for name in names}}
    return [_told(piece, facts) for piece in cover.pieces]


def simplify(mesh: MeshLike, percent: Optional[float] = None, face_count: Optional[int] = None,
             **options: Any) -> trimesh.Trimesh:
    """Builds a hull, in place of `mesh.simplify_quadric_decimation()`, whose result crosses the mesh. A hull encloses it.

    mesh: a mesh of trimesh, or whatever build() takes.
    percent: the share of the faces that shall go, in [0, 1), as trimesh has it: 0.9 leaves a tenth.
    face_count: the largest number of faces, at least 4. One of this and `percent` must be given.
    options: of build(), as in side="inner" or max_distance=0.002.

    `metadata["prohull"]` of the result has `certified`, `proof`, `side`, `target_reached`, `within_bounds`,
    `void_ratio`, `distance_bound` and `notes`, as Hull has them.

    Raises InputError as build() does, and ImportError if trimesh is not installed.
    """
    import_module("trimesh")  # before the work
    mesh = mesh_of(mesh, keep_non_finite=True)
    hull = build(mesh, _face_count(mesh, percent, face_count), **options)
    names = ("certified", "proof", "side", "target_reached", "within_bounds", "void_ratio", "distance_bound", "notes")
    return _told(hull, {name: getattr(hull, name) for name in names})


def _face_count(mesh: Mesh, percent: Any, face_count: Any) -> int:
    if (percent is None) == (face_count is None):
        raise InputError(f"percent={percent!r}, face_count={face_count!r}: expected one of them")
    if percent is None:
        count = _arrays.face_counts("face_count", face_count)
        if count.ndim > 0:
            raise InputError(f"face_count={face_count!r}: expected one whole number")
        return int(count)
    share = _arrays.not_negative("percent", percent)
    if share >= 1:
        raise InputError(f"percent={percent!r}: expected a share of the faces, at least 0 and less than 1")
    return max(4, round((1 - share) * len(mesh.faces)))


def _told(mesh: Any, facts: dict[str, Any]) -> trimesh.Trimesh:
    made: trimesh.Trimesh = mesh.to_trimesh()
    made.metadata["prohull"] = facts
    return made
