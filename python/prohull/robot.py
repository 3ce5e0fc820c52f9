"""Robots: certified collision meshes of all links, and checks of those that a robot ships with (docs/guides/robots.md).

    robot = prohull.robot.Robot.load("arm.urdf")
    hulls = robot.hulls(500, gap=0.005)
    hulls.save("arm_safe")

Reads URDF, SDF and MJCF, and expands xacro where the program xacro is installed. Lengths are in metres, angles in
radians. What is wrong with a file is raised as InputError, with the file and the line.
"""

import os
import pathlib
import warnings
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple, Optional, Union, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _prohull
from ._files import bytes_of, replaced, write_whole
from ._meshes import Mesh
from ._paths import BeyondLimits, Geometry, PathCheck, PathChecker, PathPair, path_checker, path_rows
from ._prohull import InputError
from ._shown import Shown
from ._sweep import Sweep, sweep_keywords, sweep_of
from ._types import MeshLike, Path, Progress, Source
from ._verify import Verdict, verdict_of
from ._view import Part

__all__ = ["BeyondLimits", "Check", "DisabledFinding", "DisabledPair", "Hulls", "Joint", "Link", "LinkCheck", "LinkHull",
           "LinkHulls", "Motion", "MotionPair", "PairProof", "PathCheck", "PathChecker", "PathPair", "Robot"]

Collision = Literal["hull", "convex", "spheres"]
Format = Literal["stl", "obj", "glb"]
JointType = Literal["fixed", "revolute", "continuous", "prismatic", "ball", "planar", "floating"]
Status = Literal["hulled", "primitives", "skipped", "unread", "empty"]
CheckVerdict = Literal["covered", "leaks", "undecided", "no-collision", "no-visual", "missing"]
PairKind = Literal["adjacent", "sampled-always", "sampled-never", "always", "never", "sometimes"]
PairVerdict = Literal["never", "always", "meets", "open"]
DisabledVerdict = Literal["unknown", "adjacent", "no-geometry", "never", "always", "meets", "open"]

#: Positions of joints: by name, the others at 0; or of all joints in their order.
Positions = Union[Mapping[str, float], Sequence[float], NDArray[Any]]


class Link:
    """A link of a robot."""

    name: str

    def __init__(self, robot: _prohull.Robot, number: int, name: str) -> None:
        self._robot, self._number, self.name = robot, number, name

    @property
    def visual(self) -> Mesh:
        """The triangles of the visual geometry, in the frame of the link. Curved forms as meshes around them.

        Raises InputError if a mesh file is not found or cannot be read.
        """
        return Mesh._of(self._robot.link_mesh(self._number, "visual"))

    @property
    def collision(self) -> Mesh:
        """The triangles of the collision geometry that the robot ships with, in the frame of the link.

        Raises InputError as `visual` does.
        """
        return Mesh._of(self._robot.link_mesh(self._number, "collision"))

    def __repr__(self) -> str:
        return f"<prohull.robot.Link: {self.name}>"


class Joint(NamedTuple):
    """A joint between two links."""

    name: str
    type: JointType
    parent: str  #: name of a link
    child: str  #: name of a link
    origin: NDArray[np.float64]  #: (4, 4), the frame of the child in that of the parent, at position 0
    axis: tuple[float, float, float]  #: in the frame of the child
    lower: float  #: least position; -inf without a limit
    upper: float  #: greatest position; inf without a limit
    mimics: Optional[str]  #: name of the joint that it follows


