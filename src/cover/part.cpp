#include "cover/part.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "cover/polytope.h"
#include "geometry/directions.h"
#include "geometry/no_index.h"

namespace prohull::cover {
namespace {

/// The part of a segment that is not above a plane.
bool clip(Segment& s, const Plane& plane) {
  const double a = plane.height(s.a), b = plane.height(s.b);
  if (a > 0 && b > 0) return false;
  if (a > 0) s.a = crossing(s.a, s.b, a, b);
  if (b > 0) s.b = crossing(s.a, s.b, a, b);
  return true;
}

bool clip(Segment& s, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 normal{};
    normal[axis] = 1;
    if (!clip(s, Plane{normal, box.max[axis]}) || !clip(s, Plane{-normal, -box.min[axis]})) return false;
  }
  return true;
}

/// The cell on the side of the plane that its normal looks away from.
Cell below(const Cell& cell, const Plane& plane, const Box& box) {
  Cell result;
  result.planes = cell.planes;
  result.planes.push_back(plane);
  for (Segment s : cell.edges)
    if (clip(s, plane)) result.edges.push_back(s);
  const double reach = box.diagonal() + norm(box.center());
  for (const Plane& other : cell.planes) {
    const Vec3 direction = cross(plane.normal, other.normal);
    const double sine2 = squared_norm(direction);
    if (sine2 < 1e-12) continue;
    const Vec3 point =
        (cross(other.normal, direction) * plane.offset + cross(direction, plane.normal) * other.offset) / sine2;
    const Vec3 along = direction * (2 * reach / std::sqrt(sine2));
    Segment s{point - along, point + along};
    bool meets = clip(s, box);
    for (const Plane& bound : cell.planes) meets = meets && (&bound == &other || clip(s, bound));
    if (meets) result.edges.push_back(s);
  }
  return result;
}

/// Adds the triangles, and the vertices that they use.
void append_used(TriangleMesh& surface, const TriangleMesh& mesh) {
  PerVertex<VertexId> number(mesh.vertex_count(), VertexId{kNone});
  for (auto t : mesh.triangles) {
    for (VertexId& v : t) {
      if (number[v] == VertexId{kNone}) number[v] = surface.positions.push_back(mesh.positions[v]);
      v = number[v];
    }
    surface.triangles.push_back(t);
  }
}

/// Collects the points and polygons of one side.
class Half {
 public:
  explicit Half(std::size_t points) : number_(points, kNone) {}

  void add_corner(const Part& part, std::uint32_t v) {
    if (number_[v] == kNone) {
      number_[v] = static_cast<std::uint32_t>(result.points.size());
      result.points.push_back(part.points[v]);
    }
    add(number_[v]);
  }
  void add(std::uint32_t corner) { result.corners.push_back(corner); }
  void end_polygon() {
    const std::uint32_t last = result.ends.empty() ? 0 : result.ends.back();
    if (result.corners.size() == last) return;
    result.ends.push_back(static_cast<std::uint32_t>(result.corners.size()));
  }

  bool has(std::uint32_t v) const { return number_[v] != kNone; }

  Part result;

 private:
  std::vector<std::uint32_t> number_;
};

}  // namespace

Solid::Solid(const TriangleMesh& faces, const TriangleMesh& closed, double tolerance) : index_(closed) {
  append_used(surface_, faces);
  box_ = bounding_box(surface_);
  set_tolerance(tolerance);
}

bool Solid::contains(const Vec3& p) const {
  if (index_.face_count() == 0) return false;
  MeshQuery query(index_);
  return query.contains(p) || query.closest_point(p, tolerance_);
}

Part whole(const Solid& solid) {
  Part part;
  for (const VertexId v : solid.surface().positions.ids()) part.points.push_back(solid.surface().positions[v]);
  for (const auto& t : solid.surface().triangles) {
    for (const VertexId v : t) part.corners.push_back(static_cast<std::uint32_t>(index(v)));
    part.ends.push_back(static_cast<std::uint32_t>(part.corners.size()));
  }
  return part;
}

namespace {

/// The closed surface of what a solid has below planes: convex polygons, one after the other.
class ClosedSurface {
 public:
  explicit ClosedSurface(std::span<const verify::BoundaryPiece> boundary) {
    for (const auto& [triangle, times] : boundary) {
      corners_.insert(corners_.end(), {triangle.a, triangle.b, triangle.c});
      polygons_.push_back({corners_.size(), times});
    }
  }

