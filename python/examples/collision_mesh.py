#!/usr/bin/python3
"""Builds a collision mesh for one part, proven to cover it."""

import argparse
import sys

import prohull


def main(part, out, faces):
    hull = prohull.build(part, faces, tight=True)
    for what in hull.repairs + hull.notes:
        print(f"{part}: {what}")
    if not hull.certified:
        sys.exit(f"{part}: no certified hull")
    hull.save(out)
    print(f"{out}: {len(hull.faces)} faces, void {hull.void_ratio:.2%}, at most {hull.distance_bound:.4g} from the part")
    if not prohull.verify(out, part):  # once more, from the two files
        sys.exit(f"{out}: does not enclose {part}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", help="the mesh file of the part")
    parser.add_argument("out", help="where the collision mesh goes: .stl, .glb, .ply, .obj or .off")
    parser.add_argument("faces", nargs="?", type=int, default=200, help="its number of faces (200)")
    arguments = parser.parse_args()
    try:
        main(**vars(arguments))
    except prohull.InputError as error:
        sys.exit(str(error))
