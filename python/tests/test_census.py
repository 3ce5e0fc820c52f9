"""scripts/census, which users run with the package."""

import csv
import json
import os
import pathlib
import subprocess
import sys

import prohull
import pytest

CENSUS = pathlib.Path(__file__).parents[2] / "scripts" / "census"


def census(*arguments, packages=pathlib.Path(prohull.__file__).parents[1]):
    environment = {"PYTHONPATH": str(packages), "PATH": "/usr/bin:/bin"}
    return subprocess.run([sys.executable, CENSUS, *arguments], capture_output=True, text=True, env=environment)


LINK = """<link name="{name}"><visual><geometry><mesh filename="ball.obj"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision></link>"""
JOINT = """<joint name="{child}" type="revolute"><parent link="{parent}"/><child link="{child}"/><origin xyz="1.4 0 0"/>
  <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>"""


@pytest.fixture(scope="module")
def robots(tmp_path_factory):
    """A chain of balls that ship with boxes, of which the first and the third meet in some positions."""
    folder = tmp_path_factory.mktemp("robots")
    (folder / "chain").mkdir()
    prohull.sample("sphere", 200).save(folder / "chain" / "ball.obj")
    parts = [LINK.format(name=name) for name in "abc"]
    parts += [JOINT.format(parent=parent, child=child) for parent, child in ("ab", "bc")]
    (folder / "chain" / "chain.urdf").write_text(f'<robot name="chain">{"".join(parts)}</robot>')
    (folder / "chain" / "chain.srdf").write_text('<robot name="chain"><disable_collisions link1="a" link2="c" reason="Never"/>'
                                                 '<disable_collisions link1="a" link2="b" reason="Adjacent"/></robot>')
    (folder / "broken.urdf").write_text("<robot")
    (folder / "<b>.xml").write_text("<mujoco><worldbody><body><geom type='sphere' size='nan'/></body></worldbody></mujoco>")
    (folder / "broken.srdf").write_text("<robot")
    (folder / "package.xml").write_text("<package/>")
    return folder


def test_tells_of_every_robot_and_keeps_it(robots, tmp_path):
    run = census(tmp_path, robots)
    assert run.returncode == 0, run.stderr
    assert "broken.srdf" in run.stderr and "Traceback" not in run.stderr
    rows = {row["robot"]: row for row in json.loads((tmp_path / "census.json").read_text())}
    assert set(rows) == {"<b>.xml", "broken.urdf", "chain/chain.urdf"}
    chain, broken = rows["chain/chain.urdf"], rows["broken.urdf"]
    assert chain["links"] == chain["leaks"] == 3 and 100 < chain["sticks_out_mm"] < 1000 and 0 < chain["volume_ratio"] < 1
    assert chain["srdf_rows"] == 2 and chain["srdf_false"] == 1 and chain["false_rows"] == [["a", "c"]]
    assert broken["why"] and "links" not in broken and str(robots) not in broken["why"]
    table = list(csv.DictReader((tmp_path / "census.csv").open(newline="")))
    assert [row["robot"] for row in table] == sorted(rows)
    assert (tmp_path / "census.md").read_text().count("\n| ") == 2 + len(rows)
    page = (tmp_path / "census.html").read_text()
    assert "&lt;b&gt;.xml" in page and "http" not in page and page.count("<table>") == 2

    kept = tmp_path / "robots" / "chain" / "chain.urdf.json"
    before = kept.stat().st_mtime_ns
    assert census(tmp_path, robots).returncode == 0 and kept.stat().st_mtime_ns == before
    kept.write_text(kept.read_text()[:100])
    (robots / "chain" / "chain.srdf").unlink()
    assert census(tmp_path, robots).returncode == 0
    again = json.loads(kept.read_text())
    assert "srdf_rows" not in again and 0 < again["missed"] < 100 and again["false_stops"] == 0, "boxes inside of balls"
    (robots / "chain" / "ball.obj").write_text("v 0 0 0\nf 1 2 3\n")
    assert census(tmp_path, robots).returncode == 0 and json.loads(kept.read_text())["unchecked"] == 3


def test_another_program_of_the_same_version_checks_again(tmp_path):
    write_ball(tmp_path / "robots" / "ball.urdf")
    package = tmp_path / "packages" / "prohull"
    package.mkdir(parents=True)
    for file in pathlib.Path(prohull.__file__).parent.glob("*.*"):
        (package / file.name).symlink_to(file)
    kept = tmp_path / "out" / "robots" / "ball.urdf.json"
    program, times = pathlib.Path(prohull.__file__).with_name("prohull"), []
    for text in ("", "", "# another one\n"):
        (package / "prohull").write_text(f'#!/bin/sh\n{text}exec {program} "$@"\n')
        (package / "prohull").chmod(0o755)
        assert census(tmp_path / "out", tmp_path / "robots", packages=package.parent).returncode == 0
        times.append(kept.stat().st_mtime_ns)
    assert times[0] == times[1] < times[2]


