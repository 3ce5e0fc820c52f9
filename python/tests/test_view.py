"""Pages that show hulls: in notebooks, in browsers, and as files. What is on them, tests/view/ looks at in a browser."""

import base64
import html
import json
import os
import pathlib
import re
import sys
import types

import numpy as np
import prohull
import pytest
from prohull import _prohull

needs_page = pytest.mark.skipif(bool(_prohull.no_page), reason=_prohull.no_page)


def scene(page):
    return json.loads(re.search(r'id="scene">(.*?)</script>', page, re.S)[1])


def objects(view):
    return [(o["name"], o["kind"]) for o in scene(view.html)["objects"]]


@pytest.fixture(scope="module")
def pieces(pony):
    return prohull.convex_pieces(pony, 3)


@pytest.fixture
def notebook(monkeypatch):
    """As if a kernel of Jupyter ran this."""
    shell = types.SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: shell))
    monkeypatch.setattr("webbrowser.open", lambda url: pytest.fail("a notebook shows the value of its cell"))


@pytest.fixture
def opened(monkeypatch):
    """The files that a browser would have been given."""
    files = []
    monkeypatch.setattr("webbrowser.open", lambda url: files.append(pathlib.Path(url.removeprefix("file://"))) or True)
    yield files
    for file in files:
        file.unlink()


@needs_page
def test_a_notebook_shows_the_page_and_has_a_picture(hull, notebook):
    shown = hull.show()
    bundle = shown._repr_mimebundle_(include=None, exclude=None)
    assert set(bundle) == {"text/html", "image/png", "text/plain"}
    assert base64.b64decode(bundle["image/png"]).startswith(b"\x89PNG\r\n\x1a\n")
    frame = re.search(r'<iframe srcdoc="([^"]*)"([^>]*)>', bundle["text/html"])
    assert html.unescape(frame[1]) == shown.html, "the page is whole within the frame"
    assert 'sandbox="allow-scripts allow-downloads"' in frame[2], "it runs apart from the notebook"
    assert f'src="data:image/png;base64,{bundle["image/png"]}"' in bundle["text/html"]
    assert bundle["text/plain"].startswith("<prohull.View: outer hull; a page of ")


def test_without_the_page_there_is_still_a_picture(hull, notebook, monkeypatch, tmp_path):
    monkeypatch.setattr(_prohull, "no_page", "install nodejs and npm")
    shown = hull.show()
    assert set(shown._repr_mimebundle_()) == {"image/png", "text/plain"} and shown.html is None
    assert repr(shown) == "<prohull.View: outer hull; a picture only: install nodejs and npm>"
    with pytest.raises(prohull.InputError, match="install nodejs and npm"):
        prohull.view(hull, path=tmp_path / "view.html")
    assert list(tmp_path.iterdir()) == []


def test_elsewhere_a_browser_is_opened(hull, opened, monkeypatch):
    shown = hull.show()
    content = opened[0].read_bytes()
    assert content == (shown.picture if shown.html is None else shown.html.encode())
    monkeypatch.setattr("webbrowser.open", lambda url: False)
    with pytest.raises(RuntimeError, match="no browser was found; write the page to a file"):
        shown.open()


@needs_page
def test_the_file_is_the_page(hull, tmp_path):
    path = tmp_path / "view.html"
    path.write_text("old")
    made = prohull.view(hull, path=path)
    assert path.read_text(encoding="utf-8") == made.html and list(tmp_path.iterdir()) == [path]
    for wrong in (tmp_path / "view.png", tmp_path / "missing" / "view.html"):
        with pytest.raises(prohull.InputError):
            prohull.view(hull, path=wrong)
    assert list(tmp_path.iterdir()) == [path]


@needs_page
def test_what_a_hull_is_compared_with(hull, pony, tmp_path):
    assert objects(prohull.view(hull)) == [("outer hull", "levels")]
    level = hull.level(400)
    shown = prohull.view(hull, level)
    assert objects(shown) == [("outer hull (1)", "levels"), ("outer hull (2)", "mesh"), ("original", "mesh")]
    assert all(o["verification"]["encloses"] for o in scene(shown.html)["objects"][:2])
    inner = prohull.view(prohull.build(pony, 300, side="inner"))
    found = scene(inner.html)["objects"][0]["verification"]
    assert found["encloses"] and found["side"] == "inner"
    alone = prohull.Mesh(level.vertices, level.faces)
    assert objects(prohull.view(alone)) == [("mesh", "mesh")]
    assert objects(prohull.view(alone, hull)) == [("mesh", "mesh"), ("outer hull", "levels")]
    assert not scene(prohull.view(pony, original=alone).html)["objects"][0]["verification"]["encloses"]
    assert scene(prohull.view(pony, original=alone, side="inner").html)["objects"][0]["verification"]["encloses"]


