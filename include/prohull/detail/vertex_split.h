#pragma once

#include <cstdint>

#include "prohull/detail/ids.h"

namespace prohull {

/// The inverse of the edge collapse that made one vertex s: s becomes the edge o-d, and the faces (o, d, l) and
/// (d, o, r) come back. Faces and their corners are numbered as in the original mesh; `od` and `do_` name the corners
/// (3 face + corner) that o has in the first and d in the second.
struct VertexSplit {
  VertexId o, d, l, r;
  std::uint32_t od, do_;

  bool operator==(const VertexSplit&) const = default;
};

}  // namespace prohull
