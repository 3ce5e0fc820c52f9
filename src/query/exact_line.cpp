#include "query/exact_line.h"

#include <CGAL/Gmpq.h>

#include <array>

namespace prohull {
namespace {

using Number = CGAL::Gmpq;
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
    if (const int sign = int(CGAL::sign(g)); sign != 0) return sign;
  return 0;
}

struct Plane {
  Plane(const DirectedLine& line, const Triangle& face) : normal(prohull::normal(face)) {
    const Number speed = dot(normal, direction(line));
    t = dot(normal, between(line.origin, face.a)) / speed;
    normal = scaled(normal, 1 / speed);
  }
  Vector normal;  ///< of the length that dot(normal, direction) = 1
  Number t;
};

}  // namespace

int exact_edge_sign(const DirectedLine& line, const Vec3& p, const Vec3& q) {
  const Vector d = direction(line);
  if (const int sign = int(CGAL::sign(dot(d, cross(between(line.origin, p), between(line.origin, q))))); sign != 0)
    return sign;
  return sign_of_move(cross(d, between(p, q)));
}

int exact_point_sign(const Vec3& point, const Triangle& face) {
  const Vector n = normal(face);
  if (const int sign = int(CGAL::sign(dot(n, between(point, face.a)))); sign != 0) return sign;
  return -sign_of_move(n);
}

int exact_order(const DirectedLine& line, const Triangle& first, const Triangle& second) {
  const Plane one(line, first), other(line, second);
  if (const int sign = int(CGAL::sign(one.t - other.t)); sign != 0) return sign;
  return -sign_of_move(one.normal - other.normal);
}

double exact_parameter(const DirectedLine& line, const Triangle& face) { return CGAL::to_double(Plane(line, face).t); }

}  // namespace prohull
