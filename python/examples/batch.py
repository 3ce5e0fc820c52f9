#!/usr/bin/python3
"""Hulls of all meshes of a folder, one process for each core: batch.py FOLDER OUT_FOLDER [FACES]"""

import concurrent.futures
import pathlib
import sys

import prohull

FORMATS = {".ply", ".obj", ".off", ".stl", ".glb", ".gltf", ".dae", ".3mf"}


def build(source, target, faces):
    try:
        hull = prohull.build(source, faces_target=faces, float32=True, threads=1)
    except prohull.InputError as error:
        return f"REFUSED {error}"
    if not hull.certified:
        return f"FAILED  {source.name}: " + "; ".join(hull.notes)
    hull.save(target)
    return f"ok      {source.name}: {len(hull.faces)} faces, void {hull.void_ratio:.2%}"


def main(folder, out_folder, faces=500):
    sources = sorted(p for p in pathlib.Path(folder).iterdir() if p.suffix.lower() in FORMATS)
    out = pathlib.Path(out_folder)
    out.mkdir(parents=True, exist_ok=True)
    targets = [out / f"{source.name}.stl" for source in sources]
    with concurrent.futures.ProcessPoolExecutor() as pool:
        for line in pool.map(build, sources, targets, [int(faces)] * len(sources)):
            print(line)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    main(*sys.argv[1:])
