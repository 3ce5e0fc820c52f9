#include "prohull/detail/mesh_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/compactness.h"

namespace prohull {
namespace {

/// Reorders the values.
Percentiles percentiles(std::vector<double>& values) {
  if (values.empty()) return {};
  const auto ranked = [&](std::size_t percent) {
    const std::size_t rank = (values.size() * percent + 99) / 100;  // the nearest rank, from 1
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
  };
  return {ranked(0), ranked(1), ranked(10), ranked(50)};
}

/// Two edges of a triangle, in a unit in which no product of theirs overflows or vanishes.
struct SideLengths {
  Vec3 ab, ac;

  explicit SideLengths(const Triangle& t) {
    const Vec3 half_ab = t.b * 0.5 - t.a * 0.5, half_ac = t.c * 0.5 - t.a * 0.5;
    double unit = 0;
    for (const Vec3& v : {half_ab, half_ac})
      for (int i = 0; i < 3; ++i) unit = std::max(unit, std::abs(v[i]));
    if (unit > 0) ab = half_ab / unit, ac = half_ac / unit;
  }
};

/// One side of a face, as its neighbour sees it.
struct SideUse {
  std::uint64_t key;  ///< equal for uses of one edge
  FaceId face;
  bool ascending;
};

class Measurement {
 public:
  explicit Measurement(const TriangleMesh& mesh) : mesh_(mesh), normals_(mesh.face_count()) {}

  MeshQuality run() {
    MeshQuality quality;
    std::vector<double> compactnesses, angles;
    for (const FaceId f : mesh_.triangles.ids()) compactnesses.push_back(measure(f));
    const std::vector<SideUse> uses = edge_uses();
    for (std::size_t i = 0, end; i < uses.size(); i = end) {
      for (end = i; end < uses.size() && uses[end].key == uses[i].key;) ++end;
      if (end - i == 2 && uses[i].ascending != uses[i + 1].ascending && has_area(uses[i].face) &&
          has_area(uses[i + 1].face))
        angles.push_back(dihedral_angle(normals_[uses[i].face], normals_[uses[i + 1].face]));
    }
    quality.smallest_angle = smallest_angle_;
    quality.worst_aspect_ratio = worst_aspect_ratio_;
    quality.edges = angles.size();
    quality.sharp_edges = static_cast<std::size_t>(
        std::ranges::count_if(angles, [](double angle) { return angle < kSharpDihedralAngle; }));
    quality.compactness = percentiles(compactnesses);
    quality.dihedral_angle = percentiles(angles);
    return quality;
  }

 private:
  /// Notes the normal, if there is one.
  double measure(FaceId f) {
    const Triangle t = mesh_.triangle(f);
    if (!(is_finite(t.a) && is_finite(t.b) && is_finite(t.c))) return 0;
    const SideLengths sides(t);
    const Vec3 normal = cross(sides.ab, sides.ac);
    const double double_area = norm(normal);
    if (double_area > 0) normals_[f] = normal / double_area;
    measure_shape(sides, double_area);
    return compactness(double_area,
                       squared_norm(sides.ab) + squared_norm(sides.ac) + squared_norm(sides.ac - sides.ab));
  }

  // The smallest angle faces the shortest edge; the shortest altitude stands on the longest one.
  void measure_shape(const SideLengths& sides, double double_area) {
    std::array<double, 3> lengths{norm(sides.ab), norm(sides.ac), norm(sides.ac - sides.ab)};
    std::ranges::sort(lengths);
    const double cosine = (lengths[1] * lengths[1] + lengths[2] * lengths[2] - lengths[0] * lengths[0]) / 2;
    smallest_angle_ = std::min(smallest_angle_, std::atan2(double_area, cosine));
    worst_aspect_ratio_ = std::max(worst_aspect_ratio_, double_area > 0 ? lengths[2] * lengths[2] / double_area
                                                                        : std::numeric_limits<double>::infinity());
  }

  bool has_area(FaceId f) const { return normals_[f] != Vec3{}; }

  static double dihedral_angle(const Vec3& m, const Vec3& n) {
    return std::numbers::pi - std::atan2(norm(cross(m, n)), dot(m, n));
  }

  std::vector<SideUse> edge_uses() const {
    std::vector<SideUse> uses;
    uses.reserve(3 * mesh_.face_count());
    for (const FaceId f : mesh_.triangles.ids())
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint64_t v = index(mesh_.triangles[f][i]), w = index(mesh_.triangles[f][i == 2 ? 0 : i + 1]);
        uses.push_back({std::min(v, w) << 32 | std::max(v, w), f, v < w});
      }
    std::ranges::sort(uses, {}, [](const SideUse& use) { return std::pair(use.key, use.face); });
    return uses;
  }

  const TriangleMesh& mesh_;
  double smallest_angle_ = std::numbers::pi / 3, worst_aspect_ratio_ = 2 / std::numbers::sqrt3;
  PerFace<Vec3> normals_;  ///< of length 1; zero where there is none
};

}  // namespace

MeshQuality mesh_quality(const TriangleMesh& mesh) { return Measurement(mesh).run(); }

}  // namespace prohull
