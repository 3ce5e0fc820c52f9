#!/usr/bin/python3
"""Rays against the levels of a hull: coarse levels answer sooner, and what they miss the mesh misses.

levels_and_rays.py [MESH] [RAYS]; without a mesh a sample.
"""

import sys
import time

import numpy as np
import prohull


def rays_through(mesh, count, random):
    """From a sphere around the mesh to points in its box."""
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    outwards = random.normal(size=(count, 3))
    outwards *= np.linalg.norm(high - low) / np.linalg.norm(outwards, axis=1, keepdims=True)
    origins = (low + high) / 2 + outwards
    return origins, random.uniform(low, high, size=(count, 3)) - origins


def main(path=None, count=20000):
    mesh = prohull.read(path) if path else prohull.sample("pony", 20000)
    hull = prohull.build(mesh, faces_target=200, levels=True)
    rays = rays_through(hull.original, int(count), np.random.default_rng(1))
    truth = hull.original.any_hit(*rays)
    for faces in (200, 1000, 5000):
        level = hull.level(faces)
        level.any_hit(*rays)  # builds the index
        start = time.perf_counter()
        hit = level.any_hit(*rays)
        seconds = time.perf_counter() - start
        assert not (truth & ~hit).any()
        print(f"{len(level.faces):6} faces: {np.mean(hit):6.1%} hit, {np.mean(hit & ~truth):5.1%} in vain, "
              f"{1e9 * seconds / len(hit):5.0f} ns each")
    print(f"{len(hull.original.faces):6} faces: {np.mean(truth):6.1%} hit")


if __name__ == "__main__":
    if len(sys.argv) > 3:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    main(*sys.argv[1:])
