#!/usr/bin/python3
"""Certificates of motion of whole robots, and what the checker says of them and of mutants:

    motion_certificates_test.py PROHULL PROHULL_CHECK_MOTION ROBOT...

A ROBOT is the name of a sample, or a URDF file, with the folder of its packages behind a colon. Where a file is not there, a word says so.
The numbers of a certificate are compared with those of the URDF, which is parsed here with nothing of prohull. The environment variable
PROHULL_TEST_SEED gives another seed of mutants.
"""

import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "checker"))
from motion_certificates import *

PROHULL, CHECKER, *ROBOTS = sys.argv[1:]
SEED = os.environ.get("PROHULL_TEST_SEED", "1")
MUTANTS = 30


def run(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True)


def checked(file):
    answer = run(CHECKER, file)
    assert answer.returncode in (0, 1, 2) and answer.stdout.count("\n") == 1, answer
    return answer.returncode == 0, answer.stdout


def numbers(element, tag, name, otherwise):
    found = element.find(tag)
    return [float(x) for x in (found.get(name, otherwise) if found is not None else otherwise).split()]


def origin(element):
    roll, pitch, yaw = numbers(element, "origin", "rpy", "0 0 0")
    parts = [motion({"kind": "turns", "axis": np.array(a), "anchor": np.zeros(3)}, t) for a, t in ((Z, yaw), (Y, pitch), (X, roll))]
    return matrix((parts[0] @ parts[1] @ parts[2])[:3, :3], numbers(element, "origin", "xyz", "0 0 0"))


def compare_joint(frame, element, frames):
    kind = element.get("type")
    assert frame["kind"] == {"fixed": "fixed", "prismatic": "slides", "revolute": "turns", "continuous": "turns"}.get(kind, "loose")
    assert np.abs(frame["origin"] - origin(element)).max() < 1e-14 and (frame["origin"][:3, 3] == origin(element)[:3, 3]).all()
    if "axis" not in frame:
        return
    axis = np.array(numbers(element, "axis", "xyz", "1 0 0"))
    assert np.abs(frame["axis"] - axis / np.linalg.norm(axis)).max() < 1e-15 and not frame["anchor"].any()
    limit = element.find("limit")
    limits = (float(limit.get("lower", 0)), float(limit.get("upper", 0))) if kind != "continuous" else (-EVER, EVER)
    assert frame["limits"] == limits, (frame, limits)
    mimic = element.find("mimic")
    assert (mimic is None) == (frame["mimic"] is None)
    if mimic is not None:
        leader, *rest = frame["mimic"]
        assert (frames[leader]["name"], *rest) == (mimic.get("joint"), float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0)))


def compare_with_urdf(said, urdf):
    """Joints, limits, and where collision meshes are: as the file has them."""
    robot = xml.etree.ElementTree.parse(urdf).getroot()
    joints = {j.get("name"): j for j in robot.findall("joint")}
    links = {link.get("name"): link for link in robot.findall("link")}
    of_frame = []  # the link that a frame moves
    for frame in said.frames:
        element = joints.get(frame["name"]) if frame["kind"] != "root" else None
        parent = of_frame[frame["parent"]] if frame["parent"] is not None else None
        if frame["kind"] == "root":
            of_frame.append(frame["name"])
        elif element is not None:
            assert parent == element.find("parent").get("link"), frame
            of_frame.append(element.find("child").get("link"))
            compare_joint(frame, element, said.frames)
        else:  # of a collision mesh
            collision = links[parent].findall("collision")
            assert len(collision) == 1 and np.abs(frame["origin"] - origin(collision[0])).max() < 1e-14
            of_frame.append(parent)
    for body in said.bodies:
        assert of_frame[body["frame"]] == body["name"], body["name"]
        if body["file"]:
            collision = links[body["name"]].findall("collision")
            files = [c.find("geometry/mesh").get("filename") for c in collision]
            assert files == [body["file"]], (files, body["file"])
            assert (origin(collision[0])[:3, 3] == 0).all() or said.frames[body["frame"]]["kind"] == "fixed"


def changed(line, first, change, count=3):
    """A line, of which some words become numbers that `change` gives."""
    words = line.split(" ")
    at = [i for i, w in enumerate(words) if w][first:first + count]
    for i, x in zip(at, change([float(words[i]) for i in at])):
        words[i] = repr(x)
    return " ".join(words)


