"""Builds hulls of many meshes or of a huge one, and asks many segments, on the workers of a dask cluster
(docs/guides/dask.md).

    client = distributed.Client("scheduler:8786")
    rows = prohull.dask.build_folder(client, "meshes", "hulls", 500)
    hull = prohull.dask.build_partitioned(client, "scan.ply", 2000, parts=16)
    rows = prohull.dask.build_robots(client, ["arm.urdf", "gripper.urdf"], "safe", gap=0.005)
    hits = prohull.dask.query(client, hull.original, segments)

The workers need prohull, and must see the same files by the same paths as the caller. What a worker had under way when
it died is done again by others. Importing this module raises ImportError where dask and its distributed scheduler are
not installed; `import prohull` needs neither.
"""

import contextlib
import csv
import hashlib
import inspect
import io
import json
import os
import pathlib
import sys
import time
import warnings
from collections.abc import Callable, Collection, Generator, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple, Optional, TypeVar, Union, get_args, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

try:
    import distributed
except ImportError as error:
    raise ImportError("prohull.dask needs dask and its distributed scheduler; install python3-dask and "
                      "python3-distributed, or by pip \"dask[distributed]\"") from error

import prohull

from . import AllHits, FirstHits, Hull, InputError, Mesh, _arrays, _prohull, robot
from ._files import mesh_of, replaced
from ._meshes import Engine
from ._types import MeshLike, Path, Side

__all__ = ["RobotRow", "Row", "build_folder", "build_partitioned", "build_robots", "query", "show"]

_untyped: Any = distributed  # it tells only some of its types

#: What Hull.save() writes.
Suffix = Literal[".ply", ".obj", ".off", ".stl", ".glb", ".phull"]
#: Files that build_folder() takes from a folder, also with .gz after it.
FORMATS = frozenset({".ply", ".obj", ".off", ".stl", ".glb", ".gltf", ".dae", ".3mf"})

#: A function that is called with the number of what is done, of what there is, and of what failed. False stops the run.
Progress = Callable[[int, int, int], Optional[bool]]


Status = Literal["built", "kept", "refused", "failed"]


class Row(NamedTuple):
    """What became of one mesh. report.csv has such a row for each."""

    name: str  #: name of the mesh: its path within the folder, the name of its file, its key, or its number
    status: Status  #: "built", "kept" from an earlier run, "refused" for an InputError, "failed" for anything else
    file: str = ""  #: path of the hull; empty if there is none
    faces: int = 0  #: number of faces of the hull
    void_ratio: Optional[float] = None  #: Hull.void_ratio of the hull as it was written; None if there is none
    seconds: float = 0.0  #: time that building took, with reading and writing
    message: str = ""  #: why there is no hull; or what was repaired, and the notes of the hull


def show(done: int, total: int, failed: int) -> None:
    """Writes progress to stderr: to a terminal one line that changes, else one line at the end."""
    terminal = sys.stderr.isatty()
    if terminal or done == total:
        begin, end = "\r" if terminal else "", "" if terminal and done < total else "\n"
        print(f"{begin}prohull: {done} of {total} done, {failed} failed", end=end, file=sys.stderr, flush=True)


