#include "enclose/estimated_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/area.h"

namespace prohull {
namespace {

struct Crossing {
  std::uint32_t line;
  float height;  ///< in a power of two near the length of lines
  int winding;   ///< by how much it grows there
};

/// Lines along the longest side of the box around a mesh, through the middles of cells of its other two sides.
class Lines {
 public:
  explicit Lines(const TriangleMesh& mesh) : box_(bounding_box(mesh)) {
    const Vec3 size = box_.max - box_.min;
    along_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const double cross_section = size[u()] * size[v()];
    constexpr double kMostCrossings = 0x1p20, kFewest = 16, kMost = 256;
    per_side_ = std::size_t(std::clamp(std::sqrt(kMostCrossings * cross_section / area_of(mesh)), kFewest, kMost));
    step_u_ = size[u()] / double(per_side_), step_v_ = size[v()] / double(per_side_);
    unit_ = std::ldexp(1.0, std::ilogb(size[along_]));
  }

  void cross(const Triangle& t, std::vector<Crossing>& crossings) const {
    const Vec3 &a = t.a, &b = t.b, &c = t.c;
    const double turned = area(a[u()], a[v()], b, c);
    if (turned == 0) return;
    const auto [first_u, last_u] = range(a, b, c, u(), step_u_);
    const auto [first_v, last_v] = range(a, b, c, v(), step_v_);
    for (std::size_t i = first_u; i < last_u; ++i)
      for (std::size_t j = first_v; j < last_v; ++j) {
        const double x = box_.min[u()] + (double(i) + 0.5) * step_u_, y = box_.min[v()] + (double(j) + 0.5) * step_v_;
        const double of_a = area(x, y, b, c) / turned, of_b = area(x, y, c, a) / turned, of_c = 1 - of_a - of_b;
        if (!(of_a >= 0 && of_b >= 0 && of_c >= 0)) continue;
        const double height = of_a * a[along_] + of_b * b[along_] + of_c * c[along_] - box_.min[along_];
        crossings.push_back({std::uint32_t(i * per_side_ + j), float(height / unit_), turned < 0 ? 1 : -1});
      }
  }

  double volume(double length) const { return length * unit_ * step_u_ * step_v_; }

 private:
  int u() const { return (along_ + 1) % 3; }
  int v() const { return (along_ + 2) % 3; }

  /// Twice that of the triangle (x, y), p, q, seen along the lines; negative if it turns clockwise.
  double area(double x, double y, const Vec3& p, const Vec3& q) const {
    return (p[u()] - x) * (q[v()] - y) - (p[v()] - y) * (q[u()] - x);
  }

  std::pair<std::size_t, std::size_t> range(const Vec3& a, const Vec3& b, const Vec3& c, int axis, double step) const {
    const auto [least, most] = std::minmax({a[axis], b[axis], c[axis]});
    return {std::size_t(std::max(0.0, std::floor((least - box_.min[axis]) / step - 0.5))),
            std::min(per_side_, std::size_t(std::max(0.0, std::ceil((most - box_.min[axis]) / step + 0.5))))};
  }

  Box box_;
  int along_;
  std::size_t per_side_;
  double step_u_, step_v_, unit_;
};

}  // namespace

double estimated_volume(const TriangleMesh& closed) {
  const Lines lines(closed);
  std::vector<Crossing> crossings;
  for (const FaceId f : closed.triangles.ids()) lines.cross(closed.triangle(f), crossings);
  std::ranges::sort(crossings, {}, [](const Crossing& c) { return std::tuple(c.line, c.height, c.winding); });
  double length = 0;
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].winding;
    if (crossings[i].line != crossings[i + 1].line)
      winding = 0;
    else if (winding > 0)
      length += double(crossings[i + 1].height) - double(crossings[i].height);
  }
  return lines.volume(length);
}

}  // namespace prohull
