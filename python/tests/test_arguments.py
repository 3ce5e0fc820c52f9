import numpy as np
import prohull
import pytest


@pytest.mark.parametrize("dtype", ["f8", ">f8", "f4", "f2", "i1", "i4", ">i2", "i8"])
@pytest.mark.parametrize("order", ["C", "F", "strided"])
def test_vertices_of_any_dtype_and_order(cube, dtype, order):
    vertices, faces = cube
    given = np.repeat(vertices, 2, axis=0)[::2] if order == "strided" else np.asarray(vertices, order=order)
    assert np.array_equal(prohull.Mesh(given.astype(dtype, order="K"), faces).vertices, vertices)


@pytest.mark.parametrize("dtype", ["i1", "u1", "i4", "u4", ">u4", "i8", "u8", "f4", "f8"])
def test_faces_of_any_dtype_and_order(cube, dtype):
    vertices, faces = cube
    mesh = prohull.Mesh(vertices.tolist(), np.asfortranarray(faces.astype(dtype)))
    assert mesh.faces.dtype == np.uint32 and np.array_equal(mesh.faces, faces)
    assert mesh.vertices.dtype == np.float64


def test_what_is_given_may_change_afterwards(cube):
    vertices, faces = cube[0].astype(float), cube[1]
    mesh = prohull.Mesh(vertices, faces)
    vertices[:] = 7
    assert mesh.vertices.max() == 1


@pytest.mark.parametrize("vertices, message", [
    (np.zeros((8, 2)), r"vertices: an array of shape \(8, 2\); expected \(n, 3\)"),
    (np.zeros(24), r"vertices: an array of shape \(24,\)"),
    (np.zeros((2, 4, 3)), r"vertices: an array of shape \(2, 4, 3\)"),
    (1.0, r"vertices: an array of shape \(\)"),
    (np.zeros((8, 3), complex), "vertices: an array of complex128"),
    (np.zeros((8, 3), bool), "vertices: an array of bool"),
    ([["a", "b", "c"]] * 8, "vertices: an array of <U1"),
    (np.full((8, 3), 2**53 + 1), "vertices: 9007199254740993 is no float64 number"),
    (np.full((8, 3), 2**64 - 1, np.uint64), "vertices: 18446744073709551615 is no float64 number"),
])
def test_wrong_vertices_are_named(cube, vertices, message):
    with pytest.raises(ValueError, match=message):
        prohull.build(vertices, cube[1])


@pytest.mark.parametrize("faces, message", [
    (np.zeros((6, 4), int), r"faces: an array of shape \(6, 4\); expected \(m, 3\)"),
    (np.zeros(12, int), r"faces: an array of shape \(12,\)"),
    (np.full((1, 3), 0.5), "faces: an array of float64 with fractions"),
    (np.full((1, 3), np.nan), "faces: an array of float64 with fractions"),
    ([[0, 1, 2], [0, 1, 8]], r"faces\[1\] names vertex 8, but there are 8 vertices"),
    ([[0, 1, -1]], r"faces\[0\] names vertex -1"),
    (np.full((1, 3), 2**64 - 1, np.uint64), r"faces\[0\] names vertex 18446744073709551615"),
    ([[0, 1, 2], [0, 1, 2**63]], r"faces\[1\] names vertex 9223372036854775808"),
    (np.full((1, 3), np.inf), r"faces\[0\] names vertex inf"),
])
def test_wrong_faces_are_named(cube, faces, message):
    with pytest.raises(ValueError, match=message):
        prohull.build(cube[0], faces)


def test_empty_and_infinite_meshes_are_refused(cube):
    with pytest.raises(prohull.InputError):
        prohull.build(np.zeros((0, 3)), np.zeros((0, 3), int))
    with pytest.raises(prohull.InputError):
        prohull.build(np.full((8, 3), np.nan), cube[1])


@pytest.mark.parametrize("arguments, message", [
    (dict(origins=np.zeros((4, 2)), directions=np.zeros((4, 3))), r"origins: an array of shape \(4, 2\)"),
    (dict(origins=np.zeros((4, 3)), directions=np.zeros((5, 3))), r"\(4, 3\) and directions of shape \(5, 3\)"),
    (dict(origins=np.zeros((4, 3)), directions=np.zeros((1, 4, 3))), r"directions: an array of shape \(1, 4, 3\)"),
    (dict(segments=np.zeros((4, 3))), r"segments: an array of shape \(4, 3\); expected \(n, 2, 3\) or \(n, 6\)"),
    (dict(segments=np.zeros((2, 3, 2))), r"segments: an array of shape \(2, 3, 2\)"),
    (dict(origins=np.zeros(3)), "either origins and directions, or segments"),
    (dict(segments=np.zeros((4, 6)), origins=np.zeros(3)), "either origins and directions, or segments"),
    (dict(origins=[[0, 0, np.nan]], directions=[[0, 0, 1]]), "0"),
    (dict(origins=[0, 0, 9], directions=[[0, 0, -1], [0, 0, 0]]), "query 1: the ray's direction is zero; leave it out"),
    (dict(segments=[[[0, 0, 0], [0, 0, 0]]]), "query 0: the segment's ends are equal; leave it out"),
    (dict(segments=np.zeros((1, 6)), engine="magic"), "engine='magic': expected one of auto, bvh"),
    (dict(segments=np.zeros((1, 6)), engine=["bvh"]), r"engine=\['bvh'\]: expected the name of an engine"),
])
def test_wrong_queries_are_named(cube, arguments, message):
    for ask in (prohull.Mesh(*cube).first_hit, prohull.Mesh(*cube).any_hit, prohull.Mesh(*cube).all_hits):
        with pytest.raises(ValueError, match=message):
            ask(**arguments)


