#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "prohull/detail/solid_pieces.h"
#include "prohull/error.h"
#include "verify/cell.h"

namespace prohull {
namespace {

/// A number that was computed in double precision, and a bound of how wrong it is.
struct Approximate {
  double value = 0, error = 0;

  Approximate() = default;
  explicit Approximate(double exact) : value(exact) {}
  /// An operation rounds by at most half a unit in the last place, 2^-53 of the result, or underflows by less than
  /// 1e-300. The rest makes up for the rounding of the bound itself, a sum and products of a few numbers.
  Approximate(double computed, double inherited)
      : value(computed), error((inherited + 0x1p-53 * std::abs(computed)) * (1 + 0x1p-45) + 1e-300) {}
};
Approximate operator+(const Approximate& a, const Approximate& b) { return {a.value + b.value, a.error + b.error}; }
Approximate operator-(const Approximate& a, const Approximate& b) { return {a.value - b.value, a.error + b.error}; }
Approximate operator*(const Approximate& a, const Approximate& b) {
  return {a.value * b.value, std::abs(a.value) * b.error + a.error * (std::abs(b.value) + b.error)};
}

/// R^T (p - t)
template <class Number>
std::array<Number, 3> local(const Pose& pose, const Vec3& p) {
  std::array<Number, 3> result;
  for (int i = 0; i < 3; ++i) {
    Number sum(0);
    for (int j = 0; j < 3; ++j) sum = sum + Number(pose.rotation[j][i]) * (Number(p[j]) - Number(pose.translation[j]));
    result[i] = sum;
  }
  return result;
}

double sum_of(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// The bounds of the forms, as polynomials that are at most 0 within.
enum Bound { kTube, kTop, kBottom, kUpperBall, kLowerBall };

/// A point of the outline that is turned about the axis.
struct FormCorner {
  double radius, z;
};

/// The surface of revolution of an outline that begins and ends on the axis, from the lowest z to the highest one.
TriangleMesh turned(const std::vector<FormCorner>& outline, std::size_t segments) {
  TriangleMesh mesh;
  std::vector<std::vector<VertexId>> rings;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == outline.size();
    auto& ring = rings.emplace_back();
    for (std::size_t k = 0; k < (is_end ? 1 : segments); ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(segments);
      const double radius = is_end ? 0 : outline[i].radius;
      ring.push_back(mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), outline[i].z}));
    }
  }
  for (std::size_t i = 1; i < rings.size(); ++i)
    for (std::size_t k = 0; k < segments; ++k) {
      const auto at = [&](const std::vector<VertexId>& ring, std::size_t j) { return ring[j % ring.size()]; };
      const VertexId a = at(rings[i - 1], k), b = at(rings[i - 1], k + 1), c = at(rings[i], k + 1), d = at(rings[i], k);
      if (a != b) mesh.triangles.push_back({a, b, c});
      if (c != d) mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

/// Two half spheres of `steps` rings each, `half` above and below the middle. If half is 0, they share the last ring.
std::vector<FormCorner> outline_of_balls(double radius, double half, std::size_t steps) {
  std::vector<FormCorner> outline;
  const auto angle = [&](std::size_t i) {
    return std::numbers::pi / 2 * static_cast<double>(i) / static_cast<double>(steps);
  };
  for (std::size_t i = 0; i <= steps; ++i)
    outline.push_back({radius * std::sin(angle(i)), -half - radius * std::cos(angle(i))});
  outline.back().z = -half;
  for (std::size_t i = half == 0 ? steps : steps + 1; i-- > 0;) outline.push_back({outline[i].radius, -outline[i].z});
  return outline;
}

}  // namespace

/// Knuth's sum in two parts: the second one is what the first one leaves out.
bool is_exact_sum(double a, double b) {
  const double sum = a + b, from_b = sum - a;
  return (a - (sum - from_b)) + (b - from_b) == 0;
}

std::optional<Ball> CurvedForm::ball() const {
  if (kind_ != Kind::Sphere) return std::nullopt;
  return Ball{pose_.translation, radius_};
}

template <class Number>
Number CurvedForm::excess(int bound, const Vec3& p) const {
  const auto [x, y, z] = local<Number>(pose_, p);
  const Number half(half_), radius(radius_);
  if (bound == kTop) return z - half;
  if (bound == kBottom) return Number(0) - z - half;
  Number beyond_tube = x * x + y * y - radius * radius;
  if (bound == kTube) return beyond_tube;
  const Number height = bound == kUpperBall ? z - half : z + half;
  return beyond_tube + height * height;
}

bool CurvedForm::keeps(int bound, const Vec3& p) const {
  const auto about = excess<Approximate>(bound, p);
  if (about.value > about.error) return false;
  if (about.value < -about.error) return true;
  return excess<verify::Number>(bound, p) <= 0;
}

bool CurvedForm::contains(const Vec3& p) const {
  if (kind_ != Kind::Sphere && keeps(kTube, p) && keeps(kTop, p) && keeps(kBottom, p)) return true;
  return kind_ != Kind::Cylinder && (keeps(kUpperBall, p) || keeps(kLowerBall, p));
}

