"""Proofs and distances between two meshes."""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _prohull
from ._files import distance_of, levels_of, mesh_of
from ._hull import Hull
from ._types import Gap, MeshLike, OpenShells, Progress, Side


class Offender(NamedTuple):
    """A triangle of the inner mesh of which a part lies outside of the outer one."""

    face: int  #: its row in the `faces` of the inner mesh
    point: NDArray[np.float64]  #: (3,), a point of it that lies outside
    distance: float  #: from that point to the outer mesh, in the meshes' unit


class NearFace(NamedTuple):
    """A face of a hull that is nearer to the original than the gap asked for."""

    face: int  #: its row in the `faces` of the hull
    original_face: int  #: the row of the nearest face in the `faces` of the original
    point: NDArray[np.float64]  #: (3,), a point of the hull's face that is so near
    distance: float  #: between the two faces, in the meshes' unit; 0 only if they meet


@dataclass(frozen=True)
class Verdict:
    """What is proven of a hull, or of pieces or spheres together, and against what; as reports of the command line have it.

    What was not asked, not decided or not measured is None. It counts as true if it is `certified`.
    """

    certified: bool  #: the answer: whether what this says is proven; of verify(), whether the gap asked for is kept, too
    why_not: str  #: why the answer is no; empty if it is yes
    proof: str  #: how it was decided: "replay", "enclosure", "coverage", "union", "padding" or "sweep"
    side: Side  #: "outer" or "inner"
    covers_triangles: Optional[bool]  #: whether every finite triangle of the original is covered; of an inner hull: of the hull
    encloses_solid: Optional[bool]  #: whether the solid of the original is enclosed; of an inner hull: whether it encloses
    gap: Optional[float]  #: no point is nearer than this to a triangle of the original: proven
    distance_to_triangles: Optional[tuple[float, float]]  #: bounds of how far the triangles are at most; the second is proven
    distance_to_solid: Optional[tuple[float, float]]  #: the same of the solid, to which what closes its openings belongs
    original_closed: bool  #: whether the original bounds a solid as it was given
    cap_faces: int  #: number of faces that are none of the original, and count as if they closed its openings
    non_finite_faces: int  #: number of faces of the original that were left out: a corner is not finite

    @property
    def distance_bound(self) -> float:
        """No point of the surface is farther than this from the solid, or from the triangles if there is none: proven.

        nan if it was not measured.
        """
        known = self.distance_to_solid or self.distance_to_triangles
        return known[1] if known else math.nan

    def __bool__(self) -> bool:
        return self.certified


class Proven:
    """What has a verdict."""

    verdict: Verdict

    @property
    def certified(self) -> bool:
        """Whether what `verdict` tells is proven, exactly."""
        return self.verdict.certified


def verdict_of(facts: dict[str, Any]) -> dict[str, Verdict]:
    """The verdict among the facts, if there is one."""
    return {"verdict": Verdict(**facts["verdict"])} if "verdict" in facts else {}


@dataclass(frozen=True)
class Verification(Verdict):
    """What verify() found. It counts as true if the hull encloses the original, and keeps the gap if one was asked for."""

    encloses: bool  #: `certified` but for the gap; of an inner hull, whether the original encloses it
    faces_outside: int  #: number of triangles of the inner mesh of which a part lies outside of the outer one, and not on it; exact
    worst: list[Offender]  #: the farthest of these, farthest first
    cavities: int  #: number of hollows of the outer mesh that leave a part of the inner one uncovered; they are looked for only if faces_outside is 0
    faces_undecided: int  #: number of faces whose decision would take more steps; if there are any, `certified` is false
    faces_beside_solid: int  #: number of faces of the inner mesh that bound no part of its solid, as in folds
    self_intersections: Optional[int]  #: number of pairs of faces of the hull that meet beyond what they share; exact; None if a replay failed
    original_volume: float  #: of the solid, in cubic units; overlaps count once; nan if it is not known
    void_ratio: float  #: volume of the hull / volume of the original - 1; nan if one of the two is not known
    notes: list[str]  #: what was left out of the original or turned, and units that seem to differ
    keeps_gap: Optional[bool]  #: whether the hull keeps the gap; exact; None if none was asked for, or it was not decided
    faces_too_near: int  #: number of faces of the hull that do not; exact
    nearest: list[NearFace]  #: the nearest of these, nearest first
    least_distance: float  #: no more lies between hull and original; rounded up; nan without a gap, or if the search ended


