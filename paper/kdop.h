#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geometry/bvh.h"
#include "paper/box_line.h"
#include "query/line.h"

namespace prohull {

/// The k/2 directions of k-DOPs (Klosowski, Held, Mitchell, Sowizral, Zikan 1998), which are not normalised: the axes;
/// for 14 and 26 towards the corners of a cube; for 18 and 26 towards the middles of its edges.
template <int K>
constexpr std::array<Vec3, K / 2> kdop_directions() {
  static_assert(K == 6 || K == 14 || K == 18 || K == 26);
  std::array<Vec3, K / 2> directions{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::size_t count = 3;
  if (K != 14 && K != 6)
    for (const Vec3& d : {Vec3{1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, -1, 0}, {1, 0, -1}, {0, 1, -1}})
      directions[count++] = d;
  if (K != 18 && K != 6)
    for (const Vec3& d : {Vec3{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}}) directions[count++] = d;
  return directions;
}

/// A point or vector seen along each direction; the true values are within `error`. Where coordinates overflow, values
/// and error are infinite or NaN.
template <int K>
struct Projections {
  std::array<double, K / 2> at;
  double error;
};

/// The coordinates in which k-DOPs are stored: the mesh moved to the origin and scaled by a power of two to a size
/// of about 1, so that floats are fine enough wherever the mesh is.
class KDopFrame {
 public:
  explicit KDopFrame(const Box& mesh) {
    const Vec3 half = mesh.max * 0.5 - mesh.min * 0.5;
    const double size = std::max(std::max(half.x, half.y), half.z);
    if (size > 0) scale_ = std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000));
    center_ = mesh.center() * scale_;
  }

  Vec3 operator()(const Vec3& point) const { return point * scale_ - center_; }

  template <int K>
  Projections<K> point(const Vec3& p) const {
    return projections<K>((*this)(p));
  }
  template <int K>
  Projections<K> vector(const Vec3& v) const {
    return projections<K>(v * scale_);
  }

 private:
  /// For coordinates that are exact but for one rounding each, which is that of point * scale - center: scaling is
  /// exact unless it underflows. The roundings of coordinates and those of the two additions come to at most 3 eps (|x|
  /// + |y| + |z|) (1 + O(eps)); 2^-1000 stands for underflow.
  template <int K>
  static Projections<K> projections(const Vec3& p) {
    Projections<K> seen;
    constexpr auto kDirections = kdop_directions<K>();
    for (std::size_t i = 0; i < kDirections.size(); ++i) seen.at[i] = dot(kDirections[i], p);
    seen.error = 4 * line_filter::kEpsilon * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z)) + 0x1p-1000;
    return seen;
  }

  double scale_ = 1;
  Vec3 center_;
};

/// The greatest float not above x; minus infinity for NaN.
inline float rounded_down(double x) {
  constexpr float kLowest = std::numeric_limits<float>::lowest(), kInfinity = std::numeric_limits<float>::infinity();
  if (!(x >= kLowest)) return -kInfinity;
  if (x > -double{kLowest}) return -kLowest;
  const auto nearest = static_cast<float>(x);
  return nearest > x ? std::nextafter(nearest, -kInfinity) : nearest;
}
inline float rounded_up(double x) { return -rounded_down(-x); }

/// Points of which the value along direction i is between slabs[i].planes[0] and slabs[i].planes[1]; empty as
/// constructed. Rounded outwards: holds for certain whatever it was extended by.
template <int K>
struct KDop {
  struct Slab {
    float planes[2]{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

    void extend(double low, double high) {
      planes[0] = std::min(planes[0], rounded_down(low));
      planes[1] = std::max(planes[1], rounded_up(high));
    }
  };

  void extend(const Projections<K>& point) {
    for (std::size_t i = 0; i < slabs.size(); ++i)
      slabs[i].extend(point.at[i] - point.error, point.at[i] + point.error);
  }
  void extend(const KDop& other) {
    for (std::size_t i = 0; i < slabs.size(); ++i) slabs[i].extend(other.slabs[i].planes[0], other.slabs[i].planes[1]);
  }
  bool overlaps(const KDop& other) const {
    for (std::size_t i = 0; i < slabs.size(); ++i)
      if (slabs[i].planes[0] > other.slabs[i].planes[1] || other.slabs[i].planes[0] > slabs[i].planes[1]) return false;
    return true;
  }

  std::array<Slab, K / 2> slabs;
};

template <int K>
KDop<K> kdop_of(const KDopFrame& frame, const Triangle& triangle) {
  KDop<K> kdop;
  for (const Vec3& p : {triangle.a, triangle.b, triangle.c}) kdop.extend(frame.template point<K>(p));
  return kdop;
}

/// A line up to some finite t, seen along each direction.
template <int K>
struct LineProjections {
  LineProjections(const KDopFrame& frame, const DirectedLine& line, double end)
      : origin(frame.template point<K>(line.origin)),
        direction(frame.template vector<K>(line.direction)),
        t_end(end),
        error(2 * (origin.error + t_end * direction.error)) {}

  Projections<K> origin, direction;
  double t_end;
  double error;  ///< of origin.at + t direction.at for all t of [0, t_end], evaluated with two more roundings
};

/// Around the line.
template <int K>
KDop<K> kdop_of(const LineProjections<K>& line) {
  KDop<K> kdop;
  for (std::size_t i = 0; i < kdop.slabs.size(); ++i) {
    const double start = line.origin.at[i], end = start + line.t_end * line.direction.at[i];
    kdop.slabs[i].extend(std::min(start, end) - line.error, std::max(start, end) + line.error);
  }
  return kdop;
}

/// A line to be clipped by k-DOPs, as BoxLine by boxes; its error goes to the planes.
template <int K>
class KDopLine {
 public:
  explicit KDopLine(const LineProjections<K>& line) : t_end_(line.t_end) {
    for (std::size_t i = 0; i < along_.size(); ++i) {
      const double d = line.direction.at[i], error = d < 0 ? -line.error : line.error;
      const double start = BoxLine::is_usable(d) ? line.origin.at[i] : std::numeric_limits<double>::quiet_NaN();
      along_[i] = {start + error, start - error, d == 0 ? std::numeric_limits<double>::infinity() : 1 / d, d < 0};
    }
  }

  Passage through(const KDop<K>& kdop, double limit) const {
    double from = 0, to = std::min(limit, t_end_);
    for (std::size_t i = 0; i < along_.size(); ++i) {
      const Along& along = along_[i];
      const double near = (kdop.slabs[i].planes[along.backwards] - along.near_origin) * along.inverse;
      const double far = (kdop.slabs[i].planes[!along.backwards] - along.far_origin) * along.inverse;
      from = near > from ? near : from;
      to = far < to ? far : to;
      if (from > BoxLine::widened(to)) break;
    }
    return {from, BoxLine::widened(to)};
  }

 private:
  struct Along {
    double near_origin, far_origin, inverse;
    bool backwards;  ///< the near plane is planes[1]
  };
  std::array<Along, K / 2> along_;
  double t_end_;
};

}  // namespace prohull
