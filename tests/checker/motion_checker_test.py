"""Tests prohull_check_motion: cases by hand, random chains of joints, and files that no one can read.

    motion_checker_test.py PROHULL_CHECK_MOTION [unittest options]

The environment variable PROHULL_TEST_SEED gives another seed. Where the Python package is, prohull.Collider looks for positions at which
bodies meet that the checker says never do.
"""

import math
import os
import random
import re
import subprocess
import sys
import unittest

from certificates import Folder, box, stl
from motion_certificates import *

try:
    import prohull
except ImportError:
    prohull = None

PROGRAM = sys.argv.pop(1)
SEED = os.environ.get("PROHULL_TEST_SEED", "1")
PROVEN, NOT_PROVEN, UNREADABLE = 0, 1, 2
WALL = box((-2, -5, -1), (0, 5, 1))
LEVER = box((0, -0.1, -1), (2.2, 0.1, 1))
# The lever turns about z, 2 away from the wall. There its corner touches the wall:
TOUCH = math.pi - math.acos(2 / math.hypot(2.2, 0.1)) - math.atan2(0.1, 2.2)


def collider(vertices, triangles):
    return prohull.Collider((vertices, triangles))


class Checked(Folder):
    def check(self, written):
        done = subprocess.run([PROGRAM, self.path("c.phmotion", written)], capture_output=True, text=True, timeout=60, errors="replace")
        self.assertIn(done.returncode, (PROVEN, NOT_PROVEN, UNREADABLE), done.stderr)
        self.assertEqual((done.stdout.count("\n"), done.stderr), (1, ""))
        return done.returncode, done.stdout

    def expect(self, code, words, *parts):
        got = self.check(certificate(*parts))
        self.assertEqual((code, words in got[1]), (got[0], True), got)


def hinge(low, high, lower=None, upper=None, tree=full_tree(9), **options):
    """The lever turns from `low` to `high`; the pair is about `lower` to `upper`."""
    freedoms = [(1, low if lower is None else lower, high if upper is None else upper)]
    return root(), joint("turns", 0, (2, 0, 0), Z, low, high, **options), body(0, WALL), body(1, LEVER), pair(0, 1, freedoms, tree)


