#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "prohull/geometry.h"
#include "prohull/mesh_query.h"
#include "prohull/triangle_mesh.h"
#include "verify/solid_volume.h"

namespace prohull::cover {

/// All points p with dot(normal, p) = offset.
struct Plane {
  Vec3 normal;  ///< of length 1
  double offset = 0;

  double height(const Vec3& p) const { return dot(normal, p) - offset; }
};

/// Where a segment crosses a plane that its ends have these heights over.
inline Vec3 crossing(const Vec3& p, const Vec3& q, double height_p, double height_q) {
  return p + (q - p) * (height_p / (height_p - height_q));
}

/// The surface of a solid, and what is inside of it.
class Solid {
 public:
  /// What lies in `closed` is to be covered, too; it may have no faces.
  Solid(const TriangleMesh& faces, const TriangleMesh& closed, double tolerance);
  /// Corners within `tolerance` of a plane count as on it, relative to the diagonal of the box.
  void set_tolerance(double tolerance) { tolerance_ = tolerance * box_.diagonal(); }

  const TriangleMesh& surface() const { return surface_; }
  const Box& box() const { return box_; }
  double tolerance() const { return tolerance_; }  ///< as a length
  bool has_inside() const { return index_.face_count() > 0; }
  /// Points within the tolerance of the solid count as in it: an edge of a cell may run along the surface.
  bool contains(const Vec3& p) const;

 private:
  TriangleMesh surface_;
  Box box_;
  double tolerance_;
  QueryIndex index_;
};

/// A convex part of space between cutting planes.
struct Cell {
  std::vector<Plane> planes;   ///< their normals look out of the cell
  std::vector<Segment> edges;  ///< where two planes meet, as far as the box of the solid reaches
};

/// What a convex piece has to cover: the part of a solid within a cell. The convex hull of it is that of the corners of
/// the surface within the cell, and of those corners of the cell that lie in the solid.
struct Part {
  std::vector<Vec3> points;                  ///< of the surface
  std::vector<std::uint32_t> corners, ends;  ///< polygon i has the corners [ends[i - 1], ends[i])
  std::vector<Vec3> inside;                  ///< corners of the cell in the solid
  Cell cell;

  bool empty() const { return points.empty(); }
  std::size_t polygon_count() const { return ends.size(); }
  std::span<const std::uint32_t> polygon(std::size_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : ends[i - 1];
    return {corners.data() + begin, corners.data() + ends[i]};
  }
};

Part whole(const Solid& solid);

/// Of what the cell has of the solid within the boundary, rounded.
double volume_within(const Cell& cell, std::span<const verify::BoundaryPiece> boundary);

/// The part below the plane, and the part above it. A corner on the plane belongs to the polygons on either side that
/// have it; a polygon in the plane to the side where the solid is.
std::pair<Part, Part> cut(const Part& part, const Plane& plane, const Solid& solid);

/// Where the plane meets edges of the part's cell in the solid.
std::vector<Vec3> new_corners(const Part& part, const Plane& plane, const Solid& solid);

/// All points that its convex hull is that of.
std::vector<Vec3> hull_points(const Part& part);

/// Of the convex hull.
double hull_volume(const Part& part);

/// Of its surface.
Box box_of(const Part& part);

/// The normal of a polygon of the part, as long as twice its area.
Vec3 area_vector(const Part& part, std::span<const std::uint32_t> polygon);

/// Each edge of the polygons once.
std::vector<std::array<std::uint32_t, 2>> edges(const Part& part);

}  // namespace prohull::cover
