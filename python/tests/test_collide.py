import pickle

import numpy as np
import prohull
import pytest


def moved(*translation):
    pose = np.eye(4)
    pose[:3, 3] = translation
    return pose


@pytest.fixture
def box(cube):
    return prohull.Collider(prohull.Mesh(*cube))  # [-1, 1]^3


def test_one_pose_gives_one_answer(box, cube):
    assert box.collides(box) is True and box.is_solid
    assert box.collides(box, moved(2, 0, 0)) is True, "touching counts"
    assert box.collides(box, moved(np.nextafter(2, 3), 0, 0)) is False
    assert box.collides(cube, moved(3, 0, 0)) is False, "vertices and faces"
    assert box.collides(prohull.Mesh(cube[0] * 0.1, cube[1])) is True, "inside"
    assert box.collides(box, moved(3, 0, 0), own_poses=moved(1.5, 0, 0)) is True


@pytest.mark.parametrize("protocol", [0, 1, 5])
def test_colliders_are_pickled(box, tmp_path, protocol):
    assert pickle.loads(pickle.dumps(box, protocol)).distances(box, moved(3, 0, 0)).upper[0] == pytest.approx(1)
    prohull.sample("box", 12).save(tmp_path / "box.ply")
    of_file = pickle.dumps(prohull.Collider(tmp_path / "box.ply"), protocol)
    (tmp_path / "box.ply").unlink()
    assert pickle.loads(of_file).collides(box) is True
    levels = prohull.build(prohull.sample("box", 100), 12, levels=True)
    levels.save(tmp_path / "box.phull")
    copy = pickle.loads(pickle.dumps(prohull.Collider(tmp_path / "box.phull"), protocol))
    assert copy.collides(box, conservative=True) is True


def test_many_poses_give_an_array(box):
    poses = np.array([moved(x, 0, 0) for x in (0, 1.5, 2.5, 4)])
    assert box.collides(box, poses).tolist() == [True, True, False, False]
    assert box.collides(box, poses[:1]).tolist() == [True], "one in an array is an array"
    assert box.collides(box, poses, own_poses=poses).all()
    assert box.collides(box, own_poses=poses, threads=1).tolist() == [True, True, False, False]
    assert box.collides(box, np.zeros((0, 4, 4))).shape == (0,)


def test_face_pairs(box, cube):
    found = box.intersecting_faces(box, np.array([moved(5, 0, 0), moved(1, 1, 1), moved(0, 5, 0)]))
    assert found.offsets[0] == found.offsets[1] == 0 and found.offsets[2] == found.offsets[3] == len(found.pairs) > 0
    assert found.pairs.dtype == np.int64 and found.pairs.shape[1] == 2
    assert sorted(map(tuple, found.pairs)) == list(map(tuple, found.pairs))


def test_distances(box):
    found = box.distances(box, np.array([moved(5, 0, 0), moved(0, 0, 0), moved(5, 6, 0)]))
    expected = np.array([3, 0, 5])
    assert (found.lower <= expected).all() and (expected <= found.upper).all()
    assert np.allclose(found.lower, found.upper, rtol=1e-12) and found.upper[1] == 0
    assert np.allclose(np.linalg.norm(found.points[:, 1] - found.points[:, 0], axis=1), expected)
    assert (found.faces[0] >= 0).all()


def test_hulls(hull, random):
    numbers = random()
    size = np.ptp(hull.vertices, axis=0).max()
    poses = np.array([moved(*numbers.normal(size=3) * size) for _ in range(100)])
    plain, hull_alone = prohull.Collider(hull.original), prohull.Collider(hull)
    exact = plain.collides(plain, poses)
    assert 0 < exact.sum() < 100
    assert not (exact & ~hull_alone.collides(hull_alone, poses, conservative=True)).any()


def test_a_file_of_levels_answers_for_its_original(tmp_path):
    mesh = prohull.sample("pony", 2000)
    speck = prohull.Mesh(1e-6 * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
                         [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    for side in ("outer", "inner"):
        path = tmp_path / f"{side}.phull"
        hull = prohull.build(mesh, 100, side=side, levels=True)
        hull.save(path)
        file, original, coarse = prohull.Collider(path), prohull.Collider(mesh), prohull.Collider(hull)
        poses = np.array([moved(*at) for at in [*hull.vertices, *mesh.vertices[::20]]])
        exact = original.collides(speck, poses)
        assert (file.collides(speck, poses) == exact).all()
        assert (prohull.Collider(speck).collides(path, own_poses=poses) == exact).all(), "as the other one, too"
        assert (coarse.collides(speck, poses) != exact).any(), "the hull alone answers otherwise"
        if side == "outer":
            may = file.collides(speck, poses, conservative=True)
            assert (may == coarse.collides(speck, poses, conservative=True)).all()
        else:
            with pytest.raises(prohull.InputError, match="inner.phull: it holds inner hulls"):
                file.collides(speck, poses, conservative=True)


def test_an_open_mesh_is_no_solid(cube):
    lid_off = prohull.Collider(prohull.Mesh(cube[0], cube[1][1:]))
    assert not lid_off.is_solid and lid_off.collides(prohull.Mesh(cube[0] * 0.1, cube[1])) is False


@pytest.mark.parametrize("threads", [-1, 1.5, 1 << 40])
def test_wrong_counts_of_threads(box, cube, threads):
    mesh, points = prohull.Mesh(*cube), np.zeros((1, 3))
    asked = [box.collides, box.intersecting_faces, box.distances]
    asked = [lambda ask=ask: ask(box, threads=threads) for ask in asked]
    asked += [lambda ask=ask: ask(segments=[[0, 0, 0, 1, 1, 1]], threads=threads)
              for ask in (mesh.first_hit, mesh.any_hit, mesh.all_hits)]
    asked += [lambda ask=ask: ask(points, threads=threads) for ask in (mesh.contains, mesh.closest, mesh.signed_distance)]
    asked.append(lambda: mesh.faces_met(np.zeros((1, 9)), threads=threads))
    for ask in asked:
        with pytest.raises(prohull.InputError, match=f"threads={threads}: expected a whole number"):
            ask()


def test_bad_poses(box):
    for poses in (np.eye(3), np.eye(4) * 2, np.diag([1, 1, -1, 1]), moved(np.nan, 0, 0), np.ones((2, 3, 4)), "pose"):
        with pytest.raises(prohull.InputError, match="pose"):
            box.collides(box, poses)
    with pytest.raises(prohull.InputError, match="as many"):
        box.collides(box, np.tile(np.eye(4), (2, 1, 1)), own_poses=np.tile(np.eye(4), (3, 1, 1)))
