"""Tests prohull_check: cases by hand for each kind of section, all formats of meshes, files that no one can read, and mutants.

    checker_test.py PROHULL_CHECK CHECK_MANY [unittest options]

CHECK_MANY is check_many.c, which answers for mutants: to start PROHULL_CHECK for each took a fifth of the time.

The environment variable PROHULL_CHECK_MUTANTS says how many mutants are tried, and PROHULL_TEST_SEED with which seed. Where the Python
package is, prohull.verify is asked about each mutant, too: what the checker proves it must not deny.
"""

import os
import random
import re
import struct
import subprocess
import sys
import unittest
from fractions import Fraction

from certificates import *

try:
    import prohull
except ImportError:
    prohull = None

PROGRAM, MANY = sys.argv.pop(1), sys.argv.pop(1)
MUTANTS = int(os.environ.get("PROHULL_CHECK_MUTANTS", "7500"))
SEED = os.environ.get("PROHULL_TEST_SEED", "1")
PROVEN, NOT_PROVEN, UNREADABLE = 0, 1, 2
CUBE = subdivided(box((0, 0, 0), (4, 4, 4)))
WIDE = box((-1, -1, -1), (9, 9, 9))


def both(a, b):
    return a[0] + b[0], a[1] + [tuple(v + len(a[0]) for v in t) for t in b[1]]


def turned(mesh):
    return mesh[0], [(a, c, b) for a, b, c in mesh[1]]


def scaled(mesh, scale):
    return [tuple(x * scale for x in p) for p in mesh[0]], mesh[1]


def tetrahedron(v):
    """Outwards."""
    sides = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (0, 2, 3)]
    return v, sides if orient(*v) < 0 else [(a, c, b) for a, b, c in sides]


def some_tetrahedron(rng):
    return tetrahedron([tuple(rng.randint(-99, 99) for _ in range(3)) for _ in range(4)])


class Checked(Folder):
    def paths(self, cert, hull, original, hull_name="hull.off", original_name="original.off"):
        """Meshes may be given as bytes."""
        meshes = ((hull_name, hull), (original_name, original))
        return [self.path("c", cert)] + [self.path(n, m if isinstance(m, bytes) else off(m)) for n, m in meshes]

    def check(self, *files, **names):
        """Exit code and line."""
        done = subprocess.run([PROGRAM, *self.paths(*files, **names)], capture_output=True, text=True, timeout=60)
        self.assertIn(done.returncode, (PROVEN, NOT_PROVEN, UNREADABLE), done.stderr)
        self.assertEqual(done.stdout.count("\n"), 1)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout

    def expect(self, code, words, sections, hull, original, **options):
        cert = certificate(len(hull[1]), len(original[1]), *sections, **options)
        got = self.check(cert, hull, original)
        self.assertEqual((code, words in got[1]), (code, True), got)
        self.assertEqual(code, got[0], got)


