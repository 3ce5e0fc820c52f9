import math

import numpy as np
import prohull
import pytest


def turned(vertices, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return vertices @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def is_in_a_piece(points, sweep):
    """Of each point whether it lies in one of the convex pieces, but for rounding."""
    inside = np.zeros(len(points), dtype=bool)
    for piece in sweep.pieces:
        a, b, c = (piece.vertices[piece.faces[:, i]] for i in range(3))
        normals = np.cross(b - a, c - a)
        heights = points @ normals.T - np.einsum("ij,ij->i", normals, a)
        inside |= (heights <= 1e-12 * np.linalg.norm(normals, axis=1)).all(axis=1)
    return inside


def test_a_turn_is_enclosed_at_all_moments(cube, random):
    sweep = prohull.sweep(cube, axis="z", through=(1, 0, 0), angle=70, max_distance="1%")
    corners, center = np.array(cube[0], dtype=float), np.array([1, 0, 0])
    for degrees in random().uniform(0, 70, 50):
        assert is_in_a_piece(center + turned(corners - center, degrees), sweep).all()
    assert not is_in_a_piece(center + turned(corners - center, 80), sweep).all()
    assert sweep.verdict and sweep.verdict.encloses_solid and sweep.verdict.cap_faces == 0 and 8 < sweep.volume < 30 and 0 < sweep.verdict.distance_bound < 0.1
    assert prohull.verify_union(sweep.pieces, cube)


def test_poses_are_as_good_as_a_turn(cube, tmp_path):
    turn = np.eye(4)
    turn[:2, :2] = [[0, -1], [1, 0]]
    by_matrices = prohull.sweep(cube, poses=[np.eye(4), turn])
    (tmp_path / "poses.csv").write_bytes(b"\xef\xbb\xbf0,0,0,1,0,0,0\n0,0,0,0.7071067811865476,0,0,0.7071067811865476\n")
    by_file = prohull.sweep(cube, poses=tmp_path / "poses.csv")
    by_turn = prohull.sweep(cube, angle=90)
    assert len(by_matrices.pieces) == len(by_file.pieces) == len(by_turn.pieces)
    assert by_matrices.volume == pytest.approx(by_turn.volume, rel=1e-3) == by_file.volume


def test_pieces_are_saved_and_enclosed(cube, tmp_path):
    sweep = prohull.sweep(cube, move=(0, 0, 5), float32_coordinates=True, threads=1)
    sweep.save(tmp_path / "zone.glb")
    assert len(prohull.read(tmp_path / "zone.glb").faces) == len(sweep.mesh.faces)
    hull = prohull.build(sweep.mesh, 100)
    assert hull.certified and prohull.verify(hull, cube) and sweep.picture().startswith(b"\x89PNG")
    with pytest.raises(prohull.InputError, match="float32_coordinates=True"):
        prohull.sweep(cube, axis=(1, 2, 3), angle=5).save(tmp_path / "zone.glb")


@pytest.mark.parametrize("options, message", [
    ({}, "how does the mesh move"),
    ({"angle": math.nan}, "not finite|finite"),
    ({"angle": 5, "axis": "w"}, "axis='w': expected"),
    ({"angle": 5, "axis": (0, 0, 0)}, "axis"),
    ({"angle": 5, "through": (0, 0)}, "through=.*: expected three numbers"),
    ({"move": "up"}, "move='up': expected three numbers"),
    ({"angle": 5, "pieces": 0}, "pieces=0: expected a whole number, at least 1"),
    ({"angle": 5, "max_distance": -1}, "max_distance=-1: expected"),
    ({"angle": 5, "max_distance": 0}, "max_distance=0: expected a distance greater than 0"),
    ({"angle": 5, "max_distance": "0%"}, "max_distance='0%': expected a distance greater than 0"),
    ({"angle": "90"}, "angle='90': expected a number"),
    ({"angle": 5, "axis": [1, [2], 3]}, "axis: rows of different lengths"),
    ({"poses": [np.eye(4)], "angle": 5}, "by poses, or by axis"),
    ({"poses": [np.eye(4)], "move": (0, 0, 1)}, "by poses, or by axis"),
    ({"poses": np.zeros((0, 4, 4))}, "poses: there are none"),
    ({"poses": np.full((2, 4, 4), math.nan)}, "poses"),
    ({"poses": np.diag([2.0, 1, 1, 1])}, "rotation|rigid"),
    ({"poses": np.ones((3, 3))}, "poses: an array of shape")])
def test_what_is_wrong_with_a_motion_is_told(cube, options, message):
    with pytest.raises(prohull.InputError, match=message):
        prohull.sweep(cube, **options)


def test_the_name_of_a_file_stands_in_errors(tmp_path):
    (tmp_path / "poses.csv").write_bytes(b"\xff\n")
    with pytest.raises(prohull.InputError, match="poses.csv: there are no poses"):
        prohull.sweep(prohull.sample("box", 12), poses=tmp_path / "poses.csv")
    (tmp_path / "flat.off").write_text("OFF\n1 0 0\n0 0 0\n")
    with pytest.raises(prohull.InputError, match="flat.off: "):
        prohull.sweep(tmp_path / "flat.off", angle=5)


def test_files_that_are_not_there_are_input_errors_too(cube, tmp_path):
    for error in (prohull.InputError, FileNotFoundError):
        with pytest.raises(error, match="poses.csv: cannot read: there is no such file"):
            prohull.sweep(cube, poses=tmp_path / "poses.csv")
    with pytest.raises(prohull.InputError, match="cannot read: Is a directory"):
        prohull.sweep(cube, poses=tmp_path)
