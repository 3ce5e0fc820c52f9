#!/usr/bin/python3
"""Deforms a mesh by its cage: the cage is twisted, and mean value coordinates carry the mesh along."""

import argparse

import numpy as np
import prohull


def mean_value_coordinates(points, vertices, faces):
    """The weight of each vertex of a closed mesh for each point strictly inside of it (Ju, Schaefer, Warren 2005): each
    row has the sum 1, and row @ vertices is the point."""
    weights = np.zeros((len(points), len(vertices)))
    for row, point in zip(weights, points):
        towards = vertices - point
        distance = np.linalg.norm(towards, axis=1)
        unit = (towards / distance[:, None])[faces]  # (faces, corner, 3)
        following, last = np.roll(unit, -1, axis=1), np.roll(unit, 1, axis=1)
        # Of the spherical triangle of each face: the side that faces each corner, and the cosine of the angle there.
        side = 2 * np.arcsin(np.clip(np.linalg.norm(following - last, axis=2) / 2, 0, 1))
        half = side.sum(axis=1, keepdims=True) / 2
        next_side, last_side = np.roll(side, -1, axis=1), np.roll(side, 1, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            cosine = 2 * np.sin(half) * np.sin(half - side) / (np.sin(next_side) * np.sin(last_side)) - 1
            cosine = np.clip(cosine, -1, 1)
            turn = np.sign(np.linalg.det(unit))[:, None]
            sine = turn * np.sqrt(1 - cosine ** 2)
            share = side - np.roll(cosine, -1, axis=1) * last_side - np.roll(cosine, 1, axis=1) * next_side
            share /= distance[faces] * np.sin(next_side) * np.roll(sine, 1, axis=1)
        # The plane of such a face goes through the point, which lies outside of the face: it has no share.
        share[~np.isfinite(share).all(axis=1) | (np.abs(sine) < 1e-9).any(axis=1)] = 0
        np.add.at(row, faces, share)
        row /= row.sum()
    return weights


def twisted(points, degrees):
    """Turned about the z axis, by an angle that grows from 0 at the bottom to this one at the top."""
    low, high = points[:, 2].min(), points[:, 2].max()
    angle = np.radians(degrees) * (points[:, 2] - low) / (high - low)
    x, y = points[:, 0], points[:, 1]
    return np.column_stack([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), points[:, 2]])


def main(mesh, out, cage, faces, degrees):
    mesh = prohull.read(mesh)
    around = prohull.cage(mesh, faces, even=True).outer
    weights = mean_value_coordinates(mesh.vertices, around.vertices, around.faces)
    print(f"cage of {len(around.faces)} faces, smallest angle {around.smallest_angle_degrees:.0f} degrees")
    print(f"largest error of the coordinates: {np.abs(weights @ around.vertices - mesh.vertices).max():.0e}")
    moved = twisted(around.vertices, degrees)
    prohull.Mesh(weights @ moved, mesh.faces).save(out)
    if cage:
        around.save(f"{cage}_before.obj")
        prohull.Mesh(moved, around.faces).save(f"{cage}_after.obj")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh", help="a mesh file")
    parser.add_argument("out", help="where the deformed mesh goes")
    parser.add_argument("--cage", help="where the cage goes, before and after: CAGE_before.obj and CAGE_after.obj")
    parser.add_argument("--faces", type=int, default=200, help="of the cage")
    parser.add_argument("--degrees", type=float, default=60, help="by which the top is turned")
    main(**vars(parser.parse_args()))
