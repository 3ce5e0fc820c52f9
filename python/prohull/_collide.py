"""Collisions and distances between two meshes in rigid poses."""

import os
from typing import Any, NamedTuple, Optional, Union, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _prohull
from ._files import levels_of, mesh_of, naming
from ._prohull import InputError
from ._types import MeshLike, Progress


class FacePairs(NamedTuple):
    """The pairs of faces that meet in n poses. Those of pose i are pairs[offsets[i]:offsets[i + 1]], sorted."""

    offsets: NDArray[np.int64]  #: (n + 1,)
    pairs: NDArray[np.int64]  #: (pairs, 2), rows of `faces` of the one and of the other mesh


class Distances(NamedTuple):
    """Two bounds of the least distance in each of n poses. All is 0 where the meshes collide."""

    lower: NDArray[np.float64]  #: (n,), proven: at least so far apart
    upper: NDArray[np.float64]  #: (n,), proven: at most so far apart; 0 only where they collide
    points: NDArray[np.float64]  #: (n, 2, 3), a point of the one and a point of the other mesh, that far apart
    faces: NDArray[np.int64]  #: (n, 2), the faces that these points lie on


class Collider:
    """A mesh made ready for collisions. Built once, it serves every pose, and any number of threads.

    A closed mesh stands for a solid: its faces and what is inside, also if it is inside out. Any other mesh stands for
    its faces alone. A .phull file stands for the original in it, and only collides(..., conservative=True) asks its
    coarsest hull; a Hull stands for itself. All methods take these arguments:

    other: a Collider, or what it is made of.
    poses: where `other` is: matrices of shape (n, 4, 4), a rotation and a translation each. One matrix, (4, 4), counts
        as n = 1. Without it, `other` stays where it is.
    own_poses: where this mesh is, in the same way. A single pose goes with all of the other mesh, and the reverse.
    threads: the largest number of threads; 0 means one for each core. The answers do not depend on it.
    progress: called as build() calls it, with the stage "collide".

    A Collider may be pickled, as what it was made of; the copy builds its index anew.

    Answers are exact for the meshes whose vertices are R p + t, rounded to double precision. Raises InputError for
    matrices that are not rigid within 1e-6, and for meshes that are empty or not finite.

        arm = prohull.Collider("arm.stl")
        free = ~arm.collides("wall.stl", poses)
    """

    def __init__(self, mesh: MeshLike) -> None:
        """Builds the index of a mesh, as verify() takes it."""
        levels = levels_of(mesh)
        self._build(mesh, mesh_of(mesh)._core if levels is None else None, levels)

    def _build(self, given: Any, mesh: Optional[_prohull.Mesh], levels: Optional[_prohull.Levels]) -> None:
        self._given, self._mesh, self._levels = given, mesh, levels
        with naming(given):
            self._core = (_prohull.CollisionIndex(mesh) if mesh is not None else
                          _prohull.CollisionIndex(cast(_prohull.Levels, levels), False))
        self._hull: Optional[_prohull.CollisionIndex] = None  # of the levels; built when it is first asked

    def __getstate__(self) -> tuple[Any, ...]:
        name = os.fspath(self._given) if isinstance(self._given, (str, os.PathLike)) else None
        return name, self._mesh, self._levels

    def __setstate__(self, parts: tuple[Any, ...]) -> None:
        self._build(*parts)

    def _index(self, conservative: bool) -> _prohull.CollisionIndex:
        if self._levels is None or not conservative:
            return self._core
        if self._hull is None:
            with naming(self._given):
                self._hull = _prohull.CollisionIndex(self._levels, True)
        return self._hull

    @property
    def is_solid(self) -> bool:
        """Whether the mesh is closed, so that what lies inside of it collides."""
        return self._core.is_solid

    def collides(self, other: Union["Collider", MeshLike], poses: Optional[ArrayLike] = None, *,
                 own_poses: Optional[ArrayLike] = None, conservative: bool = False, threads: int = 0,
                 progress: Optional[Progress] = None) -> Union[bool, NDArray[np.bool_]]:
        """Decides for each pose, exactly, whether the meshes have a point in common. Touching counts, and so does one
        solid that is wholly inside of the other.

        Returns an array of shape (n,); True or False if no array of shape (n, 4, 4) was given.

        conservative: whether to answer for what the two meshes enclose, as outer hulls do. False is then certain,
            whatever they enclose; True is not. Of a .phull file the coarsest hull is asked; raises InputError if that
            is an inner one.
        """
        is_one, own, others = _pose_pairs(own_poses, poses)
        threads = _arrays.count("threads", threads)
        first, second = self._index(conservative), _collider(other)._index(conservative)
        answers = first.collides(second, own, others, conservative, threads, progress)
        return bool(answers[0]) if is_one else answers

    def intersecting_faces(self, other: Union["Collider", MeshLike], poses: Optional[ArrayLike] = None, *,
                           own_poses: Optional[ArrayLike] = None, threads: int = 0,
                           progress: Optional[Progress] = None) -> FacePairs:
        """Finds all pairs of faces that have a point in common in each pose, exactly. Touching counts."""
        _, own, others = _pose_pairs(own_poses, poses)
        threads = _arrays.count("threads", threads)
        return FacePairs(*self._core.intersecting_faces(_collider(other)._core, own, others, threads, progress))

    def distances(self, other: Union["Collider", MeshLike], poses: Optional[ArrayLike] = None, *,
                  own_poses: Optional[ArrayLike] = None, threads: int = 0,
                  progress: Optional[Progress] = None) -> Distances:
        """Finds the least distance in each pose, with two proven bounds that differ by rounding only."""
        _, own, others = _pose_pairs(own_poses, poses)
        threads = _arrays.count("threads", threads)
        return Distances(*self._core.distances(_collider(other)._core, own, others, threads, progress))


def _collider(given: Union[Collider, MeshLike]) -> Collider:
    return given if isinstance(given, Collider) else Collider(given)


def _pose_pairs(own_poses: Optional[ArrayLike],
                poses: Optional[ArrayLike]) -> tuple[bool, NDArray[np.float64], NDArray[np.float64]]:
    """Whether there is one pair only that was not given as an array of poses; and the rows of both, (n, 16)."""
    own, others = matrices("own_poses", own_poses), matrices("poses", poses)
    counts = {array.shape[0] for array in (own, others) if array.ndim == 3}
    if len(counts) > 1:
        raise InputError(f"own_poses of shape {own.shape} and poses of shape {others.shape}: expected as many of the "
                         "ones as of the others")
    shape = (*counts, 4, 4) if counts else (1, 4, 4)
    rows = [np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1, 16) for array in (own, others)]
    return not counts, rows[0], rows[1]


def matrices(name: str, given: Optional[ArrayLike]) -> NDArray[np.float64]:
    if given is None:
        return np.eye(4)
    is_one = np.shape(given) == (4, 4)
    rows = _arrays.rows(name, np.reshape(given, (1, 4, 4)) if is_one else given, (4, 4))
    if not (rows[:, 3] == [0, 0, 0, 1]).all():
        raise InputError(f"{name}: the last row of a matrix is not 0, 0, 0, 1")
    return rows.reshape(4, 4) if is_one else rows
