"""Coarse meshes that provably enclose a mesh, or are enclosed by it.

    >>> import prohull
    >>> hull = prohull.build(prohull.sample("pony", 5000), faces_target=500)
    >>> hull.certified, len(hull.faces)
    (True, 500)

Meshes are given as vertices and faces, as the path of a file, or as a mesh of prohull, trimesh or Open3D. Lengths are in
the unit of the mesh, angles in radians. Errors in what is handed over are InputError, a ValueError; Ctrl-C stops whatever
runs with KeyboardInterrupt, and nothing half-written is left.
"""

import math
import os
from dataclasses import dataclass
from pathlib import Path as _PurePath
from typing import Any, Callable, NamedTuple, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _prohull
from ._meshes import AllHits, FacesMet, FirstHits, Hull, Mesh, Path, Refinement
from ._prohull import InputError

__all__ = ["AllHits", "ENGINES", "FacesMet", "FirstHits", "Hull", "InputError", "Mesh", "Offender", "Refinement",
           "Verification", "build", "distance_bounds", "load", "read", "sample", "verify"]

#: Names of the engines of queries.
ENGINES: tuple[str, ...] = _prohull.engines

InputError.__module__ = __name__

# The program that reads COLLADA, 3MF and FBX, if this package was installed with it.
_importer = _PurePath(__file__).with_name("prohull-import")
if _importer.exists():
    os.environ.setdefault("PROHULL_IMPORTER", str(_importer))

MeshLike = Union[Path, Mesh, tuple[ArrayLike, ArrayLike], Any]
Progress = Callable[[str, float], Optional[bool]]


def _mesh(mesh: MeshLike, keep_non_finite: bool = False) -> Mesh:
    if isinstance(mesh, Mesh):
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        return load(mesh) if _prohull.is_hull_file(mesh) else Mesh._of(_prohull.read(mesh, keep_non_finite))
    arrays = _arrays.arrays_of_mesh(mesh)
    if arrays is None:
        raise InputError(f"a {type(mesh).__module__}.{type(mesh).__qualname__} is no mesh; expected the path of a file, "
                         "vertices and faces, or an object that has both")
    return Mesh(*arrays)


@overload
def build(mesh: MeshLike, faces: Optional[ArrayLike] = None, *, faces_target: int = 2000, **options: Any) -> Hull: ...
@overload
def build(mesh: MeshLike, faces: Optional[ArrayLike] = None, *, faces_target: Sequence[int],
          **options: Any) -> list[Hull]: ...
