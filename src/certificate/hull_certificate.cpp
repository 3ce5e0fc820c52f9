#include <fmt/format.h>

#include <cmath>

#include "certificate/certificate_file.h"
#include "certificate/distance_trees.h"
#include "certificate/finite_original.h"
#include "certificate/flat_triangles.h"
#include "prohull/certificate.h"
#include "prohull/detail/finite.h"
#include "prohull/detail/rounded.h"
#include "prohull/error.h"

namespace prohull {

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
  if (is_outer) made.flat_triangles_in_doubt = certificate::flat_triangles_in_doubt(finite.triangles, {&hull, 1});
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
  made.flat_triangles_in_doubt = certificate::flat_triangles_in_doubt(finite.triangles, pieces);
  return made;
}

}  // namespace prohull