  /// Where a polygon leaves the plane's lower side and comes back, its new edge makes a triangle in the plane with one
  /// point that is the same for all: these triangles close the surface.
  void keep_below(const Plane& plane) {
    kept_corners_.clear(), kept_.clear(), across_.clear();
    std::size_t begin = 0;
    for (const auto& [end, times] : polygons_) {
      add_below(plane, std::span(corners_).subspan(begin, end - begin), times);
      begin = end;
    }
    for (const Across& edge : across_) {
      kept_corners_.insert(kept_corners_.end(), {across_[0].left, edge.back, edge.left});
      kept_.push_back({kept_corners_.size(), edge.times});
    }
    corners_.swap(kept_corners_), polygons_.swap(kept_);
  }

  double volume() const {
    double sixfold = 0;
    std::size_t begin = 0;
    for (const auto& [end, times] : polygons_) {
      for (std::size_t i = begin + 2; i < end; ++i)
        sixfold += times * dot(corners_[begin], cross(corners_[i - 1], corners_[i]));
      begin = end;
    }
    return sixfold / 6;
  }

 private:
  struct Polygon {
    std::size_t end;  // of its corners
    int times;
  };
  struct Across {
    Vec3 left, back;
    int times;
  };

  void add_below(const Plane& plane, std::span<const Vec3> polygon, int times) {
    const std::size_t first = kept_corners_.size();
    std::optional<Vec3> left, back;
    double height_b = plane.height(polygon[0]);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
      const double height_a = std::exchange(height_b, plane.height(b));
      if (height_a <= 0) kept_corners_.push_back(a);
      if ((height_a <= 0) == (height_b <= 0)) continue;
      kept_corners_.push_back(crossing(a, b, height_a, height_b));
      (height_a <= 0 ? left : back) = kept_corners_.back();
    }
    if (left && back) across_.push_back({*left, *back, times});
    if (kept_corners_.size() > first) kept_.push_back({kept_corners_.size(), times});
  }

  std::vector<Vec3> corners_, kept_corners_;
  std::vector<Polygon> polygons_, kept_;
  std::vector<Across> across_;  // where polygons leave the lower side and come back
};

}  // namespace

double volume_within(const Cell& cell, std::span<const verify::BoundaryPiece> boundary) {
  ClosedSurface surface(boundary);
  for (const Plane& plane : cell.planes) surface.keep_below(plane);
  return surface.volume();
}

Vec3 area_vector(const Part& part, std::span<const std::uint32_t> polygon) {
  const Vec3& origin = part.points[polygon[0]];
  Vec3 area{};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    area += cross(part.points[polygon[i - 1]] - origin, part.points[polygon[i]] - origin);
  return area;
}

