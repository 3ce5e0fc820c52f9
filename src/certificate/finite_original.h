#pragma once

#include <cstdint>
#include <vector>

#include "certificate/certificate_file.h"
#include "prohull/certificate.h"

namespace prohull::certificate {

/// The triangles that a certificate is about: those of a file that are finite, in its order.
struct FiniteOriginal {
  TriangleMesh triangles;
  bool is_closed;
  TriangleMesh turned;  ///< if it is closed: the same, but components that are inside out look outwards
  std::vector<std::uint32_t> turned_components;  ///< a triangle of each of these

  explicit FiniteOriginal(const TriangleMesh& mesh);
};

/// What a certificate of a hull, or of pieces, of so many triangles begins with.
File header(HullSide side, const CertifiedOriginal& original, std::size_t hull_triangles, const FiniteOriginal& finite);

}  // namespace prohull::certificate
