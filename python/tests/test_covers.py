"""Convex pieces and balls that cover, and proofs of unions."""

import math
import pickle

import numpy as np
import prohull
import pytest


@pytest.fixture(scope="module")
def small():
    return prohull.sample("torus", 200)


@pytest.fixture(scope="module")
def pieces(pony):
    return prohull.convex_pieces(pony, 4, vertices=32)


@pytest.fixture(scope="module")
def balls(pony):
    return prohull.spheres(pony, 16)


def test_convex_pieces_cover(pieces, pony):
    assert pieces.certified and pieces.verdict.encloses_solid and pieces.within_bounds
    assert 2 <= len(pieces.pieces) <= 4
    assert all(len(piece.vertices) <= 32 and piece.is_closed and piece.volume > 0 for piece in pieces.pieces)
    assert all(piece.primitive is None for piece in pieces.pieces)
    assert 0 <= pieces.verdict.distance_to_solid[0] <= pieces.verdict.distance_bound and pieces.void_ratio > 0
    assert f"{len(pieces.pieces)} convex pieces" in repr(pieces) and "certified" in repr(pieces)


def test_unions_are_verified(pieces, pony):
    found = prohull.verify_union(pieces, pony)
    assert found and found.original_closed and found.faces_outside == 0 and found.worst == []
    assert found.void_ratio == pytest.approx(pieces.void_ratio, rel=1e-5)
    found = prohull.verify_union(pieces.pieces[:1], pony)
    assert not found and found.why_not and found.faces_outside > 0
    assert found.worst[0].point.shape == (3,) and found.worst[0].distance > 0


def test_pieces_of_others_are_verified(cube, tmp_path):
    """Two halves of a cube touch along a wall; each is given in another way."""
    vertices, faces = np.array(cube[0], dtype=float), cube[1]
    left, right = vertices.copy(), vertices.copy()
    left[vertices[:, 0] > 0, 0] = 0
    right[vertices[:, 0] < 0, 0] = 0
    prohull.Mesh(left, faces).save(tmp_path / "left.stl")
    halves = [tmp_path / "left.stl", (right, faces)]
    found = prohull.verify_union(halves, cube)
    assert found and found.union_volume == pytest.approx(8)
    right[:, 0] = np.maximum(right[:, 0], np.nextafter(0, 1))
    assert not prohull.verify_union(halves, cube)


def test_balls_cover(balls, pony):
    assert balls.certified and balls.balls.shape == (len(balls.radii), 4) and len(balls.radii) <= 16
    assert balls.centers.shape == (len(balls.radii), 3) and (balls.radii > 0).all()
    assert "balls" in repr(balls)
    assert prohull.verify_union(balls, pony) and prohull.verify_union(balls.balls.tolist(), pony)
    smaller = balls.balls * [1, 1, 1, 0.5]
    assert prohull.verify_union(smaller, pony).faces_outside > 0


def test_balls_fill(pony):
    filled = prohull.spheres(pony, 32, fill=True)
    assert filled.certified and filled.verdict.encloses_solid and prohull.verify_union(filled, pony, inside=True)


def test_bounds_are_kept(small):
    size = np.linalg.norm(np.ptp(small.vertices, axis=0))
    cover = prohull.convex_pieces(small, 8, max_distance=0.2 * size)
    assert cover.within_bounds and cover.verdict.distance_bound <= 0.2 * size and len(cover.pieces) < 8
    missed = prohull.convex_pieces(small, 1, max_void_percent=1)
    assert not missed.within_bounds and any("not within the bounds" in note for note in missed.notes)
    assert not prohull.spheres(small, 2, max_distance=0.05 * size).within_bounds


@pytest.mark.parametrize("shape, kind", [("box", prohull.OrientedBox), ("capsule", prohull.Capsule), ("sphere", prohull.Ball)])
def test_pieces_may_be_primitives(small, shape, kind):
    cover = prohull.convex_pieces(small, 2, shape=shape)
    assert cover.certified and all(isinstance(piece.primitive, kind) for piece in cover.pieces)


def test_a_box_encloses_its_piece(small):
    for piece in prohull.convex_pieces(small, 2, shape="box").pieces:
        box = piece.primitive
        assert box.axes @ box.axes.T == pytest.approx(np.eye(3), abs=1e-9)
        inside = np.abs((piece.vertices - box.center) @ box.axes.T)
        assert (inside <= box.half_sizes * (1 + 1e-6)).all()


