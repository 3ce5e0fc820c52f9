"""Meshes, hulls, and what rays and segments hit of them."""

import os
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _prohull
from ._prohull import InputError

if TYPE_CHECKING:
    import open3d
    import trimesh

Path = Union[str, "os.PathLike[str]"]


class FirstHits(NamedTuple):
    """The first hit of each of n rays or segments; -1 and nan where there is none."""

    face: NDArray[np.int64]  #: (n,), rows of `faces`
    t: NDArray[np.float64]  #: (n,), of rays in lengths of their directions, of segments the fraction of the way
    position: NDArray[np.float64]  #: (n, 3)
    entering: NDArray[np.bool_]  #: (n,), from the outside of the face to its inside

    @property
    def hit(self) -> NDArray[np.bool_]:
        """(n,), whether there is a hit."""
        return self.face >= 0


class AllHits(NamedTuple):
    """All hits of n rays or segments: those of ray i are rows offsets[i] to offsets[i + 1] - 1, in order along it."""

    offsets: NDArray[np.int64]  #: (n + 1,)
    face: NDArray[np.int64]  #: (hits,), rows of `faces`
    t: NDArray[np.float64]  #: (hits,), as in FirstHits
    position: NDArray[np.float64]  #: (hits, 3)
    entering: NDArray[np.bool_]  #: (hits,)

    @property
    def query(self) -> NDArray[np.int64]:
        """(hits,), the ray or segment of each hit."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))


class FacesMet(NamedTuple):
    """The faces that triangle i meets are face[offsets[i]:offsets[i + 1]], ascending."""

    offsets: NDArray[np.int64]  #: (n + 1,)
    face: NDArray[np.int64]  #: rows of `faces`


class Refinement(NamedTuple):
    """An engine that asks a mesh through the levels of its hull, refined where a query comes near (docs/queries.md)."""

    paper: bool = False  #: as published, which may miss inner hits
    coarsen: bool = False  #: keep the refined hull, and coarsen it where the next query does not touch it
    queries_per_roll_back: int = 1  #: at least 1; without `coarsen`


class Mesh:
    """Vertices and triangles, which do not change; triangles are counter-clockwise seen from outside.

    Queries take arrays and use all cores (`threads` limits them), release the GIL, and can be interrupted by Ctrl-C;
    the index that they need is built by the first of them and kept. Answers are exact and the same for any number of
    threads: nothing leaks between faces, and on closed meshes hits enter and leave in turn. `engine` is a name in
    prohull.ENGINES; all give the same answers, "paper-refinement" may miss some (docs/queries.md). Segments without
    length and rays without direction hit nothing. Errors: InputError, a ValueError, for another shape, which it names,
    for coordinates that are not finite and for engines that are not there.
    """

    def __init__(self, vertices: ArrayLike, faces: ArrayLike) -> None:
        """vertices: (n, 3) of any floating point or integer dtype; faces: (m, 3) indices of vertices. They are copied.

        Raises InputError for another shape, and for faces that name vertices that are not there.
        """
        self._set(_prohull.Mesh(_arrays.rows("vertices", vertices, (3,)), _arrays.indices("faces", faces)))

    def _set(self, core: _prohull.Mesh, levels: Optional[_prohull.Levels] = None) -> None:
        self._core = core
        self._query_levels = levels  # of which this is the original mesh
        self._is_closed: Optional[bool] = None
        self._indices: dict[Any, _prohull.Index] = {}

    @classmethod
    def _of(cls, core: _prohull.Mesh, levels: Optional[_prohull.Levels] = None) -> "Mesh":
        mesh = cls.__new__(cls)
        mesh._set(core, levels)
        return mesh

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_indices": {}}

    def __repr__(self) -> str:
        return f"<prohull.{type(self).__name__}: {len(self.vertices):,} vertices, {len(self.faces):,} faces>"

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(n, 3), read-only, a view of the mesh's own memory."""
        return self._core.vertices

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(m, 3), read-only, a view of the mesh's own memory."""
        return self._core.faces

    @property
    def volume(self) -> float:
        """In cubic units; meaningful for closed meshes, negative if inside out."""
        return self._core.volume

    @property
    def is_closed(self) -> bool:
        """Along every edge, matched by position, faces run as often one way as the other. Raises InputError if empty or
        not finite."""
        if self._is_closed is None:
            self._is_closed = _prohull.is_closed(self._core)
        return self._is_closed

    def report(self) -> dict[str, Any]:
        """What the mesh is and what is wrong with it: counts of components and of each kind of defect."""
        return self._core.report()

    def save(self, path: Path) -> None:
        """Writes .ply, .obj, .off, .stl or .glb, whole or not at all.

        Raises InputError if that is not possible; .stl and .glb keep only float32 (build with `float32=True`).
        """
        self._core.write(path)

    def to_trimesh(self) -> "trimesh.Trimesh":
        """A copy; needs trimesh."""
        import trimesh

        return trimesh.Trimesh(self.vertices.copy(), self.faces.astype(np.int64), process=False)

    def to_open3d(self) -> "open3d.geometry.TriangleMesh":
        """A copy; needs Open3D."""
        import open3d

        return open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(self.vertices),
                                            open3d.utility.Vector3iVector(self.faces.astype(np.int32)))

    def first_hit(self, origins: Optional[ArrayLike] = None, directions: Optional[ArrayLike] = None, *,
                  segments: Optional[ArrayLike] = None, engine: Union[str, Refinement] = "auto",
                  threads: int = 0) -> FirstHits:
        """Of each ray, or segment, the hit nearest to its start.

        origins, directions: (n, 3), one of them may be a single (3,); directions need not be of unit length.
        segments instead: (n, 2, 3) or (n, 6), both ends.
        """
        return FirstHits(*self._index(engine).first_hits(*_lines(origins, directions, segments), threads))

    def any_hit(self, origins: Optional[ArrayLike] = None, directions: Optional[ArrayLike] = None, *,
                segments: Optional[ArrayLike] = None, engine: Union[str, Refinement] = "auto",
                threads: int = 0) -> NDArray[np.bool_]:
        """Whether each ray, or segment, hits the mesh: (n,); arguments as of first_hit. Faster than the first hit."""
        return self._index(engine).any_hits(*_lines(origins, directions, segments), threads)

    def all_hits(self, origins: Optional[ArrayLike] = None, directions: Optional[ArrayLike] = None, *,
                 segments: Optional[ArrayLike] = None, engine: Union[str, Refinement] = "auto",
                 threads: int = 0) -> AllHits:
        """Of each ray, or segment, every hit; arguments as of first_hit."""
        return AllHits(*self._index(engine).all_hits(*_lines(origins, directions, segments), threads))

    def faces_met(self, triangles: ArrayLike, *, engine: Union[str, Refinement] = "auto",
                  threads: int = 0) -> FacesMet:
        """The faces that have a point in common with each of triangles (n, 3, 3) or (n, 9), exactly; touching counts."""
        rows = _arrays.rows("triangles", triangles, (3, 3), (9,)).reshape(-1, 9)
        return FacesMet(*self._index(engine).triangles_met(rows, threads))

    def contains(self, points: ArrayLike, *, engine: Union[str, Refinement] = "auto",
                 threads: int = 0) -> NDArray[np.bool_]:
        """Whether each of points (n, 3) is inside, where the mesh winds around it at least once: (n,), exactly.

        Points on the surface may count as inside or outside. Raises InputError if the mesh is not closed.
        """
        rows = _arrays.rows("points", points, (3,))
        if not self.is_closed:
            raise InputError("the mesh is not closed: it has no inside")
        return self._index(engine).contains(rows, threads)

    def _index(self, engine: Union[str, Refinement]) -> _prohull.Index:
        if engine not in self._indices:
            self._indices[engine] = self._new_index(engine)
        return self._indices[engine]

    def _new_index(self, engine: Union[str, Refinement]) -> _prohull.Index:
        options = engine if isinstance(engine, Refinement) else Refinement()
        name = ("paper-refinement" if options.paper else "refinement") if engine is options else str(engine)
        if "refinement" not in name:
            return _prohull.Index(self._core, name)
        if self._query_levels is None:
            raise InputError(f"engine={engine!r}: of a hull's `original` only, and not where it was wrapped or has no levels")
        return _prohull.Index(self._query_levels, name, options.coarsen, options.queries_per_roll_back)


