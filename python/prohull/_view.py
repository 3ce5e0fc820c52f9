"""Pages that show hulls in three dimensions: in notebooks, in browsers, and as files."""

import base64
import html
import os
import pathlib
import sys
import tempfile
import webbrowser
from collections.abc import Sequence
from typing import Any, Callable, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _prohull
from ._files import mesh_of, write_whole
from ._meshes import Mesh
from ._prohull import InputError
from ._types import MeshLike, Path, Progress, Side, Viewable

_WIDTH, _HEIGHT = 640, 480  # of the picture

# The picture lies below the page: it is seen where frames or scripts are taken out of notebooks, and until the page opens.
# The page runs apart from the notebook, of which it can see and change nothing.
_IN_NOTEBOOK = """<div style="position: relative; height: 600px; overflow: hidden">
<img src="data:image/png;base64,{png}" alt="{alt}" style="max-width: 100%; max-height: 100%">
<iframe srcdoc="{page}" sandbox="allow-scripts allow-downloads" allow="fullscreen" title="{alt}"
 style="position: absolute; top: 0; left: 0; width: 100%; height: 100%; border: 0"></iframe>
</div>"""


class Part(NamedTuple):
    """Something on a page."""

    name: str
    core: Union[_prohull.Mesh, _prohull.Levels, _prohull.ShownRobot, list[_prohull.Mesh], NDArray[np.float64]]
    picture: Callable[[int, int], bytes]
    side: Optional[Side] = None


class View:
    """A page that shows hulls, as view() and show() make it. Notebooks show the page, or a picture where scripts are blocked."""

    html: Optional[str]  #: the page; None if prohull was built without it
    picture: bytes  #: the content of a .png file
    names: list[str]  #: of what is shown

    def __init__(self, names: list[str], html: Optional[str], picture: bytes) -> None:
        self.names, self.html, self.picture = names, html, picture

    def open(self) -> None:
        """Opens the page, or the picture if there is no page, in a browser. It goes to a file in the folder for temporary files.

        Raises RuntimeError if there is no browser.
        """
        content = self.picture if self.html is None else self.html.encode()
        suffix = ".png" if self.html is None else ".html"
        with tempfile.NamedTemporaryFile(prefix="prohull-", suffix=suffix, delete=False) as file:
            file.write(content)
        if not webbrowser.open(pathlib.Path(file.name).as_uri()):
            os.unlink(file.name)
            raise RuntimeError('no browser was found; write the page to a file: prohull.view(..., path="view.html")')

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        png = base64.b64encode(self.picture).decode()
        bundle = {"text/plain": repr(self), "image/png": png}
        if self.html is not None:
            bundle["text/html"] = _IN_NOTEBOOK.format(png=png, alt=html.escape(", ".join(self.names)),
                                                      page=html.escape(self.html))
        return bundle

    def __repr__(self) -> str:
        what = "a picture only: " + _prohull.no_page if self.html is None else f"a page of {len(self.html) / 1e6:.1f} MB"
        return f"<prohull.View: {', '.join(self.names)}; {what}>"


def view(*shown: Viewable, original: Optional[MeshLike] = None, path: Optional[Path] = None, side: Side = "outer",
         solid_only: bool = False, unit: str = "", threads: int = 0, progress: Optional[Progress] = None) -> View:
    """Makes a page that shows hulls in any browser, in three dimensions, as `prohull view` does (docs/guides/view.md).

    The page is one file, which needs no other one and no network. Verdicts and counts on it are exact, distances are
    proven bounds.

    shown: hulls, covers, cages, robots and meshes of prohull, meshes of trimesh or Open3D, paths of mesh files, .phull
        files and robots; a list of meshes stands for convex pieces that cover together. Eight at most.
    original: the mesh that all of it is compared with. Unless given, it is that of the hulls, covers and cages, if all
        have the same. A hull with levels is compared with its finest level.
    path: a .html file for the page, which is written whole or not at all.
    side: "inner" if meshes lie inside of the original. Hulls and cages know their side.
    solid_only: as verify() has it.
    unit: of all coordinates, such as "mm", to be shown; robots are in metres.
    threads: the largest number of threads; 0 means one for each core. The page does not depend on it.
    progress: called as build() calls it.

    Where prohull was built without the page, because node or npm was not there, the view is a picture only. Raises
    InputError then if a path is given; for files that cannot be read, for meshes without a finite face, and for
    arguments that are not as above.

        prohull.view("hull.stl", original="part.stl", path="view.html")
    """
    _arrays.one_of("side", side, _prohull.sides)
    _check_path(path)
    parts = _distinct([part for given in shown for part in _parts_of(given)])
    if not parts:
        raise InputError("nothing to show; view() takes hulls, covers, robots, meshes or paths")
    compared = _common_original(shown) if original is None else mesh_of(original, keep_non_finite=True)
    is_robot = any(isinstance(part.core, _prohull.ShownRobot) for part in parts)
    page = None if _prohull.no_page else _prohull.page(
        [(part.name, part.core, part.side or side) for part in parts],
        None if compared is None else (_name_of(original), compared._core), bool(solid_only),
        unit or ("m" if is_robot else ""), _arrays.count("threads", threads), progress)
    if path is not None and page is not None:
        write_whole(pathlib.Path(_arrays.path(path)), page)
    return View([part.name for part in parts], page, _picture(parts[0], side, compared))