def test_the_action_judges_a_repository(robots, tmp_path):
    root = CENSUS.parents[1]
    yaml = pytest.importorskip("yaml")
    step, = (step for step in yaml.safe_load((root / "action.yml").read_text())["runs"]["steps"] if step["name"] == "Check robots")
    assert set(step["env"]) == {"FOLDERS"}

    def run(folder):
        summary = tmp_path / "summary.md"
        summary.write_text("")
        environment = {"PYTHONPATH": str(pathlib.Path(prohull.__file__).parents[1]), "PATH": "/usr/bin:/bin", "FOLDERS": str(folder),
                       "GITHUB_ACTION_PATH": str(root), "RUNNER_TEMP": str(tmp_path), "GITHUB_STEP_SUMMARY": str(summary)}
        done = subprocess.run(["bash", "-e", "-c", step["run"]], capture_output=True, text=True, env=environment)
        return done.returncode, done.stderr, summary.read_text()

    code, told, table = run(robots)
    assert code == 1 and "covered: 0 of 3 robots; not <b>.xml; not broken.urdf; not chain/chain.urdf" in told
    assert "| chain/chain.urdf | 3 |" in table
    good = tmp_path / "good"
    write_ball(good / "ball.urdf", collision='<collision><geometry><sphere radius="1"/></geometry></collision>')
    code, told, table = run(good)
    assert code == 0 and "covered: 1 of 1 robots" in told and "| ball.urdf | 1 | 0 |" in table
    write_ball(good / "bare.urdf")
    code, told, table = run(good)
    assert code == 1 and "covered: 1 of 2 robots; not bare.urdf" in told, "nothing covers it"
    (tmp_path / "none").mkdir()
    assert run(tmp_path / "none")[0] == 1, "nothing was checked"


def test_what_is_wrong_is_one_error(tmp_path):
    assert "census [--strict] OUT DIR" in census().stderr
    run = census(tmp_path / "out", tmp_path / "nowhere")
    assert run.returncode == 1 and run.stderr.startswith("census: there is no folder") and run.stderr.count("\n") == 1
    assert census(tmp_path / "out", tmp_path).returncode == 0
    assert json.loads((tmp_path / "out" / "census.json").read_text()) == []


def write_ball(path, name="ball", collision=""):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'<robot name="{name}"><link name="a"><visual><geometry><sphere radius="1"/></geometry></visual>{collision}</link></robot>')


def test_robots_of_one_name_in_folders_of_one_name_are_kept_apart(tmp_path):
    names = ["one/robots/a/b.urdf", "one/robots/a__b.urdf", "two/robots/a/b.urdf"]
    for name in names:
        write_ball(tmp_path / name)
    assert census(tmp_path / "out", *(tmp_path / name for name in ("one/robots", "two/robots", "two"))).returncode == 0
    assert [row["robot"] for row in json.loads((tmp_path / "out" / "census.json").read_text())] == names
    assert len(list((tmp_path / "out" / "robots").rglob("*.json"))) == len(names)


def test_names_are_neither_formulas_nor_tags_nor_fatal(tmp_path):
    robots = tmp_path / "robots"
    for name in ("=1+1|<script>.urdf", os.fsdecode(b"\xff.urdf")):
        write_ball(robots / name)
    (robots / "encoding.srdf").write_text('<?xml version="1.0" encoding="none"?><robot name="ball"/>')
    run = census(tmp_path / "out", robots)
    assert run.returncode == 0 and "unknown encoding" in run.stderr, run.stderr
    table = list(csv.DictReader((tmp_path / "out" / "census.csv").open(newline="", encoding="utf-8")))
    assert [row["robot"] for row in table] == ["'=1+1|<script>.urdf", "?.urdf"]
    for name in ("census.md", "census.html"):
        assert "=1+1" in (tmp_path / "out" / name).read_text() and "=1+1|<script>" not in (tmp_path / "out" / name).read_text()
    assert r"=1+1\|&lt;script&gt;" in (tmp_path / "out" / "census.md").read_text()


@pytest.mark.skipif(os.geteuid() == 0, reason="root reads everything")
def test_what_may_not_be_read_is_told_and_passed_over(tmp_path):
    robots = tmp_path / "robots"
    write_ball(robots / "good.urdf")
    write_ball(robots / "closed" / "bad.urdf")
    for name in ("bad.urdf", "bad.xml", "bad.srdf"):
        write_ball(robots / name)
        (robots / name).chmod(0)
    (robots / "closed").chmod(0)
    run = census(tmp_path / "out", robots)
    (robots / "closed").chmod(0o755)
    assert run.returncode == 0 and "Traceback" not in run.stderr, run.stderr
    for name in ("closed", "bad.urdf", "bad.xml", "bad.srdf"):
        assert f"robots/{name}" in run.stderr
    rows = {row["robot"]: row for row in json.loads((tmp_path / "out" / "census.json").read_text())}
    assert set(rows) == {"good.urdf", "bad.urdf"} and "links" in rows["good.urdf"] and "read" in rows["bad.urdf"]["why"]