def _lines(origins, directions, segments):
    """Rows of six numbers, and whether they are rays."""
    if segments is not None and origins is None and directions is None:
        return _arrays.rows("segments", segments, (2, 3), (6,)).reshape(-1, 6), False
    if segments is None and origins is not None and directions is not None:
        return _arrays.rays(origins, directions), True
    raise InputError("expected either origins and directions, or segments")


class Hull(Mesh):
    """A mesh that encloses another one, or is enclosed by it; from build() or load(). May be pickled."""

    certified: bool  #: proven exactly, by code that shares nothing with the construction
    proof: str  #: how: "replay", "enclosure" or "coverage" (docs/repair.md); empty if not certified
    side: str  #: "outer" or "inner"
    faces_target: int  #: that were asked for; of a loaded hull what it has
    reached: bool  #: has at most so many faces, or the bounds allow no fewer
    bounded: bool  #: max_distance, max_void and max_added_volume hold
    refused: dict[str, int]  #: how often collapses were refused, by reason
    blocked: dict[str, int]  #: of the edges that are left, why
    relaxed_guards: int  #: steps by which the guards of the shape were relaxed in the end
    wrap_alpha: float  #: of the wrap that it was built from, in the mesh's unit; 0 if from the mesh itself
    repairs: list[str]  #: what was done to the mesh before
    notes: list[str]  #: why something is not as it was asked for
    build_seconds: float
    verify_seconds: float

    @classmethod
    def _made(cls, facts: dict[str, Any], side: str) -> "Hull":
        hull = cls.__new__(cls)
        hull._set(facts.pop("mesh"))
        hull._levels: Optional[_prohull.Levels] = facts.pop("levels")
        hull._original = Mesh._of(facts.pop("original"), None if facts["wrap_alpha"] > 0 else hull._levels)
        hull._self_intersections = facts.pop("self_intersections")
        hull._distance: Optional[float] = None
        hull.side = side
        hull.__dict__.update(facts)
        return hull

    @property
    def original(self) -> Mesh:
        """What the hull encloses: the mesh after repairs, or all its finite triangles where they were wrapped.

        Its queries also take the engines that go through the hull, "refinement" and "paper-refinement".
        """
        return self._original

    @property
    def levels(self) -> range:
        """The numbers of faces that level() has, from the hull to the original; empty without levels.

        A tight hull has none, and neither has one whose vertices moved after a wrap (see `levels` of build()).
        """
        if self._levels is None:
            return range(0)
        return range(self._levels.base_face_count, self._levels.original_face_count + 1, 2)

    def level(self, faces: int) -> Mesh:
        """The finest level of at most so many faces; the coarsest if that has more. Each encloses the next finer one.

        Raises InputError without levels.
        """
        return Mesh._of(self._with_levels().level(faces))

    def save(self, path: Path) -> None:
        """Writes all levels to .phull (docs/phull.md), or the hull alone to .ply, .obj, .off, .stl or .glb.

        Raises InputError if that is not possible; .stl and .glb keep only float32 (build with `float32=True`).
        """
        if os.fspath(path).lower().endswith(".phull"):
            self._with_levels().save(path)
        else:
            super().save(path)

    def _with_levels(self) -> _prohull.Levels:
        if self._levels is None:
            raise InputError("the hull has no levels; build with levels=True and tight=False")
        return self._levels

    @property
    def void_ratio(self) -> float:
        """Volume / volume of the original - 1; negative of inner hulls, nan if the original is not closed."""
        return self.volume / self._original.volume - 1 if self._original.is_closed else float("nan")

    @property
    def distance_bound(self) -> float:
        """No point of the hull is farther from the original, in its unit: proven, at most 1 % too great where that is
        found in time. Computed when first asked for."""
        if self._distance is None:
            self._distance = _prohull.distance(self._core, self._original._core, 0.01, None)[1]
        return self._distance

    @property
    def self_intersections(self) -> int:
        """Pairs of faces that meet beyond what they share; exact."""
        if self._self_intersections is None:
            self._self_intersections = _prohull.count_self_intersections(self._core)
        return self._self_intersections

    def __repr__(self) -> str:
        return (f"<prohull.Hull: {self.side}, {len(self.faces):,} faces, "
                f"{'certified' if self.certified else 'NOT CERTIFIED'}>")
