#include "query/exact_line.h"

#include <array>

#include "geometry/exact_number.h"

namespace prohull {
namespace {

using Number = ExactNumber;
using Vector = std::array<Number, 3>;

Vector between(const Vec3& from, const Vec3& to) {
  return {Number(to.x) - Number(from.x), Number(to.y) - Number(from.y), Number(to.z) - Number(from.z)};
}

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Number dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector scaled(const Vector& a, const Number& s) { return {a[0] * s, a[1] * s, a[2] * s}; }

Vector direction(const DirectedLine& line) {
  return line.is_ray() ? between(Vec3{}, line.direction) : between(line.origin, line.end);
}

Vector normal(const Triangle& face) { return cross(between(face.a, face.b), between(face.a, face.c)); }

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
        above(dot(normal, between(line.origin, face.a))) {}
  Vector normal;
  Number speed, above;  ///< t = above / speed
};

}  // namespace

int exact_edge_sign(const DirectedLine& line, const Vec3& p, const Vec3& q) {
  return sign(dot(direction(line), cross(between(line.origin, p), between(line.origin, q))));
}

int exact_point_sign(const Vec3& point, const Triangle& face) {
  return sign(dot(normal(face), between(point, face.a)));
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

}  // namespace prohull
