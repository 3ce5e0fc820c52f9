"""A real cluster of two processes, of which some are killed. Skipped without dask, but for what is told then."""

import csv
import json
import os
import signal
import subprocess
import sys

import numpy as np
import prohull
import pytest

try:
    import dask
    import distributed
except ImportError as missing:
    needs_dask = pytest.mark.skip(reason=f"clusters are not tested: {missing}")
else:
    import prohull.dask  # outside: what is wrong with ours is no reason to skip

    needs_dask = pytest.mark.filterwarnings("ignore:make_current is deprecated")

KILLER = "killer.off"
TAKES_A_WHILE = dict(target_faces=300, tight=True, best_of=2)


def test_without_dask_it_is_told_what_to_install():
    code = "import sys; sys.modules['distributed'] = None; import prohull; import prohull.dask"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.returncode == 1 and "ImportError: prohull.dask needs dask" in run.stderr
    assert "python3-dask" in run.stderr and "python3-distributed" in run.stderr


class KilledByOneMesh:
    """Makes a worker die of the mesh KILLER, as if native code had crashed."""

    def setup(self, worker):
        build = prohull.build

        def deadly(mesh, *arguments, **options):
            if isinstance(mesh, str) and mesh.endswith(KILLER):
                os.kill(os.getpid(), signal.SIGKILL)
            return build(mesh, *arguments, **options)

        prohull.build = deadly