/// No entry of R^T R - I is greater.
double CurvedForm::skew() const {
  if (pose_.rotation == Pose{}.rotation) return 0;
  double result = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double sum = i == j ? -1 : 0;
      for (int k = 0; k < 3; ++k) sum += pose_.rotation[k][i] * pose_.rotation[k][j];
      result = std::max(result, std::abs(sum));
    }
  return result + 0x1p-48;  // sums of four terms of about 1
}

/// Seen from the form, distances are longer or shorter by a factor of at most sqrt(1 + 3 skew) or sqrt(1 - 3 skew).
/// Coordinates there are sums of three products, within 2^-49 of the greatest numbers that go into them; their norms
/// add some units more.
CurvedForm::Distance CurvedForm::distance(const Vec3& p) const {
  const auto [x, y, z] = local<double>(pose_, p);
  const double from_axis = std::hypot(x, y), above = std::max(0.0, std::abs(z) - half_);
  const double seen = kind_ == Kind::Cylinder ? std::hypot(std::max(0.0, from_axis - radius_), above)
                                              : std::hypot(from_axis, above) - radius_;
  const double rounding = 0x1p-46 * (from_axis + std::abs(z) + radius_ + half_ + sum_of(pose_.translation));
  const double slack = 3 * skew() * std::abs(seen) + rounding;
  return {std::max(0.0, seen - slack), std::max(0.0, seen + slack)};
}

double CurvedForm::largest_coordinate() const { return radius_ + half_ + sum_of(pose_.translation); }

/// How far the faces of mesh() keep from the form, so that no rounding takes them to its other side.
///
/// Seen from the form, a vertex v is at R^T (p - t), where p = R v + t is rounded. That moves it by |(R^T R - I) v|, at
/// most 3 skew |v|, and by the rounding of p, at most 2^-49 (|v| + |t|). In v itself angles, cosines and products are
/// wrong by at most 2^-48 |v|. And |v| <= 1.5 (radius + half). The margin is more than the sum.
double CurvedForm::margin() const {
  return (0x1p-44 + 5 * skew()) * (radius_ + half_) + 0x1p-44 * sum_of(pose_.translation);
}

double CurvedForm::volume() const {
  const double tube = std::numbers::pi * radius_ * radius_ * 2 * half_;
  return kind_ == Kind::Cylinder ? tube : tube + 4 * std::numbers::pi / 3 * radius_ * radius_ * radius_;
}

/// Whether the caps of a cylinder are parallel to the xy plane, at heights that are not rounded.
bool CurvedForm::has_exact_caps() const {
  return pose_.rotation == Pose{}.rotation && is_exact_sum(pose_.translation.z, half_) &&
         is_exact_sum(pose_.translation.z, -half_);
}

// Why mesh() keeps its promise. Take the form with radius (and, of a cylinder, half length) greater or less by the
// margin, and the mesh M of real numbers.
//
// Around: the faces of M touch a ball, or circle, of the greater radius, or are outside of it.
//   - In a plane through the axis, the outline of M through the corners is a polygon in a circle of radius s; midway
//     between two corners, the circle has shrunk to an ellipse of half axes s cos(pi / n) and s. Edges of the outline
//     are cos(d / 2) s away from the centre, where d = pi / (2 steps) <= 2 pi / n is their angle; chords of the
//     ellipse, in which the planes of faces meet that plane, are at least cos(pi / n) times as far. So s = radius /
//     cos(pi / n)^2 suffices. A cylinder has no such steps, so that radius / cos(pi / n) would.
//   So the surface keeps the margin from the form. Rounding moves vertices by less, hence every point of every face by
//   less. While the vertices move there, on straight ways, the surface does not touch the form, so that it goes on
//   winding once around all of it.
//   Caps of a cylinder that are not rounded need no margin: nothing of the form is beyond their planes.
// Within: the vertices of M are inside of the form by the margin. Rounding moves them by less; the form is convex.
TriangleMesh CurvedForm::mesh(Curved curved, std::size_t segments) const {
  if (segments < 8) throw InputError(Defect::InvalidOption, "a curved form needs 8 segments or more");
  if (curved != Curved::SameVolume) return placed(pose_, own_mesh(curved, segments));
  TriangleMesh mesh = own_mesh(Curved::Within, segments);
  if (const double flat = signed_volume(mesh); flat > 0) {
    const double wider = std::sqrt(volume() / flat);
    for (Vec3& p : mesh.positions) p.x *= wider, p.y *= wider;
  }
  return placed(pose_, std::move(mesh));
}

/// In the frame of the form.
TriangleMesh CurvedForm::own_mesh(Curved curved, std::size_t segments) const {
  const bool is_around = curved == Curved::Around;
  const double offset = is_around ? margin() : -margin();
  double radius = std::max(0.0, radius_ + offset);
  if (is_around) radius /= std::pow(std::cos(std::numbers::pi / static_cast<double>(segments)), 2);
  if (kind_ != Kind::Cylinder) return turned(outline_of_balls(radius, half_, (segments + 3) / 4), segments);
  const double half = has_exact_caps() ? half_ : std::max(0.0, half_ + offset);
  return turned({{0, -half}, {radius, -half}, {radius, half}, {0, half}}, segments);
}

}  // namespace prohull
