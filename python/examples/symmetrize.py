"""Makes a mesh exactly symmetric: cuts it at a plane, and puts the mirror image of the one half in place of the other.

    python symmetrize.py horse.ply symmetric.ply --axis y
"""

import argparse

import numpy as np

import prohull


def half(vertices, faces, axis):
    """The part with coordinates of at least 0, cut where faces cross the plane."""
    points, cuts, kept = [*vertices], {}, []

    def cut(a, b):
        a, b = min(a, b), max(a, b)
        if (a, b) not in cuts:
            share = vertices[a, axis] / (vertices[a, axis] - vertices[b, axis])
            point = vertices[a] + share * (vertices[b] - vertices[a])
            point[axis] = 0
            cuts[a, b] = len(points)
            points.append(point)
        return cuts[a, b]

    for face in faces.tolist():
        polygon = []
        for a, b in zip(face, face[1:] + face[:1]):
            x, y = vertices[a, axis], vertices[b, axis]
            if x >= 0:
                polygon.append(a)
            if x * y < 0:
                polygon.append(cut(a, b))
        if any(points[v][axis] > 0 for v in polygon):
            kept += [(polygon[0], b, c) for b, c in zip(polygon[1:], polygon[2:])]
    return np.array(points), np.array(kept)


def symmetrized(mesh, axis):
    vertices = mesh.vertices.copy()
    vertices[:, axis] -= (vertices[:, axis].min() + vertices[:, axis].max()) / 2
    vertices, faces = half(vertices, mesh.faces, axis)
    mirrored = vertices.copy()
    mirrored[:, axis] = -mirrored[:, axis]
    in_plane = vertices[:, axis] == 0
    images = np.where(in_plane, np.arange(len(vertices)), np.arange(len(vertices)) + len(vertices))
    return prohull.Mesh(np.vstack([vertices, mirrored]), np.vstack([faces, images[faces[:, ::-1]]]))


if __name__ == "__main__":
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mesh")
    arguments.add_argument("out")
    arguments.add_argument("--axis", choices="xyz", default="x")
    given = arguments.parse_args()
    result = symmetrized(prohull.read(given.mesh), "xyz".index(given.axis))
    result.save(given.out)
    print(f"{given.out}: {len(result.faces):,} faces, symmetric along {given.axis}")