@pytest.fixture(scope="module")
def client():
    """A task that two workers died of is given up, and a dead worker is not called for half a minute."""
    with dask.config.set({"distributed.scheduler.allowed-failures": 1, "distributed.comm.timeouts.connect": "10s"}):
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None,
                                      host="127.0.0.1", silence_logs="CRITICAL") as cluster:
            with distributed.Client(cluster) as client:
                yield client


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Six meshes, one of them below another folder, and one file that is none."""
    folder = tmp_path_factory.mktemp("meshes")
    (folder / "more").mkdir()
    for i in range(5):
        prohull.sample("asteroid", 3000 + 100 * i).save(folder / f"mesh{i}.off")
    prohull.sample("torus", 500).save(folder / "more" / "torus.PLY")
    (folder / "bad.stl").write_text("nothing")
    (folder / "notes.txt").write_text("no mesh")
    return folder


def statuses(rows):
    return {row.name: row.status for row in rows}


def of_report(out):
    with open(out / "report.csv", newline="") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


def times_of_change(out):
    return {path: path.stat().st_mtime_ns for path in out.rglob("*.stl")}


class KillOneAtWork:
    """Progress that kills a worker while it has tasks, once the first hull is there."""

    def __init__(self, client):
        self.client = client
        self.pids = client.run(os.getpid)
        self.killed = None
        self.told = []

    def __call__(self, done, total, failed):
        self.told.append((done, total, failed))
        if done >= 1 and not self.killed:
            self.killed = next(address for address, tasks in self.client.processing().items() if tasks)
            os.kill(self.pids[self.killed], signal.SIGKILL)


@needs_dask
def test_a_killed_worker_costs_nothing_but_time(client, folder, tmp_path):
    progress = KillOneAtWork(client)
    rows = prohull.dask.build_folder(client, folder, tmp_path, progress=progress, **TAKES_A_WHILE)
    meshes = [f"mesh{i}.off" for i in range(5)]
    assert progress.killed and progress.pids[progress.killed] not in client.run(os.getpid).values()
    assert statuses(rows) == {"bad.stl": "refused", **dict.fromkeys([*meshes, "more/torus.PLY"], "built")}
    assert [row.name for row in rows] == ["bad.stl", *meshes, "more/torus.PLY"]
    assert "bad.stl: " in rows[0].message and not (tmp_path / "bad.stl.stl").exists()
    for row in rows[1:]:
        assert row.file == str(tmp_path / f"{row.name}.stl") and row.faces == 300 and row.seconds > 0
        assert prohull.verify(row.file, folder / row.name)
    assert progress.told[-1] == (7, 7, 1) and [done for done, _, _ in progress.told] == sorted(
        done for done, _, _ in progress.told)
    report = of_report(tmp_path)
    assert list(report) == [row.name for row in rows] and float(report["mesh3.off"]["void_ratio"]) == rows[4].void_ratio
    assert not list(tmp_path.rglob(".*")), "nothing half-written is left"


@needs_dask
def test_long_arrays_of_options_are_compared_number_by_number(client, tmp_path):
    part, tolerances = prohull.sample("sphere", 2000), np.full(2000, np.inf)
    tolerances = tolerances[:len(part.faces)]
    built = [prohull.dask.build_folder(client, [part], tmp_path, 100, suffix=".ply", progress=None, tolerances=tolerances)[0]]
    tolerances = tolerances.copy()
    tolerances[1000] = 0
    for _ in range(2):
        built += prohull.dask.build_folder(client, [part], tmp_path, 100, suffix=".ply", progress=None, tolerances=tolerances)
    assert [row.status for row in built] == ["built", "built", "kept"]


@needs_dask
def test_what_is_finished_is_kept(client, folder, tmp_path, monkeypatch):
    options = dict(target_faces=300, progress=None)
    few = [folder / f"mesh{i}.off" for i in range(3)]
    first = prohull.dask.build_folder(client, few, tmp_path, **options)
    times = times_of_change(tmp_path)
    assert len(times) == 3

    again = prohull.dask.build_folder(client, few, tmp_path, **options)
    assert times_of_change(tmp_path) == times and set(statuses(again).values()) == {"kept"}
    assert [row._replace(status="built") for row in again] == first

    os.utime(few[0])  # a mesh that changed
    (tmp_path / "mesh1.off.stl").write_text("cut off")  # a hull that did
    os.remove(tmp_path / "mesh2.off.stl.json")  # a run that ended before this one counted
    assert set(statuses(prohull.dask.build_folder(client, few, tmp_path, **options)).values()) == {"built"}
    monkeypatch.setattr(prohull, "__version__", "0.0.1")  # an upgrade
    assert set(statuses(prohull.dask.build_folder(client, few, tmp_path, **options)).values()) == {"built"}
    options["target_faces"] = 200
    assert set(statuses(prohull.dask.build_folder(client, few, tmp_path, **options)).values()) == {"built"}


@needs_dask
def test_an_interrupted_run_goes_on(client, folder, tmp_path):
    meshes = [folder / f"mesh{i}.off" for i in range(5)]
    with pytest.raises(KeyboardInterrupt):
        prohull.dask.build_folder(client, meshes, tmp_path, progress=lambda done, total, failed: done < 2)
    assert not (tmp_path / "report.csv").exists()
    rows = prohull.dask.build_folder(client, meshes, tmp_path, progress=None)
    assert {row.status for row in rows} <= {"built", "kept"} and sum(row.status == "kept" for row in rows) >= 2


@needs_dask
def test_a_mesh_that_kills_is_a_row(client, folder, tmp_path):
    meshes = {name: folder / "mesh0.off" for name in ("a", "b", "c", "d")}
    meshes["killer"] = tmp_path / KILLER
    prohull.sample("torus", 200).save(tmp_path / KILLER)
    client.register_worker_plugin(KilledByOneMesh(), name="killed")
    try:
        rows = prohull.dask.build_folder(client, meshes, tmp_path / "out", target_faces=300, progress=None)
    finally:
        client.unregister_worker_plugin("killed")
        client.wait_for_workers(2, timeout=120)  # those that died begin anew; without them, the next test would wait for ever
    assert statuses(rows) == {"a": "built", "b": "built", "c": "built", "d": "built", "killer": "failed"}
    assert "KilledWorker" in rows[-1].message and of_report(tmp_path / "out")["killer"]["status"] == "failed"


@needs_dask
def test_a_fleet_of_robots(client, tmp_path):
    prohull.sample("pony", 800).save(tmp_path / "part.ply")
    link = '<robot name="r"><link name="l"><visual><geometry><mesh filename="part.ply"/></geometry></visual></link></robot>'
    (tmp_path / "good.urdf").write_text(link)
    (tmp_path / "bad.urdf").write_text(link.replace("part", "none"))
    out = tmp_path / "out"
    for _ in range(2):
        good, bad = prohull.dask.build_robots(client, [tmp_path / "good.urdf", tmp_path / "bad.urdf"], out, 100,
                                              gap=0.01, progress=None)
        assert (good.status, good.links, good.hulls, bad.status) == ("built", 1, 1, "refused") and "none.ply" in bad.message
        assert prohull.robot.Robot.load(good.file).check().passes
    with open(out / "robots.csv", newline="") as file:
        assert [row["name"] for row in csv.DictReader(file)] == ["good", "bad"]
    left, = prohull.dask.build_robots(client, [tmp_path / "bad.urdf"], out, skip_missing=True, progress=None)
    assert (left.status, left.hulls) == ("built", 0) and "left as it is: " in left.message and "none.ply" in left.message
    (tmp_path / "odd.xml").write_text('<mujoco><worldbody><body name="a"><geom type="ellipsoid" size="1 2 3"/></body>'
                                      "</worldbody></mujoco>")
    odd, = prohull.dask.build_robots(client, [tmp_path / "odd.xml"], out, progress=None)
    assert odd.status == "failed" and "ellipsoid is not read" in odd.message
    with pytest.raises(prohull.InputError, match="another robot is called good"):
        prohull.dask.build_robots(client, [tmp_path / "good.urdf", tmp_path / "good.sdf"], out)
    with pytest.raises(TypeError, match="paddin"):
        prohull.dask.build_robots(client, [], out, paddin=1)


@needs_dask
def test_robots_are_where_their_rows_say(client, tmp_path, monkeypatch):
    prohull.sample("pony", 800).save(tmp_path / "part.ply")
    (tmp_path / "bare").write_text(  # the robot that is written has a suffix
        '<robot name="r"><link name="l"><visual><geometry><mesh filename="part.ply"/></geometry></visual></link></robot>')
    (tmp_path / "budgets.yaml").write_text("links:\n  l: {faces: 60}\n")
    monkeypatch.chdir(tmp_path)  # where no worker is
    row, = prohull.dask.build_robots(client, ["bare"], "out", 100, budgets="budgets.yaml", cache="kept", progress=None)
    assert row.status == "built" and row.file == str(tmp_path / "out" / "bare" / "bare.urdf") and row.faces <= 60
    assert prohull.robot.Robot.load(row.file).check().passes and any((tmp_path / "kept").iterdir())


@needs_dask
def test_meshes_may_be_objects(client, cube, tmp_path):
    solid = prohull.Mesh(*cube)
    rows = prohull.dask.build_folder(client, [cube, solid, (cube[0], cube[1][:3, :2])], tmp_path, suffix=".ply",
                                     target_faces=12, progress=None)
    assert statuses(rows) == {"000000": "built", "000001": "built", "000002": "refused"}
    assert "expected (m, 3)" in rows[2].message and rows[0].void_ratio == 0
    assert prohull.verify(tmp_path / "000001.ply", cube)
    named = {"sub/cube": cube, "gone": tmp_path / "gone.stl", "0": (2 * cube[0], cube[1]), "none": None,
             "empty": (np.zeros((0, 3)), np.zeros((0, 3), int)), "ragged": ([[0, 1], [0]], cube[1])}
    others = {"gone": "failed", "none": "refused", "empty": "refused", "ragged": "refused"}
    rows = prohull.dask.build_folder(client, named, tmp_path, suffix=".ply", target_faces=12, progress=None)
    assert statuses(rows) == {"sub/cube": "built", "0": "built", **others} and "gone.stl" in rows[1].message
    named["0"] = (3 * cube[0], cube[1])
    rows = prohull.dask.build_folder(client, named, tmp_path, suffix=".ply", target_faces=12, progress=None)
    assert statuses(rows) == {"sub/cube": "kept", "0": "built", **others}


@needs_dask
def test_levels_of_a_convex_mesh(client, tmp_path):
    ball = prohull.sample("sphere", 600)
    rows = prohull.dask.build_folder(client, {"ball": ball}, tmp_path, suffix=".phull", target_faces=100, progress=None)
    assert statuses(rows) == {"ball": "built"}
    assert prohull.load(tmp_path / "ball.phull").levels


@needs_dask
@pytest.mark.parametrize("meshes, options, error, message", [
    ("nowhere", {}, prohull.InputError, "nowhere: no folder"),
    (["a/x.stl", "b/x.stl"], {}, prohull.InputError, "b/x.stl: another mesh is called x.stl"),
    (".", {}, prohull.InputError, "would be meshes of the next run"),
    ({"../x": "x.stl"}, {}, prohull.InputError, "'../x': a name of a mesh is a path within"),
    ({}, {"faces": [4]}, TypeError, "faces"),
    ({}, {"facets": 4}, TypeError, "facets"),
    ({}, {"target_faces": [100, 200]}, prohull.InputError, "expected one number"),
    ({"a/b": "x.stl", "./a/b": "x.stl"}, {}, prohull.InputError, "'./a/b' and 'a/b' are one name"),
    ({}, {"suffix": ".xyz"}, prohull.InputError, "suffix='.xyz': expected one of .ply"),
    ({}, {"suffix": ".phull", "levels": False}, prohull.InputError, "these files hold levels"),
    ({}, {"suffix": ".phull", "tight": True}, prohull.InputError, "a tight hull has no levels"),
])
def test_wrong_arguments_are_named(tmp_path, meshes, options, error, message):
    with pytest.raises(error, match=message):
        prohull.dask.build_folder(None, meshes, "." if meshes == "." else tmp_path / "out", **options)
    assert not (tmp_path / "out").exists()


@pytest.fixture(scope="module")
def huge():
    """As huge as a test can have it."""
    return prohull.sample("pony", 60_000)


def same_bits(hull, other):
    return hull.vertices.tobytes() == other.vertices.tobytes() and hull.faces.tobytes() == other.faces.tobytes()


@needs_dask
def test_a_huge_mesh_in_parts(client, huge):
    told = []
    hull = prohull.dask.build_partitioned(client, huge, 500, parts=5, progress=lambda *state: told.append(state))
    assert hull.certified and hull.proof == "enclosure" and len(hull.faces) == 500 and hull.self_intersections == 0
    assert hull.original is huge and not hull.levels and hull.verify_seconds > 0 and prohull.verify(hull, huge)
    assert told == [(n, 6, 0) for n in range(1, 7)]
    voids = [prohull.build(huge, 500, seed=seed).void_ratio for seed in range(9)]
    assert hull.void_ratio < 1.02 * max(voids), "no more than one build has by chance"

    kill = KillOneAtWork(client)
    other = prohull.dask.build_partitioned(client, huge, 500, parts=5, progress=kill)
    assert kill.killed and kill.pids[kill.killed] not in client.run(os.getpid).values()
    assert same_bits(hull, other)


@needs_dask
def test_parts_share_no_vertex_and_lose_no_face(huge):
    home = np.full(len(huge.faces), -1)
    lowest, highest = (getattr(huge.vertices[huge.faces], name)(axis=1) for name in ("min", "max"))
    for i, (own, others, box) in enumerate(prohull.dask._boxes(huge, 7)):
        assert (home[own] == -1).all() and abs(len(own) - len(home) / 7) < 20
        home[own] = i
        inside = ((lowest > box[0]) & (highest < box[1])).all(axis=1)
        reaching = ((highest >= box[0]) & (lowest <= box[1])).all(axis=1)
        assert inside[own].sum() == inside.sum() > len(own) / 2, "what may change is its own"
        assert np.array_equal(np.sort(np.concatenate([own, others])), np.flatnonzero(reaching))
    assert (home >= 0).all()


@needs_dask
def test_parts_of_other_hulls(client, huge, cube, tmp_path):
    build = prohull.dask.build_partitioned
    huge.save(tmp_path / "huge.ply")
    inner = build(client, tmp_path / "huge.ply", 500, parts=3, side="inner", progress=None)
    assert inner.certified and inner.side == "inner" and inner.void_ratio < 0 and prohull.verify(inner, huge)
    rounded = build(client, huge, 500, parts=2, float32_coordinates=True, threads=2, progress=None)
    assert rounded.certified and (rounded.vertices == rounded.vertices.astype(np.float32)).all()
    tight = build(client, prohull.sample("torus", 8000), 300, parts=2, tight=True, progress=None)
    assert tight.certified and len(tight.faces) <= 300
    for parts in (1, 20):  # also more than there are faces
        small = build(client, cube, 12, parts=parts, progress=None)
        assert small.certified and small.void_ratio == 0


@needs_dask
def test_wrong_huge_meshes(client, cube):
    vertices, faces = cube
    build = prohull.dask.build_partitioned
    with pytest.raises(prohull.InputError, match="takes a closed 2-manifold"):
        build(client, (vertices, faces[1:]))
    with pytest.raises(prohull.InputError, match="inside out"):
        build(client, (vertices, faces[:, ::-1]))
    with pytest.raises(prohull.InputError, match="parts=0"):
        build(client, cube, parts=0)
    with pytest.raises(prohull.InputError, match="expected one number"):
        build(client, cube, [100, 200])
    with pytest.raises(prohull.InputError, match="side='up'"):
        build(client, cube, side="up", progress=None)
    with pytest.raises(KeyboardInterrupt):
        build(client, cube, progress=lambda *state: False)


@pytest.fixture(scope="module")
def segments(random):
    return random().uniform(-1.5, 1.5, size=(5000, 6))


@needs_dask
@pytest.mark.parametrize("kind", ["first_hit", "any_hit", "all_hits"])
@pytest.mark.parametrize("engine", ["auto", "paper-refinement",
                                    prohull.Refinement(paper=True, queries_per_roll_back=50)])
def test_answers_are_the_local_ones(client, hull, segments, kind, engine):
    local = getattr(hull.original, kind)(segments=segments, engine=engine)
    told = []
    remote = prohull.dask.query(client, hull.original, segments.reshape(-1, 2, 3), kind, chunk=1000, engine=engine,
                                progress=lambda *state: told.append(state))
    assert type(remote) is type(local) and told[-1] == (5000, 5000, 0) and len(told) == 5
    for ours, theirs in zip([remote] if kind == "any_hit" else remote, [local] if kind == "any_hit" else local):
        assert ours.dtype == theirs.dtype and ours.shape == theirs.shape and ours.tobytes() == theirs.tobytes()
    assert (local.sum() if kind == "any_hit" else (local.face >= 0).sum()) > 500


@needs_dask
def test_answers_survive_a_killed_worker(client, hull, segments):
    many = np.tile(segments, (4, 1))
    kill = KillOneAtWork(client)
    remote = prohull.dask.query(client, hull.original, many, "all_hits", chunk=512, engine="refinement", progress=kill)
    assert kill.killed
    for ours, theirs in zip(remote, hull.original.all_hits(segments=many)):
        assert np.array_equal(ours, theirs)


@needs_dask
def test_no_segments_and_wrong_ones(client, pony, segments):
    for kind in ("first_hit", "all_hits"):
        for ours, theirs in zip(prohull.dask.query(client, pony, np.zeros((0, 6)), kind),
                                getattr(pony, kind)(segments=np.zeros((0, 6)))):
            assert ours.shape == theirs.shape and ours.dtype == theirs.dtype
    wrong = segments.copy()
    wrong[1234, 5] = np.nan
    for ask in (pony.first_hit, lambda segments: prohull.dask.query(client, pony, segments)):
        with pytest.raises(prohull.InputError, match="query 1234 has a coordinate"):
            ask(segments=wrong)
    with pytest.raises(prohull.InputError, match="engine='magic'"):
        prohull.dask.query(client, pony, segments, engine="magic")
    with pytest.raises(prohull.InputError, match="kind='hits'"):
        prohull.dask.query(client, pony, segments, "hits")


@needs_dask
def test_progress_is_shown(capsys, monkeypatch):
    for done in (1, 2):
        prohull.dask.show(done, 2, 1)
    assert capsys.readouterr().err == "prohull: 2 of 2 done, 1 failed\n"
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    for done in (1, 2):
        prohull.dask.show(done, 2, 1)
    assert capsys.readouterr().err == "\rprohull: 1 of 2 done, 1 failed\rprohull: 2 of 2 done, 1 failed\n"
