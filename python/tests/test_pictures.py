import struct
import zlib

import numpy as np
import prohull
import pytest


def decoded(png):
    """The size of a picture, and how many of its bytes are not white."""
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = struct.unpack(">II", png[16:24])
    data, at = b"", 8
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        data += png[at + 8:at + 8 + length] if kind == b"IDAT" else b""
        at += 12 + length
    return (width, height), np.count_nonzero(np.frombuffer(zlib.decompress(data), np.uint8))


def test_notebooks_show_hulls_and_meshes(hull, pony):
    for shown in (hull, pony, prohull.build(pony, 300, side="inner")):
        size, drawn = decoded(shown._repr_png_())
        assert size == (400, 300) and drawn > 10000
    alone = prohull.Mesh(hull.vertices, hull.faces)
    assert hull.picture(80, 60) != alone.picture(80, 60), "a hull is drawn around its original"


def test_pictures_have_sizes(cube):
    assert decoded(prohull.Mesh(*cube).picture(80, 60))[0] == (80, 60)
    for size in ((0, 10), (10, 20000)):
        with pytest.raises(prohull.InputError, match="a picture of"):
            prohull.Mesh(*cube).picture(*size)


def test_of_nothing_there_is_no_picture():
    nothing = prohull.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert nothing._repr_png_() is None
    with pytest.raises(prohull.InputError):
        nothing.picture()


def test_reprs_say_what_it_is(hull, cube):
    assert repr(prohull.Mesh(*cube)) == "<prohull.Mesh: 8 vertices, 12 faces, size 2 x 2 x 2>"
    assert repr(hull).startswith("<prohull.Hull: outer, 300 faces, void ") and repr(hull).endswith(" %, certified by replay>")
    assert repr(prohull.Mesh(cube[0][:3], [[0, 1, 2]])).startswith("<prohull.Mesh: 3 vertices, 1 face, size ")
    assert repr(prohull.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))) == "<prohull.Mesh: 0 vertices, 0 faces, size 0>"