def test_pieces_are_saved(pieces, pony, tmp_path):
    pieces.save(tmp_path / "pony.obj")
    assert (tmp_path / "pony.obj").read_text().count("\no pony_") + 1 >= len(pieces.pieces)
    assert len(prohull.read(tmp_path / "pony.obj").faces) == sum(len(piece.faces) for piece in pieces.pieces)
    with pytest.raises(prohull.InputError, match="pony.glb: .*float32_coordinates=True"):
        pieces.save(tmp_path / "pony.glb")
    with pytest.raises(prohull.InputError, match="pony.off"):
        pieces.save(tmp_path / "pony.off")


def test_float32_coordinates(small, tmp_path):
    cover = prohull.convex_pieces(small, 2, float32_coordinates=True)
    assert all(np.array_equal(piece.vertices, piece.vertices.astype(np.float32)) for piece in cover.pieces)
    cover.save(tmp_path / "pieces.glb")
    cover.pieces[0].save(tmp_path / "piece.stl")


def test_whatever_is_a_mesh_is_covered(cube, tmp_path):
    prohull.Mesh(*cube).save(tmp_path / "cube.ply")
    for mesh in (tmp_path / "cube.ply", str(tmp_path / "cube.ply"), cube, prohull.Mesh(*cube)):
        cover = prohull.convex_pieces(mesh, 1)
        assert cover.certified and cover.volume == pytest.approx(8)
        assert prohull.spheres(mesh, 1).certified


def test_triangles_that_are_not_finite_are_left_out(cube):
    vertices = np.vstack([cube[0], [[np.nan, 0, 0]]])
    mesh = vertices, np.vstack([cube[1], [[0, 1, 8]]])
    assert prohull.convex_pieces(mesh, 1).certified and prohull.spheres(mesh, 1).certified


def test_threads_do_not_change_covers(small, pony, balls):
    one, two = (prohull.convex_pieces(small, 3, threads=threads) for threads in (1, 2))
    assert len(one.pieces) == len(two.pieces)
    assert all(np.array_equal(a.vertices, b.vertices) for a, b in zip(one.pieces, two.pieces))
    assert np.array_equal(prohull.spheres(pony, 16, threads=1).balls, balls.balls)


def test_covers_are_pickled(pieces, balls, pony):
    copy = pickle.loads(pickle.dumps(pieces))
    assert repr(copy) == repr(pieces) and prohull.verify_union(copy, pony)
    assert np.array_equal(pickle.loads(pickle.dumps(balls)).balls, balls.balls)


def test_spheres_are_saved(balls, tmp_path):
    balls.save(tmp_path / "forearm.yaml")
    yaml = pytest.importorskip("yaml", reason="files of spheres are not read: PyYAML is not installed")
    spheres = yaml.safe_load((tmp_path / "forearm.yaml").read_text())["collision_spheres"]
    assert list(spheres) == ["forearm"]
    rows = [[*sphere["center"], sphere["radius"]] for sphere in spheres["forearm"]]
    assert np.array_equal(rows, balls.balls)
    balls.save(tmp_path / "other.yml", link="wrist")
    assert "wrist" in (tmp_path / "other.yml").read_text()
    with pytest.raises(prohull.InputError, match="spheres.txt: .*yaml"):
        balls.save(tmp_path / "spheres.txt")
    with pytest.raises(prohull.InputError, match="none"):
        balls.save(tmp_path / "none" / "spheres.yaml")


@pytest.mark.parametrize("work", [
    lambda mesh, progress: prohull.convex_pieces(mesh, 8, progress=progress),
    lambda mesh, progress: prohull.spheres(mesh, 64, progress=progress),
    lambda mesh, progress: prohull.verify_union(np.tile([0, 0, 0, 9], (100, 1)), mesh, progress=progress),
])
def test_progress_is_told_and_can_stop(small, work):
    told = []
    work(small, lambda *state: told.append(state))
    assert told[0] == ("start", 0.0) and told[-1] == ("done", 1.0)
    with pytest.raises(KeyboardInterrupt, match="progress returned False"):
        work(small, lambda stage, fraction: False)


