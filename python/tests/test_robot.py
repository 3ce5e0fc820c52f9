import json
import math
import re

import numpy as np
import prohull
import prohull.robot
import pytest
from prohull import _prohull

URDF = """<?xml version="1.0"?>
<robot name="crane">
  <link name="base">
    <visual><geometry><mesh filename="base.ply"/></geometry></visual>
    <collision><geometry><box size="0.01 0.01 0.01"/></geometry></collision>
  </link>
  <link name="arm">
    <visual><origin xyz="0 0 1"/><geometry><mesh filename="arm.ply" scale="0.5 0.5 0.5"/></geometry></visual>
    <collision><geometry><box size="90 90 90"/></geometry></collision>
  </link>
  <link name="tool"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="0 0 5"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="hold" type="fixed"><parent link="arm"/><child link="tool"/></joint>
</robot>
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    folder = tmp_path_factory.mktemp("crane")
    prohull.sample("torus", 800).save(folder / "base.ply")
    prohull.sample("pony", 1500).save(folder / "arm.ply")
    (folder / "crane.urdf").write_text(URDF)
    return folder / "crane.urdf"


@pytest.fixture(scope="module")
def robot(path):
    return prohull.robot.Robot.load(path)


@pytest.fixture(scope="module")
def hulls(robot):
    return robot.hulls([100, 60], gap=0.01)


def test_a_robot_has_links_and_joints(robot):
    assert robot.name == "crane" and [link.name for link in robot.links] == ["base", "arm", "tool"]
    turn, hold = robot.joints
    assert (turn.name, turn.type, turn.parent, turn.child) == ("turn", "revolute", "base", "arm")
    assert (turn.lower, turn.upper, turn.axis) == (-1, 2, (0, 0, 1)) and turn.origin[2, 3] == 5 and hold.type == "fixed"
    pony = prohull.read(str(robot.path).replace("crane.urdf", "arm.ply"))
    assert np.allclose(np.ptp(robot.links[1].visual.vertices, axis=0), np.ptp(pony.vertices, axis=0) / 2)
    assert robot.links[0].collision.volume == pytest.approx(1e-6)


def test_poses_follow_the_joints(robot):
    for positions in ({"turn": math.pi / 2}, [math.pi / 2, 0]):
        poses = robot.poses(positions)
        assert poses.shape == (3, 4, 4)
        assert np.allclose(poses[1] @ [1, 0, 0, 1], [0, 1, 5, 1]) and np.allclose(poses[2], poses[1])
    assert np.array_equal(robot.poses()[0], np.eye(4))
    with pytest.raises(prohull.InputError, match="no joint 'twist'"):
        robot.poses({"twist": 1})
    with pytest.raises(prohull.InputError, match="1 numbers for 2 joints"):
        robot.poses([1])


def test_hulls_are_certified_in_the_frame_that_they_tell(robot, hulls):
    assert hulls.certified and [link.status for link in hulls] == ["hulled"] * 3  # also a ball gets a gap
    for link in robot.links[:2]:
        for hull, faces in zip(hulls[link.name].hulls, (100, 60)):
            assert len(hull.mesh.faces) <= faces == hull.target_faces
            assert hull.verdict.proof == "padding" and hull.verdict.gap >= 0.01 and hull.volume_ratio > 1
            assert not hull.volume_ratio_is_estimated
            in_link = hull.mesh.vertices @ hull.origin[:3, :3].T + hull.origin[:3, 3]
            assert prohull.Mesh(in_link, hull.mesh.faces).contains(link.visual.vertices).all()
    with pytest.raises(KeyError):
        hulls["head"]


def test_a_saved_robot_passes_its_check(robot, hulls, tmp_path):
    shipped = robot.check()
    assert not shipped and not shipped.passes
    assert [link.verdict for link in shipped.links] == ["leaks", "covered", "no-collision"]
    assert shipped["base"].sticks_out_at_least > 0.1 and not shipped["base"].passes
    assert len(shipped["base"].worst_point) == 3 and all(link.worst_point is None for link in shipped.links[1:])
    written = hulls.save(tmp_path / "safe", package="crane_safe")
    assert (tmp_path / "safe" / "package.xml").exists() and all((tmp_path / "safe").as_posix() in name for name in written)
    safe = prohull.robot.Robot.load(tmp_path / "safe" / "crane.urdf", [tmp_path / "safe"])
    assert safe.check().passes
    hulls.report_html(tmp_path / "report.html", check=shipped, motion=hulls.motion(20))
    assert "crane" in (tmp_path / "report.html").read_text(encoding="utf-8")
    with pytest.raises(prohull.InputError, match="No such file"):
        hulls.report_html(tmp_path / "nowhere" / "report.html")
    with pytest.raises(prohull.InputError, match="would be overwritten"):
        hulls.save(path_of(robot))


def test_a_saved_robot_becomes_mjcf(robot, hulls, tmp_path):
    written = hulls.save(tmp_path / "mujoco", to="mjcf")
    assert str(tmp_path / "mujoco" / "crane.xml") in written and str(tmp_path / "mujoco" / "crane_60.xml") in written
    again = prohull.robot.Robot.load(tmp_path / "mujoco" / "crane.xml")
    assert again.check().passes and np.allclose(again.poses({"turn": 1}), robot.poses({"turn": 1}))
    text = (tmp_path / "mujoco" / "crane.xml").read_text(encoding="utf-8")
    assert '<exclude body1="base" body2="arm"/>' in text
    for wrong in ({"to": "sdf"}, {"to": "mjcf", "package": "crane_safe"}):
        with pytest.raises(prohull.InputError):
            hulls.save(tmp_path / "none", **wrong)


def path_of(robot):
    return str(robot.path).replace("crane.urdf", "")


def test_links_get_convex_pieces(robot, tmp_path):
    made = robot.hulls(collision="convex", pieces=3, vertices=20)
    assert made.certified and [link.status for link in made] == ["hulled", "hulled", "primitives"]
    for link in robot.links[:2]:
        hull, = made[link.name].hulls
        assert hull.verdict.distance_to_triangles[1] >= hull.verdict.distance_bound > 0 and made[link.name].non_finite_faces == 0
        assert 1 <= len(hull.pieces) <= 3 and hull.verdict.proof == "union" and hull.spheres.shape == (0, 4)
        assert all(len(piece.vertices) <= 20 for piece in hull.pieces)
        assert len(hull.mesh.faces) == sum(len(piece.faces) for piece in hull.pieces)
        if np.array_equal(hull.origin, np.eye(4)):
            assert prohull.verify_union(hull.pieces, link.visual)
    written = made.save(tmp_path / "convex")
    assert any(name.endswith("base_01.stl") for name in written)
    assert prohull.robot.Robot.load(tmp_path / "convex" / "crane.urdf").check().passes


def test_what_was_left_as_it_is_is_not_certified(tmp_path):
    (tmp_path / "s.urdf").write_text('<robot name="s"><link name="t"><visual><geometry><mesh filename="missing.stl"/>'
                                     "</geometry></visual></link></robot>")
    made = prohull.robot.Robot.load(tmp_path / "s.urdf").hulls(skip_missing=True)
    assert not made.certified and repr(made) == "<prohull.robot.Hulls: s, 0 hulls, 1 link left as it was>"


def test_links_get_spheres(robot, tmp_path):
    made = robot.hulls(collision="spheres", spheres=12)
    assert made.certified and made["tool"].hulls == [] and made["base"].hulls[0].pieces == []
    balls = made["base"].hulls[0].spheres
    assert balls.shape[1] == 4 and 1 <= len(balls) <= 12 and prohull.verify_union(balls, robot.links[0].visual)
    assert any(name.endswith("crane_spheres.yaml") for name in made.save(tmp_path / "spheres"))


def test_motion_misses_nothing(hulls):
    motion = hulls.motion(50, seed=3)
    assert motion.missed == 0 and "disable_collisions" in motion.srdf
    assert "sampled" not in motion.srdf and "sampled" in hulls.motion(50, seed=3, sampled_pairs=True).srdf
    assert motion.pairs == hulls.motion(50, seed=3, threads=1).pairs


def test_pictures(robot, hulls):
    for shown in (robot, hulls):
        assert shown._repr_png_().startswith(b"\x89PNG") and "crane" in repr(shown)


def test_what_is_wrong_is_told(path, robot, tmp_path):
    (tmp_path / "none.urdf").write_text(URDF)
    broken = prohull.robot.Robot.load(tmp_path / "none.urdf")
    with pytest.raises(prohull.InputError, match="mesh files were not found"):
        broken.hulls()
    assert [link.status for link in broken.hulls(skip_missing=True)] == ["skipped", "skipped", "primitives"]
    with pytest.raises(prohull.InputError, match="base.ply"):
        broken.links[0].visual
    with pytest.raises(prohull.InputError):
        prohull.robot.Robot.load(tmp_path / "nothing.urdf")


@pytest.mark.parametrize("options, message", [
    ({"faces": 3}, "faces=3: expected a whole number of at least 4"),
    ({"faces": 30.7}, "faces=30.7: expected a whole number"),
    ({"faces": "x"}, "faces='x': expected a whole number"),
    ({"faces": None}, "faces=None: expected a whole number"),
    ({"faces": []}, "expected a whole number"),
    ({"max_distance": -1}, "max_distance=-1: expected a number"),
    ({"max_distance": math.nan}, "max_distance=nan: expected a number"),
    ({"max_distance": 0}, "max_distance=0: expected a number greater than 0, or None"),
    ({"max_distance": "2mm"}, "max_distance='2mm': expected a number"),
    ({"gap": -0.1}, "gap=-0.1: expected a number, at least 0"),
    ({"gap": math.inf}, "gap=inf: expected a number"),
    ({"gap": 10**400}, "expected a number"),
    ({"threads": -1}, "threads=-1: expected a whole number, at least 0"),
    ({"threads": 1.5}, "threads=1.5: expected a whole number"),
    ({"format": "fbx"}, "format='fbx': expected one of stl, obj, glb"),
    ({"collision": "boxes"}, "collision='boxes': expected one of hull, convex, spheres"),
    ({"collision": "convex", "pieces": 0}, "pieces=0: expected a whole number, at least 1"),
    ({"collision": "convex", "vertices": 3}, "vertices=3: expected a whole number, at least 4"),
    ({"collision": "spheres", "spheres": 1.5}, "spheres=1.5: expected a whole number"),
    ({"collision": "spheres", "gap": 0.1}, "gap"),
    ({"from_": "inertial"}, "from_='inertial': expected one of visual, collision"),
])
def test_wrong_options_are_named(robot, options, message):
    with pytest.raises(prohull.InputError, match=message):
        robot.hulls(**options)


def test_motion_proves_what_it_says_of_pairs(tmp_path):
    links = "".join(f'<link name="l{i}"><visual><geometry><box size="1 1 1"/></geometry></visual></link>'
                    for i in range(3))
    joints = "".join(
        f'<joint name="j{i}" type="prismatic"><parent link="l{i}"/><child link="l{i + 1}"/><origin xyz="{x} 0 0"/>'
        f'<axis xyz="-1 0 0"/><limit lower="0" upper="{upper}" effort="1" velocity="1"/></joint>'
        for i, (x, upper) in enumerate([(2, 0.5), (2, "UPPER")]))
    for upper, verdict in (("2.4", "never"), ("2.6", "meets")):
        (tmp_path / "slides.urdf").write_text(f'<robot name="slides">{links}{joints}</robot>'.replace("UPPER", upper))
        hulls = prohull.robot.Robot.load(tmp_path / "slides.urdf").hulls()
        motion = hulls.motion(10)
        (pair,) = (pair for pair in motion.pairs if pair.kind != "adjacent")
        assert pair.proof.verdict == verdict and pair.proof.cells > 0 and pair.proof.why == ""
        assert (pair.kind == "never") == ('reason="Never"' in motion.srdf) == (verdict == "never")
        if verdict == "meets":
            assert pair.proof.visual_meets and pair.proof.positions["j0"] + pair.proof.positions["j1"] >= 3
        else:
            assert pair.proof.proven_free == 1 and pair.proof.positions == {}
        assert all(pair.proof is None for pair in hulls.motion(10, prove=0).pairs)


def test_wrong_options_of_checks_and_motion_are_named(robot, hulls):
    for allow in (-1, math.nan, "1mm"):
        with pytest.raises(prohull.InputError, match="allow=.*: expected a number, at least 0"):
            robot.check(allow)
    for options in ({"configurations": -5}, {"configurations": 2.5}, {"seed": -1}, {"prove": -1}, {"threads": 1 << 40}):
        with pytest.raises(prohull.InputError, match=f"{next(iter(options))}=.*: expected a whole number"):
            hulls.motion(**options)
    assert robot.hulls(np.int32(100), gap=np.float32(0.25)).certified


def test_a_budget_of_no_link_is_told_with_its_line(robot, tmp_path):
    (tmp_path / "budgets.yaml").write_text("links:\n  base: {}\n  head: {skip: true}\n")
    with pytest.raises(prohull.InputError, match="budgets.yaml: line 3: crane has no link 'head'"):
        robot.hulls(budgets=tmp_path / "budgets.yaml")


@pytest.mark.skipif(bool(_prohull.no_page), reason=_prohull.no_page)
def test_robots_are_shown(robot, hulls, path):
    def links(shown):
        facts = json.loads(re.search(r'id="scene">(.*?)</script>', shown.html, re.S)[1])
        assert facts["unit"] == "m" and [o["name"] for o in facts["objects"]] == [shown.names[0]]
        return [tuple(link[which] and link[which]["facts"]["faces"] for which in ("visual", "collision"))
                for link in facts["objects"][0]["links"]]

    faces = [len(link.visual.faces) for link in robot.links]
    assert links(prohull.view(robot)) == links(prohull.view(path)) == list(zip(faces, [12, 12, None]))
    assert links(prohull.view(hulls)) == [(n, len(link.hulls[0].mesh.faces)) for n, link in zip(faces, hulls)]


SLIDE = """<robot name="slide">
  <link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="rail"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="cart"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <joint name="up" type="prismatic"><parent link="base"/><child link="rail"/><origin xyz="0 0 3"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="5" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="rail"/><child link="cart"/><origin xyz="1 0 -3"/><axis xyz="1 0 0"/>
    <limit lower="-2" upper="5" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.fixture
