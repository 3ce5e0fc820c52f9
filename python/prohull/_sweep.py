"""What encloses all positions of a mesh along a motion, or of a robot along a path."""

import math
import numbers
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _prohull
from ._collide import matrices
from ._covers import CoverShown, save_pieces
from ._files import bytes_of, distance_of, mesh_of, naming
from ._meshes import Mesh
from ._paths import BeyondLimits
from ._prohull import InputError
from ._types import Axis, Gap, MeshLike, Path, Progress
from ._verify import Verdict, verdict_of
from ._view import Part, pieces_part

_AXES: dict[str, tuple[float, float, float]] = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


@dataclass(frozen=True)
class Sweep(CoverShown):
    """Convex pieces whose union encloses all positions of a mesh; sweep() and Robot.sweep() make it."""

    pieces: list[Mesh]  #: convex polytopes, which overlap
    verdict: Verdict  #: what is proven of all positions of the mesh together; distances are from these
    fills_cavities: bool  #: whether the mesh has cavities, which count as filled
    cover_pieces: int  #: number of convex pieces of the mesh itself
    notes: list[str]
    volume: float = math.nan  #: of the union, in cubic units: an estimate; nan of links
    volume_error: float = math.nan  #: standard error of the estimate; 0 of a single piece, nan of links
    beyond_limits: Optional[BeyondLimits] = None  #: of Robot.sweep(): the first position of the path outside of the limits of its joint, if there is one

    @property
    def mesh(self) -> Mesh:
        """All pieces as one mesh: build(sweep.mesh, 500) makes one closed hull around them."""
        first = np.cumsum([0, *(len(piece.vertices) for piece in self.pieces)])
        return Mesh(np.concatenate([piece.vertices for piece in self.pieces]),
                    np.concatenate([piece.faces + offset for piece, offset in zip(self.pieces, first)]))

    def save(self, path: Path) -> None:
        """Writes all pieces to an .obj or .glb file, as an object or a mesh each. The file is written whole or not at all.

        Raises InputError for another suffix, if the file cannot be written, and for .glb unless the sweep was made with
        float32_coordinates=True.
        """
        save_pieces(path, self.pieces)

    def _view_parts(self) -> list[Part]:
        return [pieces_part([piece._core for piece in self.pieces])]

    def __repr__(self) -> str:
        return f"<prohull.Sweep: {_arrays.counted(len(self.pieces), 'convex piece')}, about {self.verdict.distance_bound:.3g} from what is passed>"


