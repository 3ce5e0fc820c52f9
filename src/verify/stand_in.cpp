#include "verify/stand_in.h"

#include <algorithm>
#include <utility>

#include "geometry/triangle_key.h"
#include "mesh/closed.h"
#include "verify/surface.h"

namespace prohull::verify {
StandIn stand_in(const TriangleMesh& closed, const TriangleMesh& original) {
  require_closed(closed, "closed");
  StandIn result{.mesh = closed};
  turn_outwards(result.mesh, "closed");
  std::vector<std::pair<TriangleKey, FaceId>> known;
  known.reserve(original.face_count());
  for (const FaceId f : original.triangles.ids()) known.emplace_back(unoriented_key(original.triangle(f)), f);
  std::ranges::sort(known);
  std::vector<bool> stands(original.face_count());
  for (const FaceId f : result.mesh.triangles.ids()) {
    const TriangleKey corners = unoriented_key(result.mesh.triangle(f));
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
