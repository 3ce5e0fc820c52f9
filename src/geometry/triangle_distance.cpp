#include "geometry/triangle_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/closest_point.h"
#include "geometry/exact_number.h"
#include "geometry/predicates.h"
#include "geometry/vector_of.h"

namespace prohull {
namespace {

struct Points {
  Vec3 s, t;
  double squared_distance = std::numeric_limits<double>::infinity();

  void consider(const Vec3& p, const Vec3& q) {
    const double d = squared_norm(q - p);
    if (d < squared_distance) s = p, t = q, squared_distance = d;
  }
};

double fraction(double part, double whole) { return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0; }

/// Ericson, Real-Time Collision Detection, 5.1.9.
void consider_edges(Points& best, const Vec3& p, const Vec3& p_end, const Vec3& q, const Vec3& q_end) {
  const Vec3 u = p_end - p, v = q_end - q, r = p - q;
  const double a = dot(u, u), b = dot(u, v), c = dot(u, r), e = dot(v, v), f = dot(v, r);
  double s = fraction(b * f - c * e, a * e - b * b);
  const double t = e > 0 ? (b * s + f) / e : 0;
  if (!(t >= 0)) s = fraction(-c, a);
  if (t > 1) s = fraction(b - c, a);
  best.consider(p + u * s, q + v * std::clamp(t >= 0 ? t : 0.0, 0.0, 1.0));
}

}  // namespace

TriangleDistance triangle_distance(const Triangle& s, const Triangle& t) {
  // As seen from a corner: these differences have relative errors only. A power of two keeps products in range; it is
  // small enough for both bounds, which are 0 or above 2^-48 of it, to be normal numbers.
  std::array<Vec3, 3> from{Vec3{}, s.b - s.a, s.c - s.a}, to{t.a - s.a, t.b - s.a, t.c - s.a};
  double size = 0;
  for (const auto& corners : {from, to})
    for (const Vec3& p : corners) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double unit = std::ldexp(1.0, -std::ilogb(std::max(size, 0x1p-900)));
  for (auto* corners : {&from, &to})
    for (Vec3& p : *corners) p = p * unit;
  Points best;
  for (std::size_t i = 0; i < 3; ++i) {
    best.consider(from[i], closest_point(from[i], Triangle{to[0], to[1], to[2]}));
    best.consider(closest_point(to[i], Triangle{from[0], from[1], from[2]}), to[i]);
    for (std::size_t j = 0; j < 3; ++j) consider_edges(best, from[i], from[(i + 1) % 3], to[j], to[(j + 1) % 3]);
  }
  // Coordinates are less than 2. The points are combinations of corners with fractions in [0, 1]: each coordinate is
  // within 24 eps of a point of its triangle, with eps = 2^-53, and their distance within 128 eps.
  constexpr double kEpsilon = 0x1p-53;
  const Vec3 axis = best.t - best.s;
  const double length = norm(axis);
  TriangleDistance result{0, (length * (1 + 8 * kEpsilon) + 128 * kEpsilon) / unit, s.a + best.s / unit,
                          s.a + best.t / unit};
  // Whatever the axis, no two points of the triangles are nearer than what separates them along it. The products have
  // errors of 12 eps of the product of the largest entries, as in geometry/triangle_intersection.cpp.
  const auto range = [&](const std::array<Vec3, 3>& corners) {
    return std::minmax({dot(axis, corners[0]), dot(axis, corners[1]), dot(axis, corners[2])});
  };
  const double gap = range(to).first - range(from).second - 64 * kEpsilon * length;
  if (length > 0x1p-100 && gap > 0) result.lower = gap / length * (1 - 8 * kEpsilon) / unit;
  return result;
}

namespace {

using Number = ExactNumber;
using Vector = VectorOf<Number>;

/// A corner of a triangle: as it is, and as exact numbers.
struct ExactCorner {
  explicit ExactCorner(const Vec3& p) : position(p), exact{p.x, p.y, p.z} {}
  Vec3 position;
  Vector exact;
};
using ExactTriangle = std::array<ExactCorner, 3>;

/// Whether the segment passes from one side of the triangle to the other through its inside.
bool pierces(const Vec3& p, const Vec3& q, const Triangle& t) {
  const Side from = side(t.a, t.b, t.c, p), to = side(t.a, t.b, t.c, q);
  if (from == Side::On || to != opposite(from)) return false;
  const Side turn = side(p, q, t.a, t.b);
  return turn != Side::On && side(p, q, t.b, t.c) == turn && side(p, q, t.c, t.a) == turn;
}

bool pierces(const Triangle& s, const Triangle& t) {
  return pierces(s.a, s.b, t) || pierces(s.b, s.c, t) || pierces(s.c, s.a, t);
}

/// Decides whether two triangles that do not pierce each other are nearer than a distance. Two of their nearest points
/// are then two corners; or a corner and its foot inside of an edge or of the triangle; or the feet of the common
/// perpendicular of two edges. Each question is about one such pair. Where the feet are elsewhere, the answer is no.
class Nearer {
 public:
  Nearer(const Triangle& s, const Triangle& t, double distance)
      : distance_(distance),
        s_{ExactCorner(s.a), ExactCorner(s.b), ExactCorner(s.c)},
        t_{ExactCorner(t.a), ExactCorner(t.b), ExactCorner(t.c)},
        squared_(Number(distance) * Number(distance)) {}

