"""Convex pieces and balls whose union covers a mesh."""

import math
import os
import pathlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Callable, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _prohull
from ._files import bound_of, mesh_of, naming, write_whole
from ._meshes import Mesh
from ._prohull import InputError
from ._shown import Shown
from ._types import Gap, MeshLike, Path, PieceShape, Progress, Rows
from ._verify import Offender, Proven, Verdict, most_steps, verdict_of
from ._view import Part, balls_part, pieces_part


class Ball(NamedTuple):
    """All points within `radius` of the center."""

    center: NDArray[np.float64]  #: (3,)
    radius: float


class Capsule(NamedTuple):
    """All points within `radius` of the segment from a to b."""

    a: NDArray[np.float64]  #: (3,)
    b: NDArray[np.float64]  #: (3,)
    radius: float


class OrientedBox(NamedTuple):
    """All points center + x axes[0] + y axes[1] + z axes[2] with |x| <= half_sizes[0] and so on."""

    center: NDArray[np.float64]  #: (3,)
    axes: NDArray[np.float64]  #: (3, 3), one axis in each row: of length 1, at right angles, right-handed
    half_sizes: NDArray[np.float64]  #: (3,)


_PRIMITIVES: dict[str, Callable[..., Union[OrientedBox, Capsule, Ball]]] = {"box": OrientedBox, "capsule": Capsule, "sphere": Ball}


class ConvexPiece(Mesh):
    """A piece of a cover: a convex polytope, closed, with faces that look outwards. Everything that a Mesh does, it does."""

    primitive: Optional[Union[OrientedBox, Capsule, Ball]]  #: a box, capsule or ball that encloses the polytope, if `shape` asked for one


class CoverShown(Proven, Shown):
    def picture(self, width: int = 400, height: int = 300) -> bytes:
        """Draws what covers the mesh, each piece or ball in a colour of its own. Returns the content of a .png file.

        width, height: in pixels, each in [1, 16384].
        """
        return self._view_parts()[0].picture(*_arrays.picture_size(width, height))

    def _repr_png_(self) -> bytes:
        return self.picture()


@dataclass(frozen=True)
class ConvexCover(CoverShown):
    """Convex pieces whose union covers a mesh; convex_pieces() makes it."""

    pieces: list[ConvexPiece]
    verdict: Verdict  #: what is proven of the pieces together; the solid of an open mesh is that with its openings closed
    volume: float  #: of the union, in cubic units; overlaps count once
    original_volume: float  #: of what lies inside of the mesh, in cubic units
    within_bounds: bool  #: whether max_distance and max_void_percent hold
    notes: list[str]  #: what is not as it was asked for, and what is worth a look
    seconds: float
    verify_seconds: float
    original: Mesh = field(repr=False)  #: what was covered

    @property
    def void_ratio(self) -> float:
        """The void, as a share of the volume of the mesh; nan if the mesh encloses no space."""
        return _void_ratio(self)

    def save(self, path: Path) -> None:
        """Writes all pieces to an .obj or .glb file, as an object or a mesh each. The file is written whole or not at all.

        A GLB file keeps float32 coordinates only. Each of `pieces` has a save() of its own, for a file for each.

        Raises InputError for another suffix, if the file cannot be written, and for .glb unless the pieces were made
        with float32_coordinates=True.
        """
        save_pieces(path, self.pieces)

    def _view_parts(self) -> list[Part]:
        return [pieces_part([piece._core for piece in self.pieces])]

    def __repr__(self) -> str:
        return _described(self, len(self.pieces), "convex piece")


@dataclass(frozen=True)
class SphereCover(CoverShown):
    """Balls whose union covers a mesh; spheres() makes it."""

    balls: NDArray[np.float64] = field(repr=False)  #: (n, 4): center and radius of each, in the mesh's unit
    verdict: Verdict  #: what is proven of the balls together; distances of a mesh without a solid are from a wrap
    volume: float  #: of the union, in cubic units; overlaps count once
    original_volume: float  #: of what lies inside of the mesh, in cubic units
    within_bounds: bool  #: whether max_distance holds
    notes: list[str]  #: what is not as it was asked for, and what is worth a look
    seconds: float
    verify_seconds: float
    original: Mesh = field(repr=False)  #: what was covered

    @property
    def centers(self) -> NDArray[np.float64]:
        """(n, 3), the centers of the balls, in the mesh's unit."""
        return self.balls[:, :3]

    @property
    def radii(self) -> NDArray[np.float64]:
        """(n,), the radii of the balls, in the mesh's unit."""
        return self.balls[:, 3]

    @property
    def void_ratio(self) -> float:
        """Volume of the union / volume of the mesh - 1; nan if the mesh encloses no space.

        Without fill=True the balls need not cover the inside, so that it may be less than 0.
        """
        return _void_ratio(self)

    def save(self, path: Path, *, link: Optional[str] = None) -> None:
        """Writes the balls to a .yaml file of collision spheres, which cuRobo reads. The file is written whole or not at all.

        link: the name of the link that the balls belong to. Unless given, it is the name of the file without its suffix.

        Raises InputError for another suffix, and if the file cannot be written.
        """
        target = pathlib.Path(_arrays.path(path))
        if target.suffix.lower() not in (".yaml", ".yml"):
            raise InputError(f"{os.fspath(path)}: spheres are written to files that end in .yaml or .yml")
        write_whole(target, _prohull.sphere_file(target.stem if link is None else link, self.balls))

    def _view_parts(self) -> list[Part]:
        return [balls_part(self.balls)]

    def __repr__(self) -> str:
        return _described(self, len(self.balls), "ball")