@needs_page
def test_files_are_shown_under_their_names(hull, pony, tmp_path):
    hull.save(tmp_path / "pony.phull")
    hull.save(tmp_path / "hull.ply")
    pony.save(tmp_path / "pony.ply")
    assert objects(prohull.view(tmp_path / "pony.phull")) == [("pony.phull", "levels")]
    shown = prohull.view(tmp_path / "hull.ply", (hull.vertices, hull.faces), original=tmp_path / "pony.ply", unit="mm")
    assert objects(shown) == [("hull.ply", "mesh"), ("mesh", "mesh"), ("pony.ply", "mesh")]
    assert scene(shown.html)["unit"] == "mm"
    os.link(tmp_path / "hull.ply", os.fsencode(tmp_path) + b"/\xff.ply")
    assert objects(prohull.view(os.fsdecode(os.fsencode(tmp_path) + b"/\xff.ply"))) == [("\N{REPLACEMENT CHARACTER}.ply", "mesh")]


@needs_page
def test_faces_that_are_not_finite_are_left_out(tmp_path, cube):
    vertices, faces = cube
    broken = prohull.Mesh([*vertices, (np.nan, 0, 0)], [*faces, (0, 1, len(vertices))])
    shown = prohull.view(broken)
    assert scene(shown.html)["objects"][0]["left_out"] == 1 and shown.picture == prohull.view(cube).picture
    with pytest.raises(prohull.InputError, match="no finite face"):
        prohull.view(prohull.Mesh(broken.vertices, broken.faces[-1:]))


@needs_page
def test_covers_are_shown_with_what_they_cover(pieces, pony):
    shown = prohull.view(pieces)
    assert objects(shown) == [("convex pieces", "mesh"), ("original", "mesh")]
    assert scene(shown.html)["objects"][0]["verification"]["encloses"]
    balls = prohull.spheres(pony, 8)
    both = prohull.view(pieces, balls)
    assert objects(both) == [("convex pieces", "mesh"), ("spheres", "balls"), ("original", "mesh")]
    assert objects(prohull.view(pieces.pieces)) == [("convex pieces", "mesh")]
    assert scene(prohull.view(pieces.pieces).html)["objects"][0]["union"] == f"{len(pieces.pieces)} pieces"


def test_covers_have_pictures(pieces, pony):
    balls = prohull.spheres(pony, 8)
    assert pieces._repr_png_() != balls._repr_png_()
    for cover in (pieces, balls):
        assert cover.picture(80, 60).startswith(b"\x89PNG\r\n\x1a\n")
        assert len(cover.show.__doc__) > 0 and cover.original.faces.shape == pony.faces.shape


@needs_page
def test_both_hulls_of_a_cage_are_compared(cube):
    made = prohull.cage(cube, 30, inner_faces=12, gap=0.1)
    shown = prohull.view(made)
    assert objects(shown) == [("outer hull", "mesh"), ("inner hull", "mesh"), ("original", "mesh")]
    assert all(o["verification"]["encloses"] for o in scene(shown.html)["objects"][:2])


def test_hostile_names_are_text(hull):
    shown = prohull.View(['"><img src=x onerror=alert(1)>'], "<p>", hull.picture(8, 6))
    assert "<img src=x" not in shown._repr_mimebundle_()["text/html"]


def test_what_cannot_be_shown_is_said(cube):
    for wrong, message in (((), "nothing to show"), ((3,), "3 is no mesh"), (("missing.stl",), "missing.stl"),
                           (([],), "."), ((prohull.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)),), ".")):
        with pytest.raises(prohull.InputError, match=message):
            prohull.view(*wrong)
    with pytest.raises(prohull.InputError, match="side='up': expected one of outer, inner"):
        prohull.view(cube, side="up")
    if not _prohull.no_page:
        with pytest.raises(prohull.InputError, match="8 hulls at most"):
            prohull.view(*[cube] * 9)


@pytest.mark.parametrize("part", [None, [None]])
def test_nothing_is_no_part_of_a_page(part):
    with pytest.raises(TypeError, match="None cannot be shown"):
        _prohull.page([("nothing", part, None)], None, False, "", 1, None)