  bool any() const {
    for (std::size_t i = 0; i < 3; ++i) {
      const ExactCorner &s = s_[i], &s_next = s_[(i + 1) % 3];
      if (corner_and_face(s, t_) || corner_and_face(t_[i], s_)) return true;
      for (std::size_t j = 0; j < 3; ++j) {
        const ExactCorner &t = t_[j], &t_next = t_[(j + 1) % 3];
        if (corners(s, t) || corner_and_edge(s, t, t_next) || corner_and_edge(t, s, s_next) ||
            edges(s, s_next, t, t_next))
          return true;
      }
    }
    return false;
  }

 private:
  bool is_far(const Triangle& s, const Triangle& t) const { return triangle_distance(s, t).lower >= distance_; }

  bool corners(const ExactCorner& p, const ExactCorner& q) const {
    if (is_far({p.position, p.position, p.position}, {q.position, q.position, q.position})) return false;
    const Vector d = p.exact - q.exact;
    return dot(d, d) < squared_;
  }

  bool corner_and_edge(const ExactCorner& p, const ExactCorner& a, const ExactCorner& b) const {
    if (is_far({p.position, p.position, p.position}, {a.position, b.position, b.position})) return false;
    const Vector edge = b.exact - a.exact, to = p.exact - a.exact;
    const Number along = dot(edge, to), all = dot(edge, edge);
    if (sign(along) <= 0 || along >= all) return false;
    const Vector n = cross(edge, to);
    return dot(n, n) < squared_ * all;
  }

  bool edges(const ExactCorner& p, const ExactCorner& p_end, const ExactCorner& q, const ExactCorner& q_end) const {
    if (is_far({p.position, p_end.position, p_end.position}, {q.position, q_end.position, q_end.position}))
      return false;
    const Vector u = p_end.exact - p.exact, v = q_end.exact - q.exact, w = q.exact - p.exact, n = cross(u, v);
    const Number all = dot(n, n), s = dot(cross(w, v), n), t = dot(cross(w, u), n);
    if (sign(all) == 0 || sign(s) < 0 || s > all || sign(t) < 0 || t > all) return false;
    const Number height = dot(w, n);
    return height * height < squared_ * all;
  }

  bool corner_and_face(const ExactCorner& p, const ExactTriangle& t) const {
    if (is_far({p.position, p.position, p.position}, {t[0].position, t[1].position, t[2].position})) return false;
    const Vector n = cross(t[1].exact - t[0].exact, t[2].exact - t[0].exact);
    const Number all = dot(n, n);
    if (sign(all) == 0) return false;
    for (std::size_t i = 0; i < 3; ++i)
      if (sign(dot(cross(t[(i + 1) % 3].exact - t[i].exact, p.exact - t[i].exact), n)) < 0) return false;
    const Number height = dot(p.exact - t[0].exact, n);
    return height * height < squared_ * all;
  }

  double distance_;
  ExactTriangle s_, t_;
  Number squared_;
};

}  // namespace

bool are_apart(const Triangle& s, const Triangle& t, double distance) {
  if (distance == 0) return true;
  const TriangleDistance bounds = triangle_distance(s, t);
  if (bounds.lower >= distance) return true;
  if (bounds.upper < distance) return false;
  return !pierces(s, t) && !pierces(t, s) && !Nearer(s, t, distance).any();
}

}  // namespace prohull
