#!/usr/bin/python3
"""What numpy writes is read, and what prohull writes is read by numpy: numpy_test.py PROHULL. Skipped without numpy."""
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
from seed import REPLAY, SEED  # noqa: E402

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)

prohull = sys.argv[1]
work = tempfile.TemporaryDirectory()
os.chdir(work.name)
checks = 0


def query(*arguments):
    done = subprocess.run([prohull, "query", "cube.obj", *arguments], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stderr)


def hits_of(name):
    query("--segments", name, "-o", "hits.npz", "--mode", "all")
    return np.load("hits.npz")


def check(condition, what):
    global checks
    checks += 1
    assert condition, what


subprocess.run([prohull, "sample", "box", "-o", "cube.obj", "--faces", "200"], check=True, capture_output=True)
print(REPLAY)
random = np.random.default_rng(SEED)
segments = random.integers(-3, 4, (500, 6))
segments[:, 0], segments[:, 3] = 2, -2  # across the box
np.savetxt("segments.csv", segments, delimiter=",", header="x0,y0,z0,x1,y1,z1")
expected = hits_of("segments.csv")
check(len(expected["t"]) > 20, "enough segments hit")
check(expected.files == ["segment", "t", "face", "x", "y", "z", "entering"], expected.files)

arrays = {
    f"{order}{kind}{layout}{len(shape)}": np.array(segments.reshape(shape), dtype=order + kind, order=layout)
    for order in "<>"
    for kind in ("f4", "f8", "i2", "i4", "i8")
    for layout in "CF"
    for shape in ((500, 6), (500, 2, 3))
}
arrays["i1"] = segments.astype("i1")
for name, array in arrays.items():
    np.save("s.npy", array)
    np.savez("s.npz", array)
    np.savez_compressed("several.npz", rays=array[:3], segments=array)
    for file in ("s.npy", "s.npz", "several.npz"):
        hits = hits_of(file)
        check(all(np.array_equal(hits[key], expected[key]) for key in expected.files), (name, file))

query("--segments", "s.npy", "-o", "hits.csv", "--mode", "all")
table = np.genfromtxt("hits.csv", delimiter=",", names=True)
check(all(np.array_equal(table[key], expected[key].astype("f8")) for key in expected.files), "csv holds the same")
check(expected["entering"].dtype == bool and expected["face"].dtype == np.int64, "types")
a, b = segments[expected["segment"], :3], segments[expected["segment"], 3:]
points = np.stack([expected[axis] for axis in "xyz"], axis=1)
check(np.allclose(points, a + (b - a) * expected["t"][:, None]), "positions lie on the segments")

query("--random", "100", "--write-segments", "random.npy")
check(np.load("random.npy").shape == (100, 6), "written segments")
np.save("triangles.npy", random.uniform(-1, 1, (50, 3, 3)))
query("--triangles", "triangles.npy", "-o", "faces.npz")
check(np.load("faces.npz").files == ["triangle", "face"], "faces met")
print(f"{checks} passed, 0 failed")
