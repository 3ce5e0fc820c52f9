"""Writes certificates (docs/certificate.md) and small mesh files, and answers by brute force, in whole numbers, what a checker decides.

Nothing is shared with prohull or with the checker. A mesh is a list of vertices and a list of triangles; a soup of its triangles' corners
is what the oracle reads.
"""

import math
import os
import random
import struct
import tempfile
import unittest
from fractions import Fraction


class Folder(unittest.TestCase):
    """Tests that write files."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def path(self, name, content):
        """Of a file with this content."""
        path = os.path.join(self.folder.name, name)
        if os.path.exists(path):
            os.remove(path)  # to write over a file takes milliseconds on some file systems
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path


def number(n):
    out = bytearray()
    while n > 127:
        out.append(n & 127 | 128)
        n >>= 7
    return bytes(out) + bytes([n])


def numbers(*values):
    return b"".join(map(number, values))


def certificate(hull_count, original_count, *sections, side=0, scale=1.0, turned=()):
    head = b"\x89PHCER\r\n" + numbers(1, side) + struct.pack("<d", scale)
    return head + numbers(hull_count, original_count, len(turned), *turned) + b"".join(sections)


def tetrahedra(added, fans):
    """Fans are (P, c, [x0, x1, ...])."""
    out = number(1) + number(len(added)) + b"".join(struct.pack("<3d", *p) for p in added) + number(len(fans))
    for apex, centre, chain in fans:
        out += numbers(apex, centre, len(chain) - 1, *chain)
    return out


def surfaces(claims=3):
    return numbers(2, claims)


def balls(trees):
    return number(3) + b"".join(trees)


def gap(least):
    return number(4) + struct.pack("<d", least)


def distance(most, trees):
    return number(5) + struct.pack("<d", most) + b"".join(trees)


def yaml(list_of_balls):
    lines = ["collision_spheres:", "  part:"]
    for x, y, z, r in list_of_balls:
        lines += [f"    - center: [{x!r}, {y!r}, {z!r}]  # a comment", f"      radius: {r!r}"]
    return ("\n".join(lines) + "\n").encode()


# ---- Mesh files


def off(mesh):
    vertices, triangles = mesh
    lines = ["OFF", f"{len(vertices)} {len(triangles)} 0"]
    lines += [" ".join(map(repr, v)) for v in vertices] + [" ".join(map(str, (len(t), *t))) for t in triangles]
    return ("\n".join(lines) + "\n").encode()


def obj(mesh):
    lines = ["# a comment"] + ["v " + " ".join(map(repr, v)) for v in mesh[0]]
    lines += ["f " + " ".join(f"{v + 1}//7" if i % 2 else str(v - len(mesh[0])) for v in t) for i, t in enumerate(mesh[1])]
    return ("\n".join(lines) + "\n").encode()


def stl(mesh, ascii_text=False):
    loose = [[mesh[0][v] for v in t] for t in mesh[1]]
    if not ascii_text:
        body = [struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0) for t in loose]
        return b"solid but binary".ljust(80) + struct.pack("<I", len(body)) + b"".join(body)
    text = "solid a vertex 1 2 3\n"
    for t in loose:
        text += "facet normal 0 0 nan\n outer loop\n" + "".join("  vertex %r %r %r\n" % p for p in map(tuple, t)) + " endloop\nendfacet\n"
    return (text + "endsolid a\n").encode()


def ply(mesh, form="ascii", real="double"):
    head = f"ply\nformat {form} 1.0\ncomment x\nelement vertex {len(mesh[0])}\nproperty uchar red\n"
    head += "".join(f"property {real} {a}\n" for a in "xyz")
    head += f"element face {len(mesh[1])}\nproperty list uchar int vertex_indices\nproperty short flag\nend_header\n"
    if form == "ascii":
        rows = ["7 " + " ".join(map(repr, v)) for v in mesh[0]] + [" ".join(map(str, (len(t), *t, -1))) for t in mesh[1]]
        return (head + "\n".join(rows) + "\n").encode()
    order = "<" if "little" in form else ">"
    body = b"".join(struct.pack(order + "B3" + real[0], 7, *v) for v in mesh[0])
    return head.encode() + body + b"".join(struct.pack(f"{order}B{len(t)}ih", len(t), *t, -1) for t in mesh[1])


# ---- Small meshes with whole coordinates


def box(low, high):
    """Outwards; 12 triangles."""
    v = [tuple((low, high)[i >> k & 1][k] for k in range(3)) for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return v, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def subdivided(mesh):
    """Each triangle becomes four; coordinates are doubled so that middles are whole."""
    v, made, out = [tuple(2 * x for x in p) for p in mesh[0]], {}, []

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in made:
            made[key] = len(v)
            v.append(tuple((x + y) // 2 for x, y in zip(v[a], v[b])))
        return made[key]

    for a, b, c in mesh[1]:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        out += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return v, out


def star(triangles, v):
    """The closed chain of vertices around v, with (v, x0, x1) a triangle."""
    after = {t[(t.index(v) + 1) % 3]: t[(t.index(v) + 2) % 3] for t in triangles if v in t}
    chain = [min(after)]
    while len(chain) == 1 or chain[-1] != chain[0]:
        chain.append(after[chain[-1]])
    return chain


def moved_outwards(mesh, rng, moves, sign=1):
    """A hull of the mesh made by moving vertices outwards (inwards if sign is -1), with its fans."""
    vertices, triangles = list(mesh[0]), list(mesh[1])
    added, fans, names = [], [], list(range(len(vertices)))
    for v in rng.sample(range(len(vertices)), moves):
        chain = star(triangles, v)
        for _ in range(200):
            p = tuple(x + rng.randint(-3, 3) for x in vertices[v])
            if p != vertices[v] and all(
                sign * orient(vertices[v], vertices[a], vertices[b], p) >= 0 for a, b in zip(chain, chain[1:])
            ):
                fans.append((len(mesh[0]) + len(added), names[v], [names[x] for x in chain]))
                names[v] = len(mesh[0]) + len(added)
                added.append(p)
                vertices[v] = p
                break
    return (vertices, triangles), added, fans


# ---- The oracle: whole numbers, or fractions


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def det(u, v, w):
    return (
        u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0])
    )


def orient(a, b, c, p):
    """> 0 where p sees (a, b, c) counter-clockwise."""
    return det(minus(b, a), minus(c, a), minus(p, a))


def soup(mesh):
    return [tuple(mesh[0][v] for v in t) for t in mesh[1]]


def is_closed(triangles):
    count = {}
    for t in triangles:
        for k in range(3):
            a, b = t[k], t[(k + 1) % 3]
            count[a, b] = count.get((a, b), 0) + 1
            count[b, a] = count.get((b, a), 0) - 1
    return not any(n for (a, b), n in count.items() if a != b)


def winding(triangles, p, rng):
    """The winding number around p, or None if p is on a triangle. A ray in a random direction that meets no edge."""
    scale = 1
    for x in p:
        scale = scale * Fraction(x).denominator // math.gcd(scale, Fraction(x).denominator)
    p = tuple(int(x * scale) for x in p)
    triangles = [tuple((a * scale, b * scale, c * scale) for a, b, c in t) for t in triangles]
    while True:
        d = tuple(rng.randint(-(10**6), 10**6) for _ in range(3))
        total = 0
        for a, b, c in triangles:
            a, b, c = minus(a, p), minus(b, p), minus(c, p)
            height = det(a, b, c)
            s = [det(d, a, b), det(d, b, c), det(d, c, a)]
            if height == 0:
                n = [det(minus(b, a), minus(c, a), e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
                k = max(range(3), key=lambda i: abs(n[i]))
                axis = tuple(int(i == k) for i in range(3))
                q = [det(a, b, axis), det(b, c, axis), det(c, a, axis)]
                if n[k] and (min(q) >= 0 or max(q) <= 0):
                    return None
                continue
            if min(s) < 0 < max(s):
                continue
            if 0 in s:
                break
            # The line meets the triangle; ahead if the height and the direction have the same sign.
            if (s[0] > 0) == (height > 0):
                total += 1 if s[0] > 0 else -1
        else:
            return total


def point_of(t, rng):
    w = [rng.randint(1, 1000) for _ in range(3)]
    s = sum(w)
    return tuple(Fraction(sum(w[i] * t[i][k] for i in range(3)), s) for k in range(3))


def is_covered(triangles, p, t, rng):
    """Whether p, a random point of t, lies in the closure of what the triangles wind around."""
    w = winding(triangles, p, rng)
    if w is not None:
        return w >= 1
    n = [det(minus(t[1], t[0]), minus(t[2], t[0]), e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    if not any(n):
        return True  # a point of a segment: many regions may be beside it
    for s in (1, -1):
        w = winding(triangles, tuple(x + Fraction(s * y, 2**60) for x, y in zip(p, n)), rng)
        if w is None or w >= 1:
            return True
    return False


def bisected_tree(t, is_leaf, depth=0):
    """A tree for triangle t. `is_leaf` returns the number of what holds three points, or None."""
    leaf = is_leaf(t)
    if leaf is not None or depth == 12:
        return number(3 + (leaf or 0))
    lengths = [sum((x - y) ** 2 for x, y in zip(t[(k + 1) % 3], t[(k + 2) % 3])) for k in range(3)]
    n = lengths.index(max(lengths))
    m = tuple(Fraction(x + y) / 2 for x, y in zip(t[(n + 1) % 3], t[(n + 2) % 3]))
    halves = [tuple(m if k == (n + i) % 3 else p for k, p in enumerate(t)) for i in (1, 2)]
    return number(n) + b"".join(bisected_tree(h, is_leaf, depth + 1) for h in halves)


def in_ball(ball, p):
    return sum((Fraction(x) - Fraction(c)) ** 2 for x, c in zip(p, ball)) <= Fraction(ball[3]) ** 2


def triangle_distance(t, p):
    """Rounded."""
    best = None
    n = [float(det(minus(t[1], t[0]), minus(t[2], t[0]), e)) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    if any(n):
        inside = [float(det(minus(t[(i + 1) % 3], t[i]), minus(p, t[i]), n)) for i in range(3)]
        if min(inside) >= 0:
            return abs(sum(float(x) * y for x, y in zip(minus(p, t[0]), n))) / math.dist(n, (0, 0, 0))
    for i in range(3):
        a, b = t[i], t[(i + 1) % 3]
        d, q = minus(b, a), minus(p, a)
        length = sum(x * x for x in d)
        s = min(1.0, max(0.0, float(sum(x * y for x, y in zip(d, q))) / float(length))) if length else 0.0
        here = math.dist([float(x) for x in q], [s * float(x) for x in d])
        best = here if best is None else min(best, here)
    return best