def slide(tmp_path):
    """A base and a cart, cubes of side 1; the joint `slide` says how far they are apart."""
    (tmp_path / "slide.urdf").write_text(SLIDE)
    return prohull.robot.Robot.load(tmp_path / "slide.urdf")


def test_a_path_is_free_or_meets_at_a_known_time(slide, tmp_path):
    free = slide.check_path([[1], [0.5]], ["slide"], distances=True)
    assert free and free.verdict == "free" and free.free_until == 1 and free.pairs == []
    assert free.intervals[0, 0] == 0 and free.intervals[-1, 1] == 1 and len(free.intervals) == len(free.distances)
    assert np.array_equal(free.intervals[1:, 0], free.intervals[:-1, 1])
    assert (free.distances <= 1 - free.intervals[:, 1] / 2).all() and (free.distances >= 0.3).all()
    meets = slide.check_path(np.array([[0, 1.0], [0, -3.0]], dtype=np.float32), times=[10, 12])
    pair, = meets.pairs
    assert not meets and meets.verdict == pair.verdict == "meets" and (pair.a, pair.b) == ("base", "cart")
    assert pair.begin <= 10.5 <= pair.end and pair.end - pair.begin < 1e-9 and meets.free_until == pair.begin
    assert pair.positions == pytest.approx({"up": 0, "slide": 0}, abs=1e-9) and meets.distances.shape == (0,)
    assert not slide.check_path([[1], [1]], ["slide"], velocities=[[-4.5], [4.5]])
    assert not slide.check_path([[1], [0.5]], ["slide"], gap=0.6) and slide.check_path([[1], [0.5]], ["slide"], gap=0.4)
    beyond = slide.check_path([[1], [6]], ["slide"])
    assert beyond.verdict == "free" and beyond.beyond_limits == (1, "slide", 6) and not beyond
    (tmp_path / "path.csv").write_text("slide\n1\n0.5\n")
    assert slide.check_path(tmp_path / "path.csv")


