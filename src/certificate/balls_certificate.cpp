#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "certificate/certificate_file.h"
#include "certificate/finite_original.h"
#include "geometry/box_around_ball.h"
#include "geometry/bvh.h"
#include "prohull/certificate.h"
#include "verify/cell.h"

// A part of which one ball holds all corners is a leaf. Any other is cut in two at the middle of its longest side.

namespace prohull {
namespace certificate {
namespace {

using BallIndex = std::uint32_t;
using verify::Number;

class BallTree {
 public:
  BallTree(const Triangle& t, std::span<const Ball> balls, std::vector<BallIndex> near, File& file)
      : t_(t), balls_(balls), near_(std::move(near)), file_(file) {}

  void write() {
    const Corner a = corner({1, 0, 0}), b = corner({0, 1, 0}), c = corner({0, 0, 1});
    write({a, b, c}, 0);
  }

 private:
  static constexpr unsigned kMostDepth = 48;  ///< halves of such weights are exact

  struct Corner {
    Vec3 weights, position;          ///< the position is rounded
    std::vector<BallIndex> holders;  ///< sorted
  };

  void write(const std::array<Corner, 3>& part, unsigned depth) {
    const auto holder = std::ranges::find_if(part[0].holders, [&](BallIndex i) {
      return std::ranges::binary_search(part[1].holders, i) && std::ranges::binary_search(part[2].holders, i);
    });
    const bool is_hopeless = depth == kMostDepth || std::ranges::any_of(part, [](const Corner& c) {
                               return c.holders.empty();
                             });  // the checker will say so
    if (holder != part[0].holders.end() || is_hopeless) {
      file_.number(3 + std::uint64_t{holder == part[0].holders.end() ? 0 : *holder});
      return;
    }
    const auto length = [&](int i) { return norm(part[(i + 1) % 3].position - part[(i + 2) % 3].position); };
    int across = 0;
    for (const int i : {1, 2})
      if (length(i) > length(across)) across = i;
    const int j = (across + 1) % 3, k = (across + 2) % 3;
    file_.number(static_cast<std::uint64_t>(across));
    const Corner middle = corner(part[j].weights * 0.5 + part[k].weights * 0.5);
    for (const int replaced : {j, k}) {
      std::array<Corner, 3> half = part;
      half[replaced] = middle;
      write(half, depth + 1);
    }
  }

  Corner corner(const Vec3& weights) const {
    Corner result{weights, t_.a * weights.x + t_.b * weights.y + t_.c * weights.z, {}};
    for (const BallIndex i : near_)
      if (holds(balls_[i], result)) result.holders.push_back(i);
    return result;
  }

  /// Exact. Rounding changes a coordinate by a few units in the last place of the corners and the centre.
  bool holds(const Ball& ball, const Corner& corner) const {
    const double distance = norm(corner.position - ball.center);
    double largest = ball.radius;
    for (const Vec3& p : {t_.a, t_.b, t_.c, ball.center})
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (const double room = ball.radius - distance; std::abs(room) > 0x1p-44 * largest) return room > 0;
    Number squared(0);
    for (int axis = 0; axis < 3; ++axis) {
      const Number x = Number(t_.a[axis]) * Number(corner.weights.x) + Number(t_.b[axis]) * Number(corner.weights.y) +
                       Number(t_.c[axis]) * Number(corner.weights.z) - Number(ball.center[axis]);
      squared += x * x;
    }
    return squared <= Number(ball.radius) * Number(ball.radius);
  }

  const Triangle t_;
  const std::span<const Ball> balls_;
  const std::vector<BallIndex> near_;
  File& file_;
};

}  // namespace
}  // namespace certificate

Certificate balls_certificate(std::span<const Ball> balls, const CertifiedOriginal& original) {
  const certificate::FiniteOriginal finite(original.mesh);
  std::vector<Box> boxes;
  for (const Ball& ball : balls) boxes.push_back(box_around(ball));
  const Bvh bvh(std::move(boxes));
  certificate::File file = certificate::header(HullSide::Outer, original, balls.size(), finite);
  file.section(certificate::Section::Balls);
  const TriangleMesh& read = finite.is_closed ? finite.turned : finite.triangles;  // as by the checker
  for (const FaceId f : read.triangles.ids()) {
    const Triangle t = read.triangle(f);
    std::vector<std::uint32_t> near;
    bvh.visit([box = box_of(t)](const Box& other) { return other.overlaps(box); },
              [&](std::uint32_t i) { near.push_back(i); });
    std::ranges::sort(near);
    certificate::BallTree(t, balls, std::move(near), file).write();
  }
  return {.bytes = file.bytes(), .claims = {"cover every finite triangle"}};
}

}  // namespace prohull
