"""scripts/census, which users run with the package."""

import csv
import json
import pathlib
import subprocess
import sys

import prohull
import pytest

CENSUS = pathlib.Path(__file__).parents[2] / "scripts" / "census"


def census(*arguments):
    environment = {"PYTHONPATH": str(pathlib.Path(prohull.__file__).parents[1]), "PATH": "/usr/bin:/bin"}
    return subprocess.run([sys.executable, CENSUS, *arguments], capture_output=True, text=True, env=environment)


def prohull_program(*arguments):
    subprocess.run([sys.executable, "-m", "prohull", *arguments], check=True, stdout=subprocess.DEVNULL)


@pytest.fixture(scope="module")
def robots(tmp_path_factory):
    folder = tmp_path_factory.mktemp("robots")
    prohull_program("sample", "gripper", "-o", folder / "gripper")
    (folder / "gripper" / "gripper.srdf").write_text('<robot name="sample_gripper"><disable_collisions link1="palm" link2="nothing" '
                                                     'reason="Never"/></robot>')
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
    assert set(rows) == {"<b>.xml", "broken.urdf", "gripper/gripper.urdf"}
    gripper, broken = rows["gripper/gripper.urdf"], rows["broken.urdf"]
    assert gripper["leaks"] > 0 and gripper["sticks_out_mm"] > 0 and gripper["volume_ratio"] > 0 and gripper["srdf_rows"] == 1
    assert 0 <= gripper["false_stops"] <= 100 and gripper["srdf_false"] == 0
    assert broken["why"] and "links" not in broken and str(robots) not in broken["why"]
    table = list(csv.DictReader((tmp_path / "census.csv").open(newline="")))
    assert [row["robot"] for row in table] == sorted(rows)
    assert (tmp_path / "census.md").read_text().count("\n| ") == 2 + len(rows)
    page = (tmp_path / "census.html").read_text()
    assert "&lt;b&gt;.xml" in page and "http" not in page and page.count("<table>") == 2

    kept = tmp_path / "robots" / "gripper__gripper.urdf.json"
    before = kept.stat().st_mtime_ns
    assert census(tmp_path, robots).returncode == 0 and kept.stat().st_mtime_ns == before
    kept.write_text(kept.read_text()[:100])
    mesh = next((robots / "gripper" / "meshes").rglob("*.stl"))
    assert census(tmp_path, robots).returncode == 0 and json.loads(kept.read_text()) == gripper, "a broken file is made again"
    mesh.write_bytes(mesh.read_bytes()[:84] + bytes(50))
    assert census(tmp_path, robots).returncode == 0 and json.loads(kept.read_text())["state"] != gripper["state"]


def test_what_is_wrong_is_one_error(tmp_path):
    assert "census OUT DIR" in census().stderr
    run = census(tmp_path / "out", tmp_path / "nowhere")
    assert run.returncode == 1 and run.stderr.startswith("census: there is no folder") and run.stderr.count("\n") == 1
    assert census(tmp_path / "out", tmp_path).returncode == 0
    assert json.loads((tmp_path / "out" / "census.json").read_text()) == []
