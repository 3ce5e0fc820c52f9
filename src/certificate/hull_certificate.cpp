#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "certificate/certificate_file.h"
#include "certificate/distance_trees.h"
#include "certificate/finite_original.h"
#include "geometry/bvh.h"
#include "geometry/triangle_predicates.h"
#include "mesh/closed.h"
#include "prohull/certificate.h"
#include "prohull/detail/finite.h"
#include "prohull/detail/rounded.h"
#include "prohull/error.h"

namespace prohull {
namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;  ///< numbers of positions, the lesser one first

/// The segment, or point, that a triangle without area is.
Ends ends_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number, FaceId f) {
  const auto along = [&](VertexId v) {
    const Vec3& p = mesh.positions[v];
    return std::array{p.x, p.y, p.z};
  };
  const auto& corners = mesh.triangles[f];
  const VertexId first = *std::ranges::min_element(corners, {}, along);
  const VertexId last = *std::ranges::max_element(corners, {}, along);
  return std::minmax({number[index(first)], number[index(last)]});
}

/// Triangles without area, on no edge and at no corner of one that has an area.
std::vector<Triangle> loose_flat_triangles(const TriangleMesh& mesh) {
  std::vector<FaceId> flat;
  for (const FaceId f : mesh.triangles.ids())
    if (!projection_axis(mesh.triangle(f))) flat.push_back(f);
  if (flat.empty()) return {};
  const std::vector<std::uint32_t> number = numbered_by_position(mesh.positions);
  std::map<Ends, bool> on_edge;
  for (const FaceId f : flat) on_edge[ends_of(mesh, number, f)] = false;
  for (const FaceId f : mesh.triangles.ids())
    for (const VertexId v : mesh.triangles[f])
      for (const VertexId w : mesh.triangles[f]) {
        const auto at = on_edge.find({number[index(v)], number[index(w)]});
        if (at != on_edge.end() && !at->second) at->second = projection_axis(mesh.triangle(f)).has_value();
      }
  std::vector<Triangle> loose;
  for (const FaceId f : flat)
    if (!on_edge[ends_of(mesh, number, f)]) loose.push_back(mesh.triangle(f));
  return loose;
}

/// How many triangles of the original without area lie in the plane of a triangle of the hull near them, and neither on
/// an edge nor at a corner of a triangle that has an area: a checker may not prove that such a triangle is covered.
std::size_t flat_triangles_in_doubt(const TriangleMesh& original, std::span<const TriangleMesh> hull) {
  const std::vector<Triangle> loose = loose_flat_triangles(original);
  if (loose.empty()) return 0;
  std::vector<Triangle> around;
  for (const TriangleMesh& part : hull)
    for (const FaceId f : part.triangles.ids())
      if (projection_axis(part.triangle(f))) around.push_back(part.triangle(f));
  const Bvh bvh(around);
  return static_cast<std::size_t>(std::ranges::count_if(loose, [&](const Triangle& t) {
    bool in_plane = false;
    bvh.visit([box = box_of(t)](const Box& other) { return other.overlaps(box); },
              [&](std::uint32_t i) { in_plane = in_plane || coplanar(around[i], t); });
    return in_plane;
  }));
}

}  // namespace

void require_certifiable(const TriangleMesh& original, HullSide side) {
  if (side == HullSide::Inner && !is_closed(with_finite_faces(original)))
    throw InputError(Defect::OpenEdge,
                     "it is not closed, and has no inside of which a certificate of an inner hull could tell; close it "
                     "with `prohull repair`, or make no certificate");
}

Certificate hull_certificate(const TriangleMesh& hull, const CertifiedOriginal& original, const HullClaims& claims) {
  const bool is_outer = claims.side == HullSide::Outer;
  using certificate::Section;
  require_certifiable(original.mesh, claims.side);
  const certificate::FiniteOriginal finite(original.mesh);
  Certificate made;
  certificate::File file = certificate::header(claims.side, original, hull.face_count(), finite);
  file.section(Section::Surfaces);
  file.number(finite.is_closed ? certificate::kCoversAndEncloses : certificate::kCovers);
  made.claims.emplace_back(is_outer ? "covers every finite triangle" : "is covered by the original");
  if (finite.is_closed) made.claims.emplace_back(is_outer ? "encloses the solid" : "is enclosed by the solid");
  if (claims.gap > 0) {
    file.section(Section::Gap);
    file.real(claims.gap);
    made.claims.push_back(fmt::format("keeps a gap of {:.6g}", rounded_down(claims.gap, 6)));
  }
  if (std::isfinite(claims.distance))
    if (const auto trees = certificate::distance_trees(hull, finite.triangles, claims.distance)) {
      file.section(Section::Distance);
      file.real(claims.distance);
      file.add(*trees);
      made.claims.push_back(
          fmt::format("is nowhere farther than {:.6g} from the triangles", rounded_up(claims.distance, 6)));
    }
  if (is_outer) made.flat_triangles_in_doubt = flat_triangles_in_doubt(finite.triangles, {&hull, 1});
  made.bytes = file.bytes();
  return made;
}

Certificate pieces_certificate(std::span<const TriangleMesh> pieces, const CertifiedOriginal& original) {
  std::size_t triangles = 0;
  for (const TriangleMesh& piece : pieces) triangles += piece.face_count();
  const certificate::FiniteOriginal finite(original.mesh);
  certificate::File file = certificate::header(HullSide::Outer, original, triangles, finite);
  file.section(certificate::Section::Surfaces);
  file.number(finite.is_closed ? certificate::kCoversAndEncloses : certificate::kCovers);
  Certificate made{.bytes = file.bytes(), .claims = {"cover every finite triangle"}};
  if (finite.is_closed) made.claims.emplace_back("enclose the solid");
  made.flat_triangles_in_doubt = flat_triangles_in_doubt(finite.triangles, pieces);
  return made;
}

}  // namespace prohull