def with_wider_limits(lines, rng):
    number = rng.choice([i for i, line in enumerate(f for f in lines if f.startswith("frame ")) if re.search(" free ", line)])
    at = [i for i, line in enumerate(lines) if line.startswith("frame ")][number]
    words = lines[at].split()
    low, high = float(words[21]), float(words[22])
    if not high - low < EVER:
        return None
    more = rng.uniform(0, 1) * (high - low)
    lines[at] = " ".join(words[:21] + [repr(low - more), repr(high + more)] + words[23:])
    for i, line in enumerate(lines):
        words = line.split()
        if line.startswith("pair "):
            for k in range(4, len(words), 3):
                if int(words[k]) == number and rng.random() < 0.9:
                    words[k + 1:k + 3] = [repr(low - more), repr(high + more)]
            lines[i] = " ".join(words)
    return lines


def with_moved_mesh(lines, rng):
    at = rng.choice([i for i, line in enumerate(lines) if line.startswith("body ")])
    if any(line.startswith("frame ") for line in lines[at:]):
        return None  # the frames behind would have other numbers
    words = lines[at].split()
    offset = [rng.gauss(0, 0.1) for _ in range(3)]
    frame = f"frame fixed {words[1]} 1 0 0 0 1 0 0 0 1 {text(*offset)} moved"
    words[1] = str(sum(line.startswith("frame ") for line in lines))
    return lines[:at] + [frame, " ".join(words)] + lines[at + 1:]


def with_tilted_axis(lines, rng):
    at = rng.choice([i for i, line in enumerate(lines) if re.match("frame (turns|slides)", line)])

    def tilt(axis):
        tilted = [a + rng.gauss(0, 0.3) for a in axis]
        return [a / math.hypot(*tilted) for a in tilted]

    lines[at] = changed(lines[at], 18, tilt)
    return lines


def with_moved_origin(lines, rng):
    at = rng.choice([i for i, line in enumerate(lines) if re.match("frame (turns|slides|fixed)", line)])
    lines[at] = changed(lines[at], 12, lambda xyz: [x + rng.gauss(0, 0.1) for x in xyz])
    return lines


def with_a_leaf_for_a_split(lines, rng):
    trees = [i for i, line in enumerate(lines) if re.fullmatch("[a-z.]*[.][a-z.]*", line) and len(line) > 1 and line != "end"]
    at = rng.choice(trees)
    splits = [i for i, c in enumerate(lines[at]) if c != "."]
    if not splits:
        return None
    begin, nodes = rng.choice(splits), 1
    whole = "\n".join(lines)
    begin += len("\n".join(lines[:at])) + 1
    stop = begin
    while nodes > 0:
        nodes += {"\n": 0, ".": -1}.get(whole[stop], 1)
        stop += 1
    return (whole[:begin] + "." + whole[stop:]).split("\n")


def try_mutants(file, rng):
    """None is proven that a sampled position refutes. Returns how many are not proven, of each kind."""
    import prohull
    written = file.read_text()
    refused = {}
    for i in range(MUTANTS):
        kind = (with_wider_limits, with_moved_mesh, with_tilted_axis, with_moved_origin, with_a_leaf_for_a_split)[i % 5]
        lines = kind(written.split("\n"), rng)
        if lines is None:
            continue
        mutant = file.with_name("mutant.phmotion")
        mutant.write_text("\n".join(lines))
        is_proven, line = checked(mutant)
        assert not line.startswith("unreadable"), (kind.__name__, line)
        tried, all_refused = refused.get(kind.__name__, (0, 0))
        refused[kind.__name__] = (tried + 1, all_refused + (not is_proven))
        if is_proven:
            said = Certificate("\n".join(lines), file.parent)
            met = said.meeting(lambda: said.random_positions(rng), 200, lambda v, t: prohull.Collider((v, t)))
            assert not met, (SEED, kind.__name__, met)
    return refused


def random_rows(joints, rng):
    """A path of three rows with what is known of each: positions; with velocities; with accelerations."""
    known = rng.randrange(3)
    names = [name + suffix for suffix in ("", ".velocity", ".acceleration")[:known + 1] for name, _ in joints]
    rows = [[rng.uniform(*limits) * 0.4 for _, limits in joints] + [rng.uniform(-1, 1) for _ in range(known * len(joints))] for _ in range(3)]
    return "\n".join([",".join(["time", *names])] + [",".join(map(repr, [2.5 * i, *row])) for i, row in enumerate(rows)]) + "\n"


