#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "geometry/orientation.h"
#include "prohull/error.h"
#include "prohull/repair.h"
#include "prohull/text.h"

namespace prohull {
namespace {

// Vertices at equal positions become one, the first; -0 equals 0. Faces that then have a vertex twice go.
void weld(TriangleMesh& mesh, Repairs& repairs) {
  std::vector<VertexId> order;
  order.reserve(mesh.vertex_count());
  for (const VertexId v : mesh.positions.ids()) order.push_back(v);
  const auto key = [&](VertexId v) {
    const Vec3& p = mesh.positions[v];
    return std::array{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(),
            [&](VertexId a, VertexId b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  PerVertex<VertexId> representative(mesh.vertex_count());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    representative[order[i]] = same ? representative[order[i - 1]] : order[i];
    repairs.welded_vertices += same;
  }
  PerFace<std::array<VertexId, 3>> kept;
  kept.reserve(mesh.face_count());
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array t{representative[a], representative[b], representative[c]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) kept.push_back(t);
  }
  repairs.dropped_faces = mesh.face_count() - kept.size();
  mesh.triangles = std::move(kept);
}

// The connected component of every face, numbered from 0.
std::vector<std::uint32_t> component_of_faces(const TriangleMesh& mesh) {
  PerVertex<VertexId> parent;
  for (const VertexId v : mesh.positions.ids()) parent.push_back(v);
  const auto find = [&](VertexId v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (const VertexId v : {t[1], t[2]}) {
      const VertexId a = find(t[0]), b = find(v);
      parent[std::max(a, b)] = std::min(a, b);
    }
  constexpr std::uint32_t kNone = 0xffffffff;
  PerVertex<std::uint32_t> number(mesh.vertex_count(), kNone);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> component;
  for (const auto& t : mesh.triangles) {
    std::uint32_t& known = number[find(t[0])];
    if (known == kNone) known = count++;
    component.push_back(known);
  }
  return component;
}

void turn_outwards(TriangleMesh& mesh, std::size_t components, Repairs& repairs) {
  std::vector<Triangle> triangles;
  for (const FaceId f : mesh.triangles.ids()) triangles.push_back(mesh.triangle(f));
  const std::vector<std::uint32_t> component = component_of_faces(mesh);
  const Orientation facing = orientation(std::move(triangles), component, components);
  for (const FaceId f : mesh.triangles.ids()) {
    const Facing own = facing.components[component[index(f)]];
    if (own == Facing::Unclear)
      throw InputError(
          Defect::InconsistentOrientation,
          fmt::format("the component of face {} is inside out, and lies partly inside and partly outside of "
                      "others: turn it, or make it a cavity of one of them",
                      index(f)));
    if (facing.turn_all == (own == Facing::InsideOut)) continue;
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
    ++repairs.turned_faces;
  }
  for (const Facing own : facing.components) repairs.turned_components += facing.turn_all != (own == Facing::InsideOut);
}

std::string why_not_closed(const MeshReport& report) {
  std::string counts;
  for (const DefectCount& defect : defect_counts(report))
    if (defect.count > 0 && !defect.allowed)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", grouped(defect.count), defect.description);
  return fmt::format(
      "{} (in all: {}); a hull needs a closed 2-manifold: close holes and separate parts that meet in an edge or "
      "vertex "
      "first",
      report.first_defect, counts);
}

void require_usable_size(const Box& box) {
  constexpr double kLargest = 1e100, kSmallest = 1e-100;
  const double reach = std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                                 std::abs(box.max.y), std::abs(box.max.z)});
  if (reach > kLargest)
    throw InputError(
        Defect::NonFiniteCoordinate,
        fmt::format("coordinates reach {:g}; beyond {:g} volumes overflow: scale the mesh", reach, kLargest));
  if (box.diagonal() < kSmallest)
    throw InputError(Defect::NoVolume,
                     fmt::format("the mesh is only {:g} across; below {:g} volumes vanish: scale the mesh",
                                 box.diagonal(), kSmallest));
}

}  // namespace

std::vector<std::string> describe(const Repairs& repairs) {
  std::vector<std::string> phrases;
  if (repairs.welded_vertices > 0)
    phrases.push_back(fmt::format("welded {} vertices at equal positions", grouped(repairs.welded_vertices)));
  if (repairs.dropped_faces > 0)
    phrases.push_back(fmt::format("dropped {} faces that had the same vertex twice", grouped(repairs.dropped_faces)));
  if (repairs.turned_components > 0)
    phrases.push_back(fmt::format("turned {} component{} that {} inside out ({} faces)",
                                  grouped(repairs.turned_components), repairs.turned_components == 1 ? "" : "s",
                                  repairs.turned_components == 1 ? "was" : "were", grouped(repairs.turned_faces)));
  return phrases;
}

ClosedMesh closed_mesh(TriangleMesh mesh) {
  if (mesh.face_count() == 0) throw InputError(Defect::EmptyMesh, "the mesh has no faces: nothing to enclose");
  constexpr std::size_t kMostFaces = 0xffffffff / 3;
  if (mesh.face_count() >= kMostFaces)
    throw InputError(Defect::InvalidOption, fmt::format("{} faces; at most {} are supported",
                                                        grouped(mesh.face_count()), grouped(kMostFaces)));
  ClosedMesh closed{std::move(mesh), {}, {}};
  closed.report = inspect(closed.mesh);
  if (!closed.report.is_closed_manifold() && closed.report.non_finite_vertices == 0) {
    weld(closed.mesh, closed.repairs);
    closed.report = inspect(closed.mesh);
  }
  if (closed.report.faces == 0)
    throw InputError(Defect::EmptyMesh, "no face has three different corners: nothing to enclose");
  if (!closed.report.is_closed_manifold()) throw InputError(closed.report.worst_defect, why_not_closed(closed.report));
  require_usable_size(closed.report.box);
  turn_outwards(closed.mesh, closed.report.components, closed.repairs);
  closed.report.volume = signed_volume(closed.mesh);
  if (!(closed.report.volume > 0)) throw InputError(Defect::NoVolume, "the mesh is closed but encloses no volume");
  return closed;
}

}  // namespace prohull
