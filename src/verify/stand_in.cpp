#include "verify/stand_in.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/closed.h"
#include "verify/surface.h"

namespace prohull::verify {
namespace {

using UnorientedCorners = std::array<std::array<double, 3>, 3>;

// Independent of orientation and of the order of the corners; -0 becomes 0.
UnorientedCorners unoriented(const Triangle& t) {
  UnorientedCorners corners;
  std::ranges::transform(std::array{t.a, t.b, t.c}, corners.begin(), [](const Vec3& p) {
    return std::array{p.x + 0.0, p.y + 0.0, p.z + 0.0};
  });
  std::ranges::sort(corners);
  return corners;
}

}  // namespace

StandIn stand_in(const TriangleMesh& closed, const TriangleMesh& original) {
  require_closed(closed, "closed");
  StandIn result{.mesh = closed};
  turn_outwards(result.mesh, "closed");
  std::vector<std::pair<UnorientedCorners, FaceId>> known;
  known.reserve(original.face_count());
  for (const FaceId f : original.triangles.ids()) known.emplace_back(unoriented(original.triangle(f)), f);
  std::ranges::sort(known);
  std::vector<bool> stands(original.face_count());
  for (const FaceId f : result.mesh.triangles.ids()) {
    const UnorientedCorners corners = unoriented(result.mesh.triangle(f));
    const auto first = std::lower_bound(known.begin(), known.end(), corners,
                                        [](const auto& entry, const auto& other) { return entry.first < other; });
    auto last = first;
    for (; last != known.end() && last->first == corners; ++last) stands[index(last->second)] = true;
    result.number.push_back(first != last ? first->second
                                          : FaceId(static_cast<std::uint32_t>(original.face_count() + result.caps++)));
  }
  for (const FaceId f : original.triangles.ids())
    if (!stands[index(f)]) result.rest.push_back(f);
  return result;
}

}  // namespace prohull::verify
