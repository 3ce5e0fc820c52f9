"""Meshes, and what rays and segments hit of them."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, TypeVar, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _prohull
from ._prohull import InputError
from ._shown import Shown
from ._types import EngineName, Path, Progress, Rows

if TYPE_CHECKING:
    import open3d
    import trimesh

    from ._hull import Hull
    from ._view import Part


class FirstHits(NamedTuple):
    """The first hit of each of n rays or segments. Where there is none, face is -1 and t and position are nan."""

    face: NDArray[np.int64]  #: (n,), rows of `faces`
    t: NDArray[np.float64]  #: (n,); of a ray in lengths of its direction, of a segment the fraction of its way
    position: NDArray[np.float64]  #: (n, 3)
    entering: NDArray[np.bool_]  #: (n,), whether it goes from the outside of the face to its inside

    @property
    def hit(self) -> NDArray[np.bool_]:
        """(n,), whether there is a hit."""
        return self.face >= 0


class AllHits(NamedTuple):
    """All hits of n rays or segments. Those of ray i are rows offsets[i] to offsets[i + 1] - 1, in order along it."""

    offsets: NDArray[np.int64]  #: (n + 1,)
    face: NDArray[np.int64]  #: (hits,), rows of `faces`
    t: NDArray[np.float64]  #: (hits,), as in FirstHits
    position: NDArray[np.float64]  #: (hits, 3)
    entering: NDArray[np.bool_]  #: (hits,), as in FirstHits

    @property
    def query(self) -> NDArray[np.intp]:
        """(hits,), the number of the ray or segment of each hit."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))


class FacesMet(NamedTuple):
    """The faces that n triangles meet. Those of triangle i are face[offsets[i]:offsets[i + 1]], in ascending order."""

    offsets: NDArray[np.int64]  #: (n + 1,)
    face: NDArray[np.int64]  #: (meetings,), rows of `faces`


class ClosestPoints(NamedTuple):
    """The points of a mesh that are closest to n points. The true distances are from `lower` to `upper`: proven.

    Where the mesh is not within max_distance, face is -1 and all else is nan.
    """

    face: NDArray[np.int64]  #: (n,), rows of `faces`; of several closest faces the first
    position: NDArray[np.float64]  #: (n, 3), on the face, rounded
    distance: NDArray[np.float64]  #: (n,), in the mesh's unit, rounded; of signed_distance() negative inside
    lower: NDArray[np.float64]  #: (n,)
    upper: NDArray[np.float64]  #: (n,)


class Refinement(NamedTuple):
    """An engine that asks a mesh through the levels of its hull, refined where a query comes near (docs/queries.md).

    It belongs to the `original` of a hull with levels: hull.original.first_hit(..., engine=prohull.Refinement()).
    """

    paper: bool = False  #: refine as the paper does, which may miss hits inside
    coarsen: bool = False  #: keep the refined hull, and coarsen it where the next query does not touch it
    queries_per_roll_back: int = 1  #: at least 1: after so many the hull is coarse again; without `coarsen`


class TwoHulls(NamedTuple):
    """An engine that asks a mesh through an outer and an inner hull of it (docs/queries.md).

    It belongs to the `original` of an outer hull with levels: outer.original.any_hit(..., engine=prohull.TwoHulls(inner)).
    Raises InputError if the two are not hulls, with levels, of the same mesh.
    """

    inner: "Hull"
    engine: EngineName = "auto"  #: "walk" follows lines through the void, "filter" speeds up any_hit()


Engine = Union[EngineName, Refinement, TwoHulls]

_AnyMesh = TypeVar("_AnyMesh", bound="Mesh")


