import pathlib
import sys

import numpy as np
import prohull
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tests"))
from seed import REPLAY, SEED  # noqa: E402


def pytest_terminal_summary(terminalreporter):
    terminalreporter.write_line(REPLAY)


@pytest.fixture(scope="session")
def random():
    """A generator of the same numbers each time; PROHULL_TEST_SEED chooses others."""
    return lambda: np.random.default_rng(SEED)


@pytest.fixture(scope="session")
def pony():
    return prohull.sample("pony", 2000)


@pytest.fixture(scope="session")
def hull(pony):
    return prohull.build(pony, target_faces=300, levels=True)


@pytest.fixture(scope="session")
def part_of_two(pony):
    """A pony with a ball that crosses it."""
    ball = prohull.sample("sphere", 300)
    size = np.ptp(pony.vertices, axis=0).min() / 2
    middle = (pony.vertices.min(axis=0) + pony.vertices.max(axis=0)) / 2
    return prohull.Mesh(np.vstack([pony.vertices, middle + size * ball.vertices]),
                        np.vstack([pony.faces, ball.faces + len(pony.vertices)]))


@pytest.fixture
def cube():
    """Of side 2 around the origin."""
    vertices = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                      [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    return vertices, faces