class LinkHull(NamedTuple):
    """A hull of a link; or its convex pieces, or its spheres."""

    target_faces: int  #: number of faces that was asked for; 0 of pieces and spheres
    mesh: Mesh  #: with the coordinates that the file keeps; of all pieces, or of meshes around the spheres
    pieces: list[Mesh]  #: convex pieces, if they were asked for; else empty
    spheres: NDArray[np.float64]  #: (n, 4), the center and the radius of each in the frame of the link; else empty
    origin: NDArray[np.float64]  #: (4, 4), the frame of the mesh in that of the link
    verdict: Verdict  #: what is proven, exactly, of the hull, or of the pieces or spheres together; distances are in metres
    target_reached: bool  #: whether the hull has at most target_faces faces, or none with fewer was found to keep max_distance
    within_bounds: bool  #: whether max_distance holds
    source: Source  #: what it was built from
    volume_ratio: float  #: its volume / the volume inside of the geometry; nan if that encloses no space
    volume_ratio_is_estimated: bool  #: whether the volume inside of the geometry is an estimate
    self_intersections: int  #: pairs of its faces that intersect
    notes: list[str]  #: what is not as it was asked for, and what is worth a look

    @property
    def certified(self) -> bool:
        """Whether what `verdict` tells is proven, exactly."""
        return self.verdict.certified


class LinkHulls(NamedTuple):
    """What was made of a link."""

    name: str
    status: Status  #: "hulled"; "primitives" are kept as they are; "skipped"; "unread" shapes; "empty" without geometry
    why: str  #: why it was skipped, or what is not read
    hulls: list[LinkHull]  #: one for each number of faces; empty unless the status is "hulled"
    repairs: list[str]  #: what was done to the geometry before hulls were built
    non_finite_faces: int  #: number of triangles with a corner that is not finite: they were left out
    seconds: float
    from_cache: bool


class LinkCheck(NamedTuple):
    """How the collision geometry that a link ships with lies to its visual geometry."""

    name: str
    verdict: CheckVerdict  #: exact; "undecided" where the two touch on a curved surface
    passes: bool  #: whether the link is as it should be: covered, nothing to cover, or sticking out by at most `allow`
    sticks_out_at_least: float  #: proven: some point of the visual geometry is that far outside
    sticks_out_at_most: float  #: proven: none is farther outside
    worst_point: Optional[tuple[float, float, float]]  #: such a point, in the frame of the link; None if none is known
    faces_outside: int  #: number of faces of the visual geometry that are not covered
    volume_ratio: float  #: volume of the collision geometry / volume inside of the visual geometry; may be nan
    volume_ratio_is_estimated: bool  #: whether one of the two volumes is an estimate
    distance_bound: float  #: how far the collision geometry reaches out of the visual one at most: proven; what is inside counts as 0
    mean_distance: float  #: the mean of the same distances over its surface, estimated
    notes: list[str]


class Check:
    """What Robot.check() has found. As a truth value: whether every link passes."""

    links: list[LinkCheck]  #: in the order of Robot.links
    allow: float

    def __init__(self, core: _prohull.RobotChecks, links: list[LinkCheck], allow: float) -> None:
        self._core, self.links, self.allow = core, links, allow

    @property
    def passes(self) -> bool:
        """Whether every link passes."""
        return all(link.passes for link in self.links)

    def __bool__(self) -> bool:
        return self.passes

    def __getitem__(self, name: str) -> LinkCheck:
        return {link.name: link for link in self.links}[name]

    def __repr__(self) -> str:
        failed = [link.name for link in self.links if not link.passes]
        result = f"{', '.join(failed)} fail" if failed else "all pass"
        return f"<prohull.robot.Check: {_arrays.counted(len(self.links), 'link')}, {result}>"


class PairProof(NamedTuple):
    """What is proven about the hulls of a pair of links, at all positions of the joints within their limits."""

    verdict: PairVerdict  #: "meets" means at `positions`
    why: str  #: if it is "open"
    proven_free: float  #: the share of the positions at which they are proven to be apart
    cells: int  #: of the joints' positions that were looked at
    positions: dict[str, float]  #: of all joints, where the hulls meet; empty if none is known
    visual_meets: bool  #: whether the visual geometry meets there, too


class DisabledFinding(NamedTuple):
    """What is proven about a pair of links that an SRDF file disables, at all positions of the joints within their limits."""

    verdict: DisabledVerdict  #: "meets" means at `positions`
    why: str  #: if it is "open"
    proven_free: float  #: as of PairProof, and so is what follows
    cells: int
    positions: dict[str, float]


