#!/usr/bin/python3
"""Draws the sections that docs/theory.md shows: theory.py OUT_DIR. Each is computed, in the plane."""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

FINE, COARSE, INNER, ADDED, REMOVED = "#8a6a45", "#2b6cb0", "#9a4a1c", "#9cc3ea", "#e9a08f"
SEGMENT, HIT = "#222222", "#d1495b"
plt.rcParams.update({"svg.hashsalt": "theory", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 11})


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def outside(points, p):
    """Twice the areas of the triangles that p makes with the edges of a chain; above 0 outside of them.

    The chain has the solid on its right.
    """
    a, b = np.asarray(points[:-1]), np.asarray(points[1:])
    return cross(b - a, np.asarray(p) - a)


def least_added(points):
    """The point outside of all edges of a chain that adds the least area; it is where two of their lines meet."""
    best, best_area = None, np.inf
    edges = [(np.asarray(a), np.asarray(b) - a) for a, b in zip(points[:-1], np.asarray(points[1:]))]
    for i, (a, u) in enumerate(edges):
        for b, v in edges[i + 1:]:
            if cross(u, v) == 0:
                continue
            p = a + u * cross(b - a, v) / cross(u, v)
            area = outside(points, p).sum()
            if outside(points, p).min() > -1e-9 and area < best_area:
                best, best_area = p, area
    return best


def clipped(polygon, a, edge):
    """What of a convex polygon is outside of the line."""
    kept = []
    for p, q in zip(polygon, [*polygon[1:], polygon[0]]):
        side_p, side_q = cross(edge, p - a), cross(edge, q - a)
        if side_p >= 0:
            kept.append(p)
        if side_p * side_q < 0:
            kept.append(p + (q - p) * side_p / (side_p - side_q))
    return kept


def panel(axes, title, x, y):
    axes.set_title(title, fontsize=11)
    axes.set_xlim(x)
    axes.set_ylim(y)
    axes.set_aspect("equal")
    axes.axis("off")


def line(axes, points, color, width=1.8, style="-", marker="", **how):
    axes.plot(*np.asarray(points).T, style, color=color, linewidth=width, marker=marker, markersize=4.5, **how)


def dot(axes, p, text, color, offset=(6, 6)):
    axes.plot(*p, "o", color=color, markersize=6)
    axes.annotate(text, p, offset, textcoords="offset points", color=color, fontstyle="italic")


def save(figure, out, name):
    figure.savefig(out / f"{name}.svg", metadata={"Date": None}, facecolor="white")


def placement(out):
    """The new vertex of a collapse: where it may be, where it adds the least, and what is added."""
    star = np.array([(0.0, 0.0), (1.1, 0.2), (1.75, 1.0), (2.75, 1.25), (3.4, 0.7), (4.6, 0.1)])
    apex = least_added(star)
    x, y = (-0.2, 4.8), (-0.5, 2.5)
    figure, panels = plt.subplots(1, 3, figsize=(11, 2.7), layout="constrained")
    titles = ("outside of every plane: P may be here", "of these points, P adds the least",
              "what is added: a triangle for each $T_j$")
    for axes, title in zip(panels, titles):
        panel(axes, title, x, y)
        axes.fill(*np.array([*star, (4.6, -0.5), (0, -0.5)]).T, color=FINE, alpha=0.18, linewidth=0)
    first, second, third = panels
    allowed = [np.array((u, v)) for u, v in zip((x[0], x[1], x[1], x[0]), (y[0], y[0], y[1], y[1]))]
    for p, q in zip(star[:-1], star[1:]):
        allowed = clipped(allowed, p, q - p)
    for axes in (first, second):
        axes.fill(*np.array(allowed).T, color=ADDED, alpha=0.6, linewidth=0)
        for p, q in zip(star[:-1], star[1:]):
            axes.axline(p, q, color="#999999", linewidth=0.8, linestyle="--")
    for p, q in zip(star[:-1], star[1:]):
        third.fill(*np.array([p, q, apex]).T, facecolor=ADDED, edgecolor="white", linewidth=1.2, alpha=0.8)
    for axes in (second, third):
        line(axes, [star[0], apex, star[-1]], COARSE)
        dot(axes, apex, "P", COARSE)
    for axes in panels:
        line(axes, star, FINE, marker="o")
        for j, (p, q) in enumerate(zip(star[:-1], star[1:]), 1):
            axes.text(*(p + q) / 2 - (0, 0.32), f"$T_{j}$", color=FINE, ha="center")
    third.text(0.85, 1.0, "$C_1$", color=COARSE)
    third.text(3.6, 1.1, "$C_2$", color=COARSE)
    save(figure, out, "placement")


def swept(out):
    """A vertex moves inwards: what is removed must hold no point of the solid."""
    figure, panels = plt.subplots(1, 2, figsize=(8.4, 3), layout="constrained")
    mesh = np.array([(0, 0), (0.9, 0.75), (1.8, 0.85), (2.7, 1.05), (3.6, 0.75), (4.5, 0)])
    a, b, apex = np.array((-0.2, 0.0)), np.array((4.7, 0.0)), np.array((2.4, 2.6))
    for axes, moved, title in ((panels[0], np.array((2.2, 1.95)), "no point of the mesh is removed: accepted"),
                               (panels[1], (a + apex) / 2, "a part of the mesh is removed: refused")):
        panel(axes, title, (-0.6, 5.2), (-0.3, 3.0))
        axes.fill(*mesh.T, color=FINE, alpha=0.18, linewidth=0)
        for link in (a, b):
            axes.fill(*np.array([apex, moved, link]).T, color=REMOVED, alpha=0.6, linewidth=0)
        line(axes, mesh, FINE, marker="o")
        line(axes, [a, apex, b], COARSE, 1.2, "--")
        line(axes, [a, moved, b], COARSE)
        for p, name, offset in ((apex, "P", (6, 6)), (moved, "Q", (-16, 2)), (a, "a", (-12, -2)), (b, "b", (6, -2))):
            dot(axes, p, name, COARSE, offset)
    save(figure, out, "swept")


