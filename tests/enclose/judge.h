#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "prohull/detail/shapes.h"
#include "prohull/triangle_mesh.h"
#include "verify/exact_kernel.h"

namespace prohull::oracle {

// Plain definitions in exact numbers, to contradict what the library says of its products. Shares nothing with src/.

using Vector = Exact::Vector_3;
using Number = Exact::FT;
using ExactTriangle = std::array<Point, 3>;

inline Number determinant(const Vector& a, const Vector& b, const Vector& c) { return CGAL::determinant(a, b, c); }

inline Number squared_distance(const Point& x, const Point& a, const Point& b) {
  const Vector along = b - a, from = x - a;
  const Number t = along * from, whole = along.squared_length();
  if (t <= 0) return from.squared_length();
  if (t >= whole) return (x - b).squared_length();
  return from.squared_length() - t * t / whole;
}

/// Of a segment or a point too, where the corners are on a line.
inline Number squared_distance(const Point& x, const ExactTriangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector normal = CGAL::cross_product(b - a, c - a);
  const auto is_left = [&](const Point& p, const Point& q) { return determinant(normal, q - p, x - p) >= 0; };
  if (normal != CGAL::NULL_VECTOR && is_left(a, b) && is_left(b, c) && is_left(c, a)) {
    const Number height = normal * (x - a);
    return height * height / normal.squared_length();
  }
  return std::min({squared_distance(x, a, b), squared_distance(x, b, c), squared_distance(x, c, a)});
}

/// None unless the lines are nearest to each other within both segments.
inline std::optional<Number> squared_distance_between(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector u = b - a, v = d - c, w = a - c;
  const Number uu = u * u, uv = u * v, vv = v * v, uw = u * w, vw = v * w, whole = uu * vv - uv * uv;
  if (whole == 0) return std::nullopt;
  const Number s = uv * vw - vv * uw, t = uu * vw - uv * uw;
  if (s < 0 || t < 0 || s > whole || t > whole) return std::nullopt;
  return (w + u * (s / whole) - v * (t / whole)).squared_length();
}

inline bool pierces(const Point& p, const Point& q, const ExactTriangle& triangle) {
  const auto& [a, b, c] = triangle;
  if (CGAL::orientation(a, b, c, p) * CGAL::orientation(a, b, c, q) >= 0) return false;
  const int s = CGAL::orientation(p, q, a, b), t = CGAL::orientation(p, q, b, c), u = CGAL::orientation(p, q, c, a);
  return s * t >= 0 && t * u >= 0 && s * u >= 0;
}

inline Number squared_distance(const ExactTriangle& s, const ExactTriangle& t) {
  Number least = squared_distance(s[0], t);
  for (int i = 0; i < 3; ++i) {
    least = std::min({least, squared_distance(s[i], t), squared_distance(t[i], s)});
    if (pierces(s[i], s[(i + 1) % 3], t) || pierces(t[i], t[(i + 1) % 3], s)) return 0;
    for (int j = 0; j < 3; ++j)
      if (const auto d = squared_distance_between(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]))
        least = std::min(least, *d);
  }
  return least;
}

inline bool contains(const Ball& ball, const Point& x) {
  return (x - exact(ball.center)).squared_length() <= Number(ball.radius) * Number(ball.radius);
}

/// The finite triangles of a mesh.
class Judge {
 public:
  explicit Judge(const TriangleMesh& mesh) {
    std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> edges;
    for (const FaceId f : mesh.triangles.ids()) {
      const Triangle t = mesh.triangle(f);
      if (!is_finite(t.a) || !is_finite(t.b) || !is_finite(t.c)) continue;
      faces_.push_back({exact(t.a), exact(t.b), exact(t.c)});
      for (const auto& [p, q] : {std::pair{t.a, t.b}, {t.b, t.c}, {t.c, t.a}}) {
        const std::array from{p.x + 0.0, p.y + 0.0, p.z + 0.0}, to{q.x + 0.0, q.y + 0.0, q.z + 0.0};  // no -0
        from < to ? ++edges[{from, to}] : --edges[{to, from}];
        if (from == to) edges.erase({to, from});
      }
    }
    is_closed_ = std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
  }

  std::span<const ExactTriangle> faces() const { return faces_; }
  /// As many faces run one way along each edge as the other way.
  bool is_closed() const { return is_closed_; }

  Number volume_times_six() const {
    Number sum = 0;
    for (const auto& [a, b, c] : faces_) sum += determinant(a - faces_[0][0], b - faces_[0][0], c - faces_[0][0]);
    return sum;
  }

