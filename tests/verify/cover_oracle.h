#pragma once

#include <algorithm>
#include <vector>

#include "verify/oracle.h"

namespace prohull::oracle {

// Decides by brute force, and by other means than src/verify, whether a chain covers a triangle: the triangle is cut by
// all planes around, and near one point of each piece every region is looked at that the planes leave.

using Polygon = std::vector<Point>;  // convex; a segment or a point where there are two corners or one

class Cover {
 public:
  Cover(const TriangleMesh& outer, std::mt19937& random) : chain_(outer), random_(random) {
    for (const auto& [a, b, c] : chain_.faces)
      if (!CGAL::collinear(a, b, c)) {
        planes_.emplace_back(a, b, c);
        boxes_.push_back(a.bbox() + b.bbox() + c.bbox());
      }
  }

  bool covers(const Triangle& t) const {
    const Point a = exact(t.a), b = exact(t.b), c = exact(t.c);
    Polygon all{a, b, c};
    if (CGAL::collinear(a, b, c)) {
      const auto [least, greatest] = std::minmax({a, b, c});
      all = least == greatest ? Polygon{least} : Polygon{least, greatest};
    }
    const CGAL::Bbox_3 box = a.bbox() + b.bbox() + c.bbox();
    std::vector<Polygon> pieces{all};
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (CGAL::do_overlap(box, boxes_[i])) cut(pieces, planes_[i]);
    return std::all_of(pieces.begin(), pieces.end(), [&](const Polygon& piece) { return is_covered(middle(piece)); });
  }

 private:
  using Vector = Exact::Vector_3;
  using Number = Exact::FT;

  static Number height(const Exact::Plane_3& plane, const Point& p) {
    return plane.a() * p.x() + plane.b() * p.y() + plane.c() * p.z() + plane.d();
  }

  static void cut(std::vector<Polygon>& pieces, const Exact::Plane_3& plane) {
    std::vector<Polygon> smaller;
    for (const Polygon& piece : pieces) {
      Polygon above, below;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const Point &p = piece[i], &q = piece[(i + 1) % piece.size()];
        const Number here = height(plane, p), next = height(plane, q);
        if (here >= 0) above.push_back(p);
        if (here <= 0) below.push_back(p);
        if (here * next < 0 && (piece.size() > 2 || i == 0)) {
          const Point x = p + (q - p) * (here / (here - next));
          above.push_back(x);
          below.push_back(x);
        }
      }
      const bool is_cut =
          std::any_of(piece.begin(), piece.end(), [&](const Point& p) { return height(plane, p) > 0; }) &&
          std::any_of(piece.begin(), piece.end(), [&](const Point& p) { return height(plane, p) < 0; });
      if (is_cut) {
        smaller.push_back(above);
        smaller.push_back(below);
      } else {
        smaller.push_back(piece);
      }
    }
    pieces = std::move(smaller);
  }

  Point middle(const Polygon& piece) const {
    std::uniform_int_distribution<int> weights(100, 1000);
    Vector sum(0, 0, 0);
    Number total(0);
    for (const Point& p : piece) {
      const int weight = weights(random_);
      sum = sum + (p - CGAL::ORIGIN) * Number(weight);
      total += weight;
    }
    return CGAL::ORIGIN + sum / total;
  }

  /// Whether a region with a winding number of at least 1 has p in its closure.
  bool is_covered(const Point& p) const {
    std::vector<Vector> normals;
    for (const Exact::Plane_3& plane : planes_) {
      if (height(plane, p) != 0) continue;
      const Vector n = plane.orthogonal_vector();
      if (std::none_of(normals.begin(), normals.end(),
                       [&](const Vector& m) { return CGAL::cross_product(m, n) == CGAL::NULL_VECTOR; }))
        normals.push_back(n);
    }
    if (normals.empty()) return winding_around(p) >= 1;
    const std::vector<Vector> directions = directions_between(normals);
    return std::any_of(directions.begin(), directions.end(),
                       [&](const Vector& d) { return winding_around(p + d * step(p, d)) >= 1; });
  }

  /// So far that no plane is reached but those through p.
  Number step(const Point& p, const Vector& d) const {
    Number least(1);
    for (const Exact::Plane_3& plane : planes_) {
      const Number from = height(plane, p), by = plane.orthogonal_vector() * d;
      if (from != 0 && by != 0) least = std::min(least, Number(CGAL::abs(from / by) / 2));
    }
    return least;
  }

  int winding_around(const Point& p) const {
    std::uniform_int_distribution<int> aside(-1000, 1000);
    for (;;)
      if (const auto w = winding(chain_, Point(aside(random_), aside(random_), 1e4), p)) return *w;
  }

  Chain chain_;
  std::vector<Exact::Plane_3> planes_;
  std::vector<CGAL::Bbox_3> boxes_;
  std::mt19937& random_;
};

}  // namespace prohull::oracle
