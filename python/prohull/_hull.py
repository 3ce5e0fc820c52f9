"""Hulls: meshes that know what they enclose, and how that was proven."""

import math
import os
from typing import TYPE_CHECKING, Any, Optional

from . import _arrays, _prohull
from ._meshes import Mesh
from ._prohull import InputError
from ._types import Axis, OpenShells, Path, Proof, Side, Source

if TYPE_CHECKING:
    from ._verify import Verification
    from ._view import Part


def _why_no_proof(certified: bool) -> str:
    """Of a level."""
    if not certified:
        return "the hull that this is a level of is not certified"
    return ("this level leaves faces of the original uncovered: where it folds over itself, levels that are finer than the "
            "hull may")


class Hull(Mesh):
    """A mesh that encloses another mesh, or is enclosed by it. build() and load() make hulls; they may be pickled.

    Everything that a Mesh does, a hull does too: rays, segments, points, pictures.
    """

    certified: bool  #: whether it is proven, exactly, by code that shares nothing with the construction
    proof: Proof  #: how it was proven: "replay", "enclosure", "coverage" or "padding" (docs/repair.md); empty if not
    gap: float  #: least distance from the triangles of the mesh, proven, if build() was asked for a gap; else 0
    side: Side  #: "outer" if the hull encloses its original, "inner" if it is enclosed by it
    target_faces: int  #: number of faces that was asked for; of a loaded hull its own
    target_reached: bool  #: whether the hull has at most target_faces faces, or none with fewer was found to keep the bounds
    within_bounds: bool  #: whether max_distance and max_void_percent hold
    refusals: dict[str, int]  #: how often collapses were refused during the construction, by reason
    blocked: dict[str, int]  #: how many of the edges that are left cannot be collapsed, by reason
    relaxed_guards: int  #: number of steps, 0 to 4, by which the guards of the shape were relaxed in the end
    rounded_vertices: int  #: number of vertices that were moved to coordinates that float32 keeps
    source: Source  #: what the hull was built from: "mesh", the repaired mesh; "convex-hull"; or "wrap" (docs/repair.md)
    wrap_spacing: float  #: spacing of the grid of the wrap that it was built from, in the mesh's unit; 0 for other sources
    repairs: list[str]  #: what was done to the mesh before the hull was built
    notes: list[str]  #: what is not as it was asked for, and what is worth a look
    build_seconds: float
    verify_seconds: float

    _levels: Optional[_prohull.Levels]
    _given: _prohull.Mesh  # the finite triangles that the proof is about
    _original: Mesh
    _covered: Optional[_prohull.Mesh] = None  # triangles that the hull has to cover beside enclosing its original
    _measured: _prohull.Mesh  # that distance_bound is about
    _bounds: tuple[Any, ...] = ()  # mesh and volume that they are about, max_distance, max_void_ratio
    _gap_asked: float = 0.0
    _mirror: Optional[Axis] = None  # that build() was asked for
    _volume_inside: Optional[float] = None  # that void is measured against; None: that of the original
    _open_shells: OpenShells = "keep"
    _replay_suffices: bool  # whether a level that encloses the solid of the original covers every triangle of it
    _distance: Optional[float] = None  # computed when it is asked for, and so are the next
    _self_intersections: Optional[int] = None
    _verdict: "Optional[Verification]" = None

    @classmethod
    def _made(cls, facts: dict[str, Any], side: Side) -> "Hull":
        original = Mesh._of(facts.pop("original"), facts["_levels"] if facts["source"] == "mesh" else None)
        return cls._with(facts.pop("mesh"), side=side, _original=original, **facts)

    def _as(self, core: _prohull.Mesh, **changes: Any) -> "Hull":
        """Another mesh with the facts of this hull, but for `changes`."""
        computed = ("_core", "_query_levels", "_is_closed", "_indices", "_solid_volume", "_distance", "_self_intersections",
                    "_verdict")
        facts = {name: value for name, value in self.__dict__.items() if name not in computed}
        return Hull._with(core, **{**facts, **changes})

    @property
    def original(self) -> Mesh:
        """What the hull encloses: the mesh after repairs, or all of its finite triangles if it is not closed then.

        If the hull was built from it and has levels, its queries also take the engines that go through the hull,
        "refinement" and "paper-refinement".
        """
        return self._original

    @property
    def levels(self) -> range:
        """The numbers of faces that level() has, from the hull to the original. Empty if the hull has no levels.

        A hull that was built with levels=True has levels. A tight hull has none, nor has one with a gap. Others have
        none if their vertices were moved after the last collapse, as of a wrap or a convex solid, where a hull was
        lifted over folds, and where there was much void.
        """
        if self._levels is None:
            return range(0)
        return range(self._levels.base_face_count, self._levels.original_face_count + 1, 2)

    def level(self, faces: int) -> "Hull":
        """The finest level of at most `faces` faces; the coarsest one if that has more.

        Of a hull that was built with `mirror`, it is the finest symmetric one. A hull that was loaded knows it by load(mirror=...).
        Each level encloses the solid of the next finer one (inner hulls: is enclosed by it). Where the original folds
        over itself, as with openings or overlapping parts, a level may leave some of its faces uncovered: then
        `certified` is false, and `notes` say why. A level is a hull without levels of its own. Raises InputError if the
        hull has no levels.
        """
        levels, faces = self._with_levels(), _arrays.count("faces", faces, bits=63)
        level = levels.level(levels.symmetric_faces(self._mirror, faces) if self._mirror else faces)
        proof = ("" if not self.certified else
                 "replay" if self._replay_suffices and self._covered is None else self._proof_of(level))
        return self._as(level, certified=bool(proof), proof=proof, target_faces=faces,
                        target_reached=len(level.faces) <= faces, within_bounds=self._is_within_bounds(level),
                        rounded_vertices=0, refusals={}, blocked={}, relaxed_guards=0, notes=[] if proof else [_why_no_proof(self.certified)], _levels=None)

    def with_float32_coordinates(self) -> "Hull":
        """The hull with coordinates that float32 keeps, as STL and GLB files do: itself if it has such already.

        Vertices move outwards (of inner hulls: inwards) by about a ten-millionth of their distance from the origin. The
        result is certified anew, on the coordinates that it then has: see its `certified` and `within_bounds`.
        """
        rounded, moved = _prohull.with_float32_coordinates(self._core, self.side)
        if moved == 0:
            return self
        proof = self._proof_of(rounded) if self.certified else ""
        gap = self.gap and self._least_distance(rounded)
        if self._gap_asked > 0:
            proof = "padding" if proof and gap >= self._gap_asked else ""
        return self._as(rounded, certified=bool(proof), proof=proof, gap=gap, rounded_vertices=moved,
                        target_reached=self.target_reached, within_bounds=self._is_within_bounds(rounded))

    def save(self, path: Path) -> None:
        """Writes the hull to a .ply, .obj, .off, .stl or .glb file, or all levels to a .phull file (docs/phull.md).

        The file is written whole or not at all. STL and GLB files keep float32 coordinates only: what is written there
        is with_float32_coordinates(), certified anew.

        Raises InputError for another suffix, for .phull if there are no levels, and if a certified hull that is rounded
        for STL or GLB is not certified, or not within its bounds, any more; the message says what to do.
        """
        path = _arrays.path(path)
        if path.lower().endswith(".phull"):
            self._with_levels().save(path)
        elif _prohull.stores_float32(path):
            self._rounded_for(path)._core.write(path)
        else:
            self._core.write(path)

    def _rounded_for(self, path: Path) -> "Hull":
        rounded = self.with_float32_coordinates()
        lost = ("does not provably enclose its original" if self.certified and not rounded.certified else
                "is not within its bounds" if self.within_bounds and not rounded.within_bounds else
                "is not symmetric" if self._mirror and not rounded._core.is_symmetric(self._mirror) else "")
        if lost:
            raise InputError(f"{os.fspath(path)}: the file keeps float32 coordinates, and rounded to them the hull {lost} "
                             "any more; build it with float32_coordinates=True, or save it as .ply, .obj or .off")
        return rounded

    def _proof_of(self, core: _prohull.Mesh) -> Proof:
        """How `core` is proven in place of this hull."""
        return _prohull.proof_of(core, self._given, self._original._core, self._covered, self.side)

    def _least_distance(self, core: _prohull.Mesh) -> float:
        """That of the surface of `core` from what it covers: proven."""
        parts = [mesh for mesh in (self._given, self._covered) if mesh is not None]
        return min(_prohull.surface_distance(core, mesh) for mesh in parts)

    def _is_within_bounds(self, core: _prohull.Mesh) -> bool:
        return not self._bounds or _prohull.is_within(core, *self._bounds)

    def _with_levels(self) -> _prohull.Levels:
        if self._levels is None:
            raise InputError("the hull has no levels; build with levels=True, and with neither tight nor a gap")
        return self._levels

    @property
    def verdict(self) -> "Verification":
        """What verify() says of the hull and the mesh as it was given, without triangles that are not finite: what is
        proven, against what, and if it is not, why not. Openings count as closed if build() closed them.

        Of a hull that was loaded, the mesh is the finest level. Decided when it is first asked for, by comparing meshes:
        its `proof` is never "replay". Distances are not measured; distance_bound is.
        """
        from . import _verify

        if self._verdict is None:
            self._verdict = _verify.verify(self, Mesh._of(self._given), gap=self._gap_asked, open_shells=self._open_shells)
        return self._verdict

    @property
    def void_ratio(self) -> float:
        """The void, as a share of the volume of the mesh: volume of the hull / volume of the mesh - 1. Parts that overlap
        count once.

        Negative for inner hulls. Where the volume of the mesh is only estimated, `notes` says so. nan if nothing is known
        of it, as of a mesh that encloses no space.
        """
        inside = self._original._volume_of_solid() if self._volume_inside is None else self._volume_inside
        return self._volume_of_solid() / inside - 1 if inside else math.nan

    @property
    def distance_bound(self) -> float:
        """No point of its surface is farther than this from the finite triangles of the mesh and from what closes its
        openings, in the mesh's unit: proven. Of a hull that was loaded, the mesh is the finest level.

        At most 1 % more than the true distance, or than max_distance if that was kept, unless finding it takes too long. Computed when it is first asked for.
        """
        if self._distance is None:
            decides = self._bounds[2] if self._bounds else 0  # so that it is no more than a bound that is kept
            self._distance = _prohull.distance(self._core, self._measured, 0.01, decides, None)[1]
        return self._distance

    @property
    def self_intersections(self) -> int:
        """The number of pairs of faces that meet beyond the corners and edges that they share; exact."""
        if self._self_intersections is None:
            self._self_intersections = _prohull.count_self_intersections(self._core)
        return self._self_intersections

    def __repr__(self) -> str:
        void = "" if math.isnan(self.void_ratio) else f"void {100 * self.void_ratio:.3g} %, "
        notes = f", {_arrays.counted(len(self.notes), 'note')}" if self.notes else ""
        return (f"<prohull.Hull: {self.side}, {_arrays.counted(len(self.faces), 'face')}, {void}"
                f"{f'certified by {self.proof}' if self.certified else 'NOT CERTIFIED'}{notes}>")

    @property
    def _is_own_original(self) -> bool:
        """Whether the finest level is all that it is compared with."""
        return self._levels is not None and self.source == "mesh" and self._covered is None

    def _view_parts(self) -> "list[Part]":
        from . import _view

        name = f"{self.side} hull"
        if self._levels is None:
            return _view.mesh_parts(self, name, self.side)
        return [_view.levels_part(name, self._levels, self._picture)]

    def _picture(self, width: int, height: int) -> bytes:
        around, inside = (self, self._original) if self.side == "outer" else (self._original, self)
        return _prohull.picture(around._core, inside._core, width, height)
