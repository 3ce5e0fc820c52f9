#pragma once

#include <cstdint>

#include "prohull/geometry.h"

namespace prohull {

/// How a triangle h meets the interior of a triangle t.
enum class Contact : std::uint8_t {
  None,      ///< nowhere, or in single points
  Crossing,  ///< in a segment
  Covering,  ///< in an area: they are coplanar
  Same,      ///< in all of it: they have the same corners
};

struct TriangleContact {
  Contact interior = Contact::None;
  std::uint8_t edges =
      0;  ///< bit e: h may hold a segment of the edge of t that begins at its corner e; if interior is None
};

/// Both triangles have an area, t one along `axis`. Exact.
TriangleContact interior_contact(const Triangle& t, int axis, const Triangle& h);

}  // namespace prohull