  /// Around all points x + t d with a small t > 0. None if the ray meets an edge.
  std::optional<int> winding_beside(const Point& x, const Vector& d) const {
    int sum = 0;
    for (const ExactTriangle& face : faces_) {
      const Vector a = face[0] - x, b = face[1] - x, c = face[2] - x;
      const int s = CGAL::sign(determinant(d, a, b)), t = CGAL::sign(determinant(d, b, c));
      if (s * t < 0) continue;
      const int u = CGAL::sign(determinant(d, c, a));
      if (s * u < 0 || t * u < 0) continue;
      const Vector normal = CGAL::cross_product(b - a, c - a);
      if (normal == CGAL::NULL_VECTOR) continue;
      const int height = CGAL::sign(normal * a), slope = CGAL::sign(normal * d);
      if (slope == 0 || (height != 0 && (s == 0 || t == 0 || u == 0))) return std::nullopt;
      if (height == slope) sum += slope;
    }
    return sum;
  }

  /// None on the surface.
  template <class Random>
  std::optional<int> winding_number(const Point& x, Random& random) const {
    if (std::ranges::any_of(faces_, [&](const ExactTriangle& t) { return is_on(x, t); })) return std::nullopt;
    for (;;)
      if (const auto number = winding_beside(x, any_direction(random))) return number;
  }

  /// Whether x is in the closure of what the mesh winds around at least once. None if that takes too long.
  template <class Random>
  std::optional<bool> covers(const Point& x, Random& random) const {
    std::vector<Vector> normals;
    for (const ExactTriangle& t : faces_) {
      const Vector n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
      if (n == CGAL::NULL_VECTOR || !is_on(x, t)) continue;
      if (std::ranges::none_of(normals,
                               [&](const Vector& m) { return CGAL::cross_product(m, n) == CGAL::NULL_VECTOR; }))
        normals.push_back(n);
    }
    for (int sides_seen = 0; sides_seen < (normals.empty() ? 1 : 32);) {
      const auto number = winding_beside(x, any_direction(random));
      if (number >= 1) return true;
      if (number) ++sides_seen;
    }
    if (normals.size() <= 1) return false;
    if (normals.size() > 5) return std::nullopt;
    bool is_certain = true;
    for (const Vector& d : directions_between(normals)) {
      const auto number = winding_near(x, d, normals, random);
      if (number >= 1) return true;
      is_certain = is_certain && number;
    }
    return is_certain ? std::optional(false) : std::nullopt;
  }

  bool is_within(const Point& x, const Number& squared) const {
    return std::ranges::any_of(faces_, [&](const ExactTriangle& t) { return squared_distance(x, t) <= squared; });
  }

  Number squared_distance_to(const ExactTriangle& triangle) const {
    Number least = squared_distance(triangle, faces_.front());
    for (const ExactTriangle& t : faces_) least = std::min(least, squared_distance(triangle, t));
    return least;
  }

  /// No face has x on its outer side.
  bool has_within_planes(const Point& x) const {
    return std::ranges::none_of(
        faces_, [&](const ExactTriangle& t) { return CGAL::orientation(t[0], t[1], t[2], x) == CGAL::POSITIVE; });
  }

  /// Corners, middles of edges and points within; of some faces, if there are many.
  template <class Random>
  std::vector<Point> points_on_faces(Random& random, std::size_t most_faces = 40) const {
    std::vector<Point> points;
    std::uniform_int_distribution<std::size_t> any(0, faces_.size() - 1);
    std::uniform_int_distribution<int> weight(1, 1000);
    for (std::size_t i = 0; i < std::min(faces_.size(), most_faces); ++i) {
      const auto& [a, b, c] = faces_[faces_.size() <= most_faces ? i : any(random)];
      points.insert(points.end(), {a, CGAL::midpoint(a, b), CGAL::midpoint(b, c)});
      for (int k = 0; k < 2; ++k)
        points.push_back(CGAL::barycenter(a, weight(random), b, weight(random), c, weight(random)));
    }
    return points;
  }

 private:
  static bool is_on(const Point& x, const ExactTriangle& triangle) {
    return CGAL::coplanar(triangle[0], triangle[1], triangle[2], x) && squared_distance(x, triangle) == 0;
  }

  /// In the cone of d between planes through x.
  template <class Random>
  std::optional<int> winding_near(const Point& x, const Vector& d, const std::vector<Vector>& normals,
                                  Random& random) const {
    const Number hair = (CGAL::abs(d.x()) + CGAL::abs(d.y()) + CGAL::abs(d.z())) / 1e12;
    for (int tries = 0; tries < 8; ++tries) {
      const Vector aside = d + any_direction(random) * hair;
      if (std::ranges::any_of(normals, [&](const Vector& n) { return CGAL::sign(n * d) != CGAL::sign(n * aside); }))
        continue;
      if (const auto number = winding_beside(x, aside)) return number;
    }
    return std::nullopt;
  }

  template <class Random>
  static Vector any_direction(Random& random) {
    std::uniform_int_distribution<int> coordinate(-9973, 9973);
    return Vector(coordinate(random), coordinate(random), coordinate(random));
  }

  std::vector<ExactTriangle> faces_;
  bool is_closed_ = false;
};

}  // namespace prohull::oracle
