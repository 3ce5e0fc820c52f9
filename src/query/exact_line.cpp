#include "query/exact_line.h"

#include "geometry/exact_number.h"
#include "geometry/vector_of.h"

namespace prohull {
namespace {

using Number = ExactNumber;
using Vector = VectorOf<Number>;

Vector scaled(const Vector& a, const Number& s) { return {a[0] * s, a[1] * s, a[2] * s}; }

Vector direction(const DirectedLine& line) {
  return line.is_ray() ? between<Number>({}, line.direction) : between<Number>(line.origin, line.end);
}

Vector normal(const Triangle& face) { return cross(between<Number>(face.a, face.b), between<Number>(face.a, face.c)); }

/// Of the change that the move (e, e^2, e^3) makes to something linear with that gradient.
int sign_of_move(const Vector& gradient) {
  for (const Number& g : gradient)
    if (const int s = sign(g); s != 0) return s;
  return 0;
}

/// The plane dot(normal, p - face.a) = 0, and the line's origin and direction against it.
struct Plane {
  Plane(const DirectedLine& line, const Triangle& face)
      : normal(prohull::normal(face)),
        speed(dot(normal, direction(line))),
        above(dot(normal, between<Number>(line.origin, face.a))) {}
  Vector normal;
  Number speed, above;  ///< t = above / speed
};

}  // namespace

int exact_edge_sign(const DirectedLine& line, const Vec3& p, const Vec3& q) {
  return sign(dot(direction(line), cross(between<Number>(line.origin, p), between<Number>(line.origin, q))));
}

int exact_point_sign(const Vec3& point, const Triangle& face) {
  return sign(dot(normal(face), between<Number>(point, face.a)));
}

int exact_minor_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return sign((Number(b[i]) - Number(a[i])) * (Number(d[j]) - Number(c[j])) -
              (Number(b[j]) - Number(a[j])) * (Number(d[i]) - Number(c[i])));
}

int exact_order(const DirectedLine& line, const Triangle& first, const Triangle& second) {
  const Plane one(line, first), other(line, second);
  const int speeds = sign(one.speed) * sign(other.speed);
  if (const int s = sign(one.above * other.speed - other.above * one.speed); s != 0) return s * speeds;
  // dot(normal, move) / speed is what the move takes from t.
  return -speeds * sign_of_move(scaled(one.normal, other.speed) - scaled(other.normal, one.speed));
}

double exact_parameter(const DirectedLine& line, const Triangle& face) {
  const Plane plane(line, face);
  return (Rational(plane.above) / Rational(plane.speed)).rounded();
}

Vec3 exact_crossing_point(const DirectedLine& line, const Triangle& face) {
  const Plane plane(line, face);
  const Vector way = scaled(direction(line), plane.above);
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis)
    point[axis] = (Rational(Number(line.origin[axis]) * plane.speed + way[axis]) / Rational(plane.speed)).rounded();
  return point;
}

}  // namespace prohull