def build_folder(client: "distributed.Client", meshes: Union[Path, Sequence[MeshLike], Mapping[str, MeshLike]],
                 out: Path, target_faces: int = 2000, *, suffix: Suffix = ".stl", progress: Optional[Progress] = show,
                 **options: Any) -> list[Row]:
    """Builds a certified hull of each mesh into the folder `out`, and writes to report.csv there what became of each.

    Guaranteed: there is a row for each mesh, in the order given, whatever happens to meshes and workers. The file of a
    hull is whole and certified, or it is not there. A mesh whose workers die each time, also when it is alone on one,
    gets a row that failed.

    When it is called again, also after an interruption, it keeps a hull if the mesh and the options are the same as
    before, and builds the others. Files count as the same by size and time of change, arrays by content.

    client: of a cluster whose workers see `meshes` and `out` by the same paths.
    meshes: a folder, which is searched for meshes at any depth; or a sequence of paths or meshes; or a dictionary of
        them by name. Workers read the paths; other meshes travel as arrays. The names of files in a sequence must be
        distinct.
    out: a folder, which is made if it is not there. The hull of NAME is NAME + suffix. NAME + suffix + ".json" beside
        it says what it was made from.
    target_faces: the largest number of faces of each hull, at least 4.
    suffix: ".ply", ".obj", ".off", ".stl" or ".glb", or ".phull" for all levels.
    progress: see Progress; None for none. If it returns False, KeyboardInterrupt is raised.
    options: other options of prohull.build(), by name. Unless given, `float32_coordinates` is True for .stl and .glb,
        `levels` is True for .phull, and `threads` is 1: start one worker for each core.

    Raises InputError if `meshes` is no folder or is `out`, if names are not distinct or lead out of `out`, and for
    another suffix; TypeError for an option that build() does not have; OSError if `out` cannot be written.
    """
    out = pathlib.Path(out).resolve()
    jobs = _jobs(_named(meshes, out), out, suffix, _checked({"target_faces": target_faces, **options}, suffix))
    return _run(client, _built, jobs, Row, out / "report.csv", progress, _finished)


class RobotRow(NamedTuple):
    """What became of one robot. robots.csv has such a row for each."""

    name: str  #: name of the robot's file without its suffix, or its key
    status: Literal["built", "refused", "failed"]  #: "refused" for an InputError, "failed" for anything else
    file: str = ""  #: path of the robot that was written; empty if there is none
    links: int = 0  #: number of links with hulls
    hulls: int = 0  #: number of hulls, all certified
    faces: int = 0  #: number of faces of all hulls
    seconds: float = 0.0
    message: str = ""  #: why there is no robot; or the notes of hulls


def build_robots(client: "distributed.Client", files: Union[Sequence[Path], Mapping[str, Path]], out: Path,
                 faces: Union[int, Sequence[int]] = 500, *, package_paths: Sequence[Path] = (),
                 progress: Optional[Progress] = show, **options: Any) -> list[RobotRow]:
    """Builds certified hulls of many robots, each into a folder of `out`, and writes to robots.csv what became of each.

    Guaranteed: there is a row for each robot, in the order given, whatever happens to robots and workers. A robot is
    written only if all of its hulls are certified and all shapes of its links are read; `message` names links that were
    skipped, as `skip_missing` or a budget asks. Hulls of an earlier run are kept in the folder `cache`.

    client: of a cluster whose workers see all files by the same paths.
    files: paths of robots whose names without suffix are distinct; or a dictionary of paths by name.
    out: a folder, which is made if it is not there. The robot NAME goes to the folder NAME of it.
    faces: as of prohull.robot.Robot.hulls(); so are `options`. Unless given, `threads` is 1, and `cache` is a folder of
        that name within `out`.
    package_paths: as of prohull.robot.Robot.load().
    progress: see Progress; None for none. If it returns False, KeyboardInterrupt is raised.

    Raises InputError if names are not distinct or lead out of `out`; TypeError for an option that hulls() does not
    have; OSError if `out` cannot be written.
    """
    out = pathlib.Path(out).resolve()
    _require_known("build_robots", robot.Robot.hulls, options, others={"progress"})
    options = {"faces": faces, "threads": 1, "cache": str(out / "cache"), **options}
    for name in ("budgets", "cache"):  # workers may have other working directories
        if options.get(name) is not None:
            options[name] = os.path.abspath(options[name])
    packages = [os.path.abspath(path) for path in package_paths]
    jobs = [_RobotJob(name, os.path.abspath(path), str(out / name), packages, options)
            for name, path in _robots_by_name(files).items()]
    out.mkdir(parents=True, exist_ok=True)
    return _run(client, _built_robot, jobs, RobotRow, out / "robots.csv", progress)


