#!/usr/bin/python3
"""Draws cells of the positions of two joints: joint_slice.py IN.csv OUT.svg OUT.png"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection
from matplotlib.patches import Patch

COLOURS = {"free": "#9cc3ea", "meets": "#d98b5f", "open": "#333333"}
LABELS = {"free": "proven free, in all of the cell", "meets": "two links meet, in the middle of the cell",
          "open": "open: too close to tell in so small a cell"}

source, svg, png = sys.argv[1:]
with open(source, newline="") as file:
    names, *rows = csv.reader(file)
cells = [([float(value) for value in row[:4]], row[4]) for row in rows]

plt.rcParams["svg.hashsalt"] = "joint_slice"
figure, axes = plt.subplots(figsize=(7, 5.2))
for finding, colour in COLOURS.items():
    corners = [[(a, c), (b, c), (b, d), (a, d)] for (a, b, c, d), found in cells if found == finding]
    edge, width = ("white", 0.3) if finding == "free" else (colour, 0.1)
    axes.add_collection(PolyCollection(corners, facecolors=colour, edgecolors=edge, linewidths=width))
axes.autoscale()
axes.margins(0)
axes.set_xlabel(names[0].removesuffix("_lower") + " (radians)")
axes.set_ylabel(names[2].removesuffix("_lower") + " (radians)")
axes.legend(handles=[Patch(color=COLOURS[f], label=LABELS[f]) for f in COLOURS], loc="upper center",
            bbox_to_anchor=(0.5, -0.12), frameon=False)
figure.tight_layout()
figure.savefig(svg, metadata={"Date": None})
figure.savefig(png, dpi=120, metadata={"Software": None})
