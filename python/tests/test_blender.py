"""The add-on for Blender, in Blender. Skipped where the program blender is not installed."""

import json
import os
import pathlib
import shutil
import subprocess

import prohull
import pytest

HERE = pathlib.Path(__file__).parent
BLENDER = shutil.which("blender")


@pytest.mark.skipif(BLENDER is None, reason="Blender is not installed (apt install blender)")
def test_the_add_on_in_blender(tmp_path):
    zip_file = tmp_path / "addon.zip"
    subprocess.run([HERE.parents[1] / "scripts" / "blender-addon", zip_file], check=True, stdout=subprocess.DEVNULL)
    program = pathlib.Path(prohull.__file__).with_name("prohull")
    run = subprocess.run([BLENDER, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                          HERE / "blender_check.py", "--", zip_file, program, tmp_path], capture_output=True, text=True,
                         env={**os.environ, "HOME": str(tmp_path), "BLENDER_USER_SCRIPTS": str(tmp_path / "scripts")})
    assert run.returncode == 0, run.stdout + run.stderr
    assert "The hull has more than 4 faces" in run.stdout
    told = json.loads((tmp_path / "told.json").read_text())
    torus = tmp_path / "torus.obj"
    assert told["outer"]["count"] == 1 and told["outer"]["faces"] <= 200 and told["outer"]["prohull_original"] == "Torus"
    assert prohull.verify(tmp_path / "outer_0.obj", torus)
    assert told["inner"]["faces"] <= 200 and prohull.verify(tmp_path / "inner_0.obj", torus, side="inner")
    assert prohull.verify(tmp_path / "near_0.obj", torus)
    assert prohull.distance_bounds(tmp_path / "near_0.obj", torus)[1] <= 0.0501, "0.1 in the world, in which it is scaled by 2"
    pieces = [tmp_path / f"pieces_{i}.obj" for i in range(told["pieces"]["count"])]
    assert 2 <= len(pieces) <= 4 and prohull.verify_union(pieces, torus)
    for name in ("outer", "inner", "near", "pieces", "modifier"):
        facts = told[name]
        assert facts["prohull_certified"] and facts["prohull_within_bounds"] and facts["prohull_proof"]
        assert facts["prohull_version"] == prohull.__version__ and facts["prohull_distance_bound"] > 0
    for name, what in {"uneven scale": "apply its scale", "shear": "apply its scale", "no program": "is not there", "another program": "exit code 1",
                       "empty": "no faces", "open": "bounds no solid", "nan": "finite"}.items():
        assert what in told[name] and "Traceback" not in told[name], (name, told[name])


def test_the_add_on_is_small():
    lines = (HERE.parent / "blender" / "enclosing_decimate.py").read_text().splitlines()
    assert len(lines) <= 300
