import inspect
import math
import pickle
import subprocess
import sys

import numpy as np
import prohull
import prohull.robot
import pytest


def test_a_hull_is_certified_and_says_how_it_came_about(pony):
    hull = prohull.build(pony.vertices, pony.faces, target_faces=500)
    assert hull.certified and hull.target_reached and hull.within_bounds
    assert len(hull.faces) == 500
    assert hull.side == "outer" and hull.proof == "enclosure" and hull.target_faces == 500
    with_levels = prohull.build(pony, 500, levels=True)
    assert with_levels.proof == "replay" and 0 < hull.void_ratio < with_levels.void_ratio  # levels do not move
    assert 0 < hull.void_ratio == hull.volume / pony.volume - 1
    assert sum(hull.refusals.values()) > 0 and set(hull.refusals) <= {
        "link_condition", "valence", "no_room_outside", "certificate", "compactness", "normal_deviation",
        "self_intersection", "overhang"}
    assert hull.self_intersections == 0
    assert prohull.verify(hull, pony)


def test_what_one_types_first_works(pony, tmp_path):
    pony.save(tmp_path / "part.ply")
    vertices, faces = pony.vertices, pony.faces
    expected = prohull.build(pony, target_faces=500).vertices
    for call in (lambda: prohull.build(str(tmp_path / "part.ply"), 500), lambda: prohull.build(tmp_path / "part.ply", 500),
                 lambda: prohull.build(pony, 500), lambda: prohull.build(vertices, faces, 500),
                 lambda: prohull.build((vertices, faces), 500), lambda: prohull.build(vertices, faces, target_faces=500),
                 lambda: prohull.build(vertices.tolist(), faces.tolist(), 500), lambda: prohull.build(pony, [500])[0],
                 lambda: prohull.build(mesh=pony, target_faces=500), lambda: prohull.build(vertices, faces=faces, target_faces=500)):
        assert np.array_equal(call().vertices, expected)


@pytest.mark.parametrize("call, message", [
    (lambda v, f, mesh: prohull.build("part.stl", "500"), "target_faces='500': expected a whole number of at least 4"),
    (lambda v, f, mesh: prohull.build(500, "part.stl"), r"500, 'part.stl': expected build\(mesh, target_faces\) or build\(v"),
    (lambda v, f, mesh: prohull.build(v, 500), r"an array of shape \(8, 3\), 500: expected build\(mesh, target_faces\)"),
    (lambda v, f, mesh: prohull.build(mesh, f, 500), "is a mesh already: expected build"),
    (lambda v, f, mesh: prohull.build(mesh, 400, target_faces=500), "is a mesh already: expected build"),
])
def test_arguments_in_the_wrong_place_are_named(cube, call, message):
    with pytest.raises(prohull.InputError, match=message):
        call(*cube, prohull.Mesh(*cube))


def test_several_budgets_give_a_list(pony):
    fine, coarse = prohull.build(pony, target_faces=[800, 400])
    assert (len(fine.faces), len(coarse.faces)) == (800, 400)
    assert fine.original.vertices.ctypes.data == coarse.original.vertices.ctypes.data, "one original for both"
    assert isinstance(prohull.build(pony, target_faces=(800,)), list)
    assert isinstance(prohull.build(pony, target_faces=np.int32(800)), prohull.Hull)


def test_distance_bound_holds_and_bounds_are_kept(pony):
    hull = prohull.build(pony, target_faces=500)
    lower, upper = prohull.distance_bounds(hull, pony)
    with pytest.raises(prohull.InputError, match="relative_gap=-1: expected a number, at least 0"):
        prohull.distance_bounds(hull, pony, relative_gap=-1)
    assert 0 < lower <= upper == hull.distance_bound <= 1.01 * lower
    near = prohull.build(pony, target_faces=500, max_distance=upper / 4)
    assert near.within_bounds and near.distance_bound <= upper / 4 and len(near.faces) > 500