def verify(hull: MeshLike, original: MeshLike, *, side: Optional[Side] = None, solid_only: bool = False,
           gap: Gap = 0.0, finite_only: bool = False, open_shells: OpenShells = "keep",
           steps: Optional[int] = None, progress: Optional[Progress] = None) -> Verification:
    """Decides exactly whether `hull` encloses `original`, as `prohull verify` does.

    A .phull file is a proof, and is replayed. Any other hull must be closed, and is compared with the original. The
    solid of the original must be enclosed, and every triangle covered; of an original that is not closed, only the
    latter, unless open_shells closes it. Components of the original that are inside out count as turned; `notes` tell of it. A hull that is inside out is refused: the answer is no, and `why_not` says so.

    hull, original: the path of a file, or a mesh of prohull, trimesh or Open3D, or a tuple of vertices and faces.
    side: "outer"; or "inner" to decide whether `original` encloses `hull`. Unless given, it is the side of the Hull or
        of the .phull file, and "outer" for any other mesh.
    solid_only: whether only the solid must be enclosed that a closed original bounds (of an inner hull: that the hull
        bounds). Triangles of folds and of parts that are inside out bound no part of it, and may then stick out.
    gap: distance that the hull must keep from every triangle of the original, at least 0, in the meshes' unit; or as in
        "0.5%" of the diagonal of the original's bounding box. Not for .phull files, whose levels touch.
    finite_only: whether triangles of the original that are not finite are left out. Otherwise the answer is no if there
        are any.
    open_shells: what is done with openings of the original. "close" gives them caps, as build() does, so that what they
        lead into must be enclosed too, and so that an inner hull has an inside to lie in; "keep" asks for the triangles
        only.
    steps: the largest number of steps of each search for parts that lie outside, for holes, and for faces nearer than
        the gap, at least 1. What is left then is undecided, the same on every machine. Unless given, it is two billion
        and 2,000 for each face of the original, which take some minutes.
    progress: called as build() calls it, with the stage "verify".

    Raises InputError if a mesh is empty, if it is not finite or not closed where it has to be, or if a coordinate is
    larger than 1e100.

        assert prohull.verify("hull.stl", "part.stl", gap="0.5%")
    """
    mesh = mesh_of(original, keep_non_finite=True)
    first: Any = levels_of(hull)
    if first:
        side = "inner" if first.is_inner else "outer"
    else:
        given = mesh_of(hull)
        first, side = given._core, side or (given.side if isinstance(given, Hull) else "outer")
    facts = _prohull.verify(first, mesh._core, progress, dict(
        side=side, open_shells=open_shells, solid_only=solid_only, finite_only=finite_only,
        gap=distance_of("gap", gap, mesh), steps=most_steps(steps)))
    facts["nearest"] = [NearFace(*near) for near in facts["nearest"]]
    facts["worst"] = [Offender(*offender) for offender in facts["worst"]]
    return Verification(**facts)


def most_steps(steps: Optional[int]) -> int:
    """0 for as many as usual."""
    return 0 if steps is None else _arrays.count("steps", steps, bits=64, least=1)


def distance_bounds(from_: MeshLike, to: MeshLike, *, relative_gap: float = 0.01,
                    progress: Optional[Progress] = None) -> tuple[float, float]:
    """Returns two bounds of the largest distance of a point of one mesh from the other. Both are proven.

    from_, to: meshes, as verify() takes them. The result is in their unit.
    relative_gap: stops when upper <= (1 + relative_gap) lower but for rounding, at least 0; or after a million steps, when the bounds
        are farther apart.
    progress: called as build() calls it, with the stage "measure".

    Raises InputError if a mesh is empty or not finite, and for another relative_gap.
    """
    gap = _arrays.not_negative("relative_gap", relative_gap)
    lower, upper, _ = _prohull.distance(mesh_of(from_)._core, mesh_of(to)._core, gap, 0, progress)
    return lower, upper
