#include "geometry/triangle_gap.h"

#include <array>

#include "geometry/exact_number.h"
#include "geometry/predicates.h"
#include "geometry/triangle_distance.h"
#include "geometry/vector_of.h"

namespace prohull {
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
