#pragma once

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct WrapOptions {
  double spacing = 0;  ///< of the grid that it is made on, in the input's unit; greater than 0
  /// How far the wrap is from flat parts, in spacings; at least 0.3. From 0.9 on, sheets have smooth wraps.
  double offset = 0.3;
  /// Farther from the triangles by this, in the input's unit; `offset` and padding / spacing are at most 2.7 together.
  double padding = 0;
  double seal_holes = 0;    ///< openings up to this diameter are closed, in the input's unit
  bool seal_rooms = false;  ///< close the doors of rooms, see wrap()
  double closing = 0;       ///< fill hollows and gaps that a ball of this radius cannot enter; in the input's unit
  /// In spacings. Where the surface is flat but for this, it has fewer faces: on cells of up to 8 spacings.
  double flatness = 0;
  Progress progress = {};  ///< stage "wrap"
};

struct Wrap {
  TriangleMesh mesh;  ///< a closed 2-manifold, oriented outwards, free of self-intersection
  /// Faces across the openings that were closed. A hull has to cover them as well, or it could enter there.
  TriangleMesh doors;
  double largest_door = 0;  ///< the greatest width of a door of a room that was closed, in the input's unit
  /// Of what lies inside of the triangles, estimated by the nodes there; 0 if nothing is thicker than two spacings.
  double inside_volume = 0;
};

/// A *wrap* of any finite triangles: the boundary of all that cannot be reached from outside without passing through
/// them, about a third of `spacing` away from them, of sheets about half and in places 1.3 times. So parts that overlap
/// become one, and what is hidden inside vanishes. Openings narrower than about twice `spacing` are closed in any case.
/// The time is linear in the number of triangles and in (diagonal / spacing)^3, the number of faces in (diagonal /
/// spacing)^2.
///
/// A *room* is a hollow that is wider than its widest entrance, its *door*: a ball fits into it that is half as large
/// again as the largest one that passes the door.
///
/// Guaranteed: nothing of the enclosure. Nobody has to trust a wrap: verify_cover decides whether it covers the
/// triangles. Throws InputError if the mesh has no faces or is not finite, if the grid would have more than 2^28 nodes,
/// or if the numbers at the coordinates of the mesh are coarser than its spacing (NonFiniteCoordinate); Cancelled.
Wrap wrap(const TriangleMesh& triangles, const WrapOptions& options);

/// Wrap::inside_volume alone.
double inside_volume(const TriangleMesh& triangles, const WrapOptions& options);

/// The boundary of what lies inside of a wrap, about a third of `spacing` away from the triangles on its boundary: they
/// are outside of it. `padding` moves it further inwards. No faces if nothing is thick enough.
TriangleMesh inner_wrap(const TriangleMesh& triangles, const WrapOptions& options);

}  // namespace prohull
