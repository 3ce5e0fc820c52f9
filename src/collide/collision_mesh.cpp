#include "collide/collision_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "collide/box_pair.h"
#include "geometry/largest_coordinate.h"
#include "geometry/orientation.h"
#include "geometry/triangle_predicates.h"
#include "prohull/detail/disjoint_sets.h"
#include "prohull/error.h"

namespace prohull {
namespace {

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InputError(Defect::EmptyMesh, "the mesh has no faces: nothing collides with it");
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    if (!is_finite(t.a) || !is_finite(t.b) || !is_finite(t.c))
      throw InputError(Defect::NonFiniteCoordinate,
                       fmt::format("face {} has a coordinate that is not finite; remove it", index(f)));
    triangles.push_back(t);
  }
  require_usable_reach(bounding_box(mesh), "coordinates");
  return triangles;
}

/// Faces in the order of `items`, vertices in the order in which these use them.
TriangleMesh reordered(const TriangleMesh& mesh, std::span<const std::uint32_t> items) {
  constexpr VertexId kNoNumber{0xffffffffu};
  PerVertex<VertexId> number(mesh.vertex_count(), kNoNumber);
  TriangleMesh result;
  result.triangles.reserve(items.size());
  result.positions.reserve(mesh.vertex_count());
  for (const std::uint32_t i : items) {
    auto triangle = mesh.triangles[FaceId(i)];
    for (VertexId& v : triangle) {
      if (number[v] == kNoNumber) number[v] = result.positions.push_back(mesh.positions[v]);
      v = number[v];
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

/// The first of the vertices at each position.
PerVertex<VertexId> first_at_position(const PerVertex<Vec3>& positions) {
  std::vector<VertexId> order;
  for (const VertexId v : positions.ids()) order.push_back(v);
  const auto key = [&](VertexId v) { return std::tie(positions[v].x, positions[v].y, positions[v].z); };
  std::ranges::sort(order, [&](VertexId v, VertexId w) { return key(v) != key(w) ? key(v) < key(w) : v < w; });
  PerVertex<VertexId> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && key(order[i - 1]) == key(order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

/// The parts whose faces are connected by vertices, matched by position.
DisjointSets connected_vertices(const TriangleMesh& mesh) {
  const PerVertex<VertexId> first = first_at_position(mesh.positions);
  DisjointSets connected(mesh.vertex_count());
  for (const VertexId v : mesh.positions.ids()) connected.join(index(v), index(first[v]));
  for (const auto& corners : mesh.triangles)
    for (const VertexId v : corners) connected.join(index(corners[0]), index(v));
  return connected;
}

/// Of a closed mesh: whether each of its parts has a negative volume. Exact.
bool is_inside_out(const TriangleMesh& mesh) {
  const auto triangle = [&](std::size_t f) { return mesh.triangle(FaceId(static_cast<std::uint32_t>(f))); };
  if (volume_sign(mesh.face_count(), triangle) >= 0) return false;
  DisjointSets connected = connected_vertices(mesh);
  PerVertex<std::vector<Triangle>> parts(mesh.vertex_count());
  for (const FaceId f : mesh.triangles.ids())
    parts[VertexId(connected.find(index(mesh.triangles[f][0])))].push_back(mesh.triangle(f));
  return std::ranges::all_of(parts, [](const auto& part) { return part.empty() || volume_sign(part) < 0; });
}

/// The first and the last vertex of each component, by x, y and z.
std::vector<Segment> component_ends_of(const TriangleMesh& mesh) {
  DisjointSets connected = connected_vertices(mesh);
  PerVertex<Segment> ends(mesh.vertex_count());
  for (const VertexId v : mesh.positions.ids()) ends[v] = {mesh.positions[v], mesh.positions[v]};
  const auto before = [](const Vec3& p, const Vec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); };
  for (const VertexId v : mesh.positions.ids()) {
    Segment& of_component = ends[VertexId(connected.find(index(v)))];
    of_component.a = std::min(of_component.a, mesh.positions[v], before);
    of_component.b = std::max(of_component.b, mesh.positions[v], before);
  }
  std::vector<Segment> result;
  for (const VertexId v : mesh.positions.ids())
    if (connected.find(index(v)) == index(v)) result.push_back(ends[v]);
  return result;
}

/// A ray from a point towards +z, as a tree in a pose sees it.
class UpwardRay {
 public:
  UpwardRay(const ObbTree& tree, const Pose& pose, const Vec3& p) {
    const Vec3 from_center = (p - pose.translation) - rotated(pose, tree.center());
    start_ = transposed_rotated(pose, from_center) * tree.unit();
    direction_ = pose.rotation[2];
    const double rounding = rounding_bound(pose, tree.reach()) + 0x1p-49 * norm(p);
    slack_ = 0x1p-16 + 4 * rotation_defect(pose) + rounding * tree.unit();
  }

  /// Whether the start is certainly outside of the box.
  bool starts_outside(const ObbNode& box) const { return !may_meet_part(box, start_, {}); }

  /// False only if the ray meets nothing in the box, of a ray that starts in the root box. That lies within sqrt(3) of
  /// the center, and all triangles within 1. Numbers are at most 4, axes are square to each other within 2^-22, and the
  /// slack is 2^-16.
  bool may_meet(const ObbNode& box) const {
    const Vec3 half_length = direction_ * (1.5 + 2 * slack_);  // of the part of the ray that may meet a box
    return may_meet_part(box, start_ + half_length, half_length);
  }

 private:
  bool may_meet_part(const ObbNode& box, const Vec3& middle, const Vec3& half_length) const {
    const Vec3 v = middle - Vec3{box.center[0], box.center[1], box.center[2]};
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis{box.axes[k], box.axes[3 + k], box.axes[6 + k]};
      if (std::abs(dot(axis, v)) > static_cast<double>(box.half[k]) + std::abs(dot(axis, half_length)) + slack_)
        return false;
    }
    return true;
  }

  Vec3 start_, direction_;
  double slack_;
};

bool is_apart_from_ray(const Triangle& t, const Vec3& p) {
  return (t.a.x < p.x && t.b.x < p.x && t.c.x < p.x) || (t.a.x > p.x && t.b.x > p.x && t.c.x > p.x) ||
         (t.a.y < p.y && t.b.y < p.y && t.c.y < p.y) || (t.a.y > p.y && t.b.y > p.y && t.c.y > p.y) ||
         (t.a.z < p.z && t.b.z < p.z && t.c.z < p.z);
}

/// How the triangle changes the winding number of p, counted along a ray towards +z from a point moved from p by
/// (eps, eps^2). A triangle that holds p itself counts as not met.
int winding_of(const Triangle& t, const Vec3& p) {
  if (is_apart_from_ray(t, p)) return 0;
  const int turns = turn_around_moved(t, p);
  if (turns == 0) return 0;
  const Side s = side(t.a, t.b, t.c, p);
  return turns > 0 ? s == Side::Inside : -(s == Side::Outside);
}

}  // namespace

CollisionMesh::CollisionMesh(const TriangleMesh& given, StandsFor what)
    : tree(triangles_of(given)),
      mesh(reordered(given, tree.items())),
      is_solid(what == StandsFor::Solid && is_closed(mesh) && !is_inside_out(mesh)) {
  component_ends = component_ends_of(mesh);
}

bool CollisionMesh::contains_component(const Pose& pose, const CollisionMesh& other, const Pose& other_pose) const {
  if (!is_solid) return false;
  const auto may_contain = [&](const Vec3& p) { return !UpwardRay(tree, pose, p).starts_outside(tree.boxes()[0]); };
  return std::ranges::any_of(other.component_ends, [&](const Segment& ends) {
    const Vec3 a = at_pose(other_pose, ends.a);
    return may_contain(a) && may_contain(at_pose(other_pose, ends.b)) && winding_number(pose, a) > 0;
  });
}

int CollisionMesh::winding_number(const Pose& pose, const Vec3& point) const {
  const UpwardRay ray(tree, pose, point);
  const auto boxes = tree.boxes();
  std::uint32_t stack[ObbTree::kMaxDepth + 1], size = 0;
  stack[size++] = 0;
  int winding = 0;
  while (size > 0) {
    const std::uint32_t n = stack[--size];
    if (!ray.may_meet(boxes[n])) continue;
    if (!boxes[n].is_leaf()) {
      stack[size++] = boxes[n].link, stack[size++] = n + 1;
      continue;
    }
    for (std::size_t i = 0; i < tree.items_of(boxes[n]).size(); ++i)
      winding += winding_of(at_pose(pose, triangle(boxes[n].first() + i)), point);
  }
  return winding;
}

}  // namespace prohull