@dataclass(frozen=True)
class UnionVerification(Verdict):
    """What verify_union() found. It counts as true if the union covers the original."""

    faces_outside: int  #: number of triangles of the original of which a part lies outside of all pieces; exact
    worst: list[Offender]  #: the farthest of these, farthest first
    faces_undecided: int  #: number of triangles that neither is proven of, to be covered or to reach outside
    inside_undecided: bool  #: whether it is not known that the pieces or balls leave no hole in the solid
    holes: int  #: number of connected parts of the union's surface that leave a hole in the solid; they are looked for only if faces_outside is 0
    turned_pieces: int  #: number of pieces that were inside out and count as turned
    union_volume: float  #: in cubic units; overlaps count once; nan if a piece is not convex
    original_volume: float  #: in cubic units; nan if the original is not closed
    void_ratio: float  #: union_volume / original_volume - 1; nan if one of the two is
    notes: list[str]  #: what was left out of the original or turned


def convex_pieces(mesh: MeshLike, pieces: int = 16, *, vertices: int = 64, max_distance: Gap = math.inf,
                  max_void_percent: float = math.inf, shape: PieceShape = "polytope", float32_coordinates: bool = False,
                  threads: int = 0, progress: Optional[Progress] = None) -> ConvexCover:
    """Covers any triangles by a few convex pieces, as `prohull convex` does.

    Guaranteed: if `certified` is True, the union of the pieces covers every finite triangle of the mesh, and its inside
    too where the mesh bounds a solid. This is decided exactly, on the very numbers in `vertices` of the pieces. The same
    input gives the same bits, whatever `threads` is. The search looks for the least volume of the union.

    mesh: the path of a file, or a mesh of prohull, trimesh or Open3D, or a tuple of vertices and faces.
    pieces: the largest number of pieces, at least 1.
    vertices: the largest number of vertices of a piece, at least 4.
    max_distance: how far the union may reach out of the mesh, in the mesh's unit, greater than 0; or as in
        "0.5%" of the diagonal of the mesh's bounding box. It is proven. Points of a piece that lie in other pieces, or
        in the solid of the mesh, do not count. With this bound or the next, the cover has as few pieces as keep both; if
        as many as `pieces` do not, `within_bounds` is False.
    max_void_percent: how much more volume than the mesh the union may have, in per cent, greater than 0.
    shape: "polytope", or "box", "capsule" or "sphere" for pieces that have such a `primitive` around them where the
        bounds allow it.
    float32_coordinates: whether all coordinates shall be numbers that float32 keeps, as STL and GLB files do.
    threads: the largest number of threads; 0 means one for each core.
    progress: called as build() calls it. If it returns False, the work stops with KeyboardInterrupt, as for Ctrl-C.

    Raises InputError, a ValueError, for a file that cannot be read, a mesh without a finite triangle, and arguments that
    are not as above.

        cover = prohull.convex_pieces("part.stl", 8)
        vertices_of_pieces = [piece.vertices for piece in cover.pieces]
    """
    keywords = dict(pieces=pieces, vertices=vertices, max_distance=max_distance, max_void_percent=max_void_percent,
                    shape=shape, float32_coordinates=float32_coordinates, threads=threads)
    facts = _covered(_prohull.convex_pieces, mesh, progress, keywords)
    facts["pieces"] = [ConvexPiece._with(core, primitive=primitive and _PRIMITIVES[primitive[0]](*primitive[1:]))
                       for core, primitive in facts["pieces"]]
    return ConvexCover(**facts)


def spheres(mesh: MeshLike, count: int = 64, *, max_distance: Gap = math.inf, fill: bool = False, threads: int = 0,
            progress: Optional[Progress] = None) -> SphereCover:
    """Covers any triangles by balls that reach out of the mesh as little as possible, as `prohull spheres` does.

    Guaranteed: if `certified` is True, the union of the balls covers every finite triangle of the mesh, with fill=True
    also its inside where the mesh bounds a solid. This is decided exactly, on the very numbers in `balls`. The same input
    gives the same bits, whatever `threads` is.

    mesh: the path of a file, or a mesh of prohull, trimesh or Open3D, or a tuple of vertices and faces.
    count: the largest number of balls, in [1, 100000].
    max_distance: how far the balls may reach out of the mesh, in the mesh's unit, greater than 0; or as
        in "0.5%" of the diagonal of the mesh's bounding box. It is proven. The cover
        then has as few balls as keep it; if as many as `count` do not, `within_bounds` is False.
    fill: whether to cover the inside of the mesh too, not only its triangles.
    threads: the largest number of threads; 0 means one for each core.
    progress: called as build() calls it. If it returns False, the work stops with KeyboardInterrupt, as for Ctrl-C.

    Raises InputError, a ValueError, for a file that cannot be read, a mesh without a finite triangle, and arguments that
    are not as above.

        cover = prohull.spheres("forearm.stl", 64)
        cover.save("forearm.yaml")
    """
    keywords = dict(count=count, max_distance=max_distance, fill=fill, threads=threads)
    return SphereCover(**_covered(_prohull.spheres, mesh, progress, keywords))


