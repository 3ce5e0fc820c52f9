#include "mesh/triangulate_polygon.h"

#include <algorithm>
#include <numeric>

#include "geometry/predicates.h"

namespace prohull {
namespace {

constexpr std::size_t kMaxTestsPerCorner = 2000;

/// A closed polygon of which ears are clipped: the corners left are linked in a ring.
class EarClipper {
 public:
  EarClipper(std::span<const VertexId> corners, const PerVertex<Vec3>& positions)
      : corners_(corners), previous_(corners.size()), next_(corners.size()), turn_(corners.size(), 1) {
    for (const VertexId v : corners) points_.push_back(positions[v]);
    std::iota(next_.begin(), next_.end(), std::size_t{1});
    next_.back() = 0;
    for (std::size_t i = 0; i < next_.size(); ++i) previous_[next_[i]] = i;
    choose_axis();
    for (std::size_t i = 0; i < corners.size(); ++i) update(i);
  }

  std::optional<std::vector<std::array<VertexId, 3>>> triangles() {
    std::vector<std::array<VertexId, 3>> result;
    std::size_t left = corners_.size(), refused = 0, ear = 1;
    // A ring of which no corner is an ear is not simple, or flat: the rest becomes a fan.
    for (; left > 3 && refused < left; ear = next_[ear]) {
      if (is_ear(ear)) {
        result.push_back(triangle(ear));
        clip(ear);
        --left, refused = 0;
      } else {
        ++refused;
      }
      if (tests_ > kMaxTestsPerCorner * corners_.size()) return {};
    }
    for (; left >= 3; ear = next_[ear], --left) {
      result.push_back(triangle(ear));
      clip(ear);
    }
    return result;
  }

 private:
  /// The axis along which the polygon is seen at its largest, from the side where it is counter-clockwise.
  void choose_axis() {
    Box box;
    for (const Vec3& p : points_) box.extend(p);
    const Vec3 center = box.center();
    const double unit = std::max({box.max.x - center.x, box.max.y - center.y, box.max.z - center.z});
    Vec3 normal;
    for (std::size_t i = 0; i < points_.size() && unit > 0; ++i)
      normal += cross((points_[i] - center) / unit, (points_[next_[i]] - center) / unit);
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(normal[axis]) > std::abs(normal[axis_])) axis_ = axis;
    sign_ = normal[axis_] < 0 ? -1 : 1;
  }

  int turn_of(const Vec3& a, const Vec3& b, const Vec3& c) const { return sign_ * turn(axis_, a, b, c); }

  std::array<VertexId, 3> triangle(std::size_t i) const {
    return {corners_[previous_[i]], corners_[i], corners_[next_[i]]};
  }

  void update(std::size_t i) {
    const int before = turn_[i];
    turn_[i] = turn_of(points_[previous_[i]], points_[i], points_[next_[i]]);
    if (turn_[i] <= 0 && before > 0) not_left_.push_back(i);
  }

  void clip(std::size_t i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    update(previous_[i]);
    update(next_[i]);
  }

  /// Only corners that do not turn left can lie in the triangle of a corner that does.
  bool is_ear(std::size_t ear) {
    if (turn_[ear] <= 0) return false;
    tests_ += not_left_.size();
    return std::none_of(not_left_.begin(), not_left_.end(),
                        [&](std::size_t i) { return turn_[i] <= 0 && blocks(points_[i], ear); });
  }

  bool blocks(const Vec3& p, std::size_t ear) const {
    const Vec3 &a = points_[previous_[ear]], &b = points_[ear], &c = points_[next_[ear]];
    for (const int axis : {(axis_ + 1) % 3, (axis_ + 2) % 3}) {
      const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
      if (p[axis] < low || p[axis] > high) return false;
    }
    if (p == a || p == b || p == c) return false;  // a seam that joins a hole with the outline
    return turn_of(a, b, p) >= 0 && turn_of(b, c, p) >= 0 && turn_of(c, a, p) >= 0;
  }

  std::span<const VertexId> corners_;
  std::vector<Vec3> points_;
  std::vector<std::size_t> previous_, next_;
  std::vector<int> turn_;              ///< +1 left, -1 right, 0 straight on; a clipped corner keeps its last
  std::vector<std::size_t> not_left_;  ///< every corner that does not turn left, and some that once did not
  int axis_ = 0, sign_ = 1;
  std::size_t tests_ = 0;
};

}  // namespace

std::optional<std::vector<std::array<VertexId, 3>>> triangulate_polygon(std::span<const VertexId> corners,
                                                                        const PerVertex<Vec3>& positions) {
  return EarClipper(corners, positions).triangles();
}

}  // namespace prohull
