"""Cages: nested hulls that keep a gap."""

import prohull
import pytest


def test_hulls_are_nested_and_keep_the_gap(pony):
    made = prohull.cage(pony, 300, inner_faces=300, gap=0.004)
    for hull in (made.outer, made.inner):
        assert hull.certified and hull.is_disjoint and hull.verdict.gap > 0 and hull.is_closed and hull.target_reached
    assert made.gap == 0.004 and made.outer.verdict.gap >= 0.004
    assert made.outer.void_ratio > 0 > made.inner.void_ratio
    assert prohull.verify(made.outer, pony) and prohull.verify(made.inner, pony, side="inner")


def test_triangles_are_even_on_demand():
    made = prohull.cage(prohull.sample("torus", 800), 200, even=True)
    assert made.inner is None and made.notes == []
    assert made.outer.smallest_angle_degrees > 17 and made.outer.worst_aspect_ratio < 4.7


def test_wrong_arguments_are_named():
    for faces in (-1, 0, 3):
        with pytest.raises(prohull.InputError, match=f"faces={faces}: expected a whole number, at least 4"):
            prohull.cage(prohull.sample("torus", 800), faces)
    with pytest.raises(prohull.InputError, match="gap"):
        prohull.cage(prohull.sample("torus", 800), gap=-1)
    with pytest.raises(prohull.InputError, match="missing.stl"):
        prohull.cage("missing.stl")
