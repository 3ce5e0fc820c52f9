import math

import numpy as np
import prohull
import pytest


@pytest.fixture(scope="module")
def rays(random):
    """Of which some miss; towards points around the origin."""
    numbers = random()
    origins = numbers.normal(size=(400, 3)) * 3
    return origins, 0.4 * numbers.normal(size=(400, 3)) - origins


def test_first_hits_of_a_cube(cube):
    mesh = prohull.Mesh(*cube)
    hits = mesh.first_hit([[0.2, 0.1, 5], [0.2, 0.1, 0], [5, 5, 5]], [0, 0, -2])
    assert hits.hit.tolist() == [True, True, False]
    assert hits.t[:2].tolist() == [2, 0.5] and np.isnan(hits.t[2])
    assert hits.position[:2].tolist() == [[0.2, 0.1, 1], [0.2, 0.1, -1]] and np.isnan(hits.position[2]).all()
    assert hits.entering.tolist() == [True, False, False]
    assert hits.face[0] in (10, 11) and hits.face[1] in (8, 9) and hits.face[2] == -1
    assert [a.dtype for a in hits] == [np.int64, np.float64, np.float64, np.bool_]


def test_segments_end(cube):
    mesh = prohull.Mesh(*cube)
    segments = np.array([[[0.2, 0.1, 5], [0.2, 0.1, 3]], [[0.2, 0.1, 5], [0.2, 0.1, -3]]], dtype=np.float32)
    for given in (segments, segments.reshape(-1, 6), np.asfortranarray(segments), segments.tolist()):
        hits = mesh.first_hit(segments=given)
        assert hits.hit.tolist() == [False, True] and hits.t[1] == 0.5
        assert mesh.any_hit(segments=given).tolist() == [False, True]
    hits = mesh.all_hits(segments=segments)
    assert hits.offsets.tolist() == [0, 0, 2] and hits.entering.tolist() == [True, False]
    assert hits.query.tolist() == [1, 1] and hits.t.tolist() == [0.5, 0.75]


def test_no_queries_give_no_hits(cube):
    mesh = prohull.Mesh(*cube)
    assert mesh.first_hit(np.zeros((0, 3)), np.zeros((0, 3))).position.shape == (0, 3)
    assert mesh.any_hit(segments=np.zeros((0, 6))).shape == (0,)
    assert mesh.all_hits(np.zeros((0, 3)), [0, 0, 1]).offsets.tolist() == [0]
    assert mesh.contains(np.zeros((0, 3))).shape == (0,)


@pytest.mark.parametrize("engine", [e for e in prohull.ENGINES if e not in ("paper-refinement", "walk", "filter")])
def test_every_engine_gives_the_same_answers(hull, rays, engine):
    mesh = hull.original
    hits, expected = mesh.all_hits(*rays, engine=engine), mesh.all_hits(*rays)
    for ours, theirs in zip(hits, expected):
        assert np.array_equal(ours, theirs)
    assert 0 < len(expected.face) and np.array_equal(mesh.any_hit(*rays, engine=engine), np.diff(hits.offsets) > 0)
    first = mesh.first_hit(*rays, engine=engine, threads=1)
    assert np.array_equal(first.t[first.hit], hits.t[hits.offsets[:-1][first.hit]])


def test_refinement_options(hull, rays):
    expected = hull.original.first_hit(*rays)
    for engine in (prohull.Refinement(coarsen=True), prohull.Refinement(queries_per_roll_back=50)):
        assert np.array_equal(hull.original.first_hit(*rays, engine=engine).face, expected.face)
    # As published, it may miss what lies ahead of a ray that starts within the hull.
    outside = ((rays[0] < hull.vertices.min(0)) | (rays[0] > hull.vertices.max(0))).any(1)
    for engine in (prohull.Refinement(paper=True), "paper-refinement"):
        found = hull.original.first_hit(*rays, engine=engine)
        assert outside.sum() > 100 and np.array_equal(found.face[outside], expected.face[outside])
        with pytest.raises(prohull.InputError, match="cannot tell what is inside"):
            hull.original.contains(hull.original.vertices.mean(0), engine=engine)
    with pytest.raises(prohull.InputError):
        hull.original.first_hit(*rays, engine=prohull.Refinement(queries_per_roll_back=0))
    with pytest.raises(prohull.InputError, match="original"):
        hull.first_hit(*rays, engine="refinement")


def test_two_hulls(hull, rays):
    inner = prohull.build(hull.original, 200, side="inner", levels=True)
    expected = hull.original.all_hits(*rays)
    for engine in ("auto", "walk", "filter", "refinement"):
        hits = hull.original.all_hits(*rays, engine=prohull.TwoHulls(inner, engine))
        assert all(np.array_equal(ours, theirs) for ours, theirs in zip(hits, expected))
        assert np.array_equal(hull.original.any_hit(*rays, engine=prohull.TwoHulls(inner, engine)),
                              np.diff(expected.offsets) > 0)
    outside = ((rays[0] < hull.vertices.min(0)) | (rays[0] > hull.vertices.max(0))).any(1)
    walked = hull.original.first_hit(*rays, engine="walk")
    assert np.array_equal(walked.face[outside], hull.original.first_hit(*rays).face[outside])
    with pytest.raises(prohull.InputError, match="inner"):
        hull.original.any_hit(*rays, engine="filter")
    with pytest.raises(prohull.InputError, match="inner"):
        hull.original.any_hit(*rays, engine=prohull.TwoHulls(hull))