def test_a_checker_serves_many_paths_in_a_world(slide):
    checker = slide.path_checker(world={"post": (prohull.sample("box", 12).vertices * 0.1 + [4, 0, 0],
                                                 prohull.sample("box", 12).faces)})
    assert ("cart", "post") in checker.pairs and ("base", "rail") not in checker.pairs
    assert [checker.check([[1], [end]], ["slide"]).verdict for end in (1.5, 5)] == ["free", "meets"]
    assert checker.check([[1], [5]], ["slide"]).pairs[0].b == "post"
    one, two = (checker.check([[1], [2]], ["slide"], threads=threads, distances=True) for threads in (1, 2))
    assert one[:5] == two[:5] and np.array_equal(one.distances, two.distances)


def test_what_was_turned_is_noted(slide):
    box = prohull.sample("box", 12)
    world = {"room": (box.vertices, box.faces[:, ::-1]), "post": (box.vertices + 9, box.faces)}
    assert [note for note in slide.path_checker(world=world).notes if "inside out" in note] == \
        ["room is inside out: it was turned, so that its inside counts as solid"]


def test_links_are_enclosed_all_along_a_path(slide):
    sweeps = slide.sweep([[0, 1], [2, 4]], links=["cart", "rail"])
    assert list(sweeps) == ["cart", "rail"] and all(sweep.verdict.encloses_solid for sweep in sweeps.values())
    low, high = (f(sweeps["cart"].mesh.vertices, axis=0) for f in (np.min, np.max))
    assert np.allclose(low, [1.5, -0.5, -0.5], atol=0.01) and np.allclose(high, [5.5, 0.5, 2.5], atol=0.01)
    assert math.isnan(sweeps["cart"].volume) and list(slide.sweep([[0, 1]])) == ["base", "rail", "cart"]
    with pytest.raises(prohull.InputError, match="links: the robot has no link 'desk'; it has base, rail, cart"):
        slide.sweep([[0, 1]], links=["desk"])
    with pytest.raises(prohull.InputError, match="links='cart': expected a sequence of names"):
        slide.sweep([[0, 1]], links="cart")
    with pytest.raises(prohull.InputError, match="max_distance=-1"):
        slide.sweep([[0, 1]], max_distance=-1)
    with pytest.raises(prohull.InputError, match="max_distance=0: expected a distance greater than 0"):
        slide.sweep([[0, 1]], max_distance=0)


