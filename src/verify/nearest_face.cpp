#include "verify/nearest_face.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/closest_point.h"
#include "geometry/largest_coordinate.h"
#include "geometry/triangle_distance.h"
#include "prohull/error.h"
#include "verify/distance.h"

namespace prohull::verify {

void require_distances(const TriangleMesh& mesh) {
  if (mesh.face_count() == 0) throw InputError(Defect::EmptyMesh, "there is no distance without faces");
  for (const FaceId f : mesh.triangles.ids())
    for (const VertexId v : mesh.triangles[f])
      if (!is_finite(mesh.positions[v]))
        throw InputError(Defect::NonFiniteCoordinate, "there is no distance from coordinates that are not finite");
}

double largest_coordinate(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  return box.is_empty() ? 0 : prohull::largest_coordinate(box);
}

double usable_unit(double largest_coordinate) {
  constexpr double kLarge = 0x1p200;
  if (largest_coordinate == 0 || !std::isfinite(largest_coordinate)) return 1;
  if (1 / kLarge < largest_coordinate && largest_coordinate < kLarge) return 1;
  return std::ldexp(1.0, -std::max(std::ilogb(largest_coordinate), -1000));
}

TriangleMesh scaled(TriangleMesh mesh, double unit) {
  for (Vec3& p : mesh.positions) p = p * unit;
  return mesh;
}

DistanceBounds unscaled(const DistanceBounds& bounds, double unit) {
  if (unit == 1) return bounds;
  const double lower = bounds.lower / unit;  // exact but for those that underflow
  return {lower * unit > bounds.lower ? std::nextafter(lower, 0) : lower,
          std::nextafter(bounds.upper / unit, std::numeric_limits<double>::infinity()), bounds.farthest / unit};
}

double NearestFace::distance(const Vec3& p, std::uint32_t face) const {
  return norm(p - closest_point(p, mesh_.triangle(FaceId(face))));
}

double NearestFace::at_least(const Vec3& p) const {
  constexpr double kBelow = 1 - 0x1p-50;  // of three rounded differences, their squares, sum and root
  double least = std::numeric_limits<double>::infinity();
  tree_.least([&](const Box& box) { return kBelow * verify::distance(p, box); },
              [&](std::uint32_t f) {
                const TriangleDistance d = triangle_distance({p, p, p}, mesh_.triangle(FaceId(f)));
                least = std::min(least, d.lower);
                return d.upper;
              },
              std::numeric_limits<double>::infinity());
  return least;
}

// Of a needle, the closest point that is found may be far from the closest one.
DistanceBounds proven(const DistanceBounds& found, const NearestFace& faces, double rounding) {
  DistanceBounds bounds{.upper = found.upper + rounding};
  if (found.lower > 0) bounds.lower = std::max(0.0, faces.at_least(found.farthest) - rounding);
  if (bounds.lower > 0) bounds.farthest = found.farthest;
  return bounds;
}

NearestFace::Found NearestFace::nearest(const Vec3& p, Found known, std::size_t& looked_at) const {
  tree_.least([&](const Box& box) { return verify::distance(p, box); },
              [&](std::uint32_t f) {
                ++looked_at;
                const double d = distance(p, f);
                if (d < known.distance) known = {f, d};
                return d;
              },
              known.distance);
  return known;
}

double FarFromFaces::upper(const Part& part, const Search&) const {
  const auto& near = part.nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t f = near[i].face;
    if ((i > 0 && near[0].face == f) || (i > 1 && near[1].face == f)) continue;
    double farthest = 0;
    for (std::size_t j = 0; j < 3 && farthest < least; ++j)
      farthest = std::max(farthest, near[j].face == f ? near[j].distance : faces_.distance(part.corners[j], f));
    least = std::min(least, farthest);
  }
  return least;
}

NearestFace::Found FarFromFaces::look_at(const Vec3& p, Search& search, const NearestFace::Found& known) const {
  std::size_t looked_at = 0;
  const NearestFace::Found found = faces_.nearest(p, known, looked_at);
  search.took(looked_at);
  search.reaches(p, found.distance);
  return found;
}

std::array<FarFromFaces::Part, 2> FarFromFaces::halves(const Part& part, Search& search) const {
  const auto& [c, near] = part;
  const int i = longest_side(c), j = (i + 1) % 3, k = (i + 2) % 3;
  const Vec3 middle = c[i] * 0.5 + c[j] * 0.5;
  const std::uint32_t guess = near[i].face;
  const NearestFace::Found found = look_at(middle, search, {guess, faces_.distance(middle, guess)});
  return {Part{{c[i], middle, c[k]}, {near[i], found, near[k]}}, Part{{middle, c[j], c[k]}, {found, near[j], near[k]}}};
}

}  // namespace prohull::verify