def test_what_a_hull_misses_the_mesh_misses(hull, pony, rays):
    assert not (pony.any_hit(*rays) & ~hull.any_hit(*rays)).any()
    assert hull.any_hit(*rays).sum() > pony.any_hit(*rays).sum() > 0


def test_contains(cube, hull, pony, random):
    mesh = prohull.Mesh(*cube)
    assert mesh.contains([[0, 0, 0], [0.99, 0.99, -0.99], [1.01, 0, 0], [-7, 0, 0]]).tolist() == [True, True, False, False]
    assert not prohull.Mesh(cube[0], cube[1][:, ::-1]).contains([[0, 0, 0]]).any(), "inside out"
    points = random().uniform(pony.vertices.min(0), pony.vertices.max(0), (3000, 3))
    inside, inside_hull = pony.contains(points), hull.contains(points)
    assert not (inside & ~inside_hull).any() and 0 < inside.sum() < inside_hull.sum() < len(points)
    with pytest.raises(prohull.InputError, match="not closed"):
        prohull.Mesh(cube[0], cube[1][1:]).contains([[0, 0, 0]])
    with pytest.raises(prohull.InputError, match=r"points: an array of shape \(2,\)"):
        mesh.contains([0, 0])


def test_contains_takes_one_point(cube):
    mesh = prohull.Mesh(*cube)
    assert mesh.contains([0, 0, 0]) is True and mesh.contains((2, 0, 0)) is False
    assert mesh.contains(np.array([0.5, 0, 0])) is True
    assert mesh.contains([[0, 0, 0], [2, 0, 0], [0, 0, 0]]).tolist() == [True, False, True], "three points are three"


def test_closest(cube, pony, random):
    mesh = prohull.Mesh(*cube)
    points = [[3, 0, 0], [0, 0, 0.75], [5, 5, 1]]
    found = mesh.closest(points)
    assert found.distance.tolist() == [2, 0.25, math.sqrt(32)] and found.position[0].tolist() == [1, 0, 0]
    assert ((found.lower <= found.distance) & (found.distance <= found.upper)).all()
    assert np.allclose(found.lower, found.upper, rtol=0, atol=1e-13)
    signed = mesh.signed_distance(points)
    assert signed.distance.tolist() == [2, -0.25, math.sqrt(32)] and (signed.face == found.face).all()
    assert signed.lower[1] == -found.upper[1] and signed.upper[1] == -found.lower[1]
    assert mesh.closest([3, 0, 0]).distance.tolist() == [2] and mesh.signed_distance((0, 0, 0)).distance.tolist() == [-1]
    near = mesh.closest(points, max_distance=2.5)
    assert near.face[2] == -1 and np.isnan(near.distance[2]) and np.isnan(near.position[2]).all()
    assert near.distance[:2].tolist() == [2, 0.25]
    assert mesh.closest(np.zeros((0, 3))).position.shape == (0, 3)

    points = random().uniform(-1, 1, (300, 3))
    away = pony.vertices[:, None] - points
    assert (pony.closest(points).lower <= np.linalg.norm(away, axis=2).min(0)).all(), "no farther than any vertex"
    one, all_cores = pony.signed_distance(points, threads=1), pony.signed_distance(points)
    assert all(np.array_equal(a, b) for a, b in zip(one, all_cores))
    assert ((one.distance < 0) == pony.contains(points)).all()

    with pytest.raises(prohull.InputError, match="not closed"):
        prohull.Mesh(cube[0], cube[1][1:]).signed_distance([[0, 0, 0]])
    for call in (lambda: mesh.closest([0, 0]), lambda: mesh.closest([[0, 0, math.nan]]),
                 lambda: mesh.closest([[0, 0, 0]], max_distance=-1)):
        with pytest.raises(prohull.InputError):
            call()


def test_faces_met(cube):
    mesh = prohull.Mesh(*cube)
    met = mesh.faces_met([[[0, 0.5, 0], [0, 0.6, 5], [0.1, 0.5, 5]], [[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]]])
    assert met.offsets.tolist() == [0, 1, 1] and met.face[0] in (10, 11)


@pytest.mark.parametrize("engine", ["auto", "brute"])
def test_a_hit_at_a_huge_t_has_its_position(engine):
    mesh = prohull.Mesh([[0, -1, -1], [0, 2, -1], [0, 0, 2]], [[0, 1, 2]])
    for speed in (5e-324, 1e-310):
        ray = [[-5, 0.1, 0]], [[speed, 0, 0]]
        for hits in (mesh.first_hit(*ray, engine=engine), mesh.all_hits(*ray, engine=engine)):
            assert np.isinf(hits.t).all() and hits.position.tolist() == [[0, 0.1, 0]]
