#include "verify/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "geometry/orientation.h"
#include "geometry/triangle_predicates.h"
#include "mesh/closed.h"
#include "prohull/detail/disjoint_sets.h"
#include "prohull/detail/inside_out.h"
#include "prohull/detail/text.h"
#include "prohull/enclosure.h"

namespace prohull::verify {
namespace {

std::uint64_t edge_key(std::uint32_t v, std::uint32_t w) {
  return std::uint64_t(std::min(v, w)) << 32 | std::max(v, w);
}

}  // namespace

Surface::Surface(const TriangleMesh& mesh, std::string_view name, Turning turning) {
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
  if (turning == Turning::Outwards && prohull::volume_sign(faces) < 0) {
    volume = -volume;
    for (Triangle& t : faces) std::swap(t.b, t.c);
    for (auto& c : corners) std::swap(c[1], c[2]);
  }
}

// By the lesser end first, in linear time: few sides share it.
std::vector<FaceEdge> edges(const Surface& surface) {
  std::vector<std::size_t> first;
  const auto lesser_end = [](std::uint64_t key) { return static_cast<std::size_t>(key >> 32); };
  const auto for_each_side = [&](auto visit) {
    for (FaceIndex f = 0; f < surface.faces.size(); ++f)
      for (std::uint8_t e = 0; e < 3; ++e)
        visit(FaceEdge{edge_key(surface.corners[f][e], surface.corners[f][(e + 1) % 3]), f, e});
  };
  for_each_side([&](const FaceEdge& side) {
    if (lesser_end(side.key) + 1 >= first.size()) first.resize(lesser_end(side.key) + 2);
    ++first[lesser_end(side.key) + 1];
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<FaceEdge> result(3 * surface.faces.size());
  std::vector<std::size_t> next = first;
  for_each_side([&](const FaceEdge& side) { result[next[lesser_end(side.key)]++] = side; });
  for (std::size_t v = 1; v < first.size(); ++v)
    std::sort(result.begin() + std::ptrdiff_t(first[v - 1]), result.begin() + std::ptrdiff_t(first[v]),
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
                         [](std::uint32_t v, std::uint32_t w, FaceId f) { return Side(std::max(v, w), index(f)); });
  DisjointSets clusters(mesh.face_count());
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    const std::span<Side> here = sides.of(v);
    std::sort(here.begin(), here.end());
    for (std::size_t i = 1; i < here.size(); ++i)
      if (here[i].first == here[i - 1].first) clusters.join(here[i].second, here[i - 1].second);
  }
  std::vector<std::uint32_t> component(mesh.face_count());
  std::uint32_t count = 0;
  for (FaceIndex f = 0; f < component.size(); ++f) {
    const FaceIndex first = clusters.find(f);  // never greater than f
    component[f] = first == f ? count++ : component[first];
  }
  return {std::move(component), count};
}

enum class Unclear { Stays, Turns };

/// The components of a mesh, and how they face.
struct Components {
  explicit Components(const TriangleMesh& mesh) {
    std::uint32_t count = 0;
    std::tie(of_face, count) = components(mesh);
    orientation = prohull::orientation(
        [&](std::size_t f) { return mesh.triangle(FaceId(static_cast<std::uint32_t>(f))); }, of_face, count);
  }

  Facing facing(FaceId f) const { return orientation.components[of_face[index(f)]]; }
  /// `unclear`: what becomes of components that are neither inside out nor a cavity for certain.
  bool is_turned(FaceId f, Unclear unclear) const {
    const Facing own = facing(f);
    const bool turns = own == Facing::InsideOut || (own == Facing::Unclear && unclear == Unclear::Turns);
    return orientation.turn_all != turns;
  }
  bool is_inside_out(FaceId f) const { return orientation.inside_out[of_face[index(f)]]; }

  std::vector<std::uint32_t> of_face;
  Orientation orientation;
};

Turned turn(TriangleMesh& mesh, const Components& components, Unclear unclear = Unclear::Stays) {
  Turned turned;
  for (const FaceId f : mesh.triangles.ids()) {
    if (!components.is_turned(f, unclear)) continue;
    auto& t = mesh.triangles[f];
    std::swap(t[1], t[2]);
    if (t[1] == t[2]) continue;
    ++turned.faces;
    turned.inwards += components.is_inside_out(f) ? 1 : 0;
  }
  return turned;
}

/// "the component of face 12 of arm is inside out, as is 1 other": of the components for whose faces `is_one` holds;
/// empty if there are none.
template <class Predicate>
std::string described(const Components& components, const TriangleMesh& mesh, const std::string& name,
                      const Predicate& is_one) {
  std::vector<bool> seen(components.orientation.components.size());
  std::size_t count = 0;
  FaceId first{};
  for (const FaceId f : mesh.triangles.ids()) {
    const std::uint32_t component = components.of_face[index(f)];
    if (seen[component] || !is_one(f)) continue;
    seen[component] = true;
    if (count++ == 0) first = f;
  }
  if (count == 0) return "";
  const std::string others =
      count == 1 ? "" : fmt::format(", as {} {}", count == 2 ? "is" : "are", counted(count - 1, "other", "others"));
  return fmt::format("the component of face {} of {} is inside out{}", index(first), name, others);
}

}  // namespace

int volume_sign(const TriangleMesh& mesh) {
  return prohull::volume_sign(mesh.face_count(),
                              [&](std::size_t f) { return mesh.triangle(FaceId(static_cast<std::uint32_t>(f))); });
}

bool is_one_sheet(const TriangleMesh& mesh) {
  for (const FaceId f : mesh.triangles.ids())
    if (!projection_axis(mesh.triangle(f))) return false;
  const auto number = numbered_by_position(mesh.positions);
  struct Side {
    std::uint32_t to;
    FaceIndex face;
    bool upwards;
  };
  SidesByEnd<Side> sides(mesh, number, [](std::uint32_t v, std::uint32_t w, FaceId f) {
    return Side{std::max(v, w), index(f), v < w};
  });
  DisjointSets clusters(mesh.face_count());
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
    if (clusters.find(f) != 0) return false;
  return true;
}

Turned turn_outwards(TriangleMesh& mesh, std::string_view name) {
  require_usable(mesh, name);
  return turn(mesh, Components(mesh));
}

std::vector<FaceId> turn_outwards_and_fill(TriangleMesh& mesh, std::string_view name) {
  require_usable(mesh, name);
  const Components components(mesh);
  turn(mesh, components);
  std::vector<FaceId> kept;
  for (const FaceId f : mesh.triangles.ids())
    if (components.facing(f) != Facing::Cavity) kept.push_back(f);
  return kept;
}

}  // namespace prohull::verify

namespace prohull {

OutwardSolid outward_solid(TriangleMesh closed, const std::string& name) {
  require_usable(closed, name);
  OutwardSolid solid{std::move(closed), {}};
  TriangleMesh& mesh = solid.mesh;
  const verify::Components components(mesh);
  // What crosses others may be meant as a hole, or as a part that was drawn inside out. Solid holds for both.
  const std::size_t turned = verify::turn(mesh, components, verify::Unclear::Turns).faces;
  if (turned == 0) return solid;
  const bool is_unclear = std::ranges::count(components.orientation.components, Facing::Unclear) > 0;
  solid.turned =
      (turned == mesh.face_count()
           ? name + " is inside out"
           : verify::described(components, mesh, name, [&](FaceId f) { return components.is_inside_out(f); })) +
      (is_unclear ? " and crosses or repeats others" : "") + ": it was turned, so that its inside counts as solid";
  return solid;
}

TriangleMesh turned_outwards(TriangleMesh mesh) {
  verify::turn_outwards(mesh, "original");
  return mesh;
}

}  // namespace prohull