class DisabledPair(NamedTuple):
    """A row of an SRDF file, and what is proven about it."""

    link1: str  #: as the file has it
    link2: str
    reason: str
    line: int  #: of the file
    refuted: bool  #: whether the two meet somewhere, and the reason does not allow for it
    collision: DisabledFinding  #: by the collision geometry that the robot ships with
    visual: DisabledFinding


class MotionPair(NamedTuple):
    """In how many configurations a pair of links collides."""

    a: str
    b: str
    kind: PairKind
    visual: int
    hull: int
    convex: int
    false_hull: int  #: the hulls collide, but the visual geometry does not
    false_convex: int  #: the convex hulls collide, but the visual geometry does not
    missed: int  #: the visual geometry collides, but the hulls do not: must be 0
    proof: Optional[PairProof]  #: None of adjacent pairs, of links without hulls, and with `prove=0`


class Motion:
    """What Hulls.motion() has found."""

    pairs: list[MotionPair]
    srdf: str  #: adjacent and proven pairs, and sampled ones if they were asked for, as a file that MoveIt reads

    def __init__(self, core: _prohull.RobotMotion, pairs: list[MotionPair], srdf: str) -> None:
        self._core, self.pairs, self.srdf = core, pairs, srdf

    @property
    def missed(self) -> int:
        """Collisions that the hulls have missed: 0, or a certificate is wrong."""
        return sum(pair.missed for pair in self.pairs)

    @property
    def false_hull(self) -> int:
        """Collisions of hulls where the visual geometry does not collide."""
        return sum(pair.false_hull for pair in self.pairs)

    @property
    def false_convex(self) -> int:
        """Collisions of convex hulls where the visual geometry does not collide."""
        return sum(pair.false_convex for pair in self.pairs)

    def __repr__(self) -> str:
        return (f"<prohull.robot.Motion: {_arrays.counted(len(self.pairs), 'pair')}, false collisions: {self.false_hull} of hulls, "
                f"{self.false_convex} of convex hulls; {self.missed} missed>")


