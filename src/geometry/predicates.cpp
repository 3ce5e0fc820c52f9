#include "geometry/predicates.h"

#include "geometry/exact_number.h"
#include "geometry/interval.h"
#include "geometry/rounded_turn.h"
#include "geometry/vector_of.h"

namespace prohull {
namespace {

template <class Field>
Field side_determinant(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  return dot(between<Field>(a, b), cross(between<Field>(a, c), between<Field>(a, p)));
}

template <class Field>
Field turn_determinant(double au, double av, double bu, double bv, double cu, double cv) {
  const Field u(au), v(av);
  return (Field(bu) - u) * (Field(cv) - v) - (Field(bv) - v) * (Field(cu) - u);
}

}  // namespace

Side exact_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  if (const auto sign = certain_sign(side_determinant<Interval>(a, b, c, p))) return Side(*sign);
  return Side(sign(side_determinant<ExactNumber>(a, b, c, p)));
}

int turn(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (const auto sign = certain_turn(axis, a, b, c)) return *sign;
  if (const auto sign = certain_sign(turn_determinant<Interval>(a[u], a[v], b[u], b[v], c[u], c[v]))) return *sign;
  return sign(turn_determinant<ExactNumber>(a[u], a[v], b[u], b[v], c[u], c[v]));
}

int exact_determinant_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e, const Vec3& f) {
  const auto are_parallel = [](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    return p == q || (p == r && q == s) || (p == s && q == r);
  };
  if (are_parallel(a, b, c, d) || are_parallel(c, d, e, f) || are_parallel(e, f, a, b)) return 0;  // often
  return sign(dot(between<ExactNumber>(a, b), cross(between<ExactNumber>(c, d), between<ExactNumber>(e, f))));
}

}  // namespace prohull
