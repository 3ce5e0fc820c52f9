"""What callers hand over becomes arrays that the extension module takes as they are."""

import numbers
import os
import sys
from collections.abc import Collection, Iterable
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._prohull import InputError


#: What is taken for a mesh, for messages.
MESHES = "expected the path of a file, vertices and faces, or an object that has both"


def array(name: str, values: Any) -> NDArray[Any]:
    try:
        made = np.asarray(values)
    except ValueError:
        raise InputError(f"{name}: rows of different lengths are no array") from None
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise InputError(f"{name}: a masked array with masked numbers; leave them out, or fill them with .filled()")
    return made


def _numbers(name: str, values: ArrayLike) -> NDArray[Any]:
    made = array(name, values)
    if made.dtype.kind not in "fiu" and made.size > 0:
        raise InputError(f"{name}: an array of {made.dtype}; expected floating point numbers or integers")
    return made


def path(value: Any) -> str:
    """The path of a file. No system has names with a zero byte."""
    name = os.fsdecode(value)
    if "\0" in name:
        raise InputError(f"{name!r}: a zero byte is in this name, and so there is no such file")
    return name


def face_counts(name: str, counts: Any) -> NDArray[Any]:
    """One number of faces, or several of them."""
    array = np.asarray(counts)
    if array.dtype.kind not in "iu" or array.ndim > 1 or array.size == 0 or array.min() < 4:
        raise InputError(f"{name}={counts!r}: expected a whole number of at least 4, or several of them")
    return array


def count(name: str, value: Any, bits: int = 32, least: int = 0) -> int:
    """A whole number, at least `least`, that has no more than these bits."""
    is_whole = isinstance(value, numbers.Integral)
    if not is_whole or not least <= value < 1 << bits:
        raise InputError(f"{name}={value!r}: expected a whole number, at least {least} and less than 2^{bits}")
    return int(value)


def one_of(name: str, value: Any, choices: Collection[Any]) -> None:
    if value not in choices:
        raise InputError(f"{name}={value!r}: expected one of {', '.join(choices)}")


def picture_size(width: Any, height: Any) -> tuple[int, int]:
    """In pixels."""
    return count("width", width, bits=31), count("height", height, bits=31)


def not_negative(name: str, value: Any, most: float = sys.float_info.max) -> float:
    """A number, at least 0; a finite one unless `most` is infinite."""
    is_number = isinstance(value, numbers.Real)
    if not is_number or not 0 <= value <= most:
        raise InputError(f"{name}={value!r}: expected a number, at least 0")
    return float(value)


def rows(name: str, values: ArrayLike, *shapes: tuple[int, ...]) -> NDArray[np.float64]:
    """A C-contiguous float64 array whose first axis counts rows, each of one of `shapes`; copied only if needed."""
    array = _numbers(name, values)
    if array.shape == (0,):  # an empty list has no rows, of whatever shape
        array = array.reshape(0, *shapes[0])
    if array.shape[1:] not in shapes or array.ndim == 0:
        expected = " or ".join(str(("n", *shape)).replace("'", "") for shape in shapes)
        raise InputError(f"{name}: an array of shape {array.shape}; expected {expected}")
    made = np.ascontiguousarray(array, dtype=np.float64)
    if array.dtype.itemsize > 8 or (array.dtype.kind in "iu" and array.dtype.itemsize == 8):
        is_rounded = (made != array.astype(np.longdouble)) & ~np.isnan(made)
        if is_rounded.any():
            raise InputError(f"{name}: {array[is_rounded][0]} is no float64 number; round to float64 before, if that will do")
    return made


def finite(name: str, array: NDArray[np.float64]) -> NDArray[np.float64]:
    if not np.isfinite(array).all():
        raise InputError(f"{name}: a number is not finite")
    return array


def indices(name: str, values: ArrayLike) -> NDArray[np.int64]:
    """A C-contiguous int64 array of shape (m, 3); copied only if needed."""
    array = _numbers(name, values)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"{name}: an array of shape {array.shape}; expected (m, 3)")
    if array.dtype.kind == "f" and not np.array_equal(array, np.trunc(array)):
        raise InputError(f"{name}: an array of {array.dtype} with fractions or numbers that are not finite")
    if array.dtype.kind != "i" and array.size > 0 and float(array.max()) >= 2.0**63:  # int64 would wrap
        greatest = format(array.max(), ".0f" if array.dtype.kind == "f" else "")
        raise InputError(f"{name}[{array.max(axis=1).argmax()}] names vertex {greatest}, which no mesh has")
    return np.ascontiguousarray(array, dtype=np.int64)


def rays(origins: ArrayLike, directions: ArrayLike) -> NDArray[np.float64]:
    """Rows of an origin and a direction, shape (n, 6); a single one, of shape (3,), is repeated for all others."""
    starts, ways = points(origins, "origins"), points(directions, "directions")
    counts = {len(made) for given, made in ((origins, starts), (directions, ways)) if np.shape(given) != (3,)} or {1}
    if len(counts) > 1:
        raise InputError(f"origins of shape {starts.shape} and directions of shape {ways.shape}: "
                         "expected as many of the ones as of the others")
    both = np.empty((counts.pop(), 6))
    both[:, :3], both[:, 3:] = starts, ways
    return both


def with_length(lines: NDArray[np.float64], are_rays: bool) -> NDArray[np.float64]:
    """The same rows, of an origin and a direction, or of two ends."""
    have_none = (lines[:, 3:] == (0 if are_rays else lines[:, :3])).all(axis=1)
    if have_none.any():
        why = "the ray's direction is zero" if are_rays else "the segment's ends are equal"
        raise InputError(f"query {have_none.argmax()}: {why}; leave it out")
    return lines


def points(values: Any, name: str = "points") -> NDArray[np.float64]:
    """Rows of shape (n, 3); a single point is the only row."""
    given = array(name, values)
    return rows(name, given[np.newaxis] if given.shape == (3,) else given, (3,))


def names(name: str, values: Any) -> list[str]:
    """One string alone is no sequence of names."""
    made = list(values) if isinstance(values, Iterable) and not isinstance(values, str) else [None]
    if not all(isinstance(value, str) for value in made):
        raise InputError(f"{name}={values!r}: expected a sequence of names")
    return made


def arrays_of_mesh(mesh: Any) -> Optional[tuple[Any, Any]]:
    """Vertices and faces of whatever looks like a mesh of trimesh, Open3D or another library; None of anything else."""
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh.Trimesh and many others
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # open3d.geometry.TriangleMesh
        return np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    if hasattr(mesh, "vertex") and hasattr(mesh, "triangle"):  # open3d.t.geometry.TriangleMesh
        return mesh.vertex["positions"].cpu().numpy(), mesh.triangle["indices"].cpu().numpy()
    if isinstance(mesh, tuple) and len(mesh) == 2:
        return mesh[0], mesh[1]
    return None


def is_mesh(given: Any) -> bool:
    """Whether it is a mesh by itself, rather than vertices without their faces."""
    return isinstance(given, (str, os.PathLike)) or arrays_of_mesh(given) is not None


def counted(number: int, one: str, many: str = "") -> str:
    """For representations: "1 face", "12 faces"."""
    return f"{number:,} {one if number == 1 else many or one + 's'}"


def described(given: Any) -> str:
    """For messages about what was handed over."""
    if isinstance(given, (str, os.PathLike, int, float)):
        return repr(given)
    if isinstance(given, np.ndarray):
        return f"an array of shape {given.shape}"
    kind = type(given)
    return f"a {kind.__qualname__}" if kind.__module__ == "builtins" else f"a {kind.__module__}.{kind.__qualname__}"