def build_partitioned(client: "distributed.Client", mesh: MeshLike, target_faces: int = 2000, *, parts: int = 8,
                      side: Side = "outer", tight: bool = False, float32_coordinates: bool = False, threads: int = 1,
                      progress: Optional[Progress] = show) -> Hull:
    """Builds a certified hull of one huge mesh. Each part of the mesh is simplified on a worker, with its border kept;
    the caller joins the parts, and builds the hull of what they make up.

    Guaranteed: `certified` says that the hull encloses the mesh as it was given, which is decided exactly and on the
    whole, as prohull.build() does. The same mesh and the same number of parts give the same bits, whatever workers do
    the work, and also if some of them die.

    The hull has no levels. It is another one than that of prohull.build(), with about as much void. The caller is left
    with some 32 faces for each of the hull, and those at borders: this pays where the mesh has many more.

    client: of a cluster. Its workers get the parts as arrays, and need not see any file.
    mesh: a closed 2-manifold, oriented outwards. The caller reads a path.
    target_faces: the largest number of faces of the hull, at least 4.
    parts: number of parts, at least 1: two or three for each worker, so that all have work until the end, and so many
        that a worker has room for one. With very many, much of the mesh lies at borders.
    side, tight, float32_coordinates: as of prohull.build().
    threads: the largest number of threads of each part on its worker; 0 means one for each core. The caller uses all of
        its cores for the rest.
    progress: see Progress; it counts parts, and the rest as one more.

    Raises InputError if the mesh is no closed 2-manifold, or is inside out, and for numbers outside of their ranges;
    distributed.KilledWorker if all workers died that a part was given to.
    """
    given, count = mesh_of(mesh), _arrays.face_counts("target_faces", target_faces)
    if count.ndim > 0:
        raise InputError(f"target_faces={target_faces!r}: expected one number")
    if not isinstance(parts, int) or parts < 1:
        raise InputError(f"parts={parts!r}: expected a whole number, at least 1")
    start = time.perf_counter()
    _require_closed(given)
    told = _Told(progress, parts + 1)
    options = {"side": side, "float32_coordinates": float32_coordinates, "threads": threads}
    joined = _joined(client, given, parts, max(_JOINED * int(count), 4 * parts), options, told)
    hull = prohull.build(joined, int(count), side=side, tight=tight, float32_coordinates=float32_coordinates)
    built = time.perf_counter()
    proof = _prohull.proof_of(hull._core, given._core, given._core, None, side)
    told.add(1)
    return hull._as(hull._core, certified=bool(proof), proof=proof, repairs=[], build_seconds=built - start,
                    verify_seconds=time.perf_counter() - built, _given=given._core, _original=given, _measured=given._core, _levels=None,
                    _covered=None, _volume_inside=None, _replay_suffices=False)


@overload
def query(client: "distributed.Client", mesh: MeshLike, segments: ArrayLike, kind: Literal["first_hit"] = ..., *,
          chunk: int = ..., engine: Engine = ..., threads: int = ..., progress: Optional[Progress] = ...) -> FirstHits: ...
@overload
def query(client: "distributed.Client", mesh: MeshLike, segments: ArrayLike, kind: Literal["any_hit"], *,
          chunk: int = ..., engine: Engine = ..., threads: int = ...,
          progress: Optional[Progress] = ...) -> NDArray[np.bool_]: ...
@overload
def query(client: "distributed.Client", mesh: MeshLike, segments: ArrayLike, kind: Literal["all_hits"], *,
          chunk: int = ..., engine: Engine = ..., threads: int = ..., progress: Optional[Progress] = ...) -> AllHits: ...
