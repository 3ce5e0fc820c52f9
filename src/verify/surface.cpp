#include "verify/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "geometry/orientation.h"
#include "geometry/triangle_predicates.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"

namespace prohull::verify {
namespace {

std::string text(const Vec3& p) { return fmt::format("({} {} {})", p.x, p.y, p.z); }

std::uint64_t edge_key(std::uint32_t v, std::uint32_t w) {
  return std::uint64_t(std::min(v, w)) << 32 | std::max(v, w);
}

/// An edge along which faces run more often one way than the other.
struct OpenEdge {
  std::uint32_t v, w;  ///< by number
  std::size_t faces;
};

std::optional<OpenEdge> find_open_edge(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number) {
  struct Use {
    std::uint64_t key;
    int direction;
  };
  std::vector<Use> uses;
  uses.reserve(3 * mesh.face_count());
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = number[index(t[i])], w = number[index(t[(i + 1) % 3])];
      if (v != w) uses.push_back({edge_key(v, w), v < w ? 1 : -1});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.key < b.key; });
  for (std::size_t i = 0, end; i < uses.size(); i = end) {
    int sum = 0;
    for (end = i; end < uses.size() && uses[end].key == uses[i].key; ++end) sum += uses[end].direction;
    if (sum != 0) return OpenEdge{std::uint32_t(uses[i].key >> 32), std::uint32_t(uses[i].key), end - i};
  }
  return std::nullopt;
}

void require_closed(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number, std::string_view name) {
  const auto open = find_open_edge(mesh, number);
  if (!open) return;
  const Defect defect = open->faces == 1   ? Defect::OpenEdge
                        : open->faces == 2 ? Defect::InconsistentOrientation
                                           : Defect::NonManifoldEdge;
  throw InputError(defect,
                   fmt::format("the {} mesh is not closed: edge {} - {} has {} face{}, not as many on one side as "
                               "on the other; only closed meshes can be verified",
                               name, text(mesh.positions[VertexId(open->v)]), text(mesh.positions[VertexId(open->w)]),
                               open->faces, open->faces == 1 ? "" : "s"));
}

}  // namespace

std::vector<std::uint32_t> numbered_by_position(const PerVertex<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size()), number(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto at = [&](std::uint32_t v) -> const Vec3& { return positions[VertexId(v)]; };
  std::erase_if(order, [&](std::uint32_t v) { return !is_finite(at(v)); });
  std::sort(order.begin(), order.end(), [&](std::uint32_t v, std::uint32_t w) {
    const Vec3 &p = at(v), &q = at(w);
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : v < w;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    number[order[i]] = i > 0 && at(order[i]) == at(order[i - 1]) ? number[order[i - 1]] : order[i];
  return number;
}

void require_usable(const TriangleMesh& mesh, std::string_view name) {
  if (mesh.triangles.empty()) throw InputError(Defect::EmptyMesh, fmt::format("the {} mesh has no triangle", name));
  for (const FaceId f : mesh.triangles.ids())
    for (const VertexId v : mesh.triangles[f]) {
      if (index(v) >= mesh.vertex_count())
        throw InputError(Defect::Malformed, fmt::format("the {} mesh: face {} refers to vertex {}, of {}", name,
                                                        index(f), index(v), mesh.vertex_count()));
      if (!is_finite(mesh.positions[v]))
        throw InputError(Defect::NonFiniteCoordinate, fmt::format("the {} mesh: vertex {} of face {} is at {}", name,
                                                                  index(v), index(f), text(mesh.positions[v])));
    }
}

void require_closed(const TriangleMesh& mesh, std::string_view name) {
  require_usable(mesh, name);
  require_closed(mesh, numbered_by_position(mesh.positions), name);
}

Surface::Surface(const TriangleMesh& mesh, std::string_view name) {
  require_usable(mesh, name);
  const auto number = numbered_by_position(mesh.positions);
  require_closed(mesh, number, name);
  std::vector<Box> boxes;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    const auto projected_along = projection_axis(t);
    if (!projected_along) continue;
    const auto& v = mesh.triangles[f];
    faces.push_back(t);
    axis.push_back(static_cast<std::uint8_t>(*projected_along));
    corners.push_back({number[index(v[0])], number[index(v[1])], number[index(v[2])]});
    source.push_back(f);
    boxes.push_back(box_of(t));
  }
  bvh = Bvh(boxes);
  volume = signed_volume(mesh);
  if (volume_sign(faces) < 0) {
    volume = -volume;
    for (Triangle& t : faces) std::swap(t.b, t.c);
    for (auto& c : corners) std::swap(c[1], c[2]);
  }
}

Clusters::Clusters(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

std::uint32_t Clusters::representative(std::uint32_t i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

void Clusters::join(std::uint32_t i, std::uint32_t j) {
  i = representative(i), j = representative(j);
  parent_[std::max(i, j)] = std::min(i, j);
}

std::vector<FaceEdge> edges(const Surface& surface) {
  std::vector<FaceEdge> result;
  result.reserve(3 * surface.faces.size());
  for (FaceIndex f = 0; f < surface.faces.size(); ++f)
    for (std::uint8_t e = 0; e < 3; ++e)
      result.push_back({edge_key(surface.corners[f][e], surface.corners[f][(e + 1) % 3]), f, e});
  std::sort(result.begin(), result.end(),
            [](const FaceEdge& a, const FaceEdge& b) { return a.key != b.key ? a.key < b.key : a.face < b.face; });
  return result;
}

namespace {

/// The component of each face, connected by edges that are matched by position, numbered from 0; and how many there
/// are.
std::pair<std::vector<std::uint32_t>, std::uint32_t> components(const TriangleMesh& mesh) {
  const auto number = numbered_by_position(mesh.positions);
  std::vector<std::pair<std::uint64_t, FaceIndex>> sides;
  for (const FaceId f : mesh.triangles.ids())
    for (int i = 0; i < 3; ++i) {
      const auto& t = mesh.triangles[f];
      sides.emplace_back(edge_key(number[index(t[i])], number[index(t[(i + 1) % 3])]), index(f));
    }
  std::sort(sides.begin(), sides.end());
  Clusters clusters(mesh.face_count());
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].first == sides[i - 1].first) clusters.join(sides[i].second, sides[i - 1].second);
  std::vector<std::uint32_t> component(mesh.face_count());
  std::uint32_t count = 0;
  for (FaceIndex f = 0; f < component.size(); ++f) {
    const FaceIndex first = clusters.representative(f);  // never greater than f
    component[f] = first == f ? count++ : component[first];
  }
  return {std::move(component), count};
}

}  // namespace
}  // namespace prohull::verify

namespace prohull {

bool is_closed(const TriangleMesh& mesh) {
  verify::require_usable(mesh, "given");
  return !verify::find_open_edge(mesh, verify::numbered_by_position(mesh.positions));
}

TriangleMesh turned_outwards(TriangleMesh mesh) {
  verify::require_usable(mesh, "original");
  const auto [component, count] = verify::components(mesh);
  std::vector<Triangle> faces;
  for (const FaceId f : mesh.triangles.ids()) faces.push_back(mesh.triangle(f));
  const Orientation facing = orientation(std::move(faces), component, count);
  for (const FaceId f : mesh.triangles.ids()) {
    auto& t = mesh.triangles[f];
    if (facing.turn_all != (facing.components[component[index(f)]] == Facing::InsideOut)) std::swap(t[1], t[2]);
  }
  return mesh;
}

}  // namespace prohull
