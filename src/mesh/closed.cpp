#include "mesh/closed.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_sort.h>

#include <optional>
#include <string>

#include "prohull/error.h"

namespace prohull {
namespace {

std::string text(const Vec3& p) { return fmt::format("({} {} {})", p.x, p.y, p.z); }

/// An edge along which faces run more often one way than the other.
struct OpenEdge {
  std::uint32_t v, w;  ///< by number
  std::size_t faces;
};

std::optional<OpenEdge> find_open_edge(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number) {
  struct Use {
    std::uint32_t to;
    int direction;
  };
  SidesByEnd<Use> sides(mesh, number, [](std::uint32_t v, std::uint32_t w, FaceId) {
    return Use{std::max(v, w), v < w ? 1 : v > w ? -1 : 0};
  });
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    const std::span<Use> uses = sides.of(v);
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.to < b.to; });
    for (std::size_t i = 0, end; i < uses.size(); i = end) {
      int sum = 0;
      for (end = i; end < uses.size() && uses[end].to == uses[i].to; ++end) sum += uses[end].direction;
      if (sum != 0) return OpenEdge{v, uses[i].to, end - i};
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::uint32_t> numbered_by_position(const PerVertex<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size()), number(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto at = [&](std::uint32_t v) -> const Vec3& { return positions[VertexId(v)]; };
  std::erase_if(order, [&](std::uint32_t v) { return !is_finite(at(v)); });
  oneapi::tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t v, std::uint32_t w) {
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

bool is_closed(const TriangleMesh& mesh) {
  require_usable(mesh, "given");
  return !find_open_edge(mesh, numbered_by_position(mesh.positions));
}

}  // namespace prohull
