#!/usr/bin/python3
"""Void against faces, of levels and of tight hulls: void_plot.py OUT.png [MESH]; without a mesh a sample."""

import sys

import matplotlib

matplotlib.use("Agg")  # no display
import matplotlib.pyplot as plt
import prohull


def main(out, path=None):
    mesh = prohull.read(path) if path else prohull.sample("asteroid", 5000)
    hull = prohull.build(mesh, faces_target=100, levels=True)
    faces = [n for n in (100, 200, 500, 1000, 2000) if n < len(mesh.faces)]
    void = [hull.level(n).volume / hull.original.volume - 1 for n in faces]
    tight = prohull.build(mesh, faces_target=faces, tight=True)

    figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
    axes.loglog(faces, [100 * v for v in void], "o-", label="levels of one hull")
    axes.loglog([len(t.faces) for t in tight], [100 * t.void_ratio for t in tight], "s-", label="tight hulls")
    axes.set_xlabel("faces")
    axes.set_ylabel("void, % of the volume")
    axes.legend()
    figure.savefig(out)
    print(f"{out}: " + ", ".join(f"{n}: {100 * v:.2f} %" for n, v in zip(faces, void)))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    main(*sys.argv[1:])