class Vertex:
    """Of a progressive hull in the plane, with the edge that a split makes of it and the link that this needs."""

    def __init__(self, position, edge=(), link=()):
        self.position, self.edge, self.link = np.asarray(position), edge, link

    def descends_to(self, other):
        return self is other or any(v.descends_to(other) for v in self.edge)


def positions(vertices):
    return np.array([v.position for v in vertices])


def collapse_best(vertices, is_closed):
    """Collapses the edge that adds the least area; its link stays."""
    count = len(vertices)
    best = None
    for i in range(0 if is_closed else 1, count if is_closed else count - 2):
        star = [vertices[(i + k - 1) % count] for k in range(4)]
        apex = least_added(positions(star))
        if apex is not None and (best is None or outside(positions(star), apex).sum() < best[0]):
            best = (outside(positions(star), apex).sum(), star, apex)
    _, (left, o, d, right), apex = best
    vertices[vertices.index(o)] = Vertex(apex, (o, d), (left, right))
    vertices.remove(d)


def split(vertices, vertex):
    """Undoes a collapse, and before that what its link needs."""
    for needed in vertex.link:
        while needed not in vertices:
            split(vertices, next(v for v in vertices if v.descends_to(needed)))
    i = vertices.index(vertex)
    vertices[i:i + 1] = vertex.edge


def crossings(vertices, p, q):
    """Where a segment meets a chain, and between which of its vertices."""
    for u, v in zip(vertices[:-1], vertices[1:]):
        a, b = u.position, v.position
        t, s = (cross(a - p, w) / cross(q - p, b - a) for w in (b - a, q - p))
        if 0 <= s <= 1 and 0 <= t <= 1:
            yield p + t * (q - p), (u, v)


def refinement(out):
    """A base hull is split where a segment meets it, until what it meets is of the original mesh."""
    angles = np.linspace(np.pi, 0, 21)
    original = np.stack([3 * np.cos(angles), 2 * np.sin(angles)], axis=1)
    vertices = [Vertex(p) for p in original]
    while len(vertices) > 5:
        collapse_best(vertices, is_closed=False)
    p, q = np.array((-3.4, 2.4)), np.array((-0.9, 0.6))
    figure, panels = plt.subplots(1, 3, figsize=(11, 2.8), layout="constrained")
    for axes, title in zip(panels, ("the segment meets the base hull", "split there, it meets a finer face",
                                    "and in the end one of the original")):
        panel(axes, title, (-3.9, 3.9), (-0.2, 3.0))
        axes.fill(*original.T, color=FINE, alpha=0.18, linewidth=0)
        line(axes, original, FINE, 1.0)
        line(axes, positions(vertices), COARSE, marker="o")
        line(axes, [p, q], SEGMENT, 1.4)
        for hit, ends in crossings(vertices, p, q):
            axes.plot(*hit, "o", color=HIT, markersize=6.5)
        while True:
            to_split = [v for _, ends in crossings(vertices, p, q) for v in ends if v.edge]
            if not to_split:
                break
            split(vertices, to_split[0])
            if axes is panels[0]:
                break
    save(figure, out, "refinement")


def hull_of(polygon, count):
    vertices = [Vertex(p) for p in polygon]
    while len(vertices) > count:
        collapse_best(vertices, is_closed=True)
    return positions([*vertices, vertices[0]])


def sides(out):
    """An inner and an outer hull, and what each tells of a segment."""
    angles = -np.linspace(0, 2 * np.pi, 49)[:-1]
    radius = 1.5 + 0.22 * np.cos(3 * angles) + 0.08 * np.sin(5 * angles)
    original = np.stack([1.4 * radius * np.cos(angles), radius * np.sin(angles)], axis=1)
    outer, inner = hull_of(original, 10), hull_of(original[::-1], 10)
    figure, axes = plt.subplots(figsize=(8.4, 3.6), layout="constrained")
    panel(axes, "", (-3.2, 6.8), (-2.0, 2.1))
    axes.fill(*outer.T, color=ADDED, alpha=0.35, linewidth=0)
    axes.fill(*original.T, color="#ead9c4", linewidth=0)
    axes.fill(*inner.T, color="#d9b98f", linewidth=0)
    line(axes, [*original, original[0]], FINE)
    line(axes, outer, COARSE, marker="o")
    line(axes, inner, INNER, marker="o")
    for (x0, y0), (x1, y1), text in (((-2.9, 0.9), (2.9, 0.5), "meets the inner hull: a hit, surely"),
                                     ((0.6, -1.95), (2.9, -1.25), "misses the outer hull: a miss, surely"),
                                     ((2.56, 0.35), (2.43, -0.73), "between the two: the mesh is asked")):
        line(axes, [(x0, y0), (x1, y1)], SEGMENT, 1.4)
        axes.text(x1 + 0.12, y1 - 0.07, text, fontsize=11)
    for p, text, color in (((-3.1, 0.1), "outer hull", COARSE), ((-0.4, -0.2), "inner hull", INNER)):
        axes.text(*p, text, color=color)
    save(figure, out, "sides")


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    for draw in (placement, swept, refinement, sides):
        draw(folder)