def test_a_link_without_a_shape_is_not_swept(tmp_path):
    bare = SLIDE.replace('<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>', "")
    (tmp_path / "bare.urdf").write_text(bare)
    robot = prohull.robot.Robot.load(tmp_path / "bare.urdf")
    assert list(robot.sweep([[0, 1]])) == ["base", "cart"] and list(robot.sweep_workspace()) == ["base"]
    for sweep in (lambda: robot.sweep([[0, 1]], links=["cart", "rail"]), lambda: robot.sweep_workspace(links=["rail"])):
        with pytest.raises(prohull.InputError, match="links: 'rail' has no shape"):
            sweep()


def test_rows_of_an_srdf_are_decided(slide, tmp_path):
    rows = [("base", "cart", "Never"), ("base", "cart", "User"), ("base", "rail", "Adjacent"), ("base", "desk", "Never")]
    (tmp_path / "slide.srdf").write_text("<robot name='slide'>\n" + "\n".join(
        f"<disable_collisions link1='{a}' link2='{b}' reason='{reason}'/>" for a, b, reason in rows) + "</robot>")
    found = slide.check_disabled(tmp_path / "slide.srdf")
    assert [row[:3] for row in found] == rows and [row.line for row in found] == [2, 3, 4, 5]
    assert [row.refuted for row in found] == [True, False, False, False]
    assert [row.collision.verdict for row in found] == ["meets", "meets", "adjacent", "unknown"]
    assert found[0].collision.positions["slide"] <= 0 and found[0].visual.verdict == "no-geometry"
    (tmp_path / "slide.srdf").write_text("<robot name='glide'><disable_collisions link1='base' link2='cart'/></robot>")
    with pytest.warns(UserWarning, match="slide.srdf: it is of the robot 'glide', not of 'slide'"):
        assert len(slide.check_disabled(tmp_path / "slide.srdf")) == 1
    assert "not of 'slide'" in slide.path_checker(srdf=tmp_path / "slide.srdf").notes[-1]
    for check in (slide.check_disabled, lambda srdf: slide.path_checker(srdf=srdf)):
        with pytest.raises(prohull.InputError, match="slide.urdf: line 1: it has no element of an SRDF file"):
            check(slide.path)
    (tmp_path / "slide.srdf").write_bytes(b"<robot name='\xff'/>")
    with pytest.raises(prohull.InputError, match="slide.srdf: line 1: no XML"):
        slide.check_disabled(tmp_path / "slide.srdf")


