"""What editors complete and mypy checks. Skipped without mypy, but for what needs none."""

import inspect
import pathlib
import re
import subprocess
import sys
import typing

import prohull
import pytest
from prohull import _prohull, _types

HERE = pathlib.Path(__file__).parent
PACKAGE = pathlib.Path(prohull.__file__).parent

# Reading the whole of dask took 17 of 20 seconds, to find the types of one client and its futures.
SETTINGS = """[mypy]
[mypy-dask.*,distributed.*]
follow_imports = skip
"""


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    cache = tmp_path_factory.mktemp("mypy")
    (cache / "mypy.ini").write_text(SETTINGS)
    return lambda *arguments: run_mypy(cache, *arguments)


def run_mypy(cache, *arguments):
    pytest.importorskip("mypy", reason="types are not checked: mypy is not installed (python3-mypy)")
    run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--config-file", cache / "mypy.ini", "--cache-dir", cache,
                          *arguments], text=True, capture_output=True, env={"MYPYPATH": str(PACKAGE.parent)})
    assert run.returncode in (0, 1), run.stdout + run.stderr
    return run.stdout


def test_mypy_refuses_wrong_names_and_values(mypy):
    calls = HERE / "typed_calls.py"
    found = mypy("--follow-imports=silent", calls)
    wrong = {i for i, line in enumerate(calls.read_text().splitlines(), 1) if line.endswith("# refused")}
    told = {int(line) for line in re.findall(r"typed_calls\.py:(\d+): error", found)}
    assert told == wrong, found


def test_the_package_itself_is_typed(mypy):
    found = mypy("--ignore-missing-imports", *PACKAGE.glob("*.py"))
    assert found.startswith("Success"), found


@pytest.mark.skipif(not hasattr(typing, "get_overloads"), reason="Python 3.11 or later tells overloads")
def test_every_way_to_call_build_has_the_same_options():
    def options(function):
        return {p.name: p.annotation for p in inspect.signature(function).parameters.values() if p.kind is p.KEYWORD_ONLY}

    ways = typing.get_overloads(prohull.build)
    assert len(ways) == 4 and all(options(way) == options(prohull.build) for way in ways)


@pytest.mark.parametrize("names", ["axes", "engines", "sides", "strategies", "repairs", "open_shells", "piece_shapes",
                                   "sources", "self_intersections"])
def test_names_are_those_of_the_library(names):
    types = dict(axes=_types.Axis, engines=_types.EngineName, sides=_types.Side, strategies=_types.Strategy, repairs=_types.Repair,
                 open_shells=_types.OpenShells, piece_shapes=_types.PieceShape, sources=_types.Source,
                 self_intersections=_types.SelfIntersections)
    assert typing.get_args(types[names]) == getattr(_prohull, names)
