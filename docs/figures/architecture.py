#!/usr/bin/python3
"""Prints the drawing of docs/architecture.md, how data flows through the folders: architecture.py > architecture.svg"""

WIDTH, HEIGHT = 1000, 470
DATA, ROOM, PROOF, FRAME, ARROW = "#8a6a45", "#2b6cb0", "#9a4a1c", "#666666", "#444444"
HALF_HEIGHT = 19

# What flows, and the folders of src/ that it flows through: text, centre and width.
BOXES = {
    "file": ("mesh file", DATA, 60, 100, 90),
    "read": ("io", ROOM, 165, 100, 56),
    "triangles": ("TriangleMesh", DATA, 275, 100, 112),
    "repair": ("repair", ROOM, 405, 75, 84),
    "wrap": ("wrap", ROOM, 405, 145, 84),
    "closed": ("closed mesh", DATA, 520, 100, 100),
    "construct": ("construct", ROOM, 640, 100, 92),
    "hull": ("ProgressiveHull", DATA, 775, 100, 126),
    "query": ("query", ROOM, 890, 100, 66),
    "hits": ("hits", DATA, 965, 100, 48),
    "write": ("io", ROOM, 775, 200, 56),
    "written": ("hull.stl, hull.phull", DATA, 775, 275, 150),
    "verify": ("verify", ROOM, 520, 275, 84),
    "proof": ("certificate", PROOF, 275, 275, 100),
}
ARROWS = ["file read", "read triangles", "triangles repair", "triangles wrap", "repair closed", "wrap closed",
          "closed construct", "construct hull", "hull query", "query hits", "hull write", "write written",
          "written verify", "verify proof"]
STRIPS = [
    (350, ROOM, "geometry, mesh, hull, parallel", "what the folders above are made of: predicates, half-edges, the record, threads"),
    (410, DATA, "apps, python, render, examples", "what users run: written with the public headers of include/prohull alone"),
]


def text(x, y, words, color, anchor="middle", size=15, style=""):
    return f'<text x="{x}" y="{y}" fill="{color}" font-size="{size}" text-anchor="{anchor}"{style}>{words}</text>'


def rectangle(x, y, width, height, color, fill="white", style=""):
    return (f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="5" fill="{fill}" stroke="{color}" '
            f'stroke-width="1.5"{style}/>')


def box(words, color, x, y, width):
    """Folders are filled, what flows between them is not."""
    fill = color if color == ROOM else "white"
    yield rectangle(x - width / 2, y - HALF_HEIGHT, width, 2 * HALF_HEIGHT, color, fill)
    yield text(x, y + 5, words, "white" if color == ROOM else color)


def arrow(x0, y0, x1, y1):
    """From point to point, with a head at the end."""
    length = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5
    u, v = (x1 - x0) / length, (y1 - y0) / length
    head = [(x1, y1), (x1 - 9 * u + 4 * v, y1 - 9 * v - 4 * u), (x1 - 9 * u - 4 * v, y1 - 9 * v + 4 * u)]
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in head)
    yield f'<path d="M {x0:.1f} {y0:.1f} L {x1 - 6 * u:.1f} {y1 - 6 * v:.1f}" fill="none" stroke="{ARROW}" stroke-width="1.5"/>'
    yield f'<polygon points="{points}" fill="{ARROW}"/>'


def joined(a, b):
    """An arrow between the sides of two boxes that face each other."""
    (_, _, ax, ay, aw), (_, _, bx, by, bw) = BOXES[a], BOXES[b]
    if abs(ax - bx) < 1:
        toward = 1 if by > ay else -1
        return arrow(ax, ay + toward * HALF_HEIGHT, bx, by - toward * HALF_HEIGHT)
    toward = 1 if bx > ax else -1
    return arrow(ax + toward * aw / 2, ay, bx - toward * bw / 2, by)


def drawing():
    yield (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" '
           'font-family="sans-serif">')
    yield f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>'
    yield rectangle(348, 28, 344, 152, FRAME, "none", ' stroke-dasharray="6 4"')
    yield text(520, 21, "enclose: the ladder of solids, until a hull is good enough", FRAME, size=13)
    for ends in ARROWS:
        yield from joined(*ends.split())
    # The verifier reads the original too, past all that was done to it.
    yield (f'<path d="M 275 {100 + HALF_HEIGHT} L 275 215 L 520 215 L 520 {275 - HALF_HEIGHT - 6}" fill="none" '
           f'stroke="{ARROW}" stroke-width="1.5"/>')
    yield from arrow(520, 240, 520, 275 - HALF_HEIGHT)
    yield text(392, 208, "the original", ARROW, size=13)
    yield text(520, 312, "shares only geometry with construct", FRAME, size=13)
    for y, color, names, what in STRIPS:
        yield rectangle(15, y, WIDTH - 30, 44, color)
        yield text(30, y + 27, names, color, "start", style=' font-weight="bold"')
        yield text(WIDTH - 30, y + 27, what, color, "end", 13)
    for box_ in BOXES.values():
        yield from box(*box_)
    yield "</svg>"


if __name__ == "__main__":
    print("\n".join(drawing()))
