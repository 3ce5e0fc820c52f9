#include "paper/refine_along.h"

#include <algorithm>
#include <memory>

#include "paper/refined_hull.h"
#include "prohull/mesh_query.h"

namespace prohull {
namespace {

std::vector<FaceId> faces_of(const RefinedHull& hull) {
  std::vector<FaceId> faces;
  for (std::uint32_t f = 0; f < hull.refinable().hull().original_face_count(); ++f)
    if (hull.has(FaceId{f})) faces.push_back(FaceId{f});
  return faces;
}

/// The faces that the segment meets, ascending.
std::vector<FaceId> faces_met(const RefinedHull& hull, const Segment& segment) {
  const std::vector<FaceId> faces = faces_of(hull);
  std::vector<FaceId> met;
  for (const Hit& hit : MeshQuery(QueryIndex(hull.triangle_mesh())).all_hits(segment))
    met.push_back(faces[index(hit.face)]);
  std::ranges::sort(met);
  return met;
}

/// Splits what can be split at the corners of the faces; whether there was anything.
bool split_corners(RefinedHull& hull, const std::vector<FaceId>& faces) {
  std::vector<VertexId> corners;
  for (const FaceId f : faces)
    for (const VertexId v : hull.corners(f))
      if (hull.refinable().is_made(v)) corners.push_back(v);
  for (const VertexId v : corners) hull.split(v);
  return !corners.empty();
}

}  // namespace

RefinedAlong refine_along(const ProgressiveHull& hull, const Segment& segment) {
  RefinedHull refined(std::make_shared<const RefinableHull>(hull));
  std::vector<FaceId> met;
  do met = faces_met(refined, segment);
  while (split_corners(refined, met));

  RefinedAlong result{refined.triangle_mesh(), {}, {}};
  for (const Hit& hit : MeshQuery(QueryIndex(hull.original())).all_hits(segment))
    (std::ranges::binary_search(met, hit.face) ? result.found : result.missed).push_back(hit.t);
  return result;
}

}  // namespace prohull