def sweep(mesh: MeshLike, *, axis: Union[Axis, Sequence[float]] = "z", through: Sequence[float] = (0, 0, 0),
          angle: float = 0, move: Sequence[float] = (0, 0, 0), poses: Union[ArrayLike, Path, None] = None,
          pieces: int = 16, max_distance: Optional[Gap] = None, float32_coordinates: bool = False, threads: int = 0,
          progress: Optional[Progress] = None) -> Sweep:
    """Encloses all positions that a mesh has along a motion, as `prohull sweep` does: the swept volume.

    Guaranteed: each position of each finite triangle lies in the union of the pieces, at every moment of the motion;
    and so does the inside where `verdict.encloses_solid` is True. It is proven, not sampled. The same input gives the same bits,
    whatever `threads` is.

    mesh: the path of a file, or a mesh of prohull, trimesh or Open3D, or a tuple of vertices and faces.
    axis, through, angle: the mesh turns by `angle` degrees, counter-clockwise if one looks against the axis, about an
        axis through a point: "x", "y", "z" or a vector.
    move: the mesh moves straight by this vector; together with `angle` as a screw does.
    poses: or from pose to pose: matrices of shape (n, 4, 4), a rotation and a translation each; or the name of a file,
        as --poses of `prohull sweep` reads it. Matrices may differ from rigid ones by 1e-6: what is
        proven is about the rigid ones, and `notes` tell of it. The origin of the mesh goes straight from one to the next, and the mesh
        turns about one axis the shorter way round. Not together with axis, through, angle and move.
    pieces: the largest number of convex pieces that cover the mesh before it moves, at least 1.
    max_distance: how far the slices of the motion may add to the distance of these pieces from the mesh, in the mesh's
        unit, greater than 0; or as in "0.5%" of the diagonal of the mesh's bounding box. None: 2 % of it.
    float32_coordinates: whether all coordinates shall be numbers that float32 keeps, as STL and GLB files do.
    threads: the largest number of threads; 0 means one for each core.
    progress: called as build() calls it. If it returns False, the work stops with KeyboardInterrupt, as for Ctrl-C.

    Raises InputError, a ValueError, for a file that cannot be read, a mesh without a finite triangle, no motion, motions
    that take more than 50,000 pieces, and arguments that are not as above.

        zone = prohull.sweep("door.stl", axis="z", through=(0, 1, 0), angle=90)
        hull = prohull.build(zone.mesh, 300)
    """
    has_turn = angle != 0 or not (isinstance(axis, str) and axis == "z" and _is_zero(through) and _is_zero(move))
    if poses is not None and has_turn:
        raise InputError("a mesh moves by poses, or by axis, through, angle and move: leave one of the two out")
    motions, notes = (_turn(axis, through, angle, move), []) if poses is None else _motions(poses)
    given = mesh_of(mesh, keep_non_finite=True)
    keywords = sweep_keywords(pieces, max_distance, lambda name, distance: distance_of(name, distance, given),
                              float32_coordinates, threads)
    with naming(mesh):
        facts = _prohull.sweep(given._core, motions, progress, keywords)
    return sweep_of({**facts, "notes": facts["notes"] + notes})


def sweep_keywords(pieces: int, max_distance: Optional[Gap], read: Callable[[str, Any], float], float32_coordinates: bool,
                   threads: int) -> dict[str, Any]:
    """`read` makes a number of the distance; the extension module takes 0 for 2 % of the diagonal."""
    distance = 0 if max_distance is None else read("max_distance", max_distance)
    if max_distance is not None and distance == 0:
        raise InputError(f"max_distance={max_distance!r}: expected a distance greater than 0, or None for 2 % of the diagonal")
    return dict(pieces=pieces, max_distance=distance, float32_coordinates=float32_coordinates, threads=threads)


def sweep_of(facts: dict[str, Any]) -> Sweep:
    facts["pieces"] = [Mesh._of(piece) for piece in facts["pieces"]]
    return Sweep(**{**facts, **verdict_of(facts)})


def _turn(axis: Any, through: Any, angle: float, move: Any) -> list[_prohull.RigidMotion]:
    if isinstance(axis, str) and axis not in _AXES:
        raise InputError(f"axis={axis!r}: expected 'x', 'y', 'z' or three numbers")
    direction, point, shift = (_vector(name, value) for name, value in (
        ("axis", _AXES[axis] if isinstance(axis, str) else axis), ("through", through), ("move", move)))
    if not isinstance(angle, numbers.Real):
        raise InputError(f"angle={angle!r}: expected a number")
    turned = math.radians(angle)
    if turned == 0 and not any(shift):
        raise InputError("how does the mesh move? Give angle, move or poses")
    return _prohull.turn(direction, point, turned, shift)


def _is_zero(vector: Any) -> bool:
    return np.array_equal(vector, (0, 0, 0))


def _vector(name: str, value: Any) -> list[float]:
    vector = _arrays.array(name, value)
    if vector.shape != (3,) or vector.dtype.kind not in "fiu":
        raise InputError(f"{name}={value!r}: expected three numbers")
    return [float(x) for x in vector]


def _motions(poses: Any) -> tuple[list[_prohull.RigidMotion], list[str]]:
    """And notes about the poses."""
    if isinstance(poses, (str, os.PathLike)):
        return _prohull.read_motions(bytes_of(poses), os.fspath(poses))
    rows = matrices("poses", poses).reshape(-1, 16)
    if len(rows) == 0:
        raise InputError("poses: there are none")
    return _prohull.motions_of(_arrays.finite("poses", rows))