class Pairs(Checked):
    def test_are_proven_up_to_where_they_touch(self):
        self.expect(PROVEN, "1 pair that never meet", *hinge(-TOUCH + 0.01, TOUCH - 0.01))
        self.expect(NOT_PROVEN, "too close", *hinge(-TOUCH - 1e-6, TOUCH - 0.01))
        self.expect(NOT_PROVEN, "too close", *hinge(-TOUCH + 0.01, TOUCH - 1e-6, tree="."))

    def test_are_about_all_positions(self):
        self.expect(NOT_PROVEN, "not all positions", *hinge(-1, 1.1, -1, 1))
        self.expect(NOT_PROVEN, "not all positions", *hinge(-1.1, 1, -1, 1))
        self.expect(PROVEN, "", *hinge(-1, 1, -1.1, 1.1))
        parts = hinge(-1, 1)
        self.expect(NOT_PROVEN, "nothing says where", *parts[:-1], pair(0, 1, [], "."))

    def test_are_about_positions_at_which_followers_are_within_their_limits(self):
        for factor, limits in ((10, (-5, 11)), (-10, (-11, 5))):
            follower = joint("slides", 0, (0, 0, 0), Y, *limits, mimic=(1, factor, 0))
            for upper, code in ((1.1000001, PROVEN), (1.09, NOT_PROVEN)):
                lever = joint("turns", 0, (2, 0, 0), Z, -1, 1.2)
                self.expect(code, "" if code == PROVEN else "not all positions", root(), lever, follower, body(0, WALL), body(1, LEVER),
                            pair(0, 1, [(1, -0.6, upper)], full_tree(9)))

    def test_know_that_a_turn_is_all(self):
        short = box((0, -0.1, -1), (1.5, 0.1, 1))
        for turn, code in ((6.2831853072, PROVEN), (6.28, NOT_PROVEN)):
            self.expect(code, "", root(), joint("turns", 0, (2, 0, 0), Z, -EVER, EVER), body(0, WALL), body(1, short),
                        pair(0, 1, [(1, 1, 1 + turn)], full_tree(8)))
        for factor, code in ((2, PROVEN), (0.5, NOT_PROVEN)):
            self.expect(code, "", root(), joint("turns", 0, (2, 0, 0), Z, -EVER, EVER), joint("turns", 0, (2, 0, 0), Z, 0, 0, mimic=(1, factor, 1)),
                        body(0, WALL), body(2, short), pair(0, 1, [(1, 0, 6.2831853072)], full_tree(9)))
        slide = joint("slides", 0, (2, 0, 0), Y, -EVER, EVER)
        self.expect(NOT_PROVEN, "", root(), slide, body(0, WALL), body(1, short), pair(0, 1, [(1, 0, 7)], full_tree(9)))

    def test_climb_and_slide_and_follow(self):
        one, two = box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (3, 1, 1))
        for a, b in ((1, 2), (2, 1)):
            for reach, code in ((0.45, PROVEN), (0.55, NOT_PROVEN)):
                joints = joint("slides", 0, (0, 0, 0), X, 0, reach), joint("slides", 0, (0, 0, 0), X, 0, 0, mimic=(1, -1, 0))
                self.expect(code, "", root(), *joints, body(a, one if a == 1 else two), body(b, one if b == 1 else two),
                            pair(0, 1, [(1, 0, reach)], full_tree(6)))

    def test_anchors_and_origins_count(self):
        # About an anchor at its far end, the lever cannot reach the wall with its near end.
        turned = (0, -1, 0, 1, 0, 0, 0, 0, 1)
        self.expect(PROVEN, "", *hinge(-0.5, 0.5, anchor=(2.2, 0, 0), tree=full_tree(6)))
        self.expect(PROVEN, "", *hinge(-TOUCH - math.pi / 2 + 0.01, TOUCH - math.pi / 2 - 0.01, rotation=turned))
        self.expect(NOT_PROVEN, "", *hinge(-TOUCH + 0.01, TOUCH - 0.01, rotation=turned))
        self.expect(UNREADABLE, "no rotation", *hinge(-1, 1, rotation=(-1, 0, 0, 0, 1, 0, 0, 0, 1)))
        self.expect(UNREADABLE, "no rotation", *hinge(-1, 1, rotation=(1, 0, 0, 0, 1, 0, 0, 0, 1.001)))

    def test_do_not_lie_inside_of_each_other(self):
        small, large = box((4, 4, 4), (5, 5, 5)), box((0, 0, 0), (9, 9, 9))
        hollow = box((1, 1, 1), (8, 8, 8))
        hollow = hollow[0], [(a, c, b) for a, b, c in hollow[1]]
        still = pair(0, 1, [], ".")
        self.expect(NOT_PROVEN, "inside", root(), body(0, large), body(0, small), still)
        self.expect(NOT_PROVEN, "inside", root(), body(0, small), body(0, large), still)
        self.expect(NOT_PROVEN, "inside", root(), body(0, box((-9, 0, 0), (-8, 1, 1)), small), body(0, large), still)
        self.expect(PROVEN, "", root(), body(0, large, hollow), body(0, small), still)
        self.expect(PROVEN, "of 1, what is not closed counts by its triangles only", root(), body(0, (large[0], large[1][1:])), body(0, small), still)
        scrap = [(0, 0, 0), (-1, 0, 0), (0, -1, 0)], [(0, 1, 2)]
        self.expect(NOT_PROVEN, "inside", root(), body(0, large, scrap), body(0, small), still)

    def test_are_not_proven_where_squares_underflow(self):
        a, b = ([tuple(1e-162 * x for x in p) for p in box((x, -0.01, -0.01), (x + 0.06, 0.01, 0.01))[0]] for x in (-1.46, 1.4))
        triangles = box((0, 0, 0), (1, 1, 1))[1]
        self.expect(NOT_PROVEN, "too close", root(), joint("turns", 0, (0, 0, 0), Z, -4, 4), body(0, (a, triangles)), body(1, (b, triangles)),
                    pair(0, 1, [(1, -4, 4)], "."))

    def test_have_limits_in_order(self):
        self.expect(UNREADABLE, "the lower limit is above the upper one", *hinge(1, -1, -1, 1))

    def test_need_joints_that_connect_and_are_known(self):
        one, two = box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (3, 1, 1))
        still = pair(0, 1, [], ".")
        self.expect(PROVEN, "", root(), body(0, one), body(0, two), still)
        self.expect(NOT_PROVEN, "connect", root(), root(), body(0, one), body(1, two), still)
        self.expect(NOT_PROVEN, "not known", root(), joint("loose", 0), body(0, one), body(1, two), still)
        for mimic in ((1, 1, 0), (2, 1, 0), (7, 1, 0), (0, 1, 0)):
            joints = joint("turns", 0, mimic=mimic), joint("turns", 1, mimic=(1, 1, 0))
            self.expect(NOT_PROVEN, "not known", root(), *joints, body(0, one), body(2, two), still)

    def test_may_be_triangles_of_a_file(self):
        self.path("lever.stl", stl(LEVER))
        for end, code in (("lever.stl", PROVEN), ("other.stl", UNREADABLE)):
            parts = hinge(-1, 1)
            self.expect(code, "", *parts[:3], f"body 1 lever\nstl {end}\n", parts[4])
        for size in (0, 83, 84, 100):
            self.path("lever.stl", stl(LEVER)[:size])
            self.expect(UNREADABLE, "", *parts[:3], "body 1 lever\nstl lever.stl\n", parts[4])


