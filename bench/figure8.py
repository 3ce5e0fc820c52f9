#!/usr/bin/python3
"""Draws P&T Figure 8, times for segments by size of the base mesh: figure8.py IN.csv OUT.svg OUT.png"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

source, svg, png = sys.argv[1:]
curves = {}
with open(source, newline="") as file:
    for row in csv.DictReader(file):
        if row["mesh"] == "bundled_pony":  # there for scripts/records
            continue
        points = curves.setdefault(f"{row['mesh'].split('_')[0]} ({int(row['faces']):,} faces)", {})
        points[int(row["base_faces"])] = float(row["seconds_per_10000"])

plt.rcParams["svg.hashsalt"] = "figure8"
figure, axes = plt.subplots(figsize=(7, 4.5))
for name, points in curves.items():
    axes.plot(list(points), list(points.values()), marker="o", label=name)
axes.set_xlabel("faces of the base mesh")
axes.set_ylabel("seconds for 10,000 segments")
axes.set_xlim(left=0)
axes.set_ylim(bottom=0)
axes.grid(alpha=0.3)
axes.legend()
figure.tight_layout()
figure.savefig(svg, metadata={"Date": None})
figure.savefig(png, dpi=120, metadata={"Software": None})
