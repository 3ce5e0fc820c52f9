"""Writes and reads certificates of motion (docs/certificate.md), and places bodies as they say: with nothing of prohull or its checkers."""

import math
import struct

import numpy as np

IDENTITY = (1, 0, 0, 0, 1, 0, 0, 0, 1)
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
EVER = math.inf


def text(*numbers):
    return " ".join(f"{x:.0f}" if isinstance(x, int) else repr(float(x)) for x in numbers)


def root(name="base"):
    return f"frame root {name}\n"


def joint(kind, parent, at=(0, 0, 0), axis=Z, low=0, high=0, rotation=IDENTITY, anchor=(0, 0, 0), mimic=(), name="joint"):
    words = ["frame", kind, str(parent), text(*rotation, *at)]
    if kind in ("turns", "slides"):
        words += [text(*anchor, *axis, low, high), text(*mimic) if mimic else "free"]
    return " ".join(words + [name]) + "\n"


def body(frame, *meshes, name="body"):
    vertices, triangles = [], []
    for v, t in meshes:
        triangles += [tuple(c + len(vertices) for c in corners) for corners in t]
        vertices += v
    lines = [f"body {frame} {name}", f"triangles {len(vertices)} {len(triangles)}"]
    return "\n".join(lines + [text(*p) for p in vertices] + [text(*t) for t in triangles]) + "\n"


def pair(a, b, freedoms, tree):
    return f"pair {a} {b} {len(freedoms)} " + " ".join(text(*f) for f in freedoms) + f"\n{tree}\n"


def path(joints, rows):
    """Of a row: its time and, of each joint, position, velocity, and acceleration as far as they are known."""
    lines = [f"path {len(rows)} {len(joints)} {text(*joints)}"]
    return "\n".join(lines + [text(time, len(states[0]) - 1, *sum(map(tuple, states), ())) for time, *states in rows]) + "\n"


def certificate(*parts):
    return "prohull-motion 1\n" + "".join(parts) + "end\n"


def full_tree(depth, freedoms="a"):
    return "." if depth == 0 else freedoms[0] + 2 * full_tree(depth - 1, freedoms[1:] + freedoms[:1])


class Certificate:
    """What a certificate says."""

    def __init__(self, written, folder="."):
        self.frames, self.bodies, self.pairs, self.gap, self.path = [], [], [], 0, None
        self.lines = iter(written.split("\n"))
        assert next(self.lines) == "prohull-motion 1"
        for line in self.lines:
            word, *rest = line.split()
            if word == "end":
                return
            getattr(self, "read_" + word)(rest, folder)
        raise ValueError("there is no end")

    def read_frame(self, words, _):
        frame = {"kind": words[0], "parent": None, "name": words[-1], "mimic": None}
        if words[0] != "root":
            numbers = list(map(float, words[2:14]))
            frame |= {"parent": int(words[1]), "origin": matrix(numbers[:9], numbers[9:])}
        if words[0] in ("turns", "slides"):
            frame |= {"anchor": np.array(words[14:17], float), "axis": np.array(words[17:20], float),
                      "limits": (float(words[20]), float(words[21]))}
            if words[22] != "free":
                frame["mimic"] = (int(words[22]), float(words[23]), float(words[24]))
        self.frames.append(frame)

    def read_body(self, words, folder):
        word, *rest = next(self.lines).split()
        file = rest[0] if word == "stl" else None
        if file:
            with open(f"{folder}/{file}", "rb") as stream:
                data = stream.read()
            corners = [struct.unpack_from("<9f", data, 96 + 50 * i) for i in range(struct.unpack_from("<I", data, 80)[0])]
            vertices, numbers = np.unique(np.array(corners, float).reshape(-1, 3), axis=0, return_inverse=True)
            triangles = numbers.reshape(-1, 3)
        else:
            vertices = np.array([next(self.lines).split() for _ in range(int(rest[0]))], float)
            triangles = np.array([next(self.lines).split() for _ in range(int(rest[1]))], int)
        self.bodies.append({"frame": int(words[0]), "name": words[1], "file": file, "mesh": (vertices, triangles)})

    def read_gap(self, words, _):
        self.gap = float(words[0])

    def read_path(self, words, _):
        self.path = [int(w) for w in words[2:]], [list(map(float, next(self.lines).split())) for _ in range(int(words[0]))]

    def read_pair(self, words, _):
        self.pairs.append((int(words[0]), int(words[1])))
        nodes = 1
        while nodes > 0:
            for c in next(self.lines):
                nodes += -1 if c == "." else 1

    def random_positions(self, rng):
        return [rng.uniform(*(f["limits"] if f["limits"][1] - f["limits"][0] < EVER else (-math.pi, math.pi))) if "limits" in f else 0
                for f in self.frames]

    def positions_on_path(self, rng):
        """At a random moment: by the polynomials that keep what both rows know."""
        joints, rows = self.path
        positions = [f["limits"][0] if "limits" in f else 0 for f in self.frames]
        first = rng.randrange(max(len(rows) - 1, 1))
        before, after = rows[first], rows[min(first + 1, len(rows) - 1)]
        known, time, fraction = int(min(before[1], after[1])) + 1, after[0] - before[0], rng.random()
        for k, joint in enumerate(joints):
            equations, values = [], []
            for t, row in ((0, before), (1, after)):
                states = row[2:][k * (int(row[1]) + 1):]
                for d in range(known):
                    equations.append([math.perm(n, d) * t ** (n - d) if n >= d else 0 for n in range(2 * known)])
                    values.append(states[d] * time ** d)
            positions[joint] = float(np.polynomial.polynomial.polyval(fraction, np.linalg.solve(equations, values)))
        return positions

    def poses(self, positions):
        """Of all frames, as 4 x 4 matrices."""
        def position_of(i):
            if not self.frames[i]["mimic"]:
                return positions[i]
            leader, factor, offset = self.frames[i]["mimic"]
            return factor * position_of(leader) + offset

        poses = []
        for i, frame in enumerate(self.frames):
            moved = np.eye(4) if frame["parent"] is None else poses[frame["parent"]] @ frame["origin"] @ motion(frame, position_of(i))
            poses.append(moved)
        return poses

    def meeting(self, positions_of, count, collider):
        """The first pair that meets in any of `count` positions: its number and the positions; or None."""
        colliders = [collider(*b["mesh"]) for b in self.bodies]
        all_positions = [positions_of() for _ in range(count)]
        all_poses = [np.array(self.poses(p)) for p in all_positions]
        for number, (a, b) in enumerate(self.pairs):
            of_a, of_b = ([poses[self.bodies[i]["frame"]] for poses in all_poses] for i in (a, b))
            meets = colliders[a].collides(colliders[b], np.array(of_b), own_poses=np.array(of_a))
            if meets.any():
                return number, all_positions[int(np.argmax(meets))]
        return None


def matrix(rotation, translation):
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = np.reshape(rotation, (3, 3)), translation
    return out


def motion(frame, position):
    if frame["kind"] == "slides":
        return matrix(IDENTITY, frame["axis"] * position)
    if frame["kind"] != "turns":
        return np.eye(4)
    k = frame["axis"] / np.linalg.norm(frame["axis"])
    across = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    turn = np.eye(3) + math.sin(position) * across + (1 - math.cos(position)) * across @ across
    return matrix(turn, frame["anchor"] - turn @ frame["anchor"])
