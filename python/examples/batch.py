#!/usr/bin/python3
"""Builds hulls of all meshes of a folder, in one process for each core."""

import argparse
import concurrent.futures
import pathlib

import prohull

FORMATS = {".ply", ".obj", ".off", ".stl", ".glb", ".gltf", ".dae", ".3mf"}


def build(source, target, faces):
    try:
        hull = prohull.build(source, faces, threads=1)
        if not hull.certified:
            return f"FAILED  {source.name}: " + "; ".join(hull.notes)
        hull.save(target)
    except prohull.InputError as error:
        return f"REFUSED {error}"
    return f"ok      {source.name}: {len(hull.faces)} faces, void {hull.void_ratio:.2%}" + "".join(
        f"; {note}" for note in hull.notes)


def main(folder, out, faces):
    sources = sorted(p for p in folder.iterdir() if p.suffix.lower() in FORMATS)
    out.mkdir(parents=True, exist_ok=True)
    targets = [out / f"{source.name}.stl" for source in sources]
    with concurrent.futures.ProcessPoolExecutor() as pool:
        for line in pool.map(build, sources, targets, [faces] * len(sources)):
            print(line)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="the folder of the meshes")
    parser.add_argument("out", type=pathlib.Path, help="the folder of the hulls, made if it is not there")
    parser.add_argument("faces", nargs="?", type=int, default=500, help="the number of faces of each hull (500)")
    main(**vars(parser.parse_args()))
