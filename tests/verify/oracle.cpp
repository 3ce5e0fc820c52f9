#include "verify/oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <utility>

#include "verify/exact_kernel.h"

namespace prohull::oracle {

struct Faces {
  std::vector<std::array<Point, 3>> triangles;
  std::vector<CGAL::Bbox_3> boxes;
};

namespace {

using Tetrahedron = std::array<Point, 4>;

std::optional<int> winding(const Faces& chain, const Point& apex, const Point& x) {
  int sum = 0;
  for (std::size_t f = 0; f < chain.triangles.size(); ++f) {
    if (!CGAL::do_overlap(chain.boxes[f] + apex.bbox(), x.bbox())) continue;
    const auto& [a, b, c] = chain.triangles[f];
    const int s = CGAL::orientation(apex, a, b, x), t = CGAL::orientation(apex, b, c, x);
    if (s * t < 0) continue;
    const int u = CGAL::orientation(apex, c, a, x);
    if (s * u < 0 || t * u < 0) continue;
    const int cone = CGAL::orientation(a, b, c, apex), base = CGAL::orientation(a, b, c, x);
    if (cone == 0 || cone == -base) continue;
    if (s == cone || t == cone || u == cone) continue;  // in the mirrored cone, behind the apex
    if (s == 0 || t == 0 || u == 0 || base == 0) return std::nullopt;
    sum -= cone;  // an apex inside sees the face clockwise: negative
  }
  return sum;
}

/// Cuts the tetrahedron by the plane: no piece has corners strictly on both sides.
void cut(const Tetrahedron& t, const std::array<Point, 3>& plane, std::vector<Tetrahedron>& pieces) {
  std::array<int, 4> side;
  for (int i = 0; i < 4; ++i) side[i] = CGAL::orientation(plane[0], plane[1], plane[2], t[i]);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      if (side[i] * side[j] < 0) {
        const auto height = [&](const Point& p) {
          return CGAL::determinant(plane[1] - plane[0], plane[2] - plane[0], p - plane[0]);
        };
        const auto hi = height(t[i]), hj = height(t[j]);
        const Point x = t[i] + (t[j] - t[i]) * (hi / (hi - hj));
        for (const int replaced : {i, j}) {
          Tetrahedron half = t;
          half[replaced] = x;
          cut(half, plane, pieces);
        }
        return;
      }
  pieces.push_back(t);
}

Point random_point_in(const Tetrahedron& t, std::mt19937& random) {
  std::uniform_int_distribution<int> weight(100, 1000);
  const int w[] = {weight(random), weight(random), weight(random), weight(random)};
  return CGAL::barycenter(t[0], w[0], t[1], w[1], t[2], w[2], t[3], w[3]);
}

/// Cuts the pieces by the planes of the chain's faces, where those are near.
std::vector<Tetrahedron> cut(std::vector<Tetrahedron> pieces, const Faces& chain) {
  for (std::size_t f = 0; f < chain.triangles.size(); ++f) {
    const auto& plane = chain.triangles[f];
    if (CGAL::collinear(plane[0], plane[1], plane[2])) continue;
    std::vector<Tetrahedron> smaller;
    for (const Tetrahedron& t : pieces) {
      const CGAL::Bbox_3 box = t[0].bbox() + t[1].bbox() + t[2].bbox() + t[3].bbox();
      if (CGAL::do_overlap(box, chain.boxes[f]))
        cut(t, plane, smaller);
      else
        smaller.push_back(t);
    }
    pieces = std::move(smaller);
  }
  std::erase_if(pieces, [](const Tetrahedron& t) { return CGAL::coplanar(t[0], t[1], t[2], t[3]); });
  return pieces;
}

/// At any point inside a piece that the chain does not cut.
int winding(const Faces& chain, const Tetrahedron& piece, std::mt19937& random) {
  std::uniform_int_distribution<int> aside(-1000, 1000);
  for (;;) {
    // Far along an axis and only a little aside, so that few cones are near the point.
    const Point apex = piece[0] + Exact::Vector_3(1e-5 * aside(random), 1e-5 * aside(random), 1e4);
    if (const auto w = winding(chain, apex, random_point_in(piece, random))) return *w;
  }
}

/// Whether w_outer >= 1 wherever w_inner >= 1 inside the given tetrahedra.
bool encloses_within(const std::vector<Tetrahedron>& domain, const Faces& inner, const Faces& outer,
                     std::mt19937& random) {
  std::vector<Tetrahedron> solid = cut(domain, inner);
  std::erase_if(solid, [&](const Tetrahedron& t) { return winding(inner, t, random) < 1; });
  const std::vector<Tetrahedron> pieces = cut(solid, outer);
  return std::none_of(pieces.begin(), pieces.end(),
                      [&](const Tetrahedron& t) { return winding(outer, t, random) < 1; });
}

using Polygon = std::vector<Point>;  // convex; a segment or a point where there are two corners or one

class Cover {
 public:
  Cover(const Faces& chain, std::mt19937& random) : chain_(chain), random_(random) {
    for (const auto& [a, b, c] : chain_.triangles)
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

  const Faces& chain_;
  std::vector<Exact::Plane_3> planes_;
  std::vector<CGAL::Bbox_3> boxes_;
  std::mt19937& random_;
};

}  // namespace

Chain::Chain(const TriangleMesh& mesh) {
  Faces faces;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    faces.triangles.push_back({exact(t.a), exact(t.b), exact(t.c)});
    faces.boxes.push_back(exact(t.a).bbox() + exact(t.b).bbox() + exact(t.c).bbox());
  }
  faces_ = std::make_shared<const Faces>(std::move(faces));
}

std::optional<int> Chain::winding(const Vec3& apex, const Vec3& x) const {
  return oracle::winding(*faces_, exact(apex), exact(x));
}

bool Chain::covers(const Triangle& t, std::mt19937& random) const { return Cover(*faces_, random).covers(t); }

bool Chain::is_enclosed_by(const Chain& outer, std::mt19937& random) const {
  std::vector<Tetrahedron> cones;
  const Point apex = faces_->triangles[0][0];
  for (const auto& [a, b, c] : faces_->triangles)
    if (!CGAL::coplanar(a, b, c, apex)) cones.push_back({a, b, c, apex});
  return encloses_within(cones, *faces_, *outer.faces_, random);
}

bool Chain::is_enclosed_by(const Chain& outer, const std::vector<std::array<Vec3, 4>>& within,
                           std::mt19937& random) const {
  std::vector<Tetrahedron> domain;
  for (const auto& [a, b, c, d] : within) domain.push_back({exact(a), exact(b), exact(c), exact(d)});
  return encloses_within(domain, *faces_, *outer.faces_, random);
}

bool contains(const Ball& ball, const Triangle& t, const std::array<double, 3>& weights) {
  const Exact::FT a(weights[0]), b(weights[1]), c(weights[2]), radius(ball.radius);
  const Exact::Vector_3 x =
      a * (exact(t.a) - CGAL::ORIGIN) + b * (exact(t.b) - CGAL::ORIGIN) + c * (exact(t.c) - CGAL::ORIGIN);
  return (x - (exact(ball.center) - CGAL::ORIGIN)).squared_length() <= radius * radius;
}

bool has_area(const Triangle& t) { return !CGAL::collinear(exact(t.a), exact(t.b), exact(t.c)); }

bool are_apart(const Triangle& s, const Triangle& t, double distance) {
  return CGAL::squared_distance(Exact::Triangle_3(exact(s.a), exact(s.b), exact(s.c)),
                                Exact::Triangle_3(exact(t.a), exact(t.b), exact(t.c))) >=
         Exact::FT(distance) * Exact::FT(distance);
}

std::size_t self_intersections(const TriangleMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  std::vector<CGAL::SM_Vertex_index> vertices;
  for (const Vec3& p : mesh.positions) vertices.push_back(surface.add_vertex({p.x, p.y, p.z}));
  for (const auto& [a, b, c] : mesh.triangles)
    surface.add_face(vertices[index(a)], vertices[index(b)], vertices[index(c)]);
  std::vector<std::pair<CGAL::SM_Face_index, CGAL::SM_Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(pairs));
  return pairs.size();
}

TriangleMesh convex_hull(const TriangleMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  CGAL::convex_hull_3(points.begin(), points.end(), surface);
  TriangleMesh hull;
  for (const auto v : surface.vertices())
    hull.positions.push_back({surface.point(v).x(), surface.point(v).y(), surface.point(v).z()});
  for (const auto f : surface.faces()) {
    std::vector<VertexId> corners;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) corners.push_back(VertexId(v.idx()));
    hull.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return hull;
}

}  // namespace prohull::oracle
