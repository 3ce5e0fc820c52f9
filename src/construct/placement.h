#pragma once

#include <optional>

#include "construct/star.h"
#include "geometry/largest_coordinate.h"

namespace prohull {

/// Where the new vertex may go, in the star's own frame, and the volume it adds there, in the input's unit.
struct Placement {
  Vec3 local;
  double added_volume;
};

/// The point outside of all faces of the star that adds the least volume (P&T 3.1.2), by a linear program; where that
/// has no single answer (flat stars), the one nearest to the edge's midpoint. It keeps a `margin` (local units) away
/// from the planes, so that it still is outside when rounded.
std::optional<Placement> place_outside(const Star& star, double margin);

/// The plane in which the new vertex of a symmetric star has to lie.
struct StarPlane {
  int axis;                     ///< it is perpendicular to
  double coordinate;            ///< local
  std::vector<double> weights;  ///< of the faces, in the volume that is added
};

/// The same in a plane.
std::optional<Placement> place_outside(const Star& star, double margin, const StarPlane& plane);

/// The most by which storing a vertex moves a coordinate, with some room, where all are in `bounds`.
inline double storage_rounding(const Box& bounds, bool float32_coordinates) {
  return largest_coordinate(bounds) * (float32_coordinates ? 0x1p-23 : 0x1p-52);
}

/// P&T formula 3: what a collapse to the local point adds, in the input's unit; less than 0 where it removes more.
double added_volume(const Star& star, const Vec3& p);

/// What place_outside needs where storing the vertex moves its coordinates by up to `rounding` (input unit).
inline double placement_margin(const Star& star, double rounding) {
  constexpr double kOfTheProgram = 1e-10;  // the rounding errors of the linear program, local
  return kOfTheProgram + 2 * rounding / star.scale;
}

/// Exact.
bool lies_on_all_planes(const HalfEdgeMesh& mesh, const Star& star, const Vec3& p);

/// A collapse that adds less is worth the exact test of whether it adds nothing.
inline bool is_nearly_flat(const Star& star, const Placement& placement) {
  constexpr double kFlat = 1e-7;  // of the star's cube
  return placement.added_volume <= kFlat * star.scale * star.scale * star.scale;
}

/// Where an end of the edge lies on all planes of the star, as in flat parts and along straight creases, a collapse to
/// it adds nothing. Whether such an end is accepted by accepts(position, local position), asked of one after the other.
template <class Accepts>
bool any_flat_end(const HalfEdgeMesh& mesh, const Star& star, const Placement& placement, Accepts&& accepts) {
  if (!is_nearly_flat(star, placement)) return false;
  const auto is_flat_and_accepted = [&](const Vec3& end, const Vec3& local) {
    return lies_on_all_planes(mesh, star, end) && accepts(end, local);
  };
  return is_flat_and_accepted(mesh.position(star.o), star.local_o) ||
         is_flat_and_accepted(mesh.position(star.d), star.local_d);
}

/// P&T 3.1.3, second strategy: the unsigned volume between the star and the centre of its link, in the input's unit.
double link_center_volume(const Star& star);

/// What place_outside is likely to add, and hardly more, without a linear program: a multiple of the unsigned volume
/// between the star and the centre of its link, or an end of the edge, where that is less, as along creases. Requires
/// gather_star only; never NaN or infinite.
double estimated_volume(const HalfEdgeMesh& mesh, const Star& star);

/// Exact: the apex, as stored, is outside of or on the supporting plane of every face of the star.
bool is_outside(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex);
/// Exact: the point is outside of or on the supporting plane of every face around v.
bool is_outside(const HalfEdgeMesh& mesh, VertexId v, const Vec3& p);

}  // namespace prohull
