"""STL and GLB files keep float32 coordinates: what is written there is rounded outwards, and certified again."""

import numpy as np
import prohull
import pytest


def is_float32(mesh):
    return np.array_equal(mesh.vertices, mesh.vertices.astype(np.float32))


@pytest.fixture
def part(pony):
    """Neither its vertices nor those of its hulls are float32 numbers."""
    return prohull.Mesh(pony.vertices / 3 + 0.1, pony.faces)


def test_names_may_be_bytes(cube, tmp_path):
    hull = prohull.build(prohull.Mesh(*cube), 12, levels=True)
    for name in ("hull.ply", "hull.stl", "hull.phull"):
        hull.save(bytes(tmp_path / name))
        assert (tmp_path / name).exists()
    prohull.spheres(hull, 2).save(bytes(tmp_path / "balls.yaml"))
    assert (tmp_path / "balls.yaml").exists()


@pytest.mark.parametrize("suffix", [".stl", ".GLB"])
@pytest.mark.parametrize("options", [{}, {"tight": True}, {"side": "inner"}, {"max_distance": 0.5}])
def test_a_hull_is_saved_certified(part, tmp_path, suffix, options):
    hull = prohull.build(part, 300, **options)
    assert hull.certified and not is_float32(hull)
    hull.save(tmp_path / f"hull{suffix}")
    written = prohull.read(tmp_path / f"hull{suffix}")
    assert prohull.verify(written, part, side=hull.side)
    rounded = hull.with_float32_coordinates()
    assert rounded.certified and rounded.proof == "enclosure" and rounded.rounded_vertices > 0 and rounded.within_bounds
    assert np.array_equal(written.vertices[written.faces], rounded.vertices[rounded.faces])
    assert abs(rounded.void_ratio) > abs(hull.void_ratio) and rounded.void_ratio == pytest.approx(hull.void_ratio, rel=0.05)
    assert rounded.with_float32_coordinates() is rounded


def test_a_level_is_saved_certified(part, tmp_path):
    level = prohull.build(part, 100, levels=True).level(300)
    assert level.certified and level.proof == "replay" and not is_float32(level)
    level.save(tmp_path / "level.stl")
    assert prohull.verify(tmp_path / "level.stl", part)


def test_a_loaded_hull_is_saved_certified(part, tmp_path):
    prohull.build(part, 100, levels=True).save(tmp_path / "hull.phull")
    prohull.load(tmp_path / "hull.phull").save(tmp_path / "hull.stl")
    assert prohull.verify(tmp_path / "hull.stl", part)


def test_the_hull_of_an_open_shell_is_saved_certified(part, tmp_path):
    lidless = (part.vertices, part.faces[50:])
    hull = prohull.build(*lidless, 500, open_shells="keep")
    assert hull.certified and not is_float32(hull)
    hull.save(tmp_path / "hull.stl")
    assert prohull.verify(tmp_path / "hull.stl", lidless) and hull.with_float32_coordinates().proof == "coverage"


def test_what_cannot_be_certified_any_more_is_not_written(part, tmp_path):
    hull = prohull.build(part, 300, max_distance=1.0)
    hull._bounds = (part._core, part.volume, hull.distance_bound / 2, np.inf)  # as if it had been at the very bound
    with pytest.raises(prohull.InputError, match="hull.stl: .*not within its bounds.* float32_coordinates=True, or save it as .ply"):
        hull.save(tmp_path / "hull.stl")
    hull = prohull.build(part, 300)
    hull._covered = prohull.Mesh([[9, 0, 0], [9, 1, 0], [9, 0, 1]], [[0, 1, 2]])._core
    with pytest.raises(prohull.InputError, match="hull.stl: .*does not provably enclose"):
        hull.save(tmp_path / "hull.stl")
    assert not list(tmp_path.iterdir())


def test_meshes_are_not_rounded(part, tmp_path):
    with pytest.raises(prohull.InputError, match="float32"):
        part.save(tmp_path / "part.stl")
    with pytest.raises(prohull.InputError, match="part.xyz"):
        part.save(tmp_path / "part.xyz")
