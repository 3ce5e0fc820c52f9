#!/usr/bin/python3
"""The space between a mesh and its cage can be filled with tetrahedra: tetrahedra.py PROHULL [MESH...]

Makes cages of all samples, or of closed meshes in files, and has the program tetgen (Hang Si; Debian package tetgen) fill
the space between outer hull and mesh, and between mesh and inner hull. Skipped where tetgen or numpy is missing."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)


def read_off(path):
    """Vertices and triangles of an OFF file."""
    words = pathlib.Path(path).read_text().split()
    assert words[0] == "OFF", path
    vertices, faces = int(words[1]), int(words[2])
    end = 4 + 3 * vertices
    points = np.array(words[4:end], dtype=float).reshape(-1, 3)
    return points, np.array(words[end:end + 4 * faces], dtype=int).reshape(-1, 4)[:, 1:]


def components(faces):
    """The faces of each connected part."""
    label = np.arange(faces.max() + 1)
    while True:
        least = label[faces].min(axis=1)
        smaller = label.copy()
        np.minimum.at(smaller, faces, least[:, None])
        smaller = smaller[smaller]
        if (smaller == label).all():
            break
        label = smaller
    of_face = label[faces[:, 0]]
    return [faces[of_face == part] for part in np.unique(of_face)]


def point_behind(points, part, faces):
    """A point just inside of the surface of `part`: behind the middle of its largest face, half-way to what comes next."""
    a, b, c = (points[part[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    largest = np.argmax((normals ** 2).sum(axis=1))
    origin = (a[largest] + b[largest] + c[largest]) / 3
    direction = -normals[largest] / np.linalg.norm(normals[largest])
    a, ab, ac = points[faces[:, 0]], points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]]
    p = np.cross(direction, ac)
    determinant = (ab * p).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        s = origin - a
        q = np.cross(s, ab)
        u, v, t = (s * p).sum(axis=1) / determinant, q @ direction / determinant, (ac * q).sum(axis=1) / determinant
        near = np.abs(s).max(axis=1)
        is_hit = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9) & (t > 1e-12 * near)
    return origin + direction * t[is_hit].min() / 2


def write_smesh(path, meshes, holes):
    """The surfaces as a piecewise linear complex. meshes: (points, faces) each."""
    lines = [f"{sum(len(points) for points, _ in meshes)} 3 0 0"]
    number = 0
    for points, _ in meshes:
        for x, y, z in points:
            lines.append(f"{number} {x:.17g} {y:.17g} {z:.17g}")
            number += 1
    lines.append(f"{sum(len(faces) for _, faces in meshes)} 1")
    first = 0
    for mark, (points, faces) in enumerate(meshes, 1):
        lines += [f"3 {a + first} {b + first} {c + first} {mark}" for a, b, c in faces]
        first += len(points)
    lines.append(str(len(holes)))
    lines += [f"{i} {x:.17g} {y:.17g} {z:.17g}" for i, (x, y, z) in enumerate(holes)]
    lines.append("0")
    pathlib.Path(path).write_text("\n".join(lines) + "\n")


def tetrahedra_between(outer, inner, work):
    """Runs tetgen on the space inside of `outer` and outside of `inner`: the volumes of its tetrahedra. The faces of
    both stay as they are (-Y)."""
    points, faces = inner
    holes = [point_behind(points, part, faces) for part in components(faces)]
    write_smesh(work / "between.smesh", [outer, inner], holes)
    done = subprocess.run(["tetgen", "-pYqQ", "between.smesh"], cwd=work, capture_output=True, text=True)
    elements = work / "between.1.ele"
    assert done.returncode == 0 and elements.exists(), f"tetgen: {done.returncode}: {done.stdout}{done.stderr}"
    corners = np.loadtxt(elements, skiprows=1, comments="#", ndmin=2).astype(int)[:, 1:5]
    nodes = np.loadtxt(work / "between.1.node", skiprows=1, comments="#", ndmin=2)[:, 1:4]
    for file in work.glob("between.*"):
        file.unlink()
    a, b, c, d = (nodes[corners[:, i]] for i in range(4))
    return np.abs(((b - a) * np.cross(c - a, d - a)).sum(axis=1) / 6)


def volume(mesh):
    points, faces = mesh
    a, b, c = (points[faces[:, i]] for i in range(3))
    return float((a * np.cross(b, c)).sum() / 6)


def check(outer, inner, work, what):
    tetrahedra = tetrahedra_between(outer, inner, work)
    expected = volume(outer) - volume(inner)
    # Where tetgen needs a point on a given edge, it fills what lies between this point and the edge with flat ones.
    flat = int((tetrahedra <= 1e-15 * expected).sum())
    assert flat <= len(tetrahedra) / 500, (what, flat)
    assert abs(tetrahedra.sum() - expected) <= 1e-9 * expected, (what, tetrahedra.sum(), expected)
    print(f"{what}: {len(tetrahedra):,} tetrahedra", flush=True)


def check_cage(prohull, path, name, has_inner, work, *options):
    hulls = ["-o", "outer.off"] + (["--inner", "inner.off"] if has_inner else [])
    subprocess.run([prohull, "cage", path, *hulls, "--strict", "-q", *options], cwd=work, check=True)
    subprocess.run([prohull, "build", path, "--repair", "none", "--faces", "1e9", "-o", "mesh.off", "-q"], cwd=work,
                   check=True)
    mesh = read_off(work / "mesh.off")
    check(read_off(work / "outer.off"), mesh, work, f"{name}, outer hull to mesh {' '.join(options)}")
    if has_inner:
        check(mesh, read_off(work / "inner.off"), work, f"{name}, mesh to inner hull {' '.join(options)}")


def main():
    prohull, files = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2:]
    if not shutil.which("tetgen"):
        print("skipped: tetgen is not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        for path in files:
            check_cage(prohull, pathlib.Path(path).resolve(), pathlib.Path(path).name, False, work, "--even")
        if files:
            return 0
        for name in ("sphere", "torus", "knot", "asteroid", "box", "bracket", "pony", "gyroid"):
            subprocess.run([prohull, "sample", name, "--faces", "500", "-o", "sample.ply", "-q"], cwd=work, check=True)
            has_inner = name != "gyroid"  # its walls are too thin for so few faces
            for options in (["--faces", "200"], ["--faces", "200", "--even"]):
                if has_inner or "--even" not in options:
                    check_cage(prohull, "sample.ply", name, has_inner, work, *options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