class Mesh(Shown):
    """Vertices and triangles, which do not change. Triangles are counter-clockwise when seen from outside.

    Queries (first_hit, any_hit, all_hits, faces_met, contains) take arrays and answer exactly: nothing leaks between
    faces, and the hits on a closed mesh enter and leave in turn. Distances (closest, signed_distance) have proven
    bounds. The first query builds an index, which is kept. All of
    them take these arguments too:

    engine: a name in prohull.ENGINES, a Refinement or TwoHulls. All give the same answers, except that
        "paper-refinement", and "walk" without an inner hull, may miss some (docs/queries.md).
    threads: the largest number of threads; 0 means one for each core. The answers do not depend on it.
    progress: called as build() calls it, with the stage "query".

    Queries release the GIL, and Ctrl-C stops them. Queries raise InputError, a ValueError, for an array of
    another shape, for coordinates that are not finite, for segments without length and rays without direction, and for
    an unknown engine.
    """

    def __init__(self, vertices: Rows, faces: Rows) -> None:
        """Copies the arrays.

        vertices: (n, 3), of any floating point or integer dtype.
        faces: (m, 3), of any integer dtype: for each corner of a face the row of its vertex.

        Raises InputError for another shape, and for a face that names a vertex that does not exist.
        """
        self._set(_prohull.Mesh(_arrays.rows("vertices", vertices, (3,)), _arrays.indices("faces", faces)))

    def _set(self, core: _prohull.Mesh, levels: Optional[_prohull.Levels] = None) -> None:
        self._core = core
        self._query_levels = levels  # of which this is the original mesh
        self._is_closed: Optional[bool] = None  # computed when it is asked for, and so is the next
        self._solid_volume: Optional[float] = None
        self._indices: dict[Any, _prohull.Index] = {}

    @classmethod
    def _of(cls, core: _prohull.Mesh, levels: Optional[_prohull.Levels] = None) -> "Mesh":
        mesh = cls.__new__(cls)
        mesh._set(core, levels)
        return mesh

    @classmethod
    def _with(cls: type[_AnyMesh], core: _prohull.Mesh, **facts: Any) -> _AnyMesh:
        mesh = cls.__new__(cls)
        mesh._set(core)
        mesh.__dict__.update(facts)
        return mesh

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_indices": {}}

    def __repr__(self) -> str:
        size = " x ".join(f"{side:.4g}" for side in np.ptp(self.vertices, axis=0)) if len(self.vertices) else "0"
        return (f"<prohull.Mesh: {_arrays.counted(len(self.vertices), 'vertex', 'vertices')}, "
                f"{_arrays.counted(len(self.faces), 'face')}, size {size}>")

    def picture(self, width: int = 400, height: int = 300) -> bytes:
        """Draws the mesh; of a hull, draws it around its original. Returns the content of a .png file.

        width, height: in pixels, each in [1, 16384].

        Notebooks show this picture for a mesh. Raises InputError if there is nothing to be drawn.

            pathlib.Path("hull.png").write_bytes(hull.picture())
        """
        return self._picture(*_arrays.picture_size(width, height))

    def _view_parts(self) -> "list[Part]":
        from . import _view

        return _view.mesh_parts(self)

    def _picture(self, width: int, height: int) -> bytes:
        return _prohull.picture(self._core, None, width, height)

    def _repr_png_(self) -> Optional[bytes]:
        try:
            return self.picture()
        except InputError:
            return None

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(n, 3), float64: the coordinates of each vertex. A read-only view of the mesh's own memory."""
        return self._core.vertices

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(m, 3), uint32: the rows in `vertices` of each face's corners. A read-only view of the mesh's own memory."""
        return self._core.faces

    @property
    def volume(self) -> float:
        """The signed volume, in cubic units. Of a closed mesh that does not overlap itself it is the volume inside; overlaps
        count several times. Negative if the mesh is inside out."""
        return self._core.volume

    def _volume_of_solid(self) -> float:
        """Overlaps count once."""
        if self._solid_volume is None:
            self._solid_volume = _prohull.solid_volume(self._core)
        return self._solid_volume

    @property
    def is_closed(self) -> bool:
        """Whether faces run along every edge, matched by position, as often one way as the other.

        Raises InputError if the mesh is empty or not finite.
        """
        if self._is_closed is None:
            self._is_closed = _prohull.is_closed(self._core)
        return self._is_closed

    def report(self) -> dict[str, Any]:
        """Says what the mesh is and what is wrong with it, as `prohull info` does: counts by name.

        `openings` lists the diameters of all holes and rims, in the mesh's unit, the largest first.
        """
        return self._core.report()

    def save(self, path: Path) -> None:
        """Writes the mesh to a .ply, .obj, .off, .stl or .glb file, whole or not at all.

        Raises InputError for another suffix, if the file cannot be written, and if coordinates are not float32 numbers,
        which is all that .stl and .glb files keep. A Hull is rounded where that is needed.
        """
        self._core.write(_arrays.path(path))

    def to_trimesh(self) -> "trimesh.Trimesh":
        """Makes a copy as a mesh of trimesh, which must be installed."""
        import trimesh

        return trimesh.Trimesh(self.vertices.copy(), self.faces.astype(np.int64), process=False)

    def to_open3d(self) -> "open3d.geometry.TriangleMesh":
        """Makes a copy as a mesh of Open3D, which must be installed."""
        import open3d

        return open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(self.vertices),
                                            open3d.utility.Vector3iVector(self.faces.astype(np.int32)))

    def first_hit(self, origins: Optional[ArrayLike] = None, directions: Optional[ArrayLike] = None, *,
                  segments: Optional[ArrayLike] = None, engine: Engine = "auto", threads: int = 0,
                  progress: Optional[Progress] = None) -> FirstHits:
        """Finds for each ray, or for each segment, the hit that is nearest to its start.

        origins, directions: (n, 3) each; one of them may be a single (3,), for all rays. Directions may have any
            length.
        segments instead: (n, 2, 3) or (n, 6), both ends of each.
        """
        threads = _arrays.count("threads", threads)
        return FirstHits(*self._index(engine).first_hits(*_lines(origins, directions, segments), threads, progress))

    def any_hit(self, origins: Optional[ArrayLike] = None, directions: Optional[ArrayLike] = None, *,
                segments: Optional[ArrayLike] = None, engine: Engine = "auto", threads: int = 0,
                progress: Optional[Progress] = None) -> NDArray[np.bool_]:
        """Decides for each ray, or for each segment, whether it hits the mesh: (n,). Faster than first_hit().

        The arguments are those of first_hit().
        """
        threads = _arrays.count("threads", threads)
        return self._index(engine).any_hits(*_lines(origins, directions, segments), threads, progress)

    def all_hits(self, origins: Optional[ArrayLike] = None, directions: Optional[ArrayLike] = None, *,
                 segments: Optional[ArrayLike] = None, engine: Engine = "auto", threads: int = 0,
                 progress: Optional[Progress] = None) -> AllHits:
        """Finds for each ray, or for each segment, all of its hits. The arguments are those of first_hit()."""
        threads = _arrays.count("threads", threads)
        return AllHits(*self._index(engine).all_hits(*_lines(origins, directions, segments), threads, progress))

    def faces_met(self, triangles: ArrayLike, *, engine: Engine = "auto", threads: int = 0,
                  progress: Optional[Progress] = None) -> FacesMet:
        """Finds for each triangle the faces that have a point in common with it, exactly; touching counts.

        triangles: (n, 3, 3) or (n, 9), the corners of each.
        """
        rows = _arrays.rows("triangles", triangles, (3, 3), (9,)).reshape(-1, 9)
        threads = _arrays.count("threads", threads)
        return FacesMet(*self._index(engine).triangles_met(rows, threads, progress))

    @overload
    def contains(self, points: Sequence[float], *, engine: Engine = ..., threads: int = ...,
                 progress: Optional[Progress] = ...) -> bool: ...
    @overload
    def contains(self, points: Rows, *, engine: Engine = ..., threads: int = ...,
                 progress: Optional[Progress] = ...) -> NDArray[np.bool_]: ...
    def contains(self, points: Any, *, engine: Engine = "auto", threads: int = 0,
                 progress: Optional[Progress] = None) -> Union[bool, NDArray[np.bool_]]:
        """Decides for each point, exactly, whether it is inside: where the mesh winds around it at least once.

        points: (n, 3), which gives (n,); or a single point, (3,), which gives True or False.

        A point on the surface may count as inside or as outside. Raises InputError if the mesh is not closed, and for
        the engine "paper-refinement", which may miss crossings.
        """
        is_one = np.shape(points) == (3,)
        threads = _arrays.count("threads", threads)
        inside = self._index(engine).contains(_arrays.points(points), threads, progress)
        return bool(inside[0]) if is_one else inside

    def closest(self, points: ArrayLike, *, max_distance: float = math.inf, engine: Engine = "auto", threads: int = 0,
                progress: Optional[Progress] = None) -> ClosestPoints:
        """Finds for each point the closest point of the mesh, and how far it is.

        points: (n, 3), or a single point, (3,), which is row 0 of the answer.
        max_distance: points of which the mesh is not certainly within this distance, at least 0, get no answer; saves
            time.
        """
        threads = _arrays.count("threads", threads)
        most = _arrays.not_negative("max_distance", max_distance, math.inf)
        return ClosestPoints(*self._index(engine).closest(_arrays.points(points), most, threads, progress))

    def signed_distance(self, points: ArrayLike, *, engine: Engine = "auto", threads: int = 0,
                        progress: Optional[Progress] = None) -> ClosestPoints:
        """closest(), with distances and bounds that are negative where contains() has the point inside.

        points: as of closest(). Raises InputError as contains() does.
        """
        threads = _arrays.count("threads", threads)
        return ClosestPoints(*self._index(engine).signed_distances(_arrays.points(points), threads, progress))

    def _index(self, engine: Engine) -> _prohull.Index:
        if not isinstance(engine, (str, Refinement, TwoHulls)):
            raise InputError(f"engine={engine!r}: expected the name of an engine, a Refinement or TwoHulls")
        if engine not in self._indices:
            self._indices[engine] = self._new_index(engine)
        return self._indices[engine]

    def _new_index(self, engine: Engine) -> _prohull.Index:
        if isinstance(engine, TwoHulls):
            return _prohull.Index(self._asked_levels(engine), engine.inner._with_levels(), engine.engine)
        options = engine if isinstance(engine, Refinement) else Refinement()
        name = ("paper-refinement" if options.paper else "refinement") if engine is options else str(engine)
        if "refinement" not in name and name not in ("walk", "filter"):
            return _prohull.Index(self._core, name)
        return _prohull.Index(self._asked_levels(engine), name, options.coarsen, options.queries_per_roll_back)

    def _asked_levels(self, engine: Engine) -> _prohull.Levels:
        if self._query_levels is None:
            raise InputError(f"engine={engine!r}: this engine goes through the levels of a hull; ask the `original` of a hull "
                             "that was built from it and has levels")
        return self._query_levels


def _lines(origins: Optional[ArrayLike], directions: Optional[ArrayLike],
           segments: Optional[ArrayLike]) -> tuple[NDArray[np.float64], bool]:
    """Rows of six numbers, and whether they are rays."""
    if segments is not None and origins is None and directions is None:
        return _arrays.with_length(_arrays.rows("segments", segments, (2, 3), (6,)).reshape(-1, 6), False), False
    if segments is None and origins is not None and directions is not None:
        return _arrays.with_length(_arrays.rays(origins, directions), True), True
    raise InputError("expected either origins and directions, or segments")
