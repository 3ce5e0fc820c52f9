#!/usr/bin/python3
"""Certificates of a sample robot, and what the checker says of them: robot_certificates_test.py PROHULL PROHULL_CHECK"""

import json
import pathlib
import subprocess
import sys
import tempfile

PROHULL, CHECKER = sys.argv[1:]
BUDGETS = """links:
  palm: {collision: convex, pieces: 2}
  left_pad: {collision: spheres, spheres: 12}
  left_finger: {gap: 0.0001}
"""


def run(folder, *command):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True)


def made_robot(folder):
    run(folder, PROHULL, "sample", "gripper", "-o", "gripper")
    (folder / "budgets.yaml").write_text(BUDGETS)
    options = ["--budgets", "budgets.yaml", "--faces", "60", "--format", "obj", "--configurations", "0", "--no-pictures"]
    return run(folder, PROHULL, "urdf", "gripper/gripper.urdf", "-o", "safe", *options, "--certificate")


def certificates(safe):
    """Of each link."""
    return {link["name"]: link["hulls"][0]["certificate"] for link in json.loads((safe / "report.json").read_text())["links"]}


def checked(safe, certificate):
    return run(safe, CHECKER, certificate["file"], *certificate["hull"], certificate["original"])


def moved_inwards(mesh):
    """The first vertex of an OBJ file moves halfway to the middle of all."""
    lines = mesh.read_text().splitlines()
    at = [i for i, line in enumerate(lines) if line.startswith("v ")]
    vertices = [[float(x) for x in lines[i].split()[1:4]] for i in at]
    middle = [sum(axis) / len(vertices) for axis in zip(*vertices)]
    lines[at[0]] = "v " + " ".join(repr((x + m) / 2) for x, m in zip(vertices[0], middle))
    return "\n".join(lines) + "\n"


def main():
    folder = pathlib.Path(tempfile.mkdtemp())
    safe = folder / "safe"
    answer = made_robot(folder)
    assert answer.returncode == 0, answer
    of_links = certificates(safe)
    assert f"certificates: {len(of_links)}, {len(of_links) - 1} about mesh files of the robot, 1 about" in answer.stdout, answer.stdout
    for link, certificate in of_links.items():
        answer = checked(safe, certificate)
        assert answer.returncode == 0 and answer.stdout.startswith("proven: the hull covers every finite triangle"), (link, answer)
        # All are about the robot's own files but that of the link that mirrors one.
        assert certificate["original_is_of_robot"] == (link != "right_finger"), link
        scaled = "the original is scaled by 0.001" in answer.stdout
        assert scaled == certificate["original_is_of_robot"], (link, answer.stdout)
    assert len(of_links["palm"]["hull"]) == 2 and of_links["left_pad"]["hull"] == ["meshes/collision/left_pad.yaml"]
    assert "keeps a gap of 0.0001" in of_links["left_finger"]["claims"], of_links["left_finger"]
    hull = safe / of_links["left_finger"]["hull"][0]
    hull.write_text(moved_inwards(hull))
    answer = checked(safe, of_links["left_finger"])
    assert answer.returncode == 1, answer
    print(f"{len(of_links)} certificates")


if __name__ == "__main__":
    main()