def query(client: "distributed.Client", mesh: MeshLike, segments: ArrayLike, kind: str = "first_hit", *,
          chunk: int = 1 << 17, engine: Engine = "auto", threads: int = 1,
          progress: Optional[Progress] = None) -> Union[FirstHits, NDArray[np.bool_], AllHits]:
    """Answers mesh.first_hit(), any_hit() or all_hits() for `segments`: with the same bits, in the same order.

    The mesh travels to each worker once, with its levels where `engine` needs them, and each worker builds its index
    once.

    mesh: a Mesh, a Hull or its `original`, or what else prohull.build() takes. The caller reads a path.
    segments: (n, 2, 3) or (n, 6), both ends of each.
    kind: "first_hit", "any_hit" or "all_hits".
    chunk: number of segments of one task, at least 1; it is rounded up to a multiple of 512.
    engine, threads: as of the queries of Mesh. Each task has one thread unless `threads` is given.
    progress: see Progress; it counts segments.

    Raises InputError as the query itself does, and distributed.KilledWorker if all workers died that a chunk was given
    to.
    """
    _arrays.one_of("kind", kind, ("first_hit", "any_hit", "all_hits"))
    rows = _arrays.with_length(_finite(_arrays.rows("segments", segments, (2, 3), (6,)).reshape(-1, 6)), False)
    given = mesh_of(mesh)
    bare = Mesh._of(given._core, given._query_levels)  # of a Hull no more than is asked
    # Multiples of what a batch answers at a time, which paper-refinement can tell.
    size = -(-max(1, chunk) // 512) * 512
    chunks = {start: rows[start:start + size] for start in range(0, max(1, len(rows)), size)}
    held = _submitted(client, _held, bare)
    told = _Told(progress, len(rows))
    answers: dict[int, Any] = {}
    with contextlib.closing(_completed(client, _ask, chunks.items(), held, kind, engine, threads)) as completed:
        for start, future in completed:
            answers[start] = future.result()
            told.add(len(chunks[start]))
    together: Union[FirstHits, NDArray[np.bool_], AllHits] = _together(kind, [answers[start] for start in chunks])
    return together


#: What the parts make up has so many faces for each face of the hull,
_JOINED = 32
#: and so many beside each face at a border, from where faces can only grow slowly.
_BORDER = 4


class _Part(NamedTuple):
    """The faces that reach into a box; first its own, then those that belong to other parts."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.uint32]
    own_faces: int
    box: NDArray[np.float64]  # its least and its greatest corner
    target_faces: int


def _require_closed(mesh: Mesh) -> None:
    report = mesh.report()
    if not report["closed_manifold"]:
        raise InputError(f"build_partitioned() takes a closed 2-manifold, and this mesh is none: {report['first_defect']}; "
                         "prohull.build() repairs meshes")
    if not report["volume"] > 0:
        raise InputError("the mesh is inside out or encloses nothing; prohull.build() turns what it can")


def _boxes(mesh: Mesh, count: int) -> Iterator[tuple[Any, Any, Any]]:
    """Splits space into boxes of about as many faces each, and tells of each its own faces, the others that reach into
    it, and its two corners. The least coordinates of a face decide whose it is, without arithmetic: a face that lies
    inside of a box is its own."""
    vertices, faces = mesh.vertices, mesh.faces

    def split(near: Any, is_own: Any, box: Any, count: int) -> Iterator[tuple[Any, Any, Any]]:
        if count == 1 or not is_own.any():
            yield near[is_own], near[~is_own], box
            yield from [(near[:0], near[:0], box)] * (count - 1)
            return
        axis = int(np.argmax([np.ptp(low_and_high(near[is_own], axis)[0]) for axis in range(3)]))
        low, high = low_and_high(near, axis)
        below = count // 2
        median = is_own.sum() * below // count
        at = np.partition(low[is_own], median)[median]
        for is_near, of_half, side, parts in ((low <= at, low < at, 1, below), (high >= at, low >= at, 0, count - below)):
            half = box.copy()
            half[side, axis] = at
            yield from split(near[is_near], (is_own & of_half)[is_near], half, parts)

    def low_and_high(some: Any, axis: int) -> Any:
        a, b, c = (vertices[:, axis][faces[some, corner]] for corner in range(3))
        return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)

    everything = np.arange(len(faces), dtype=np.uint32)
    whole = np.array([[-np.inf] * 3, [np.inf] * 3])
    yield from split(everything, np.ones(len(faces), bool), whole, count)


def _joined(client: "distributed.Client", mesh: Mesh, count: int, target_faces: int, options: dict[str, Any],
            told: "_Told") -> Mesh:
    """What the parts make up when each is simplified."""
    numbers: dict[int, Any] = {}  # of the vertices of each part, in the mesh

    def parts() -> Iterator[tuple[int, Any]]:
        for i, (own, others, box) in enumerate(_boxes(mesh, count)):
            faces = mesh.faces[np.concatenate([own, others])]
            numbers[i], faces = _compact(faces, len(mesh.vertices))
            vertices = mesh.vertices[numbers[i]]
            is_inside = ((vertices > box[0]) & (vertices < box[1])).all(axis=1)
            at_border = len(own) - np.count_nonzero(is_inside[faces[:len(own)]].all(axis=1))
            target = target_faces * len(own) // max(1, len(mesh.faces)) + _BORDER * at_border
            yield i, _Part(vertices, faces, len(own), box, max(4, target))

    made: dict[int, Any] = {}
    with contextlib.closing(_completed(client, _simplified, parts(), options)) as completed:
        for i, future in completed:
            made[i] = future.result()
            told.add(1)
    return _together_again(mesh, [(numbers[i], *made[i]) for i in range(count)])


def _compact(faces: Any, vertices: int) -> tuple[Any, Any]:
    """The numbers of the vertices that the faces have, in their order, and the faces in places of this list."""
    is_used = np.zeros(vertices, bool)
    is_used[faces] = True
    places = np.cumsum(is_used, dtype=np.uint32) - np.uint32(1)
    return np.flatnonzero(is_used), places[faces]


def _together_again(mesh: Mesh, parts: Sequence[tuple[Any, ...]]) -> Mesh:
    vertices, faces, count = [mesh.vertices], [], len(mesh.vertices)
    for numbers, kept, new, of_part in parts:
        vertices.append(new)
        faces.append(np.concatenate([numbers[kept], np.arange(count, count + len(new))])[of_part])
        count += len(new)
    used, joined = _compact(np.concatenate(faces), count)
    return Mesh(np.concatenate(vertices)[used], joined)


class _RobotJob(NamedTuple):
    name: str
    path: str
    folder: str
    package_paths: list[str]
    options: dict[str, Any]


def _require_known(caller: str, called: Callable[..., Any], options: Iterable[str], others: Collection[str] = ()) -> None:
    """`others` are keywords of `called` that are none of its options here."""
    known = {p.name for p in inspect.signature(called).parameters.values() if p.kind is p.KEYWORD_ONLY}
    if unknown := set(options) - (known - set(others)):
        raise TypeError(f"{caller}() got options that {called.__name__}() does not have: {', '.join(sorted(unknown))}")


def _is_path(mesh: Any) -> bool:
    return isinstance(mesh, (str, os.PathLike))


def _by_name(things: Any, what: str, name_of: Callable[[int, Any], str]) -> dict[str, Any]:
    """A mapping as it is, a sequence under the name of each."""
    named: dict[str, Any] = {}
    for name, thing in things.items() if isinstance(things, Mapping) else ((name_of(*it), it[1]) for it in enumerate(things)):
        if name in named:
            raise InputError(f"{thing}: another {what} is called {name} as well; give them by distinct names")
        named[name] = thing
    return named


def _robots_by_name(files: Any) -> dict[str, Any]:
    named = _by_name(files, "robot", lambda i, path: pathlib.Path(path).stem)
    for name in named:
        if name in ("", ".", "..", "cache", "robots.csv") or pathlib.PurePath(name).name != name:
            raise InputError(f"{name!r}: no name for a folder of a robot")
    return named


class _Job(NamedTuple):
    name: str
    mesh: Union[str, Mesh]
    target: str
    options: dict[str, Any]
    made_from: dict[str, Any]


def _checked(options: dict[str, Any], suffix: str) -> dict[str, Any]:
    _require_known("build_folder", prohull.build, options.keys() - {"target_faces"})
    if np.ndim(options["target_faces"]) > 0:
        raise InputError(f"target_faces={options['target_faces']!r}: expected one number")
    if suffix.lower() not in get_args(Suffix):
        raise InputError(f"suffix={suffix!r}: expected one of {', '.join(get_args(Suffix))}")
    keeps_levels = suffix.lower() == ".phull"
    if keeps_levels and options.get("tight"):
        raise InputError("suffix='.phull': a tight hull has no levels; give another suffix or leave out tight")
    if keeps_levels and not options.get("levels", True):
        raise InputError("suffix='.phull': these files hold levels; give another suffix or leave out levels")
    return {"float32_coordinates": suffix.lower() in (".stl", ".glb"), "threads": 1,
            **({"levels": True} if keeps_levels else {}), **options}


def _named(meshes: Any, out: pathlib.Path) -> dict[str, Any]:
    if _is_path(meshes):
        return _meshes_in(pathlib.Path(meshes).resolve(), out)
    return _by_name(meshes, "mesh", lambda i, mesh: pathlib.Path(mesh).name if _is_path(mesh) else f"{i:06d}")


def _meshes_in(folder: pathlib.Path, out: pathlib.Path) -> dict[str, pathlib.Path]:
    if not folder.is_dir():
        raise InputError(f"{folder}: no folder")
    if folder == out:
        raise InputError(f"{folder}: its hulls would be meshes of the next run; give another folder as out")
    return {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*"))
            if _is_mesh(path) and out not in path.parents}


def _is_mesh(path: pathlib.Path) -> bool:
    packed = path.suffix.lower() == ".gz"
    return (path.with_suffix("") if packed else path).suffix.lower() in FORMATS and path.is_file()


def _jobs(named: dict[str, Any], out: pathlib.Path, suffix: str, options: dict[str, Any]) -> list[Union[_Job, Row]]:
    """A row instead for what is no mesh or not there."""
    normal: dict[str, str] = {}
    for name in named:
        other = normal.setdefault(os.path.normpath(name), name)
        if other != name:
            raise InputError(f"{name!r} and {other!r} are one name; give distinct ones")
        if os.path.isabs(name) or ".." in pathlib.PurePath(name).parts or not name:
            raise InputError(f"{name!r}: a name of a mesh is a path within {out}")
    out.mkdir(parents=True, exist_ok=True)
    jobs: list[Union[_Job, Row]] = []
    for name, mesh in named.items():
        try:
            is_path = _is_path(mesh)
            mesh = os.path.abspath(mesh) if is_path else mesh_of(mesh, keep_non_finite=True)
            made_from = {"version": prohull.__version__, "options": json.loads(json.dumps(options, default=_recorded)),
                         "mesh": {"path": mesh, **_state(mesh)} if is_path else {"digest": _digest(mesh)}}
            jobs.append(_Job(name, mesh, str(out / (name + suffix)), options, made_from))
        except Exception as error:
            jobs.append(_row_of_error(name, error, Row))
    return jobs


_AnyRow = TypeVar("_AnyRow", Row, RobotRow)


def _row_of_error(name: str, error: BaseException, row: type[_AnyRow]) -> _AnyRow:
    if isinstance(error, InputError):
        return row(name, "refused", message=str(error))
    why = "every worker that built it died, as by a crash or for want of memory"
    told = why if isinstance(error, distributed.KilledWorker) else error
    return row(name, "failed", message=f"{type(error).__name__}: {told}")


def _recorded(value: Any) -> Any:
    """Of an option: numpy's repr() leaves out numbers of long arrays."""
    return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else repr(value)


def _state(path: str) -> dict[str, int]:
    """Changes whenever the file does."""
    stat = os.stat(path)
    return {"bytes": stat.st_size, "mtime_ns": stat.st_mtime_ns}


def _digest(mesh: Mesh) -> str:
    content = hashlib.blake2b(digest_size=16)
    content.update(f"{len(mesh.vertices)} {len(mesh.faces)}".encode())
    content.update(mesh.vertices.data)
    content.update(mesh.faces.data)
    return content.hexdigest()


# On the worker.


def _row_of(job: Any, build: Callable[[Any], _AnyRow], row: type[_AnyRow]) -> _AnyRow:
    try:
        return build(job)
    except Exception as error:  # whatever it is, the others are to be built
        return _row_of_error(job.name, error, row)


def _finished(job: _Job) -> Optional[Row]:
    """That of the hull if it is there, and made of this mesh with these options by this version."""
    try:
        with open(job.target + ".json") as file:
            record = json.load(file)
        if record["made_from"] == job.made_from and record["hull"] == _state(job.target):
            return Row(**record["row"])._replace(name=job.name, file=job.target)
    except (OSError, ValueError, KeyError, TypeError):
        pass
    return None


def _built(job: _Job) -> Row:
    if known := _finished(job):  # by a worker that died later
        return known
    start = time.perf_counter()
    hull = prohull.build(job.mesh, **job.options)
    notes = "; ".join([*hull.repairs, *hull.notes])
    if not hull.certified:
        return Row(job.name, "failed", message=f"not certified: {notes}")
    os.makedirs(os.path.dirname(job.target), exist_ok=True)
    hull.save(job.target)
    row = Row(job.name, "built", job.target, len(hull.faces), float(hull.void_ratio),
              round(time.perf_counter() - start, 3), notes)
    record = {"made_from": job.made_from, "hull": _state(job.target), "row": row._asdict()}
    _write(pathlib.Path(job.target + ".json"), json.dumps(record, indent=1) + "\n")  # only now it counts
    return row


def _built_robot(job: _RobotJob) -> RobotRow:
    start = time.perf_counter()
    hulls = robot.Robot.load(job.path, job.package_paths).hulls(**job.options)
    made = [hull for link in hulls for hull in link.hulls]
    notes = "; ".join([*(f"{link.name}: left as it is: {link.why}" for link in hulls if link.why),
                       *(f"{link.name}: {note}" for link in hulls for hull in link.hulls for note in hull.notes)])
    if not all(hull.certified for hull in made) or any(link.status == "unread" for link in hulls):
        return RobotRow(job.name, "failed", message=f"not certified: {notes}")
    file = next(path for path in hulls.save(job.folder) if os.path.dirname(path) == job.folder)
    return RobotRow(job.name, "built", file, sum(bool(link.hulls) for link in hulls), len(made),
                    sum(len(hull.mesh.faces) for hull in made), round(time.perf_counter() - start, 3), notes)


def _simplified(part: _Part, options: dict[str, Any]) -> tuple[Any, Any, Any]:
    """The vertices of the part that are left, the first that the faces count; those that are new; and the faces."""
    mesh = _prohull.Mesh(part.vertices, part.faces.astype(np.int64))
    made, kept = _prohull.simplified_part(mesh, part.own_faces, part.box, None,
                                          {**options, "target_faces": part.target_faces})
    return kept, made.vertices[len(kept):], made.faces


def _held(mesh: Mesh) -> Mesh:
    """A result that workers hand on to each other and keep, and that is there anew if all that had it died."""
    return mesh


def _ask(rows: NDArray[np.float64], mesh: Mesh, kind: str, engine: Any, threads: int) -> Any:
    return getattr(mesh, kind)(segments=rows, engine=engine, threads=threads)


# On the caller's side.


def _completed(client: Any, function: Callable[..., Any], jobs: Iterable[tuple[int, Any]], *arguments: Any,
               alone: bool = False) -> Generator[tuple[int, Any], None, None]:
    """The futures of function(job, *arguments), as they come, under the keys of the jobs. Two for each thread are under
    way at once, or only one, for the sake of the scheduler's memory; when this is closed, none begins any more."""
    waiting = iter(jobs)
    under_way: dict[Any, int] = {}
    pool = _untyped.as_completed(loop=client.loop)

    def submit() -> None:
        most = 1 if alone else 2 * max(1, sum(client.nthreads().values()))
        for _, (key, job) in zip(range(most - len(under_way)), waiting):
            future = _submitted(client, function, job, *arguments)
            under_way[future] = key
            pool.add(future)

    try:
        submit()
        for future in pool:
            yield under_way.pop(future), future
            submit()
    finally:
        if under_way:
            client.cancel(list(under_way))


def _submitted(client: Any, function: Callable[..., Any], *arguments: Any) -> Any:
    """Meshes and segments go with their tasks, so that any worker can begin them anew; dask would rather scatter them,
    which is lost with a worker."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="(?s)(Large object|Sending large graph) of size")
        return client.submit(function, *arguments, pure=False)


def _run(client: "distributed.Client", build: Callable[..., Any], jobs: Sequence[Any], row: Any, file: pathlib.Path,
         progress: Optional[Progress], known: Callable[[Any], Any] = lambda job: None) -> list[Any]:
    """What build(job) returns for each of the jobs, or a row that says why it did not; the file gets the rows, too. A
    row among the jobs stands for itself, and known(job) tells what an earlier run has built."""
    rows: dict[int, Any] = {}
    for i, job in enumerate(jobs):
        if isinstance(job, row):
            rows[i] = job
        elif earlier := known(job):
            rows[i] = earlier._replace(status="kept")
    told = _Told(progress, len(jobs))
    told.add(len(rows), sum(row.status != "kept" for row in rows.values()))
    for alone in (False, True):  # what was lost with its worker again: something beside it may have killed that
        todo = [(i, job) for i, job in enumerate(jobs) if i not in rows]
        with contextlib.closing(_completed(client, _row_of, todo, build, row, alone=alone)) as completed:
            for i, future in completed:
                error = future.exception() if future.status == "error" else None
                if alone or not isinstance(error, distributed.KilledWorker):
                    rows[i] = _row_of_error(jobs[i].name, error, row) if error else future.result()
                    told.add(1, rows[i].status != "built")
    in_order = [rows[i] for i in sorted(rows)]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([row._fields, *in_order])
    _write(file, text.getvalue())
    return in_order


class _Told:
    """How far it is, told to `progress`."""

    def __init__(self, progress: Optional[Progress], total: int) -> None:
        self._progress, self._total = progress, total
        self._done = self._failed = 0

    def add(self, done: int, failed: int = 0) -> None:
        self._done, self._failed = self._done + done, self._failed + failed
        goes_on = self._progress(self._done, self._total, self._failed) if self._progress else None
        if isinstance(goes_on, (bool, np.bool_)) and not goes_on:
            raise KeyboardInterrupt("progress returned False")


def _finite(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    finite = np.isfinite(rows).all(axis=1)
    if not finite.all():
        raise InputError(f"query {np.argmin(finite)} has a coordinate that is not finite; remove it")
    return rows


def _together(kind: str, answers: list[Any]) -> Any:
    if kind == "any_hit":
        return np.concatenate(answers)
    columns: list[Any] = [np.concatenate(column) for column in zip(*answers)]
    if kind == "first_hit":
        return FirstHits(*columns)
    begins = np.cumsum([0] + [len(answer.face) for answer in answers])
    offsets = [answer.offsets[:-1] + begin for answer, begin in zip(answers, begins)]
    return AllHits(np.concatenate([*offsets, begins[-1:]]), *columns[1:])


def _write(path: pathlib.Path, text: str) -> None:
    with replaced(path) as whole:
        whole.write_text(text, encoding="utf-8", errors="surrogateescape")  # names of files may be no UTF-8