def test_what_is_wrong_with_a_path_is_told(slide, tmp_path):
    for positions, options, message in [
            ([[1]], {}, r"positions: an array of shape \(1, 1\); expected \(n, 2\)"),
            ([1, 2], {}, "positions: an array of shape"),
            ([["a", "b"]], {}, "positions: an array of"),
            (np.empty((0, 2)), {}, "path: there are no rows of positions"),
            ([[0, math.nan]], {}, "path: row 0: positions of joint 'slide': nan is no number"),
            ([[0, 1e308]], {}, "1e\\+308 is no number"),
            ([[0]], {"joints": ["slyde"]}, "the robot has no joint 'slyde'; it has up, slide"),
            ([[0, 1], [0, 2]], {"times": [1, 1]}, "path: row 1: time 1 does not come after 1"),
            ([[0, 1], [0, 2]], {"times": [[1], [2]]}, "times: an array of shape"),
            ([[0, 1], [0, 2]], {"velocities": [[1, 1]]}, "velocities are not of as many rows"),
            ([[0, 1]], {"accelerations": [[1, 1]]}, "there are accelerations, but no velocities"),
            ([[0, 1]], {"gap": -1}, "gap=-1: expected a number, at least 0"),
            ([[0, 1]], {"cells": 1}, "cells=1: expected a whole number, at least 2"),
            ([[0, 1]], {"geometry": "inertial"}, "geometry='inertial': expected one of visual, collision"),
            ([[0, 1]], {"ignore": [("cart", "desk")]}, "is called 'desk'"),
            ([[0, 1]], {"ignore": [("cart", "base")]}, None),
            ([[0, 1]], {"ignore": ["cart", "base"]}, "expected pairs of names, as "),
            ([[0, 1]], {"ignore": "cart"}, "ignore='cart': expected pairs of names"),
            ([[0, 1]], {"world": "table.off"}, "world: 'table.off'; expected meshes by their names"),
            ([[0]], {"joints": "slide"}, "joints='slide': expected a sequence of names"),
            ([[0, 1]], {"world": {"cart": prohull.sample("box", 12)}}, "two bodies are called 'cart'"),
            (tmp_path / "none.csv", {}, None),
            (slide.path, {"times": [1]}, "are those of the file"),
            (slide.path, {}, "slide.urdf: line ")]:
        if message is None and "ignore" in options:
            with pytest.raises(prohull.InputError, match="no pair of bodies"):
                slide.check_path(positions, **options)
        elif message is None:
            with pytest.raises(FileNotFoundError):
                slide.check_path(positions, **options)
        else:
            with pytest.raises(prohull.InputError, match=message):
                slide.check_path(positions, **options)
    with pytest.raises(KeyboardInterrupt):
        slide.check_path([[0, 1], [0, 2]], progress=lambda stage, fraction: False)


def test_positions_of_links_are_enclosed(robot):
    passed = robot.sweep([[0], [1]], ["turn"], links=["tool"])
    assert list(passed) == ["tool"] and passed["tool"].verdict.encloses_solid
    assert passed["tool"].beyond_limits is None
    assert robot.sweep([[0], [9]], ["turn"], links=["tool"])["tool"].beyond_limits == (1, "turn", 9)
    ever = robot.sweep_workspace(links=["tool"], threads=1)
    assert list(ever) == ["base"] and ever["base"].verdict.distance_bound < 0.02
    ball = prohull.sample("sphere", 200)
    where = (0.1 * ball.vertices + [0, 0, 5], ball.faces)
    assert prohull.verify_union(passed["tool"].pieces, where) and prohull.verify_union(ever["base"].pieces, where)
    with pytest.raises(prohull.InputError, match="no link 'hand'"):
        robot.sweep_workspace(links=["hand"])