def open_view(shown: Viewable, progress: Optional[Progress]) -> View:
    """view(shown), which is opened in a browser unless a notebook shows it."""
    made = view(shown, progress=progress)
    if not _in_notebook():
        made.open()
    return made


def mesh_parts(mesh: Mesh, name: str = "mesh", side: Optional[Side] = None) -> list[Part]:
    return [Part(name, mesh._core, mesh._picture, side)]


def _in_notebook() -> bool:
    """Whether values of cells are shown."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return getattr(shell, "kernel", None) is not None


def _check_path(path: Optional[Path]) -> None:
    if path is None:
        return
    if pathlib.Path(_arrays.path(path)).suffix.lower() not in (".html", ".htm"):
        raise InputError(f"{os.fspath(path)}: pages are written to files that end in .html or .htm")
    if _prohull.no_page:
        raise InputError(_prohull.no_page)


def _parts_of(given: Any) -> list[Part]:
    if hasattr(given, "_view_parts"):
        return list(given._view_parts())
    if isinstance(given, (str, os.PathLike)):
        return [_part_of_file(os.fspath(given))]
    is_list = isinstance(given, Sequence) and not isinstance(given, tuple)
    if is_list:
        return [pieces_part([mesh_of(piece)._core for piece in given])]
    return mesh_parts(mesh_of(given, keep_non_finite=True))


def pieces_part(pieces: list[_prohull.Mesh]) -> Part:
    return Part("convex pieces", pieces, lambda *size: _prohull.picture_of_parts(pieces, np.empty((0, 4)), *size))


def balls_part(balls: NDArray[np.float64]) -> Part:
    return Part("spheres", balls, lambda *size: _prohull.picture_of_parts([], balls, *size))


def levels_part(name: str, levels: _prohull.Levels, picture: Optional[Callable[[int, int], bytes]] = None) -> Part:
    def drawn(width: int, height: int) -> bytes:
        ends = levels.level(0), levels.level(levels.original_face_count)
        around, inside = reversed(ends) if levels.is_inner else ends
        return _prohull.picture(around, inside, width, height)

    return Part(name, levels, picture or drawn)


def _name_of_file(path: Path) -> str:
    """As UTF-8 has it, whatever bytes the name has."""
    return os.fsencode(pathlib.Path(path).name).decode("utf-8", "replace")


def _part_of_file(path: str) -> Part:
    name = _name_of_file(path)
    if _prohull.is_hull_file(_arrays.path(path)):
        return levels_part(name, _prohull.load(path))
    if _prohull.is_robot_file(path):
        robot = _prohull.read_robot(path, [])
        return Part(name, robot.shown(), lambda *size: robot.picture([0.0] * len(robot.joints), *size))
    return mesh_parts(mesh_of(path, keep_non_finite=True), name)[0]


def _distinct(parts: list[Part]) -> list[Part]:
    """With numbers behind names that occur again."""
    names = [part.name for part in parts]
    return [part if names.count(part.name) == 1 else part._replace(name=f"{part.name} ({names[:i].count(part.name) + 1})")
            for i, part in enumerate(parts)]


def _common_original(shown: Sequence[Any]) -> Optional[Mesh]:
    """The mesh that all of them are hulls or covers of; None if a page compares the only one with itself."""
    if len(shown) == 1 and getattr(shown[0], "_is_own_original", False):
        return None
    originals = [getattr(given, "original", None) for given in shown]
    first = originals[0] if originals else None
    if not isinstance(first, Mesh):
        return None
    return first if all(isinstance(other, Mesh) and _is_equal(first, other) for other in originals) else None


def _is_equal(a: Mesh, b: Mesh) -> bool:
    return a._core is b._core or (np.array_equal(a.vertices, b.vertices, equal_nan=True)
                                  and np.array_equal(a.faces, b.faces))


def _name_of(original: Optional[MeshLike]) -> str:
    return _name_of_file(original) if isinstance(original, (str, os.PathLike)) else "original"


def _picture(part: Part, side: Side, compared: Optional[Mesh]) -> bytes:
    if compared is None or not isinstance(part.core, _prohull.Mesh):
        return part.picture(_WIDTH, _HEIGHT)
    both = part.core, compared._core
    around, inside = reversed(both) if (part.side or side) == "inner" else both
    return _prohull.picture(around, inside, _WIDTH, _HEIGHT)