def test_a_file_is_read_at_a_scale(tmp_path):
    mesh = prohull.sample("box", 12)
    mesh.save(tmp_path / "box.ply")
    np.testing.assert_array_equal(prohull.read(tmp_path / "box.ply", scale=0.5).vertices, 0.5 * mesh.vertices)
    with pytest.raises(prohull.InputError, match="greater than 0"):
        prohull.read(tmp_path / "box.ply", scale=0)
    with pytest.raises(prohull.InputError, match="scale='x': expected a number greater than 0"):
        prohull.read(tmp_path / "box.ply", scale="x")


def test_an_empty_list_has_no_rows(cube):
    mesh = prohull.Mesh(*cube)
    assert mesh.contains([]).shape == (0,) and len(mesh.closest([]).face) == 0
    assert mesh.any_hit(segments=[]).shape == (0,) and mesh.any_hit([], [0, 0, 1]).shape == (0,)
    assert mesh.all_hits(segments=[]).offsets.tolist() == [0]


def test_a_report_lists_openings(cube):
    vertices, faces = cube
    assert prohull.Mesh(vertices, faces).report()["openings"] == []
    without_a_side = prohull.Mesh(vertices, faces[2:]).report()
    assert without_a_side["openings"] == pytest.approx([8**0.5])


@pytest.mark.parametrize("ask", [lambda path: prohull.build(path, 200), prohull.read, prohull.load,
                                 lambda path: prohull.verify(path, path)])
def test_names_that_no_file_has_are_told(ask):
    with pytest.raises(prohull.InputError, match=r"a\\xffb.stl: cannot read: there is no such file") as told:
        ask("a\udcffb.stl")
    assert isinstance(told.value, FileNotFoundError)
    with pytest.raises(prohull.InputError, match=r"'a\\x00b.stl': a zero byte is in this name"):
        ask("a\0b.stl")


def test_a_level_has_a_number_of_faces(hull):
    with pytest.raises(prohull.InputError, match="faces=-1: expected a whole number, at least 0"):
        hull.level(-1)


def test_a_sample_has_a_number_of_faces():
    for faces in (-1, 2**40, 1.5):
        with pytest.raises(prohull.InputError, match=f"faces={faces}: expected a whole number, at least 0 and less than"):
            prohull.sample("pony", faces)
    with pytest.raises(prohull.InputError, match="5"):
        prohull.sample(5, 100)


def test_masked_numbers_are_refused(cube):
    vertices, faces = cube
    masked = np.ma.masked_less(vertices, 0.5)
    with pytest.raises(prohull.InputError, match="vertices: a masked array with masked numbers"):
        prohull.Mesh(masked, faces)
    for points in (masked, masked[0]):
        with pytest.raises(prohull.InputError, match="points: a masked array"):
            prohull.Mesh(vertices, faces).closest(points)
    assert np.array_equal(prohull.Mesh(np.ma.asarray(vertices), faces).vertices, vertices)


def test_progress_is_called(pony):
    for call in (lambda: prohull.build(pony, 200, progress=3), lambda: pony.contains([0, 0, 0], progress=3)):
        with pytest.raises(prohull.InputError, match="progress=3: expected a function of a stage and a fraction, or None"):
            call()


@pytest.mark.parametrize("dtype", [np.int64, np.uint64])
def test_rays_are_not_rounded(cube, dtype):
    mesh, far = prohull.Mesh(*cube), np.array([2**53 + 1, 1, 1], dtype)
    for origins in (far, far[np.newaxis]):
        with pytest.raises(prohull.InputError, match="origins: 9007199254740993 is no float64 number"):
            mesh.first_hit(origins, [-1, 0, 0])
        with pytest.raises(prohull.InputError, match="directions: 9007199254740993 is no float64 number"):
            mesh.first_hit([5, 1, 1], origins)


@pytest.mark.parametrize("far", ["1%", None, -1, np.nan])
def test_a_search_ends_at_a_number(pony, far):
    with pytest.raises(prohull.InputError, match=f"max_distance={far!r}: expected a number, at least 0"):
        pony.closest([0, 0, 0], max_distance=far)


@pytest.mark.parametrize("size", [{"width": 1.5}, {"width": 2**40}, {"height": "9"}, {"height": -1}])
def test_pictures_have_sizes_in_pixels(cube, size):
    [(name, value)] = size.items()
    for drawn in (prohull.Mesh(*cube), prohull.convex_pieces(cube, 1)):
        with pytest.raises(prohull.InputError, match=f"{name}={value!r}: expected a whole number, at least 0 and less than"):
            drawn.picture(**size)
