#pragma once

#include <optional>
#include <string>

#include "prohull/certificate.h"

namespace prohull::certificate {

/// The section of tetrahedra, without its kind: those between the levels, from the hull to the triangles of the file,
/// `turned` as the certificate says. Nothing if the coarsest level is not the hull, or the finest one not `turned`, as
/// chains of oriented triangles.
std::optional<std::string> tetrahedra(const ProgressiveHull& levels, const TriangleMesh& hull,
                                      const CertifiedOriginal& original, const TriangleMesh& turned);

}  // namespace prohull::certificate