class Hulls(Shown):
    """Hulls of all links of a robot, as Robot.hulls() makes them. Notebooks show the robot inside of its hulls."""

    robot: "Robot"
    links: list[LinkHulls]  #: in the order of Robot.links

    def __init__(self, robot: "Robot", core: _prohull.RobotHulls, format: Format) -> None:
        self.robot, self._core, self._format = robot, core, format
        self.links = [_link_hulls(facts) for facts in core.links]

    @property
    def certified(self) -> bool:
        """Whether every hull is certified, and no link was left as it is because it was skipped or has unread shapes."""
        return not self._left and all(hull.certified for link in self.links for hull in link.hulls)

    @property
    def _left(self) -> list[LinkHulls]:
        return [link for link in self.links if link.status in ("skipped", "unread")]

    def __getitem__(self, name: str) -> LinkHulls:
        return {link.name: link for link in self.links}[name]

    def __iter__(self) -> Iterator[LinkHulls]:
        return iter(self.links)

    def save(self, folder: Path, *, package: Optional[str] = None, to: Optional[Literal["mjcf"]] = None) -> list[str]:
        """Writes a robot whose collision elements name the hulls, with the hulls beside it. Returns the paths.

        folder: is made if it is not there. Each file appears whole or not at all, in place of one that has its name.
        package: make the folder a ROS package of this name, with copies of the files that the robot names.
        to: "mjcf" also writes a URDF robot as MJCF, for MuJoCo, without contacts between links that a joint connects.

        Raises InputError if the folder is that of the robot itself, for a name that ROS does not take, and for what
        MuJoCo does not read.
        """
        if to is not None:
            _arrays.one_of("to", to, ("mjcf",))
        out = pathlib.Path(_arrays.path(folder))
        if out.resolve() == pathlib.Path(self.robot.path).resolve().parent:
            raise InputError(f"{out}: the robot itself is in this folder, and would be overwritten; choose another one")
        written = []
        for name, write in self._core.files(out, self._format, package or "", to is not None):
            target = out / name
            target.parent.mkdir(parents=True, exist_ok=True)
            with replaced(target) as whole:
                write(whole)
            written.append(str(target))
        return written

    def motion(self, configurations: int = 1000, *, seed: int = 1, sampled_pairs: bool = False, prove: int = 10_000,
               threads: int = 0, progress: Optional[Progress] = None) -> Motion:
        """Moves the robot at random and counts which pairs of links collide: the geometry, hulls and convex hulls.
        Proves which pairs of hulls never meet, and finds where others do.

        configurations: number of random positions of all joints, within their limits.
        seed: other numbers give other positions.
        sampled_pairs: the SRDF has pairs, too, that were never, or always, in collision: sampled, which is no proof.
        prove: the largest number of cells of the joints' positions for each pair that no joint connects; with 0
            nothing is proven.
        threads, progress: as of Robot.hulls(). The counts do not depend on threads.
        """
        core, pairs, srdf = self._core.motion(
            _arrays.count("configurations", configurations), _arrays.count("seed", seed, bits=64),
            bool(sampled_pairs), _arrays.count("prove", prove), _arrays.count("threads", threads), progress)
        return Motion(core, [MotionPair._make([*pair, proof and PairProof(*proof)]) for *pair, proof in pairs], srdf)

    def report_html(self, path: Path, *, check: Optional[Check] = None, motion: Optional[Motion] = None,
                    threads: int = 0, progress: Optional[Progress] = None) -> None:
        """Writes a page with pictures and tables to a file, whole or not at all.

        check, motion: what check() and motion() have returned, to be on the page too.

        Raises InputError if the file cannot be written.
        """
        checks, allow = (None, 0.0) if check is None else (check._core, check.allow)
        page = self._core.report_html(checks, allow, None if motion is None else motion._core,
                                      _arrays.count("threads", threads), progress)
        write_whole(pathlib.Path(_arrays.path(path)), page)

    def _view_parts(self) -> list[Part]:
        return [Part(self.robot.name, self._core.shown(), lambda *size: self.picture((), *size))]

    def picture(self, positions: Positions = (), width: int = 560, height: int = 420) -> bytes:
        """Draws the robot inside of its first hulls. Returns the content of a .png file."""
        return self._core.picture(self.robot._positions(positions), *_arrays.picture_size(width, height))

    def _repr_png_(self) -> Optional[bytes]:
        return self.picture() or None

    def __repr__(self) -> str:
        made = [hull.certified for link in self.links for hull in link.hulls]
        left = f", {_arrays.counted(len(self._left), 'link')} left as it was" if self._left else ""
        return (f"<prohull.robot.Hulls: {self.robot.name}, {_arrays.counted(len(made), 'hull')}"
                f"{', NOT ALL CERTIFIED' if not all(made) else ', all certified' if made else ''}{left}>")


