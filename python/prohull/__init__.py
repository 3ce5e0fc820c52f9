"""Coarse meshes that provably enclose a mesh, or are enclosed by it.

    >>> import prohull
    >>> hull = prohull.build(prohull.sample("pony", 5000), 500)
    >>> hull.certified, len(hull.faces)
    (True, 500)

A mesh is given as the path of a file, as vertices and faces, or as a mesh of prohull, trimesh or Open3D. Lengths are in
the unit of the mesh, angles in degrees. What is wrong with an argument or a file is raised as InputError, a ValueError;
a file that is not there is a FileNotFoundError, too.
Ctrl-C stops long work (build, cage, convex_pieces, repair, spheres, sweep, verify, distance_bounds, queries, read, view) with
KeyboardInterrupt.
Files appear whole or not at all.
"""

import os as _os
from pathlib import Path as _Path

from . import _prohull
from ._build import build
from ._cage import Cage, CageHull, cage
from ._collide import Collider, Distances, FacePairs
from ._covers import (Ball, Capsule, ConvexCover, ConvexPiece, OrientedBox, SphereCover, UnionVerification, convex_pieces,
                      spheres, verify_union)
from ._files import load, read, sample
from ._hull import Hull
from ._meshes import AllHits, ClosestPoints, FacesMet, FirstHits, Mesh, Refinement, TwoHulls
from ._prohull import InputError
from ._repair import Solid, repair
from ._sweep import Sweep, sweep
from ._verify import NearFace, Offender, Verdict, Verification, distance_bounds, verify
from ._view import View, view

__all__ = ["AllHits", "Ball", "Cage", "CageHull", "Capsule", "ClosestPoints", "Collider", "ConvexCover",
           "ConvexPiece", "Distances", "ENGINES", "FacePairs", "FacesMet", "FirstHits", "Hull", "InputError",
           "Mesh", "NearFace", "Offender", "OrientedBox", "Refinement", "Solid", "SphereCover", "Sweep", "TwoHulls", "UnionVerification",
           "Verdict", "Verification", "View", "build", "cage", "convex_pieces", "distance_bounds", "load", "read", "repair", "sample",
           "spheres", "sweep", "verify", "verify_union", "view"]

#: Names of the engines of queries.
ENGINES: tuple[str, ...] = _prohull.engines

__version__: str = _prohull.version

InputError.__module__ = __name__

# The program that reads COLLADA, 3MF and FBX, if this package was installed with it.
_importer = _Path(__file__).with_name("prohull-import")
if _importer.exists():
    _os.environ.setdefault("PROHULL_IMPORTER", str(_importer))
