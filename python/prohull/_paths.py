"""Paths of robots: free all along, proven, or where bodies meet first."""

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, NamedTuple, Optional, Union, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _prohull
from ._files import bytes_of, mesh_of
from ._prohull import InputError
from ._types import MeshLike, Path, Progress

PathVerdict = Literal["free", "meets", "open"]
Geometry = Literal["visual", "collision"]


class PathPair(NamedTuple):
    """Two bodies that are not free all along a path."""

    a: str  #: name of a link
    b: str  #: name of a link, or of a mesh of the world
    verdict: PathVerdict  #: "meets" or "open"
    why: str  #: if it is "open"
    begin: float  #: before this time they do not meet: proven
    end: float  #: if it "meets": they do at this time; if it is "open": it is open up to this time
    positions: dict[str, float]  #: of all joints, where they meet; empty if it is "open"
    faces: tuple[int, int]  #: two faces that meet there; (0, 0) where one body is inside of the other


class BeyondLimits(NamedTuple):
    """A joint outside of its limits."""

    row: int  #: of the path; if it is outside between two rows only, the first of them
    joint: str
    position: float


class PathCheck(NamedTuple):
    """What is proven about a path. Times are those that were given; without any, row i is at time i.

    As a truth value: whether the path is free all along, and within the limits of the joints.
    """

    verdict: PathVerdict  #: "free": proven at every moment; "meets"; "open": neither was found
    free_until: float  #: no two bodies meet before this time: proven
    pairs: list[PathPair]  #: those that are not free; the first to meet comes first
    beyond_limits: Optional[BeyondLimits]  #: the first position outside of the limits of its joint, if there is one
    cells: int  #: pieces of the path that were looked at, over all pairs
    intervals: NDArray[np.float64]  #: (n, 2), begin and end of the intervals of `distances`; empty if not asked for
    distances: NDArray[np.float64]  #: (n,), in each interval all pairs are at least so far apart: proven

    def __bool__(self) -> bool:
        return self.verdict == "free" and self.beyond_limits is None


class PathChecker:
    """A robot and its world, ready for any number of paths: Robot.path_checker() makes it."""

    notes: list[str]  #: what stands for what, as links without collision geometry
    pairs: list[tuple[str, str]]  #: names of the bodies that are compared

    def __init__(self, joint_names: Sequence[str], core: _prohull.PathChecker) -> None:
        self._joint_names, self._core, self.notes, self.pairs = joint_names, core, core.notes, core.pairs

    def check(self, positions: Union[ArrayLike, Path], joints: Optional[Sequence[str]] = None, *,
              times: Optional[ArrayLike] = None, velocities: Optional[ArrayLike] = None,
              accelerations: Optional[ArrayLike] = None, gap: float = 0, cells: int = 10_000, distances: bool = False,
              threads: int = 0, progress: Optional[Progress] = None) -> PathCheck:
        """Decides whether the bodies are apart at every moment of a path: proven, not sampled.

        positions: of shape (rows, joints), in radians or metres; or the name of a .csv or .json file, as `prohull
            motion` reads it (docs/guides/motion.md), and then none of the next four.
        joints: the names of the columns; without it the columns are all joints that turn or slide and do not mimic
            others, in the order of Robot.joints. All others stay at rest, or follow those that they mimic.
        times: of shape (rows,), in seconds, which increase; without it rows are 1 apart.
        velocities, accelerations: of shape (rows, joints). Without velocities, the path is straight between rows; with
            them it consists of cubics, and with both of quintics.
        gap: how far bodies have to be apart at least, in metres; closer counts as meeting.
        cells: the largest number of pieces into which the path is divided for each pair of bodies.
        distances: whether to find the least distance over time, too.
        threads: the largest number of threads; 0 means one for each core. The result does not depend on it.
        progress: called as build() calls it, with the stage "prove".

        Raises InputError, with the row, for joints that the robot does not have, arrays of other shapes, numbers that
        are not finite, and times that do not increase; and if there is no pair of bodies that could meet.
        """
        rows = path_rows(self._joint_names, joints, positions, times, velocities, accelerations)
        facts = self._core.prove(rows, _arrays.not_negative("gap", gap), _arrays.count("cells", cells, least=2), bool(distances),
                                 _arrays.count("threads", threads), progress)
        pairs = [PathPair(**pair) for pair in facts.pop("pairs")]
        pairs.sort(key=lambda pair: (pair.verdict != "meets", pair.end if pair.verdict == "meets" else pair.begin))
        beyond = facts.pop("beyond_limits")
        return PathCheck(pairs=pairs, beyond_limits=beyond and BeyondLimits(*beyond), **facts)

    def __repr__(self) -> str:
        return f"<prohull.robot.PathChecker: {_arrays.counted(len(self.pairs), 'pair')} of bodies>"


def path_rows(names: Sequence[str], joints: Optional[Sequence[str]], positions: Any, *others: Optional[ArrayLike]
              ) -> _prohull.PathRows:
    """Of a file; or of arrays: positions, times, velocities and accelerations of `joints`, without these of `names`."""
    if isinstance(positions, (str, os.PathLike)):
        if joints is not None or any(other is not None for other in others):
            raise InputError("joints, times, velocities and accelerations are those of the file")
        return _prohull.read_path_rows(bytes_of(positions), os.fspath(positions))
    columns = list(names) if joints is None else _arrays.names("joints", joints)
    times, velocities, accelerations = others

    def table(name: str, values: Optional[ArrayLike]) -> list[Any]:
        return [] if values is None else list(_arrays.rows(name, values, (len(columns),)).tolist())

    moments = [] if times is None else _arrays.rows("times", times, ()).tolist()
    return _prohull.PathRows(columns, table("positions", positions), moments, table("velocities", velocities),
                             table("accelerations", accelerations))


def _world_of(world: Any) -> Mapping[str, MeshLike]:
    if world is None:
        return {}
    if not isinstance(world, Mapping) or not all(isinstance(name, str) for name in world):
        raise InputError(f"world: {_arrays.described(world)}; expected meshes by their names, as "
                         '{"table": "table.off"}')
    return world


def _pairs_of(ignore: Any) -> list[tuple[str, str]]:
    def is_pair(pair: Any) -> bool:
        return isinstance(pair, (tuple, list)) and len(pair) == 2 and all(isinstance(name, str) for name in pair)

    pairs = list(ignore) if isinstance(ignore, Iterable) else [ignore]
    if not all(map(is_pair, pairs)):
        raise InputError(f'ignore={ignore!r}: expected pairs of names, as [("base_link", "table")]')
    return [(a, b) for a, b in pairs]


def path_checker(robot: _prohull.Robot, joint_names: Sequence[str], world: Optional[Mapping[str, MeshLike]],
                 geometry: Geometry, srdf: Optional[Path], ignore: Sequence[tuple[str, str]]) -> PathChecker:
    _arrays.one_of("geometry", geometry, get_args(Geometry))
    text = b"" if srdf is None else bytes_of(srdf)
    meshes = [(name, mesh_of(mesh)._core) for name, mesh in _world_of(world).items()]
    core = _prohull.PathChecker(robot, meshes, geometry, text, "" if srdf is None else os.fspath(srdf),
                                _pairs_of(ignore))
    return PathChecker(joint_names, core)