def verify_union(pieces: Union[ConvexCover, SphereCover, Sequence[MeshLike], Rows], original: MeshLike, *,
                 inside: bool = False, solid_only: bool = False, finite_only: bool = False,
                 steps: Optional[int] = None, progress: Optional[Progress] = None) -> UnionVerification:
    """Decides exactly whether convex pieces, or balls, cover `original`, as `prohull verify --union` does.

    It does not matter which program made them. Pieces may touch, share walls and overlap. Every triangle of the original
    must be covered. Convex pieces must also cover its inside, if it is closed.

    pieces: a cover; or a sequence of meshes, each of which is one convex piece, and is given as `original` is; or balls
        as an array, (n, 4), with the center and the radius of each.
    original: the path of a file, or a mesh of prohull, trimesh or Open3D, or a tuple of vertices and faces.
    inside: whether balls must cover the inside of a closed original, too. Convex pieces always must.
    solid_only: whether only the solid must be covered that a closed original bounds, as in verify().
    finite_only: whether triangles of the original that are not finite are left out, as in verify().
    steps: the largest number of steps of each search, as in verify().
    progress: called as build() calls it, with the stage "verify".

    Raises InputError if there is no piece, if a piece is not closed, not finite or has no volume, and if the original
    is empty.

        assert prohull.verify_union(["hull_1.stl", "hull_2.stl"], "part.stl")
    """
    second = mesh_of(original, keep_non_finite=True)._core
    balls, most = _balls(pieces), most_steps(steps)
    if balls is not None:
        facts = _prohull.verify_balls(balls, second, inside, solid_only, finite_only, most, progress)
    else:
        given: Any = pieces.pieces if isinstance(pieces, ConvexCover) else pieces
        facts = _prohull.verify_pieces([mesh_of(piece)._core for piece in given], second, solid_only, finite_only, most,
                                       progress)
    facts["worst"] = [Offender(*offender) for offender in facts["worst"]]
    return UnionVerification(**facts)


def save_pieces(path: Path, pieces: Sequence[Mesh]) -> None:
    is_float32 = all(np.array_equal(piece.vertices, piece.vertices.astype(np.float32)) for piece in pieces)
    if _prohull.stores_float32(path) and not is_float32:
        raise InputError(f"{os.fspath(path)}: the file keeps float32 coordinates; make the pieces with "
                         "float32_coordinates=True, or save them as .obj")
    _prohull.write_pieces(path, [piece._core for piece in pieces])


def _covered(cover: Callable[..., dict[str, Any]], mesh: MeshLike, progress: Optional[Progress],
             keywords: dict[str, Any]) -> dict[str, Any]:
    """What `cover` makes of the mesh; errors name the file."""
    given = mesh_of(mesh, keep_non_finite=True)
    lengths = {name: bound_of(name, keywords[name], given) for name in ("max_distance", "gap", "spacing") if name in keywords}
    with naming(mesh):
        facts = cover(given._core, progress, {**keywords, **lengths})
        return {**facts, **verdict_of(facts), "original": given}


def _balls(pieces: Any) -> Optional[NDArray[np.float64]]:
    """Balls, of shape (n, 4); None if meshes were given."""
    if isinstance(pieces, SphereCover):
        return pieces.balls
    if isinstance(pieces, ConvexCover):
        return None
    is_sequence = isinstance(pieces, Sequence) and not isinstance(pieces, str)
    if is_sequence and all(_arrays.is_mesh(piece) for piece in pieces):
        return None
    if _arrays.is_mesh(pieces):
        raise InputError(f"pieces: {_arrays.described(pieces)} is one mesh; expected a sequence of them, or balls")
    return _arrays.rows("balls", pieces, (4,))


def _void_ratio(cover: Union[ConvexCover, SphereCover]) -> float:
    return cover.volume / cover.original_volume - 1 if cover.original_volume else math.nan


def _described(cover: Union[ConvexCover, SphereCover], count: int, what: str) -> str:
    void = "" if math.isnan(cover.void_ratio) else f"void {100 * cover.void_ratio:.3g} %, "
    notes = f", {_arrays.counted(len(cover.notes), 'note')}" if cover.notes else ""
    return (f"<prohull.{type(cover).__name__}: {_arrays.counted(count, what)}, {void}"
            f"{'certified' if cover.certified else 'NOT CERTIFIED'}{notes}>")
