#!/usr/bin/python3
"""Draws void against faces, and below it what sticks out of those that do not enclose: peers.py IN.csv OUT.svg OUT.png"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import ScalarFormatter

source, svg, png = sys.argv[1:]
models = {}
methods = []
with open(source, newline="") as file:
    for row in csv.DictReader(file):
        if row["mesh"] == "bundled_pony":  # there for scripts/records
            continue
        rows = models.setdefault(f"{row['mesh'].split('_')[0]} ({int(row['mesh_faces']):,} faces)", [])
        if row["method"] not in methods:
            methods.append(row["method"])
        if row["void_percent"]:
            rows.append(row)

plt.rcParams["svg.hashsalt"] = "peers"
figure, panels = plt.subplots(
    2, len(models), figsize=(max(7, 1 + 4 * len(models)), 6.5), sharex="col", squeeze=False, height_ratios=[3, 2]
)
legend = {}
for (name, rows), (voids, outside) in zip(models.items(), panels.T):
    for number, method in enumerate(methods):
        mine = sorted((row for row in rows if row["method"] == method), key=lambda row: int(row["hull_faces"]))
        look = {"color": f"C{number}", "marker": "os^DvPX*"[number % 8], "markersize": 5, "linewidth": 1.3}
        enclosing = [row for row in mine if row["encloses"] == "yes"]
        if enclosing:
            (legend[method],) = voids.plot(
                [int(row["hull_faces"]) for row in enclosing],
                [float(row["void_percent"]) for row in enclosing],
                **look,
            )
        others = [row for row in mine if row["encloses"] != "yes" and row["vertices_outside"]]
        if others:
            (line,) = outside.plot(
                [int(row["hull_faces"]) for row in others],
                [100 * int(row["vertices_outside"]) / int(row["mesh_vertices"]) for row in others],
                markerfacecolor="none",
                linestyle=":",
                **look,
            )
            legend.setdefault(method, line)
    voids.set_title(name, fontsize=10)
    voids.set_xscale("log")
    voids.set_yscale("log")
    voids.yaxis.set_major_formatter(ScalarFormatter())
    outside.set_xscale("log")
    asked = sorted({int(row["asked_faces"]) for row in rows if row["asked_faces"]})
    outside.set_xticks(asked, [f"{faces:,}" for faces in asked])
    outside.minorticks_off()
    outside.set_xlabel("faces")
    outside.set_ylim(0, 100)
    for axes in (voids, outside):
        axes.grid(alpha=0.3)
panels[0][0].set_ylabel("void of those that enclose, %")
panels[1][0].set_ylabel("do not enclose:\noriginal vertices outside, %")
figure.legend(legend.values(), legend.keys(), loc="lower center", ncols=4, fontsize=9 if len(models) > 1 else 7.5)
figure.tight_layout(rect=(0, 0.09, 1, 1))
figure.savefig(svg, metadata={"Date": None})
figure.savefig(png, dpi=120, metadata={"Software": None})