class Tetrahedra(Checked):
    def test_prove_an_outer_and_an_inner_hull(self):
        for sign, side, words in ((1, 0, "the hull encloses the solid"), (-1, 1, "the solid encloses the hull")):
            hull, added, fans = moved_outwards(CUBE, random.Random(1), 8, sign)
            self.assertEqual(len(added), 8)
            self.expect(PROVEN, words, [tetrahedra(added, fans)], hull, CUBE, side=side)
            self.expect(PROVEN, words, [tetrahedra(added, fans[::-1])], hull, CUBE, side=side)
            self.expect(NOT_PROVEN, "wrong side", [tetrahedra(added, fans)], hull, CUBE, side=1 - side)
            self.expect(NOT_PROVEN, "differ", [tetrahedra(added, fans[1:])], hull, CUBE, side=side)

    def test_are_not_needed_for_the_original_itself(self):
        self.expect(PROVEN, "encloses", [tetrahedra([], [])], CUBE, CUBE)

    def test_need_a_closed_original(self):
        open_cube = (CUBE[0], CUBE[1][1:])
        self.expect(NOT_PROVEN, "not closed", [tetrahedra([], [])], open_cube, open_cube)

    def test_decide_the_last_bit(self):
        # The tip goes up by one bit, or down by one; the three faces around it are steep.
        mesh = ([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.1, 0.1, 0.7)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
        for tip, code in (((0.1, 0.1, 0.7000000000000001), PROVEN), ((0.1, 0.1, 0.6999999999999999), NOT_PROVEN)):
            hull = (mesh[0][:3] + [tip], mesh[1])
            self.expect(code, "proven", [tetrahedra([tip], [(4, 3, [0, 1, 2, 0])])], hull, mesh)

    def test_know_turned_components(self):
        turned = (CUBE[0], [(a, c, b) for a, b, c in CUBE[1]])
        hull, added, fans = moved_outwards(CUBE, random.Random(2), 5)
        self.expect(PROVEN, "components of the original that are turned: 1", [tetrahedra(added, fans)], hull, turned, turned=[7])
        self.expect(NOT_PROVEN, "", [tetrahedra(added, fans)], hull, turned)
        self.expect(NOT_PROVEN, "not negative", [tetrahedra(added, fans)], hull, CUBE, turned=[7])

    def test_know_what_is_inside_out_as_a_whole(self):
        cavity = box((1, 1, 1), (3, 3, 3))
        hollow = both((CUBE[0], [(a, c, b) for a, b, c in CUBE[1]]), cavity)
        hull = both(WIDE, (cavity[0], [(a, c, b) for a, b, c in cavity[1]]))
        inside = len(CUBE[1])
        self.expect(PROVEN, "turned: 2, which are all", [surfaces()], hull, hollow, turned=[0, inside])
        self.expect(NOT_PROVEN, "hole", [surfaces()], hull, hollow, turned=[0])
        self.expect(NOT_PROVEN, "not negative", [surfaces()], hull, both(CUBE, (cavity[0], [(a, c, b) for a, b, c in cavity[1]])), turned=[0, inside])

    def test_know_turned_components_of_any_size(self):
        for scale in (2.0**-300, 2.0**300):
            hull, cube = scaled(WIDE, scale), scaled(CUBE, scale)
            turned = (cube[0], [(a, c, b) for a, b, c in cube[1]])
            self.expect(PROVEN, "components of the original that are turned: 1", [surfaces()], hull, turned, turned=[7])
            self.expect(NOT_PROVEN, "not negative", [surfaces()], hull, cube, turned=[7])

    def test_know_turned_components_of_which_some_triangles_are_too_large_to_round(self):
        # Of a cube with a spike: beside the tip, from where volumes are counted, those of the others are negative.
        spiked = ([(12, 4, 4) if p == (8, 4, 4) else p for p in CUBE[0]], CUBE[1])
        for scale in (1e90 / n for n in (20, 30, 40)):
            hull, cube = scaled(box((-1, -1, -1), (13, 9, 9)), scale), scaled(spiked, scale)
            self.expect(NOT_PROVEN, "not negative", [surfaces()], hull, cube, turned=[7])
            self.expect(PROVEN, "turned: 1", [surfaces()], hull, turned(cube), turned=[7])


class Surfaces(Checked):
    def test_prove_outer_and_inner_hulls(self):
        self.expect(PROVEN, "covers every finite triangle; the hull encloses the solid", [surfaces()], WIDE, CUBE)
        self.expect(PROVEN, "covers every triangle of the hull; the solid encloses the hull", [surfaces()], CUBE, WIDE, side=1)
        self.expect(NOT_PROVEN, "outside", [surfaces()], CUBE, WIDE)
        self.expect(PROVEN, "", [surfaces()], CUBE, CUBE)
        self.expect(PROVEN, "", [surfaces()], box((0, 0, 0), (8, 8, 8)), CUBE)

    def test_prove_moved_hulls(self):
        for seed in range(30):
            hull, _, _ = moved_outwards(CUBE, random.Random(seed), 6)
            cert = certificate(len(hull[1]), len(CUBE[1]), surfaces())
            self.check(cert, hull, CUBE)  # some intersect themselves

    def test_cover_a_soup(self):
        rng = random.Random(3)
        vertices = [tuple(rng.randint(0, 8) for _ in range(3)) for _ in range(30)]
        cloud = (vertices, [tuple(rng.sample(range(30), 3)) for _ in range(40)])
        self.expect(PROVEN, "covers every finite triangle", [surfaces(1)], WIDE, cloud)
        self.expect(NOT_PROVEN, "not closed", [surfaces(3)], WIDE, cloud)
        self.expect(NOT_PROVEN, "", [surfaces(1)], box((0, 0, 0), (7, 8, 8)), cloud)

    def test_cut_triangles_that_the_hull_crosses(self):
        original = both(box((0, 0, 0), (4, 4, 4)), box((2, 2, 2), (6, 6, 6)))
        wide = box((1, 1, 1), (7, 7, 7))
        self.expect(PROVEN, "covers", [surfaces(1)], both(box((-1, -1, -1), (5, 5, 5)), wide), original)
        self.expect(PROVEN, "covers", [surfaces(1)], both(box((-1, -1, -1), (4, 5, 5)), wide), original)
        self.expect(PROVEN, "encloses", [surfaces(3)], both(box((-1, -1, -1), (5, 5, 5)), wide), original)
        self.expect(NOT_PROVEN, "a part of triangle", [surfaces(1)], both(box((-1, -1, -1), (3, 5, 5)), wide), original)

    def test_cut_a_tiny_triangle_at_overlapping_tetrahedra(self):
        # Of a part of it, one point was rounded and another one exact: together they were within.
        corners = [(1.7, -11, 83), (9.9, -36, -58), (-15, 62, 89), (-5.6, -36, -17)]
        corners += [(92, -73, 41), (22, 18, -20), (-56, 38, -13), (-81, -20, -60)]
        corners += [(-25, -70, 17), (73, 66, -14), (-41, 81, -94), (-90, 40, 92)]
        triangle = [(-19, -40, 6.3), (2.4, -11, -11), (1.4, 37, -33)]
        hull = both(both(tetrahedron(corners[:4]), tetrahedron(corners[4:8])), tetrahedron(corners[8:]))
        tiny = lambda mesh: ([tuple(float(f"{x}e-61") for x in p) for p in mesh[0]], mesh[1])
        self.expect(NOT_PROVEN, "a part of triangle", [surfaces(1)], tiny(hull), tiny((triangle, [(0, 1, 2)])))

    def test_cut_triangles_of_any_size_alike(self):
        answers = set()
        for seed in range(120, 170):
            rng = random.Random(seed)
            hull = some_tetrahedron(rng)
            for _ in range(rng.randint(2, 6)):
                hull = both(hull, some_tetrahedron(rng))
            corner = lambda: tuple(rng.choice(hull[0])[k] // 4 + rng.randint(-20, 20) for k in range(3))
            triangle = ([corner() for _ in range(3)], [(0, 1, 2)])
            cert = certificate(len(hull[1]), 1, surfaces(1))
            got = [self.check(cert, scaled(hull, s), scaled(triangle, s)) for s in (1.0, 2.0**-30, 2.0**-200, 2.0**100)]
            self.assertEqual(len(set(got)), 1, (seed, got))
            answers.add(got[0][0])
        self.assertEqual(answers, {PROVEN, NOT_PROVEN})

    def test_leave_no_hole(self):
        # A thick shell covers the triangles of a cube, but not its inside.
        inside = box((2, 2, 2), (6, 6, 6))
        shell = (WIDE[0] + inside[0], WIDE[1] + [(a + 8, c + 8, b + 8) for a, b, c in inside[1]])
        self.expect(PROVEN, "covers", [surfaces(1)], shell, CUBE)
        self.expect(NOT_PROVEN, "hole", [surfaces(3)], shell, CUBE)

    def test_leave_no_room_between_slabs_of_any_size(self):
        # Parts of triangles had middles whose weights, times coordinates, overflowed: no ray from there met anything.
        slabs = ([], [])
        for k in range(3):
            for low, high in ((-1, 2), (6, 9)):
                slabs = both(slabs, box(*(tuple(x if i == k else wide for i in range(3)) for x, wide in ((low, -1), (high, 9)))))
        for scale in (1.0, 2.0**1000, 2.0**1018):
            hull, cube = scaled(slabs, scale), scaled(CUBE, scale)
            self.expect(PROVEN, "covers", [surfaces(1)], hull, cube)
            self.expect(NOT_PROVEN, "hole", [surfaces(3)], hull, cube)

    def test_refuse_a_hull_that_is_turned_or_open(self):
        self.expect(NOT_PROVEN, "outside", [surfaces()], (WIDE[0], [(a, c, b) for a, b, c in WIDE[1]]), CUBE)
        self.expect(NOT_PROVEN, "not closed", [surfaces()], (WIDE[0], WIDE[1][1:]), CUBE)

    def test_see_to_triangles_without_area(self):
        flat = lambda *p: (CUBE[0] + list(p), CUBE[1] + [tuple(range(len(CUBE[0]), len(CUBE[0]) + len(p)))])
        self.expect(PROVEN, "covers", [surfaces(1)], WIDE, flat((1, 1, 1), (2, 2, 2), (3, 3, 3)))
        self.expect(PROVEN, "covers", [surfaces(1)], WIDE, flat((1, 1, 1), (1, 1, 1), (1, 1, 1)))
        self.expect(NOT_PROVEN, "outside", [surfaces(1)], WIDE, flat((11, 1, 1), (11, 1, 1), (11, 1, 1)))
        self.expect(NOT_PROVEN, "outside", [surfaces(1)], WIDE, flat((1, 1, 1), (5, 5, 5), (19, 19, 19)))
        self.expect(PROVEN, "covers", [surfaces(1)], CUBE, flat((0, 0, 0), (0, 0, 2), (0, 0, 4)))
        self.expect(NOT_PROVEN, "no area", [surfaces(1)], CUBE, flat((0, 0, 1), (0, 0, 2), (0, 0, 3)))

    def test_cut_triangles_without_area(self):
        across = ([(1, 1, 1), (4, 4, 4), (8, 8, 8)], [(0, 1, 2)])
        self.expect(PROVEN, "covers", [surfaces(1)], two_boxes(), across)
        self.expect(NOT_PROVEN, "outside", [surfaces(1)], two_boxes(4, 5), across)

    def test_leave_out_triangles_that_are_not_finite(self):
        mesh = (CUBE[0] + [(float("nan"), 0.0, float("inf"))], CUBE[1] + [(0, 1, len(CUBE[0]))])
        cert = certificate(len(WIDE[1]), len(CUBE[1]), surfaces())
        code, line = self.check(cert, WIDE, mesh)
        self.assertEqual(code, PROVEN, line)
        self.assertIn("triangles of the original that are not finite: 1", line)

    def test_scale_the_original(self):
        self.expect(PROVEN, "scaled by 1000", [surfaces()], box((0, 0, 0), (8000, 8000, 8000)), CUBE, scale=1000.0)

    def test_decide_coordinates_of_any_size(self):
        for size in (2.0**-1060, 1e-200, 2.0**900):
            cube = ([tuple(float(x) * size for x in p) for p in CUBE[0]], CUBE[1])
            wide = ([tuple(float(x) * size for x in p) for p in box((0, 0, 0), (8, 8, 8))[0]], WIDE[1])
            self.expect(PROVEN, "", [surfaces()], wide, cube)
            small = ([tuple(min(x, 7.999 * size) for x in p) for p in wide[0]], WIDE[1])
            self.expect(NOT_PROVEN, "", [surfaces()], small, cube)


class Formats(Checked):
    def test_every_format_is_read(self):
        mesh = (CUBE[0], CUBE[1])
        cert = certificate(len(WIDE[1]), len(mesh[1]), surfaces())
        files = [("o.off", off(mesh)), ("o.obj", obj(mesh)), ("o.stl", stl(mesh)), ("o.STL", stl(mesh, True))]
        for form in ("ascii", "binary_little_endian", "binary_big_endian"):
            files += [("o.ply", ply(mesh, form, real)) for real in ("double", "float")]
        for name, content in files:
            code, line = self.check(cert, WIDE, content, original_name=name)
            self.assertEqual(code, PROVEN, (name, line))
            if name != "o.obj":
                self.assertEqual(self.check(cert, WIDE, content[: len(content) * 2 // 3], original_name=name)[0] == PROVEN, False)

    def test_polygons_are_fans(self):
        square = b"v 0 0 0\nv 1 0 0\nv 1 1 0 \\\n 5\nv 0 1 0\nf 1 2 3 4\nf 1\nf 1 2\n"
        self.assertEqual(self.check(certificate(12, 4, surfaces(1)), WIDE, square, original_name="o.obj")[0], PROVEN)

    def test_strips(self):
        head = b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        head += b"element tristrips 2\nproperty list int int vertex_indices\nend_header\n"
        tetrahedron = b"0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        strips = b"9 0 2 1 3 -1 0 3 2 2\n4 -1 0 1 3\n"
        cert = certificate(len(WIDE[1]), 4, surfaces())
        self.assertEqual(self.check(cert, WIDE, head + tetrahedron + strips, original_name="o.ply")[0], PROVEN)
        wrong = strips.replace(b"-1 0 1 3", b"-1 0 3 1")
        self.assertEqual(self.check(cert, WIDE, head + tetrahedron + wrong, original_name="o.ply")[0], NOT_PROVEN)
        self.assertEqual(self.check(cert, WIDE, head + tetrahedron + strips.replace(b"3 2", b"3 4"), original_name="o.ply")[0], UNREADABLE)

    def test_faces_may_be_divided(self):
        # An arrow: the fan of its first corner sticks out of the hull, a prism of the arrow's own shape.
        arrow = b"OFF\n4 1 0\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 1 2 3 0\n"
        prism = (
            [(0, 0, -1), (4, 0, -1), (1, 1, -1), (0, 4, -1), (0, 0, 1), (4, 0, 1), (1, 1, 1), (0, 4, 1)],
            [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7)]
            + [t for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)) for t in ((a, b, b + 4), (a, b + 4, a + 4))],
        )
        divided = lambda corners: number(6) + number(1) + number(0) + b"".join(map(number, corners))
        ask = lambda *sections: self.check(certificate(12, 2, *sections), prism, arrow)[0]
        self.assertEqual(ask(surfaces(1)), NOT_PROVEN)
        self.assertEqual(ask(divided([0, 1, 5, 1, 2, 5]), surfaces(1)), PROVEN)
        for wrong in ([0, 1, 5, 1, 5, 2], [0, 0, 0, 1, 2, 5], [1, 2, 5, 1, 2, 5], [0, 1, 2, 0, 4, 5]):
            self.assertEqual(ask(divided(wrong), surfaces(1)), NOT_PROVEN, wrong)
        self.assertEqual(ask(divided([0, 1, 5, 1, 2, 6]), surfaces(1)), UNREADABLE)
        right = divided([0, 1, 5, 1, 2, 5])
        for sections in ([right], [right, right, surfaces(1)], [right, surfaces(1), right]):
            self.assertEqual(ask(*sections), UNREADABLE)

    def test_faces_that_are_folded_are_not_divided_away(self):
        # Each sticks out of the cube; its boundary, as a sum, is 0, or that of the triangle (0, 1, 2).
        hull = box((-2, -2, -2), (2, 2, 2))
        points = b"0 0 0\n1 0 0\n0 1 0\n9 0 0\n"
        for corners, leaves_out in (
            ((0, 1, 3, 1), (0, 0, 0, 0, 0, 0)),
            ((1, 3, 1, 0), (0, 5, 5, 0, 0, 0)),
            ((0, 1, 2, 0, 3), (0, 1, 2, 0, 0, 0, 0, 0, 0)),
            ((1, 2, 0, 3, 0), (0, 1, 2, 0, 0, 0, 0, 0, 0)),
        ):
            face = b"OFF\n4 1 0\n" + points + b"%d %s\n" % (len(corners), b" ".join(b"%d" % c for c in corners))
            section = number(6) + number(1) + number(0) + b"".join(map(number, leaves_out))
            got = self.check(certificate(12, len(corners) - 2, section, surfaces(1)), hull, face)
            self.assertEqual((got[0], "leave out sides" in got[1]), (NOT_PROVEN, True), (corners, got))

    def test_the_answer_tells_of_faces_that_are_divided(self):
        # Around a hole of the hull and back: the fan spans the hole, and triangles without area do not.
        bars = [(-10, -10, 10, -4), (-10, 4, 10, 10), (-10, -10, -4, 10), (4, -10, 10, 10)]
        hull = ([], [])
        for a, b, c, d in bars:
            bar, first = box((a, b, -1), (c, d, 1)), len(hull[0])
            hull[0].extend(bar[0]), hull[1].extend(tuple(v + first for v in t) for t in bar[1])
        face = b"OFF\n4 1 0\n-6 -6 0\n6 -6 0\n6 6 0\n-6 6 0\n8 0 1 2 3 0 3 2 1\n"
        section = number(6) + number(1) + number(0) + b"".join(map(number, (0, 1, 0, 1, 2, 1, 2, 5, 2, 5, 0, 5, 0, 1, 0, 0, 1, 0)))
        self.assertEqual(self.check(certificate(48, 6, surfaces(1)), hull, face)[0], NOT_PROVEN)
        code, said = self.check(certificate(48, 6, section, surfaces(1)), hull, face)
        self.assertEqual((code, said.strip().endswith("; faces of the original that are divided in another way than as fans: 1")), (PROVEN, True), said)

    def test_decimals_are_rounded_correctly(self):
        text = "OFF\n3 1 0\n8.99999999999999999999999 0 0\n0 0 0\n0 1 0\n3 0 1 2\n".encode()
        hull = box((-1, -1, -1), (9, 9, 9))
        self.assertEqual(self.check(certificate(12, 1, surfaces(1)), hull, text)[0], PROVEN)
        text = text.replace(b"8.99999999999999999999999", b"9.0000000000000009")
        self.assertEqual(self.check(certificate(12, 1, surfaces(1)), hull, text)[0], NOT_PROVEN)


class Unreadable(Checked):
    def test_certificates(self):
        hull, added, fans = moved_outwards(CUBE, random.Random(1), 3)
        cert = certificate(len(hull[1]), len(CUBE[1]), tetrahedra(added, fans))
        self.assertEqual(self.check(cert, hull, CUBE)[0], PROVEN)
        for n in range(len(cert)):
            self.assertEqual(self.check(cert[:n], hull, CUBE)[0], UNREADABLE, n)
        for wrong in (b"", b"x" * 40, cert + b"\0", cert + b"\x09", cert + b"\x02\x02", cert + cert[26:]):
            self.assertEqual(self.check(wrong, hull, CUBE)[0], UNREADABLE)
        self.assertEqual(self.check(certificate(2**60, 5, surfaces()), hull, CUBE)[0], NOT_PROVEN)

    def test_meshes(self):
        cert = certificate(12, 12, surfaces())
        for name, content in (
            ("h.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            ("h.off", b"OFF\n1e18 1 0\n0 0 0\n"),
            ("h.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 x\n3 0 1 2\n"),
            ("h.off", b""),
            ("h.obj", b"v 0 0 0\nf 1 2 3\n"),
            ("h.obj", b"v 0 0 0\nf -2 1 1\n"),
            ("h.stl", struct.pack("<80xI", 2**32 - 1)),
            ("h.stl", b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nendloop\nendfacet\nendsolid"),
            ("h.ply", b"ply\nformat ascii 1.0\nelement face 1\nproperty list char char corners\nend_header\n3 0 1 2\n"),
            ("h.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 1e300\nproperty float x\nend_header\n"),
            ("h.xyz", b"1 2 3\n"),
        ):
            code, line = self.check(cert, content, CUBE, hull_name=name)
            self.assertEqual(code, UNREADABLE, line)
            self.assertIn(name, line)


def two_boxes(left=5, right=3):
    """Pieces that cover CUBE if they meet."""
    return both(box((-1, -1, -1), (left, 9, 9)), box((right, -1, -1), (9, 9, 9)))


def ball_cover(rng, count=40):
    """Balls that cover CUBE, and trees."""
    found = []
    for i in range(27):
        found.append((*(1.5 + 2.5 * (i // 3**k % 3) for k in range(3)), 2.75 + rng.random()))

    def leaf(t):
        return next((i for i, b in enumerate(found) if all(in_ball(b, p) for p in t)), None)

    return found, [bisected_tree(t, leaf) for t in soup(CUBE)]


class Page(Checked):
    def test_the_example_of_the_page(self):
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
        with open(os.path.join(root, "docs", "certificate.md"), encoding="utf-8") as file:
            example = file.read().split("## An example")[1]
        cert = b"".join(bytes.fromhex(m) for m in re.findall(r"^    ((?:[0-9A-F]{2} +)*[0-9A-F]{2})(?:  |$)", example, re.M))
        columns = [(row[4:28].strip(), row[28:].strip()) for row in example.split("\n\n")[2].split("\n")]
        original, hull = ("\n".join(column).encode() for column in zip(*columns))
        code, line = self.check(cert, hull, original)
        self.assertEqual((code, line), (PROVEN, "proven: the hull covers every finite triangle; the hull encloses the solid\n"))


class Covers(Checked):
    def test_pieces(self):
        mesh = two_boxes()
        self.expect(PROVEN, "covers every finite triangle", [surfaces(1)], mesh, CUBE)
        dented = ([(6, 3, 3) if i == 8 else p for i, p in enumerate(mesh[0])], mesh[1])
        self.expect(NOT_PROVEN, "outside", [surfaces(1)], dented, both(CUBE, box((5, 0, 0), (6, 1, 1))))
        self.expect(NOT_PROVEN, "outside", [surfaces(1)], (mesh[0], [(a, c, b) for a, b, c in mesh[1]]), CUBE)

    def test_a_file_for_each_piece(self):
        halves = [box((-1, -1, -1), (5, 9, 9)), box((3, -1, -1), (9, 9, 9))]
        for suffix, write in ((".off", off), (".obj", obj), (".stl", stl), (".stl", lambda m: stl(m, True)), (".ply", ply)):
            paths = [self.path("c", certificate(24, len(CUBE[1]), surfaces(1)))]
            paths += [self.path(f"{i}{suffix}", write(half)) for i, half in enumerate(halves)] + [self.path("o.off", off(CUBE))]
            done = subprocess.run([PROGRAM, *paths], capture_output=True, text=True)
            self.assertEqual(done.returncode, PROVEN, done.stdout)

    def test_pieces_that_leave_a_slit(self):
        self.expect(NOT_PROVEN, "outside", [surfaces(1)], two_boxes(4, 5), CUBE)

    def test_pieces_that_share_a_wall(self):
        self.expect(PROVEN, "covers", [surfaces(1)], two_boxes(3, 3), CUBE)

    def test_pieces_that_leave_a_hole(self):
        # Six boxes around a room of (2, 2, 2) to (4, 4, 4): slabs that cross each other, or touch in walls.
        solid = box((1, 1, 1), (5, 5, 5))
        for reach in (6, 4):
            hull = ([], [])
            for axis in range(3):
                for from_, to in ((0, 2), (4, 6)):
                    low, high = [0, 0, 0], [6, 6, 6]
                    for other in range(axis):
                        low[other], high[other] = 6 - reach, reach
                    low[axis], high[axis] = from_, to
                    hull = both(hull, box(low, high))
            self.expect(PROVEN, "covers", [surfaces(1)], hull, solid)
            self.expect(NOT_PROVEN, "hole", [surfaces(3)], hull, solid)
            hollow = both(solid, turned(box((2, 2, 2), (4, 4, 4))))
            self.expect(PROVEN, "encloses", [surfaces(3)], hull, hollow)
            self.expect(NOT_PROVEN, "outside", [surfaces(3)], hull, both(solid, turned(box((2, 2, 3), (4, 4, 4)))))
            self.expect(PROVEN, "encloses", [surfaces(3)], both(hull, box((2, 2, 2), (4, 4, 4))), solid)
            self.expect(PROVEN, "encloses", [surfaces(3)], both(hull, box((1, 1, 1), (5, 5, 5))), solid)

    def test_pieces_that_touch_or_cross(self):
        for left, right in ((5, 3), (3, 3), (9, -1), (9, 3), (4, 4)):
            self.expect(PROVEN, "encloses the solid", [surfaces(3)], two_boxes(left, right), CUBE)
        # Of three pieces two share half of a wall of the third each.
        halves = both(box((4, -1, -1), (9, 3, 9)), box((4, 3, -1), (9, 9, 9)))
        self.expect(PROVEN, "encloses", [surfaces(3)], both(box((-1, -1, -1), (4, 9, 9)), halves), CUBE)
        self.expect(NOT_PROVEN, "", [surfaces(3)], both(box((-1, -1, -1), (4, 9, 9)), box((4, -1, -1), (9, 3, 9))), CUBE)

    def test_balls(self):
        found, trees = ball_cover(random.Random(4))
        cert = certificate(len(found), len(CUBE[1]), balls(trees))
        code, line = self.check(cert, yaml(found), CUBE, hull_name="balls.yaml")
        self.assertEqual((code, line), (PROVEN, "proven: the hull covers every finite triangle\n"))
        flow = "spheres:\n" + "".join("  - {center: [%r, %r, %r], radius: %r}\n" % b for b in found)
        self.assertEqual(self.check(cert, flow.encode(), CUBE, hull_name="balls.yaml")[0], PROVEN)
        small = [(*b[:3], 0.5) for b in found]
        self.assertEqual(self.check(cert, yaml(small), CUBE, hull_name="balls.yaml")[0], NOT_PROVEN)
        for wrong in (b"part:\n  - center: [1, 2, 3]\n", b"a:\n  b:\n    c:\n", b"# - center: [1, 2, 3]\n x", b"- center: [1, 2, 3]\n  radius: 0\n"):
            self.assertEqual(self.check(cert, wrong, CUBE, hull_name="balls.yaml")[0], UNREADABLE)

    def test_a_ball_that_touches_all_corners(self):
        mesh = ([(3, 4, 0), (-3, 4, 0), (0, -5, 0)], [(0, 1, 2)])
        for radius, code in ((5.0, PROVEN), (4.999999999999999, NOT_PROVEN)):
            cert = certificate(1, 1, balls([number(3)]))
            self.assertEqual(self.check(cert, yaml([(0.0, 0.0, 0.0, radius)]), mesh, hull_name="balls.yaml")[0], code)


class Distances(Checked):
    def test_gap(self):
        self.expect(PROVEN, "keeps a gap of at least 1", [gap(1.0)], WIDE, CUBE)
        self.expect(NOT_PROVEN, "nearer", [gap(1.0000000000000002)], WIDE, CUBE)
        self.expect(PROVEN, "encloses the solid; the hull keeps a gap of at least 0.5", [surfaces(), gap(0.5)], WIDE, CUBE)

    def test_distance(self):
        corner = 3**0.5

        def leaf(t):
            for i, o in enumerate(soup(CUBE)):
                if all(triangle_distance(o, p) <= corner for p in t):
                    return i
            return None

        trees = [bisected_tree(t, leaf) for t in soup(WIDE)]
        self.expect(PROVEN, "no point of the surface of the hull is farther than 1.7320508075688", [distance(corner + 1e-15, trees)], WIDE, CUBE)
        self.expect(NOT_PROVEN, "farther", [distance(1.7, trees)], WIDE, CUBE)


class Mutants(Checked):
    """No yes that brute force in fractions or prohull.verify denies."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.many = subprocess.Popen([MANY], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        cls.verified = {}  # how often, by both answers: whether the checker says yes, and whether verify does

    @classmethod
    def tearDownClass(cls):
        cls.many.communicate()
        super().tearDownClass()
        asked = "; ".join(f"checker {c}, verify {v}: {n}" for (c, v), n in sorted(cls.verified.items()))
        print(f"PROHULL_TEST_SEED={SEED}; {asked or 'prohull.verify was not asked: there is no Python package'}")

    def check(self, *files):
        """As the program of one check does, by CHECK_MANY."""
        print(*self.paths(*files), sep="\t", file=self.many.stdin, flush=True)
        told = []
        while not (told and told[-1].startswith("exit ")):
            told.append(self.many.stdout.readline() or "exit of CHECK_MANY")
        line, _, end = told
        self.assertIn(end, [f"exit {code}\n" for code in (PROVEN, NOT_PROVEN, UNREADABLE)], told)
        return int(end.split()[1]), line

    def denied_by_verify(self, claims, hull, original, side):
        """What prohull.verify says against a yes to these claims, which say all that it decides; None if it was not asked."""
        if not prohull or not hull[1] or not original[1]:
            return None
        try:
            found = prohull.verify(hull, original, side="inner" if side else "outer")
        except prohull.InputError as error:
            found = None
            why = str(error)
        else:
            why = found.why_not
        says = claims is not None, bool(found)
        self.verified[says] = self.verified.get(says, 0) + 1
        return f"verify says no: {why}" if says == (True, False) else None

    def cases(self):
        rng = random.Random(5)
        small = box((0, 0, 0), (6, 6, 6))
        for name, sections, hull, original, side in (
            ("tetrahedra", None, None, small, 0),
            ("tetrahedra inside", None, None, small, 1),
            ("surfaces", surfaces(3), small, small, 0),
            ("surfaces around", surfaces(3), box((-1, 0, 0), (7, 7, 6)), small, 0),
            ("surfaces inside", surfaces(3), small, box((-1, 0, 0), (7, 7, 6)), 1),
            ("covers", surfaces(1), box((0, 0, 0), (6, 6, 7)), (small[0], small[1][2:9]), 0),
            ("crossed", surfaces(1), both(box((-1, -1, -1), (4, 6, 6)), box((2, -1, -1), (7, 7, 7))), small, 0),
        ):
            if sections is None:
                hull, added, fans = moved_outwards(original, rng, 5, 1 - 2 * side)
                sections = tetrahedra(added, fans)
            yield name, sections, hull, original, side
        crossed = both(both(box((-1, -1, -1), (4, 6, 6)), box((2, -1, -1), (7, 7, 7))), tetrahedron([(0, 0, 0), (9, 0, 0), (0, 9, 1), (0, 2, 9)]))
        yield "crossed, around a solid", surfaces(3), crossed, small, 0
        yield "pieces", surfaces(1), two_boxes(), CUBE, 0
        yield "pieces around a solid", surfaces(3), two_boxes(), CUBE, 0
        yield "pieces that share a wall", surfaces(3), two_boxes(3, 3), CUBE, 0
        yield "gap", surfaces(3) + gap(1.0), box((-1, -1, -1), (7, 7, 7)), small, 0

    def mutant(self, rng, sections, hull, original):
        hull, original = (list(hull[0]), list(hull[1])), (list(original[0]), list(original[1]))
        for _ in range(rng.choice((1, 1, 2, 3))):
            mesh = rng.choice((hull, hull, original))
            i = rng.randrange(len(mesh[1]))
            kind = rng.randrange(8)
            if kind < 3:
                v = rng.randrange(len(mesh[0]))
                mesh[0][v] = tuple(x + rng.choice((-2, -1, 0, 0, 1, 2)) for x in mesh[0][v])
            elif kind == 3 and len(mesh[1]) > 1:
                del mesh[1][i]
            elif kind == 4:
                a, b, c = mesh[1][i]
                mesh[1][i] = (a, c, b)
            elif kind == 5:
                j = rng.randrange(len(mesh[1]))
                mesh[1][i], mesh[1][j] = mesh[1][j], mesh[1][i]
            elif kind == 6:
                mesh[1].append(mesh[1][i])
            elif sections:
                k = rng.randrange(len(sections))
                sections = rng.choice(
                    (
                        sections[:k] + bytes([rng.randrange(256)]) + sections[k + 1 :],
                        sections[:k] + bytes([sections[k] ^ 1 << rng.randrange(8)]) + sections[k + 1 :],
                        sections[:k] + sections[k + 1 :],
                        sections[:k] + bytes([rng.randrange(8)]) + sections[k:],
                    )
                )
        return sections, hull, original

    def denied(self, rng, line, hull, original, side):
        """What is wrong with a yes."""
        inner, outer = (soup(hull), soup(original)) if side else (soup(original), soup(hull))
        if not is_closed(outer):
            return "the outer surface is not closed"
        if "covers" in line:
            for t in inner:
                for _ in range(2):
                    p = point_of(t, rng)
                    if not is_covered(outer, p, t, rng):
                        return f"{p} is not covered"
        if "encloses" in line:
            if not is_closed(inner):
                return "the inner surface is not closed"
            for i in range(24):
                p = tuple(Fraction(rng.randint(-4000, 12000), 1000) for _ in range(3))
                if i % 2:  # beside the outer surface, where holes are
                    p = tuple(x + Fraction(rng.randint(-9, 9), 10 ** rng.randint(2, 9)) for x in point_of(rng.choice(outer), rng))
                w, around = winding(inner, p, rng), winding(outer, p, rng)
                if w is not None and around is not None and w >= 1 and around < 1:
                    return f"{p} is not enclosed"
        if "gap" in line:
            least = float(re.search(r"gap of at least (\S+?)(;|\n)", line)[1])
            for t in soup(hull):
                p = point_of(t, rng)
                if any(triangle_distance(o, p) < least * (1 - 1e-9) for o in soup(original)):
                    return f"{p} is in the gap"
        return None

    def judge(self, rng, answer, hull, original, side):
        code, line = answer
        decides_all = "encloses" in line or not is_closed(soup(original))
        if code == NOT_PROVEN or (code == PROVEN and "covers" in line and decides_all):
            what = self.denied_by_verify(line if code == PROVEN else None, hull, original, side)
            self.assertIsNone(what, (what, line, hull, original, side))
        if code == PROVEN:
            what = self.denied(rng, line, hull, original, side)
            self.assertIsNone(what, (what, line, hull, original, side))

    def test_no_yes_is_false(self):
        rng = random.Random(f"mutants {SEED}")
        cases = list(self.cases())
        answers = {}
        for i in range(MUTANTS):
            name, sections, hull, original, side = cases[i % len(cases)]
            sections, hull, original = self.mutant(rng, sections, hull, original)
            cert = certificate(len(hull[1]), len(original[1]), sections, side=side)
            code, line = self.check(cert, hull, original)
            answers[name, code] = answers.get((name, code), 0) + 1
            self.judge(rng, (code, line), hull, original, side)
        for name, *_ in cases:
            self.assertGreater(answers.get((name, PROVEN), 0), 0, answers)

    def test_no_yes_is_false_of_random_solids(self):
        """Tetrahedra on a small grid, which overlap, touch and repeat, in a box or in more tetrahedra."""
        rng = random.Random(f"solids {SEED}")

        def solid(count, mesh):
            vertices, triangles = list(mesh[0]), list(mesh[1])
            for _ in range(count):
                a, b, c, d = (tuple(rng.randint(0, 4) for _ in range(3)) for _ in range(4))
                if orient(a, b, c, d) > 0:
                    b, c = c, b
                n = len(vertices)
                vertices += [a, b, c, d]
                triangles += [(n, n + 1, n + 2), (n, n + 3, n + 1), (n + 1, n + 3, n + 2), (n + 2, n + 3, n)]
            return vertices, triangles

        proven = 0
        for i in range(MUTANTS // 3):
            original = solid(rng.randint(1, 2), ([], []))
            around = [box((0, 0, 0), (4, 4, 4)), box((0, 0, 0), (4, 4, rng.randint(2, 5))), original, ([], [])][i % 4]
            hull = solid(rng.randint(i % 4 == 3, 2), around)
            side = int(rng.random() < 0.3)
            if side:
                hull, original = original, hull
            claims = rng.choice((1, 3, 3))
            cert = certificate(len(hull[1]), len(original[1]), surfaces(claims), side=side)
            size = 2.0 ** rng.choice((0, -30, -200, 100))
            code, line = self.check(cert, scaled(hull, size), scaled(original, size))
            proven += code == PROVEN
            self.judge(rng, (code, line), hull, original, side)
        self.assertGreater(proven, MUTANTS // 30)

    def test_boxes_are_decided(self):
        """Boxes on a grid, some inside out, that cross, touch and repeat, sheared: the answer is that of all cells."""
        rng = random.Random(f"boxes {SEED}")
        size = 4
        cells = [(x, y, z) for x in range(size) for y in range(size) for z in range(size)]

        def boxes(count, negative, margin=0):
            found = []
            for _ in range(count):
                ends = [sorted(rng.sample(range(margin, size + 1 - margin), 2)) for _ in range(3)]
                found.append((-1 if rng.random() < negative else 1, *zip(*ends)))
            return found

        def wound(found, cell):
            return sum(s for s, low, high in found if all(l <= x < h for l, x, h in zip(low, cell, high)))

        def is_wall_covered(hull, walls):
            """Of each square of a box's walls one of the two cells beside it must be wound around."""
            for _, low, high in walls:
                for axis in range(3):
                    for cell in cells:
                        if not all(l <= x < h for k, (l, x, h) in enumerate(zip(low, cell, high)) if k != axis):
                            continue
                        for end in (low[axis], high[axis]):
                            beside = [tuple(end - back if k == axis else x for k, x in enumerate(cell)) for back in (0, 1)]
                            if all(wound(hull, c) < 1 for c in beside):
                                return False
            return True

        def mesh_of(found, shear):
            mesh = ([], [])
            for s, low, high in found:
                mesh = both(mesh, box(low, high) if s > 0 else turned(box(low, high)))
            return [tuple(sum(m * x for m, x in zip(row, p)) for row in shear) for p in mesh[0]], mesh[1]

        answers = {}
        for i in range(MUTANTS // 6):
            whole, cut = [(1, (0, 0, 0), (size, size, size))], rng.randint(1, size - 1)
            halves = [(1, (0, 0, 0), (cut, size, size)), (1, (cut, 0, 0), (size, size, size))]
            hull = (whole, halves, [])[i % 3] + boxes(rng.randint(0, 2), 1, 1) + boxes(rng.randint(0, 9), 0.2)
            original = whole * (i % 2) + boxes(rng.randint(1, 2), 0) + boxes(rng.choice((0, 0, 1)), 1)
            if rng.random() < 0.5:
                hull = hull[: rng.randint(1, 4)]
            if not hull:
                continue
            a, b, c = (rng.randint(-2, 2) for _ in range(3))
            shear = [(1, a, b), (0, 1, c), (0, 0, 1)]
            inner, outer = mesh_of(original, shear), mesh_of(hull, shear)
            covered = is_wall_covered(hull, original)
            enclosed = covered and all(wound(hull, cell) >= 1 or wound(original, cell) < 1 for cell in cells)
            for claims, truth in ((1, covered), (3, enclosed)):
                cert = certificate(len(outer[1]), len(inner[1]), surfaces(claims))
                code, line = self.check(cert, outer, inner)
                self.assertEqual(code == PROVEN, truth, (line, outer, inner))
            answers[covered, enclosed] = answers.get((covered, enclosed), 0) + 1
        for kind in ((False, False), (True, False), (True, True)):
            self.assertGreater(answers.get(kind, 0), MUTANTS // 600, answers)


if __name__ == "__main__":
    unittest.main()
