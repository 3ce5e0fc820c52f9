"""The command line that the package brings."""

import subprocess
import sys

import prohull


def program(*arguments):
    return subprocess.run([sys.executable, "-m", "prohull", *arguments], capture_output=True, text=True)


def test_the_module_runs_the_program(tmp_path):
    part, hull = tmp_path / "part.stl", tmp_path / "hull.stl"
    assert program("sample", "box", "-o", str(part), "--faces", "200").returncode == 0
    assert "certified: yes" in program("build", str(part), "--faces", "50", "-o", str(hull)).stdout
    assert program("verify", str(hull), str(part)).returncode == 0
    assert program("verify", str(part), str(hull)).returncode == 1


def test_package_and_program_have_one_version():
    assert prohull.__version__ in program("--version").stdout