class Paths(Checked):
    def expect_path(self, code, rows, gap=0, tree=full_tree(9, "aa")):
        parts = root(), joint("turns", 0, (2, 0, 0), Z, 0, 0), body(0, WALL), body(1, LEVER)
        self.expect(code, "", *parts, f"gap {gap}\n", path([1], rows), f"pair 0 1\n{tree}\n")

    def test_straight(self):
        self.expect_path(PROVEN, [(0, (-TOUCH + 0.01,)), (1, (0,)), (7, (TOUCH - 0.01,))])
        self.expect_path(NOT_PROVEN, [(0, (-TOUCH + 0.01,)), (1, (0,)), (7, (TOUCH,))])
        self.expect_path(NOT_PROVEN, [(0, (0,)), (1, (2 * math.pi,))])
        self.expect_path(PROVEN, [(0, (1,))], tree=".")
        self.expect_path(UNREADABLE, [(0, (0,)), (0, (1,))])

    def test_cubic_and_quintic(self):
        # From 0 back to 0: a cubic with the velocities v and -v goes up to v / 4, a quintic without accelerations to 5 v / 16.
        for row, factor in (((), 4), ((0,), 3.2)):
            for most, code in ((TOUCH - 0.02, PROVEN), (TOUCH + 0.01, NOT_PROVEN)):
                self.expect_path(code, [(0, (0, factor * most, *row)), (1, (0, -factor * most, *row))])
                self.expect_path(code, [(0, (0, factor / 2 * most, *row)), (2, (0, -factor / 2 * most, *row))])
        # From rest to rest with an acceleration a: a / 2 t^2 (1 - t)^3 (3 t + 1) is at most 0.0207 a at about t = 0.4.
        self.expect_path(PROVEN, [(0, (0, 0, 60)), (1, (0, 0, 0))])
        self.expect_path(NOT_PROVEN, [(0, (0, 0, 400)), (1, (0, 0, 0))])

    def test_keep_a_gap(self):
        for gap, code in ((0.79, PROVEN), (0.81, NOT_PROVEN)):  # at 2 - 1.2 = 0.8
            parts = root(), joint("slides", 0, (2, 0, 0), X, 0, 0), body(0, WALL), body(1, box((0, 0, 0), (1, 1, 1)))
            self.expect(code, "", *parts, f"gap {gap}\n", path([1], [(0, (0,)), (1, (-1.2,))]), f"pair 0 1\n{full_tree(8)}\n")


