#include "prohull/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/directions.h"
#include "geometry/no_index.h"
#include "geometry/triangle_predicates.h"
#include "prohull/detail/finite.h"

namespace prohull {
namespace {

struct HullFace {
  std::array<VertexId, 3> corners;
  std::array<std::uint32_t, 3> beyond;  ///< the face beyond the edge from corner i to corner i + 1
  std::vector<VertexId> outside;        ///< points outside of this face, each noted at one face only
  bool is_gone = false;
  std::uint32_t seen = 0;  ///< by which point, counted from 1
};

class Quickhull {
 public:
  explicit Quickhull(const TriangleMesh& mesh) : mesh_(mesh), next_at_(mesh.vertex_count(), kNone) {}

  TriangleMesh run() {
    if (!begin()) return {};
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      while (!faces_[f].is_gone && !faces_[f].outside.empty()) add(farthest(f), f);
    TriangleMesh hull;
    PerVertex<VertexId> number(mesh_.vertex_count(), VertexId{kNone});
    for (const HullFace& face : faces_) {
      if (face.is_gone) continue;
      std::array<VertexId, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        VertexId& known = number[face.corners[i]];
        if (known == VertexId{kNone}) known = hull.positions.push_back(at(face.corners[i]));
        corners[i] = known;
      }
      hull.triangles.push_back(corners);
    }
    return hull;
  }

 private:
  const Vec3& at(VertexId v) const { return mesh_.positions[v]; }
  Side side_of(const HullFace& face, VertexId v) const {
    return side(at(face.corners[0]), at(face.corners[1]), at(face.corners[2]), at(v));
  }

  /// A tetrahedron of four points that are not in a plane; false if there are none.
  bool begin() {
    std::vector<VertexId> points;
    PerVertex<char> is_used(mesh_.vertex_count());
    for (const auto& t : mesh_.triangles)
      for (const VertexId v : t) is_used[v] = 1;
    for (const VertexId v : mesh_.positions.ids())
      if (is_used[v]) points.push_back(v);
    if (points.empty()) return false;
    // The farthest of them, or any that will do where rounding hides which these are.
    const auto most = [&](auto&& measure, auto&& will_do) -> std::optional<VertexId> {
      if (const VertexId v = *std::ranges::max_element(points, {}, measure); will_do(v)) return v;
      const auto found = std::ranges::find_if(points, will_do);
      return found == points.end() ? std::nullopt : std::optional(*found);
    };
    const VertexId a = *std::ranges::min_element(points, {}, [&](VertexId v) { return at(v).x; });
    const auto b =
        most([&](VertexId v) { return squared_norm(at(v) - at(a)); }, [&](VertexId v) { return at(v) != at(a); });
    if (!b) return false;
    const auto c = most([&](VertexId v) { return squared_norm(cross(at(v) - at(a), at(*b) - at(a))); },
                        [&](VertexId v) {
                          return projection_axis({at(a), at(*b), at(v)}).has_value();
                        });
    if (!c) return false;
    const Vec3 normal = cross(at(*b) - at(a), at(*c) - at(a));
    const auto side_of_all = [&](VertexId v) { return side(at(a), at(*b), at(*c), at(v)); };
    const auto d = most([&](VertexId v) { return std::abs(dot(at(v) - at(a), normal)); },
                        [&](VertexId v) { return side_of_all(v) != Side::On; });
    if (!d) return false;
    const auto [p, q] = side_of_all(*d) == Side::Inside ? std::pair(*b, *c) : std::pair(*c, *b);
    faces_.push_back({{a, p, q}, {1, 2, 3}, {}});
    faces_.push_back({{p, a, *d}, {0, 3, 2}, {}});
    faces_.push_back({{q, p, *d}, {0, 1, 3}, {}});
    faces_.push_back({{a, q, *d}, {0, 2, 1}, {}});
    for (const VertexId v : points)
      if (v != a && v != *b && v != *c && v != *d) note(v, 0, faces_.size());
    return true;
  }

  /// At the first of the faces [from, to) that it is outside of.
  void note(VertexId v, std::size_t from, std::size_t to) {
    for (std::size_t f = from; f < to; ++f)
      if (side_of(faces_[f], v) == Side::Outside) return faces_[f].outside.push_back(v);
  }

  VertexId farthest(std::uint32_t f) const {
    const auto& [a, b, c] = faces_[f].corners;
    const Vec3 origin = at(a), normal = cross(at(b) - origin, at(c) - origin);
    return *std::ranges::max_element(faces_[f].outside, {}, [&](VertexId v) { return dot(at(v) - origin, normal); });
  }

