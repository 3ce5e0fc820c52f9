#include "certificate/distance_trees.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "certificate/certificate_file.h"
#include "geometry/bvh.h"
#include "geometry/closest_point.h"
#include "geometry/largest_coordinate.h"

namespace prohull::certificate {
namespace {

constexpr unsigned kMostDepth = 40;
constexpr std::size_t kMostPartsPerFace = 8;  ///< of both meshes together

class DistanceTrees {
 public:
  DistanceTrees(const TriangleMesh& hull, const TriangleMesh& triangles, double distance)
      : triangles_(triangles),
        bvh_(triangles),
        most_parts_(kMostPartsPerFace * (hull.face_count() + triangles.face_count())) {
    // Distances are rounded: what is nearly too far counts as too far.
    Box box = bounding_box(hull);
    box.extend(bounding_box(triangles));
    enough_ = distance * (1 - 1e-9) - 0x1p-46 * largest_coordinate(box);
  }

  bool write(const Triangle& t) { return write({t.a, t.b, t.c}, 0); }
  const std::string& bytes() const { return file_.bytes(); }

 private:
  using Part = std::array<Vec3, 3>;

  bool write(const Part& part, unsigned depth) {
    if (++parts_ > most_parts_ || depth > kMostDepth) return false;
    const Vec3 middle = part[0] / 3 + part[1] / 3 + part[2] / 3;
    for (const Vec3& p : {middle, part[0], part[1], part[2]}) {
      const auto [face, distance] = nearest(p);
      if (distance > enough_) return false;
      const Triangle t = triangles_.triangle(FaceId(face));
      if (std::ranges::all_of(part, [&](const Vec3& corner) { return distance_to(t, corner) <= enough_; })) {
        file_.number(3 + std::uint64_t{face});
        return true;
      }
    }
    const auto length = [&](int i) { return norm(part[(i + 1) % 3] - part[(i + 2) % 3]); };
    int across = 0;
    for (const int i : {1, 2})
      if (length(i) > length(across)) across = i;
    const int j = (across + 1) % 3, k = (across + 2) % 3;
    file_.number(static_cast<std::uint64_t>(across));
    const Vec3 half_way = part[j] * 0.5 + part[k] * 0.5;
    for (const int replaced : {j, k}) {
      Part half = part;
      half[replaced] = half_way;
      if (!write(half, depth + 1)) return false;
    }
    return true;
  }

  static double distance_to(const Triangle& t, const Vec3& p) { return norm(closest_point(p, t) - p); }

  std::pair<std::uint32_t, double> nearest(const Vec3& p) const {
    std::uint32_t found = 0;
    double least = std::numeric_limits<double>::infinity();
    const auto bound = [&](const Box& box) {
      Vec3 away;
      for (int axis = 0; axis < 3; ++axis)
        away[axis] = std::max({box.min[axis] - p[axis], 0.0, p[axis] - box.max[axis]});
      return norm(away);
    };
    bvh_.least(bound, [&](std::uint32_t f) {
      const double distance = distance_to(triangles_.triangle(FaceId(f)), p);
      if (distance < least) least = distance, found = f;
      return distance;
    });
    return {found, least};
  }

  const TriangleMesh& triangles_;
  const Bvh bvh_;
  const std::size_t most_parts_;
  double enough_;
  std::size_t parts_ = 0;
  File file_;
};

}  // namespace

std::optional<std::string> distance_trees(const TriangleMesh& hull, const TriangleMesh& triangles, double distance) {
  DistanceTrees trees(hull, triangles, distance);
  for (const FaceId f : hull.triangles.ids())
    if (!trees.write(hull.triangle(f))) return std::nullopt;
  return trees.bytes();
}

}  // namespace prohull::certificate
