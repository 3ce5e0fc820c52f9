#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "prohull/detail/mesh_marks.h"
#include "prohull/detail/shapes.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// How ORIGINAL, the file that a certificate is about, came to be a mesh.
struct CertifiedOriginal {
  TriangleMesh mesh;                      ///< as read_mesh gives it with NonFinite::Keep
  double scale = 1;                       ///< ReadOptions::scale of that call
  std::vector<DividedFace> divided = {};  ///< ReadOptions::divided of that call
};

/// What a certificate says about a hull, beside what it covers and encloses.
struct HullClaims {
  HullSide side = HullSide::Outer;
  double gap = 0;  ///< that the hull keeps from the triangles, in their unit; 0: says nothing of it
  /// Which no point of the hull's surface exceeds from the triangles, in their unit; infinity: says nothing of it. It
  /// is left out, too, where it does not hold, or leaves so little to spare that the proof would be much larger than
  /// the meshes.
  double distance = std::numeric_limits<double>::infinity();
};

/// What HullClaims may say of a gap: a checker finds it by planes with rounded normals, which leaves a little of what
/// is proven undecided.
inline double claimed_gap(double asked, double proven) { return std::min(asked, proven * (1 - 1e-6)); }

/// What HullClaims may say of a distance. Infinity is asked for if there is no bound. The proof of a distance with
/// nothing to spare would have no end.
inline double claimed_distance(double asked, double proven) {
  return std::isfinite(asked) && proven <= asked ? asked : 1.01 * proven;
}

/// A certificate as docs/certificate.md describes it. It is a proposal: only a checker, such as
/// checker/prohull_check.c, decides whether it proves what it claims. The functions below make certificates of which
/// that is to be expected if verify_hull or verify_union say yes.
struct Certificate {
  std::string bytes;                ///< of the file
  std::vector<std::string> claims;  ///< what it is to prove: "covers every finite triangle", "encloses the solid"
  /// Triangles of the original without area, on the hull and on no edge of another triangle: a checker may not prove
  /// that these are covered, and so nothing at all.
  std::size_t flat_triangles_in_doubt = 0;
};

/// Throws InputError(OpenEdge) for an inner hull if the original is not closed: it has no inside, of which a
/// certificate could tell.
void require_certifiable(const TriangleMesh& original, HullSide side);

/// Of a hull with the coordinates that its file has. The triangles of the original that are not finite are left out. If
/// the original is not closed, it has no solid. Throws InputError if no triangle is finite, and as require_certifiable.
///
///     const CertifiedOriginal original{read_mesh("part.ply", {.non_finite = NonFinite::Keep})};
///     const EnclosingHull hull = enclosing_hull(original.mesh, 500);
///     write_mesh("hull.ply", hull.mesh);
///     std::ofstream("part.phcert", std::ios::binary) << hull_certificate(hull.mesh, original).bytes;
Certificate hull_certificate(const TriangleMesh& hull, const CertifiedOriginal& original,
                             const HullClaims& claims = {});

/// Of convex pieces, as convex_cover makes them, with the coordinates that their files have: together they are a hull,
/// whose surface may cross itself. They enclose the solid, if the original is closed.
Certificate pieces_certificate(std::span<const TriangleMesh> pieces, const CertifiedOriginal& original);

/// Of balls, as sphere_cover makes them: for each triangle of the original cuts in halves, and the balls that hold the
/// parts.
Certificate balls_certificate(std::span<const Ball> balls, const CertifiedOriginal& original);

}  // namespace prohull