def build(mesh: MeshLike, faces: Optional[ArrayLike] = None, *,
          faces_target: Union[int, Sequence[int]] = 2000, side: str = "outer", tight: bool = False,
          levels: bool = False, max_distance: float = math.inf, max_void: float = math.inf,
          max_added_volume: float = math.inf, repair: str = "auto", keep_cavities: bool = False,
          seal_holes: float = 0.0, float32: bool = False, strategy: str = "lazy", best_of: int = 1, seed: int = 0,
          threads: int = 0, self_intersections: str = "by-strategy", relax_guards: bool = True,
          max_valence: int = 12, min_compactness_ratio: float = 0.8, sufficient_compactness: float = 0.15,
          max_normal_deviation: float = math.pi / 4,
          progress: Optional[Progress] = None) -> Union[Hull, list[Hull]]:
    """A hull of any triangles: repaired, or wrapped where that is not enough, and certified (docs/repair.md).

    Guaranteed: a hull with `certified` encloses every finite triangle (side="inner": is enclosed by the mesh), decided
    exactly on the very numbers of `vertices`. The same input gives the same bits, whatever `threads`.

    mesh: vertices, (n, 3) of any floating point or integer dtype, with `faces`, (m, 3) indices of them; or the path of
        a file (docs/formats.md); or a mesh of prohull, trimesh or Open3D.
    faces_target: at most so many faces, at least 4; several give a list of hulls in this order. A hull may keep more,
        see `reached`, `notes` and `blocked`.
    side: "outer" or "inner", which needs a closed mesh.
    tight: far less void, some twenty to seventy times slower, and no levels.
    levels: keep levels also where the mesh has to be wrapped; its vertices then do not move back towards the triangles.
    max_distance, max_void, max_added_volume: stop at the coarsest hull, of at least faces_target, with no point farther
        from the mesh, in its unit, proven; with at most so much more volume, as a ratio, or in cubic units.
    repair: "auto"; "none" refuses what is not closed; "wrap" wraps at once.
    keep_cavities: keep components inside of others; inner hulls always do.
    seal_holes: where it wraps, close openings up to this diameter, in the mesh's unit.
    float32: coordinates that float32 keeps, as .stl and .glb do; certified with them.
    strategy: "lazy", or "paper1" and "paper2" of Platis and Theoharis (2003).
    best_of, seed: build with so many seeds, from `seed` on, and keep the best.
    threads: at most so many; 0: one for each core.
    self_intersections: "refused", "allowed", which is faster, or "by-strategy": refused by "lazy" only.
    relax_guards, max_valence, min_compactness_ratio, sufficient_compactness, max_normal_deviation (radians): guards of
        the shape of triangles, and whether they give way where faces_target is not reached otherwise.
    progress: called with the stage and a fraction in [0, 1] some 20 times a second, by the calling thread; last with
        ("done", 1.0). What it raises stops the build and goes on to the caller; if it returns False,
        KeyboardInterrupt does.

    Raises InputError, a ValueError, for shapes and values that are not as above, files that cannot be read, meshes
    without a finite triangle, and what is not closed where it has to be.

        hull = prohull.build("part.stl", faces_target=500, tight=True, float32=True)
        hull.save("part_collision.stl")
    """
    keywords = dict(
        side=side, tight=tight, levels=levels, max_distance=max_distance, max_void=max_void,
        max_added_volume=max_added_volume, repair=repair, keep_cavities=keep_cavities, seal_holes=seal_holes,
        float32=float32, strategy=strategy, best_of=best_of, seed=seed, threads=threads,
        self_intersections=self_intersections, relax_guards=relax_guards, max_valence=max_valence,
        min_compactness_ratio=min_compactness_ratio, sufficient_compactness=sufficient_compactness,
        max_normal_deviation=max_normal_deviation)
    original = _mesh(mesh, keep_non_finite=True) if faces is None else Mesh(mesh, faces)
    several = np.ndim(faces_target) > 0
    targets = _targets(faces_target)
    try:
        made = _prohull.build(original._core, targets, progress, keywords)
    except InputError as error:
        if isinstance(mesh, (str, os.PathLike)):
            raise InputError(f"{os.fspath(mesh)}: {error}") from None
        raise
    hulls = [Hull._made(facts, side) for facts in made]
    return hulls if several else hulls[0]


def _targets(faces_target: Any) -> list[int]:
    targets = np.atleast_1d(np.asarray(faces_target))
    if targets.dtype.kind not in "iu" or targets.ndim != 1 or targets.size == 0 or targets.min() < 4:
        raise InputError(f"faces_target={faces_target!r}: expected a whole number of at least 4, or several")
    return targets.tolist()


def read(path: Path) -> Mesh:
    """The mesh in a file: PLY, OBJ, OFF, STL, glTF, also gzipped, and others (docs/formats.md).

    Raises InputError with what is wrong with the file, and where.
    """
    return Mesh._of(_prohull.read(path, False))


def load(path: Path) -> Hull:
    """The hull that Hull.save wrote to a .phull file, with all levels.

    `certified` tells that each encloses all finer ones up to the original, which is in the file too: the proof is
    replayed. Raises InputError if the file is no sound .phull.
    """
    levels = _prohull.load(path)
    why_not = _prohull.replayed(levels, None)
    faces = levels.base_face_count
    facts = dict(mesh=levels.level(0), original=levels.level(levels.original_face_count), levels=levels, wrap_alpha=0.0,
                 certified=not why_not, proof="" if why_not else "replay", faces_target=faces, reached=True,
                 bounded=True, refused={}, blocked={}, relaxed_guards=0, self_intersections=None, build_seconds=0.0,
                 verify_seconds=0.0, repairs=[], notes=[why_not] if why_not else [])
    return Hull._made(facts, "inner" if levels.is_inner else "outer")