def test_a_gap_is_proven_and_kept_by_files(pony, tmp_path):
    gap = 0.02 * float(np.linalg.norm(np.ptp(pony.vertices, axis=0)))
    hull = prohull.build(pony, 60, gap=gap)
    assert hull.certified and hull.proof == "padding" and hull.gap >= gap and not hull.levels
    assert prohull.verify(hull, pony)
    faces = np.vstack([hull.faces, hull.faces[:1]])  # not closed: its surface alone
    surface = prohull.Collider((hull.vertices, faces))
    assert surface.distances(pony).lower[0] >= gap
    stored = prohull.build(pony, 60, gap=gap, float32_coordinates=True)
    assert stored.proof == "padding" and stored.gap >= gap and stored.with_float32_coordinates() is stored
    stored.save(tmp_path / "hull.stl")
    rounded = hull.with_float32_coordinates()
    assert rounded.certified == (rounded.gap >= gap) and rounded.gap == pytest.approx(hull.gap, rel=1e-4)
    assert prohull.build(pony, 60).gap == 0


@pytest.mark.parametrize("side", ["outer", "inner"])
def test_gaps_are_kept_and_verified(pony, side):
    diagonal = float(np.linalg.norm(np.ptp(pony.vertices, axis=0)))
    hull = prohull.build(pony, 60, gap="1%", side=side)
    assert hull.certified and hull.proof == "padding" and hull.gap >= 0.01 * diagonal
    assert np.array_equal(hull.vertices, prohull.build(pony, 60, gap=0.01 * diagonal, side=side).vertices)
    found = prohull.verify(hull, pony, gap="1%")
    assert found and found.keeps_gap and not found.nearest and found.least_distance == pytest.approx(hull.gap)
    more = prohull.verify(hull, pony, gap=1.01 * hull.gap)
    assert not more and more.encloses and not more.keeps_gap and more.faces_too_near >= len(more.nearest) > 0
    near = more.nearest[0]
    assert near.distance == pytest.approx(hull.gap) and near.face < len(hull.faces)
    assert near.original_face < len(pony.faces) and near.point.shape == (3,) and "nearer" in more.why_not


def test_lengths_take_per_cent(pony):
    diagonal = float(np.linalg.norm(np.ptp(pony.vertices, axis=0)))
    ball = prohull.sample("sphere", 100)
    near = prohull.build(pony, 4, max_distance="3%", seal_holes="1%")
    assert near.within_bounds and np.array_equal(near.vertices, prohull.build(pony, 4, max_distance=0.03 * diagonal).vertices)
    assert prohull.cage(pony, gap="1%").gap == pytest.approx(0.01 * diagonal)
    assert prohull.spheres(pony, 500, max_distance="10%").verdict.distance_bound <= 0.1 * diagonal
    assert prohull.convex_pieces(ball, max_distance="25%").verdict.distance_bound <= 0.25 * np.linalg.norm(np.ptp(ball.vertices, axis=0))
    for wrong in ["3", "x%", "-1%", "1mm"]:
        for call, name in [(prohull.build, "seal_holes"), (prohull.cage, "gap"), (prohull.spheres, "max_distance")]:
            with pytest.raises(prohull.InputError, match=f"{name}={wrong!r}: expected a number"):
                call(pony, **{name: wrong})


