#include "verify/surface.h"

#include <fmt/format.h>

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

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

/// The sides of all faces, each as item(tail, tip, face), by the lesser of the numbers of its ends. In linear time, and
/// in half of the memory that sorting them by both ends takes.
template <class Item>
class SidesByEnd {
 public:
  template <class MakeItem>
  SidesByEnd(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number, MakeItem item)
      : first_(number.size() + 1, 0) {
    for_each(mesh, number, [&](std::uint32_t v, std::uint32_t w, FaceIndex) { ++first_[std::min(v, w) + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    items_.resize(first_.back());
    std::vector<std::size_t> cursor(first_.begin(), first_.end() - 1);
    for_each(mesh, number,
             [&](std::uint32_t v, std::uint32_t w, FaceIndex f) { items_[cursor[std::min(v, w)]++] = item(v, w, f); });
  }

  std::span<Item> of(std::uint32_t v) { return std::span(items_).subspan(first_[v], first_[v + 1] - first_[v]); }

 private:
  template <class Visit>
  static void for_each(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number, Visit visit) {
    for (const FaceId f : mesh.triangles.ids())
      for (int i = 0; i < 3; ++i) {
        const auto& t = mesh.triangles[f];
        visit(number[index(t[i])], number[index(t[(i + 1) % 3])], index(f));
      }
  }

  std::vector<std::size_t> first_;
  std::vector<Item> items_;
};

std::optional<OpenEdge> find_open_edge(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number) {
  struct Use {
    std::uint32_t to;
    int direction;
  };
  SidesByEnd<Use> sides(mesh, number, [](std::uint32_t v, std::uint32_t w, FaceIndex) {
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
  bvh = Bvh(std::move(boxes));
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
  using Side = std::pair<std::uint32_t, FaceIndex>;  // to which end
  SidesByEnd<Side> sides(mesh, number,
                         [](std::uint32_t v, std::uint32_t w, FaceIndex f) { return Side(std::max(v, w), f); });
  Clusters clusters(mesh.face_count());
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    const std::span<Side> here = sides.of(v);
    std::sort(here.begin(), here.end());
    for (std::size_t i = 1; i < here.size(); ++i)
      if (here[i].first == here[i - 1].first) clusters.join(here[i].second, here[i - 1].second);
  }
  std::vector<std::uint32_t> component(mesh.face_count());
  std::uint32_t count = 0;
  for (FaceIndex f = 0; f < component.size(); ++f) {
    const FaceIndex first = clusters.representative(f);  // never greater than f
    component[f] = first == f ? count++ : component[first];
  }
  return {std::move(component), count};
}

}  // namespace

bool is_one_sheet(const TriangleMesh& mesh) {
  const auto number = numbered_by_position(mesh.positions);
  struct Side {
    std::uint32_t to;
    FaceIndex face;
    bool upwards;
  };
  SidesByEnd<Side> sides(mesh, number, [](std::uint32_t v, std::uint32_t w, FaceIndex f) {
    return Side{std::max(v, w), f, v < w};
  });
  Clusters clusters(mesh.face_count());
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    const std::span<Side> here = sides.of(v);
    if (here.size() % 2 != 0) return false;
    std::sort(here.begin(), here.end(), [](const Side& a, const Side& b) { return a.to < b.to; });
    for (std::size_t i = 0; i < here.size(); i += 2) {
      const Side &a = here[i], &b = here[i + 1];
      const bool has_more = i > 0 && here[i - 1].to == a.to;
      if (a.to == v || a.to != b.to || a.upwards == b.upwards || has_more) return false;
      clusters.join(a.face, b.face);
    }
  }
  for (FaceIndex f = 0; f < mesh.face_count(); ++f)
    if (clusters.representative(f) != 0) return false;
  return true;
}

std::size_t turn_outwards(TriangleMesh& mesh, std::string_view name) {
  require_usable(mesh, name);
  const auto [component, count] = components(mesh);
  const auto triangle = [&](std::size_t f) { return mesh.triangle(FaceId(static_cast<std::uint32_t>(f))); };
  const Orientation facing = orientation(triangle, component, count);
  std::size_t turned = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    auto& t = mesh.triangles[f];
    if (facing.turn_all == (facing.components[component[index(f)]] == Facing::InsideOut)) continue;
    std::swap(t[1], t[2]);
    turned += t[1] != t[2];
  }
  return turned;
}

}  // namespace prohull::verify

namespace prohull {

bool is_closed(const TriangleMesh& mesh) {
  verify::require_usable(mesh, "given");
  return !verify::find_open_edge(mesh, verify::numbered_by_position(mesh.positions));
}

TriangleMesh turned_outwards(TriangleMesh mesh) {
  verify::turn_outwards(mesh, "original");
  return mesh;
}

}  // namespace prohull
