#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/four_boxes.h"
#include "prohull/triangle_mesh.h"
#include "verify/greatest_distance.h"

namespace prohull::verify {

/// Throws InputError if the mesh is empty or not finite.
void require_distances(const TriangleMesh& mesh);

/// Of the corners of faces, by absolute value; 0 without faces.
double largest_coordinate(const TriangleMesh& mesh);

/// A power of two. Times this, products of four coordinates neither overflow nor underflow, but for coordinates that
/// are less than rounding; it is 1 unless the largest coordinate is very large or very small, or not finite.
double usable_unit(double largest_coordinate);

TriangleMesh scaled(TriangleMesh mesh, double unit);

/// Bounds that were found times `unit`.
DistanceBounds unscaled(const DistanceBounds& bounds, double unit);

/// How far bounds are off that were found in usable units: a closest point is computed from differences, within 16 eps
/// of the largest coordinate for each of its own (a sum of three with factors in [0, 1]), and its distance to p adds as
/// much again. Each cut of a part at a rounded point, a (1 - f) + b f, adds at most 3 sqrt(3) eps: so many of them, one
/// within the other, have room, with 507.5 of 512.
constexpr std::uint8_t kMostCuts = 87;
inline double rounding_of_distances(double largest_coordinate) { return 512 * 0x1p-53 * largest_coordinate; }

/// Of the faces of a mesh, which must outlive it. Distances are rounded.
class NearestFace {
 public:
  struct Found {
    std::uint32_t face;
    double distance;
  };

  explicit NearestFace(const TriangleMesh& mesh);

  double distance(const Vec3& p, std::uint32_t face) const;
  /// Proven: no face is nearer to p. Coordinates are within 1e100.
  double at_least(const Vec3& p) const;
  static constexpr Found kNone{0, std::numeric_limits<double>::infinity()};
  /// `known`, or one that is nearer. Adds how many faces it looked at.
  Found nearest(const Vec3& p, Found known, std::size_t& looked_at) const;
  Found nearest(const Vec3& p, std::uint32_t guess) const {
    std::size_t looked_at = 0;
    return nearest(p, {guess, distance(p, guess)}, looked_at);
  }

 private:
  /// measure(f) of all faces that may be nearer to p than `best`, which is the least of all that it has returned.
  template <class Measure>
  void visit_near(const Vec3& p, double best, Measure measure) const;

  const TriangleMesh& mesh_;
  UnitCube cube_;
  std::vector<std::uint32_t> face_at_;  ///< along a Morton curve
  FourWideTree levels_;                 ///< over the faces in this order
};

/// The bounds as they hold where distances, and the points of parts, are off by `rounding`.
DistanceBounds proven(const DistanceBounds& found, const NearestFace& faces, double rounding);

/// Parts of faces, and how far all of their points are from a mesh. The distance to a triangle is a convex function: no
/// point of a part is farther from it than the farthest corner. So is a mean of such distances, which no nearest face
/// is above.
class FarFromFaces {
 public:
  struct Part {
    std::array<Vec3, 3> corners;
    std::array<std::uint32_t, 3> faces;              ///< near each corner
    std::array<std::array<double, 3>, 3> distances;  ///< [i][j]: of corner i from face j
    std::uint8_t cuts;                               ///< that led to it; at most kMostCuts
  };
  using Search = GreatestDistance<FarFromFaces>;

  explicit FarFromFaces(const NearestFace& faces) : faces_(faces) {}

  void add(const Triangle& t, const std::array<NearestFace::Found, 3>& nearest, Search& search) const;
  /// In two. Which face is nearest to where a side is cut is asked only if the faces of the part leave one of them
  /// open.
  void cut(const Part& part, Search& search) const;

  /// The face nearest to a point, none that is not nearer than `known`. The search is told of the point.
  NearestFace::Found look_at(const Vec3& p, Search& search, const NearestFace::Found& known) const;

 private:
  const NearestFace& faces_;
};

}  // namespace prohull::verify
