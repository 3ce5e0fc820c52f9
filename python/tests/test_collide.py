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


def test_an_open_mesh_is_no_solid(cube):
    lid_off = prohull.Collider(prohull.Mesh(cube[0], cube[1][1:]))
    assert not lid_off.is_solid and lid_off.collides(prohull.Mesh(cube[0] * 0.1, cube[1])) is False


def test_bad_poses(box):
    for poses in (np.eye(3), np.eye(4) * 2, np.diag([1, 1, -1, 1]), moved(np.nan, 0, 0), np.ones((2, 3, 4)), "pose"):
        with pytest.raises(prohull.InputError, match="pose"):
            box.collides(box, poses)
    with pytest.raises(prohull.InputError, match="as many"):
        box.collides(box, np.tile(np.eye(4), (2, 1, 1)), own_poses=np.tile(np.eye(4), (3, 1, 1)))