@pytest.mark.parametrize("function, options, message", [
    (prohull.convex_pieces, {"pieces": 0}, "pieces=0: expected a whole number, at least 1"),
    (prohull.convex_pieces, {"pieces": 10**12}, "pieces=1000000000000: .* less than 2\\^32"),
    (prohull.convex_pieces, {"pieces": "many"}, "pieces='many': expected a whole number"),
    (prohull.convex_pieces, {"vertices": 3}, "vertices=3: expected a whole number, at least 4"),
    (prohull.convex_pieces, {"max_distance": -1}, "max_distance=-1: expected a number greater than 0"),
    (prohull.convex_pieces, {"max_distance": 0}, "max_distance=0: expected a number greater than 0"),
    (prohull.convex_pieces, {"max_void_percent": 0}, "max_void_percent=0: expected a number greater than 0"),
    (prohull.convex_pieces, {"max_void_percent": np.nan}, "max_void_percent=nan"),
    (prohull.convex_pieces, {"shape": "egg"}, "shape='egg': expected one of polytope, box, capsule, sphere"),
    (prohull.convex_pieces, {"float32_coordinates": "yes"}, "float32_coordinates='yes': expected True or False"),
    (prohull.spheres, {"count": 0}, "count=0: expected a whole number, at least 1"),
    (prohull.spheres, {"count": 1.5}, "count=1.5: expected a whole number"),
    (prohull.spheres, {"max_distance": 0}, "max_distance=0: expected a number greater than 0"),
    (prohull.spheres, {"fill": "yes"}, "fill='yes': expected True or False"),
])
def test_wrong_options_are_named(cube, function, options, message):
    with pytest.raises(prohull.InputError, match=message):
        function(cube, **options)


def test_wrong_meshes_are_named(cube, tmp_path):
    (tmp_path / "empty.off").write_text("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n")
    for function in (prohull.convex_pieces, prohull.spheres):
        with pytest.raises(prohull.InputError, match="expected the path of a file, vertices and faces"):
            function(cube[0], 8)
        with pytest.raises(prohull.InputError, match="empty.off: "):
            function(tmp_path / "empty.off")
        with pytest.raises(prohull.InputError, match="none.stl"):
            function(tmp_path / "none.stl")


@pytest.mark.parametrize("pieces, message", [
    ([], "piece"),
    ("part.stl", "pieces: 'part.stl' is one mesh; expected a sequence of them, or balls"),
    (np.zeros((4, 3)), r"balls: an array of shape \(4, 3\); expected \(n, 4\)"),
    ([[0, 0, 0, np.nan]], ""),
    ([[0, 0, 0, -1]], ""),
    (3, r"balls: an array of shape \(\)"),
])
def test_wrong_unions_are_named(cube, pieces, message):
    with pytest.raises(prohull.InputError, match=message):
        prohull.verify_union(pieces, cube)


def test_open_pieces_are_refused(cube):
    with pytest.raises(prohull.InputError):
        prohull.verify_union([(cube[0], cube[1][1:])], cube)


def test_all_products_have_one_record(pony, tmp_path):
    ball = prohull.sample("sphere", 100)
    made = [prohull.build(ball, 40), prohull.convex_pieces(ball, 2), prohull.spheres(ball, 8), prohull.cage(ball, 40).outer,
            prohull.repair(ball), prohull.sweep(ball, angle=0.1)]
    for product in made:
        assert isinstance(product.verdict, prohull.Verdict) and product.verdict and product.verdict.original_closed, product
        assert product.verdict.covers_triangles and product.verdict.why_not == "" and product.verdict.cap_faces == 0
    assert made[2].verdict.encloses_solid is None and made[3].verdict.gap > 0 and made[0].verdict.gap is None
    assert math.isnan(made[4].verdict.distance_bound) and made[1].verdict.distance_bound > 0
    assert isinstance(prohull.verify_union(made[1], ball), prohull.Verdict) and not prohull.verify(ball, made[0])


def test_verify_union_ends_after_so_many_steps(pony):
    cover = prohull.spheres(pony, 16)
    found = prohull.verify_union(cover, pony, steps=1)
    assert not found and found.covers_triangles is None and found.faces_undecided > 0
    assert prohull.verify_union(cover, pony, steps=10**9)
