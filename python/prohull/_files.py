"""Meshes and hulls from files, from arrays and from other libraries."""

import contextlib
import numbers
import os
import pathlib
import tempfile
from collections.abc import Iterator
from typing import Any, Optional

import numpy as np

from . import _arrays, _prohull
from ._hull import Hull
from ._meshes import Mesh
from ._prohull import InputError
from ._types import Axis, Gap, MeshLike, Path, Side


def mesh_of(mesh: MeshLike, keep_non_finite: bool = False) -> Mesh:
    """The Mesh of whatever is taken for one; a Hull of a .phull file."""
    if isinstance(mesh, Mesh):
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        _arrays.path(mesh)
        return load(mesh) if _prohull.is_hull_file(mesh) else Mesh._of(_prohull.read(mesh, keep_non_finite, 1.0))
    arrays = _arrays.arrays_of_mesh(mesh)
    if arrays is None:
        raise InputError(f"{_arrays.described(mesh)} is no mesh; {_arrays.MESHES}")
    return Mesh(*arrays)


def levels_of(mesh: Any) -> Optional[_prohull.Levels]:
    """Those in a .phull file, not verified; None of anything else."""
    is_path = isinstance(mesh, (str, os.PathLike))
    return _prohull.load(mesh) if is_path and _prohull.is_hull_file(_arrays.path(mesh)) else None


@contextlib.contextmanager
def naming(mesh: Any) -> Iterator[None]:
    """Errors name the mesh if it was given as a file."""
    try:
        yield
    except InputError as error:
        if isinstance(mesh, (str, os.PathLike)):
            raise InputError(f"{os.fspath(mesh)}: {error}") from None
        raise


def distance_of(name: str, value: Gap, mesh: Mesh) -> float:
    """A distance of at least 0; of "0.5%" that part of the diagonal of the box of the finite faces."""
    if not isinstance(value, str):
        return _arrays.not_negative(name, value)
    try:
        if not value.endswith("%"):
            raise ValueError
        share = _arrays.not_negative(name, float(value[:-1]))
    except ValueError:
        raise InputError(f'{name}={value!r}: expected a number, at least 0, or per cent as in "0.5%"') from None
    return share / 100 * mesh._core.diagonal


def bound_of(name: str, value: Gap, mesh: Mesh) -> float:
    """The same of a distance that may be infinite."""
    return distance_of(name, value, mesh) if isinstance(value, str) else value


def read(path: Path, *, scale: float = 1.0) -> Mesh:
    """Reads a mesh from a file: PLY, OBJ, OFF, STL, glTF, each also gzipped, and others (docs/formats.md).

    Returns the triangles as they are in the file, closed or not. Coordinates keep their bits. Raises InputError if the
    file cannot be read; the message says what is wrong with it, and where. A .phull file is read by load().

    scale: every coordinate is multiplied by this number, greater than 0, and rounded to the nearest double. 0.001 makes
        metres of millimetres.
    """
    if _prohull.is_hull_file(_arrays.path(path)):
        raise InputError(f"{os.fspath(path)}: this file holds the levels of a hull; prohull.load reads it")
    if not isinstance(scale, numbers.Real):
        raise InputError(f"scale={scale!r}: expected a number greater than 0")
    return Mesh._of(_prohull.read(path, False, float(scale)))


_FINEST = {"repaired": "the input after repairs", "convex-hull": "the convex hull of the input",
           "wrap": "a wrap of the input"}


def load(path: Path, *, mirror: Optional[Axis] = None) -> Hull:
    """Loads the hull that Hull.save() wrote to a .phull file, with all of its levels.

    The file holds the original mesh too, and the hull is verified against it as verify() does: `certified` says whether
    each level encloses all finer ones up to the original. If it does not, `notes` says why. `notes` also tells if the finest
    level, the `original`, is not what build() was given but what it made of that. Raises InputError if the file is not
    a sound .phull file. A mesh file is read by read().

    mirror: the axis for which build() was asked for a symmetric hull, which the file does not tell; None if that does
        not matter. Then levels are symmetric ones, and STL and GLB files are refused where float32 breaks the symmetry.
        Raises InputError if the hull is not symmetric.
    """
    levels = _prohull.load(_arrays.path(path))
    faces = levels.base_face_count
    original = levels.level(levels.original_face_count)
    if mirror is not None:
        _arrays.one_of("mirror", mirror, ("x", "y", "z"))
        if not levels.level(0).is_symmetric(mirror):
            raise InputError(f"{os.fspath(path)}: the hull is not symmetric along {mirror}; leave mirror out")
    side: Side = "inner" if levels.is_inner else "outer"
    found = _prohull.verify(levels, original, None, dict(
        side=side, open_shells="keep", solid_only=False, finite_only=False, gap=0.0, steps=0))
    proven, why_not = found["encloses"], found["why_not"]
    finest = _FINEST.get(levels.finest_level)
    notes = ([why_not] if why_not else []) + ([f"the finest level is {finest}, not the input itself"] if finest else [])
    facts = dict(mesh=levels.level(0), original=original, source="mesh", wrap_spacing=0.0, _levels=levels,
                 _given=original, _measured=original, _replay_suffices=False, _mirror=mirror,
                 certified=proven, proof="replay" if proven else "", gap=0.0, target_faces=faces, target_reached=True,
                 within_bounds=True, refusals={}, blocked={}, relaxed_guards=0, rounded_vertices=0, build_seconds=0.0,
                 verify_seconds=0.0, repairs=[], notes=notes)
    return Hull._made(facts, side)


def sample(name: str, faces: int) -> Mesh:
    """Makes a closed mesh of about so many faces: asteroid, bracket, box, gyroid, knot, pony, sphere or torus.

    faces: in [4, 2^30]; the mesh may have a few more or fewer.

    Raises InputError for another name, and for a number of faces outside of this range.
    """
    return Mesh._of(_prohull.sample(str(name), _arrays.count("faces", faces)))


def bytes_of(path: Path) -> bytes:
    """Of a whole file; errors are those of meshes that cannot be read."""
    try:
        return pathlib.Path(_arrays.path(path)).read_bytes()
    except FileNotFoundError:
        raise _prohull.MissingFile(f"{os.fspath(path)}: cannot read: there is no such file; look at its name and its "
                                   "folder") from None
    except OSError as error:
        raise InputError(f"{os.fspath(path)}: cannot read: {error.strerror}") from None


@contextlib.contextmanager
def replaced(path: pathlib.Path) -> Iterator[pathlib.Path]:
    """A path for a file that takes the place of the one at `path`, once it is whole."""
    with tempfile.TemporaryDirectory(dir=path.parent) as beside:
        whole = pathlib.Path(beside) / path.name
        yield whole
        os.replace(whole, path)


def write_whole(path: pathlib.Path, text: str) -> None:
    try:
        with replaced(path) as whole:
            whole.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
