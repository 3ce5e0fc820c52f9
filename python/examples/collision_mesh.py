#!/usr/bin/python3
"""A collision mesh for one part, proven to cover it: collision_mesh.py PART OUT [FACES]"""

import sys

import prohull


def main(part, out, faces=200):
    hull = prohull.build(part, faces_target=int(faces), tight=True, float32=out.endswith((".stl", ".glb")))
    for what in hull.repairs + hull.notes:
        print(f"{part}: {what}")
    if not hull.certified:
        sys.exit(f"{part}: no certified hull")
    hull.save(out)
    print(f"{out}: {len(hull.faces)} faces, void {hull.void_ratio:.2%}, at most {hull.distance_bound:.4g} from the part")
    if not prohull.verify(out, part):  # once more, from the two files
        sys.exit(f"{out}: does not enclose {part}")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    main(*sys.argv[1:])
