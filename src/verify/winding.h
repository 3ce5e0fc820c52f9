#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>

#include "geometry/predicates.h"
#include "verify/cell.h"
#include "verify/surface.h"

namespace prohull::verify {

/// One of `least` to `most`, with the same bits everywhere: the standard fixes those of the engine, but not those of
/// its distributions. None is likelier than another by more than their number / 2^32.
inline int random_number(std::mt19937& random, int least, int most) {
  const auto count = static_cast<std::uint64_t>(most - least) + 1;
  return least + static_cast<int>(random() * count >> 32);
}

/// A point with rational coordinates.
class ExactPoint {
 public:
  explicit ExactPoint(std::array<Number, 3> coordinates);
  explicit ExactPoint(const Vec3& p);

  const Number& operator[](int coordinate) const { return exact_[coordinate]; }
  double lower(int coordinate) const { return exact_[coordinate].approx().inf(); }
  double upper(int coordinate) const { return exact_[coordinate].approx().sup(); }
  Vec3 rounded() const { return verify::rounded(exact_); }

  /// The turn from each corner of h to the next to this point, seen along the axis; exact.
  std::array<int, 3> turns(int axis, const Triangle& h) const;
  /// The side of the plane of h, exact.
  Side side(const Triangle& h) const;

 private:
  std::array<Number, 3> exact_;
};

/// The winding number of a surface around a point that is not on it.
int winding_at(const Surface& surface, const ExactPoint& p);

/// A point inside a triangle, exactly on its plane.
class SurfacePoint {
 public:
  /// A random point inside `cell`, a piece of t.
  SurfacePoint(const Triangle& t, int axis, const Cell& cell, std::mt19937& random);

  const Triangle& support() const { return support_; }
  int axis() const { return axis_; }
  double lower(int coordinate) const { return point_.lower(coordinate); }
  double upper(int coordinate) const { return point_.upper(coordinate); }
  const Number& operator[](int coordinate) const { return point_[coordinate]; }
  Vec3 rounded() const { return point_.rounded(); }

  std::array<int, 3> turns(const Triangle& h) const { return point_.turns(axis_, h); }
  /// The side of the plane of h, exact.
  Side side(const Triangle& h) const;

 private:
  Triangle support_;
  int axis_;
  ExactPoint point_;
};

/// The winding numbers of a surface beside a point of a triangle of it or of another.
struct WindingBeside {
  int outside = 0, inside = 0;  ///< just outside and just inside of the triangle
  bool covered = false;         ///< faces of the surface, coplanar with the triangle, hold the point
  bool is_cover() const { return outside >= 1 || inside >= 1; }
};

/// Counts the faces that the ray from p along p.axis() crosses. None if the ray meets an edge, or if p lies on a
/// face that is not coplanar with its triangle: take another point.
std::optional<WindingBeside> winding_beside(const Surface& surface, const SurfacePoint& p);

/// The same at p, a point of `cell`, or at another one, which p then is.
WindingBeside winding_beside(const Surface& surface, SurfacePoint& p, const Cell& cell, std::mt19937& random);

}  // namespace prohull::verify
