#include "prohull/detail/mesh_part.h"

#include <algorithm>
#include <utility>

#include "construct/checked_options.h"
#include "construct/progressive/rounds.h"
#include "construct/turned.h"
#include "mesh/half_edge_mesh.h"
#include "parallel/arena.h"
#include "prohull/error.h"

namespace prohull {
namespace {

void check(const MeshPart& part, const HullOptions& options) {
  check(options);
  if (options.mirror)
    throw InputError(Defect::InvalidOption, "a part of a mesh has no symmetry: simplify it without mirror");
  const auto require = [](bool holds, Defect defect, const char* what) {
    if (!holds) throw InputError(defect, what);
  };
  require(options.strategy == Strategy::Lazy && options.tolerances.empty(), Defect::InvalidOption,
          "a part is simplified by the strategy lazy, without tolerances");
  require(!part.box.is_empty(), Defect::InvalidOption, "the box of the part is empty");
  require(part.own_faces <= part.mesh.face_count(), Defect::InvalidOption, "the part has more own faces than faces");
  require(std::ranges::all_of(part.mesh.positions, is_finite), Defect::NonFiniteCoordinate,
          "the part has coordinates that are not finite");
}

bool is_strictly_inside(const Box& box, const Vec3& p) {
  return box.min.x < p.x && p.x < box.max.x && box.min.y < p.y && p.y < box.max.y && box.min.z < p.z && p.z < box.max.z;
}

std::size_t faces_that_stay(const MeshPart& part) {
  return static_cast<std::size_t>(std::ranges::count_if(part.mesh.triangles, [&](const auto& corners) {
    return !std::ranges::all_of(corners,
                                [&](VertexId v) { return is_strictly_inside(part.box, part.mesh.positions[v]); });
  }));
}

SimplifiedPart own_faces(const ProgressiveHull& hull, std::size_t count) {
  SimplifiedPart made;
  const std::vector<VertexId>& corners = hull.base_corners();
  PerVertex<VertexId> number(hull.positions().size(), kNoVertex);
  for (std::size_t c = 0; c < 3 * count; ++c)
    if (corners[c] != kNoVertex) number[corners[c]] = VertexId{0};
  for (const VertexId v : number.ids()) {
    if (number[v] == kNoVertex) continue;
    number[v] = made.mesh.positions.push_back(hull.positions()[v]);
    if (index(v) < hull.original_vertex_count()) made.kept.push_back(v);
  }
  for (std::size_t c = 0; c < 3 * count; c += 3)
    if (corners[c] != kNoVertex)
      made.mesh.triangles.push_back({number[corners[c]], number[corners[c + 1]], number[corners[c + 2]]});
  return made;
}

}  // namespace

SimplifiedPart simplify_part(const MeshPart& part, const HullOptions& options) {
  check(part, options);
  if (part.own_faces == 0) return {};
  HullOptions of_all = options;
  of_all.target_faces += faces_that_stay(part);
  SimplifiedPart made = arena_of(options.threads).execute([&] {
    const HullResult result = simplify_in_rounds(turned_if_inner(part.mesh, options.side), of_all, &part.box);
    return own_faces(result.hull, part.own_faces);
  });
  made.mesh = turned_if_inner(std::move(made.mesh), options.side);
  return made;
}

}  // namespace prohull