def test_repair_closes_a_mesh(pony):
    solid = prohull.repair((pony.vertices, np.delete(pony.faces, [5, 900], axis=0)))
    assert solid.certified and solid.source == "mesh" and solid.closed_openings == 2 and not solid.verdict.why_not
    assert len(solid.faces) == len(pony.faces) and solid.contains(pony.vertices.mean(axis=0)[None]).shape == (1,)
    assert solid.largest_opening > 0 and "closed 2 openings" in solid.repairs[0]
    book = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1]], [[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    wrap = prohull.repair(book, spacing="2%")
    assert wrap.certified and wrap.source == "wrap" and wrap.wrap_spacing > 0 and wrap.obstacle
    assert prohull.verify(wrap, book)
    with pytest.raises(prohull.InputError, match="spacing='1mm': expected a number"):
        prohull.repair(book, spacing="1mm")


def test_gaps_that_mean_nothing_are_refused(pony, tmp_path):
    for gap in ["1", "%", "x%", "-1%", -1, math.inf, math.nan]:
        with pytest.raises(prohull.InputError, match="gap="):
            prohull.build(pony, 200, gap=gap)
        with pytest.raises(prohull.InputError, match="gap="):
            prohull.verify(pony, pony, gap=gap)
    with pytest.raises(prohull.InputError, match="thicker than twice the gap"):
        prohull.build(pony, 200, gap="60%", side="inner")
    prohull.build(pony, 200, levels=True).save(tmp_path / "pony.phull")
    with pytest.raises(prohull.InputError, match="touch each other"):
        prohull.verify(tmp_path / "pony.phull", pony, gap=0.1)


def test_inner_hulls_are_enclosed(pony):
    inner = prohull.build(pony, target_faces=500, side="inner", levels=True)
    assert inner.certified and inner.side == "inner" and inner.void_ratio < 0
    assert prohull.verify(inner, pony)
    assert prohull.verify(inner.level(1000), pony, side="inner")
    assert not prohull.verify(inner, pony, side="outer")


def test_tight_hulls_have_less_void_and_no_levels(pony):
    tight = prohull.build(pony, target_faces=500, tight=True)
    assert tight.certified and tight.void_ratio < prohull.build(pony, target_faces=500).void_ratio
    assert len(tight.levels) == 0
    with pytest.raises(prohull.InputError, match="no levels"):
        tight.level(600)


def test_why_a_hull_with_a_gap_has_no_levels(pony):
    with pytest.raises(prohull.InputError, match="neither tight nor a gap"):
        prohull.build(pony, target_faces=500, gap="1%").level(600)


def test_levels_are_nested_views(hull, pony):
    assert hull.levels == range(300, len(pony.faces) + 1, 2)
    level = hull.level(1000)
    assert len(level.faces) == 1000
    assert prohull.verify(hull, level) and prohull.verify(level, pony)
    for array in (level.vertices, level.faces):
        assert not array.flags.writeable and not array.flags.owndata and array.flags.c_contiguous
    assert level.vertices.ctypes.data == level.vertices.ctypes.data, "no copy on each access"
    vertices = hull.level(1000).vertices
    assert np.array_equal(vertices, level.vertices), "a view keeps alive what it shows"
    finest = hull.level(len(pony.faces))
    assert np.array_equal(finest.vertices[finest.faces], pony.vertices[pony.faces])


def test_a_level_that_leaves_folds_says_so():
    ball = prohull.sample("sphere", 600)
    vertices = ball.vertices.copy()
    vertices[np.argmax(vertices[:, 2])] = [0.03, 0.05, -1.001]
    hull = prohull.build(vertices, ball.faces, target_faces=12, levels=True)
    assert hull.certified and hull.source == "mesh"
    level = hull.level(300)
    assert not prohull.verify(level, hull.original)
    assert not level.certified and "leaves faces of the original uncovered" in level.notes[0]
    assert hull.level(12).certified and not hull.level(12).notes


@pytest.mark.parametrize("face", [[0, 1, 2], [0, 1, 1]])
def test_an_estimate_is_told_only_of_a_void_that_is_known(face):
    hull = prohull.build([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [face], target_faces=100)
    assert math.isnan(hull.void_ratio) and not any("void_ratio" in note for note in hull.notes)


def test_openings_are_closed_unless_they_are_to_be_kept(cube):
    vertices, faces = cube
    lidless = faces[2:]
    with pytest.raises(prohull.InputError, match="edge"):
        prohull.build(vertices, lidless, repair="none")
    solid = prohull.build(vertices, lidless, target_faces=50)
    assert solid.certified and solid.source == "mesh" and solid.repairs[-1].startswith("closed 1 opening")
    assert solid.volume >= solid.original.volume == prohull.Mesh(vertices, faces).volume
    shell = prohull.build(vertices, lidless, target_faces=50, open_shells="keep")
    assert shell.certified and shell.proof == "coverage" and shell.source == "wrap" and shell.wrap_spacing > 0
    assert math.isnan(shell.void_ratio) and not any("void_ratio" in note for note in shell.notes)
    assert shell.distance_bound > 0 and len(shell.levels) == 0
    assert len(shell.original.faces) == len(lidless)
    assert prohull.verify(shell, (vertices, lidless)) and prohull.verify(solid, (vertices, lidless))
    assert prohull.verify(solid, (vertices, lidless), open_shells="close")
    assert not prohull.verify(shell, (vertices, lidless), open_shells="close")
    inner = prohull.build(vertices, lidless, target_faces=50, side="inner")
    assert prohull.verify(inner, (vertices, lidless), open_shells="close")
    with pytest.raises(prohull.InputError, match="no inside"):
        prohull.verify(inner, (vertices, lidless))
    with pytest.raises(prohull.InputError, match="open_shells='shut': expected one of"):
        prohull.verify(inner, (vertices, lidless), open_shells="shut")


def test_the_best_source_is_taken(part_of_two):
    hull = prohull.build(part_of_two, 100)
    assert hull.certified and hull.source in ("mesh", "convex-hull", "wrap")
    assert (hull.wrap_spacing > 0) == (hull.source == "wrap")
    wrapped = prohull.build(part_of_two, 100, repair="wrap", levels=True)
    assert wrapped.certified and wrapped.source != "mesh" and wrapped.proof == "enclosure"
    assert prohull.verify(wrapped, part_of_two)
    level = wrapped.level(200)
    assert level.certified and level.proof == "enclosure" and prohull.verify(level, part_of_two)
    with pytest.raises(prohull.InputError, match="built from it"):
        wrapped.original.first_hit([0, 0, 9], [0, 0, -1], engine="refinement")


def test_a_file_says_that_its_finest_level_is_a_wrap(part_of_two, tmp_path):
    wrapped = prohull.build(part_of_two, 100, repair="wrap", levels=True)
    wrapped.save(tmp_path / "wrap.phull")
    kinds = {"wrap": "a wrap of the input", "convex-hull": "the convex hull of the input"}
    notes = [f"the finest level is {kinds[wrapped.source]}, not the input itself"]
    assert prohull.load(tmp_path / "wrap.phull").notes == notes
    assert pickle.loads(pickle.dumps(prohull.load(tmp_path / "wrap.phull"))).notes == notes
    assert prohull.verify(tmp_path / "wrap.phull", part_of_two).proof == "replay"
    assert prohull.verify(tmp_path / "wrap.phull", part_of_two)


@pytest.mark.parametrize("tight", [False, True])
@pytest.mark.parametrize("faces", [60, 100])
def test_few_faces_make_no_spikes(pony, faces, tight):
    low, high = pony.vertices.min(axis=0), pony.vertices.max(axis=0)
    reach = 0.02 * np.linalg.norm(high - low)
    hull = prohull.build(pony, faces, max_overhang=0.02, relax_guards=False, tight=tight)
    assert hull.certified and (hull.vertices >= low - reach).all() and (hull.vertices <= high + reach).all()


def test_notes_tell_what_is_not_as_it_was_asked_for(pony):
    assert prohull.build(pony, 500).notes == []
    stuck = prohull.build(prohull.sample("torus", 200), 4, side="inner")  # a torus has at least 14
    assert not stuck.target_reached and sum(stuck.blocked.values()) > 0
    assert f"{len(stuck.faces)} faces, more than the 4 asked for: of its edges, " in stuck.notes[-1]


def test_repairs_are_told(cube):
    vertices, faces = cube
    hull = prohull.build(vertices[faces].reshape(-1, 3), np.arange(36).reshape(12, 3), target_faces=12)
    assert hull.certified and hull.repairs == ["welded 28 vertices at equal positions"]


def test_triangles_that_are_not_finite_are_dropped(tmp_path, cube):
    vertices, faces = np.vstack([cube[0], [[np.nan, 0, 0]]]), np.vstack([cube[1], [[0, 1, 8]]])
    (tmp_path / "cube.off").write_text("OFF\n9 13 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in vertices) +
                                       "".join(f"3 {a} {b} {c}\n" for a, b, c in faces))
    for given in (tmp_path / "cube.off", (vertices, faces)):
        hull = prohull.build(given, target_faces=12)
        assert hull.certified and len(hull.original.faces) == 12 and "dropped 1 face" in hull.repairs[0]
    with pytest.raises(prohull.InputError, match="cube.off"):
        prohull.read(tmp_path / "cube.off")


def test_files(tmp_path, pony, hull):
    hull.save(tmp_path / "pony.phull")
    loaded = prohull.load(str(tmp_path / "pony.phull"))
    assert loaded.certified and loaded.levels == hull.levels and loaded.self_intersections == 0
    assert np.array_equal(loaded.vertices, hull.vertices) and np.array_equal(loaded.faces, hull.faces)
    assert loaded.void_ratio == hull.void_ratio
    assert prohull.verify(tmp_path / "pony.phull", pony)

    pony.save(tmp_path / "pony.ply")
    assert np.array_equal(prohull.read(tmp_path / "pony.ply").vertices, pony.vertices)
    with pytest.raises(prohull.InputError, match="pony.phull: .*prohull.load"):
        prohull.read(tmp_path / "pony.phull")
    with pytest.raises(prohull.InputError, match="pony.ply"):
        prohull.load(tmp_path / "pony.ply")
    hull = prohull.build(str(tmp_path / "pony.ply"), 500, float32_coordinates=True)
    assert np.array_equal(hull.vertices, hull.vertices.astype(np.float32)) and hull.with_float32_coordinates() is hull


def test_overlaps_of_a_loaded_hull_count_once(tmp_path):
    cube = prohull.sample("box", 12)
    shift = 0.5 * np.ptp(cube.vertices[:, 0]) * np.array([1, 0, 0])
    two = (np.vstack([cube.vertices, cube.vertices + shift]), np.vstack([cube.faces, cube.faces + len(cube.vertices)]))
    hull = prohull.build(two, len(two[1]), levels=True)
    hull.save(tmp_path / "two.phull")
    loaded = prohull.load(tmp_path / "two.phull")
    for made in (loaded, loaded.level(len(two[1])), pickle.loads(pickle.dumps(loaded))):
        assert made.void_ratio == hull.void_ratio == 0 and "void 0 %" in repr(made)


def test_verify_names_offenders(pony):
    smaller = prohull.Mesh(0.9 * pony.vertices, pony.faces)
    report = prohull.verify(smaller, pony)
    assert not report and not report.encloses and report.faces_outside > 0
    face, point, distance = report.worst[0]
    assert distance > 0 and point.shape == (3,) and face < len(pony.faces)


def test_verify_says_how_it_decided(pony, hull, tmp_path):
    hull.save(tmp_path / "hull.phull")
    replayed = prohull.verify(tmp_path / "hull.phull", pony)
    assert replayed and replayed.proof == "replay" and replayed.void_ratio == hull.void_ratio and replayed.self_intersections == 0
    other = prohull.verify(tmp_path / "hull.phull", prohull.sample("box", 100))
    assert not other and other.self_intersections is None, "nobody has counted them"
    assert prohull.verify(hull, pony).proof == "enclosure"
    scaled = prohull.verify(prohull.Mesh(1000 * hull.vertices, hull.faces), pony)
    assert scaled and "times larger" in scaled.notes[0]


def test_per_cent_of_a_tiny_mesh_are_not_zero(pony):
    tiny = prohull.Mesh(pony.vertices * 1e-163, pony.faces)
    assert not prohull.verify(tiny, tiny, gap="50%").keeps_gap


@pytest.mark.parametrize("finest", [-1, 4])
def test_pickled_levels_say_what_their_finest_level_is(hull, finest):
    make, (parts,) = hull._levels.__reduce__()
    with pytest.raises(prohull.InputError, match="finest level"):
        make((*parts[:5], finest))


def test_pickled_hulls_are_the_same(hull, pony):
    copy = pickle.loads(pickle.dumps(hull, protocol=5))
    assert repr(copy) == repr(hull) and copy.certified and copy.levels == hull.levels
    assert np.array_equal(copy.vertices, hull.vertices) and np.array_equal(copy.level(900).faces, hull.level(900).faces)
    assert copy.original.first_hit([0, 0, 9], [0, 0, -1], engine="refinement").hit[0] == \
        hull.original.first_hit([0, 0, 9], [0, 0, -1]).hit[0]
    tight = prohull.build(pony, target_faces=1000, tight=True)
    assert np.array_equal(pickle.loads(pickle.dumps(tight)).vertices, tight.vertices)
    with pytest.raises(prohull.InputError, match="hello"):
        raise pickle.loads(pickle.dumps(prohull.InputError("hello")))


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_every_protocol_pickles_or_says_that_it_cannot(hull, protocol):
    copy = pickle.loads(pickle.dumps(hull, protocol))
    assert np.array_equal(copy.vertices, hull.vertices) and copy.levels == hull.levels
    index = hull._new_index("bvh")
    with pytest.raises(TypeError, match="cannot pickle 'Index' object"):
        pickle.dumps(index, protocol)


def test_distances_are_told_from_faces_without_area_too(cube):
    vertices = np.vstack([cube[0], [[3, 0, 0], [9, 0, 0]]])
    mesh = prohull.Mesh(vertices, np.vstack([cube[1], [[8, 8, 9]]]))
    for bounds in ({}, dict(max_distance=2)):
        hull = prohull.build(mesh, 100, **bounds)
        assert hull.distance_bound == prohull.distance_bounds(hull, mesh)[1]
    balls = prohull.spheres(mesh, 12)
    assert balls.verdict.distance_to_triangles[1] < 2 and len(balls.balls) > 4


def test_threads_do_not_change_hulls(pony):
    one, two = (prohull.build(pony, target_faces=400, threads=threads) for threads in (1, 2))
    assert np.array_equal(one.vertices, two.vertices) and np.array_equal(one.faces, two.faces)


def test_defaults_are_those_of_the_library(pony):
    """Giving none of the options is giving their documented defaults."""
    defaults = {name: p.default for name, p in inspect.signature(prohull.build).parameters.items()
                if p.kind is p.KEYWORD_ONLY}
    assert len(prohull.build(prohull.sample("pony", 3000)).faces) == 2000
    assert np.array_equal(prohull.build(pony, target_faces=500, **defaults).vertices,
                          prohull.build(pony, target_faces=500).vertices)


@pytest.mark.parametrize("options, message", [
    ({"side": "outter"}, "side='outter': expected one of outer, inner"),
    ({"repair": "magic"}, "repair='magic': expected one of auto, none, wrap"),
    ({"strategy": None}, "strategy=None: expected one of lazy"),
    ({"target_faces": 3}, "target_faces=3"),
    ({"target_faces": []}, "target_faces=\\[\\]"),
    ({"target_faces": 2.5}, "target_faces=2.5"),
    ({"threads": -1}, "threads=-1: expected a whole number"),
    ({"best_of": "many"}, "best_of='many': expected a whole number"),
    ({"best_of": 0}, "best_of=0: expected a whole number, at least 1"),
    ({"best_of": -1}, "best_of=-1: expected a whole number, at least 1"),
    ({"max_valence": 2}, "max_valence=2: expected a whole number, at least 3"),
    ({"seal_holes": np.inf}, "largest diameter of holes to seal is inf"),
    ({"seal_holes": np.nan, "repair": "wrap"}, "seal_holes=nan"),
    ({"max_distance": -1.0}, "max_distance=-1.0: expected a number, at least 0"),
    ({"max_void_percent": "small"}, "max_void_percent='small': expected a number"),
    ({"min_compactness_ratio": 2.0}, "compactness"),
    ({"max_overhang": -0.1}, "max_overhang=-0.1: expected a number, at least 0"),
    ({"open_shells": "shut"}, "open_shells='shut': expected one of close, keep"),
])
def test_bad_options_are_named(cube, options, message):
    with pytest.raises(ValueError, match=message):
        prohull.build(*cube, **options)


def test_unknown_samples_and_files_are_refused(tmp_path):
    with pytest.raises(prohull.InputError, match="unicorn"):
        prohull.sample("unicorn", 100)
    for call in (prohull.build, prohull.read, prohull.load, prohull.robot.Robot.load):
        with pytest.raises(prohull.InputError, match="none.stl: cannot read: there is no such file"):
            call(tmp_path / "none.stl")
        with pytest.raises(FileNotFoundError):
            call(tmp_path / "none.stl")
    (tmp_path / "open.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    with pytest.raises(prohull.InputError, match="open.off: "):
        prohull.build(tmp_path / "open.off", repair="none")


def test_the_package_needs_nothing_but_numpy():
    code = ("import sys, prohull; "
            "print([m for m in ('trimesh', 'open3d', 'matplotlib', 'pytest', 'dask', 'distributed') if m in sys.modules], prohull.__all__)")
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.startswith("[]")


def test_tolerances_keep_faces_and_bound_the_distance_of_others():
    mesh = prohull.sample("bracket", 1500)
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.faces)]
    tolerances = np.full(len(mesh.faces), np.inf)
    tolerances[(corners[..., 2] >= 0.5).all(axis=1)] = 0.02
    tolerances[(corners[..., 2] <= 0).all(axis=1)] = 0
    hull = prohull.build(mesh, 600, tolerances=tolerances)
    assert hull.certified
    of_hull = {row.tobytes() for row in np.asarray(hull.vertices)[np.asarray(hull.faces)]}
    kept = corners[tolerances == 0]
    rolled = [{np.roll(t, k, axis=0).tobytes() for k in range(3)} for t in kept]
    assert len(kept) > 10 and all(of_hull & of_face for of_face in rolled)


@pytest.mark.parametrize("tolerances", [[0.1], "far", [[0.1, 0.2]], 0.1])
def test_tolerances_that_are_none_are_refused(tolerances):
    with pytest.raises(prohull.InputError, match="toleranc"):
        prohull.build(prohull.sample("box", 100), 50, tolerances=tolerances)


def two_pyramids(levels=3):
    """On a square, with four times as many faces for each level; symmetric along all axes."""
    vertices = [(-1.0, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, -1), (0, 0, 1)]
    faces = [(0, 1, 5), (1, 2, 5), (2, 3, 5), (3, 0, 5), (1, 0, 4), (2, 1, 4), (3, 2, 4), (0, 3, 4)]
    for _ in range(levels):
        middles, finer = {}, []
        for a, b, c in faces:
            for v, w in ((a, b), (b, c), (c, a)):
                if (min(v, w), max(v, w)) not in middles:
                    middles[min(v, w), max(v, w)] = len(vertices)
                    vertices.append(tuple(np.add(vertices[v], vertices[w]) / 2))
            ab, bc, ca = (middles[min(v, w), max(v, w)] for v, w in ((a, b), (b, c), (c, a)))
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    round_ones = np.array(vertices)
    return round_ones / np.linalg.norm(round_ones, axis=1, keepdims=True) ** 0.5, np.array(faces)


def is_mirrored(mesh, axis):
    vertices = {tuple(v) for v in np.asarray(mesh.vertices).tolist()}
    return all(tuple(-x if i == axis else x for i, x in enumerate(v)) in vertices for v in vertices)


def test_a_symmetric_hull_is_its_own_mirror_image():
    vertices, faces = two_pyramids()
    hull = prohull.build(vertices, faces, 40, mirror="x")
    assert hull.certified and is_mirrored(hull, 0)
    levels = [hull.level(n) for n in range(40, 200, 2)]
    assert all(is_mirrored(level, 0) and level.certified for level in levels)
    assert is_mirrored(pickle.loads(pickle.dumps(hull)).level(99), 0)


def test_a_symmetric_hull_that_was_loaded_stays_so_or_is_refused(tmp_path):
    vertices, faces = two_pyramids()
    vertices = np.round(vertices * 2**30) / 2**30 + [1 + 2**-28, 0, 0]  # doubles, and no float32
    prohull.build(vertices, faces, 40, mirror="x", levels=True).save(tmp_path / "hull.phull")
    prohull.load(tmp_path / "hull.phull").save(tmp_path / "any.stl")
    known = prohull.load(tmp_path / "hull.phull", mirror="x")
    assert known.level(99)._core.is_symmetric("x")
    with pytest.raises(prohull.InputError, match="is not symmetric any more"):
        known.save(tmp_path / "hull.stl")
    assert not (tmp_path / "hull.stl").exists()
    prohull.build(prohull.sample("bracket", 500), 50, levels=True).save(tmp_path / "bracket.phull")
    with pytest.raises(prohull.InputError, match="not symmetric along x; leave mirror out"):
        prohull.load(tmp_path / "bracket.phull", mirror="x")


def test_a_mesh_that_is_not_symmetric_is_refused():
    with pytest.raises(prohull.InputError, match="not exactly symmetric: .* has no mirror image in the plane x = "):
        prohull.build(prohull.sample("bracket", 500), 50, mirror="x")
    with pytest.raises(prohull.InputError, match="mirror='w': expected one of x, y, z"):
        prohull.build(prohull.sample("bracket", 500), 50, mirror="w")


def test_the_verdict_is_that_of_verify(pony, tmp_path):
    hull = prohull.build(pony, 300, levels=True)
    assert hull.verdict and hull.verdict is hull.verdict and hull.verdict.original_closed
    assert hull.verdict.void_ratio == pytest.approx(hull.void_ratio)
    assert hull.level(600).verdict.void_ratio < hull.verdict.void_ratio
    hull.save(tmp_path / "pony.phull")
    assert prohull.load(tmp_path / "pony.phull").verdict.encloses
    gap = prohull.build(pony, 60, gap="1%").verdict
    assert gap and gap.least_distance > 0


def test_the_verdict_of_an_open_mesh_closes_what_build_has_closed(pony):
    vertices, faces = pony.vertices, pony.faces[:-1]
    inner = prohull.build((vertices, faces), 40, side="inner")
    assert inner.verdict and inner.verdict.proof == "enclosure"
    kept = prohull.build((vertices, faces), 40, open_shells="keep")
    assert kept.verdict and kept.verdict.proof == "coverage" and not kept.verdict.original_closed


def test_verify_ends_after_so_many_steps(pony):
    hull = prohull.build(pony, 60, gap="1%")
    found = prohull.verify(hull, pony, gap="1%", steps=1000)
    assert not found and found.encloses and not found.keeps_gap and found.faces_too_near == 0
    assert 0 < found.faces_undecided and found.gap is None and "ended before" in found.why_not
    assert prohull.verify(hull, pony, gap="1%", steps=10**9)
    with pytest.raises(prohull.InputError, match="steps=0: expected a whole number, at least 1"):
        prohull.verify(hull, pony, steps=0)