class Robot(Shown):
    """A robot as its file describes it. Notebooks show its visual geometry."""

    path: str  #: of the file
    name: str
    links: list[Link]
    joints: list[Joint]  #: those of a parent come before those of its children
    notes: list[str]  #: what of the file was not read

    def __init__(self, core: _prohull.Robot, path: str) -> None:
        self._core, self.path, self.name, self.notes = core, path, core.name, core.notes
        self.links = [Link(core, i, name) for i, name in enumerate(core.link_names)]
        self.joints = [Joint(**facts) for facts in core.joints]

    @classmethod
    def load(cls, path: Path, package_paths: Sequence[Path] = ()) -> "Robot":
        """Reads URDF, SDF or MJCF. A mesh file that is missing is told when it is needed.

        package_paths: folders in which packages are looked for, before those above the file and those of ROS.

        Raises InputError for what cannot be read, or is no robot.
        """
        return cls(_prohull.read_robot(_arrays.path(path), list(package_paths)), os.fspath(path))

    def poses(self, positions: Positions = ()) -> NDArray[np.float64]:
        """(links, 4, 4): where each link is, in the frame of the root, for positions of the joints."""
        return self._core.poses(self._positions(positions))

    def hulls(self, faces: Union[int, Sequence[int]] = 500, *, collision: Collision = "hull", pieces: int = 8,
              vertices: int = 64, spheres: int = 64, gap: float = 0, max_distance: Optional[float] = None,
              tight: bool = False, budgets: Optional[Path] = None, cache: Optional[Path] = None,
              from_: Geometry = "visual", format: Format = "stl", skip_missing: bool = False, threads: int = 0,
              progress: Optional[Progress] = None) -> Hulls:
        """Builds certified hulls of all links that have meshes, or convex pieces or spheres that cover them.

        Links are worked on side by side.

        faces: the largest number of faces of each hull, at least 4; several numbers make a hull each.
        collision: what covers each link: one "hull", "convex" pieces, or "spheres". Of spheres, Hulls.save() also
            writes ROBOT_spheres.yaml, as cuRobo reads it.
        pieces, vertices: with collision="convex", the largest number of pieces of each link, at least 1, and of
            vertices of each piece, at least 4.
        spheres: with collision="spheres", the largest number of spheres of each link, in [1, 100000].
        gap: least distance that hulls keep from the geometry, proven. Not for pieces and spheres.
        max_distance: largest distance of a point of a hull from the geometry, proven; greater than 0. None: no bound.
            Pieces and spheres are as few as keep it.
        tight: whether to build tight hulls, which takes some 4 times as long. Not for pieces and spheres.
        budgets: a YAML file with collision, faces, pieces, vertices, spheres, max_distance, gap and skip for single
            links.
        cache: a folder that keeps hulls for the next time.
        from_: the geometry that the hulls enclose, "visual" or "collision".
        format: of the hulls' files, "stl", "obj" or "glb". Hulls have float32 coordinates, which is what simulators and
            planners read of all of them.
        skip_missing: whether to leave links alone whose meshes are not found.
        threads: the largest number of threads; 0 means one for each core. The hulls do not depend on it.
        progress: called as build() calls it, with the name of the link that was finished last.

        Raises InputError for mesh files that are not found or cannot be read, and for options that are not as above.
        """
        for name, value, choices in (("from_", from_, Geometry), ("format", format, Format),
                                     ("collision", collision, Collision)):
            _arrays.one_of(name, value, get_args(choices))
        sizes = {"pieces": (pieces, 1), "vertices": (vertices, 4), "spheres": (spheres, 1)}
        for name, (size, least) in sizes.items():
            _arrays.count(name, size, least=least)
        counts = np.atleast_1d(_arrays.face_counts("faces", faces))
        distance = 0.0 if max_distance is None else _arrays.not_negative("max_distance", max_distance)
        if max_distance is not None and distance == 0:
            raise InputError(f"max_distance={max_distance!r}: expected a number greater than 0, or None for no bound")
        given = {"faces": counts.tolist(), "collision": collision, "pieces": int(pieces), "vertices": int(vertices),
                 "spheres": int(spheres), "gap": _arrays.not_negative("gap", gap),
                 "max_distance": distance, "tight": bool(tight), "cache": cache, "from": from_,
                 "skip_missing": bool(skip_missing), "threads": _arrays.count("threads", threads),
                 "budgets": None if budgets is None else bytes_of(budgets),
                 "budgets_name": "" if budgets is None else os.fspath(budgets)}
        return Hulls(self, self._core.hulls(given, progress), format)

    def check(self, allow: float = 0, *, threads: int = 0, progress: Optional[Progress] = None) -> Check:
        """Decides whether the collision geometry that the robot ships with covers its visual geometry, exactly.

        allow: how far the visual geometry may stick out.
        """
        allow = _arrays.not_negative("allow", allow)
        core, links = self._core.check(allow, _arrays.count("threads", threads), progress)
        return Check(core, [LinkCheck(**facts) for facts in links], allow)

    def check_disabled(self, srdf: Path, *, prove: int = 10_000, threads: int = 0,
                       progress: Optional[Progress] = None) -> list[DisabledPair]:
        """Decides each pair of links that an SRDF file disables, as `prohull urdf --check --srdf` does.

        prove: the largest number of cells of the joints' positions for each pair that no joint connects.

        Raises InputError for a file that is no SRDF, or the rows of which name no two links of this robot. Warns where
        it has the name of another robot. Mesh files that are not found are told in `why`.

            false = [pair for pair in robot.check_disabled("arm.srdf") if pair.refuted]
        """
        notes, rows = self._core.disabled_pairs(bytes_of(srdf), os.fspath(srdf), _arrays.count("prove", prove),
                                                _arrays.count("threads", threads), progress)
        for note in notes:
            warnings.warn(note, stacklevel=2)
        return [DisabledPair._make([*row, DisabledFinding(*collision), DisabledFinding(*visual)])
                for *row, collision, visual in rows]

    def path_checker(self, *, world: Optional[Mapping[str, MeshLike]] = None, geometry: Geometry = "collision",
                     srdf: Optional[Path] = None, ignore: Sequence[tuple[str, str]] = ()) -> PathChecker:
        """Makes the robot and its world ready for checks of paths.

        world: meshes by their names, each as verify() takes it, in metres and in the frame of the robot's root, where
            they stand still.
        geometry: of the links, "collision" or "visual". A link that has none of it counts by the other one.
        srdf: an SRDF file, the disabled pairs of which are not compared.
        ignore: pairs of names, of links or meshes of the world, that may meet: [("base_link", "table")].

        Links that a joint connects are not compared. Raises InputError for names that are not there, and for mesh files
        that are not found or cannot be read.
        """
        return path_checker(self._core, self._path_joints(), world, geometry, srdf, ignore)

    def check_path(self, positions: Union[ArrayLike, Path], joints: Optional[Sequence[str]] = None, *,
                   times: Optional[ArrayLike] = None, velocities: Optional[ArrayLike] = None,
                   accelerations: Optional[ArrayLike] = None, world: Optional[Mapping[str, MeshLike]] = None,
                   geometry: Geometry = "collision", srdf: Optional[Path] = None,
                   ignore: Sequence[tuple[str, str]] = (), gap: float = 0, cells: int = 10_000,
                   distances: bool = False, threads: int = 0, progress: Optional[Progress] = None) -> PathCheck:
        """Decides whether the robot is free at every moment of a path: proven, not sampled.

        The same as path_checker(world=..., ...).check(positions, joints, ...), which says what each argument is. For
        many paths keep the PathChecker: it reads the meshes only once.
        """
        checker = self.path_checker(world=world, geometry=geometry, srdf=srdf, ignore=ignore)
        return checker.check(positions, joints, times=times, velocities=velocities, accelerations=accelerations, gap=gap,
                             cells=cells, distances=distances, threads=threads, progress=progress)

    def sweep(self, positions: Union[ArrayLike, Path], joints: Optional[Sequence[str]] = None, *,
              times: Optional[ArrayLike] = None, velocities: Optional[ArrayLike] = None,
              accelerations: Optional[ArrayLike] = None, links: Optional[Sequence[str]] = None,
              geometry: Geometry = "collision", pieces: int = 16, max_distance: Optional[float] = None,
              float32_coordinates: bool = False, threads: int = 0, progress: Optional[Progress] = None
              ) -> dict[str, Sweep]:
        """Encloses all positions of links along a path, in the frame of the robot's root: by the name of each link.

        positions, joints, times, velocities, accelerations: the path, as of PathChecker.check().
        links: names; without it all links that have a shape.
        geometry: of the links, "collision" or "visual". A link that has none of it counts by the other one.
        pieces, float32_coordinates, threads, progress: as of prohull.sweep().
        max_distance: how far the slices of the motion may add to the distance of the pieces, in metres, greater than
            0. None: 2 % of the diagonal of each link.

        Raises InputError as check_path() and prohull.sweep() do, and for a link without a shape.
        """
        _arrays.one_of("geometry", geometry, get_args(Geometry))
        rows = path_rows(self._path_joints(), joints, positions, times, velocities, accelerations)
        made = _prohull.sweep_robot(
            self._core, rows, self._numbers_of(links), geometry == "visual", progress,
            sweep_keywords(pieces, max_distance, _arrays.not_negative, float32_coordinates, threads))
        beyond = _prohull.beyond_limits(self._core, rows)
        return {name: sweep_of({**facts, "beyond_limits": beyond and BeyondLimits(*beyond)}) for name, facts in made}

    def sweep_workspace(self, *, links: Optional[Sequence[str]] = None, geometry: Geometry = "collision",
                        pieces: int = 16, max_distance: Optional[float] = None, float32_coordinates: bool = False,
                        threads: int = 0, progress: Optional[Progress] = None) -> dict[str, Sweep]:
        """Encloses all positions of links with each joint anywhere within its limits: by the name of each root.

        Joints move independently, those that mimic too.

        links, geometry, pieces, float32_coordinates, threads, progress: as of sweep().
        max_distance: how far the slices of each joint's motion may add to the distance of the pieces, in metres, greater
            than 0. None: 2 % of the diagonal of what the joint moves.

        Raises InputError as sweep() does, and for a joint that has no limits, wrong ones or several freedoms, if such a
        link is behind it.
        """
        _arrays.one_of("geometry", geometry, get_args(Geometry))
        made = _prohull.sweep_workspace(
            self._core, self._numbers_of(links), geometry == "visual", progress,
            sweep_keywords(pieces, max_distance, _arrays.not_negative, float32_coordinates, threads))
        return {name: sweep_of(facts) for name, facts in made}

    def _numbers_of(self, links: Optional[Sequence[str]]) -> list[int]:
        numbers = {link.name: number for number, link in enumerate(self.links)}
        with_shape = [link.name for link in self.links if self._core.has_shape(numbers[link.name])]
        if not with_shape:
            raise InputError(f"{self.name}: no link has a shape")
        named = with_shape if links is None else _arrays.names("links", links)
        if unknown := [name for name in named if name not in numbers]:
            raise InputError(f"links: the robot has no link {unknown[0]!r}; it has {', '.join(numbers)}")
        if shapeless := [name for name in named if name not in with_shape]:
            raise InputError(f"links: {shapeless[0]!r} has no shape")
        return [numbers[name] for name in named]

    def _path_joints(self) -> list[str]:
        return [joint.name for joint in self.joints
                if joint.type in ("revolute", "continuous", "prismatic") and joint.mimics is None]

    def _view_parts(self) -> list[Part]:
        return [Part(self.name, self._core.shown(), lambda *size: self.picture((), *size))]

    def picture(self, positions: Positions = (), width: int = 560, height: int = 420) -> bytes:
        """Draws the visual geometry; meshes that are missing are left out. Returns the content of a .png file."""
        return self._core.picture(self._positions(positions), *_arrays.picture_size(width, height))

    def _repr_png_(self) -> Optional[bytes]:
        return self.picture() or None

    def __repr__(self) -> str:
        return f"<prohull.robot.Robot: {self.name}, {_arrays.counted(len(self.links), 'link')}, {_arrays.counted(len(self.joints), 'joint')}>"

    def _positions(self, positions: Positions) -> list[float]:
        """Of all joints."""
        if isinstance(positions, Mapping):
            names = [joint.name for joint in self.joints]
            if unknown := [name for name in positions if name not in names]:
                raise InputError(f"positions: {self.name} has no joint {unknown[0]!r}; it has {', '.join(names)}")
            return [float(positions.get(name, 0)) for name in names]
        values = [float(x) for x in positions] or [0.0] * len(self.joints)
        if len(values) != len(self.joints):
            raise InputError(f"positions: {len(values)} numbers for {len(self.joints)} joints")
        return values


def _link_hulls(facts: dict[str, Any]) -> LinkHulls:
    facts["hulls"] = [_link_hull(hull) for hull in facts["hulls"]]
    return LinkHulls(**facts)


def _link_hull(facts: dict[str, Any]) -> LinkHull:
    facts["mesh"] = Mesh._of(facts["mesh"])
    facts["pieces"] = [Mesh._of(piece) for piece in facts["pieces"]]
    return LinkHull(**{**facts, **verdict_of(facts)})