def sample(name: str, faces: int) -> Mesh:
    """A closed mesh of about so many faces: asteroid, bracket, box, gyroid, knot, pony, sphere or torus.

    Raises InputError for another name, or faces outside of [4, 2^30].
    """
    return Mesh._of(_prohull.sample(name, faces))


class Offender(NamedTuple):
    """A triangle of the inner mesh of which a part lies outside of the outer one."""

    face: int  #: of the inner mesh
    point: NDArray[np.float64]  #: (3,), a point of it that does
    distance: float  #: from there to the outer mesh, in its unit


@dataclass(frozen=True)
class Verification:
    """What verify() found; true if it encloses."""

    encloses: bool  #: the verdict, exact
    proof: str  #: "replay" of the levels in a .phull file, "enclosure" of closed meshes, or "coverage" of every triangle
    side: str  #: "outer" or "inner"
    original_closed: bool  #: the original bounds a solid; else every triangle must be covered
    every_triangle: bool  #: every triangle had to be covered
    why_not: str  #: the first step of a replay that fails; empty if it holds
    faces_outside: int  #: triangles of the inner mesh of which a part lies outside of the outer one; exact
    worst: list[Offender]  #: the farthest of them
    cavities: int  #: hollows of the outer mesh that leave a part of the inner one uncovered
    self_intersections: int  #: pairs of faces of the hull that meet beyond what they share; exact
    void_ratio: float  #: volume of the hull / volume of the original - 1; nan if the original is not closed
    notes: list[str]  #: what was left out of the original or turned, and units that seem to differ

    def __bool__(self) -> bool:
        return self.encloses


def verify(hull: MeshLike, original: MeshLike, *, side: Optional[str] = None, every_triangle: bool = False,
           progress: Optional[Progress] = None) -> Verification:
    """Decides exactly whether `hull` encloses `original` (side="inner": whether `original` encloses it).

    hull, original: as of build(). A .phull file is a proof, and is replayed; any other hull must be closed, and is
        compared with the original. Of an original that is not closed every triangle must be covered; with
        `every_triangle` also of one that is, which matters where it intersects itself. Components that are inside out
        count as turned, and triangles of the original that are not finite are left out; `notes` tell of both.
    side: of a Hull or a .phull file its own; of other meshes "outer" unless given.

    Raises InputError if a mesh is empty, or not finite or not closed where it has to be.

        assert prohull.verify("hull.stl", "part.stl")
    """
    second = _mesh(original, keep_non_finite=True)._core
    if isinstance(hull, (str, os.PathLike)) and _prohull.is_hull_file(hull):
        facts = _prohull.verify_levels(_prohull.load(hull), second, every_triangle, progress)
    else:
        first = _mesh(hull)
        facts = _prohull.verify_mesh(first._core, second, side or getattr(first, "side", "outer"), every_triangle,
                                     progress)
    facts["worst"] = [Offender(*offender) for offender in facts["worst"]]
    return Verification(**facts)


def distance_bounds(from_: MeshLike, to: MeshLike, *, relative_gap: float = 0.01,
                    progress: Optional[Progress] = None) -> tuple[float, float]:
    """Two bounds of the farthest that a point of one mesh is from the other, in their unit; the upper one is proven.

    Stops when upper <= (1 + relative_gap) lower, or after a million steps, when they are farther apart. Raises InputError
    if a mesh is empty or not finite.
    """
    lower, upper, _ = _prohull.distance(_mesh(from_)._core, _mesh(to)._core, relative_gap, progress)
    return lower, upper
