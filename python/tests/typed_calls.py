"""Calls that `mypy --strict` accepts, and calls that it refuses: the lines that end in "# refused". See test_typing.py."""

from typing import Any, Optional

import numpy as np
import prohull
import prohull.robot
from numpy.typing import NDArray

v, f = np.zeros((8, 3)), np.zeros((12, 3), dtype=np.int64)
mesh = prohull.Mesh(v, f)

one: prohull.Hull = prohull.build("part.stl", 500)
one = prohull.build("part.stl", target_faces=500, tight=True, side="inner")
one = prohull.build(v, f, 500)
one = prohull.build(mesh="part.stl", target_faces=500)
one = prohull.build(v, faces=f)
one = prohull.build(v.tolist(), [[0, 1, 2]], target_faces=500)
one = prohull.build((v, f), 500, self_intersections="allowed", max_void_percent=3, repair="wrap", strategy="paper1")
one = prohull.build(mesh)
one = prohull.build(mesh, open_shells="keep", max_overhang=0.2)
one = prohull.build(one.original, 100, progress=lambda stage, fraction: stage != "verify")
several: list[prohull.Hull] = prohull.build("part.stl", [1000, 500])
several = prohull.build(v, f, target_faces=(1000, 500), best_of=3)

prohull.build("part.stl", "500")  # refused
prohull.build(500, "part.stl")  # refused
prohull.build(500)  # refused
prohull.build("part.stl", 500.5)  # refused
prohull.build(v, 500)  # refused
prohull.build(mesh, f, 500)  # refused
prohull.build("part.stl", 500, "outer")  # refused
prohull.build("part.stl", faces_target=500)  # refused
prohull.build("part.stl", 500, side="outter")  # refused
prohull.build("part.stl", 500, repair="magic")  # refused
prohull.build("part.stl", 500, open_shells="shut")  # refused
prohull.build("part.stl", 500, strategy="fast")  # refused
prohull.build("part.stl", 500, self_intersections=True)  # refused
prohull.build("part.stl", 500, max_distance=[1])  # refused
prohull.build("part.stl", 500, best_of=2.5)  # refused
prohull.build("part.stl", 500, tigth=True)  # refused
prohull.build(v, f, 500, sied="inner")  # refused
prohull.build("part.stl", 500, progress=lambda stage: True)  # refused
several = prohull.build("part.stl", 500)  # refused
one = prohull.build("part.stl", [500])  # refused

hits: prohull.FirstHits = mesh.first_hit([0, 0, 9], [0, 0, -1], engine="bvh")
hits = one.original.first_hit(v, -v, engine=prohull.Refinement(coarsen=True), threads=2)
hits = one.original.first_hit(v, -v, engine=prohull.TwoHulls(one, "walk"))
inside: bool = mesh.contains([0, 0, 0])
each: NDArray[np.bool_] = mesh.contains([[0, 0, 0], [1, 1, 1]], progress=lambda stage, fraction: None)
closest: prohull.ClosestPoints = mesh.closest([[0, 0, 0]], max_distance=2)
closest = mesh.closest([0, 0, 0])
away: NDArray[np.float64] = mesh.signed_distance(v, threads=1).distance
facts: dict[str, Any] = mesh.report()
level: prohull.Hull = one.level(1000)
level.save("level.stl")
reason: str = one.proof if prohull.verify(one, "part.stl", side="outer") else one.notes[0]

mesh.first_hit([0, 0, 9], [0, 0, -1], engine="magic")  # refused
mesh.any_hit(segments=v, threads="all")  # refused
each = mesh.contains([0, 0, 0])  # refused
away = mesh.signed_distance(v)  # refused
prohull.verify(one, "part.stl", side="out")  # refused
one.reached  # refused

pieces: prohull.ConvexCover = prohull.convex_pieces("part.stl", 8, vertices=32, max_void_percent=10, shape="box")
pieces = prohull.convex_pieces((v, f), max_distance=0.01, progress=lambda stage, fraction: None)
corners: NDArray[np.float64] = pieces.pieces[0].vertices
balls: prohull.SphereCover = prohull.spheres(mesh, 32, max_distance=0.1, fill=True, threads=1)
balls.save("part.yaml", link="forearm")
covers: bool = prohull.verify_union(pieces, "part.stl").certified
covers = bool(prohull.verify_union(["a.stl", "b.stl"], mesh, solid_only=True))
covers = bool(prohull.verify_union([(v, f)], mesh))
covers = prohull.verify_union(balls.balls, mesh, inside=True).certified

made: prohull.Cage = prohull.cage("part.stl", 400, inner_faces=200, gap=0.01, even=True)
corners = made.outer.vertices

prohull.cage("part.stl", gap=[1])  # refused
prohull.convex_pieces("part.stl", "8")  # refused
prohull.convex_pieces("part.stl", 8, shape="egg")  # refused
prohull.convex_pieces("part.stl", 8, 64)  # refused
prohull.spheres("part.stl", fill="yes")  # refused
prohull.verify_union(3, "part.stl")  # refused

page: Optional[str] = one.show(progress=lambda stage, fraction: None).html
page = prohull.view(one, "part.stl", (v, f), pieces, balls, made, [mesh, "piece.stl"], original=mesh, path="view.html").html
page = prohull.view(pieces.pieces, original="part.stl").html
page = prohull.view(prohull.robot.Robot.load("arm.urdf"), unit="m", threads=1).html
checked = prohull.robot.Robot.load("arm.urdf").check_path([[0.0]], ["joint1"], times=[0.0], gap=0.01, distances=True)
print(checked.verdict, checked.pairs[0].positions["joint1"], checked.distances.min())
drawn: bytes = pieces.show().picture

prohull.view(3)  # refused
prohull.view(one, side="up")  # refused
one.show("view.html")  # refused
