#!/usr/bin/python3
"""Draws the void against the number of faces, of the levels of a hull and of tight hulls."""

import argparse

import prohull


def main(out, mesh):
    import matplotlib
    matplotlib.use("Agg")  # no display
    import matplotlib.pyplot as plt

    mesh = prohull.read(mesh) if mesh else prohull.sample("asteroid", 5000)
    hull = prohull.build(mesh, 100, levels=True)
    faces = [n for n in (100, 200, 500, 1000, 2000) if n < len(mesh.faces)]
    void = [hull.level(n).void_ratio for n in faces]
    tight = prohull.build(mesh, faces, tight=True)

    figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
    axes.loglog(faces, [100 * v for v in void], "o-", label="levels of one hull")
    axes.loglog([len(t.faces) for t in tight], [100 * t.void_ratio for t in tight], "s-", label="tight hulls")
    axes.set_xlabel("faces")
    axes.set_ylabel("void, % of the volume")
    axes.legend()
    figure.savefig(out)
    print(f"{out}: " + ", ".join(f"{n}: {100 * v:.2f} %" for n, v in zip(faces, void)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", help="where the picture goes: .png, .svg or .pdf")
    parser.add_argument("mesh", nargs="?", help="a mesh file; a sample unless given")
    main(**vars(parser.parse_args()))
