#!/usr/bin/python3
"""What batches of queries cost from Python, over the same call in C++: python_batch.py [--segments N] [--out FOLDER]

Both are asked by one process, one after the other in each round, for segments as in P&T 4.2; a ratio is the median of
those of the rounds. Needs the build's folder python/ in PYTHONPATH. Ends with 1 if a median is above --limit.
"""

import argparse
import csv
import functools
import pathlib
import statistics
import sys
import tempfile
import time

import numpy as np
import prohull
import prohull_cpp_batch

COLUMNS = ("mesh", "faces", "engine", "query", "threads", "segments", "hits", "cpp_ms", "python_ms", "ratio")


def random_segments(mesh, count, seed):
    """From one side of a box twice as large as the mesh's to another: (count, 6)."""
    random = np.random.default_rng(seed)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    start = random.integers(6, size=count)
    sides = np.stack([start, (start + random.integers(1, 6, size=count)) % 6], axis=1)
    points = random.uniform(-1, 1, size=(count, 2, 3))
    np.put_along_axis(points, sides[..., None] // 2, sides[..., None] % 2 * 2.0 - 1, axis=2)
    return ((low + high) / 2 + points * (high - low)).reshape(count, 6)


def count_hits(query, answer):
    return int(answer.sum() if query == "any_hit" else answer.hit.sum() if query == "first_hit" else len(answer.t))


def compare(ask, index, query, segments, threads, rounds):
    """Milliseconds in C++ and in Python, their ratio, and the hits; a first round, not counted, warms both up."""
    cpp, python = [], []
    for _ in range(rounds + 1):
        start = time.perf_counter()
        answer = ask(segments=segments, threads=threads)
        python.append(time.perf_counter() - start)
        seconds, hits = index.timed(segments, query, threads)
        cpp.append(seconds)
        if count_hits(query, answer) != hits:
            sys.exit(f"{query}: {count_hits(query, answer)} hits in Python, {hits} in C++")
        del answer
    if rounds == 0:
        return 0, 0, 0, hits
    cpp, python = cpp[1:], python[1:]
    ratio = statistics.median(b / a for a, b in zip(cpp, python))
    return 1e3 * statistics.median(cpp), 1e3 * statistics.median(python), ratio, hits


def subjects(options, folder):
    """Name, mesh, the file that C++ reads of it, engine, how many segments."""
    hull = prohull.build(options.mesh or prohull.sample("pony", 100000), target_faces=options.faces)
    hull.save(folder / "hull.phull")
    hull.save(folder / "hull.ply")
    yield "hull", hull, folder / "hull.ply", "bvh", options.segments
    yield "original", hull.original, folder / "hull.phull", "bvh", options.segments
    for engine in ("refinement", "paper-refinement"):  # a hundred times slower
        yield "original", hull.original, folder / "hull.phull", engine, options.segments // 100


def measure(options, folder):
    for name, mesh, path, engine, count in subjects(options, folder):
        index = prohull_cpp_batch.Index(path, engine)
        segments = random_segments(mesh, count, options.seed)
        for query in ("first_hit", "any_hit", "all_hits"):
            ask = functools.partial(getattr(mesh, query), engine=engine)
            for threads in (1, 0):
                cpp, python, ratio, hits = compare(ask, index, query, segments, threads, options.repeat)
                yield dict(zip(COLUMNS, (name, len(mesh.faces), engine, query, threads or "all", count, hits,
                                         f"{cpp:.1f}", f"{python:.1f}", f"{ratio:.3f}")))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mesh", help="path; without, the sample pony of 100,000 faces")
    parser.add_argument("--faces", type=int, default=2000, help="of the hull [%(default)s]")
    parser.add_argument("--segments", type=int, default=1_000_000,
                        help="a hundredth of them for the refinement engines [%(default)s]")
    parser.add_argument("--repeat", type=int, default=9, help="rounds; 0: only hits are counted [%(default)s]")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=float, default=float("inf"), help="of the ratios")
    parser.add_argument("--out", type=pathlib.Path, help="folder for python.csv")
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for row in measure(options, pathlib.Path(folder)):
            rows.append(row)
            print(*row.values(), flush=True)
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        with open(options.out / "python.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return int(max(float(row["ratio"]) for row in rows) > options.limit)


if __name__ == "__main__":
    sys.exit(main())
