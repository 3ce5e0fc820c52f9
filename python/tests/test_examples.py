"""The docstring, the examples and the benchmark run; tests/docs/snippets.py runs what the pages show."""

import doctest
import pathlib
import subprocess
import sys

import prohull
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "python" / "examples"


def run(name, *arguments):
    return subprocess.run([sys.executable, str(EXAMPLES / name), *map(str, arguments)], text=True, check=True,
                          stdout=subprocess.PIPE).stdout


@pytest.mark.parametrize("name, arguments", [("batch.py", 0), ("collision_mesh.py", 1), ("deform.py", 3),
                                             ("levels_and_rays.py", 3), ("symmetrize.py", 3),
                                             ("void_plot.py", 0)])
def test_wrong_arguments_get_the_usage(name, arguments):
    done = subprocess.run([sys.executable, str(EXAMPLES / name), *["x"] * arguments], text=True, stderr=subprocess.PIPE)
    assert done.returncode == 2 and name in done.stderr and "Traceback" not in done.stderr


def test_docstring():
    assert doctest.testmod(prohull).failed == 0 < doctest.testmod(prohull).attempted


def test_collision_mesh(tmp_path):
    prohull.sample("bracket", 2000).save(tmp_path / "part.ply")
    assert "200 faces, void" in run("collision_mesh.py", tmp_path / "part.ply", tmp_path / "hull.stl")
    assert prohull.verify(tmp_path / "hull.stl", tmp_path / "part.ply")


def test_batch(tmp_path):
    for name in ("torus", "sphere"):
        prohull.sample(name, 1000).save(tmp_path / f"{name}.off")
    (tmp_path / "bad.stl").write_text("nothing")
    printed = run("batch.py", tmp_path, tmp_path / "out", 300)
    assert [line.split()[0] for line in printed.splitlines()] == ["REFUSED", "ok", "ok"]
    assert prohull.verify(tmp_path / "out" / "torus.off.stl", tmp_path / "torus.off")


def test_links_with_openings_have_a_void(tmp_path):
    """Openings get caps, so that what is left out of a torus counts as inside."""
    torus = prohull.sample("torus", 1000)
    prohull.Mesh(torus.vertices, torus.faces[20:]).save(tmp_path / "link.off")
    line = run("batch.py", tmp_path, tmp_path / "out", 300)
    assert line.startswith("ok") and "nan" not in line, line


@pytest.mark.parametrize("name", ["collision_mesh.py", "batch.py"])
def test_without_arguments_examples_say_how_to_call_them(name):
    called = subprocess.run([sys.executable, str(EXAMPLES / name)], text=True, capture_output=True)
    assert called.returncode == 2 and called.stderr.startswith("usage: " + name), called.stderr


def test_a_cage_carries_its_mesh_along(tmp_path):
    prohull.sample("torus", 800).save(tmp_path / "torus.ply")
    printed = run("deform.py", tmp_path / "torus.ply", tmp_path / "twisted.ply", "--cage", tmp_path / "cage")
    error = float(printed.splitlines()[1].split(": ")[1])
    assert error < 1e-8, printed
    before, after = prohull.read(tmp_path / "torus.ply"), prohull.read(tmp_path / "twisted.ply")
    assert after.volume == pytest.approx(before.volume, rel=0.2)
    assert not (after.vertices == before.vertices).all()
    assert prohull.verify(tmp_path / "cage_before.obj", tmp_path / "torus.ply")


def test_a_mesh_becomes_symmetric(tmp_path):
    prohull.sample("pony", 2000).save(tmp_path / "pony.ply")
    assert "symmetric along y" in run("symmetrize.py", tmp_path / "pony.ply", tmp_path / "symmetric.ply", "--axis", "y")
    symmetric = prohull.read(tmp_path / "symmetric.ply")
    assert symmetric.volume == pytest.approx(prohull.read(tmp_path / "pony.ply").volume, rel=0.02)
    assert prohull.build(symmetric, 200, mirror="y").certified


def test_levels_and_rays():
    assert run("levels_and_rays.py").count("hit") == 4


def test_python_asks_as_cpp_does(tmp_path):
    """The answers of both are compared; of times nothing is expected here."""
    pytest.importorskip("prohull_cpp_batch", reason="the benchmark of batches was not built")
    prohull.sample("torus", 2000).save(tmp_path / "torus.ply")
    subprocess.run([sys.executable, ROOT / "bench" / "python_batch.py", "--mesh", tmp_path / "torus.ply", "--faces", "500",
                    "--segments", "2000", "--repeat", "1", "--out", tmp_path], check=True, stdout=subprocess.DEVNULL)
    lines = (tmp_path / "python.csv").read_text().splitlines()
    assert lines[0].endswith("cpp_ms,python_ms,ratio") and len(lines) == 1 + 4 * 3 * 2


def test_void_plot(tmp_path):
    pytest.importorskip("matplotlib")
    prohull.sample("torus", 800).save(tmp_path / "torus.ply")
    run("void_plot.py", tmp_path / "void.png", tmp_path / "torus.ply")
    assert (tmp_path / "void.png").read_bytes().startswith(b"\x89PNG")
