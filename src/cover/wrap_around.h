#pragma once

#include "prohull/wrap.h"

namespace prohull::cover {

/// Of triangles that bound no solid, and what closes their openings: what lies inside of it counts as their inside.
inline Wrap wrap_around(const TriangleMesh& with_caps, double spacing, const Progress& progress) {
  constexpr double kClosing = 1.5;  // in spacings, as for hulls
  return wrap(with_caps, {.spacing = spacing, .seal_rooms = true, .closing = kClosing * spacing, .progress = progress});
}

}  // namespace prohull::cover