  /// Replaces the faces that see v, or that lie in a plane with it and are connected to those, by a fan around v. So no
  /// face of the fan is without area: v is on no plane beyond the horizon.
  void add(VertexId v, std::uint32_t visible) {
    ++points_;
    std::vector<std::uint32_t> gone{visible};
    faces_[visible].seen = points_;
    std::vector<VertexId> homeless;
    const auto first_new = static_cast<std::uint32_t>(faces_.size());
    for (std::size_t i = 0; i < gone.size(); ++i) {
      for (const std::uint32_t g : faces_[gone[i]].beyond)
        if (faces_[g].seen != points_ && side_of(faces_[g], v) != Side::Inside) {
          faces_[g].seen = points_;
          gone.push_back(g);
        }
    }
    for (const std::uint32_t f : gone) {
      faces_[f].is_gone = true;
      homeless.insert(homeless.end(), faces_[f].outside.begin(), faces_[f].outside.end());
      faces_[f].outside = {};
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t g = faces_[f].beyond[e];
        if (faces_[g].seen == points_) continue;
        const VertexId from = faces_[f].corners[e], to = faces_[f].corners[(e + 1) % 3];
        const auto fresh = static_cast<std::uint32_t>(faces_.size());
        next_at_[from] = fresh;
        const auto back = std::ranges::find(faces_[g].corners, to) - faces_[g].corners.begin();
        faces_[g].beyond[static_cast<std::size_t>(back)] = fresh;
        faces_.push_back({{from, to, v}, {g, kNone, kNone}, {}});
      }
    }
    for (auto f = first_new; f < faces_.size(); ++f) {
      const std::uint32_t next = next_at_[faces_[f].corners[1]];
      faces_[f].beyond[1] = next;
      faces_[next].beyond[2] = f;
    }
    for (const VertexId p : homeless)
      if (p != v) note(p, first_new, faces_.size());
  }

  const TriangleMesh& mesh_;
  std::vector<HullFace> faces_;
  PerVertex<std::uint32_t> next_at_;  ///< of the horizon: the new face whose edge begins at the vertex
  std::uint32_t points_ = 0;
};

/// The corners of a polyhedron around the ball of radius 1.
std::vector<Vec3> ball_corners(std::size_t count) {
  std::vector<Vec3> corners = spread_directions(count);
  TriangleMesh inscribed;
  inscribed.positions = PerVertex<Vec3>(corners);
  for (std::uint32_t i = 2; i < count; ++i) inscribed.triangles.push_back({VertexId{0}, VertexId{i - 1}, VertexId{i}});
  double radius = 1;
  const TriangleMesh hull = convex_hull(inscribed);
  for (const FaceId f : hull.triangles.ids()) {
    const Triangle t = hull.triangle(f);
    const Vec3 n = cross(t.b - t.a, t.c - t.a);
    radius = std::min(radius, dot(n, t.a) / norm(n));
  }
  for (Vec3& p : corners) p = p / radius;
  return corners;
}

/// The convex hull of all sums of a vertex that triangles use and an offset.
TriangleMesh convex_hull_of_sums(const TriangleMesh& mesh, const std::vector<Vec3>& offsets, double scale) {
  TriangleMesh sums;
  for (const Vec3& p : without_unused_vertices(mesh).positions)
    for (const Vec3& offset : offsets) sums.positions.push_back(p + offset * scale);
  for (std::uint32_t i = 2; i < sums.vertex_count(); ++i)
    sums.triangles.push_back({VertexId{0}, VertexId{i - 1}, VertexId{i}});
  return convex_hull(sums);
}

}  // namespace

TriangleMesh convex_hull(const TriangleMesh& mesh) { return Quickhull(mesh).run(); }

TriangleMesh slab_around(const TriangleMesh& mesh, double distance) {
  std::vector<Vec3> corners;
  for (const double x : {-1., 1.})
    for (const double y : {-1., 1.})
      for (const double z : {-1., 1.}) corners.push_back({x, y, z});
  const TriangleMesh convex = convex_hull(mesh);
  return convex_hull_of_sums(convex.face_count() > 0 ? convex : mesh, corners, distance);
}

TriangleMesh padded_convex_hull(const TriangleMesh& mesh, double distance) {
  constexpr int kCorners = 96, kFewCorners = 6;
  constexpr double kThin = 0.01;  // in distances: thickness given to what is flat
  TriangleMesh core = convex_hull(mesh);
  if (core.face_count() == 0) core = convex_hull_of_sums(mesh, ball_corners(kFewCorners), kThin * distance);
  return convex_hull_of_sums(core, ball_corners(kCorners), distance);
}

}  // namespace prohull
