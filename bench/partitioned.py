#!/usr/bin/python3
"""A hull of a huge mesh in parts, on a cluster of this machine, beside that of one build: partitioned.py [--out FOLDER]

Once more with a worker killed in the middle, which must give the same bits. Needs the build's folder python/ in
PYTHONPATH, and dask. Ends with 1 if a hull is not certified, is another one after the kill, or has more void than
--limit times that of one build.
"""

import argparse
import csv
import os
import pathlib
import signal
import sys
import time

import dask
import distributed
import prohull
import prohull.dask

COLUMNS = ("mesh", "faces", "hull_faces", "parts", "killed_workers", "void_percent", "void_by_one_build", "certified",
           "same_bits", "elapsed_s")


class KillOneAtWork:
    """Progress that kills a worker while it has tasks, once half of the parts are there."""

    def __init__(self, client):
        self.client = client
        self.killed = 0

    def __call__(self, done, total, failed):
        busy = [address for address, tasks in self.client.processing().items() if tasks]
        if self.killed == 0 and 2 * done >= total - 1 and busy:
            self.killed = 1
            os.kill(self.client.run(os.getpid)[busy[0]], signal.SIGKILL)


def timed(build):
    start = time.perf_counter()
    return build(), time.perf_counter() - start


def measure(options, client):
    mesh = prohull.read(options.mesh) if options.mesh else prohull.sample("pony", options.mesh_faces)
    name = pathlib.Path(options.mesh).name.split(".")[0] if options.mesh else "bundled_pony"
    one, seconds = timed(lambda: prohull.build(mesh, options.faces))

    def row(hull, parts, killed, same_bits, seconds):
        return dict(zip(COLUMNS, (name, len(mesh.faces), len(hull.faces), parts, killed, f"{100 * hull.void_ratio:.4f}",
                                  f"{hull.void_ratio / one.void_ratio:.4f}", "yes" if hull.certified else "no",
                                  same_bits, f"{seconds:.1f}")))

    yield row(one, "", 0, "", seconds)
    hulls = []
    for progress in (None, KillOneAtWork(client)):
        hull, seconds = timed(lambda: prohull.dask.build_partitioned(client, mesh, options.faces, parts=options.parts,
                                                                     progress=progress))
        hulls.append((hull.vertices.tobytes(), hull.faces.tobytes()))
        yield row(hull, options.parts, progress.killed if progress else 0, "yes" if hulls[0] == hulls[-1] else "no", seconds)


def is_good(row, limit):
    if not row["parts"]:
        return True
    return row["certified"] == row["same_bits"] == "yes" and float(row["void_by_one_build"]) <= limit


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mesh", help="path; without, the sample pony")
    parser.add_argument("--mesh-faces", type=int, default=6_000_000, help="of the sample [%(default)s]")
    parser.add_argument("--faces", type=int, default=2000, help="of the hull [%(default)s]")
    parser.add_argument("--parts", type=int, default=8, help="[%(default)s]")
    parser.add_argument("--workers", type=int, default=2, help="[%(default)s]")
    parser.add_argument("--limit", type=float, default=1.02, help="of the void, by that of one build [%(default)s]")
    parser.add_argument("--out", type=pathlib.Path, help="folder for partitioned.csv")
    options = parser.parse_args()
    rows = []
    with dask.config.set({"distributed.comm.timeouts.connect": "10s"}), distributed.LocalCluster(
            n_workers=options.workers, threads_per_worker=1, processes=True, dashboard_address=None,
            silence_logs="CRITICAL") as cluster, distributed.Client(cluster) as client:
        for row in measure(options, client):
            rows.append(row)
            print(*row.values(), flush=True)
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        with open(options.out / "partitioned.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return int(not all(is_good(row, options.limit) for row in rows))


if __name__ == "__main__":
    sys.exit(main())