namespace {

/// visit(a, b) for each side of a polygon, with a < b.
template <class Visit>
void visit_sides(const Part& part, Visit visit) {
  for (std::size_t p = 0; p < part.polygon_count(); ++p) {
    const std::span<const std::uint32_t> polygon = part.polygon(p);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto [a, b] = std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]);
      visit(a, b);
    }
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> edges(const Part& part) {
  std::vector<std::uint32_t> places(part.points.size() + 1, 0);  // where the edges of a corner begin, by counting
  visit_sides(part, [&](std::uint32_t a, std::uint32_t) { ++places[a + 1]; });
  std::partial_sum(places.begin(), places.end(), places.begin());
  std::vector<std::array<std::uint32_t, 2>> result(part.corners.size());
  std::vector<std::uint32_t> ends = places;
  visit_sides(part, [&](std::uint32_t a, std::uint32_t b) { result[ends[a]++] = {a, b}; });
  for (std::size_t a = 0; a + 1 < places.size(); ++a)
    std::sort(result.begin() + places[a], result.begin() + places[a + 1]);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<Vec3> new_corners(const Part& part, const Plane& plane, const Solid& solid) {
  std::vector<Vec3> result;
  for (const Segment& s : part.cell.edges) {
    const double a = plane.height(s.a), b = plane.height(s.b);
    if ((a < 0) == (b < 0)) continue;
    const Vec3 p = crossing(s.a, s.b, a, b);
    if (solid.contains(p)) result.push_back(p);
  }
  return result;
}

namespace {

class Cutter {
 public:
  Cutter(const Part& part, const Plane& plane, const Solid& solid)
      : part_(part),
        plane_(plane),
        solid_(solid),
        heights_(part.points.size()),
        lower_(part.points.size()),
        upper_(part.points.size()) {
    std::transform(part.points.begin(), part.points.end(), heights_.begin(),
                   [&](const Vec3& p) { return plane.height(p); });
    visit_sides(part, [&](std::uint32_t a, std::uint32_t b) {
      if (side(a) * side(b) < 0) crossed_.push_back({a, b});
    });
    std::sort(crossed_.begin(), crossed_.end());
    crossed_.erase(std::unique(crossed_.begin(), crossed_.end()), crossed_.end());
    for (const auto& [a, b] : crossed_) {
      const Vec3 p = crossing(part.points[a], part.points[b], heights_[a], heights_[b]);
      lower_.result.points.push_back(p);
      upper_.result.points.push_back(p);
    }
  }

  std::pair<Part, Part> run() {
    for (std::size_t i = 0; i < part_.polygon_count(); ++i) add_polygon(part_.polygon(i));
    for (std::uint32_t v = 0; v < heights_.size(); ++v)
      if (side(v) == 0) add_to_other_side(v);
    for (const Vec3& p : part_.inside) {
      const double height = plane_.height(p);
      if (height <= solid_.tolerance()) lower_.result.inside.push_back(p);
      if (height >= -solid_.tolerance()) upper_.result.inside.push_back(p);
    }
    return {std::move(lower_.result), std::move(upper_.result)};
  }

 private:
  int side(std::uint32_t v) const {
    return heights_[v] > solid_.tolerance() ? 1 : heights_[v] < -solid_.tolerance() ? -1 : 0;
  }

  void add_polygon(std::span<const std::uint32_t> polygon) {
    bool is_below = false, is_above = false;
    for (const std::uint32_t v : polygon) is_below |= side(v)<0, is_above |= side(v)> 0;
    if (!is_below && !is_above) (looks_up(polygon) ? is_below : is_above) = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::uint32_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      if (is_below && side(a) <= 0) lower_.add_corner(part_, a);
      if (is_above && side(a) >= 0) upper_.add_corner(part_, a);
      if (side(a) * side(b) >= 0) continue;
      const std::array<std::uint32_t, 2> key{std::min(a, b), std::max(a, b)};
      const auto number =
          static_cast<std::uint32_t>(std::lower_bound(crossed_.begin(), crossed_.end(), key) - crossed_.begin());
      lower_.add(number);
      upper_.add(number);
    }
    lower_.end_polygon();
    upper_.end_polygon();
  }

  /// A corner on the plane whose polygons all lie on one side of it may still be a corner of what the solid has on the
  /// other side: where an edge of a cell runs along the surface.
  void add_to_other_side(std::uint32_t v) {
    if (lower_.has(v) && !upper_.has(v) && has_solid_beside(v, 1)) upper_.result.inside.push_back(part_.points[v]);
    if (upper_.has(v) && !lower_.has(v) && has_solid_beside(v, -1)) lower_.result.inside.push_back(part_.points[v]);
  }

  bool has_solid_beside(std::uint32_t v, int sign) const {
    static const std::vector<Vec3> directions = spread_directions(48);
    const double step = 1e-4 * solid_.box().diagonal();
    return std::any_of(directions.begin(), directions.end(), [&](const Vec3& d) {
      if (sign * dot(plane_.normal, d) < 0.05) return false;
      const Vec3 p = part_.points[v] + d * step;
      return holds(part_.cell, p) && solid_.contains(p);
    });
  }

  static bool holds(const Cell& cell, const Vec3& p) {
    return std::all_of(cell.planes.begin(), cell.planes.end(),
                       [&](const Plane& plane) { return plane.height(p) <= 0; });
  }

  bool looks_up(std::span<const std::uint32_t> polygon) const {
    return dot(area_vector(part_, polygon), plane_.normal) > 0;
  }

  const Part& part_;
  const Plane& plane_;
  const Solid& solid_;
  std::vector<double> heights_;
  std::vector<std::array<std::uint32_t, 2>> crossed_;
  Half lower_, upper_;
};

}  // namespace

std::pair<Part, Part> cut(const Part& part, const Plane& plane, const Solid& solid) {
  auto [lower, upper] = Cutter(part, plane, solid).run();
  for (const Vec3& p : new_corners(part, plane, solid)) {
    lower.inside.push_back(p);
    upper.inside.push_back(p);
  }
  lower.cell = below(part.cell, plane, solid.box());
  upper.cell = below(part.cell, Plane{-plane.normal, -plane.offset}, solid.box());
  return {std::move(lower), std::move(upper)};
}

std::vector<Vec3> hull_points(const Part& part) {
  std::vector<Vec3> points = part.points;
  points.insert(points.end(), part.inside.begin(), part.inside.end());
  return points;
}

Box box_of(const Part& part) {
  Box box;
  for (const Vec3& p : part.points) box.extend(p);
  return box;
}

double hull_volume(const Part& part) { return signed_volume(convex_hull_of(hull_points(part))); }

}  // namespace prohull::cover