def compare_with_csv(said, csv):
    names, *rows = [line.split(",") for line in csv.split()]
    joints, said_rows = said.path
    at = {(said.frames[j]["name"], d): 2 + k * (int(said_rows[0][1]) + 1) + d for k, j in enumerate(joints) for d in range(3)}
    for row, said_row in zip(rows, said_rows, strict=True):
        assert float(row[0]) == said_row[0]
        for name, x in zip(names[1:], row[1:]):
            joint, _, derivative = name.partition(".")
            assert said_row[at[joint, ["", "velocity", "acceleration"].index(derivative)]] == float(x)


def try_paths(urdf, rng):
    """Random paths of a robot: all pairs that are free are proven again, and no moment of them is refuted. A row that is moved may not be
    proven where a moment is refuted. Returns how many pairs were proven, and how many mutants were not."""
    import prohull
    robot = xml.etree.ElementTree.parse(urdf).getroot()
    joints = [(j.get("name"), (float(j.find("limit").get("lower")), float(j.find("limit").get("upper")))) for j in robot.findall("joint")
              if j.get("type") in ("revolute", "prismatic") and j.find("mimic") is None]
    csv, file = urdf.with_name("path.csv"), urdf.with_name("path.phmotion")
    pairs = refused = 0
    for _ in range(8):
        csv.write_text(random_rows(joints, rng))
        answer = run(PROHULL, "motion", urdf, csv, "--certificate", file, *rng.choice([[], ["--gap", "1mm"]]))
        assert f"{file}: certificate of " in answer.stdout, answer
        is_proven, line = checked(file)
        assert is_proven, line
        said = Certificate(file.read_text(), file.parent)
        compare_with_csv(said, csv.read_text())
        assert not said.meeting(lambda: said.positions_on_path(rng), 100, lambda v, t: prohull.Collider((v, t))), SEED
        pairs += len(said.pairs)
        lines = file.read_text().split("\n")
        at = next(i for i, line in enumerate(lines) if line.startswith("path ")) + 1 + rng.randrange(3)
        lines[at] = changed(lines[at], rng.randrange(2, len(lines[at].split())), lambda x: [x[0] + rng.uniform(-3, 3)], 1)
        file.write_text("\n".join(lines))
        is_proven, line = checked(file)
        refused += not is_proven
        if is_proven:
            said = Certificate("\n".join(lines), file.parent)
            assert not said.meeting(lambda: said.positions_on_path(rng), 100, lambda v, t: prohull.Collider((v, t))), SEED
    return pairs, refused


def made_robot(folder, robot):
    """The URDF with hulls."""
    file, _, packages = robot.partition(":")
    options = ["--package-path", packages] if packages else []
    if file.endswith(".urdf"):
        if not pathlib.Path(file).exists() or not pathlib.Path(packages or ".").exists():
            return None
    else:
        run(PROHULL, "sample", file, "-o", folder / "in")
        file = folder / "in" / f"{file}.urdf"
    answer = run(PROHULL, "urdf", file, "-o", folder / "safe", "--faces", 100, "--configurations", 1, "--no-pictures", "--certificate",
                 "--prove", 3000, *options)
    assert answer.returncode == 0, answer
    urdf = folder / "safe" / pathlib.Path(file).name
    assert f"{urdf.stem}.phmotion: certificate of " in answer.stdout, answer.stdout
    return urdf


def main():
    rng = random.Random(SEED)
    for robot in ROBOTS:
        folder = pathlib.Path(tempfile.mkdtemp())
        urdf = made_robot(folder, robot)
        if urdf is None:
            print(f"{robot}: skipped, as it is not here")
            continue
        file = urdf.with_suffix(".phmotion")
        is_proven, line = checked(file)
        assert is_proven, line
        said = Certificate(file.read_text(), file.parent)
        compare_with_urdf(said, urdf)
        print(f"{robot}: {line.strip()}; {file.stat().st_size} bytes; mutants refused: {try_mutants(file, rng)}")
        print("  on 8 paths: {} pairs proven, {} mutants refused".format(*try_paths(urdf, rng)))


if __name__ == "__main__":
    main()