class Random(Checked):
    def chain(self, rng):
        """A base and three to five joints, each with a box."""
        def size():
            low = [rng.uniform(-0.2, 0.1) for _ in range(3)]
            return box(low, [x + rng.uniform(0.1, 0.4) for x in low])

        frames, bodies = [root()], [body(0, size())]
        for i in range(rng.randint(3, 5)):
            kind = rng.choice(("turns", "turns", "slides", "fixed"))
            axis = [rng.gauss(0, 1) for _ in range(3)]
            length = math.sqrt(sum(a * a for a in axis))
            low = rng.uniform(-2, 1) / (1 if kind == "turns" else 5)
            limits = (low, low + rng.uniform(0, 2) / (1 if kind == "turns" else 5))
            free = [j for j, f in enumerate(frames) if f.startswith(("frame turns", "frame slides")) and " free " in f]
            mimic = (rng.choice(free), rng.uniform(-2, 2), rng.uniform(-1, 1)) if free and kind != "fixed" and rng.random() < 0.2 else ()
            turn = motion({"kind": "turns", "axis": np.array([rng.gauss(0, 1) for _ in range(3)]), "anchor": np.zeros(3)}, rng.uniform(-3, 3))
            frames.append(joint(kind, rng.randint(max(0, i - 1), i), [rng.uniform(-0.3, 0.3) for _ in range(3)], [a / length for a in axis],
                                *limits, rotation=turn[:3, :3].ravel(), anchor=[rng.uniform(-0.1, 0.1) for _ in range(3)], mimic=mimic))
            bodies.append(body(i + 1, size()))
        return "".join(frames), "".join(bodies), len(bodies)

    def grown(self, start, a, b, freedoms):
        """A tree for the pair: leaves that are not proven are halved. None if 150 halvings are not enough, or they meet."""
        leaves = [0]  # depths
        tree = "."
        for _ in range(150):
            code, line = self.check(certificate(start, pair(a, b, freedoms, tree)))
            if code == PROVEN:
                return tree
            cell = re.search(r"in cell (\d+)", line)
            if not cell or not freedoms:
                return None
            at = [i for i, c in enumerate(tree) if c == "."][int(cell[1]) - 1]
            depth = leaves[int(cell[1]) - 1]
            tree = tree[:at] + "abcdef"[depth % len(freedoms)] + ".." + tree[at + 1:]
            leaves[int(cell[1]) - 1:int(cell[1])] = [depth + 1] * 2
            if depth > 30:
                return None
        return None

    @unittest.skipUnless(prohull, "the Python package is not there")
    def test_what_is_proven_is_never_refuted(self):
        rng, proven, meeting = random.Random(SEED), 0, 0
        for _ in range(40):
            frames, bodies, count = self.chain(rng)
            said = Certificate(certificate(frames, bodies))
            for _ in range(3):
                a, b = rng.sample(range(count), 2)
                said.pairs = [(a, b)]
                met = said.meeting(lambda: said.random_positions(rng), 200, collider)
                freedoms = [(i, *f["limits"]) for i, f in enumerate(said.frames) if "limits" in f and not f["mimic"]]
                tree = self.grown(frames + bodies, a, b, freedoms)
                self.assertFalse(met and tree, (SEED, frames, met))
                proven += tree is not None
                meeting += met is not None
        print(f"seed {SEED}: {proven} pairs proven, {meeting} that meet", file=sys.stderr)
        self.assertGreater(min(proven, meeting), 20)


class Hostile(Checked):
    def test_truncated_files(self):
        whole = certificate(*hinge(-1, 1, tree=full_tree(5)))
        for size in range(0, len(whole) - 1, 7):
            self.assertNotEqual(self.check(whole[:size])[0], PROVEN)
        self.assertEqual(self.check(whole)[0], PROVEN)

    def test_numbers_that_are_none(self):
        rng = random.Random(SEED)
        whole = certificate(*hinge(-1, 1, tree=full_tree(5)))
        numbers = [m.span() for m in re.finditer(r"(?<= )-?[0-9][0-9.e-]*", whole)]
        for bad in ("nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "1e400", "x", "-1", "4294967296", "0.5"):
            for begin, stop in rng.sample(numbers, 12):
                self.check(whole[:begin] + bad + whole[stop:])

    def test_random_bytes(self):
        rng = random.Random(SEED)
        whole = certificate(*hinge(-1, 1, tree=full_tree(5))).encode()
        for _ in range(300):
            mutant = bytearray(whole)
            for _ in range(rng.randint(1, 4)):
                mutant[rng.randrange(len(mutant))] = rng.choice(b"0123456789.- abz\n\0\xff")
            self.check(bytes(mutant))

    def test_deep_and_endless_trees(self):
        self.expect(UNREADABLE, "deeper", *hinge(-1, 1, tree="a" * 100000))
        self.expect(UNREADABLE, "no tree", *hinge(-1, 1, tree="a" * 900 + "b"))
        self.expect(UNREADABLE, "belongs not here", *hinge(-1, 1, tree=full_tree(5) + "."))
        self.expect(NOT_PROVEN, "no pairs", root())
        self.expect(UNREADABLE, "behind its end", *hinge(-1, 1), "end\n")
        self.expect(UNREADABLE, "this pair is there already", *hinge(-1, 1), pair(0, 1, [(1, -1, 1)], full_tree(5)))
        self.expect(UNREADABLE, "this pair is there already", *hinge(-1, 1), pair(1, 0, [(1, -1, 1)], full_tree(5)))
        self.expect(UNREADABLE, "belongs not here", "gap 0.01\n", "gap 0\n", *hinge(-1, 1))
        self.expect(UNREADABLE, "a path already", *hinge(-1, 1)[:4], *2 * [path([1], [(0, (0,))])])

    def test_files_that_are_none(self):
        for content in ("", "prohull-motion 2\n", "prohull-motion 1", "\0" * 100, "prohull-motion 1\nbody 0 x\n"):
            self.assertEqual(self.check(content)[0], UNREADABLE)
        for arguments in ([], ["nothing"], [self.folder.name], ["a", "b"]):
            done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout.count("\n")), (UNREADABLE, 1))


if __name__ == "__main__":
    unittest.main()
