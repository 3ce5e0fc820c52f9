#!/usr/bin/python3
"""Asks rays of the levels of a hull. Coarse levels answer sooner, and what they miss the mesh misses."""

import argparse
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


def main(mesh, rays):
    mesh = prohull.read(mesh) if mesh else prohull.sample("pony", 20000)
    hull = prohull.build(mesh, 200, levels=True)
    rays = rays_through(hull.original, rays, np.random.default_rng(1))
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
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh", nargs="?", help="a mesh file; a sample unless given")
    parser.add_argument("rays", nargs="?", type=int, default=20000, help="how many rays (20000)")
    main(**vars(parser.parse_args()))
